//! What may stand at the cursor.

use super::hover::{default_text, of_field};
use super::names;
use super::place::{Expected, Step, Way, expected, way};
use crate::expression::{function, functions};
use crate::files::FileKind;
use crate::read::{PICK, REPEAT, expected as takes};
use crate::schema::{Content, EnumDef, FieldDef, StructDef, Type, prose};
use crate::syntax::Syntax;
use std::ops::Range;

/// What a proposal is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompletionKind {
    /// The name of a field.
    Field,
    /// A kind: `Sphere`, `Diffuse`.
    Kind,
    /// A name that the scene gives.
    Name,
    /// A value as it stands.
    Value,
    /// A function of expressions.
    Function,
}

/// A proposal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// What is shown, and what is looked for.
    pub label: String,
    /// What it is.
    pub kind: CompletionKind,
    /// A few words beside it.
    pub detail: String,
    /// What it means, as Markdown.
    pub documentation: String,
    /// What is written, with places to fill in as `$1` and `${2:default}`, as editors know them.
    pub snippet: String,
}

/// The proposals at a cursor.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Completions {
    /// What they replace.
    pub range: Range<usize>,
    /// Best first.
    pub items: Vec<Completion>,
    /// Files of this kind may stand here, too: names relative to the scene's folder, of which this is begun.
    pub files: Option<(FileKind, String)>,
}

/// What may stand at a byte.
pub fn complete(text: &str, syntax: Syntax, byte: usize) -> Completions {
    let way = way(text, syntax, byte);
    let mut out = Completions { range: way.word.clone(), ..Completions::default() };
    if way.in_comment {
        return out;
    }
    let begun = &text[way.word.clone()];
    if way.quoted.is_some() && begun.trim_start().starts_with('=') {
        return in_expression(text, syntax, byte, begun, &way);
    }
    let Some(expected) = expected(&way, syntax) else { return out };
    if way.in_header {
        out.items = if way.quoted.is_some() { Vec::new() } else { in_header(expected, syntax) };
        return out;
    }
    match expected {
        Expected::Field(_) if way.quoted.is_some() && syntax != Syntax::Json => {}
        Expected::Field(def) if way.quoted.is_some() => {
            // The closing quote is there already, where the editor has written it.
            let closed = text[byte..].starts_with('"');
            for field in def.fields.iter().filter(|field| !way.written.iter().any(|written| written == field.name)) {
                let whole = of_name(field, syntax);
                let snippet = if closed { field.name.to_owned() } else { whole.snippet[1..].to_owned() };
                out.items.push(Completion { snippet, ..whole });
            }
        }
        Expected::Field(def) => {
            let fields = def.fields.iter().filter(|field| !way.written.iter().any(|written| written == field.name));
            out.items.extend(fields.map(|field| of_name(field, syntax)));
        }
        Expected::KindAsKey(kind) => {
            let mut offer = |name: &str, doc: &[&str]| {
                let whole = format!("{}{{ $0 }}", joined(name, syntax));
                let snippet = match (syntax, way.quoted) {
                    (Syntax::Json, Some(_)) if text[byte..].starts_with('"') => name.to_owned(),
                    (Syntax::Json, Some(_)) => whole[1..].to_owned(),
                    _ => whole,
                };
                out.items.push(of_variant(name, prose(doc), snippet));
            };
            kinds(kind, &mut |def| {
                for variant in def.variants.iter().filter(|variant| !matches!(variant.content, Content::Unit)) {
                    offer(variant.name, variant.doc);
                }
            });
            // In place of an item, and of any value.
            let listed = way.steps.last() == Some(&Step::Item) || has_list_header(&way.steps);
            [&REPEAT, &PICK].into_iter().filter(|_| listed).for_each(|def| offer(def.name, def.doc));
        }
        Expected::Value(kind, field) => {
            value(text, syntax, kind, field, &way, &mut out);
            let of_kinds = out.items.iter().any(|item| item.kind == CompletionKind::Kind);
            if way.quoted.is_none() && of_kinds && !matches!(kind.resolved(), Type::Struct(_)) {
                out.items.push(of_variant(PICK.name, prose(PICK.doc), with_fields(PICK.name, &PICK, syntax)));
            }
        }
    }
    out
}

