//! `tracer check --fix`: the edits that diagnostics offer, written into the scene.

use crate::args::DiagnosticsForm;
use crate::failure::Failure;
use crate::loading::{is_dash, read_text};
use crate::shell::{Shell, counted};
use crate::write::save;
use scene_format::{Syntax, mend};
use std::path::Path;

/// Mends what can be mended for certain in a scene file; says what was changed, a line for each change.
pub(super) fn fix(scene: &Path, syntax: Option<Syntax>, form: DiagnosticsForm, shell: &Shell) -> Result<(), Failure> {
    if is_dash(scene) {
        return Err(Failure::wrong("--fix writes into files; standard input is none"));
    }
    let syntax = syntax.or_else(|| Syntax::from_path(scene));
    // First of all whether it is there, and no picture or mesh.
    let (name, bytes) = read_text(scene, syntax)?;
    let Some(syntax) = syntax else {
        let way = "name it .ron, .toml or .json, or say which it is with `--syntax ron`";
        return Err(Failure::wrong(format!("{name}: --fix writes into scenes, and this may be none: {way}")));
    };
    // What is no text has no edits; the check tells why.
    let Ok(before) = String::from_utf8(bytes) else { return Ok(()) };
    let mended = mend(&name, &before, syntax, scene.parent().unwrap_or(Path::new("")));
    if mended.text != before {
        save(scene, mended.text.as_bytes())?;
        for change in &mended.changes {
            shell.say(&match form {
                DiagnosticsForm::Json => change.json(&name),
                _ => format!("{name}:{}:{}: {}", change.line, change.column, change.said()),
            });
        }
        if form != DiagnosticsForm::Json {
            shell.say(&format!("{name}: mended {}", counted(mended.changes.len(), "fault")));
        }
    }
    Ok(())
}
