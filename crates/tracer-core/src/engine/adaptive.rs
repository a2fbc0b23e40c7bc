//! Which tiles rest: told by four pictures of one sample per pixel, with seeds of their own, that are not shown.
//!
//! Two of them differ by what two samples of a pixel do, sharing and light paths and all. For the least variance of the
//! whole picture in a given time a tile takes samples in proportion to the root of its own over what its samples cost
//! (Neyman 1934): here a half, a quarter or an eighth of those that the noisiest tiles take. The cost is counted in
//! rays of paths, of which glass has many and the sky has one, not measured: so it is the same on every machine. (Of a
//! part of a picture and of another the times of a sample were in proportion to it within a seventh, in three scenes.)
//! What a tile has is smoothed with its neighbours', for it tells little by itself. Above which variance tiles take all
//! is chosen by the time that it saves, that of light paths, which come whoever rests, beside it; and that is judged by
//! two pictures that the other two know nothing of, both ways: where few pixels bear the noise, what one pair finds
//! bright the other does not, and nothing would be gained. Where less than a fifth is, no tile rests.
//!
//! Tried: pictures of two, four and eight samples instead of one tell hardly more (docs/noise.md).

use super::grid::Grid;
use super::observer::{Observer, Progress};
use super::{RenderOptions, render};
use crate::film::{Adaptive, FROM, Film, MOST, Piece, run_end};
use crate::scene::Scene;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tracer_kernels::layers::{Layer, LayerSet};
use tracer_kernels::sampling::blocks::TILE;
use tracer_kernels::sampling::sampler::hash3;

/// The same noise takes so many times less at least, or no tile rests.
const WORTH: f64 = 1.2;

/// What a light path costs: two rays and a half on average, and what falls on the film, in rays of camera paths. Of
/// `marbles`, whose filter is wide, 3.0 were measured.
const LIGHT_PATH: f64 = 3.0;

/// What a sample costs at least.
const LEAST_COST: f64 = 0.1;

/// The variance above which tiles take all samples is looked for among those of so many tiles.
const CANDIDATES: usize = 32;

/// Whether it is to be decided now which tiles rest: all tiles have taken all samples so far, and the rendering goes
/// on. With a noise goal that has not been said otherwise, where it will take twice as many.
pub(super) fn is_due(scene: &Scene, options: &RenderOptions, film: &Film, goal: Option<f64>) -> bool {
    let begins = film.whole == FROM.max(film.first()) && film.unfinished.is_none();
    begins
        && film.adaptive().is_none()
        && !scene.moves()
        && options.adaptive.or(scene.adaptive).unwrap_or_else(|| {
            let is_far = |goal: f64| film.relative_noise() > goal * std::f64::consts::SQRT_2;
            goal.is_some_and(is_far)
        })
}

/// Whether a film that is gone on with was made so: of what is not said a film may be either.
pub(super) fn fits(scene: &Scene, options: &RenderOptions, film: &Film) -> bool {
    let asked = options.adaptive.or(scene.adaptive).filter(|_| film.whole > FROM && !scene.moves());
    asked.is_none_or(|asked| if asked { film.adaptive().is_some() } else { !film.is_adaptive() })
}

/// Decides it, where there are so many light paths for a sample index; `None` where the observer has ended the
/// rendering.
pub(super) fn plan(
    scene: &Scene,
    options: &RenderOptions,
    film: &Film,
    light_paths: u64,
    observer: Quiet<'_>,
) -> Option<Arc<Adaptive>> {
    let pictures = [0, 1, 2, 3].map(|k| picture(scene, options, hash3(film.seed(), 0x_ada9_71fe, k) as u32, &observer));
    if observer.is_ended.into_inner() {
        return None;
    }
    let tiles = scene.size.map(|side| side.div_ceil(TILE));
    let pairs = [[0, 1], [2, 3]].map(|[a, b]| Tiles::of(tiles, &pictures[a], &pictures[b], light_paths));
    let rests = pairs[0].rests(&pairs[1]);
    Some(Arc::new(
        rests.and_then(|rests| Adaptive::new(scene.size, rests)).unwrap_or_else(|| Adaptive::even(scene.size)),
    ))
}

/// A picture of one sample per pixel.
fn picture(scene: &Scene, options: &RenderOptions, seed: u32, observer: &Quiet<'_>) -> Film {
    let options = RenderOptions {
        samples: Some(1),
        seed: Some(seed),
        threads: options.threads,
        level: options.level,
        reuse: options.reuse,
        caustics: options.caustics,
        clamp: options.clamp,
        layers: Some(LayerSet::from_iter([Layer::PathLength])),
        light_groups: Some(false),
        adaptive: Some(false),
        ..RenderOptions::default()
    };
    render(scene, &options, observer)
}

/// Hears of no progress, and can end.
pub(super) struct Quiet<'a> {
    observer: &'a dyn Observer,
    now: Progress,
    is_ended: AtomicBool,
}

impl<'a> Quiet<'a> {
    pub fn new(observer: &'a dyn Observer, now: Progress) -> Self {
        Quiet { observer, now, is_ended: AtomicBool::new(false) }
    }
}

impl Observer for Quiet<'_> {
    fn progress(&self, _: Progress) -> ControlFlow<()> {
        let goes_on = self.observer.progress(self.now);
        if goes_on.is_break() {
            self.is_ended.store(true, Ordering::Relaxed);
        }
        goes_on
    }
}

