//! TOML: groups of fields as `[tables]`, objects and lights as `[[lists]]`, the rest on one line each.

use super::{WIDTH, after_blank, has_comments, number, quoted};
use crate::form::{BLANK_LINE, Entry, Form};

/// A whole scene, with the comments that stand before and after it.
pub(crate) fn toml(scene: &Form, before: &[String], after: &[String]) -> String {
    let mut out = String::new();
    comments(&mut out, before);
    blank(&mut out);
    let Form::Struct { fields, .. } = scene else { return out };
    // Plain values come first: after a header they would belong to it.
    for entry in fields.iter().filter(|entry| !is_table(&entry.value) && entry.value != Form::Absent) {
        line(&mut out, entry);
    }
    for entry in fields.iter().filter(|entry| is_table(&entry.value)) {
        match &entry.value {
            Form::List(items) => {
                let mut before = entry.before.as_slice();
                for item in items {
                    blank(&mut out);
                    comments(&mut out, after_blank(std::mem::take(&mut before)));
                    comments(&mut out, after_blank(&item.before));
                    if item.value == Form::Absent {
                        continue;
                    }
                    out.push_str(&format!("[[{}]]", entry.name));
                    // What is said of an item stands behind the line that is the whole of it.
                    let whole = on_one_line(&item.value).map(|whole| Entry { after: item.after.clone(), ..whole });
                    end_line(&mut out, item.after.as_deref().filter(|_| whole.is_none()));
                    match whole {
                        Some(whole) => line(&mut out, &whole),
                        None => body(&mut out, &entry.name, &item.value),
                    }
                }
                if let Some(after) = &entry.after {
                    comments(&mut out, std::slice::from_ref(after));
                }
            }
            value => {
                blank(&mut out);
                comments(&mut out, after_blank(&entry.before));
                out.push_str(&format!("[{}]", entry.name));
                end_line(&mut out, entry.after.as_deref());
                body(&mut out, &entry.name, value);
            }
        }
    }
    let last = fields.iter().filter(|entry| entry.value == Form::Absent).map(|entry| entry.before.as_slice());
    for after in last.chain([after]).filter(|after| !after.is_empty()) {
        blank(&mut out);
        comments(&mut out, after_blank(after));
    }
    out
}

/// A value on one line.
pub(crate) fn toml_value(form: &Form) -> String {
    let mut out = String::new();
    inline(&mut out, form);
    out
}

/// Whether a field of the scene gets a header.
fn is_table(form: &Form) -> bool {
    match form {
        Form::Struct { .. } | Form::Map(_) => true,
        // A list of names is no list of tables.
        Form::List(items) => !items.is_empty() && items.iter().all(|item| !matches!(item.value, Form::Text(_))),
        _ => false,
    }
}

/// What stands under the header `path`.
fn body(out: &mut String, path: &str, form: &Form) {
    match form {
        Form::Struct { fields, .. } => fields.iter().for_each(|entry| line(out, entry)),
        Form::Map(entries) => {
            // In their order, which numbers them: what follows on a header has one, too.
            let tabled = |entry: &Entry| {
                let variant = matches!(&entry.value, Form::Variant { content: Some(content), .. }
                    if matches!(**content, Form::Struct { .. }));
                variant && entry.value != Form::Absent
            };
            let first = entries.iter().position(|entry| tabled(entry) && !fits(entry)).unwrap_or(entries.len());
            let is_line = |(k, entry): &(usize, &Entry)| *k < first || !tabled(entry);
            let there = entries.iter().enumerate().filter(|(_, entry)| entry.value != Form::Absent);
            let (short, long): (Vec<_>, Vec<_>) = there.partition(is_line);
            short.iter().for_each(|(_, entry)| line(out, entry));
            for (_, entry) in long {
                let Form::Variant { name, content: Some(content) } = &entry.value else { continue };
                let path = format!("{path}.{}.{name}", key(&entry.name));
                blank(out);
                sub_table(out, &path, entry, content);
            }
            // What stands below the last of them.
            entries.iter().filter(|entry| entry.value == Form::Absent).for_each(|entry| line(out, entry));
        }
        Form::Variant { name, content: Some(content) } => {
            let entry = Entry::new(*name, (**content).clone());
            if fits(&entry) { line(out, &entry) } else { sub_table(out, &format!("{path}.{name}"), &entry, content) }
        }
        other => {
            inline(out, other);
            out.push('\n');
        }
    }
}

fn sub_table(out: &mut String, path: &str, entry: &Entry, content: &Form) {
    let Form::Struct { .. } = content else { return line(out, entry) };
    comments(out, after_blank(&entry.before));
    out.push_str(&format!("[{path}]"));
    end_line(out, entry.after.as_deref());
    body(out, path, content);
}

