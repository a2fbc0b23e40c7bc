//! Where a checkpoint lies: its file, the one before, the one that is being written, and the lock.

use super::{Flushing, is_film};
use crate::failure::Failure;
use crate::write::{WriteError, forget_unfinished, probe, real_place, remember_unfinished};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// What is added to a checkpoint's name for the files beside it: the one before, the one that is being written, and the
/// lock.
pub const BESIDE: [&str; 3] = [PREVIOUS, WRITING, LOCK];
const PREVIOUS: &str = ".previous";
const WRITING: &str = ".writing";
const LOCK: &str = ".lock";

/// A checkpoint's name, and those of [`BESIDE`].
#[derive(Clone, Debug)]
pub struct Place {
    named: PathBuf,
    /// Links followed, and whole: what is renamed must not be a link, and the process may change its folder.
    real: PathBuf,
}

impl Place {
    /// Of a name on the command line, where a file can be written now.
    ///
    /// # Errors
    /// Why it cannot.
    pub fn new(path: &Path) -> Result<Self, Failure> {
        probe(path)?;
        let real = real_place(path).map_err(|why| WriteError::Io { path: path.to_owned(), why })?;
        if path.exists() && !path.is_file() {
            return Err(Failure::wrong(format!("{} is no file; a checkpoint needs one", path.display())));
        }
        Ok(Place { named: path.to_owned(), real })
    }

    /// Sees that none of the files that lie beside it is somebody else's: they are replaced and deleted.
    ///
    /// # Errors
    /// That one is.
    pub fn spare_beside(&self) -> Result<(), Failure> {
        for suffix in BESIDE {
            let path = self.with(suffix);
            let is_empty = path.metadata().map_or(true, |found| found.len() == 0);
            if path.is_dir() || !(is_empty || suffix != LOCK && (is_film(&path) || is_blank(&path))) {
                let shown = format!("{}{suffix}", self.name());
                return Err(Failure::wrong(format!(
                    "{shown} is no file of tracer's, and would be replaced beside {}; name another file",
                    self.name()
                )));
            }
        }
        Ok(())
    }

    /// The same without looking whether a file can be written now.
    ///
    /// # Errors
    /// When its folder is gone.
    pub fn unchecked(path: &Path) -> io::Result<Self> {
        Ok(Place { named: path.to_owned(), real: real_place(path)? })
    }

    /// As it was named.
    pub fn named(&self) -> &Path {
        &self.named
    }

    /// As it was named, to be shown.
    pub fn name(&self) -> String {
        self.named.display().to_string()
    }

    /// The file.
    pub fn file(&self) -> &Path {
        &self.real
    }

    /// Whether another name means the same file.
    pub fn is(&self, other: &Place) -> bool {
        self.real == other.real
    }

    /// The checkpoint before.
    pub fn previous(&self) -> PathBuf {
        self.with(PREVIOUS)
    }

    fn with(&self, suffix: &str) -> PathBuf {
        let mut name = self.real.as_os_str().to_owned();
        name.push(suffix);
        name.into()
    }

    fn folder(&self) -> &Path {
        self.real.parent().unwrap_or(Path::new("/"))
    }

    /// Makes its folder, should that be gone; whether it was.
    ///
    /// # Errors
    /// When it cannot be made.
    pub fn make_folder(&self) -> io::Result<bool> {
        if self.folder().is_dir() {
            return Ok(false);
        }
        fs::create_dir_all(self.folder()).map(|()| true)
    }

    /// Writes it whole or not at all; the one before stays under its other name if it is to be kept.
    ///
    /// # Errors
    /// When it could not be written; then what was there is as it was.
    pub fn write(&self, keep: bool, fill: impl FnOnce(&mut Flushing) -> io::Result<u64>) -> io::Result<u64> {
        let writing = self.with(WRITING);
        remember_unfinished(&writing);
        let written = self.write_as(&writing, keep, fill);
        if written.is_err() {
            // It may be what fills the disk.
            let _ = fs::remove_file(&writing);
        }
        forget_unfinished(&writing);
        written
    }

