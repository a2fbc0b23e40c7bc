//! Faults that are none: those that vanish when another one is mended.
//!
//! A reader that goes on after a fault guesses what was meant, and where it guesses wrong it sees faults that are not
//! there. So what it suggests is tried: an edit that makes its own fault and others vanish, and brings no new one,
//! shows that the others only followed from it. Where brackets or quotes do not match, the edits that people forget are
//! tried as well.

use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Severity, Span};
use crate::render::apply_edits;
use std::ops::Range;

/// With more faults than this a file is rubbish.
const MANY: usize = 300;
/// Bytes that are read again at most, all trials together: a fiftieth of a second.
const BUDGET: usize = 1 << 20;
/// To tell of so many faults takes as long as to read the text of them: names are compared with all that is known, and
/// with each other.
const FAULTS_OF_A_READING: usize = 32;
/// Longer files are told as they are.
const LONG: usize = 1 << 16;
/// Lines with faults whose brackets are looked at, and how long they may be.
const LINES: usize = 4;
const LINE_BYTES: usize = 400;

/// Leaves out what follows from other faults. `read` gives the errors of another text.
pub(crate) fn leave_out(text: &str, diagnostics: &mut Vec<Diagnostic>, read: impl Fn(&str) -> Vec<Diagnostic>) {
    leave_out_conflicts(diagnostics);
    let errors: Vec<Diagnostic> =
        diagnostics.iter().filter(|fault| fault.severity == Severity::Error).cloned().collect();
    if errors.len() < 2 || errors.len() > MANY || text.len() > LONG {
        return;
    }
    let mut trials = Trials { text, read, errors: &errors, budget: BUDGET };
    let mut follows = vec![false; errors.len()];
    let mut root = None;
    for (index, fault) in errors.iter().enumerate() {
        if let Some(edit) = &fault.edit
            && !follows[index]
            && let Some(gone) = trials.gone(edit)
            && gone[index]
        {
            gone.iter().enumerate().for_each(|(other, &gone)| follows[other] |= gone && other != index);
        }
    }
    // One edit for all that is left.
    let left = follows.iter().filter(|follows| !**follows).count();
    if left > 1
        && let Some(repair) = repairs(text, &errors).into_iter().find(|repair| trials.heals(&repair.edit))
    {
        root = Some(repair.fault());
        follows.fill(true);
    }
    let mut index = 0;
    diagnostics.retain(|fault| {
        let error = fault.severity == Severity::Error;
        index += usize::from(error);
        !error || !follows[index - 1]
    });
    diagnostics.extend(root);
}

/// That a table was written before follows, where that table is told to be none.
fn leave_out_conflicts(diagnostics: &mut Vec<Diagnostic>) {
    let wrong: Vec<Span> =
        diagnostics.iter().filter(|fault| fault.code == codes::WRONG_TYPE).map(|fault| fault.span).collect();
    let within = |span: Span| {
        let mut wrong = wrong.iter();
        wrong.any(|wrong| wrong.source == span.source && wrong.start <= span.start && span.end <= wrong.end)
    };
    diagnostics
        .retain(|fault| fault.code != codes::TABLE_CONFLICT || !fault.labels.iter().any(|label| within(label.span)));
}

/// What is tried, and with what the outcome is compared.
struct Trials<'t, R> {
    text: &'t str,
    read: R,
    errors: &'t [Diagnostic],
    budget: usize,
}

impl<R: Fn(&str) -> Vec<Diagnostic>> Trials<'_, R> {
    /// The errors after an edit of the scene file, as long as there is time.
    fn after(&mut self, edit: &Edit) -> Option<Vec<Diagnostic>> {
        let cost = self.text.len() * (1 + self.errors.len() / FAULTS_OF_A_READING);
        self.budget = self.budget.checked_sub(cost).filter(|_| edit.span.source == 0)?;
        Some((self.read)(&apply_edits(self.text, std::slice::from_ref(edit))))
    }

    /// Whether nothing is wrong any more.
    fn heals(&mut self, edit: &Edit) -> bool {
        self.after(edit).is_some_and(|errors| errors.is_empty())
    }

    /// Which errors an edit makes vanish; `None` when it brings others.
    fn gone(&mut self, edit: &Edit) -> Option<Vec<bool>> {
        let after = self.after(edit)?;
        let mut gone = vec![true; self.errors.len()];
        for fault in &after {
            let same = |before: &Diagnostic| {
                let start = before.span.start;
                let moved = if before.span.source == 0 && start >= edit.span.end {
                    start + edit.replacement.len() as u32 - (edit.span.end - edit.span.start)
                } else {
                    start
                };
                (before.code, &before.message) == (fault.code, &fault.message)
                    && (before.span.source, moved) == (fault.span.source, fault.span.start)
            };
            let index = self.errors.iter().position(same)?;
            gone[index] = false;
        }
        Some(gone)
    }
}

