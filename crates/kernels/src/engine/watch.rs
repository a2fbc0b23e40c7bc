//! The clock of a thread: keeps where its time goes.

use crate::report::{Costs, Stage, Statistics};
use std::time::Instant;

/// Keeps the statistics of a thread, or nothing.
#[derive(Debug, Default)]
pub struct Watch {
    last: Option<Instant>,
    /// What was counted since it was started.
    pub statistics: Statistics,
    /// Kept whether statistics are or not.
    pub costs: Costs,
}

impl Watch {
    /// Starts the time of a batch; `on`: there is somebody to tell.
    pub fn start(&mut self, on: bool) {
        self.last = on.then(Instant::now);
    }

    /// Goes on after other work, if statistics are kept.
    pub fn resume(&mut self) {
        self.last = self.last.map(|_| Instant::now());
    }

    /// Whether statistics are kept.
    pub fn is_on(&self) -> bool {
        self.last.is_some()
    }

    /// All time since the last lap was spent on this stage.
    pub fn lap(&mut self, stage: Stage) {
        if let Some(last) = &mut self.last {
            let now = Instant::now();
            self.statistics.seconds[stage as usize] += now.duration_since(*last).as_secs_f64();
            *last = now;
        }
    }

    /// So many paths were shaded, over so many lanes at a time.
    pub fn shaded(&mut self, paths: usize, lanes: usize) {
        if self.is_on() {
            self.statistics.vertices += paths as u64;
            self.statistics.lanes += paths.next_multiple_of(lanes) as u64;
        }
    }
}
