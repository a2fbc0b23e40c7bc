//! Where a cursor stands: between which brackets, and what the schema expects there.

use super::{place_json, place_ron, place_toml};
use crate::desc::Scene;
use crate::read::REPEAT;
use crate::schema::{Content, FieldDef, StructDef, Type};
use crate::syntax::Syntax;
use crate::words::Words;
use std::ops::Range;

/// One step from the scene to the cursor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// Into the value of a field or of a name.
    Key(String),
    /// Into what stands in the brackets of a kind: `Sphere(`, and in TOML and JSON the table of its name.
    Kind(String),
    /// Into an item of a list.
    Item,
}

/// What the text before the cursor says.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Way {
    pub steps: Vec<Step>,
    /// Names of fields that stand before the cursor in the same brackets.
    pub written: Vec<String>,
    /// Whether a value may stand here; else a name.
    pub at_value: bool,
    /// The word that has been begun.
    pub word: Range<usize>,
    /// Where the text between quotes begins that the cursor stands in.
    pub quoted: Option<usize>,
    /// The cursor stands in a comment.
    pub in_comment: bool,
    /// The cursor stands in a header of TOML, which has names alone.
    pub in_header: bool,
}

/// What may stand at the cursor.
#[derive(Clone, Copy, Debug)]
pub(super) enum Expected {
    /// The name of a field of this.
    Field(&'static StructDef),
    /// A value of this type; of this field, if it is one's own.
    Value(Type, Option<&'static FieldDef>),
    /// In TOML and JSON: the name of a kind as the key of a table.
    KindAsKey(Type),
}

/// What an inner place is.
#[derive(Clone, Copy)]
enum Inside {
    Struct(&'static StructDef),
    /// A value of this type.
    Value(Type, Option<&'static FieldDef>),
    /// The fields of a `Repeat` in a list of this.
    Repeat(Type),
    /// The list of its items, each of this.
    Items(Type),
}

/// Where the cursor stands.
pub(super) fn way(text: &str, syntax: Syntax, cursor: usize) -> Way {
    match syntax {
        Syntax::Ron => place_ron::way(text, cursor),
        Syntax::Toml => place_toml::way(text, cursor),
        Syntax::Json => place_json::way(text, cursor),
    }
}

/// What the schema expects at the end of a way; `None` where it knows nothing.
pub(super) fn expected(way: &Way, syntax: Syntax) -> Option<Expected> {
    let mut inside = match syntax {
        Syntax::Ron | Syntax::Json => Inside::Value(Scene::TYPE, None),
        Syntax::Toml => Inside::Struct(&Scene::DEF),
    };
    for step in &way.steps {
        inside = into(inside, step)?;
    }
    let inside = match inside {
        Inside::Items(kind) => Inside::Items(kind.resolved()),
        Inside::Value(kind, field) => Inside::Value(kind.resolved(), field),
        inside => inside,
    };
    Some(match (inside, way.at_value) {
        (Inside::Struct(def), false) => Expected::Field(def),
        (Inside::Repeat(_), false) => Expected::Field(&REPEAT),
        (Inside::Struct(def), true) => match def.bare.and_then(|bare| def.field(bare)) {
            Some(field) => Expected::Value(field.kind, Some(field)),
            None => Expected::Field(def),
        },
        (Inside::Value(kind, field), true) => Expected::Value(kind, field),
        (Inside::Items(kind) | Inside::Value(kind, _), false) if syntax != Syntax::Ron => match kind.group() {
            Some(def) => Expected::Field(def),
            None => Expected::KindAsKey(kind),
        },
        _ => return None,
    })
}

fn into(inside: Inside, step: &Step) -> Option<Inside> {
    match (inside, step) {
        (Inside::Struct(def), Step::Key(key)) => {
            let field = def.field(key)?;
            Some(Inside::Value(field.kind, Some(field)))
        }
        (Inside::Repeat(item), Step::Key(key)) => {
            let field = REPEAT.field(key)?;
            Some(if key == "items" { Inside::Items(item) } else { Inside::Value(field.kind, Some(field)) })
        }
        (Inside::Items(item), Step::Item) => Some(Inside::Value(item, None)),
        // In TOML `[[objects.Repeat.items]]` says nothing of items.
        (Inside::Items(item), step) => into(Inside::Value(item, None), step),
        // In place of any item of a list; no other kind has that name.
        (Inside::Value(kind, _), Step::Kind(name) | Step::Key(name)) if name == REPEAT.name => {
            Some(Inside::Repeat(if let Type::List(inner) = kind { *inner } else { kind }))
        }
        (Inside::Value(kind, _), step) => into_value(kind, step),
        // `Scale(2)` and the like: brackets within are of the bare field.
        (Inside::Struct(def), step) => {
            let field = def.field(def.bare?)?;
            into_value(field.kind, step)
        }
        (Inside::Repeat(_), _) => None,
    }
}

fn into_value(kind: Type, step: &Step) -> Option<Inside> {
    match (kind.resolved(), step) {
        (Type::Optional(inner), step) => into_value(*inner, step),
        (Type::OneOf(kinds), step) => kinds.iter().find_map(|kind| into_value(*kind, step)),
        (Type::List(inner), Step::Item) => Some(Inside::Value(*inner, None)),
        // In TOML `[[objects]]` says nothing of items.
        (Type::List(inner), step) => into_value(*inner, step),
        (Type::Map(inner), Step::Key(_)) => Some(Inside::Value(*inner, None)),
        (Type::Struct(def), Step::Kind(name)) => (def.name == name || name.is_empty()).then_some(Inside::Struct(def)),
        (Type::Struct(def), Step::Key(key)) => {
            let field = def.field(key)?;
            Some(Inside::Value(field.kind, Some(field)))
        }
        // In TOML and JSON a kind is the key of its table.
        (Type::Enum(def), Step::Kind(name) | Step::Key(name)) => match &def.variant(name)?.content {
            Content::Struct(def) => Some(Inside::Struct(def)),
            Content::Value(field) => Some(Inside::Value(field.kind, Some(field))),
            Content::Unit => None,
        },
        _ => None,
    }
}
