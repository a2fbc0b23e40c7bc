//! Rings around an axis: t = 1/2 - cos(2 pi (d + distortion n))/2, d the distance from it, n four octaves of noise from
//! -1 to 1.

use super::marble::wave;
use crate::lanes::Lanes;
use crate::math::V3;

#[inline(always)]
pub fn t<F: Lanes>(p: V3<F>, axis: V3<F>, distortion: F, noise: F) -> F {
    // Beside the axis: of the y axis (x, 0, z), to the last bit.
    let V3(x, y, z) = p.sub(axis.scale(axis.dot(p)));
    let distance = x.fma(x, y.fma(y, z * z)).sqrt();
    wave(distortion.fma(noise, distance))
}
