//! TOML into the tree, with recovery: a fault is told in the scene's words, and does not swallow the lines after it.

use super::bare_numbers;
use super::brackets::{self, Open};
use super::toml_brackets::too_deep;
use super::toml_lexer::Lexer;
use super::toml_tables::{Inline, Key, Tables, key_span};
use super::{MAX_DEPTH, Sink, Syntax, span};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::tape::Tape;
use crate::tree::{Builder, Kind};
use std::collections::HashMap;
use toml_parser::lexer::TokenKind;

/// Reads one text into `builder`; returns the comments,
/// and the first `Added` node of each table that has some.
pub(crate) fn parse(text: &str, builder: &mut Builder, sink: &mut Sink) -> (Tape<Span>, HashMap<u32, u32>) {
    let mut lexer = Lexer::new(text, 0);
    let (kind, span) = lexer.next();
    let tables = Tables::new(text, builder);
    let mut parser = Parser {
        text,
        lexer,
        kind,
        span,
        previous_end: 0,
        values: builder,
        tables,
        sink,
        comments: Tape::default(),
        open: Vec::new(),
        inline: None,
        unwinding: false,
        spare_path: Vec::new(),
        colon: None,
        line: 0,
    };
    parser.document();
    let Parser { tables, comments, values, .. } = parser;
    (comments, tables.finish(values))
}

pub(super) struct Parser<'p> {
    pub text: &'p str,
    pub lexer: Lexer<'p>,
    pub kind: TokenKind,
    pub span: toml_parser::Span,
    /// End of the last token that was neither space nor comment.
    pub previous_end: usize,
    pub values: &'p mut Builder,
    pub tables: Tables<'p>,
    pub sink: &'p mut Sink,
    pub comments: Tape<Span>,
    pub open: Vec<Open>,
    /// The innermost bracket is an inline table whose keys have dots.
    pub inline: Option<Inline>,
    /// A bracket was found to be open where a new statement begins: all brackets end here.
    pub unwinding: bool,
    /// Where the current line begins.
    pub line: usize,
    /// A path that is not in use: one allocation serves all of them.
    pub spare_path: Vec<Key>,
    /// A colon at the end of the last key: `name: value`, as RON writes it.
    pub colon: Option<usize>,
}

