//! The shading normal of what is seen, over mirrors and through glass, unit, in the scene's axes, by the share of the
//! light that comes from there. Zero for what lies beyond all surfaces.

use super::{PictureLayer, Pixel, Seen};
use crate::lanes::Lanes;
use crate::math::V3;

pub(super) struct DenoisingNormal;

impl PictureLayer for DenoisingNormal {
    const NAME: &'static str = "denoising_normal";
    const CHANNELS: &'static [&'static str] = &["X", "Y", "Z"];
    const PIXEL: Pixel = Pixel::Seen;

    #[inline(always)]
    fn seen<F: Lanes>(of: &Seen<F>) -> [F; 3] {
        let (zero, meets) = (F::splat(0.0), of.surfaces | of.lamps);
        let (share, V3(x, y, z)) = (of.share(), of.normal);
        // The normals of other lanes may be no numbers.
        [F::select(meets, share * x, zero), F::select(meets, share * y, zero), F::select(meets, share * z, zero)]
    }
}
