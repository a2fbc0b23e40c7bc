//! What is filtered.

/// A picture with noise, and what guides its filter. The three numbers of a pixel stand together, rows from the top.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Linear RGB, not below zero, without a limit above.
    pub color: &'a [f32],
    /// Colour without light, in 0..=1.
    pub albedo: &'a [f32],
    /// Shading normal, in any frame; its parts in -1..=1.
    pub normal: &'a [f32],
}
