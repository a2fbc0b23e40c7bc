//! Where the sky is seen from, found out by paths ahead of all others ([`tracer_kernels::engine::guide::sky`]).

use super::Trial;
use crate::engine::technique::Engine;
use crate::engine::trace::{met, seen, shade};
use std::time::Instant;
use tracer_kernels::engine::batch::{Batch, ITEMS, PATHS, path};
use tracer_kernels::engine::guide::Guide;
use tracer_kernels::engine::guide::cells::{Cells, FARTHEST, Photon};
use tracer_kernels::engine::guide::sky::Seen;
use tracer_kernels::engine::pass::Pass;
use tracer_kernels::engine::pool::Pool;
use tracer_kernels::report::Stage;
use tracer_kernels::sampling::blocks::{Block, ITEM_PIXELS, Item, QUARTERS, TILE};
use tracer_kernels::sampling::sampler::hash3;
use tracer_kernels::scene::{NONE, Scene};

/// Paths with this bit in their slots' words began as aimed rays.
const ASIDE: u32 = 1 << 31;
/// Paths of the trial.
const TRIAL: u32 = PATHS as u32;
/// Where fewer rays than this would be aimed, of each surface one, the sky is looked for no further: rays by chance do
/// as well.
const LEAST: f32 = 0.03;

/// Whether rays are aimed at the sky at all: it is one colour, and seen through openings.
pub fn is_worth(trial: &Trial<'_>) -> bool {
    let scene = trial.engine.scene;
    let shines = scene.background.iter().any(|&x| x > 0.0) && scene.tables.lights.environment.is_none();
    if !shines || scene.max_bounces == 0 {
        return false;
    }
    let seed = hash3(trial.pass.seed, 0, 0x0007_21a2) as u32;
    found(trial.engine, seed, TRIAL, None, trial.pool).mean_chance(seed) > LEAST
}

/// The cells of so many paths, beside rays that are aimed at lights.
pub fn cells(engine: Engine<'_>, seed: u32, paths: u32, lights: Option<&Guide>, pool: &Pool) -> Cells {
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
        batch.items.extend((first..items.min(first + ITEMS as u32)).map(|k| item(engine.scene, seed, k, items)));
        trace(engine, seed, lights, batch)
    };
    let mut all = Seen::default();
    pool.each(batches as usize, trace).into_iter().for_each(|seen| all.append(seen));
    all
}

/// One of the k-th of so many equal shares of all quarters of the picture; where these are fewer, at another sample
/// index.
fn item(scene: &Scene, seed: u32, k: u32, count: u32) -> Item {
    let [across, down] = scene.size.map(|size| size.div_ceil(TILE));
    let all = u64::from(across) * u64::from(down) * u64::from(QUARTERS);
    let (sample, k) = ((u64::from(k) / all) as u32, u64::from(k) % all);
    let count = u64::from(count).min(all);
    let (first, end) = (all * k / count, (all * (k + 1) / count).max(all * k / count + 1).min(all));
    let quarter = first + hash3(seed, 0x001d_17ed, k as u32) % (end - first).max(1);
    let (tile, quarter) = ((quarter / u64::from(QUARTERS)) as u32, (quarter % u64::from(QUARTERS)) as u32);
    Item { block: Block::straight([tile % across, tile / across].map(|tile| tile as i32)), quarter, sample }
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
        if let Some([point, direction, from]) = left[place].filter(|_| !aside) {
            let origin = [0, 1, 2].map(|axis: usize| direction[axis].mul_add(FARTHEST, point[axis]));
            found.found.push(Photon { point, from, origin, flux: 1.0 });
        }
        if aside || left[place].is_some() {
            let sky: f32 = (0..3).map(|c| paths.throughput[c][i] * scene.background[c]).sum();
            found.brought[(slot & path::SLOT) as usize][0] += sky * paths.eta2[i];
        }
    }
}
