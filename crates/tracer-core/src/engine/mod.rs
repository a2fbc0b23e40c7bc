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
mod stages;
mod statistics;
mod trace;

pub use batch::Counters;
pub use statistics::{Costs, Stage, Statistics, TreeWork};

use crate::film::{Cells, Crop, Film, Overlap};
use crate::level::Level;
use crate::sampling::sampler::hash3;
use crate::scene::{Scene, Sharing};
use batch::{Batch, ITEMS, Item, QUARTERS, TILE};
use glints::Glints;
use grid::Grid;
use guide::Guides;
use guide::plan::Plan;
use kernels::Kernels;
use light_paths::{LightPaths, OnFilm};
use std::ops::ControlFlow;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::Instant;

/// What a caller may decide about a rendering; `None` and zero take what the scene says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RenderOptions {
    /// Samples per pixel.
    pub samples: Option<u32>,
    /// Seed of all random choices.
    pub seed: Option<u32>,
    /// The part of the picture to render; the same bytes as that part of the whole.
    pub crop: Option<Crop>,
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
    /// Whether to keep [`Statistics`].
    pub statistics: bool,
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
    let level = options.level.unwrap_or_else(Level::best);
    let kernels = Kernels::new(level);
    let samples = options.samples.unwrap_or(scene.samples);
    let mut pass_options = trace::Pass {
        seed: options.seed.unwrap_or(scene.seed),
        reuse: false,
        lanes: level.lanes(),
        guide: None,
        light_paths: None,
        task: trace::Task::Picture,
    };
    let crop = options.crop.unwrap_or(Crop::whole(scene.size)).within(scene.size);
    let threads = if options.threads == 0 { available_threads() } else { options.threads };
    let clamp = options.clamp.or(scene.clamp).filter(|&limit| limit > 0.0 && limit.is_finite());
    let mut film = Film::new(scene.size, crop, pass_options.seed, scene.radiance_unit, clamp);
    let samples_total = u64::from(crop.width) * u64::from(crop.height) * u64::from(samples);
    let done = AtomicU64::new(0);
    let stopped = AtomicBool::new(false);
    let workers: Vec<Mutex<Worker>> = (0..threads).map(|_| Mutex::new(Worker::new())).collect();
    for worker in &workers {
        lock(worker).batch.watch.start(options.statistics);
    }
    let sharing = match options.reuse {
        None => scene.reuse,
        Some(true) => Sharing::Always,
        Some(false) => Sharing::Never,
    };
    let has_second = if sharing == Sharing::Indoors && samples_total > 0 {
        second_vertices(scene, &kernels, pass_options, &workers)
    } else {
        0.0
    };
    let share_of_blocks = match sharing {
        Sharing::Always => 1.0,
        Sharing::Never => 0.0,
        Sharing::Indoors => ((has_second - OUTDOORS) / (INDOORS - OUTDOORS)).clamp(0.0, 1.0),
    };
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
    for pass in passes(samples, 16 * SAMPLES) {
        if let Some(guides) = &mut guides {
            guides.prepare(scene, &kernels, &pass, &workers);
        }
        let pass_options = trace::Pass {
            guide: guides.as_ref().map(Guides::guide),
            light_paths: light_paths.as_ref().map(|(light_paths, plan)| (light_paths, *plan)),
            ..pass_options
        };
        // Whole blocks per batch, and a pass's samples of a place one after the other: the tiles that they are added to stay in the cache.
        let at_once = (pass.end - pass.start).min(SAMPLES);
        let per_batch = (SAMPLES / at_once) as usize;
        let next = AtomicUsize::new(0);
        film.light_samples += if light_paths.is_some() { pass.end - pass.start } else { 0 };
        let cells = Cells::new(&mut film);
        if let (Some((light_paths, plan)), Some(guide)) = (&light_paths, pass_options.guide) {
            let limit = clamp.map(|limit| f64::from(limit) / scene.radiance_unit);
            let on_film = OnFilm { cells: &cells, limit };
            light_paths.trace(scene, &kernels, plan, guide, pass.clone(), on_film, &workers);
        }
        let work = |worker: &mut Worker| {
            while !stopped.load(Ordering::Relaxed) {
                let first = next.fetch_add(1, Ordering::Relaxed) * per_batch;
                let mine = first..grid.len().min(first + per_batch);
                if mine.is_empty() {
                    break;
                }
                let mut sample = pass.start;
                while sample < pass.end {
                    let count = (pass.end - sample).min(at_once);
                    let batch = &mut worker.batch;
                    batch.items.clear();
                    (batch.glints, batch.shares) = (0, 0);
                    for place in mine.clone() {
                        for sample in sample..sample + count {
                            let Some(block) = grid.block(place, sample) else { continue };
                            if glints.in_block(block) {
                                batch.glints |= ((1 << QUARTERS) - 1) << batch.items.len();
                            }
                            if shares(pass_options.seed, block, sample, share_of_blocks) {
                                batch.shares |= ((1 << QUARTERS) - 1) << batch.items.len();
                            }
                            batch.items.extend((0..QUARTERS).map(|quarter| Item::new(block, quarter, sample)));
                        }
                    }
                    if batch.items.is_empty() {
                        sample += count;
                        continue;
                    }
                    batch.watch.start(options.statistics);
                    let start = Instant::now();
                    trace::trace(scene, &kernels, pass_options, batch);
                    if let Some(limit) = clamp {
                        clamp_samples(f64::from(limit) / scene.radiance_unit, &cells, batch);
                    }
                    let added = add_samples(&cells, batch);
                    batch.watch.lap(Stage::Film);
                    batch.watch.costs.total += start.elapsed().as_secs_f64();
                    sample += count;
                    let samples_done = done.fetch_add(added, Ordering::Relaxed) + added;
                    if observer.progress(Progress { samples_done, samples_total }).is_break() {
                        stopped.store(true, Ordering::Relaxed);
                        break;
                    }
                }
            }
        };
        on_all(&workers, &work);
        drop(cells);
        if stopped.load(Ordering::Relaxed) {
            break;
        }
        observer.pass(&film);
    }
    let mut statistics = Statistics::default();
    for worker in &workers {
        let Batch { counters, watch, .. } = &lock(worker).batch;
        film.counters.add(counters);
        statistics.add(&watch.statistics);
        film.costs.add(&watch.costs);
    }
    film.statistics = options.statistics.then_some(statistics);
    film.reuse = pass_options.reuse;
    film.caustics = guides.is_some();
    film.level = level;
    film.threads = threads;
    film
}

