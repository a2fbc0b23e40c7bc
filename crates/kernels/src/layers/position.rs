//! The point, in the scene's axes and unit.

use super::{FirstHit, PictureLayer, Pixel, Units};
use crate::lanes::Lanes;
use crate::scene::Scene;

pub(super) struct Position;

impl PictureLayer for Position {
    const NAME: &'static str = "position";
    const CHANNELS: &'static [&'static str] = &["X", "Y", "Z"];
    // No point is far from all others: where nothing is hit it is the origin, and depth tells.
    const PIXEL: Pixel = Pixel::MeanOfHits(0.0);

    #[inline(always)]
    fn at<F: Lanes>(hit: &FirstHit<'_, F>) -> [F; 3] {
        let p = hit.surface.p;
        [p.0, p.1, p.2]
    }

    fn units(scene: &Scene) -> Units {
        Units { scale: 1.0 / scene.frame.scale, offset: scene.frame.centre.to_array() }
    }
}
