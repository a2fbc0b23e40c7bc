//! The shading normal, unit, in the scene's axes (render space has the same), on the viewer's side.

use super::{FirstHit, PictureLayer, Pixel};
use crate::lanes::Lanes;

pub(super) struct Normal;

impl PictureLayer for Normal {
    const NAME: &'static str = "normal";
    const CHANNELS: &'static [&'static str] = &["X", "Y", "Z"];
    // Zero is no direction, so it says that there is none; a share of it shortens the normal as it dims the picture.
    const PIXEL: Pixel = Pixel::Mean;

    #[inline(always)]
    fn at<F: Lanes>(hit: &FirstHit<'_, F>) -> [F; 3] {
        let normal = hit.surface.ns;
        [normal.0, normal.1, normal.2]
    }
}
