//! Denoising a film: the halves of its samples and what its camera rays have hit first, for [`tracer_denoise`].

use crate::film::{Crop, Film};
use rayon::prelude::*;
use tracer_denoise::{Input, denoise_while as filtered};
use tracer_kernels::layers::{Layer, LayerSet};

/// The layers that guide it; the film needs them, beside halves ([`crate::RenderOptions::halves`]).
pub const GUIDES: [Layer; 4] = [Layer::DenoisingAlbedo, Layer::DenoisingNormal, Layer::Depth, Layer::Emission];

/// Pixels that a crop's border may differ by from the same pixels of the whole, which has others beside them.
pub const DENOISE_REACH: u32 = tracer_denoise::REACH as u32;

/// What denoising made of a film.
#[derive(Clone, Debug, PartialEq)]
pub struct Denoised {
    /// Radiance of the pixels that the film holds, linear RGB, rows from the top: as [`Film::radiance`] gives it, less
    /// the background where the film keeps that by itself ([`Film::has_backdrop`]).
    pub radiance: Vec<f32>,
    /// What was changed, and how large errors were and are.
    pub told: DenoiseTold,
}

/// What denoising did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DenoiseTold {
    /// Root mean square of what pixels changed by, over the root mean square of the picture before.
    pub change: f64,
    /// Root mean square error before, estimated by the halves, over the root mean square of the picture before.
    pub error_before: f64,
    /// The same afterwards, as [`tracer_denoise::Told`] has it; where another denoiser was at work nobody knows.
    pub error_after: Option<f64>,
}

/// Why a film cannot be denoised.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DenoiseError {
    /// It was rendered without what denoising needs.
    #[error("it was rendered without what denoising needs ({0})")]
    Lacks(String),
    /// A pixel has samples, and none of one of the halves.
    #[error("denoising needs two samples per pixel at least, one for each half")]
    Samples,
    /// It was not to go on ([`denoise_while`]).
    #[error("denoising was ended early")]
    Ended,
    /// What another denoiser gives back has another number of pixels.
    #[error("what the denoiser gives back has another number of pixels")]
    Size,
}

/// Denoises a film, over the threads of rayon's current pool; the same for any number of them.
///
/// # Errors
/// When the film does not hold two halves and the layers [`GUIDES`], or a pixel has samples of one of the halves only.
///
/// # Examples
///
/// ```
/// use std::path::Path;
/// use tracer_core::{GUIDES, RenderOptions, Unobserved, compile, denoise, develop_denoised, render};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let text = "Scene(image: Image(width: 24, height: 16), \
///             lights: [SphereLight(center: (2, 3, 4), radius: 1, power: 500)], \
///             objects: [Sphere(center: (0, 0, 0), radius: 1)])";
/// let loaded = scene_format::load_str("ball.ron", text, scene_format::Syntax::Ron, Path::new("."), &[])?;
/// let scene = compile(&loaded.scene)?;
/// let layers = Some(GUIDES.into_iter().collect());
/// let options = RenderOptions { samples: Some(4), halves: true, layers, ..RenderOptions::default() };
/// let film = render(&scene, &options, &Unobserved);
/// let denoised = denoise(&film)?;
/// let image = develop_denoised(&film, &scene.look, &denoised);
/// assert_eq!((image.linear.len(), image.layers.last().map(|layer| layer.name)), (3 * 24 * 16, Some("noisy")));
/// # Ok(())
/// # }
/// ```
pub fn denoise(film: &Film) -> Result<Denoised, DenoiseError> {
    denoise_while(film, &|| true)
}

