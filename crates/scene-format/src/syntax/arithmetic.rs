//! Arithmetic without quotes, `1/3` or `sqrt(2)`, where an expression is a text: `"=1/3"`. And numbers with signs of
//! other languages: `50%`.

use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::expression::{self, Named, Value};
use crate::syntax::ron_literal::number_kind;
use std::borrow::Cow;

/// Signs that go on an expression after a number.
pub(super) const OPERATORS: &[u8] = b"+-*/^%";

/// The length of the arithmetic that begins at `start`, on the same line; `None` where there is none.
pub(super) fn ahead(text: &str, start: usize) -> Option<usize> {
    let line = super::line_ahead(text, start);
    let bytes = line.as_bytes();
    let word = line.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(line.len());
    let chooses = line.contains('?');
    let known = expression::is_known(&line[..word]) && !matches!(&line[..word], "true" | "false");
    let led = !known && reckons(&line[word..]) && expression::is_name(&line[..word]);
    let named = known || led || chooses && expression::is_name(&line[..word]);
    if !named && !bytes.first().is_some_and(|byte| byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.')) {
        return None;
    }
    let (mut depth, mut end) = (0usize, line.len());
    for (at, &byte) in bytes.iter().enumerate() {
        match byte {
            b'(' => depth += 1,
            b')' if depth > 0 => depth -= 1,
            b',' if depth > 0 => {}
            b')' | b',' | b']' | b'}' | b'#' | b'\r' => {
                end = at;
                break;
            }
            b'/' if matches!(bytes.get(at + 1), Some(b'/' | b'*')) => {
                end = at;
                break;
            }
            // `0 -1` is rather two numbers without their comma.
            b'+' | b'-'
                if !led && at > 0 && bytes[at - 1] == b' ' && bytes.get(at + 1).is_none_or(|next| *next != b' ') =>
            {
                return None;
            }
            b'+' | b'-' | b'*' | b'/' | b'^' | b'%' | b'.' | b'_' | b' ' => {}
            b'?' | b':' | b'<' | b'>' | b'=' | b'!' | b'&' | b'|' if chooses => {}
            byte if byte.is_ascii_alphanumeric() => {}
            _ => return None,
        }
    }
    let body = line[..end].trim_end();
    if chooses {
        return (depth == 0 && choice(body).is_some()).then_some(body.len());
    }
    // `a/b` and `my-file` are rather texts, unless they are made of names that the scene gives.
    // `a -b` has a sign before a name: no text has.
    let signed = |body: &str| {
        body.match_indices(" -").any(|(at, _)| body[at + 2..].starts_with(|c: char| c.is_ascii_alphabetic()))
    };
    let sure =
        |body: &str| body.contains(['*', '^', '%']) || body.contains(" + ") || body.contains(" - ") || signed(body);
    if led && !sure(body) && !names_are_given(text, body) {
        return None;
    }
    let negated = body.strip_prefix(['-', '+']).is_some_and(|rest| names_are_given(text, rest));
    // `-(3)`
    let negated = negated || body.starts_with("-(") || body.starts_with("+(");
    let is_plain =
        number_kind(body).is_some() || !known && !negated && !body[1..].bytes().any(|byte| OPERATORS.contains(&byte));
    (!is_plain && depth == 0 && is_expression(&ours(body))).then_some(body.len())
}

/// Where the brackets around arithmetic begin and end, `(h*60)`, which are no vector's, with what goes on behind them.
pub(super) fn with_brackets(text: &str, start: usize, end: usize) -> Option<(usize, usize)> {
    let before = text[..start].trim_end_matches(' ').strip_suffix('(')?;
    if before.ends_with(|c: char| c.is_alphanumeric() || c == '_') {
        return None;
    }
    let after = text[end..].trim_start_matches(' ').strip_prefix(')')?;
    let (open, close) = (before.len(), text.len() - after.len());
    let whole = expression_ahead(&text[open..]).filter(|&length| open + length >= close);
    Some(whole.map_or((start, end), |length| if open + length > close { (open, open + length) } else { (open, close) }))
}

/// An expression between quotes and what goes on behind them, ` + 1`, as one; with the length of that.
pub(super) fn joined(inner: &str, rest: &str) -> Option<(String, usize)> {
    if !reckons(rest) {
        return None;
    }
    let line = super::line_ahead(rest, 0);
    // Any name stands for what is between the quotes.
    let length = expression_ahead(&format!("x{line}")).filter(|&length| length > 1)? - 1;
    let simple = inner.bytes().all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.'));
    let inner = if simple { inner.to_owned() } else { format!("({inner})") };
    Some((format!("{inner}{}", &line[..length]), length))
}

