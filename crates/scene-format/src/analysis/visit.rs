//! A walk over a scene's tree with the schema beside it.

use crate::desc::Scene;
use crate::diagnostic::Span;
use crate::read::{PICK, REPEAT, is_expression, pick_body, repeat_body};
use crate::schema::{Content, FieldDef, StructDef, Type, VariantDef, fits};
use crate::syntax::{Sink, Syntax};
use crate::tree::{Item, Kind, Tree};
use crate::words::Words;

/// What is met on the way.
pub(super) struct Visit<'t, 's> {
    /// The value.
    pub item: Item<'t, 's>,
    /// Its type.
    pub kind: Type,
    /// The field that it is the value of, and where its name stands.
    pub field: Option<(&'static FieldDef, Item<'t, 's>)>,
    /// The name in a map.
    pub name: Option<Item<'t, 's>>,
    /// The kind that it is, and where that word stands.
    pub variant: Option<(&'static VariantDef, Span)>,
    /// The field of the scene that it is in: `objects`.
    pub section: &'static str,
    /// How deep it stands.
    pub depth: usize,
    /// The field of the `Include` that it is in: names there are those of the included file.
    pub included: Option<&'static str>,
    /// The innermost `Repeat` that it is in, where that is in one piece: names that it gives are known there alone.
    pub scope: Option<Span>,
}

/// The tree of a text, whatever is wrong with it.
pub(super) fn tree(text: &str, syntax: Syntax) -> Tree<'_> {
    crate::syntax::parse(text, syntax, &mut Sink::default())
}

/// Calls `meet` for every value that the schema knows, parents first.
pub(super) fn visit<'t, 's>(tree: &'t Tree<'s>, meet: &mut dyn FnMut(&Visit<'t, 's>)) {
    let Some(root) = tree.root() else { return };
    let at = At { kind: Scene::TYPE, field: None, name: None, section: "", depth: 0, included: None, scope: None };
    walk(root, at, meet);
}

#[derive(Clone, Copy)]
struct At<'t, 's> {
    kind: Type,
    field: Option<(&'static FieldDef, Item<'t, 's>)>,
    name: Option<Item<'t, 's>>,
    section: &'static str,
    depth: usize,
    included: Option<&'static str>,
    scope: Option<Span>,
}

// Long: one arm for every type of the language.
fn walk<'t, 's>(item: Item<'t, 's>, at: At<'t, 's>, meet: &mut dyn FnMut(&Visit<'t, 's>)) {
    let mut variant = None;
    let At { kind, field, name, section, depth, included, scope } = at;
    if let Some(body) = pick_body(item) {
        return pick(body, at, meet);
    }
    let kind = match kind.resolved() {
        Type::Optional(inner) => *inner,
        Type::OneOf(kinds) => match kinds.iter().find(|kind| fits(item.without_some(), kind)) {
            Some(kind) => kind.resolved(),
            None => at.kind,
        },
        kind => kind,
    };
    let item = item.without_some();
    let mut body = Some(item);
    let mut content = None;
    if let Type::Enum(def) = kind {
        let (word, span, inner) = match item.kind() {
            Kind::Struct | Kind::Tuple => (item.name().unwrap_or_default().into(), item.head(), Some(item)),
            Kind::Map => match item.fields().next() {
                Some((key, value)) => (key.text(), key.span(), Some(value)),
                None => ("".into(), item.head(), None),
            },
            _ => (item.text(), item.span(), None),
        };
        if let Some(found) = def.variant(&word) {
            variant = Some((found, span));
            content = Some(&found.content);
        }
        body = inner;
    }
    meet(&Visit { item, kind, field, name, variant, section, depth, included, scope });
    if is_expression(item) {
        return;
    }
    let inner = |kind| At { kind, field: None, name: None, section, depth: depth + 1, included, scope };
    let def: Option<&'static StructDef> = match (kind, content) {
        (Type::Struct(def), _) => Some(def),
        (Type::Enum(_), Some(Content::Struct(def))) => Some(def),
        _ => None,
    };
    match (kind, content, body) {
        (Type::List(inner_kind), ..) => {
            for child in item.children() {
                match repeat_body(child) {
                    Some(body) => repeat(body, *inner_kind, inner(kind), meet),
                    None => walk(child, inner(*inner_kind), meet),
                }
            }
        }
        (Type::Map(inner_kind), ..) => {
            for (key, value) in item.fields() {
                walk(value, At { name: Some(key), ..inner(*inner_kind) }, meet);
            }
        }
        (Type::Struct(_), ..) | (Type::Enum(_), Some(Content::Struct(_)), _) => {
            let (Some(body), Some(def)) = (body, def) else { return };
            let top = depth == 0;
            let bare = def.bare.and_then(|bare| def.field(bare));
            let unnamed = match (body.kind(), item.kind()) {
                (Kind::Struct | Kind::Map, _) => None,
                (Kind::Tuple, Kind::Tuple) => body.children().next(),
                _ => Some(body),
            };
            if let (Some(field), Some(value)) = (bare, unnamed.filter(|_| matches!(kind, Type::Enum(_)))) {
                return walk(value, At { field: Some((field, value)), ..inner(field.kind) }, meet);
            }
            for (key, value) in body.fields() {
                let Some(field) = def.field(&key.text()) else { continue };
                let section = if top { field.name } else { section };
                let included = if def.name == "Include" { Some(field.name) } else { included };
                walk(value, At { field: Some((field, key)), section, included, ..inner(field.kind) }, meet);
            }
        }
        // Components, each of which may be an expression.
        (Type::Vector | Type::Pair | Type::Color | Type::Value | Type::Rows, ..) => {
            let component = if matches!(kind, Type::Value | Type::Rows) { Type::Value } else { Type::Number };
            for child in item.children().filter(|child| child.kind() != Kind::Key) {
                match repeat_body(child).filter(|_| matches!(kind, Type::Value) && item.kind() == Kind::List) {
                    Some(body) => repeat(body, component, inner(kind), meet),
                    None => walk(child, inner(component), meet),
                }
            }
        }
        (Type::Enum(_), Some(Content::Value(field)), Some(body)) => {
            let value = if item.kind() == Kind::Map { Some(body) } else { body.children().next() };
            if let Some(value) = value {
                walk(value, At { field: None, ..inner(field.kind) }, meet);
            }
        }
        _ => {}
    }
}

/// The values of a `Pick`, each of which may stand in its place.
fn pick<'t, 's>(body: Item<'t, 's>, at: At<'t, 's>, meet: &mut dyn FnMut(&Visit<'t, 's>)) {
    for (key, value) in body.fields() {
        match PICK.field(&key.text()) {
            Some(field) if field.name == "from" => value.children().for_each(|child| walk(child, at, meet)),
            Some(field) => walk(value, At { kind: field.kind, field: Some((field, key)), ..at }, meet),
            None => {}
        }
    }
}

fn repeat<'t, 's>(body: Item<'t, 's>, kind: Type, at: At<'t, 's>, meet: &mut dyn FnMut(&Visit<'t, 's>)) {
    // A table of TOML is its header alone.
    let whole = body.span();
    let at = At { scope: if body.lexeme().starts_with('[') { at.scope } else { Some(whole) }, ..at };
    for (key, value) in body.fields() {
        let Some(field) = REPEAT.field(&key.text()) else { continue };
        if field.name != "items" {
            walk(value, At { kind: field.kind, field: Some((field, key)), ..at }, meet);
            continue;
        }
        for child in value.children() {
            match repeat_body(child) {
                Some(body) => repeat(body, kind, At { depth: at.depth + 1, ..at }, meet),
                None => walk(child, At { kind, field: None, name: None, depth: at.depth + 1, ..at }, meet),
            }
        }
    }
}
