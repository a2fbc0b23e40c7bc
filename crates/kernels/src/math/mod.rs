//! Vectors and elementary functions over lanes.

mod elementary;
mod vector;

pub use elementary::{acos, atan2_turns, exp, expm1, ln, ln1p, sincos_turns};
pub use vector::V3;
