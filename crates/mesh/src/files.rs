//! Reading a whole input file, and what can go wrong before its first byte is looked at.

use scene_format::Diagnostic;
use scene_format::codes;
use scene_format::diagnostic::Span;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A mesh, texture, placements or MTL file that could not be read at all.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// Nothing is there.
    #[error("there is no file {}", path.display())]
    NotFound {
        /// The file.
        path: PathBuf,
        /// A file of the same folder whose name differs only in upper and lower case.
        similar: Option<OsString>,
    },
    /// Something is there that cannot be read.
    #[error("cannot read {}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A folder, pipe or device.
    #[error("{} is not a regular file", path.display())]
    NotRegular {
        /// The path.
        path: PathBuf,
    },
}

impl FileError {
    /// `E0501` (no such file) or `E0502` (cannot be read), at `span` of the scene file.
    pub fn to_diagnostic(&self, span: Span) -> Diagnostic {
        match self {
            FileError::NotFound { similar, .. } => {
                let diagnostic = Diagnostic::error(codes::FILE_NOT_FOUND, span, self.to_string());
                match similar {
                    Some(name) => diagnostic.hint(format!("the folder has `{}`", name.display())),
                    None => diagnostic.hint("paths are relative to the folder of the scene file"),
                }
            }
            FileError::Unreadable { source, .. } => {
                Diagnostic::error(codes::FILE_UNREADABLE, span, format!("{self}: {source}"))
            }
            FileError::NotRegular { .. } => Diagnostic::error(codes::FILE_UNREADABLE, span, self.to_string())
                .expected("a file, not a folder, pipe or device"),
        }
    }
}

/// All bytes of a regular file. Pipes and devices are refused, since they may never end.
///
/// # Errors
/// When nothing is there, it is no regular file, or it cannot be read.
pub fn read_regular_file(path: &Path) -> Result<Vec<u8>, FileError> {
    let unreadable = |source: io::Error| {
        // A path through a file (`a.obj/b.obj`) is as absent as one through nothing.
        if matches!(source.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) {
            FileError::NotFound { path: path.to_owned(), similar: name_in_other_case(path) }
        } else {
            FileError::Unreadable { path: path.to_owned(), source }
        }
    };
    if !fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(FileError::NotRegular { path: path.to_owned() });
    }
    fs::read(path).map_err(unreadable)
}

/// The file beside `path` that has its name but for upper and lower case.
fn name_in_other_case(path: &Path) -> Option<OsString> {
    let wanted = path.file_name()?.to_str()?.to_lowercase();
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut names: Vec<OsString> = fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| Some(entry.ok()?.file_name()))
        .filter(|name| name.to_str().is_some_and(|name| name.to_lowercase() == wanted))
        .collect();
    names.sort();
    names.into_iter().next()
}
