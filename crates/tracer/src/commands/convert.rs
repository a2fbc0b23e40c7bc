//! `tracer convert`: a scene in another syntax, comments and all where that has comments.

use crate::args::ConvertArgs;
use crate::failure::{Failure, exit};
use crate::loading::{asset_files, is_dash, read_text, told};
use crate::shell::{Shell, counted};
use crate::write::{is_one_file, save, spare};
use scene_format::{LoadError, Syntax, mentioned_in};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

pub(super) fn run(args: &ConvertArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let output = args.output.as_deref().filter(|path| !is_dash(path));
    let by_name = match output {
        Some(path) => Some(Syntax::from_path(path).ok_or_else(|| {
            Failure::wrong(format!("-o {} is no name for a scene file; expected .ron, .toml or .json", path.display()))
        })?),
        None => None,
    };
    let asked = args.to.map(Syntax::from);
    if let (Some(by_name), Some(asked)) = (by_name, asked)
        && by_name != asked
    {
        return Err(Failure::wrong(format!("--to says {}, but -o names a {} file", asked.name(), by_name.name())));
    }
    if let Some(path) = output {
        if !is_dash(&args.scene) && is_one_file(path, &args.scene) {
            return Err(Failure::wrong(format!("-o {} is the scene itself; name another file", path.display())));
        }
        spare(path, args.force)?;
    }
    let syntax = args.syntax.map(Syntax::from);
    let (name, bytes) = read_text(&args.scene, syntax)?;
    let text = match String::from_utf8(bytes) {
        Ok(text) => text,
        // The reader tells where the fault is.
        Err(error) => {
            let wrong = scene_format::load_bytes(&name, error.into_bytes(), None, Path::new(""), &[]);
            return Err(wrong.err().map_or(Failure::WrongScene, |error| told(error, args.diagnostics, shell)));
        }
    };
    let syntax = syntax.or_else(|| Syntax::from_path(&args.scene));
    let from = syntax.unwrap_or_else(|| Syntax::guess(&text));
    let to = asked.or(by_name).unwrap_or(match from {
        Syntax::Ron => Syntax::Toml,
        Syntax::Toml | Syntax::Json => Syntax::Ron,
    });
    let converted = scene_format::convert(&name, &text, from, to)
        .map_err(|error: LoadError| told(error, args.diagnostics, shell))?;
    match output {
        Some(path) => {
            spare_named(path, args, &name, &text, from)?;
            save(path, converted.as_bytes())?;
            let moves = folder(path) != folder(&args.scene) && !is_dash(&args.scene);
            if moves && names_files(&name, &text, from) {
                shell.say("warning: paths in a scene start from its folder, and this one moves to another folder");
            }
        }
        None => {
            let mut out = std::io::stdout().lock();
            out.write_all(converted.as_bytes())?;
            out.flush()?;
        }
    }
    let comments = if to == Syntax::Json { scene_format::comments(&text, from) } else { 0 };
    if comments > 0 {
        shell.say(&format!(
            "warning: JSON has no comments, so {} {} left out",
            counted(comments, "comment"),
            if comments == 1 { "is" } else { "are" }
        ));
    }
    Ok(ExitCode::from(exit::DONE))
}

/// Sees that the scene that is written replaces no file that the other one names.
fn spare_named(path: &Path, args: &ConvertArgs, name: &str, text: &str, syntax: Syntax) -> Result<(), Failure> {
    // What comes by standard input names files from the folder that one is in.
    let folder = if is_dash(&args.scene) { Some(Path::new("")) } else { args.scene.parent() };
    let Some(folder) = folder.filter(|_| path.is_file()) else { return Ok(()) };
    // What is wrong with it is no matter here: that it names files is.
    let named = scene_format::load_str(name, text, syntax, folder, &[])
        .map_or_else(|_| mentioned_in(name, text, folder), |loaded| loaded.scene.mentioned());
    if named.iter().any(|file| is_one_file(path, file)) {
        let shown = path.display();
        return Err(Failure::wrong(format!("-o {shown} would replace a file that the scene names; name another file")));
    }
    Ok(())
}

/// Whether a scene names files by where they lie from its own folder.
fn names_files(name: &str, text: &str, syntax: Syntax) -> bool {
    let loaded = scene_format::load_bytes(name, text.as_bytes().to_vec(), Some(syntax), Path::new(""), &[]);
    loaded.is_ok_and(|loaded| asset_files(&loaded.scene).into_iter().any(Path::is_relative))
}

/// The folder of a file, as the system sees it.
fn folder(path: &Path) -> Option<PathBuf> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    folder.canonicalize().ok()
}
