//! Guides ([`tracer_kernels::engine::guide`]): made of photons before passes, and rays aimed by them after vertices.
//!
//! The guide gets better as samples are added: that of sample index s is made from more photons at every doubling of s,
//! up to [`MOST_PHOTONS`]. It depends on scene, seed and s only: the same for any crop, threads, lanes and number of
//! samples asked for.

use super::Trial;
use super::photons::photons;
use super::sky;
use crate::engine::technique::{Engine, Technique, Vertex};
use std::any::Any;
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;
use tracer_kernels::engine::batch::Batch;
use tracer_kernels::engine::guide::casters::Casters;
use tracer_kernels::engine::guide::cells::Cells;
use tracer_kernels::engine::guide::plan::Plan;
use tracer_kernels::engine::guide::{Guide, MOST_CASTERS};
use tracer_kernels::engine::pass::Pass;
use tracer_kernels::engine::pool::Pool;
use tracer_kernels::report::Stage;
use tracer_kernels::sampling::sampler::hash3;
use tracer_kernels::scene::Scene;

/// Photons of the largest guide.
const MOST_PHOTONS: u32 = 1 << 18;
/// Photons of the trial that tells how many of them meet the caster that they are sent at: of those that are sent at a
/// bent mesh's sphere, a tenth. What meets it and goes to the sky brings as little with more photons.
const TRIAL: u32 = 4096;
/// Where fewer meet it, so many times as many are sent, at most.
const MOST_MORE: u32 = 8;

/// The guides of a rendering, one at a time.
struct Guides {
    /// Where there is a way for photons.
    plan: Option<Arc<Plan>>,
    /// How often a path sees the sky, where that is looked for, too.
    sky: Option<f32>,
    seed: u32,
    /// Photons of the first guide.
    first: u32,
    /// How many times as many photons are sent as where all meet a caster; known after a trial.
    more: Option<u32>,
    stage: u32,
    guide: Guide,
    /// It was made at the first sample index that has it.
    is_of_stage: bool,
}

/// Which guide a sample index has: a new one at every power of two.
fn stage_of(sample: u32) -> u32 {
    sample.checked_ilog2().map_or(0, |k| k + 1)
}

/// The first sample index that has a guide.
fn first_of(stage: u32) -> u32 {
    stage.checked_sub(1).map_or(0, |k| 1 << k)
}

/// Photons of the first guide: they go by the size of the picture.
fn first_photons(scene: &Scene) -> u32 {
    let pixels = u64::from(scene.size[0]) * u64::from(scene.size[1]);
    (pixels / 4).next_power_of_two().clamp(1024, 65536) as u32
}

/// The guide of a sample index, where the first has so many photons.
fn stage_with(first: u32, sample: u32) -> u32 {
    let largest = (MOST_PHOTONS / first).ilog2() + 1;
    stage_of(sample).min(largest)
}

/// The sample index at which the guide of this one is made. Where the scene moves, it is made of the scene as the
/// former sees it, whether or not there is a way for photons at this moment.
pub fn made_at(scene: &Scene, sample: u32) -> u32 {
    first_of(stage_with(first_photons(scene), sample))
}

/// Guides, where they are wanted, and photons have a way to go or the sky is seen through openings.
pub fn plan(trial: &Trial<'_>) -> Option<Box<dyn Technique>> {
    let scene = trial.engine.scene;
    let sky = if trial.wants_guides { sky::finds_per_path(trial, first_photons(scene)) } else { None };
    if trial.plan.is_none() && sky.is_none() {
        return None;
    }
    Some(Box::new(Guides::new(scene, trial.plan.clone(), sky, trial.pass.seed)))
}

impl Guides {
    /// There is no guide at hand before [`Technique::before_pass`].
    fn new(scene: &Scene, plan: Option<Arc<Plan>>, sky: Option<f32>, seed: u32) -> Self {
        let mut guide = Guide::default();
        if plan.is_some() {
            for caster in Casters::new(scene, MOST_CASTERS).list.iter().take(MOST_CASTERS) {
                guide.casters.push(caster.center.as_vec3().to_array(), caster.radius as f32, 1.0);
            }
        }
        let first = first_photons(scene);
        Guides { plan, sky, seed, first, more: None, stage: u32::MAX, guide, is_of_stage: false }
    }

