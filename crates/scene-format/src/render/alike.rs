//! Faults that are alike: where there are many, the first one tells of the others.

use super::Lines;
use crate::codes;
use crate::diagnostic::{Diagnostic, Severity};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// More faults that are alike than this are told by the first of them.
const MANY_ALIKE: usize = 3;
/// So many of their lines are named.
const SHOWN_LINES: usize = 8;

type Alike<'d> = (Severity, &'d str, Cow<'d, str>, &'d str, u32);

/// A message without what stands between quotes, numbers and names of files.
fn without_values(message: &str) -> String {
    let words = message.split(' ').map(|word| match word.find(['"', '/', '.', '`']) {
        Some(_) => "..",
        None if word.starts_with(|c: char| c.is_ascii_digit() || c == '-') => "..",
        None => word,
    });
    words.collect::<Vec<_>>().join(" ")
}

/// What diagnostics that are alike have in common; those that no source shows stand alone.
fn alike<'d>(d: &'d Diagnostic, lines: &[Lines<'_>]) -> Option<Alike<'d>> {
    let shown = d.elsewhere.is_none() && (d.span.source as usize) < lines.len();
    // A hundred numbers between quotes, materials that are nowhere and files that are missing are one mistake.
    let by_value = [codes::WRONG_TYPE, codes::UNKNOWN_MATERIAL, codes::FILE_NOT_FOUND].contains(&d.code);
    let message = if by_value { without_values(&d.message).into() } else { Cow::Borrowed(&*d.message) };
    shown.then_some((d.severity, d.code.as_str(), message, &*d.expected, d.span.source))
}

/// For each diagnostic what is said of the others like it: `None` where another one tells of it.
pub(super) fn grouped(diagnostics: &[Diagnostic], lines: &[Lines<'_>]) -> Vec<Option<String>> {
    let mut groups: BTreeMap<Alike<'_>, Vec<usize>> = BTreeMap::new();
    for (index, diagnostic) in diagnostics.iter().enumerate() {
        if let Some(key) = alike(diagnostic, lines) {
            groups.entry(key).or_default().push(index);
        }
    }
    let mut said = vec![Some(String::new()); diagnostics.len()];
    for (_, group) in groups.into_iter().filter(|(_, group)| group.len() > MANY_ALIKE) {
        let mut numbers: Vec<usize> = Vec::new();
        for &index in &group[1..] {
            said[index] = None;
            let span = diagnostics[index].span;
            numbers.push(lines[span.source as usize].index.line(span.start as usize) + 1);
        }
        numbers.dedup();
        let shown = |numbers: &[usize]| numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
        let places = match numbers.as_slice() {
            [only] => format!("line {only}"),
            numbers if numbers.len() <= SHOWN_LINES => format!("lines {}", shown(numbers)),
            numbers => format!("lines {} .. {}", shown(&numbers[..SHOWN_LINES]), numbers[numbers.len() - 1]),
        };
        said[group[0]] = Some(format!("{} more like this, on {places}", group.len() - 1));
    }
    said
}
