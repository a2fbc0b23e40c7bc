//! `tracer golden new`: a folder becomes one of expected pictures.

use super::examine::nearest;
use crate::args::GoldenNewArgs;
use crate::command_line::quoted;
use crate::failure::{Failure, exit, why};
use crate::loading::expect_scene;
use crate::shell::Shell;
use crate::write::{WriteError, save, spare};
use scene_format::Syntax;
use std::path::{Component, Path, PathBuf};
use std::process::ExitCode;
use tracer_golden::settings::{FILE, Settings};

pub(super) fn run(args: &GoldenNewArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let folder = &args.folder;
    let shown = folder.display();
    args.scenes.iter().try_for_each(|scene| expect_scene(scene))?;
    if folder.is_file() {
        let is_scene = Syntax::from_path(folder).is_some();
        let way = if is_scene {
            format!(
                "name a folder, and the scene by --scene: tracer golden new golden --scene {}",
                quoted(&shown.to_string())
            )
        } else {
            "name a folder".to_owned()
        };
        return Err(Failure::wrong(format!("{shown} is a file, and expected pictures lie in a folder; {way}")));
    }
    let file = folder.join(FILE);
    spare(&file, false).map_err(|error| match error {
        WriteError::There { .. } => Failure::wrong(format!("{} is there already; edit it", file.display())),
        error => error.into(),
    })?;
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::could_not(format!("cannot make {shown}: {}", why(&error))))?;
    let text = text(args, folder)?;
    // What cannot be read again is not written.
    Settings::parse(&text, &nearest).map_err(|wrong| Failure::wrong(format!("{FILE}{wrong}")))?;
    save(&file, text.as_bytes())?;
    if shell.is_told() {
        let folder = quoted(&folder.to_string_lossy());
        shell.say(&format!(
            "made {}; next: tracer golden run {folder}, then: tracer golden accept {folder} --all-failed --reason \
            \"first pictures\"",
            file.display()
        ));
    }
    Ok(ExitCode::from(exit::DONE))
}

fn text(args: &GoldenNewArgs, folder: &Path) -> Result<String, Failure> {
    let mut text = "# Expected pictures: `tracer golden run` compares, docs/golden.md tells the rest.\n".to_owned();
    let string = |value: &str| toml::Value::String(value.to_owned()).to_string();
    if args.scenes.is_empty() {
        text += "# The scenes in this folder and below; scenes = [\"../room.ron\"] names others.\n";
    } else {
        let paths = args
            .scenes
            .iter()
            .map(|scene| Ok(string(&from(folder, scene)?)))
            .collect::<Result<Vec<String>, Failure>>()?;
        text += &format!("scenes = [{}]\n", paths.join(", "));
    }
    if let Some(size) = args.size {
        text += &format!("size = [{}, {}]\n", size.width, size.height);
    }
    if let Some(samples) = args.samples {
        text += &format!("samples = {samples}\n");
    }
    if let Some(seed) = args.seed {
        text += &format!("seed = {seed}\n");
    }
    if let Some(camera) = &args.camera {
        text += &format!("camera = {}\n", string(camera));
    }
    if !args.set.is_empty() {
        text += &format!("set = [{}]\n", args.set.iter().map(|set| string(set)).collect::<Vec<_>>().join(", "));
    }
    if args.bytes {
        text += "# Every byte counts: no noise is kept.\nnoise = false\n";
    }
    Ok(text)
}

/// A path from a folder to a file, with strokes, as it stays right when both are moved together.
fn from(folder: &Path, file: &Path) -> Result<String, Failure> {
    let real = |path: &Path| {
        std::fs::canonicalize(path)
            .map_err(|error| Failure::could_not(format!("cannot find {}: {error}", path.display())))
    };
    let (folder, file) = (real(folder)?, real(file)?);
    let common = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    let path: PathBuf = up.chain(file.components().skip(common)).collect();
    // Nothing in common is another drive.
    let path = if common == 0 { file } else { path };
    Ok(path.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/"))
}
