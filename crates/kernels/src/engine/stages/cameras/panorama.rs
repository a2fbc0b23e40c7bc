//! All directions: longitude across, latitude upwards.
//!
//! The picture ends where it begins, but a pixel's filter reaches over its border: there light paths do not go, which
//! fall onto the picture itself.

use super::{CameraRay, Seen, View};
use crate::lanes::Lanes;
use crate::math::{V3, atan2_turns, sincos_turns};
use std::f32::consts::PI;

impl<F: Lanes> View<F> {
    #[inline(always)]
    pub(super) fn panorama_ray(&self, x: F, y: F) -> CameraRay<F> {
        let c = F::splat;
        let ((sin_x, cos_x), (sin_y, cos_y)) = (sincos_turns(x * c(0.5)), sincos_turns(y * c(0.25)));
        let across = self.right.mad(sin_x, self.forward.scale(cos_x));
        let within = x.abs().lt(c(1.0)) & y.abs().lt(c(1.0));
        CameraRay {
            origin: self.eye,
            direction: across.mad(cos_y, self.up.scale(sin_y)),
            measure: F::select(within, self.solid_angle() * cos_y, c(0.0)),
            seen: F::first(F::N),
        }
    }

    #[inline(always)]
    pub(super) fn panorama_place(&self, direction: V3<F>, cos: F) -> Seen<F> {
        let c = F::splat;
        let (right, up) = (direction.dot(self.right), direction.dot(self.up));
        let across = right.fma(right, cos * cos).sqrt();
        let (x, y) = (atan2_turns(right, cos) * c(2.0), atan2_turns(up, across) * c(4.0));
        Seen { x, y, measure: self.solid_angle() * across, seen: F::first(F::N) }
    }

    /// Of a pixel on the horizon: a turn over the columns, half a turn over the rows.
    #[inline(always)]
    fn solid_angle(&self) -> F {
        F::splat(PI / self.middle_of_eye[0]) * F::splat(0.5 * PI / self.middle_of_eye[1])
    }
}
