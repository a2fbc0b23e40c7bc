//! The engine's picture against the reference's, and against itself with other settings.

use super::{effort, film};
use scene_format::SceneDesc;
use scene_format::desc::{Caustics, Indirect, Reuse};
use tracer_core::scene::Sharing;
use tracer_core::{Film, Scene};
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
    fn new(scene: &Scene, samples: u32, first_seed: u32) -> Self {
        Renderings((first_seed..first_seed + SEEDS).map(|seed| film(scene, samples, seed)).collect())
    }

    /// Mean of a channel over a rectangle. However the pixels of one rendering hang together, the renderings tell its variance.
    fn estimate(&self, rectangle: Rectangle, channel: usize) -> Estimate {
        let mean =
            |film: &Film| pixels(rectangle).map(|(x, y)| film.radiance(x, y)[channel]).sum::<f64>() / area(rectangle);
        Estimate::of(&self.0.iter().map(mean).collect::<Vec<_>>())
    }
}

/// Asserts that engine and reference agree: every tile of 8x8 pixels and channel by Welch's test, strict enough for all tiles of all
/// scenes together (Šidák), and the means of the channels within three standard errors. Without photons and the indirect map, which are
/// right in the limit only: they have tests of their own ([`assert_photons_are_consistent`], [`assert_map_is_consistent`]).
pub fn assert_same_picture(name: &str, desc: &SceneDesc, samples: Samples) {
    let mut desc = desc.clone();
    (desc.render.caustics, desc.render.indirect) = (Caustics::None, Indirect::Paths);
    let scene = super::compiled(&desc);
    let engine_samples = (samples.engine * effort()).div_ceil(SEEDS).max(1);
    let engine = Renderings::new(&scene, engine_samples, 1000);
    let reference = render(&scene, samples.reference * effort(), 7, Smoothing::Hanika);
    let at = |(x, y): (u32, u32)| (y * scene.size[0] + x) as usize;
    let theirs = |rectangle: Rectangle, channel: usize| Estimate {
        mean: pixels(rectangle).map(|p| reference.mean[at(p)][channel]).sum::<f64>() / area(rectangle),
        variance: pixels(rectangle).map(|p| reference.variance[at(p)][channel]).sum::<f64>() / area(rectangle).powi(2),
        freedom: f64::INFINITY,
    };
    assert_agree(name, scene.size, SCENES, &|r, c| engine.estimate(r, c), &theirs);
}

/// Asserts by the same tests that pixels which share what they find, and pixels for themselves, make the same picture; enough samples
/// that both shapes of items occur (see `engine::batch`). `scenes`: how many are compared so in all.
pub fn assert_sharing_is_unbiased(name: &str, desc: &SceneDesc, scenes: usize) {
    assert_shared_is_alone(name, desc, Caustics::None, scenes);
}

/// The same with photons on both sides, where pixels that share also aim rays at casters. Both have the same photons on average, so what
/// these blur drops out.
pub fn assert_aiming_is_unbiased(name: &str, desc: &SceneDesc, scenes: usize) {
    assert_shared_is_alone(name, desc, Caustics::Photons, scenes);
}

fn assert_shared_is_alone(name: &str, desc: &SceneDesc, caustics: Caustics, scenes: usize) {
    let rendered = |reuse: Reuse, samples: u32, first_seed: u32| {
        let mut desc = desc.clone();
        (desc.render.caustics, desc.render.indirect) = (caustics, Indirect::Paths);
        let mut scene = super::compiled(&desc);
        // Outdoors, too, where by itself the engine does not share.
        scene.reuse = if reuse == Reuse::Blocks { Sharing::Always } else { Sharing::Never };
        Renderings::new(&scene, samples * effort(), first_seed)
    };
    let size = [desc.image.width.value, desc.image.height.value];
    let (shared, alone) = (rendered(Reuse::Blocks, 24, 2000), rendered(Reuse::None, 64, 3000));
    assert_agree(name, size, scenes, &|r, c| shared.estimate(r, c), &|r, c| alone.estimate(r, c));
}

