//! What must be the same for a farm to be gone on with.

use super::record::{Record, VERSION, whole};
use crate::args::{FarmSlurmArgs, SplitName};
use crate::cache::Cache;
use crate::checkpoint::{mattes_told, note_differences, notes};
use crate::failure::Failure;
use crate::loading::{Known, compile};
use crate::shell::Shell;
use crate::write::Bits;
use scene_format::SceneDesc;
use std::path::Path;
use tracer_core::{Crop, Note, PROGRAM};

/// A word that a script and `farm.json` can hold.
///
/// # Errors
/// When it is no text.
pub fn text(path: &Path) -> Result<String, Failure> {
    let shown = path.display();
    path.to_str().map(str::to_owned).ok_or_else(|| Failure::wrong(format!("the name {shown} is no UTF-8: rename it")))
}

/// The record of a farm that has submitted nothing yet. The scene is compiled: what is wrong with it is told here once,
/// and not by every part.
///
/// # Errors
/// The scene is wrong.
pub fn record(args: &FarmSlurmArgs, desc: &mut SceneDesc, shell: &Shell) -> Result<Record, Failure> {
    // What is kept here no part has to build.
    let cache = Cache::open(&args.cache, None, shell)?;
    let known = cache.as_ref().map_or(Known::Nothing, Known::Cached);
    let scene = compile(desc, args.scene.diagnostics, known, shell);
    if let Some(cache) = &cache {
        cache.finish();
    }
    let scene = scene?;
    let directory = std::env::current_dir()
        .map_err(|error| Failure::could_not(format!("cannot tell the current folder: {error}")))?;
    let pictures = args.output.iter().map(|path| text(path)).collect::<Result<Vec<_>, _>>()?;
    let places = args.output.iter().map(|path| text(&whole(path)?)).collect::<Result<Vec<_>, Failure>>()?;
    let notes = notes(desc, &scene.mattes, &scene.files, &args.scene.sets())?;
    let settings = settings(args, desc, &places, scene.clamp, &notes);
    Ok(Record {
        farm_version: VERSION,
        command: std::iter::once("tracer".to_owned())
            .chain(std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned()))
            .collect(),
        directory: text(&directory)?,
        scene: text(&args.scene.scene)?,
        pictures,
        parts: args.parts,
        settings,
        notes,
        arrays: Vec::new(),
        merge: None,
    })
}

fn settings(
    args: &FarmSlurmArgs,
    desc: &SceneDesc,
    places: &[String],
    clamp: Option<f32>,
    notes: &[Note],
) -> Vec<Note> {
    let backdrop = notes.iter().find(|(name, _)| name == "picture.backdrop").map_or("", |(_, value)| value);
    let [width, height] = [desc.image.width.value, desc.image.height.value];
    let split = match args.split {
        None => "not told",
        Some(SplitName::Samples) => "samples",
        Some(SplitName::Rows) => "rows",
    };
    let bits = match args.bits {
        None => "not told",
        Some(Bits::Eight) => "8",
        Some(Bits::Sixteen) => "16",
    };
    let crop =
        args.crop.map_or("the whole".to_owned(), |Crop { x, y, width, height }| format!("{x},{y},{width},{height}"));
    let layers: Vec<&str> = tracer_core::film_layers(&desc.output).names().collect();
    let layers = if layers.is_empty() { "none".to_owned() } else { layers.join(", ") };
    [
        ("the program's version", PROGRAM.to_owned()),
        ("the number of parts", args.parts.to_string()),
        ("--split", split.to_owned()),
        ("the size", format!("{width}x{height}")),
        ("the crop", crop),
        ("the number of samples", desc.render.samples.value.to_string()),
        ("render.adaptive", format!("{:?}", desc.render.adaptive)),
        ("the seed", desc.render.seed.value.to_string()),
        ("render.clamp", clamp.map_or("None".to_owned(), |limit| limit.to_string())),
        ("the set of layers", layers),
        ("the choice of mattes", mattes_told(notes)),
        ("light groups", if desc.output.light_groups { "on" } else { "off" }.to_owned()),
        ("--denoise", args.denoise.how().name().to_owned()),
        ("--no-metadata", if args.no_metadata { "on" } else { "off" }.to_owned()),
        ("the exposure", desc.effects.exposure.value.to_string()),
        ("the tone map", format!("{:?}", desc.effects.tone_map)),
        ("--bits", bits.to_owned()),
        ("the backdrop", if backdrop.is_empty() { "the background" } else { backdrop }.to_owned()),
        ("-o", places.join(", ")),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .to_vec()
}

/// What is not the same there as here, for people.
pub fn differences(there: &Record, here: &Record) -> Vec<String> {
    let value = |of: &Record, name: &str| {
        let found = of.settings.iter().find(|(of, _)| of == name);
        found.map_or("not told", |(_, value)| value.as_str()).to_owned()
    };
    let told = |(name, here): &Note| {
        let there = value(there, name);
        (there != *here).then(|| format!("{name} is {there} there and {here} here"))
    };
    let mut found: Vec<String> = here.settings.iter().filter_map(told).collect();
    note_differences(&mut found, &there.notes, &here.notes);
    found
}