    /// Cells of photons.
    fn of_photons(&mut self, engine: Engine<'_>, plan: &Plan, stage: u32, pool: &Pool) -> Cells {
        let more = *self.more.get_or_insert_with(|| {
            let seed = hash3(self.seed, 0, 0x0007_21a1) as u32;
            let met = photons(engine, plan, seed, TRIAL, pool).met;
            (TRIAL / met.max(1)).clamp(1, MOST_MORE)
        });
        let count = plan.worth((self.first << stage.saturating_sub(1)).min(MOST_PHOTONS) * more);
        // Choices of its own for each guide.
        let seed = hash3(self.seed, stage, 0x0007_21a1) as u32;
        let photons = photons(engine, plan, seed, count, pool).stored;
        pool.once(|batch| {
            batch.watch.resume();
            let start = Instant::now();
            let cells = Cells::new(seed, &photons, plan.sent / std::f32::consts::PI * count as f32);
            batch.watch.lap(Stage::Photons);
            batch.watch.costs.photons_since(start);
            cells
        })
    }

    /// The guide of a sample index.
    fn stage(&self, sample: u32) -> u32 {
        stage_with(self.first, sample)
    }
}

impl Technique for Guides {
    fn name(&self) -> &'static str {
        "aiming"
    }

    /// Makes the guide of these sample indices, which have the same one, if it is not at hand.
    fn before_pass(&mut self, engine: Engine<'_>, samples: &Range<u32>, pool: &Pool) {
        let stage = self.stage(samples.start);
        debug_assert_eq!(self.stage(samples.end.max(1) - 1), stage, "a pass has one guide");
        if stage == self.stage {
            return;
        }
        if let Some(plan) = self.plan.clone() {
            self.guide.lights = Some(self.of_photons(engine, &plan, stage, pool));
        }
        if let Some(finds) = self.sky {
            let paths = (self.first << stage.saturating_sub(1)).min(MOST_PHOTONS) / 4;
            let seed = hash3(self.seed, stage, 0x0007_21a2) as u32;
            self.guide.sky = None;
            let lights = self.guide.lights.is_some().then_some(&self.guide);
            self.guide.sky = Some(sky::cells(engine, seed, (paths, finds), lights, pool));
        }
        (self.stage, self.is_of_stage) = (stage, samples.start == first_of(stage));
    }

    /// The cells: photons cost too much for a sample each, and a guide only says where to look. One that was not made
    /// at the first index of its stage (there were no ways for photons then) is not handed on, so that it does not
    /// matter at which index a rendering begins.
    fn hand_on(&mut self) -> Option<Box<dyn Any + Send>> {
        let Guide { lights, sky, .. } = &mut self.guide;
        self.is_of_stage.then(|| Box::new((self.stage, [lights.take(), sky.take()])) as Box<dyn Any + Send>)
    }

    fn take_over(&mut self, handed: Box<dyn Any + Send>) {
        if let Ok(handed) = handed.downcast::<(u32, [Option<Cells>; 2])>() {
            (self.stage, [self.guide.lights, self.guide.sky]) = *handed;
            self.is_of_stage = true;
        }
    }

    fn tell<'a>(&'a self, pass: &mut Pass<'a>) {
        pass.guide = Some(&self.guide);
    }

    /// Aims rays.
    fn after_vertex(&self, engine: Engine<'_>, pass: Pass<'_>, vertex: Vertex, batch: &mut Batch) {
        let start = Instant::now();
        engine.kernels.aim(engine.scene, &self.guide, pass.seed, vertex.number, batch);
        batch.watch.costs.caustics += start.elapsed().as_secs_f64();
        batch.watch.lap(Stage::Aim);
    }
}
