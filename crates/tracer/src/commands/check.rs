//! `tracer check`: everything that is wrong with scenes, meshes and textures included.

use crate::args::{CheckArgs, DiagnosticsForm};
use crate::failure::{Failure, exit};
use crate::loading::{compile, load_counting};
use crate::shell::{Shell, counted};
use scene_format::Syntax;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

pub(super) fn run(args: &CheckArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let mut scenes = Vec::new();
    for path in &args.scenes {
        if path.is_dir() {
            let before = scenes.len();
            find(path, &mut scenes);
            if scenes.len() == before {
                return Err(Failure::wrong(format!("there is no scene in the folder {}", path.display())));
            }
        } else {
            scenes.push(path.clone());
        }
    }
    let mut wrong = 0;
    let many = scenes.len();
    for scene in scenes {
        match check(args, scene, shell) {
            Ok(()) => {}
            // The others are checked all the same.
            Err(Failure::WrongScene) => wrong += 1,
            Err(Failure::Wrong(error)) if many > 1 => {
                shell.error(&error);
                wrong += 1;
            }
            Err(failure) => return Err(failure),
        }
    }
    if wrong > 0 && many > 1 {
        shell.error(&anyhow::anyhow!("{wrong} of {many} scenes are wrong"));
    }
    Ok(ExitCode::from(if wrong > 0 { exit::WRONG } else { exit::DONE }))
}

fn check(args: &CheckArgs, scene: PathBuf, shell: &Shell) -> Result<(), Failure> {
    let args_of_scene = args.of(scene);
    let (desc, warnings) = load_counting(&args_of_scene, shell)?;
    let scene = compile(&desc, args.diagnostics, shell)?;
    let name = desc.sources.first().map_or("", |source| source.name.as_str());
    let warnings = warnings + scene.warnings.len();
    if args.deny_warnings && warnings > 0 {
        if args.diagnostics == DiagnosticsForm::Text {
            shell.error(&anyhow::anyhow!("{name}: {}, denied by --deny-warnings", counted(warnings, "warning")));
        }
        return Err(Failure::WrongScene);
    }
    if args.diagnostics == DiagnosticsForm::Text {
        let (objects, lights) = (counted(desc.objects.len(), "object"), counted(scene.lights.len(), "light"));
        writeln!(std::io::stdout().lock(), "{name}: ok, {objects}, {lights}")?;
    }
    Ok(())
}

/// The scenes in a folder and below, in order of their names: `.ron`, and `.toml` that has objects. Hidden folders are left out.
fn find(folder: &Path, scenes: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        // A link may lead back to where it stands.
        if path.is_dir() && !path.is_symlink() && !hidden {
            find(&path, scenes);
        } else if path.is_file() && is_scene(&path) {
            scenes.push(path);
        }
    }
}

/// TOML files are many things.
fn is_scene(path: &Path) -> bool {
    match Syntax::from_path(path) {
        Some(Syntax::Ron) => true,
        Some(Syntax::Toml) => std::fs::read(path).is_ok_and(|bytes| bytes.windows(7).any(|word| word == b"objects")),
        None => false,
    }
}