/// Asserts that glint chains beside photons change no picture in which photons bring next to nothing: to what surfaces that reflect a
/// thousandth show of lamps, which is 3e-5 at most, photons may do what they may do elsewhere.
pub fn assert_chains_are_unbiased(name: &str, desc: &SceneDesc, scenes: usize) {
    let rendered = |caustics: Caustics, samples: u32, first_seed: u32| {
        let mut desc = desc.clone();
        (desc.render.caustics, desc.render.indirect) = (caustics, Indirect::Paths);
        Renderings::new(&super::compiled(&desc), samples * effort(), first_seed)
    };
    let size = [desc.image.width.value, desc.image.height.value];
    let (chains, paths) = (rendered(Caustics::Photons, 24, 6000), rendered(Caustics::None, 96, 7000));
    assert!(chains.0.iter().all(|film| film.caustics && film.counters.chain_rays > 0), "{name}: no chains");
    let allow = |rectangle: Rectangle, channel: usize| {
        let (ours, theirs) = (chains.estimate(rectangle, channel), paths.estimate(rectangle, channel));
        let excess = ((ours.mean - theirs.mean).abs() - BLUR * 3e-5).max(0.0);
        Estimate { mean: theirs.mean + excess.copysign(ours.mean - theirs.mean), ..ours }
    };
    assert_agree(name, size, scenes, &allow, &|r, c| paths.estimate(r, c));
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

/// Asserts that a picture with photons is that without, but for a bias: of a tile, [`BLUR`] of what it holds, because the light of a
/// caustic is spread over the radius of a map and tiles are small; of the whole picture, `bias` of its mean.
pub fn assert_photons_are_consistent(name: &str, desc: &SceneDesc, plain: u32, bias: f64, scenes: usize) {
    let rendered = |caustics: Caustics, samples: u32, first_seed: u32| {
        let mut desc = desc.clone();
        (desc.render.caustics, desc.render.indirect) = (caustics, Indirect::Paths);
        Renderings::new(&super::compiled(&desc), samples * effort(), first_seed)
    };
    let size = [desc.image.width.value, desc.image.height.value];
    let (photons, plain) = (rendered(Caustics::Photons, 64, 4000), rendered(Caustics::None, plain, 5000));
    let allow = |rectangle: Rectangle, channel: usize| {
        let (ours, theirs) = (photons.estimate(rectangle, channel), plain.estimate(rectangle, channel));
        let allowed = theirs.mean * if area(rectangle) < area([0, 0, size[0], size[1]]) { BLUR } else { bias };
        let excess = ((ours.mean - theirs.mean).abs() - allowed).max(0.0);
        Estimate { mean: theirs.mean + excess.copysign(ours.mean - theirs.mean), ..ours }
    };
    assert_agree(name, size, scenes, &allow, &|r, c| plain.estimate(r, c));
}

/// Asserts that a picture with the indirect map is that without, but for a bias: of a tile, [`CELLS`] of what it holds, for a cell knows the
/// mean of its light only; of the whole picture, a thousandth of its mean. False where no rendering had a map, for hardly a path has a
/// second vertex; nothing is compared then.
pub fn assert_map_is_consistent(name: &str, desc: &SceneDesc, scenes: usize) -> bool {
    let rendered = |indirect: Indirect, samples: u32, first_seed: u32| {
        let mut desc = desc.clone();
        (desc.render.reuse, desc.render.indirect) = (Reuse::Blocks, indirect);
        Renderings::new(&super::compiled(&desc), samples * effort(), first_seed)
    };
    let size = [desc.image.width.value, desc.image.height.value];
    if !rendered(Indirect::Map, 1, 9000).0.iter().any(|film| film.indirect) {
        return false;
    }
    let (map, paths) = (rendered(Indirect::Map, 64, 9000), rendered(Indirect::Paths, 64, 10000));
    let allow = |rectangle: Rectangle, channel: usize| {
        let (ours, theirs) = (map.estimate(rectangle, channel), paths.estimate(rectangle, channel));
        let whole = area(rectangle) == area([0, 0, size[0], size[1]]);
        let excess = ((ours.mean - theirs.mean).abs() - theirs.mean * if whole { 0.001 } else { CELLS }).max(0.0);
        Estimate { mean: theirs.mean + excess.copysign(ours.mean - theirs.mean), ..ours }
    };
    assert_agree(name, size, scenes, &allow, &|r, c| paths.estimate(r, c));
    true
}

/// See [`assert_map_is_consistent`].
const CELLS: f64 = 0.005;

/// See [`assert_photons_are_consistent`].
const BLUR: f64 = 0.03;

/// Tiles and means of two pictures of the same scene, one of `scenes`.
fn assert_agree(
    name: &str,
    [width, height]: [u32; 2],
    scenes: usize,
    one: &dyn Fn(Rectangle, usize) -> Estimate,
    other: &dyn Fn(Rectangle, usize) -> Estimate,
) {
    let tiles: Vec<Rectangle> = (0..height.div_ceil(TILE))
        .flat_map(|y| (0..width.div_ceil(TILE)).map(move |x| (x, y)))
        .map(|(x, y)| [x * TILE, y * TILE, width.min((x + 1) * TILE), height.min((y + 1) * TILE)])
        .collect();
    let level = sidak(sidak(FAMILY_LEVEL, scenes), 3 * tiles.len());
    let mut faults = Vec::new();
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
                faults.push(line(format!("pixels {tile:?} channel {channel}"), &ours, &theirs, comparison.z));
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
            faults.push(line);
        }
    }
    assert!(faults.is_empty(), "{name} differs:\n{}", faults.join("\n"));
}

/// Compares, allowing for the rounding of `f32` where there is no noise to hide it: a picture of 10 operations per vertex and 10
/// vertices is right to 100 * 2^-24 = 6e-6 of its value.
fn agree(ours: &Estimate, theirs: &Estimate) -> tracer_reference::statistics::Comparison {
    let rounding = 6e-6 * theirs.mean;
    let rounded = Estimate { mean: theirs.mean, variance: theirs.variance + rounding * rounding, ..*theirs };
    ours.compare(&rounded)
}