    fn write_as(
        &self,
        writing: &Path,
        keep: bool,
        fill: impl FnOnce(&mut Flushing) -> io::Result<u64>,
    ) -> io::Result<u64> {
        let mut file = Flushing::create(writing)?;
        let bytes = fill(&mut file)?;
        file.end()?;
        if keep && self.real.exists() {
            let previous = self.previous();
            let _ = fs::remove_file(&previous);
            // A second name, so that there is a checkpoint under the first at any moment; where there are no links, a
            // moment without.
            fs::hard_link(&self.real, &previous).or_else(|_| fs::rename(&self.real, &previous))?;
            fs::rename(writing, &self.real).inspect_err(|_| {
                // Should it have lost its name, it gets that back.
                if !self.real.exists() {
                    let _ = fs::rename(&previous, &self.real);
                }
            })?;
        } else {
            fs::rename(writing, &self.real)?;
        }
        // The name is on the disk only when the folder is; not all systems can do this.
        let _ = File::open(self.folder()).and_then(|folder| folder.sync_all());
        Ok(bytes)
    }

    /// Sees that no other process writes here.
    ///
    /// # Errors
    /// When one does.
    pub fn lock(&self) -> Result<Lock, Failure> {
        self.locked(self.try_lock())
    }

    /// The same for who only reads: where nobody may write, nobody has to be kept off.
    ///
    /// # Errors
    /// As [`Place::lock`].
    pub fn lock_to_read(&self) -> Result<Option<Lock>, Failure> {
        match self.try_lock() {
            Err(why) if matches!(why.kind(), io::ErrorKind::ReadOnlyFilesystem | io::ErrorKind::PermissionDenied) => {
                Ok(None)
            }
            tried => self.locked(tried).map(Some),
        }
    }

    fn locked(&self, tried: io::Result<Option<Lock>>) -> Result<Lock, Failure> {
        let name = self.name();
        match tried {
            Ok(Some(lock)) => Ok(lock),
            Ok(None) => {
                Err(Failure::could_not(format!("another process writes {name}; wait for it, or name another file")))
            }
            Err(error) => Err(Failure::could_not(format!("cannot lock {name}: {error}; name another place"))),
        }
    }

    /// The same; nothing where another process writes here.
    ///
    /// # Errors
    /// When the system does not tell.
    pub fn try_lock(&self) -> io::Result<Option<Lock>> {
        let path = self.with(LOCK);
        loop {
            let opened = OpenOptions::new().create_new(true).write(true).open(&path);
            let is_new = opened.is_ok();
            let file = opened.or_else(|error| match error.kind() {
                io::ErrorKind::AlreadyExists => OpenOptions::new().create(true).truncate(false).write(true).open(&path),
                _ => Err(error),
            });
            let file = file?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Ok(None),
                Err(TryLockError::Error(error)) => {
                    if is_new {
                        let _ = fs::remove_file(&path);
                    }
                    return Err(error);
                }
            }
            // Whatever ends the program by its own will takes it along.
            remember_unfinished(&path);
            let lock = Lock { file, path: path.clone() };
            // Whoever had it before may have deleted it since it was opened.
            if lock.is_the_file() {
                return Ok(Some(lock));
            }
        }
    }
}

/// Whether a file begins with zeros, as one does that was not yet on the disk when the power went.
fn is_blank(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(16).read_to_end(&mut head));
    read.is_ok() && head.iter().all(|&byte| byte == 0)
}

/// A lock that ends with the process, however that ends.
#[derive(Debug)]
pub struct Lock {
    file: File,
    path: PathBuf,
}

impl Lock {
    #[cfg(unix)]
    fn is_the_file(&self) -> bool {
        use std::os::unix::fs::MetadataExt;
        let id = |found: io::Result<fs::Metadata>| found.ok().map(|found| (found.dev(), found.ino()));
        id(self.file.metadata()).is_some_and(|mine| id(fs::metadata(&self.path)) == Some(mine))
    }

    #[cfg(not(unix))]
    fn is_the_file(&self) -> bool {
        // A file that is open cannot be deleted there.
        let _ = &self.file;
        true
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        if self.is_the_file() {
            let _ = fs::remove_file(&self.path);
        }
        forget_unfinished(&self.path);
    }
}
