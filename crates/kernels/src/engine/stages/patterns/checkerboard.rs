//! Cubes of side 1: t = 0 where the sum of the coordinates' whole parts is even.

use super::whole;
use crate::lanes::{Bits, Lanes};
use crate::math::V3;

#[inline(always)]
pub fn t<F: Lanes>(p: V3<F>) -> F {
    let sum = whole(p.0) + whole(p.1) + whole(p.2);
    F::from_int(sum & F::U::splat(1))
}
