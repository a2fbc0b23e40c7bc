//! RON.

use super::{WIDTH, after_blank, has_comments, number, quoted};
use crate::form::{BLANK_LINE, Entry, Form};

/// A whole scene, with the comments that stand before and after it.
pub(crate) fn ron(scene: &Form, before: &[String], after: &[String]) -> String {
    let mut out = String::new();
    for comment in after_blank(before) {
        comment_line(&mut out, comment, 0);
    }
    // The scene itself is never squeezed into one line.
    if let Form::Struct { name, fields } = scene {
        block(&mut out, &format!("{name}("), fields, ")", 0);
    } else {
        value(&mut out, scene, 0, 0);
    }
    out.push('\n');
    for comment in after {
        comment_line(&mut out, comment, 0);
    }
    out
}

/// A value on one line.
pub(crate) fn ron_value(form: &Form) -> String {
    let mut out = String::new();
    let _ = inline(&mut out, form, usize::MAX);
    out
}

fn comment_line(out: &mut String, comment: &str, depth: usize) {
    if comment == BLANK_LINE {
        return out.push('\n');
    }
    indent(out, depth);
    out.push_str("//");
    if !comment.is_empty() {
        out.push(' ');
        out.push_str(comment);
    }
    out.push('\n');
}

fn indent(out: &mut String, depth: usize) {
    out.extend(std::iter::repeat_n("    ", depth));
}

/// A value that begins at column `column` of a line of depth `depth`.
fn value(out: &mut String, form: &Form, depth: usize, column: usize) {
    if !has_comments(form) {
        let mark = out.len();
        if inline(out, form, mark + WIDTH.saturating_sub(column).max(20)) {
            return;
        }
        out.truncate(mark);
    }
    match form {
        Form::List(entries) => block(out, "[", entries, "]", depth),
        Form::Map(entries) => block(out, "{", entries, "}", depth),
        Form::Struct { name, fields } => block(out, &format!("{name}("), fields, ")", depth),
        Form::Variant { content: Some(content), name } => match &**content {
            Form::Struct { fields, .. } => block(out, &format!("{name}("), fields, ")", depth),
            content => {
                out.push_str(name);
                out.push('(');
                value(out, content, depth, column + name.len() + 1);
                out.push(')');
            }
        },
        _ => {
            let _ = inline(out, form, usize::MAX);
        }
    }
}

/// One entry a line.
fn block(out: &mut String, open: &str, entries: &[Entry], close: &str, depth: usize) {
    out.push_str(open);
    out.push('\n');
    for (index, entry) in entries.iter().enumerate() {
        let before = if index == 0 { after_blank(&entry.before) } else { &entry.before };
        for comment in before {
            comment_line(out, comment, depth + 1);
        }
        if entry.value == Form::Absent {
            continue;
        }
        indent(out, depth + 1);
        let name = key(&entry.name, open);
        out.push_str(&name);
        value(out, &entry.value, depth + 1, 4 * (depth + 1) + name.chars().count());
        out.push(',');
        if let Some(comment) = &entry.after {
            out.push_str(" // ");
            out.push_str(comment);
        }
        out.push('\n');
    }
    indent(out, depth);
    out.push_str(close);
}

fn key(name: &str, open: &str) -> String {
    match (name, open) {
        (_, "[") => String::new(),
        (name, "{") => format!("{}: ", text(name)),
        (name, _) => format!("{name}: "),
    }
}

fn text(text: &str) -> String {
    quoted(text, |c| format!("\\u{{{:x}}}", u32::from(c)))
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
            out.push('(');
            for (index, number) in numbers.iter().enumerate() {
                if index > 0 {
                    out.push_str(", ");
                }
                inline(out, number, usize::MAX);
            }
            out.push(')');
        }
        Form::List(entries) => return entries_inline(out, "[", entries, "]", limit),
        Form::Map(entries) => return entries_inline(out, "{", entries, "}", limit),
        Form::Struct { name, fields } => return entries_inline(out, &format!("{name}("), fields, ")", limit),
        Form::Variant { name, content: None } => out.push_str(name),
        Form::Variant { name, content: Some(content) } => {
            if let Form::Struct { fields, .. } = &**content {
                return entries_inline(out, &format!("{name}("), fields, ")", limit);
            }
            out.push_str(name);
            out.push('(');
            if !inline(out, content, limit) {
                return false;
            }
            out.push(')');
        }
    }
    out.len() <= limit
}

fn entries_inline(out: &mut String, open: &str, entries: &[Entry], close: &str, limit: usize) -> bool {
    out.push_str(open);
    for (index, entry) in entries.iter().enumerate() {
        if index > 0 {
            out.push_str(", ");
        }
        out.push_str(&key(&entry.name, open));
        if !inline(out, &entry.value, limit) {
            return false;
        }
    }
    out.push_str(close);
    out.len() <= limit
}
