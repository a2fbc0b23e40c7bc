//! Light that is sampled from a vertex.

use super::mis::weight_of_ratio;
use super::vertex::Vertex;
use super::{Points, Stage};
use crate::engine::batch::Shadows;
use crate::engine::stages::aim;
use crate::engine::stages::lights::{self, Receiver};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::NONE;

impl<F: Lanes> Stage<'_, F> {
    /// Adds a shadow ray to a point on a light for each of these lanes, with what arrives if nothing is between. Where
    /// no further ray is cast to meet the light (lanes outside `goes_on`), the sample has weight one.
    #[inline(always)]
    pub fn sample_light(
        &self,
        at: &Vertex<'_, F>,
        points: &Points<F>,
        lanes: F::M,
        goes_on: F::M,
        shadows: &mut Shadows,
    ) {
        let tables = &self.scene.tables;
        if !lanes.any() || tables.lights.is_empty() {
            return;
        }
        let zero = F::splat(0.0);
        let Vertex { ray, s, bsdf, wo, .. } = at;
        let (u, v) = points.choice;
        let choice = lights::choose(&tables.lights, Receiver { p: s.start, n: s.ns }, u, v);
        let (u, v) = points.on_light;
        let none = F::U::splat(NONE);
        let on = F::U::select(ray.instance.eq(none), ray.primitive, none);
        let from = lights::Start { p: s.start, on, parts: &tables.shapes.parts };
        let l = lights::sample(&tables.lights, &choice, from, u, v, lanes);
        let cos_i = s.ns.dot(l.wi);
        let lit = lanes & bsdf.reaches(cos_i) & zero.lt(l.distance) & !s.buries(l.wi);
        if !lit.any() {
            return;
        }
        let (f, pdf) = bsdf.evaluate(s.ns, *wo, l.wi, cos_i);
        let by_rays = pdf + self.aimed_at_the_sky(at, l.wi, lit & choice.environment);
        let weight = F::select(goes_on, weight_of_ratio(by_rays * l.inverse_pdf), F::splat(1.0));
        let mut value = f.mul(ray.throughput).mul(l.radiance).scale(cos_i * l.inverse_pdf * (weight * ray.eta2));
        if tables.lights.glow.is_some() {
            let on_lamp = lit & !choice.environment;
            value = value.mul(lights::share_towards(self.scene, choice.light, (s.start, l.wi), l.distance, on_lamp));
        }
        let cast = lit & zero.lt(value.max_component());
        let k = shadows.len;
        s.start.compress(cast, &mut shadows.origin, k);
        l.wi.compress(cast, &mut shadows.direction, k);
        l.distance.compress(cast, &mut shadows.t_max[k..]);
        value.compress(cast, &mut shadows.contribution, k);
        ray.sum().compress(cast, &mut shadows.slot[k..]);
        at.leaves(l.wi).compress(cast, &mut shadows.from_primitive[k..]);
        ray.instance.compress(cast, &mut shadows.from_instance[k..]);
        l.primitive.compress(cast, &mut shadows.target_primitive[k..]);
        shadows.len += cast.count();
    }

    /// The density with which rays are aimed from here along these directions, for lanes where these see the sky.
    #[inline(always)]
    fn aimed_at_the_sky(&self, at: &Vertex<'_, F>, wi: V3<F>, lanes: F::M) -> F {
        let zero = F::splat(0.0);
        let Some(guide) = self.pass.guide.filter(|guide| guide.sky.is_some() && lanes.any()) else { return zero };
        let lanes = lanes & self.aims(at);
        if !lanes.any() {
            return zero;
        }
        let from = aim::From { p: at.s.start, n: at.s.ns, shared: aim::is_shared::<F>(at.ray.slot) };
        F::select(lanes, aim::density(guide, from, wi, lanes), zero)
    }
}
