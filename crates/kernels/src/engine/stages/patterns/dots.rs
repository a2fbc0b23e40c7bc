//! Dots: t = 1 within the radius of the middle of each unit square.

use crate::engine::stages::textures::floor;
use crate::lanes::Lanes;
use crate::math::V3;

#[inline(always)]
pub fn t<F: Lanes>(p: V3<F>, radius: F) -> F {
    let half = F::splat(0.5);
    let (x, y) = (p.0 - floor(p.0) - half, p.1 - floor(p.1) - half);
    F::select(x.fma(x, y * y).lt(radius * radius), F::splat(1.0), F::splat(0.0))
}
