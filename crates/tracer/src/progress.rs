//! A bar with rate and time left, on a terminal.

use crate::checkpoint::Checkpoints;
use crate::interrupt;
use crate::shell::Shell;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::ops::ControlFlow;
use tracer_core::{FilmState, Observer, Progress};

/// Watches a rendering: shows how far it is, ends it on Ctrl-C, and has its state kept.
pub struct Watch<'a> {
    bar: Option<ProgressBar>,
    checkpoints: Option<&'a Checkpoints>,
}

impl<'a> Watch<'a> {
    /// Draws only where somebody watches.
    pub fn new(shell: &Shell, samples: u64) -> Self {
        let bar = shell.is_watched().then(|| {
            let template = "{bar:30} {percent:>3} %  {rate}  {eta} left";
            let style = ProgressStyle::with_template(template)
                .unwrap_or_else(|_| ProgressStyle::default_bar())
                .with_key("rate", |state: &ProgressState, out: &mut dyn Write| {
                    let _ = write!(out, "{}", rate(state.per_sec()));
                })
                .progress_chars("=> ");
            let target = ProgressDrawTarget::stderr_with_hz(10);
            ProgressBar::with_draw_target(Some(samples), target).with_style(style)
        });
        Watch { bar, checkpoints: None }
    }

    /// The same, where so many samples were done before, and the state is kept.
    pub fn going_on(self, done: u64, checkpoints: Option<&'a Checkpoints>) -> Self {
        if let Some(bar) = &self.bar {
            bar.set_position(done);
            // What was done before says nothing about the time that is left.
            bar.reset_eta();
        }
        Watch { checkpoints, ..self }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

impl Observer for Watch<'_> {
    fn progress(&self, progress: Progress) -> ControlFlow<()> {
        if let Some(bar) = &self.bar {
            bar.set_position(progress.samples_done);
        }
        if interrupt::requested().is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn wants_state(&self) -> bool {
        self.checkpoints.is_some_and(Checkpoints::is_due)
    }

    fn state(&self, state: FilmState) {
        if let Some(checkpoints) = self.checkpoints {
            checkpoints.begin(state);
        }
    }
}

/// `12.3 M samples/s`
pub fn rate(per_second: f64) -> String {
    match per_second {
        r if r >= 1e9 => format!("{:.1} G samples/s", r / 1e9),
        r if r >= 1e6 => format!("{:.1} M samples/s", r / 1e6),
        r if r >= 1e3 => format!("{:.1} k samples/s", r / 1e3),
        r => format!("{r:.0} samples/s"),
    }
}
