//! Texture coordinates, u to the right, v upwards, before a texture's mapping; zero on meshes that have none.

use super::{FirstHit, PictureLayer, Pixel};
use crate::lanes::Lanes;

pub(super) struct Uv;

impl PictureLayer for Uv {
    const NAME: &'static str = "uv";
    const CHANNELS: &'static [&'static str] = &["U", "V"];
    // Zero is a place in a texture like any other; depth tells where nothing is hit.
    const PIXEL: Pixel = Pixel::MeanOfHits(0.0);
    const READS_UV: bool = true;

    #[inline(always)]
    fn at<F: Lanes>(hit: &FirstHit<'_, F>) -> [F; 3] {
        [hit.surface.u, hit.surface.v, F::splat(0.0)]
    }
}
