//! Numbers, texts and characters of RON.

use super::ron::Parser;
use super::ron_scan::{is_invisible, is_wide_comma};
use super::{arithmetic, decode};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::tree::Kind;

impl Parser<'_> {
    pub(super) fn number_literal(&mut self) {
        let start = self.at;
        let bytes = self.text.as_bytes();
        if let Some((length, kind)) = plain_number(&bytes[start..])
            && match bytes.get(start + length) {
                Some(b',' | b')' | b']' | b'}' | b'\r' | b'\n') => true,
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
        let mut at = start;
        if matches!(bytes[at], b'+' | b'-') {
            at += 1;
        }
        let digits = at;
        while let Some(&byte) = bytes.get(at) {
            let sign_of_exponent = matches!(byte, b'+' | b'-')
                && matches!(bytes[at - 1], b'e' | b'E')
                && at > digits
                && !bytes[digits..].starts_with(b"0x");
            if !byte.is_ascii() && self.text.get(at..).is_some_and(|rest| rest.starts_with(is_wide_comma)) {
                break;
            }
            if byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.') || sign_of_exponent || !byte.is_ascii() {
                at += 1;
            } else {
                break;
            }
        }
        if bytes.get(at).is_some_and(|byte| !byte.is_ascii()) && self.wide_commas(start) {
            return;
        }
        let mut mended = None;
        if at == digits && digits > start {
            // `- 5`: a sign with a space before its digits.
            let rest = &self.text[at..];
            let space = rest.len() - rest.trim_start_matches([' ', '\t']).len();
            let digits = rest[space..].bytes().take_while(|b| b.is_ascii_digit() || *b == b'.').count();
            if digits > 0 {
                at += space + digits;
                mended = Some(format!("{}{}", &self.text[start..start + 1], &rest[space..space + digits]));
            }
        }
        let lexeme = &self.text[start..at];
        let percent = bytes.get(at) == Some(&b'%');
        let (number, sign) = match (lexeme.strip_suffix('°'), percent) {
            (Some(number), _) => (number, Some('°')),
            (None, true) => (lexeme, Some('%')),
            (None, false) => (lexeme, None),
        };
        let end = at + usize::from(percent);
        if percent && self.percentages(start) {
            return;
        }
        if let Some(fault) = sign.and_then(|sign| arithmetic::with_sign(number, sign, self.span(start, end))) {
            self.at = end;
            self.sink.push(fault);
            return self.builder.leaf(Kind::Broken, start, end);
        }
        self.at = at;
        match number_kind(lexeme) {
            Some(kind) => self.builder.leaf(kind, start, at),
            None => {
                let lexeme = lexeme.to_owned();
                self.no_number(start, at, &lexeme, mended);
            }
        }
    }

    /// Reports what begins like a number and is none; `mended` is what was meant, where a space was too many.
    fn no_number(&mut self, start: usize, at: usize, lexeme: &str, mended: Option<String>) {
        let found = self.span(start, at.max(start + 1));
        let plain = lexeme.replace(|c: char| is_invisible(c) || !c.is_ascii() && c.is_whitespace(), "");
        let mended = mended.or_else(|| (plain.len() < lexeme.len() && number_kind(&plain).is_some()).then_some(plain));
        let mut fault = Diagnostic::error(codes::BAD_NUMBER, found, format!("`{lexeme}` is not a number"))
            .expected("a number such as 3, -0.25, 1.5e3 or 1_000");
        if lexeme.matches('.').count() > 1 {
            fault = fault.hint("a number has one decimal point; values are parted by commas");
        } else if let Some(mended) = mended {
            let what = if lexeme.contains(' ') { "a space" } else { "the character that is not seen" };
            fault = fault.hint(format!("write {mended}, without {what}"));
            fault.edit = Some(Edit { span: found, replacement: mended });
        } else if lexeme.len() == 1 {
            fault = fault.hint("write the digits after the sign, without a space");
        } else {
            fault = super::units::joined(fault, lexeme);
        }
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, start, at);
    }

    /// What follows from `start` to the bracket that closes, on one line.
    fn within_brackets(&self, start: usize) -> &str {
        let line = super::line_ahead(self.text, start);
        line[..line.find([')', ']', '}', '/']).unwrap_or(line.len())].trim_end()
    }

    /// `(0，1，2)`: numbers parted by commas of another script, which is reported once.
    fn wide_commas(&mut self, start: usize) -> bool {
        let numbers = self.within_brackets(start);
        let plain: Vec<&str> = numbers.split(|c| c == ',' || is_wide_comma(c)).map(str::trim).collect();
        if !numbers.contains(is_wide_comma) || !plain.iter().all(|number| number_kind(number).is_some()) {
            return false;
        }
        let (mended, end) = (plain.join(", "), start + numbers.len());
        let found = self.span(start, end);
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, "values are parted by plain commas")
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.sink.push(fault);
        self.at = end;
        self.builder.leaf(Kind::Broken, start, end);
        true
    }

    /// `rgb(80%, 20%, 10%)` from its first number on, which is reported once.
    fn percentages(&mut self, start: usize) -> bool {
        let numbers = self.within_brackets(start);
        let shares: Option<Vec<String>> = numbers
            .split([',', ' '])
            .filter(|number| !number.is_empty())
            .map(|number| {
                let number = number.strip_suffix('%').filter(|number| number_kind(number).is_some())?;
                Some(format!("{}", decode::number(number) / 100.0))
            })
            .collect();
        let Some(shares) = shares.filter(|shares| shares.len() > 1) else { return false };
        let end = start + numbers.len();
        let (mut from, mut to, mut mended) = (start, end, shares.join(", "));
        if let Some(open) = self.open.last()
            && self.text[open.at + 1..start].trim().is_empty()
        {
            // Colours of CSS have a name before their bracket.
            let before = &self.text[..open.at];
            let name = ["rgb", "rgba", "srgb", "color"].iter().find(|name| before.ends_with(**name));
            if let Some(name) = name.filter(|_| self.text[end..].trim_start().starts_with(')')) {
                from = open.at - name.len();
                to = end + 1 + self.text[end..].find(')').unwrap_or(0);
                mended = format!("({mended})");
            }
        }
        let found = self.span(from, to);
        let mut fault =
            Diagnostic::error(codes::BAD_NUMBER, self.span(start, end), "shares go from 0 to 1, without signs")
                .expected("numbers such as 0.8, 0.2, 0.1")
                .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.sink.push(fault);
        self.at = end;
        self.builder.leaf(Kind::Broken, start, end);
        true
    }

    /// `(0 1.6 6)` after its first number, which ends at `end`: reported once.
    pub(super) fn without_commas(&mut self, end: usize) -> bool {
        let Some(open) = self.open.last().map(|open| open.at + 1) else { return false };
        let first = self.text[open..end].trim();
        if number_kind(first).is_none() {
            return false;
        }
        let rest = self.within_brackets(end);
        let more: Vec<&str> = rest.split_whitespace().collect();
        let after = self.text[end + rest.len()..].trim_start();
        if more.len() < 2 || !after.starts_with([')', ']']) || more.iter().any(|number| number_kind(number).is_none()) {
            return false;
        }
        let mended = format!("{first}, {}", more.join(", "));
        let (start, last) = (end - first.len(), end + rest.len());
        let found = self.span(start, last);
        let mut fault = Diagnostic::error(codes::MISSING_COMMA, found, "numbers are parted by commas")
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.sink.push(fault);
        self.at = last;
        self.builder.leaf(Kind::Broken, end, last);
        true
    }

    /// Arithmetic without quotes that begins here, which is reported.
    pub(super) fn arithmetic(&mut self, start: usize) -> bool {
        let Some(length) = arithmetic::ahead(self.text, start).filter(|_| !self.is_of_text(start)) else {
            return false;
        };
        self.at = start + length;
        let (from, to) = arithmetic::with_brackets(self.text, start, self.at).unwrap_or((start, self.at));
        let fault = arithmetic::fault(self.text, &self.text[from..to], self.span(from, to));
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, start, self.at);
        true
    }

    /// `"=h" + 1`: an expression that goes on behind its quotes, of which the last is at `at`; it is reported.
    fn expression_goes_on(&mut self, start: usize, at: usize) -> bool {
        let Some(inner) = self.text[start + 1..at].strip_prefix('=') else { return false };
        let Some((body, length)) = arithmetic::joined(inner, &self.text[at + 1..]) else { return false };
        self.at = at + 1 + length;
        let found = self.span(start, self.at);
        let mended = format!("\"={body}\"");
        let mut fault =
            Diagnostic::error(codes::BARE_EXPRESSION, found, "all of an expression stands between the quotes")
                .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, start, self.at);
        true
    }

    /// Whether what begins at `start` is the value of a field that takes a text, by its name: `file: a/b`.
    fn is_of_text(&self, start: usize) -> bool {
        let before = self.text[..start].trim_end().strip_suffix(':').unwrap_or_default().trim_end();
        ["file", "placements", "material", "part", "name"].iter().any(|field| {
            before.strip_suffix(field).is_some_and(|rest| !rest.ends_with(|c: char| c.is_alphanumeric() || c == '_'))
        })
    }

    /// `<0, 1, 6>` and `rgb<0.8, 0.2, 0.1>`, the name beginning at `start`, which is reported.
    pub(super) fn angle_brackets(&mut self, start: usize) -> bool {
        let Some((length, numbers)) = arithmetic::angle_brackets(self.rest()) else { return false };
        let one = number_kind(numbers).is_some();
        let mended = if one { numbers.to_owned() } else { format!("({numbers})") };
        self.at += length;
        let found = self.span(start, self.at);
        let message = if one { "a number stands without brackets" } else { "vectors stand in round brackets" };
        let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message)
            .expected(if one { "a number" } else { "(x, y, z)" })
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: found, replacement: mended });
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, start, self.at);
        true
    }

    /// An expression without quotes, or without its first one, which is reported.
    pub(super) fn bare_expression(&mut self, start: usize) -> bool {
        let text = self.text;
        let Some(rest) = text[start..].strip_prefix('=') else { return false };
        let Some(length) = arithmetic::expression_ahead(rest).filter(|&length| number_kind(&rest[..length]).is_none())
        else {
            return false;
        };
        let end = start + 1 + length;
        self.at = end;
        let fault = match rest[length..].starts_with('"') {
            true => {
                self.at += 1;
                let mut fault =
                    Diagnostic::error(codes::UNCLOSED_TEXT, self.span(start, self.at), "this text has no first quote")
                        .expected("a text between double quotes")
                        .hint(format!("write \"{}\"", &self.text[start..end]));
                fault.edit = Some(Edit { span: self.span(start, start), replacement: "\"".to_owned() });
                fault
            }
            false => arithmetic::without_quotes(&rest[..length], self.span(start, end)),
        };
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, start, self.at);
        true
    }

    pub(super) fn is_raw_text(&self) -> bool {
        let rest = self.rest();
        rest.strip_prefix('r').is_some_and(|raw| {
            let quote = raw.trim_start_matches('#');
            quote.starts_with('"')
        })
    }

    /// `r#None`, as the `ron` crate writes a kind that is called like a word of RON.
    pub(super) fn is_raw_word(&self) -> bool {
        self.rest().strip_prefix("r#").is_some_and(|word| {
            // Not of itself: a file of nothing else must not fill the stack.
            word.starts_with(|c: char| c.is_ascii_alphabetic()) && !word.starts_with("r#")
        })
    }

    pub(super) fn raw_text_literal(&mut self) {
        let start = self.at;
        let raw = &self.rest()[1..];
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        let close = format!("\"{}", "#".repeat(hashes));
        match raw.get(hashes + 1..).and_then(|inner| inner.find(&close)) {
            Some(length) => {
                if let Some(newline) = raw[hashes + 1..hashes + 1 + length].rfind('\n') {
                    self.line = start + 1 + hashes + 1 + newline + 1;
                }
                self.at = start + 1 + hashes + 1 + length + close.len();
                self.builder.leaf(Kind::Text, start, self.at);
            }
            None => {
                let found = self.span(start, start + hashes + 2);
                self.sink.push(
                    Diagnostic::error(codes::UNCLOSED_TEXT, found, "this raw text is never closed")
                        .expected(format!("{close} at its end")),
                );
                self.at = self.text.len();
                self.at_end_reported = true;
                self.builder.leaf(Kind::Broken, start, self.at);
            }
        }
    }

    pub(super) fn text_literal(&mut self) {
        let start = self.at;
        let bytes = self.text.as_bytes();
        let mut at = start + 1;
        let mut escapes = false;
        loop {
            match bytes.get(at) {
                Some(b'"') => break,
                Some(b'\\') => {
                    escapes = true;
                    at += 2;
                }
                None | Some(b'\n') => return self.unclosed_text(),
                Some(_) => at += 1,
            }
        }
        if arithmetic::lost_its_quote(&self.text[start + 1..at], &self.text[at + 1..]) {
            return self.unclosed_text();
        }
        self.at = at + 1;
        if bytes.get(start + 1) == Some(&b'=') && self.expression_goes_on(start, at) {
            return;
        }
        if escapes {
            let inner = &self.text[start + 1..at];
            let mut faults = Vec::new();
            decode::resolve_escapes(inner, &mut |from, to| faults.push((from, to)));
            if !faults.is_empty() {
                // One is enough: who writes one backslash so writes the others so, too.
                if let Some(&(from, to)) = faults.first() {
                    let found = self.span(start + 1 + from, start + 1 + to);
                    let escape = inner.get(from..to).unwrap_or("\\");
                    let mut fault =
                        Diagnostic::error(codes::BAD_ESCAPE, found, format!("`{escape}` means nothing in a text"))
                            .expected("\\\\ \\\" \\n \\t \\r \\0 \\x41 or \\u{e9}")
                            .hint("write a backslash as `\\\\`; in paths `/` does everywhere");
                    fault.edit = decode::with_slashes(inner)
                        .map(|path| Edit { span: self.span(start + 1, at), replacement: path });
                    self.sink.push(fault);
                }
                self.builder.leaf(Kind::Broken, start, self.at);
                return;
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
            None => line[1..].find([',', ')', ']', '}']).map_or(line.len(), |end| end + 1),
        };
        let found = self.span(start, start + 1);
        let mut fault = Diagnostic::error(codes::UNCLOSED_TEXT, found, "this text is never closed")
            .expected("\" at its end, on the same line")
            .hint("write `\"` where the text ends");
        if expression.is_some() {
            let end = self.span(start + length, start + length);
            fault.edit = Some(Edit { span: end, replacement: "\"".to_owned() });
        }
        self.sink.push(fault);
        self.at = start + length;
        self.builder.leaf(Kind::Broken, start, self.at);
    }

    pub(super) fn char_literal(&mut self) {
        let start = self.at;
        let line = super::line_ahead(self.text, self.at);
        let escaped = usize::from(line[1..].starts_with('\\'));
        let first = line[1..].chars().nth(escaped).map_or(0, |c| escaped + c.len_utf8());
        match line.get(1 + first..).and_then(|rest| rest.find('\'')) {
            Some(more) => {
                self.at = start + 1 + first + more + 1;
                self.builder.leaf(Kind::Char, start, self.at);
            }
            None => {
                let found = self.span(start, start + 1);
                self.sink.push(
                    Diagnostic::error(codes::UNCLOSED_TEXT, found, "this quote is never closed")
                        .expected("a text between double quotes"),
                );
                self.at += 1;
                self.skip_broken();
                self.builder.leaf(Kind::Broken, start, self.at);
            }
        }
    }
}

