//! Radiance that has come over one surface at most, in W/(sr m^2): lamps and background as the camera sees them, and
//! what surfaces scatter that have it from lamps and background themselves, over no mirror or glass between.

use super::{PictureLayer, Pixel, Units};
use crate::scene::Scene;

pub(super) struct Direct;

impl PictureLayer for Direct {
    const NAME: &'static str = "direct";
    const CHANNELS: &'static [&'static str] = &["R", "G", "B"];
    const PIXEL: Pixel = Pixel::Direct;

    fn units(scene: &Scene) -> Units {
        Units { scale: scene.radiance_unit, ..Units::SAME }
    }
}
