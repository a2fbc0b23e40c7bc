//! As the eye and lenses see: pinhole and thin lens, whose film may be shifted and whose plane of focus may be tilted.

use super::{CameraRay, Seen, View};
use crate::lanes::Lanes;
use crate::math::V3;
use crate::scene::Lens;

impl<F: Lanes> View<F> {
    #[inline(always)]
    pub(super) fn perspective_ray(
        &self,
        x: F,
        y: F,
        shift: [f64; 2],
        lens: Option<Lens>,
        on_lens: (F, F),
    ) -> CameraRay<F> {
        let c = F::splat;
        let (x, y) = (x + c(shift[0] as f32), y + c(shift[1] as f32));
        let mut direction = self.right.mad(x, self.up.mad(y, self.forward));
        let mut origin = self.eye;
        let mut measure = c(1.0);
        if let Some(lens) = lens {
            let focus = c(lens.focus_distance as f32);
            let offset = self.on_lens(lens, on_lens);
            origin = self.eye.add(offset);
            direction = match lens.tilted {
                // The plane of focus is met at focus_distance times the direction whose forward component is one.
                None => direction.scale(focus).sub(offset),
                // Tilted, it is met at focus_distance / (direction . normal), which may be behind the eye; so not the
                // point is taken, but what the offset bends the direction by.
                Some(normal) => {
                    let normal = V3::<F>::splat(normal.as_vec3().to_array());
                    measure = tilted(offset, normal, focus).abs();
                    direction.scale(focus).sub(offset.scale(direction.dot(normal)))
                }
            };
        }
        CameraRay { origin, direction, measure, seen: F::first(F::N) }
    }

    /// What is seen along a direction, whose cosine to the view direction this is, from a point of the lens so far
    /// from its middle.
    #[inline(always)]
    pub(super) fn perspective_place(
        &self,
        offset: V3<F>,
        direction: V3<F>,
        cos: F,
        shift: [f64; 2],
        lens: Option<Lens>,
    ) -> Seen<F> {
        let c = F::splat;
        let focus = match lens {
            Some(lens) => c(lens.focus_distance as f32),
            None => c(1.0),
        };
        let reach = focus / F::select(c(0.0).lt(cos), cos, c(1.0));
        let (mut measure, mut at) = (c(1.0), direction.mad(reach, offset));
        if let Some(Lens { tilted: Some(normal), .. }) = lens {
            // The other way round: with forward components of one, q = d - o (d . n) / f, so d = q + o (q . n) / (f -
            // o . n).
            let normal = V3::<F>::splat(normal.as_vec3().to_array());
            let along = direction.scale(reach);
            let larger = tilted(offset, normal, focus);
            measure = larger.abs();
            at = offset.mad(along.dot(normal) / (focus * larger), along);
        }
        let x = at.dot(self.right) / (self.right.dot(self.right) * focus) - c(shift[0] as f32);
        let y = at.dot(self.up) / (self.up.dot(self.up) * focus) - c(shift[1] as f32);
        Seen { x, y, measure, seen: c(0.0).lt(cos) }
    }
}

/// How much larger the picture is from a point of the lens whose plane of focus is tilted: the determinant of the map
/// of [`View::perspective_ray`] from directions from the eye to those from there. Beyond the plane of focus, where that
/// cuts through the lens, it is below zero: the picture is upside down, and as much larger.
#[inline(always)]
fn tilted<F: Lanes>(offset: V3<F>, normal: V3<F>, focus: F) -> F {
    F::splat(1.0) - offset.dot(normal) / focus
}
