//! What a sample costs at the tree's leaves: those of up to four triangles or spheres, or of one other shape, that its
//! rays ask, shadow rays too. Counted as [`super::nodes`] is.

use super::{Count, PictureLayer, Pixel};

pub(super) struct Leaves;

impl PictureLayer for Leaves {
    const NAME: &'static str = "leaves";
    const CHANNELS: &'static [&'static str] = &["Y"];
    const PIXEL: Pixel = Pixel::Counted(Count::Leaves);
}
