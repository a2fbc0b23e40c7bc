//! The engine's picture against the reference's, and against itself with other settings.

use super::{effort, film};
use rayon::prelude::*;
use scene_format::SceneDesc;
use scene_format::desc::{Caustics, Reuse};
use tracer_core::scene::Sharing;
use tracer_core::{Film, Scene};
use tracer_reference::statistics::{Estimate, sidak};
use tracer_reference::{Smoothing, render, render_moving};

/// Pixels along a tile's side.
const TILE: u32 = 8;

/// Renderings of the engine with independent seeds. Samples within one are stratified, so only whole renderings tell
/// the variance.
const SEEDS: u32 = 32;

/// Scenes that are compared in all: together they fail by chance once in a hundred.
const SCENES: usize = 168;
const FAMILY_LEVEL: f64 = 0.01;

/// Largest difference of the pictures' means, in standard errors. Of 32 renderings one mean in 190 is further off by
/// chance, so one of the scenes is in most runs: what differs is rendered once more (`Round`).
const MEANS: f64 = 3.0;

/// Means that seem to differ are looked at once more, with four times the samples and other seeds: a true difference is
/// twice as many standard errors then; one by chance is found again in one of 190 means, so in one of some 100 runs of
/// all. Tiles, whose level is that of all scenes together, have one round.
#[derive(Clone, Copy)]
struct Round {
    times: u32,
    seeds: u32,
}

const ROUNDS: [Round; 2] = [Round { times: 1, seeds: 0 }, Round { times: 4, seeds: 10_000 }];

/// How many samples per pixel.
#[derive(Clone, Copy)]
pub struct Samples {
    pub engine: u32,
    pub reference: u32,
}

/// A rectangle of pixels: left, top, right, bottom.
type Rectangle = [u32; 4];

fn pixels([left, top, right, bottom]: Rectangle) -> impl Iterator<Item = (u32, u32)> {
    (top..bottom).flat_map(move |y| (left..right).map(move |x| (x, y)))
}

fn area([left, top, right, bottom]: Rectangle) -> f64 {
    f64::from((right - left) * (bottom - top))
}

/// Renderings of one scene with independent seeds.
struct Renderings(Vec<Film>);

impl Renderings {
    /// Side by side: a long proof that comes late keeps all cores busy.
    fn new(scene: &Scene, samples: u32, first_seed: u32) -> Self {
        Renderings((first_seed..first_seed + SEEDS).into_par_iter().map(|seed| film(scene, samples, seed)).collect())
    }

    /// Mean of a channel over a rectangle. However the pixels of one rendering hang together, the renderings tell its
    /// variance.
    fn estimate(&self, rectangle: Rectangle, channel: usize) -> Estimate {
        let mean =
            |film: &Film| pixels(rectangle).map(|(x, y)| film.radiance(x, y)[channel]).sum::<f64>() / area(rectangle);
        Estimate::of(&self.0.iter().map(mean).collect::<Vec<_>>())
    }
}

/// Asserts that engine and reference agree: every tile of 8x8 pixels and channel by Welch's test, strict enough for all
/// tiles of all scenes together (Šidák), and the means of the channels within three standard errors. With all that is
/// on by default.
pub fn assert_same_picture(name: &str, desc: &SceneDesc, samples: Samples) {
    let scene = super::compiled(desc);
    in_rounds(name, |Round { times, seeds }| {
        let engine_samples = (samples.engine * effort() * times).div_ceil(SEEDS).max(1);
        let engine = Renderings::new(&scene, engine_samples, 1000 + seeds);
        let (theirs, seed) = (samples.reference * effort() * times, u64::from(7 + seeds));
        let reference = if scene.moves() {
            render_moving(&scene, theirs, seed, Smoothing::Hanika).expect("it is right at all times")
        } else {
            render(&scene, theirs, seed, Smoothing::Hanika)
        };
        let at = |(x, y): (u32, u32)| (y * scene.size[0] + x) as usize;
        let theirs = |rectangle: Rectangle, channel: usize| Estimate {
            mean: pixels(rectangle).map(|p| reference.mean[at(p)][channel]).sum::<f64>() / area(rectangle),
            variance: pixels(rectangle).map(|p| reference.variance[at(p)][channel]).sum::<f64>()
                / area(rectangle).powi(2),
            freedom: f64::INFINITY,
        };
        differences(name, scene.size, SCENES, &|r, c| engine.estimate(r, c), &theirs)
    });
}

