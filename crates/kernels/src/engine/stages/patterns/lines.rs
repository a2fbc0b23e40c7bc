//! Lines: t = 0 within half a width of whole u, v.

use crate::engine::stages::textures::floor;
use crate::lanes::Lanes;
use crate::math::V3;

/// `half.0`: half the width of the lines at whole u, below 0 where there are none; `half.1`: of those at whole v.
#[inline(always)]
pub fn t<F: Lanes>(p: V3<F>, half: V3<F>) -> F {
    let on = from_whole(p.0).le(half.0) | from_whole(p.1).le(half.1);
    F::select(on, F::splat(0.0), F::splat(1.0))
}

/// Distance from the nearest whole number.
#[inline(always)]
fn from_whole<F: Lanes>(x: F) -> F {
    (x - floor(x + F::splat(0.5))).abs()
}
