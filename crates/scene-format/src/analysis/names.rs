//! Names that a person gives: of materials, of textures, of cameras, of objects and lights, and of values in `vars`.

use super::hover::range;
use super::visit::{Visit, tree, visit};
use crate::diagnostic::Edit;
use crate::diagnostic::Span;
use crate::expression::{is_known, is_name};
use crate::read::is_expression;
use crate::schema::Type;
use crate::syntax::Syntax;
use crate::tree::Kind;
use std::ops::Range;

/// What a name is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Of {
    Material,
    Texture,
    Camera,
    Var,
    /// An object or a light, which masks name.
    Thing,
}

/// A place where a name stands.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Place {
    of: Of,
    name: String,
    /// The name without quotes.
    range: Range<usize>,
    /// Quotes stand around it, or an expression does.
    is_quoted: bool,
    defines: bool,
}

/// The name that stands at a byte: its letters.
pub fn name_at(text: &str, syntax: Syntax, byte: usize) -> Option<Range<usize>> {
    places(text, syntax).into_iter().find(|place| holds_byte(&place.range, byte)).map(|place| place.range)
}

/// Where the name at a byte is defined.
pub fn definition(text: &str, syntax: Syntax, byte: usize) -> Option<Range<usize>> {
    let places = places(text, syntax);
    let at = places.iter().find(|place| holds_byte(&place.range, byte))?;
    let same = |place: &&Place| place.defines && place.of == at.of && place.name == at.name;
    // Of several the last before it: names within hide those around.
    let before = places.iter().filter(same).rfind(|place| place.range.start <= at.range.start);
    before.or_else(|| places.iter().find(same)).map(|place| place.range.clone())
}

/// All places of the name at a byte.
pub fn occurrences(text: &str, syntax: Syntax, byte: usize) -> Vec<Range<usize>> {
    of_one_name(text, syntax, byte).into_iter().map(|place| place.range).collect()
}

/// The edits that give the thing at a byte another name.
///
/// # Errors
/// Why it cannot have that name, in a sentence.
pub fn rename(text: &str, syntax: Syntax, byte: usize, name: &str) -> Result<Vec<Edit>, String> {
    let found = of_one_name(text, syntax, byte);
    let Some(first) = found.first() else { return Err("no name stands here".to_owned()) };
    let of = first.of;
    if of == Of::Var && is_known(name) {
        return Err(format!("{name} means something in expressions"));
    }
    if of == Of::Var && !is_name(name) {
        return Err("the name of a value has letters, digits and underscores, no digit first".to_owned());
    }
    if name.is_empty() || name.chars().any(|c| c.is_control() || matches!(c, '"' | '\\')) {
        return Err("a name has at least one letter, no quotes and no backslash".to_owned());
    }
    if places(text, syntax).iter().any(|place| place.of == of && place.name == name && place.name != first.name) {
        return Err(format!("there is another {name:?} already"));
    }
    let is_bare = name.bytes().all(|byte| matches!(byte, b'_' | b'-') || byte.is_ascii_alphanumeric());
    let edit = |place: Place| {
        let written = if place.is_quoted || is_bare { name.to_owned() } else { format!("\"{name}\"") };
        let span = Span { source: 0, start: place.range.start as u32, end: place.range.end as u32 };
        Edit { span, replacement: written }
    };
    Ok(found.into_iter().map(edit).collect())
}

/// A name, where it is given or used.
pub(super) struct Named {
    pub name: String,
    pub range: Range<usize>,
    /// What it stands for, as it is written; of an index nothing.
    pub value: Option<String>,
}

/// So much of what a name stands for is shown.
const SHOWN: usize = 200;

