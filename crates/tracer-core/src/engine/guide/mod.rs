//! Guides: where rays from diffuse and glossy surfaces are aimed to find lights over mirrors, glass and narrow glossy lobes.
//!
//! A path that scatters from a rough surface, goes on over mirrors, glass and narrow lobes only and then meets a small light carries
//! nearly all of the noise of a picture with such objects (E D S+ L in Heckbert's notation), because the ray that happens to take this
//! way is rare and bright. Photons know these ways: sent from the lights at the casters ([`casters`], [`plan`]) and followed over mirrors,
//! glass and narrow lobes ([`trace`]), they tell at every place that they reach from where the light comes: from the last mirror or glass
//! that they met. The guide keeps these as spheres in space, for the cells of an octree ([`cells`]), and more rays are aimed into the cones
//! around them (`engine::stages::aim`). So photons guide paths and bring no light themselves (Jensen: Importance Driven Path Tracing
//! Using the Photon Map, 1995): the estimate is that of paths, unbiased, on thin, small, folded and bent receivers as on large flat
//! ones; a bad guide makes noise, never an error. A density estimate of the photons lost up to two thirds of the light there.
//!
//! The guide gets better as samples are added: that of sample index s is made from more photons at every doubling of s, up to
//! [`MOST_PHOTONS`]. It depends on scene, seed and s only: the same for any crop, threads, lanes and number of samples asked for.

pub mod casters;
pub mod cells;
pub mod plan;
pub mod trace;

use crate::engine::kernels::Kernels;
use crate::engine::statistics::Stage;
use crate::engine::{Worker, each};
use crate::sampling::sampler::hash3;
use crate::scene::Scene;
use cells::{Cells, SphereRows};
use plan::Plan;
use std::sync::Mutex;
use std::time::Instant;

/// Photons of the largest guide.
const MOST_PHOTONS: u32 = 1 << 18;
/// Photons of the trial that tells how many of them are stored: of those that are sent at a bent mesh's sphere, a tenth.
const TRIAL: u32 = 4096;
/// Where fewer are stored, so many times as many are sent, at most.
const MOST_MORE: u32 = 8;
/// Rays may be aimed at the casters themselves, too, so many at most; more of them are taken together.
pub const MOST_CASTERS: usize = 16;

/// What rays are aimed at.
pub struct Guide {
    /// By place.
    pub cells: Cells,
    /// Spheres around the casters, for what no photon has found.
    pub casters: SphereRows,
}

/// The guides of a rendering, one at a time.
pub struct Guides<'a> {
    plan: &'a Plan,
    seed: u32,
    /// Photons of the first guide.
    first: u32,
    /// How many times as many photons are sent as where all are stored; known after a trial.
    more: Option<u32>,
    stage: u32,
    guide: Guide,
}

/// Which guide a sample index has: a new one at every power of two.
fn stage_of(sample: u32) -> u32 {
    sample.checked_ilog2().map_or(0, |k| k + 1)
}

impl<'a> Guides<'a> {
    /// There is no guide at hand before [`Guides::prepare`].
    pub fn new(scene: &Scene, plan: &'a Plan, seed: u32) -> Self {
        let mut casters = SphereRows::default();
        for caster in casters::Casters::new(scene, MOST_CASTERS).list.iter().take(MOST_CASTERS) {
            casters.push(caster.center.as_vec3().to_array(), caster.radius as f32, 1.0);
        }
        let pixels = u64::from(scene.size[0]) * u64::from(scene.size[1]);
        let first = (pixels / 4).next_power_of_two().clamp(1024, 65536) as u32;
        Guides { plan, seed, first, more: None, stage: u32::MAX, guide: Guide { cells: Cells::default(), casters } }
    }

    /// Makes the guide of these sample indices, which have the same one, if it is not at hand.
    pub fn prepare(
        &mut self,
        scene: &Scene,
        kernels: &Kernels,
        samples: &std::ops::Range<u32>,
        workers: &[Mutex<Worker>],
    ) {
        let largest = (MOST_PHOTONS / self.first).ilog2() + 1;
        let stage = stage_of(samples.start).min(largest);
        debug_assert_eq!(stage_of(samples.end.max(1) - 1).min(largest), stage, "a pass has one guide");
        if stage == self.stage {
            return;
        }
        let more = *self.more.get_or_insert_with(|| {
            let seed = hash3(self.seed, 0, 0x0007_21a1) as u32;
            let stored = trace::photons(scene, kernels, self.plan, seed, TRIAL, workers).len() as u32;
            (TRIAL / stored.max(1)).clamp(1, MOST_MORE)
        });
        let count = (self.first << stage.saturating_sub(1)).min(MOST_PHOTONS) * more;
        // Choices of its own for each guide.
        let seed = hash3(self.seed, stage, 0x0007_21a1) as u32;
        let photons = trace::photons(scene, kernels, self.plan, seed, count, workers);
        let mut made = each(workers, 1, |_, worker| {
            worker.batch.watch.resume();
            let start = Instant::now();
            let cells = Cells::new(seed, &photons, self.plan.power / std::f32::consts::PI * count as f32);
            worker.batch.watch.lap(Stage::Photons);
            worker.batch.watch.costs.photons_since(start);
            cells
        });
        self.guide.cells = made.pop().unwrap_or_default();
        self.stage = stage;
    }

    /// The guide that was prepared.
    pub fn guide(&self) -> &Guide {
        &self.guide
    }
}
