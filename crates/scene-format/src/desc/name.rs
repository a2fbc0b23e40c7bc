//! Names of objects and lights.

use crate::codes;
use crate::diagnostic::Diagnostic;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Type};
use crate::tree::Item;
use crate::words::Words;
use std::borrow::Cow;

/// What an object or a light is called, if anything. Eight bytes long, as a scene may have millions of things without a
/// name.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
#[allow(clippy::box_collection, reason = "a text by itself is three words long")]
pub struct Name(Option<Box<String>>);

impl Name {
    /// The name; `None` where there is none.
    pub fn as_str(&self) -> Option<&str> {
        self.0.as_ref().map(|name| name.as_str())
    }
}

impl<T: Into<String>> From<Option<T>> for Name {
    fn from(name: Option<T>) -> Self {
        Name(name.map(|name| Box::new(name.into())))
    }
}

impl Words for Name {
    const TYPE: Type = Type::Optional(&Type::Text);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if item.is_word("None") {
            return Some(Name::default());
        }
        let text = text_of_name(reader, item.without_some(), at)?;
        Some(Name::from(Some(text)))
    }

    fn form(&self, _all: bool) -> Form {
        self.as_str().map_or(Form::word("None"), |name| Form::Text(name.to_owned()))
    }
}

/// A text that names something: "None" says in TOML that nothing is named, and is no name in RON either, so that a
/// scene is the same in both.
pub(crate) fn text_of_name<'s>(
    reader: &mut Reader<'_>,
    item: Item<'_, 's>,
    at: &'static FieldDef,
) -> Option<Cow<'s, str>> {
    let text = reader.text(item, at)?;
    if text == "None" {
        let fault = Diagnostic::error(codes::WRONG_TYPE, item.span(), "\"None\" is no name");
        reader.report(fault.expected("another name, or none").hint("write None without quotes, or another name"));
        return None;
    }
    Some(text)
}
