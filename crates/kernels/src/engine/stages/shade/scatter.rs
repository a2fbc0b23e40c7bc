//! The next ray of a path.

use super::vertex::Vertex;
use super::{Points, Stage};
use crate::engine::batch::{BRANCHING, Paths, path};
use crate::engine::stages::light_paths::{Turn, change};
use crate::engine::stages::materials::{Dielectric, reflect_bent};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;

/// Where the fainter of both ways carries less than this, one of them is taken at random.
const LEAST_BRANCH: f32 = 0.003;

/// Rays that go on from a vertex.
pub struct Onward<F: Lanes> {
    /// Lanes that have one.
    pub alive: F::M,
    /// Where it starts.
    pub start: V3<F>,
    /// Its direction.
    pub wi: V3<F>,
    /// f cos over the density.
    pub weight: V3<F>,
    /// What [`Paths::throughput`] holds; of paths that roulette spares more.
    pub carried: V3<F>,
    /// The density; of mirrors and glass anything.
    pub pdf: F,
    /// What [`Paths::eta2`] holds.
    pub eta2: F,
}

impl<F: Lanes> Stage<'_, F> {
    /// Samples the lobes of the lanes that go on.
    #[inline(always)]
    pub fn sample_bsdf(
        &self,
        at: &Vertex<'_, F>,
        points: &Points<F>,
        goes_on: F::M,
        branches: &mut Paths,
    ) -> Onward<F> {
        let zero = F::splat(0.0);
        let Vertex { ray, s, bsdf, wo, .. } = at;
        let (_, lobe) = points.roulette;
        let mut onward = Onward {
            alive: at.surfaces & goes_on,
            start: s.start,
            wi: ray.direction,
            weight: bsdf.color,
            carried: V3::zero(),
            pdf: F::splat(0.0),
            eta2: ray.eta2,
        };
        let rough = bsdf.rough();
        if (rough & goes_on).any() {
            let (u, v) = points.direction;
            let sample = bsdf.sample_rough(s.ns, *wo, u, v, lobe);
            onward.wi = V3::select(rough, sample.wi, onward.wi);
            onward.weight = V3::select(rough, sample.weight, onward.weight);
            onward.pdf = F::select(rough, sample.pdf, onward.pdf);
            onward.alive = onward.alive & !(rough & (sample.pdf.le(zero) | s.buries(sample.wi)));
        }
        if bsdf.mirror.any() {
            let (reflected, normal) = reflect_bent(s, *wo);
            onward.wi = V3::select(bsdf.mirror, reflected, onward.wi);
            onward.weight = V3::select(bsdf.mirror, bsdf.mirrored_color(wo.dot(normal)), onward.weight);
            onward.start = V3::select(bsdf.mirror, s.ng.mad(s.offset, s.p), onward.start);
        }
        if bsdf.transparent.any() {
            self.sample_glass(at, lobe, &mut onward, branches);
        }
        onward
    }

    /// One way at glass, by chance; at the first vertices both: the path goes on where more of the light goes, the rest
    /// is a path of its own, and shares nothing. Roulette must not see their shares: they make a whole.
    #[inline(always)]
    fn sample_glass(&self, at: &Vertex<'_, F>, lobe: F, onward: &mut Onward<F>, branches: &mut Paths) {
        let one = F::splat(1.0);
        let Vertex { ray, s, bsdf, .. } = at;
        let d = bsdf.dielectric(s, at.wo);
        let mut refracted = d.reflectance.le(lobe);
        let mut share = one;
        if self.vertex < BRANCHING {
            let fresh = (ray.slot & F::U::splat(!path::SLOT)).eq(F::U::splat(0));
            let fainter = d.reflectance.min(one - d.reflectance);
            let carried = fainter * ray.eta2 * ray.throughput.max_component();
            let both = bsdf.transparent & fresh & F::splat(LEAST_BRANCH).lt(carried);
            let passes = d.reflectance.lt(F::splat(0.5));
            refracted = (both & passes) | (!both & refracted);
            share = F::select(both, one - fainter, one);
            if both.any() {
                branch(at, &d, (passes, fainter), both, branches);
            }
        }
        let d = d.take(refracted);
        let passed = bsdf.transparent;
        onward.wi = V3::select(passed, d.wi, onward.wi);
        let side = F::select(d.refracted, -s.offset, s.offset);
        onward.start = V3::select(passed, s.ng.mad(side, s.p), onward.start);
        onward.weight = V3::select(passed & !d.refracted, V3::grey(one), onward.weight);
        onward.eta2 = F::select(passed, ray.eta2 * d.eta2 * share, onward.eta2);
    }

    /// Takes into [`Vertex::film`] what mirrors and glass change of it.
    #[inline(always)]
    pub fn change_of_film(&self, at: &mut Vertex<'_, F>, onward: &Onward<F>) {
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        if self.pass.light_paths.is_none() || self.vertex == 0 || !zero.lt(at.film).any() {
            return;
        }
        let (wo, wi) = (at.wo, onward.wi);
        let refracted = at.bsdf.transparent & wi.dot(at.s.ng).lt(zero);
        let ior = at.bsdf.ior();
        let eta = F::select(at.s.outside, one / ior, ior);
        let eta2 = F::select(refracted, eta * eta, one);
        at.film = at.film * change(&at.s, Turn { wo, wi, refracted, ior, eta2 }, true);
    }
}

/// Adds the other way at glass, with its share, for these lanes.
#[inline(always)]
fn branch<F: Lanes>(
    at: &Vertex<'_, F>,
    d: &Dielectric<F>,
    (passes, fainter): (F::M, F),
    lanes: F::M,
    branches: &mut Paths,
) {
    let Vertex { ray, s, bsdf, .. } = at;
    let o = d.take(!passes);
    let color = V3::select(o.refracted, bsdf.color, V3::grey(F::splat(1.0)));
    let side = F::select(o.refracted, -s.offset, s.offset);
    let k = branches.len;
    s.ng.mad(side, s.p).compress(lanes, &mut branches.origin, k);
    o.wi.compress(lanes, &mut branches.direction, k);
    ray.throughput.mul(color).compress(lanes, &mut branches.throughput, k);
    (ray.eta2 * o.eta2 * fainter).compress(lanes, &mut branches.eta2[k..]);
    (ray.slot | F::U::splat(path::BRANCH | path::SPECULAR)).compress(lanes, &mut branches.slot[k..]);
    ray.primitive.compress(lanes, &mut branches.from_primitive[k..]);
    ray.instance.compress(lanes, &mut branches.from_instance[k..]);
    branches.len += lanes.count();
}
