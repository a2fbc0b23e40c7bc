//! From a lexeme to its value: numbers, quoted texts, keys.

use std::borrow::Cow;
use toml_parser::Source;
use toml_parser::decoder::Encoding;

/// The value of a number that a lexer accepted, in either syntax; whole numbers too large for `f64` round.
pub(crate) fn number(lexeme: &str) -> f64 {
    if let Some(value) = short_number(lexeme.as_bytes()) {
        return value;
    }
    if let Ok(value) = lexeme.parse::<f64>() {
        return value;
    }
    let plain: String = lexeme.chars().filter(|&c| c != '_').collect();
    let (sign, digits) = match plain.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, plain.strip_prefix('+').unwrap_or(&plain)),
    };
    let radix = match digits.get(..2) {
        Some("0x") => 16,
        Some("0o") => 8,
        Some("0b") => 2,
        _ => return plain.parse().unwrap_or(f64::NAN),
    };
    let value = digits[2..]
        .chars()
        .fold(0.0, |value: f64, digit| value * f64::from(radix) + f64::from(digit.to_digit(radix).unwrap_or(0)));
    sign * value
}

/// Digits with a point among them, at most fifteen: their whole number and the power of ten are exact, so that one
/// division rounds as reading the digits themselves would (Clinger 1990).
#[inline]
fn short_number(lexeme: &[u8]) -> Option<f64> {
    const POWERS: [f64; 16] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
    let (negative, digits) = match lexeme.split_first() {
        Some((b'-', digits)) => (true, digits),
        _ => (false, lexeme),
    };
    if digits.is_empty() || digits.len() > 16 {
        return None;
    }
    let (mut whole, mut point) = (0u64, None);
    for (at, &byte) in digits.iter().enumerate() {
        match byte {
            b'0'..=b'9' => whole = whole * 10 + u64::from(byte - b'0'),
            b'.' if point.is_none() => point = Some(at),
            _ => return None,
        }
    }
    let (count, fraction) = match point {
        Some(at) => (digits.len() - 1, digits.len() - 1 - at),
        None => (digits.len(), 0),
    };
    if count == 0 || count > 15 {
        return None;
    }
    let value = whole as f64 / POWERS[fraction];
    Some(if negative { -value } else { value })
}

/// A RON key, text, raw text or character: without quotes and with escapes resolved.
pub(crate) fn ron_text(lexeme: &str) -> Cow<'_, str> {
    if let Some(raw) = lexeme.strip_prefix('r').filter(|raw| raw.starts_with(['#', '"'])) {
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        let inner = raw.get(hashes + 1..raw.len().saturating_sub(hashes + 1));
        return match inner {
            Some(inner) if raw[hashes..].starts_with('"') => Cow::Borrowed(inner),
            _ => Cow::Borrowed(raw.trim_start_matches('#')),
        };
    }
    let Some(quote) = lexeme.chars().next().filter(|c| matches!(c, '"' | '\'')) else {
        return Cow::Borrowed(lexeme);
    };
    let inner = &lexeme[1..];
    let inner = inner.strip_suffix(quote).unwrap_or(inner);
    if inner.contains('\\') { Cow::Owned(resolve_escapes(inner, &mut |_, _| {})) } else { Cow::Borrowed(inner) }
}

/// Resolves the escapes of RON; `fault(start, end)` hears of each one that means nothing, by bytes in `inner`.
pub(crate) fn resolve_escapes(inner: &str, fault: &mut dyn FnMut(usize, usize)) -> String {
    let mut out = String::with_capacity(inner.len());
    let mut rest = inner;
    while let Some(at) = rest.find('\\') {
        out.push_str(&rest[..at]);
        let start = inner.len() - rest.len() + at;
        let escape = &rest[at + 1..];
        let (length, value) = match escape.bytes().next() {
            Some(b'n') => (1, Some('\n')),
            Some(b'r') => (1, Some('\r')),
            Some(b't') => (1, Some('\t')),
            Some(b'0') => (1, Some('\0')),
            Some(b'\\') => (1, Some('\\')),
            Some(b'"') => (1, Some('"')),
            Some(b'\'') => (1, Some('\'')),
            Some(b'x') => {
                let digits = escape.get(1..3).filter(|d| d.bytes().all(|b| b.is_ascii_hexdigit()));
                match digits {
                    Some(digits) => (3, u32::from_str_radix(digits, 16).ok().and_then(char::from_u32)),
                    None => (1, None),
                }
            }
            Some(b'u') => match escape.get(1..).and_then(|e| e.strip_prefix('{')).and_then(|e| e.split_once('}')) {
                Some((digits, _)) if digits.len() <= 6 => {
                    (digits.len() + 3, u32::from_str_radix(digits, 16).ok().and_then(char::from_u32))
                }
                _ => (1, None),
            },
            Some(_) => (escape.chars().next().map_or(0, char::len_utf8), None),
            None => (0, None),
        };
        match value {
            Some(value) => out.push(value),
            None => fault(start, start + 1 + length),
        }
        rest = escape.get(length..).unwrap_or("");
    }
    out.push_str(rest);
    out
}