impl Parser<'_> {
    fn document(&mut self) {
        loop {
            self.trivia();
            match self.kind {
                TokenKind::Eof => return,
                _ if self.sink.is_full() => return,
                _ if self.lexeme().starts_with("//") || self.lexeme().starts_with("/*") => self.foreign_comment(),
                TokenKind::LeftSquareBracket => self.header(),
                TokenKind::Equals => {
                    let found = self.found();
                    self.sink.push(
                        Diagnostic::error(codes::MISSING_NAME, found, "there is no name before `=`")
                            .expected("name = value"),
                    );
                    self.tables.add_broken(self.values);
                    self.skip_line();
                }
                _ if self.at_key() => self.statement(),
                _ => {
                    self.unexpected("a line begins with a name or with a [header]");
                    self.tables.add_broken(self.values);
                    self.skip_line();
                }
            }
        }
    }

    /// `[path]` or `[[path]]`.
    pub(super) fn header(&mut self) {
        let start = self.span.start();
        self.bump();
        let many = self.kind == TokenKind::LeftSquareBracket && self.span.start() == start + 1;
        if many {
            self.bump();
        }
        let path = self.key_path();
        let mut closed = self.kind == TokenKind::RightSquareBracket;
        if closed {
            self.bump();
            if many {
                closed = self.kind == TokenKind::RightSquareBracket;
                if closed {
                    self.bump();
                }
            }
        }
        let end = self.previous_end;
        if !closed {
            let close = if many { "]]" } else { "]" };
            let found = self.range(start, end);
            let mut fault = Diagnostic::error(codes::UNCLOSED_BRACKET, found, "this header is never closed")
                .expected(format!("`{close}` after the name"));
            if matches!(self.kind, TokenKind::Newline | TokenKind::Comment | TokenKind::Eof | TokenKind::Whitespace) {
                let from = self.range(end - usize::from(self.text[..end].ends_with(']')), end);
                fault.edit = Some(Edit { span: from, replacement: close.to_owned() });
            }
            self.sink.push(fault);
        } else if path.is_empty() {
            let found = self.range(start, end);
            self.sink
                .push(Diagnostic::error(codes::MISSING_NAME, found, "this header has no name").expected("[camera]"));
        }
        self.tables.header(&path, many, &(start..end), self.values, self.sink);
        self.spare_path = path;
        if closed { self.end_of_line("the header") } else { self.skip_line() }
    }

    /// `path = value`.
    pub(super) fn statement(&mut self) {
        if self.construct_elsewhere() {
            return self.tables.add_broken(self.values);
        }
        let path = self.key_path();
        if path.is_empty() {
            self.tables.add_broken(self.values);
            return self.skip_line();
        }
        if !self.equals(&path) {
            self.tables.add_broken(self.values);
            return self.skip_line();
        }
        self.tables.begin_value(&path, self.values, self.sink);
        self.spare_path = path;
        self.one_value();
        if self.unwinding {
            self.unwinding = false;
            self.open.clear();
        } else {
            self.end_of_line("the value");
        }
    }

    /// `=` after a key; `false` when there is nothing like it.
    pub(super) fn equals(&mut self, path: &[Key]) -> bool {
        self.space();
        if self.kind == TokenKind::Equals {
            self.bump();
            self.space();
            while self.kind == TokenKind::Equals {
                let found = self.found();
                let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, "there is one `=` too many")
                    .expected("name = value");
                fault.edit = Some(Edit { span: found, replacement: String::new() });
                self.sink.push(fault);
                self.bump();
                self.space();
            }
            return true;
        }
        let colon = self.colon.take().or_else(|| self.lexeme().starts_with(':').then(|| self.span.start()));
        if let Some(at) = colon {
            let found = self.range(at, at + 1);
            let mut fault = Diagnostic::error(
                codes::MISSING_COLON,
                found,
                "in TOML a name and its value are joined by `=`, not `:`",
            )
            .expected("name = value");
            fault.edit = Some(Edit { span: found, replacement: " =".to_owned() });
            self.sink.push(fault);
            if self.lexeme() == ":" {
                self.bump();
            }
            self.space();
            // `a: 1` names a value all the same.
            return !matches!(self.kind, TokenKind::Newline | TokenKind::Eof);
        }
        let Some(last) = path.last() else { return false };
        let value = match self.kind {
            TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket | TokenKind::BasicString => true,
            TokenKind::Atom => self.lexeme().starts_with(|c: char| c.is_ascii_digit() || c == '-'),
            _ => false,
        };
        if value {
            let found = self.range(last.end, last.end);
            let mut fault = Diagnostic::error(codes::MISSING_COLON, found, "a `=` is missing after this name")
                .expected("name = value")
                .hint("write `=`");
            fault.edit = Some(Edit { span: found, replacement: " =".to_owned() });
            self.sink.push(fault);
            return true;
        }
        if let Some(end) = self.words_before_equals(last.end) {
            let found = self.range(last.start, end);
            let name = &self.text[last.start..end];
            let mut fault = Diagnostic::error(codes::KEY_NOT_QUOTED, found, "a name of several words needs quotes")
                .expected("letters, digits, `_` and `-`; other names between quotes")
                .hint(format!("write \"{name}\""));
            fault.edit = Some(Edit { span: found, replacement: format!("\"{name}\"") });
            self.sink.push(fault);
            return false;
        }
        let found = key_span(self.values.source, last);
        self.sink.push(
            Diagnostic::error(codes::MISSING_COLON, found, "there is no `=` and no value after this name")
                .expected("name = value"),
        );
        false
    }

    /// `clear glass = ..`, after the first word of the name, which ends at `end`: where the last one ends.
    fn words_before_equals(&self, end: usize) -> Option<usize> {
        let line = super::line_ahead(self.text, end);
        let words = line.split_once('=')?.0.trim_end();
        let plain = words.chars().all(|c| c.is_alphanumeric() || matches!(c, ' ' | '_' | '-'));
        (plain && words.starts_with(' ') && !words.trim().is_empty()).then(|| end + words.len())
    }

    /// Keys joined by points.
    pub(super) fn key_path(&mut self) -> Vec<Key> {
        let mut path = std::mem::take(&mut self.spare_path);
        path.clear();
        loop {
            self.space();
            if !self.at_key() {
                let found = self.found();
                if !path.is_empty() {
                    self.sink.push(
                        Diagnostic::error(codes::MISSING_NAME, found, "a name is missing after the point")
                            .expected("name.name = value"),
                    );
                }
                return Vec::new();
            }
            if let Some((name, end)) = self.in_other_quotes() {
                path.push(name);
                self.colon = None;
                self.resume(end);
                self.space();
                if self.kind != TokenKind::Dot {
                    return path;
                }
                self.bump();
                continue;
            }
            let colon = self.kind == TokenKind::Atom && self.lexeme().ends_with(':');
            path.push(self.span.start()..self.span.end() - usize::from(colon));
            self.colon = colon.then(|| self.span.end() - 1);
            self.check_key();
            self.bump();
            self.space();
            if self.kind != TokenKind::Dot {
                return path;
            }
            if path.len() >= MAX_DEPTH {
                let found = self.found();
                self.sink.push(too_deep(found));
                return Vec::new();
            }
            self.bump();
        }
    }

    pub(super) fn check_key(&mut self) {
        let lexeme = self.lexeme();
        if self.kind != TokenKind::Atom {
            let closed = lexeme.len() >= 2 && lexeme.as_bytes().first() == lexeme.as_bytes().last();
            if closed {
                self.escapes(self.span.start(), self.span.end(), 1);
            } else {
                self.unclosed_text();
            }
            return;
        }
        let name = lexeme.strip_suffix(':').unwrap_or(lexeme);
        if !name.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-')) {
            let found = self.found();
            let mut fault = Diagnostic::error(codes::KEY_NOT_QUOTED, found, "this name needs quotes")
                .expected("letters, digits, `_` and `-`; other names between quotes");
            if !name.contains(['"', '\'', '\\', '(', ')']) {
                fault.edit = Some(Edit { span: found, replacement: format!("\"{name}\"") });
            }
            self.sink.push(fault);
        }
    }

    pub(super) fn at_key(&self) -> bool {
        matches!(
            self.kind,
            TokenKind::Atom
                | TokenKind::BasicString
                | TokenKind::LiteralString
                | TokenKind::MlBasicString
                | TokenKind::MlLiteralString
        )
    }

    /// One value after a name; numbers without the brackets of a vector are told as one fault.
    pub(super) fn one_value(&mut self) {
        let mark = self.values.nodes.len();
        self.value();
        let text = self.text;
        if let Some((end, fault)) = bare_numbers::report(text, Syntax::Toml, mark, self.previous_end, self.values) {
            self.resume(end);
            self.sink.push(fault);
        }
    }

    /// One value: always one node with its children.
    pub(super) fn value(&mut self) {
        self.space();
        let start = self.span.start();
        match self.kind {
            TokenKind::LeftSquareBracket => self.array(b'['),
            TokenKind::LeftCurlyBracket if self.is_list_in_braces() => self.array(b'{'),
            TokenKind::LeftCurlyBracket => self.inline_table(),
            TokenKind::BasicString
            | TokenKind::LiteralString
            | TokenKind::MlBasicString
            | TokenKind::MlLiteralString => self.text_value(),
            TokenKind::Atom | TokenKind::Dot => self.atom(),
            _ => {
                if self.bare_color() {
                    return;
                }
                let found = self.range(self.previous_end, self.previous_end);
                self.sink.push(
                    Diagnostic::error(codes::MISSING_VALUE, found, "a value is missing here")
                        .hint("write a value, or remove the name before it to get the default"),
                );
                self.values.leaf(Kind::Broken, start, start);
            }
        }
    }

    /// After a header or a statement nothing but a comment may stand on the line.
    pub(super) fn end_of_line(&mut self, what: &str) {
        let end = self.previous_end;
        self.space();
        match self.kind {
            TokenKind::Newline | TokenKind::Eof => {}
            TokenKind::Comment => self.trivia(),
            TokenKind::Atom if self.is_unit(end) => {
                self.unit(end);
                self.end_of_line(what);
            }
            _ => {
                let start = self.span.start();
                let sign = match self.lexeme() {
                    "," => Some("TOML has no commas between lines"),
                    ";" => Some("TOML has no semicolons"),
                    _ => None,
                };
                let close = matches!(self.kind, TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket);
                self.skip_line();
                let end = self.previous_end.max(start);
                if close {
                    return self.sink.push(brackets::stray(self.text, self.values.source, start));
                }
                let found = self.range(start, end);
                let mut fault = Diagnostic::error(codes::TEXT_AFTER_END, found, format!("{what} ended before this"))
                    .expected("the end of the line, or a # comment");
                let rest = self.text.get(start..end).unwrap_or("");
                if what == "the header" && rest.contains('=') {
                    fault.hint = "put it on the next line".to_owned();
                    let found = self.range(start, start);
                    fault.edit = Some(Edit { span: found, replacement: "\n".to_owned() });
                }
                if let Some(sign) = ["//", "--"].into_iter().find(|sign| rest.starts_with(sign)) {
                    fault.hint = "comments begin with #".to_owned();
                    let found = self.range(start, start + sign.len());
                    fault.edit = Some(Edit { span: found, replacement: "#".to_owned() });
                }
                if let Some(hint) = sign.filter(|_| end == start + 1) {
                    fault.hint = hint.to_owned();
                    fault.edit = Some(Edit { span: found, replacement: String::new() });
                }
                self.sink.push(fault);
            }
        }
    }

    pub(super) fn skip_line(&mut self) {
        while !matches!(self.kind, TokenKind::Newline | TokenKind::Eof) {
            if self.kind == TokenKind::Comment {
                return self.trivia();
            }
            self.bump();
        }
    }

    pub(super) fn unexpected(&mut self, hint: &str) {
        let found = self.found();
        let lexeme: String = self.lexeme().chars().take(20).collect();
        self.sink.push(
            Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, format!("`{lexeme}` cannot stand here")).hint(hint),
        );
    }

    /// `// ..`, as comments are written elsewhere.
    pub(super) fn foreign_comment(&mut self) {
        let found = self.range(self.span.start(), self.span.start() + 2);
        let message = format!("comments begin with `#` in TOML, not `{}`", &self.lexeme()[..2]);
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message).hint("write `#`");
        fault.edit = Some(Edit { span: found, replacement: "#".to_owned() });
        self.sink.push(fault);
        self.skip_line();
    }

    /// White space, newlines and comments between statements.
    pub(super) fn trivia(&mut self) {
        loop {
            match self.kind {
                TokenKind::Whitespace | TokenKind::Newline => self.next(),
                TokenKind::Comment => self.comment(),
                _ => return,
            }
        }
    }

    pub(super) fn comment(&mut self) {
        let end = self.span.start() + self.lexeme().trim_end().len();
        let found = self.range(self.span.start(), end);
        self.comments.push(found);
        self.next();
    }

    pub(super) fn space(&mut self) {
        while self.kind == TokenKind::Whitespace {
            self.next();
        }
    }

    /// The next token, the current one having been read.
    pub(super) fn bump(&mut self) {
        if !matches!(self.kind, TokenKind::Whitespace | TokenKind::Newline | TokenKind::Comment) {
            self.previous_end = self.span.end();
        }
        self.next();
    }

    pub(super) fn next(&mut self) {
        if self.kind == TokenKind::Newline {
            self.line = self.span.end();
        }
        (self.kind, self.span) = self.lexer.next();
    }

    /// Reads on at a byte, what stands before it having been read.
    pub(super) fn resume(&mut self, at: usize) {
        self.lexer = Lexer::new(self.text, at);
        self.previous_end = at;
        self.next();
    }

    pub(super) fn lexeme(&self) -> &str {
        self.text.get(self.span.start()..self.span.end()).unwrap_or("")
    }

    pub(super) fn found(&self) -> Span {
        self.range(self.span.start(), self.span.end())
    }

    pub(super) fn range(&self, start: usize, end: usize) -> Span {
        span(self.values.source, start, end)
    }
}
