//! The path engine: batches of paths through stages, over lanes, on all cores.
//!
//! A pass adds a range of sample indices to every pixel of the picture, block by block ([`grid`]). Blocks are independent and a pixel's sum
//! is exact ([`crate::film`]), so threads take batches in any order and the film is the same.

mod batch;
mod glints;
mod grid;
mod guide;
#[allow(unsafe_code)]
mod kernels;
mod lane_io;
mod light_paths;
mod passes;
mod stages;
mod statistics;
mod trace;

pub use batch::Counters;
pub(crate) use batch::LayerSamples;
pub(crate) use stages::{lights, materials::Bsdf, surface::Surface};
pub use statistics::{Costs, Stage, Statistics, TreeWork};

use crate::film::{Cells, Crop, Film, FilmState, Part};
use crate::layers::LayerSet;
use crate::level::Level;
use crate::sampling::blocks::{BLOCK_PIXELS, Block, ITEM_PIXELS, Item, QUARTERS, TILE};
use crate::sampling::sampler::hash3;
use crate::scene::{Scene, Sharing};
use batch::{Batch, ITEMS};
use glints::Glints;
use grid::Grid;
use guide::Guides;
use guide::plan::Plan;
use kernels::Kernels;
use light_paths::LightPaths;
use passes::{Painter, Passes};
use std::ops::ControlFlow;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// What a caller may decide about a rendering; `None` and zero take what the scene says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RenderOptions {
    /// Samples per pixel.
    pub samples: Option<u32>,
    /// Seed of all random choices.
    pub seed: Option<u32>,
    /// The part of the picture to render; the same bytes as that part of the whole.
    pub crop: Option<Crop>,
    /// A part of the rendering, to be merged with the others later ([`Film::merge`]): its crop and samples are then those of the rendering. Goals
    /// of the scene (noise, time) are for whole renderings, and do not count.
    pub part: Option<Part>,
    /// Worker threads; 0: one per core.
    pub threads: usize,
    /// The vector instructions of stages and tree; the bytes are the same for all.
    pub level: Option<Level>,
    /// Whether the pixels of a block share what they find.
    pub reuse: Option<bool>,
    /// Whether photons tell where rays are aimed, so that they find lights over mirrors and glass.
    pub caustics: Option<bool>,
    /// The most that the largest channel of a sample counts, in W/(sr m^2): what is above is scaled down to it as a whole. A sample is
    /// all that a pixel gets at one sample index, its part of what others have found included; what one light path brings to a pixel is
    /// scaled by itself. What is not a finite number above zero is no limit.
    pub clamp: Option<f32>,
    /// The rendering ends as soon as [`Film::relative_noise`] is no more than this, with fewer samples than are asked for. It is looked at where
    /// all pixels have 16 samples, at every power of two, and from 64 on at every multiple of 64: so the picture depends on
    /// nothing but the scene.
    pub noise: Option<f64>,
    /// The rendering ends then, as an observer would end it; not before every pixel has a sample.
    pub until: Option<Instant>,
    /// What is kept of what camera rays hit first, beside the picture ([`Film::layer`]).
    pub layers: Option<LayerSet>,
    /// Whether to keep [`Statistics`].
    pub statistics: bool,
    /// Passes are made no longer than this, as far as those before tell, so that [`Observer::state`] comes often: it comes between passes only.
    /// The picture does not depend on it.
    pub longest_pass: Option<Duration>,
}

/// Samples per pixel at which a noise goal is looked at first: with fewer, what is rare has not been found, and does not count.
const FIRST_LOOK: u32 = 16;

/// Whether a noise goal is looked at where all pixels have so many samples.
fn is_looked_at(samples: u32) -> bool {
    samples >= FIRST_LOOK && (samples.is_power_of_two() || samples.is_multiple_of(passes::LOOKS))
}

/// Why a film cannot be gone on with ([`resume`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
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

