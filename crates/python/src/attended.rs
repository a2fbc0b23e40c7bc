//! Long work, with Python going on beside it: other threads run, Ctrl-C comes through, progress is told.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How often Python is asked whether to go on.
const TICK: Duration = Duration::from_millis(50);

/// Work that was asked to stop is waited for so long; what takes longer ends by itself, and nobody hears of it.
const PATIENCE: Duration = Duration::from_secs(2);

/// Compiling goes as deep as on the program's own stack.
const STACK: usize = 8 << 20;

/// What those who work and those who wait tell each other.
#[derive(Default)]
pub struct Shared {
    /// It is to stop.
    pub stopped: AtomicBool,
    /// Samples done, and samples in all.
    pub done: AtomicU64,
    pub all: AtomicU64,
}

impl Shared {
    /// How much is done, 0 to 1.
    fn fraction(&self) -> f64 {
        let all = self.all.load(Ordering::Relaxed);
        if all == 0 { 0.0 } else { self.done.load(Ordering::Relaxed) as f64 / all as f64 }
    }
}

struct Slot<T> {
    result: Mutex<Option<std::thread::Result<T>>>,
    is_there: Condvar,
}

impl<T> Slot<T> {
    fn wait(&self, time: Duration) -> Option<std::thread::Result<T>> {
        let found = self.result.lock().unwrap_or_else(PoisonError::into_inner);
        let found = self.is_there.wait_timeout_while(found, time, |found| found.is_none());
        found.unwrap_or_else(PoisonError::into_inner).0.take()
    }
}

/// Does the work in a thread of its own, with a pool of so many threads for what it does in parallel (0: one per core).
/// Nothing of it outlives the call, so that a process may fork between two of them. `progress` is called in the thread
/// of the caller; `False` from it ends the work early.
///
/// # Errors
/// What Python raises meanwhile (Ctrl-C, the callback), after the work was stopped.
pub fn attended<T: Send + 'static>(
    py: Python<'_>,
    threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Shared) -> T + Send + 'static,
) -> PyResult<T> {
    let shared = Arc::new(Shared::default());
    let slot = Arc::new(Slot { result: Mutex::new(None), is_there: Condvar::new() });
    let (of_worker, its_slot) = (Arc::clone(&shared), Arc::clone(&slot));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build();
    let pool = pool.map_err(|error| PyRuntimeError::new_err(format!("cannot start threads: {error}")))?;
    let body = move || {
        let result = catch_unwind(AssertUnwindSafe(|| pool.install(|| work(&of_worker))));
        *its_slot.result.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
        its_slot.is_there.notify_all();
    };
    let spawned = std::thread::Builder::new().name("tracer".to_owned()).stack_size(STACK).spawn(body);
    spawned.map_err(|error| PyRuntimeError::new_err(format!("cannot start a thread: {error}")))?;
    let mut told = 0.0;
    loop {
        if let Some(result) = py.detach(|| slot.wait(TICK)) {
            let result = result.map_err(|panic| PyRuntimeError::new_err(message(&*panic)))?;
            if let Some(progress) = progress.filter(|_| !shared.stopped.load(Ordering::Relaxed)) {
                progress.call1((1.0,))?;
            }
            return Ok(result);
        }
        let fraction = shared.fraction();
        let asked = py.check_signals().and_then(|()| match progress.filter(|_| fraction > told) {
            Some(progress) => progress.call1((fraction,))?.extract::<Option<bool>>(),
            None => Ok(None),
        });
        told = fraction;
        match asked {
            Ok(Some(false)) => shared.stopped.store(true, Ordering::Relaxed),
            Ok(_) => {}
            Err(error) => {
                shared.stopped.store(true, Ordering::Relaxed);
                let until = Instant::now() + PATIENCE;
                py.detach(|| slot.wait(until.saturating_duration_since(Instant::now())));
                return Err(error);
            }
        }
    }
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    format!("an error of tracer itself, please report it: {}", text.unwrap_or("no message"))
}
