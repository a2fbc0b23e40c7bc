//! Gradients: t is a coordinate, or the distance from the origin, clamped.

use crate::lanes::Lanes;
use crate::math::V3;

/// By the coordinate along an axis.
#[inline(always)]
pub fn along<F: Lanes>(p: V3<F>, axis: V3<F>) -> F {
    p.dot(axis).max(F::splat(0.0)).min(F::splat(1.0))
}

/// By the distance from the origin.
#[inline(always)]
pub fn radial<F: Lanes>(p: V3<F>) -> F {
    p.dot(p).sqrt().min(F::splat(1.0))
}
