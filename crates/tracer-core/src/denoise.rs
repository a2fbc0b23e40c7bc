//! Denoising a film: the halves of its samples and what its camera rays have hit first, for [`tracer_denoise`].

use crate::film::{Crop, Film};
use rayon::prelude::*;
use tracer_denoise::{Input, denoise as filtered};
use tracer_kernels::layers::{Layer, LayerSet};

/// The layers that guide it; the film needs them, beside halves ([`crate::RenderOptions::halves`]).
pub const GUIDES: [Layer; 4] = [Layer::Albedo, Layer::Normal, Layer::Depth, Layer::Emission];

/// Pixels that a crop's border may differ by from the same pixels of the whole, which has others beside them.
pub const DENOISE_REACH: u32 = tracer_denoise::REACH as u32;

/// What denoising made of a film.
#[derive(Clone, Debug, PartialEq)]
pub struct Denoised {
    /// Radiance of the pixels that the film holds, linear RGB, rows from the top: as [`Film::radiance`] gives it, less
    /// the background where the film keeps that by itself ([`Film::has_backdrop`]).
    pub radiance: Vec<f32>,
    /// What was changed, and how large errors were and are.
    pub told: tracer_denoise::Told,
}

/// Why a film cannot be denoised.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DenoiseError {
    /// It was rendered without what denoising needs.
    #[error("it was rendered without what denoising needs ({0})")]
    Lacks(String),
    /// A pixel has no sample of one of the halves.
    #[error("denoising needs two samples per pixel at least, one for each half")]
    Samples,
}

/// Denoises a film, over the threads of rayon's current pool; the same for any number of them.
///
/// # Errors
/// When the film does not hold two halves and the layers [`GUIDES`], or a pixel has no sample of one of the halves.
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
    let missing: Vec<&str> = lacks(film.has_halves(), film.layers());
    if !missing.is_empty() {
        return Err(DenoiseError::Lacks(missing.join(", ")));
    }
    let Crop { x: left, y: top, width, height } = film.crop();
    let pixels = width as usize * height as usize;
    let at = |k: usize| (left + (k % width.max(1) as usize) as u32, top + (k / width.max(1) as usize) as u32);
    let of_pixel = |(x, y): (u32, u32)| {
        let (radiance, lamps) = (film.radiance_of_halves(x, y)?, film.lamps_of_halves(x, y));
        Some([0, 1].map(|half| [0, 1, 2].map(|c| radiance[half][c] - lamps[half][c])))
    };
    let halves: Option<Vec<[[f64; 3]; 2]>> = (0..pixels).into_par_iter().map(|k| of_pixel(at(k))).collect();
    let halves = halves.ok_or(DenoiseError::Samples)?;
    let counts = (0..pixels).map(|k| film.samples_of_halves(at(k).0, at(k).1).map(f64::from));
    let [first, second] = counts.fold([0.0; 2], |sum, [one, two]| [sum[0] + one, sum[1] + two]);
    let picture = |half: usize| -> Vec<f32> { halves.iter().flat_map(|of| of[half].map(finite)).collect() };
    let lamps = |(x, y): (u32, u32)| {
        let (lamps, [first, second]) = (film.lamps_of_halves(x, y), film.samples_of_halves(x, y).map(f64::from));
        let behind = if film.has_backdrop() { film.background(x, y) } else { [0.0; 3] };
        // Never less than none, but for rounding.
        let seen = |c: usize| (lamps[0][c] * first + lamps[1][c] * second) / (first + second) - behind[c];
        [0, 1, 2].map(|c| finite(seen(c).max(0.0)))
    };
    let lamps: Vec<f32> = (0..pixels).flat_map(|k| lamps(at(k))).collect();
    let variance: Vec<f32> = (0..pixels).into_par_iter().map(|k| finite(film.variance(at(k).0, at(k).1))).collect();
    // All of them are there: else the film would lack them.
    let layer = |layer| film.layer(layer).map(|image| image.values).unwrap_or_default();
    let [albedo, normal, depth] = [Layer::Albedo, Layer::Normal, Layer::Depth].map(layer);
    let denoised = filtered(&Input {
        width: width as usize,
        height: height as usize,
        halves: [&picture(0), &picture(1)],
        share: if pixels == 0 { 0.5 } else { (first / (first + second)) as f32 },
        lamps: &lamps,
        albedo: &albedo,
        normal: &normal,
        depth: &depth,
        variance: &variance,
    });
    let tracer_denoise::Denoised { pixels, told } =
        denoised.unwrap_or_else(|wrong| unreachable!("the pictures of one film: {wrong}"));
    Ok(Denoised { radiance: pixels, told })
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
