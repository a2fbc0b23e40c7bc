//! The path engine: batches of paths through stages, over lanes, on all cores.
//!
//! A pass adds a range of sample indices to every pixel of the picture, block by block ([`grid`]). Blocks are independent and a pixel's sum
//! is exact ([`crate::film`]), so threads take batches in any order and the film is the same.

mod batch;
mod caustics;
mod glints;
mod grid;
mod indirect;
mod kernels;
mod lane_io;
mod stages;
mod statistics;
mod trace;

pub use batch::Counters;
pub use statistics::{Costs, Stage, Statistics, TreeWork};

use crate::film::{Cells, Crop, Film, Overlap};
use crate::lanes::level::Level;
use crate::scene::{Scene, Sharing};
use batch::{Batch, ITEMS, Item, QUARTERS};
use caustics::Caustics;
use glints::Glints;
use grid::Grid;
use kernels::Kernels;
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
    /// Lane type; the bytes are the same for all.
    pub level: Option<Level>,
    /// Whether the pixels of a block share what they find.
    pub reuse: Option<bool>,
    /// Whether photons carry the light that reaches diffuse surfaces over mirrors and glass.
    pub caustics: Option<bool>,
    /// Whether a map brings the indirect light of second vertices; only where pixels share.
    pub indirect: Option<bool>,
    /// The most that the largest channel of a sample counts, in W/(sr m^2): what is above is scaled down to it as a whole. A sample is
    /// all that a pixel gets at one sample index, its part of what others have found and of photons included. What is not a finite number
    /// above zero is no limit.
    pub clamp: Option<f32>,
    /// Whether to keep [`Statistics`].
    pub statistics: bool,
}

/// Under a background pixels share where such a share of the paths has a second vertex: in rooms with a window or without a wall. What a ray
/// sees where it leaves the scene is its own pixel's; outdoors to share never paid (docs/noise.md).
const INDOORS: f32 = 0.8;

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
        photons: None,
        indirect: None,
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
    // A second vertex scatters once more.
    let may_map = sharing != Sharing::Never && scene.max_bounces > 1 && options.indirect.unwrap_or(scene.indirect);
    let has_second = if (may_map || sharing == Sharing::Indoors) && samples_total > 0 {
        indirect::trial(scene, &kernels, pass_options, &workers)
    } else {
        0.0
    };
    pass_options.reuse = sharing == Sharing::Always || sharing == Sharing::Indoors && has_second >= INDOORS;
    let wants_indirect = may_map && pass_options.reuse && has_second >= indirect::WORTH;
    let wants_photons = options.caustics.unwrap_or(scene.caustics) && samples_total > 0;
    let mut caustics = if wants_photons { Caustics::new(scene, &kernels, pass_options.seed, &workers) } else { None };
    let glints = match &caustics {
        Some(_) => glints::pilot(scene, &kernels, pass_options, crop, &workers),
        None => Glints::default(),
    };
    let grid = Grid::new(crop, pass_options.seed, pass_options.reuse);
    let has_maps = caustics.is_some() || wants_indirect;
    for pass in passes(samples, if has_maps { 4 * SAMPLES } else { 16 * SAMPLES }) {
        if let Some(caustics) = &mut caustics {
            caustics.prepare(scene, &kernels, pass.clone(), &workers);
        }
        let indirect = if wants_indirect {
            indirect::maps(scene, &kernels, pass_options, caustics.as_ref(), pass.clone(), &workers)
        } else {
            Vec::new()
        };
        // Whole blocks per batch, and a pass's samples of a place one after the other: the tiles that they are added to stay in the cache. A
        // batch has one map of photons and one of indirect light, and each sample index its own.
        let at_once = if has_maps { 1 } else { (pass.end - pass.start).min(SAMPLES) };
        let per_batch = (SAMPLES / at_once) as usize;
        let next = AtomicUsize::new(0);
        let cells = Cells::new(&mut film);
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
                    batch.glints = 0;
                    for place in mine.clone() {
                        for sample in sample..sample + count {
                            let Some(block) = grid.block(place, sample) else { continue };
                            if glints.in_block(block) {
                                batch.glints |= ((1 << QUARTERS) - 1) << batch.items.len();
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
                    let photons = caustics.as_ref().and_then(|c| c.map(sample));
                    let indirect = indirect.get((sample - pass.start) as usize);
                    trace::trace(scene, &kernels, trace::Pass { photons, indirect, ..pass_options }, batch);
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
    film.caustics = caustics.is_some();
    film.indirect = wants_indirect;
    film.level = level;
    film.threads = threads;
    film
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
