//! Checkpoints of a rendering: which are read and written, as the command line says.

use super::frames::Frames;
use crate::args::RenderArgs;
use crate::cache::Cache;
use crate::checkpoint::{self, Checkpoints, EVERY, Extent, Found, Hashes, Hashing, Lock, Place};
use crate::checkpoint::{is_film, look_for, notes, picture_notes};
use crate::failure::Failure;
use crate::loading::is_dash;
use crate::shell::{Shell, Verbosity};
use crate::write::{Provenance, WriteError};
use scene_format::SceneDesc;
use tracer_core::{Film, LayerSet, Note, Scene};

/// The places, locked before any work is done.
pub(super) struct Places {
    /// Where to look for a film, and what keeps others off it where it is not the place to write.
    resume: Option<(Place, Option<Lock>)>,
    /// Where to write.
    write: Option<(Place, Lock)>,
}

/// A film to go on with, and who writes it.
pub(super) struct Kept {
    pub film: Option<Film>,
    pub checkpoints: Option<Checkpoints>,
    /// What is told beside the film.
    pub notes: Vec<Note>,
    /// Of a file that is only read.
    _lock: Option<Lock>,
}

impl Kept {
    /// Writes the last checkpoint, where there are any; gives its name.
    pub(super) fn end(&mut self, film: &Film) -> Option<anyhow::Result<String>> {
        self.checkpoints.take().map(|checkpoints| checkpoints.end(film))
    }
}

impl Places {
    /// Whether a file is the one that is written.
    pub(super) fn writes(&self, other: &Place) -> bool {
        self.write.as_ref().is_some_and(|(place, _)| place.is(other))
    }

    /// As the command line names them: `--resume` writes where it reads, unless `--checkpoint` says another place.
    ///
    /// # Errors
    /// What is no place for a checkpoint; another process is at work there.
    pub(super) fn new(args: &RenderArgs, shell: &Shell) -> Result<Self, Failure> {
        let paths = [&args.checkpoint, &args.resume];
        if args.every.is_some() && paths.iter().all(|path| path.is_none()) {
            return Err(Failure::wrong("--every is for checkpoints; name one by --checkpoint or --resume"));
        }
        if paths.into_iter().flatten().any(|path| is_dash(path)) {
            return Err(Failure::wrong("a checkpoint is a file: it cannot be standard input or output"));
        }
        let write = args.checkpoint.as_deref().map(Place::new).transpose()?;
        let resume = args.resume.as_deref().map(|path| match &write {
            // It is only read.
            Some(_) if path.is_file() => {
                Place::unchecked(path).map_err(|why| WriteError::Io { path: path.to_owned(), why }.into())
            }
            _ => Place::new(path),
        });
        let resume: Option<Place> = resume.transpose()?;
        let is_resumed = |place: &Place| resume.as_ref().is_some_and(|resume| resume.is(place));
        if let Some(place) =
            write.as_ref().filter(|place| !is_resumed(place) && place.file().try_exists().unwrap_or(true))
        {
            if !is_film(place.file()) {
                return Err(Failure::wrong(format!(
                    "--checkpoint {} would replace what is no checkpoint, or cannot be read; name another file",
                    place.name()
                )));
            }
            if shell.verbosity > Verbosity::Quiet {
                let name = place.name();
                shell
                    .say(&format!("warning: {name} is there already and is replaced; --resume {name} goes on with it"));
            }
        }
        let resume_lock = match (&resume, &write) {
            (Some(resume), Some(write)) if !resume.is(write) => resume.lock_to_read()?,
            _ => None,
        };
        let write = write.or(resume.clone());
        write.as_ref().map_or(Ok(()), Place::spare_beside)?;
        let write = write.map(|place| place.lock().map(|lock| (place, lock))).transpose()?;
        Ok(Places { resume: resume.map(|place| (place, resume_lock)), write })
    }

    /// Reads what is there.
    ///
    /// # Errors
    /// What is there is of another rendering, or cannot be read.
    pub(super) fn open(
        self,
        args: &RenderArgs,
        desc: &mut SceneDesc,
        scene: &Scene,
        extent: Extent,
        shell: &Shell,
    ) -> Result<Kept, Failure> {
        let Some((place, lock)) = self.write else {
            // Pictures need to tell less of what they are made of than films.
            let notes = match args.part {
                Some(_) => notes(desc, &scene.mattes, &scene.files, &args.scene.sets())?,
                None => picture_notes(desc, &scene.mattes, &args.scene.sets()),
            };
            return Ok(Kept { film: None, checkpoints: None, notes, _lock: None });
        };
        let notes = notes(desc, &scene.mattes, &scene.files, &args.scene.sets())?;
        let (found, _lock) = match self.resume {
            Some((resume, lock)) => {
                let mut found = look_for(&resume, scene, args.denoise.is_on(), extent, &notes, shell)?;
                found.is_spoilt &= resume.is(&place);
                (found, lock)
            }
            None => (Found { film: None, is_spoilt: false }, None),
        };
        let every = args.every.unwrap_or(EVERY);
        let checkpoints = Checkpoints::new(place, lock, every, notes.clone(), found.is_spoilt, *shell);
        Ok(Kept { film: found.film, checkpoints: Some(checkpoints), notes, _lock })
    }
}

/// Begins with the hashes of the scene's files, where the notes have none yet and somebody wants them.
pub(super) fn hashing(
    args: &RenderArgs,
    notes: &[Note],
    scene: &Scene,
    desc: &SceneDesc,
    (frames, cache): (Option<&Frames>, Option<&Cache>),
) -> Option<Hashing> {
    let is_wanted = args.report.is_some() || !args.no_metadata;
    let are_there = notes.iter().any(|(name, _)| *name == checkpoint::files_are_told().0);
    let hashes = frames.map_or_else(|| Hashes::by(cache.map(Cache::hashes)), |frames| frames.hashes.clone());
    (is_wanted && !are_there).then(|| hashes.begin(&scene.files, &desc.base_dir, args.threads))
}

/// The hashes that were begun; that there are none is said.
pub(super) fn hashed(hashing: Option<Hashing>, shell: &Shell) -> Vec<Note> {
    let Some(hashing) = hashing else { return Vec::new() };
    hashing.end().unwrap_or_else(|| {
        shell.say("warning: a file of the scene cannot be read again, so it is not told what the files held");
        Vec::new()
    })
}

/// What pictures tell of themselves, if they may.
pub(super) fn provenance(args: &RenderArgs, notes: &[Note], film: &Film, denoised: Option<&str>) -> Provenance {
    if args.no_metadata {
        return Provenance::hidden();
    }
    let show = args.show.map(|layer| checkpoint::show_note(&LayerSet::from_iter([layer]).to_string()));
    let notes: Vec<Note> = notes.iter().cloned().chain(show).collect();
    checkpoint::provenance(&notes, film, denoised)
}
