//! From a film to the picture that is written of it.

use super::asked::Asked;
use super::outputs;
use super::ready::Ready;
use super::rendered::Rendered;
use crate::args::DenoiseArgs;
use crate::denoising::{self, DenoiseReport, Developed};
use crate::failure::Failure;
use crate::layer_view;
use crate::shell::Shell;
use tracer_core::{Film, Image, Layer, Look};

/// A film as a picture.
pub(super) struct Picture {
    /// None where none is asked for.
    pub image: Option<Image>,
    /// What denoising did, where it was at work.
    pub denoised: Option<DenoiseReport>,
    /// It has its noise still, because a library has failed to take it out.
    pub is_noisy: bool,
    /// It has its noise still, because a signal has ended the denoising.
    pub is_ended: bool,
}

impl Picture {
    /// Develops the film, denoised if that is asked for.
    ///
    /// # Errors
    /// When the film lacks what denoising needs.
    pub fn of(asked: &mut Asked<'_>, ready: &Ready, rendered: &Rendered) -> Result<Self, Failure> {
        let (shell, denoiser) = (asked.shell, asked.denoiser.as_ref());
        let film = (&rendered.film, rendered.interrupted);
        let made = (!asked.outputs.is_empty())
            .then(|| denoising::picture(film, &ready.scene.look, ready.written_layers, denoiser, shell))
            .transpose()?;
        let is_noisy = made.as_ref().is_some_and(|made| made.is_noisy(shell));
        let is_ended = made.as_ref().is_some_and(|made| made.is_ended);
        if is_ended {
            // The picture is the one that comes without.
            asked.args.denoise = DenoiseArgs { denoise: None };
        }
        let (image, denoised) = made.map(|Developed { image, denoised, .. }| (image, denoised)).unzip();
        Ok(Picture { image, denoised: denoised.flatten(), is_noisy, is_ended })
    }

    /// As it is written: with its mattes, or a layer in its place.
    pub fn into_written(mut self, asked: &Asked<'_>, ready: &Ready, film: &Film) -> Self {
        if let Some(image) = self.image.as_mut().filter(|_| outputs::has_exr(&asked.outputs)) {
            image.mattes = ready.scene.mattes.develop(film);
        }
        if let Some(layer) = asked.args.show {
            self.image = shown(layer, film, &ready.scene.look, asked.shell);
        }
        self
    }
}

/// A layer of a film in place of its picture; what its colours stand for is said.
fn shown(layer: Layer, film: &Film, look: &Look, shell: &Shell) -> Option<Image> {
    let layer = film.layer(layer)?;
    let (image, range) = layer_view::picture(&layer, film.crop().width, look);
    if let Some([low, high]) = range.map(|range| range.map(layer_view::number)).filter(|_| shell.is_told()) {
        shell.say(&format!("{}: {low} is dark, {high} and more is bright", layer.name));
    }
    Some(image)
}
