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
    /// The file has no part of this name.
    #[error("{}: there is no part {part}", path.display())]
    UnknownPart {
        /// The file.
        path: PathBuf,
        /// The name that was asked for, in quotes, as all of these are.
        part: String,
        /// What parts of such files are: `objects and groups`.
        kinds: &'static str,
        /// The name of a part that is most like it.
        nearest: Option<String>,
        /// The first names of parts.
        names: Vec<String>,
        /// How many there are in all.
        count: usize,
    },
    /// A part is asked for, and files of this format have none.
    #[error("{}: {what} have no parts", path.display())]
    NoParts {
        /// The file.
        path: PathBuf,
        /// What they are called: `PLY files`.
        what: String,
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
    /// Whether it is about the part that was asked for, not about the file.
    pub fn is_of_part(&self) -> bool {
        matches!(self, MeshError::UnknownPart { .. } | MeshError::NoParts { .. })
    }

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
    /// mesh), `E0513` (an extension is needed) or `E0514` (a part that it does not have).
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
                    .expected(
                        "a glTF file that requires no extension but KHR_mesh_quantization and EXT_mesh_gpu_instancing",
                    )
                    .hint(hint)
                    .at_line(path, 0)
            }
            MeshError::UnknownPart { path, kinds, nearest, names, count, .. } => {
                let more = if names.len() < *count { format!(", .. ({count} in all)") } else { String::new() };
                let expected = match names.is_empty() {
                    true => format!("a file with names of {kinds}, which this one has none of, or no `part`"),
                    false => format!("one of its {kinds}: {}{more}", names.join(", ")),
                };
                let fault = Diagnostic::error(codes::UNKNOWN_PART, span, self.to_string()).expected(expected);
                let hint = nearest.as_ref().map(|name| format!("did you mean {name}?"));
                fault.hint(hint.unwrap_or_default()).at_line(path, 0)
            }
            MeshError::NoParts { path, .. } => Diagnostic::error(codes::UNKNOWN_PART, span, self.to_string())
                .expected("an OBJ, glTF or GLB file, or no `part`")
                .at_line(path, 0),
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
