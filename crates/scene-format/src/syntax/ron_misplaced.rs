//! What stands in the wrong brackets of RON: items of a list with names, items without their list, the fields of a kind
//! without the kind, a table of TOML. Each is told once, with the way, and read as it was meant.

use super::ron::Parser;
use super::ron_scan::is_closed_ahead;
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::tree::Kind;

/// So far the end of a list is looked for. It is done once a fault, of which there are not many.
const LONGEST: usize = 20_000;

impl Parser<'_> {
    /// `ball: Sphere(..)` among the items of a list, and `"ball": Sphere(..)`; the name has this length.
    pub(super) fn named_item(&mut self, length: usize) -> bool {
        let start = self.at;
        let name = self.text[start..start + length].trim_matches('"').to_owned();
        let after = self.text[start + length..].trim_start();
        let value = after.strip_prefix([':', '=']).unwrap_or(after).trim_start();
        let kind = value.bytes().take_while(|byte| byte.is_ascii_alphanumeric()).count();
        let of_kind = value.starts_with(|c: char| c.is_ascii_uppercase()) && value[kind..].starts_with('(');
        // What belongs to an outer bracket, for the list was never closed, is no item.
        if !of_kind || name.contains('"') || !is_closed_ahead(self.rest(), b'[', LONGEST) {
            return false;
        }
        let at = self.text.len() - value.len();
        let opened = at + kind + 1;
        let empty = self.text[opened..].trim_start().starts_with(')');
        let comma = if empty { "" } else { ", " };
        let found = self.span(start, start + length);
        let mut fault = Diagnostic::error(codes::MIXED_FIELDS, found, "the items of a list have no names before them")
            .expected("[a, b, c]")
            .hint(format!("write the name inside: {}(name: \"{name}\"{}..)", &value[..kind], ", "));
        let replacement = format!("{}(name: \"{name}\"{comma}", &value[..kind]);
        fault.edit = Some(Edit { span: self.span(start, opened), replacement });
        self.sink.push(fault);
        self.at = at;
        self.value();
        true
    }

    /// `Sphere(..), Sphere(..), ],` among the fields of the scene: its list was never opened.
    pub(super) fn items_without_list(&mut self) -> bool {
        let kind_ahead = |parser: &Self| {
            parser.peek().is_some_and(|byte| byte.is_ascii_uppercase())
                && parser.rest()[parser.word_length()..].starts_with('(')
        };
        if self.open.len() != 1 || !kind_ahead(self) || !is_closed_ahead(self.rest(), b'[', LONGEST) {
            return false;
        }
        let start = self.at;
        let end = start + self.word_length();
        let indent = " ".repeat(if self.indent == usize::MAX { 0 } else { self.indent });
        let gap = if self.line + self.indent.min(start) == start { format!("\n{indent}") } else { String::new() };
        let mut fault =
            Diagnostic::error(codes::MISSING_NAME, self.span(start, end), "`objects: [` is missing before this")
                .expected("objects: [a, b, c]")
                .hint("write `objects: [` before the first object");
        fault.edit = Some(Edit { span: self.span(start, start), replacement: format!("objects: [{gap}") });
        self.sink.push(fault);
        let mark = self.builder.nodes.len();
        while !matches!(self.peek(), None | Some(b']')) {
            let before = self.at;
            self.value();
            self.trivia();
            if self.peek() == Some(b',') {
                self.at += 1;
            }
            self.trivia();
            if self.at == before {
                break;
            }
        }
        self.at += usize::from(self.peek() == Some(b']'));
        self.builder.nodes.truncate(mark);
        self.builder.leaf(Kind::Broken, start, self.at);
        true
    }

    /// `radius: 1, material: ..),` among the items of a list: the fields of a kind that is not there.
    pub(super) fn fields_without_kind(&mut self) -> bool {
        let start = self.at;
        // Further in they go on with an item that has been closed too early.
        const ITEM: usize = 4;
        if self.open.last().is_none_or(|open| self.indent > open.indent.saturating_add(ITEM)) {
            return false;
        }
        let line = super::line_ahead(self.text, start);
        let mut depth = 1usize;
        let end = line.bytes().position(|byte| {
            match byte {
                b'(' | b'[' | b'{' => depth += 1,
                b')' | b']' | b'}' => depth -= 1,
                _ => {}
            }
            depth == 0
        });
        // They end with a bracket on their line, and the list goes on behind them.
        let end = end.filter(|&end| line.as_bytes()[end] == b')').map(|end| start + end + 1);
        let Some(end) = end.filter(|&end| is_closed_ahead(&self.text[end..], b'[', LONGEST)) else { return false };
        let found = self.span(start, start + self.word_length());
        let fault = Diagnostic::error(codes::MIXED_FIELDS, found, "these fields have no kind")
            .expected("Kind(name: value, ..), as Sphere(radius: 1, ..)")
            .hint("write the kind and `(` before them");
        self.sink.push(fault);
        self.at = end;
        self.builder.leaf(Kind::Broken, start, end);
        true
    }

    /// `[image]` and lines of `width = 320` below it.
    pub(super) fn table_of_toml(&mut self) -> bool {
        let start = self.at;
        let line = super::line_ahead(self.text, start).trim_end();
        let name = line.trim_start_matches('[').trim_end_matches(']');
        let is_header = line.starts_with('[') && line.ends_with(']') && !name.is_empty();
        if !is_header || !name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_.".contains(&byte)) {
            return false;
        }
        let mut end = start + line.len();
        for next in self.text[end..].split_inclusive('\n') {
            let words = next.trim();
            let of_table = words.split_once('=').is_some_and(|(key, _)| {
                let key = key.trim();
                !key.is_empty() && key.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
            });
            if !words.is_empty() && !of_table {
                break;
            }
            end += next.len();
        }
        let end = start + self.text[start..end].trim_end().len();
        let mut kind = name.split('.').next().unwrap_or(name).to_owned();
        kind[..1].make_ascii_uppercase();
        let found = self.span(start, start + line.len());
        let way = format!("write {}: {kind}(name: value, ..)", kind.to_ascii_lowercase());
        let fault = Diagnostic::error(codes::OTHER_LANGUAGE, found, "this is TOML, and the scene is RON").hint(way);
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, start, end);
        self.at = end;
        self.separated = true;
        if let Some(newline) = self.text[start..end].rfind('\n') {
            self.line = start + newline + 1;
        }
        self.trivia();
        if self.peek() == Some(b',') {
            self.at += 1;
        }
        true
    }
}
