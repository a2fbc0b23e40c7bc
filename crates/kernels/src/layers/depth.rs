//! The distance from the eye along the view axis, as `focus_distance` is measured: that of a wall seen straight is the
//! same in all of the picture. A lens lies across the view axis, so it changes nothing. Cameras that see all around
//! have no such axis: the distance itself.

use super::{FirstHit, PictureLayer, Pixel, Units};
use crate::engine::depth;
use crate::lanes::Lanes;
use crate::scene::Scene;

pub(super) struct Depth;

impl PictureLayer for Depth {
    const NAME: &'static str = "depth";
    const CHANNELS: &'static [&'static str] = &["Z"];
    // A mean of distances to something and to nothing is neither: what hits nothing is left out. Where nothing is hit
    // at all, infinity is behind everything, as pictures that are laid over each other by depth want it, and is no
    // distance that a surface could have.
    const PIXEL: Pixel = Pixel::MeanOfHits(f32::INFINITY);

    #[inline(always)]
    fn at<F: Lanes>(hit: &FirstHit<'_, F>) -> [F; 3] {
        let depth = depth(&hit.scene.camera, hit.t, hit.direction);
        [depth, depth, depth]
    }

    fn units(scene: &Scene) -> Units {
        Units { scale: 1.0 / scene.frame.scale, ..Units::SAME }
    }
}
