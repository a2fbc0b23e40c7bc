//! A pass: a range of sample indices added to every pixel, its work dealt out to threads in batches.

use super::deal::{Deal, joined};
use super::direct;
use super::grid::Grid;
use super::lighting::Lighting;
use super::observer::{Observer, Progress};
use super::technique::{OnFilm, Technique};
use super::trace::trace;
use super::watcher::Unwatched;
use crate::film::{Adaptive, Cells, Film, Keeper, MattesKept, Piece, Plan, Samples, Tile, Unfinished};
use crate::film::{half_end, run_end};
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};
use tracer_kernels::engine::batch::{Batch, ITEMS, PATHS};
use tracer_kernels::engine::pass::Pass;
use tracer_kernels::engine::pool::Pool;
use tracer_kernels::layers::{LayerSamples, LayerSet};
use tracer_kernels::report::Stage;
use tracer_kernels::sampling::blocks::{Block, Item, QUARTERS, runs, slots_of};

/// Samples of a block that fill a batch.
pub const SAMPLES: u32 = ITEMS as u32 / QUARTERS;

/// Sample ranges of the passes: powers of two up to the longest, then so many at a time, so that an early look costs
/// little and later passes are long. None goes over a power of two, where guides change. The picture does not depend on
/// them.
pub struct Passes {
    next: u32,
    samples: u32,
    longest: u32,
    last: u32,
    looks: bool,
    plan: Option<Plan>,
    /// None goes over an index at which tiles may begin or end to rest.
    pub rests: bool,
}

/// Samples per pixel at which a noise goal is looked at first: with fewer, what is rare has not been found, and does
/// not count.
const FIRST_LOOK: u32 = 16;

/// A noise goal is looked at so many times between a power of two and the next: so a picture has a fourth more samples
/// than it needs at most, and still so many at once that they are good ones.
const LOOKS: u32 = 4;

/// The next number of samples of all pixels at which a noise goal is looked at.
fn next_look(samples: u32) -> u32 {
    let apart = samples.checked_ilog2().map_or(1, |power| (1 << power) / LOOKS).max(FIRST_LOOK / LOOKS);
    (samples - samples % apart).saturating_add(apart).max(FIRST_LOOK)
}

/// Whether a noise goal is looked at where all pixels have so many samples.
pub fn is_looked_at(samples: u32) -> bool {
    samples > 0 && next_look(samples - 1) == samples
}

impl Passes {
    /// From a sample index on.
    pub fn new(next: u32, samples: u32, longest: u32) -> Self {
        Passes { next, samples, longest, last: 1, looks: false, plan: None, rests: false }
    }

    /// Whether none goes over a number of samples at which a noise goal is looked at.
    pub fn looking(self, looks: bool) -> Self {
        Passes { looks, ..self }
    }

    /// Whether the last one is that of a plan.
    pub fn planned(self, plan: Option<Plan>) -> Self {
        Passes { plan, ..self }
    }

    /// The next one, up to `end` where a pass is to be gone on with.
    pub fn next(&mut self, end: Option<u32>) -> Option<Range<u32>> {
        let start = self.next;
        let of_guide = start.checked_next_power_of_two().map_or(u32::MAX, |next| next.max(1) - start);
        let of_guide = if of_guide == 0 { start } else { of_guide };
        let of_look = if self.looks { next_look(start) - start } else { u32::MAX };
        let of_rest = if self.rests { run_end(start) - start } else { u32::MAX };
        let of_plan = self.plan.map_or(u32::MAX, |plan| plan.whole.saturating_sub(start));
        let end = end.or(self.plan.filter(|plan| plan.whole == start).map(|plan| plan.end));
        let rest =
            self.samples.saturating_sub(start).min(of_plan).min(self.longest).min(of_guide).min(of_look).min(of_rest);
        // A pass that is no multiple of a batch's items but longer would leave lanes empty: split off what fits.
        let whole = match rest {
            0 => 0,
            rest if rest > SAMPLES => rest - rest % SAMPLES,
            rest => 1 << rest.ilog2(),
        };
        let end = end.unwrap_or(start + whole);
        self.next = end;
        self.last = end.saturating_sub(start).max(1);
        (start < end).then_some(start..end)
    }

    /// The last one took so long; the next ones are to take no longer than this.
    pub fn took(&mut self, time: Duration, longest: Option<Duration>) {
        let Some(limit) = longest else { return };
        let of_one = time.as_secs_f64() / f64::from(self.last);
        self.longest = ((limit.as_secs_f64() / of_one.max(1e-9)) as u32).clamp(1, 16 * SAMPLES);
    }
}

