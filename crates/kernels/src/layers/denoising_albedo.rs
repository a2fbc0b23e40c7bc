//! The colour without light of what is seen, over mirrors and through glass: their tints times the albedo of what they
//! show. One for what lies beyond all surfaces, and for lamps in mirrors and behind glass: what they send is divided by
//! nothing. Lamps that the camera sees straight have none, as in `albedo`: denoisers leave them out.

use super::{PictureLayer, Pixel, Seen};
use crate::lanes::Lanes;
use crate::math::V3;

pub(super) struct DenoisingAlbedo;

impl PictureLayer for DenoisingAlbedo {
    const NAME: &'static str = "denoising_albedo";
    const CHANNELS: &'static [&'static str] = &["R", "G", "B"];
    const PIXEL: Pixel = Pixel::Seen;

    #[inline(always)]
    fn seen<F: Lanes>(of: &Seen<F>) -> [F; 3] {
        let white = if of.straight { of.beyond } else { of.beyond | of.lamps };
        let color = V3::select(white, V3::grey(F::splat(1.0)), V3::select(of.surfaces, of.color, V3::zero()));
        let V3(red, green, blue) = of.weight.mul(color);
        [red, green, blue]
    }
}
