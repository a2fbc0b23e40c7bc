//! How far the parts of a farm are, by their films, what the scripts have left, and Slurm's queue.

use super::queue::Queued;
use super::record::{Layout, Record};
use std::fs::{self, File};
use std::path::Path;
use tracer_core::{FilmError, SavedFilm};

/// Lines of a log that are told.
const LINES: usize = 5;

/// What becomes of a part, or of the merge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    Done,
    Running,
    Waiting,
    /// It has failed too often.
    Failed,
    /// It neither waits nor runs, and is not done: cancelled, out of time, or lost.
    Stopped,
}

impl State {
    pub fn word(self) -> &'static str {
        match self {
            State::Done => "done",
            State::Running => "running",
            State::Waiting => "waiting",
            State::Failed => "failed",
            State::Stopped => "stopped",
        }
    }

    /// Whether nothing more comes of it by itself, and it is not done.
    pub fn is_lost(self) -> bool {
        matches!(self, State::Failed | State::Stopped)
    }
}

/// What there is to tell of a part, or of the merge.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Told {
    pub state: State,
    /// Samples per pixel that its film has, and that it will have.
    pub samples: Option<[u32; 2]>,
    /// Where it runs, why it waits or has failed.
    pub note: String,
    /// The last lines of its log, where it will not go on.
    pub log: Vec<String>,
}

/// All parts, in order.
pub fn parts(layout: &Layout, record: &Record, queued: &[Queued]) -> Vec<Told> {
    (1..=record.parts).map(|part| of_part(layout, record, queued, part)).collect()
}

fn of_part(layout: &Layout, record: &Record, queued: &[Queued], part: u32) -> Told {
    let (samples, is_done, damage) = match head(&layout.film(part, record.parts)) {
        Ok(Some((samples, is_done))) => (Some(samples), is_done, None),
        Ok(None) => (None, false, None),
        Err(error) => (None, false, Some(error)),
    };
    if is_done {
        return Told { state: State::Done, samples, note: String::new(), log: Vec::new() };
    }
    let entry = queued.iter().find(|entry| entry.task == Some(part) && record.arrays.contains(&entry.job));
    let name = part.to_string();
    let mut told = told(layout, entry, &name, &format!("part-{part}"));
    told.samples = samples;
    if let Some(damage) = damage {
        told.note += &format!("{}its film cannot be used: {damage}", if told.note.is_empty() { "" } else { "; " });
    }
    let tries = read(&layout.state(&name, "tries"));
    if let (false, Some(last)) = (told.state == State::Failed, tries.lines().last()) {
        let times = tries.lines().count();
        let times = if times == 1 { "once".to_owned() } else { format!("{times} times") };
        told.note += &format!("{}failed {times} before: {last}", if told.note.is_empty() { "" } else { "; " });
    }
    told
}

/// The merge.
pub fn merge(layout: &Layout, record: &Record, queued: &[Queued]) -> Told {
    if layout.state("merge", "done").exists() {
        return Told { state: State::Done, samples: None, note: String::new(), log: Vec::new() };
    }
    let entry = queued.iter().find(|entry| Some(&entry.job) == record.merge.as_ref());
    told(layout, entry, "merge", "merge")
}

/// By Slurm's queue, and the script's last word.
fn told(layout: &Layout, entry: Option<&Queued>, name: &str, log: &str) -> Told {
    let (state, note) = match entry {
        Some(entry) if entry.is_running() => (State::Running, format!("on {} for {}", entry.node, entry.time)),
        Some(entry) => (State::Waiting, entry.why.clone()),
        None => match read(&layout.state(name, "failed")).trim() {
            "" => (State::Stopped, String::new()),
            why => (State::Failed, why.to_owned()),
        },
    };
    let log = if state.is_lost() { last_lines(&read(&layout.log(log))) } else { Vec::new() };
    Told { state, samples: None, note, log }
}

/// What a film tells of itself: samples that it has and will have, and whether these are all. `None`: there is none.
fn head(path: &Path) -> Result<Option<([u32; 2], bool)>, FilmError> {
    let file = match File::open(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        file => file.map_err(FilmError::Io)?,
    };
    let saved = SavedFilm::open(file)?;
    let (head, part) = (saved.head(), saved.head().part());
    let held = head.samples.start().saturating_sub(part.first);
    Ok(Some(([held, part.end - part.first], head.is_finished())))
}

/// Whether a film is whole, to its last byte.
///
/// # Errors
/// What is wrong with it.
pub fn check(path: &Path) -> Result<(), FilmError> {
    File::open(path).map_err(FilmError::Io).and_then(SavedFilm::open)?.check().map(drop)
}

/// What a script has left; nothing where there is no such file.
fn read(path: &Path) -> String {
    fs::read(path).map_or(String::new(), |bytes| String::from_utf8_lossy(&bytes).into_owned())
}

/// The last lines of a log, but for what the script itself says between.
fn last_lines(log: &str) -> Vec<String> {
    let lines: Vec<&str> = log.lines().filter(|line| !line.trim().is_empty() && !line.starts_with("== ")).collect();
    lines[lines.len().saturating_sub(LINES)..].iter().map(|line| (*line).to_owned()).collect()
}
