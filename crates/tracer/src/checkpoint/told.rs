//! What a checkpoint holds, for `tracer info`.

use super::picture::{mattes_told, picture_layers};
use crate::memory::human;
use serde_json::json;
use std::path::Path;
use tracer_core::{Crop, FilmHead, MattesKept, Note, Part};

/// A note of a film; empty where there is none of that name.
pub fn note<'a>(head: &'a FilmHead, name: &str) -> &'a str {
    head.notes.iter().find(|(of, _)| of == name).map_or("", |(_, value)| value)
}

fn files(head: &FilmHead) -> Vec<&str> {
    head.notes.iter().filter_map(|(name, _)| name.strip_prefix("file:")).collect()
}

/// The names of the layers, and `halves` where two halves of the samples are kept; `none` where there is none.
pub fn layers(head: &FilmHead) -> String {
    layers_of(head.layers(), head.has_halves())
}

/// The same of these.
pub fn layers_of<'a>(names: impl Iterator<Item = &'a str>, halves: bool) -> String {
    let names: Vec<&str> = names.chain(halves.then_some("halves")).collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// These names, but for layers that nobody asked for: that of a backdrop, and those that mattes are made of.
pub fn asked_layers(layers: &str, notes: &[Note], backdrop: bool, mattes: MattesKept) -> String {
    let asked = picture_layers(notes);
    let is_asked = |name: &str| asked.is_some_and(|asked| asked.names().any(|layer| layer == name));
    let hidden = |name: &str| match name {
        "alpha" => backdrop,
        "object_id" => mattes.objects,
        "material_id" => mattes.materials,
        _ => false,
    };
    let left: Vec<&str> = layers.split(", ").filter(|name| is_asked(name) || !hidden(name)).collect();
    if left.is_empty() { "none".to_owned() } else { left.join(", ") }
}

/// Light groups by their names; `none` where there is none.
pub fn light_groups(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// What a film is of its rendering: `samples 3 to 5 of 9, rows 0 to 63`.
pub fn part_told(part: Option<Part>) -> String {
    part.map_or("the whole".to_owned(), |Part { crop, first, end, of_samples, .. }| {
        format!(
            "samples {first} to {} of {of_samples}, rows {} to {}",
            end - 1,
            crop.y,
            crop.y + crop.height.max(1) - 1
        )
    })
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
    if head.is_part() {
        line("part", part_told(Some(head.part())));
    }
    let (fewest, most) = samples(head);
    line("samples", if fewest == most { fewest.to_string() } else { format!("{fewest} to {most}") });
    if head.layers().next().is_some() {
        line("layers", layers(head));
    }
    if !head.mattes().is_empty() {
        line("mattes", mattes_told(&head.notes));
    }
    if !head.light_groups().is_empty() {
        line("lights", light_groups(head.light_groups()));
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

/// Samples per pixel: fewest and most.
fn samples(head: &FilmHead) -> (u32, u32) {
    let first = head.part().first;
    (head.samples.start().saturating_sub(first), head.samples.end().saturating_sub(first))
}

/// The same for programs.
pub fn as_json(path: &Path, bytes: u64, head: &FilmHead) -> serde_json::Value {
    let Crop { x, y, width, height } = head.crop;
    let (fewest, most) = samples(head);
    let part = head.is_part().then(|| [head.part().first, head.part().end, head.part().of_samples]);
    json!({
        "checkpoint": path,
        "bytes": bytes,
        "scene": note(head, "scene"),
        "hash": note(head, "hash"),
        "picture": { "width": head.size[0], "height": head.size[1], "crop": [x, y, width, height], "seed": head.seed },
        "part": part,
        "samples_min": fewest,
        "samples_max": most,
        "layers": head.layers().collect::<Vec<_>>(),
        "light_groups": head.light_groups(),
        "mattes": { "objects": head.mattes().objects, "materials": head.mattes().materials },
        "written": note(head, "when"),
        "tracer_version": head.program,
        "files": files(head),
        "memory": { "film": head.bytes() },
    })
}
