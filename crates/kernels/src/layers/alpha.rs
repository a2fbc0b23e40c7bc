//! Coverage: the share of a pixel that hides the background. It is one where something is hit, glass and mirrors
//! included.

use super::{FirstHit, PictureLayer, Pixel};
use crate::lanes::Lanes;

pub(super) struct Alpha;

impl PictureLayer for Alpha {
    const NAME: &'static str = "alpha";
    const CHANNELS: &'static [&'static str] = &["A"];
    const PIXEL: Pixel = Pixel::Mean;

    #[inline(always)]
    fn at<F: Lanes>(_: &FirstHit<'_, F>) -> [F; 3] {
        [F::splat(1.0), F::splat(0.0), F::splat(0.0)]
    }
}
