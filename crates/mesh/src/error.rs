//! What can be wrong with a mesh file.

use super::cursor::Fault;
use super::files::FileError;
use super::format::MeshFormat;
use scene_format::Diagnostic;
use scene_format::codes;
use scene_format::diagnostic::{Excerpt, Span};
use std::fmt;
use std::path::{Path, PathBuf};

/// A place in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// 1-based line of a text.
    Line(u64),
    /// Byte of a binary file, counted from 0.
    Byte(u64),
}

/// As it follows the name of the file.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line(line) => write!(f, ":{line}"),
            Place::Byte(byte) => write!(f, ": byte {byte}"),
        }
    }
}

/// Why a mesh could not be loaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
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
    #[error("{}{place}: {message}", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// Where in it.
        place: Place,
        /// What is wrong.
        message: String,
        /// What was expected; may be empty.
        expected: String,
        /// The line, where it can be shown.
        excerpt: Option<Box<Excerpt>>,
    },
    /// The file cannot be read without an extension of glTF that is not known here.
    #[error("{}: the file requires the glTF extension `{name}`", path.display())]
    Extension {
        /// The file.
        path: PathBuf,
        /// The extension.
        name: String,
    },
    /// The arrays of a mesh in memory are wrong.
    #[error("the mesh {}: {message}", path.display())]
    Arrays {
        /// The name that the scene gives it.
        path: PathBuf,
        /// What is wrong.
        message: String,
        /// What was expected.
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
    /// A fault in a line of `text`.
    #[cold]
    pub(super) fn at_line(path: &Path, text: &[u8], fault: Fault) -> MeshError {
        let (place, excerpt) = (Place::Line(fault.line_in(text)), Excerpt::around(text, fault.at).map(Box::new));
        MeshError::Broken { path: path.to_owned(), place, message: fault.message, expected: fault.expected, excerpt }
    }

    /// A fault at a byte of a binary file.
    #[cold]
    pub(super) fn at_byte(path: &Path, fault: Fault) -> MeshError {
        let place = Place::Byte(fault.at as u64);
        let excerpt = None;
        MeshError::Broken { path: path.to_owned(), place, message: fault.message, expected: fault.expected, excerpt }
    }

    /// The diagnostic at `span` of the scene file: `E0501`, `E0502`, `E0510` (broken mesh), `E0511` (empty
    /// mesh) or `E0513` (an extension is needed).
    pub fn to_diagnostic(&self, span: Span) -> Diagnostic {
        match self {
            MeshError::File(error) => error.to_diagnostic(span),
            MeshError::UnknownFormat { path } => {
                let packed =
                    path.extension().is_some_and(|e| ["gz", "zip", "xz", "bz2", "zst"].iter().any(|p| e == *p));
                let hint = if packed {
                    "unpack the file first".to_owned()
                } else {
                    format!("export the mesh as {}", MeshFormat::list(|format| format.name().to_owned()))
                };
                let extensions = MeshFormat::list(|format| format!("`.{}`", format.extension()));
                Diagnostic::error(codes::FILE_UNREADABLE, span, self.to_string())
                    .expected(format!("a mesh file that ends in {extensions}"))
                    .hint(hint)
            }
            MeshError::Broken { path, place, message, expected, excerpt } => {
                let (at, line) = match *place {
                    Place::Line(line) => (String::new(), line),
                    Place::Byte(byte) => (format!(" at byte {byte}"), 0),
                };
                Diagnostic::error(codes::BROKEN_MESH, span, format!("the mesh file is broken{at}: {message}"))
                    .expected(expected.clone())
                    .at_line(path, line)
                    .showing(excerpt.as_deref().cloned())
            }
            MeshError::Extension { path, name } => {
                let message = format!("the mesh file requires the glTF extension `{name}`, which is not known here");
                let hint = match name.contains("compression") {
                    true => "export it without compression",
                    false => "export it without this extension",
                };
                Diagnostic::error(codes::GLTF_EXTENSION, span, message)
                    .expected("a glTF file that requires no extension but KHR_mesh_quantization")
                    .hint(hint)
                    .at_line(path, 0)
            }
            MeshError::Arrays { expected, .. } => {
                Diagnostic::error(codes::BROKEN_MESH, span, self.to_string()).expected(expected.clone())
            }
            MeshError::Empty { path, hint } => Diagnostic::error(codes::EMPTY_MESH, span, self.to_string())
                .expected("at least one triangle with an area")
                .hint(hint.clone())
                .at_line(path, 0),
        }
    }
}
