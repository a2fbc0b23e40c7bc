//! Radiance that the surface itself sends to the viewer, in W/(sr m^2): lamps. The background is no surface.

use super::{FirstHit, PictureLayer, Pixel, Units};
use crate::engine::lights::{LightHit, radiance, share_at};
use crate::lanes::{Bits, Lanes, Mask};
use crate::scene::Scene;

pub(super) struct Emission;

impl PictureLayer for Emission {
    const NAME: &'static str = "emission";
    const CHANNELS: &'static [&'static str] = &["R", "G", "B"];
    const PIXEL: Pixel = Pixel::Mean;

    #[inline(always)]
    fn at<F: Lanes>(hit: &FirstHit<'_, F>) -> [F; 3] {
        let (zero, s) = (F::splat(0.0), hit.surface);
        let lamp = hit.valid & !s.light.eq(F::U::splat(0));
        if !lamp.any() {
            return [zero, zero, zero];
        }
        let light = F::U::select(lamp, s.light - F::U::splat(1), F::U::splat(0));
        let cos = hit.direction.dot(s.ng).abs();
        let met = LightHit { direction: hit.direction, distance: hit.t, cos, front: s.outside, lanes: lamp };
        let lights = &hit.scene.tables.lights;
        let mut shines = radiance(lights, light, &met);
        if lights.glow.is_some() {
            shines = shines.mul(share_at(hit.scene, s, lamp));
        }
        [F::select(lamp, shines.0, zero), F::select(lamp, shines.1, zero), F::select(lamp, shines.2, zero)]
    }

    fn units(scene: &Scene) -> Units {
        Units { scale: scene.radiance_unit, ..Units::SAME }
    }
}
