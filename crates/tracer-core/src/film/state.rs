//! The film as it was at the end of a pass, told while threads add to it.
//!
//! To copy a film takes as long as its memory: a tenth of a second and more at 3840x2160, in which nothing would be
//! rendered. So the next pass begins at once, and each tile is packed before anything is added to it: by the thread
//! that comes to it, or by one that goes over all tiles meanwhile, whichever is first.

use super::file::{FilmWriter, Note};
use super::head::FilmHead;
use super::record::record;
use super::{Film, Tile};
use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

/// Bytes that may wait for a slow disk; more come only from threads that must not wait themselves.
const MOST_WAITING: usize = 32 << 20;

/// What both ends know.
#[derive(Debug, Default)]
struct Queue {
    waiting: AtomicUsize,
    /// Nobody takes any more.
    closed: AtomicBool,
    /// The pass is over: whoever goes over all tiles must not wait any more.
    hurry: AtomicBool,
}

/// A film as it was between two passes ([`crate::Observer::state`]). It becomes whole while the rendering goes on, and
/// whoever writes it waits for that: on a thread of its own.
#[derive(Debug)]
pub struct FilmState {
    head: FilmHead,
    tiles: usize,
    records: Receiver<Vec<u8>>,
    queue: Arc<Queue>,
}

/// The end of it at the film.
#[derive(Debug)]
pub(crate) struct Keeper {
    records: Sender<Vec<u8>>,
    queue: Arc<Queue>,
}

impl Film {
    /// Its state, which the keeper has to be told: every tile once, before anything is added to it.
    pub(crate) fn state(&self) -> (Keeper, FilmState) {
        let (sender, receiver) = channel();
        let queue = Arc::new(Queue::default());
        let keeper = Keeper { records: sender, queue: queue.clone() };
        (keeper, FilmState { head: FilmHead::of(self), tiles: self.tiles.len(), records: receiver, queue })
    }
}

impl Keeper {
    /// Takes a tile as it is.
    pub fn keep(&self, place: usize, tile: &Tile) {
        if !self.is_closed() {
            let record = record(place, tile);
            self.queue.waiting.fetch_add(record.len(), Ordering::Relaxed);
            // If nobody takes it, nobody wants it.
            let _ = self.records.send(record);
        }
    }

    /// Whether nobody takes any more.
    pub fn is_closed(&self) -> bool {
        self.queue.closed.load(Ordering::Relaxed)
    }

    /// Waits while much waits for a slow disk.
    pub fn wait(&self) {
        let queue = &self.queue;
        while queue.waiting.load(Ordering::Relaxed) > MOST_WAITING
            && !self.is_closed()
            && !queue.hurry.load(Ordering::Relaxed)
        {
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// From now on nothing waits.
    pub fn hurry(&self) {
        self.queue.hurry.store(true, Ordering::Relaxed);
    }
}

impl FilmState {
    /// What it tells about itself.
    pub fn head(&self) -> &FilmHead {
        &self.head
    }

    /// Writes it, as [`Film::save`] does.
    ///
    /// # Errors
    /// When it cannot be written, or the rendering has panicked.
    pub fn save(mut self, to: &mut impl Write, notes: &[Note]) -> io::Result<u64> {
        self.head.notes = notes.to_vec();
        let mut writer = FilmWriter::new(to, &self.head)?;
        for _ in 0..self.tiles {
            let record =
                self.records.recv().map_err(|_| io::Error::other("the rendering ended before the film was whole"))?;
            self.queue.waiting.fetch_sub(record.len(), Ordering::Relaxed);
            writer.put(&record)?;
        }
        writer.end()
    }
}

impl Drop for FilmState {
    fn drop(&mut self) {
        self.queue.closed.store(true, Ordering::Relaxed);
    }
}
