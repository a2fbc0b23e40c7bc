//! Forms as text, in any syntax: short values on one line, long ones one entry a line, comments where they belong.

mod json;
mod ron;
mod toml;

pub(crate) use json::{json, json_value};
pub(crate) use ron::{ron, ron_value};
pub(crate) use toml::{key as toml_key, text as toml_text, toml, toml_value};

use crate::form::{BLANK_LINE, Entry, FILLED, Form, OWN_LINES};
use crate::syntax::Syntax;

/// Lines are filled up to this many characters.
const WIDTH: usize = 120;

/// A whole scene, with the comments that stand before and after it, where the syntax has comments.
pub(crate) fn scene(scene: &Form, syntax: Syntax, before: &[String], after: &[String]) -> String {
    match syntax {
        Syntax::Ron => ron(scene, before, after),
        Syntax::Toml => toml(scene, before, after),
        Syntax::Json => json(scene),
    }
}

/// A value on one line.
pub(crate) fn value(form: &Form, syntax: Syntax) -> String {
    match syntax {
        Syntax::Ron => ron_value(form),
        Syntax::Toml => toml_value(form),
        Syntax::Json => json_value(form),
    }
}

/// A text between quotes, as a syntax writes it.
pub(crate) fn text(text: &str, syntax: Syntax) -> String {
    value(&Form::Text(text.to_owned()), syntax)
}

/// A number as all syntaxes read it: the shortest digits that give the same value.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-5..1e16).contains(&size) { format!("{value:e}") } else { format!("{value}") }
}

/// A text between double quotes; `unicode` writes the escape of a control character.
fn quoted(text: &str, unicode: impl Fn(char) -> String) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            c if c.is_control() => out.push_str(&unicode(c)),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// Comments without an empty line before the first.
fn after_blank(comments: &[String]) -> &[String] {
    match comments {
        [first, rest @ ..] if first == OWN_LINES || first == FILLED => after_blank(rest),
        [first, rest @ ..] if first == BLANK_LINE => rest,
        _ => comments,
    }
}

/// Whether comments stand inside a value, or empty lines between its entries, or these are to stand on own lines.
fn has_comments(form: &Form) -> bool {
    let inside = |entries: &[Entry]| {
        let own_lines = entries.first().and_then(|entry| entry.before.first()).is_some_and(|first| first == OWN_LINES);
        own_lines
            || entries.iter().enumerate().any(|(index, entry)| {
                let before = if index == 0 { after_blank(&entry.before) } else { &entry.before };
                !before.is_empty() || entry.after.is_some() || has_comments(&entry.value)
            })
    };
    match form {
        Form::List(entries) | Form::Map(entries) | Form::Struct { fields: entries, .. } => inside(entries),
        Form::Variant { content: Some(content), .. } => has_comments(content),
        _ => false,
    }
}
