//! The path engine: batches of paths through stages, over lanes, on all cores.
//!
//! A pass adds a range of sample indices to every pixel of the picture, block by block ([`grid`]). Blocks are
//! independent and a pixel's sum is exact ([`crate::film`]), so threads take batches in any order and the film is the
//! same.

mod adaptive;
mod counting;
mod deal;
mod direct;
mod grid;
mod inspect;
mod lighting;
mod moments;
mod observer;
mod options;
mod passes;
mod technique;
mod techniques;
mod trace;
mod watcher;

pub use inspect::{
    Brought, Ended, Inspection, LightOf, MetTold, PathTold, Roulette, SampledTold, Scattering, Shared, Told,
    VertexTold, Whole, inspect,
};
pub use observer::{Observer, Progress, Unobserved};
pub use options::RenderOptions;

use crate::film::{Crop, Film, FilmGroups, Keeper, Plan, Unfinished};
use crate::scene::Scene;
use adaptive::Quiet;
use grid::Grid;
use lighting::Lighting;
use passes::{Painter, Passes, SAMPLES, is_looked_at};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};
use technique::Engine;
use techniques::Trial;
use tracer_kernels::engine::kernels::Kernels;
use tracer_kernels::engine::pass::{Pass, Task};
use tracer_kernels::engine::pool::{Counted, Pool};
use tracer_kernels::layers::Layer;
use tracer_kernels::level::Level;
use tracer_kernels::sampling::blocks::QUARTERS;
use tracer_kernels::scene::Integrator;

/// Why a film cannot be gone on with ([`resume`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Misfit {
    /// It was made with another setting: which.
    #[error("the film was made with another {0}")]
    Setting(&'static str),
    /// There is less to do than has been done.
    #[error("the film has {held} samples per pixel, or is on the way to them; {asked} are asked for")]
    Samples {
        /// Samples per pixel that it has, or will have when the pass that was ended early is whole.
        held: u32,
        /// Samples per pixel that are asked for.
        asked: u32,
    },
}

/// Renders the scene: the third hand, `Scene` to [`Film`]. It cannot fail; an observer can end it early. Where
/// something moves while the shutter is open, each quarter of a sample index sees a scene of its own
/// ([`Scene::at_sample`]), and what is wrong with one of these ends it early, too ([`Film::fault`]).
pub fn render(scene: &Scene, options: &RenderOptions, observer: &dyn Observer) -> Film {
    let film = new_film_of(scene, options);
    go_on(scene, options, film, observer).unwrap_or_else(|misfit| unreachable!("a new film: {misfit}"))
}

/// Goes on with a film that [`render`] made, in this process or in one before ([`Film::load`]): in the end it is the
/// one that would have been made at once. More samples may be asked for than then, also where it had all of them.
///
/// # Errors
/// When the film is not one of this scene with these options, as far as the film tells: what is in the scene is for the
/// caller to compare. When it has more samples than are asked for.
pub fn resume(scene: &Scene, options: &RenderOptions, film: Film, observer: &dyn Observer) -> Result<Film, Misfit> {
    let fresh = new_film_of(scene, options);
    fits("set of samples", !film.has_gaps())?;
    fits("size", film.size() == fresh.size())?;
    fits("crop", film.crop() == fresh.crop())?;
    fits("part", film.part() == fresh.part())?;
    // What is done beyond a plan cannot be taken back, nor is it known what of its last pass is.
    let is_before = |plan: Plan| film.unfinished.is_none() && film.whole <= plan.whole;
    fits("end", plan(options).is_none_or(is_before))?;
    fits("seed", film.seed() == fresh.seed())?;
    fits("clamp", film.clamp == fresh.clamp)?;
    // Both need layers of their own, so they come before those.
    fits("backdrop", film.has_backdrop() == fresh.has_backdrop())?;
    fits("choice of mattes", film.mattes() == fresh.mattes())?;
    fits("set of light groups", film.light_groups() == fresh.light_groups())?;
    fits("set of layers", film.has_layers_of(&fresh))?;
    fits("choice of halves", film.has_halves() == fresh.has_halves())?;
    fits("range of brightness", film.has_unit_of(&fresh))?;
    fits("choice of adaptive sampling", adaptive::fits(scene, options, &film))?;
    let samples = samples(scene, options);
    let held = film.unfinished.as_ref().map_or(film.whole, |rest| rest.end);
    if samples < held {
        return Err(Misfit::Samples { held, asked: samples });
    }
    go_on(scene, options, film, observer)
}

