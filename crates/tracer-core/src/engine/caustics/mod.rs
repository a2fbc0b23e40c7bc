//! Caustics: light that reaches Lambert lobes over mirrors, glass and narrow glossy lobes, by maps of photons.
//!
//! A path that scatters by a Lambert lobe, goes on over mirrors, glass and narrow lobes only and then meets a small light carries
//! nearly all of the noise of a picture with such objects, because the ray that happens to take this way is rare and bright. For that
//! class of paths, and no other, photons are sent from the lights at the casters ([`casters`], [`plan`]), followed over mirrors, glass
//! and narrow lobes ([`trace`]) and stored at every Lambert lobe that they meet ([`map`]); every vertex with such a lobe gathers those
//! around it (`engine::stages::gather`), and scattered rays that find such a light count nothing.
//!
//! A surface with both lobes belongs to both sides: its Lambert lobe gathers, its glossy lobe passes photons on. So with photons
//! paths take one lobe at a time and know which. Weighing photons against paths where a lobe is neither narrow nor wide (Georgiev et al.:
//! Light Transport Simulation with Vertex Connection and Merging, 2012) would need both densities along the whole way; a bound on the
//! exponent needs none, and lobes wider than that are lit well by light samples.
//!
//! Each sample index has a map of its own; from map to map the radius shrinks, so the picture is consistent (its bias goes to zero) rather
//! than unbiased (Hachisuka, Ogaki, Jensen: Progressive Photon Mapping, 2008). Maps depend on scene, seed and number only:
//! the same for any crop, threads and lanes.

pub mod aims;
pub mod casters;
pub mod map;
pub mod plan;
pub mod trace;

use crate::engine::kernels::Kernels;
use crate::engine::statistics::Stage;
use crate::engine::{Worker, each};
use crate::lanes::{Bits, Lanes};
use crate::sampling::sampler::hash3;
use crate::scene::Scene;
use map::{Map, Photon};
use plan::Plan;
use std::sync::Mutex;
use std::time::Instant;

/// Photons of the trial that tells whether maps are worth it.
const TRIAL: u32 = 4096;

/// A map and its plan, as the engine's stages need them.
#[derive(Clone, Copy)]
pub struct PhotonMap<'a> {
    /// Which lights it holds.
    pub plan: &'a Plan,
    /// The photons.
    pub map: &'a Map,
}

impl PhotonMap<'_> {
    /// Lights whose light over mirrors, glass and narrow lobes the map holds.
    #[inline(always)]
    pub fn brings<F: Lanes>(&self, light: F::U) -> F::M {
        !F::U::gather(&self.plan.mapped, light).eq(F::U::splat(0))
    }
}

/// The maps of a rendering.
pub struct Caustics {
    /// What the maps have in common.
    pub plan: Plan,
    seed: u32,
    /// The maps at hand, by number.
    maps: Vec<Map>,
}

impl Caustics {
    /// Finds out by a trial whether a scene is worth maps; `None` where it is not.
    pub fn new(scene: &Scene, kernels: &Kernels, seed: u32, workers: &[Mutex<Worker>]) -> Option<Caustics> {
        let plan = Plan::new(scene, seed)?;
        let count = TRIAL.min(plan.photons);
        let shares: Vec<plan::Share> = plan.shares(0, count).collect();
        // Choices of its own: where the photons of the maps go must not depend on what becomes of those very photons.
        let photons = trace::photons(scene, kernels, &plan, hash3(seed, 0, 0x0007_21a1) as u32, &shares, workers);
        let scale = f64::from(plan.photons) / f64::from(count);
        let mut stored = vec![0.0; plan.pairs.caster.len()];
        for photon in &photons {
            stored[photon.pair as usize] += scale * f64::from(photon.flux.iter().sum::<f32>());
        }
        let plan = plan.after(scene, &stored)?;
        Some(Caustics { plan, seed, maps: Vec::new() })
    }

    /// Makes the maps for a range of sample indices and forgets others.
    pub fn prepare(
        &mut self,
        scene: &Scene,
        kernels: &Kernels,
        samples: std::ops::Range<u32>,
        workers: &[Mutex<Worker>],
    ) {
        self.maps.retain(|m| samples.contains(&m.number));
        let plan = &self.plan;
        let mut photons: Vec<(u32, Vec<Photon>)> = Vec::new();
        for number in samples {
            if self.maps.iter().all(|m| m.number != number) {
                let shares: Vec<plan::Share> = plan.shares(number, plan.photons).collect();
                photons.push((number, trace::photons(scene, kernels, plan, self.seed, &shares, workers)));
            }
        }
        let made = each(workers, photons.len(), |k, worker| {
            worker.batch.watch.resume();
            let start = Instant::now();
            let (number, photons) = &photons[k];
            let map = Map::new(*number, photons, &plan.pairs, &plan.radii);
            worker.batch.watch.lap(Stage::Photons);
            worker.batch.watch.costs.photons_since(start);
            map
        });
        self.maps.extend(made);
    }

    /// The map of a sample index that was prepared.
    pub fn map(&self, sample: u32) -> Option<PhotonMap<'_>> {
        let map = self.maps.iter().find(|m| m.number == sample)?;
        Some(PhotonMap { plan: &self.plan, map })
    }
}
