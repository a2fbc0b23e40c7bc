//! Light that rays have met: a light's, or that from beyond all surfaces.

use super::Stage;
use super::mis::power_heuristic;
use super::vertex::{Ray, has};
use crate::engine::batch::{Columns, Hits, ITEMS, Paths, path};
use crate::engine::guide::Guide;
use crate::engine::stages::aim;
use crate::engine::stages::light_paths::{density_ratio, density_ratio_of_sky};
use crate::engine::stages::lights::{self, Beyond, LightHit, Receiver};
use crate::engine::stages::surface::Surface;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;

/// Light that a vector of paths brings to their sums.
pub struct Seen<F: Lanes> {
    /// How much.
    pub light: V3<F>,
    /// Lanes that bring some.
    pub lanes: F::M,
}

impl<F: Lanes> Seen<F> {
    /// Adds it to the paths' sums, one after the other.
    #[inline(always)]
    pub fn add(&self, radiance: &mut Columns, sum: F::U) {
        let mut bits = self.lanes.bits();
        if bits == 0 {
            return;
        }
        let mut slots = [0u32; 32];
        let mut values = [[0f32; 32]; 3];
        sum.store(&mut slots);
        self.light.0.store(&mut values[0]);
        self.light.1.store(&mut values[1]);
        self.light.2.store(&mut values[2]);
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize;
            bits &= bits - 1;
            let to = slots[lane] as usize;
            for channel in 0..3 {
                radiance[channel][to] += values[channel][lane];
            }
        }
    }
}

