//! What is denoised, and what is known of it.

use std::fmt;

/// A rendering. The numbers of a pixel stand together, rows from the top.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Means of two halves of each pixel's samples, linear RGB, without what is seen of lamps themselves: of one
    /// expectation, and independent of each other.
    pub halves: [&'a [f32]; 2],
    /// How many of the samples are the first half's, from 0 to 1, neither included: the picture is the first half times
    /// this and the second times the rest.
    pub share: f32,
    /// What is seen of lamps themselves, straight or in mirrors and through glass, linear RGB, in the halves' unit, as
    /// a mean over all their samples. There is no noise of light in it, only that of coverage, so it is left as it is.
    pub lamps: &'a [f32],
    /// Colour without light, textures included, in 0..=1, as either half has met it; one where nothing is hit, as what
    /// is behind everything has no texture, and zero where that is not part of the picture.
    pub albedo: [&'a [f32]; 2],
    /// Shading normal; shorter than one where samples differ, zero where nothing is hit.
    pub normal: &'a [f32],
    /// Distance along the view axis, above zero; infinite where nothing is hit.
    pub depth: &'a [f32],
    /// Estimated variance of a pixel's mean luminance, were its samples independent. Only its shape counts: how large
    /// it is the halves tell.
    pub variance: &'a [f32],
}

/// A picture of the input does not have the size that it tells, or a half has no share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WrongSize(
    /// What is wrong.
    pub &'static str,
);

impl fmt::Display for WrongSize {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "what is to be denoised has the wrong {}", self.0)
    }
}

impl std::error::Error for WrongSize {}

impl Input<'_> {
    pub(crate) fn check(&self) -> Result<(), WrongSize> {
        let pixels = self.width.checked_mul(self.height).filter(|&pixels| pixels <= usize::MAX / 64);
        let pixels = pixels.ok_or(WrongSize("size"))?;
        let [one, other] = self.halves;
        let three = [one, other, self.lamps, self.albedo[0], self.albedo[1], self.normal];
        let right = three.iter().all(|picture| picture.len() == 3 * pixels)
            && self.depth.len() == pixels
            && self.variance.len() == pixels;
        if !right {
            return Err(WrongSize("number of pixels"));
        }
        if self.share > 0.0 && self.share < 1.0 { Ok(()) } else { Err(WrongSize("share of the halves")) }
    }

    /// A number of the picture that is denoised.
    pub(crate) fn mean(&self, k: usize) -> f32 {
        self.share * self.halves[0][k] + (1.0 - self.share) * self.halves[1][k] + self.lamps[k]
    }
}
