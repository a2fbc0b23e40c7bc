//! Who watches a rendering.

use crate::film::{Film, FilmState};
use std::ops::ControlFlow;

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
    /// Asked between passes, after [`Observer::pass`]: whether the film is wanted as it is now, to be kept while the
    /// rendering goes on.
    fn wants_state(&self) -> bool {
        false
    }
    /// Gives it, if it was wanted. It becomes whole in the next pass, so it must be written by a thread of its own.
    fn state(&self, _state: FilmState) {}
}

/// Renders without being watched.
pub struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
