//! Rays against the spheres that every ray tests, over lanes (see `scene::sphere` for the two forms of the quadratic).
//!
//! A ray that leaves a sphere sets gamma = 0 for it (and the shift of the recentred form), so that its roots there are exactly 0
//! and -2 beta / k: no epsilon, and no self-intersection.

use crate::engine::batch::Batch;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{LinearSphere, NONE, Scene};

/// A ray, with what the lifted form shares between spheres.
#[derive(Clone, Copy)]
struct Ray<F: Lanes> {
    o: V3<F>,
    d: V3<F>,
    oo: F,
    od: F,
    from: F::U,
}

impl<F: Lanes> Ray<F> {
    #[inline(always)]
    fn new(o: V3<F>, d: V3<F>, from: F::U) -> Self {
        Ray { o, d, oo: o.dot(o), od: o.dot(d), from }
    }
    #[inline(always)]
    fn leaves(&self, s: &LinearSphere) -> F::M {
        self.from.eq(F::U::splat(s.id))
    }
}

/// (beta, gamma) of the lifted form.
#[inline(always)]
fn lifted<F: Lanes>(s: &LinearSphere, ray: &Ray<F>, own: F::M) -> (F, F) {
    let c = F::splat;
    let m = V3::<F>::splat(s.m);
    let k = c(s.k);
    let beta = ray.od.fma(k, m.dot(ray.d));
    let mo = m.dot(ray.o);
    let gamma = ray.oo.fma(k, (mo + mo) + c(s.c));
    (beta, F::select(own, c(0.0), gamma))
}

/// (shift, beta, gamma) of the recentred form: t = shift + u.
#[inline(always)]
fn recentred<F: Lanes>(s: &LinearSphere, ray: &Ray<F>, own: F::M) -> (F, F, F) {
    let c = F::splat;
    let k = c(s.k);
    let n = V3::<F>::splat(s.n);
    let g0 = ray.o.sub(V3::splat(s.p));
    let shift = F::select(own, c(0.0), -g0.dot(ray.d));
    let g = ray.d.mad(shift, g0);
    let beta = g.dot(ray.d).fma(k, n.dot(ray.d));
    let ng = n.dot(g);
    let gamma = F::select(own, c(0.0), g.dot(g).fma(k, ng + ng));
    (shift, beta, gamma)
}

/// Fills `batch.hits` with the nearest of the linear spheres.
#[inline(always)]
pub fn spheres_closest<F: Lanes>(scene: &Scene, batch: &mut Batch) {
    let spheres = &scene.tables.spheres;
    let paths = &batch.paths;
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
            let own = ray.leaves(s);
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
            let own = ray.leaves(s);
            let (shift, beta, gamma) = recentred(s, &ray, own);
            let disc = beta.fma(beta, -(F::splat(s.k) * gamma));
            let may = zero.le(disc);
            if may.any() {
                let root = disc.max(zero).sqrt();
                let r = F::splat(s.r);
                let first = (-(beta + root)).fma(r, shift);
                let second = (root - beta).fma(r, shift);
                let candidate = F::select(zero.lt(first), first, second);
                let hit = may & zero.lt(candidate) & candidate.lt(t);
                t = F::select(hit, candidate, t);
                id = F::U::select(hit, F::U::splat(s.id), id);
            }
        }
        t.store(&mut batch.hits.t[i..]);
        id.store(&mut batch.hits.primitive[i..]);
        F::U::splat(NONE).store(&mut batch.hits.instance[i..]);
    }
}

/// Sets `batch.shadows.occluded` for the shadow rays that a linear sphere blocks: no square root and no division, only the signs of
/// the quadratic at both ends of the segment and, where both are outside, at its vertex.
#[inline(always)]
pub fn spheres_occluded<F: Lanes>(scene: &Scene, batch: &mut Batch) {
    let spheres = &scene.tables.spheres;
    let shadows = &mut batch.shadows;
    let zero = F::splat(0.0);
    for i in (0..shadows.len).step_by(F::N) {
        let ray = Ray::<F>::new(
            V3::load(&shadows.origin, i),
            V3::load(&shadows.direction, i),
            F::U::load(&shadows.from_primitive[i..]),
        );
        let t_max = F::load(&shadows.t_max[i..]);
        let target = F::U::load(&shadows.target_primitive[i..]);
        let mut occluded = F::M::from_bits(0);
        for s in &spheres.large {
            let own = ray.leaves(s);
            let (beta, gamma) = lifted(s, &ray, own);
            let k = F::splat(s.k);
            let kt = k * t_max;
            let at_end = (kt + beta + beta).fma(t_max, gamma);
            let disc = beta.fma(beta, -(k * gamma));
            // On its own sphere the ray starts inside when it heads inwards: there the sign is beta's.
            let starts_inside = F::select(own, beta, gamma).lt(zero);
            let ends_inside = at_end.lt(zero);
            let dips = beta.lt(zero) & (-beta).lt(kt) & zero.lt(disc);
            let blocked = (starts_inside & !ends_inside) | (!starts_inside & (ends_inside | dips));
            occluded = occluded | (blocked & !target.eq(F::U::splat(s.id)));
        }
        for s in &spheres.small {
            let own = ray.leaves(s);
            let (shift, beta, gamma) = recentred(s, &ray, own);
            let k = F::splat(s.k);
            let end = t_max - shift;
            let (k_start, k_end) = (-(k * shift), k * end);
            let beta2 = beta + beta;
            let at_start = (beta2 + k_start).fnma(shift, gamma);
            let at_end = (k_end + beta2).fma(end, gamma);
            let disc = beta.fma(beta, -(k * gamma));
            let starts_inside = F::select(own, beta, at_start).lt(zero);
            let ends_inside = at_end.lt(zero);
            let dips = k_start.lt(-beta) & (-beta).lt(k_end) & zero.lt(disc);
            let blocked = (starts_inside & !ends_inside) | (!starts_inside & (ends_inside | dips));
            occluded = occluded | (blocked & !target.eq(F::U::splat(s.id)));
        }
        F::U::select(occluded, F::U::splat(1), F::U::splat(0)).store(&mut shadows.occluded[i..]);
    }
}
