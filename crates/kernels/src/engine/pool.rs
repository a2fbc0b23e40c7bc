//! Threads, and the memory of each.

use super::batch::Batch;
use crate::report::{Costs, Counters, Statistics};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard};

/// A batch for each thread. Threads are started for a work and end with it.
pub struct Pool {
    batches: Vec<Mutex<Batch>>,
}

/// What threads have counted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counted {
    /// Rays.
    pub counters: Counters,
    /// Seconds of the switches.
    pub costs: Costs,
    /// Seconds of the stages, and what the tree did.
    pub statistics: Statistics,
}

impl Pool {
    /// Of so many threads, at least one; with statistics or without.
    pub fn new(threads: usize, statistics: bool) -> Self {
        let batch = || {
            let mut batch = Batch::new();
            batch.watch.start(statistics);
            Mutex::new(batch)
        };
        Pool { batches: (0..threads.max(1)).map(|_| batch()).collect() }
    }

    /// Has all threads do a work, this one among them.
    pub fn on_all(&self, work: &(impl Fn(&mut Batch) + Sync)) {
        let [mine, others @ ..] = &*self.batches else { return };
        std::thread::scope(|scope| {
            for batch in others {
                // Where the system gives no more threads, those that there are do all of it.
                if std::thread::Builder::new().spawn_scoped(scope, || work(&mut lock(batch))).is_err() {
                    break;
                }
            }
            work(&mut lock(mine));
        });
    }

    /// Has the threads do pieces 0 .. `count` of a work, whoever is free the next one; the results in the order of the
    /// pieces.
    pub fn each<T: Send>(&self, count: usize, work: impl Fn(usize, &mut Batch) -> T + Sync) -> Vec<T> {
        let next = AtomicUsize::new(0);
        let results = Mutex::new(Vec::with_capacity(count));
        self.on_all(&|batch: &mut Batch| {
            let mut mine = Vec::new();
            loop {
                let k = next.fetch_add(1, Ordering::Relaxed);
                if k >= count {
                    break;
                }
                mine.push((k, work(k, batch)));
            }
            lock(&results).append(&mut mine);
        });
        let mut results = results.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        results.sort_by_key(|&(k, _)| k);
        results.into_iter().map(|(_, result)| result).collect()
    }

    /// Does a work on this thread.
    pub fn once<T>(&self, work: impl FnOnce(&mut Batch) -> T) -> T {
        work(&mut lock(&self.batches[0]))
    }

    /// Rays that were traced so far count for nothing.
    pub fn forget_counters(&self) {
        self.batches.iter().for_each(|batch| lock(batch).counters = Counters::default());
    }

    /// What all threads have counted so far.
    pub fn counted(&self) -> Counted {
        let mut sum = Counted::default();
        for batch in &self.batches {
            let Batch { counters, watch, .. } = &*lock(batch);
            sum.counters.add(counters);
            sum.costs.add(&watch.costs);
            sum.statistics.add(&watch.statistics);
        }
        sum
    }
}

/// What a thread that has panicked held is as good as any: the panic ends the rendering.
fn lock<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}
