//! Descriptions from serde's data, of any format that says itself what it holds.
//!
//! What the format holds becomes JSON, which the reader reads: so one thing checks, and fills in defaults, whatever
//! the way in. Names of kinds before brackets, which only RON has, come through what serde keeps for untagged enums:
//! there the `ron` crate gives a kind as a map of one name, as JSON has it.

use crate::diagnostic::{Diagnostic, Severity};
use crate::form::Form;
use crate::print::json_value;
use crate::read::{PICK, REPEAT};
use crate::schema::{Content, StructDef, Type};
use crate::words::Words;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::fmt::{Formatter, Write};

/// What a format may hold.
#[derive(Debug)]
pub(crate) enum Any {
    Null,
    Bool(bool),
    Integer(i64),
    Number(f64),
    Text(String),
    List(Vec<Any>),
    Map(Vec<(Any, Any)>),
}

/// Makes serde keep what a format holds before it is looked at.
#[derive(serde::Deserialize)]
#[serde(untagged)]
enum Kept {
    Any(Any),
}

/// A type of the language.
pub(crate) fn words<'de, T: Words, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    let text = json(deserializer, T::TYPE)?;
    crate::read::part(&text).map_err(|faults| D::Error::custom(told(&faults)))
}

/// As [`words`]; nothing is nothing.
pub(crate) fn optional<'de, T: Words, D: Deserializer<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    let text = json(deserializer, T::TYPE)?;
    if text == "null" {
        return Ok(None);
    }
    crate::read::part(&text).map(Some).map_err(|faults| D::Error::custom(told(&faults)))
}

/// What a format holds as JSON, for the type that is expected.
pub(crate) fn json<'de, D: Deserializer<'de>>(deserializer: D, kind: Type) -> Result<String, D::Error> {
    let Kept::Any(any) = Kept::deserialize(deserializer)?;
    let mut out = String::new();
    write(&any, Some(kind), &mut out).map_err(D::Error::custom)?;
    Ok(out)
}

/// The first faults in one line.
pub(crate) fn told(faults: &[Diagnostic]) -> String {
    const SHOWN: usize = 3;
    let errors: Vec<&Diagnostic> = faults.iter().filter(|fault| fault.severity == Severity::Error).collect();
    let mut out = String::new();
    for (index, fault) in errors.iter().take(SHOWN).enumerate() {
        out.push_str(if index > 0 { "; " } else { "" });
        if !fault.path.is_empty() {
            let _ = write!(out, "{}: ", fault.path);
        }
        out.push_str(&fault.message);
        if !fault.expected.is_empty() {
            let _ = write!(out, " (expected {})", fault.expected);
        }
    }
    if errors.is_empty() {
        out.push_str("this is no value of the scene language");
    }
    if errors.len() > SHOWN {
        let _ = write!(out, "; and {} more", errors.len() - SHOWN);
    }
    out
}

impl<'de> Deserialize<'de> for Any {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OfAny)
    }
}

struct OfAny;

impl<'de> Visitor<'de> for OfAny {
    type Value = Any;

    fn expecting(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("a value of the scene language")
    }

    fn visit_unit<E>(self) -> Result<Any, E> {
        Ok(Any::Null)
    }

    fn visit_none<E>(self) -> Result<Any, E> {
        Ok(Any::Null)
    }

    fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<Any, D::Error> {
        Any::deserialize(deserializer)
    }

