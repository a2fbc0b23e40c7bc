//! What a picture was made of, as it tells itself.

use crate::checkpoint::Record;
use crate::failure::{Failure, leads_nowhere, why};
use crate::loading::{is_picture, nearby};
use scene_format::desc::Adaptive;
use scene_format::{LoadError, Loaded, Override, SceneDesc, Syntax};
use std::path::Path;
use tracer_core::{LayerSet, layer_word};
use tracer_picture::{Told, ToldError, told as told_of};

/// What a picture tells of itself.
///
/// # Errors
/// It is no picture, cannot be read, or its head is broken.
pub fn told(picture: &Path) -> Result<Told, Failure> {
    let shown = picture.display();
    if picture.is_dir() {
        return Err(Failure::wrong(format!("cannot read {shown}: it is a folder; name a picture in it")));
    }
    told_of(picture).map_err(|error| match error {
        ToldError::Io(error) if leads_nowhere(&error) => {
            let tip = nearby(picture, is_picture).map_or(String::new(), |near| format!("; did you mean {near}?"));
            Failure::wrong(format!("there is no picture {shown}{tip}"))
        }
        ToldError::Io(error) => Failure::could_not(format!("cannot read {shown}: {}", why(&error))),
        error => Failure::wrong(format!("{shown}: {error}")),
    })
}

/// How it was made.
///
/// # Errors
/// It does not tell.
pub fn record(told: &Told, picture: &Path) -> Result<Record, Failure> {
    let shown = picture.display();
    match &told.record {
        Some(record) => Record::read(record).map_err(|why| Failure::wrong(format!("{shown}: {why}"))),
        None => Err(Failure::wrong(format!(
            "{shown} does not tell how it was made: only PNG and EXR files from `tracer render` and `tracer merge` do, \
             unless --no-metadata or another program has taken it away"
        ))),
    }
}

/// The layers that a picture has beside it.
pub fn layers(told: &Told) -> LayerSet {
    told.layers.iter().filter_map(|name| LayerSet::by_name(name)).collect()
}

/// The scene's text read, with fields set.
///
/// # Errors
/// What is wrong with it.
pub fn load(name: &str, text: &str, folder: &Path, set: &[String]) -> Result<SceneDesc, LoadError> {
    let overrides: Vec<Override> = set.iter().cloned().map(Override::from).collect();
    let load = |syntax| scene_format::load_str(name, text, syntax, folder, &overrides);
    let (by_name, by_looks) = (Syntax::from_path(Path::new(name)), Syntax::guess(text));
    let loaded = match load(by_name.unwrap_or(by_looks)) {
        // --syntax may have said that it is another than its name says.
        Err(error) if by_name.is_some_and(|by_name| by_name != by_looks) => load(by_looks).map_err(|_| error),
        loaded => loaded,
    };
    loaded.map(|Loaded { scene, .. }| scene)
}

/// The scene as it was rendered: with all that the command line had set.
///
/// # Errors
/// What is wrong with it.
pub fn rendered(record: &Record, layers: LayerSet, text: &str, folder: &Path) -> Result<SceneDesc, LoadError> {
    let mut desc = load(&record.scene, text, folder, &record.set)?;
    let [width, height] = record.size;
    (desc.image.width, desc.image.height) = (width.into(), height.into());
    desc.render.samples = record.plan().map_or(record.samples[0], |plan| plan.end).into();
    desc.render.seed = record.seed.into();
    desc.effects.exposure = record.exposure.into();
    // They have ended where the samples tell.
    (desc.render.noise, desc.render.time) = (None, None);
    if record.adaptive {
        desc.render.adaptive = Adaptive::Always;
    }
    for layer in layers.iter().map(layer_word) {
        if !desc.output.layers.contains(&layer) {
            desc.output.layers.push(layer);
        }
    }
    Ok(desc)
}
