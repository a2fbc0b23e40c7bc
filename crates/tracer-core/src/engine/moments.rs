//! A scene in which something moves while the shutter is open: each sample index sees a scene of its own, and is a pass
//! of its own. One of them is in memory at a time.
//!
//! Techniques are planned anew for each, since what they know of lights and surfaces is of that scene. Only what takes
//! long and need not be exact is handed on ([`Technique::hand_on`](super::technique::Technique::hand_on)): guides.

use super::passes::{Painter, Passes};
use super::technique::Engine;
use super::{Misfit, Work, fits, has_places, painter};
use crate::film::Film;
use crate::scene::Scene;
use scene_format::Diagnostics;
use std::any::Any;
use std::collections::BTreeMap;
use tracer_kernels::engine::kernels::Kernels;

/// What techniques hand on, by their names.
#[derive(Default)]
pub(super) struct Handed(BTreeMap<&'static str, Box<dyn Any + Send>>);

impl Handed {
    /// Takes what the techniques have for others.
    fn take(&mut self, painter: &mut Painter<'_>) {
        for technique in &mut painter.techniques {
            if let Some(handed) = technique.hand_on() {
                self.0.insert(technique.name(), handed);
            }
        }
    }

    /// Gives it to techniques that are made ready next.
    pub fn give(&mut self, painter: &mut Painter<'_>) {
        for technique in &mut painter.techniques {
            if let Some(handed) = self.0.remove(technique.name()) {
                technique.take_over(handed);
            }
        }
    }
}

/// The scene as a sample index sees it; this one where nothing moves.
pub(super) fn seen(scene: &Scene, film: &Film, sample: u32) -> Option<Result<Scene, Diagnostics>> {
    scene.at_sample(sample, film.seed())
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
        let asked = painter(Engine { scene, kernels }, work.options, film, work.samples, work.pool, work.observer);
        asked.techniques.iter().map(|technique| technique.made_at(sample)).find(|&before| before != sample)
    };
    let mut handed = Handed::default();
    let now = seen(scene, film, sample).transpose()?;
    if let Some(before) = planned(now.as_ref().unwrap_or(scene)) {
        drop(now);
        let then = seen(scene, film, before).transpose()?;
        let engine = Engine { scene: then.as_ref().unwrap_or(scene), kernels };
        let mut painter = painter(engine, work.options, film, work.samples, work.pool, work.observer);
        painter.prepare(&(before..before + 1));
        handed.take(&mut painter);
    }
    // What was made before is made again, and counted no second time.
    work.pool.forget_counters();
    Ok(handed)
}

/// Adds the samples that a film lacks.
pub(super) fn go_on(scene: &Scene, kernels: &Kernels, mut film: Film, mut work: Work<'_>) -> Result<Film, Misfit> {
    take_up(&mut film, &work, Engine { scene, kernels })?;
    film.fault = None;
    let mut handed = match handed_before(scene, kernels, &film, &work, film.whole) {
        Ok(handed) => handed,
        Err(faults) => {
            film.fault = Some(faults);
            return Ok(film);
        }
    };
    let mut passes = Passes::new(film.whole, work.samples, 1);
    while !work.goals.are_met(&film)
        && let Some(pass) = passes.next(film.unfinished.as_ref().map(|rest| rest.end))
    {
        let now = match seen(scene, &film, pass.start).transpose() {
            Ok(now) => now,
            Err(faults) => {
                film.fault = Some(faults);
                break;
            }
        };
        let engine = Engine { scene: now.as_ref().unwrap_or(scene), kernels };
        let mut painter = painter(engine, work.options, &film, work.samples, work.pool, work.observer);
        has_places(&film, &painter)?;
        handed.give(&mut painter);
        if film.unfinished.is_some() {
            // As above.
            painter.prepare(&pass);
            work.pool.forget_counters();
        }
        let end = pass.end;
        let goes_on = work.add(&mut film, &mut painter, pass);
        handed.take(&mut painter);
        if film.unfinished.is_none() {
            // Where there was no way for light paths at this moment, they have brought nothing.
            film.light_samples = end;
        }
        if !goes_on {
            break;
        }
        work.offer_state(&film);
    }
    Ok(film)
}

/// Takes up a film where it was left, if it fits. Whether pixels share, and rays are aimed, is told of the scene as it
/// is when the shutter opens.
fn take_up(film: &mut Film, work: &Work<'_>, engine: Engine<'_>) -> Result<(), Misfit> {
    let painter = painter(engine, work.options, film, work.samples, work.pool, work.observer);
    let pass = painter.pass();
    let (reuse, caustics) = (pass.reuse, pass.guide.is_some());
    if film.is_begun() {
        fits("reuse", film.reuse == reuse)?;
        fits("caustics", film.caustics == caustics)?;
    }
    (film.reuse, film.caustics) = (reuse, caustics);
    Ok(())
}