/// What two pictures tell of the tiles.
struct Tiles {
    size: [u32; 2],
    /// Pixels of each.
    counts: Vec<f64>,
    /// Variance of a sample of each, mean over its pixels.
    variances: Vec<f64>,
    /// What a sample of each costs, mean over its pixels.
    costs: Vec<f64>,
    /// What the light paths of a sample index cost.
    light: f64,
}

impl Tiles {
    fn of(size: [u32; 2], a: &Film, b: &Film, light_paths: u64) -> Self {
        let none = vec![0.0; size[0] as usize * size[1] as usize];
        let light = LIGHT_PATH * light_paths as f64;
        let mut tiles = Tiles { size, counts: none.clone(), variances: none.clone(), costs: none, light };
        for (x, y) in a.pixels() {
            let tile = (y / TILE * size[0] + x / TILE) as usize;
            let difference = a.mean_luminance(x, y) - b.mean_luminance(x, y);
            let rays = [a, b].map(|film| f64::from(film.number(Layer::PathLength, x, y)));
            tiles.counts[tile] += 1.0;
            tiles.variances[tile] += 0.5 * difference * difference;
            tiles.costs[tile] += 0.5 * (rays[0] + rays[1]);
        }
        for mean in [&mut tiles.variances, &mut tiles.costs] {
            mean.iter_mut().zip(&tiles.counts).for_each(|(mean, count)| *mean /= count);
        }
        tiles
    }

    /// What is to be in proportion to the square of a tile's samples: variance over cost, smoothed.
    fn wanted(&self) -> Vec<f64> {
        // Beside a fisheye's circle no ray is cast.
        self.smoothed().iter().zip(&self.costs).map(|(variance, cost)| variance / cost.max(LEAST_COST)).collect()
    }

    /// With the weights 1, 2, 1 both ways.
    fn smoothed(&self) -> Vec<f64> {
        let [columns, rows] = self.size.map(i64::from);
        let at = |column: i64, row: i64| {
            self.variances[(row.clamp(0, rows - 1) * columns + column.clamp(0, columns - 1)) as usize]
        };
        let line = |column: i64, row: i64| at(column - 1, row) + 2.0 * at(column, row) + at(column + 1, row);
        let mean = |column: i64, row: i64| {
            let mean = (line(column, row - 1) + 2.0 * line(column, row) + line(column, row + 1)) / 16.0;
            // A tile that is far noisier than its neighbours is not drowned by them.
            mean.max(0.5 * at(column, row))
        };
        (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))).map(|(c, r)| mean(c, r)).collect()
    }

    /// How many times less it takes to make the same variance, if tiles rest so.
    fn gain(&self, rests: &[u8]) -> f64 {
        let (mut even, mut adaptive) = ([0.0, self.light], [0.0, self.light]);
        for (k, &rest) in rests.iter().enumerate() {
            let of_all = f64::from(1_u32 << rest);
            let (variance, cost) = (self.counts[k] * self.variances[k], self.counts[k] * self.costs[k]);
            even = [even[0] + variance, even[1] + cost];
            adaptive = [adaptive[0] + variance * of_all, adaptive[1] + cost / of_all];
        }
        if adaptive[0] > 0.0 { even[0] / adaptive[0] * even[1] / adaptive[1] } else { 1.0 }
    }

    /// How much tiles rest, by what both pairs of pictures tell; `None` where that would not be worth it.
    fn rests(&self, other: &Tiles) -> Option<Vec<u8>> {
        let [own, others] = [self, other].map(Tiles::wanted);
        let both: Vec<f64> = own.iter().zip(&others).map(|(a, b)| 0.5 * (a + b)).collect();
        let mut sorted = both.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let candidates = (0..CANDIDATES).map(|k| sorted[(sorted.len() - 1) * k / (CANDIDATES - 1)]);
        let gain = |&limit: &f64| 0.5 * (other.gain(&below(limit, &own)) + self.gain(&below(limit, &others)));
        let best = candidates.filter(|&limit| limit > 0.0).map(|limit| (gain(&limit), limit));
        let (gain, limit) = best.max_by(|a, b| a.0.total_cmp(&b.0))?;
        (gain >= WORTH).then(|| below(limit, &both))
    }
}

/// How much tiles of these variances rest, where one of so much takes all samples.
fn below(limit: f64, variances: &[f64]) -> Vec<u8> {
    let rest = |&variance: &f64| {
        let halvings = 0.5 * libm::log2(limit / variance);
        // Of a variance of zero there are infinitely many.
        (halvings + 0.5).floor().clamp(0.0, f64::from(MOST)) as u8
    };
    variances.iter().map(rest).collect()
}

impl Adaptive {
    /// The pieces of a pass cut into batches of so many places each that take its samples: no tile begins or ends to
    /// rest within it.
    pub(super) fn batches(&self, grid: &Grid, pieces: Vec<Piece>, per_batch: u32) -> Vec<Piece> {
        let mut batches = Vec::new();
        for Piece { places, samples } in pieces {
            debug_assert!(samples.end <= run_end(samples.start));
            let (mut start, mut awake) = (places.start, 0);
            for place in places.clone() {
                let takes = samples.clone().any(|sample| {
                    let block = grid.block(place as usize, grid.cut(sample));
                    block.is_some_and(|block| self.resting(block, sample).is_some())
                });
                awake += u32::from(takes);
                if awake == per_batch {
                    batches.push(Piece { places: start..place + 1, samples: samples.clone() });
                    (start, awake) = (place + 1, 0);
                }
            }
            if start < places.end {
                batches.push(Piece { places: start..places.end, samples });
            }
        }
        batches
    }
}
