//! The watch: sees that a file of the scene has changed.
//!
//! What counts is the files' stamps (time, size, number); the system's events only say when to look. Folders are
//! watched, not files, since most editors save by renaming another file to the scene's name, which ends the watch of
//! a file for ever. Where the system has no events (a network's folder, too many watches) the files are looked at
//! twice a second.

use crate::files::stamp;
use crate::shared::{Shared, lock};
use notify::{EventKind, RecommendedWatcher, RecursiveMode, Watcher};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Weak};
use std::time::{Duration, Instant};

/// How often files are looked at without an event.
const LOOK: Duration = Duration::from_millis(500);
/// Files that stay the same so long have been written.
const SETTLED: Duration = Duration::from_millis(12);
/// So long at most is waited for that.
const LONGEST: Duration = Duration::from_millis(300);
/// Some editors empty or delete a file before they write it: so long is waited for its text.
const EMPTY: Duration = Duration::from_millis(250);

/// Watches until nobody needs it any more.
pub fn run(shared: Arc<Shared>) {
    let (sender, events) = channel();
    let tell = move |event: notify::Result<notify::Event>| {
        // That a file was read is no news, and reading it again would be more of it. Whoever listened is gone: nor is
        // that.
        let paths = match event {
            Ok(notify::Event { kind: EventKind::Access(_), .. }) => return,
            Ok(event) => event.paths,
            Err(_) => Vec::new(),
        };
        let _ = sender.send(paths);
    };
    let mut watcher = notify::recommended_watcher(tell).ok();
    let mut folders = BTreeSet::new();
    let weak = Arc::downgrade(&shared);
    drop(shared);
    while step(&weak, &events, watcher.as_mut(), &mut folders) {}
}

/// Waits for an event, and looks; whether the watch goes on.
fn step(
    shared: &Weak<Shared>,
    events: &Receiver<Vec<PathBuf>>,
    watcher: Option<&mut RecommendedWatcher>,
    folders: &mut BTreeSet<PathBuf>,
) -> bool {
    let mut came = match events.recv_timeout(LOOK) {
        Ok(paths) => paths,
        Err(RecvTimeoutError::Timeout) => Vec::new(),
        Err(RecvTimeoutError::Disconnected) => {
            // There are no events here.
            std::thread::sleep(LOOK);
            Vec::new()
        }
    };
    let Some(shared) = shared.upgrade() else { return false };
    came.extend(events.try_iter().flatten());
    if let Some(watcher) = watcher {
        follow(watcher, folders, lock(&shared.watched).folders());
    }
    if lock(&shared.watched).counts(&came) {
        settle(&shared);
        // Unless it was read while it settled.
        let mut watched = lock(&shared.watched);
        if watched.counts(&came) {
            let touched = watched.is_only_touched();
            watched.before_reading(&came);
            drop(watched);
            if !touched {
                shared.order(|orders| orders.reload = true);
            }
        }
    }
    true
}

/// Watches these folders, and no others.
fn follow(watcher: &mut RecommendedWatcher, folders: &mut BTreeSet<PathBuf>, wanted: BTreeSet<PathBuf>) {
    for old in folders.difference(&wanted) {
        // Gone with its folder: so is the watch.
        let _ = watcher.unwatch(old);
    }
    let kept = folders.intersection(&wanted).cloned();
    // What cannot be watched is looked at.
    let new = wanted.difference(folders).filter(|new| watcher.watch(new, RecursiveMode::NonRecursive).is_ok()).cloned();
    *folders = kept.chain(new).collect();
}

/// Waits until all files have been written.
fn settle(shared: &Shared) {
    let began = Instant::now();
    loop {
        let (before, scene) = {
            let watched = lock(&shared.watched);
            (watched.now(), watched.scene.clone())
        };
        std::thread::sleep(SETTLED);
        let is_empty = stamp(&scene).is_none_or(|(_, length, _)| length == 0);
        let same = before == lock(&shared.watched).now();
        let longest = if is_empty { EMPTY } else { LONGEST };
        if began.elapsed() > longest || same && !is_empty {
            return;
        }
    }
}
