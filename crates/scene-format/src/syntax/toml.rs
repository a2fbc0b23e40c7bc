//! TOML into the tree, with recovery. The words come from `toml_parser`'s lexer; the grammar is read here, so that a fault can be
//! told in the scene's words and does not swallow the lines after it.

use super::brackets::{self, Fate, Open};
use super::toml_tables::{Key, Tables, key_span, regroup};
use super::{MAX_DEPTH, Sink, line_ahead, span};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::tree::{Builder, Kind};
use toml_parser::Source;
use toml_parser::lexer::{Lexer, Token, TokenKind};

/// Reads one text into `builder`; returns the comments.
pub(crate) fn parse(text: &str, builder: &mut Builder, sink: &mut Sink) -> Vec<Span> {
    let mut lexer = Source::new(text).lex();
    let end = toml_parser::Span::new_unchecked(text.len(), text.len());
    let Some(current) = lexer.next() else { return Vec::new() };
    let mut parser = Parser {
        text,
        lexer,
        kind: current.kind(),
        span: current.span(),
        end,
        previous_end: 0,
        values: Builder::new(builder.source, text.len()),
        tables: Tables::new(text),
        sink,
        comments: Vec::new(),
        open: Vec::new(),
        unwinding: false,
        colon: None,
        line: 0,
        offset: 0,
    };
    parser.document();
    let Parser { tables, comments, values, .. } = parser;
    tables.emit(&values.nodes, builder);
    comments
}

pub(super) struct Parser<'p> {
    pub text: &'p str,
    lexer: Lexer<'p>,
    pub kind: TokenKind,
    pub span: toml_parser::Span,
    end: toml_parser::Span,
    /// End of the last token that was neither space nor comment.
    pub previous_end: usize,
    pub values: Builder,
    tables: Tables<'p>,
    pub sink: &'p mut Sink,
    comments: Vec<Span>,
    open: Vec<Open>,
    /// A bracket was found to be open where a new statement begins: all brackets end here.
    unwinding: bool,
    /// Where the current line begins.
    line: usize,
    /// Where the lexer began, which it does anew after a text that is never closed.
    offset: usize,
    /// A colon at the end of the last key: `name: value`, as RON writes it.
    colon: Option<usize>,
}

/// What stands in a bracket at the current token.
enum Next {
    /// Its end, for whatever reason.
    End,
    /// Something that was seen to.
    Again,
    /// An entry or a comma.
    Entry,
}

