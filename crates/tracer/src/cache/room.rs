//! How much a folder takes: what was used longest ago goes first.

use crate::checkpoint::{BESIDE, Place};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// What a process has left that was killed is older, whatever the disk.
const LEFT: Duration = Duration::from_secs(3600);

struct Kept {
    /// Records come last: they take nothing.
    is_record: bool,
    used: SystemTime,
    bytes: u64,
    path: PathBuf,
}

/// Makes room for so many bytes. Nothing but files of a cache is counted or deleted.
///
/// # Errors
/// The folder cannot be listed, or what must go cannot be deleted.
pub fn make(folder: &Path, most: u64, needed: u64) -> io::Result<()> {
    let mut kept = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let Some(name) = name.to_str() else { continue };
        // What has gone meanwhile is gone.
        let Ok(found) = entry.metadata() else { continue };
        let used = found.modified().unwrap_or(SystemTime::UNIX_EPOCH);
        let is_old = || SystemTime::now().duration_since(used).is_ok_and(|age| age > LEFT);
        let path = entry.path();
        if is_kept(name) {
            kept.push(Kept { is_record: name.starts_with("hash-"), used, bytes: found.len(), path });
        } else if name.starts_with(".tracer-") && name.ends_with(".tmp") && is_old() {
            let _ = fs::remove_file(path);
        } else if let Some(of) = beside(name).filter(|_| is_old()) {
            clear(&folder.join(of), &path);
        }
    }
    kept.sort_by_key(|file| (file.is_record, file.used));
    let mut sum: u64 = kept.iter().map(|file| file.bytes).sum();
    for file in kept {
        if sum.saturating_add(needed) <= most {
            break;
        }
        match fs::remove_file(&file.path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => sum -= file.bytes,
        }
    }
    Ok(())
}

fn is_kept(name: &str) -> bool {
    name.ends_with(".kept") && ["mesh-", "tree-", "hash-"].iter().any(|kind| name.starts_with(kind))
}

/// The file that one lies beside which a killed process has left.
fn beside(name: &str) -> Option<&str> {
    BESIDE.iter().find_map(|suffix| name.strip_suffix(suffix)).filter(|name| is_kept(name))
}

/// Deletes what a killed process has left beside a file, unless somebody is at work there.
fn clear(of: &Path, left: &Path) {
    if let Ok(Some(_lock)) = Place::unchecked(of).and_then(|place| place.try_lock()) {
        // The lock takes its own file along.
        let _ = fs::remove_file(left);
    }
}