/// The digits, and digits after a point, that a text begins with, as most numbers are written: their length and kind,
/// which are the same in both syntaxes if nothing follows that belongs to a number. `None`: it may be a number written
/// in another way.
#[inline]
pub(super) fn plain_number(bytes: &[u8]) -> Option<(usize, Kind)> {
    let digits = |from: usize| {
        let rest = bytes.get(from..).unwrap_or_default();
        rest.iter().position(|byte| !byte.is_ascii_digit()).unwrap_or(rest.len())
    };
    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let whole = digits(sign);
    // TOML has no leading zeros.
    if whole == 0 || whole > 1 && bytes[sign] == b'0' {
        return None;
    }
    let end = sign + whole;
    if bytes.get(end) != Some(&b'.') {
        return Some((end, Kind::Integer));
    }
    let fraction = digits(end + 1);
    (fraction > 0).then_some((end + 1 + fraction, Kind::Float))
}

/// Whether a lexeme is a number in RON, and of which kind.
pub(crate) fn number_kind(lexeme: &str) -> Option<Kind> {
    let unsigned = lexeme.strip_prefix(['+', '-']).unwrap_or(lexeme);
    if matches!(unsigned, "inf" | "NaN" | "nan" | "infinity") {
        return Some(Kind::Float);
    }
    for (prefix, radix) in [("0x", 16), ("0o", 8), ("0b", 2)] {
        if let Some(digits) = unsigned.strip_prefix(prefix) {
            let valid = digits.chars().any(|c| c != '_') && digits.chars().all(|c| c == '_' || c.is_digit(radix));
            return valid.then_some(Kind::Integer);
        }
    }
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (unsigned, None),
    };
    let is_digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit() || b == b'_');
    let has_digit = |text: &str| text.bytes().any(|b| b.is_ascii_digit());
    if let Some(exponent) = exponent {
        let digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
        if !is_digits(digits) || !has_digit(digits) {
            return None;
        }
    }
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let starts_well = !mantissa.starts_with('_') && !fraction.starts_with('_');
    if !starts_well || !is_digits(whole) || !is_digits(fraction) || !(has_digit(whole) || has_digit(fraction)) {
        return None;
    }
    Some(if exponent.is_some() || mantissa.contains('.') { Kind::Float } else { Kind::Integer })
}
