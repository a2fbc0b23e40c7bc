//! Pictures laid over surfaces.

use super::Mapping;
use crate::diagnostic::Spanned;
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{scene_struct, scene_words};
use std::path::Path;
use std::sync::Arc;

scene_struct! {
    /// A picture laid over a surface by `vt` on meshes and by longitude and latitude on spheres.
    pub struct Texture as "Texture", "a texture" {
        /// PNG or JPEG, relative to the scene file.
        file: Spanned<Arc<Path>> => Rule::file(FileKind::Texture);
        /// Between texels.
        filter: TextureFilter = TextureFilter::Bilinear;
        /// Beyond the borders.
        wrap: TextureWrap = TextureWrap::Repeat;
        /// Where it lies.
        mapping: Mapping = Mapping::default();
    }
}

scene_words! {
    /// Between texels.
    pub enum TextureFilter, "texture filter" {
        /// Linear between the four nearest.
        Bilinear,
        /// The nearest texel.
        Nearest,
    }
}

scene_words! {
    /// Beyond the borders.
    pub enum TextureWrap, "texture wrap" {
        /// Tiles.
        Repeat,
        /// The border texel goes on.
        Clamp,
        /// Tiles, every second one mirrored.
        Mirror,
    }
}
