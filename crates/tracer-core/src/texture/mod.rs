//! Pictures laid over surfaces: PNG, JPEG, HDR and EXR files, decoded.

// As in `mesh`: what a file says must not end the program.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::unreachable,
        clippy::todo,
        clippy::unimplemented,
        clippy::indexing_slicing,
        clippy::string_slice
    )
)]

mod environment;
mod error;
mod extent;
mod floats;
mod grey;
mod heights;
mod pixels;
mod reading;

pub use environment::{Panorama, decode_environment, load_environment};
pub use error::TextureError;
pub use heights::{Landscape, decode_heights, load_heights};
pub use pixels::{Pixels, PixelsError};
pub use reading::{Channel, ColorSpace, Reading};
pub use tracer_kernels::scene::Texels;
pub use tracer_kernels::srgb::SRGB_TO_LINEAR;

use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use scene_format::codes;
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics};
use std::io::Cursor;
use std::path::Path;
use tracer_mesh::Files;

/// Most pixels along a side.
pub const MAX_SIDE: u32 = 1 << 15;

/// Pixels that any file may have, however well it is packed (4096 x 4096).
const FREE_PIXELS: u64 = 1 << 24;

/// Further pixels that a file may have per byte. A JPEG of one colour has 64 with the usual tables; far beyond this a
/// small file would take the memory of a large one.
const PIXELS_PER_BYTE: u64 = 256;

/// A decoded picture. Row 0 is the top row of the picture, each row from left to right.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// `width * height` texels, row by row.
    pub texels: Texels,
    /// At most one `W0520` and one `W0522`: what of the file was ignored, or clipped. They have no span.
    pub warnings: Diagnostics,
}

impl Texture {
    /// The largest channel of all texels, linear.
    pub(crate) fn brightest(&self) -> f64 {
        let most = match &self.texels {
            Texels::Srgb8(texels) => {
                let byte = texels.iter().flat_map(|texel| texel.to_le_bytes().into_iter().take(3)).max();
                byte.and_then(|byte| SRGB_TO_LINEAR.get(usize::from(byte)).copied())
            }
            Texels::Linear(texels) => texels.as_flattened().iter().copied().reduce(f32::max),
        };
        most.map_or(0.0, f64::from)
    }
}

/// Reads the PNG, JPEG, HDR or EXR picture in `path`; its content decides which, not its extension. A picture within a
/// glTF file is called `model.glb/images[0]`.
///
/// Grey and palette pictures become RGB; alpha is ignored (with a warning when it is not opaque everywhere); colours
/// are taken as sRGB, whatever profile the file names; the orientation that a camera noted in a JPEG is applied. HDR
/// and EXR are linear, and clipped to 0 to 1 (with a warning); of an EXR file the first part with R, G and B is taken,
/// and its only channel, whatever its name, as grey.
///
/// # Errors
/// When there is no such file, it cannot be read, it is of another format or broken, or it has more than
/// [`MAX_SIDE`] pixels along a side or out of all proportion to its size.
pub fn load(path: &Path) -> Result<Texture, TextureError> {
    load_as(path, Reading::default())
}

/// As [`load`], read in another way.
///
/// # Errors
/// As [`load`].
pub fn load_as(path: &Path, reading: Reading) -> Result<Texture, TextureError> {
    decode_as(&Files::default().read_picture(path)?, path, reading)
}

/// Decodes a picture from the bytes of its file; `path` is what messages show.
///
/// # Errors
/// As [`load`].
pub fn decode(bytes: &[u8], path: &Path) -> Result<Texture, TextureError> {
    decode_as(bytes, path, Reading::default())
}

/// As [`decode`], read in another way.
///
/// # Errors
/// As [`load`].
pub fn decode_as(bytes: &[u8], path: &Path, reading: Reading) -> Result<Texture, TextureError> {
    let format = format_of(bytes, path, &TEXTURES)?;
    Ok(from_picture(checked(bytes, path, format)?, path, reading))
}

/// The format of a file, which must be one of these.
fn format_of(bytes: &[u8], path: &Path, formats: &'static [ImageFormat]) -> Result<ImageFormat, TextureError> {
    match image::guess_format(bytes) {
        Ok(format) if formats.contains(&format) => Ok(format),
        other => Err(TextureError::Format { path: path.to_owned(), found: other.ok(), formats }),
    }
}

/// Formats of textures.
const TEXTURES: [ImageFormat; 4] = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Hdr, ImageFormat::OpenExr];

/// Formats of pictures of numbers: of light, of heights.
const ENVIRONMENTS: [ImageFormat; 4] = [ImageFormat::Hdr, ImageFormat::OpenExr, ImageFormat::Png, ImageFormat::Jpeg];

