//! A scene in which something moves while the shutter is open: each sample index sees a scene of its own, and is a pass
//! of its own. One of them is in memory at a time, and what is to tell how things move of two more.
//!
//! Techniques are planned anew for each, since what they know of lights and surfaces is of that scene. Only what takes
//! long and need not be exact is handed on ([`Technique::hand_on`](super::technique::Technique::hand_on)): guides.

use super::passes::{Painter, Passes};
use super::technique::Engine;
use super::{Misfit, Work, fits, has_places, lit, painter};
use crate::film::{Film, Plan, Unfinished};
use crate::scene::Scene;
use scene_format::Diagnostics;
use std::any::Any;
use std::collections::BTreeMap;
use std::sync::Arc;
use tracer_kernels::engine::kernels::Kernels;
use tracer_kernels::layers::Layer;
use tracer_kernels::scene::{End, Ends};

/// What techniques hand on, by the light group that they are of and by their names.
#[derive(Default)]
pub(super) struct Handed(BTreeMap<(usize, &'static str), Box<dyn Any + Send>>);

impl Handed {
    /// Takes what the techniques have for others.
    fn take(&mut self, painter: &mut Painter<'_>) {
        for (group, technique) in painter.techniques() {
            if let Some(handed) = technique.hand_on() {
                self.0.insert((group, technique.name()), handed);
            }
        }
    }

    /// Gives it to techniques that are made ready next.
    pub fn give(&mut self, painter: &mut Painter<'_>) {
        for (group, technique) in painter.techniques() {
            if let Some(handed) = self.0.remove(&(group, technique.name())) {
                technique.take_over(handed);
            }
        }
    }
}

/// The scene as a sample index sees it; this one where nothing moves.
pub(super) fn seen(scene: &Scene, film: &Film, sample: u32) -> Option<Result<Scene, Diagnostics>> {
    scene.at_sample(sample, film.seed())
}

/// The scene as the shutter opens and as it closes, where the film tells how things move.
fn ends(scene: &Scene, film: &Film) -> Result<Option<Arc<Ends>>, Diagnostics> {
    if !film.layers().iter().any(|layer| layer == Layer::Motion) {
        return Ok(None);
    }
    let at = |part: f64| scene.at(part).transpose();
    let (Some(open), Some(close)) = (at(0.0)?, at(1.0)?) else { return Ok(None) };
    let shutter = scene.moments.as_ref().map_or(1.0, |moments| moments.shutter());
    Ok(Some(Arc::new(Ends { scenes: [End::new(&open), End::new(&close)], shutter })))
}

/// What the techniques of a sample index are handed by those before, made as it was then.
pub(super) fn handed_before(
    scene: &Scene,
    kernels: &Kernels,
    film: &Film,
    work: &Work<'_>,
    sample: u32,
) -> Result<Handed, Diagnostics> {
    let planned = |scene: &Scene| {
        let lit = lit(scene, film);
        let engine = Engine::new(scene, kernels);
        let mut asked = painter(engine, &lit, work.options, film, work.samples, work.pool, work.observer);
        asked.techniques().map(|(_, technique)| technique.made_at(sample)).find(|&before| before != sample)
    };
    let mut handed = Handed::default();
    let now = seen(scene, film, sample).transpose()?;
    if let Some(before) = planned(now.as_ref().unwrap_or(scene)) {
        drop(now);
        let then = seen(scene, film, before).transpose()?;
        let then = then.as_ref().unwrap_or(scene);
        let (engine, lit) = (Engine::new(then, kernels), lit(then, film));
        let mut painter = painter(engine, &lit, work.options, film, work.samples, work.pool, work.observer);
        painter.prepare(&(before..before + 1));
        handed.take(&mut painter);
    }
    // What was made before is made again, and counted no second time.
    work.pool.forget_counters();
    Ok(handed)
}

/// Adds the samples that a film lacks.
pub(super) fn go_on(scene: &Scene, kernels: &Kernels, mut film: Film, mut work: Work<'_>) -> Result<Film, Misfit> {
    take_up(scene, &mut film, &work, kernels)?;
    // A pass is one sample index: no other sees what it sees.
    let is_one = |rest: &Unfinished| rest.end == film.whole + 1;
    fits("division into passes", film.unfinished.as_ref().is_none_or(is_one))?;
    work.plan = work.plan.map(|plan| Plan { end: plan.whole + 1, light: plan.light.min(plan.whole + 1), ..plan });
    film.fault = None;
    let mut handed = match handed_before(scene, kernels, &film, &work, film.whole) {
        Ok(handed) => handed,
        Err(faults) => {
            film.fault = Some(faults);
            return Ok(film);
        }
    };
    let ends = match ends(scene, &film) {
        Ok(ends) => ends,
        Err(faults) => {
            film.fault = Some(faults);
            return Ok(film);
        }
    };
    let mut passes = Passes::new(film.whole, work.samples, 1).planned(work.plan);
    while !work.goals.are_met(&film)
        && let Some(pass) = passes.next(film.unfinished.as_ref().map(|rest| rest.end))
    {
        let mut now = match seen(scene, &film, pass.start).transpose() {
            Ok(now) => now,
            Err(faults) => {
                film.fault = Some(faults);
                break;
            }
        };
        if let Some(now) = &mut now {
            now.rendered.ends.clone_from(&ends);
        }
        let now = now.as_ref().unwrap_or(scene);
        let (engine, lit) = (Engine::new(now, kernels), lit(now, &film));
        let mut painter = painter(engine, &lit, work.options, &film, work.samples, work.pool, work.observer);
        has_places(&film, &painter)?;
        handed.give(&mut painter);
        if film.unfinished.is_some() {
            // As above.
            painter.prepare(&pass);
            work.pool.forget_counters();
        }
        let goes_on = work.add(&mut film, &mut painter, pass);
        handed.take(&mut painter);
        if !goes_on {
            break;
        }
        work.offer_state(&film);
    }
    Ok(film)
}

/// Takes up a film where it was left, if it fits. Whether pixels share, and rays are aimed, is told of the scene as it
/// is when the shutter opens.
fn take_up(scene: &Scene, film: &mut Film, work: &Work<'_>, kernels: &Kernels) -> Result<(), Misfit> {
    let (engine, lit) = (Engine::new(scene, kernels), lit(scene, film));
    let painter = painter(engine, &lit, work.options, film, work.samples, work.pool, work.observer);
    let (reuse, caustics) = (painter.reuses(), painter.aims());
    if film.is_begun() {
        fits("reuse", film.reuse == reuse)?;
        fits("caustics", film.caustics == caustics)?;
    }
    (film.reuse, film.caustics) = (reuse, caustics);
    Ok(())
}
