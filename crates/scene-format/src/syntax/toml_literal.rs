//! Numbers, words, dates and texts of TOML.

use super::decode;
use super::ron_literal::{number_kind, plain_number};
use super::toml::Parser;
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::tree::Kind;
use toml_parser::lexer::TokenKind;

impl Parser<'_> {
    /// A number, `true`, `false`, a date, or a word that should have quotes.
    pub(super) fn atom(&mut self) {
        let start = self.span.start();
        let bytes = self.text.as_bytes();
        if let Some((length, kind)) = plain_number(&bytes[start..])
            && matches!(bytes.get(start + length), Some(b',' | b' ' | b']' | b'}' | b'\r' | b'\n'))
        {
            // In one go: to the lexer a number with a point is three tokens.
            self.values.leaf(kind, start, start + length);
            return self.resume(start + length);
        }
        if self.lexeme().starts_with('(') {
            return self.round_brackets();
        }
        let mut end = self.span.end();
        while matches!(self.kind, TokenKind::Atom | TokenKind::Dot) {
            end = self.span.end();
            self.bump();
            if self.span.start() != end {
                break;
            }
        }
        let lexeme = &self.text[start..end];
        if let Some(kind) = scalar_kind(lexeme) {
            return self.values.leaf(kind, start, end);
        }
        let found = self.range(start, end);
        let fault = if lexeme.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.')) {
            let mut fault = Diagnostic::error(codes::BAD_NUMBER, found, format!("`{lexeme}` is not a number"))
                .expected("a number such as 3, -0.25, 1.5e3 or 1_000");
            let mended = mended_number(lexeme);
            if let Some(mended) = mended {
                fault = fault.hint(format!("TOML writes it `{mended}`"));
                fault.edit = Some(Edit { span: found, replacement: mended });
            }
            fault
        } else {
            let lower = lexeme.to_ascii_lowercase();
            let mended = if matches!(lower.as_str(), "true" | "false") { lower } else { format!("\"{lexeme}\"") };
            let mut fault =
                Diagnostic::error(codes::WORD_NOT_QUOTED, found, format!("`{lexeme}` is not a value in TOML"))
                    .expected("a number, a \"text\", true, false, a [list] or a { table = .. }")
                    .hint(format!("write {mended}"));
            if !lexeme.contains(['"', '\\', '(', ')']) {
                fault.edit = Some(Edit { span: found, replacement: mended });
            }
            fault
        };
        self.sink.push(fault);
        self.values.leaf(Kind::Broken, start, end);
    }

    /// `(1, 2, 3)`: a vector as RON writes it.
    fn round_brackets(&mut self) {
        let start = self.span.start();
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
        let mut faults = Vec::new();
        if matches!(self.kind, TokenKind::BasicString | TokenKind::MlBasicString) && lexeme.contains('\\') {
            let span = toml_parser::Span::new_unchecked(0, lexeme.len());
            let raw = toml_parser::Raw::new_unchecked(lexeme, decode::toml_encoding(lexeme), span);
            let mut out = String::new();
            let mut sink = |fault: toml_parser::ParseError| faults.push(fault);
            let _kind = raw.decode_scalar(&mut out, &mut sink);
        }
        for fault in &faults {
            let at = fault.unexpected().unwrap_or(toml_parser::Span::new_unchecked(0, lexeme.len()));
            let from = lexeme[..at.start().min(lexeme.len())].rfind('\\').unwrap_or(at.start());
            let to = from + 1 + lexeme[from + 1..].chars().next().map_or(0, char::len_utf8);
            let found = self.range(start + from, start + to);
            let escape = &lexeme[from..to];
            self.sink.push(
                Diagnostic::error(codes::BAD_ESCAPE, found, format!("`{escape}` means nothing in a text"))
                    .expected("\\\\ \\\" \\n \\t \\r \\u00e9 or \\U0001f408")
                    .hint("write a backslash as `\\\\`, or the text in 'single quotes'; in paths `/` does everywhere"),
            );
        }
        self.bump();
        self.values.leaf(if faults.is_empty() { Kind::Text } else { Kind::Broken }, start, end);
    }

    pub(super) fn unclosed_text(&mut self) {
        let quote = &self.lexeme()[..1];
        let message = "this text is never closed";
        let found = self.range(self.span.start(), self.span.start() + 1);
        let fault = Diagnostic::error(codes::UNCLOSED_TEXT, found, message)
            .expected(format!("{quote} at its end, on the same line"))
            .hint(format!("write `{quote}` where the text ends"));
        self.sink.push(fault);
    }
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
