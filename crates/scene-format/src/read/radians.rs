//! Angles in radians where the language counts in degrees: `pi` within a sine, a cosine or a tangent.

use std::ops::Range;

/// The first of them in an expression: where it stands, and what it is in degrees.
pub(super) fn in_radians(body: &str) -> Option<(Range<usize>, String)> {
    // Hardly any has one, and there may be millions.
    if !body.contains("pi") {
        return None;
    }
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let calls = ["sin(", "cos(", "tan("].into_iter().flat_map(|name| body.match_indices(name));
    let turned = calls.filter_map(|(at, name)| {
        // `asin` gives an angle, and takes none.
        let is_other = body[..at].ends_with(is_name);
        let argument = argument(&body[at + name.len()..]);
        let degrees = in_degrees(argument).filter(|_| !is_other)?;
        Some((at..at + name.len() + argument.len() + 1, format!("{name}{degrees})")))
    });
    turned.min_by_key(|(at, _)| at.start)
}

/// Up to the bracket that closes it.
pub(super) fn argument(text: &str) -> &str {
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
    while let Some(first) = rest.chars().next() {
        let word =
            if is_name(first) { rest.find(|c: char| !is_name(c)).unwrap_or(rest.len()) } else { first.len_utf8() };
        let (word, after) = rest.split_at(word);
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
        let told = |body: &str| in_radians(body).map(|(at, degrees)| (body[at].to_owned(), degrees));
        let of = |written: &str, degrees: &str| Some((written.to_owned(), degrees.to_owned()));
        assert_eq!(told("3*cos(2*pi*i/k) + 1"), of("cos(2*pi*i/k)", "cos(2*180*i/k)"));
        assert_eq!(told("1 + sin((a + pi)/2)"), of("sin((a + pi)/2)", "sin((a + 180)/2)"));
        for right in ["cos(360*i/k)", "asin(pi/4)", "pi*cos(a)", "pi", "sin(pie)", "é"] {
            assert_eq!(told(right), None, "{right}");
        }
    }
}