/// A change of one sign.
struct Repair {
    edit: Edit,
    /// The sign that stood there, if one did.
    was: &'static str,
}

impl Repair {
    /// What is said of the sign.
    fn fault(self) -> Diagnostic {
        let span = self.edit.span;
        let right = &self.edit.replacement;
        let fault = match (self.was, right.as_str()) {
            ("", "\"") => Diagnostic::error(codes::UNCLOSED_TEXT, span, "a quote is missing here")
                .expected("a text between two quotes"),
            ("", _) => Diagnostic::error(codes::UNCLOSED_BRACKET, span, format!("a `{right}` is missing here")),
            (_, "") => Diagnostic::error(codes::STRAY_BRACKET, span, "this bracket closes nothing"),
            (was, _) => Diagnostic::error(codes::STRAY_BRACKET, span, format!("`{was}` does not match"))
                .expected(format!("`{right}`")),
        };
        let hint = if right.is_empty() { "remove it".to_owned() } else { format!("write `{right}`") };
        Diagnostic { edit: Some(self.edit), ..fault.hint(hint) }
    }
}

/// Changes that may mend brackets and quotes on the lines of faults: what is too much is taken away, what is of the
/// wrong kind replaced, what is missing added.
fn repairs(text: &str, errors: &[Diagnostic]) -> Vec<Repair> {
    const CLOSERS: [&str; 3] = [")", "]", "}"];
    const OPENERS: [&str; 3] = ["(", "[", "{"];
    let syntax = |fault: &&Diagnostic| fault.code.is_syntax() && fault.span.source == 0;
    let mut lines: Vec<Range<usize>> = Vec::new();
    let mut places: Vec<Span> = errors
        .iter()
        .filter(syntax)
        .flat_map(|fault| std::iter::once(fault.span).chain(fault.labels.iter().map(|label| label.span)))
        .collect();
    places.sort();
    for place in places {
        let line = line_around(text, place.start as usize);
        if lines.len() < LINES && line.len() <= LINE_BYTES && !lines.contains(&line) {
            lines.push(line);
        }
    }
    // What is missing may be missing on a line between.
    let (first, last) = (lines.iter().map(|line| line.start).min(), lines.iter().map(|line| line.end).max());
    if let (Some(first), Some(last)) = (first, last)
        && last - first <= LINES * LINE_BYTES
    {
        let mut at = first;
        for line in text[first..last].split('\n') {
            let line = at..at + line.len();
            at = line.end + 1;
            if lines.len() < 2 * LINES && line.len() <= LINE_BYTES && !lines.contains(&line) {
                lines.push(line);
            }
        }
    }
    let excess = excess(text);
    if excess != [0; 3] {
        lines.extend(uneven_lines(text, excess, &lines));
    }
    let mut found = Vec::new();
    for line in &lines {
        let quotes = text[line.clone()].matches('"').count() % 2 == 1;
        for (at, byte) in text.as_bytes()[line.clone()].iter().enumerate() {
            let at = line.start + at;
            let change = |end: usize, was: &'static str, replacement: &str| Repair {
                edit: Edit { span: place(at, end), replacement: replacement.to_owned() },
                was,
            };
            let sign = std::str::from_utf8(std::slice::from_ref(byte)).unwrap_or("");
            if let Some(&was) = CLOSERS.iter().find(|closer| **closer == sign) {
                found.push(change(at + 1, was, ""));
                found.extend(CLOSERS.iter().filter(|other| **other != was).map(|other| change(at + 1, was, other)));
            }
            if let Some(&was) = OPENERS.iter().find(|opener| **opener == sign) {
                found.extend(OPENERS.iter().filter(|other| **other != was).map(|other| change(at + 1, was, other)));
            }
            if matches!(byte, b',' | b')' | b']' | b'}') {
                found.extend(CLOSERS.iter().map(|closer| change(at, "", closer)));
            }
        }
        let end = line.start + text[line.clone()].trim_end().len();
        found.extend(
            CLOSERS.iter().map(|closer| Repair {
                edit: Edit { span: place(end, end), replacement: (*closer).to_owned() },
                was: "",
            }),
        );
        let word = |byte: Option<&u8>| {
            byte.is_some_and(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.' | b'/' | b'-'))
        };
        let bytes = text.as_bytes();
        let edges = line.clone().filter(|&at| {
            bytes[at] == b'.'
                || at > 0 && bytes[at - 1] == b'.'
                || word(at.checked_sub(1).and_then(|before| bytes.get(before))) != word(bytes.get(at))
        });
        let missing: &[&'static str] = if quotes { &["\""] } else { &OPENERS };
        found.extend(edges.flat_map(|at| {
            let add = move |sign: &&str| Repair {
                edit: Edit { span: place(at, at), replacement: (*sign).to_owned() },
                was: "",
            };
            missing.iter().map(add)
        }));
    }
    if excess != [0; 3] {
        // What does not make the brackets even cannot be it.
        found.retain(|repair| {
            let of = |sign: &str| std::array::from_fn(|kind| excess_of(sign.bytes().next(), kind));
            let (was, now): ([i32; 3], [i32; 3]) = (of(repair.was), of(&repair.edit.replacement));
            repair.edit.replacement == "\"" || (0..3).all(|kind| excess[kind] - was[kind] + now[kind] == 0)
        });
    }
    found
}

/// One for an opening bracket of a kind, minus one for a closing one.
fn excess_of(byte: Option<u8>, kind: usize) -> i32 {
    const KINDS: [(u8, u8); 3] = [(b'(', b')'), (b'[', b']'), (b'{', b'}')];
    let (open, close) = KINDS[kind];
    i32::from(byte == Some(open)) - i32::from(byte == Some(close))
}

/// Lines whose own brackets are as uneven as those of the file, and that begin with something other than a bracket
/// which closes: there one is likely to be missing or too many, wherever it is noticed.
fn uneven_lines(text: &str, excess: [i32; 3], known: &[Range<usize>]) -> Vec<Range<usize>> {
    let mut at = 0;
    let lines = text.split('\n').map(|line| {
        let start = at;
        at += line.len() + 1;
        start..start + line.len()
    });
    let uneven = lines.filter(|line| {
        let written = &text[line.clone()];
        line.len() <= LINE_BYTES
            && !written.trim_start().starts_with([')', ']', '}'])
            && self::excess(written) == excess
            && !known.contains(line)
    });
    uneven.take(LINES).collect()
}

/// How many more brackets of each kind open than close, outside texts and comments.
fn excess(text: &str) -> [i32; 3] {
    let mut excess = [0; 3];
    for line in text.lines() {
        let mut quoted = false;
        for (at, byte) in line.bytes().enumerate() {
            match byte {
                b'"' => quoted = !quoted,
                _ if quoted => {}
                b'#' => break,
                b'/' if line.as_bytes().get(at + 1) == Some(&b'/') => break,
                _ => (0..3).for_each(|kind| excess[kind] += excess_of(Some(byte), kind)),
            }
        }
    }
    excess
}

fn place(start: usize, end: usize) -> Span {
    Span { source: 0, start: start as u32, end: end as u32 }
}

/// The line that a byte stands on, without its end.
fn line_around(text: &str, byte: usize) -> Range<usize> {
    let bytes = text.as_bytes();
    let byte = byte.min(bytes.len());
    let start = bytes[..byte].iter().rposition(|&b| b == b'\n').map_or(0, |newline| newline + 1);
    let end = bytes[byte..].iter().position(|&b| b == b'\n').map_or(bytes.len(), |newline| byte + newline);
    start..end
}

/// Takes back edits on lines where an error of the syntax stands for which there is none: what is meant there nobody
/// knows.
pub(crate) fn withhold(text: &str, faults: &mut [Diagnostic]) {
    // What is missing or too much where the syntax is right hides nothing.
    let unclear = |fault: &&Diagnostic| {
        fault.severity == Severity::Error && fault.code.is_syntax() && fault.edit.is_none() && fault.span.source == 0
    };
    let mut lines: Vec<Range<u32>> = Vec::new();
    for fault in faults.iter().filter(unclear) {
        let line = lines_of(text, fault.span.start, fault.span.end);
        match lines.last_mut() {
            // Faults are in order of position.
            Some(last) if line.start < last.end => last.end = last.end.max(line.end),
            _ => lines.push(line),
        }
    }
    for fault in faults.iter_mut() {
        fault.edit.take_if(|edit| {
            let edited = lines_of(text, edit.span.start, edit.span.end);
            let at = lines.partition_point(|line| line.end <= edited.start);
            edit.span.source == 0 && lines.get(at).is_some_and(|line| line.start < edited.end)
        });
    }
}

/// The lines that a range of bytes touches, with the ends of these lines.
fn lines_of(text: &str, start: u32, end: u32) -> Range<u32> {
    let bytes = text.as_bytes();
    let (start, end) = ((start as usize).min(bytes.len()), (end as usize).min(bytes.len()));
    let first = bytes[..start].iter().rposition(|&byte| byte == b'\n').map_or(0, |newline| newline + 1);
    let last = bytes[end..].iter().position(|&byte| byte == b'\n').map_or(bytes.len() + 1, |newline| end + newline + 1);
    first as u32..last as u32
}
