//! Rays against the spheres that every ray tests, over lanes (see `scene::sphere` for the two forms of the quadratic).
//!
//! A ray that leaves a sphere is known to start on it, so that its roots there are exactly 0 and the other end of the
//! chord: no epsilon, and no self-intersection. Large spheres have gamma = 0 then; of small ones half the chord is as
//! long as the way to its middle.

use crate::engine::batch::Batch;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{LargeSphere, NONE, SmallSphere, SphereTable};

/// A ray, with what the lifted form shares between spheres; `from` is the primitive that it leaves.
#[derive(Clone, Copy)]
pub struct Ray<F: Lanes> {
    o: V3<F>,
    d: V3<F>,
    oo: F,
    od: F,
    from: F::U,
}

impl<F: Lanes> Ray<F> {
    /// From a point along a unit vector.
    #[inline(always)]
    pub fn new(o: V3<F>, d: V3<F>, from: F::U) -> Self {
        Ray { o, d, oo: o.dot(o), od: o.dot(d), from }
    }
    #[inline(always)]
    fn leaves(&self, id: u32) -> F::M {
        self.from.eq(F::U::splat(id))
    }
}

/// (beta, gamma) of the lifted form.
#[inline(always)]
fn lifted<F: Lanes>(s: &LargeSphere, ray: &Ray<F>, own: F::M) -> (F, F) {
    let c = F::splat;
    let m = V3::<F>::splat(s.m);
    let k = c(s.k);
    let beta = ray.od.fma(k, m.dot(ray.d));
    let mo = m.dot(ray.o);
    let gamma = ray.oo.fma(k, (mo + mo) + c(s.c));
    (beta, F::select(own, c(0.0), gamma))
}

/// (middle, disc): the ray meets the sphere at middle - sqrt(disc) and middle + sqrt(disc).
#[inline(always)]
fn centred<F: Lanes>(s: &SmallSphere, ray: &Ray<F>, own: F::M) -> (F, F) {
    let V3(x, y, z) = V3::<F>::splat(s.center).sub(ray.o);
    let middle = V3(x, y, z).dot(ray.d);
    let (x, y, z) = (middle.fnma(ray.d.0, x), middle.fnma(ray.d.1, y), middle.fnma(ray.d.2, z));
    let disc = z.fnma(z, y.fnma(y, x.fnma(x, F::splat(s.r2))));
    (middle, F::select(own, middle * middle, disc))
}

/// Fills `batch.hits` with the nearest of the linear spheres.
#[inline(always)]
pub fn spheres_closest<F: Lanes>(spheres: &SphereTable, batch: &mut Batch) {
    let paths = &*batch.paths;
    let zero = F::splat(0.0);
    for i in (0..paths.len).step_by(F::N) {
        let ray = Ray::<F>::new(
            V3::load(&paths.origin, i),
            V3::load(&paths.direction, i),
            F::U::load(&paths.from_primitive[i..]),
        );
        let mut id = F::U::splat(NONE);
        // The large ones: t as a fraction, compared by cross-multiplying, one division at the end.
        let (mut num, mut den) = (F::splat(1.0), zero);
        for s in &spheres.large {
            let own = ray.leaves(s.id);
            let (beta, gamma) = lifted(s, &ray, own);
            let k = F::splat(s.k);
            let disc = beta.fma(beta, -(k * gamma));
            let root = disc.max(zero).sqrt();
            let ahead = beta.lt(zero);
            // q = -(beta + sign(beta) root): the roots are gamma / q and q / k, and neither loses digits.
            let q = F::select(ahead, root - beta, -(beta + root));
            let near_inside = gamma.lt(zero) & !ahead;
            let near_outside = zero.lt(gamma) & ahead;
            let near = near_inside | near_outside;
            let n = F::select(near, gamma.abs(), q);
            let d = F::select(near, q.abs(), k);
            let hit = zero.le(disc) & (near | ahead) & (n * den).lt(num * d);
            num = F::select(hit, n, num);
            den = F::select(hit, d, den);
            id = F::U::select(hit, F::U::splat(s.id), id);
        }
        let mut t = num / den;
        for s in &spheres.small {
            let own = ray.leaves(s.id);
            let (middle, disc) = centred(s, &ray, own);
            // No branch past those that no lane meets: it is taken wrong too often.
            let root = disc.max(zero).sqrt();
            let (first, second) = (middle - root, middle + root);
            let candidate = F::select(zero.lt(first), first, second);
            let hit = zero.le(disc) & zero.lt(candidate) & candidate.lt(t);
            t = F::select(hit, candidate, t);
            id = F::U::select(hit, F::U::splat(s.id), id);
        }
        t.store(&mut batch.hits.t[i..]);
        id.store(&mut batch.hits.primitive[i..]);
        F::U::splat(NONE).store(&mut batch.hits.instance[i..]);
    }
}

