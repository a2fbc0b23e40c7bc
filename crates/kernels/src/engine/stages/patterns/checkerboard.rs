//! Cubes of side 1: t = 0 where the sum of the coordinates' whole parts is even.
//!
//! A face that lies where two cubes meet is in one of them everywhere, the upper one: coordinates that rounding may
//! have put just below a whole number count as that number.

use super::whole;
use crate::lanes::{Bits, Lanes};
use crate::math::V3;

/// Points are moved away from render space's origin by this share of their distance to see what that does to their
/// coordinates.
pub const MOVED: f32 = 1.0 / 65_536.0;

/// `moved`: the coordinates of the point that is moved so.
#[inline(always)]
pub fn t<F: Lanes>(p: V3<F>, moved: V3<F>) -> F {
    // Points are known to some 2^-22 of their distance from the origin.
    let V3(x, y, z) = moved.sub(p);
    let rounding = (x.abs() + y.abs() + z.abs()).fma(F::splat(1.0 / 32.0), F::splat(1.0 / 1_048_576.0));
    let rounding = rounding.min(F::splat(0.01));
    let sum = whole(p.0 + rounding) + whole(p.1 + rounding) + whole(p.2 + rounding);
    F::from_int(sum & F::U::splat(1))
}
