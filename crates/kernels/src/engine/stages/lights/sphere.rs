//! Luminous spheres: a direction to one, and its density.

use super::LightSample;
use crate::engine::stages::materials::TWO_PI;
use crate::lanes::Lanes;
use crate::math::V3;
use crate::sampling::warp;
use crate::scene::LightTable;

/// 1 - cos of the half angle under which a sphere is seen from squared distance d2, without cancellation; 2 (all
/// directions) from within. Uniform in solid angle: the density of a direction is 1 / (2 pi times this).
#[inline(always)]
fn one_minus_cos<F: Lanes>(d2: F, r2: F) -> F {
    let one = F::splat(1.0);
    let inside = d2.le(r2);
    let sin2 = r2 / F::select(inside, r2, d2);
    let cos = (one - sin2).max(F::splat(0.0)).sqrt();
    F::select(inside, F::splat(2.0), sin2 / (one + cos))
}

/// A direction from `p` to light `k`, uniform in the solid angle under which it is seen.
#[inline(always)]
pub fn sample<F: Lanes>(lights: &LightTable, k: F::U, p: V3<F>, u: F, v: F) -> LightSample<F> {
    let c = F::splat;
    let [x, y, z, radius, red, green, blue, primitive, inwards, _] = lights.rows.row::<F>(k);
    let to_center = V3(x, y, z).sub(p);
    let d2 = to_center.dot(to_center);
    let r2 = radius * radius;
    let inside = d2.le(r2);
    let opening = one_minus_cos(d2, r2);
    let at_center = d2.le(c(0.0));
    let inverse = c(1.0) / F::select(at_center, c(1.0), d2).sqrt();
    let axis = V3::select(at_center, V3(c(0.0), c(0.0), c(1.0)), to_center.scale(inverse));
    let local = warp::cone(u, v, opening);
    let wi = axis.to_world(local);
    let along = d2 * inverse * local.2;
    let sin2 = local.0.fma(local.0, local.1 * local.1);
    let half_chord = d2.fnma(sin2, r2).max(c(0.0)).sqrt();
    let distance = F::select(inside, along + half_chord, along - half_chord);
    LightSample {
        wi,
        distance,
        inverse_pdf: opening * c(TWO_PI),
        radiance: V3::select(inside & inwards.le(c(0.0)), V3::zero(), V3(red, green, blue)),
        primitive: primitive.to_bits(),
    }
}

/// One over the density of [`sample`] in solid angle, of directions that meet light `k`.
#[inline(always)]
pub fn inverse_pdf<F: Lanes>(lights: &LightTable, k: F::U, p: V3<F>) -> F {
    let [x, y, z, radius, ..] = lights.rows.row::<F>(k);
    let to_center = V3(x, y, z).sub(p);
    one_minus_cos(to_center.dot(to_center), radius * radius) * F::splat(TWO_PI)
}
