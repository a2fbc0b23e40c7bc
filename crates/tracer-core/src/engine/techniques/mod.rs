//! The techniques, a room each: what they have in common, [`super::technique`] says.

mod glints;
mod guides;
mod light_paths;
mod photons;
mod reuse;
mod sky;
mod trial;

/// The sample index at which is made what techniques hand on to this one, where the scene moves.
pub use guides::made_at;

use super::options::RenderOptions;
use super::technique::{Engine, Technique};
use crate::film::Crop;
use std::sync::Arc;
use tracer_kernels::engine::guide::plan::Plan;
use tracer_kernels::engine::pass::Pass;
use tracer_kernels::engine::pool::Pool;
use tracer_kernels::scene::Integrator;

/// What a technique may try before it says whether it is worth its while.
pub struct Trial<'a> {
    pub engine: Engine<'a>,
    pub options: &'a RenderOptions,
    pub crop: Crop,
    /// There is anything to render.
    pub has_samples: bool,
    /// Each sample index sees another moment, and tries anew.
    pub moves: bool,
    /// Plain paths.
    pub pass: Pass<'a>,
    pub pool: &'a Pool,
    /// Rays are aimed where a guide says.
    pub wants_guides: bool,
    /// From which lights photons go to which casters; where they are wanted and have a way to go.
    pub plan: Option<Arc<Plan>>,
}

/// Tries a technique; `None` where it is not worth its while.
type TryOut = fn(&Trial<'_>) -> Option<Box<dyn Technique>>;

/// All of them, in the order of their turns after a vertex and after a batch.
const ALL: [TryOut; 4] = [reuse::plan, guides::plan, light_paths::plan, glints::plan];

/// Those that are at work.
pub fn plan(mut trial: Trial<'_>) -> Vec<Box<dyn Technique>> {
    let scene = trial.engine.scene;
    // They bring all light sooner; nothing else.
    if scene.integrator != Integrator::Paths {
        return Vec::new();
    }
    trial.wants_guides = trial.options.caustics.unwrap_or(scene.caustics) && trial.has_samples;
    trial.plan = if trial.wants_guides { Plan::new(scene, trial.pass.seed).map(Arc::new) } else { None };
    ALL.iter().filter_map(|plan| plan(&trial)).collect()
}
