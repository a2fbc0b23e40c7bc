//! Parallel rays from the plane of the eye.

use super::{CameraRay, Seen, View, along};
use crate::lanes::Lanes;
use crate::math::V3;

impl<F: Lanes> View<F> {
    #[inline(always)]
    pub(super) fn orthographic_ray(&self, x: F, y: F) -> CameraRay<F> {
        CameraRay {
            origin: self.right.mad(x, self.up.mad(y, self.eye)),
            direction: self.forward,
            measure: self.pixel_area,
            seen: F::first(F::N),
        }
    }

    /// The point of the eye's plane that sees a point.
    #[inline(always)]
    pub(super) fn under(&self, point: V3<F>) -> V3<F> {
        let depth = point.sub(self.eye).dot(self.forward);
        self.forward.mad(-depth, point)
    }

    #[inline(always)]
    pub(super) fn orthographic_place(&self, point: V3<F>) -> Seen<F> {
        let from_eye = point.sub(self.eye);
        let seen = F::splat(0.0).lt(from_eye.dot(self.forward));
        Seen { x: along(from_eye, self.right), y: along(from_eye, self.up), measure: self.pixel_area, seen }
    }
}
