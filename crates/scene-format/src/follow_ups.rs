//! Faults that are none: those that vanish when another one is mended.
//!
//! A reader that goes on after a fault guesses what was meant, and where it guesses wrong it sees faults that are not
//! there. So what it suggests is tried: an edit that makes its own fault and others vanish, and brings no new one,
//! shows that the others only followed from it. Where brackets or quotes do not match, the edits that people forget are
//! tried as well.

use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Severity, Span};
use crate::render::apply_edits;
use crate::syntax::declarations;
use std::ops::Range;

/// With more faults than this a file is rubbish.
const MANY: usize = 300;
/// Bytes that are read again at most, all trials together: a fiftieth of a second.
const BUDGET: usize = 1 << 20;
/// An item that is repeated or included takes as long as so many bytes.
const BYTES_OF_AN_ITEM: usize = 100;
/// To tell of so many faults takes as long as to read the text of them: names are compared with all that is known, and
/// with each other.
const FAULTS_OF_A_READING: usize = 32;
/// Longer files are told as they are.
const LONG: usize = 1 << 16;
/// Lines with faults whose brackets are looked at, and how long they may be.
const LINES: usize = 4;
const LINE_BYTES: usize = 400;

/// What a word does not hold.
const BETWEEN_WORDS: [char; 12] = [' ', '\n', '\t', ',', ':', '=', '(', ')', '[', ']', '{', '}'];

/// Whether a text that makes so many items may be read again.
pub(crate) fn is_cheap(repeated: u64) -> bool {
    repeated < (BUDGET / BYTES_OF_AN_ITEM) as u64
}

/// Leaves out what follows from other faults. `read` gives the errors of another text, and how many items it makes.
pub(crate) fn leave_out(text: &str, diagnostics: &mut Vec<Diagnostic>, read: impl Fn(&str) -> (Vec<Diagnostic>, u64)) {
    leave_out_conflicts(diagnostics);
    join_unclosed(diagnostics);
    leave_out_ends(diagnostics);
    leave_out_last_word(text, diagnostics);
    leave_out_declared(text, diagnostics);
    join_decimal_comma(text, diagnostics);
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
        && let Some((repair, gone)) = trials.best(repairs(text, &errors))
    {
        root = Some(repair.fault());
        gone.iter().zip(&mut follows).for_each(|(gone, follows)| *follows |= gone);
    }
    let mut index = 0;
    diagnostics.retain(|fault| {
        let error = fault.severity == Severity::Error;
        index += usize::from(error);
        !error || !follows[index - 1]
    });
    diagnostics.extend(root);
}

/// Brackets that are all missing at one place are one fault, and that a value is missing there follows.
fn join_unclosed(diagnostics: &mut Vec<Diagnostic>) {
    let place = |fault: &Diagnostic| match fault.labels.as_slice() {
        [label] if fault.code == codes::UNCLOSED_BRACKET && fault.expected.len() == 3 => Some(label.span),
        _ => None,
    };
    let mut places: Vec<(Span, usize)> = Vec::new();
    let mut joined: Vec<(usize, String)> = Vec::new();
    let mut follows = vec![false; diagnostics.len()];
    for (index, fault) in diagnostics.iter().enumerate() {
        let Some(at) = place(fault) else { continue };
        let bracket = fault.expected.trim_matches('`').to_owned();
        match places.iter().find(|(other, _)| *other == at) {
            None => places.push((at, joined.len())),
            Some(&(_, first)) => {
                // The innermost is closed first.
                joined[first].1.insert_str(0, &bracket);
                follows[index] = true;
                continue;
            }
        }
        joined.push((index, bracket));
    }
    for (at, first) in places {
        let (index, brackets) = &joined[first];
        if brackets.len() > 1 {
            let fault = &mut diagnostics[*index];
            fault.message = format!("this bracket and {} within it are never closed", brackets.len() - 1);
            fault.expected = format!("`{brackets}`");
            fault.labels[0].text = format!("`{brackets}` is missing before this");
            let missing = |other: &Diagnostic| other.code == codes::MISSING_VALUE && other.span.start == at.start;
            diagnostics.iter().zip(&mut follows).for_each(|(other, follows)| *follows |= missing(other));
        }
    }
    let mut follows = follows.into_iter();
    diagnostics.retain(|_| follows.next() != Some(true));
}

