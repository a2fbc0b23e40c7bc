//! `tracer fmt`: scenes laid out as everybody's are.

use super::scenes;
use crate::args::FmtArgs;
use crate::failure::{Failure, exit};
use crate::loading::{is_dash, read_text, told};
use crate::shell::{Shell, counted};
use crate::write::save;
use scene_format::Syntax;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

pub(super) fn run(args: &FmtArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let scenes = scenes::named(&args.scenes)?;
    let (mut wrong, mut untidy) = (0, 0);
    let many = scenes.len();
    for scene in scenes {
        match tidy(args, &scene, shell) {
            Ok(changes) => untidy += usize::from(changes),
            // The others are laid out all the same.
            Err(Failure::WrongScene) => wrong += 1,
            Err(Failure::Wrong(error)) if many > 1 => {
                shell.error(&error);
                wrong += 1;
            }
            Err(failure) => return Err(failure),
        }
    }
    if args.check && untidy > 0 {
        shell
            .error(&anyhow::anyhow!("{} of {many} would change; `tracer fmt` lays them out", counted(untidy, "scene")));
    }
    Ok(ExitCode::from(match (wrong, args.check && untidy > 0) {
        (0, false) => exit::DONE,
        (0, true) => exit::FAILED,
        _ => exit::WRONG,
    }))
}

/// Lays out one scene; whether it changes.
fn tidy(args: &FmtArgs, scene: &Path, shell: &Shell) -> Result<bool, Failure> {
    let syntax = args.syntax.map(Syntax::from);
    let (name, bytes) = read_text(scene, syntax)?;
    let syntax = syntax.or_else(|| Syntax::from_path(scene));
    let text = match String::from_utf8(bytes) {
        Ok(text) => text,
        // The reader tells where the fault is.
        Err(error) => {
            let wrong = scene_format::load_bytes(&name, error.into_bytes(), syntax, Path::new(""), &[]);
            return Err(wrong.err().map_or(Failure::WrongScene, |error| told(error, args.diagnostics, shell)));
        }
    };
    let syntax = syntax.unwrap_or_else(|| Syntax::guess(&text));
    let tidy = scene_format::format(&name, &text, syntax).map_err(|error| told(error, args.diagnostics, shell))?;
    let changes = tidy != text;
    if is_dash(scene) && !args.check {
        let mut out = std::io::stdout().lock();
        out.write_all(tidy.as_bytes())?;
        out.flush()?;
    } else if changes {
        if !args.check {
            save(scene, tidy.as_bytes())?;
        }
        writeln!(std::io::stdout().lock(), "{name}")?;
    }
    Ok(changes)
}
