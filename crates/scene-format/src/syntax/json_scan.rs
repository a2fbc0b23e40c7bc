//! Characters of JSON: white space, comments, which it has none of, words, and the ways past what cannot be read.

use super::json::Parser;
use super::{means_nothing, span};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::tree::Kind;

impl<'p> Parser<'p> {
    pub(super) fn control_character(&mut self, sign: char) {
        let found = self.span(self.at, self.at + sign.len_utf8());
        self.sink.push(means_nothing(found, sign));
        self.at += sign.len_utf8();
    }

    /// White space; comments, of which JSON has none, are reported.
    #[inline]
    pub(super) fn space(&mut self) {
        let bytes = self.text.as_bytes();
        loop {
            match bytes.get(self.at) {
                Some(b' ' | b'\t' | b'\r') => self.at += 1,
                Some(b'\n') => {
                    self.at += 1;
                    self.line = self.at;
                    self.indent = bytes[self.at..].iter().take_while(|byte| matches!(byte, b' ' | b'\t')).count();
                    self.at += self.indent;
                }
                Some(b'/') if matches!(bytes.get(self.at + 1), Some(b'/' | b'*')) => self.comment(),
                Some(b'#') if !self.is_hex_color() => self.comment(),
                Some(byte) if !byte.is_ascii() => match self.rest().chars().next() {
                    Some(sign) if sign.is_whitespace() || matches!(sign, '\u{feff}' | '\u{200b}') => {
                        self.control_character(sign);
                    }
                    _ => return,
                },
                _ => return,
            }
        }
    }

    fn comment(&mut self) {
        let (start, rest) = (self.at, self.rest());
        let (length, closed) = match rest.starts_with("/*") {
            true => rest[2..].find("*/").map_or((rest.len(), false), |end| (end + 4, true)),
            false => (rest.split('\n').next().unwrap_or("").trim_end().len(), true),
        };
        self.at = start + length;
        let found = self.span(start, start + rest[..length].lines().next().unwrap_or("").len());
        if !closed {
            self.at_end_reported = true;
            self.sink.push(
                Diagnostic::error(codes::UNCLOSED_TEXT, found, "this comment is never closed, and JSON has none")
                    .hint("remove it"),
            );
            return;
        }
        // A line that holds nothing else goes with it.
        let begin = self.text[..start].trim_end_matches([' ', '\t']).len();
        let end = self.at + (self.rest().len() - self.rest().trim_start_matches([' ', '\t', '\r']).len());
        let own_line = begin == self.line.min(start) && self.text[end..].starts_with('\n');
        let removed = if own_line { self.span(begin, end + 1) } else { self.span(begin, self.at) };
        if let Some(newline) = rest[..length].rfind('\n') {
            self.line = start + newline + 1;
        }
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, "JSON has no comments")
            .hint("remove it; a scene with comments is written in RON or TOML");
        fault.edit = Some(Edit { span: removed, replacement: String::new() });
        self.sink.push(fault);
    }

    /// `#ff8800` without quotes.
    pub(super) fn is_hex_color(&self) -> bool {
        self.rest().bytes().skip(1).take_while(u8::is_ascii_alphanumeric).count() == 6
            && self.rest().bytes().skip(1).take(6).all(|byte| byte.is_ascii_hexdigit())
    }

    /// Whether a short word follows a number, which ends at `end`, on its line: `5 cm`.
    pub(super) fn is_unit(&self, end: usize) -> bool {
        let length = self.word_length();
        let (word, after) = self.rest().split_at(length);
        let number = self.text[..end].ends_with(|c: char| c.is_ascii_digit());
        let short = (1..=7).contains(&length) && word.bytes().all(|byte| byte.is_ascii_alphabetic());
        number && short && self.line <= end && !after.trim_start().starts_with([':', '=', '(', '"', '[', '{'])
    }

    /// Goes to the next comma or closing bracket of this level.
    pub(super) fn skip_broken(&mut self) {
        let mut depth = 0usize;
        let begin = self.at;
        while let Some(byte) = self.peek() {
            match byte {
                b',' | b')' | b']' | b'}' if depth == 0 => break,
                b'(' | b'[' | b'{' => depth += 1,
                b')' | b']' | b'}' => depth -= 1,
                b'"' => {
                    self.skip_text();
                    continue;
                }
                // A fault inside an entry does not reach over the next line's entry.
                b'\n'
                    if depth == 0
                        && self.at > begin
                        && super::line_ahead(self.text, self.at + 1).trim_start().starts_with('"') =>
                {
                    break;
                }
                _ => {}
            }
            self.bump();
        }
    }

    /// Goes past the bracket that opens here, however deep it is.
    pub(super) fn skip_brackets(&mut self) {
        let mut depth = 0usize;
        while let Some(byte) = self.peek() {
            match byte {
                b'(' | b'[' | b'{' => depth += 1,
                b')' | b']' | b'}' => {
                    depth -= 1;
                    if depth == 0 {
                        self.at += 1;
                        return;
                    }
                }
                b'"' => {
                    self.skip_text();
                    continue;
                }
                _ => {}
            }
            self.bump();
        }
    }

    fn skip_text(&mut self) {
        let bytes = self.text.as_bytes();
        let mut at = self.at + 1;
        while let Some(&byte) = bytes.get(at) {
            match byte {
                b'\\' if bytes.get(at + 1).is_some_and(|next| next.is_ascii() && *next != b'\n') => at += 1,
                b'"' => {
                    self.at = at + 1;
                    return;
                }
                b'\n' => break,
                _ => {}
            }
            at += 1;
        }
        self.at = at.min(bytes.len());
    }

    pub(super) fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    pub(super) fn rest(&self) -> &'p str {
        self.text.get(self.at..).unwrap_or("")
    }

    /// One character on.
    pub(super) fn bump(&mut self) {
        self.at += self.rest().chars().next().map_or(1, char::len_utf8);
    }

    /// Length of the word that begins here, 0 when none does.
    pub(super) fn word_length(&self) -> usize {
        let rest = super::line_ahead(self.text, self.at);
        if !rest.starts_with(|c: char| c.is_alphabetic() || c == '_') {
            return 0;
        }
        rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len())
    }

    pub(super) fn span(&self, start: usize, end: usize) -> Span {
        span(self.builder.source, start, end)
    }
}

impl Parser<'_> {
    /// `"name: value"`, an entry between one pair of quotes; reported.
    pub(super) fn entry_in_quotes(&mut self) -> bool {
        let start = self.at;
        let line = super::line_ahead(self.text, start + 1);
        let Some((inner, rest)) = line.split_once('"') else { return false };
        let ends = rest.trim_start().is_empty() || rest.trim_start().starts_with([',', '}']);
        let Some((name, value)) = inner.split_once(':').filter(|_| ends) else { return false };
        let plain = !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        if !plain || value.trim().is_empty() || value.contains('\\') {
            return false;
        }
        let end = start + 2 + inner.len();
        let found = self.span(start, end);
        let mended = format!("\"{name}\":{value}");
        let mut fault =
            Diagnostic::error(codes::UNCLOSED_TEXT, found, "the quote after the name stands behind its value")
                .expected("\"name\": value")
                .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.sink.push(fault);
        self.builder.leaf(Kind::Key, start + 1, start + 1 + name.len());
        self.builder.leaf(Kind::Broken, start, end);
        self.at = end;
        true
    }
}
