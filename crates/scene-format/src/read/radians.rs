//! Angles in radians where the language counts in degrees: `pi` within a sine, a cosine or a tangent.

use std::ops::Range;

/// An angle in radians within an expression.
pub(super) struct Radians {
    /// Where the call stands that takes it.
    pub at: Range<usize>,
    /// The call with degrees.
    pub degrees: String,
    /// The name of the var that is in radians, where `pi` stands there.
    pub by: Option<String>,
}

/// The first of them in an expression. `is_radians`: of the names of vars.
pub(super) fn in_radians(body: &str, is_radians: &dyn Fn(&str) -> bool) -> Option<Radians> {
    let calls = ["sin(", "cos(", "tan("].into_iter().flat_map(|name| body.match_indices(name));
    let turned = calls.filter_map(|(at, name)| {
        // `asin` gives an angle, and takes none.
        let is_other = body[..at].ends_with(is_name);
        let argument = argument(&body[at + name.len()..]);
        let (inner, by) = in_degrees(argument, is_radians).filter(|_| !is_other)?;
        let at = at..at + name.len() + argument.len() + 1;
        Some(Radians { at, degrees: format!("{name}{inner})"), by })
    });
    turned.min_by_key(|radians| radians.at.start)
}

fn is_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// Whether what an expression comes to is in radians: `pi` is in it, or what is, outside of calls. What is divided by
/// `pi` is not.
pub(super) fn holds_radians(body: &str, is_radians: &dyn Fn(&str) -> bool) -> bool {
    let mut plain = String::new();
    let mut rest = body;
    while let Some(open) = rest.find('(') {
        let (before, inner) = (&rest[..open], argument(&rest[open + 1..]));
        plain.push_str(before);
        if !before.ends_with(is_name) {
            plain.push_str(inner);
        }
        plain.push(' ');
        rest = rest.get(open + inner.len() + 2..).unwrap_or("");
    }
    plain.push_str(rest);
    in_degrees(&plain, is_radians).is_some()
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

/// With 180 for every `pi`; where a name stands for radians, it turned into degrees, and the name. `None`: there is
/// none, or it is turned already.
fn in_degrees(argument: &str, is_radians: &dyn Fn(&str) -> bool) -> Option<(String, Option<String>)> {
    let mut out = String::new();
    let (mut found, mut by) = (false, None);
    let mut rest = argument;
    while let Some(first) = rest.chars().next() {
        let word =
            if is_name(first) { rest.find(|c: char| !is_name(c)).unwrap_or(rest.len()) } else { first.len_utf8() };
        let (word, after) = rest.split_at(word);
        if word == "pi" && out.trim_end_matches(['(', ' ']).ends_with('/') {
            return None;
        }
        found |= word == "pi";
        if by.is_none() && is_name(first) && is_radians(word) {
            by = Some(word.to_owned());
        }
        out.push_str(if word == "pi" { "180" } else { word });
        rest = after;
    }
    if found {
        return Some((out, None));
    }
    let by = by?;
    let is_one = argument.trim().chars().all(is_name);
    let turned = if is_one { format!("{}*180/pi", argument.trim()) } else { format!("({argument})*180/pi") };
    Some((turned, Some(by)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pi_within_a_sine_is_told() {
        let told = |body: &str| {
            let is_radians = |name: &str| matches!(name, "w" | "phase");
            in_radians(body, &is_radians).map(|radians| (body[radians.at].to_owned(), radians.degrees))
        };
        let of = |written: &str, degrees: &str| Some((written.to_owned(), degrees.to_owned()));
        assert_eq!(told("3*cos(2*pi*i/k) + 1"), of("cos(2*pi*i/k)", "cos(2*180*i/k)"));
        assert_eq!(told("1 + sin((a + pi)/2)"), of("sin((a + pi)/2)", "sin((a + 180)/2)"));
        assert_eq!(told("2*sin(w)"), of("sin(w)", "sin(w*180/pi)"));
        assert_eq!(told("cos(k*phase + 1)"), of("cos(k*phase + 1)", "cos((k*phase + 1)*180/pi)"));
        let turned = ["sin(w*180/pi)", "sin(a*180/pi)", "sin(180*w/(pi))", "sin(ww)"];
        for right in turned.into_iter().chain(["cos(360*i/k)", "asin(pi/4)", "pi*cos(a)", "pi", "sin(pie)", "é"]) {
            assert_eq!(told(right), None, "{right}");
        }
    }

    #[test]
    fn a_var_is_in_radians_where_pi_is_a_factor() {
        let holds = |body: &str| holds_radians(body, &|name| name == "w");
        assert!(["2*pi*time", "(pi + 1)/2", "3*w", "2*(a + w)", "max(a, b)*pi"].into_iter().all(holds));
        assert!(!["180/pi", "sin(pi*a)", "sqrt(w)", "a*180/(pi)", "3", "ww", "("].into_iter().any(holds));
    }
}
