//! Veins across an axis: t = 1/2 - cos(2 pi (x + distortion n))/2, x the coordinate along it, n six octaves of
//! turbulence from 0 to 1.

use crate::engine::stages::textures::floor;
use crate::lanes::Lanes;
use crate::math::{V3, sincos_turns};

#[inline(always)]
pub fn t<F: Lanes>(p: V3<F>, axis: V3<F>, distortion: F, turbulence: F) -> F {
    wave(distortion.fma(turbulence, axis.dot(p)))
}

/// 1/2 - cos(2 pi x)/2.
#[inline(always)]
pub fn wave<F: Lanes>(x: F) -> F {
    let (_, cos) = sincos_turns(x - floor(x));
    cos.fma(F::splat(-0.5), F::splat(0.5)).max(F::splat(0.0)).min(F::splat(1.0))
}