/// The same, as long as it is to go on; it is asked some thousand times a second.
///
/// # Errors
/// As of [`denoise`]; when it was not to go on.
pub fn denoise_while(film: &Film, goes_on: &(dyn Fn() -> bool + Sync)) -> Result<Denoised, DenoiseError> {
    let Halves { pictures, share } = Halves::of(film)?;
    let Crop { width, height, .. } = film.crop();
    let (pixels, at) = (width as usize * height as usize, places(film));
    let lamps = |(x, y): (u32, u32)| {
        let (lamps, [first, second]) = (film.lamps_of_halves(x, y), film.samples_of_halves(x, y).map(f64::from));
        let behind = if film.has_backdrop() { film.background(x, y) } else { [0.0; 3] };
        // Never less than none, but for rounding.
        let seen = |c: usize| (lamps[0][c] * first + lamps[1][c] * second) / (first + second).max(1.0) - behind[c];
        [0, 1, 2].map(|c| finite(seen(c).max(0.0)))
    };
    let lamps: Vec<f32> = (0..pixels).flat_map(|k| lamps(at(k))).collect();
    let variance: Vec<f32> = (0..pixels).into_par_iter().map(|k| finite(film.variance(at(k).0, at(k).1))).collect();
    // All of them are there: else the film would lack them.
    let layer = |layer| film.layer(layer).map(|image| image.values).unwrap_or_default();
    let [normal, depth] = [Layer::DenoisingNormal, Layer::Depth].map(layer);
    let albedos: Vec<[[f64; 3]; 2]> =
        (0..pixels).into_par_iter().map(|k| film.albedo_of_halves(at(k).0, at(k).1)).collect();
    let albedo = [0, 1].map(|half| albedos.iter().flat_map(|of| of[half].map(finite)).collect::<Vec<f32>>());
    let input = Input {
        width: width as usize,
        height: height as usize,
        halves: [&pictures[0], &pictures[1]],
        share: share as f32,
        lamps: &lamps,
        albedo: [&albedo[0], &albedo[1]],
        normal: &normal,
        depth: &depth,
        variance: &variance,
    };
    let denoised = filtered(&input, goes_on).unwrap_or_else(|wrong| unreachable!("the pictures of one film: {wrong}"));
    let tracer_denoise::Denoised { pixels, told } = denoised.ok_or(DenoiseError::Ended)?;
    let tracer_denoise::Told { change, error_before, error_after } = told;
    Ok(Denoised { radiance: pixels, told: DenoiseTold { change, error_before, error_after: Some(error_after) } })
}

/// The place of each pixel that a film holds, by its number.
fn places(film: &Film) -> impl Fn(usize) -> (u32, u32) + Sync + use<> {
    let Crop { x: left, y: top, width, .. } = film.crop();
    let width = width.max(1) as usize;
    move |k| (left + (k % width) as u32, top + (k / width) as u32)
}

/// Two halves of a film's samples.
struct Halves {
    /// Linear RGB, without what is seen of lamps.
    pictures: [Vec<f32>; 2],
    /// How many of the samples are of the first.
    share: f64,
}

impl Halves {
    fn of(film: &Film) -> Result<Self, DenoiseError> {
        let missing: Vec<&str> = lacks(film.has_halves(), film.layers());
        if !missing.is_empty() {
            return Err(DenoiseError::Lacks(missing.join(", ")));
        }
        let Crop { width, height, .. } = film.crop();
        let (pixels, at) = (width as usize * height as usize, places(film));
        let of_pixel = |(x, y): (u32, u32)| {
            // What parts were missing for is black.
            if film.samples_of_halves(x, y) == [0, 0] && film.has_gaps() {
                return Some([[0.0; 3]; 2]);
            }
            let (radiance, lamps) = (film.radiance_of_halves(x, y)?, film.lamps_of_halves(x, y));
            Some([0, 1].map(|half| [0, 1, 2].map(|c| radiance[half][c] - lamps[half][c])))
        };
        let halves: Option<Vec<[[f64; 3]; 2]>> = (0..pixels).into_par_iter().map(|k| of_pixel(at(k))).collect();
        let halves = halves.ok_or(DenoiseError::Samples)?;
        let counts = (0..pixels).map(|k| film.samples_of_halves(at(k).0, at(k).1).map(f64::from));
        let [first, second] = counts.fold([0.0; 2], |sum, [one, two]| [sum[0] + one, sum[1] + two]);
        let picture = |half: usize| -> Vec<f32> { halves.iter().flat_map(|of| of[half].map(finite)).collect() };
        let share = if pixels == 0 { 0.5 } else { first / (first + second) };
        Ok(Halves { pictures: [picture(0), picture(1)], share })
    }
}

