//! Arrays and inline tables of TOML, and what to make of brackets that do not match.

use super::brackets::{self, Fate, Open};
use super::toml::Parser;
use super::{MAX_DEPTH, line_ahead};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::tree::Kind;
use toml_parser::lexer::TokenKind;

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
    /// Opens a bracket, or skips one that is too deep.
    pub(super) fn open_bracket(&mut self, bracket: u8, written: u8) -> bool {
        if self.open.len() < MAX_DEPTH {
            self.open.push(Open { bracket, written, at: self.span.start(), line: self.line, indent: 0 });
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

    /// Something in the innermost bracket could not be read.
    fn damage(&mut self, end: usize) {
        if let Some(inline) = self.inline {
            self.tables.reach_inline(inline, self.values);
        }
        self.values.leaf(Kind::Broken, self.span.start(), end);
    }

    /// `{ { .. }, .. }` or `{ 1, .. }`: a list in the brackets of a table.
    pub(super) fn is_list_in_braces(&self) -> bool {
        let inner = self.text[self.span.end()..].trim_start();
        let number = inner.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+'));
        let first = || super::line_ahead(inner, 0).split([',', ']', '}']).next().map(str::trim);
        inner.starts_with(['{', '[']) || number && first().is_some_and(|first| first.parse::<f64>().is_ok())
    }

    /// A list, in brackets that are `written` so.
    pub(super) fn array(&mut self, written: u8) {
        let start = self.span.start();
        if !self.open_bracket(b'[', written) {
            return;
        }
        let node = self.values.open(start);
        let outer = self.inline.take();
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
            if self.kind == TokenKind::Atom && self.plain_numbers() {
                continue;
            }
            if self.kind == TokenKind::Equals || self.at_key() && self.assignment_ahead() {
                let found = self.found();
                self.sink.push(
                    Diagnostic::error(codes::MIXED_FIELDS, found, "the items of a list have no names")
                        .expected("[a, b, c], or { name = value } for fields"),
                );
                self.damage(self.span.end());
                self.skip_entry();
                continue;
            }
            self.value();
            self.separator();
        }
        self.open.pop();
        self.inline = outer;
        self.values.close(node, Kind::List, self.previous_end);
    }

    pub(super) fn inline_table(&mut self) {
        let start = self.span.start();
        if !self.open_bracket(b'{', b'{') {
            return;
        }
        let node = self.values.open(start);
        let outer = self.inline.take();
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
                self.damage(self.span.end());
                self.bump_value();
                self.skip_entry();
                continue;
            }
            let path = self.key_path();
            if path.is_empty() || !self.equals(&path) {
                self.damage(self.span.start());
                self.skip_entry();
                continue;
            }
            if path.len() > 1 && self.inline.is_none() {
                self.inline = Some(self.tables.open_inline(node));
            }
            match (self.inline, path.first()) {
                (Some(inline), _) => self.tables.begin_inline_value(inline, &path, self.values, self.sink),
                (None, Some(key)) => self.values.leaf(Kind::Key, key.start, key.end),
                (None, None) => {}
            }
            self.spare_path = path;
            self.one_value();
            self.separator();
        }
        self.open.pop();
        if let Some(inline) = std::mem::replace(&mut self.inline, outer) {
            self.tables.close_inline(inline, self.values);
        }
        self.values.close(node, Kind::Map, self.previous_end);
    }

    /// What comes next in a bracket that `right` closes.
    fn bracket_ends(&mut self, right: u8) -> Next {
        if self.unwinding {
            self.damage(self.span.start());
            return Next::End;
        }
        let close = match self.kind {
            TokenKind::RightSquareBracket => b']',
            TokenKind::RightCurlyBracket => b'}',
            TokenKind::Atom if self.lexeme().starts_with(')') => {
                if let Some(&open) = self.open.last() {
                    self.sink.push(brackets::wrong_closer(self.values.source, open, self.span.start(), b')'));
                }
                self.resume(self.span.start() + 1);
                return Next::End;
            }
            TokenKind::Eof => {
                self.unwind(None);
                return Next::End;
            }
            _ => return Next::Entry,
        };
        let wrong = self.open.last().copied().filter(|open| open.written != open.bracket);
        if let Some(open) = wrong.filter(|open| close == right || close == brackets::closer_of(open.written)) {
            let at = self.span.start();
            self.sink.push(brackets::wrong_kind(self.text, self.values.source, open, "", at));
            self.bump();
            return Next::End;
        }
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
                self.damage(self.span.start());
                Next::End
            }
            Fate::Stray => {
                self.sink.push(brackets::stray(self.text, self.values.source, self.span.start()));
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
        self.damage(self.span.start());
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
    pub(super) fn separator(&mut self) {
        let end = self.previous_end;
        self.trivia_in_bracket();
        if self.unwinding {
            return;
        }
        match self.kind {
            TokenKind::Comma => self.bump(),
            TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket | TokenKind::Eof => {}
            TokenKind::Atom if self.lexeme().starts_with(')') => {}
            TokenKind::Atom if self.lexeme().starts_with(';') => {
                let found = self.range(self.span.start(), self.span.start() + 1);
                let mut fault = Diagnostic::error(codes::MISSING_COMMA, found, "values are parted by commas")
                    .hint("write `,` between two values");
                fault.edit = Some(Edit { span: found, replacement: ",".to_owned() });
                self.sink.push(fault);
                self.resume(self.span.start() + 1);
            }
            TokenKind::Atom if self.is_unit(end) => {
                self.unit(end);
                self.separator();
            }
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

    /// Whether a short word follows the value before it on its line: `5 cm`.
    pub(super) fn is_unit(&self, end: usize) -> bool {
        let word = self.lexeme();
        let after = self.text[self.span.end()..].trim_start_matches([' ', '\t']);
        let number = self.text[..end].ends_with(|c: char| c.is_ascii_digit());
        let short = word.len() <= 7 && word.bytes().all(|byte| byte.is_ascii_alphabetic());
        number
            && short
            && self.span.start() > end
            && !after.starts_with(['=', '.', ':'])
            && !self.text[end..self.span.start()].contains('\n')
    }

    /// Tells that numbers carry no unit, and goes past it.
    pub(super) fn unit(&mut self, end: usize) {
        let found = self.found();
        let mut fault =
            Diagnostic::error(codes::BAD_NUMBER, found, format!("`{}` is not part of a number", self.lexeme()))
                .hint(super::units::way(None, self.lexeme()));
        fault.edit = Some(Edit { span: self.range(end, self.span.end()), replacement: String::new() });
        self.sink.push(fault);
        self.bump();
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

    /// White space, comments and newlines in a bracket; a new statement on a new line ends all brackets.
    pub(super) fn trivia_in_bracket(&mut self) {
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
                _ if self.lexeme().starts_with("//") => self.foreign_comment(),
                _ => return,
            }
        }
    }

    /// Whether the line that begins here must be a new statement though a bracket is open: `[name]`, `[[name]]`, or
    /// `name =` in a list.
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

    /// Whether `name =` stands at the current token.
    fn assignment_ahead(&self) -> bool {
        let line = line_ahead(self.text, self.span.start());
        let key = line.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '"' | '\'' | ' ')));
        // What begins with a quote and a sign is an expression.
        let expression = line.starts_with("\"=") || line.starts_with("'=");
        key.is_some_and(|at| at > 0 && line[at..].starts_with('=')) && !expression
    }
}

pub(super) fn too_deep(found: Span) -> Diagnostic {
    Diagnostic::error(codes::TOO_DEEP, found, format!("brackets stand more than {MAX_DEPTH} deep"))
        .hint("a scene needs no more than ten")
}