/// Where the first object of several was taken for the whole file, that it ends too early follows.
fn leave_out_ends(diagnostics: &mut Vec<Diagnostic>) {
    let alone =
        |fault: &Diagnostic| fault.code == codes::UNKNOWN_VARIANT && fault.message.starts_with("an object stands");
    if diagnostics.iter().any(alone) {
        diagnostics.retain(|fault| fault.code != codes::TEXT_AFTER_END);
    }
}

/// Of a file that ends within a bracket the last word may be half of one.
fn leave_out_last_word(text: &str, diagnostics: &mut Vec<Diagnostic>) {
    let end = text.trim_end().len();
    let ends = |fault: &Diagnostic| {
        fault.code == codes::UNCLOSED_BRACKET
            && fault.labels.is_empty()
            && fault.span.source == 0
            && (fault.hint.ends_with("the file ends before that") || fault.span.start as usize >= end)
    };
    if !diagnostics.iter().any(ends) {
        return;
    }
    let within = |fault: &Diagnostic| {
        let start = (fault.span.start as usize).min(end);
        let last = fault.span.source == 0 && text.get(start..end).is_some_and(|rest| !rest.contains(BETWEEN_WORDS));
        last && fault.severity == Severity::Error && fault.code != codes::UNCLOSED_BRACKET
    };
    diagnostics.retain(|fault| !within(fault));
}

/// `[0.2, 0,04]`: of the two numbers that a decimal comma makes the second is none (JSON, TOML), and whatever is wrong
/// with the first is not told.
fn join_decimal_comma(text: &str, diagnostics: &mut Vec<Diagnostic>) {
    while let Some((index, whole)) = diagnostics.iter().enumerate().find_map(|(index, fault)| {
        let (start, end) = (fault.span.start as usize, fault.span.end as usize);
        let fraction = text.get(start..end).filter(|_| fault.code == codes::BAD_NUMBER && fault.span.source == 0)?;
        let all_digits = fraction.len() > 1 && fraction.bytes().all(|byte| byte.is_ascii_digit());
        let before = text[..start].strip_suffix(',').filter(|_| all_digits && fraction.starts_with('0'))?;
        let rest = before.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('-');
        (rest.len() < before.len() && rest.ends_with([' ', '[', ','])).then_some((index, rest.len()))
    }) {
        let fault = &mut diagnostics[index];
        fault.span.start = whole as u32;
        let (found, written) = (fault.span, &text[whole..fault.span.end as usize]);
        let mended = written.replacen(',', ".", 1);
        fault.message = format!("`{written}` is not a number");
        fault.hint = format!("numbers have a decimal point: {mended}");
        fault.edit = Some(Edit { span: found, replacement: mended });
        let mut at = 0;
        diagnostics.retain(|other| {
            at += 1;
            let within = other.span.source == 0 && found.start <= other.span.start && other.span.end <= found.end;
            at == index + 1 || !within
        });
    }
}

