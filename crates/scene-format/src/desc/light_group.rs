//! Groups of lights.

use super::name::text_of_name;
use crate::codes;
use crate::diagnostic::Diagnostic;
use crate::form::Form;
use crate::read::{Reader, shortened};
use crate::schema::{FieldDef, Type};
use crate::tree::Item;
use crate::words::Words;

/// The group that a light is of, if any. As small as a [`Name`](super::Name).
#[derive(Clone, Debug, PartialEq, Eq, Default)]
#[allow(clippy::box_collection, reason = "a text by itself is three words long")]
pub struct LightGroup(Option<Box<String>>);

/// Bytes of a group's name at most: OpenEXR's names of channels have 255, with `light.` and `.R`.
const LONGEST: usize = 240;

impl LightGroup {
    /// What the lights are called together that are of no group.
    pub const REST: &str = "rest";

    /// Its name; `None` where there is none.
    pub fn as_str(&self) -> Option<&str> {
        self.0.as_ref().map(|name| name.as_str())
    }
}

impl<T: Into<String>> From<Option<T>> for LightGroup {
    fn from(name: Option<T>) -> Self {
        LightGroup(name.map(|name| Box::new(name.into())))
    }
}

impl Words for LightGroup {
    const TYPE: Type = Type::Optional(&Type::Text);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if item.is_word("None") {
            return Some(LightGroup::default());
        }
        let item = item.without_some();
        let name = text_of_name(reader, item, at)?;
        let (message, expected) = if name == LightGroup::REST {
            let message = "\"rest\" is what the lights are called that are of no group".to_owned();
            (message, "another name, or no group".to_owned())
        } else if name.len() > LONGEST || name.contains('\0') {
            let message = format!("\"{}\" cannot name a layer of a picture", shortened(&name));
            (message, format!("a name of at most {LONGEST} bytes without a zero byte"))
        } else {
            return Some(LightGroup::from(Some(name)));
        };
        reader.report(Diagnostic::error(codes::LIGHT_GROUP, item.span(), message).expected(expected));
        None
    }

    fn form(&self, _all: bool) -> Form {
        self.as_str().map_or(Form::word("None"), |name| Form::Text(name.to_owned()))
    }
}
