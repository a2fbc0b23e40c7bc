//! The bright parts of a picture of all directions: a sun, a window, the lamps of a studio.
//!
//! Light samples find them, but not over mirrors and glass: behind a ball of glass or a pane what a sun brings is met
//! by rays that happen to go there. So photons and light paths are sent from these parts at the casters, as they are
//! from lights. Of what is alike all around rays by chance find as much.

use super::approach::balls;
use super::casters::Caster;
use crate::lanes::Lanes;
use crate::math::V3;
use crate::scene::{Environment, Scene};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// What is so many times as bright as the mean of all directions is bright.
const TIMES: f64 = 8.0;
/// Where less than this part of the light is from there, no photons are sent.
const LEAST_PART: f64 = 0.1;

/// What photons from the sky have to know.
pub struct Bright {
    /// Radiance from which on it is bright, the sum of the channels.
    pub least: f32,
    /// The integral of bright radiance over its directions, the sum of the channels.
    pub fluence: f64,
    /// All that has an end is within this of the middle of render space.
    pub reach: f64,
}

impl Bright {
    /// `None` where there are none.
    pub fn new(scene: &Scene) -> Option<Bright> {
        let (least, fluence) = bright_part(scene.environment()?)?;
        let reach = balls(scene)
            .into_iter()
            .map(|(center, radius)| center.length() + radius)
            .filter(|x| x.is_finite())
            .fold(0.0, f64::max);
        Some(Bright { least: least as f32, fluence, reach })
    }

    /// Whether this radiance is of these parts.
    #[inline(always)]
    pub fn has<F: Lanes>(&self, V3(red, green, blue): V3<F>) -> F::M {
        F::splat(self.least).lt(red + green + blue)
    }

    /// Middle and radius of what photons are sent at: of a plane, what the scene has beside it.
    pub fn target(&self, caster: &Caster) -> (DVec3, f64) {
        if caster.center.length() + caster.radius <= self.reach {
            (caster.center, caster.radius)
        } else {
            (DVec3::ZERO, self.reach)
        }
    }

    /// How far before the middle of that they start: before all that has an end.
    pub fn before(&self, (center, radius): (DVec3, f64)) -> f64 {
        1.01 * (self.reach + center.length() + radius)
    }
}

/// The radiance from which on a sky is bright, and the integral of what is; `None` where that is hardly any.
fn bright_part(sky: &Environment) -> Option<(f64, f64)> {
    let height = |row: usize| libm::cos(PI * row as f64 / f64::from(sky.height));
    let light = |least: f64| -> f64 {
        let of_row = |(row, texels): (usize, &[f32])| {
            let of_texels = texels.chunks_exact(3).map(|texel| texel.iter().map(|&x| f64::from(x)).sum::<f64>());
            let angle = (height(row) - height(row + 1)) * TAU / f64::from(sky.width);
            of_texels.filter(|&x| x > least).sum::<f64>() * angle
        };
        sky.texels.chunks_exact(3 * sky.width as usize).enumerate().map(of_row).sum()
    };
    let all = light(0.0);
    let least = TIMES * all / (2.0 * TAU);
    let fluence = light(least);
    (fluence > LEAST_PART * all).then_some((least, fluence))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 64 x 32 texels one at the horizon is a sun of this radiance; the others are grey.
    fn under_a_sun(radiance: f32) -> Option<(f64, f64)> {
        let mut texels = vec![[1.0f32; 3]; 64 * 32];
        texels[64 * 15 + 5] = [radiance; 3];
        bright_part(&Environment::new([64, 32], &texels, DVec3::Y, 0.0, true))
    }

    /// A texel at the horizon is 0.0096 sr of 12.57: from a radiance of 8 on it is bright, from 145 on it is a tenth of
    /// all light.
    #[test]
    fn a_sun_is_bright_and_a_grey_sky_is_not() {
        assert!(under_a_sun(1.0).is_none());
        assert!(under_a_sun(120.0).is_none());
        let (least, fluence) = under_a_sun(1000.0).expect("a sun");
        let angle = libm::cos(PI * 15.0 / 32.0) * TAU / 64.0;
        assert!((fluence / (3000.0 * angle) - 1.0).abs() < 1e-6, "{fluence}");
        let mean = 3.0 * (1.0 + 999.0 * angle / (2.0 * TAU));
        assert!((least / (TIMES * mean) - 1.0).abs() < 1e-6, "{least}");
    }
}
