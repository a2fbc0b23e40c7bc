//! Rays that a sample's paths are made of: the camera's, one for each surface that scatters, both ways at glass, aimed
//! rays. Neither rays that ask whether a light is seen, nor those of glint chains and light paths.

use super::{Count, PictureLayer, Pixel};

pub(super) struct PathLength;

impl PictureLayer for PathLength {
    const NAME: &'static str = "path_length";
    const CHANNELS: &'static [&'static str] = &["Y"];
    const PIXEL: Pixel = Pixel::Counted(Count::Rays);
}