/// Adds passes to a film.
pub struct Painter<'a> {
    pub pool: &'a Pool,
    /// Plain paths.
    pub plain: Pass<'a>,
    /// What lights the picture: all lights at once, or one group after the other.
    pub lightings: Vec<Lighting<'a>>,
    pub grid: Grid,
    /// The quarter of each block's pixels that sees the scene as it is now, where something moves: the others see it at
    /// other moments.
    pub quarter: Option<u32>,
    /// The place before which it ends, where a plan says so of a quarter.
    pub last_place: u32,
    pub observer: &'a dyn Observer,
    /// Statistics are kept.
    pub statistics: bool,
    /// The most that samples count, in the film's unit.
    pub limit: Option<f64>,
    /// What is seen behind everything is summed by itself.
    pub backdrop: bool,
    /// Luminance of what the picture is laid over then, in the film's unit.
    pub paper: f64,
    /// What is counted for mattes.
    pub mattes: MattesKept,
    /// What is seen of lamps is told apart for halves.
    pub lamps: bool,
    /// Where the layer `denoising_albedo` stands among the sums of samples, where halves are kept.
    pub albedo: Option<usize>,
    /// Which tiles rest, where that was decided.
    pub adaptive: Option<Arc<Adaptive>>,
    /// When the rendering ends at the latest.
    pub until: Option<Instant>,
    /// The sample index whose light paths are not wanted any more.
    pub light_until: u32,
    /// Samples that are on the film, and all that are asked for.
    pub done: AtomicU64,
    pub samples_total: u64,
    /// The observer has ended the rendering, or the time is over.
    pub stopped: AtomicBool,
}