/// Asserts by the same tests that two scenes make the same picture with so many samples each.
pub fn assert_same_scenes(name: &str, one: &SceneDesc, other: &SceneDesc, samples: u32) {
    let size = [one.image.width.value, one.image.height.value];
    in_rounds(name, |Round { times, seeds }| {
        let samples = (samples * effort() * times).div_ceil(SEEDS).max(1);
        let rendered = |desc: &SceneDesc, seed: u32| Renderings::new(&super::compiled(desc), samples, seed + seeds);
        let (ours, theirs) = (rendered(one, 6000), rendered(other, 7000));
        differences(name, size, SCENES, &|r, c| ours.estimate(r, c), &|r, c| theirs.estimate(r, c))
    });
}

/// Asserts by the same tests that pixels which share what they find, and pixels for themselves, make the same picture.
/// `scenes`: how many are compared so in all.
pub fn assert_sharing_is_unbiased(name: &str, desc: &SceneDesc, scenes: usize) {
    assert_shared_is_alone(name, desc, scenes);
}

fn assert_shared_is_alone(name: &str, desc: &SceneDesc, scenes: usize) {
    let rendered = |reuse: Reuse, samples: u32, first_seed: u32| {
        let mut desc = desc.clone();
        desc.render.caustics = Caustics::None;
        let mut scene = super::compiled(&desc);
        // Outdoors, too, where by itself the engine does not share.
        scene.reuse = if reuse == Reuse::Blocks { Sharing::Always } else { Sharing::Never };
        Renderings::new(&scene, samples * effort(), first_seed)
    };
    let size = [desc.image.width.value, desc.image.height.value];
    in_rounds(name, |Round { times, seeds }| {
        let shared = rendered(Reuse::Blocks, 24 * times, 2000 + seeds);
        let alone = rendered(Reuse::None, 64 * times, 3000 + seeds);
        differences(name, size, scenes, &|r, c| shared.estimate(r, c), &|r, c| alone.estimate(r, c))
    });
}

/// Asserts that rays which photons guide, and glint chains, change no picture: by all that is on with `render.caustics:
/// Photons`, and by paths alone, with so many samples.
pub fn assert_guiding_is_unbiased(name: &str, desc: &SceneDesc, plain: u32, scenes: usize) {
    let rendered = |caustics: Caustics, samples: u32, first_seed: u32| {
        let mut desc = desc.clone();
        desc.render.caustics = caustics;
        Renderings::new(&super::compiled(&desc), samples * effort(), first_seed)
    };
    let size = [desc.image.width.value, desc.image.height.value];
    in_rounds(name, |Round { times, seeds }| {
        let guided = rendered(Caustics::Photons, 64 * times, 4000 + seeds);
        let plain = rendered(Caustics::None, plain * times, 5000 + seeds);
        differences(name, size, scenes, &|r, c| guided.estimate(r, c), &|r, c| plain.estimate(r, c))
    });
}

/// Variance of a picture with so many samples, summed over its pixels and channels.
pub fn noise(desc: &SceneDesc, samples: u32) -> f64 {
    let renderings = Renderings::new(&super::compiled(desc), samples, 8000);
    let [width, height] = [desc.image.width.value, desc.image.height.value];
    let of_pixel = |(x, y): (u32, u32)| -> f64 {
        // The estimate's variance is that of the mean over the renderings.
        (0..3).map(|channel| renderings.estimate([x, y, x + 1, y + 1], channel).variance * f64::from(SEEDS)).sum()
    };
    pixels([0, 0, width, height]).map(of_pixel).sum()
}

