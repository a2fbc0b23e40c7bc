//! What is in a scene, as an outline.

use super::visit::{tree, visit};
use crate::syntax::Syntax;
use crate::tree::Kind;
use std::ops::Range;

/// What a thing in the outline is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolKind {
    /// A field of the scene: `camera`, `objects`.
    Section,
    /// A named thing: a material, a value.
    Named,
    /// A thing in a list: an object, a light.
    Item,
}

/// A thing in the outline.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// `objects`, `red`, `Sphere`.
    pub name: String,
    /// `Diffuse` of the material `red`; may be empty.
    pub detail: String,
    /// What it is.
    pub kind: SymbolKind,
    /// All of it.
    pub range: Range<usize>,
    /// Its name.
    pub head: Range<usize>,
    /// What is in it.
    pub children: Vec<Symbol>,
}

/// The names of the fields at the top of a text, whether a scene has them or not.
pub fn words_at_top(text: &str, syntax: Syntax) -> Vec<String> {
    let tree = tree(text, syntax);
    tree.root().into_iter().flat_map(|root| root.fields()).map(|(key, _)| key.text().into_owned()).collect()
}

/// The scene's outline: its sections, and what is in its lists and maps.
pub fn symbols(text: &str, syntax: Syntax) -> Vec<Symbol> {
    let tree = tree(text, syntax);
    let mut sections: Vec<Symbol> = Vec::new();
    visit(&tree, &mut |visit| {
        let whole = super::hover::range(visit.item.span());
        match (visit.depth, visit.field) {
            (1, Some((field, key))) => {
                let head = super::hover::range(key.span());
                let range = head.start.min(whole.start)..head.end.max(whole.end);
                let (name, detail) = (field.name.to_owned(), String::new());
                sections.push(Symbol { name, detail, kind: SymbolKind::Section, range, head, children: Vec::new() });
            }
            (1, None) => {}
            (depth, _) if depth >= 2 => {
                let Some(section) = sections.last_mut().filter(|section| section.name == visit.section) else { return };
                let word = visit.variant.map(|(variant, _)| variant.name.to_owned());
                let symbol = match (visit.name, word) {
                    (Some(name), word) if depth == 2 => Symbol {
                        name: name.text().into_owned(),
                        detail: word.unwrap_or_default(),
                        kind: SymbolKind::Named,
                        range: name.span().start as usize..whole.end.max(name.span().end as usize),
                        head: super::hover::range(name.span()),
                        children: Vec::new(),
                    },
                    (None, Some(word)) if visit.field.is_none() && matches!(visit.section, "objects" | "lights") => {
                        let head = visit.variant.map_or(whole.clone(), |(_, span)| super::hover::range(span));
                        let range = whole.start.min(head.start)..whole.end.max(head.end);
                        // Of items of a `Repeat` there may be many levels; the outline is flat.
                        Symbol {
                            name: word,
                            detail: detail(&visit.item),
                            kind: SymbolKind::Item,
                            range,
                            head,
                            children: Vec::new(),
                        }
                    }
                    _ => return,
                };
                // Items of an object are no objects.
                if section.children.last().is_none_or(|last| symbol.range.start >= last.range.end) {
                    section.range.end = section.range.end.max(symbol.range.end);
                    section.children.push(symbol);
                }
            }
            _ => {}
        }
    });
    sections
}

/// The name of an object, its file, else its material.
fn detail(item: &crate::tree::Item<'_, '_>) -> String {
    let body = match item.kind() {
        Kind::Map => item.fields().next().map(|(_, value)| value),
        _ => Some(*item),
    };
    let Some(body) = body else { return String::new() };
    let text = |wanted: &str| {
        let mut fields = body.fields();
        let (_, value) = fields.find(|(key, _)| key.text() == wanted)?;
        (value.kind() == Kind::Text).then(|| value.text().into_owned())
    };
    text("name").or_else(|| text("file")).or_else(|| text("material")).unwrap_or_default()
}
