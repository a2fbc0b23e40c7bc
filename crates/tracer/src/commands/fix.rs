//! `tracer check --fix`: the edits that diagnostics offer, written into the scene.

use crate::failure::Failure;
use crate::loading::{is_dash, read};
use crate::shell::{Shell, counted};
use crate::write::save;
use scene_format::diagnostic::Edit;
use scene_format::render::apply_edits;
use scene_format::{Diagnostics, LoadError, Severity, Syntax};
use std::path::Path;

/// What is wrong may hide what else is: so often the text is looked at again.
const MOST_ROUNDS: usize = 20;

/// Mends what can be mended for certain in a scene file; says how much that was.
pub(super) fn fix(scene: &Path, syntax: Option<Syntax>, shell: &Shell) -> Result<(), Failure> {
    if is_dash(scene) {
        return Err(Failure::wrong("--fix writes into files; standard input is none"));
    }
    let (name, bytes) = read(scene)?;
    // What is no text has no edits; the check tells why.
    let Ok(before) = String::from_utf8(bytes) else { return Ok(()) };
    let syntax = syntax.or_else(|| Syntax::from_path(scene)).unwrap_or_else(|| Syntax::guess(&before));
    let mut text = before.clone();
    let first = diagnostics(&name, &text, syntax);
    let mut faults = first.clone();
    for _ in 0..MOST_ROUNDS {
        let next = apply_edits(&text, &edits(&faults));
        let left = diagnostics(&name, &next, syntax);
        // An edit that makes nothing better would go on for ever.
        if next == text || errors(&left) > errors(&faults) {
            break;
        }
        (text, faults) = (next, left);
    }
    if text != before {
        save(scene, text.as_bytes())?;
        let mended = first.len().saturating_sub(faults.len()).max(1);
        shell.say(&format!("{name}: mended {}", counted(mended, "fault")));
    }
    Ok(())
}

fn diagnostics(name: &str, text: &str, syntax: Syntax) -> Diagnostics {
    match scene_format::load_str(name, text, syntax, Path::new(""), &[]) {
        Ok(loaded) => loaded.warnings,
        Err(LoadError::Invalid { diagnostics, .. }) => diagnostics,
        Err(LoadError::Io { .. }) => Diagnostics::new(),
    }
}

fn errors(faults: &Diagnostics) -> usize {
    faults.iter().filter(|fault| fault.severity == Severity::Error).count()
}

/// The offered edits of the scene's own text.
fn edits(diagnostics: &Diagnostics) -> Vec<Edit> {
    let mut edits: Vec<Edit> = diagnostics.iter().filter_map(|fault| fault.edit.clone()).collect();
    edits.retain(|edit| edit.span.source == 0);
    edits
}