/// Arithmetic with the constants and functions of other languages that a line begins with, `Math.PI/4`, in ours, and
/// its length; `None` where there is none.
pub(super) fn of_languages(line: &str) -> Option<(String, usize)> {
    let mut depth = 0usize;
    let end = line.find(|sign| {
        match sign {
            '(' => depth += 1,
            ')' if depth > 0 => depth -= 1,
            ')' | ']' | '}' => return true,
            ',' => return depth == 0,
            _ => {}
        }
        false
    });
    let text = line[..end.unwrap_or(line.len())].trim_end();
    const HEADS: [&str; 4] = ["Math.", "math.", "numpy.", "np."];
    let mut body = HEADS.iter().fold(text.to_owned(), |body, head| body.replace(head, ""));
    body = body.replace("M_PI", "pi");
    let words: Vec<&str> = body.split_inclusive(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
    let body: String =
        words.iter().map(|word| word.replacen("PI", "pi", usize::from(word.starts_with("PI")))).collect();
    let value = expression::evaluate(&body, &mut |_| Named::Unknown(Vec::new()));
    (body != text && value.is_ok()).then_some((body, text.len()))
}

/// `if a then b else c` as an expression, and its length.
pub(super) fn conditional(line: &str) -> Option<(String, usize)> {
    let inner = line.strip_prefix("if ")?;
    let (condition, rest) = inner.split_once(" then ")?;
    let (yes, rest) = rest.split_once(" else ")?;
    let no = &rest[..expression_ahead(rest)?];
    let body = format!("if({}, {}, {})", condition.trim(), yes.trim(), no.trim());
    is_expression(&body).then(|| (body, line.len() - rest.len() + no.len()))
}

/// Whether a comparison follows on a name whose line chooses by it: ` > 1 ? 2 : 3`.
pub(super) fn chooses(after: &str) -> bool {
    let is_comparison = after.trim_start_matches(' ').starts_with(['<', '>', '?', '!', '=']);
    is_comparison && super::line_ahead(after, 0).split_once('?').is_some_and(|(_, values)| values.contains(':'))
}

/// Whether an operator follows on a name: ` * 2`.
pub(super) fn reckons(after: &str) -> bool {
    let after = after.trim_start_matches(' ');
    let comment = after.starts_with("//") || after.starts_with("/*");
    after.bytes().next().is_some_and(|byte| OPERATORS.contains(&byte)) && !comment
}

/// Whether an expression has names, and all of them are names that the scene gives to something.
fn names_are_given(text: &str, body: &str) -> bool {
    let (mut given, mut any) = (true, false);
    let value = expression::evaluate(body, &mut |name| {
        given = given && is_given(text, name);
        any = true;
        Named::Value(Value::Number(1.0))
    });
    given && any && !matches!(value, Err(Some(fault)) if fault.code != codes::EXPRESSION_NOT_FINITE)
}

/// Whether a scene seems to give a name to something: a var, or the index of a `Repeat`.
pub(super) fn is_given(text: &str, name: &str) -> bool {
    text.contains(&format!("\"{name}\""))
        || text.contains(&format!("{name} ="))
        || name == "i" && text.contains("Repeat")
}

/// Arithmetic with the operators of other languages, in ours: `2**3`, `a < 1 ? 2 : 3`.
fn ours(body: &str) -> Cow<'_, str> {
    match choice(body) {
        Some(choice) => Cow::Owned(choice),
        None if body.contains("**") => Cow::Owned(body.replace("**", "^")),
        None => Cow::Borrowed(body),
    }
}

/// `if(c, a, b)` for `c ? a : b`.
fn choice(body: &str) -> Option<String> {
    let (condition, values) = body.split_once('?')?;
    let (a, b) = values.split_once(':')?;
    let parts = [condition, a, b].map(str::trim);
    parts.iter().all(|part| is_expression(part)).then(|| format!("if({})", parts.join(", ")))
}

/// Whether a text is written as expressions are, whatever its names stand for.
fn is_expression(body: &str) -> bool {
    let value = expression::evaluate(body, &mut |_| Named::Value(Value::Number(1.0)));
    !matches!(value, Err(Some(fault)) if fault.code == codes::EXPRESSION_SYNTAX)
}