/// A JSON text or key: without quotes and with escapes resolved.
pub(crate) fn json_text(lexeme: &str) -> Cow<'_, str> {
    let Some(inner) = lexeme.strip_prefix('"') else { return Cow::Borrowed(lexeme) };
    let inner = inner.strip_suffix('"').unwrap_or(inner);
    if inner.contains('\\') { Cow::Owned(resolve_json_escapes(inner, &mut |_, _| {})) } else { Cow::Borrowed(inner) }
}

/// Resolves the escapes of JSON; `fault(start, end)` hears of each one that means nothing, by bytes in `inner`. A
/// character beyond U+FFFF is two of them, a surrogate pair (RFC 8259, section 7).
pub(crate) fn resolve_json_escapes(inner: &str, fault: &mut dyn FnMut(usize, usize)) -> String {
    let unit = |escape: &str| {
        let digits = escape.strip_prefix('u')?.get(..4).filter(|digits| digits.bytes().all(|b| b.is_ascii_hexdigit()));
        digits.and_then(|digits| u32::from_str_radix(digits, 16).ok())
    };
    let mut out = String::with_capacity(inner.len());
    let mut rest = inner;
    while let Some(at) = rest.find('\\') {
        out.push_str(&rest[..at]);
        let start = inner.len() - rest.len() + at;
        let escape = &rest[at + 1..];
        let (length, value) = match escape.bytes().next() {
            Some(b'n') => (1, Some('\n')),
            Some(b'r') => (1, Some('\r')),
            Some(b't') => (1, Some('\t')),
            Some(b'b') => (1, Some('\u{8}')),
            Some(b'f') => (1, Some('\u{c}')),
            Some(sign @ (b'\\' | b'"' | b'/')) => (1, Some(char::from(sign))),
            Some(b'u') => match unit(escape) {
                Some(high @ 0xd800..=0xdbff) => match escape[5..].strip_prefix('\\').and_then(unit) {
                    Some(low @ 0xdc00..=0xdfff) => {
                        (11, char::from_u32(0x1_0000 + ((high - 0xd800) << 10) + (low - 0xdc00)))
                    }
                    _ => (5, None),
                },
                Some(unit) => (5, char::from_u32(unit)),
                None => (1, None),
            },
            Some(_) => (escape.chars().next().map_or(0, char::len_utf8), None),
            None => (0, None),
        };
        match value {
            Some(value) => out.push(value),
            None => fault(start, start + 1 + length),
        }
        rest = escape.get(length..).unwrap_or("");
    }
    out.push_str(rest);
    out
}

/// What looks like the name of a file with backslashes between folders, with slashes.
pub(crate) fn with_slashes(inner: &str) -> Option<String> {
    let (stem, extension) = inner.rsplit_once('.')?;
    let of_file =
        !stem.is_empty() && matches!(extension.len(), 2..=4) && extension.bytes().all(|b| b.is_ascii_alphanumeric());
    let of_path = inner.contains('\\') && !inner.contains("\\\\") && !inner.contains(char::is_control);
    (of_file && of_path).then(|| inner.replace('\\', "/"))
}

