//! JSON (RFC 8259) into the tree, with recovery: a fault is reported where it stands, and reading goes on at the next
//! comma or bracket.

use super::brackets::{self, Fate, Open};
use super::json_literal::QUOTES;
use super::ron::Trust;
use super::{MAX_DEPTH, Sink, Syntax, bare_numbers};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::tree::{Builder, Kind};

/// Reads one text into `builder`. JSON has no comments, so there are none to return.
pub(crate) fn parse(text: &str, builder: &mut Builder, sink: &mut Sink) {
    let mut faults = attempt(text, builder, Trust::Brackets);
    if faults.diagnostics.iter().any(|fault| fault.code.is_of_brackets()) {
        // As in RON: where brackets do not match, indentation may say better what was meant.
        let errors = faults.errors;
        drop(faults);
        faults = attempt(text, builder, Trust::Indentation);
        if faults.errors > errors {
            drop(faults);
            faults = attempt(text, builder, Trust::Brackets);
        }
    }
    faults.diagnostics.into_iter().for_each(|fault| sink.push(fault));
}

fn attempt(text: &str, builder: &mut Builder, trust: Trust) -> Sink {
    builder.nodes.truncate(0);
    let mut sink = Sink::default();
    let mut parser = Parser {
        text,
        at: 0,
        builder,
        sink: &mut sink,
        open: Vec::new(),
        at_end_reported: false,
        closed: (usize::MAX, 0),
        separated: false,
        trust,
        line: 0,
        indent: 0,
    };
    parser.document();
    sink
}

pub(super) struct Parser<'p> {
    pub text: &'p str,
    pub at: usize,
    pub builder: &'p mut Builder,
    pub sink: &'p mut Sink,
    /// Brackets that are open, outermost first.
    open: Vec<Open>,
    /// Whether an open bracket was reported at the end of the file.
    pub at_end_reported: bool,
    /// The line on which a bracket was closed last, and the one on which that was opened.
    closed: (usize, usize),
    /// The comma after the entry was read already, inside a bracket that was never closed.
    separated: bool,
    trust: Trust,
    /// Where the current line begins, and how far its first word is indented.
    pub line: usize,
    pub indent: usize,
}

/// So many bytes of a bracket are looked at to tell what it is.
const LOOK_AHEAD: usize = 300;

