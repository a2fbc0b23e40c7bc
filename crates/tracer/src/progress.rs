//! A bar with rate and time left, on a terminal.

use crate::interrupt;
use crate::shell::Shell;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::ops::ControlFlow;
use tracer_core::{Observer, Progress};

/// Watches a rendering: shows how far it is, and ends it on Ctrl-C.
pub struct Watch {
    bar: Option<ProgressBar>,
}

impl Watch {
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
            ProgressBar::with_draw_target(Some(samples), ProgressDrawTarget::stderr_with_hz(10)).with_style(style)
        });
        Watch { bar }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

impl Observer for Watch {
    fn progress(&self, progress: Progress) -> ControlFlow<()> {
        if let Some(bar) = &self.bar {
            bar.set_position(progress.samples_done);
        }
        if interrupt::requested().is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
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
