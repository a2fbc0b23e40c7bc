//! What a word means, where it stands.

use super::complete::in_repeat;
use super::names;
use super::place::way;
use super::visit::{tree, visit};
use crate::expression;
use crate::read::{PICK, REPEAT, expected};
use crate::schema::{Content, FieldDef, StructDef, prose};
use crate::syntax::Syntax;
use crate::tree::{Item, Kind, Tree};
use std::fmt::Write;
use std::ops::Range;

/// What is shown over a word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// The word.
    pub range: Range<usize>,
    /// What it means, as Markdown.
    pub markdown: String,
}

/// What the word at a byte means; a value shows its field.
pub fn hover(text: &str, syntax: Syntax, byte: usize) -> Option<Hover> {
    let tree = tree(text, syntax);
    let mut found: Option<Hover> = None;
    // The innermost field that has a value here.
    let mut valued: Option<Hover> = None;
    visit(&tree, &mut |visit| {
        if holds(visit.item.span(), byte) && (visit.field.is_some() || visit.name.is_some()) {
            // What has a name that the scene gives is nobody's field.
            let field = visit.field.filter(|_| visit.name.is_none());
            valued = field.and_then(|(field, _)| {
                let value = leaf(visit.item, byte)?;
                Some(Hover { range: range(value.span()), markdown: of_field(field, syntax) })
            });
        }
        if let Some((field, key)) = visit.field
            && holds(key.span(), byte)
        {
            found = Some(Hover { range: range(key.span()), markdown: of_field(field, syntax) });
        }
        if let Some((variant, span)) = visit.variant
            && holds(span, byte)
        {
            let mut markdown = format!("**{}**\n\n{}", variant.name, variant.prose());
            if let Content::Struct(def) = &variant.content {
                fields(&mut markdown, def);
            }
            found = Some(Hover { range: range(span), markdown });
        }
    });
    found.or_else(|| of_body(text, byte)).or_else(|| of_name(&tree, text, syntax, byte)).or(valued)
}

/// `Repeat` and `Pick`, which stand in place of any item or value.
fn of_body(text: &str, byte: usize) -> Option<Hover> {
    let is_letter = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    let bytes = text.as_bytes();
    let start = byte - bytes.get(..byte)?.iter().rev().take_while(|byte| is_letter(byte)).count();
    let end = byte + bytes[byte..].iter().take_while(|byte| is_letter(byte)).count();
    let def = [&REPEAT, &PICK].into_iter().find(|def| text.get(start..end) == Some(def.name))?;
    // In a comment or a text it is a word like others.
    let follows = text[end..].trim_start_matches([' ', '"']).starts_with(['(', ':', '=', ']', '.']);
    let mut markdown = format!("**{}**\n\n{}", def.name, prose(def.doc));
    fields(&mut markdown, def);
    follows.then_some(Hover { range: start..end, markdown })
}

/// The value without brackets that stands at a byte: a number of a vector, too, but not what has a name of its own.
fn leaf<'t, 's>(item: Item<'t, 's>, byte: usize) -> Option<Item<'t, 's>> {
    match item.kind() {
        Kind::List | Kind::Tuple if item.name().is_none() => {
            item.children().filter(|child| holds(child.span(), byte)).find_map(|child| leaf(child, byte))
        }
        Kind::List | Kind::Tuple | Kind::Struct | Kind::Map | Kind::Key | Kind::Broken => None,
        _ => Some(item),
    }
}

/// What a name stands for, or what a word of an expression means.
fn of_name(tree: &Tree<'_>, text: &str, syntax: Syntax, byte: usize) -> Option<Hover> {
    if let Some(names::Named { name, range, value }) = names::named_at(tree, text, syntax, byte) {
        let means = value.map_or("counts from 0: the index of a `Repeat`".to_owned(), |value| format!("`{value}`"));
        return Some(Hover { range, markdown: format!("**{name}**: {means}") });
    }
    let word = names::word_of_expression(tree, text, byte)?;
    let name = &text[word.clone()];
    let markdown = match expression::function(name) {
        Some((call, does)) => format!("**{call}**\n\n{does}"),
        None => match expression::constant(name) {
            Some(means) => format!("**{name}**: {means}"),
            None if name == "i" && in_repeat(&way(text, syntax, byte)) => {
                "**i**: counts from 0: the index of a `Repeat`".to_owned()
            }
            None => return None,
        },
    };
    Some(Hover { range: word, markdown })
}

/// What a field takes and means.
pub(super) fn of_field(field: &FieldDef, syntax: Syntax) -> String {
    let mut out = format!("**{}**: {}", field.name, expected(field));
    if let Some(default) = default_text(field, syntax) {
        let _ = write!(out, "; default `{default}`");
    }
    let _ = write!(out, "\n\n{}", prose(field.doc));
    out
}

/// A field's default as it would be written; `None` where it must be, or where it is nothing that has words.
pub(super) fn default_text(field: &FieldDef, syntax: Syntax) -> Option<String> {
    let form = field.default?();
    let text = crate::print::value(&form, syntax);
    (!text.is_empty() && text.len() <= 40).then_some(text)
}

/// The fields of a kind, one a line.
pub(super) fn fields(out: &mut String, def: &StructDef) {
    out.push('\n');
    for field in def.fields {
        let _ = write!(out, "\n- `{}`: {}", field.name, expected(field));
    }
}

pub(super) fn range(span: crate::diagnostic::Span) -> Range<usize> {
    span.start as usize..span.end as usize
}

pub(super) fn holds(span: crate::diagnostic::Span, byte: usize) -> bool {
    (span.start as usize..=span.end as usize).contains(&byte)
}