/// Under a background pixels share in all blocks where such a share of the paths has a second vertex, as in rooms with a window, in none where
/// it is [`OUTDOORS`] or less, and in a part of the blocks between, so that pictures of a sequence, or of other seeds, do not differ in
/// kind. What a ray sees where it leaves the scene is its own pixel's; outdoors to share never paid (docs/noise.md).
const INDOORS: f32 = 0.9;
const OUTDOORS: f32 = 0.6;

/// How far a rendering is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Camera samples done.
    pub samples_done: u64,
    /// Camera samples in all.
    pub samples_total: u64,
}

/// Who watches a rendering, and may end it. Called from worker threads.
pub trait Observer: Sync {
    /// Called after each batch. `Break` ends the rendering; the film keeps what is done.
    fn progress(&self, progress: Progress) -> ControlFlow<()>;
    /// Called between passes with the film so far: every pixel holds the same samples.
    fn pass(&self, _film: &Film) {}
    /// Asked between passes, after [`Observer::pass`]: whether the film is wanted as it is now, to be kept while the rendering goes on.
    fn wants_state(&self) -> bool {
        false
    }
    /// Gives it, if it was wanted. It becomes whole in the next pass, so it must be written by a thread of its own.
    fn state(&self, _state: FilmState) {}
}

/// Renders without being watched.
pub struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Renders the scene: the third hand, `Scene` to [`Film`]. It cannot fail; an observer can end it early.
pub fn render(scene: &Scene, options: &RenderOptions, observer: &dyn Observer) -> Film {
    let film = new_film(scene, options);
    go_on(scene, options, film, observer).unwrap_or_else(|misfit| unreachable!("a new film: {misfit}"))
}

/// Goes on with a film that [`render`] made, in this process or in one before ([`Film::load`]): in the end it is the one that would have been
/// made at once. More samples may be asked for than then, also where it had all of them.
///
/// # Errors
/// When the film is not one of this scene with these options, as far as the film tells: what is in the scene is for the caller to compare.
/// When it has more samples than are asked for.
pub fn resume(scene: &Scene, options: &RenderOptions, film: Film, observer: &dyn Observer) -> Result<Film, Misfit> {
    let fresh = new_film(scene, options);
    fits("set of samples", !film.has_gaps())?;
    fits("size", film.size() == fresh.size())?;
    fits("crop", film.crop() == fresh.crop())?;
    fits("part", film.part() == fresh.part())?;
    fits("seed", film.seed() == fresh.seed())?;
    fits("clamp", film.clamp == fresh.clamp)?;
    fits("set of layers", film.has_layers_of(&fresh))?;
    fits("range of brightness", film.has_unit_of(&fresh))?;
    let samples = samples(scene, options);
    let held = film.unfinished.as_ref().map_or(film.whole, |rest| rest.end);
    if samples < held {
        return Err(Misfit::Samples { held, asked: samples });
    }
    go_on(scene, options, film, observer)
}

fn fits(what: &'static str, same: bool) -> Result<(), Misfit> {
    if same { Ok(()) } else { Err(Misfit::Setting(what)) }
}

/// A film without samples.
fn new_film(scene: &Scene, options: &RenderOptions) -> Film {
    let crop =
        options.part.map(|part| part.crop).or(options.crop).unwrap_or(Crop::whole(scene.size)).within(scene.size);
    let clamp = options.clamp.or(scene.clamp).filter(|&limit| limit > 0.0 && limit.is_finite());
    let mut film = Film::new(scene.size, crop, options.seed.unwrap_or(scene.seed), scene.radiance_unit, clamp);
    film.keep_layers(options.layers.unwrap_or(scene.layers), scene);
    film.keep_part(options.part);
    film
}

/// The sample index that a rendering ends before.
fn samples(scene: &Scene, options: &RenderOptions) -> u32 {
    options.part.map(|part| part.end).or(options.samples).unwrap_or(scene.samples)
}

