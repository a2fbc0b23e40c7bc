//! What tells that a file is the same without reading it.

use std::fs::{self, Metadata};
use std::io;
use std::path::Path;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Size and times of a file. The time of the last change of anything about it (Unix) shows also what was written and
/// then given an older time.
#[derive(Clone, Copy, Debug)]
pub struct Stamp {
    /// Bytes.
    pub bytes: u64,
    /// When it was looked at.
    pub seen: SystemTime,
    modified: SystemTime,
    changed: Option<SystemTime>,
}

/// Two writings may have one time where clocks of file systems are as coarse as this.
const COARSE: Duration = Duration::from_secs(2);

impl Stamp {
    /// Of the file that has this path now.
    ///
    /// # Errors
    /// When there is none, or the system knows no times.
    pub fn of(path: &Path) -> io::Result<Self> {
        let seen = SystemTime::now();
        let found = fs::metadata(path)?;
        Ok(Stamp { bytes: found.len(), seen, modified: found.modified()?, changed: changed(&found) })
    }

    /// Whether it is the stamp of a file that is as it was.
    pub fn is_same(&self, other: &Stamp) -> bool {
        (self.bytes, self.modified, self.changed) == (other.bytes, other.modified, other.changed)
    }

    /// Whether the file was left alone for so long before a moment that whoever writes it again gives it another stamp.
    pub fn is_settled(&self, at: SystemTime) -> bool {
        let last = self.changed.map_or(self.modified, |changed| changed.max(self.modified));
        at.duration_since(last).is_ok_and(|quiet| quiet > COARSE)
    }
}

impl std::fmt::Display for Stamp {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let nanoseconds = |time: SystemTime| match time.duration_since(UNIX_EPOCH) {
            Ok(after) => after.as_nanos().to_string(),
            Err(before) => format!("-{}", before.duration().as_nanos()),
        };
        let changed = self.changed.map_or_else(|| "none".to_owned(), nanoseconds);
        write!(f, "{} bytes, modified {}, changed {changed}", self.bytes, nanoseconds(self.modified))
    }
}

#[cfg(unix)]
fn changed(found: &Metadata) -> Option<SystemTime> {
    use std::os::unix::fs::MetadataExt;
    let seconds = u64::try_from(found.ctime()).ok()?;
    UNIX_EPOCH.checked_add(Duration::new(seconds, u32::try_from(found.ctime_nsec()).ok()?))
}

#[cfg(not(unix))]
fn changed(_: &Metadata) -> Option<SystemTime> {
    None
}
