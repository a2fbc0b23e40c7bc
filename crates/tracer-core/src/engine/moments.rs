//! A scene in which something moves while the shutter is open: each quarter of the pixels of a sample index sees a
//! scene of its own ([`Scene::at_sample`]); all of them the same where that takes long to compile. One of them is in
//! memory at a time, and what is to tell how things move of two more. A sample index is a pass; its quarters are
//! painted one after the other.
//!
//! Pixels of a quarter share what they find, as always, and those of one quarter at one sample index are of others at
//! the next. Were there one moment for all pixels, sixteen samples would show sixteen ghosts of what moves fast.
//!
//! Techniques are planned anew for each, since what they know of lights and surfaces is of that scene. Only what takes
//! long and need not be exact is handed on ([`Technique::hand_on`](super::technique::Technique::hand_on)): guides.

use super::passes::{Painter, Passes};
use super::technique::Engine;
use super::techniques::made_at;
use super::{Misfit, Work, fits, has_places, lit, painter};
use crate::film::{Film, Piece, Plan, Unfinished};
use crate::scene::Scene;
use scene_format::Diagnostics;
use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;
use tracer_kernels::engine::kernels::Kernels;
use tracer_kernels::layers::Layer;
use tracer_kernels::sampling::blocks::QUARTERS;
use tracer_kernels::scene::{End, Ends};

/// What techniques hand on, by the light group that they are of and by their names.
#[derive(Default)]
pub(super) struct Handed(BTreeMap<(usize, &'static str), Box<dyn Any + Send>>);

impl Handed {
    /// Takes what the techniques have for others; after the first quarter only what was given to them, so that it does
    /// not matter in which quarter a rendering begins.
    fn take(&mut self, painter: &mut Painter<'_>, given: &BTreeSet<(usize, &'static str)>) {
        let is_first = painter.quarter.is_none_or(|quarter| quarter == 0);
        for (group, technique) in painter.techniques() {
            let key = (group, technique.name());
            if let Some(handed) = technique.hand_on().filter(|_| is_first || given.contains(&key)) {
                self.0.insert(key, handed);
            }
        }
    }

    /// Gives it to techniques that are made ready next; which it was given to.
    pub fn give(&mut self, painter: &mut Painter<'_>) -> BTreeSet<(usize, &'static str)> {
        let mut given = BTreeSet::new();
        for (group, technique) in painter.techniques() {
            let key = (group, technique.name());
            if let Some(handed) = self.0.remove(&key) {
                technique.take_over(handed);
                given.insert(key);
            }
        }
        given
    }
}

/// The scene as a sample index, or a quarter of its pixels, sees it; this one where nothing moves.
fn seen(scene: &Scene, film: &Film, sample: u32, quarter: Option<u32>) -> Option<Result<Scene, Diagnostics>> {
    scene.at_sample(sample, quarter, film.seed())
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

/// What the techniques of a quarter of a sample index are handed by those before, made as it was then.
pub(super) fn handed_before(
    scene: &Scene,
    kernels: &Kernels,
    film: &Film,
    work: &Work<'_>,
    (sample, quarter): (u32, Option<u32>),
) -> Result<Handed, Diagnostics> {
    let mut handed = Handed::default();
    let before = made_at(scene, sample);
    if before != sample || quarter.is_some_and(|quarter| quarter > 0) {
        let first = quarter.and(Some(0));
        let then = seen(scene, film, before, first).transpose()?;
        let then = then.as_ref().unwrap_or(scene);
        let (engine, lit) = (Engine::new(then, kernels), lit(then, film));
        let mut painter = painter(engine, &lit, work.options, film, work.samples, work.pool, work.observer);
        painter.quarter = first;
        painter.prepare(&(before..before + 1));
        handed.take(&mut painter, &BTreeSet::new());
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
    match add_all(scene, kernels, &mut film, &mut work)? {
        Ok(()) => {}
        Err(faults) => film.fault = Some(faults),
    }
    Ok(film)
}

/// Adds them, quarter by quarter; within, what is wrong with the scene as one of them sees it.
fn add_all(
    scene: &Scene,
    kernels: &Kernels,
    film: &mut Film,
    work: &mut Work<'_>,
) -> Result<Result<(), Diagnostics>, Misfit> {
    let all: Vec<_> = if film.moments == QUARTERS { (0..QUARTERS).map(Some).collect() } else { vec![None] };
    // What is left of a sample index is so much of its places.
    let left = film.unfinished.as_ref().and_then(|rest| rest.pieces.first().map(|piece| piece.places.clone()));
    let begun = left.map_or(0, |left| left.start as usize * all.len() / left.end.max(1) as usize);
    let mut first = begun.min(all.len() - 1);
    let handed = handed_before(scene, kernels, film, work, (film.whole, all[first])).and_then(|handed| {
        let ends = ends(scene, film)?;
        Ok((handed, ends))
    });
    let (mut handed, ends) = match handed {
        Ok(all) => all,
        Err(faults) => return Ok(Err(faults)),
    };
    let mut passes = Passes::new(film.whole, work.samples, 1).planned(work.plan);
    while !work.goals.are_met(film)
        && let Some(pass) = passes.next(film.unfinished.as_ref().map(|rest| rest.end))
    {
        for &quarter in &all[std::mem::take(&mut first)..] {
            let mut now = match seen(scene, film, pass.start, quarter).transpose() {
                Ok(now) => now,
                Err(faults) => return Ok(Err(faults)),
            };
            if let Some(now) = &mut now {
                now.rendered.ends.clone_from(&ends);
            }
            let now = now.as_ref().unwrap_or(scene);
            let (engine, lit) = (Engine::new(now, kernels), lit(now, film));
            let mut painter = painter(engine, &lit, work.options, film, work.samples, work.pool, work.observer);
            painter.quarter = quarter;
            has_places(film, &painter)?;
            let is_over = |plan: Plan| plan.whole == pass.start && plan.blocks <= painter.places_now().start;
            if quarter.is_some() && work.plan.is_some_and(is_over) {
                // A plan of nothing but the samples before. Its painter's trials are made and counted another time.
                film.unfinished = Some(nothing_done(&painter, pass));
                return Ok(Ok(()));
            }
            let given = handed.give(&mut painter);
            let left =
                film.unfinished.as_ref().map(|rest| rest.pieces.first().map_or(u32::MAX, |piece| piece.places.start));
            // Before a quarter begins all of it is left.
            if left.is_some_and(|left| quarter.is_none() || left > painter.places_now().start) {
                // What was made before is made again, and counted no second time.
                painter.prepare(&pass);
                work.pool.forget_counters();
            }
            let goes_on = work.add(film, &mut painter, pass.clone());
            handed.take(&mut painter, &given);
            if !goes_on {
                return Ok(Ok(()));
            }
        }
        work.offer_state(film);
    }
    Ok(Ok(()))
}

/// All places of a pass are left.
fn nothing_done(painter: &Painter<'_>, pass: Range<u32>) -> Unfinished {
    Unfinished { end: pass.end, pieces: vec![Piece { places: 0..painter.places(), samples: pass }] }
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