/// The length of the expression that `rest`, what follows on a `=`, begins with, up to a quote, a comma or a bracket
/// that closes, on the same line; `None` where there is none.
pub(super) fn expression_ahead(rest: &str) -> Option<usize> {
    let line = super::line_ahead(rest, 0);
    let (mut depth, mut end) = (0usize, line.len());
    for (at, byte) in line.bytes().enumerate() {
        match byte {
            b'(' | b'[' => depth += 1,
            b')' | b']' if depth > 0 => depth -= 1,
            b',' if depth > 0 => {}
            b'"' | b',' | b')' | b']' | b'}' | b'\r' => {
                end = at;
                break;
            }
            b'/' if line[at..].starts_with("//") => {
                end = at;
                break;
            }
            _ => {}
        }
    }
    let body = line[..end].trim_end();
    is_expression(body).then_some(body.len())
}

/// Whether a text that was closed by the quote of the next one is rather an expression without its last quote. `inner`:
/// what stands between the quotes; `after`: what follows on the second.
pub(super) fn lost_its_quote(inner: &str, after: &str) -> bool {
    let Some(body) = inner.strip_prefix('=') else { return false };
    let after = super::line_ahead(after, 0).trim_start();
    !after.is_empty()
        && !after.starts_with([',', ')', ']', '}', ':'])
        && !after.starts_with("//")
        && expression_ahead(body).is_some_and(|length| length < body.trim_end().len())
}

/// What is said of an expression whose quotes are missing: `=2*r`, of which `body` follows on the sign.
pub(super) fn without_quotes(body: &str, span: Span) -> Diagnostic {
    let mended = format!("\"={body}\"");
    let mut fault = Diagnostic::error(codes::BARE_EXPRESSION, span, "an expression stands between quotes")
        .expected("a text that begins with `=`")
        .hint(format!("write {mended}"));
    fault.edit = Some(Edit { span, replacement: mended });
    fault
}

/// What is said of arithmetic without quotes. An edit is offered where all its names are known.
pub(super) fn fault(text: &str, body: &str, span: Span) -> Diagnostic {
    let body = &*ours(body);
    let mended = format!("\"={body}\"");
    let mut fault = Diagnostic::error(codes::BARE_EXPRESSION, span, "arithmetic stands between quotes here")
        .expected("a number, or an expression: a text that begins with `=`")
        .hint(format!("write {mended}"));
    let mut known = true;
    let value = expression::evaluate(body, &mut |name| {
        known = known && is_given(text, name);
        Named::Value(Value::Number(1.0))
    });
    // What a name stands for may make it finite.
    if known && !matches!(value, Err(Some(fault)) if fault.code != codes::EXPRESSION_NOT_FINITE) {
        fault.edit = Some(Edit { span, replacement: mended });
    }
    fault
}

/// `50%` and `35°`, of which `number` is the number: what is said, and what is meant.
pub(super) fn with_sign(number: &str, sign: char, span: Span) -> Option<Diagnostic> {
    let value = super::decode::number(number);
    if number_kind(number).is_none() || !value.is_finite() {
        return None;
    }
    let (mended, why) = match sign {
        // Shortest digits that read back: 0.07, where 7.0 / 100.0 gives 0.07 and 0.07 * 100 does not.
        '%' if value > 100.0 => (format!("{}", value / 100.0), "all of it is 1"),
        '%' => (format!("{}", value / 100.0), "shares go from 0 to 1"),
        '°' => (number.to_owned(), "angles are in degrees without a sign"),
        _ => return None,
    };
    let mut fault = Diagnostic::error(codes::BAD_NUMBER, span, format!("`{number}{sign}` is not a number"))
        .expected("a number such as 3, -0.25, 1.5e3 or 1_000")
        .hint(format!("write {mended}: {why}"));
    fault.edit = Some(Edit { span, replacement: mended });
    Some(fault)
}

/// `<0, 1, 6>` at the beginning of `rest`: its length and the numbers.
pub(super) fn angle_brackets(rest: &str) -> Option<(usize, &str)> {
    let line = super::line_ahead(rest, 0);
    let close = line.strip_prefix('<')?.find('>')? + 1;
    let inner = line[1..close].trim();
    let numbers = inner.split(',').all(|number| number_kind(number.trim()).is_some());
    numbers.then_some((close + 1, inner))
}
