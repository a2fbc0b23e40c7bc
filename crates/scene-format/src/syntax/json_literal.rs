//! Numbers, texts and words of JSON, and what people write in their place: single quotes, `True`, `1_000`.

use super::json::Parser;
use super::ron_literal::{number_kind, plain_number};
use super::{arithmetic, decode};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::expression;
use crate::tree::Kind;
use std::ops::Range;

/// Quotes of word processors and of other languages.
pub(super) const QUOTES: [char; 7] = ['\'', '“', '”', '„', '‘', '’', '«'];

/// Whether JSON reads this lexeme as a number.
pub(crate) fn is_json_number(lexeme: &str) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let unsigned = lexeme.strip_prefix('-').unwrap_or(lexeme);
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (unsigned, None),
    };
    let (whole, fraction) = match mantissa.split_once('.') {
        Some((whole, fraction)) => (whole, Some(fraction)),
        None => (mantissa, None),
    };
    digits(whole)
        && (whole.len() == 1 || !whole.starts_with('0'))
        && fraction.is_none_or(digits)
        && exponent.is_none_or(|exponent| digits(exponent.strip_prefix(['+', '-']).unwrap_or(exponent)))
}

impl<'p> Parser<'p> {
    pub(super) fn number_literal(&mut self) {
        let start = self.at;
        let bytes = self.text.as_bytes();
        if bytes[start] != b'+'
            && let Some((length, kind)) = plain_number(&bytes[start..])
            && match bytes.get(start + length) {
                Some(b',' | b']' | b'}' | b'\r' | b'\n') => true,
                Some(b' ') => !bytes.get(start + length + 1).is_some_and(|next| arithmetic::OPERATORS.contains(next)),
                _ => false,
            }
        {
            self.at = start + length;
            return self.builder.leaf(kind, start, self.at);
        }
        if self.arithmetic(start) {
            return;
        }
        let lexeme = self.number_ahead();
        let end = start + lexeme.len();
        if is_json_number(lexeme) && !matches!(bytes.get(end), Some(b'%')) {
            self.at = end;
            let kind = if lexeme.contains(['.', 'e', 'E']) { Kind::Float } else { Kind::Integer };
            return self.builder.leaf(kind, start, end);
        }
        let percent = usize::from(bytes.get(end) == Some(&b'%'));
        let (number, sign) = match (lexeme.strip_suffix('°'), percent) {
            (Some(number), _) => (number, Some('°')),
            (None, 1) => (lexeme, Some('%')),
            _ => (lexeme, None),
        };
        let found = self.span(start, end + percent);
        let fault = match sign.and_then(|sign| arithmetic::with_sign(number, sign, found)) {
            Some(fault) => {
                self.at = end + percent;
                fault.expected(NUMBERS)
            }
            None => {
                self.at = end.max(start + 1);
                let fault = bad_number(lexeme, self.span(start, self.at));
                self.sign_apart(start, &fault).unwrap_or(fault)
            }
        };
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, start, self.at);
    }

    /// What a number could be that begins here: its letters, digits, points and signs.
    fn number_ahead(&self) -> &'p str {
        let rest = self.rest();
        let bytes = rest.as_bytes();
        let mut at = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
        while let Some(&byte) = bytes.get(at) {
            let exponent = at > 0 && matches!(bytes[at - 1], b'e' | b'E') && !rest.starts_with("0x");
            let of_number = byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.') || !byte.is_ascii();
            if !(of_number || exponent && matches!(byte, b'+' | b'-')) {
                break;
            }
            at += 1;
        }
        // Signs of other scripts are no part of it, but for the degree.
        let number = &rest[..at];
        let end = number.find(|c: char| !c.is_ascii() && c != '°' && !c.is_alphanumeric()).unwrap_or(at);
        &number[..end]
    }

    /// `- 5`: a sign with a space before its digits.
    fn sign_apart(&mut self, start: usize, fault: &Diagnostic) -> Option<Diagnostic> {
        let sign = &self.text[start..self.at];
        let digits = self.rest().trim_start_matches([' ', '\t']);
        let (length, _) = plain_number(digits.as_bytes())?;
        if !matches!(sign, "-" | "+") || digits.starts_with(['-', '+']) {
            return None;
        }
        let end = self.text.len() - digits.len() + length;
        let mended = format!("{}{}", sign.trim_start_matches('+'), &digits[..length]);
        self.at = end;
        let found = self.span(start, end);
        let message = format!("`{}` is not a number", &self.text[start..end]);
        let mut told = Diagnostic { message, span: found, ..fault.clone() };
        told.hint = format!("write {mended}, without a space");
        told.edit = Some(Edit { span: found, replacement: mended });
        Some(told)
    }

    /// Arithmetic without quotes that begins here, which is reported.
    fn arithmetic(&mut self, start: usize) -> bool {
        let Some(length) = arithmetic::ahead(self.text, start) else { return false };
        self.at = start + length;
        let body = &self.text[start..self.at];
        if number_kind(body).is_some() {
            self.at = start;
            return false;
        }
        let fault = arithmetic::fault(self.text, body, self.span(start, self.at));
        self.broken(start, fault);
        true
    }

    pub(super) fn text_literal(&mut self) {
        let start = self.at;
        let bytes = self.text.as_bytes();
        let (mut at, mut escapes, mut control) = (start + 1, false, None);
        loop {
            match bytes.get(at) {
                Some(b'"') => break,
                Some(b'\\') => {
                    escapes = true;
                    at += 2;
                }
                None | Some(b'\n' | b'\r') => return self.unclosed_text(),
                Some(byte) => {
                    control = control.or((*byte < 0x20).then_some(at));
                    at += 1;
                }
            }
        }
        let inner = &self.text[start + 1..at];
        if arithmetic::lost_its_quote(inner, &self.text[at + 1..]) {
            return self.unclosed_text();
        }
        self.at = at + 1;
        if let Some(at) = control {
            let escape = match bytes[at] {
                b'\t' => "\\t".to_owned(),
                byte => format!("\\u{byte:04x}"),
            };
            let found = self.span(at, at + 1);
            let message =
                format!("a text of JSON has no character {} as it is", char::from(bytes[at]).escape_unicode());
            let mut fault =
                Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message).hint(format!("write {escape}"));
            fault.edit = Some(Edit { span: found, replacement: escape });
            return self.broken(start, fault);
        }
        if escapes {
            // One is enough: who writes one backslash so writes the others so, too.
            let mut first: Option<(usize, usize)> = None;
            decode::resolve_json_escapes(inner, &mut |from, to| first = first.or(Some((from, to))));
            if let Some((from, to)) = first {
                let found = self.span(start + 1 + from, start + 1 + to);
                let fault = bad_escape(inner, (from, to), found, self.span(start + 1, at));
                return self.broken(start, fault);
            }
        }
        self.builder.leaf(Kind::Text, start, self.at);
    }

    /// A text that its line does not close. It is taken to end before the next comma or bracket.
    fn unclosed_text(&mut self) {
        let start = self.at;
        let line = self.rest().split('\n').next().unwrap_or("").trim_end();
        let expression = line[1..].strip_prefix('=').and_then(arithmetic::expression_ahead);
        let length = match expression {
            Some(length) => 2 + length,
            None => line[1..].find([',', ')', ']', '}', ':']).map_or(line.len(), |end| end + 1),
        };
        let mut fault =
            Diagnostic::error(codes::UNCLOSED_TEXT, self.span(start, start + 1), "this text is never closed")
                .expected("\" at its end, on the same line")
                .hint("write `\"` where the text ends");
        if expression.is_some() {
            let end = self.span(start + length, start + length);
            fault.edit = Some(Edit { span: end, replacement: "\"".to_owned() });
        }
        self.at = start + length;
        self.broken(start, fault);
    }

    /// A word, or something that begins no value.
    pub(super) fn word_or_fault(&mut self) {
        let start = self.at;
        let length = self.word_length();
        if length == 0 {
            return self.unexpected();
        }
        let word = &self.text[start..start + length];
        // A comment may follow, which is told by itself.
        let ends = |b: &u8| b.is_ascii_whitespace() || matches!(b, b',' | b';' | b']' | b'}' | b')' | b'/' | b'#');
        let alone = self.text.as_bytes().get(start + length).is_none_or(ends);
        match word {
            "true" | "false" if alone => {
                self.at += length;
                return self.builder.leaf(Kind::Bool, start, self.at);
            }
            "null" if alone => {
                self.at += length;
                return self.builder.leaf(Kind::Word, start, self.at);
            }
            _ if (expression::is_known(word) || arithmetic::reckons(&self.text[start + length..]))
                && self.arithmetic(start) =>
            {
                return;
            }
            _ => {}
        }
        if self.of_numpy(start) || self.angle_brackets(start) || self.kind_with_brackets(start) {
            return;
        }
        if matches!(word, "NaN" | "nan" | "Infinity" | "inf" | "infinity" | "Inf") && alone {
            self.at += length;
            let message = format!("JSON has no `{word}`");
            let fault = Diagnostic::error(codes::BAD_NUMBER, self.span(start, self.at), message)
                .expected("a finite number such as 3, -0.25 or 1.5e3");
            return self.broken(start, fault);
        }
        let mended = match word {
            "True" | "TRUE" | "False" | "FALSE" if alone => Some(word.to_ascii_lowercase()),
            "None" | "NULL" | "Null" | "nil" | "undefined" if alone => Some("null".to_owned()),
            _ => None,
        };
        let Some(mended) = mended else { return self.text_without_quotes(start) };
        self.at += length;
        let found = self.span(start, self.at);
        let mut fault =
            Diagnostic::error(codes::WORD_NOT_QUOTED, found, format!("JSON writes `{mended}`, not `{word}`")).hint(
                match &*mended {
                    "null" => "write null where a field may have none; else leave the field out".to_owned(),
                    _ => format!("write {mended}"),
                },
            );
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.broken(start, fault);
    }

    /// A text that has no quotes, or no first one, begins here.
    pub(super) fn text_without_quotes(&mut self, start: usize) {
        if let Some((body, length)) = arithmetic::of_languages(super::line_ahead(self.text, start)) {
            // Whether an angle was meant, and in which unit, nobody knows: no edit is certain.
            self.at = start + length;
            let fault = arithmetic::without_quotes(&body, self.span(start, self.at));
            let hint = format!("{}; angles are in degrees", fault.hint);
            return self.broken(start, Diagnostic { edit: None, hint, ..fault });
        }
        self.at = start + self.bare_text();
        let text = self.text[start..self.at].trim_end_matches('"');
        let found = self.span(start, self.at);
        let message = format!("the text `{text}` is not between quotes");
        let mut fault = Diagnostic::error(codes::WORD_NOT_QUOTED, found, message).hint(format!("write \"{text}\""));
        if !text.contains(['"', '\\', '(', '[', '{']) {
            fault.edit = Some(Edit { span: found, replacement: format!("\"{text}\"") });
        }
        self.broken(start, fault);
    }

    /// The length of a text that has no quotes: up to what ends an entry, on the same line.
    fn bare_text(&self) -> usize {
        let line = super::line_ahead(self.text, self.at);
        line.split([',', ']', '}', ':']).next().map_or(0, |text| text.trim_end().len()).max(1)
    }

    /// `np.float64(1.0)` or `array([0., 1.])`, as NumPy prints its values, which is reported.
    fn of_numpy(&mut self, start: usize) -> bool {
        let line = super::line_ahead(self.text, start);
        let Some((length, mended)) = numpy(line) else { return false };
        let name = &line[..line.find('(').unwrap_or(line.len())];
        self.at = start + length;
        let found = self.span(start, self.at);
        let message = format!("JSON has no `{name}(..)`: this is a value of NumPy");
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message)
            .expected(VALUES)
            .hint(format!("write {mended}; in Python, .tolist() gives plain numbers"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.broken(start, fault);
        true
    }

    /// `Diffuse(albedo: 1)` or `vec3(1, 2, 3)`, as other languages have it, which is reported.
    fn kind_with_brackets(&mut self, start: usize) -> bool {
        let length = self.word_length();
        let line = super::line_ahead(self.text, start);
        if !line.get(length..).is_some_and(|after| after.starts_with('(')) {
            return false;
        }
        let Some(close) = closing(line, length) else { return false };
        let (name, inner) = (&line[..length], line[length + 1..close].trim());
        let kind = name.starts_with(|c: char| c.is_ascii_uppercase());
        let vector = inner.split(',').all(|number| is_json_number(number.trim()));
        let mended = match (kind, vector) {
            (true, true) => Some(format!("{{ \"{name}\": [{inner}] }}")),
            (true, false) => fields(inner).map(|fields| format!("{{ \"{name}\": {{{fields}}} }}")),
            (false, true) => Some(format!("[{inner}]")),
            (false, false) => None,
        };
        let expected = match kind {
            true => format!("{{ \"{name}\": {{ \"field\": value }} }}"),
            false => VALUES.to_owned(),
        };
        self.at = start + close + 1;
        let fault = no_round_brackets(self.span(start, self.at), expected, mended);
        self.broken(start, fault);
        true
    }

    /// `(1, 2, 3)`: a vector as RON and Python write it.
    pub(super) fn round_brackets(&mut self, start: usize) {
        let line = super::line_ahead(self.text, start);
        let Some(close) = closing(line, 0) else {
            self.skip_brackets();
            let fault = no_round_brackets(self.span(start, start + 1), VALUES.to_owned(), None);
            return self.broken(start, fault);
        };
        let inner = line[1..close].trim();
        let mended = (!inner.contains(['(', ':'])).then(|| format!("[{inner}]"));
        self.at = start + close + 1;
        let fault = no_round_brackets(self.span(start, self.at), VALUES.to_owned(), mended);
        self.broken(start, fault);
    }

    /// `<0, 1, 6>`, which is reported.
    fn angle_brackets(&mut self, start: usize) -> bool {
        let name = self.word_length();
        let Some((length, numbers)) = arithmetic::angle_brackets(&self.rest()[name..]) else { return false };
        let one = number_kind(numbers).is_some();
        let mended = if one { numbers.to_owned() } else { format!("[{numbers}]") };
        self.at += name + length;
        let found = self.span(start, self.at);
        let message = if one { "a number stands without brackets" } else { "vectors stand in square brackets" };
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message)
            .expected(if one { "a number" } else { "[x, y, z]" })
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.broken(start, fault);
        true
    }

    /// A character that begins nothing.
    fn unexpected(&mut self) {
        let start = self.at;
        if self.rest().starts_with(QUOTES) {
            self.in_other_quotes();
            return self.builder.leaf(Kind::Broken, start, self.at);
        }
        if self.angle_brackets(start) || self.bare_expression(start) {
            return;
        }
        if self.rest().starts_with('#') && self.is_hex_color() {
            self.at += 7;
            let mended = format!("\"{}\"", &self.text[start..self.at]);
            let found = self.span(start, self.at);
            let mut fault = Diagnostic::error(codes::WORD_NOT_QUOTED, found, "this colour is not between quotes")
                .hint(format!("write {mended}"));
            fault.edit = Some(Edit { span: found, replacement: mended });
            return self.broken(start, fault);
        }
        let sign = self.rest().chars().next().unwrap_or(' ');
        let message = format!("a value cannot begin with `{}`", sign.escape_debug());
        let found = self.span(start, start + sign.len_utf8());
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message)
            .expected("a number, a \"text\", true, false, null, a [list] or { \"name\": value }");
        if matches!(sign, '=' | ':' | ';') {
            fault = fault.hint("remove it");
        }
        self.bump();
        self.skip_broken();
        self.broken(start, fault);
    }

    /// An expression without quotes: `=2*r`.
    fn bare_expression(&mut self, start: usize) -> bool {
        let Some(rest) = self.text[start..].strip_prefix('=') else { return false };
        let Some(length) = arithmetic::expression_ahead(rest).filter(|&length| number_kind(&rest[..length]).is_none())
        else {
            return false;
        };
        self.at = start + 1 + length;
        if self.peek() == Some(b'"') {
            let mended = format!("\"{}\"", &self.text[start..self.at]);
            self.at += 1;
            let mut fault =
                Diagnostic::error(codes::UNCLOSED_TEXT, self.span(start, self.at), "this text has no first quote")
                    .expected("a text between double quotes")
                    .hint(format!("write {mended}"));
            fault.edit = Some(Edit { span: self.span(start, start), replacement: "\"".to_owned() });
            self.broken(start, fault);
        } else {
            let fault = arithmetic::without_quotes(&rest[..length], self.span(start, self.at));
            self.broken(start, fault);
        }
        true
    }

    /// `'text'` or `“text”` ahead, which is reported: where the text within stands. `None`: it is not closed, which is
    /// reported, too.
    pub(super) fn in_other_quotes(&mut self) -> Option<Range<usize>> {
        let start = self.at;
        let line = super::line_ahead(self.text, start);
        let quote = line.chars().next().map_or(1, char::len_utf8);
        let single = line.starts_with('\'');
        let inner = &line[quote..];
        let close = if single { inner.find('\'') } else { inner.find(['“', '”', '’', '»', '"']) };
        let Some(length) = close else {
            self.at += quote;
            let found = self.span(start, self.at);
            self.sink.push(
                Diagnostic::error(codes::UNCLOSED_TEXT, found, "this quote is never closed")
                    .expected("a text between double quotes"),
            );
            self.skip_broken();
            return None;
        };
        let from = start + quote;
        self.at = from + length + inner[length..].chars().next().map_or(0, char::len_utf8);
        let found = self.span(start, self.at);
        let text = &inner[..length];
        let message = if single { "JSON has no single quotes" } else { "these are no quotes of JSON" };
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message)
            .expected("a text between straight double quotes: \"text\"")
            .hint(format!("write \"{text}\""));
        if !text.contains(['"', '\\']) {
            fault.edit = Some(Edit { span: found, replacement: format!("\"{text}\"") });
        }
        self.sink.push(fault);
        Some(from..from + length)
    }

    /// Reports a fault, and leaves a broken node from `start` to here.
    pub(super) fn broken(&mut self, start: usize, fault: Diagnostic) {
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, start, self.at);
    }
}

