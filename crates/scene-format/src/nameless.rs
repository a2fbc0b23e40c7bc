//! Values that stand among fields without the names of theirs: what the name is, where the value tells it.

use crate::codes;
use crate::desc::Object;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::read::field_of;

/// How far back the bracket is looked for that a value stands in.
const FAR: usize = 1000;

/// Says which field is meant: a material is the `material`, a transform stands in the list of them.
pub(crate) fn name_values(text: &str, faults: &mut [Diagnostic]) {
    for fault in faults {
        if fault.code == codes::MIXED_FIELDS && fault.edit.is_none() && fault.span.source == 0 {
            name_first(text, fault);
            continue;
        }
        let is_nameless = fault.code == codes::MISSING_NAME && fault.edit.is_none() && fault.span.source == 0;
        let place = fault.span.start as usize..fault.span.end as usize;
        let Some(value) = text.get(place.clone()).filter(|_| is_nameless) else { continue };
        let of_items = || items_of(opened_by(text, place.start), value);
        let Some((field, mended)) = field_of(value).or_else(of_items) else { continue };
        let is_there = fields_before(text, place.start).any(|name| name == field);
        if is_there || !is_whole(value) {
            continue;
        }
        fault.hint = format!("write `{mended}`");
        fault.edit = Some(Edit { span: fault.span, replacement: mended });
    }
}

/// The same of one before others that have names: `Scene(Camera(..), objects: [..])`.
fn name_first(text: &str, fault: &mut Diagnostic) {
    let Some(span) = fault.labels.first().map(|label| label.span) else { return };
    // A list would have to end somewhere, too.
    let value = text.get(span.start as usize..).and_then(field_of).filter(|(field, _)| *field != "transform");
    let Some((field, _)) = value else { return };
    let kind = text[span.start as usize..].split('(').next().unwrap_or_default().trim_end();
    fault.hint = format!("write `{field}: {kind}(..)`");
    fault.edit = Some(Edit { span: Span { end: span.start, ..span }, replacement: format!("{field}: ") });
}

/// The list of an object that stands alone in what has a list of them.
fn items_of(kind: &str, value: &str) -> Option<(&'static str, String)> {
    let object = value.split('(').next().is_some_and(|name| Object::DEF.variant(name.trim_end()).is_some());
    let field = match kind {
        "Repeat" => "items",
        "Group" | "Union" | "Intersection" | "Difference" => "objects",
        _ => return None,
    };
    object.then(|| (field, format!("{field}: [{value}]")))
}

/// The kind whose bracket a place stands in.
fn opened_by(text: &str, at: usize) -> &str {
    let before = text[..begin_of(text, at)].strip_suffix('(').unwrap_or("").trim_end();
    before.rsplit(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).next().unwrap_or("")
}

/// Whether all brackets of a value are closed in it: one of several lines is told by its first.
fn is_whole(value: &str) -> bool {
    let count = |signs: [char; 3]| value.matches(signs).count();
    count(['(', '[', '{']) == count([')', ']', '}'])
}

/// The names of fields between the bracket that a place stands in and the place.
fn fields_before(text: &str, at: usize) -> impl Iterator<Item = &str> {
    text[begin_of(text, at)..at]
        .split(':')
        .map(|before| before.rsplit([',', '(', ' ', '\n', '\t']).find(|word| !word.is_empty()))
        .map(|name| name.unwrap_or(""))
}

/// Where what stands in the bracket begins that a place stands in.
fn begin_of(text: &str, at: usize) -> usize {
    let mut depth = 0usize;
    let far = text[..at].bytes().rev().take(FAR).position(|byte| {
        match byte {
            b')' | b']' | b'}' => depth += 1,
            b'(' | b'[' | b'{' if depth == 0 => return true,
            b'(' | b'[' | b'{' => depth -= 1,
            _ => {}
        }
        false
    });
    at - far.unwrap_or(0)
}
