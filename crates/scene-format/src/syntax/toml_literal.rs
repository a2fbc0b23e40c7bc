//! Numbers, words, dates and texts of TOML.

use super::ron_literal::{number_kind, plain_number};
use super::toml::Parser;
use super::{Syntax, arithmetic, constructs, decode, from_ron};
use crate::codes;
use crate::css_colors::named_color;
use crate::diagnostic::{Diagnostic, Edit};
use crate::expression;
use crate::tree::Kind;
use std::ops::Range;
use toml_parser::lexer::TokenKind;

impl Parser<'_> {
    /// A number as most are, in one go: to the lexer one with a point is three tokens.
    #[inline]
    pub(super) fn plain_atom(&mut self) -> bool {
        let start = self.span.start();
        let bytes = self.text.as_bytes();
        let Some((length, kind)) = plain_number(&bytes[start..]) else { return false };
        let end = start + length;
        let ends = match bytes.get(end) {
            Some(b',' | b']' | b'}' | b'\r' | b'\n') => true,
            // `1 = 2` in a list is a name.
            Some(b' ') => !goes_on(bytes.get(end + 1)),
            _ => false,
        };
        if ends {
            self.values.leaf(kind, start, end);
            self.resume(end);
        }
        ends
    }

    /// Numbers of a list with the commas after them, as most are, in one go.
    #[inline]
    pub(super) fn plain_numbers(&mut self) -> bool {
        let bytes = self.text.as_bytes();
        let (mut at, mut any, mut comma) = (self.span.start(), false, false);
        let mut previous_end = at;
        while let Some((length, kind)) = plain_number(&bytes[at..]) {
            let end = at + length;
            let ends = match bytes.get(end) {
                Some(b',' | b']' | b'}' | b'\r' | b'\n') => true,
                // `1 = 2` in a list is a name.
                Some(b' ') => !goes_on(bytes.get(end + 1)),
                _ => false,
            };
            if !ends {
                break;
            }
            self.values.leaf(kind, at, end);
            (any, comma) = (true, bytes[end] == b',');
            previous_end = end + usize::from(comma);
            at = previous_end;
            if !comma {
                break;
            }
            at += usize::from(bytes.get(at) == Some(&b' '));
        }
        if any {
            self.resume(at);
            self.previous_end = previous_end;
            if !comma {
                self.separator();
            }
        }
        any
    }

    /// A number, `true`, `false`, a date, or a word that should have quotes.
    // Long: one arm for each thing that is none of these.
    pub(super) fn atom(&mut self) {
        if self.plain_atom() {
            return;
        }
        let start = self.span.start();
        if let Some(length) = arithmetic::ahead(self.text, start)
            && scalar_kind(&self.text[start..start + length]).is_none()
        {
            let end = start + length;
            let fault = arithmetic::fault(self.text, &self.text[start..end], self.range(start, end));
            self.sink.push(fault);
            self.values.leaf(Kind::Broken, start, end);
            return self.resume(end);
        }
        if self.lexeme().starts_with('(') {
            return self.round_brackets();
        }
        if self.kind_with_brackets() || self.other_quotes() {
            return;
        }
        if self.sign_apart() {
            return;
        }
        let mut end = self.span.end();
        while matches!(self.kind, TokenKind::Atom | TokenKind::Dot) {
            end = self.span.end();
            self.bump();
            if self.span.start() != end || self.lexeme().starts_with([';', ')']) {
                break;
            }
        }
        // Signs of other languages are no part of the value: what follows it says so.
        if let Some(at) = self.text[start..end].find([';', ')']).filter(|&at| at > 0) {
            end = start + at;
            self.resume(end);
        }
        let lexeme = &self.text[start..end];
        if let Some(kind) = scalar_kind(lexeme) {
            return self.values.leaf(kind, start, end);
        }
        let found = self.range(start, end);
        if let Some(sign) = lexeme.chars().next_back()
            && let Some(fault) = arithmetic::with_sign(&lexeme[..lexeme.len() - sign.len_utf8()], sign, found)
        {
            self.sink.push(fault);
            return self.values.leaf(Kind::Broken, start, end);
        }
        let fault = if lexeme.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.')) {
            let mut fault = Diagnostic::error(codes::BAD_NUMBER, found, format!("`{lexeme}` is not a number"))
                .expected("a number such as 3, -0.25, 1.5e3 or 1_000");
            if let Some((at, sign)) = lexeme.char_indices().find(|(_, sign)| sign.is_control()) {
                let at = start + at;
                fault = super::means_nothing(self.range(at, at + sign.len_utf8()), sign);
            } else if let Some(mended) = mended_number(lexeme) {
                fault = fault.hint(format!("TOML writes it `{mended}`"));
                fault.edit = Some(Edit { span: found, replacement: mended });
            } else {
                fault = super::units::joined(fault, lexeme);
            }
            fault
        } else {
            let (end, lexeme, found) = match self.more_words(end) {
                Some(longer) => {
                    self.resume(longer);
                    (longer, &self.text[start..longer], self.range(start, longer))
                }
                None => (end, lexeme, found),
            };
            let lower = lexeme.to_ascii_lowercase();
            let mended = if matches!(lower.as_str(), "true" | "false") { lower } else { format!("\"{lexeme}\"") };
            let mut fault =
                Diagnostic::error(codes::WORD_NOT_QUOTED, found, format!("`{lexeme}` is not a value in TOML"))
                    .expected("a number, a \"text\", true, false, a [list] or a { table = .. }")
                    .hint(format!("write {mended}"));
            let mut mended = mended;
            if let Some(hex) = named_color(lexeme) {
                fault.hint = format!("a colour is \"{hex}\"; the name of a material is {mended}");
            } else if ["Diffuse", "Mirror", "Emissive"].contains(&lexeme) {
                let field = if lexeme == "Emissive" { " radiance = 5 " } else { "" };
                mended = format!("{{ {lexeme} = {{{field}}} }}");
                fault.hint = format!("write {mended}");
            } else if expression::is_name(lexeme) && lexeme.starts_with(|c: char| c.is_ascii_lowercase()) {
                fault.hint += &format!(", or \"={lexeme}\" for one of `vars`");
            }
            if !lexeme.contains(['"', '\\', '(', ')']) {
                fault.edit = Some(Edit { span: found, replacement: mended });
            }
            self.values.leaf(Kind::Broken, start, end);
            return self.sink.push(fault);
        };
        self.sink.push(fault);
        self.values.leaf(Kind::Broken, start, end);
    }

    /// `glossy tabby` without quotes: where the words after the first one end, when nothing else follows them.
    fn more_words(&self, end: usize) -> Option<usize> {
        let line = super::line_ahead(self.text, end);
        let words = line.split([',', ']', '}', '#']).next().unwrap_or("").trim_end();
        let plain = words.chars().all(|c| c.is_alphanumeric() || matches!(c, ' ' | '_' | '-' | '.'));
        (plain && words.starts_with(' ') && !words.trim().is_empty()).then(|| end + words.len())
    }

    /// `Diffuse(albedo: 1)`: a kind as RON writes it.
    fn kind_with_brackets(&mut self) -> bool {
        let start = self.span.start();
        let Some(length) = from_ron::length(&self.text[start..]) else { return false };
        let name = &self.text[start..start + self.text[start..].find('(').unwrap_or(0)];
        let kind = name.starts_with(|c: char| c.is_ascii_uppercase());
        let end = start + length;
        let text = &self.text[start..end];
        let mended = match kind {
            true => from_ron::in_toml(text).or_else(|| from_ron::in_toml(&text.replace(" =", ":"))),
            // `vec3(0, 1, 2)`
            false => from_ron::in_toml(&text[name.len()..]).filter(|mended| mended.starts_with('[')),
        };
        let expected = match kind {
            true => format!("{{ {name} = {{ field = value }} }}"),
            false => "[x, y, z] for vectors and lists, { name = value } for fields".to_owned(),
        };
        let found = self.range(start, end);
        let mut fault =
            Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, "TOML has no round brackets").expected(expected);
        if let Some(mended) = mended {
            fault = fault.hint(format!("write {mended}"));
            fault.edit = Some(Edit { span: found, replacement: mended });
        }
        self.sink.push(fault);
        self.values.leaf(Kind::Broken, start, end);
        self.resume(end);
        true
    }

    /// `Sphere(center: (0, 0, 0), radius: 1)` in the place of `name = value`, a loop or a block of POV-Ray, which is
    /// reported.
    pub(super) fn construct_elsewhere(&mut self) -> bool {
        let start = self.span.start();
        let rest = &self.text[start..];
        let end;
        if let Some(found) = constructs::at_beginning(rest, Syntax::Toml) {
            end = start + found.length;
            let fault = found.fault(start, |from, to| self.range(from, to));
            self.sink.push(fault);
        } else if let Some(length) =
            from_ron::length(rest).filter(|_| rest.starts_with(|c: char| c.is_ascii_uppercase()))
        {
            end = start + length;
            let found = self.range(start, end);
            let name = &rest[..rest.find('(').unwrap_or(0)];
            let mut fault = Diagnostic::error(codes::OTHER_LANGUAGE, found, format!("this is RON: `{name}(..)`"))
                .expected(format!("{name} = {{ field = value }}, in TOML"));
            let mended = from_ron::in_toml(&rest[..length]);
            let inner = mended.as_deref().and_then(|mended| mended.strip_prefix("{ ")?.strip_suffix(" }"));
            if let Some(inner) = inner.filter(|inner| inner.starts_with(name)) {
                fault = fault.hint(format!("write {inner}"));
                fault.edit = Some(Edit { span: found, replacement: inner.to_owned() });
            }
            self.sink.push(fault);
        } else {
            return false;
        }
        self.resume(end);
        // A comma after it is RON's, too.
        self.space();
        if self.kind == TokenKind::Comma {
            self.bump();
        }
        self.skip_line();
        true
    }

    /// `“text”`: quotes of a word processor.
    fn other_quotes(&mut self) -> bool {
        let start = self.span.start();
        let Some((_, end)) = self.in_other_quotes() else { return false };
        self.values.leaf(Kind::Broken, start, end);
        self.resume(end);
        true
    }

    /// `“text”` ahead, which is reported: the text within, and where the last quote ends.
    pub(super) fn in_other_quotes(&mut self) -> Option<(Range<usize>, usize)> {
        const QUOTES: [char; 6] = ['“', '”', '„', '‘', '’', '«'];
        let start = self.span.start();
        if self.lexeme().as_bytes().first().is_none_or(u8::is_ascii) {
            return None;
        }
        let line = super::line_ahead(self.text, start);
        let inner = line.strip_prefix(QUOTES)?;
        let length = inner.find(['“', '”', '’', '»', '"'])?;
        let close = inner[length..].chars().next().map_or(0, char::len_utf8);
        let from = start + (line.len() - inner.len());
        let end = from + length + close;
        let found = self.range(start, end);
        let mended = format!("\"{}\"", &inner[..length]);
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, "these are no quotes of TOML")
            .expected("straight quotes: \"text\"")
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.sink.push(fault);
        Some((from..from + length, end))
    }

    /// `#ff8800` without quotes, which TOML takes for a comment.
    pub(super) fn bare_color(&mut self) -> bool {
        let start = self.span.start();
        let digits = self.lexeme().bytes().skip(1).take_while(u8::is_ascii_alphanumeric).count();
        let hex = self.lexeme().bytes().skip(1).take(6).all(|byte| byte.is_ascii_hexdigit());
        if self.kind != TokenKind::Comment || digits != 6 || !hex {
            return false;
        }
        let found = self.range(start, start + 7);
        let mended = format!("\"{}\"", &self.lexeme()[..7]);
        let mut fault = Diagnostic::error(codes::WORD_NOT_QUOTED, found, "without quotes a `#` begins a comment")
            .expected("a colour between quotes: \"#rrggbb\"")
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.sink.push(fault);
        self.values.leaf(Kind::Broken, start, start + 7);
        self.resume(start + 7);
        true
    }

    /// `- 5`: a sign with a space before its digits.
    fn sign_apart(&mut self) -> bool {
        let start = self.span.start();
        let rest = &self.text[self.span.end()..];
        let digits = rest.trim_start_matches([' ', '\t']);
        let Some((length, _)) = plain_number(digits.as_bytes()) else { return false };
        if !matches!(self.lexeme(), "-" | "+") || digits.starts_with(['-', '+']) {
            return false;
        }
        let end = self.span.end() + (rest.len() - digits.len()) + length;
        let found = self.range(start, end);
        let mended = format!("{}{}", self.lexeme(), &digits[..length]);
        let mut fault =
            Diagnostic::error(codes::BAD_NUMBER, found, format!("`{}` is not a number", &self.text[start..end]))
                .hint(format!("write {mended}, without a space"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.sink.push(fault);
        self.values.leaf(Kind::Broken, start, end);
        self.resume(end);
        true
    }

    /// `(1, 2, 3)`: a vector as RON writes it.
    fn round_brackets(&mut self) {
        let start = self.span.start();
        if self.kind_with_brackets() {
            return;
        }
        let mut depth = 0usize;
        let mut end;
        loop {
            depth += self.lexeme().matches('(').count();
            depth = depth.saturating_sub(self.lexeme().matches(')').count());
            end = self.span.end();
            self.bump();
            if depth == 0 || matches!(self.kind, TokenKind::Newline | TokenKind::Eof) {
                break;
            }
        }
        let found = self.range(start, end);
        let text = &self.text[start..end];
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, "TOML has no round brackets")
            .expected("[x, y, z] for vectors and lists, { name = value } for fields");
        let inner = text.strip_prefix('(').and_then(|t| t.strip_suffix(')'));
        if let Some(inner) = inner.filter(|inner| !inner.contains(['(', ')', ':'])) {
            fault = fault.hint(format!("write [{inner}]"));
            fault.edit = Some(Edit { span: found, replacement: format!("[{inner}]") });
        }
        self.sink.push(fault);
        self.values.leaf(Kind::Broken, start, end);
    }

    pub(super) fn text_value(&mut self) {
        let (start, end) = (self.span.start(), self.span.end());
        let lexeme = &self.text[start..end];
        let quotes = match self.kind {
            TokenKind::MlBasicString | TokenKind::MlLiteralString => 3,
            _ => 1,
        };
        let closed =
            lexeme.len() >= 2 * quotes && lexeme.as_bytes()[..quotes] == lexeme.as_bytes()[lexeme.len() - quotes..];
        if !closed {
            self.unclosed_text();
            self.values.leaf(Kind::Broken, start, end);
            // The text is taken to end before the next comma or bracket, so that its line can be read on.
            match lexeme[1..].find([',', ']', '}']).filter(|_| quotes == 1) {
                Some(length) => self.resume(start + 1 + length),
                None => self.bump(),
            }
            return;
        }
        let sound = self.escapes(start, end, quotes);
        self.bump();
        self.values.leaf(if sound { Kind::Text } else { Kind::Broken }, start, end);
    }

    /// Whether all escapes of a text between so many quotes mean something; the first that does not is reported.
    pub(super) fn escapes(&mut self, start: usize, end: usize, quotes: usize) -> bool {
        let lexeme = &self.text[start..end];
        let mut faults = Vec::new();
        if matches!(self.kind, TokenKind::BasicString | TokenKind::MlBasicString) && lexeme.contains('\\') {
            let span = toml_parser::Span::new_unchecked(0, lexeme.len());
            let raw = toml_parser::Raw::new_unchecked(lexeme, decode::toml_encoding(lexeme), span);
            let mut out = String::new();
            let mut sink = |fault: toml_parser::ParseError| faults.push(fault);
            let _kind = raw.decode_scalar(&mut out, &mut sink);
        }
        let Some(fault) = faults.first() else { return true };
        let at = fault.unexpected().unwrap_or(toml_parser::Span::new_unchecked(0, lexeme.len()));
        let from = lexeme[..at.start().min(lexeme.len())].rfind('\\').unwrap_or(at.start());
        let to = from + 1 + lexeme[from + 1..].chars().next().map_or(0, char::len_utf8);
        let found = self.range(start + from, start + to);
        let escape = &lexeme[from..to];
        let mut told = Diagnostic::error(codes::BAD_ESCAPE, found, format!("`{escape}` means nothing in a text"))
            .expected("\\\\ \\\" \\n \\t \\r \\u00e9 or \\U0001f408")
            .hint("write a backslash as `\\\\`, or the text in 'single quotes'; in paths `/` does everywhere");
        let inner = lexeme.get(quotes..lexeme.len() - quotes).unwrap_or("");
        told.edit = decode::with_slashes(inner)
            .map(|path| Edit { span: self.range(start + quotes, end - quotes), replacement: path });
        self.sink.push(told);
        false
    }

    pub(super) fn unclosed_text(&mut self) {
        // Three quotes begin a text of several lines.
        let many = self.lexeme().starts_with("\"\"\"") || self.lexeme().starts_with("'''");
        let (quote, place) = match many {
            true => (&self.lexeme()[..3], "at its end"),
            false => (&self.lexeme()[..1], "at its end, on the same line"),
        };
        let message = "this text is never closed";
        let found = self.range(self.span.start(), self.span.start() + quote.len());
        let fault = Diagnostic::error(codes::UNCLOSED_TEXT, found, message)
            .expected(format!("{quote} {place}"))
            .hint(format!("write `{quote}` where the text ends"));
        self.sink.push(fault);
    }
}

