//! What can be wrong with a picture file.

use super::MAX_SIDE;
use image::{ImageError, ImageFormat};
use scene_format::Diagnostic;
use scene_format::codes;
use scene_format::diagnostic::Span;
use std::path::PathBuf;
use tracer_mesh::FileError;

/// Why a texture could not be loaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TextureError {
    /// The file could not be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is of no format that is read here.
    #[error("{} is no {} picture", path.display(), names(formats))]
    Format {
        /// The file.
        path: PathBuf,
        /// Those that are.
        formats: &'static [ImageFormat],
        /// What it is instead, if that is known.
        found: Option<ImageFormat>,
    },
    /// The picture cannot be decoded.
    #[error("the picture {} is broken", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// What the decoder said.
        source: ImageError,
    },
    /// The file is cut off, or its header promises more than it can hold.
    #[error("the picture {} is broken: {reason}", path.display())]
    Incomplete {
        /// The file.
        path: PathBuf,
        /// What tells it.
        reason: String,
    },
    /// The picture is empty, or too large in itself or for its file.
    #[error("the picture {} has {width} x {height} pixels in {bytes} bytes", path.display())]
    Size {
        /// The file.
        path: PathBuf,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Size of the file.
        bytes: u64,
    },
    /// Heights are no numbers.
    #[error("{wrong} heights of the picture {} are not finite numbers", path.display())]
    Heights {
        /// The file.
        path: PathBuf,
        /// How many.
        wrong: usize,
    },
    /// What stands there in memory is a mesh.
    #[error("{} is a mesh", path.display())]
    Mesh {
        /// The name that the scene gives it.
        path: PathBuf,
    },
    /// Numbers from memory are no colours of a surface.
    #[error("{wrong} pixels of the picture {} have numbers outside of 0 to 1", path.display())]
    Range {
        /// The name that the scene gives it.
        path: PathBuf,
        /// How many pixels.
        wrong: usize,
    },
}

/// What the decoder says of an EXR file without a layer of colours.
const NO_RGB: &str = "rgb channels";

/// "PNG, JPEG, HDR or EXR".
fn names(formats: &[ImageFormat]) -> String {
    let name = |format: &ImageFormat| match format {
        ImageFormat::OpenExr => "EXR".to_owned(),
        other => format!("{other:?}").to_uppercase(),
    };
    let (last, others) = formats
        .split_last()
        .map_or((String::new(), Vec::new()), |(last, others)| (name(last), others.iter().map(name).collect()));
    if others.is_empty() { last } else { format!("{} or {last}", others.join(", ")) }
}

impl TextureError {
    /// The same for the picture of an environment: `E0552` where a texture has `E0520`.
    pub fn to_environment_diagnostic(&self, span: Span) -> Diagnostic {
        let diagnostic = self.to_diagnostic(span);
        if diagnostic.code != codes::BROKEN_TEXTURE {
            return diagnostic;
        }
        let expected = match self {
            TextureError::Broken { .. } | TextureError::Incomplete { .. } => {
                "a whole HDR, EXR, PNG or JPEG file".into()
            }
            _ => diagnostic.expected,
        };
        Diagnostic { code: codes::BROKEN_ENVIRONMENT, expected, ..diagnostic }
    }

    /// The same for a picture of heights, which may have other sizes and formats.
    pub fn to_heights_diagnostic(&self, span: Span) -> Diagnostic {
        let diagnostic = self.to_diagnostic(span);
        let expected = match self {
            TextureError::Broken { .. } | TextureError::Incomplete { .. } => {
                "a whole PNG, JPEG, EXR or HDR file".to_owned()
            }
            TextureError::Size { .. } => format!(
                "2 to {MAX_SIDE} pixels along a side, at most 8192 x 8192 in all, and beyond 4096 x 4096 no more \
                 than 256 for each byte of the file"
            ),
            _ => return diagnostic,
        };
        let hint = match self {
            TextureError::Size { width, height, .. } if *width < 2 || *height < 2 => {
                "each pixel is a point of the height field: one row of them has no surface".to_owned()
            }
            _ => diagnostic.hint,
        };
        Diagnostic { expected, hint, ..diagnostic }
    }

    /// The diagnostic at `span` of the scene file: `E0501`, `E0502`, or `E0520` (the picture is wrong).
    pub fn to_diagnostic(&self, span: Span) -> Diagnostic {
        match self {
            TextureError::File(error) => error.to_diagnostic(span),
            TextureError::Format { path, found, formats, .. } => {
                let what = match found.and_then(|format| format.extensions_str().first()) {
                    Some(name) => format!("{self}, but looks like `{name}`"),
                    None => self.to_string(),
                };
                // Steps of PNG are too coarse for what has floating-point numbers.
                let hint = match path.extension().and_then(|end| end.to_str()) {
                    Some("npy" | "npz" | "pfm" | "tif" | "tiff" | "mat" | "h5" | "csv" | "txt" | "dat" | "asc") => {
                        "convert it to EXR, which keeps its numbers as they are"
                    }
                    _ => "convert the picture to PNG",
                };
                Diagnostic::error(codes::BROKEN_TEXTURE, span, what)
                    .expected(format!("a {} file", names(formats)))
                    .hint(hint)
            }
            TextureError::Broken { .. } | TextureError::Incomplete { .. } => {
                let message = match self {
                    TextureError::Broken { source, .. } => format!("{self}: {source}"),
                    _ => self.to_string(),
                };
                let fault = Diagnostic::error(codes::BROKEN_TEXTURE, span, message);
                if fault.message.contains(NO_RGB) {
                    return fault
                        .expected(
                            "an EXR file, not deep, of one channel or with R, G and B: the first such part is taken",
                        )
                        .hint("save the layer that is meant as a picture of its own");
                }
                fault
                    .expected("a whole PNG, JPEG, HDR or EXR file")
                    .hint("open it in an image program and save it again")
            }
            TextureError::Size { .. } => Diagnostic::error(codes::BROKEN_TEXTURE, span, self.to_string())
                .expected(format!(
                    "1 to {MAX_SIDE} pixels along a side, and beyond 4096 x 4096 no more than 256 for each byte of the \
                     file"
                ))
                .hint("save the picture smaller"),
            TextureError::Mesh { .. } => {
                Diagnostic::error(codes::BROKEN_TEXTURE, span, self.to_string()).expected("a picture")
            }
            TextureError::Range { .. } => Diagnostic::error(codes::BROKEN_TEXTURE, span, self.to_string())
                .expected("linear reflectance, 0 to 1 in each channel")
                .hint("divide by the largest number, or cut off what is beyond"),
            TextureError::Heights { .. } => Diagnostic::error(codes::BROKEN_TEXTURE, span, self.to_string())
                .expected("a finite number in each pixel")
                .hint("where a picture has no height, fill it in: with 0, or with the heights around it"),
        }
    }
}
