//! The surface's colour without light: albedo, of mirrors the reflectance, of glass the transmittance. Lamps have none.

use super::{FirstHit, PictureLayer, Pixel};
use crate::engine::Bsdf;
use crate::lanes::Lanes;

pub(super) struct Albedo;

impl PictureLayer for Albedo {
    const NAME: &'static str = "albedo";
    const CHANNELS: &'static [&'static str] = &["R", "G", "B"];
    // As denoisers and compositing expect it: black where the picture shows the background, in the same share of the
    // samples.
    const PIXEL: Pixel = Pixel::Mean;

    #[inline(always)]
    fn at<F: Lanes>(hit: &FirstHit<'_, F>) -> [F; 3] {
        let color = Bsdf::at(hit.scene, hit.surface, hit.valid).color;
        [color.0, color.1, color.2]
    }
}