/// Whether the way is that of a list's header in TOML, `[[objects]]`, which says nothing of items.
fn has_list_header(steps: &[Step]) -> bool {
    matches!(steps, [Step::Key(list)] if list == "objects" || list == "lights")
}

/// Within a header of TOML: the names of what has tables, and nothing behind them.
fn in_header(expected: Expected, syntax: Syntax) -> Vec<Completion> {
    let mut items = Vec::new();
    match expected {
        Expected::Field(def) => {
            // The items of a `Repeat` are what its list takes.
            let is_items = |field: &FieldDef| def.name == REPEAT.name && field.name == "items";
            let fields = def.fields.iter().filter(|field| has_tables(field.kind) || is_items(field));
            items.extend(fields.map(|field| Completion { snippet: field.name.to_owned(), ..of_name(field, syntax) }));
        }
        Expected::KindAsKey(kind) => kinds(kind, &mut |def| {
            let is_table = |content: &Content| match content {
                Content::Unit => false,
                Content::Value(field) => has_tables(field.kind),
                Content::Struct(_) => true,
            };
            for variant in def.variants.iter().filter(|variant| is_table(&variant.content)) {
                items.push(of_variant(variant.name, prose(variant.doc), variant.name.to_owned()));
            }
        }),
        // A header has no values.
        Expected::Value(..) => {}
    }
    items
}

/// Whether a value of this type may be a table, or a list of tables.
fn has_tables(kind: Type) -> bool {
    match kind.resolved() {
        Type::Struct(_) | Type::Map(_) => true,
        Type::Enum(def) => def.variants.iter().any(|variant| !matches!(variant.content, Content::Unit)),
        Type::List(inner) | Type::Optional(inner) => has_tables(*inner),
        Type::OneOf(kinds) => kinds.iter().any(|kind| has_tables(*kind)),
        _ => false,
    }
}

/// The proposal of a field's name.
fn of_name(field: &'static FieldDef, syntax: Syntax) -> Completion {
    Completion {
        label: field.name.to_owned(),
        kind: CompletionKind::Field,
        detail: takes(field),
        documentation: of_field(field, syntax),
        snippet: format!("{}{}", joined(field.name, syntax), place(field, syntax, 0)),
    }
}

/// A name and what stands between it and its value.
fn joined(name: &str, syntax: Syntax) -> String {
    match syntax {
        Syntax::Ron => format!("{name}: "),
        Syntax::Toml => format!("{name} = "),
        Syntax::Json => format!("\"{name}\": "),
    }
}

fn of_variant(name: &str, documentation: String, snippet: String) -> Completion {
    Completion { label: name.to_owned(), kind: CompletionKind::Kind, detail: String::new(), documentation, snippet }
}

/// Where a value is filled in, with the brackets that it has in any case.
fn place(field: &FieldDef, syntax: Syntax, number: usize) -> String {
    let inner = match default_text(field, syntax) {
        Some(default) if number > 0 => format!("${{{number}:{}}}", escaped(&default)),
        _ => format!("${number}"),
    };
    match field.kind {
        Type::Vector if inner == format!("${number}") => match syntax {
            Syntax::Ron => format!("({inner})"),
            Syntax::Toml | Syntax::Json => format!("[{inner}]"),
        },
        Type::List(_) => format!("[{}]", if inner.contains('[') { format!("${number}") } else { inner }),
        Type::Text | Type::File => format!("\"${number}\""),
        _ => inner,
    }
}

/// A name as it is written, between quotes or within those that are there.
fn named(name: &str, quoted: bool, syntax: Syntax) -> String {
    let written = crate::print::text(name, syntax);
    if quoted { written[1..written.len() - 1].to_owned() } else { written }
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('$', "\\$").replace('}', "\\}")
}

