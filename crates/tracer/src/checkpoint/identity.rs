//! What a rendering is known by: a checkpoint is gone on with only where all of it is the same.

use super::hashes::{file_note, files_are_told};
use super::picture::{backdrop_told, mattes_told};
use super::{picture_notes, told};
use crate::failure::Failure;
use crate::write::is_one_file;
use scene_format::desc::{Acceleration, Adaptive, ToneMap};
use scene_format::{SceneDesc, hash_hex};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs::File;
use std::io;
use std::mem::{swap, take};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};
use tracer_core::{Crop, FilmHead, Mattes, MattesKept, Note, PROGRAM, Part};

/// Kinds of notes, as their names begin: a value to be shown, a part of the scene by its hash, a file by its own.
const SETTING: &str = "render.";
const PART: &str = "part:";
const FILE: &str = "file:";
/// All that the film depends on: words that are in no part above, too.
const WHOLE: &str = "whole";

/// What is written beside the film: what it is known by, where samples may grow and what makes the picture of the film
/// may change, and how its picture is made; `set` are the fields that the command line has set. The scene is as it was
/// afterwards.
///
/// # Errors
/// When a file of the scene cannot be read any more.
pub fn notes(desc: &mut SceneDesc, mattes: &Mattes, files: &[PathBuf], set: &[String]) -> Result<Vec<Note>, Failure> {
    let name = desc.sources.first().map_or("", |source| source.name.as_str());
    let mut notes: Vec<Note> = vec![("scene".to_owned(), name.to_owned()), ("hash".to_owned(), hash_hex(desc))];
    notes.push((WHOLE.to_owned(), hash_of_film(desc)));
    let render = &desc.render;
    let settings = [
        ("integrator", render.integrator.to_string()),
        ("reuse", format!("{:?}", render.reuse)),
        ("caustics", format!("{:?}", render.caustics)),
        ("max_bounces", render.max_bounces.value.to_string()),
    ];
    notes.extend(settings.map(|(name, value)| (format!("{SETTING}{name}"), value)));
    let mut part = |name: &str, part: &SceneDesc| notes.push((format!("{PART}{name}"), hash_hex(part)));
    let blank = SceneDesc::default;
    part("camera", &SceneDesc { camera: desc.camera.clone(), ..blank() });
    let mut effects = desc.effects.clone();
    (effects.exposure, effects.tone_map) = (0.0.into(), ToneMap::None);
    part("effects", &SceneDesc { effects, ..blank() });
    part("background", &SceneDesc { background: desc.background.clone(), ..blank() });
    // There may be millions of these: they are lent, not copied.
    let mut lent = SceneDesc { lights: take(&mut desc.lights), ..blank() };
    part("lights", &lent);
    swap(&mut lent.lights, &mut desc.lights);
    let swap_materials = |lent: &mut SceneDesc, desc: &mut SceneDesc| {
        swap(&mut lent.textures, &mut desc.textures);
        swap(&mut lent.materials, &mut desc.materials);
    };
    swap_materials(&mut lent, desc);
    part("materials", &lent);
    swap_materials(&mut lent, desc);
    swap(&mut lent.objects, &mut desc.objects);
    part("objects", &lent);
    swap(&mut lent.objects, &mut desc.objects);
    notes.extend(picture_notes(desc, mattes, set));
    for file in files {
        notes.push((file_note(file, &desc.base_dir), hash_of(file)?));
    }
    notes.push(files_are_told());
    Ok(notes)
}

/// Hash of the scene but for what may change: samples, what develops the film, what finds the hits; and but for its
/// layers, that of the backdrop among them, which are named where they differ.
fn hash_of_film(desc: &mut SceneDesc) -> String {
    let render = desc.render.clone();
    let effects = desc.effects.clone();
    let output = take(&mut desc.output);
    // The scene is what it is in this frame and for this camera, whatever others there are.
    let (animation, cameras) = (take(&mut desc.animation), take(&mut desc.cameras));
    desc.render.samples = 1.into();
    (desc.render.noise, desc.render.time, desc.render.adaptive) = (None, None, Adaptive::WithNoise);
    desc.render.acceleration = Acceleration::Bvh;
    (desc.effects.exposure, desc.effects.tone_map) = (0.0.into(), ToneMap::None);
    let hash = hash_hex(desc);
    (desc.render, desc.effects, desc.output) = (render, effects, output);
    (desc.animation, desc.cameras) = (animation, cameras);
    hash
}

