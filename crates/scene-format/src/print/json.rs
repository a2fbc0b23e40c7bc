//! JSON: no comments, so those of the scene are left out.

use super::{WIDTH, number, quoted};
use crate::form::{BLANK_LINE, Entry, Form};

/// A whole scene.
pub(crate) fn json(scene: &Form) -> String {
    let mut out = String::new();
    match scene {
        // The scene itself is never squeezed into one line.
        Form::Struct { fields, .. } if !fields.is_empty() => block(&mut out, ["{", "}"], fields, 0),
        scene => value(&mut out, scene, 0, 0),
    }
    out.push('\n');
    out
}

/// A value on one line.
pub(crate) fn json_value(form: &Form) -> String {
    let mut out = String::new();
    let _ = inline(&mut out, form, usize::MAX);
    out
}

fn indent(out: &mut String, depth: usize) {
    out.extend(std::iter::repeat_n("    ", depth));
}

/// A value that begins at column `column` of a line of depth `depth`.
fn value(out: &mut String, form: &Form, depth: usize, column: usize) {
    let mark = out.len();
    if !has_blanks(form) && inline(out, form, mark + WIDTH.saturating_sub(column).max(20)) {
        return;
    }
    out.truncate(mark);
    match form {
        Form::List(entries) => block(out, ["[", "]"], entries, depth),
        Form::Map(entries) | Form::Struct { fields: entries, .. } => block(out, ["{", "}"], entries, depth),
        Form::Variant { name, content: Some(content) } => {
            let head = format!("{{ {}: ", text(name));
            out.push_str(&head);
            value(out, content, depth, column + head.len());
            out.push_str(" }");
        }
        _ => {
            let _ = inline(out, form, usize::MAX);
        }
    }
}

/// One entry a line.
fn block(out: &mut String, [open, close]: [&str; 2], entries: &[Entry], depth: usize) {
    out.push_str(open);
    for (index, entry) in entries.iter().enumerate() {
        out.push_str(if index > 0 { ",\n" } else { "\n" });
        if index > 0 && is_after_blank(entry) {
            out.push('\n');
        }
        indent(out, depth + 1);
        let name = if open == "{" { format!("{}: ", text(&entry.name)) } else { String::new() };
        out.push_str(&name);
        value(out, &entry.value, depth + 1, 4 * (depth + 1) + name.chars().count());
    }
    out.push('\n');
    indent(out, depth);
    out.push_str(close);
}

/// Whether an empty line stands before an entry.
fn is_after_blank(entry: &Entry) -> bool {
    entry.before.iter().any(|comment| comment == BLANK_LINE)
}

/// Whether empty lines stand between entries.
fn has_blanks(form: &Form) -> bool {
    match form {
        Form::List(entries) | Form::Map(entries) | Form::Struct { fields: entries, .. } => {
            entries.iter().skip(1).any(is_after_blank) || entries.iter().any(|entry| has_blanks(&entry.value))
        }
        Form::Variant { content: Some(content), .. } => has_blanks(content),
        _ => false,
    }
}

fn text(text: &str) -> String {
    quoted(text, |c| format!("\\u{:04x}", u32::from(c)))
}

/// Writes a value on one line; `false` when that goes beyond `limit` bytes of `out`.
fn inline(out: &mut String, form: &Form, limit: usize) -> bool {
    match form {
        Form::Absent => {}
        Form::Bool(value) => out.push_str(if *value { "true" } else { "false" }),
        Form::Number(value) => out.push_str(&number(*value)),
        Form::Integer(value) => out.push_str(&value.to_string()),
        Form::Lexeme(lexeme) => out.push_str(lexeme),
        Form::Text(value) => out.push_str(&text(value)),
        Form::Vector(numbers) => {
            out.push('[');
            for (index, number) in numbers.iter().enumerate() {
                if index > 0 {
                    out.push_str(", ");
                }
                inline(out, number, usize::MAX);
            }
            out.push(']');
        }
        Form::List(entries) => {
            out.push('[');
            for (index, entry) in entries.iter().enumerate() {
                if index > 0 {
                    out.push_str(", ");
                }
                if !inline(out, &entry.value, limit) {
                    return false;
                }
            }
            out.push(']');
        }
        Form::Map(entries) | Form::Struct { fields: entries, .. } => {
            if entries.is_empty() {
                out.push_str("{}");
                return out.len() <= limit;
            }
            out.push_str("{ ");
            for (index, entry) in entries.iter().enumerate() {
                if index > 0 {
                    out.push_str(", ");
                }
                out.push_str(&text(&entry.name));
                out.push_str(": ");
                if !inline(out, &entry.value, limit) {
                    return false;
                }
            }
            out.push_str(" }");
        }
        Form::Variant { name, content: None } => out.push_str(&text(name)),
        Form::Variant { name, content: Some(content) } => {
            out.push_str("{ ");
            out.push_str(&text(name));
            out.push_str(": ");
            if !inline(out, content, limit) {
                return false;
            }
            out.push_str(" }");
        }
    }
    out.len() <= limit
}
