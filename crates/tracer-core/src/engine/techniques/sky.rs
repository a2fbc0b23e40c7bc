//! Where the sky is seen from, found out by paths ahead of all others ([`tracer_kernels::engine::guide::sky`]).

use super::Trial;
use super::trial::stratified;
use crate::engine::technique::Engine;
use crate::engine::trace::{met, seen, shade};
use std::time::Instant;
use tracer_kernels::engine::batch::{Batch, ITEMS, PATHS, path};
use tracer_kernels::engine::guide::Guide;
use tracer_kernels::engine::guide::cells::{Cells, FARTHEST, Photon};
use tracer_kernels::engine::guide::sky::Seen;
use tracer_kernels::engine::pass::Pass;
use tracer_kernels::engine::pool::Pool;
use tracer_kernels::engine::told::beyond;
use tracer_kernels::report::Stage;
use tracer_kernels::sampling::blocks::ITEM_PIXELS;
use tracer_kernels::sampling::sampler::hash3;
use tracer_kernels::scene::{NONE, Scene};

/// Paths with this bit in their slots' words began as aimed rays.
const ASIDE: u32 = 1 << 31;
/// Paths of a trial, at first: of windows that few of them find it takes more to tell.
const TRIAL: u32 = PATHS as u32;
/// So many finds tell.
const TELLING: usize = 200;
/// And so few nothing.
const FEW: usize = 8;
/// Where fewer rays than this would be aimed, of each surface one, the sky is looked for no further: rays by chance do
/// as well.
const LEAST: f32 = 0.03;
/// Cells are made of so many finds at least, where that takes at most [`MOST_MORE`] times the paths.
const WANTED: f32 = 512.0;
const MOST_MORE: u32 = 8;

/// How often a path sees the sky, as far as that is worth to be known: not where rays by chance see it as often as
/// aimed ones would. Found out by at most so many paths; it depends on nothing but them, so that windows are not aimed
/// at in one frame and left to chance in the next.
pub fn finds_per_path(trial: &Trial<'_>, most: u32) -> Option<f32> {
    let scene = trial.engine.scene;
    if !scene.is_under_sky() || scene.max_bounces == 0 {
        return None;
    }
    let most = if trial.moves { TRIAL } else { most };
    let (mut seen, mut paths) = (Seen::default(), 0);
    while seen.found.len() < TELLING && paths < most {
        let seed = hash3(trial.pass.seed, paths, 0x0007_21a3) as u32;
        let next = TRIAL.max(paths).min(most - paths);
        seen.append(found(trial.engine, seed, next, None, trial.pool));
        paths += next;
    }
    let is_worth = seen.found.len() >= FEW && seen.mean_chance(trial.pass.seed) > LEAST;
    is_worth.then(|| seen.found.len() as f32 / paths as f32)
}

/// The cells of so many paths, or of more where these find little, beside rays that are aimed at lights.
pub fn cells(
    engine: Engine<'_>,
    seed: u32,
    (paths, finds_per_path): (u32, f32),
    lights: Option<&Guide>,
    pool: &Pool,
) -> Cells {
    let wanted = (WANTED / finds_per_path).ceil() as u32;
    let paths = paths.max(wanted.min(MOST_MORE * paths));
    let seen = found(engine, seed, paths, lights, pool);
    pool.once(|batch| {
        batch.watch.resume();
        let start = Instant::now();
        let cells = seen.cells(seed);
        batch.watch.lap(Stage::Photons);
        batch.watch.costs.photons_since(start);
        cells
    })
}

/// What so many paths find, in an order that depends on nothing else.
fn found(engine: Engine<'_>, seed: u32, paths: u32, lights: Option<&Guide>, pool: &Pool) -> Seen {
    let items = paths.div_ceil(ITEM_PIXELS as u32);
    let batches = items.div_ceil(ITEMS as u32);
    let trace = |k: usize, batch: &mut Batch| {
        let first = k as u32 * ITEMS as u32;
        batch.items.clear();
        batch.items.extend((first..items.min(first + ITEMS as u32)).map(|k| stratified(engine.scene, seed, k, items)));
        trace(engine, seed, lights, batch)
    };
    let mut all = Seen::default();
    pool.each(batches as usize, trace).into_iter().for_each(|seen| all.append(seen));
    all
}

