//! What a closing bracket that does not match means: a typo, a bracket left open, or one too many.

use super::span;
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};

/// A bracket that is open.
#[derive(Clone, Copy, Debug)]
pub(super) struct Open {
    /// The bracket that should stand there.
    pub bracket: u8,
    /// The bracket that stands there.
    pub written: u8,
    pub at: usize,
    /// Where its line begins, and how far that is indented.
    pub line: usize,
    pub indent: usize,
}

/// What to do with a closing bracket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fate {
    /// It closes the innermost bracket.
    Closes,
    /// It was meant to close the innermost bracket, but is of another kind.
    Typo,
    /// It closes an outer bracket: the innermost one was left open.
    ClosesOuter,
    /// It closes nothing.
    Stray,
}

pub(super) fn closer_of(bracket: u8) -> u8 {
    match bracket {
        b'(' => b')',
        b'[' => b']',
        _ => b'}',
    }
}

impl Open {
    /// Whether a bracket closes this one: as it should be, or as it is written.
    fn closed_by(&self, close: u8) -> bool {
        closer_of(self.bracket) == close || closer_of(self.written) == close
    }
}

/// The longest line that is weighed when a bracket does not match; a file in one line must not take quadratic time.
const WEIGHED_BYTES: usize = 400;

/// How badly the rest of a line fits brackets that are open: mismatches count, and so does what this line leaves open.
fn misfit(rest: &str, open: &[Open], line: usize) -> usize {
    let base = open.iter().filter(|open| open.at < line).count();
    let mut stack: Vec<u8> = open.iter().map(|open| open.bracket).collect();
    let mut faults = 0;
    for byte in rest.bytes().take(WEIGHED_BYTES).take_while(|&byte| byte != b'\n') {
        match byte {
            b'(' | b'[' | b'{' => stack.push(byte),
            b')' | b']' | b'}' => match stack.pop() {
                // Closing what an earlier line opened is possible, but not likely in the middle of a line.
                Some(bracket) if closer_of(bracket) == byte => faults += usize::from(stack.len() < base),
                _ => faults += 2,
            },
            _ => {}
        }
    }
    faults + 2 * stack.len().saturating_sub(base)
}

/// Decides about the closing bracket `close` at `at`, while `open` are open.
pub(super) fn fate(text: &str, open: &[Open], at: usize, close: u8) -> Fate {
    let Some((innermost, outer_ones)) = open.split_last() else { return Fate::Stray };
    if innermost.closed_by(close) {
        return Fate::Closes;
    }
    let outer = outer_ones.iter().rposition(|open| open.closed_by(close));
    let between = text.as_bytes().get(innermost.at..at).unwrap_or_default();
    let same_line = between.len() <= WEIGHED_BYTES && !between.contains(&b'\n');
    let Some(outer) = outer else { return if same_line { Fate::Typo } else { Fate::Stray } };
    if !same_line {
        return Fate::ClosesOuter;
    }
    // All are possible: take what lets the rest of the line fit best.
    let line = innermost.line;
    let rest = &text[at + 1..];
    let implied = outer_ones.len() - outer;
    let typo = misfit(rest, outer_ones, line);
    let closes_outer = misfit(rest, &open[..outer], line) + 2 * implied.saturating_sub(1);
    let stray = misfit(rest, open, line);
    if stray < typo.min(closes_outer) {
        Fate::Stray
    } else if typo <= closes_outer {
        Fate::Typo
    } else {
        Fate::ClosesOuter
    }
}

/// Whether the closing bracket at `at` stands behind another one at the end of its line, and the next line begins with
/// a field's name, deeper than `indent`.
pub(super) fn goes_on(text: &str, at: usize, indent: usize) -> bool {
    if !text[..at].ends_with([')', ']', '}']) {
        return false;
    }
    let rest = text[at + 1..].strip_prefix(',').unwrap_or(&text[at + 1..]);
    let Some((end, next)) = rest.split_once('\n') else { return false };
    let next = next.lines().next().unwrap_or("");
    let name = next.trim_start();
    let length = name.bytes().take_while(|byte| byte.is_ascii_alphanumeric() || *byte == b'_').count();
    end.trim().is_empty() && next.len() - name.len() > indent && length > 0 && name[length..].starts_with(':')
}

/// `close` at `at` stands where the innermost bracket should be closed.
pub(super) fn wrong_closer(source: u16, open: Open, at: usize, close: u8) -> Diagnostic {
    let right = char::from(closer_of(open.bracket));
    let found = span(source, at, at + 1);
    let message = format!("`{}` is closed by `{}`", char::from(open.written), char::from(close));
    let mut fault = Diagnostic::error(codes::STRAY_BRACKET, found, message)
        .expected(format!("`{right}`"))
        .label(span(source, open.at, open.at + 1), "opened here");
    fault.edit = Some(Edit { span: found, replacement: right.to_string() });
    fault
}

/// A bracket of the wrong kind, which `close` closes at `at`: `Sphere { .. }`, `objects: { .. }`, `materials: [ .. ]`.
pub(super) fn wrong_kind(text: &str, source: u16, open: Open, name: &str, at: usize) -> Diagnostic {
    let (begin, end) = (char::from(open.bracket), char::from(closer_of(open.bracket)));
    let found = span(source, open.at, open.at + 1);
    let (message, expected) = match open.bracket {
        b'(' if name.is_empty() => {
            ("the numbers of a vector stand in round brackets".to_owned(), "(x, y, z)".to_owned())
        }
        b'(' => (format!("the fields of `{name}` stand in round brackets"), format!("{name}(..)")),
        b'[' => ("the items of a list stand in square brackets".to_owned(), "[a, b, c]".to_owned()),
        _ => ("names with their values stand in braces".to_owned(), "{ \"name\": value }".to_owned()),
    };
    let mut fault = Diagnostic::error(codes::WRONG_TYPE, found, message).expected(expected);
    fault.edit = if text.as_bytes().get(at) == Some(&closer_of(open.bracket)) {
        Some(Edit { span: found, replacement: begin.to_string() })
    } else {
        let inner = text.get(open.at + 1..at).unwrap_or("");
        Some(Edit { span: span(source, open.at, at + 1), replacement: format!("{begin}{inner}{end}") })
    };
    fault.hint(format!("write `{begin}` and `{end}`"))
}

/// A closing bracket without an opening one.
pub(super) fn stray(text: &str, source: u16, at: usize) -> Diagnostic {
    let found = span(source, at, at + 1);
    // Between two commas one of them goes with it.
    let after = text[at + 1..].trim_start();
    let comma = after.starts_with(',') && text[..at].trim_end().ends_with(',');
    let end = if comma { text.len() - after.len() + 1 } else { at + 1 };
    let mut fault = Diagnostic::error(codes::STRAY_BRACKET, found, "this bracket closes nothing");
    fault.hint = "remove it, or open one before it".to_owned();
    fault.edit = Some(Edit { span: span(source, at, end), replacement: String::new() });
    fault
}

/// A bracket that is still open at `noticed` (`None`: at the end of the file).
pub(super) fn unclosed(source: u16, open: Open, noticed: Option<usize>) -> Diagnostic {
    let close = char::from(closer_of(open.bracket));
    let message = format!("this `{}` is never closed", char::from(open.written));
    let fault = Diagnostic::error(codes::UNCLOSED_BRACKET, span(source, open.at, open.at + 1), message)
        .expected(format!("`{close}`"));
    match noticed {
        Some(at) => fault.label(span(source, at, at + 1), format!("`{close}` is missing before this")),
        None => fault.hint(format!("write `{close}` where it ends; the file ends before that")),
    }
}
