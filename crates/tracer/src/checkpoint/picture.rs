//! What the picture of a film is made with, as notes beside it: so that a film is enough to make it, without the scene.

use super::Record;
use crate::write::{Provenance, Setting, sha256};
use scene_format::SceneDesc;
use scene_format::desc::{Output, ToneMap};
use std::path::Path;
use tracer_core::{Backdrop, Crop, Film, LayerSet, Look, MatteOf, Mattes, Note};

/// How the names of these notes begin.
const NOTE: &str = "picture.";
const TONE_MAPS: [ToneMap; 3] = [ToneMap::None, ToneMap::Filmic, ToneMap::AgX];

/// Of a scene, and the fields of it that the command line has set.
pub fn picture_notes(desc: &SceneDesc, mattes: &Mattes, set: &[String]) -> Vec<Note> {
    let source = desc.sources.first();
    let name = source.map_or("", |source| source.name.as_str());
    let name = Path::new(name).file_name().map_or(name.into(), |name| name.to_string_lossy()).into_owned();
    // A longer one is not put into pictures.
    let text = source.map(|source| source.text.as_str()).filter(|text| text.len() <= Provenance::MAX_SCENE_BYTES);
    let note = |name: &str, value: String| (format!("{NOTE}{name}"), value);
    let mut notes = vec![
        note("scene_name", name),
        note("scene_text", text.unwrap_or_default().to_owned()),
        note("scene_sha256", source.map_or_else(String::new, |source| sha256(source.text.as_bytes()))),
        note("max_bounces", desc.render.max_bounces.value.to_string()),
        note("exposure", desc.effects.exposure.value.to_string()),
        note("tone_map", format!("{:?}", desc.effects.tone_map)),
        note("backdrop", backdrop_note(&desc.output)),
        note("layers", tracer_core::layer_set(&desc.output.layers).names().collect::<Vec<_>>().join(",")),
    ];
    if !mattes.is_empty() {
        notes.push(note("mattes", mattes_note(mattes)));
    }
    notes.extend(set.iter().map(|set| note("set", set.clone())));
    notes
}

/// The note of a layer that is shown in place of the picture.
pub fn show_note(layer: &str) -> Note {
    (format!("{NOTE}show"), layer.to_owned())
}

pub(super) fn all<'a>(notes: &'a [Note], name: &'a str) -> impl Iterator<Item = &'a str> {
    notes.iter().filter(move |(of, _)| of.strip_prefix(NOTE) == Some(name)).map(|(_, value)| value.as_str())
}

pub(super) fn first<'a>(notes: &'a [Note], name: &'a str) -> &'a str {
    all(notes, name).next().unwrap_or_default()
}

/// The layers that are written beside the picture: the film may have more, for denoising. `None` where the notes do not
/// tell.
pub fn picture_layers(notes: &[Note]) -> Option<LayerSet> {
    let names = all(notes, "layers").next()?;
    Some(names.split(',').filter_map(LayerSet::by_name).collect())
}

/// Mattes with all names, as a note.
fn mattes_note(mattes: &Mattes) -> String {
    let Mattes { cryptomatte, masks, objects, materials } = mattes;
    let has = |of: MatteOf| cryptomatte.contains(&of);
    let kinds = [has(MatteOf::Objects), has(MatteOf::Materials)];
    serde_json::json!([kinds, masks, objects, materials]).to_string()
}

/// The mattes of the picture; `None` where the notes do not tell.
pub fn mattes(notes: &[Note]) -> Option<Mattes> {
    let Some(note) = all(notes, "mattes").next() else { return Some(Mattes::default()) };
    let (kinds, masks, objects, materials): ([bool; 2], _, _, _) = serde_json::from_str(note).ok()?;
    let cryptomatte = [MatteOf::Objects, MatteOf::Materials].into_iter().zip(kinds).filter(|(_, has)| *has);
    Some(Mattes { cryptomatte: cryptomatte.map(|(of, _)| of).collect(), masks, objects, materials })
}

/// What mattes there are, for people.
pub fn mattes_told(notes: &[Note]) -> String {
    let names: Vec<String> = mattes(notes).unwrap_or_default().names().collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// What is behind everything, for people.
pub fn backdrop_told(notes: &[Note]) -> &str {
    match first(notes, "backdrop") {
        "" => "the background",
        "clear" => "nothing (alpha)",
        color => color,
    }
}

/// What is behind everything, as a note.
fn backdrop_note(output: &Output) -> String {
    match &output.backdrop {
        _ if output.alpha => "clear".to_owned(),
        Some(color) => color.value.map(|x| x.to_string()).join(" "),
        None => String::new(),
    }
}

/// The same of a note.
fn backdrop(note: &str) -> Option<Backdrop> {
    match note {
        "" => Some(Backdrop::Background),
        "clear" => Some(Backdrop::Clear),
        color => {
            let numbers: Option<Vec<f64>> = color.split(' ').map(|x| x.parse().ok()).collect();
            Some(Backdrop::Color(numbers?.try_into().ok()?))
        }
    }
}

/// How the film is developed; `None` where the notes do not tell.
pub fn look(notes: &[Note]) -> Option<Look> {
    let exposure = first(notes, "exposure").parse().ok().filter(|stops: &f64| stops.is_finite())?;
    let tone_map = first(notes, "tone_map");
    let tone_map = TONE_MAPS.into_iter().find(|of| format!("{of:?}") == tone_map)?;
    Some(Look { exposure, tone_map, backdrop: backdrop(first(notes, "backdrop"))? })
}

/// What picture files tell of themselves: of a picture that was denoised the word for that, too.
pub fn provenance(notes: &[Note], film: &Film, denoised: Option<&str>) -> Provenance {
    let (fewest, most) = film.samples().into_inner();
    let samples = if fewest == most { most.to_string() } else { format!("{fewest} to {most}") };
    let [width, height] = film.size();
    let mut settings = vec![
        Setting { name: "samples", value: samples },
        Setting { name: "seed", value: film.seed().to_string() },
        Setting { name: "size", value: format!("{width}x{height}") },
    ];
    for name in ["max_bounces", "exposure", "tone_map"] {
        settings.push(Setting { name, value: first(notes, name).to_owned() });
    }
    let Crop { x, y, width, height } = film.crop();
    if film.crop() != Crop::whole(film.size()) {
        settings.push(Setting { name: "crop", value: format!("{x},{y},{width},{height}") });
    }
    settings.extend(denoised.map(|how| Setting { name: "denoise", value: how.to_owned() }));
    settings.extend(all(notes, "set").map(|set| Setting { name: "set", value: set.to_owned() }));
    Provenance {
        scene_name: first(notes, "scene_name").to_owned(),
        scene_text: first(notes, "scene_text").to_owned(),
        settings,
        record: Record::new(notes, film, denoised).to_json(),
        is_hidden: false,
    }
}
