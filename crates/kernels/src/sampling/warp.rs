//! From the unit square to directions and points, each with its density, in the frame of its doc comment.

use crate::lanes::Lanes;
use crate::math::{V3, expm1, ln, sincos_turns};

/// A point of the unit disc, uniform: (sqrt(u) cos 2 pi v, sqrt(u) sin 2 pi v). Density 1/pi.
#[inline(always)]
pub fn disc<F: Lanes>(u: F, v: F) -> (F, F) {
    let (s, c) = sincos_turns(v);
    let r = u.sqrt();
    (r * c, r * s)
}

/// A direction about +z with density cos(theta)/pi.
#[inline(always)]
pub fn cosine_hemisphere<F: Lanes>(u: F, v: F) -> V3<F> {
    let (x, y) = disc(u, v);
    V3(x, y, (F::splat(1.0) - u).sqrt())
}

/// A direction within a cone about +z, uniform; `one_minus_cos` is 1 - cos of its half angle. Density 1/(2 pi
/// one_minus_cos).
#[inline(always)]
pub fn cone<F: Lanes>(u: F, v: F, one_minus_cos: F) -> V3<F> {
    let (s, c) = sincos_turns(v);
    let x = u * one_minus_cos;
    let r = (x * (F::splat(2.0) - x)).sqrt();
    V3(r * c, r * s, F::splat(1.0) - x)
}

/// A half vector about +z with density (alpha + 1)/(2 pi) cos^alpha(theta).
#[inline(always)]
pub fn power_cosine<F: Lanes>(u: F, v: F, alpha: F) -> V3<F> {
    let (s, c) = sincos_turns(v);
    // cos^2 = (1 - u)^(2/(alpha + 1)), so sin^2 = -expm1(ln(1 - u) 2/(alpha + 1)) loses no digit at large alpha.
    let one = F::splat(1.0);
    let sin2 = -expm1(ln(one - u) * (F::splat(2.0) / (alpha + one)));
    let r = sin2.max(F::splat(0.0)).sqrt();
    V3(r * c, r * s, (one - sin2).max(F::splat(0.0)).sqrt())
}

#[cfg(test)]
mod tests;