/// Sets `batch.shadows.occluded` for the shadow rays that a linear sphere blocks.
#[inline(always)]
pub fn spheres_occluded<F: Lanes>(spheres: &SphereTable, batch: &mut Batch) {
    let shadows = &mut *batch.shadows;
    for i in (0..shadows.len).step_by(F::N) {
        let ray = Ray::<F>::new(
            V3::load(&shadows.origin, i),
            V3::load(&shadows.direction, i),
            F::U::load(&shadows.from_primitive[i..]),
        );
        let t_max = F::load(&shadows.t_max[i..]);
        let target = F::U::load(&shadows.target_primitive[i..]);
        let occluded = blocked(spheres, &ray, t_max, target);
        F::U::select(occluded, F::U::splat(1), F::U::splat(0)).store(&mut shadows.occluded[i..]);
    }
}

/// Whether a linear sphere other than the target blocks the way up to `t_max`.
#[inline(always)]
pub fn blocked<F: Lanes>(spheres: &SphereTable, ray: &Ray<F>, t_max: F, target: F::U) -> F::M {
    let mut occluded = F::M::from_bits(0);
    for s in &spheres.large {
        occluded = occluded | (large_blocks(s, ray, t_max) & !target.eq(F::U::splat(s.id)));
    }
    for s in &spheres.small {
        occluded = occluded | (small_blocks(s, ray, t_max) & !target.eq(F::U::splat(s.id)));
    }
    occluded
}

/// Whether a large sphere blocks the way up to `t_max`: no square root and no division, only the signs of the quadratic
/// at both ends of the segment and, where both are outside, at its vertex.
#[inline(always)]
pub fn large_blocks<F: Lanes>(s: &LargeSphere, ray: &Ray<F>, t_max: F) -> F::M {
    let zero = F::splat(0.0);
    let own = ray.leaves(s.id);
    let (beta, gamma) = lifted(s, ray, own);
    let k = F::splat(s.k);
    let kt = k * t_max;
    let at_end = (kt + beta + beta).fma(t_max, gamma);
    let disc = beta.fma(beta, -(k * gamma));
    // On its own sphere the ray starts inside when it heads inwards: there the sign is beta's.
    let starts_inside = F::select(own, beta, gamma).lt(zero);
    let ends_inside = at_end.lt(zero);
    let dips = beta.lt(zero) & (-beta).lt(kt) & zero.lt(disc);
    (starts_inside & !ends_inside) | (!starts_inside & (ends_inside | dips))
}

/// The same of a small sphere.
#[inline(always)]
pub fn small_blocks<F: Lanes>(s: &SmallSphere, ray: &Ray<F>, t_max: F) -> F::M {
    let zero = F::splat(0.0);
    let own = ray.leaves(s.id);
    let (middle, disc) = centred(s, ray, own);
    let end = t_max - middle;
    // On its own sphere, where both squares are the same, the ray starts inside when it heads inwards.
    let inwards = zero.lt(middle);
    let starts_inside = (middle * middle).lt(disc) | (own & inwards);
    let ends_inside = (end * end).lt(disc);
    let dips = inwards & zero.lt(end) & zero.lt(disc);
    (starts_inside & !ends_inside) | (!starts_inside & (ends_inside | dips))
}

#[cfg(test)]
mod tests;