impl Parser<'_> {
    fn document(&mut self) {
        loop {
            self.trivia();
            match self.kind {
                TokenKind::Eof => return,
                _ if self.sink.is_full() => return,
                _ if self.lexeme().starts_with("//") || self.lexeme().starts_with("/*") => {
                    let found = self.range(self.span.start(), self.span.start() + 2);
                    let mut fault = Diagnostic::error(
                        codes::UNEXPECTED_CHARACTER,
                        found,
                        format!("comments begin with `#` in TOML, not `{}`", &self.lexeme()[..2]),
                    )
                    .hint("write `#`");
                    fault.edit = Some(Edit { span: found, replacement: "#".to_owned() });
                    self.sink.push(fault);
                    self.skip_line();
                }
                TokenKind::LeftSquareBracket => self.header(),
                TokenKind::Equals => {
                    let found = self.found();
                    self.sink.push(
                        Diagnostic::error(codes::MISSING_NAME, found, "there is no name before `=`")
                            .expected("name = value"),
                    );
                    self.tables.add_broken();
                    self.skip_line();
                }
                _ if self.at_key() => self.statement(),
                _ => {
                    self.unexpected("a line begins with a name or with a [header]");
                    self.tables.add_broken();
                    self.skip_line();
                }
            }
        }
    }

    /// `[path]` or `[[path]]`.
    fn header(&mut self) {
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
        self.tables.header(&path, many, start..end, self.values.source, self.sink);
        if closed { self.end_of_line("the header") } else { self.skip_line() }
    }

    /// `path = value`.
    fn statement(&mut self) {
        let path = self.key_path();
        if path.is_empty() {
            self.tables.add_broken();
            return self.skip_line();
        }
        if !self.equals(&path) {
            self.tables.add_broken();
            return self.skip_line();
        }
        let first = self.values.nodes.len();
        self.value();
        let value = first..self.values.nodes.len();
        self.tables.add_value(&path, value, self.values.source, self.sink);
        if self.unwinding {
            self.unwinding = false;
            self.open.clear();
        } else {
            self.end_of_line("the value");
        }
    }

    /// `=` after a key; `false` when there is nothing like it.
    fn equals(&mut self, path: &[Key]) -> bool {
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
        let found = key_span(self.values.source, last);
        self.sink.push(
            Diagnostic::error(codes::MISSING_COLON, found, "there is no `=` and no value after this name")
                .expected("name = value"),
        );
        false
    }

    /// Keys joined by points.
    fn key_path(&mut self) -> Vec<Key> {
        let mut path = Vec::new();
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

    fn check_key(&mut self) {
        let lexeme = self.lexeme();
        if self.kind != TokenKind::Atom {
            let closed = lexeme.len() >= 2 && lexeme.as_bytes().first() == lexeme.as_bytes().last();
            if !closed {
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

    fn at_key(&self) -> bool {
        matches!(
            self.kind,
            TokenKind::Atom
                | TokenKind::BasicString
                | TokenKind::LiteralString
                | TokenKind::MlBasicString
                | TokenKind::MlLiteralString
        )
    }

    /// One value: always one node with its children.
    pub(super) fn value(&mut self) {
        self.space();
        let start = self.span.start();
        match self.kind {
            TokenKind::LeftSquareBracket => self.array(),
            TokenKind::LeftCurlyBracket => self.inline_table(),
            TokenKind::BasicString
            | TokenKind::LiteralString
            | TokenKind::MlBasicString
            | TokenKind::MlLiteralString => self.text_value(),
            TokenKind::Atom | TokenKind::Dot => self.atom(),
            _ => {
                let found = self.range(self.previous_end, self.previous_end);
                self.sink.push(
                    Diagnostic::error(codes::MISSING_VALUE, found, "a value is missing here")
                        .hint("write a value, or remove the name before it to get the default"),
                );
                self.values.leaf(Kind::Broken, start, start);
            }
        }
    }

    /// Opens a bracket, or skips one that is too deep.
    fn open_bracket(&mut self, bracket: u8) -> bool {
        if self.open.len() < MAX_DEPTH {
            self.open.push(Open { bracket, at: self.span.start(), line: self.line, indent: 0 });
            self.bump();
            return true;
        }
        let (found, start) = (self.found(), self.span.start());
        self.sink.push(too_deep(found));
        let mut depth = 0usize;
        loop {
            match self.kind {
                TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket => depth += 1,
                TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket => depth -= 1,
                TokenKind::Eof => break,
                _ => {}
            }
            self.bump();
            if depth == 0 {
                break;
            }
        }
        self.values.leaf(Kind::Broken, start, self.previous_end);
        false
    }

    fn array(&mut self) {
        let start = self.span.start();
        if !self.open_bracket(b'[') {
            return;
        }
        let node = self.values.open(start);
        loop {
            if self.sink.is_full() {
                self.unwinding = true;
            }
            self.trivia_in_bracket();
            match self.bracket_ends(b']') {
                Next::End => break,
                Next::Again => continue,
                Next::Entry => {}
            }
            if self.kind == TokenKind::Comma {
                self.extra_comma();
                continue;
            }
            if self.kind == TokenKind::Equals || self.at_key() && self.assignment_ahead() {
                let found = self.found();
                self.sink.push(
                    Diagnostic::error(codes::MIXED_FIELDS, found, "the items of a list have no names")
                        .expected("[a, b, c], or { name = value } for fields"),
                );
                self.values.leaf(Kind::Broken, self.span.start(), self.span.end());
                self.skip_entry();
                continue;
            }
            self.value();
            self.separator();
        }
        self.open.pop();
        self.values.close(node, Kind::List, self.previous_end);
    }

    fn inline_table(&mut self) {
        let start = self.span.start();
        if !self.open_bracket(b'{') {
            return;
        }
        let node = self.values.open(start);
        let mut dotted = false;
        loop {
            if self.sink.is_full() {
                self.unwinding = true;
            }
            self.trivia_in_bracket();
            match self.bracket_ends(b'}') {
                Next::End => break,
                Next::Again => continue,
                Next::Entry => {}
            }
            if self.kind == TokenKind::Comma {
                self.extra_comma();
                continue;
            }
            if !self.at_key() {
                self.unexpected("a table in braces holds `name = value`");
                self.values.leaf(Kind::Broken, self.span.start(), self.span.end());
                self.bump_value();
                self.skip_entry();
                continue;
            }
            let path = self.key_path();
            if path.is_empty() || !self.equals(&path) {
                self.values.leaf(Kind::Broken, self.span.start(), self.span.start());
                self.skip_entry();
                continue;
            }
            dotted |= path.len() > 1;
            for key in &path {
                self.values.leaf(Kind::Key, key.start, key.end);
            }
            self.value();
            self.separator();
        }
        self.open.pop();
        if dotted {
            regroup(self.text, &mut self.values, node);
        }
        self.values.close(node, Kind::Map, self.previous_end);
    }

    /// What comes next in a bracket that `right` closes.
    fn bracket_ends(&mut self, right: u8) -> Next {
        if self.unwinding {
            self.values.leaf(Kind::Broken, self.span.start(), self.span.start());
            return Next::End;
        }
        let close = match self.kind {
            TokenKind::RightSquareBracket => b']',
            TokenKind::RightCurlyBracket => b'}',
            TokenKind::Eof => {
                self.unwind(None);
                return Next::End;
            }
            _ => return Next::Entry,
        };
        let fate =
            if close == right { Fate::Closes } else { brackets::fate(self.text, &self.open, self.span.start(), close) };
        match fate {
            Fate::Closes => {
                self.bump();
                Next::End
            }
            Fate::Typo => {
                if let Some(&open) = self.open.last() {
                    self.sink.push(brackets::wrong_closer(self.values.source, open, self.span.start(), close));
                }
                self.bump();
                Next::End
            }
            Fate::ClosesOuter => {
                if let Some(&open) = self.open.last() {
                    self.sink.push(brackets::unclosed(self.values.source, open, Some(self.span.start())));
                }
                self.values.leaf(Kind::Broken, self.span.start(), self.span.start());
                Next::End
            }
            Fate::Stray => {
                self.sink.push(brackets::stray(self.values.source, self.span.start()));
                self.bump();
                self.trivia_in_bracket();
                if self.kind == TokenKind::Comma {
                    self.bump();
                }
                Next::Again
            }
        }
    }

    /// The innermost bracket is open though a new statement begins (`None`: the file ends).
    fn unwind(&mut self, noticed: Option<usize>) {
        if let Some(&open) = self.open.last() {
            self.sink.push(brackets::unclosed(self.values.source, open, noticed));
        }
        self.values.leaf(Kind::Broken, self.span.start(), self.span.start());
        self.unwinding = true;
    }

    fn extra_comma(&mut self) {
        let found = self.found();
        let mut fault = Diagnostic::error(codes::MISSING_VALUE, found, "there is nothing before this comma")
            .hint("remove one of the two commas");
        fault.edit = Some(Edit { span: found, replacement: String::new() });
        self.sink.push(fault);
        self.bump();
    }

    /// The comma after an entry, or the end of the bracket.
    fn separator(&mut self) {
        let end = self.previous_end;
        self.trivia_in_bracket();
        if self.unwinding {
            return;
        }
        match self.kind {
            TokenKind::Comma => self.bump(),
            TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket | TokenKind::Eof => {}
            _ => {
                let next_line = self.text[end..self.span.start()].contains('\n');
                if next_line && self.open.last().is_some_and(|open| open.bracket == b'{') && self.assignment_ahead() {
                    return self.unwind(Some(self.span.start()));
                }
                let found = self.range(end, end);
                let mut fault = Diagnostic::error(codes::MISSING_COMMA, found, "a comma is missing here")
                    .hint("write `,` between two values");
                fault.edit = Some(Edit { span: found, replacement: ",".to_owned() });
                self.sink.push(fault);
                if self.kind == TokenKind::Equals {
                    self.skip_entry();
                }
            }
        }
    }

    /// Goes past the next comma of this bracket, or to its end.
    fn skip_entry(&mut self) {
        let mut depth = 0usize;
        loop {
            match self.kind {
                TokenKind::Comma if depth == 0 => return self.bump(),
                TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket if depth == 0 => return,
                TokenKind::Newline | TokenKind::Eof => return,
                TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket => depth += 1,
                TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket => depth -= 1,
                _ => {}
            }
            self.bump();
        }
    }

    /// Goes past a thing that is no key, so that reading always gets on.
    fn bump_value(&mut self) {
        if !matches!(self.kind, TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket) {
            self.bump();
        }
    }

    /// After a header or a statement nothing but a comment may stand on the line.
    fn end_of_line(&mut self, what: &str) {
        self.space();
        match self.kind {
            TokenKind::Newline | TokenKind::Eof => {}
            TokenKind::Comment => self.trivia(),
            _ => {
                let start = self.span.start();
                let comma = self.kind == TokenKind::Comma;
                let close = matches!(self.kind, TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket);
                self.skip_line();
                let end = self.previous_end.max(start);
                if close {
                    return self.sink.push(brackets::stray(self.values.source, start));
                }
                let found = self.range(start, end);
                let mut fault = Diagnostic::error(codes::TEXT_AFTER_END, found, format!("{what} ended before this"))
                    .expected("the end of the line, or a # comment");
                if comma && end == start + 1 {
                    fault.hint = "TOML has no commas between lines".to_owned();
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

    /// Whether `name =` stands at the current token.
    fn assignment_ahead(&self) -> bool {
        let line = line_ahead(self.text, self.span.start());
        let key = line.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '"' | '\'' | ' ')));
        key.is_some_and(|at| at > 0 && line[at..].starts_with('='))
    }

    /// White space, comments and newlines in a bracket; a new statement on a new line ends all brackets.
    fn trivia_in_bracket(&mut self) {
        if self.unwinding {
            return;
        }
        loop {
            match self.kind {
                TokenKind::Whitespace => self.next(),
                TokenKind::Comment => self.comment(),
                TokenKind::Newline => {
                    self.next();
                    if self.statement_ahead() {
                        let at = self.text[self.span.start()..].len();
                        let at = self.text.len() - at;
                        return self.unwind(Some(at));
                    }
                }
                _ => return,
            }
        }
    }

    /// Whether the line that begins here must be a new statement though a bracket is open: `[name]`, `[[name]]`, or `name =`
    /// in a list.
    fn statement_ahead(&self) -> bool {
        let line = line_ahead(self.text, self.span.start()).trim();
        let header = line.trim_start_matches('[');
        if header.len() < line.len() {
            let name = header.trim_start().as_bytes().first();
            let name = name.is_some_and(|b| b.is_ascii_alphabetic());
            let close = header.find(']').unwrap_or(0);
            let inner = header.get(..close).unwrap_or("").trim();
            let after = header.get(close..).unwrap_or("").trim_start_matches(']').trim_start();
            return name
                && !matches!(inner, "true" | "false" | "inf" | "nan")
                && inner.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-' | b'.'))
                && (after.is_empty() || after.starts_with('#'));
        }
        self.open.last().is_some_and(|open| open.bracket == b'[')
            && line.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && self.assignment_ahead_in(line)
    }

    fn assignment_ahead_in(&self, line: &str) -> bool {
        let key = line.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | ' ')));
        key.is_some_and(|at| line[at..].starts_with(['=', ':']))
    }

    /// White space, newlines and comments between statements.
    fn trivia(&mut self) {
        loop {
            match self.kind {
                TokenKind::Whitespace | TokenKind::Newline => self.next(),
                TokenKind::Comment => self.comment(),
                _ => return,
            }
        }
    }

    fn comment(&mut self) {
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

    fn next(&mut self) {
        if self.kind == TokenKind::Newline {
            self.line = self.span.end();
        }
        let token: Option<Token> = self.lexer.next();
        (self.kind, self.span) =
            token.map_or((TokenKind::Eof, self.end), |token| (token.kind(), token.span() + self.offset));
    }

    /// Reads on at a byte before the end of the current token.
    pub(super) fn resume(&mut self, at: usize) {
        self.lexer = Source::new(&self.text[at..]).lex();
        self.offset = at;
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

fn too_deep(found: Span) -> Diagnostic {
    Diagnostic::error(codes::TOO_DEEP, found, format!("brackets stand more than {MAX_DEPTH} deep"))
        .hint("a scene needs no more than ten")
}