impl<F: Lanes> Stage<'_, F> {
    /// What the paths' throughput counts for light that they have met: the scaling of refraction, and the share that
    /// glint chains leave (weights by item where a batch has any).
    #[inline(always)]
    pub fn shown(&self, ray: &Ray<F>, glint_weight: Option<&[f32; ITEMS]>) -> F {
        let Some(weights) = glint_weight else { return ray.eta2 };
        let mirrors_and_glass =
            (ray.slot & F::U::splat(!(path::SLOT | path::BRANCH | path::SPECULAR))).eq(F::U::splat(0));
        F::select(mirrors_and_glass, ray.eta2 * F::gather(weights, ray.item()), ray.eta2)
    }

    /// Light from beyond all surfaces, for rays that hit nothing.
    #[inline(always)]
    pub fn beyond(&self, ray: &Ray<F>, aimed: F::M, paths: &Paths, shown: F) -> Seen<F> {
        let mut lanes = if self.open { ray.valid & !ray.hit } else { F::M::from_bits(0) };
        let sky = self.pass.guide.filter(|guide| guide.sky.is_some() && self.vertex > 0);
        let mut shown = shown;
        let mut by_rays = None;
        match sky {
            Some(guide) => {
                let (both, share) = self.own_and_aimed(guide, ray, paths, lanes);
                (by_rays, shown) = (Some(both), shown * share);
            }
            None => lanes = lanes & !aimed,
        }
        let mut light = ray.throughput.scale(shown).mul(V3::<F>::splat(self.scene.background));
        let lights = &self.scene.tables.lights;
        if let Some(environment) = &lights.environment
            && (self.vertex > 0 || environment.camera_visible)
            && lanes.any()
        {
            let by_rays = by_rays.unwrap_or_else(|| F::load(&paths.pdf[ray.first..]));
            let sky = lights::beyond(lights, environment, ray.direction);
            // Of mirrors and glass no light sample takes this direction; an aimed ray is a rough surface's.
            let not_sampled = has(ray.slot, path::SPECULAR) & !aimed;
            let weight = F::select(not_sampled, F::splat(1.0), power_heuristic(by_rays, sky.sampled));
            let weight = self.beside_light_paths(ray, paths, lanes, &sky, weight);
            light = ray.throughput.mul(sky.radiance).scale(shown * weight);
        }
        Seen { light, lanes }
    }

    /// What rays count by that have come over mirrors and glass to where light paths come from, too; of others
    /// `weight`.
    #[inline(always)]
    fn beside_light_paths(&self, ray: &Ray<F>, paths: &Paths, lanes: F::M, sky: &Beyond<F>, weight: F) -> F {
        let Some((light_paths, plan)) = self.pass.light_paths.filter(|_| self.vertex > 1) else { return weight };
        let ratio = F::load(&paths.film[ray.first..]);
        let found = lanes & F::splat(0.0).lt(ratio);
        if !found.any() {
            return weight;
        }
        let from = [&paths.from_primitive, &paths.from_instance].map(|column| F::U::load(&column[ray.first..]));
        let by_light = density_ratio_of_sky(light_paths, plan, (sky.pdf, sky.radiance), from, ratio, found);
        let one = F::splat(1.0);
        F::select(found, one / (one + by_light), weight)
    }

    /// Of rays that see the sky, which those that are aimed from the same surface may see, too: the density of both
    /// ways together, and what share of it is these rays' (aimed ones count so already).
    #[inline(always)]
    fn own_and_aimed(&self, guide: &Guide, ray: &Ray<F>, paths: &Paths, lanes: F::M) -> (F, F) {
        let by_itself = F::load(&paths.pdf[ray.first..]);
        let one = F::splat(1.0);
        let own = lanes & has(ray.slot, path::AIMS);
        if !own.any() {
            return (by_itself, one);
        }
        let normal = V3::<F>::load(&paths.normal, ray.first);
        let from = aim::From { p: ray.origin, n: normal, shared: aim::is_shared::<F>(ray.slot) };
        let both = by_itself + aim::density(guide, from, ray.direction, own);
        (F::select(own, both, by_itself), F::select(own, by_itself / both, one))
    }

    /// Light of the lights that the rays of these lanes hit, beside what is seen already. Light is added path by path,
    /// not kind by kind: both ways at glass have one slot, and the order of a sum must not depend on the number of
    /// lanes.
    #[inline(always)]
    pub fn emission(
        &self,
        at: (&Ray<F>, &Surface<F>),
        from: (&Paths, &Hits),
        shown: F,
        lanes: F::M,
        seen: &mut Seen<F>,
    ) {
        let ((ray, s), (paths, hits)) = (at, from);
        if lanes.any() {
            let (zero, one) = (F::splat(0.0), F::splat(1.0));
            let lights = &self.scene.tables.lights;
            let light = F::U::select(lanes, s.light - F::U::splat(1), F::U::splat(0));
            let pdf = F::load(&paths.pdf[ray.first..]);
            let normal = if self.several { V3::<F>::load(&paths.normal, ray.first) } else { V3::grey(zero) };
            let (direction, distance) = (ray.direction, ray.distance(hits));
            let met = LightHit { direction, distance, cos: direction.dot(s.ng).abs(), front: s.outside, lanes };
            let sampled = lights::pdf(lights, light, Receiver { p: ray.origin, n: normal }, &met);
            let mut weight = F::select(has(ray.slot, path::SPECULAR), one, power_heuristic(pdf, sampled));
            if let Some((light_paths, plan)) = self.pass.light_paths
                && self.vertex > 1
            {
                let ratio = F::load(&paths.film[ray.first..]);
                let found = lanes & zero.lt(ratio);
                if found.any() {
                    let from = |column: &[u32]| F::U::load(&column[ray.first..]);
                    let (primitive, instance) = (from(&paths.from_primitive), from(&paths.from_instance));
                    let by_light =
                        density_ratio(light_paths, plan, s, direction, light, primitive, instance, ratio, found);
                    weight = F::select(found, one / (one + by_light), weight);
                }
            }
            let mut shines = lights::radiance(lights, light, &met).mul(ray.throughput).scale(shown * weight);
            if lights.glow.is_some() {
                shines = shines.mul(lights::share_at(self.scene, s, lanes));
            }
            seen.light = V3::select(lanes, shines, seen.light);
        }
        seen.lanes = seen.lanes | lanes;
    }
}
