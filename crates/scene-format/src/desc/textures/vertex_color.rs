//! The colours that the vertices of a mesh have.

use super::{Pattern, SolidMapping};
use crate::desc::Albedo;
use crate::words::{scene_struct, scene_words};

scene_struct! {
    /// The colours of a mesh's vertices, between vertices by where a point lies in its triangle: scans, sculptures,
    /// simulations. They are decoded to linear light before they are mixed, and numbers beyond 0 to 1 are clipped. OBJ
    /// (`v x y z r g b`), OFF (`COFF`, or without saying so; 0 to 255, or 0 to 1 where none is above), PLY (`red green
    /// blue`, `diffuse_red ..` or `r g b`) and glTF (`COLOR_0`) files have them, and meshes that a scene writes out
    /// with `colors`; alpha does not count, nor do colours of faces, nor those that some programs hide in STL files.
    /// Where some vertices have none they are white. It is an error on an object that has no such colours.
    pub struct VertexColor as "VertexColor", "the colours of vertices" {
        /// What their numbers mean.
        color_space: VertexColorSpace = VertexColorSpace::Auto;
    }
}

scene_words! {
    /// What the numbers of vertices' colours mean.
    pub enum VertexColorSpace, "colour space of vertices" {
        /// As the kind of file has it: `Srgb` for OBJ, OFF and PLY of whole numbers, `Linear` for PLY of floats, glTF
        /// and `colors`.
        Auto,
        /// Encoded as screens want it.
        Srgb,
        /// The very numbers.
        Linear,
    }
}

impl Pattern for VertexColor {
    fn parts(&self) -> Vec<&Albedo> {
        Vec::new()
    }

    fn mapping(&self) -> Option<SolidMapping> {
        None
    }
}
