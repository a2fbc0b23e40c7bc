//! Points of a thin lens.

use super::View;
use crate::engine::stages::textures::floor;
use crate::lanes::Lanes;
use crate::math::{V3, sincos_turns};
use crate::sampling::warp;
use crate::scene::Lens;

impl<F: Lanes> View<F> {
    /// A uniform point of the lens about an eye; of a pinhole the eye.
    #[inline(always)]
    pub(super) fn lens(&self, eye: V3<F>, lens: Option<Lens>, at: (F, F)) -> V3<F> {
        match lens {
            Some(lens) => eye.add(self.on_lens(lens, at)),
            None => eye,
        }
    }

    /// From the eye to a uniform point of the lens.
    #[inline(always)]
    pub(super) fn on_lens(&self, lens: Lens, (u, v): (F, F)) -> V3<F> {
        let (x, y) = if lens.blades < 3 { warp::disc(u, v) } else { polygon(u, v, lens) };
        let radius = F::splat(lens.radius as f32);
        self.right.normalise().mad(x * radius, self.up.normalise().scale(y * radius))
    }
}

/// A uniform point of the regular polygon with a corner for each blade on the unit circle: of one of its triangles,
/// which u chooses.
#[inline(always)]
fn polygon<F: Lanes>(u: F, v: F, lens: Lens) -> (F, F) {
    let c = F::splat;
    let (blades, turn) = (lens.blades as f32, 1.0 / lens.blades as f32);
    let scaled = u * c(blades);
    let triangle = floor(scaled).min(c(blades - 1.0));
    let along = scaled - triangle;
    let at = triangle.fma(c(turn), c(lens.rotation as f32));
    let ((s0, c0), (s1, c1)) = (sincos_turns(at), sincos_turns(at + c(turn)));
    let out = v.sqrt();
    (along.fma(c1 - c0, c0) * out, along.fma(s1 - s0, s0) * out)
}
