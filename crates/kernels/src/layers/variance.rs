//! Estimated variance of the pixel's mean luminance, in the square of W/(sr m^2): how noisy it still is.

use super::{FilmNumber, PictureLayer, Pixel};

pub(super) struct Variance;

impl PictureLayer for Variance {
    const NAME: &'static str = "variance";
    const CHANNELS: &'static [&'static str] = &["Y"];
    // The film keeps what it comes of for every picture.
    const PIXEL: Pixel = Pixel::OfFilm(FilmNumber::Variance);
}
