//! Pictures of floats (HDR, EXR) laid over surfaces.

use super::{Channel, Reading, Texels, Texture, alpha_is_ignored, no_alpha};
use rayon::prelude::*;
use scene_format::codes;
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics};
use std::path::Path;

/// The texture of pixels of N floats, RGB or RGBA. What is beyond 0 to 1 is clipped, and what is no number black: a
/// surface reflects no more than it gets. They stay floats, 12 bytes a texel, as pictures of 16 bits do.
pub(super) fn texture<const N: usize>(raw: Vec<f32>, size: [u32; 2], path: &Path, reading: Reading) -> Texture {
    let pixels = raw.as_chunks::<N>().0;
    let alpha = |pixel: &[f32; N]| pixel.get(3).copied();
    let texel = |pixel: &[f32; N]| match *pixel.as_slice() {
        [red, green, blue, ..] => reading.texel([red, green, blue], alpha(pixel).unwrap_or(1.0)),
        _ => [0.0; 3],
    };
    let mut texels: Vec<[f32; 3]> = pixels.par_iter().map(texel).collect();
    let is_transparent = pixels.par_iter().any(|pixel| alpha(pixel).is_some_and(|alpha| alpha != 1.0));
    drop(raw);
    let clip = |texel: &mut [f32; 3]| {
        // No number is above nothing: what is none becomes black.
        let clipped = texel.map(|x| if x > 0.0 { x.min(1.0) } else { 0.0 });
        let is_beyond = clipped != *texel;
        *texel = clipped;
        u64::from(is_beyond)
    };
    let beyond: u64 = texels.par_iter_mut().map(clip).sum();
    let mut warnings = Diagnostics::new();
    match reading.channel {
        Channel::Color if is_transparent => warnings.push(alpha_is_ignored(path)),
        Channel::Alpha if N < 4 => warnings.push(no_alpha(path)),
        _ => {}
    }
    if beyond > 0 {
        let texels = if beyond == 1 {
            "1 texel of the picture is".into()
        } else {
            format!("{beyond} texels of the picture are")
        };
        let message = format!("{texels} beyond 0 to 1, or no numbers");
        let warning = Diagnostic::warning(codes::TEXTURE_CLIPPED, Span::NONE, message);
        let warning = warning.expected("from 0 to 1: a surface reflects no more than it gets");
        warnings.push(warning.hint("they are clipped; what is no number is black").at_line(path, 0));
    }
    let [width, height] = size;
    Texture { width, height, texels: Texels::Linear(texels), warnings }
}
