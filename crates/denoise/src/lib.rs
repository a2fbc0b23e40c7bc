//! The denoiser: two half pictures and what camera rays hit become one picture with less noise.
//!
//! Pixels are filtered by what else is like them. How much noise there is, and whether a filter makes the picture
//! better or worse, is told by two halves of the samples that know nothing of each other, and by nothing else: errors
//! that neighbours have in common (pixels that share what they find, [`Input::halves`]) do not mislead it, for what
//! is common to a half is not in the other.
//!
//! 1. *Demodulation* (`prepared`): what is not of lamps that are seen is divided by the albedo, so that textures are
//!    not there to be blurred; both come back in the end. Where halves differ by what each has met of a texture, each
//!    is divided by its own albedo.
//! 2. *Filtering* (`filter`), three times with steps of 1, 3 and 9 pixels: around each pixel a plane over position,
//!    normal, nearness and albedo is fitted to the pixels that are alike, as Bitterli et al. do (Nonlinearly Weighted
//!    First-order Regression for Denoising Monte Carlo Renderings, 2016); their weighted mean is a second candidate.
//!    Alike is what has like colours in patches around it, measured by the noise (non-local means; Rousselle, Knaus,
//!    Zwicker: Adaptive Rendering with Non-Local Means Filtering, 2012), and like features (Rousselle, Manzi,
//!    Zwicker: Robust Denoising using Feature and Color Information, 2013). A half is filtered by the weights that
//!    the other tells.
//! 3. *Choice* (`choice`): of what there was before, mean and plane, each pixel takes what has the least squared
//!    error in the squares around it, estimated by the other half.
//!
//! Where we deviate: weights are polynomials that end, not exponentials; features are not filtered before (they have no
//! halves); the plane of a pixel counts for that pixel alone; the wide steps come by repetition.
//!
//! The result is the same for any number of threads. A pixel depends on those up to [`REACH`] pixels away.

#![forbid(unsafe_code)]

mod choice;
mod filter;
mod input;
mod plane;
mod prepared;
mod solve;

pub use input::{Input, WrongSize};

use choice::Chosen;
use filter::Pass;
use prepared::Prepared;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// The passes, the finest first.
const PASSES: [Pass; 3] = [
    Pass { step: 1, reach: 4, planes: true },
    Pass { step: 3, reach: 4, planes: true },
    Pass { step: 9, reach: 4, planes: false },
];

/// A pixel depends on no other pixel farther away than this, along a row or a column: that is how far crops differ
/// from the whole.
pub const REACH: usize = {
    let (mut reach, mut k) = (prepared::REACH, 0);
    while k < PASSES.len() {
        reach += PASSES[k].step * PASSES[k].reach + filter::PATCH + choice::REACH;
        k += 1;
    }
    reach
};

/// A picture with less noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Denoised {
    /// Three numbers a pixel, linear RGB, rows from the top.
    pub pixels: Vec<f32>,
    /// What became of it.
    pub told: Told,
}

/// What denoising did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Told {
    /// Root mean square of what pixels changed by, over the root mean square of the picture before.
    pub change: f64,
    /// Root mean square error before, estimated by the halves, over the root mean square of the picture before.
    pub error_before: f64,
    /// The same afterwards: an estimate that the choice has seen, so it may be somewhat too low; not less than the
    /// noise that is left, as the halves tell it.
    pub error_after: f64,
}

/// Denoises a rendering, over the threads of rayon's current pool.
///
/// # Errors
/// When the input's pictures do not have the size that it tells.
///
/// # Examples
///
/// ```
/// use tracer_denoise::{Input, denoise};
///
/// // Noise of one in a hundred over a white wall, another in each half.
/// let hash = |half: u32, k: usize| (k as u32 * 2 + half).wrapping_mul(2_654_435_761) >> 8;
/// let noise = |half: u32, k: usize| hash(half, k) as f32 / 8_388_608.0 - 1.0;
/// let half = |half| (0..32 * 32).flat_map(|k| [1.0 + 0.01 * noise(half, k); 3]).collect::<Vec<f32>>();
/// let (pixels, one) = (32 * 32, vec![1.0; 3 * 32 * 32]);
/// let denoised = denoise(&Input {
///     width: 32,
///     height: 32,
///     halves: [&half(0), &half(1)],
///     share: 0.5,
///     lamps: &vec![0.0; 3 * pixels],
///     albedo: [&one, &one],
///     normal: &[0.0, 0.0, 1.0].repeat(pixels),
///     depth: &vec![2.0; pixels],
///     variance: &vec![1e-5; pixels],
/// })?;
/// let mean_square = denoised.pixels.iter().map(|x| (x - 1.0) * (x - 1.0)).sum::<f32>() / (3 * pixels) as f32;
/// assert!(mean_square < 1.7e-5 / 10.0);
/// # Ok::<(), tracer_denoise::WrongSize>(())
/// ```
pub fn denoise(input: &Input<'_>) -> Result<Denoised, WrongSize> {
    Ok(denoise_while(input, &|| true)?.unwrap_or_else(|| unreachable!("it goes on")))
}