/// Of which quarter of the pixels one is at a sample index, 0 to 3, where these see moments of their own
/// ([`Scene::at_sample`]); `None` where they do not.
pub fn quarter_of(scene: &Scene, pixel: [u32; 2], sample: u32, seed: u32) -> Option<u32> {
    let crop = Crop { x: pixel[0], y: pixel[1], width: 1, height: 1 };
    let quarter = || Grid::new(crop, seed, true).quarter(pixel, sample);
    if scene.moments_of_sample() == QUARTERS { quarter() } else { None }
}

fn fits(what: &'static str, same: bool) -> Result<(), Misfit> {
    if same { Ok(()) } else { Err(Misfit::Setting(what)) }
}

/// A film without samples, which keeps the scene's light groups apart unless the caller says otherwise.
fn new_film_of(scene: &Scene, options: &RenderOptions) -> Film {
    let mut film = new_film(scene, options);
    if let Some(groups) = scene.light_groups.as_ref().filter(|_| options.light_groups != Some(false)) {
        film.keep_groups(FilmGroups { names: groups.names.clone(), of_background: groups.of_background });
    }
    film
}

/// The scene once for each light group that a film keeps apart; none where it keeps none.
fn lit(scene: &Scene, film: &Film) -> Vec<tracer_kernels::scene::Scene> {
    let groups = scene.light_groups.as_ref().filter(|_| !film.light_groups().is_empty());
    groups.map(|groups| groups.lit(scene)).unwrap_or_default()
}

/// A film without samples.
fn new_film(scene: &tracer_kernels::scene::Scene, options: &RenderOptions) -> Film {
    let crop =
        options.part.map(|part| part.crop).or(options.crop).unwrap_or(Crop::whole(scene.size)).within(scene.size);
    let clamp = options.clamp.or(scene.clamp).filter(|&limit| limit > 0.0 && limit.is_finite());
    let mut film = Film::new(scene.size, crop, options.seed.unwrap_or(scene.seed), scene.radiance_unit, clamp);
    film.keep_backdrop(scene.backdrop);
    let alpha = scene.backdrop.then_some(Layer::Alpha);
    film.keep_mattes(options.mattes);
    let of_mattes = options.mattes.layers();
    let layers = options.layers.unwrap_or(scene.layers);
    film.keep_layers(layers.iter().chain(alpha).chain(of_mattes.iter()).collect(), scene);
    film.keep_part(options.part);
    film.keep_halves(options.halves);
    film
}

/// The sample index that a rendering ends before.
fn samples(scene: &tracer_kernels::scene::Scene, options: &RenderOptions) -> u32 {
    let planned = plan(options).map(|plan| plan.end);
    options.part.map(|part| part.end).or(planned).or(options.samples).unwrap_or(scene.samples)
}

/// Where a whole rendering is to end within a pass.
fn plan(options: &RenderOptions) -> Option<Plan> {
    options.plan.filter(|_| options.part.is_none())
}

/// Adds the samples that a film lacks.
fn go_on(scene: &Scene, options: &RenderOptions, mut film: Film, observer: &dyn Observer) -> Result<Film, Misfit> {
    let samples = samples(scene, options);
    film.level = options.level.unwrap_or_else(Level::best);
    film.threads = if options.threads == 0 { available_threads() } else { options.threads };
    film.statistics = options.statistics.then(Default::default);
    film.moments = scene.moments_of_sample();
    film.lie_over(scene.look.paper());
    if film.is_begun() && film.unfinished.is_none() && film.whole >= samples {
        return Ok(film);
    }
    let kernels = Kernels::new(film.level);
    let pool = Pool::new(film.threads, options.statistics);
    let engine = Engine::new(scene, &kernels);
    let before = Counted { counters: film.counters, costs: film.costs, ..Counted::default() };
    let goals = Goals::new(scene, options, &film);
    let plan = plan(options);
    let mut work =
        Work { options, observer, pool: &pool, samples, plan, moves: scene.moves(), before, goals, keeper: None };
    if scene.moves() {
        return moments::go_on(scene, &kernels, film, work);
    }
    let lit = lit(scene, &film);
    let mut painter = painter(engine, &lit, options, &film, samples, &pool, observer);
    take_up(&mut film, &mut painter)?;
    let passes = Passes::new(film.whole, samples, 16 * SAMPLES).planned(plan);
    let mut passes = passes.looking(work.goals.noise.is_some());
    painter.keep_adaptive(&film, &mut passes);
    while !work.goals.are_met(&film)
        && film.whole < samples
        && work.adapt(scene, &mut film, &mut painter, &mut passes)
        && let Some(pass) = passes.next(film.unfinished.as_ref().map(|rest| rest.end))
    {
        let started = Instant::now();
        if !work.add(&mut film, &mut painter, pass) {
            break;
        }
        passes.took(started.elapsed(), options.longest_pass);
        work.offer_state(&film);
    }
    Ok(film)
}

