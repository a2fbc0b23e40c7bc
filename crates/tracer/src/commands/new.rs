//! `tracer new`: a small scene that renders well, to start from, or the scene that a picture was rendered of.

use super::from_picture;
use crate::args::{DiagnosticsForm, NewArgs};
use crate::command_line::{printable, quoted};
use crate::failure::{Failure, exit};
use crate::loading::{is_dash, told as told_load, with_faults_of_files};
use crate::shell::Shell;
use crate::write::{is_one_file, save, spare};
use clap::ValueEnum;
use scene_format::{Defaults, SceneDesc, Syntax, hash_hex, to_text};
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use tracer_core::Crop;

/// What to start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Template {
    /// A ball on a floor
    Ball,
    /// Every material, side by side
    Materials,
    /// A closed room with a lamp and two balls
    Room,
}

impl Template {
    /// Its text, in RON.
    pub fn text(self) -> &'static str {
        match self {
            Template::Ball => include_str!("../../templates/ball.ron"),
            Template::Materials => include_str!("../../templates/materials.ron"),
            Template::Room => include_str!("../../templates/room.ron"),
        }
    }
}

pub(super) fn run(args: &NewArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let path = &args.scene;
    let shown = path.display();
    let syntax = match is_dash(path) {
        true => Syntax::Ron,
        false => Syntax::from_path(path).ok_or_else(|| {
            Failure::wrong(format!("{shown} is no name for a scene file; expected .ron, .toml or .json at its end"))
        })?,
    };
    if let Some(picture) = args.from.as_ref().filter(|picture| is_one_file(path, picture)) {
        return Err(Failure::wrong(format!("{shown} is the picture itself ({}); name a new file", picture.display())));
    }
    if !is_dash(path) {
        spare(path, args.force)?;
    }
    let Made { text, options } = match &args.from {
        Some(picture) => of_picture(picture, args, syntax, shell)?,
        None => {
            let text = of_template(args.template, syntax)?;
            Made { text: if is_dash(path) { text } else { named(&text, path) }, options: Vec::new() }
        }
    };
    if is_dash(path) {
        let mut out = std::io::stdout().lock();
        out.write_all(text.as_bytes())?;
        out.flush()?;
        return Ok(ExitCode::from(exit::DONE));
    }
    save(path, text.as_bytes())?;
    if shell.is_told() {
        let picture = path.with_extension("png");
        let words = ["tracer", "render", &path.to_string_lossy(), "-o", &picture.to_string_lossy()].map(quoted);
        let options = options.iter().map(|word| quoted(word));
        let command = words.into_iter().chain(options).collect::<Vec<_>>().join(" ");
        shell.say(&format!("made {shown}; see it by: {command}"));
    }
    Ok(ExitCode::from(exit::DONE))
}

/// A scene file's text, and the options that belong to its picture beside.
struct Made {
    text: String,
    options: Vec<String>,
}

fn of_template(template: Template, syntax: Syntax) -> Result<String, Failure> {
    in_syntax("template", template.text(), Syntax::Ron, syntax)
}

/// The command that renders a template, which stands in its comment, for a file of this name.
fn named(text: &str, path: &Path) -> String {
    let name = |path: &Path| quoted(&path.file_name().unwrap_or_default().to_string_lossy());
    let command = format!("tracer render {} -o {}", name(path), name(&path.with_extension("png")));
    text.replace("tracer render ball.ron -o ball.png", &command)
}

fn in_syntax(name: &str, text: &str, from: Syntax, to: Syntax) -> Result<String, Failure> {
    if from == to {
        return Ok(text.to_owned());
    }
    scene_format::convert(name, text, from, to).map_err(|error| Failure::could_not(error.to_string()))
}

/// The scene that a picture was rendered of. Its own text, with comments, where that alone is the scene; else what the
/// program has read, with all that options had set.
fn of_picture(picture: &Path, args: &NewArgs, syntax: Syntax, shell: &Shell) -> Result<Made, Failure> {
    let told = from_picture::told(picture)?;
    let shown = picture.display();
    let Some(text) = &told.scene else {
        return Err(Failure::wrong(format!("{shown} does not hold the text of its scene")));
    };
    let folder = args.scene.parent().unwrap_or(Path::new(""));
    let wrong = |error| told_load(with_faults_of_files(error, folder), DiagnosticsForm::Text, shell);
    let record = match &told.record {
        Some(_) => Some(from_picture::record(&told, picture)?),
        None => None,
    };
    let name = record.as_ref().map_or("scene.txt".to_owned(), |record| record.scene.clone());
    let name = name.as_str();
    let plain = from_picture::load(name, text, folder, &[]).map_err(wrong)?;
    if args.scene.is_file() && plain.mentioned().iter().any(|file| is_one_file(&args.scene, file)) {
        let scene = args.scene.display();
        return Err(Failure::wrong(format!("{scene} is a file that the scene names; name a new file")));
    }
    let by_name = Syntax::from_path(Path::new(name));
    let from = by_name.filter(|by_name| *by_name == Syntax::guess(text)).unwrap_or_else(|| Syntax::guess(text));
    let Some(record) = record.filter(|_| !args.as_written) else {
        if told.record.is_none() && shell.is_told() {
            shell.say(&format!("warning: {shown} does not tell its options; the scene is as it was written"));
        }
        tell_missing(&plain, shell);
        return Ok(Made { text: in_syntax(name, text, from, syntax)?, options: Vec::new() });
    };
    let desc = from_picture::rendered(&record, from_picture::layers(&told), text, folder).map_err(wrong)?;
    tell_missing(&desc, shell);
    let [x, y, width, height] = record.crop;
    let mut options = Vec::new();
    if record.crop() != Crop::whole(record.size) {
        options.extend(["--crop".to_owned(), format!("{x},{y},{width},{height}")]);
    }
    options.extend(record.denoise.iter().map(|how| format!("--denoise={}", printable(how))));
    if hash_hex(&plain) == hash_hex(&desc) {
        return Ok(Made { text: in_syntax(name, text, from, syntax)?, options });
    }
    if shell.is_told() && scene_format::comments(text, from) > 0 {
        shell.say("what options had set is in the scene; its comments are not: --as-written writes it as it was");
    }
    Ok(Made { text: to_text(&desc, syntax, Defaults::Hidden), options })
}

/// Says which files of the scene are not there.
fn tell_missing(desc: &SceneDesc, shell: &Shell) {
    for file in tracer_core::named_files(desc).iter().filter(|file| !file.exists()) {
        let shown = printable(&file.display().to_string());
        shell.say(&format!("warning: {shown} is not there; paths in a scene start from its folder"));
    }
}