/// What differs in two pictures.
struct Differences {
    tiles: Vec<String>,
    means: Vec<String>,
}

/// Asserts that no tile differs, and no mean, or none any more when it is looked at closer.
fn in_rounds(name: &str, differences: impl Fn(Round) -> Differences) {
    let mut faults = Vec::new();
    for round in ROUNDS {
        let Differences { tiles, means } = differences(round);
        assert!(tiles.is_empty(), "{name} differs:\n{}", tiles.join("\n"));
        if means.is_empty() {
            return;
        }
        println!("{name} differs with {} times the samples:\n{}", round.times, means.join("\n"));
        faults = means;
    }
    panic!("{name} differs:\n{}", faults.join("\n"));
}

/// Asserts that tiles and means of two pictures of the same scene are equal.
pub fn assert_agree(name: &str, size: [u32; 2], one: &Told<'_>, other: &Told<'_>) {
    let Differences { tiles, means } = differences(name, size, 1, one, other);
    let faults = [tiles, means].concat();
    assert!(faults.is_empty(), "{name} differs:\n{}", faults.join("\n"));
}

/// What is told of a rectangle and a channel.
type Told<'a> = dyn Fn(Rectangle, usize) -> Estimate + 'a;

/// Tiles and means that differ in two pictures of the same scene, one of `scenes`.
fn differences(name: &str, [width, height]: [u32; 2], scenes: usize, one: &Told<'_>, other: &Told<'_>) -> Differences {
    let tiles: Vec<Rectangle> = (0..height.div_ceil(TILE))
        .flat_map(|y| (0..width.div_ceil(TILE)).map(move |x| (x, y)))
        .map(|(x, y)| [x * TILE, y * TILE, width.min((x + 1) * TILE), height.min((y + 1) * TILE)])
        .collect();
    let level = sidak(sidak(FAMILY_LEVEL, scenes), 3 * tiles.len());
    let mut found = Differences { tiles: Vec::new(), means: Vec::new() };
    let mut worst = 0.0f64;
    let line = |place: String, ours: &Estimate, theirs: &Estimate, z: f64| {
        let (a, b) = (ours.mean, theirs.mean);
        format!("{place}: {a:.6} +- {:.6}, against {b:.6} +- {:.6}, z {z:.2}", ours.error(), theirs.error())
    };
    for tile in tiles {
        for channel in 0..3 {
            let (ours, theirs) = (one(tile, channel), other(tile, channel));
            let comparison = agree(&ours, &theirs);
            worst = worst.max(comparison.z.abs());
            // False for no number, too.
            let same = comparison.probability >= level;
            if !same {
                found.tiles.push(line(format!("pixels {tile:?} channel {channel}"), &ours, &theirs, comparison.z));
            }
        }
    }
    for channel in 0..3 {
        let whole = [0, 0, width, height];
        let (ours, theirs) = (one(whole, channel), other(whole, channel));
        let z = agree(&ours, &theirs).z;
        let line = line(format!("mean of channel {channel}"), &ours, &theirs, z);
        println!("{name}: {line}; worst tile z {worst:.2}");
        let same = z.abs() <= MEANS;
        if !same {
            found.means.push(line);
        }
    }
    found
}

/// Compares, allowing for the rounding of `f32` where there is no noise to hide it: a picture of 10 operations per
/// vertex and 10 vertices is right to 100 * 2^-24 = 6e-6 of its value.
fn agree(ours: &Estimate, theirs: &Estimate) -> tracer_reference::statistics::Comparison {
    let rounding = 6e-6 * theirs.mean;
    let rounded = Estimate { mean: theirs.mean, variance: theirs.variance + rounding * rounding, ..*theirs };
    ours.compare(&rounded)
}