/// What a rendering does pass by pass.
struct Work<'a> {
    options: &'a RenderOptions,
    observer: &'a dyn Observer,
    pool: &'a Pool,
    /// The sample index that it ends before.
    samples: u32,
    /// Where it ends within a pass.
    plan: Option<Plan>,
    /// Each sample index sees a scene of its own.
    moves: bool,
    /// What was counted before.
    before: Counted,
    goals: Goals,
    keeper: Option<Keeper>,
}

impl Work<'_> {
    /// Adds a pass, or what is left of it; whether the rendering goes on.
    fn add(&mut self, film: &mut Film, painter: &mut Painter<'_>, pass: Range<u32>) -> bool {
        painter.until = self.goals.until.filter(|_| film.whole > film.first());
        painter.prepare(&pass);
        let plan = self.plan.filter(|plan| plan.whole == pass.start);
        let blocks = painter.grid.len() as u32;
        match &plan {
            Some(plan) if painter.quarter.is_some() => painter.last_place = plan.blocks,
            Some(plan) => {
                film.unfinished = Some(plan.pieces(blocks));
                painter.light_until = plan.light;
            }
            None => {}
        }
        film.unfinished = painter.paint(film, pass.clone(), self.keeper.take());
        if let Some(left) = plan.filter(|_| painter.quarter.is_none()).and_then(|plan| plan.left(blocks)) {
            let rest = film.unfinished.get_or_insert(Unfinished { end: left.end, pieces: Vec::new() });
            rest.pieces.extend(left.pieces);
        }
        note(film, &self.before, &self.pool.counted());
        if film.unfinished.is_none() {
            film.whole = pass.end;
            if self.moves {
                // Where there was no way for light paths at this moment, they have brought nothing.
                film.light_samples = pass.end;
            }
            film.end_octave();
        }
        // Of a plan there may be further quarters.
        let is_last = |plan: Plan| painter.quarter.is_none() || plan.blocks <= painter.places_now().end;
        if painter.stopped.load(Ordering::Relaxed) || plan.is_some_and(is_last) {
            return false;
        }
        if film.unfinished.is_none() {
            self.observer.pass(film);
        }
        true
    }

    /// Decides which tiles rest, where it is time for that; whether the rendering goes on.
    fn adapt(&self, scene: &Scene, film: &mut Film, painter: &mut Painter<'_>, passes: &mut Passes) -> bool {
        if !adaptive::is_due(scene, self.options, film, self.goals.noise) {
            return true;
        }
        let samples_done = painter.done.load(Ordering::Relaxed);
        let now = Progress { samples_done, samples_total: painter.samples_total };
        let observer = Quiet::new(self.observer, now);
        let Some(adaptive) = adaptive::plan(scene, self.options, film, painter.light_paths(), observer) else {
            return false;
        };
        film.keep_adaptive(Some(adaptive));
        painter.keep_adaptive(film, passes);
        true
    }

    /// Gives the film as it is to whoever wants to keep it.
    fn offer_state(&mut self, film: &Film) {
        if film.whole < self.samples && self.observer.wants_state() {
            let (end, state) = film.state();
            self.keeper = Some(end);
            self.observer.state(state);
        }
    }
}

