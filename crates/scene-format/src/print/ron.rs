//! RON.

use super::{WIDTH, after_blank, has_comments, number, quoted};
use crate::form::{BLANK_LINE, Entry, FILLED, Form, OWN_LINES};

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
        // A comma follows.
        if inline(out, form, mark + (WIDTH - 1).saturating_sub(column).max(20)) {
            return;
        }
        out.truncate(mark);
    }
    match form {
        Form::List(entries) => block(out, "[", entries, "]", depth),
        Form::Map(entries) => block(out, "{", entries, "}", depth),
        Form::Struct { name, fields } => in_brackets(out, name, fields, depth, column),
        Form::Variant { content: Some(content), name } => match &**content {
            Form::Struct { fields, .. } => in_brackets(out, name, fields, depth, column),
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

/// Fields that do not fit on one line: on two, if they fit there; or behind the bracket all but the last, if that is a
/// list whose items stand below it, or a kind that is the only field; else one a line.
fn in_brackets(out: &mut String, name: &str, fields: &[Entry], depth: usize, column: usize) {
    let mark = out.len();
    out.push_str(name);
    out.push('(');
    if two_lines(out, fields, depth, mark + WIDTH.saturating_sub(column)) {
        return out.push(')');
    }
    out.truncate(mark + name.len() + 1);
    if list_below(out, fields, depth, mark + WIDTH.saturating_sub(column)) {
        return out.push(')');
    }
    out.truncate(mark);
    block(out, &format!("{name}("), fields, ")", depth);
}

/// Writes fields behind the bracket and, from the first on that does not fit there, on the next line; `false` where
/// they have comments, or do not fit.
fn two_lines(out: &mut String, fields: &[Entry], depth: usize, limit: usize) -> bool {
    let own_lines = |field: &Entry| field.before.iter().any(|line| line == OWN_LINES);
    let plain = |field: &Entry| field.after.is_none() && field.value != Form::Absent && !has_comments(&field.value);
    if fields.len() < 2 || fields.iter().any(own_lines) || !fields.iter().all(plain) {
        return false;
    }
    if fields.iter().skip(1).any(|field| !field.before.is_empty()) || !after_blank(&fields[0].before).is_empty() {
        return false;
    }
    let (mut limit, mut second) = (limit, false);
    for (index, field) in fields.iter().enumerate() {
        let mark = out.len();
        let is_last = index + 1 == fields.len();
        // A comma follows, or the bracket and a comma.
        let (comma, behind) = if is_last { ("", 2) } else { (",", 1) };
        if index > 0 {
            out.push(' ');
        }
        out.push_str(&key(&field.name, "("));
        if inline(out, &field.value, limit.saturating_sub(behind)) {
            out.push_str(comma);
            continue;
        }
        out.truncate(mark);
        if second || index == 0 {
            return false;
        }
        out.push('\n');
        (second, limit) = (true, out.len() + WIDTH);
        indent(out, depth + 1);
        out.push_str(&key(&field.name, "("));
        if !inline(out, &field.value, limit - behind) {
            return false;
        }
        out.push_str(comma);
    }
    true
}

/// Writes fields of which the last opens a bracket on their line; `false` where they have comments, or do not fit.
fn list_below(out: &mut String, fields: &[Entry], depth: usize, limit: usize) -> bool {
    let Some((last, others)) = fields.split_last() else { return false };
    let commented = |(index, field): (usize, &Entry)| {
        let own_lines = field.before.iter().any(|line| line == OWN_LINES);
        let before = if index == 0 { after_blank(&field.before) } else { &field.before };
        own_lines || !before.is_empty() || field.after.is_some()
    };
    let opens = match &last.value {
        Form::List(items) => {
            items.len() > 1 || items.iter().any(|item| item.before.iter().any(|line| line == OWN_LINES))
        }
        Form::Map(_) => true,
        Form::Variant { content: Some(content), .. } => others.is_empty() && matches!(**content, Form::Struct { .. }),
        _ => false,
    };
    if !opens || fields.iter().enumerate().any(commented) || others.iter().any(|field| has_comments(&field.value)) {
        return false;
    }
    for field in others {
        out.push_str(&key(&field.name, "("));
        if !inline(out, &field.value, limit) {
            return false;
        }
        out.push_str(", ");
    }
    out.push_str(&key(&last.name, "("));
    let opened = out.len();
    match &last.value {
        Form::List(entries) => block(out, "[", entries, "]", depth),
        Form::Map(entries) => block(out, "{", entries, "}", depth),
        Form::Variant { name, content: Some(content) } => {
            let Form::Struct { fields, .. } = &**content else { return false };
            block(out, &format!("{name}("), fields, ")", depth);
        }
        _ => return false,
    }
    opened + out[opened..].find('\n').unwrap_or(0) <= limit
}

/// Entries without comments that shared lines: as many on each line as fit; `false` where one alone does not.
fn filled(out: &mut String, open: &str, entries: &[Entry], depth: usize) -> bool {
    let mut line = out.len();
    for (index, entry) in entries.iter().enumerate() {
        let mark = out.len();
        out.push(' ');
        out.push_str(&key(&entry.name, open));
        if !inline(out, &entry.value, mark + WIDTH) {
            return false;
        }
        out.push(',');
        if index == 0 || out.len() - line > WIDTH {
            let value = out.split_off(mark);
            out.push('\n');
            line = out.len();
            indent(out, depth + 1);
            out.push_str(value.trim_start());
            if out.len() - line > WIDTH {
                return false;
            }
        }
    }
    out.push('\n');
    indent(out, depth);
    true
}

/// One entry a line.
fn block(out: &mut String, open: &str, entries: &[Entry], close: &str, depth: usize) {
    out.push_str(open);
    let plain = |(index, entry): (usize, &Entry)| {
        let before = if index == 0 { after_blank(&entry.before) } else { &entry.before };
        before.is_empty() && entry.after.is_none() && entry.value != Form::Absent && !has_comments(&entry.value)
    };
    let fills = entries.first().is_some_and(|first| first.before.iter().any(|line| line == FILLED));
    let mark = out.len();
    if fills && entries.iter().enumerate().all(plain) && filled(out, open, entries, depth) {
        return out.push_str(close);
    }
    out.truncate(mark);
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
    let (open, close) = if open == "{" && !entries.is_empty() { ("{ ", " }") } else { (open, close) };
    out.push_str(open);
    for (index, entry) in entries.iter().filter(|entry| entry.value != Form::Absent).enumerate() {
        if index > 0 {
            out.push_str(", ");
        }
        out.push_str(&key(&entry.name, open.trim_end()));
        if !inline(out, &entry.value, limit) {
            return false;
        }
    }
    out.push_str(close);
    out.len() <= limit
}
