//! Samples that the pixel has: the same everywhere but where a rendering was ended early.

use super::{FilmNumber, PictureLayer, Pixel};

pub(super) struct Samples;

impl PictureLayer for Samples {
    const NAME: &'static str = "samples";
    const CHANNELS: &'static [&'static str] = &["Y"];
    const PIXEL: Pixel = Pixel::OfFilm(FilmNumber::Samples);
}
