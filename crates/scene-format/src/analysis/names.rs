//! Names that a person gives: of materials, of textures, of cameras, of objects and lights, and of values in `vars`.

use super::hover::range;
use super::visit::{Visit, tree, visit};
use crate::diagnostic::Edit;
use crate::diagnostic::Span;
use crate::expression::{is_known, is_name};
use crate::read::is_expression;
use crate::schema::Type;
use crate::syntax::{Syntax, decode};
use crate::tree::{Item, Kind, Tree};
use std::borrow::Cow;
use std::collections::HashSet;
use std::ops::Range;

/// What a name is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Of {
    Material,
    Texture,
    Camera,
    Var,
    /// An object or a light, which masks name.
    Thing,
}

/// A place where a name stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Place<'s> {
    pub of: Of,
    pub name: Cow<'s, str>,
    /// The name without quotes.
    pub range: Range<usize>,
    /// The quote that stands around it; of an expression the one around that.
    quote: Option<char>,
    pub defines: bool,
    /// Where a name that is given here is known; `None`: everywhere.
    pub scope: Option<Range<usize>>,
}

/// The name that stands at a byte: its letters.
pub fn name_at(text: &str, syntax: Syntax, byte: usize) -> Option<Range<usize>> {
    let places = places(&tree(text, syntax), text, syntax);
    places.into_iter().find(|place| holds_byte(&place.range, byte)).map(|place| place.range)
}

/// Where the name at a byte is defined.
pub fn definition(text: &str, syntax: Syntax, byte: usize) -> Option<Range<usize>> {
    let places = places(&tree(text, syntax), text, syntax);
    let at = places.iter().find(|place| holds_byte(&place.range, byte))?;
    defined_of(&places, at).map(|place| place.range.clone())
}

/// The name that stands at a byte, as it is meant.
pub fn name_meant(text: &str, syntax: Syntax, byte: usize) -> Option<String> {
    let places = places(&tree(text, syntax), text, syntax);
    places.into_iter().find(|place| holds_byte(&place.range, byte)).map(|place| place.name.into_owned())
}

/// The place that gives the name at another one: names within hide those around.
pub(super) fn defined_of<'p, 's>(places: &'p [Place<'s>], at: &Place<'_>) -> Option<&'p Place<'s>> {
    let known = |place: &Place<'_>| {
        place.scope.as_ref().is_none_or(|scope| scope.start <= at.range.start && at.range.end <= scope.end)
    };
    let same = |place: &&Place<'_>| place.defines && place.of == at.of && place.name == at.name && known(place);
    let nearest = |place: &&Place<'_>| {
        let start = place.range.start;
        let length = place.scope.as_ref().map_or(usize::MAX, ExactSizeIterator::len);
        // Of several the last before it.
        (length, start > at.range.start, start.abs_diff(at.range.start))
    };
    places.iter().filter(same).min_by_key(nearest)
}

/// All places of the name at a byte.
pub fn occurrences(text: &str, syntax: Syntax, byte: usize) -> Vec<Range<usize>> {
    let places = places(&tree(text, syntax), text, syntax);
    of_one_name(&places, byte).map(|place| place.range.clone()).collect()
}

/// The edits that give the thing at a byte another name.
///
/// # Errors
/// Why it cannot have that name, in a sentence.
pub fn rename(text: &str, syntax: Syntax, byte: usize, name: &str) -> Result<Vec<Edit>, String> {
    let places = places(&tree(text, syntax), text, syntax);
    let Some(first) = of_one_name(&places, byte).next() else { return Err("no name stands here".to_owned()) };
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
    if name.starts_with('=') || of == Of::Texture && name.starts_with('#') {
        return Err("a text that begins so is an expression or a colour".to_owned());
    }
    if name.contains('\'') && of_one_name(&places, byte).any(|place| place.quote == Some('\'')) {
        return Err("a name between single quotes has none".to_owned());
    }
    if !of_one_name(&places, byte).any(|place| place.defines) {
        let why = match (of, &*first.name) {
            (Of::Var, "i") => "it is what a `Repeat` counts by; write `index` there, with a name",
            _ => "it is not given in this file",
        };
        return Err(format!("{:?} cannot be renamed here: {why}", first.name));
    }
    if places.iter().any(|place| place.of == of && place.name == name && place.name != first.name) {
        return Err(format!("there is another {name:?} already"));
    }
    Ok(of_one_name(&places, byte).map(|place| edit_of(place, name)).collect())
}