const NUMBERS: &str = "a number such as 3, -0.25 or 1.5e3";
const VALUES: &str = "[x, y, z] for vectors and lists, { \"name\": value } for fields";

fn no_round_brackets(found: Span, expected: String, mended: Option<String>) -> Diagnostic {
    let mut fault =
        Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, "JSON has no round brackets").expected(expected);
    if let Some(mended) = mended {
        fault = fault.hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
    }
    fault
}

/// The value of NumPy that a line begins with, as JSON has it, and its length as it is written.
fn numpy(line: &str) -> Option<(usize, String)> {
    const KINDS: [&str; 14] = [
        "float64", "float32", "float16", "int64", "int32", "int16", "int8", "uint8", "uint16", "uint32", "float",
        "int", "array", "asarray",
    ];
    let open = line.find('(')?;
    let name = line[..open].trim_start_matches("numpy.").trim_start_matches("np.");
    let close = closing(line, open).filter(|_| KINDS.contains(&name))?;
    let inner = line[open + 1..close].split(", dtype").next().unwrap_or_default().trim();
    let is_number = |sign: char| sign.is_ascii_digit() || matches!(sign, '.' | '-' | '+' | 'e' | 'E');
    let (mut out, mut rest) = (String::with_capacity(inner.len() + 8), inner);
    while let Some(sign) = rest.chars().next() {
        let length = rest.find(|sign| !is_number(sign)).unwrap_or(rest.len());
        let number = &rest[..length];
        match number.strip_suffix('.') {
            _ if length == 0 && !matches!(sign, '[' | ']' | ',' | ' ') => return None,
            _ if length == 0 => out.push(sign),
            // JSON has digits after a point.
            Some(whole) if is_json_number(whole) => out += &format!("{whole}.0"),
            _ if is_json_number(number) => out += number,
            _ => return None,
        }
        rest = &rest[length.max(sign.len_utf8())..];
    }
    let is_list = out.starts_with('[') && out.ends_with(']');
    (is_list || is_json_number(&out)).then_some((close + 1, out))
}

