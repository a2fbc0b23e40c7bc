//! Pictures of all directions: HDR, EXR, PNG and JPEG files, decoded to linear light.

use super::{ENVIRONMENTS, Reading, SRGB_TO_LINEAR, Texels, TextureError, checked, format_of, from_picture};
use image::DynamicImage;
use scene_format::codes;
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics};
use std::path::Path;
use tracer_mesh::read_regular_file;

/// A picture of all directions. Row 0 is the top row, each row from left to right.
#[derive(Clone, Debug, PartialEq)]
pub struct Panorama {
    /// Texels across and down.
    pub size: [u32; 2],
    /// `width * height` texels, linear RGB, finite and not below zero.
    pub texels: Vec<[f32; 3]>,
    /// `W0513`, `W0552`. They have no span.
    pub warnings: Diagnostics,
}

/// The largest number of a half: what infinite pixels are taken for, which programs that write halves make of suns.
const LARGEST_HALF: f32 = 65504.0;

/// Reads the picture in `path`; its content decides the format, not its extension. PNG and JPEG are taken as sRGB, HDR
/// and EXR as linear RGB.
///
/// # Errors
/// When there is no such file, it cannot be read, is of another format or broken, or too large in itself or for its
/// file.
pub fn load_environment(path: &Path) -> Result<Panorama, TextureError> {
    decode_environment(&read_regular_file(path)?, path)
}

/// Decodes such a picture from the bytes of its file; `path` is what messages show.
///
/// # Errors
/// As [`load_environment`].
pub fn decode_environment(bytes: &[u8], path: &Path) -> Result<Panorama, TextureError> {
    let format = format_of(bytes, path, &ENVIRONMENTS)?;
    Ok(panorama(checked(bytes, path, format)?, path))
}

/// A decoded picture as one of all directions.
pub(super) fn panorama(picture: DynamicImage, path: &Path) -> Panorama {
    let size = [picture.width(), picture.height()];
    let mut texels = match picture {
        DynamicImage::ImageRgb32F(picture) => picture.into_raw().as_chunks::<3>().0.to_vec(),
        DynamicImage::ImageRgba32F(picture) => {
            picture.into_raw().as_chunks::<4>().0.iter().map(|&[r, g, b, _]| [r, g, b]).collect()
        }
        other => match from_picture(other, path, Reading::default()).texels {
            Texels::Linear(texels) => texels,
            Texels::Srgb8(texels) => texels.iter().map(|texel| linear(*texel)).collect(),
        },
    };
    let mut warnings = Diagnostics::new();
    if size[0] != 2 * size[1] {
        let message = format!("the picture has {} x {} pixels", size[0], size[1]);
        let warning = Diagnostic::warning(codes::ENVIRONMENT_SHAPE, Span::NONE, message);
        warnings.push(warning.expected("a picture twice as wide as it is high, 360 degrees by 180").at_line(path, 0));
    }
    let (mut none, mut infinite) = (0u64, 0u64);
    for x in texels.as_flattened_mut() {
        if *x == f32::INFINITY {
            *x = LARGEST_HALF;
            infinite += 1;
        } else if *x < 0.0 || x.is_nan() {
            *x = 0.0;
            none += 1;
        }
    }
    if none + infinite > 0 {
        let message = format!("{none} numbers of the picture are below zero or none, {infinite} are infinite");
        let warning = Diagnostic::warning(codes::ENVIRONMENT_PIXELS, Span::NONE, message);
        let taken = format!("taken as black, and infinite ones as {LARGEST_HALF}");
        warnings.push(warning.hint(taken).at_line(path, 0));
    }
    Panorama { size, texels, warnings }
}

/// Of sRGB code values, packed as `0x00BBGGRR`.
fn linear(texel: u32) -> [f32; 3] {
    let [red, green, blue, _] = texel.to_le_bytes();
    [red, green, blue].map(|byte| SRGB_TO_LINEAR.get(usize::from(byte)).copied().unwrap_or(0.0))
}