/// The name that stands at a byte, and what it stands for.
pub(super) fn named_at(text: &str, syntax: Syntax, byte: usize) -> Option<Named> {
    let place = places(text, syntax).into_iter().find(|place| holds_byte(&place.range, byte))?;
    let defined = definition(text, syntax, byte)?;
    // What is long, or has more lines than one, is written anew.
    let in_short = |lexeme: &str| {
        let lexeme: String = lexeme.chars().take(SHOWN).collect();
        lexeme.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let mut value = None;
    visit(&tree(text, syntax), &mut |visit| {
        if visit.name.is_some_and(|key| holds_byte(&range(key.span()), defined.start)) {
            value = Some(in_short(visit.item.lexeme()));
        }
    });
    // A table of TOML is its header: the line tells as much. So does that of an object.
    let is_header = place.of != Of::Var && value.as_ref().is_none_or(|value| value.starts_with('['));
    if is_header {
        let begin = text[..defined.start].rfind('\n').map_or(0, |at| at + 1);
        value = text[begin..].lines().next().map(in_short);
    }
    Some(Named { name: place.name, range: place.range, value })
}

/// The file that a text at a byte names, as it is written.
pub fn file_at(text: &str, syntax: Syntax, byte: usize) -> Option<(Range<usize>, String)> {
    let mut found = None;
    visit(&tree(text, syntax), &mut |visit| {
        let range = range(visit.item.span());
        if matches!(visit.kind, Type::File) && visit.item.kind() == Kind::Text && holds_byte(&range, byte) {
            found = Some((range, visit.item.text().into_owned()));
        }
    });
    found
}

/// The word of an expression that stands at a byte.
pub(super) fn word_of_expression(text: &str, syntax: Syntax, byte: usize) -> Option<Range<usize>> {
    let mut found = None;
    visit(&tree(text, syntax), &mut |visit| {
        let whole = range(visit.item.span());
        if visit.item.kind() == Kind::Text && is_expression(visit.item) && whole.contains(&byte) {
            let is_word = |c: char| c == '_' || c.is_ascii_alphanumeric();
            let start = whole.start + text[whole.start..byte].rfind(|c| !is_word(c)).map_or(0, |at| at + 1);
            let end = text[byte..whole.end].find(|c| !is_word(c)).map_or(whole.end, |at| byte + at);
            found = (start < end).then_some(start..end);
        }
    });
    found
}

/// Names that are given in a scene, in order of writing.
#[derive(Default)]
pub(super) struct Defined {
    /// Of objects and lights.
    pub things: Vec<String>,
    pub materials: Vec<String>,
    pub textures: Vec<String>,
    pub cameras: Vec<String>,
    /// Of values at the top of the scene.
    pub vars: Vec<String>,
}

/// The names that a scene gives.
pub(super) fn defined(text: &str, syntax: Syntax) -> Defined {
    let mut defined = Defined::default();
    for place in places(text, syntax).into_iter().filter(|place| place.defines) {
        let list = match place.of {
            Of::Material => &mut defined.materials,
            Of::Texture => &mut defined.textures,
            Of::Camera => &mut defined.cameras,
            Of::Thing => &mut defined.things,
            Of::Var => &mut defined.vars,
        };
        if !list.contains(&place.name) {
            list.push(place.name);
        }
    }
    defined
}

fn holds_byte(range: &Range<usize>, byte: usize) -> bool {
    (range.start..=range.end).contains(&byte)
}

fn of_one_name(text: &str, syntax: Syntax, byte: usize) -> Vec<Place> {
    let places = places(text, syntax);
    let Some(at) = places.iter().find(|place| holds_byte(&place.range, byte)).cloned() else { return Vec::new() };
    places.into_iter().filter(|place| place.of == at.of && place.name == at.name).collect()
}

/// All places of names, in order.
fn places(text: &str, syntax: Syntax) -> Vec<Place> {
    let tree = tree(text, syntax);
    let mut found = Vec::new();
    visit(&tree, &mut |visit| {
        let field = visit.field.map(|(field, _)| field.name);
        if let Some(key) = visit.name {
            let of = match (visit.section, visit.kind) {
                ("materials", _) => Some(Of::Material),
                ("textures", _) => Some(Of::Texture),
                ("cameras", _) => Some(Of::Camera),
                (_, Type::Value) => Some(Of::Var),
                _ => None,
            };
            if let Some(of) = of {
                found.push(of_text(of, key.lexeme(), key.span(), true, key.text().into_owned()));
            }
        }
        if visit.item.kind() != Kind::Text {
            return;
        }
        if is_expression(visit.item) {
            in_expression(visit.item.lexeme(), visit.item.span().start as usize, &mut found);
        } else if field == Some("material") && matches!(visit.kind, Type::Text) {
            let item = visit.item;
            found.push(of_text(Of::Material, item.lexeme(), item.span(), false, item.text().into_owned()));
        } else if is_texture(visit) {
            let item = visit.item;
            found.push(of_text(Of::Texture, item.lexeme(), item.span(), false, item.text().into_owned()));
        } else if field == Some("camera") && matches!(visit.kind, Type::Text) {
            let item = visit.item;
            found.push(of_text(Of::Camera, item.lexeme(), item.span(), false, item.text().into_owned()));
        } else if field == Some("name") && matches!(visit.section, "objects" | "lights") {
            let item = visit.item;
            found.push(of_text(Of::Thing, item.lexeme(), item.span(), true, item.text().into_owned()));
        } else if visit.section == "output"
            && field.is_none()
            && visit.name.is_none()
            && matches!(visit.kind, Type::Text)
        {
            // An item of `masks`: no other list of the output has texts.
            let item = visit.item;
            found.push(of_text(Of::Thing, item.lexeme(), item.span(), false, item.text().into_owned()));
        } else if field == Some("index") && matches!(visit.kind, Type::Text) {
            let item = visit.item;
            found.push(of_text(Of::Var, item.lexeme(), item.span(), true, item.text().into_owned()));
        }
    });
    found.sort_by_key(|place| place.range.start);
    found.dedup();
    found
}

/// Whether a text is the name of a texture, where that or a colour is due.
fn is_texture(visit: &Visit<'_, '_>) -> bool {
    let is_due = match visit.field {
        Some((field, _)) => field.kind.is_texture(),
        None => visit.section == "textures" && matches!(visit.kind, Type::Color),
    };
    is_due && !visit.item.text().starts_with(['#', '='])
}

fn of_text(of: Of, lexeme: &str, span: Span, defines: bool, name: String) -> Place {
    let is_quoted = lexeme.len() >= 2 && lexeme.starts_with(['"', '\'']);
    let inset = usize::from(is_quoted);
    let whole = range(span);
    Place { of, name, range: whole.start + inset..whole.end - inset, is_quoted, defines }
}

/// The names in an expression that are no functions and no parts.
fn in_expression(lexeme: &str, start: usize, found: &mut Vec<Place>) {
    let bytes = lexeme.as_bytes();
    let is_word = |byte: u8| byte == b'_' || byte.is_ascii_alphanumeric();
    let mut at = 0;
    while at < bytes.len() {
        let from = at;
        while at < bytes.len() && is_word(bytes[at]) {
            at += 1;
        }
        if at == from {
            at += 1;
            continue;
        }
        let before = lexeme[..from].trim_end().bytes().next_back();
        let behind = lexeme[at..].trim_start().bytes().next();
        let is_name = !bytes[from].is_ascii_digit() && !matches!(before, Some(b'.' | b'#')) && behind != Some(b'(');
        let name = &lexeme[from..at];
        if is_name && !is_known(name) {
            let range = start + from..start + at;
            found.push(Place { of: Of::Var, name: name.to_owned(), range, is_quoted: true, defines: false });
        }
    }
}
