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
    // Points are known to some 2^-22 of their distance from the origin, and coordinates to as much of their size.
    let (V3(x, y, z), least) = (moved.sub(p), F::splat(1.0 / 1_048_576.0));
    let of_points = (x.abs() + y.abs() + z.abs()).fma(F::splat(1.0 / 32.0), least);
    let rounding = |x: F| x.abs().fma(F::splat(1.0 / 4_194_304.0), of_points).min(F::splat(0.01));
    let V3(x, y, z) = p;
    let sum = whole(x + rounding(x)) + whole(y + rounding(y)) + whole(z + rounding(z));
    F::from_int(sum & F::U::splat(1))
}