/// A film as other denoisers want it.
///
/// # Examples
///
/// ```
/// use std::path::Path;
/// use tracer_core::{GUIDES, Noisy, RenderOptions, Unobserved, compile, render};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let text = "Scene(image: Image(width: 24, height: 16), \
///             lights: [SphereLight(center: (2, 3, 4), radius: 1, power: 500)], \
///             objects: [Sphere(center: (0, 0, 0), radius: 1)])";
/// let loaded = scene_format::load_str("ball.ron", text, scene_format::Syntax::Ron, Path::new("."), &[])?;
/// let layers = Some(GUIDES.into_iter().collect());
/// let options = RenderOptions { samples: Some(4), halves: true, layers, ..RenderOptions::default() };
/// let film = render(&compile(&loaded.scene)?, &options, &Unobserved);
/// let noisy = Noisy::of(&film)?;
/// let darker = noisy.color.iter().map(|x| 0.9 * x).collect();
/// let told = noisy.denoised(darker)?.told;
/// assert!((told.change - 0.1).abs() < 1e-6 && told.error_before > 0.0 && told.error_after.is_none());
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Noisy {
    /// Pixels across, of what the film holds.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Radiance, linear RGB, rows from the top, not below zero; less the background where the film keeps that by itself
    /// ([`Film::has_backdrop`]).
    pub color: Vec<f32>,
    /// The layer `denoising_albedo`.
    pub albedo: Vec<f32>,
    /// The layer `denoising_normal`.
    pub normal: Vec<f32>,
    /// Mean square error of the colour, estimated by the halves.
    error: f64,
}

impl Noisy {
    /// Of a film that [`denoise`] could denoise, too.
    ///
    /// # Errors
    /// As of [`denoise`].
    pub fn of(film: &Film) -> Result<Self, DenoiseError> {
        let Halves { pictures: [first, second], share } = Halves::of(film)?;
        let square = |x: f64| x * x;
        let differences = first.iter().zip(&second).map(|(a, b)| square(f64::from(*a) - f64::from(*b)));
        let error = share * (1.0 - share) * differences.sum::<f64>() / first.len().max(1) as f64;
        let Crop { width, height, .. } = film.crop();
        let at = places(film);
        let pixel = |k: usize| {
            let (x, y) = at(k);
            let behind = if film.has_backdrop() { film.background(x, y) } else { [0.0; 3] };
            let radiance = film.radiance(x, y);
            // Never less than none, but for rounding.
            [0, 1, 2].map(|c| finite((radiance[c] - behind[c]).max(0.0)))
        };
        let pixels = (0..width as usize * height as usize).into_par_iter();
        let color: Vec<f32> = pixels.flat_map_iter(pixel).collect();
        let [albedo, normal] = [Layer::DenoisingAlbedo, Layer::DenoisingNormal]
            .map(|layer| film.layer(layer).map(|image| image.values).unwrap_or_default());
        Ok(Noisy { width, height, color, albedo, normal, error })
    }

    /// With these pixels in place of its own. One that is no number stays as it was.
    ///
    /// # Errors
    /// When there are more or fewer of them.
    pub fn denoised(&self, mut pixels: Vec<f32>) -> Result<Denoised, DenoiseError> {
        if pixels.len() != self.color.len() {
            return Err(DenoiseError::Size);
        }
        let square = |x: f64| x * x;
        let (mut picture, mut change) = (0.0, 0.0);
        for (after, &before) in pixels.iter_mut().zip(&self.color) {
            if !after.is_finite() {
                *after = before;
            }
            picture += square(f64::from(before));
            change += square(f64::from(*after) - f64::from(before));
        }
        let relative = |square: f64| if picture > 0.0 { (square / picture).sqrt() } else { 0.0 };
        let error_before = relative(self.error * pixels.len() as f64);
        let told = DenoiseTold { change: relative(change), error_before, error_after: None };
        Ok(Denoised { radiance: pixels, told })
    }
}

/// What a film with halves or not and these layers lacks to be denoised: names of layers, and `halves`.
pub fn lacks(has_halves: bool, layers: LayerSet) -> Vec<&'static str> {
    let layers: Vec<&str> = layers.names().collect();
    let guides: LayerSet = GUIDES.into_iter().collect();
    let missing = guides.names().filter(|name| !layers.contains(name));
    missing.chain((!has_halves).then_some("halves")).collect()
}

/// In single precision; what is beyond its range is its largest number.
fn finite(x: f64) -> f32 {
    x.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}