/// The items of a batch.
fn trace(engine: Engine<'_>, seed: u32, lights: Option<&Guide>, batch: &mut Batch) -> Seen {
    let Engine { scene, kernels, .. } = engine;
    let pass = Pass { guide: lights, ..Pass::plain(seed, 0) };
    batch.watch.resume();
    let start = Instant::now();
    let before = (batch.counters, batch.watch.costs);
    batch.glints = 0;
    batch.start();
    kernels.camera(scene, seed, u32::MAX, batch);
    let mut found = Seen::default();
    // The last rough surface of a path, and the ray that left it; of the other way at glass apart.
    let mut left: Vec<Option<[[f32; 3]; 3]>> = vec![None; 2 * PATHS];
    let mut visible = Vec::new();
    found.brought = vec![[0.0; 2]; batch.items.len() * ITEM_PIXELS];
    let mut vertex = 0;
    while batch.paths.len > 0 {
        met(engine, pass, vertex, batch);
        shade(engine, pass, vertex, batch);
        if vertex == 0 {
            visible = radiance(batch);
        }
        seen(engine, pass, batch);
        look(scene, batch, &mut left, &mut found);
        if let Some(guide) = lights {
            let own = batch.paths.len;
            kernels.aim(scene, guide, seed, vertex, batch);
            let aimed = own..batch.paths.len;
            batch.paths.slot[aimed].iter_mut().for_each(|slot| *slot |= ASIDE);
        }
        vertex += 1;
    }
    for ((brought, all), visible) in found.brought.iter_mut().zip(radiance(batch)).zip(visible) {
        brought[1] = (all - visible).max(0.0);
    }
    (batch.counters, batch.watch.costs) = before;
    batch.watch.costs.photons_since(start);
    batch.watch.lap(Stage::Photons);
    found
}

/// The radiance of the batch's paths, the sums of their channels; none where single precision ends.
fn radiance(batch: &Batch) -> Vec<f32> {
    let of = |slot: usize| batch.radiance.iter().map(|column| column[slot]).sum::<f32>();
    (0..batch.items.len() * ITEM_PIXELS).map(of).map(|x| if x.is_finite() { x } else { 0.0 }).collect()
}

/// What the rays that were shaded last have met: they lie in `batch.next` now.
fn look(scene: &Scene, batch: &Batch, left: &mut [Option<[[f32; 3]; 3]>], found: &mut Seen) {
    let (paths, hits) = (&*batch.next, &*batch.hits);
    for i in 0..paths.len {
        let at =
            |columns: &[tracer_kernels::engine::batch::Column<f32>; 3]| [columns[0][i], columns[1][i], columns[2][i]];
        let (slot, origin, direction) = (paths.slot[i], at(&paths.origin), at(&paths.direction));
        let place = (slot & path::SLOT) as usize + if slot & path::BRANCH != 0 { PATHS } else { 0 };
        let escapes = hits.primitive[i] == NONE && slot & path::AIMED == 0;
        let aside = slot & ASIDE != 0;
        let end = |t: f32| [0, 1, 2].map(|axis: usize| direction[axis].mul_add(t, origin[axis]));
        if slot & (path::SPECULAR | ASIDE) == 0 {
            let first = if escapes { end(FARTHEST) } else { end(hits.t[i]) };
            left[place] = Some([origin, direction, first]);
            found.asked.push(origin);
        }
        if !escapes {
            continue;
        }
        // Beside what light samples are better for.
        let met = beyond(scene, direction, (slot & path::SPECULAR == 0).then_some(paths.pdf[i]));
        let light = met.radiance.map(|x| x * met.weight);
        if let Some([point, direction, from]) = left[place].filter(|_| !aside) {
            let origin = [0, 1, 2].map(|axis: usize| direction[axis].mul_add(FARTHEST, point[axis]));
            let flux = light.iter().sum();
            found.found.push(Photon { point, from, origin, flux });
        }
        if aside || left[place].is_some() {
            let sky: f32 = (0..3).map(|c| paths.throughput[c][i] * light[c]).sum();
            found.brought[(slot & path::SLOT) as usize][0] += sky * paths.eta2[i];
        }
    }
}