impl Parser<'_> {
    fn document(&mut self) {
        if self.text.starts_with('\u{feff}') {
            // Readers may pass over it (RFC 8259, section 8.1), and Windows programs write it.
            self.at = 3;
        }
        self.space();
        if self.at == self.text.len() {
            return; // An empty file: the reader says what a scene needs.
        }
        self.value();
        self.end_of_text();
    }

    fn end_of_text(&mut self) {
        self.space();
        if self.at >= self.text.len() {
            return;
        }
        let start = self.at;
        if matches!(self.peek(), Some(b')' | b']' | b'}')) {
            return self.sink.push(brackets::stray(self.text, self.builder.source, start));
        }
        let line = self.rest().trim_end().lines().next().map_or(1, |line| line.trim_end().len());
        let mut fault =
            Diagnostic::error(codes::TEXT_AFTER_END, self.span(start, start + line), "the scene ended before this")
                .expected("the end of the file, after the bracket that closes the scene")
                .hint("remove what follows, or the bracket that ended the scene too early");
        if matches!(self.rest().trim_end(), "," | ";") {
            fault.hint = "remove it".to_owned();
            fault.edit = Some(Edit { span: fault.span, replacement: String::new() });
        }
        self.sink.push(fault);
    }

    /// One value; always exactly one node (with its children), `Broken` where nothing could be read.
    pub(super) fn value(&mut self) {
        let start = self.at;
        match self.peek() {
            None | Some(b',' | b')' | b']' | b'}') => {
                self.sink.push(
                    Diagnostic::error(codes::MISSING_VALUE, self.span(start, start), "a value is missing here")
                        .hint("write a value, or remove the name before it to get the default"),
                );
                self.builder.leaf(Kind::Broken, start, start);
            }
            Some(bracket @ (b'[' | b'{')) => self.bracket(bracket),
            Some(b'"') => self.text_literal(),
            Some(b'.' | b'/') if ["../", "./", "/"].iter().any(|head| self.rest().starts_with(head)) => {
                self.text_without_quotes(start);
            }
            Some(b'0'..=b'9' | b'+' | b'-' | b'.') => self.number_literal(),
            Some(b'(') => self.round_brackets(start),
            _ => self.word_or_fault(),
        }
    }

    /// The bracket that was meant where `written` stands: lists are in square ones, names with their values in braces.
    fn meant(&self, written: u8) -> u8 {
        // What is in it may begin some lines below.
        let mut end = self.text.len().min(self.at + LOOK_AHEAD);
        while !self.text.is_char_boundary(end) {
            end -= 1;
        }
        let inner = self.text[self.at + 1..end].trim_start();
        let numbers = || {
            let mut all = inner.split('}').next().unwrap_or("").split(',').map(|item| item.trim().parse::<f64>());
            all.clone().count() > 1 && all.all(|number| number.is_ok())
        };
        match written {
            b'{' if inner.starts_with(['{', '[']) || numbers() => b'[',
            b'[' if inner.starts_with('"') => {
                let close = inner[1..].find('"').map_or(inner.len(), |close| close + 2);
                if inner[close..].trim_start().starts_with(':') { b'{' } else { written }
            }
            _ => written,
        }
    }

    /// `[ .. ]` or `{ .. }`.
    // Long: what may stand in a bracket, one arm for each.
    fn bracket(&mut self, written: u8) {
        let (bracket, opened) = (self.meant(written), self.at);
        let node = self.builder.open(opened);
        if self.open.len() >= MAX_DEPTH {
            let found = self.span(opened, opened + 1);
            self.sink.push(
                Diagnostic::error(codes::TOO_DEEP, found, format!("brackets stand more than {MAX_DEPTH} deep"))
                    .hint("a scene needs no more than twenty"),
            );
            self.skip_brackets();
            return self.builder.close(node, Kind::Broken, self.at);
        }
        self.at += 1;
        self.open.push(Open { bracket, written, at: opened, line: self.line, indent: self.indent });
        // Where the comma stands after which nothing has come yet.
        let mut comma = None;
        loop {
            if self.sink.is_full() {
                self.at = self.text.len();
            }
            self.space();
            match self.peek() {
                Some(close @ (b')' | b']' | b'}')) => {
                    let fate = self.fate(close);
                    if let (Fate::Closes | Fate::Typo, Some(comma)) = (fate, comma) {
                        self.trailing_comma(comma, close);
                    }
                    match fate {
                        Fate::Closes => {
                            self.closed = (self.line, self.open.last().map_or(0, |open| open.line));
                            if bracket != written
                                && let Some(&open) = self.open.last()
                            {
                                let fault = brackets::wrong_kind(self.text, self.builder.source, open, "", self.at);
                                self.sink.push(fault);
                            }
                            self.at += 1;
                            break;
                        }
                        Fate::Typo => {
                            if let Some(&open) = self.open.last() {
                                self.sink.push(brackets::wrong_closer(self.builder.source, open, self.at, close));
                            }
                            self.at += 1;
                            break;
                        }
                        Fate::ClosesOuter => {
                            self.unclosed(Some(self.at));
                            break;
                        }
                        Fate::Stray => {
                            self.sink.push(brackets::stray(self.text, self.builder.source, self.at));
                            self.at += 1;
                            self.space();
                            if self.peek() == Some(b',') {
                                self.at += 1;
                            }
                        }
                    }
                }
                None => {
                    self.unclosed(None);
                    break;
                }
                Some(b',') => self.extra_comma(),
                Some(_) if self.line_ends_bracket() => {
                    self.separated = true;
                    self.unclosed(Some(self.at));
                    break;
                }
                Some(_) => {
                    match bracket {
                        b'[' => self.item(),
                        _ if self.next_item_ahead() => {
                            self.separated = true;
                            self.unclosed(Some(self.at));
                            break;
                        }
                        _ => self.entry(),
                    }
                    comma = self.separator();
                }
            }
        }
        self.open.pop();
        self.builder.close(node, if bracket == b'[' { Kind::List } else { Kind::Map }, self.at);
    }

    fn fate(&self, close: u8) -> Fate {
        let fate = brackets::fate(self.text, &self.open, self.at, close);
        // A bracket in the middle of a line whose own brackets are all closed is one too many. So is one that closes
        // what was opened on an earlier line, but another one than what was closed just before it.
        let opened = self.open.last().map_or(self.line, |open| open.line);
        let other = self.closed != (self.line, opened);
        let stray = self.trust == Trust::Indentation
            && (fate == Fate::ClosesOuter || fate == Fate::Closes && other)
            && opened < self.line
            && self.at > self.line + self.indent;
        if stray { Fate::Stray } else { fate }
    }

    /// Whether a new line begins here that is indented no deeper than the one that opened the innermost bracket.
    fn line_ends_bracket(&self) -> bool {
        self.trust == Trust::Indentation
            && self.at == self.line + self.indent
            && self.open.last().is_some_and(|open| open.line < self.line && self.indent <= open.indent)
    }

    /// `{` ahead where a name should stand, in an item of a list: the brace of that item was never closed.
    fn next_item_ahead(&self) -> bool {
        self.peek() == Some(b'{') && self.open.len() >= 2 && self.open[self.open.len() - 2].bracket == b'['
    }

    /// The innermost bracket was not closed before `noticed` (`None`: before the end of the file).
    fn unclosed(&mut self, noticed: Option<usize>) {
        self.builder.leaf(Kind::Broken, self.at, self.at);
        let Some(&open) = self.open.last() else { return };
        // At the end of the file the innermost open bracket stands for all that are open.
        if noticed.is_none() && std::mem::replace(&mut self.at_end_reported, true) {
            return;
        }
        self.sink.push(brackets::unclosed(self.builder.source, open, noticed));
    }

    fn trailing_comma(&mut self, comma: usize, close: u8) {
        let found = self.span(comma, comma + 1);
        let message = format!("JSON has no comma before `{}`", char::from(close));
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message).hint("remove it");
        fault.edit = Some(Edit { span: found, replacement: String::new() });
        self.sink.push(fault);
    }

    fn extra_comma(&mut self) {
        let found = self.span(self.at, self.at + 1);
        let mut fault = Diagnostic::error(codes::MISSING_VALUE, found, "there is nothing before this comma")
            .hint("remove one of the two commas");
        fault.edit = Some(Edit { span: found, replacement: String::new() });
        self.sink.push(fault);
        self.at += 1;
    }

    /// One item of a list.
    fn item(&mut self) {
        let named = self.peek() == Some(b'"') && {
            let ahead = super::line_ahead(self.text, self.at + 1);
            ahead.find('"').is_some_and(|close| ahead[close + 1..].trim_start().starts_with(':'))
        };
        if !named {
            return self.value();
        }
        let start = self.at;
        self.text_literal();
        let found = self.span(start, self.at);
        self.sink.push(
            Diagnostic::error(codes::MIXED_FIELDS, found, "the items of a list have no names")
                .expected("[a, b, c]")
                .hint("names with their values stand in braces: { \"name\": value }"),
        );
        if let Some(node) = self.builder.nodes.get_mut(self.builder.nodes.len() - 1) {
            node.kind = Kind::Broken;
        }
        self.skip_broken();
    }

    /// `"name": value` in `{ .. }`.
    fn entry(&mut self) {
        let start = self.at;
        let mark = self.builder.nodes.len();
        match self.peek() {
            Some(b'"') if self.entry_in_quotes() => return,
            Some(b'"') if self.name_without_last_quote() => {}
            Some(b'"') => {
                self.text_literal();
                if let Some(node) = self.builder.nodes.get_mut(mark)
                    && node.kind == Kind::Text
                {
                    node.kind = Kind::Key;
                }
            }
            Some(b'\'') => self.name_in_other_quotes(),
            _ if self.rest().starts_with(QUOTES) => self.name_in_other_quotes(),
            _ => match self.bare_name() {
                Some(length) if self.rest()[length..].starts_with('"') && self.colon_after(start + length + 1) => {
                    self.at += length + 1;
                    let found = self.span(start, self.at);
                    let message = "this name has no first quote";
                    let mut fault = Diagnostic::error(codes::UNCLOSED_TEXT, found, message)
                        .expected("\"name\": value")
                        .hint(format!("write \"{}", &self.text[start..self.at]));
                    fault.edit = Some(Edit { span: self.span(start, start), replacement: "\"".to_owned() });
                    self.sink.push(fault);
                    self.builder.leaf(Kind::Key, start, start + length);
                }
                Some(length) => {
                    let word = &self.text[start..start + length];
                    let found = self.span(start, start + length);
                    let mut fault =
                        Diagnostic::error(codes::KEY_NOT_QUOTED, found, "in JSON names stand between double quotes")
                            .expected("\"name\": value")
                            .hint(format!("write \"{word}\""));
                    fault.edit = Some(Edit { span: found, replacement: format!("\"{word}\"") });
                    self.sink.push(fault);
                    self.at += length;
                    self.builder.leaf(Kind::Key, start, self.at);
                }
                None => return self.value_without_name(),
            },
        }
        let end = self.at;
        self.space();
        if !self.joined(start, end) {
            return self.builder.leaf(Kind::Broken, end, end);
        }
        self.space();
        let mark = self.builder.nodes.len();
        self.value();
        if let Some((end, fault)) = bare_numbers::report(self.text, Syntax::Json, mark, self.at, self.builder) {
            self.at = end;
            self.sink.push(fault);
        }
    }

    fn colon_after(&self, at: usize) -> bool {
        super::line_ahead(self.text, at).trim_start().starts_with(':')
    }

    /// The length of a name without quotes that begins here: what stands before a `:` or `=`, or a word before a value.
    fn bare_name(&self) -> Option<usize> {
        let line = super::line_ahead(self.text, self.at);
        let of_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '$' | ' ');
        let name = line.split(|c: char| !of_name(c)).next().unwrap_or("");
        let joined = line[name.len()..].starts_with([':', '=']);
        let name = name.trim_end();
        if joined && !name.is_empty() {
            return Some(name.len());
        }
        let length = self.word_length();
        let value = super::line_ahead(self.text, self.at + length).trim_start().starts_with(['"', '[', '{']);
        (length > 0 && value).then_some(length)
    }

    /// `"name: value` with another quote in its line, by which the text would end in the middle of the value; reported.
    fn name_without_last_quote(&mut self) -> bool {
        let start = self.at;
        let inner = super::line_ahead(self.text, start + 1);
        let length = inner.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(inner.len());
        let Some(close) = inner.find('"') else { return false };
        if length == 0 || length > close || !inner[length..].starts_with(':') || self.colon_after(start + close + 2) {
            return false;
        }
        self.at += 1 + length;
        let found = self.span(start, self.at);
        let mut fault = Diagnostic::error(codes::UNCLOSED_TEXT, found, "this name has no last quote")
            .expected("\"name\": value")
            .hint(format!("write {}\"", &self.text[start..self.at]));
        fault.edit = Some(Edit { span: self.span(self.at, self.at), replacement: "\"".to_owned() });
        self.sink.push(fault);
        self.builder.leaf(Kind::Key, start + 1, self.at);
        true
    }

    fn name_in_other_quotes(&mut self) {
        let start = self.at;
        match self.in_other_quotes() {
            Some(inner) => self.builder.leaf(Kind::Key, inner.start, inner.end),
            None => {
                self.skip_broken();
                self.builder.leaf(Kind::Broken, start, self.at);
            }
        }
    }

    /// The `:` between a name, from `start` to `end`, and its value; `false` where there is neither.
    fn joined(&mut self, start: usize, end: usize) -> bool {
        let found = self.span(self.at, self.at + 1);
        let mut fault = match self.peek() {
            Some(b':') => {
                self.at += 1;
                if self.peek() != Some(b':') {
                    return true;
                }
                let found = self.span(self.at, self.at + 1);
                let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, "there is one `:` too many");
                fault.edit = Some(Edit { span: found, replacement: String::new() });
                self.at += 1;
                self.sink.push(fault.hint("remove it"));
                return true;
            }
            Some(b'=') => {
                let arrow = usize::from(self.rest().starts_with("=>"));
                self.at += 1 + arrow;
                let found = self.span(self.at - 1 - arrow, self.at);
                let message = "in JSON a name and its value are joined by `:`, not `=`";
                let mut fault = Diagnostic::error(codes::MISSING_COLON, found, message);
                fault.edit = Some(Edit { span: found, replacement: ":".to_owned() });
                fault
            }
            None | Some(b',' | b']' | b'}' | b')') => {
                // A text that was not closed has been told.
                if self.builder.nodes.get(self.builder.nodes.len() - 1).is_some_and(|node| node.kind == Kind::Key) {
                    self.sink.push(
                        Diagnostic::error(
                            codes::MISSING_COLON,
                            self.span(start, end),
                            "there is no `:` and no value after this name",
                        )
                        .expected("\"name\": value"),
                    );
                }
                return false;
            }
            // A text that was not closed, and what it swallowed.
            Some(_) if self.builder.nodes.get(self.builder.nodes.len() - 1).is_none_or(|n| n.kind != Kind::Key) => {
                self.skip_broken();
                return false;
            }
            Some(_) => {
                let found = self.span(end, end);
                let mut fault = Diagnostic::error(codes::MISSING_COLON, found, "a `:` is missing after this name");
                fault.edit = Some(Edit { span: found, replacement: ":".to_owned() });
                fault
            }
        };
        if fault.span.start == fault.span.end && found.start as usize == self.text.len() {
            return false;
        }
        fault = fault.expected("\"name\": value").hint("write `:`");
        self.sink.push(fault);
        true
    }

    fn value_without_name(&mut self) {
        let start = self.at;
        let errors = self.sink.errors;
        let mark = self.builder.nodes.len();
        self.value();
        self.builder.nodes.truncate(mark);
        self.builder.leaf(Kind::Broken, start, self.at);
        if self.sink.errors == errors {
            let line = self.text[start..self.at].lines().next().unwrap_or("").trim_end().len();
            let found = self.span(start, start + line.max(1));
            self.sink.push(
                Diagnostic::error(codes::MISSING_NAME, found, "this value has no name")
                    .expected("\"name\": value")
                    .hint("write the name and `:` before the value"),
            );
        }
    }

    /// The comma after an entry, or the end of the bracket. Where the comma stands.
    fn separator(&mut self) -> Option<usize> {
        if std::mem::take(&mut self.separated) {
            return None;
        }
        let end = self.at;
        self.space();
        match self.peek() {
            Some(b',') => {
                self.at += 1;
                return Some(self.at - 1);
            }
            None | Some(b')' | b']' | b'}') => return None,
            Some(_) if self.is_unit(end) => {
                let length = self.word_length();
                let found = self.span(self.at, self.at + length);
                let word = &self.text[self.at..self.at + length];
                let mut fault =
                    Diagnostic::error(codes::BAD_NUMBER, found, format!("`{word}` is not part of a number"))
                        .hint(super::units::way(None, word));
                fault.edit = Some(Edit { span: self.span(end, self.at + length), replacement: String::new() });
                self.sink.push(fault);
                self.at += length;
                return self.separator();
            }
            // What follows belongs to an outer bracket.
            Some(_) if self.line_ends_bracket() => return None,
            Some(_) => {}
        }
        if let Some(sign) = self.rest().chars().next().filter(|c| c.is_control()) {
            self.control_character(sign);
            return self.separator();
        }
        let semicolon = self.peek() == Some(b';');
        let found = if semicolon { self.span(self.at, self.at + 1) } else { self.span(end, end) };
        self.at += usize::from(semicolon);
        let message = if semicolon { "values are parted by commas" } else { "a comma is missing here" };
        let mut fault = Diagnostic::error(codes::MISSING_COMMA, found, message).hint("write `,` between two values");
        fault.edit = Some(Edit { span: found, replacement: ",".to_owned() });
        self.sink.push(fault);
        if !semicolon && !self.entry_ahead() {
            self.skip_broken();
            if self.peek() == Some(b',') {
                self.at += 1;
            }
        }
        None
    }

    /// Whether what stands here can be an entry of the innermost bracket.
    fn entry_ahead(&self) -> bool {
        match self.open.last().map(|open| open.bracket) {
            Some(b'{') => self.peek() == Some(b'"') || self.bare_name().is_some(),
            _ => !matches!(self.peek(), Some(b':' | b'=' | b';')),
        }
    }
}