impl Painter<'_> {
    /// The techniques, and the number of the lighting whose they are.
    pub fn techniques(&mut self) -> impl Iterator<Item = (usize, &mut Box<dyn Technique>)> {
        self.lightings
            .iter_mut()
            .enumerate()
            .flat_map(|(k, lighting)| lighting.techniques.iter_mut().map(move |technique| (k, technique)))
    }

    /// From here on tiles rest as the film's do.
    pub fn keep_adaptive(&mut self, film: &Film, passes: &mut Passes) {
        self.adaptive = film.adaptive().filter(|_| film.is_adaptive()).cloned();
        passes.rests = self.adaptive.is_some();
        if passes.rests {
            self.samples_total = film.samples_until(passes.samples);
        }
    }

    /// Whether pixels share, in any lighting.
    pub fn reuses(&self) -> bool {
        self.lightings.iter().any(|lighting| lighting.pass(self.plain).reuse)
    }

    /// Whether rays are aimed, in any lighting.
    pub fn aims(&self) -> bool {
        self.lightings.iter().any(|lighting| lighting.pass(self.plain).guide.is_some())
    }

    /// Places of a pass: blocks or, where quarters of them see moments of their own, all of the first quarter, then all
    /// of the second and so on.
    pub fn places(&self) -> u32 {
        self.grid.len() as u32 * if self.quarter.is_some() { QUARTERS } else { 1 }
    }

    /// Those of the quarter that it paints.
    pub fn places_now(&self) -> Range<u32> {
        let blocks = self.grid.len() as u32;
        self.quarter.map_or(0..blocks, |quarter| quarter * blocks..(quarter + 1) * blocks)
    }

    /// Makes ready for these sample indices.
    pub fn prepare(&mut self, samples: &Range<u32>) {
        for Lighting { engine, techniques, .. } in &mut self.lightings {
            techniques.iter_mut().for_each(|technique| technique.before_pass(*engine, samples, self.pool));
        }
    }

    /// Adds the samples of a pass, or of a quarter of its pixels, or what is left of it; gives what is left then. The
    /// keeper is told the film as it was before.
    pub fn paint(&self, film: &mut Film, samples: Range<u32>, keeper: Option<Keeper>) -> Option<Unfinished> {
        let plain = Pass { layers: film.layers(), lamps: self.lamps, ..self.plain };
        let whole = || vec![Piece { places: 0..self.places(), samples: samples.clone() }];
        let pieces = film.unfinished.take().map_or_else(whole, |rest| rest.pieces);
        let begins = pieces.first().is_none_or(|piece| piece.places.start <= self.places_now().start);
        let (pieces, later) = self.of_now(pieces);
        // Whole blocks per batch, and a pass's samples of a place one after the other: the tiles that they are added to
        // stay in the cache.
        let at_once = (samples.end - samples.start).min(SAMPLES);
        let items = if self.quarter.is_some() { ITEMS as u32 } else { SAMPLES };
        let deal = match &self.adaptive {
            Some(adaptive) => Deal::of_batches(adaptive.batches(&self.grid, pieces, items / at_once)),
            None => Deal::new(pieces, items / at_once),
        };
        let mut light = film.light_samples;
        let cells = Cells::new(film, keeper);
        std::thread::scope(|scope| {
            if cells.keeper().is_some() {
                // Where there is no further thread, it is done before the pass.
                let helper = std::thread::Builder::new().spawn_scoped(scope, || cells.keep_all());
                helper.map(drop).unwrap_or_else(|_| cells.keep_all());
            }
            match self.quarter {
                None => light = self.bring(plain, light..samples.end.min(self.light_until), &cells),
                Some(_) if begins && !deal.is_empty() => drop(self.bring(plain, samples.clone(), &cells)),
                Some(_) => {}
            }
            self.pool.on_all(&|batch: &mut Batch| {
                let mut totals = self.room_for_totals();
                while !self.stopped.load(Ordering::Relaxed)
                    && let Some(piece) = deal.take()
                {
                    let samples = self.batch(plain, &piece, at_once, (&cells, &mut totals), batch);
                    if !samples.is_empty() {
                        deal.give_back(Piece { samples, ..piece });
                    }
                }
            });
            if let Some(keeper) = cells.keeper() {
                keeper.hurry();
            }
        });
        drop(cells);
        film.light_samples = light;
        let mut left = deal.left();
        if self.adaptive.is_some() {
            left.sort_unstable_by_key(|piece| (piece.samples.start, piece.places.start));
            left = joined(Vec::new(), left);
        }
        let pieces = joined(left, later);
        let brings = self.quarter.is_none() && self.bringers().next().is_some();
        let is_whole = pieces.is_empty() && (light >= samples.end.min(self.light_until) || !brings);
        (!is_whole).then_some(Unfinished { end: samples.end, pieces })
    }

    /// What brings light to the film beside the samples, and for how many sample indices at a time.
    fn bringers(&self) -> impl Iterator<Item = (&Lighting<'_>, &dyn Technique, u32)> {
        self.lightings.iter().filter_map(move |lighting| {
            let bringer = lighting.techniques.iter().find_map(|technique| Some((&**technique, technique.at_once()?)));
            bringer.map(|(technique, at_once)| (lighting, technique, at_once))
        })
    }

    /// How many light paths there are for a sample index.
    pub fn light_paths(&self) -> u64 {
        self.bringers().map(|(_, technique, _)| technique.count()).sum()
    }

    /// Has light brought to the film beside the samples of these indices; where it has come to.
    fn bring(&self, plain: Pass<'_>, samples: Range<u32>, cells: &Cells<'_>) -> u32 {
        let mut next = samples.start;
        let Some(at_once) = self.bringers().map(|(.., at_once)| at_once).min() else { return next };
        while next < samples.end && !self.stopped.load(Ordering::Relaxed) {
            // Of one half of the samples only, and taken by the same tiles.
            let end = if self.adaptive.is_some() { run_end(next) } else { half_end(next) };
            let now = next..samples.end.min(next.saturating_add(at_once)).min(end);
            for (lighting, technique, _) in self.bringers() {
                let film =
                    OnFilm { cells, limit: self.limit, sample: next, group: lighting.group, quarter: self.quarter };
                technique.bring(lighting.engine, lighting.pass(plain), now.clone(), film, self.pool);
            }
            next = now.end;
            if next < samples.end {
                self.tell(0);
            }
        }
        next
    }

    /// Adds a batch; gives the samples that it lacks because the rendering was ended.
    fn batch(
        &self,
        plain: Pass<'_>,
        piece: &Piece,
        at_once: u32,
        (cells, totals): (&Cells<'_>, &mut Totals),
        batch: &mut Batch,
    ) -> Range<u32> {
        let mut sample = piece.samples.start;
        while sample < piece.samples.end {
            let count = (piece.samples.end - sample).min(at_once);
            self.fill(&piece.places, sample..sample + count, batch);
            sample += count;
            if batch.items.is_empty() {
                continue;
            }
            batch.watch.start(self.statistics);
            let start = Instant::now();
            for lighting in &self.lightings {
                lighting.mark(batch);
                trace(lighting.engine, lighting.pass(plain), &lighting.techniques, batch, &mut Unwatched);
                if let Some(limit) = self.limit {
                    clamp_samples(limit, cells, batch);
                }
                direct::settle(plain.layers, batch);
                if let Some(group) = lighting.group {
                    add_group(group, cells, totals, batch);
                }
            }
            let added = self.add_samples(plain.layers, cells, totals, batch);
            batch.watch.lap(Stage::Film);
            batch.watch.costs.total += start.elapsed().as_secs_f64();
            if !self.tell(added) {
                break;
            }
        }
        sample..piece.samples.end
    }

    /// Makes a batch's items those of the blocks, or quarters of them, at these places and sample indices.
    pub fn fill(&self, places: &Range<u32>, samples: Range<u32>, batch: &mut Batch) {
        batch.items.clear();
        let quarters = self.quarter.map_or(0..QUARTERS, |quarter| quarter..quarter + 1);
        let first = self.places_now().start;
        for place in places.clone() {
            for sample in samples.clone() {
                let Some(block) = self.grid.block((place - first) as usize, self.grid.cut(sample)) else { continue };
                let Some(resting) = self.resting(block, sample) else { continue };
                batch.items.extend(quarters.clone().map(|quarter| Item { block, quarter, sample, resting }));
            }
        }
    }

    /// Which of a block's tiles take no sample at this index; `None` where none takes one.
    fn resting(&self, block: Block, sample: u32) -> Option<u8> {
        self.adaptive.as_ref().map_or(Some(0), |adaptive| adaptive.resting(block, sample))
    }

    /// Which pieces are of this quarter and before the last place, and which are left for later.
    fn of_now(&self, pieces: Vec<Piece>) -> (Vec<Piece>, Vec<Piece>) {
        let end = self.places_now().end.min(self.last_place);
        let cut = |from: u32, to: u32| {
            let within = |Piece { places, samples }: &Piece| {
                let places = places.start.max(from)..places.end.min(to);
                (!places.is_empty()).then(|| Piece { places, samples: samples.clone() })
            };
            pieces.iter().filter_map(within).collect::<Vec<_>>()
        };
        (cut(0, end), cut(end, u32::MAX))
    }

    /// Room for the totals of a batch's samples over the groups, where there are groups.
    fn room_for_totals(&self) -> Totals {
        let has_groups = self.lightings.iter().any(|lighting| lighting.group.is_some());
        vec![[0; 3]; if has_groups { PATHS } else { 0 }]
    }

    /// Adds the samples of a batch to the film; how many they are. Those of groups were added before, and are taken
    /// from `totals`, which are zero afterwards.
    fn add_samples(&self, layers: LayerSet, cells: &Cells<'_>, totals: &mut Totals, batch: &mut Batch) -> u64 {
        let mut added = 0;
        for run in runs(&batch.items) {
            let slots = slots_of(&run);
            let sample = batch.items[run.start].sample;
            cells.each(&batch.pixels, (slots.clone(), sample), |tile, common| {
                let half = tile.half_of(sample);
                if totals.is_empty() {
                    let samples = batch.radiance.each_ref().map(|channel| &channel[slots.clone()]);
                    let left_out = tile.add(samples, common);
                    batch.counters.dropped += left_out.dropped;
                    batch.counters.beyond += left_out.beyond;
                    self.add_parts(samples, tile, (&batch.layers, half), &slots, common);
                } else {
                    let totals = &totals[slots.clone()];
                    tile.count_totals(totals, common);
                    self.add_parts(totals, tile, (&batch.layers, half), &slots, common);
                }
                tile.add_layers(&batch.layers, &slots, common);
                if !self.mattes.is_empty() {
                    tile.add_mattes(self.mattes, layers, &batch.layers, &slots, common);
                }
                added += common.len() as u64;
            });
        }
        totals.fill([0; 3]);
        added
    }

    /// Adds what is summed apart of the samples of a block's slots, which are of this half: the background, and halves.
    fn add_parts(
        &self,
        samples: impl Samples + Copy,
        tile: &mut Tile,
        (layers, half): (&LayerSamples, usize),
        slots: &Range<usize>,
        common: &[[u8; 2]],
    ) {
        if self.backdrop {
            tile.add_missed(samples, layers, slots.start, common, (half, self.paper));
        }
        if half == 1 {
            tile.add_half(samples, common);
            if let Some(place) = self.albedo {
                tile.add_half_albedo(layers, (place, !self.backdrop), slots, common);
            }
        }
        if self.lamps {
            tile.add_lamps(half, (&layers.lamps[slots.clone()], samples), common, self.limit);
        }
    }

    /// Tells the observer of so many samples more; whether it goes on.
    fn tell(&self, added: u64) -> bool {
        let samples_done = self.done.fetch_add(added, Ordering::Relaxed) + added;
        let goes_on =
            self.observer.progress(Progress { samples_done, samples_total: self.samples_total }).is_continue();
        let is_over = self.until.is_some_and(|until| Instant::now() >= until);
        if !goes_on || is_over {
            self.stopped.store(true, Ordering::Relaxed);
        }
        goes_on
    }
}

