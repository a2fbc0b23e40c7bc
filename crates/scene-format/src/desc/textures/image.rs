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
        /// PNG, JPEG, HDR or EXR, relative to the scene file. Numbers of HDR and EXR files beyond 0 to 1 are clipped,
        /// and what is none is 0; of an EXR file of several parts the first with R, G and B is taken. In memory a
        /// texel takes 4 bytes, of HDR, EXR and PNG of 16 bits 12. A picture within a glTF file is called by its place
        /// in it: `model.glb/images[0]`.
        file: Spanned<Arc<Path>> => Rule::file(FileKind::Texture);
        /// Between texels.
        filter: TextureFilter = TextureFilter::Bilinear;
        /// Beyond the borders.
        wrap: TextureWrap = TextureWrap::Repeat;
        /// What the picture's numbers mean.
        color_space: TextureColorSpace = TextureColorSpace::Auto;
        /// What of the picture counts.
        channel: TextureChannel = TextureChannel::Auto;
        /// Where it lies.
        mapping: Mapping = Mapping::default();
    }
}

impl Texture {
    /// The whole picture as it is.
    pub fn of(file: Spanned<Arc<Path>>) -> Self {
        Texture {
            file,
            filter: TextureFilter::Bilinear,
            wrap: TextureWrap::Repeat,
            color_space: TextureColorSpace::Auto,
            channel: TextureChannel::Auto,
            mapping: Mapping::default(),
        }
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

scene_words! {
    /// What the numbers of a picture mean. Alpha is linear whatever is said here.
    pub enum TextureColorSpace, "colour space of a texture" {
        /// `Srgb` where a colour is wanted, `Linear` where a number is: a `roughness`, the `weight` of a `Mix`, the
        /// `input` of a `ColorRamp`. HDR and EXR: `Linear`.
        Auto,
        /// Encoded as screens want it: photographs, and what is painted to look right.
        Srgb,
        /// The very numbers: masks, measured reflectance, what another program has reckoned.
        Linear,
    }
}

scene_words! {
    /// What of a picture counts.
    pub enum TextureChannel, "channel of a texture" {
        /// Red, green and blue.
        Auto,
        /// Red alone, as a grey.
        Red,
        /// Green alone, as a grey.
        Green,
        /// Blue alone, as a grey.
        Blue,
        /// How opaque it is, as a grey; 1 where the picture does not say.
        Alpha,
        /// How light it is, as a grey: 0.2126 R + 0.7152 G + 0.0722 B.
        Luminance,
    }
}
