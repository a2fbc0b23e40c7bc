//! The background: black, a colour, or a picture of all directions.

use super::assets::Sources;
use crate::texture::Panorama;
use glam::DVec3;
use scene_format::desc::{self, Background};
use scene_format::{Diagnostic, Diagnostics, SceneDesc};
use tracer_kernels::scene::Environment;

/// The background with its picture loaded.
pub(super) enum Loaded<'d> {
    /// W/(sr m^2).
    Color([f64; 3]),
    /// A picture, and what it is laid by.
    Environment(&'d desc::Environment, Panorama),
}

/// Loads it. Where that fails it is black.
pub(super) fn load<'d>(desc: &'d SceneDesc, sources: &Sources<'_>, diagnostics: &mut Diagnostics) -> Loaded<'d> {
    let environment = match &desc.background {
        Background::Color(color) => return Loaded::Color(*color),
        Background::Environment(environment) => environment,
    };
    let span = environment.file.span;
    match sources.environment(&desc.base_dir.join(&environment.file.value)) {
        Ok(mut picture) => {
            diagnostics.extend(picture.warnings.drain(..).map(|warning| Diagnostic { span, ..warning }));
            Loaded::Environment(environment, picture)
        }
        Err(error) => {
            diagnostics.push(error.to_environment_diagnostic(span));
            Loaded::Color([0.0; 3])
        }
    }
}

impl Loaded<'_> {
    /// Per channel the most that comes from any direction, in W/(sr m^2).
    pub fn brightest(&self) -> [f64; 3] {
        match self {
            Loaded::Color(color) => *color,
            Loaded::Environment(environment, picture) => {
                let most =
                    picture.texels.iter().fold([0f32; 3], |most, texel| [0, 1, 2].map(|c| most[c].max(texel[c])));
                [0, 1, 2].map(|c| f64::from(most[c]) * environment.scale[c])
            }
        }
    }

    /// Colour and picture for the engine, in a unit of radiance.
    pub fn build(self, unit: f64) -> ([f32; 3], Option<Environment>) {
        match self {
            Loaded::Color(color) => (color.map(|x| (x / unit) as f32), None),
            Loaded::Environment(environment, mut picture) => {
                let scale = environment.scale.map(|x| x / unit);
                for texel in &mut picture.texels {
                    *texel = [0, 1, 2].map(|c| (f64::from(texel[c]) * scale[c]) as f32);
                }
                let desc::Environment { up, rotation, camera_visible, .. } = environment;
                let up = DVec3::from(up.value);
                ([0.0; 3], Some(Environment::new(picture.size, &picture.texels, up, *rotation, *camera_visible)))
            }
        }
    }
}
