//! Edits that diagnostics offer, applied: those that make a text better, and no others.

use crate::changes::{Change, Changes};
use crate::codes::{self, Code};
use crate::diagnostic::{Diagnostic, Diagnostics, Edit, Severity};
use crate::load::{LoadError, load_str};
use crate::syntax::Syntax;
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
    /// What was changed, in the order of the text.
    pub changes: Vec<Change>,
}

/// Applies what the faults of a text offer, again and again, as long as errors become fewer, or warnings where errors
/// do not become more: a text that is mended twice is as if it were mended once. `base_dir` is where the files that it
/// names lie.
pub fn mend(name: &str, text: &str, syntax: Syntax, base_dir: &Path) -> Mended {
    let look = |text: &str| -> Diagnostics {
        match load_str(name, text, syntax, base_dir, &[]) {
            Ok(loaded) => loaded.warnings,
            Err(LoadError::Invalid { diagnostics, .. }) => diagnostics,
            Err(LoadError::Io { .. }) => Diagnostics::new(),
        }
    };
    let before = text;
    let mut text = text.to_owned();
    let mut changes = Changes::default();
    let mut faults = look(&text);
    let first = faults.clone();
    loop {
        let certain = faults.iter().filter(|fault| is_certain(fault, &text, syntax));
        let edits: Vec<Edit> = certain.filter_map(|fault| fault.edit.clone()).collect();
        let singly = edits.iter().take(if edits.len() > 1 { MOST_TRIED } else { 0 }).map(std::slice::from_ref);
        let better = std::iter::once(edits.as_slice()).chain(singly).find_map(|edits| {
            let mut kept = changes.clone();
            let next = kept.apply(&text, edits);
            let left = (next != text).then(|| look(&next))?;
            (count(&left) < count(&faults)).then_some((next, left, kept))
        });
        match better {
            Some(better) => (text, faults, changes) = better,
            None => break,
        }
    }
    if let Some(kept) = without_new_errors((before, &first), (&text, &faults)) {
        let left = look(&kept);
        if kept == before || count(&left) < count(&first) {
            (text, faults) = (kept, left);
        }
    }
    Mended { faults: first.len().saturating_sub(faults.len()), changes: changes.between(before, &text), text }
}

/// Whether an edit is what must have been meant. Of names that a person has given nobody knows which one was; nor where
/// a comment belongs for which the edit has no place.
fn is_certain(fault: &Diagnostic, text: &str, syntax: Syntax) -> bool {
    let named = [codes::UNKNOWN_MATERIAL, codes::UNKNOWN_NAME, codes::UNKNOWN_CAMERA, codes::UNKNOWN_MASK];
    let by_likeness = |edit: &Edit| named.contains(&fault.code) && edit.replacement.starts_with('"');
    let keeps_comments = |edit: &Edit| {
        let replaced = text.get(edit.span.start as usize..edit.span.end as usize).unwrap_or("");
        // JSON has none: there they are what is wrong.
        syntax == Syntax::Json || comments(replaced, syntax).iter().all(|comment| edit.replacement.contains(comment))
    };
    fault.edit.as_ref().is_some_and(|edit| edit.span.source == 0 && !by_likeness(edit) && keeps_comments(edit))
}

/// The comments of a piece of text, outside of quotes.
fn comments(text: &str, syntax: Syntax) -> Vec<&str> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find(['"', '\'', '/', '#']) {
        rest = &rest[at..];
        let line = rest.lines().next().unwrap_or("");
        let is_line = if syntax == Syntax::Toml { rest.starts_with('#') } else { rest.starts_with("//") };
        let length = if is_line {
            found.push(line.trim_end());
            line.len()
        } else if syntax == Syntax::Ron && rest.starts_with("/*") {
            let length = rest.find("*/").map_or(rest.len(), |end| end + 2);
            found.push(&rest[..length]);
            length
        } else if let Some(quote) = rest.chars().next().filter(|sign| matches!(sign, '"' | '\'')) {
            let mut escaped = false;
            let end = line[1..].find(|sign| {
                let closes = sign == quote && !escaped;
                escaped = sign == '\\' && !escaped;
                closes
            });
            end.map_or(1, |end| end + 2)
        } else {
            1
        };
        rest = &rest[length..];
    }
    found
}

/// A mended text, of the same number of lines, with those lines as they were that have got an error of another kind:
/// there the edits were no help. `None`: there are none.
fn without_new_errors(before: (&str, &[Diagnostic]), after: (&str, &[Diagnostic])) -> Option<String> {
    let (old, new): (Vec<&str>, Vec<&str>) =
        (before.0.split_inclusive('\n').collect(), after.0.split_inclusive('\n').collect());
    if old.len() != new.len() {
        return None;
    }
    // What is wrong, and with what.
    let of = |text: &str, faults: &[Diagnostic]| -> Vec<(usize, (Code, String, String))> {
        let errors = faults.iter().filter(|fault| fault.severity == Severity::Error && fault.span.source == 0);
        let place = |fault: &Diagnostic| {
            let (start, end) = (fault.span.start as usize, fault.span.end as usize);
            let line = text.get(..start)?.matches('\n').count();
            // Where the text can be read, a fault stands at other words once they are mended.
            let what = if fault.code.as_str().starts_with("E01") { text.get(start..end)? } else { "" };
            Some((line, (fault.code, fault.message.clone(), what.to_owned())))
        };
        errors.filter_map(place).collect()
    };
    let known: Vec<_> = of(before.0, before.1).into_iter().map(|(_, fault)| fault).collect();
    let worse: Vec<usize> =
        of(after.0, after.1).into_iter().filter(|(_, fault)| !known.contains(fault)).map(|(line, _)| line).collect();
    let is_worse = |line: usize| old[line] != new[line] && worse.contains(&line);
    (0..old.len()).any(is_worse).then(|| {
        (0..old.len()).map(|line| if is_worse(line) { old[line] } else { new[line] }).collect::<Vec<_>>().concat()
    })
}

/// Errors first, then warnings.
fn count(faults: &[Diagnostic]) -> (usize, usize) {
    let errors = faults.iter().filter(|fault| fault.severity == Severity::Error).count();
    (errors, faults.len() - errors)
}
