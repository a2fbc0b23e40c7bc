//! Numbers that may differ from place to place.

use super::{Albedo, PatternWords, is_written_as_texture};
use crate::diagnostic::{Span, Spanned};
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Type};
use crate::tree::Item;
use crate::words::Words;

/// A number, constant or by place: of a texture, and of a colour that a name stands for, the luminance counts.
#[derive(Clone, Debug, PartialEq)]
pub struct Number(pub Albedo);

impl Number {
    /// The number, where it is the same everywhere.
    pub fn constant(&self) -> Option<f64> {
        match self.0.resolved() {
            Albedo::Color(color) => Some(Number::of_color(color.value)),
            _ => None,
        }
    }

    /// The luminance of a colour; of a grey it is the grey, to the last bit.
    pub fn of_color([r, g, b]: [f64; 3]) -> f64 {
        (b - g) * 0.0722 + ((r - g) * 0.2126 + g)
    }

    /// Where the number stands; of a texture nowhere.
    pub fn span(&self) -> Span {
        match &self.0 {
            Albedo::Color(color) => color.span,
            _ => Span::NONE,
        }
    }
}

impl From<f64> for Number {
    fn from(number: f64) -> Self {
        Number([number; 3].into())
    }
}

impl Words for Number {
    // A text is the name of a texture.
    const TYPE: Type = Type::OneOf(&[Type::Number, Type::Later(|| PatternWords::TYPE)]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if is_written_as_texture(reader, item)? {
            return Albedo::read(reader, item, at).map(Number);
        }
        let number = <Spanned<f64>>::read(reader, item, at)?;
        Some(Number(Albedo::Color(Spanned { value: [number.value; 3], span: number.span })))
    }

    fn form(&self, all: bool) -> Form {
        match &self.0 {
            Albedo::Color(color) => Form::Number(color.value[0]),
            texture => texture.form(all),
        }
    }
}