/// Whether the pixels of a block share at a sample index: so large a share of the blocks does, by chance.
fn shares(seed: u32, block: [i32; 2], sample: u32, share: f32) -> bool {
    let salt = hash3(seed, sample, 0x05ba_5e55) as u32;
    ((hash3(salt, block[0] as u32, block[1] as u32) >> 40) as f32) < share * (1u32 << 24) as f32
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
            batch.items.push(Item::new([tile % across, tile / across].map(|tile| (tile * TILE) as i32), quarter, 0));
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
    found[0] as f32 / (count as usize * batch::BLOCK_PIXELS) as f32
}

/// The slots of an item's pixels.
fn slots_of(item: usize) -> Range<usize> {
    item * batch::BLOCK_PIXELS..(item + 1) * batch::BLOCK_PIXELS
}

/// Adds the samples of a batch to the film; how many they are.
fn add_samples(cells: &Cells<'_>, batch: &mut Batch) -> u64 {
    let mut added = 0;
    for first in (0..batch.items.len()).step_by(QUARTERS as usize) {
        cells.each([batch.items[first].x, batch.items[first].y], |tile, overlap: &Overlap| {
            for quarter in 0..QUARTERS {
                let slots = slots_of(first + quarter as usize);
                let samples = batch.radiance.each_ref().map(|channel| &channel[slots.clone()]);
                let left_out = tile.add(samples, overlap.of_quarter(quarter));
                batch.counters.dropped += left_out.dropped;
                batch.counters.beyond += left_out.beyond;
            }
            added += overlap.pixels();
        });
    }
    added
}

/// Clamps the samples of a batch before they are added. A pass of its own, so that its time is known and nothing is asked where none is
/// wanted.
fn clamp_samples(limit: f64, cells: &Cells<'_>, batch: &mut Batch) {
    let start = Instant::now();
    for first in (0..batch.items.len()).step_by(QUARTERS as usize) {
        cells.each([batch.items[first].x, batch.items[first].y], |tile, overlap: &Overlap| {
            for quarter in 0..QUARTERS {
                let slots = slots_of(first + quarter as usize);
                let samples = batch.radiance.each_mut().map(|channel| &mut channel[slots.clone()]);
                tile.clamp(limit, samples, overlap.of_quarter(quarter));
            }
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

/// Sample ranges of the passes: powers of two up to `longest` samples, then so many at a time, so that an early look costs little and
/// later passes are long. The picture does not depend on them.
fn passes(samples: u32, longest: u32) -> impl Iterator<Item = std::ops::Range<u32>> {
    let mut start = 0;
    std::iter::from_fn(move || {
        let length = if start == 0 { 1 } else { start.min(longest) };
        let rest = (samples - start).min(length);
        if rest == 0 {
            return None;
        }
        // A pass that is no multiple of a batch's items but longer would leave lanes empty: split off what fits.
        let whole = if rest > SAMPLES { rest - rest % SAMPLES } else { 1 << rest.ilog2() };
        let pass = start..start + whole;
        start = pass.end;
        Some(pass)
    })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// The first pixel of a quarter of a block, for the tests of the film.
    pub fn first_pixel(block: [i32; 2], quarter: u32) -> [i32; 2] {
        Item::new(block, quarter, 0).first_pixel()
    }

    #[test]
    fn passes_cover_all_samples_once() {
        for (samples, longest) in (1..300).chain([1000, 1023]).flat_map(|samples| [(samples, 64), (samples, 16)]) {
            let mut next = 0;
            for pass in passes(samples, longest) {
                assert_eq!(pass.start, next);
                let n = pass.end - pass.start;
                assert!(n.is_multiple_of(SAMPLES) || SAMPLES.is_multiple_of(n));
                next = pass.end;
            }
            assert_eq!(next, samples);
        }
    }
}
