//! From the colours that a file has to those of a mesh.

use super::colors::VertexColors;
use super::oddities::{Oddities, Oddity};
use rayon::prelude::*;

/// A vertex without a colour, before [`settled`]: no reader has a number that is none.
pub(super) const NO_COLOR: [f32; 3] = [f32::NAN; 3];

/// Beyond 0 to 1 by so much is rounding.
const ROUNDING: f32 = 1e-6;

/// What a file says of `vertices` vertices: the colours of the first of them, or [`NO_COLOR`], times `scale`. Those
/// without are white.
pub(super) fn settled(
    mut raw: Vec<[f32; 3]>,
    vertices: usize,
    scale: f32,
    is_srgb: bool,
    oddities: &mut Oddities,
) -> Option<VertexColors> {
    if raw.is_empty() {
        return None;
    }
    raw.resize(vertices, NO_COLOR);
    let is_beyond = |x: &f32| !(-ROUNDING..=1.0 + ROUNDING).contains(x);
    let settle = |color: &mut [f32; 3]| {
        if color.iter().any(|x| x.is_nan()) {
            *color = [1.0; 3];
            return [1, 0];
        }
        *color = color.map(|x| x * scale);
        [0, u64::from(color.iter().any(is_beyond))]
    };
    let sum = |a: [u64; 2], b: [u64; 2]| [a[0] + b[0], a[1] + b[1]];
    let [missing, beyond] = raw.par_iter_mut().map(settle).reduce(|| [0; 2], sum);
    oddities.add_many(Oddity::MissingColor, missing);
    oddities.add_many(Oddity::ClippedColor, beyond);
    Some(VertexColors::new(raw, is_srgb))
}
