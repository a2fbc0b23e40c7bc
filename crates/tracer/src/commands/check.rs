//! `tracer check`: everything that is wrong with scenes, meshes and textures included.

use super::{fix, scenes};
use crate::args::{CheckArgs, DiagnosticsForm};
use crate::failure::{Failure, exit};
use crate::frames;
use crate::loading::{Known, compile, is_dash, load_to_look, use_threads, with_faults_of_files};
use crate::shell::{Shell, counted, sarif};
use scene_format::diagnostic::{Severity, Source};
use scene_format::render::json_error;
use scene_format::{Diagnostics, LoadError, Syntax, codes, is_library, load_str};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

pub(super) fn run(args: &CheckArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let checked = check_all(args, &shell.denying(args.deny_warnings));
    if args.diagnostics == DiagnosticsForm::Sarif {
        std::io::stdout().lock().write_all(sarif(checked.is_ok()).as_bytes())?;
    }
    checked
}

fn check_all(args: &CheckArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let scenes = scenes::named(&args.scenes)?;
    let mut wrong = 0;
    let many = scenes.len();
    for scene in scenes {
        let syntax = args.syntax.map(Syntax::from);
        let mended = if args.fix { fix::fix(&scene, syntax, args.diagnostics, shell) } else { Ok(()) };
        match mended.and_then(|()| check(args, scene, shell)) {
            Ok(()) => {}
            // The others are checked all the same.
            Err(Failure::WrongScene) => wrong += 1,
            Err(Failure::Wrong(error)) if many > 1 => {
                match args.diagnostics {
                    DiagnosticsForm::Json => shell.say(&json_error(&format!("{error:#}"))),
                    _ => shell.error(&error),
                }
                wrong += 1;
            }
            Err(failure) => return Err(failure),
        }
    }
    // Whoever reads records counts them.
    if wrong > 0 && many > 1 && args.diagnostics != DiagnosticsForm::Json {
        shell.error(&anyhow::anyhow!("{wrong} of {many} scenes are wrong"));
    }
    Ok(ExitCode::from(if wrong > 0 { exit::WRONG } else { exit::DONE }))
}

/// What is wrong with a file that is there to be included, and its texts: all but that it has nothing to render. `None`
/// where it is none.
fn of_library(scene: &Path, syntax: Option<Syntax>) -> Result<Option<(Diagnostics, Vec<Source>)>, Failure> {
    // A pipe gives what it has once: whoever loads the scene reads it.
    let text = Some(scene)
        .filter(|scene| !is_dash(scene) && scene.is_file())
        .and_then(|scene| std::fs::read_to_string(scene).ok());
    let Some(text) = text else { return Ok(None) };
    let syntax = syntax.or_else(|| Syntax::from_path(scene)).unwrap_or_else(|| Syntax::guess(&text));
    if !is_library(&text, syntax) {
        return Ok(None);
    }
    use_threads(None)?;
    let folder = scene.parent().unwrap_or(Path::new(""));
    let loaded = load_str(&scene.display().to_string(), &text, syntax, folder, &[]);
    Ok(match loaded.map_err(|error| with_faults_of_files(error, folder)) {
        Err(LoadError::Invalid { mut diagnostics, sources, .. }) => {
            diagnostics.retain(|fault| fault.code != codes::NO_OBJECTS);
            Some((diagnostics, sources))
        }
        _ => None,
    })
}

fn check(args: &CheckArgs, scene: PathBuf, shell: &Shell) -> Result<(), Failure> {
    if let Some((diagnostics, sources)) = of_library(&scene, args.syntax.map(Syntax::from))? {
        shell.diagnostics(&diagnostics, &sources, args.diagnostics);
        if diagnostics.iter().any(|fault| fault.severity == Severity::Error)
            || args.deny_warnings && shell.count(&diagnostics) > 0
        {
            return Err(Failure::WrongScene);
        }
        if args.diagnostics == DiagnosticsForm::Text && !args.quiet {
            writeln!(std::io::stdout().lock(), "{}: ok, to be included: nothing to render", scene.display())?;
        }
        return Ok(());
    }
    let mut args_of_scene = args.of(scene);
    let (desc, warnings) = load_to_look(&mut args_of_scene, shell)?;
    let scene = compile(&desc, args.diagnostics, Known::Nothing, shell)?;
    let frames = frames::told(&args_of_scene, &desc, None, shell)?;
    let name = desc.sources.first().map_or("", |source| source.name.as_str());
    let warnings = warnings + shell.count(&scene.warnings) + frames.warnings;
    if args.deny_warnings && warnings > 0 {
        if args.diagnostics == DiagnosticsForm::Text {
            shell.error(&anyhow::anyhow!("{name}: {}, denied by --deny-warnings", counted(warnings, "warning")));
        }
        return Err(Failure::WrongScene);
    }
    if args.diagnostics == DiagnosticsForm::Text && !args.quiet {
        let copies: u64 = desc.objects.iter().map(|object| object.value.placements().known_copies()).sum();
        let places = if copies == desc.objects.len() as u64 { String::new() } else { format!(" in {copies} places") };
        let objects = format!("{}{places}", counted(desc.objects.len(), "object"));
        let lights = counted(tracer_core::shining_objects(&scene), "light");
        let frames = frames.count.map_or(String::new(), |frames| format!(", {frames}"));
        let cameras = args_of_scene
            .camera
            .filter(|_| args.camera.is_none())
            .map_or(String::new(), |_| format!(", {} of which none is chosen", counted(desc.cameras.len(), "camera")));
        writeln!(std::io::stdout().lock(), "{name}: ok, {objects}, {lights}{frames}{cameras}")?;
    }
    Ok(())
}
