//! Why a picture could not be written.

use std::io;
use std::path::{Path, PathBuf};

/// Why a file could not be written. In all cases an older file of that name is as it was.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The folder that the file should be in is not there.
    #[error("cannot write {}: {}", path.display(), no_folder(folder))]
    NoFolder {
        /// The file.
        path: PathBuf,
        /// The folder.
        folder: PathBuf,
    },
    /// The name is a folder's.
    #[error("cannot write {}: it is a folder; name a file", path.display())]
    Folder {
        /// The file.
        path: PathBuf,
    },
    /// There is a file of that name that must not be changed.
    #[error("cannot write {}: the file is read-only; name another place, or make it writable", path.display())]
    ReadOnly {
        /// The file.
        path: PathBuf,
    },
    /// There is a file of that name that is not replaced without being asked.
    #[error("{} is there already; name another file, or replace it by --force", path.display())]
    There {
        /// The file.
        path: PathBuf,
    },
    /// There is a file of that name that is something else: it is not replaced.
    #[error("{} is there already and is no {noun}: it is not replaced; name another file", path.display())]
    Other {
        /// The file.
        path: PathBuf,
        /// What would be written.
        noun: &'static str,
    },
    /// The system says no: permission, disk full, a broken disk.
    #[error("cannot write {}: {why}; {}", path.display(), advice(why))]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        why: io::Error,
    },
    /// Standard output takes no more.
    #[error("cannot write to standard output")]
    Stdout(#[source] io::Error),
    /// The picture could not be put into bytes.
    #[error("cannot encode the picture as {encoding}: {message}")]
    Encode {
        /// The kind of file.
        encoding: &'static str,
        /// What the encoder says.
        message: String,
    },
    /// The picture is empty, or does not have three numbers for each pixel.
    #[error("the picture does not hold {width} x {height} pixels")]
    Picture {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
}

/// Why a file cannot be in a folder that is none: it is not there, or it, or what should hold it, is a file.
fn no_folder(folder: &Path) -> String {
    match folder.components().as_path().ancestors().find(|above| above.is_file()) {
        Some(file) => format!("{} is a file, and no folder; name another place", file.display()),
        None => format!("there is no folder {}; make it, or name another place", folder.display()),
    }
}

/// What to do where a file cannot be written.
pub fn advice(why: &io::Error) -> &'static str {
    match why.kind() {
        io::ErrorKind::FileTooLarge => "the system allows no file of this size here (ulimit -f): name another place",
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "make room there, or name another place",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => "name a place where you may write",
        _ => "name another place, should that stay so",
    }
}

impl WriteError {
    /// Whether the reader of standard output went away, which is no fault.
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, WriteError::Stdout(source) if source.kind() == io::ErrorKind::BrokenPipe)
    }
}