/// Adds the samples that a film lacks.
fn go_on(scene: &Scene, options: &RenderOptions, mut film: Film, observer: &dyn Observer) -> Result<Film, Misfit> {
    let level = options.level.unwrap_or_else(Level::best);
    let kernels = Kernels::new(level);
    let samples = samples(scene, options);
    let crop = film.crop();
    let threads = if options.threads == 0 { available_threads() } else { options.threads };
    (film.level, film.threads) = (level, threads);
    film.statistics = options.statistics.then(Statistics::default);
    let resumed = film.is_begun();
    if resumed && film.unfinished.is_none() && film.whole >= samples {
        return Ok(film);
    }
    let mut pass_options = trace::Pass {
        seed: film.seed(),
        reuse: false,
        lanes: level.lanes(),
        guide: None,
        light_paths: None,
        task: trace::Task::Picture,
        layers: LayerSet::default(),
    };
    let samples_total =
        u64::from(crop.width) * u64::from(crop.height) * u64::from(samples.saturating_sub(film.first()));
    let workers: Vec<Mutex<Worker>> = (0..threads).map(|_| Mutex::new(Worker::new())).collect();
    for worker in &workers {
        lock(worker).batch.watch.start(options.statistics);
    }
    let share_of_blocks = share_of_blocks(scene, options, samples_total > 0, &kernels, pass_options, &workers);
    pass_options.reuse = share_of_blocks > 0.0;
    let wants_guide = options.caustics.unwrap_or(scene.caustics) && samples_total > 0;
    let plan = if wants_guide { Plan::new(scene, pass_options.seed) } else { None };
    let mut guides = plan.as_ref().map(|plan| Guides::new(scene, plan, pass_options.seed));
    let light_paths = plan.as_ref().and_then(|plan| Some((LightPaths::new(scene, plan, pass_options.seed)?, plan)));
    let glints = match &guides {
        Some(_) => glints::pilot(scene, &kernels, pass_options, crop, &workers),
        None => Glints::default(),
    };
    let grid = Grid::new(crop, pass_options.seed, pass_options.reuse);
    if resumed {
        fits("reuse", film.reuse == pass_options.reuse)?;
        fits("caustics", film.caustics == guides.is_some())?;
        let pieces = film.unfinished.as_ref().map_or(&[][..], |rest| &rest.pieces);
        fits("division into blocks", pieces.iter().all(|piece| piece.places.end as usize <= grid.len()))?;
    }
    if let Some(last) = film.unfinished.as_ref().map_or(film.whole, |rest| rest.end).checked_sub(1) {
        // What was made before is made again, and counted no second time.
        if let Some(guides) = &mut guides {
            guides.prepare(scene, &kernels, &(last..last + 1), &workers);
        }
        workers.iter().for_each(|worker| lock(worker).batch.counters = Counters::default());
    }
    (film.reuse, film.caustics) = (pass_options.reuse, guides.is_some());
    let before = (film.counters, film.costs);
    let done = AtomicU64::new(if resumed { film.camera_samples() } else { 0 });
    let stopped = AtomicBool::new(false);
    let of_scene = options.part.is_none();
    let noise = options.noise.or(scene.noise.filter(|_| of_scene));
    // A time that no clock can hold is none.
    let time = scene.time.filter(|_| of_scene).and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    let until = options.until.or_else(|| Instant::now().checked_add(time?));
    let mut passes = Passes::new(film.whole, samples, 16 * SAMPLES).looking(noise.is_some());
    let mut keeper = None;
    let is_good = |film: &Film| {
        film.unfinished.is_none() && is_looked_at(film.whole) && noise.is_some_and(|goal| film.relative_noise() <= goal)
    };
    while !is_good(&film)
        && let Some(pass) = passes.next(film.unfinished.as_ref().map(|rest| rest.end))
    {
        let started = Instant::now();
        if let Some(guides) = &mut guides {
            guides.prepare(scene, &kernels, &pass, &workers);
        }
        let painter = Painter {
            scene,
            kernels: &kernels,
            options: trace::Pass {
                guide: guides.as_ref().map(Guides::guide),
                light_paths: light_paths.as_ref().map(|(light_paths, plan)| (light_paths, *plan)),
                layers: film.layers(),
                ..pass_options
            },
            statistics: options.statistics,
            limit: film.clamp.map(|limit| f64::from(limit) / scene.radiance_unit),
            glints: &glints,
            grid: &grid,
            share_of_blocks,
            observer,
            samples_total,
            until: until.filter(|_| film.whole > film.first()),
            done: &done,
            stopped: &stopped,
        };
        let left = painter.paint(&mut film, pass.clone(), keeper.take(), &workers);
        gather(&mut film, before, options.statistics, &workers);
        film.unfinished = left;
        if film.unfinished.is_none() {
            film.whole = pass.end;
        }
        if stopped.load(Ordering::Relaxed) {
            break;
        }
        observer.pass(&film);
        passes.took(started.elapsed(), options.longest_pass);
        if film.whole < samples && observer.wants_state() {
            let (end, state) = film.state();
            keeper = Some(end);
            observer.state(state);
        }
    }
    Ok(film)
}

