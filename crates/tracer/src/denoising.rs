//! `--denoise`: what is rendered beside the picture for it, and the picture that comes of it.

use crate::args::DenoiseName;
use crate::failure::Failure;
use crate::interrupt;
use crate::shell::Shell;
use serde::Serialize;
use std::time::Instant;
use tracer_core::{DenoiseError, DenoiseTold, Denoised, Film, GUIDES, Image, LayerSet, Look, Noisy, Scene};
use tracer_core::{denoise_lacks, denoise_while, develop, develop_denoised};
use tracer_oidn::{NAMED_BY, NotFound, Oidn, Picture};

/// Bytes of a pixel that denoising takes while it is at work: measured at 1920x1080.
pub fn bytes_per_pixel(how: DenoiseName) -> u64 {
    match how {
        DenoiseName::Off => 0,
        DenoiseName::On => 400,
        DenoiseName::Oidn => 700,
    }
}

/// What denoising did.
#[derive(Clone, Debug, Serialize)]
pub struct DenoiseReport {
    /// What has done it: `tracer`, or the library's name with its version.
    pub by: String,
    /// Root mean square of what pixels changed by, relative to the root mean square of the picture.
    pub change: f64,
    /// Root mean square error before, estimated from two halves of the samples; relative to the same.
    pub error_before: f64,
    /// The same afterwards; null where a library has done it, which does not tell.
    pub error_after: Option<f64>,
    /// What it took.
    pub seconds: f64,
}

impl DenoiseReport {
    /// A line for people.
    pub fn to_text(&self) -> String {
        let seconds = self.seconds;
        match self.error_after.map(|after| self.error_before / after) {
            Some(times) if times.is_finite() && times > 1.0 => {
                format!("denoised in {seconds:.2} s: errors about {times:.1} times smaller")
            }
            Some(times) if times.is_finite() && times < 0.95 => {
                let larger = 1.0 / times;
                format!(
                    "denoised in {seconds:.2} s: errors about {larger:.1} times larger, so it is not better here: \
                     leave --denoise out"
                )
            }
            Some(times) if times.is_finite() => format!("denoised in {seconds:.2} s: errors about as large as before"),
            Some(_) => format!("denoised in {seconds:.2} s"),
            None => format!("denoised by {} in {seconds:.2} s", self.by),
        }
    }
}

/// Who takes the noise out.
#[derive(Debug)]
pub enum Denoiser {
    /// What is built in.
    BuiltIn,
    /// Open Image Denoise.
    Oidn(Box<Oidn>),
}

impl Denoiser {
    /// What was asked for, ready to work: so that nothing is rendered in vain.
    ///
    /// # Errors
    /// When there is no Open Image Denoise.
    pub fn ready(how: DenoiseName) -> Result<Option<Self>, Failure> {
        match how {
            DenoiseName::Off => Ok(None),
            DenoiseName::On => Ok(Some(Denoiser::BuiltIn)),
            DenoiseName::Oidn => match Oidn::from_environment(rayon::current_num_threads()) {
                Ok(oidn) => Ok(Some(Denoiser::Oidn(Box::new(oidn)))),
                Err(why) => Err(Failure::could_not(without_oidn(&why))),
            },
        }
    }

    /// How it is asked for.
    pub fn name(&self) -> DenoiseName {
        match self {
            Denoiser::BuiltIn => DenoiseName::On,
            Denoiser::Oidn(_) => DenoiseName::Oidn,
        }
    }

    /// A signal ends it, but not one that has ended the rendering.
    fn of_film(&self, film: &Film, rendering_ended: bool) -> Result<Denoised, Fault> {
        match self {
            Denoiser::BuiltIn => Ok(denoise_while(film, &|| rendering_ended || interrupt::requested().is_none())?),
            Denoiser::Oidn(oidn) => {
                let noisy = Noisy::of(film)?;
                let Noisy { width, height, color, albedo, normal, .. } = &noisy;
                let [width, height] = [*width, *height].map(|side| side as usize);
                let pixels = oidn.denoise(&Picture { width, height, color, albedo, normal });
                let pixels = pixels.map_err(|fault| Fault::Oidn(format!("{} has failed: {fault}", oidn.name())))?;
                Ok(noisy.denoised(pixels)?)
            }
        }
    }

    fn told(&self) -> String {
        match self {
            Denoiser::BuiltIn => "tracer".to_owned(),
            Denoiser::Oidn(oidn) => oidn.name(),
        }
    }
}

/// Why a film was not denoised.
enum Fault {
    Film(DenoiseError),
    Oidn(String),
}

impl From<DenoiseError> for Fault {
    fn from(error: DenoiseError) -> Self {
        Fault::Film(error)
    }
}