/// Of each slot of a batch what all groups have brought, in the film's least units.
type Totals = Vec<[i128; 3]>;

/// Adds what a group, of so many, has brought to the samples of a batch.
fn add_group([group, count]: [usize; 2], cells: &Cells<'_>, totals: &mut Totals, batch: &mut Batch) {
    for run in runs(&batch.items) {
        let (slots, sample) = (slots_of(&run), batch.items[run.start].sample);
        cells.each(&batch.pixels, (slots.clone(), sample), |tile, common| {
            let samples = batch.radiance.each_ref().map(|channel| &channel[slots.clone()]);
            let left_out = tile.add_group((group, count), samples, common, &mut totals[slots.clone()]);
            batch.counters.dropped += left_out.dropped;
            batch.counters.beyond += left_out.beyond;
        });
    }
}

/// Clamps the samples of a batch before they are added. A pass of its own, so that its time is known and nothing is
/// asked where none is wanted.
fn clamp_samples(limit: f64, cells: &Cells<'_>, batch: &mut Batch) {
    let start = Instant::now();
    for run in runs(&batch.items) {
        let (slots, sample) = (slots_of(&run), batch.items[run.start].sample);
        cells.each(&batch.pixels, (slots.clone(), sample), |tile, common| {
            let samples = batch.radiance.each_mut().map(|channel| &mut channel[slots.clone()]);
            tile.clamp(limit, samples, common);
        });
    }
    batch.watch.costs.clamp += start.elapsed().as_secs_f64();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_cover_all_samples_once() {
        let guide = |sample: u32| sample.checked_ilog2();
        for (samples, longest) in (1..300).chain([1000, 1023]).flat_map(|samples| [64, 16, 5, 1].map(|n| (samples, n)))
        {
            for start in [0, 1, 2, 3, 5, 64, 77, samples] {
                let mut passes = Passes::new(start, samples, longest);
                let mut next = start.min(samples.max(start));
                while let Some(pass) = passes.next(None) {
                    assert_eq!(pass.start, next);
                    let n = pass.end - pass.start;
                    assert!(n <= longest && (n.is_multiple_of(SAMPLES) || SAMPLES.is_multiple_of(n)));
                    assert_eq!(guide(pass.start), guide(pass.end - 1), "{pass:?}");
                    next = pass.end;
                }
                assert_eq!(next, samples.max(start));
            }
        }
        let mut passes = Passes::new(0, 1000, 64);
        let lengths: Vec<u32> = std::iter::from_fn(|| passes.next(None)).map(|pass| pass.end - pass.start).collect();
        assert_eq!(lengths[..9], [1, 1, 2, 4, 8, 16, 32, 64, 64]);
        // As measured, and no shorter than a sample.
        let mut passes = Passes::new(512, 1000, 64);
        for (seconds, length) in [(64.0, 8), (80.0, 1), (0.01, 64)] {
            passes.next(None);
            passes.took(Duration::from_secs_f64(seconds), Some(Duration::from_secs(8)));
            assert_eq!(passes.longest, length);
        }
    }

    /// A noise goal is looked at at the same numbers of samples, however long passes are.
    #[test]
    fn passes_stop_where_noise_is_looked_at() {
        for (samples, longest, start) in [(1000, 64, 0), (1000, 5, 3), (300, 7, 70), (257, 33, 1)] {
            let mut passes = Passes::new(start, samples, longest).looking(true);
            let mut ends = Vec::new();
            while let Some(pass) = passes.next(None) {
                ends.push(pass.end);
                passes.longest = 1 + (pass.end * 7) % 64;
            }
            let looks = (start + 1..=samples).filter(|&n| is_looked_at(n));
            assert!(looks.clone().count() > 2 && looks.clone().all(|look| ends.contains(&look)), "{ends:?}");
        }
    }
}