/// Whether what stands after a number and a space belongs to it: `1 = 2`, `1 + 2`.
fn goes_on(next: Option<&u8>) -> bool {
    next.is_some_and(|next| *next == b'=' || arithmetic::OPERATORS.contains(next))
}

/// Whether a lexeme is a value in TOML, and of which kind.
pub(super) fn scalar_kind(lexeme: &str) -> Option<Kind> {
    match lexeme {
        "true" | "false" => return Some(Kind::Bool),
        "inf" | "+inf" | "-inf" | "nan" | "+nan" | "-nan" => return Some(Kind::Float),
        _ => {}
    }
    let bytes = lexeme.as_bytes();
    if !bytes.first()?.is_ascii_digit() && !matches!(bytes.first(), Some(b'+' | b'-')) {
        return None;
    }
    let is_date = bytes.len() >= 8
        && (bytes.get(4) == Some(&b'-') && bytes.get(7) == Some(&b'-')
            || bytes.get(2) == Some(&b':') && bytes.get(5) == Some(&b':'));
    if is_date {
        return Some(Kind::Date);
    }
    let kind = number_kind(lexeme)?;
    let unsigned = lexeme.trim_start_matches(['+', '-']);
    // TOML wants digits on both sides of the point, and no leading zeros.
    let (whole, _) = unsigned.split_once(['.', 'e', 'E']).unwrap_or((unsigned, ""));
    let radix = unsigned.starts_with("0x") || unsigned.starts_with("0o") || unsigned.starts_with("0b");
    let leading_zero = !radix && whole.len() > 1 && whole.starts_with('0');
    let bare_point =
        unsigned.starts_with('.') || unsigned.ends_with('.') || unsigned.contains(".e") || unsigned.contains(".E");
    let underscores =
        unsigned.contains("__") || unsigned.ends_with('_') || whole.ends_with('_') || unsigned.contains("_e");
    let signed_radix = radix && lexeme.len() != unsigned.len();
    let wrong = leading_zero || bare_point || underscores || signed_radix;
    (!wrong).then_some(kind)
}

/// A number that RON takes as TOML wants it.
fn mended_number(lexeme: &str) -> Option<String> {
    number_kind(lexeme)?;
    let value = decode::number(lexeme);
    value.is_finite().then(|| format!("{value}"))
}
