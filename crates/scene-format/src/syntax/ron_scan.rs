//! Characters of RON: white space, comments, words, what stands ahead, and the ways past what cannot be read.

use super::brackets::closer_of;
use super::ron::Parser;
use super::ron_literal::number_kind;
use super::{arithmetic, constructs, means_nothing, span};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::expression;

impl Parser<'_> {
    /// Goes to the next comma or closing bracket of this level.
    pub(super) fn skip_broken(&mut self) {
        let mut depth = 0usize;
        let begin = self.at;
        while let Some(byte) = self.peek() {
            match byte {
                b',' if depth == 0 => break,
                b')' | b']' | b'}' if depth == 0 => break,
                b'(' | b'[' | b'{' => depth += 1,
                b')' | b']' | b'}' => depth -= 1,
                b'"' => {
                    self.skip_text();
                    continue;
                }
                // A fault inside an item does not reach over the next line's item.
                b'\n' if depth == 0 && self.at > begin => {
                    let line = self.rest()[1..].trim_start();
                    if line.starts_with(|c: char| c.is_alphabetic() || c == '_') {
                        break;
                    }
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
                b'\\' if at + 1 < bytes.len() && bytes[at + 1].is_ascii() => at += 1,
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

    /// White space and comments.
    #[inline]
    pub(super) fn trivia(&mut self) {
        // Within a line there is mostly nothing, or one space.
        let bytes = self.text.as_bytes();
        self.at += usize::from(bytes.get(self.at) == Some(&b' '));
        let begins =
            |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'(' | b')' | b'[' | b']' | b',' | b':' | b'"');
        if self.indent == usize::MAX || !bytes.get(self.at).is_some_and(begins) {
            self.lines();
        }
    }

    /// White space and comments, however many.
    fn lines(&mut self) {
        self.white_space();
        if self.indent == usize::MAX {
            self.indent = self.at - self.line;
        }
    }

    fn white_space(&mut self) {
        let bytes = self.text.as_bytes();
        loop {
            match bytes.get(self.at) {
                Some(b'\n') => {
                    self.at += 1;
                    self.line = self.at;
                    // Until the line's first word is met.
                    self.indent = usize::MAX;
                }
                Some(b' ' | b'\t' | b'\r') => self.at += 1,
                Some(b'#') if !self.is_hex_color() && !self.rest().starts_with("#!") => self.foreign_comment(),
                Some(b'/') if bytes.get(self.at + 1) == Some(&b'/') => {
                    let length = self.rest().find('\n').unwrap_or(self.rest().len());
                    let length = self.rest()[..length].trim_end().len();
                    self.comment(length);
                }
                Some(b'/') if bytes.get(self.at + 1) == Some(&b'*') => match self.block_comment() {
                    Some(length) => self.comment(length),
                    None => {
                        let found = self.span(self.at, self.at + 2);
                        self.sink.push(
                            Diagnostic::error(codes::UNCLOSED_TEXT, found, "this comment is never closed")
                                .expected("*/ at its end"),
                        );
                        self.at = self.text.len();
                        // What is open now cannot be closed any more.
                        self.at_end_reported = true;
                    }
                },
                Some(b'/' | b'-') if self.other_comment() => self.foreign_comment(),
                Some(byte) if !byte.is_ascii() => match self.rest().chars().next() {
                    Some(c) if c.is_whitespace() => self.at += c.len_utf8(),
                    Some(c) if is_invisible(c) => self.invisible(c),
                    _ => return,
                },
                _ => return,
            }
        }
    }

    /// A character that nobody sees, which is reported and passed over.
    pub(super) fn invisible(&mut self, sign: char) {
        let found = self.span(self.at, self.at + sign.len_utf8());
        self.sink.push(means_nothing(found, sign));
        self.at += sign.len_utf8();
    }

    /// `，` or `、` between two values, which is reported.
    pub(super) fn wide_comma(&mut self) -> bool {
        let Some(sign) = self.rest().chars().next().filter(|c| is_wide_comma(*c)) else { return false };
        let found = self.span(self.at, self.at + sign.len_utf8());
        let message = format!("`{sign}` is no comma of RON");
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message).hint("write a plain `,`");
        fault.edit = Some(Edit { span: found, replacement: ",".to_owned() });
        self.sink.push(fault);
        self.at += sign.len_utf8();
        true
    }

    /// `#ff8800` without quotes, or `#f80` before what ends a value.
    pub(super) fn is_hex_color(&self) -> bool {
        let digits = self.hex_digits();
        let ends = self.rest()[1 + digits..].starts_with([',', ')', ']', '}']);
        digits == 6 || ends && digits == 3
    }

    /// How many digits follow on a `#`.
    pub(super) fn hex_digits(&self) -> usize {
        self.rest().bytes().skip(1).take_while(u8::is_ascii_hexdigit).count()
    }

    /// `/ ..` or `-- ..`: signs that begin no value.
    fn other_comment(&self) -> bool {
        let blank = |rest: &str| rest.is_empty() || rest.starts_with(|c: char| c.is_whitespace());
        ["/", "--"].iter().any(|sign| self.rest().strip_prefix(sign).is_some_and(blank))
    }

    /// `# ..`, as comments are written elsewhere.
    fn foreign_comment(&mut self) {
        let sign = if self.rest().starts_with("--") { "--" } else { &self.rest()[..1] };
        if let Some((length, way)) = constructs::directive(self.rest()) {
            let found = self.span(self.at, self.at + length);
            let message = format!("`{}` is of another language", &self.rest()[..length]);
            self.sink.push(Diagnostic::error(codes::OTHER_LANGUAGE, found, message).hint(way));
            self.at += self.rest().find('\n').unwrap_or(self.rest().len());
            return;
        }
        let found = self.span(self.at, self.at + sign.len());
        let message = format!("comments begin with `//` in RON, not `{sign}`");
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message).hint("write `//`");
        // One stroke may be a slip before what is no comment.
        fault.edit = (sign != "/").then(|| Edit { span: found, replacement: "//".to_owned() });
        self.sink.push(fault);
        self.at += self.rest().find('\n').unwrap_or(self.rest().len());
    }

    fn comment(&mut self, length: usize) {
        if let Some(newline) = self.text[self.at..self.at + length].rfind('\n') {
            self.line = self.at + newline + 1;
            self.indent = usize::MAX;
        }
        let found = self.span(self.at, self.at + length);
        self.comments.push(found);
        self.at += length;
    }

    /// Length of a block comment, which may hold others; `None` when it is never closed.
    fn block_comment(&self) -> Option<usize> {
        let bytes = self.rest().as_bytes();
        let (mut at, mut depth) = (2, 1usize);
        while depth > 0 {
            match (bytes.get(at)?, bytes.get(at + 1)) {
                (b'*', Some(b'/')) => {
                    depth -= 1;
                    at += 2;
                }
                (b'/', Some(b'*')) => {
                    depth += 1;
                    at += 2;
                }
                _ => at += 1,
            }
        }
        Some(at)
    }

    pub(super) fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    pub(super) fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or("")
    }

    /// One character on.
    pub(super) fn bump(&mut self) {
        self.at += self.rest().chars().next().map_or(1, char::len_utf8);
    }

    /// Length of the word that begins here, 0 when none does.
    pub(super) fn word_length(&self) -> usize {
        let bytes = self.text.as_bytes();
        let mut at = self.at;
        match bytes.get(at) {
            Some(b'a'..=b'z' | b'A'..=b'Z' | b'_') => at += 1,
            Some(byte) if !byte.is_ascii() => {
                let rest = self.rest();
                return rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
            }
            _ => return 0,
        }
        while let Some(byte) = bytes.get(at) {
            match byte {
                b'a'..=b'z' | b'A'..=b'Z' | b'_' | b'0'..=b'9' => at += 1,
                byte if !byte.is_ascii() => {
                    let rest = &self.text[at..];
                    at += rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
                    break;
                }
                _ => break,
            }
        }
        at - self.at
    }

    pub(super) fn span(&self, start: usize, end: usize) -> Span {
        span(self.builder.source, start, end)
    }

    /// Whether a value can begin here.
    pub(super) fn entry_ahead(&self) -> bool {
        match self.peek() {
            Some(b'0'..=b'9' | b'+' | b'-' | b'.' | b'"' | b'\'' | b'(' | b'[' | b'{') => true,
            _ => self.word_length() > 0,
        }
    }

    /// `name:` (or `name =`) ahead: the length of the name.
    pub(super) fn field_ahead(&mut self) -> Option<usize> {
        let start = self.at;
        let mut length = self.word_length();
        // No name begins with `=`: such a text is an expression.
        if length == 0 && self.peek() == Some(b'"') && !self.rest().starts_with("\"=") {
            // `("name": value)`: the name of a field in quotes, taken as the field.
            let close = self.rest()[1..].find(['"', '\n'])?;
            length = close + 2;
        }
        if length == 0 {
            return None;
        }
        let mut at = start + length;
        let bytes = self.text.as_bytes();
        // `look-at: ..` is read as a name; the reader of fields knows what was meant.
        while bytes.get(at) == Some(&b'-') && bytes.get(at + 1).is_some_and(u8::is_ascii_alphabetic) {
            let rest = bytes[at + 1..].iter().position(|byte| !byte.is_ascii_alphanumeric() && *byte != b'_');
            at += 1 + rest.unwrap_or(bytes.len() - at - 1);
        }
        length = at - start;
        while matches!(bytes.get(at), Some(b' ' | b'\t' | b'\r' | b'\n')) {
            at += 1;
        }
        if matches!(bytes.get(at), Some(b'/')) {
            self.at += length;
            let comments = self.comments.len();
            self.trivia();
            at = self.at;
            self.comments.truncate(comments);
            self.at = start;
        }
        matches!(bytes.get(at), Some(b':' | b'=')).then_some(length)
    }

    /// `name value` ahead, on one line: the length of the name.
    pub(super) fn field_without_colon(&self) -> Option<usize> {
        let length = self.word_length();
        let (word, after) = self.rest().split_at(length);
        if !word.starts_with(|c: char| c.is_ascii_lowercase()) || matches!(word, "true" | "false" | "inf" | "nan") {
            return None;
        }
        // `cos(30)` and `r - 1` are the first numbers of a vector.
        let reckoned = after.starts_with('(') && expression::is_known(word) || arithmetic::reckons(after);
        if reckoned && arithmetic::ahead(self.text, self.at).is_some() {
            return None;
        }
        let value = after.trim_start_matches([' ', '\t']);
        let apart = value.len() < after.len() && value.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '-');
        (apart || value.starts_with(['"', '(', '[', '{'])).then_some(length)
    }

    /// Whether a short word follows a number, which ends at `end`, on its line: `5 cm`.
    pub(super) fn is_unit(&self, end: usize) -> bool {
        let length = self.word_length();
        let (word, after) = self.rest().split_at(length);
        let number = self.text[..end].ends_with(|c: char| c.is_ascii_digit());
        let short = (1..=7).contains(&length) && word.bytes().all(|byte| byte.is_ascii_alphabetic());
        number && short && self.line <= end && !after.trim_start().starts_with([':', '=', '(', '"', '[', '{'])
    }

    /// The bracket that was meant where `written` stands, after a name from `start` on: fields stand in round ones,
    /// names of materials in braces, lists in square ones.
    pub(super) fn meant(&self, start: usize, written: u8) -> u8 {
        let inner = || {
            let mut inner = self.rest()[1..].trim_start();
            while inner.starts_with("//") {
                inner = inner.split_once('\n').map_or("", |(_, rest)| rest).trim_start();
            }
            inner
        };
        match written {
            b'[' | b'{' if start < self.at => b'(',
            b'{' if inner().starts_with(|c: char| c.is_ascii_uppercase()) => {
                let word = inner().trim_start_matches(|c: char| c.is_ascii_alphanumeric() || c == '_');
                // What has a name has it before a colon.
                let item = word.starts_with('(') || word.trim_start().starts_with([',', '}']);
                if item { b'[' } else { written }
            }
            b'{' if inner().starts_with(|c: char| c.is_ascii_digit() || c == '-') => {
                // `{0, 1, 6}`, as vectors are written in C.
                let numbers = super::line_ahead(inner(), 0).split_once('}').map_or("", |(numbers, _)| numbers);
                let is_vector = numbers.split(',').all(|number| number_kind(number.trim()).is_some());
                if is_vector { b'(' } else { written }
            }
            b'[' if inner().starts_with('"') && !self.is_list_of_things(start) => {
                let ahead = super::line_ahead(inner(), 1);
                let named = ahead.find('"').is_some_and(|close| ahead[close + 1..].trim_start().starts_with(':'));
                if named { b'{' } else { written }
            }
            _ => written,
        }
    }

    /// Whether what stands before `start` names a list whose items may have names of their own.
    fn is_list_of_things(&self, start: usize) -> bool {
        let before = self.text[..start].trim_end().trim_end_matches([':', '=']).trim_end();
        ["objects", "lights", "items"].iter().any(|list| before.ends_with(list))
    }

    /// `Name(` ahead inside the named fields of an item of a list: the bracket of that item was never closed.
    pub(super) fn next_item_ahead(&self) -> bool {
        let length = self.word_length();
        let in_list = self.open.len() >= 2 && self.open[self.open.len() - 2].bracket == b'[';
        in_list
            && length > 0
            && self.rest()[length..].trim_start().starts_with('(')
            && !self.open.last().is_some_and(|open| is_closed_ahead(self.rest(), open.bracket, OBJECT))
    }
}

/// Objects are no longer, and a file of brackets must not take quadratic time.
const OBJECT: usize = 400;

/// Whether the bracket that a text stands in is closed in its first bytes, so many, before any other one: whatever
/// begins the text is within.
pub(super) fn is_closed_ahead(text: &str, bracket: u8, longest: usize) -> bool {
    let (mut open, mut quoted): (Vec<u8>, bool) = (vec![bracket], false);
    for byte in text.bytes().take(longest) {
        match byte {
            b'"' => quoted = !quoted,
            b'\n' => quoted = false,
            _ if quoted => {}
            b'(' | b'[' | b'{' => open.push(byte),
            b')' | b']' | b'}' => {
                if open.pop().is_none_or(|open| closer_of(open) != byte) {
                    return false;
                }
                if open.is_empty() {
                    return true;
                }
            }
            _ => {}
        }
    }
    false
}

/// Commas of other scripts.
pub(super) fn is_wide_comma(c: char) -> bool {
    matches!(c, '，' | '、' | '､')
}

/// Characters without width, which come with what is copied from pages.
pub(super) fn is_invisible(c: char) -> bool {
    matches!(c, '\u{200b}'..='\u{200f}' | '\u{2060}' | '\u{feff}' | '\u{ad}')
}
