//! Light paths of a rendering: how many go from which light to which caster, and onto which pixels they fall ([`super::stages::light_paths`]).
//!
//! At every sample index there are as many, whose numbers go on where those of the sample index before have ended. What they bring is
//! summed apart from the pixels' samples, exactly, and counts as much whatever the crop, the threads and the order.

use super::batch::{Batch, PATHS};
use super::guide::Guide;
use super::guide::plan::{Plan, Share};
use super::guide::trace::{PhotonPass, batches, load};
use super::kernels::Kernels;
use super::stages::camera::density;
use super::stages::light_paths::LightPass;
use super::statistics::Stage;
use super::trace::{closest, occluded};
use super::{Worker, each};
use crate::bvh::Coherence;
use crate::film::Cells;
use crate::sampling::sampler::hash3;
use crate::scene::{NONE, Scene};
use std::ops::Range;
use std::sync::Mutex;
use std::time::Instant;

/// Light paths of a sample index for five pixels. With half as many the statues' error was a twentieth larger, with ten for five pixels a
/// twentieth smaller, for a twentieth and a seventh of the time.
const PER_FIVE_PIXELS: u64 = 2;
/// Light paths of a sample index at most, and at a time.
const MOST: u64 = 1 << 22;

/// How many light paths there are.
pub struct LightPaths {
    /// Seed of their random choices.
    seed: u32,
    /// Those of one sample index.
    shares: Vec<Share>,
    /// Pair of light `l` and caster `c`, at `l` times the number of casters plus `c`, or [`NONE`].
    pub pair_of: Vec<u32>,
    /// Per pair: light paths of a sample index over the area of light that they start from.
    pub density: Vec<f32>,
    /// How far outside of the picture they count, in pixels.
    pub reach: f32,
}

/// Where light paths fall.
#[derive(Clone, Copy)]
pub struct OnFilm<'a, 'b> {
    /// The film.
    pub cells: &'a Cells<'b>,
    /// The most that the largest channel of what one of them brings counts, where samples are clamped; in the film's unit.
    pub limit: Option<f64>,
}

impl LightPaths {
    /// `None` where no pixel could see them: all rays of a pixel go through its centre.
    pub fn new(scene: &Scene, plan: &Plan, seed: u32) -> Option<Self> {
        let reach = scene.camera.filter.reach();
        if reach <= 0.0 {
            return None;
        }
        let pixels = u64::from(scene.size[0]) * u64::from(scene.size[1]);
        let count = (pixels * PER_FIVE_PIXELS / 5).clamp(1, MOST) as u32;
        let shares: Vec<Share> = plan.shares(count).collect();
        let casters = plan.casters.list.len();
        let mut pair_of = vec![NONE; scene.lights.len() * casters];
        let mut density = vec![0.0; plan.ends.len()];
        for share in &shares {
            let pair = share.pair as usize;
            let [light, caster] = plan.ends[pair];
            pair_of[light * casters + caster] = share.pair;
            density[pair] = share.count as f32 / plan.pairs.area[pair];
        }
        let seed = hash3(seed, 0, 0x0011_6847) as u32;
        (!shares.is_empty()).then_some(LightPaths { seed, shares, pair_of, density, reach })
    }

    /// Sample indices that are followed at a time.
    pub fn at_once(&self) -> u32 {
        let of_one: u64 = self.shares.iter().map(|share| u64::from(share.count)).sum();
        (MOST / of_one).max(1) as u32
    }

    /// Follows the light paths of these sample indices, which have one guide, onto the film.
    #[allow(clippy::too_many_arguments)]
    pub fn trace(
        &self,
        scene: &Scene,
        kernels: &Kernels,
        plan: &Plan,
        guide: &Guide,
        samples: Range<u32>,
        film: OnFilm<'_, '_>,
        workers: &[Mutex<Worker>],
    ) {
        let pass = LightPass { seed: self.seed, plan, light_paths: self, guide };
        let at_once = self.at_once();
        for start in samples.clone().step_by(at_once as usize) {
            // Batches of full length, whichever sample index their paths are of.
            let count = at_once.min(samples.end - start);
            let shares = self.shares.iter().map(|share| Share {
                first: share.count.wrapping_mul(start),
                count: share.count * count,
                ..*share
            });
            let batches = batches(shares);
            each(workers, batches.len(), |k, worker| {
                let batch = &mut worker.batch;
                batch.watch.resume();
                let start = Instant::now();
                follow(scene, kernels, pass, &batches[k], film, batch);
                batch.watch.costs.photons_since(start);
            });
        }
    }
}

/// Follows a batch of light paths.
fn follow(
    scene: &Scene,
    kernels: &Kernels,
    pass: LightPass<'_>,
    shares: &[Share],
    film: OnFilm<'_, '_>,
    batch: &mut Batch,
) {
    let count = load(shares, batch);
    debug_assert!(count <= PATHS);
    let photons = PhotonPass { seed: pass.seed, count, light_paths: Some(pass.light_paths) };
    kernels.photons_emit(pass.plan, photons, batch);
    let mut event = 0;
    batch.watch.lap(Stage::Photons);
    while batch.paths.len > 0 {
        closest(scene, kernels, false, batch);
        batch.splats.len = 0;
        kernels.light_paths(scene, pass, event, batch);
        batch.watch.lap(Stage::Photons);
        occluded(scene, kernels, Coherence::Incoherent, batch);
        splat(scene, film, batch);
        batch.watch.lap(Stage::Film);
        event += 1;
    }
}

/// Adds what reaches the lens to the film.
fn splat(scene: &Scene, film: OnFilm<'_, '_>, batch: &Batch) {
    let splats = &batch.splats;
    let filter = scene.camera.filter;
    let reach = filter.reach();
    for k in (0..splats.len).filter(|&k| batch.shadows.occluded[k] == 0) {
        let (x, y) = (splats.x[k], splats.y[k]);
        let pixels = |at: f32| (at - 0.5 - reach).ceil() as i32..=(at - 0.5 + reach).floor() as i32;
        for row in pixels(y) {
            for column in pixels(x) {
                let h = density(filter, x - 0.5 - column as f32, y - 0.5 - row as f32);
                let scale = h / (h * splats.by_paths[k] + splats.by_light[k]);
                if scale > 0.0 && scale.is_finite() {
                    let brings = [0, 1, 2].map(|c| splats.brings[c][k] * scale);
                    film.cells.splat([column, row], brings, film.limit);
                }
            }
        }
    }
}
