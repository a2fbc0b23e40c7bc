//! Two eyes, each with half of the picture ([`crate::scene::Stereo`]). An eye is told by -1, the left one, or 1.
//!
//! A light path goes to one of them at random, so that each has half of what a single camera would have, and paths
//! weigh it by half the measure. Where a pixel's filter reaches over the border of its eye's half light paths do not
//! go.

use super::{Seen, View};
use crate::lanes::{Lanes, Mask};
use crate::math::{V3, sincos_turns};
use crate::scene::{Camera, Projection};

/// The eyes, splatted.
pub(super) struct Eyes<F: Lanes> {
    /// From the middle to the right eye.
    aside: V3<F>,
    /// How long that is.
    distance: F,
    inwards: F,
    above: bool,
}

impl<F: Lanes> Eyes<F> {
    #[inline(always)]
    pub(super) fn of(camera: &Camera) -> Option<Self> {
        let stereo = camera.stereo.as_ref()?;
        let aside = camera.right.normalize() * stereo.aside;
        Some(Eyes {
            aside: V3::splat(aside.as_vec3().to_array()),
            distance: F::splat(stereo.aside as f32),
            inwards: F::splat(stereo.inwards as f32),
            above: stereo.above,
        })
    }

    /// Whose half of the picture a place lies in.
    #[inline(always)]
    pub(super) fn eye(&self, x: F, y: F) -> F {
        let zero = F::splat(0.0);
        let left = if self.above { zero.lt(y) } else { x.lt(zero) };
        F::select(left, F::splat(-1.0), F::splat(1.0))
    }

    /// A place of the picture in that of an eye.
    #[inline(always)]
    pub(super) fn in_half(&self, eye: F, x: F, y: F) -> (F, F) {
        if self.above { (x, y + y + eye) } else { (x + x - eye, y) }
    }

    /// What an eye sees in its middle it looks at from its own side.
    #[inline(always)]
    pub(super) fn outwards(&self, eye: F, x: F) -> F {
        x - eye * self.inwards
    }

    /// A place in the picture of an eye in the whole one, seen where it lies in the eye's half.
    #[inline(always)]
    pub(super) fn in_whole(&self, eye: F, at: Seen<F>) -> Seen<F> {
        let half = F::splat(0.5);
        let (x, y) = (at.x + eye * self.inwards, at.y);
        let seen = at.seen & within(x, y);
        let (x, y) = if self.above { (x, (y - eye) * half) } else { ((x + eye) * half, y) };
        Seen { x, y, measure: at.measure * half, seen }
    }

    /// The measure of a place of an eye.
    #[inline(always)]
    pub(super) fn measure(&self, (x, y): (F, F), of_camera: F) -> F {
        F::select(within(x, y), of_camera * F::splat(0.5), F::splat(0.0))
    }

    /// An eye by a uniform number, and what is left of it, which is uniform again.
    #[inline(always)]
    pub(super) fn choose(&self, u: F) -> (F, F) {
        let one = F::splat(1.0);
        let right = F::splat(0.5).le(u);
        (F::select(right, one, -one), u + u - F::select(right, one, F::splat(0.0)))
    }
}

#[inline(always)]
fn within<F: Lanes>(x: F, y: F) -> F::M {
    let one = F::splat(1.0);
    x.abs().lt(one) & y.abs().lt(one)
}

impl<F: Lanes> View<F> {
    /// From the middle to the eye that sees what is at x of its picture.
    #[inline(always)]
    pub(super) fn aside(&self, eyes: &Eyes<F>, eye: F, x: F) -> V3<F> {
        if let Projection::Panorama = self.projection {
            let (sin, cos) = sincos_turns(x * F::splat(0.5));
            return self.right.scale(cos).sub(self.forward.scale(sin)).scale(eye * eyes.distance);
        }
        eyes.aside.scale(eye)
    }

    /// From the middle to where an eye sees a point from, and whether it does. In a panorama the ray touches the circle
    /// of the eyes: with the point's distances r to the right and f ahead, and s along the ray, r = a cos + s sin and
    /// f = s cos - a sin. No ray leads to what is above or below the circle.
    #[inline(always)]
    pub(super) fn aside_for(&self, eyes: &Eyes<F>, eye: F, point: V3<F>) -> (V3<F>, F::M) {
        if let Projection::Panorama = self.projection {
            let a = eye * eyes.distance;
            let to = point.sub(self.eye);
            let (r, f) = (to.dot(self.right), to.dot(self.forward));
            let square = r.fma(r, f * f).max(F::splat(1e-30));
            let (zero, s2) = (F::splat(0.0), square - a * a);
            let s = s2.max(zero).sqrt();
            let (sin, cos) = ((s * r - a * f) / square, (s * f + a * r) / square);
            return (self.right.scale(cos).sub(self.forward.scale(sin)).scale(a), zero.lt(s2));
        }
        (eyes.aside.scale(eye), F::M::from_bits(!0))
    }
}
