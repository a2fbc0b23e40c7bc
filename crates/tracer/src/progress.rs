//! How far a rendering is: a bar with rate and time left on a terminal, else a line now and then.

use crate::checkpoint::Checkpoints;
use crate::interrupt;
use crate::shell::Shell;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use tracer_core::{FewNoisy, Film, FilmState, Observer, Progress};

/// Samples from which on a pixel's noise is more than chance.
const TOLD_FROM: u32 = 64;

/// What makes few pixels that noisy, mostly.
pub const SMALL: &str =
    "a light that is smaller than a pixel does that: camera_visible: false takes it out of the picture";

/// Watches a rendering: shows how far it is, ends it on Ctrl-C, and has its state kept.
pub struct Watch<'a> {
    bar: Option<ProgressBar>,
    lines: Option<Mutex<Lines>>,
    shell: Shell,
    begun: Instant,
    checkpoints: Option<&'a Checkpoints>,
    goals: Goals,
    /// Camera samples that were done before.
    before: u64,
    /// Camera samples that a noise goal will take, as far as one can tell.
    for_noise: AtomicU64,
    /// It was said that few pixels are left to become less noisy.
    few_told: AtomicBool,
    pace: Mutex<Pace>,
    /// Seconds left, as far as one can tell.
    left: Arc<AtomicU64>,
}

/// What may end a rendering before all samples are done.
#[derive(Clone, Copy, Debug, Default)]
pub struct Goals {
    /// The relative noise.
    pub noise: Option<f64>,
    /// The moment.
    pub until: Option<Instant>,
}

impl<'a> Watch<'a> {
    /// Draws only where somebody watches; elsewhere there are lines, unless nothing is to be said.
    pub fn new(shell: &Shell, samples: u64) -> Self {
        let left = Arc::new(AtomicU64::new(u64::MAX));
        let bar = shell.is_watched().then(|| {
            let template = match shell.width() {
                0..NARROW => "{wide_bar} {percent:>3} %",
                _ => "{wide_bar} {percent:>3} %  {rate}  {left}",
            };
            let left = left.clone();
            let style = ProgressStyle::with_template(template)
                .unwrap_or_else(|_| ProgressStyle::default_bar())
                .with_key("rate", |state: &ProgressState, out: &mut dyn Write| {
                    let _ = write!(out, "{}", rate(state.per_sec()));
                })
                .with_key("left", move |_: &ProgressState, out: &mut dyn Write| {
                    let _ = write!(out, "{}", left_in_words(left.load(Ordering::Relaxed)).unwrap_or_default());
                })
                .progress_chars("=> ");
            let target = ProgressDrawTarget::stderr_with_hz(10);
            ProgressBar::with_draw_target(Some(samples), target).with_style(style)
        });
        let begun = Instant::now();
        let lines = (bar.is_none() && shell.is_told()).then(|| Mutex::new(Lines { last: begun, tenths: 0 }));
        let (goals, for_noise) = (Goals::default(), AtomicU64::new(u64::MAX));
        let pace = Mutex::default();
        let few_told = AtomicBool::new(false);
        Watch { bar, lines, shell: *shell, begun, checkpoints: None, goals, before: 0, for_noise, few_told, pace, left }
    }

    /// The same, where so many samples were done before, and the state is kept.
    pub fn going_on(mut self, done: u64, of: u64, checkpoints: Option<&'a Checkpoints>) -> Self {
        if let Some(bar) = &self.bar {
            // What was done before says nothing about the time that is left.
            bar.update(|state| state.set_pos(done));
            bar.reset_eta();
        }
        if let Some(lines) = &mut self.lines {
            lines.get_mut().unwrap_or_else(PoisonError::into_inner).tenths = tenths(done, of);
        }
        Watch { checkpoints, before: done, ..self }
    }

    /// The same, where it may end sooner.
    pub fn until(self, goals: Goals) -> Self {
        Watch { goals, ..self }
    }

    /// How many samples it will be, as far as one can tell.
    fn expected(&self, progress: Progress) -> u64 {
        let now = Instant::now();
        let by_time = self.goals.until.map_or(u64::MAX, |until| {
            let (gone, left) = (now - self.begun, until.saturating_duration_since(now));
            let here = progress.samples_done.saturating_sub(self.before) as f64;
            progress.samples_done + (here * left.as_secs_f64() / gone.as_secs_f64().max(1e-3)) as u64
        });
        let by_noise = self.for_noise.load(Ordering::Relaxed).max(progress.samples_done);
        progress.samples_total.min(by_time).min(by_noise)
    }

    /// Notes how far it is, and how long it will take.
    fn note(&self, progress: Progress, all: u64) {
        let now = Instant::now();
        let mut pace = self.pace.lock().unwrap_or_else(PoisonError::into_inner);
        let by_pace = pace.left(progress.samples_done, all, now);
        let by_time = self.goals.until.map(|until| until.saturating_duration_since(now));
        let left = by_pace.into_iter().chain(by_time).min();
        self.left.store(left.map_or(u64::MAX, |left| left.as_secs_f64().round() as u64), Ordering::Relaxed);
    }

