//! Descriptions as serde's data: what the writer writes, for any format. A vector is a tuple, a kind with fields a
//! struct variant, a field with its default is left out; so RON, TOML and JSON by other crates are what the reader
//! reads.

use crate::form::{Entry, Form};
use crate::words::Words;
use serde::ser::{Error, Serialize, SerializeStruct, SerializeStructVariant, SerializeTuple, Serializer};
use std::borrow::Cow;

/// Serializes a type of the language.
pub(crate) fn words<T: Words, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
    value.form(false).serialize(serializer)
}

/// The name of a field; all of those stand in the program.
fn name<E: Error>(entry: &Entry) -> Result<&'static str, E> {
    match entry.name {
        Cow::Borrowed(name) => Ok(name),
        Cow::Owned(_) => Err(E::custom("a field of the language has no name of its own")),
    }
}

impl Serialize for Form {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Form::Absent => serializer.serialize_none(),
            Form::Bool(value) => serializer.serialize_bool(*value),
            Form::Number(value) => serializer.serialize_f64(*value),
            Form::Integer(value) => serializer.serialize_u64(*value),
            Form::Lexeme(text) | Form::Text(text) => serializer.serialize_str(text),
            Form::Vector(numbers) => {
                let mut tuple = serializer.serialize_tuple(numbers.len())?;
                numbers.iter().try_for_each(|number| tuple.serialize_element(number))?;
                tuple.end()
            }
            Form::List(entries) => serializer.collect_seq(entries.iter().map(|entry| &entry.value)),
            Form::Map(entries) => serializer.collect_map(entries.iter().map(|entry| (&*entry.name, &entry.value))),
            Form::Struct { name: word, fields } => {
                let mut out = serializer.serialize_struct(word, fields.len())?;
                fields.iter().try_for_each(|field| out.serialize_field(name(field)?, &field.value))?;
                out.end()
            }
            Form::Variant { name: word, content: None } => serializer.serialize_unit_variant(word, 0, word),
            Form::Variant { name: word, content: Some(content) } => match &**content {
                Form::Struct { fields, .. } => {
                    let mut out = serializer.serialize_struct_variant(word, 0, word, fields.len())?;
                    fields.iter().try_for_each(|field| out.serialize_field(name(field)?, &field.value))?;
                    out.end()
                }
                content => serializer.serialize_newtype_variant(word, 0, word, content),
            },
        }
    }
}