/// The encoding of a quoted TOML lexeme.
pub(crate) fn toml_encoding(lexeme: &str) -> Option<Encoding> {
    if !lexeme.starts_with(['"', '\'']) {
        None
    } else if lexeme.starts_with("\"\"\"") {
        Some(Encoding::MlBasicString)
    } else if lexeme.starts_with("'''") {
        Some(Encoding::MlLiteralString)
    } else if lexeme.starts_with('"') {
        Some(Encoding::BasicString)
    } else if lexeme.starts_with('\'') {
        Some(Encoding::LiteralString)
    } else {
        None
    }
}

/// A TOML text without its quotes.
pub(crate) fn toml_text(lexeme: &str) -> Cow<'_, str> {
    if let Some(inner) = simple(lexeme) {
        return Cow::Borrowed(inner);
    }
    let mut out = Cow::Borrowed("");
    let span = toml_parser::Span::new_unchecked(0, lexeme.len());
    let raw = toml_parser::Raw::new_unchecked(lexeme, toml_encoding(lexeme), span);
    let _kind = raw.decode_scalar(&mut out, &mut ());
    out
}

/// A TOML key, bare or quoted.
pub(crate) fn toml_key(lexeme: &str) -> Cow<'_, str> {
    match toml_encoding(lexeme) {
        None => Cow::Borrowed(lexeme),
        Some(_) if simple(lexeme).is_some() => Cow::Borrowed(simple(lexeme).unwrap_or_default()),
        encoding => {
            let mut out = Cow::Borrowed("");
            if let Some(raw) = Source::new(lexeme).get(toml_parser::Span::new_unchecked(0, lexeme.len())) {
                let raw = toml_parser::Raw::new_unchecked(
                    raw.as_str(),
                    encoding,
                    toml_parser::Span::new_unchecked(0, lexeme.len()),
                );
                raw.decode_key(&mut out, &mut ());
            }
            out
        }
    }
}

/// The inside of a one-line text without escapes.
fn simple(lexeme: &str) -> Option<&str> {
    let inner = lexeme.strip_prefix('"')?.strip_suffix('"')?;
    (!inner.bytes().any(|byte| matches!(byte, b'\\' | b'"'))).then_some(inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes_of_json_are_those_of_serde_json() {
        const PIECES: [&str; 20] = [
            "a",
            "é",
            "🐈",
            "\\n",
            "\\r",
            "\\t",
            "\\b",
            "\\f",
            "\\/",
            "\\\\",
            "\\\"",
            "\\u00e9",
            "\\ud83d",
            "\\udc08",
            "\\uD83D\\uDC08",
            "\\u12",
            "\\x41",
            "\\'",
            "\\é",
            "u",
        ];
        let mut state = 5u64;
        let mut below = |count: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) % count as u64) as usize
        };
        for _ in 0..20_000 {
            let inner: String = (0..below(6)).map(|_| PIECES[below(PIECES.len())]).collect();
            let mut faults = 0;
            let text = resolve_json_escapes(&inner, &mut |from, to| {
                assert!(inner.get(from..to).is_some_and(|escape| escape.starts_with('\\')), "{inner:?}");
                faults += 1;
            });
            match serde_json::from_str::<String>(&format!("\"{inner}\"")) {
                Ok(wanted) => assert_eq!((text, faults), (wanted, 0), "{inner:?}"),
                Err(_) => assert!(faults > 0, "{inner:?}"),
            }
        }
    }

    #[test]
    fn short_numbers_have_the_bits_of_long_ones() {
        let mut state = 7u64;
        for _ in 0..200_000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let digits = format!("{:015}", (state >> 11) % 1_000_000_000_000_000);
            let digits = &digits[..1 + (state >> 3) as usize % 15];
            let (whole, fraction) = digits.split_at((state >> 7) as usize % (digits.len() + 1));
            for text in [format!("{whole}.{fraction}"), format!("-{whole}.{fraction}"), digits.to_owned()] {
                if let Some(value) = short_number(text.as_bytes()) {
                    assert_eq!(value.to_bits(), text.parse::<f64>().expect("a number").to_bits(), "{text}");
                } else {
                    assert!(text.parse::<f64>().is_err(), "{text} is short");
                }
            }
        }
        for text in ["", "-", ".", "1e5", "1_000", "1.2.3", "+1", "1234567890123456"] {
            assert_eq!(short_number(text.as_bytes()), None, "{text}");
        }
    }
}
