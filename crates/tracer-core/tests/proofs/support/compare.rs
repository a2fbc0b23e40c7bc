//! The engine's picture against the reference's.

use super::{effort, film};
use scene_format::SceneDesc;
use tracer_core::Film;
use tracer_reference::statistics::{Estimate, sidak};
use tracer_reference::{Smoothing, render};

/// Pixels along a tile's side.
const TILE: u32 = 8;

/// Renderings of the engine with independent seeds. Samples within one are stratified, so only whole renderings tell the variance.
const SEEDS: u32 = 32;

/// Scenes that are compared in all: together they fail by chance once in a hundred.
const SCENES: usize = 54;
const FAMILY_LEVEL: f64 = 0.01;

/// Largest difference of the pictures' means, in standard errors.
const MEANS: f64 = 3.0;

/// How many samples per pixel.
#[derive(Clone, Copy)]
pub struct Samples {
    pub engine: u32,
    pub reference: u32,
}

/// Asserts that engine and reference agree: every tile of 8x8 pixels and channel by Welch's test, strict enough for all tiles of all
/// scenes together (Šidák), and the means of the channels within three standard errors.
pub fn assert_same_picture(name: &str, desc: &SceneDesc, samples: Samples) {
    let scene = super::compiled(desc);
    let [width, height] = scene.size;
    let engine_samples = (samples.engine * effort()).div_ceil(SEEDS).max(1);
    let films: Vec<Film> = (0..SEEDS).map(|seed| film(&scene, engine_samples, 1000 + seed)).collect();
    let reference = render(&scene, samples.reference * effort(), 7, Smoothing::Hanika);

    let estimates = |x0: u32, y0: u32, x1: u32, y1: u32, channel: usize| {
        let count = f64::from((x1 - x0) * (y1 - y0));
        let pixels = || (y0..y1).flat_map(move |y| (x0..x1).map(move |x| (x, y)));
        let means: Vec<f64> =
            films.iter().map(|f| pixels().map(|(x, y)| f.radiance(x, y)[channel]).sum::<f64>() / count).collect();
        let at = |(x, y): (u32, u32)| (y * width + x) as usize;
        let theirs = Estimate {
            mean: pixels().map(|p| reference.mean[at(p)][channel]).sum::<f64>() / count,
            variance: pixels().map(|p| reference.variance[at(p)][channel]).sum::<f64>() / (count * count),
            freedom: f64::INFINITY,
        };
        (Estimate::of(&means), theirs)
    };
    let tiles: Vec<(u32, u32)> =
        (0..height.div_ceil(TILE)).flat_map(|y| (0..width.div_ceil(TILE)).map(move |x| (x, y))).collect();
    let level = sidak(sidak(FAMILY_LEVEL, SCENES), 3 * tiles.len());
    let mut faults = Vec::new();
    let mut worst = 0.0f64;
    for &(x, y) in &tiles {
        for channel in 0..3 {
            let (ours, theirs) =
                estimates(x * TILE, y * TILE, width.min((x + 1) * TILE), height.min((y + 1) * TILE), channel);
            let comparison = agree(&ours, &theirs);
            worst = worst.max(comparison.z.abs());
            // False for no number, too.
            let same = comparison.probability >= level;
            if !same {
                faults.push(format!(
                    "tile ({x}, {y}) channel {channel}: engine {:.6} +- {:.6}, reference {:.6} +- {:.6}, z {:.2}",
                    ours.mean,
                    ours.error(),
                    theirs.mean,
                    theirs.error(),
                    comparison.z
                ));
            }
        }
    }
    for channel in 0..3 {
        let (ours, theirs) = estimates(0, 0, width, height, channel);
        let z = agree(&ours, &theirs).z;
        let line = format!(
            "mean of channel {channel}: engine {:.6} +- {:.6}, reference {:.6} +- {:.6}, z {z:.2}",
            ours.mean,
            ours.error(),
            theirs.mean,
            theirs.error()
        );
        println!("{name}: {line}; worst tile z {worst:.2}");
        let same = z.abs() <= MEANS;
        if !same {
            faults.push(line);
        }
    }
    assert!(faults.is_empty(), "{name} differs from the reference:\n{}", faults.join("\n"));
}

/// Compares, allowing for the rounding of `f32` where there is no noise to hide it: a picture of 10 operations per vertex and 10
/// vertices is right to 100 * 2^-24 = 6e-6 of its value.
fn agree(ours: &Estimate, theirs: &Estimate) -> tracer_reference::statistics::Comparison {
    let rounding = 6e-6 * theirs.mean;
    let rounded = Estimate { mean: theirs.mean, variance: theirs.variance + rounding * rounding, ..*theirs };
    ours.compare(&rounded)
}
