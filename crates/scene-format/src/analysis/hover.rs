//! What a word means, where it stands.

use super::names;
use super::visit::{tree, visit};
use crate::expression;
use crate::read::expected;
use crate::schema::{Content, FieldDef, StructDef, prose};
use crate::syntax::Syntax;
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

/// What the word at a byte means.
pub fn hover(text: &str, syntax: Syntax, byte: usize) -> Option<Hover> {
    let tree = tree(text, syntax);
    let mut found: Option<Hover> = None;
    visit(&tree, &mut |visit| {
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
    found.or_else(|| of_name(text, syntax, byte))
}

/// What a name stands for, or what a word of an expression means.
fn of_name(text: &str, syntax: Syntax, byte: usize) -> Option<Hover> {
    if let Some(names::Named { name, range, value }) = names::named_at(text, syntax, byte) {
        let means = value.map_or("counts from 0: the index of a `Repeat`".to_owned(), |value| format!("`{value}`"));
        return Some(Hover { range, markdown: format!("**{name}**: {means}") });
    }
    let word = names::word_of_expression(text, syntax, byte)?;
    let name = &text[word.clone()];
    let markdown = match expression::function(name) {
        Some((call, does)) => format!("**{call}**\n\n{does}"),
        None => format!("**{name}**: {}", expression::constant(name)?),
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