    fn visit_newtype_struct<D: Deserializer<'de>>(self, deserializer: D) -> Result<Any, D::Error> {
        Any::deserialize(deserializer)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Any, E> {
        Ok(Any::Bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Any, E> {
        Ok(Any::Integer(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Any, E> {
        Ok(i64::try_from(value).map_or(Any::Number(value as f64), Any::Integer))
    }

    fn visit_i128<E>(self, value: i128) -> Result<Any, E> {
        Ok(Any::Number(value as f64))
    }

    fn visit_u128<E>(self, value: u128) -> Result<Any, E> {
        Ok(Any::Number(value as f64))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Any, E> {
        Ok(Any::Number(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Any, E> {
        Ok(Any::Text(value.to_owned()))
    }

    fn visit_string<E>(self, value: String) -> Result<Any, E> {
        Ok(Any::Text(value))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Any, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element()? {
            list.push(item);
        }
        Ok(Any::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Any, A::Error> {
        let mut map = Vec::new();
        while let Some(entry) = entries.next_entry()? {
            map.push(entry);
        }
        Ok(Any::Map(map))
    }
}

/// Writes a value as JSON. `kind` says what is expected, where that is known: only RON needs it, for the names of
/// structs before their brackets, and for brackets with nothing in them.
fn write(any: &Any, kind: Option<Type>, out: &mut String) -> Result<(), &'static str> {
    let kind = kind.map(|kind| chosen(any, kind));
    match any {
        Any::Null | Any::List(_) if is_empty(any) && matches!(kind, Some(Type::Struct(_))) => out.push_str("{}"),
        Any::Null => out.push_str("null"),
        Any::Bool(value) => out.push_str(if *value { "true" } else { "false" }),
        Any::Integer(value) => {
            let _ = write!(out, "{value}");
        }
        Any::Number(value) if value.is_finite() => out.push_str(&crate::print::number(*value)),
        Any::Number(_) => return Err("numbers must be finite"),
        Any::Text(text) => out.push_str(&json_value(&Form::Text(text.clone()))),
        Any::List(items) => {
            let inner = match kind {
                Some(Type::List(inner)) => Some(*inner),
                _ => None,
            };
            out.push('[');
            for (index, item) in items.iter().enumerate() {
                out.push_str(if index > 0 { ", " } else { "" });
                write(item, inner, out)?;
            }
            out.push(']');
        }
        Any::Map(entries) => {
            let kind = match (kind, only(any)) {
                (_, Some((name, body))) if name == PICK.name => return pick(body, kind, out),
                (_, Some((name, body))) if name == REPEAT.name => return repeat(body, kind, out),
                // Camera(..), as RON may have it.
                (Some(Type::Struct(def)), Some((name, body))) if name == def.name && def.field(name).is_none() => {
                    return write(body, kind, out);
                }
                (kind, _) => kind,
            };
            map(entries, |name| within(kind, name), out)?;
        }
    }
    Ok(())
}

/// A map, whose values are of these types by name.
fn map(entries: &[(Any, Any)], kind: impl Fn(&str) -> Option<Type>, out: &mut String) -> Result<(), &'static str> {
    out.push('{');
    for (index, (key, value)) in entries.iter().enumerate() {
        let Any::Text(name) = key else { return Err("names must be texts") };
        out.push_str(if index > 0 { ", " } else { "" });
        out.push_str(&json_value(&Form::Text(name.clone())));
        out.push_str(": ");
        write(value, kind(name), out)?;
    }
    out.push('}');
    Ok(())
}

/// What a name in a map is of.
fn within(kind: Option<Type>, name: &str) -> Option<Type> {
    match kind? {
        Type::Struct(def) => def.field(name).map(|field| field.kind),
        Type::Map(inner) => Some(*inner),
        Type::Enum(def) => match &def.variant(name)?.content {
            Content::Struct(fields) => Some(Type::Struct(fields)),
            Content::Value(field) => Some(field.kind),
            Content::Unit => None,
        },
        _ => None,
    }
}

/// The type of several that a value is of.
fn chosen(any: &Any, kind: Type) -> Type {
    match kind.resolved() {
        Type::Optional(inner) => chosen(any, *inner),
        Type::OneOf(kinds) => {
            let fits = |kind: &&Type| match (any, kind.resolved()) {
                (Any::Map(_), kind) => matches!(kind, Type::Struct(_) | Type::Enum(_)),
                (Any::List(_), kind) => matches!(kind, Type::List(_)),
                _ => false,
            };
            kinds.iter().find(fits).map_or(kind, |kind| chosen(any, *kind))
        }
        kind => kind,
    }
}

/// `()`: to serde nothing, or a list of nothing.
fn is_empty(any: &Any) -> bool {
    match any {
        Any::Null => true,
        Any::List(items) => items.is_empty(),
        _ => false,
    }
}

/// The one entry of a map.
fn only(any: &Any) -> Option<(&str, &Any)> {
    match any {
        Any::Map(entries) => match entries.as_slice() {
            [(Any::Text(name), value)] => Some((name, value)),
            _ => None,
        },
        _ => None,
    }
}

/// `Pick(..)`: each of its values is what is expected in its place.
fn pick(body: &Any, kind: Option<Type>, out: &mut String) -> Result<(), &'static str> {
    of_items(&PICK, "from", body, kind, out)
}

/// `Repeat(..)` among items of this type.
fn repeat(body: &Any, kind: Option<Type>, out: &mut String) -> Result<(), &'static str> {
    of_items(&REPEAT, "items", body, kind, out)
}

fn of_items(
    def: &'static StructDef,
    list: &str,
    body: &Any,
    kind: Option<Type>,
    out: &mut String,
) -> Result<(), &'static str> {
    let Any::Map(entries) = body else { return write(body, None, out) };
    let _ = write!(out, "{{\"{}\": {{", def.name);
    for (index, (key, value)) in entries.iter().enumerate() {
        let Any::Text(name) = key else { return Err("names must be texts") };
        out.push_str(if index > 0 { ", " } else { "" });
        out.push_str(&json_value(&Form::Text(name.clone())));
        out.push_str(": ");
        match value {
            Any::List(items) if name == list => {
                out.push('[');
                for (index, item) in items.iter().enumerate() {
                    out.push_str(if index > 0 { ", " } else { "" });
                    write(item, kind, out)?;
                }
                out.push(']');
            }
            value => write(value, def.field(name).map(|field| field.kind), out)?,
        }
    }
    out.push_str("}}");
    Ok(())
}