/// SHA-256 of a file's contents.
fn hash_of(path: &Path) -> Result<String, Failure> {
    sha256_of(path).map_err(|error| Failure::could_not(format!("cannot read {}: {error}", path.display())))
}

/// Whether a file is one of those that a film's notes name: the scene's own, or one with the contents of any of its
/// files, wherever that lay.
pub fn is_of_scene(path: &Path, notes: &[Note]) -> bool {
    let files = || notes.iter().filter(|(name, _)| name.starts_with(FILE));
    let is_scene = notes.iter().any(|(name, value)| name == "scene" && is_one_file(path, Path::new(value)));
    let hash = || sha256_of(path).ok().filter(|_| path.is_file());
    is_scene || (files().next().is_some() && hash().is_some_and(|hash| files().any(|(_, value)| *value == hash)))
}

/// SHA-256 of a file's contents.
///
/// # Errors
/// When it cannot be read.
pub fn sha256_of(path: &Path) -> io::Result<String> {
    let mut hasher = Sha256::new();
    io::copy(&mut File::open(path)?, &mut HashWriter(&mut hasher))?;
    Ok(hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

struct HashWriter<'a>(&'a mut Sha256);

impl io::Write for HashWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// What a rendering asks a checkpoint for.
pub struct Asked<'a> {
    /// Of the whole picture.
    pub size: [u32; 2],
    /// What of it.
    pub extent: Extent,
    /// Of all random choices.
    pub seed: u32,
    /// `render.clamp`.
    pub clamp: Option<f32>,
    /// Names of the layers; `none` where there is none.
    pub layers: String,
    /// What is behind everything is kept apart.
    pub backdrop: bool,
    /// What is counted for mattes.
    pub mattes: MattesKept,
    /// The names of the light groups that are kept apart.
    pub light_groups: &'a [String],
    /// As [`notes`] gives them.
    pub notes: &'a [Note],
}

/// What of a picture is asked for.
#[derive(Clone, Copy, Debug)]
pub enum Extent {
    /// A film: of these pixels, where it is a part this one.
    Film(Crop, Option<Part>),
    /// A part of a rendering of these pixels with so many samples.
    PartOf(Crop, u32),
}

impl<'a> Asked<'a> {
    /// What another part of the same rendering is asked for.
    pub fn of_part(head: &'a FilmHead) -> Self {
        let Part { of_crop, of_samples, .. } = head.part();
        Asked {
            size: head.size,
            extent: Extent::PartOf(of_crop, of_samples),
            seed: head.seed,
            clamp: head.clamp,
            layers: told::layers(head),
            backdrop: head.has_backdrop(),
            mattes: head.mattes(),
            light_groups: head.light_groups(),
            notes: &head.notes,
        }
    }
}

