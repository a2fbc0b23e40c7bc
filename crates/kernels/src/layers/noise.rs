//! The pixel's standard error relative to its own luminance, 0.1 for ten per cent: how noisy it still is, as the eye
//! sees it. Zero where it is black, and below two samples.

use super::{FilmNumber, PictureLayer, Pixel};

pub(super) struct Noise;

impl PictureLayer for Noise {
    const NAME: &'static str = "noise";
    const CHANNELS: &'static [&'static str] = &["Y"];
    const PIXEL: Pixel = Pixel::OfFilm(FilmNumber::Noise);
}
