//! The files that a text names, as far as it could be read: they can be looked at even where the text itself is wrong.

use crate::diagnostic::Span;
use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;

/// What a file that a scene names holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FileKind {
    /// Triangles: OFF or OBJ.
    Mesh,
    /// Placements of a mesh, one a line.
    Placements,
    /// A picture.
    Texture,
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

    pub fn into_list(self) -> Vec<NamedFile> {
        self.list
    }
}