/// What is not the same there as here, for people.
pub fn differences(head: &FilmHead, asked: &Asked<'_>) -> Vec<String> {
    let mut found = Vec::new();
    let mut compare = |what: &str, there: String, here: String| {
        if there != here {
            found.push(format!("{what} is {there} there and {here} here"));
        }
    };
    compare("the program's version", head.program.clone(), PROGRAM.to_owned());
    let size = |[width, height]: [u32; 2]| format!("{width}x{height}");
    compare("the size", size(head.size), size(asked.size));
    let crop = |Crop { x, y, width, height }: Crop| format!("{x},{y},{width},{height}");
    let part = head.is_part().then(|| head.part());
    match asked.extent {
        Extent::Film(of, asked_part) => {
            if head.size == asked.size && part.is_none() && asked_part.is_none() {
                compare("the crop", crop(head.crop), crop(of));
            }
            compare("the part", told::part_told(part), told::part_told(asked_part));
        }
        Extent::PartOf(of, samples) => {
            compare("the crop", crop(head.part().of_crop), crop(of));
            compare("the number of samples", head.part().of_samples.to_string(), samples.to_string());
        }
    }
    compare("the seed", head.seed.to_string(), asked.seed.to_string());
    let clamp = |limit: Option<f32>| limit.map_or("None".to_owned(), |limit| limit.to_string());
    compare("render.clamp", clamp(head.clamp), clamp(asked.clamp));
    // Of parts one picture is made, so it is the same one; a film alone can be developed otherwise.
    let is_part = matches!(asked.extent, Extent::PartOf(..));
    if is_part || head.has_backdrop() != asked.backdrop {
        compare("the backdrop", backdrop_told(&head.notes).to_owned(), backdrop_told(asked.notes).to_owned());
    }
    if is_part || head.mattes() != asked.mattes {
        compare("the choice of mattes", mattes_told(&head.notes), mattes_told(asked.notes));
    }
    let groups = told::light_groups;
    compare("the set of light groups", groups(head.light_groups()), groups(asked.light_groups));
    let layers = told::layers(head);
    if layers != asked.layers {
        let there = told::asked_layers(&layers, &head.notes, head.has_backdrop(), head.mattes());
        let here = told::asked_layers(&asked.layers, asked.notes, asked.backdrop, asked.mattes);
        compare("the set of layers", there, here);
    }
    note_differences(&mut found, &head.notes, asked.notes);
    found
}

/// What is not the same in notes as [`notes`] gives them; where nothing else was found, that it is the scene.
pub fn note_differences(found: &mut Vec<String>, there: &[Note], here: &[Note]) {
    let (there, here): (BTreeMap<_, _>, BTreeMap<_, _>) =
        (there.iter().cloned().collect(), here.iter().cloned().collect());
    let names = here.keys().chain(there.keys().filter(|name| !here.contains_key(*name)));
    for name in names {
        let (old, new) = (there.get(name), here.get(name));
        if old == new {
            continue;
        }
        let value = |value: Option<&String>| value.map_or("not told", String::as_str).to_owned();
        if name.starts_with(SETTING) {
            compare_notes(found, name, &value(old), &value(new));
        } else if let Some(part) = name.strip_prefix(PART) {
            found.push(format!("`{part}` of the scene has changed"));
        } else if let Some(file) = name.strip_prefix(FILE) {
            found.push(match (old, new) {
                (Some(_), Some(_)) => format!("the contents of {file} have changed"),
                (None, _) => format!("{file} was not part of it"),
                (_, None) => format!("{file} is no part of it any more"),
            });
        }
    }
    if found.is_empty() && there.get(WHOLE) != here.get(WHOLE) {
        found.push("the scene has changed".to_owned());
    }
}

fn compare_notes(found: &mut Vec<String>, what: &str, there: &str, here: &str) {
    found.push(format!("{what} is {there} there and {here} here"));
}

/// The time now, in UTC: `2026-11-24T04:05:06Z`.
pub fn now() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_secs());
    date(seconds)
}

/// Seconds since 1970 as a date (Hinnant, days_from_civil, the other way).
fn date(seconds: u64) -> String {
    let (days, of_day) = (seconds / 86_400 + 719_468, seconds % 86_400);
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    let year = era * 400 + year + next;
    let (hour, minute, second) = (of_day / 3600, of_day / 60 % 60, of_day % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        assert_eq!(date(0), "1970-01-01T00:00:00Z");
        assert_eq!(date(951_782_399), "2000-02-28T23:59:59Z");
        assert_eq!(date(951_782_400), "2000-02-29T00:00:00Z");
        assert_eq!(date(1_767_225_599), "2025-12-31T23:59:59Z");
        assert_eq!(date(4_107_542_400), "2100-03-01T00:00:00Z");
    }
}
