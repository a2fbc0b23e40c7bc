//! `random(-1, 1)`: a range in other programs; here two seeds, that give one number and always the same.

use super::radians::argument;
use std::ops::Range;

/// The first of them in an expression: where it stands, and what a number from that range is, another for each i.
pub(super) fn as_range(body: &str) -> Option<(Range<usize>, String)> {
    const NAME: &str = "random(";
    // Hardly any has one, and there may be millions.
    if !body.contains(NAME) {
        return None;
    }
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    body.match_indices(NAME).find_map(|(at, name)| {
        let argument = argument(&body[at + name.len()..]);
        let (low, high) = argument.split_once(',')?;
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let (low, high) = (number(low)?, number(high)?);
        if body[..at].ends_with(is_name) || low >= high {
            return None;
        }
        let spread = if high - low == 1.0 { "random(i)".to_owned() } else { format!("{}*random(i)", high - low) };
        let mended = match low {
            0.0 => spread,
            _ if low < 0.0 => format!("{spread} - {}", -low),
            _ => format!("{spread} + {low}"),
        };
        Some((at..at + name.len() + argument.len() + 1, mended))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_told() {
        let told = |body: &str| as_range(body).map(|(at, mended)| (body[at].to_owned(), mended));
        let of = |written: &str, mended: &str| Some((written.to_owned(), mended.to_owned()));
        assert_eq!(told("3 + random(-1, 1)/2"), of("random(-1, 1)", "2*random(i) - 1"));
        assert_eq!(told("random(0,1)"), of("random(0,1)", "random(i)"));
        assert_eq!(told("random(2, 4.5)"), of("random(2, 4.5)", "2.5*random(i) + 2"));
        for right in ["random(i)", "random(i, 1)", "random(3, 1)", "brandom(0, 1)", "random(1)", "random(0, 1, 2)"] {
            assert_eq!(told(right), None, "{right}");
        }
    }
}