    /// Says once that the goal is reached but for a few pixels, which may take the rendering to its last sample.
    fn tell_few(&self, film: &Film, goal: f64) {
        if !self.shell.is_told() || *film.samples().start() < TOLD_FROM || self.few_told.load(Ordering::Relaxed) {
            return;
        }
        let Some(few) = film.few_noisy().filter(|few| few.rest <= goal && film.relative_noise() > goal) else { return };
        self.few_told.store(true, Ordering::Relaxed);
        let line = format!("noise: {}, which is good enough; {SMALL}", few_in_words(few));
        match &self.bar {
            Some(bar) => bar.suspend(|| self.shell.say(&line)),
            None => self.shell.say(&line),
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            // Of what took no time none is seen, not even while it is taken away.
            if self.begun.elapsed() < NO_BAR_BEFORE {
                bar.set_draw_target(ProgressDrawTarget::hidden());
            }
            bar.finish_and_clear();
        }
    }
}

impl Observer for Watch<'_> {
    fn progress(&self, progress: Progress) -> ControlFlow<()> {
        if let Some(bar) = self.bar.as_ref().filter(|_| self.begun.elapsed() >= NO_BAR_BEFORE) {
            let all = self.expected(progress);
            self.note(progress, all);
            bar.set_length(all);
            bar.set_position(progress.samples_done);
        }
        if let Some(lines) = &self.lines {
            let mut lines = lines.lock().unwrap_or_else(PoisonError::into_inner);
            let all = self.expected(progress);
            self.note(progress, all);
            if lines.is_due(tenths(progress.samples_done, all), Instant::now()) {
                let percent = 100 * progress.samples_done / all.max(1);
                let left = left_in_words(self.left.load(Ordering::Relaxed));
                let left = left.map_or(String::new(), |left| format!(", {left}"));
                self.shell.say(&format!("{percent} % after {}{left}", time(self.begun.elapsed())));
            }
        }
        if interrupt::requested().is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn pass(&self, film: &Film) {
        let Some(goal) = self.goals.noise else { return };
        let times = (film.relative_noise() / goal).powf(2.0 / film.noise_rate());
        self.for_noise.store((film.camera_samples() as f64 * times) as u64, Ordering::Relaxed);
        self.tell_few(film, goal);
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

/// How fast it goes: moments, and what was done then.
#[derive(Default)]
struct Pace(Vec<(u64, Instant)>);

impl Pace {
    /// How long the rest will take, where so much is done by now. The pace is that of the latter half of what was done:
    /// first passes are short, and come with what is made ready for all.
    fn left(&mut self, done: u64, all: u64, now: Instant) -> Option<Duration> {
        let first = self.0.first().map_or(done, |first| first.0);
        // Threads tell in any order.
        let here = done.saturating_sub(first);
        if self.0.last().is_none_or(|last| here > (last.0 - first) / 8 * 9) {
            self.0.push((done, now));
        }
        let half = first + here / 2;
        let since = self.0.iter().rev().find(|point| point.0 <= half)?;
        let seconds = (now - since.1).as_secs_f64() / done.saturating_sub(since.0).max(1) as f64;
        (done > since.0).then(|| Duration::try_from_secs_f64(seconds * all.saturating_sub(done) as f64).ok()).flatten()
    }
}

/// `12 s left`; nothing where one cannot tell.
fn left_in_words(seconds: u64) -> Option<String> {
    (seconds < u64::MAX).then(|| format!("{} left", time(Duration::from_secs(seconds))))
}

/// Terminals of fewer columns get the bar and a number.
const NARROW: usize = 60;
/// What is done sooner needs no bar.
const NO_BAR_BEFORE: Duration = Duration::from_millis(300);
/// Lines come no faster than this, and, while there is any progress, no slower than that.
const SOONEST: Duration = Duration::from_secs(10);
const LATEST: Duration = Duration::from_secs(60);

/// When the last line was said, and of which tenth of the work.
struct Lines {
    last: Instant,
    tenths: u64,
}

impl Lines {
    /// Whether a line is due: at another tenth, or after a minute.
    fn is_due(&mut self, tenths: u64, now: Instant) -> bool {
        let since = now.duration_since(self.last);
        let due = tenths > self.tenths && since >= SOONEST || since >= LATEST;
        if due {
            *self = Lines { last: now, tenths };
        }
        due
    }
}

fn tenths(done: u64, of: u64) -> u64 {
    10 * done / of.max(1)
}

/// `42 s`, `3 min 20 s`, `2 h 5 min`
fn time(duration: Duration) -> String {
    match duration.as_secs() {
        s @ 0..60 => format!("{s} s"),
        s @ 60..3600 => format!("{} min {} s", s / 60, s % 60),
        s => format!("{} h {} min", s / 3600, s % 3600 / 60),
    }
}

/// How noisy a picture of so many samples is, and what it takes to be less so; or who bears it, where few pixels do.
pub fn noise_of(film: &Film, samples: u32) -> Option<String> {
    let relative = film.relative_noise();
    let line = noise(relative, samples)?;
    Some(match film.few_noisy() {
        Some(few) => format!("noise {} %: {}", shown(100.0 * relative), few_in_words(few)),
        None => line,
    })
}

/// `noise 4 %, about 1000 samples for 1 %`. `None`: there is no noise, or one cannot tell.
///
/// Its square is taken to fall by the number of samples, which is what it comes to. It often falls faster between the
/// first of them, while guides get better and edges clear up, and that says nothing of what is left then: told by the
/// rate as it was seen, three scenes with rough metal or glass needed three to six times as many samples.
pub fn noise(relative: f64, samples: u32) -> Option<String> {
    if !(relative.is_finite() && relative > 1e-6) || samples < 2 {
        return None;
    }
    let percent = 100.0 * relative;
    let mut line = format!("noise {} %", shown(percent));
    // The next power of ten that is well below.
    if let Some(goal) = [10.0, 1.0, 0.1].into_iter().find(|goal| *goal * 1.5 <= percent) {
        let needed = f64::from(samples) * (percent / goal).powi(2);
        let unit = 10f64.powf((needed.log10() - 1.0).floor());
        let needed = (needed / unit).ceil() * unit;
        // More is no advice.
        if needed <= 1e9 {
            line += &format!(", about {needed:.0} samples for {goal} %");
        }
    }
    Some(line)
}

/// `3 pixels bear it, (80, 12) most; the others have 1.2 % at most`
fn few_in_words(FewNoisy { pixels, worst: [x, y], rest }: FewNoisy) -> String {
    let rest = shown(100.0 * rest);
    match pixels {
        1 => format!("one pixel bears it, ({x}, {y}); the others have {rest} % at most"),
        _ => format!("{pixels} pixels bear it, ({x}, {y}) most; the others have {rest} % at most"),
    }
}

/// A percentage as people say it.
fn shown(percent: f64) -> String {
    match percent {
        p if p >= 10.0 => format!("{p:.0}"),
        p => format!("{p:.1}").trim_end_matches(".0").to_owned(),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_at_tenths_but_not_too_often_and_each_minute() {
        let begun = Instant::now();
        let at = |seconds| begun + Duration::from_secs(seconds);
        let mut lines = Lines { last: begun, tenths: 0 };
        let said: Vec<u64> = [(1, 1), (9, 3), (10, 3), (15, 4), (20, 4), (79, 4), (80, 4), (100, 9)]
            .into_iter()
            .filter(|&(second, tenths)| lines.is_due(tenths, at(second)))
            .map(|(second, _)| second)
            .collect();
        assert_eq!(said, [10, 20, 80, 100]);
    }

    /// A rendering whose first tenth takes ten times as long: the pace is that of what comes.
    #[test]
    fn the_rest_is_told_by_the_latter_half() {
        let begun = Instant::now();
        let mut pace = Pace::default();
        let mut at = 0.0;
        for done in (500..1500).step_by(5) {
            at += if done < 600 { 0.05 } else { 0.005 };
            let left = pace.left(done, 1500, begun + Duration::from_secs_f64(at)).map(|left| left.as_secs_f64());
            let expected = (1500 - done) as f64 / 1000.0;
            let is_late = done > 740;
            assert!(left.is_some_and(|left| left >= 0.99 * expected) || done < 520, "{done}: {left:?}");
            assert!(!is_late || left.is_some_and(|left| left < 1.3 * expected + 0.01), "{done}: {left:?}, {expected}");
        }
        assert_eq!(Pace::default().left(7, 10, begun), None);
    }

    #[test]
    fn noise_is_told_with_what_it_takes() {
        assert_eq!(noise(0.04, 64).as_deref(), Some("noise 4 %, about 1100 samples for 1 %"));
        assert_eq!(noise(0.24, 32).as_deref(), Some("noise 24 %, about 190 samples for 10 %"));
        assert_eq!(noise(0.0123, 100).as_deref(), Some("noise 1.2 %, about 16000 samples for 0.1 %"));
        assert_eq!(noise(0.0012, 100).as_deref(), Some("noise 0.1 %"));
        for (relative, samples) in [(0.0, 64), (f64::NAN, 64), (0.3, 1)] {
            assert_eq!(noise(relative, samples), None);
        }
    }

    #[test]
    fn times_are_read_at_a_glance() {
        let shown = [0, 59, 61, 7500].map(|seconds| time(Duration::from_secs(seconds)));
        assert_eq!(shown, ["0 s", "59 s", "1 min 1 s", "2 h 5 min"]);
    }
}
