//! A checkpoint that is looked for: the film of it, or of the one before where it is damaged.

use super::Place;
use super::identity::{Asked, Extent, differences};
use super::told::layers_of;
use crate::failure::Failure;
use crate::shell::{Shell, Verbosity};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use tracer_core::{Film, FilmError, Note, SavedFilm, Scene};

/// What was found.
pub struct Found {
    /// The film, if there is one.
    pub film: Option<Film>,
    /// The newest file is damaged: it must not replace the one before.
    pub is_spoilt: bool,
}

/// Why one of the two files cannot be used.
enum Fault {
    NotThere,
    Unusable(FilmError),
    Refused(Failure),
}

/// Whether a file begins as a saved film does, as far as it can be read.
pub fn is_film(path: &Path) -> bool {
    // A pipe gives what it has once: it is not opened.
    let Some(file) = Some(path).filter(|path| path.is_file()).and_then(|path| File::open(path).ok()) else {
        return false;
    };
    // Only what opens with the head's first bytes is anything but foreign.
    let head = SavedFilm::open(file.take(16));
    !matches!(head, Err(FilmError::Foreign | FilmError::Io(_))) && !is_empty(path)
}

fn is_empty(path: &Path) -> bool {
    path.metadata().is_ok_and(|found| found.len() == 0)
}

/// The film of a checkpoint, if it belongs to the rendering, which keeps halves of the samples or not.
///
/// # Errors
/// When it belongs to another, or neither it nor the one before can be read.
pub fn look_for(
    place: &Place,
    scene: &Scene,
    halves: bool,
    extent: Extent,
    notes: &[Note],
    shell: &Shell,
) -> Result<Found, Failure> {
    let layers = layers_of(scene.layers.names(), halves);
    let (backdrop, mattes) = (scene.backdrop, scene.mattes.kept());
    let light_groups = scene.light_groups.as_ref().map_or(&[][..], |groups| &groups.names);
    let (size, seed, clamp) = (scene.size, scene.seed, scene.clamp);
    let asked = Asked { size, extent, seed, clamp, layers, backdrop, mattes, light_groups, notes };
    let (name, previous) = (place.name(), format!("{}.previous", place.name()));
    let first = match load(place.file(), &name, &asked) {
        Ok(film) => return Ok(Found { film: Some(film), is_spoilt: false }),
        Err(Fault::Refused(failure)) => return Err(failure),
        Err(fault) => fault,
    };
    let why = match &first {
        Fault::Unusable(error) => format!("{name} cannot be used: {error}"),
        _ => format!("{name} is not there"),
    };
    match (load(&place.previous(), &previous, &asked), first) {
        (Ok(film), first) => {
            shell.say(&format!("warning: {why}; going on from the one before, {previous}"));
            Ok(Found { film: Some(film), is_spoilt: matches!(first, Fault::Unusable(_)) })
        }
        (Err(Fault::NotThere), Fault::NotThere) => {
            if shell.verbosity > Verbosity::Quiet {
                shell.say(&format!("{name} is not there yet: the rendering begins anew"));
            }
            Ok(Found { film: None, is_spoilt: false })
        }
        (Err(Fault::Refused(failure)), _) => Err(failure),
        (Err(fault), _) => {
            let also = match fault {
                Fault::Unusable(error) => format!(", nor the one before, {previous}: {error}"),
                _ => ", and there is none before it".to_owned(),
            };
            Err(Failure::could_not(format!("{why}{also}; name another file to begin anew")))
        }
    }
}

fn load(path: &Path, name: &str, asked: &Asked<'_>) -> Result<Film, Fault> {
    let file = File::open(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => Fault::NotThere,
        _ => Fault::Unusable(error.into()),
    })?;
    let saved = SavedFilm::open(file).map_err(Fault::Unusable)?;
    let differences = differences(saved.head(), asked);
    if !differences.is_empty() {
        return Err(Fault::Refused(Failure::wrong(format!(
            "{name} is of another rendering: {}; name another file, or delete it to begin anew",
            differences.join("; ")
        ))));
    }
    saved.film().map_err(Fault::Unusable)
}
