//! Textures by name.

use super::Albedo;
use crate::diagnostic::Spanned;
use crate::form::{Entry, Form};
use crate::read::Reader;
use crate::schema::{FieldDef, Type};
use crate::tree::Item;
use crate::words::Words;
use std::sync::Arc;

/// A texture with its name: one of the scene's `textures`, and what [`Albedo::Named`] holds wherever it is used. So
/// nobody has to look for what a name means.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedTexture {
    /// The name: not empty, and neither `#` nor `=` stands first.
    pub name: Spanned<Arc<str>>,
    /// What it is: a texture, or a colour.
    pub texture: Albedo,
}

/// `{ "name": texture }`
impl Words for Vec<Arc<NamedTexture>> {
    const TYPE: Type = Type::Map(&Albedo::TYPE);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        // They stay with the reader until all objects are read.
        reader.named_textures(item, at).map(|()| Vec::new())
    }

    fn form(&self, all: bool) -> Form {
        Form::Map(self.iter().map(|named| Entry::new(named.name.value.to_string(), named.texture.form(all))).collect())
    }
}