/// What adds passes to the film, with the techniques that are worth it in this scene. `lit`: the scene once for each
/// light group that is kept apart.
fn painter<'a>(
    engine: Engine<'a>,
    lit: &'a [tracer_kernels::scene::Scene],
    options: &RenderOptions,
    film: &Film,
    samples: u32,
    pool: &'a Pool,
    observer: &'a dyn Observer,
) -> Painter<'a> {
    let crop = film.crop();
    let samples_total =
        u64::from(crop.width) * u64::from(crop.height) * u64::from(samples.saturating_sub(film.first()));
    let task = if engine.scene.integrator == Integrator::Direct { Task::Direct } else { Task::Picture };
    let plain = Pass { task, ..Pass::plain(film.seed(), film.level.lanes()) };
    let has_samples = samples_total > 0;
    let lighting = |(k, engine): (usize, Engine<'a>)| {
        let techniques = techniques::plan(Trial {
            engine,
            options,
            crop,
            has_samples,
            moves: film.moments > 0,
            pass: plain,
            pool,
            wants_guides: false,
            plan: None,
        });
        Lighting { engine, group: (!lit.is_empty()).then_some([k, lit.len()]), techniques }
    };
    let lightings = lighting::engines(engine, lit).into_iter().enumerate().map(lighting).collect();
    let mut painter = Painter {
        pool,
        plain,
        lightings,
        grid: Grid::new(crop, plain.seed, false),
        quarter: None,
        last_place: u32::MAX,
        observer,
        statistics: options.statistics,
        limit: film.clamp.map(|limit| f64::from(limit) / engine.scene.radiance_unit),
        backdrop: film.has_backdrop(),
        paper: film.paper,
        mattes: film.mattes(),
        lamps: film.place_for_halves(Layer::Emission).is_some(),
        albedo: film.place_for_halves(Layer::DenoisingAlbedo),
        adaptive: None,
        until: None,
        light_until: u32::MAX,
        done: AtomicU64::new(if film.is_begun() { film.camera_samples() } else { 0 }),
        samples_total,
        stopped: AtomicBool::new(false),
    };
    // Pixels are of other quarters at each sample index.
    painter.grid = Grid::new(crop, plain.seed, painter.reuses() || film.moments == QUARTERS);
    painter
}

/// Takes up a film where it was left, if it fits.
fn take_up(film: &mut Film, painter: &mut Painter<'_>) -> Result<(), Misfit> {
    let (reuse, caustics) = (painter.reuses(), painter.aims());
    if film.is_begun() {
        fits("reuse", film.reuse == reuse)?;
        fits("caustics", film.caustics == caustics)?;
        has_places(film, painter)?;
    }
    if let Some(last) = film.unfinished.as_ref().map_or(film.whole, |rest| rest.end).checked_sub(1) {
        // What was made before is made again, and counted no second time.
        painter.prepare(&(last..last + 1));
        painter.pool.forget_counters();
    }
    (film.reuse, film.caustics) = (reuse, caustics);
    Ok(())
}

/// Whether what is left of a pass is of blocks that there are.
fn has_places(film: &Film, painter: &Painter<'_>) -> Result<(), Misfit> {
    let places = painter.places();
    let pieces = film.unfinished.as_ref().map_or(&[][..], |rest| &rest.pieces);
    // Of quarters the rest is known by where it begins.
    let is_rest = painter.quarter.is_none() || pieces.len() == 1 && pieces[0].places.end == places;
    fits("division into blocks", pieces.is_empty() || is_rest && pieces.iter().all(|piece| piece.places.end <= places))
}

/// When a rendering ends before it has its samples.
struct Goals {
    /// The relative noise that is asked for.
    noise: Option<f64>,
    /// It is looked at from so many samples of each pixel on.
    first: u32,
    /// When it ends at the latest.
    until: Option<Instant>,
}

impl Goals {
    fn new(scene: &tracer_kernels::scene::Scene, options: &RenderOptions, film: &Film) -> Self {
        let of_scene = options.part.is_none() && plan(options).is_none();
        // A time that no clock can hold is none.
        let time = scene.time.filter(|_| of_scene).and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        Goals {
            noise: options.noise.filter(|_| plan(options).is_none()).or(scene.noise.filter(|_| of_scene)),
            first: LEAST_MOMENTS.checked_div(film.moments).unwrap_or(0),
            until: options.until.or_else(|| Instant::now().checked_add(time?)),
        }
    }

    /// Whether the noise is no more than asked for.
    fn are_met(&self, film: &Film) -> bool {
        film.unfinished.is_none()
            && film.whole >= self.first
            && is_looked_at(film.whole)
            && self.noise.is_some_and(|goal| film.relative_noise() <= goal)
    }
}

/// So many moments at least tell of what is there for a short time only.
const LEAST_MOMENTS: u32 = 64;

/// Notes on the film what was counted, beside what it had before.
fn note(film: &mut Film, before: &Counted, now: &Counted) {
    (film.counters, film.costs) = (before.counters, before.costs);
    film.counters.add(&now.counters);
    film.costs.add(&now.costs);
    if let Some(statistics) = &mut film.statistics {
        *statistics = now.statistics;
    }
}

fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
