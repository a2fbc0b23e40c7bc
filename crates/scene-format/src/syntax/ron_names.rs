//! Names and their values in RON: fields, entries of `{ .. }`, and names that are missing, mistaken or out of place.

use super::ron::Parser;
use super::{Syntax, bare_numbers, brackets, constructs};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::tree::Kind;

impl Parser<'_> {
    /// `name: value`, with `=` for `:` reported.
    pub(super) fn field(&mut self, length: usize) {
        let (start, key) = (self.at, self.builder.nodes.len());
        self.builder.leaf(Kind::Key, start, start + length);
        self.at += length;
        self.trivia();
        self.joined(start + length);
        self.trivia();
        self.value_of_name();
        self.last_field = key;
    }

    /// The value behind a name; of a vector without its brackets all of it, which is reported.
    fn value_of_name(&mut self) {
        let mark = self.builder.nodes.len();
        self.value();
        if let Some((end, fault)) = bare_numbers::report(self.text, Syntax::Ron, mark, self.at, self.builder) {
            self.at = end;
            self.sink.push(fault);
        }
    }

    /// The `:` between a field, which ends at `end`, and its value.
    pub(super) fn joined(&mut self, end: usize) {
        let found = self.span(self.at, self.at + 1);
        let mut fault = match self.peek() {
            Some(b':') => {
                self.at += 1;
                if self.peek() != Some(b':') {
                    return;
                }
                let found = self.span(self.at, self.at + 1);
                let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, "there is one `:` too many")
                    .hint("remove it");
                fault.edit = Some(Edit { span: found, replacement: String::new() });
                self.at += 1;
                return self.sink.push(fault);
            }
            Some(b'=') => {
                self.at += 1;
                let mut fault =
                    Diagnostic::error(codes::MISSING_COLON, found, "a field and its value are joined by `:`, not `=`");
                fault.edit = Some(Edit { span: found, replacement: ":".to_owned() });
                fault
            }
            _ => {
                let found = self.span(end, end);
                let mut fault = Diagnostic::error(codes::MISSING_COLON, found, "a `:` is missing after this name");
                fault.edit = Some(Edit { span: found, replacement: ":".to_owned() });
                fault
            }
        };
        fault = fault.expected("name: value").hint("write `:`");
        self.sink.push(fault);
    }

    /// A loop, or a block of POV-Ray, which is reported and passed over with the comma after it.
    pub(super) fn construct_elsewhere(&mut self) -> bool {
        if !self.peek().is_some_and(|byte| byte.is_ascii_lowercase()) {
            return false;
        }
        let Some(found) = constructs::at_beginning(self.rest(), Syntax::Ron) else { return false };
        self.pass_over(found);
        self.trivia();
        if self.peek() == Some(b',') {
            self.at += 1;
        }
        self.separated = true;
        true
    }

    /// `for i in range(8)` after a value, whose nodes begin at `mark` and which begins at `begin`: reported, and
    /// nothing is said of the value.
    #[inline]
    pub(super) fn comprehension(&mut self, mark: usize, begin: usize) {
        if !matches!(self.peek(), Some(b' ' | b'\n' | b'\r')) || !self.rest().trim_start().starts_with("for ") {
            return;
        }
        let at = self.at + (self.rest().len() - self.rest().trim_start().len());
        let Some(found) = constructs::loop_of(&self.text[at..], Syntax::Ron) else { return };
        self.trivia();
        self.builder.nodes.truncate(mark);
        self.builder.leaf(Kind::Broken, begin, at);
        self.pass_over(found);
    }

    pub(super) fn pass_over(&mut self, found: constructs::Construct) {
        let (start, end) = (self.at, self.at + found.length);
        let fault = found.fault(start, |from, to| self.span(from, to));
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, start, end);
        if let Some(newline) = self.text[start..end].rfind('\n') {
            self.line = start + newline + 1;
        }
        self.at = end;
    }

    pub(super) fn value_without_name(&mut self) {
        if self.list_without_brackets() || self.items_without_list() || self.table_of_toml() {
            return;
        }
        let start = self.at;
        let errors = self.sink.errors;
        let mark = self.builder.nodes.len();
        self.value();
        let end = self.at;
        self.builder.nodes.truncate(mark);
        self.builder.leaf(Kind::Broken, start, end);
        if self.sink.errors == errors {
            let line = self.text[start..end].lines().next().unwrap_or("").trim_end().len();
            let found = self.span(start, start + line.max(1));
            self.sink.push(
                Diagnostic::error(codes::MISSING_NAME, found, "this value has no field name")
                    .expected("name: value, as in the fields before it")
                    .hint("write the name of the field and `:` before the value"),
            );
        }
    }

    /// `transform: Translate(..), RotateY(20)` and `colors: "#f00", "#0f0"`: the rest of the list, if the field before
    /// is one.
    fn list_without_brackets(&mut self) -> bool {
        const OF_KINDS: [&str; 5] = ["transform", "placements", "objects", "lights", "of"];
        const OF_TEXTS: [&str; 3] = ["colors", "include", "masks"];
        let nodes = &self.builder.nodes;
        let value = self.last_field.saturating_add(1);
        let (Some(key), Some(first)) = (nodes.get(self.last_field), nodes.get(value)) else { return false };
        if value + first.size as usize != nodes.len() {
            return false;
        }
        let field = self.text[key.start as usize..key.end as usize].to_owned();
        let start = first.start as usize;
        let of_kinds = self.text[start..].starts_with(|c: char| c.is_ascii_uppercase());
        let named = if of_kinds { OF_KINDS.contains(&&*field) } else { OF_TEXTS.contains(&&*field) };
        let ahead = |parser: &Self| match parser.peek() {
            Some(b'"') => !of_kinds,
            Some(byte) => {
                of_kinds && byte.is_ascii_uppercase() && parser.rest()[parser.word_length()..].starts_with('(')
            }
            None => false,
        };
        if key.kind != Kind::Key || !named || !ahead(self) {
            return false;
        }
        let mut last = self.at;
        while ahead(self) {
            self.value();
            last = self.at;
            self.trivia();
            if self.peek() == Some(b',') {
                self.at += 1;
                self.trivia();
            }
        }
        self.builder.nodes.truncate(value);
        if self.peek() == Some(b']') {
            // Only the first bracket is missing.
            self.at += 1;
            self.builder.leaf(Kind::Broken, start, self.at);
            let found = self.span(start, self.at);
            let mut fault = Diagnostic::error(codes::STRAY_BRACKET, found, "this list has no `[` before it")
                .expected("a list: [a, b, c]")
                .hint("write `[` before the first value");
            fault.edit = Some(Edit { span: self.span(start, start), replacement: "[".to_owned() });
            self.sink.push(fault);
            return true;
        }
        self.separated = true;
        self.builder.leaf(Kind::Broken, start, last);
        let list = format!("[{}]", &self.text[start..last]);
        let found = self.span(start, last);
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, found, format!("the values of `{field}` stand in a list"))
            .expected("a list: [a, b, c]")
            .hint(if list.contains('\n') { "write [ and ] around them".to_owned() } else { format!("write {list}") });
        fault.edit = Some(Edit { span: found, replacement: list });
        self.sink.push(fault);
        true
    }

    /// A field whose name has this length stands after values without names: it is told, and passed over.
    pub(super) fn named_after_unnamed(&mut self, length: usize) {
        let found = self.span(self.at, self.at + length);
        let opened = self.open.last().map_or(self.at, |open| open.at + 1);
        let first = self.text[opened..].trim_start();
        let first = self.text.len() - first.len();
        let message = "named and unnamed values stand in one pair of brackets";
        let mut fault = Diagnostic::error(codes::MIXED_FIELDS, found, message)
            .hint("write the name of each value, `name: value`")
            .label(self.span(first, first + 1), "this has no name");
        // The kinds whose first value may stand alone.
        let name = self.text[..opened - 1].trim_end();
        let bare = [("Scale", "factor"), ("DropTo", "y"), ("CenterTo", "point")];
        let bare = bare.into_iter().find(|(kind, _)| name.ends_with(kind));
        if let Some((_, field)) = bare {
            let replacement = format!("{field}: ");
            fault.hint = format!("write `{replacement}` before the first value");
            fault.edit = Some(Edit { span: self.span(first, first), replacement });
        }
        // Whose values without names can only be objects.
        let kind = name.rsplit(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default();
        let values = self.text[first..self.at].trim_end().trim_end_matches(',').trim_end();
        let is_plain = !values.contains("//") && !values.contains("/*");
        if matches!(kind, "Union" | "Intersection" | "Difference" | "Group") && values.ends_with(')') && is_plain {
            let replacement = format!("objects: [{values}]");
            // What is longer is not shown in part.
            fault.hint = match replacement.len() < 120 && !replacement.contains('\n') {
                true => format!("write `{replacement}`"),
                false => "write `objects: [` before the values without names, and `]` behind them".to_owned(),
            };
            fault.edit = Some(Edit { span: self.span(first, first + values.len()), replacement });
        }
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, self.at, self.at);
        self.skip_broken();
    }

    pub(super) fn named_in_list(&mut self) {
        let start = self.at;
        if let Some(end) = brackets::fields_behind(self.text, start) {
            self.sink.push(brackets::closed_before_fields(self.text, self.builder.source, start, end));
            self.builder.leaf(Kind::Broken, start, end);
            self.at = end;
            return;
        }
        let length = self.word_length();
        let found = self.span(start, start + length);
        self.sink.push(
            Diagnostic::error(codes::MIXED_FIELDS, found, "the items of a list have no names")
                .expected("[a, b, c]")
                .hint("fields stand in round brackets: (name: value)"),
        );
        self.builder.leaf(Kind::Broken, start, start + length);
        self.skip_broken();
    }

    /// `"name: value` with another quote in its line, by which the text would end in the middle of the value; reported.
    fn name_without_last_quote(&mut self) -> bool {
        let start = self.at;
        let Some(inner) = super::line_ahead(self.text, start).strip_prefix('"') else { return false };
        let length = inner.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(inner.len());
        let Some(close) = inner.find('"') else { return false };
        let joined = |rest: &str| rest.trim_start().starts_with(':');
        if length == 0 || length > close || !inner[length..].starts_with(':') || joined(&inner[close + 1..]) {
            return false;
        }
        self.at += 1 + length;
        let found = self.span(start, self.at);
        let mut fault = Diagnostic::error(codes::UNCLOSED_TEXT, found, "this name has no last quote")
            .expected("{ \"name\": value }")
            .hint(format!("write {}\"", &self.text[start..self.at]));
        fault.edit = Some(Edit { span: self.span(self.at, self.at), replacement: "\"".to_owned() });
        self.sink.push(fault);
        self.builder.leaf(Kind::Key, start + 1, self.at);
        true
    }

    /// What stands between single quotes here, before the sign that joins it to a value.
    fn single_quoted(&self) -> Option<&str> {
        let line = super::line_ahead(self.text, self.at);
        let (inner, rest) = line.strip_prefix('\'')?.split_once('\'')?;
        (rest.trim_start().starts_with([':', '=']) && !inner.contains(['"', '\\'])).then_some(inner)
    }

    /// `"key": value` in `{ .. }`.
    // Long: one arm for each way that names are written.
    pub(super) fn map_entry(&mut self) {
        let start = self.at;
        let length = self.word_length();
        if self.name_without_last_quote() {
            // Its value follows.
        } else if self.peek() == Some(b'"') || self.is_raw_text() {
            let mark = self.builder.nodes.len();
            if self.peek() == Some(b'"') {
                self.text_literal()
            } else {
                self.raw_text_literal()
            }
            if let Some(node) = self.builder.nodes.get_mut(mark)
                && node.kind == Kind::Text
            {
                node.kind = Kind::Key;
            }
        } else if let Some(inner) = self.single_quoted().map(str::to_owned) {
            self.at += inner.len() + 2;
            self.key_not_quoted(start, &inner, "names in { } stand between double quotes");
        } else if length > 0 && self.text[start + length..].trim_start().starts_with('(') {
            return self.kind_without_name(start);
        } else if length > 0 {
            // A name may have spaces; it ends before the colon.
            let line = super::line_ahead(self.text, start);
            let named = line.split_once(':').map_or("", |(name, _)| name.trim_end());
            let plain = named.chars().all(|c| c.is_alphanumeric() || matches!(c, ' ' | '_' | '-' | '.'));
            let length = if plain { length.max(named.len()) } else { length };
            let word = &self.text[start..start + length];
            self.at += length;
            self.key_not_quoted(start, word, "names in { } stand between quotes");
        } else {
            let mark = self.builder.nodes.len();
            let errors = self.sink.errors;
            self.value();
            self.builder.nodes.truncate(mark);
            self.builder.leaf(Kind::Broken, start, self.at);
            if self.sink.errors == errors {
                let found = self.span(start, self.at);
                self.sink.push(
                    Diagnostic::error(codes::KEY_NOT_QUOTED, found, "a name in { } is a text between quotes")
                        .expected("{ \"name\": value }"),
                );
            }
            self.skip_broken();
            return;
        }
        self.trivia();
        match self.peek() {
            Some(b':') => self.at += 1,
            other => {
                let equals = other == Some(b'=');
                // `"white" Diffuse(..)`: all is there but the sign.
                if other.is_some_and(|byte| byte.is_ascii_uppercase() || matches!(byte, b'(' | b'"')) {
                    let end = start + self.text[start..self.at].trim_end().len();
                    let found = self.span(end, end);
                    let mut fault = Diagnostic::error(codes::MISSING_COLON, found, "a `:` is missing after this name")
                        .expected("{ \"name\": value }")
                        .hint("write `:`");
                    fault.edit = Some(Edit { span: found, replacement: ":".to_owned() });
                    self.sink.push(fault);
                    return self.value();
                }
                let found = if equals { self.span(self.at, self.at + 1) } else { self.span(start, self.at) };
                let mut fault =
                    Diagnostic::error(codes::MISSING_COLON, found, "a name and its value are joined by `:`")
                        .expected("{ \"name\": value }")
                        .hint("write `:` and the value");
                if equals {
                    fault.edit = Some(Edit { span: found, replacement: ":".to_owned() });
                    self.at += 1;
                }
                self.sink.push(fault);
                if !equals {
                    self.builder.leaf(Kind::Broken, self.at, self.at);
                    self.skip_broken();
                    return;
                }
            }
        }
        self.trivia();
        self.value_of_name();
    }

    /// `{ Mirror() }`: an entry without its name, which is reported.
    fn kind_without_name(&mut self, start: usize) {
        let (mark, errors) = (self.builder.nodes.len(), self.sink.errors);
        self.value();
        self.builder.nodes.truncate(mark);
        self.builder.leaf(Kind::Broken, start, self.at);
        if self.sink.errors == errors {
            let line = self.text[start..self.at].lines().next().unwrap_or("").trim_end();
            let found = self.span(start, start + line.len().max(1));
            self.sink.push(
                Diagnostic::error(codes::KEY_NOT_QUOTED, found, "this entry has no name")
                    .expected("{ \"name\": value }")
                    .hint("write its name between quotes, and `:`, before it"),
            );
        }
    }

    /// Takes what stands from here to the reader's place for a name without its quotes, and says so.
    fn key_not_quoted(&mut self, start: usize, name: &str, message: &str) {
        let found = self.span(start, self.at);
        let mut fault = Diagnostic::error(codes::KEY_NOT_QUOTED, found, message)
            .expected("{ \"name\": value }")
            .hint(format!("write \"{name}\""));
        fault.edit = Some(Edit { span: found, replacement: format!("\"{name}\"") });
        self.sink.push(fault);
        self.builder.leaf(Kind::Key, start, self.at);
    }

    /// A text, or the name of a kind between quotes: `"Sphere"(..)`.
    pub(super) fn text_or_kind(&mut self, start: usize) {
        let mark = self.builder.nodes.len();
        self.text_literal();
        let name = self.text[start + 1..self.at].trim_end_matches('"');
        let kind = self.peek() == Some(b'(') && name.bytes().all(|byte| byte.is_ascii_alphanumeric());
        if !kind || name.is_empty() || self.builder.nodes.get(mark).is_none_or(|node| node.kind != Kind::Text) {
            return;
        }
        let found = self.span(start, self.at);
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, found, "a kind is written without quotes")
            .expected(format!("{name}(..)"))
            .hint(format!("write {name}"));
        fault.edit = Some(Edit { span: found, replacement: name.to_owned() });
        self.sink.push(fault);
        self.builder.nodes.truncate(mark);
        self.bracket(start + 1, b'(');
    }
}
