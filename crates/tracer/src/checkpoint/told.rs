//! What a checkpoint holds, for `tracer info`.

use crate::memory::human;
use serde_json::json;
use std::path::Path;
use tracer_core::{Crop, FilmHead};

fn note<'a>(head: &'a FilmHead, name: &str) -> &'a str {
    head.notes.iter().find(|(of, _)| of == name).map_or("", |(_, value)| value)
}

fn files(head: &FilmHead) -> Vec<&str> {
    head.notes.iter().filter_map(|(name, _)| name.strip_prefix("file:")).collect()
}

/// The names of the layers; `none` where there is none.
pub fn layers(head: &FilmHead) -> String {
    let names: Vec<&str> = head.layers().collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// A few lines for people.
pub fn as_text(path: &Path, bytes: u64, head: &FilmHead) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:<11}{value}\n");
    line("checkpoint", format!("{}, {}, whole", path.display(), human(bytes)));
    line("scene", note(head, "scene").to_owned());
    let Crop { x, y, width, height } = head.crop;
    let part =
        if head.crop == Crop::whole(head.size) { String::new() } else { format!(", of it {x},{y},{width},{height}") };
    line("picture", format!("{}x{} pixels{part}, seed {}", head.size[0], head.size[1], head.seed));
    let (fewest, most) = head.samples.clone().into_inner();
    line("samples", if fewest == most { fewest.to_string() } else { format!("{fewest} to {most}") });
    if head.layers().next().is_some() {
        line("layers", layers(head));
    }
    line("written", note(head, "when").to_owned());
    line("program", head.program.clone());
    for (k, file) in files(head).into_iter().enumerate() {
        line(if k == 0 { "files" } else { "" }, file.to_owned());
    }
    line("memory", format!("film {}", human(head.bytes())));
    line("hash", note(head, "hash").to_owned());
    text
}

/// The same for programs.
pub fn as_json(path: &Path, bytes: u64, head: &FilmHead) -> serde_json::Value {
    let Crop { x, y, width, height } = head.crop;
    json!({
        "checkpoint": path,
        "bytes": bytes,
        "scene": note(head, "scene"),
        "hash": note(head, "hash"),
        "picture": { "width": head.size[0], "height": head.size[1], "crop": [x, y, width, height], "seed": head.seed },
        "samples_min": head.samples.start(),
        "samples_max": head.samples.end(),
        "layers": head.layers().collect::<Vec<_>>(),
        "written": note(head, "when"),
        "tracer_version": head.program,
        "files": files(head),
        "memory": { "film": head.bytes() },
    })
}
