//! Checkpoints: the state of a rendering on the disk, so that it can be gone on with whatever happens to the process.

mod flushing;
mod hashes;
mod identity;
mod picture;
mod place;
mod read;
mod record;
mod told;

pub use flushing::Flushing;
pub use hashes::{HashOf, Hashes, Hashing, files_are_told};
pub use identity::{Asked, Extent, differences, is_of_scene, note_differences, notes, now, sha256_of};
pub use picture::{look, mattes, mattes_told, picture_layers, picture_notes, provenance, show_note};
pub use place::{BESIDE, Lock, Place};
pub use read::{Found, is_film, look_for};
pub use record::{Record, RecordedFile, assets_hash, told_name};
pub use told::{as_json, as_text, note, part_told};

use crate::memory::human;
use crate::shell::{Shell, Verbosity};
use crate::write::advice;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tracer_core::{Film, FilmState, Note};

/// The time between checkpoints where nobody says another.
pub const EVERY: Duration = Duration::from_secs(60);

/// Writes checkpoints, each on a thread of its own.
pub struct Checkpoints {
    every: Duration,
    inner: Arc<Inner>,
    turn: Mutex<Turn>,
}

struct Turn {
    last: Instant,
    writer: Option<JoinHandle<()>>,
}

struct Inner {
    place: Place,
    /// None where its folder was gone and another process came first.
    lock: Mutex<Option<Lock>>,
    notes: Vec<Note>,
    shell: Shell,
    /// What is at the place is worse than the one before.
    is_spoilt: AtomicBool,
    /// Why the last one could not be written, if so.
    failed: Mutex<Option<String>>,
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

impl Checkpoints {
    /// At a place that is locked; `is_spoilt`: what is there must not become the one before.
    pub fn new(place: Place, lock: Lock, every: Duration, notes: Vec<Note>, is_spoilt: bool, shell: Shell) -> Self {
        let inner = Inner {
            place,
            lock: Mutex::new(Some(lock)),
            notes,
            shell,
            is_spoilt: AtomicBool::new(is_spoilt),
            failed: Mutex::default(),
        };
        let turn = Turn { last: Instant::now(), writer: None };
        Checkpoints { every, inner: Arc::new(inner), turn: Mutex::new(turn) }
    }

    /// How long a pass may be: what it takes is lost with it, and what came since the last checkpoint.
    pub fn longest_pass(&self) -> Duration {
        /// However seldom checkpoints are wanted.
        const MOST: Duration = Duration::from_secs(60);
        (self.every / 3).min(MOST)
    }

    /// Whether it is time for the next one, and the last one is on the disk.
    pub fn is_due(&self) -> bool {
        let turn = locked(&self.turn);
        turn.last.elapsed() >= self.every && turn.writer.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Writes one, while the rendering goes on.
    pub fn begin(&self, state: FilmState) {
        let inner = Arc::clone(&self.inner);
        let samples = *state.head().samples.start();
        let work = move || {
            let written = inner.write(samples, |file, notes| state.save(file, notes));
            // The rendering goes on, and the next one may do better.
            inner.tell(&written);
        };
        let mut turn = locked(&self.turn);
        turn.last = Instant::now();
        // Without a thread there is none this time.
        turn.writer = std::thread::Builder::new().name("checkpoint".to_owned()).spawn(work).ok();
    }

    /// Writes the last one; gives its name.
    ///
    /// # Errors
    /// When it could not be written.
    pub fn end(self, film: &Film) -> anyhow::Result<String> {
        if let Some(writer) = locked(&self.turn).writer.take() {
            let _ = writer.join();
        }
        let inner = &self.inner;
        match inner.write(*film.samples().start(), |file, notes| film.save(file, notes)) {
            Ok(()) => Ok(inner.place.name()),
            Err(error) => Err(anyhow::Error::msg(inner.failure(&error))),
        }
    }
}

impl Inner {
    fn write(&self, samples: u32, save: impl FnOnce(&mut Flushing, &[Note]) -> io::Result<u64>) -> io::Result<()> {
        let started = Instant::now();
        let mut notes = self.notes.clone();
        notes.push(("when".to_owned(), identity::now()));
        if self.place.make_folder()? {
            self.shell.say(&format!("the folder of {} was gone: it is made again", self.place.name()));
            // The lock went with it.
            *locked(&self.lock) = self.place.lock().ok();
        }
        if locked(&self.lock).is_none() {
            return Err(io::Error::other("another process writes there now"));
        }
        let bytes = self.place.write(!self.is_spoilt.load(Ordering::Relaxed), |file| save(file, &notes))?;
        self.is_spoilt.store(false, Ordering::Relaxed);
        let seconds = started.elapsed().as_secs_f64();
        self.shell.explain(|| {
            let rate = human((bytes as f64 / seconds.max(1e-9)) as u64);
            format!(
                "checkpoint {}: {samples} samples per pixel, {} in {seconds:.2} s, {rate}/s",
                self.place.name(),
                human(bytes)
            )
        });
        Ok(())
    }

    /// Says what went wrong, once, and that it goes well again.
    fn tell(&self, written: &io::Result<()>) {
        let mut failed = locked(&self.failed);
        let now = written.as_ref().err().map(io::Error::to_string);
        match (&*failed, written) {
            (before, Err(error)) if *before != now => self.shell.say(&format!(
                "warning: {} (the rendering goes on, and the next checkpoint is tried at its time)",
                self.failure(error)
            )),
            (Some(_), Ok(())) if self.shell.verbosity > Verbosity::Quiet => {
                self.shell.say(&format!("checkpoints are written again: {}", self.place.name()));
            }
            _ => {}
        }
        *failed = now;
    }

    fn failure(&self, error: &io::Error) -> String {
        format!("cannot write the checkpoint {}: {error}; {}", self.place.name(), advice(error))
    }
}
