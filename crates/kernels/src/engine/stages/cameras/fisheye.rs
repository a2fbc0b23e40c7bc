//! Fisheye lenses: a round picture, r from its middle being a function of the angle t to the view direction.

use super::{CameraRay, Seen, View, along};
use crate::lanes::Lanes;
use crate::math::{V3, atan2_turns, sincos_turns};
use crate::scene::FisheyeMapping;
use std::f32::consts::TAU;

/// Sine and cosine of t, and the solid angle over the area of the picture, r being one on the circle.
struct Angle<F: Lanes> {
    sin: F,
    cos: F,
    solid_angle: F,
}

impl<F: Lanes> View<F> {
    #[inline(always)]
    pub(super) fn fisheye_ray(&self, x: F, y: F, mapping: FisheyeMapping, scale: f32) -> CameraRay<F> {
        let c = F::splat;
        let across = self.right.mad(x, self.up.scale(y));
        let r = across.dot(across).sqrt();
        let seen = r.lt(c(1.0));
        let t = angle(F::select(seen, r, c(0.5)), mapping, scale);
        let direction = across.mad(t.sin / r.max(c(1e-12)), self.forward.scale(t.cos));
        CameraRay { origin: self.eye, direction, measure: self.pixel_area * t.solid_angle, seen }
    }

    #[inline(always)]
    pub(super) fn fisheye_place(&self, direction: V3<F>, cos: F, mapping: FisheyeMapping, scale: f32) -> Seen<F> {
        let c = F::splat;
        let across = direction.sub(self.forward.scale(cos));
        let sin = across.dot(across).sqrt();
        let one = c(1.0);
        // The tangent of half the angle, which is exact for the smallest.
        let tangent = sin / (one + cos).max(c(1e-6));
        let r = match mapping {
            FisheyeMapping::Equidistant => atan2_turns(sin, cos) * c(TAU / scale),
            FisheyeMapping::Equisolid => tangent / (tangent.fma(tangent, one).sqrt() * c(scale)),
            FisheyeMapping::Stereographic => tangent / c(scale),
            FisheyeMapping::Orthographic => F::select(c(0.0).lt(cos), sin / c(scale), c(2.0)),
        };
        let seen = r.lt(one);
        let t = angle(F::select(seen, r, c(0.5)), mapping, scale);
        let per_sine = r / sin.max(c(1e-12));
        let (x, y) = (along(direction, self.right) * per_sine, along(direction, self.up) * per_sine);
        Seen { x, y, measure: self.pixel_area * t.solid_angle, seen }
    }
}

/// The angle at r, below one. The solid angle is sin t dt / (r dr).
#[inline(always)]
fn angle<F: Lanes>(r: F, mapping: FisheyeMapping, scale: f32) -> Angle<F> {
    let c = F::splat;
    let (zero, one, scale2) = (c(0.0), c(1.0), c(scale * scale));
    match mapping {
        FisheyeMapping::Equidistant => {
            let (sin, cos) = sincos_turns(r * c(scale / TAU));
            let per_r = F::select(c(1e-6).lt(r), sin / r.max(c(1e-6)), c(scale));
            Angle { sin, cos, solid_angle: per_r * c(scale) }
        }
        FisheyeMapping::Equisolid => {
            let half = r * c(scale);
            let cos_half = (one - half * half).max(zero).sqrt();
            let (sin, cos) = ((half + half) * cos_half, one - (half + half) * half);
            Angle { sin, cos, solid_angle: c(4.0) * scale2 }
        }
        FisheyeMapping::Stereographic => {
            let tangent = r * c(scale);
            let over = one / tangent.fma(tangent, one);
            let (sin, cos) = ((tangent + tangent) * over, (one - tangent * tangent) * over);
            Angle { sin, cos, solid_angle: c(4.0) * scale2 * over * over }
        }
        FisheyeMapping::Orthographic => {
            let sin = r * c(scale);
            let cos = (one - sin * sin).max(zero).sqrt();
            Angle { sin, cos, solid_angle: scale2 / cos.max(c(1e-3)) }
        }
    }
}
