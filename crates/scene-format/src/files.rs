//! The files that a text names, as far as it could be read: they can be looked at even where the text itself is wrong.

use crate::diagnostic::{Diagnostic, Span};
use std::collections::HashSet;
use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

/// Scene files may have this many bytes (1 GiB).
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// Files that a scene includes, at most.
pub(crate) const MOST_FILES: usize = 256;

/// The bytes of a file; `None`: it has more than `most`. Of what is no regular file nobody knows the size before: no
/// more than that is read.
pub(crate) fn read(path: &Path, most: u64) -> std::io::Result<Option<Vec<u8>>> {
    let file = File::open(path)?;
    let size = file.metadata()?.len();
    if size > most {
        return Ok(None);
    }
    let mut bytes = Vec::with_capacity(size as usize);
    file.take(most + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= most).then_some(bytes))
}

/// What a file that a scene names holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FileKind {
    /// Triangles: OBJ, OFF, PLY, STL, glTF or GLB.
    Mesh,
    /// Placements of a mesh, one a line.
    Placements,
    /// A picture.
    Texture,
    /// A picture of all directions.
    Environment,
    /// A picture of heights.
    Heights,
    /// A scene, or a library of materials and values.
    Scene,
}

/// A file that a scene names, and where it first does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedFile {
    /// What it should hold.
    pub kind: FileKind,
    /// As it is written, relative to the scene's folder.
    pub path: Arc<Path>,
    /// The place in the scene.
    pub span: Span,
}

/// More files than this are not kept: as many faults as are listed.
const MAX_FILES: usize = 1000;

/// Files in the order in which they were read, each once.
#[derive(Debug, Default)]
pub(crate) struct Files {
    list: Vec<NamedFile>,
    known: HashSet<(FileKind, Arc<Path>)>,
}

impl Files {
    pub fn add(&mut self, kind: FileKind, path: &Arc<Path>, span: Span) {
        let last = self.list.last().is_some_and(|last| last.kind == kind && Arc::ptr_eq(&last.path, path));
        if !last && self.list.len() < MAX_FILES && self.known.insert((kind, Arc::clone(path))) {
            self.list.push(NamedFile { kind, path: Arc::clone(path), span });
        }
    }

    /// Those that stand on none of these lines.
    pub fn outside(self, lines: &[Range<u32>]) -> Vec<NamedFile> {
        let mut list = self.list;
        list.retain(|file| file.span.source != 0 || !lines.iter().any(|line| line.contains(&file.span.start)));
        list
    }
}

/// The lines on which the syntax is broken: where a quote is missing, what stands between two others is no name.
pub(crate) fn broken_lines(text: &str, faults: &[Diagnostic]) -> Vec<Range<u32>> {
    let bytes = text.as_bytes();
    let mut lines: Vec<Range<u32>> = Vec::new();
    for fault in faults.iter().filter(|fault| fault.code.is_syntax() && fault.span.source == 0) {
        let at = (fault.span.start as usize).min(bytes.len());
        // A long line with many faults is looked for once.
        if lines.iter().any(|line| line.contains(&(at as u32))) {
            continue;
        }
        let start = bytes[..at].iter().rposition(|&byte| byte == b'\n').map_or(0, |newline| newline + 1);
        let end = bytes[at..].iter().position(|&byte| byte == b'\n').map_or(bytes.len(), |newline| at + newline + 1);
        lines.push(start as u32..end as u32);
    }
    lines
}

/// A path from the scene's folder, for a name in a file of this folder: [`plain_path`] of both.
pub(crate) fn joined(folder: &Path, name: &str) -> PathBuf {
    plain_path(&folder.join(name))
}

/// One of the names that a path has: without `.`, and without `..` where that leads back. No file is looked at; where a
/// folder is a link, it may be another one.
pub fn plain_path(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if matches!(out.components().next_back(), Some(Component::Normal(_))) => {
                out.pop();
            }
            part => out.push(part),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What never ends is read as far as is allowed.
    #[cfg(unix)]
    #[test]
    fn files_are_read_up_to_a_limit() {
        assert_eq!(read(Path::new("/dev/zero"), 1000).expect("can be read"), None);
        assert_eq!(read(Path::new("/dev/null"), 1000).expect("can be read"), Some(Vec::new()));
        let manifest = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml"));
        assert_eq!(read(manifest, 10).expect("can be read"), None);
        assert!(read(manifest, 1 << 20).expect("can be read").is_some_and(|bytes| bytes.starts_with(b"[package]")));
    }

    #[test]
    fn names_start_from_the_folder_of_the_file_that_they_stand_in() {
        for (folder, name, path) in [
            ("", "a.ron", "a.ron"),
            ("parts", "a.ron", "parts/a.ron"),
            ("parts", "../a.ron", "a.ron"),
            ("parts/x", "./../y/a.ron", "parts/y/a.ron"),
            ("", "../a.ron", "../a.ron"),
            ("../x", "../a.ron", "../a.ron"),
            ("parts", "/a.ron", "/a.ron"),
        ] {
            assert_eq!(joined(Path::new(folder), name), Path::new(path), "{folder} {name}");
        }
    }
}