/// A value whose name stands in no `vars` is told once, not at each place where it is used.
fn leave_out_declared(text: &str, diagnostics: &mut Vec<Diagnostic>) {
    let mut told: Vec<String> = Vec::new();
    // `for i in range(8):` has neither a comma behind it, nor is its `i` known.
    let loops: Vec<Span> = diagnostics
        .iter()
        .filter(|fault| fault.code == codes::OTHER_LANGUAGE && fault.message.starts_with("there are no loops"))
        .map(|fault| fault.span)
        .collect();
    for span in &loops {
        let head = text.get(span.start as usize..span.end as usize).unwrap_or("");
        told.extend(head.split_whitespace().nth(1).map(|name| name.trim_matches(['(', ',']).to_owned()));
    }
    let behind = |fault: &Diagnostic| {
        let mut loops = loops.iter();
        fault.code == codes::MISSING_COMMA
            && loops
                .any(|span| span.source == fault.span.source && (span.end..span.end + 3).contains(&fault.span.start))
    };
    diagnostics.retain(|fault| match declarations::name_in_way(&fault.hint) {
        _ if behind(fault) => false,
        Some(name) if told.iter().any(|other| other == name) => false,
        Some(name) => {
            told.push(name.to_owned());
            true
        }
        None => true,
    });
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

impl<R: Fn(&str) -> (Vec<Diagnostic>, u64)> Trials<'_, R> {
    /// The bytes that one trial counts as.
    fn cost(&self) -> usize {
        self.text.len() * (1 + self.errors.len() / FAULTS_OF_A_READING)
    }

    /// The errors after an edit of the scene file, as long as there is time.
    fn after(&mut self, edit: &Edit) -> Option<Vec<Diagnostic>> {
        self.budget = self.budget.checked_sub(self.cost()).filter(|_| edit.span.source == 0)?;
        let (errors, items) = (self.read)(&apply_edits(self.text, std::slice::from_ref(edit)));
        let items = usize::try_from(items).unwrap_or(usize::MAX);
        self.budget = self.budget.saturating_sub(items.saturating_mul(BYTES_OF_AN_ITEM));
        Some(errors)
    }

    /// The first repair after which nothing is wrong any more; else the one after which least is, nothing of the
    /// syntax and nothing that was not wrong before: the rest are mistakes of their own. With what vanishes by it.
    fn best(&mut self, mut repairs: Vec<Repair>) -> Option<(Repair, Vec<bool>)> {
        if repairs.len() > self.budget / self.cost().max(1) {
            // Where not all can be tried, those beside what is wrong.
            let places: Vec<u32> = self.errors.iter().map(|fault| fault.span.start).collect();
            let away = |repair: &Repair| places.iter().map(|place| place.abs_diff(repair.edit.span.start)).min();
            repairs.sort_by_cached_key(away);
        }
        let mut best: Option<(Repair, Vec<bool>)> = None;
        let left = |gone: &[bool]| gone.iter().filter(|gone| !**gone).count();
        for repair in repairs {
            let Some(gone) = self.gone(&repair.edit) else { continue };
            if left(&gone) == 0 {
                return Some((repair, gone));
            }
            let mended = self.errors.iter().zip(&gone).all(|(fault, &gone)| gone || !fault.code.is_syntax());
            if mended && best.as_ref().is_none_or(|(_, other)| left(&gone) < left(other)) {
                best = Some((repair, gone));
            }
        }
        best
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
            ("(" | "[" | "{", "") => Diagnostic::error(codes::UNCLOSED_BRACKET, span, "this bracket is one too many"),
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
    let syntax = |fault: &&Diagnostic| fault.code.is_syntax() && fault.span.source == 0;
    if !errors.iter().any(|fault| syntax(&fault)) {
        return Vec::new();
    }
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
    // Nor need the syntax be wrong where a bracket too many ends something, or anything on the line where a list ought
    // to begin.
    let first = errors.iter().filter(|fault| fault.span.source == 0).map(|fault| fault.span.start).min();
    let first = first.map(|at| line_around(text, at as usize));
    let before = first.clone().and_then(|line| line.start.checked_sub(1)).map(|at| line_around(text, at));
    for line in [first, before].into_iter().flatten().filter(|line| line.len() <= LINE_BYTES) {
        lines.retain(|other| *other != line);
        lines.insert(0, line);
    }
    let excess = excess(text);
    if excess != [0; 3] {
        lines.extend(uneven_lines(text, excess, &lines));
    }
    let mut found: Vec<Repair> = lines.iter().flat_map(|line| repairs_of_line(text, line.clone())).collect();
    // Forgotten closing brackets are likelier than opening ones that are too many.
    found.sort_by_key(|repair| OPENERS.contains(&repair.was) && repair.edit.replacement.is_empty());
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

const CLOSERS: [&str; 3] = [")", "]", "}"];
const OPENERS: [&str; 3] = ["(", "[", "{"];

/// The changes of one line.
fn repairs_of_line(text: &str, line: Range<usize>) -> Vec<Repair> {
    let bytes = text.as_bytes();
    let change = |at: usize, was: &'static str, replacement: &str| Repair {
        edit: Edit { span: place(at, at + was.len()), replacement: replacement.to_owned() },
        was,
    };
    let mut found = Vec::new();
    for at in line.clone() {
        let sign = text.get(at..at + 1).unwrap_or("");
        for signs in [&CLOSERS, &OPENERS] {
            if let Some(&was) = signs.iter().find(|bracket| **bracket == sign) {
                found.push(change(at, was, ""));
                found.extend(signs.iter().filter(|other| **other != was).map(|other| change(at, was, other)));
            }
        }
        if matches!(bytes[at], b',' | b')' | b']' | b'}') {
            found.extend(CLOSERS.iter().map(|closer| change(at, "", closer)));
        }
    }
    let end = line.start + text[line.clone()].trim_end().len();
    found.extend(CLOSERS.iter().map(|closer| change(end, "", closer)));
    if text[line.clone()].matches('"').count() % 2 == 1 {
        found.extend(line.clone().filter(|&at| is_edge(bytes, at)).map(|at| change(at, "", "\"")));
        return found;
    }
    // Without its bracket a kind grows together with what follows: `Diffusealbedo: 0.5)`, `Scale1.2)`, `DropTo-1)`.
    let within = line.clone().filter(|&at| {
        let before = bytes[..at].iter().rev().take_while(|byte| byte.is_ascii_alphanumeric());
        let grown = at > 0 && bytes[at - 1].is_ascii_alphabetic();
        let grown = grown && (bytes[at].is_ascii_lowercase() || bytes[at].is_ascii_digit() || bytes[at] == b'-');
        grown && before.last().is_some_and(u8::is_ascii_uppercase)
    });
    found.extend(within.map(|at| change(at, "", "(")));
    let edges = line.filter(|&at| is_edge(bytes, at) || matches!(&bytes[at..], [b'(' | b'[', ..] | [b'"', b'=', ..]));
    let edges = edges.chain([end]);
    found.extend(edges.flat_map(|at| OPENERS.map(|opener| change(at, "", opener))));
    found
}

/// Whether a word begins or ends here.
fn is_edge(bytes: &[u8], at: usize) -> bool {
    let word =
        |byte: Option<&u8>| byte.is_some_and(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.' | b'/' | b'-'));
    let before = at.checked_sub(1).and_then(|before| bytes.get(before));
    bytes.get(at) == Some(&b'.') || before == Some(&b'.') || word(before) != word(bytes.get(at))
}

/// One for an opening bracket of a kind, minus one for a closing one.
fn excess_of(byte: Option<u8>, kind: usize) -> i32 {
    const KINDS: [(u8, u8); 3] = [(b'(', b')'), (b'[', b']'), (b'{', b'}')];
    let (open, close) = KINDS[kind];
    i32::from(byte == Some(open)) - i32::from(byte == Some(close))
}

/// Lines whose own brackets are as uneven as those of the file, and that begin with something other than a bracket
/// which closes, and lines of nothing but such brackets, two of a kind side by side (`]],`): there one is likely to be
/// missing or too many, wherever it is noticed.
fn uneven_lines(text: &str, excess: [i32; 3], known: &[Range<usize>]) -> Vec<Range<usize>> {
    let mut at = 0;
    let lines = text.split('\n').map(|line| {
        let start = at;
        at += line.len() + 1;
        start..start + line.len()
    });
    let uneven = lines.filter(|line| {
        let written = &text[line.clone()];
        let closers = written.trim().trim_end_matches(',').as_bytes();
        let twice = closers.windows(2).any(|pair| pair[0] == pair[1]);
        let likely = match closers {
            [b')' | b']' | b'}', ..] => twice && closers.iter().all(|byte| b")]}".contains(byte)),
            _ => self::excess(written) == excess,
        };
        likely && line.len() <= LINE_BYTES && !known.contains(line)
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
        match lines.last_mut() {
            // Faults are in order of position. What lies on a line that is known needs no look: it may be a whole file.
            Some(last) if fault.span.end < last.end => {}
            Some(last) if fault.span.start < last.end => {
                last.end = lines_of(text, fault.span.start, fault.span.end).end;
            }
            _ => lines.push(lines_of(text, fault.span.start, fault.span.end)),
        }
    }
    if lines.is_empty() {
        return;
    }
    let mut last = 0..0;
    for fault in faults.iter_mut() {
        fault.edit.take_if(|edit| {
            if edit.span.source != 0 {
                return false;
            }
            if edit.span.start < last.start || edit.span.end >= last.end {
                last = lines_of(text, edit.span.start, edit.span.end);
            }
            let at = lines.partition_point(|line| line.end <= last.start);
            lines.get(at).is_some_and(|line| line.start < last.end)
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
