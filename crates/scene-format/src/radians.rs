//! Angles in radians where the language counts in degrees: `pi` within a sine, a cosine or a tangent.

use crate::codes;
use crate::diagnostic::{Diagnostic, Span};

/// Warns of the first of them in a scene's own text.
pub(crate) fn warning(text: &str) -> Option<Diagnostic> {
    let bytes = text.as_bytes();
    // Most scenes have no expression.
    if !bytes.contains(&b'=') {
        return None;
    }
    let is_name = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    let mut from = 0;
    while let Some(found) = text[from..].find("\"=") {
        let start = from + found + 2;
        let end = start + text[start..].find(['"', '\n'])?;
        let body = &text[start..end];
        for name in ["sin(", "cos(", "tan("] {
            for (at, _) in body.match_indices(name) {
                // `asin` gives an angle, and takes none.
                let is_other = start + at > 0 && is_name(bytes[start + at - 1]);
                let argument = argument(&body[at + name.len()..]);
                let degrees = in_degrees(argument).filter(|_| !is_other);
                if let Some(degrees) = degrees {
                    let begin = (start + at) as u32;
                    let span = Span { source: 0, start: begin, end: begin + (name.len() + argument.len() + 1) as u32 };
                    let message = format!("`{name}{argument})` has an angle in radians");
                    let warning = Diagnostic::warning(codes::OTHER_SCALE, span, message);
                    let hint = format!("write `{name}{degrees})`: a half turn is 180");
                    return Some(warning.expected("an angle in degrees").hint(hint));
                }
            }
        }
        from = end;
    }
    None
}

/// Up to the bracket that closes it.
fn argument(text: &str) -> &str {
    let mut depth = 0usize;
    let end = text.find(|c: char| {
        match c {
            '(' => depth += 1,
            ')' if depth == 0 => return true,
            ')' => depth -= 1,
            _ => {}
        }
        false
    });
    &text[..end.unwrap_or(text.len())]
}

/// With 180 for every `pi`; `None`: there is none.
fn in_degrees(argument: &str) -> Option<String> {
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut out = String::new();
    let mut found = false;
    let mut rest = argument;
    while !rest.is_empty() {
        let length = rest.find(|c: char| !is_name(c)).unwrap_or(rest.len()).max(1);
        let length = if rest.starts_with(is_name) { length } else { rest.chars().next().map_or(1, char::len_utf8) };
        let (word, after) = rest.split_at(length);
        found |= word == "pi";
        out.push_str(if word == "pi" { "180" } else { word });
        rest = after;
    }
    found.then_some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pi_within_a_sine_is_told() {
        let hint = |text: &str| warning(text).map(|fault| fault.hint);
        let told = hint(r#"(center: ("=3*cos(2*pi*i/k)", 0, 1))"#);
        assert_eq!(told.as_deref(), Some("write `cos(2*180*i/k)`: a half turn is 180"));
        assert!(hint(r#"a: "=1 + sin((a + pi)/2)""#).is_some_and(|hint| hint.contains("sin((a + 180)/2)")));
        for right in [r#""=cos(360*i/k)""#, r#""=asin(pi/4)""#, r#""=pi*cos(a)""#, "cos(pi)", r#""=sin(pie)""#, "\"=é"]
        {
            assert_eq!(hint(right), None, "{right}");
        }
    }
}
