//! What a sample costs in the tree: nodes of up to eight boxes that its rays ask, shadow rays too. Each ray is counted
//! as if it went alone, so that it does not show which others were traced beside it.

use super::{Count, PictureLayer, Pixel};

pub(super) struct Nodes;

impl PictureLayer for Nodes {
    const NAME: &'static str = "nodes";
    const CHANNELS: &'static [&'static str] = &["Y"];
    const PIXEL: Pixel = Pixel::Counted(Count::Nodes);
}