/// The same, as long as it is to go on; it is asked some thousand times a second. `None` where it was not.
///
/// # Errors
/// As of [`denoise`].
pub fn denoise_while(input: &Input<'_>, goes_on: &(dyn Fn() -> bool + Sync)) -> Result<Option<Denoised>, WrongSize> {
    input.check()?;
    if input.width * input.height == 0 {
        return Ok(Some(Denoised { pixels: Vec::new(), told: Told::default() }));
    }
    // Once it was not to go on it does not, whatever is said later.
    let is_ended = AtomicBool::new(false);
    let goes_on = || {
        if !goes_on() {
            is_ended.store(true, Ordering::Relaxed);
        }
        !is_ended.load(Ordering::Relaxed)
    };
    let prepared = Prepared::new(input);
    let mut chosen = Chosen::nothing(&prepared);
    for pass in &PASSES {
        let variance = match pass.step {
            1 => prepared.variance.clone(),
            _ => prepared::variance_of(&chosen.halves, input.share),
        };
        let filtered = filter::filter(&prepared, &chosen.halves, &variance, pass, &goes_on);
        if !goes_on() {
            return Ok(None);
        }
        chosen = choice::choose(&prepared, &chosen, &filtered);
    }
    let halves = &chosen.halves;
    let mut pixels = vec![0.0; 3 * input.width * input.height];
    pixels.par_chunks_mut(3).enumerate().for_each(|(k, pixel)| {
        for (c, to) in pixel.iter_mut().enumerate() {
            let mean = input.share * halves[0][c].values[k] + (1.0 - input.share) * halves[1][c].values[k];
            let radiance = mean * prepared.albedo[c].values[k] + prepared.lamps[c].values[k];
            *to = (radiance * prepared.scale).clamp(f32::MIN, f32::MAX);
        }
    });
    let told = told(input, &prepared, &chosen, &pixels);
    Ok(Some(Denoised { pixels, told }))
}

/// What became of the picture: sums in `f64`, one after the other, so that threads cannot show.
fn told(input: &Input<'_>, prepared: &Prepared, chosen: &Chosen, pixels: &[f32]) -> Told {
    let (mut picture, mut change, mut before, mut texture) = (0.0, 0.0, 0.0, 0.0);
    let share = f64::from(input.share * (1.0 - input.share));
    for (k, &after) in pixels.iter().enumerate() {
        let mean = f64::from(input.mean(k));
        picture += mean * mean;
        change += (f64::from(after) - mean) * (f64::from(after) - mean);
        let [one, other] = input.halves.map(|half| f64::from(half[k]));
        before += share * (one - other) * (one - other);
        let [one, other] = input.albedo.map(|albedo| f64::from(albedo[k].clamp(0.0, 1.0)));
        let [light, other_light] = chosen.halves.each_ref().map(|half| f64::from(half[k % 3].values[k / 3]));
        let light = 0.5 * (light + other_light) * (one - other);
        // Of what is no number nothing is known.
        texture += if light.is_finite() { share * light * light } else { 0.0 };
    }
    if picture == 0.0 {
        return Told::default();
    }
    let sum = |plane: &plane::Plane| plane.values.iter().map(|&x| f64::from(x)).sum::<f64>();
    let unit = f64::from(prepared.scale) * f64::from(prepared.scale);
    // The estimate of the squared error may come out too low by its own noise, below zero even; that of its variance
    // cannot.
    let after = (sum(&chosen.after).max(sum(&chosen.variance)) + texture) * unit;
    let relative = |square: f64| (square.max(0.0) / picture).sqrt();
    Told { change: relative(change), error_before: relative(before), error_after: relative(after) }
}
