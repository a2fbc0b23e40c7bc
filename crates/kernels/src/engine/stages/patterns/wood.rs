//! Rings around the y axis: t = 1/2 - cos(2 pi (hypot(x, z) + distortion n))/2, n four octaves of noise from -1 to 1.

use super::marble::wave;
use crate::lanes::Lanes;
use crate::math::V3;

#[inline(always)]
pub fn t<F: Lanes>(p: V3<F>, distortion: F, noise: F) -> F {
    let radius = p.0.fma(p.0, p.2 * p.2).sqrt();
    wave(distortion.fma(noise, radius))
}
