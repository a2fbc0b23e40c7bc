//! Photons from the lights to where they are stored.

use crate::engine::technique::Engine;
use crate::engine::trace::closest;
use std::time::Instant;
use tracer_kernels::engine::batch::{Batch, Columns, PATHS, Photons};
use tracer_kernels::engine::guide::cells::Photon;
use tracer_kernels::engine::guide::plan::{Plan, Share};
use tracer_kernels::engine::pass::PhotonPass;
use tracer_kernels::engine::pool::Pool;
use tracer_kernels::report::Stage;

/// What became of photons.
#[derive(Default)]
pub struct Sent {
    /// What was stored, in an order that depends on nothing else.
    pub stored: Vec<Photon>,
    /// How many met the caster that they were sent at, and went on from there.
    pub met: u32,
}

/// Sends so many photons.
pub fn photons(engine: Engine<'_>, plan: &Plan, seed: u32, count: u32, pool: &Pool) -> Sent {
    let batches = batches(plan.shares(count));
    let trace = |k: usize, batch: &mut Batch| trace(engine, plan, seed, &batches[k], batch);
    let mut all = Sent::default();
    for Sent { mut stored, met } in pool.each(batches.len(), trace) {
        all.stored.append(&mut stored);
        all.met += met;
    }
    all
}

/// Cuts the shares into batches of at most [`PATHS`] photons.
pub fn batches(shares: impl Iterator<Item = Share>) -> Vec<Vec<Share>> {
    let mut batches = vec![Vec::new()];
    let mut room = PATHS as u32;
    for share in shares {
        let mut rest = share;
        while rest.count > 0 {
            if room == 0 {
                batches.push(Vec::new());
                room = PATHS as u32;
            }
            let count = rest.count.min(room);
            if let Some(batch) = batches.last_mut() {
                batch.push(Share { count, ..rest });
            }
            rest = Share { first: rest.first.wrapping_add(count), count: rest.count - count, ..rest };
            room -= count;
        }
    }
    batches
}

/// One batch.
fn trace(engine: Engine<'_>, plan: &Plan, seed: u32, shares: &[Share], batch: &mut Batch) -> Sent {
    let Engine { scene, kernels, .. } = engine;
    let count = load(shares, batch);
    batch.watch.resume();
    let start = Instant::now();
    kernels.photons_emit(scene, plan, PhotonPass { seed, count, light_paths: None }, batch);
    let mut sent = Sent::default();
    let mut event = 0;
    while batch.paths.len > 0 {
        closest(engine, false, batch);
        batch.photons.len = 0;
        kernels.photons_scatter(scene, plan, seed, event, batch);
        store(&batch.photons, &mut sent.stored);
        if event == 0 {
            sent.met = batch.paths.len as u32;
        }
        event += 1;
    }
    batch.watch.lap(Stage::Photons);
    batch.watch.costs.photons_since(start);
    sent
}

/// The photons of a batch; how many.
pub fn load(shares: &[Share], batch: &mut Batch) -> usize {
    let mut count = 0;
    for share in shares {
        for k in 0..share.count {
            batch.photons.pair[count] = share.pair;
            batch.photons.index[count] = share.first.wrapping_add(k);
            count += 1;
        }
    }
    count
}

/// Appends what one event stored.
fn store(photons: &Photons, stored: &mut Vec<Photon>) {
    let at = |columns: &Columns, k: usize| [columns[0][k], columns[1][k], columns[2][k]];
    stored.extend((0..photons.len).map(|k| Photon {
        point: at(&photons.point, k),
        from: at(&photons.from, k),
        origin: at(&photons.origin, k),
        flux: photons.flux[k],
    }));
}
