//! A sample with all techniques at work: what each of them brings to it.

use super::super::moments::handed_before;
use super::super::observer::Unobserved;
use super::super::technique::Engine;
use super::super::trace::trace;
use super::super::watcher::{Unwatched, Watcher};
use super::super::{Goals, RenderOptions, Work, new_film, painter};
use super::told::{Brought, Shared, Whole};
use super::{fill, radiance};
use crate::scene::Scene;
use tracer_kernels::engine::batch::{Batch, path};
use tracer_kernels::engine::pool::{Counted, Pool};
use tracer_kernels::sampling::blocks::ITEM_PIXELS;

/// Sees what techniques bring to a slot. Rays that were aimed from it get another one, of an item with the same pixels
/// and no paths of its own: the same random numbers, and a sum of their own.
struct Tagger {
    slot: u32,
    aimed: u32,
    items: u32,
    aimed_rays: u32,
    before: [f32; 3],
    brought: Vec<(&'static str, [f32; 3], [f32; 3])>,
    shared: Option<Shared>,
}

impl Watcher for Tagger {
    fn items(&self) -> u32 {
        self.items
    }

    fn after_vertex(&mut self, before: usize, batch: &mut Batch) {
        // Those of second vertices that are shared belong to whoever shares them.
        let len = batch.paths.len;
        for slot in batch.paths.slot[before.min(len)..len].iter_mut().filter(|slot| **slot & path::SHARED == 0) {
            let of = *slot & path::SLOT;
            self.aimed_rays += u32::from(of == self.slot || of == self.aimed);
            if of == self.slot {
                *slot = *slot & !path::SLOT | self.aimed;
            }
        }
    }

    fn after_paths(&mut self, batch: &Batch) {
        self.before = radiance(batch, self.slot as usize);
        self.brought.push(("paths", [0.0; 3], self.before));
        if self.aimed_rays > 0 {
            self.brought.push(("aimed rays", [0.0; 3], radiance(batch, self.aimed as usize)));
        }
    }

    fn after_batch(&mut self, technique: &'static str, batch: &Batch) {
        let now = radiance(batch, self.slot as usize);
        if now != self.before {
            self.brought.push((technique, self.before, now));
        }
        if technique == "sharing" {
            self.shared = shared(self.slot, batch);
        }
        self.before = now;
    }
}

/// What the pixel of a slot shares.
fn shared(slot: u32, batch: &Batch) -> Option<Shared> {
    let members = &batch.members;
    let member = (0..members.len).find(|&i| members.slot[i] == slot)? as u32;
    let is_of = |group: &tracer_kernels::engine::batch::Group| (group.first..group.first + group.len).contains(&member);
    let (number, group) = batch.groups.list.iter().enumerate().find(|(_, group)| is_of(group))?;
    let suffixes = || (0..batch.suffixes.len).filter(|&j| batch.groups.of_suffix[j] as usize == number);
    let seen = suffixes().filter(|&j| batch.groups.hidden[j] >> (member - group.first) & 1 == 0).count();
    Some(Shared { pixels: group.len, found: suffixes().count() as u32, seen: seen as u32 })
}

/// Explains it; the outer `None`: there is no such pixel; the inner: no technique is at work. `whole`: the scene as the
/// shutter opens, of which the engine's is what the sample sees, and the quarter that it is of where something moves.
/// Of light paths, a fourth of those of the sample index come at its moment.
pub fn explain(
    engine: Engine<'_>,
    (whole, quarter): (&Scene, Option<u32>),
    options: &RenderOptions,
    pixel: [u32; 2],
    sample: u32,
) -> Option<Option<Whole>> {
    let scene = engine.scene;
    let threads = if options.threads == 0 { super::super::available_threads() } else { options.threads };
    let pool = Pool::new(threads, false);
    let mut film = new_film(scene, options);
    film.moments = whole.moments_of_sample();
    let mut painter = painter(engine, &[], options, &film, sample + 1, &pool, &Unobserved);
    if painter.lightings[0].techniques.is_empty() {
        return Some(None);
    }
    painter.quarter = quarter;
    if whole.moves() {
        let work = Work {
            options,
            observer: &Unobserved,
            pool: &pool,
            samples: sample + 1,
            plan: None,
            moves: true,
            before: Counted::default(),
            goals: Goals::new(scene, options, &film),
            keeper: None,
        };
        handed_before(whole, engine.kernels, &film, &work, (sample, quarter)).ok()?.give(&mut painter);
    }
    painter.prepare(&(sample..sample + 1));
    film.unfinished = painter.paint(&mut film, sample..sample + 1, None);
    if quarter.is_some() {
        (film.unfinished, film.light_samples) = (None, sample + 1);
    }
    let lighting = &painter.lightings[0];
    let pass = lighting.pass(painter.plain);
    let mut batch = Batch::new();
    let slot = fill(&painter, pixel, sample, &mut batch)?;
    trace(engine, pass, &lighting.techniques, &mut batch, &mut Unwatched);
    let of_batch = radiance(&batch, slot);

    fill(&painter, pixel, sample, &mut batch)?;
    let items = batch.items.len();
    batch.items.push(batch.items[slot / ITEM_PIXELS]);
    let mut tagger = Tagger {
        slot: slot as u32,
        aimed: (items * ITEM_PIXELS + slot % ITEM_PIXELS) as u32,
        items: (1 << items) - 1,
        aimed_rays: 0,
        before: [0.0; 3],
        brought: Vec::new(),
        shared: None,
    };
    trace(engine, pass, &lighting.techniques, &mut batch, &mut tagger);

    let unit = scene.radiance_unit;
    let rows = tagger.brought.iter().map(|(by, from, to)| Brought {
        by,
        radiance: [0, 1, 2].map(|c| (f64::from(to[c]) - f64::from(from[c])) * unit),
    });
    let mut brought: Vec<Brought> = rows.collect();
    let [x, y] = pixel;
    let light = film.of_light_paths(x, y);
    if light != [0.0; 3] {
        brought.push(Brought { by: "light paths", radiance: light });
    }
    let (counts, taken) = (film.radiance(x, y), film.taken(x, y));
    let rounding = [0, 1, 2].map(|c| counts[c] + taken[c] - brought.iter().map(|by| by.radiance[c]).sum::<f64>());
    let agrees = (0..3).all(|c| {
        let all = brought.iter().map(|by| by.radiance[c].abs()).sum::<f64>();
        let whole = f64::from(of_batch[c]) * unit + light[c];
        // The film's own sums are exact; those of a path are in single precision.
        rounding[c].abs() <= 1e-5 * all && (counts[c] + taken[c] - whole).abs() <= 1e-12 * (all + 1e-9 * unit)
    });
    let Tagger { aimed_rays: aimed, shared, .. } = tagger;
    Some(Some(Whole { brought, rounding, taken, radiance: counts, aimed, shared, agrees }))
}
