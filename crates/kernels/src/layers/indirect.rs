//! Radiance that has come over two surfaces and more, in W/(sr m^2): the picture without [`super::direct`].

use super::{PictureLayer, Pixel, Units};
use crate::scene::Scene;

pub(super) struct Indirect;

impl PictureLayer for Indirect {
    const NAME: &'static str = "indirect";
    const CHANNELS: &'static [&'static str] = &["R", "G", "B"];
    const PIXEL: Pixel = Pixel::Indirect;

    fn units(scene: &Scene) -> Units {
        Units { scale: scene.radiance_unit, ..Units::SAME }
    }
}
