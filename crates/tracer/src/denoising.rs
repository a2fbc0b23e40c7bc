//! `--denoise`: what is rendered beside the picture for it, and the picture that comes of it.

use crate::failure::Failure;
use crate::shell::Shell;
use serde::Serialize;
use std::time::Instant;
use tracer_core::{DenoiseError, DenoiseTold, Film, GUIDES, Image, LayerSet, Look, Scene};
use tracer_core::{denoise, denoise_lacks, develop, develop_denoised};

/// Bytes of a pixel that denoising takes while it is at work.
pub const BYTES_PER_PIXEL: u64 = 400;

/// What denoising did.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct DenoiseReport {
    /// Root mean square of what pixels changed by, relative to the root mean square of the picture.
    pub change: f64,
    /// Root mean square error before, estimated from two halves of the samples; relative to the same.
    pub error_before: f64,
    /// The same afterwards.
    pub error_after: f64,
    /// What it took.
    pub seconds: f64,
}

impl DenoiseReport {
    /// A line for people.
    pub fn to_text(self) -> String {
        let [change, before, after] = [self.change, self.error_before, self.error_after].map(percent);
        format!("denoised in {:.2} s: changed by {change}, error from about {before} to {after}", self.seconds)
    }
}

/// A share as people read it: no error is told as none.
fn percent(share: f64) -> String {
    match 100.0 * share {
        0.0 => "0 %".into(),
        small if small < 0.01 => "less than 0.01 %".into(),
        percent => format!("{percent:.2} %"),
    }
}

/// These layers, and those that denoising needs.
pub fn with_guides(layers: LayerSet) -> LayerSet {
    layers.iter().chain(GUIDES).collect()
}

/// Has the scene rendered with what denoising needs, if it is wanted.
///
/// # Errors
/// When there is no sample for one of the halves.
pub fn prepare(scene: &mut Scene, is_on: bool) -> Result<(), Failure> {
    if is_on && scene.samples < 2 {
        return Err(Failure::wrong("--denoise needs two samples per pixel at least, one for each half; --samples 16"));
    }
    if is_on {
        scene.layers = with_guides(scene.layers);
    }
    Ok(())
}

/// Sees that a film with halves or not and these layers can be denoised.
///
/// # Errors
/// When it cannot be.
pub fn check(has_halves: bool, layers: impl Iterator<Item = impl AsRef<str>>) -> Result<(), Failure> {
    let layers = layers.filter_map(|name| LayerSet::by_name(name.as_ref())).collect();
    let missing = denoise_lacks(has_halves, layers);
    if missing.is_empty() {
        return Ok(());
    }
    Err(Failure::wrong(format!(
        "--denoise needs what these parts do not hold ({}); render them with --denoise, too",
        missing.join(", ")
    )))
}

/// Develops a film, denoised if that is wanted, with those of its layers that are to be written.
///
/// # Errors
/// When the film lacks what denoising needs. With too few samples it is not denoised, which is said.
pub fn picture(
    film: &Film,
    look: &Look,
    written: LayerSet,
    is_on: bool,
    shell: &Shell,
) -> Result<(Image, Option<DenoiseReport>), Failure> {
    let started = Instant::now();
    let denoised = match is_on.then(|| denoise(film)).transpose() {
        Ok(denoised) => denoised,
        Err(error @ DenoiseError::Samples) => {
            shell.say(&format!("warning: the picture is not denoised: {error}"));
            None
        }
        Err(error) => return Err(Failure::wrong(format!("the picture cannot be denoised: {error}"))),
    };
    let seconds = started.elapsed().as_secs_f64();
    let mut image = match &denoised {
        Some(denoised) => develop_denoised(film, look, denoised),
        None => develop(film, look),
    };
    let is_written = |name: &str| name == "noisy" || written.names().any(|written| written == name);
    image.layers.retain(|layer| is_written(layer.name));
    let report = denoised.map(|denoised| {
        let DenoiseTold { change, error_before, error_after } = denoised.told;
        DenoiseReport { change, error_before, error_after, seconds }
    });
    Ok((image, report))
}
