//! Edits that diagnostics offer, applied: those that make a text better, and no others.

use crate::diagnostic::{Diagnostic, Diagnostics, Edit, Severity};
use crate::load::{LoadError, load_str};
use crate::render::apply_edits;
use crate::syntax::Syntax;
use std::ops::Range;
use std::path::Path;

/// Edits of one round that are tried by themselves, where all of them together make nothing better.
const MOST_TRIED: usize = 64;

/// A text whose faults were mended as far as is certain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mended {
    /// The text.
    pub text: String,
    /// How many faults there are less than before; 0: nothing was changed.
    pub faults: usize,
}

/// Applies what the faults of a text offer, again and again, as long as errors become fewer, or warnings where errors do not become more: a
/// text that is mended twice is as if it were mended once. `base_dir` is where the files that it names lie.
pub fn mend(name: &str, text: &str, syntax: Syntax, base_dir: &Path) -> Mended {
    let look = |text: &str| -> Diagnostics {
        match load_str(name, text, syntax, base_dir, &[]) {
            Ok(loaded) => loaded.warnings,
            Err(LoadError::Invalid { diagnostics, .. }) => diagnostics,
            Err(LoadError::Io { .. }) => Diagnostics::new(),
        }
    };
    let mut text = text.to_owned();
    let mut faults = look(&text);
    let first = faults.len();
    loop {
        let edits: Vec<Edit> =
            faults.iter().filter_map(|fault| fault.edit.clone()).filter(|edit| edit.span.source == 0).collect();
        let singly = edits.iter().take(if edits.len() > 1 { MOST_TRIED } else { 0 }).map(std::slice::from_ref);
        let better = std::iter::once(edits.as_slice()).chain(singly).find_map(|edits| {
            let next = apply_edits(&text, edits);
            let left = (next != text).then(|| look(&next))?;
            (count(&left) < count(&faults)).then_some((next, left))
        });
        match better {
            Some(better) => (text, faults) = better,
            None => return Mended { text, faults: first.saturating_sub(faults.len()) },
        }
    }
}

/// Errors first, then warnings.
fn count(faults: &[Diagnostic]) -> (usize, usize) {
    let errors = faults.iter().filter(|fault| fault.severity == Severity::Error).count();
    (errors, faults.len() - errors)
}

/// Takes back edits on lines where an error of the syntax stands for which there is none: what is meant there nobody knows.
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
