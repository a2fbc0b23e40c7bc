//! Luminous spheres: which one, a direction to it, and the density of a direction that met one.

use super::materials::TWO_PI;
use crate::lanes::{Bits, Lanes};
use crate::math::V3;
use crate::sampling::warp;
use crate::scene::LightTable;

/// A direction to a light.
pub struct LightSample<F: Lanes> {
    /// Unit direction.
    pub wi: V3<F>,
    /// Distance to the light's surface along it.
    pub distance: F,
    /// Density in solid angle, the choice of the light included.
    pub pdf: F,
    /// Radiance that comes from there.
    pub radiance: V3<F>,
    /// The light's primitive.
    pub primitive: F::U,
}

/// Which light: proportional to power, by the alias method.
#[inline(always)]
pub fn choose<F: Lanes>(lights: &LightTable, u: F, v: F) -> F::U {
    let n = F::splat(lights.len as f32);
    let last = F::U::splat(lights.len - 1);
    let k = (u * n).to_int();
    let k = F::U::select(last.lt(k), last, k);
    F::U::select(v.lt(F::gather(&lights.keep, k)), k, F::U::gather(&lights.alias, k))
}

/// 1 - cos of the half angle under which a sphere is seen from squared distance d2, without cancellation; 2 (all directions) from
/// within. Uniform in solid angle: the density of a direction is 1 / (2 pi times this).
#[inline(always)]
fn one_minus_cos<F: Lanes>(d2: F, r2: F) -> F {
    let one = F::splat(1.0);
    let inside = d2.le(r2);
    let sin2 = r2 / F::select(inside, r2, d2);
    let cos = (one - sin2).max(F::splat(0.0)).sqrt();
    F::select(inside, F::splat(2.0), sin2 / (one + cos))
}

/// A direction from `p` to light k, uniform in the solid angle under which it is seen.
#[inline(always)]
pub fn sample<F: Lanes>(lights: &LightTable, k: F::U, p: V3<F>, u: F, v: F) -> LightSample<F> {
    let c = F::splat;
    let center = V3(F::gather(&lights.center[0], k), F::gather(&lights.center[1], k), F::gather(&lights.center[2], k));
    let radius = F::gather(&lights.radius, k);
    let to_center = center.sub(p);
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
        pdf: F::gather(&lights.probability, k) / (opening * c(TWO_PI)),
        radiance: radiance(lights, k),
        primitive: F::U::gather(&lights.primitive, k),
    }
}

/// Density with which [`choose`] and [`sample`] take a direction from `p` that meets light k.
#[inline(always)]
pub fn pdf<F: Lanes>(lights: &LightTable, k: F::U, p: V3<F>) -> F {
    let center = V3(F::gather(&lights.center[0], k), F::gather(&lights.center[1], k), F::gather(&lights.center[2], k));
    let radius = F::gather(&lights.radius, k);
    let to_center = center.sub(p);
    let opening = one_minus_cos(to_center.dot(to_center), radius * radius);
    F::gather(&lights.probability, k) / (opening * F::splat(TWO_PI))
}

/// Radiance of light k.
#[inline(always)]
pub fn radiance<F: Lanes>(lights: &LightTable, k: F::U) -> V3<F> {
    V3(F::gather(&lights.radiance[0], k), F::gather(&lights.radiance[1], k), F::gather(&lights.radiance[2], k))
}

#[cfg(test)]
mod tests;
