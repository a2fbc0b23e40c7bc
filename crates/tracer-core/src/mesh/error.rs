//! What can be wrong with a mesh file.

use super::FileError;
use super::cursor::Fault;
use scene_format::Diagnostic;
use scene_format::codes;
use scene_format::diagnostic::Span;
use std::path::{Path, PathBuf};

/// Why a mesh could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file could not be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The extension names no format that is known here.
    #[error("{}: meshes of this type cannot be read", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The file (or its MTL file) is wrong.
    #[error("{}:{line}: {message}", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// 1-based line.
        line: u64,
        /// What is wrong.
        message: String,
        /// What was expected; may be empty.
        expected: String,
    },
    /// The file has no triangle.
    #[error("{}: the mesh has no triangles", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
        /// What the file has instead; may be empty.
        hint: String,
    },
}

impl MeshError {
    /// A fault at a byte of `text`.
    #[cold]
    pub(super) fn at_fault(path: &Path, text: &[u8], fault: Fault) -> MeshError {
        MeshError::Broken {
            path: path.to_owned(),
            line: fault.line_in(text),
            message: fault.message,
            expected: fault.expected,
        }
    }

    /// The diagnostic at `span` of the scene file: `E0501`, `E0502`, `E0510` (broken mesh) or `E0511` (empty mesh).
    pub fn to_diagnostic(&self, span: Span) -> Diagnostic {
        match self {
            MeshError::File(error) => error.to_diagnostic(span),
            MeshError::UnknownFormat { path } => {
                let packed =
                    path.extension().is_some_and(|e| ["gz", "zip", "xz", "bz2", "zst"].iter().any(|p| e == *p));
                let hint = if packed { "unpack the file first" } else { "export the mesh as OBJ or OFF" };
                Diagnostic::error(codes::FILE_UNREADABLE, span, self.to_string())
                    .expected("a mesh file that ends in `.obj` or `.off`")
                    .hint(hint)
            }
            MeshError::Broken { path, line, message, expected } => {
                Diagnostic::error(codes::BROKEN_MESH, span, format!("the mesh file is broken: {message}"))
                    .expected(expected.clone())
                    .at_line(path, *line)
            }
            MeshError::Empty { path, hint } => Diagnostic::error(codes::EMPTY_MESH, span, self.to_string())
                .expected("at least one triangle with an area")
                .hint(hint.clone())
                .at_line(path, 0),
        }
    }
}
