//! Textures: one file each, with the texture's words.

mod checkerboard;
mod image;
mod mapping;

pub use checkerboard::Checkerboard;
pub use image::{Texture, TextureFilter, TextureWrap};
pub use mapping::Mapping;
pub(crate) use mapping::MappingWords;

use super::Color;
use crate::diagnostic::Spanned;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Type};
use crate::tree::{Item, Kind};
use crate::words::{Words, scene_enum};

/// A colour, constant or by place.
#[derive(Clone, Debug, PartialEq)]
pub enum Albedo {
    /// The same everywhere.
    Color(Spanned<Color>),
    /// From a picture.
    Texture(Texture),
    /// Squares of two colours.
    Checkerboard(Box<Checkerboard>),
}

impl Default for Albedo {
    fn default() -> Self {
        Albedo::Color([0.8; 3].into())
    }
}

scene_enum! {
    /// A colour that differs from place to place.
    pub(crate) enum Pattern, "texture" {
        /// A picture laid over a surface by `vt` on meshes and by longitude and latitude on spheres.
        Texture(Texture);
        /// Squares of two colours.
        Checkerboard(Box<Checkerboard>);
    }
}

/// Whether a name before brackets is other languages' for a colour.
fn is_color(name: &str) -> bool {
    ["rgb", "srgb", "color", "colour", "vec3", "float3"].iter().any(|known| name.eq_ignore_ascii_case(known))
}

impl Words for Albedo {
    const TYPE: Type = Type::OneOf(&[Type::Color, Pattern::TYPE]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        // `rgb(..)` and `red`: a colour, if not ours.
        let bare = item.kind() == Kind::Word && item.lexeme().starts_with(char::is_lowercase);
        if bare || item.name().is_some_and(|name| Pattern::DEF.variant(name).is_none() && is_color(name)) {
            return <Spanned<Color>>::read(reader, item, at).map(Albedo::Color);
        }
        if matches!(item.kind(), Kind::Struct | Kind::Map) || item.name().is_some() || item.kind() == Kind::Word {
            return Some(match Pattern::read(reader, item, at)? {
                Pattern::Texture(texture) => Albedo::Texture(texture),
                Pattern::Checkerboard(checkerboard) => Albedo::Checkerboard(checkerboard),
            });
        }
        <Spanned<Color>>::read(reader, item, at).map(Albedo::Color)
    }

    fn form(&self, all: bool) -> Form {
        match self {
            Albedo::Color(color) => color.form(all),
            Albedo::Texture(texture) => Pattern::Texture(texture.clone()).form(all),
            Albedo::Checkerboard(checkerboard) => Pattern::Checkerboard(checkerboard.clone()).form(all),
        }
    }
}
