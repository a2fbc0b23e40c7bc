//! Reading a whole input file, of the disk or of memory, and what can go wrong before its first byte is looked at.

use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, codes, plain_path};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{fs, io};

/// Files that are in memory, by their paths; all others are those of the disk.
///
/// ```
/// use std::path::Path;
/// use tracer_mesh::{Files, load_from};
///
/// let mut files = Files::default();
/// files.insert("models/a.off", *b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
/// let mesh = load_from(Path::new("models/a.off"), &files)?;
/// assert_eq!(mesh.triangles, [[0, 1, 2]]);
/// # Ok::<(), tracer_mesh::MeshError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Files {
    memory: BTreeMap<PathBuf, Arc<[u8]>>,
}

impl Files {
    /// Puts a file there, in place of one of the disk with that path.
    pub fn insert(&mut self, path: impl AsRef<Path>, bytes: impl Into<Arc<[u8]>>) {
        self.memory.insert(plain_path(path.as_ref()), bytes.into());
    }

    /// The file of this path that is in memory.
    pub fn get(&self, path: &Path) -> Option<&Arc<[u8]>> {
        if self.memory.is_empty() { None } else { self.memory.get(&plain_path(path)) }
    }

    /// All bytes of a file.
    ///
    /// # Errors
    /// As [`read_regular_file`].
    pub fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        self.get(path).map_or_else(|| read_regular_file(path), |bytes| Ok(bytes.to_vec()))
    }

    /// Whether there is such a file.
    pub fn has(&self, path: &Path) -> bool {
        self.get(path).is_some() || path.is_file()
    }
}

/// A mesh, texture, placements or MTL file that could not be read at all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
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
    /// A glTF file has no such picture, or a broken one.
    #[error("cannot take the picture out of {}: {why}", file.display())]
    Within {
        /// The glTF file.
        file: PathBuf,
        /// What is wrong with it.
        why: String,
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
            FileError::Within { .. } => Diagnostic::error(codes::FILE_UNREADABLE, span, self.to_string())
                .expected("a number of its `images`, counted from 0"),
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