/// Puts what the workers have counted on the film, beside what it had before.
fn gather(film: &mut Film, before: (Counters, Costs), statistics: bool, workers: &[Mutex<Worker>]) {
    (film.counters, film.costs) = before;
    let mut sums = Statistics::default();
    for worker in workers {
        let Batch { counters, watch, .. } = &lock(worker).batch;
        film.counters.add(counters);
        sums.add(&watch.statistics);
        film.costs.add(&watch.costs);
    }
    film.statistics = statistics.then_some(sums);
}

/// The share of the blocks whose pixels share.
fn share_of_blocks(
    scene: &Scene,
    options: &RenderOptions,
    has_samples: bool,
    kernels: &Kernels,
    pass: trace::Pass<'_>,
    workers: &[Mutex<Worker>],
) -> f32 {
    let sharing = match options.reuse {
        None => scene.reuse,
        Some(true) => Sharing::Always,
        Some(false) => Sharing::Never,
    };
    match sharing {
        Sharing::Always => 1.0,
        Sharing::Never => 0.0,
        Sharing::Indoors => {
            let has_second = if has_samples { second_vertices(scene, kernels, pass, workers) } else { 0.0 };
            ((has_second - OUTDOORS) / (INDOORS - OUTDOORS)).clamp(0.0, 1.0)
        }
    }
}

/// Whether the pixels of the block of a tile share at a sample index: so large a share of the blocks does, by chance.
fn shares(seed: u32, tile: [i32; 2], sample: u32, share: f32) -> bool {
    let salt = hash3(seed, sample, 0x05ba_5e55) as u32;
    ((hash3(salt, tile[0] as u32, tile[1] as u32) >> 40) as f32) < share * (1u32 << 24) as f32
}

/// The share of a trial's paths that have a second vertex. It depends on scene and seed alone.
fn second_vertices(scene: &Scene, kernels: &Kernels, pass: trace::Pass<'_>, workers: &[Mutex<Worker>]) -> f32 {
    // Choices of its own: whether pixels share must not depend on the very paths that do.
    let pass = trace::Pass { reuse: true, seed: hash3(pass.seed, 0, 0x001d_17ee) as u32, ..pass };
    let [across, down] = scene.size.map(|size| size.div_ceil(TILE));
    let all = u64::from(across) * u64::from(down) * u64::from(QUARTERS);
    let count = (ITEMS as u64).min(all);
    let found = each(workers, 1, |_, worker| {
        let batch = &mut worker.batch;
        batch.watch.resume();
        let start = Instant::now();
        let before = (batch.counters, batch.watch.costs);
        batch.items.clear();
        for k in 0..count {
            // One of the k-th of equal shares of all quarters.
            let (first, end) = (all * k / count, all * (k + 1) / count);
            let quarter = first + hash3(pass.seed, 0x001d_17ed, k as u32) % (end - first);
            let (tile, quarter) = ((quarter / u64::from(QUARTERS)) as u32, (quarter % u64::from(QUARTERS)) as u32);
            let block = Block::straight([tile % across, tile / across].map(|tile| tile as i32));
            batch.items.push(Item { block, quarter, sample: 0 });
        }
        batch.glints = 0;
        batch.shares = u32::MAX;
        batch.start();
        kernels.camera(scene, pass.seed, u32::MAX, batch);
        for vertex in 0..=scene.max_bounces {
            trace::bounce(scene, kernels, pass, vertex, batch);
        }
        (batch.counters, batch.watch.costs) = before;
        batch.watch.costs.reuse += start.elapsed().as_secs_f64();
        batch.watch.lap(Stage::Share);
        batch.suffixes.len
    });
    found[0] as f32 / (count as usize * ITEM_PIXELS) as f32
}

