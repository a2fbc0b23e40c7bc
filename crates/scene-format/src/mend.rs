//! Edits that diagnostics offer, applied: those that make a text better, and no others.

use crate::diagnostic::{Diagnostic, Diagnostics, Edit, Severity};
use crate::load::{LoadError, load_str};
use crate::render::apply_edits;
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