/// Calls for every choice that a type leaves.
fn kinds(kind: Type, each: &mut dyn FnMut(&'static EnumDef)) {
    match kind.resolved() {
        Type::Enum(def) => each(def),
        Type::Optional(inner) | Type::List(inner) => kinds(*inner, each),
        Type::OneOf(all) => all.iter().for_each(|kind| kinds(*kind, each)),
        _ => {}
    }
}

// Long: one arm for every type of the language.
fn value(text: &str, syntax: Syntax, kind: Type, field: Option<&'static FieldDef>, way: &Way, out: &mut Completions) {
    let quoted = way.quoted.is_some();
    if let Some(file) = field.and_then(|field| field.rule.file)
        && quoted
    {
        out.files = Some((file, text[way.word.clone()].to_owned()));
        return;
    }
    let kind = kind.resolved();
    if matches!(way.steps.as_slice(), [.., Step::Key(key), Step::Item] if key == "masks") {
        let written = |name: &str| named(name, quoted, syntax);
        out.items.extend(names::defined(text, syntax).things.iter().map(|name| Completion {
            label: name.clone(),
            kind: CompletionKind::Name,
            detail: "objects or lights of this name".to_owned(),
            documentation: String::new(),
            snippet: escaped(&written(name)),
        }));
        return;
    }
    let in_list = matches!(way.steps.last(), Some(Step::Item));
    match kind {
        Type::Optional(inner) => {
            if !quoted {
                out.items.push(plain(crate::read::none(syntax), "nothing"));
            }
            return value(text, syntax, *inner, field, way, out);
        }
        Type::OneOf(all) => {
            let of = field.map(|field| field.name).filter(|_| matches!(all, [Type::Text, ..]));
            if let Some(of @ ("material" | "camera")) = of {
                let defined = names::defined(text, syntax);
                let names = if of == "camera" { defined.cameras } else { defined.materials };
                let written = |name: &str| named(name, quoted, syntax);
                out.items.extend(names.iter().map(|name| Completion {
                    label: name.clone(),
                    kind: CompletionKind::Name,
                    detail: format!("a {of} of this scene"),
                    documentation: String::new(),
                    snippet: escaped(&written(name)),
                }));
            }
            if kind.is_texture() {
                out.items.extend(names::defined(text, syntax).textures.iter().map(|name| Completion {
                    label: name.clone(),
                    kind: CompletionKind::Name,
                    detail: "a texture of this scene".to_owned(),
                    documentation: String::new(),
                    snippet: escaped(&named(name, quoted, syntax)),
                }));
            }
            all.iter()
                .filter(|kind| !matches!(kind, Type::Text))
                .for_each(|kind| value(text, syntax, *kind, field, way, out));
            return;
        }
        Type::Enum(def) if !quoted || syntax != Syntax::Ron => {
            for variant in def.variants {
                let (name, doc) = (variant.name, prose(variant.doc));
                match (&variant.content, syntax) {
                    (Content::Unit, Syntax::Ron) => out.items.push(of_variant(name, doc, name.to_owned())),
                    (Content::Unit, _) if quoted => out.items.push(of_variant(name, doc, name.to_owned())),
                    (Content::Unit, _) => out.items.push(of_variant(name, doc, format!("\"{name}\""))),
                    _ if quoted => {}
                    (Content::Value(field), Syntax::Ron) => {
                        out.items.push(of_variant(name, doc, format!("{name}({})", place(field, syntax, 0))));
                    }
                    (Content::Value(field), _) => {
                        let value = format!("{{ {}{} }}", joined(name, syntax), place(field, syntax, 0));
                        out.items.push(of_variant(name, doc, value));
                    }
                    (Content::Struct(fields), syntax) => {
                        out.items.push(of_variant(name, doc, with_fields(name, fields, syntax)));
                    }
                }
            }
            if in_list && !quoted {
                out.items.push(of_variant(REPEAT.name, prose(REPEAT.doc), with_fields(REPEAT.name, &REPEAT, syntax)));
            }
        }
        Type::Struct(def) if !quoted && syntax == Syntax::Ron => {
            out.items.push(of_variant(def.name, prose(def.doc), format!("{}($0)", def.name)));
        }
        Type::Bool if !quoted => out.items.extend(["true", "false"].map(|word| plain(word, ""))),
        _ => {}
    }
    if let Some(field) = field.filter(|_| !quoted)
        && !matches!(kind, Type::Bool | Type::Enum(_) | Type::Struct(_))
        && let Some(default) = default_text(field, syntax)
    {
        let item = Completion {
            documentation: of_field(field, syntax),
            ..plain(&default, &format!("default; {}", takes(field)))
        };
        if !out.items.iter().any(|other| other.label == item.label) {
            out.items.push(item);
        }
    }
}

fn plain(label: &str, detail: &str) -> Completion {
    Completion {
        label: label.to_owned(),
        kind: CompletionKind::Value,
        detail: detail.to_owned(),
        documentation: String::new(),
        snippet: escaped(label),
    }
}

/// A kind with the fields that must be written.
fn with_fields(name: &str, def: &StructDef, syntax: Syntax) -> String {
    let must = def.fields.iter().filter(|field| field.default.is_none());
    let of_field = |(k, field): (usize, &FieldDef)| joined(field.name, syntax) + &place(field, syntax, k + 1);
    let fields: Vec<String> = must.enumerate().map(of_field).collect();
    let inner = if fields.is_empty() { "$0".to_owned() } else { fields.join(", ") };
    match syntax {
        Syntax::Ron => format!("{name}({inner})"),
        syntax => format!("{{ {}{{ {inner} }} }}", joined(name, syntax)),
    }
}

/// Whether the cursor stands in what is repeated.
pub(super) fn in_repeat(way: &Way) -> bool {
    way.steps.iter().any(|step| matches!(step, Step::Kind(kind) | Step::Key(kind) if kind == REPEAT.name))
}

/// Within a text that begins with `=`: values and functions.
fn in_expression(text: &str, syntax: Syntax, byte: usize, begun: &str, way: &Way) -> Completions {
    let letters = begun.bytes().rev().take_while(|byte| *byte == b'_' || byte.is_ascii_alphanumeric()).count();
    let range = byte - letters..byte;
    let before = &begun[..begun.len() - letters];
    let name = |name: &str, detail: &str| Completion { kind: CompletionKind::Name, ..plain(name, detail) };
    if let Some(of) = before.strip_suffix('.').filter(|of| !of.ends_with(|c: char| c.is_ascii_digit())) {
        // Of a point or a colour; `1.` is a number.
        let parts = ["x", "y", "z", "r", "g", "b"].map(|part| name(part, "one of its three numbers"));
        let items = if of.ends_with(['=', ' ']) { Vec::new() } else { parts.into() };
        return Completions { range, items, files: None };
    }
    let vars = names::defined(text, syntax).vars;
    let mut items: Vec<Completion> = vars.iter().map(|var| name(var, "a value of this scene")).collect();
    let told = [("frame", "the number of the frame"), ("time", "seconds from the first frame"), ("pi", "a number")];
    items.extend(told.map(|(word, detail)| name(word, detail)));
    if in_repeat(way) && !items.iter().any(|item| item.label == "i") {
        items.push(name("i", "the number of the copy, from 0, where Repeat has no `index`"));
    }
    items.extend(functions().map(|(name, call)| Completion {
        kind: CompletionKind::Function,
        detail: call.to_owned(),
        documentation: function(name).map_or(String::new(), |(_, does)| does.to_owned()),
        snippet: format!("{name}($0)"),
        ..plain(name, "")
    }));
    Completions { range, items, files: None }
}