/// The slots of the block whose first item this is.
pub(crate) fn slots_of_block(first: usize) -> Range<usize> {
    first * ITEM_PIXELS..first * ITEM_PIXELS + BLOCK_PIXELS
}

/// Adds the samples of a batch to the film; how many they are.
fn add_samples(cells: &Cells<'_>, batch: &mut Batch) -> u64 {
    let mut added = 0;
    for first in (0..batch.items.len()).step_by(QUARTERS as usize) {
        let slots = slots_of_block(first);
        cells.each(&batch.pixels, slots.start, |tile, common| {
            let samples = batch.radiance.each_ref().map(|channel| &channel[slots.clone()]);
            let left_out = tile.add(samples, common);
            batch.counters.dropped += left_out.dropped;
            batch.counters.beyond += left_out.beyond;
            tile.add_layers(&batch.layers, first, common);
            added += common.len() as u64;
        });
    }
    added
}

/// Clamps the samples of a batch before they are added. A pass of its own, so that its time is known and nothing is asked where none is
/// wanted.
fn clamp_samples(limit: f64, cells: &Cells<'_>, batch: &mut Batch) {
    let start = Instant::now();
    for first in (0..batch.items.len()).step_by(QUARTERS as usize) {
        let slots = slots_of_block(first);
        cells.each(&batch.pixels, slots.start, |tile, common| {
            let samples = batch.radiance.each_mut().map(|channel| &mut channel[slots.clone()]);
            tile.clamp(limit, samples, common);
        });
    }
    batch.watch.costs.clamp += start.elapsed().as_secs_f64();
}

/// Samples of a block that fill a batch.
const SAMPLES: u32 = ITEMS as u32 / QUARTERS;

/// A thread's memory.
struct Worker {
    batch: Batch,
}

impl Worker {
    fn new() -> Self {
        Worker { batch: Batch::new() }
    }
}

/// Has all workers do a work, each on a thread of its own.
fn on_all(workers: &[Mutex<Worker>], work: &(impl Fn(&mut Worker) + Sync)) {
    if let [worker] = workers {
        work(&mut lock(worker));
    } else {
        std::thread::scope(|scope| {
            for worker in workers {
                scope.spawn(|| work(&mut lock(worker)));
            }
        });
    }
}

/// Has the workers do pieces 0 .. `count` of a work, whoever is free the next one; the results in the order of the pieces.
fn each<T: Send>(workers: &[Mutex<Worker>], count: usize, work: impl Fn(usize, &mut Worker) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::with_capacity(count));
    on_all(workers, &|worker: &mut Worker| {
        let mut mine = Vec::new();
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            if k >= count {
                break;
            }
            mine.push((k, work(k, worker)));
        }
        results.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).append(&mut mine);
    });
    let mut results = results.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
    results.sort_by_key(|&(k, _)| k);
    results.into_iter().map(|(_, result)| result).collect()
}

fn lock(worker: &Mutex<Worker>) -> std::sync::MutexGuard<'_, Worker> {
    worker.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
