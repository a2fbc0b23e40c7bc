//! What a closing bracket that does not match means: a typo, a bracket left open, or one too many.

use super::span;
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};

/// Faults of texts whose brackets do not match.
pub(super) const CODES: [codes::Code; 3] = [codes::UNCLOSED_BRACKET, codes::STRAY_BRACKET, codes::TEXT_AFTER_END];

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
fn goes_on(text: &str, at: usize, indent: usize) -> bool {
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

/// The brackets of a line from its first byte on, outside texts and comments, as (byte, bracket).
fn brackets_of(line: &str) -> impl Iterator<Item = (usize, u8)> {
    let (mut quoted, bytes) = (false, line.as_bytes());
    let end = bytes.iter().position(|byte| *byte == b'\n').unwrap_or(bytes.len()).min(WEIGHED_BYTES);
    let code = (0..end).take_while(move |&at| !bytes[at..].starts_with(b"//") || quoted_before(bytes, at));
    code.filter_map(move |at| {
        quoted ^= bytes[at] == b'"';
        let bracket = matches!(bytes[at], b'(' | b')' | b'[' | b']' | b'{' | b'}');
        (bracket && !quoted).then_some((at, bytes[at]))
    })
}

/// Whether a text is open before a byte of a line.
fn quoted_before(line: &[u8], at: usize) -> bool {
    line[..at].iter().filter(|byte| **byte == b'"').count() % 2 == 1
}

/// Where the first bracket stands that closes more than the rest of a line has opened.
fn excess(rest: &str) -> Option<(usize, u8)> {
    let mut depth = 0usize;
    for (at, bracket) in brackets_of(rest) {
        match (bracket, depth) {
            (b'(' | b'[' | b'{', _) => depth += 1,
            (_, 0) => return Some((at, bracket)),
            _ => depth -= 1,
        }
    }
    None
}

/// The rest of a line that goes on with `, name:`.
fn with_next_field(rest: &str) -> Option<&str> {
    let name = rest.strip_prefix(',')?.trim_start_matches([' ', '\t']);
    let length = name.bytes().take_while(|byte| byte.is_ascii_alphanumeric() || *byte == b'_').count();
    (length > 0 && name[length..].starts_with(':')).then_some(name)
}

/// Whether the round bracket closed at `at`, which stands in `outer` and was opened on the line of `at`, is closed too
/// early: the line goes on with a field, and closes a round bracket that it has not opened. In a list or in braces
/// no field can stand; in fields that is so if the next line is no further out than this one, by its `indent`.
fn too_early(text: &str, at: usize, outer: u8, indent: usize) -> bool {
    let rest = &text[at + 1..];
    let Some((end, b')')) = with_next_field(rest).and_then(|_| excess(rest)) else { return false };
    let after = rest[end + 1..].strip_prefix(',').unwrap_or(&rest[end + 1..]);
    let Some((line, next)) = after.split_once('\n') else { return outer != b'(' };
    let next = next.lines().find(|line| !line.trim().is_empty()).unwrap_or("");
    let word = next.trim_start();
    let goes_on = next.len() - word.len() >= indent && !word.starts_with([')', ']', '}']);
    outer != b'(' || goes_on && (line.trim().is_empty() || line.trim_start().starts_with("//"))
}

/// Whether the closing bracket at `at` ends a line, and the next one begins with a bracket that closes `open`, as far
/// in as the line that opened it.
fn closed_next(text: &str, at: usize, open: Open) -> bool {
    let rest = text[at + 1..].strip_prefix(',').unwrap_or(&text[at + 1..]);
    let Some((end, next)) = rest.split_once('\n') else { return false };
    let line = next.lines().next().unwrap_or("");
    let first = line.trim_start();
    end.trim().is_empty()
        && first.starts_with(char::from(closer_of(open.bracket)))
        && line.len() - first.len() == open.indent
}

/// Whether the innermost bracket is closed too early at `at`: its fields go on, on this line or on the next, or the
/// next line closes it again. The line begins at `line` and is indented by `indent`.
pub(super) fn closes_too_early(text: &str, open: &[Open], at: usize, line: usize, indent: usize) -> bool {
    let Some((inner, outer)) = open.split_last().filter(|(inner, _)| inner.bracket == b'(') else { return false };
    let outer = outer.last();
    if inner.line < line {
        return outer.map_or(0, |outer| outer.indent) < inner.indent && closed_next(text, at, *inner);
    }
    let first = outer.is_none_or(|outer| outer.line < line);
    let early = |outer: &Open| (first || outer.bracket != b'(') && too_early(text, at, outer.bracket, indent);
    first && goes_on(text, at, inner.indent) || outer.is_some_and(early)
}

/// Where the fields end that stand behind a kind which a line has closed before them, in its list: `Box(size: 2),
/// name: "a"`. `None`: it is not so, or the line has a bracket that does not fit.
pub(super) fn fields_behind(text: &str, at: usize) -> Option<usize> {
    let before = text[..at].trim_end_matches([' ', '\t']).strip_suffix(',')?;
    let rest = before.ends_with(')').then(|| &text[before.len()..])?;
    with_next_field(rest)?;
    let line = super::line_ahead(text, at);
    let line = line.split_once(" //").map_or(line, |(code, _)| code).trim_end().trim_end_matches(',');
    let opened = brackets_of(line).filter(|(_, bracket)| matches!(bracket, b'(' | b'[' | b'{')).count();
    (excess(line).is_none() && 2 * opened == brackets_of(line).count()).then_some(at + line.len())
}

/// A kind that was closed before its last fields, which end at `end`; they begin behind a comma at `at`.
pub(super) fn closed_before_fields(text: &str, source: u16, at: usize, end: usize) -> Diagnostic {
    let before = text[..at].trim_end().trim_end_matches(',').len() - 1;
    let found = span(source, before, before + 1);
    let mut fault = Diagnostic::error(codes::STRAY_BRACKET, found, "this bracket closes too early")
        .hint("close it behind the fields that follow");
    fault.edit = Some(Edit { span: span(source, before, end), replacement: format!("{})", &text[before + 1..end]) });
    fault
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

/// A closing bracket behind which the fields that it should close go on.
pub(super) fn early(stray: Diagnostic) -> Diagnostic {
    Diagnostic { message: "this bracket closes too early".to_owned(), ..stray }.hint("remove it: more fields follow")
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
