//! What a picture tells of itself.

use crate::args::InfoArgs;
use crate::checkpoint::Record;
use crate::command_line::{printable, quoted};
use crate::commands::from_picture;
use crate::failure::{Failure, exit};
use crate::loading::is_dash;
use crate::write::{Bits, Encoding};
use serde_json::json;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use tracer_picture::{Told, ToldError};

/// What the file tells, if it is a picture.
///
/// # Errors
/// It is one, and its head is broken.
pub fn told(path: &Path) -> Result<Option<Told>, Failure> {
    if is_dash(path) || !path.is_file() {
        return Ok(None);
    }
    match tracer_picture::told(path) {
        // Reading it as a scene says what is wrong.
        Err(ToldError::Io(_) | ToldError::Foreign) => Ok(None),
        _ => from_picture::told(path).map(Some),
    }
}

pub fn of_picture(args: &InfoArgs, told: &Told) -> Result<ExitCode, Failure> {
    let path = &args.scene.scene;
    if super::is_for_scenes(args) {
        let shown = path.display();
        return Err(Failure::wrong(format!(
            "{shown} is a picture; --objects, --resolved, --set, --camera and --frame are for scenes: `tracer new \
             a.ron --from {}` writes its scene",
            quoted(&path.to_string_lossy())
        )));
    }
    let record = told.record.as_deref().map(Record::read);
    let text = match args.json {
        true => format!("{:#}\n", as_json(path, told, record)),
        false => as_text(path, told, record),
    };
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}

fn bits(encoding: Encoding) -> u32 {
    match encoding {
        Encoding::Png(Bits::Sixteen) => 16,
        Encoding::Exr | Encoding::Pfm => 32,
        _ => 8,
    }
}

fn as_text(path: &Path, told: &Told, record: Option<Result<Record, String>>) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:<11}{}\n", printable(&value));
    let Told { encoding, width, height, software, comment, scene, .. } = told;
    let kind = encoding.name().to_uppercase();
    line("picture", format!("{}, {kind}, {} bits, {width}x{height} pixels", path.display(), bits(*encoding)));
    if !told.layers.is_empty() {
        line("layers", told.layers.join(", "));
    }
    let not_told = || "not told".to_owned();
    let held = scene.as_ref().map_or("its text is not in the picture".to_owned(), |scene| {
        format!("its text is in the picture, {} bytes", scene.len())
    });
    match record {
        None => {
            line("program", software.clone().unwrap_or_else(not_told));
            line("made of", comment.clone().unwrap_or_else(not_told));
            line("scene", held);
            line("again", "not told, so `tracer repro` cannot make it again".to_owned());
        }
        Some(Err(why)) => {
            line("program", software.clone().unwrap_or_else(not_told));
            line("again", why);
        }
        Some(Ok(record)) => {
            line("program", format!("tracer {}", record.program));
            line("scene", format!("{}, {held}", record.scene));
            let [fewest, most] = record.samples;
            let samples = if fewest == most { most.to_string() } else { format!("{fewest} to {most}") };
            line("render", format!("{samples} samples, seed {}", record.seed));
            let picture = path.file_name().unwrap_or_default().to_string_lossy();
            match fewest == most || record.plan.is_some() {
                true => line("again by", record.command(&picture, from_picture::layers(told))),
                false => line("again", "not by a command: it was interrupted within a pass".to_owned()),
            }
            let files = record.files.iter().flatten();
            for (k, file) in files.enumerate() {
                line(if k == 0 { "files" } else { "" }, format!("{}  SHA-256 {}", file.name, file.sha256));
            }
            line(
                "assets",
                record.assets.unwrap_or_else(|| match record.files {
                    Some(_) => "none".to_owned(),
                    None => not_told(),
                }),
            );
        }
    }
    text
}

fn as_json(path: &Path, told: &Told, record: Option<Result<Record, String>>) -> serde_json::Value {
    let picture = path.file_name().unwrap_or_default().to_string_lossy();
    let record = record.and_then(Result::ok);
    json!({
        "picture": path,
        "format": told.encoding.name(),
        "bits": bits(told.encoding),
        "layers": told.layers,
        "width": told.width,
        "height": told.height,
        "software": told.software,
        "comment": told.comment,
        "scene": told.scene,
        "command": record.as_ref().map(|record| record.command(&picture, from_picture::layers(told))),
        "record": record,
    })
}