/// Why there is no Open Image Denoise, and what to do.
fn without_oidn(why: &NotFound) -> String {
    let way = match why {
        NotFound::Static => "a tracer that was built for this system's C library can".to_owned(),
        _ => format!("install Open Image Denoise 2, or have {NAMED_BY} name its library or the folder of that"),
    };
    format!("--denoise oidn: no Open Image Denoise: {why}; {way}; --denoise alone needs none")
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

/// A film as a picture.
#[derive(Debug)]
pub struct Developed {
    /// With its layers.
    pub image: Image,
    /// What denoising did, where it was at work.
    pub denoised: Option<DenoiseReport>,
    /// Why it has its noise still, where a library should have taken it out and has failed.
    pub fault: Option<String>,
    /// A signal has ended the denoising: the picture has its noise.
    pub is_ended: bool,
}

impl Developed {
    /// Says the fault, and whether there is one.
    pub fn is_noisy(&self, shell: &Shell) -> bool {
        if let Some(fault) = &self.fault {
            shell.error(&anyhow::anyhow!("the picture is not denoised: {fault}"));
        }
        self.fault.is_some()
    }
}

/// Develops a film, denoised if that is wanted, with those of its layers that are to be written; `rendering_ended`: a
/// signal has ended its rendering. One that came when all samples were under way ends the denoising.
///
/// # Errors
/// When the film lacks what denoising needs. With too few samples, and where a library fails, it is not denoised, and
/// the picture has its noise: nothing that was rendered is lost.
pub fn picture(
    (film, rendering_ended): (&Film, bool),
    look: &Look,
    written: LayerSet,
    denoiser: Option<&Denoiser>,
    shell: &Shell,
) -> Result<Developed, Failure> {
    let started = Instant::now();
    let (mut fault, mut is_ended) = (None, false);
    let denoised = match denoiser.map(|denoiser| denoiser.of_film(film, rendering_ended)).transpose() {
        Ok(denoised) => denoised,
        Err(Fault::Film(error @ DenoiseError::Samples)) => {
            shell.say(&format!("warning: the picture is not denoised: {error}"));
            None
        }
        Err(Fault::Film(DenoiseError::Ended)) => {
            shell.say("interrupted: the picture is not denoised");
            is_ended = true;
            None
        }
        Err(Fault::Film(error)) => return Err(Failure::wrong(format!("the picture cannot be denoised: {error}"))),
        Err(Fault::Oidn(error)) => {
            fault = Some(error);
            None
        }
    };
    let seconds = started.elapsed().as_secs_f64();
    let mut image = match &denoised {
        Some(denoised) => develop_denoised(film, look, denoised),
        None => develop(film, look),
    };
    let is_written = |name: &str| name == "noisy" || written.names().any(|written| written == name);
    image.layers.retain(|layer| is_written(layer.name));
    let report = denoiser.zip(denoised).map(|(denoiser, denoised)| {
        let DenoiseTold { change, error_before, error_after } = denoised.told;
        DenoiseReport { by: denoiser.told(), change, error_before, error_after, seconds }
    });
    Ok(Developed { image, denoised: report, fault, is_ended })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_has_none_is_told_what_to_do() {
        let told = without_oidn(&NotFound::Absent("lib".into()));
        let wanted = "--denoise oidn: no Open Image Denoise: TRACER_OIDN names lib, which is not there; install Open \
                      Image Denoise 2, or have TRACER_OIDN name its library or the folder of that; --denoise alone \
                      needs none";
        assert_eq!(told, wanted);
        let told = without_oidn(&NotFound::Static);
        assert!(told.contains("a static program cannot load libraries; a tracer that was built for"), "{told}");
    }

    #[test]
    fn what_a_library_does_not_tell_is_not_told() {
        let report = DenoiseReport {
            by: "Open Image Denoise 2.5.1".to_owned(),
            change: 0.031,
            error_before: 0.05,
            error_after: None,
            seconds: 0.5,
        };
        assert_eq!(report.to_text(), "denoised by Open Image Denoise 2.5.1 in 0.50 s");
        let report = DenoiseReport { error_after: Some(0.01), ..report };
        assert_eq!(report.to_text(), "denoised in 0.50 s: errors about 5.0 times smaller");
        let report = DenoiseReport { error_after: Some(0.075), ..report };
        assert_eq!(
            report.to_text(),
            "denoised in 0.50 s: errors about 1.5 times larger, so it is not better here: leave --denoise out"
        );
        let report = DenoiseReport { error_after: Some(0.051), ..report };
        assert_eq!(report.to_text(), "denoised in 0.50 s: errors about as large as before");
    }
}
