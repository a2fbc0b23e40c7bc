//! Numbers parted by commas where one value stands: a vector without its brackets, or a decimal comma.

use super::{Syntax, span};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::tree::{Builder, Kind};

/// What follows the number that has just been read as the node at `mark`, ending at `at`: when more numbers do, they
/// are reported with it as one fault, and the node is broken. Gives the end of the last one.
pub(super) fn report(
    text: &str,
    syntax: Syntax,
    mark: usize,
    at: usize,
    builder: &mut Builder,
) -> Option<(usize, Diagnostic)> {
    if !matches!(text.as_bytes().get(at), Some(b',' | b' ' | b'\t')) {
        return None;
    }
    let first = builder.nodes.get(mark)?;
    if !matches!(first.kind, Kind::Integer | Kind::Float) || builder.nodes.len() != mark + 1 {
        return None;
    }
    let start = first.start as usize;
    let mut end = at;
    let mut count = 1;
    while let Some(next) = next_number(&text[end..]) {
        end += next;
        count += 1;
    }
    // `0 1.5 4`: without commas, too.
    let blanks = count == 1 && text.as_bytes().get(at) != Some(&b',');
    while let Some(next) = next_after_blank(&text[end..]).filter(|_| blanks) {
        end += next;
        count += 1;
    }
    if blanks && count < 3 {
        return None;
    }
    let found = span(builder.source, start, end);
    let numbers = text.get(start..end)?;
    let fault = match count {
        1 => return None,
        2 => {
            // `1, 5` is more likely a value whose name is missing; that is for the reader of fields to say.
            let (whole, fraction) = numbers.split_once(',')?;
            if first.kind != Kind::Integer || !fraction.bytes().all(|byte| byte.is_ascii_digit()) {
                return None;
            }
            let mended = format!("{whole}.{fraction}");
            // `1,024`: whether that is a thousand nobody knows.
            let of_thousands = fraction.len() == 3 && !whole.starts_with('0');
            let mut fault = Diagnostic::error(codes::BAD_NUMBER, found, format!("`{numbers}` is not a number"))
                .expected(match syntax {
                    Syntax::Json => "a number such as 3, -0.25 or 1.5e3",
                    Syntax::Ron | Syntax::Toml => "a number such as 3, -0.25, 1.5e3 or 1_000",
                })
                .hint(match of_thousands {
                    true => format!("numbers have no commas: write {whole}{fraction}, or {mended}"),
                    false => format!("numbers have a decimal point: {mended}"),
                });
            fault.edit = (!of_thousands).then_some(Edit { span: found, replacement: mended });
            fault
        }
        _ => {
            let (open, close) = if syntax == Syntax::Ron { ('(', ')') } else { ('[', ']') };
            let mut fault = Diagnostic::error(codes::NO_BRACKETS, found, "these numbers stand without brackets")
                .expected(format!("a vector: {open}x, y, z{close}"));
            if count == 3 {
                let parted: Vec<&str> = numbers.split([',', ' ', '\t']).filter(|number| !number.is_empty()).collect();
                let mended = format!("{open}{}{close}", parted.join(", "));
                fault = fault.hint(format!("write {mended}"));
                fault.edit = Some(Edit { span: found, replacement: mended });
            }
            fault
        }
    };
    builder.nodes.truncate(mark);
    builder.leaf(Kind::Broken, start, end);
    Some((end, fault))
}

/// The length of a comma and a number on the same line, with what ends an entry after them.
fn next_number(rest: &str) -> Option<usize> {
    const BLANK: [char; 2] = [' ', '\t'];
    let number = rest.trim_start_matches(BLANK).strip_prefix(',')?.trim_start_matches(BLANK);
    if !number.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.')) {
        return None;
    }
    let of_number = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '+' | '.' | '_');
    let after = number.trim_start_matches(of_number);
    let ends = after.trim_start_matches(BLANK);
    let ended = ends.is_empty() || ends.starts_with([',', ')', ']', '}', '\r', '\n', '#', '/']);
    ended.then(|| rest.len() - after.len())
}

/// The length of blanks and a number on the same line, with what ends an entry after it, or another such number.
fn next_after_blank(rest: &str) -> Option<usize> {
    let number = rest.trim_start_matches([' ', '\t']);
    let begins = |text: &str| text.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'));
    if number.len() == rest.len() || !begins(number) {
        return None;
    }
    let after = number.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.' | 'e' | '_'));
    let ends = after.trim_start_matches([' ', '\t']);
    let another = ends.len() < after.len() && begins(ends);
    let ended = another || ends.is_empty() || ends.starts_with([',', ')', ']', '}', '\r', '\n', '#', '/']);
    ended.then(|| rest.len() - after.len())
}