/// Another name in place of this one.
pub(super) fn edit_of(place: &Place<'_>, name: &str) -> Edit {
    let is_bare = name.bytes().all(|byte| matches!(byte, b'_' | b'-') || byte.is_ascii_alphanumeric());
    let replacement = if place.quote.is_some() || is_bare { name.to_owned() } else { format!("\"{name}\"") };
    let span = Span { source: 0, start: place.range.start as u32, end: place.range.end as u32 };
    Edit { span, replacement }
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
pub(super) fn named_at(tree: &Tree<'_>, text: &str, syntax: Syntax, byte: usize) -> Option<Named> {
    let places = places(tree, text, syntax);
    let place = places.iter().find(|place| holds_byte(&place.range, byte))?;
    let defined = defined_of(&places, place)?.range.clone();
    // What is long, or has more lines than one, is written anew.
    let in_short = |lexeme: &str| {
        let lexeme: String = lexeme.chars().take(SHOWN).collect();
        lexeme.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let mut value = None;
    visit(tree, &mut |visit| {
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
    Some(Named { name: place.name.to_string(), range: place.range.clone(), value })
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
pub(super) fn word_of_expression(tree: &Tree<'_>, text: &str, byte: usize) -> Option<Range<usize>> {
    let mut found = None;
    visit(tree, &mut |visit| {
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
    let (mut defined, mut seen) = (Defined::default(), HashSet::new());
    for place in places(&tree(text, syntax), text, syntax).into_iter().filter(|place| place.defines) {
        let list = match place.of {
            Of::Material => &mut defined.materials,
            Of::Texture => &mut defined.textures,
            Of::Camera => &mut defined.cameras,
            Of::Thing => &mut defined.things,
            Of::Var => &mut defined.vars,
        };
        // A thousand objects may have a name each.
        if seen.insert((place.of, place.name.clone())) {
            list.push(place.name.into_owned());
        }
    }
    defined
}

pub(super) fn holds_byte(range: &Range<usize>, byte: usize) -> bool {
    (range.start..=range.end).contains(&byte)
}

/// The places of the name at a byte: those that the same place gives it to.
fn of_one_name<'p, 's>(places: &'p [Place<'s>], byte: usize) -> impl Iterator<Item = &'p Place<'s>> {
    let at = places.iter().find(|place| holds_byte(&place.range, byte));
    let scope = at.map(|at| defined_of(places, at).and_then(|given| given.scope.clone()));
    places.iter().filter(move |place| {
        at.is_some_and(|at| place.of == at.of && place.name == at.name)
            && scope == Some(defined_of(places, place).and_then(|given| given.scope.clone()))
    })
}

/// All places of names, in order.
pub(super) fn places<'s>(tree: &Tree<'s>, text: &'s str, syntax: Syntax) -> Vec<Place<'s>> {
    let mut found = Vec::new();
    visit(tree, &mut |visit| {
        let scope = visit.scope.map(range);
        if let Some(key) = visit.name.filter(|_| visit.included.is_none()) {
            let of = match (visit.section, visit.kind) {
                ("materials", _) => Some(Of::Material),
                ("textures", _) => Some(Of::Texture),
                ("cameras", _) => Some(Of::Camera),
                (_, Type::Value) => Some(Of::Var),
                _ => None,
            };
            let scope = scope.clone().filter(|_| visit.section != "vars");
            found.extend(of.map(|of| Place { scope, ..of_text(of, key, true) }));
        }
        if visit.item.kind() != Kind::Text {
            return;
        }
        let is_text = matches!(visit.kind, Type::Text | Type::File);
        if is_expression(visit.item) && !is_text {
            in_expression(visit.item.lexeme(), visit.item.span().start as usize, &mut found);
        } else if let Some((of, defines)) = of_value(visit) {
            let scope = scope.filter(|_| of == Of::Var);
            found.push(Place { scope, ..of_text(of, visit.item, defines) });
        }
    });
    if syntax == Syntax::Toml {
        in_headers(text, &mut found);
    }
    found.sort_by_key(|place| place.range.start);
    found.dedup_by(|a, b| a.range == b.range && a.of == b.of);
    found
}

/// Names in the headers and dotted keys of TOML that go on with what others have begun: the tree has the first alone.
fn in_headers<'s>(text: &'s str, found: &mut Vec<Place<'s>>) {
    let mut header: Vec<Range<usize>> = Vec::new();
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let inner = line.trim_start_matches([' ', '\t', '[']);
        let start = at + line.len() - inner.len();
        let is_header = line.trim_start().starts_with('[');
        at += line.len();
        let Some(path) = toml_path(inner, start, if is_header { ']' } else { '=' }) else { continue };
        let whole: Vec<Range<usize>> =
            if is_header { path.clone() } else { header.iter().cloned().chain(path.iter().cloned()).collect() };
        if is_header {
            header = path;
        }
        let [section, name, ..] = whole.as_slice() else { continue };
        let of = match &text[section.clone()] {
            "materials" => Of::Material,
            "textures" => Of::Texture,
            "cameras" => Of::Camera,
            "vars" => Of::Var,
            _ => continue,
        };
        let quote = text[..name.start].chars().next_back().filter(|sign| matches!(sign, '"' | '\''));
        let inset = usize::from(quote.is_some());
        let meant = decode::toml_key(text.get(name.start - inset..name.end + inset).unwrap_or(""));
        if found.iter().any(|place| place.defines && place.of == of && place.name == meant) {
            found.push(Place { of, name: meant, range: name.clone(), quote, defines: true, scope: None });
        }
    }
}

/// The names of a dotted key, without their quotes, up to the sign that ends it; `None` where there is no such key.
fn toml_path(line: &str, start: usize, end: char) -> Option<Vec<Range<usize>>> {
    let (mut names, mut rest) = (Vec::new(), line);
    loop {
        rest = rest.trim_start_matches([' ', '\t']);
        let at = start + line.len() - rest.len();
        let quote = rest.chars().next().filter(|sign| matches!(sign, '"' | '\''));
        let length = match quote {
            Some(quote) => rest[1..].find(quote)?,
            None => rest.bytes().take_while(|byte| byte.is_ascii_alphanumeric() || b"_-".contains(byte)).count(),
        };
        let inset = usize::from(quote.is_some());
        if length == 0 {
            return None;
        }
        names.push(at + inset..at + inset + length);
        rest = rest[length + 2 * inset..].trim_start_matches([' ', '\t']);
        match rest.strip_prefix('.') {
            Some(next) => rest = next,
            None => return rest.starts_with(end).then_some(names),
        }
    }
}

/// What a text is the name of, if it is one, and whether it gives the name.
fn of_value(visit: &Visit<'_, '_>) -> Option<(Of, bool)> {
    let is_text = matches!(visit.kind, Type::Text);
    match visit.field.map(|(field, _)| field.name) {
        // What stands in place of the materials of an included file.
        None if visit.included == Some("materials") => Some((Of::Material, false)),
        Some("material") if is_text => Some((Of::Material, false)),
        _ if is_texture(visit) => Some((Of::Texture, false)),
        Some("camera") if is_text => Some((Of::Camera, false)),
        Some("name") if matches!(visit.section, "objects" | "lights") => Some((Of::Thing, true)),
        // An item of `masks`: no other list of the output has texts.
        None if is_text && visit.section == "output" && visit.name.is_none() => Some((Of::Thing, false)),
        Some("index") if is_text => Some((Of::Var, true)),
        _ => None,
    }
}

/// Whether a text is the name of a texture, where that or a colour is due.
fn is_texture(visit: &Visit<'_, '_>) -> bool {
    let is_due = match visit.field {
        Some((field, _)) => field.kind.is_texture(),
        None => visit.section == "textures" && matches!(visit.kind, Type::Color),
    };
    is_due && !visit.item.text().starts_with(['#', '='])
}

fn of_text<'s>(of: Of, item: Item<'_, 's>, defines: bool) -> Place<'s> {
    let lexeme = item.lexeme();
    // `r#"red"#` of RON, too.
    let raw = lexeme.strip_prefix('r').filter(|rest| rest.starts_with(['"', '#']) && rest.ends_with(['"', '#']));
    let hashes = raw.map_or(0, |rest| rest.bytes().take_while(|byte| *byte == b'#').count());
    let quote = lexeme[usize::from(raw.is_some()) + hashes..].chars().next().filter(|c| matches!(c, '"' | '\''));
    let quote = quote.filter(|_| lexeme.len() >= 2);
    let inset = usize::from(quote.is_some()) * (1 + hashes);
    let whole = range(item.span());
    let range = whole.start + inset + usize::from(raw.is_some())..whole.end - inset;
    Place { of, name: item.text(), range, quote, defines, scope: None }
}

/// The names in an expression that are no functions and no parts.
fn in_expression<'s>(lexeme: &'s str, start: usize, found: &mut Vec<Place<'s>>) {
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
            let quote = Some('"');
            found.push(Place { of: Of::Var, name: name.into(), range, quote, defines: false, scope: None });
        }
    }
}