/// Where the bracket is closed that opens at a byte of a line.
fn closing(line: &str, open: usize) -> Option<usize> {
    let mut depth = 0usize;
    let brackets = line.bytes().enumerate().skip(open).filter(|(_, byte)| matches!(byte, b'(' | b')'));
    for (at, byte) in brackets {
        depth = if byte == b'(' { depth + 1 } else { depth - 1 };
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

/// `albedo: 1, name: "x"` as JSON has it; `None` where it is not as plain as that.
fn fields(inner: &str) -> Option<String> {
    if inner.is_empty() {
        return Some(String::new());
    }
    let pairs: Option<Vec<String>> = inner
        .split(',')
        .map(|pair| {
            let (name, value) = pair.split_once([':', '='])?;
            let (name, value) = (name.trim(), value.trim());
            let text = value.len() > 2 && value.starts_with('"') && value.ends_with('"');
            let plain = is_json_number(value) || matches!(value, "true" | "false") || text;
            let is_name = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
            (plain && is_name).then(|| format!("\"{name}\": {value}"))
        })
        .collect();
    pairs.map(|pairs| format!(" {} ", pairs.join(", ")))
}

fn bad_number(lexeme: &str, found: Span) -> Diagnostic {
    let mut fault =
        Diagnostic::error(codes::BAD_NUMBER, found, format!("`{lexeme}` is not a number in JSON")).expected(NUMBERS);
    let value = number_kind(lexeme).map(|_| decode::number(lexeme)).filter(|value| value.is_finite());
    if let Some(value) = value {
        let mended = format!("{value}");
        fault = fault.hint(format!("JSON writes it {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
    } else if lexeme.matches('.').count() > 1 {
        fault = fault.hint("a number has one decimal point; values are parted by commas");
    } else if lexeme.trim_start_matches(['+', '-']).starts_with(['i', 'I', 'n', 'N']) {
        fault = fault.hint("JSON has finite numbers only");
    } else {
        fault = super::units::joined(fault, lexeme);
    }
    fault
}

/// An escape at `from..to` of a text's inside that means nothing.
fn bad_escape(inner: &str, (from, to): (usize, usize), found: Span, inside: Span) -> Diagnostic {
    let escape = inner.get(from..to).unwrap_or("\\");
    let mut fault = Diagnostic::error(codes::BAD_ESCAPE, found, format!("`{escape}` means nothing in a text"))
        .expected("\\\\ \\\" \\/ \\n \\t \\r \\b \\f or \\u00e9")
        .hint("write a backslash as `\\\\`; in paths `/` does everywhere");
    if let Some(path) = decode::with_slashes(inner) {
        fault.edit = Some(Edit { span: inside, replacement: path });
    } else if escape.starts_with("\\ud") || escape.starts_with("\\uD") {
        fault.hint = "a character beyond \\uffff is two of these, as in \\ud83d\\udc08".to_owned();
    } else if escape == "\\'" {
        fault.hint = "write `'`".to_owned();
        fault.edit = Some(Edit { span: found, replacement: "'".to_owned() });
    }
    fault
}