/// Decodes a picture of a known format, if it is whole and its size is in proportion to its file.
fn checked(bytes: &[u8], path: &Path, format: ImageFormat) -> Result<DynamicImage, TextureError> {
    checked_up_to(bytes, path, format, u64::MAX)
}

/// As [`checked`], if it has so many pixels at most.
fn checked_up_to(bytes: &[u8], path: &Path, format: ImageFormat, most: u64) -> Result<DynamicImage, TextureError> {
    let fault = match format {
        ImageFormat::Png => extent::fault_of_png(bytes),
        ImageFormat::Jpeg => extent::fault_of_jpeg(bytes),
        // Their decoders tell a file that is cut off.
        _ => None,
    };
    if let Some(reason) = fault {
        return Err(TextureError::Incomplete { path: path.to_owned(), reason });
    }
    let broken = |source| TextureError::Broken { path: path.to_owned(), source };
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::no_limits();
    let most_pixels = most.min(FREE_PIXELS + PIXELS_PER_BYTE * bytes.len() as u64);
    // A decoder holds the picture, of up to 8 bytes a pixel, or 16 where they are floats, and rows of it.
    let floats = matches!(format, ImageFormat::Hdr | ImageFormat::OpenExr);
    limits.max_alloc = Some(if floats { 20 } else { 10 } * most_pixels);
    reader.limits(limits);
    let fits = |width: u32, height: u32| {
        let pixels = u64::from(width) * u64::from(height);
        if width > MAX_SIDE || height > MAX_SIDE || pixels > most_pixels || pixels == 0 {
            return Err(TextureError::Size { path: path.to_owned(), width, height, bytes: bytes.len() as u64 });
        }
        Ok(())
    };
    if format == ImageFormat::OpenExr
        && let Some([width, height]) = grey::size(bytes)
    {
        fits(width, height)?;
        return grey::decode(bytes).map_err(broken);
    }
    let mut decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    fits(width, height)?;
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let mut picture = DynamicImage::from_decoder(decoder).map_err(broken)?;
    picture.apply_orientation(orientation);
    Ok(picture)
}

fn from_picture(picture: DynamicImage, path: &Path, reading: Reading) -> Texture {
    let (width, height) = (picture.width(), picture.height());
    let picture = match picture {
        DynamicImage::ImageRgb32F(p) => return floats::texture::<3>(p.into_raw(), [width, height], path, reading),
        DynamicImage::ImageRgba32F(p) => return floats::texture::<4>(p.into_raw(), [width, height], path, reading),
        whole => whole,
    };
    let warnings = warning_of_alpha(&picture, path, reading.channel).into_iter().collect();
    Texture { width, height, texels: reading.texels(picture), warnings }
}

/// The warning that a picture is not opaque everywhere, or that it has no alpha where that is all that counts.
fn warning_of_alpha(picture: &DynamicImage, path: &Path, channel: Channel) -> Option<Diagnostic> {
    match channel {
        Channel::Alpha => return (!picture.color().has_alpha()).then(|| no_alpha(path)),
        // Who names a channel knows that there are others.
        Channel::Red | Channel::Green | Channel::Blue | Channel::Luminance => return None,
        Channel::Color => {}
    }
    let transparent = match picture {
        DynamicImage::ImageLumaA8(p) => p.pixels().any(|p| p.0[1] != u8::MAX),
        DynamicImage::ImageRgba8(p) => p.pixels().any(|p| p.0[3] != u8::MAX),
        DynamicImage::ImageLumaA16(p) => p.pixels().any(|p| p.0[1] != u16::MAX),
        DynamicImage::ImageRgba16(p) => p.pixels().any(|p| p.0[3] != u16::MAX),
        _ => false,
    };
    transparent.then(|| alpha_is_ignored(path))
}

/// The warning that a picture is not opaque everywhere.
fn alpha_is_ignored(path: &Path) -> Diagnostic {
    let message = "the picture has an alpha channel, which is ignored";
    Diagnostic::warning(codes::TEXTURE_ALPHA, Span::NONE, message).expected("an opaque picture").at_line(path, 0)
}

/// The warning that what counts of a picture is not there.
fn no_alpha(path: &Path) -> Diagnostic {
    let message = "the picture has no alpha channel, and its alpha is all that counts: it is 1 everywhere";
    let warning = Diagnostic::warning(codes::TEXTURE_ALPHA, Span::NONE, message);
    warning.expected("a picture with an alpha channel").hint("name another `channel`: Luminance").at_line(path, 0)
}