/// A kind with its fields as the one entry below its header, if that fits on a line.
fn on_one_line(form: &Form) -> Option<Entry> {
    let Form::Variant { name, content: Some(content) } = form else { return None };
    Some(Entry::new(*name, (**content).clone())).filter(fits)
}

/// Whether an entry can stand on one line.
fn fits(entry: &Entry) -> bool {
    !has_comments(&entry.value) && key(&entry.name).len() + 3 + toml_value(&entry.value).chars().count() <= WIDTH
}

/// `name = value`; lists that are long or hold comments take several lines. Tables in braces cannot, so that the
/// comments in them move up before the line.
fn line(out: &mut String, entry: &Entry) {
    let is_first = out.is_empty();
    let at_head =
        is_first || out.ends_with("\n\n") || out.lines().next_back().is_some_and(|line| line.starts_with('['));
    comments(out, if at_head { after_blank(&entry.before) } else { &entry.before });
    if entry.value == Form::Absent {
        return;
    }
    let mut inner = Vec::new();
    hoisted(&entry.value, false, &mut inner);
    comments(out, &inner);
    if is_first && !out.is_empty() {
        // What stands at the head of a file is read as the file's.
        out.push('\n');
    }
    out.push_str(&key(&entry.name));
    out.push_str(" = ");
    match &entry.value {
        Form::List(items) if !items.is_empty() && !fits(entry) => {
            out.push_str("[\n");
            for item in items {
                let mut inner = item.before.clone();
                hoisted(&item.value, true, &mut inner);
                for comment in &inner {
                    out.push_str(if comment == BLANK_LINE { "" } else { "    " });
                    comments(out, std::slice::from_ref(comment));
                }
                if item.value == Form::Absent {
                    continue;
                }
                out.push_str("    ");
                inline(out, &item.value);
                out.push(',');
                end_line(out, item.after.as_deref());
            }
            out.push(']');
        }
        value => inline(out, value),
    }
    end_line(out, entry.after.as_deref());
}

/// Comments that stand inside a value that will be on one line; those of a list's own items stay when it has several
/// lines.
fn hoisted(form: &Form, lists: bool, out: &mut Vec<String>) {
    let entries = match form {
        Form::List(_) if !lists => return,
        Form::List(entries) | Form::Map(entries) | Form::Struct { fields: entries, .. } => entries,
        Form::Variant { content: Some(content), .. } => return hoisted(content, true, out),
        _ => return,
    };
    for entry in entries {
        out.extend(entry.before.iter().filter(|comment| *comment != BLANK_LINE).cloned());
        out.extend(entry.after.clone());
        hoisted(&entry.value, true, out);
    }
}

fn blank(out: &mut String) {
    if !out.is_empty() {
        out.push('\n');
    }
}

fn comments(out: &mut String, comments: &[String]) {
    for comment in comments {
        if comment == BLANK_LINE {
            out.push('\n');
            continue;
        }
        out.push('#');
        if !comment.is_empty() {
            out.push(' ');
            out.push_str(comment);
        }
        out.push('\n');
    }
}

fn end_line(out: &mut String, comment: Option<&str>) {
    if let Some(comment) = comment {
        out.push_str(" # ");
        out.push_str(comment);
    }
    out.push('\n');
}

/// A text between quotes.
pub(crate) fn text(text: &str) -> String {
    quoted(text, |c| format!("\\u{:04x}", u32::from(c)))
}

/// A name, between quotes where it needs them.
pub(crate) fn key(name: &str) -> String {
    let bare = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-'));
    if bare { name.to_owned() } else { text(name) }
}

/// The entries that are more than comments.
fn there(entries: &[Entry]) -> impl Iterator<Item = &Entry> {
    entries.iter().filter(|entry| entry.value != Form::Absent)
}

fn inline(out: &mut String, form: &Form) {
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
                inline(out, number);
            }
            out.push(']');
        }
        Form::List(entries) => {
            out.push('[');
            for (index, entry) in there(entries).enumerate() {
                if index > 0 {
                    out.push_str(", ");
                }
                inline(out, &entry.value);
            }
            out.push(']');
        }
        Form::Map(entries) | Form::Struct { fields: entries, .. } => {
            if there(entries).next().is_none() {
                return out.push_str("{}");
            }
            out.push_str("{ ");
            for (index, entry) in there(entries).enumerate() {
                if index > 0 {
                    out.push_str(", ");
                }
                out.push_str(&key(&entry.name));
                out.push_str(" = ");
                inline(out, &entry.value);
            }
            out.push_str(" }");
        }
        Form::Variant { name, content: None } => out.push_str(&text(name)),
        Form::Variant { name, content: Some(content) } => {
            out.push_str(&format!("{{ {name} = "));
            inline(out, content);
            out.push_str(" }");
        }
    }
}
