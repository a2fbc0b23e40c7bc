//! The files of a rendering: its checkpoint, its pictures, or the part that it is.

use super::asked::Asked;
use super::picture::Picture;
use super::ready::Ready;
use super::rescue::{Pictures, Rescued, pictures, rescue};
use super::{kept, parts};
use crate::failure::Failure;
use crate::report::FileReport;
use crate::write::Place;
use tracer_core::Film;

/// What was written.
pub(super) struct Written {
    /// Pictures, or the part.
    pub files: Vec<FileReport>,
    /// Where the film is kept, or why it is not; none where nobody asks for it.
    pub kept: Option<anyhow::Result<String>>,
    /// A file is not where it was asked for.
    pub elsewhere: bool,
}

impl Written {
    /// Writes all that was asked for but the report.
    ///
    /// # Errors
    /// When the reader of standard output is gone, or the part cannot be written anywhere.
    pub fn of(asked: &mut Asked<'_>, ready: &mut Ready, film: &Film, picture: &Picture) -> Result<Self, Failure> {
        let shell = asked.shell;
        ready.kept.notes.extend(kept::hashed(ready.hashing.take(), shell));
        let denoiser = asked.denoiser.take().filter(|_| picture.denoised.is_some());
        let denoised_by = denoiser.map(|by| by.name().name());
        let provenance = kept::provenance(&asked.args, &ready.kept.notes, film, denoised_by);
        // First, because all else can be made of it. The pictures are written whatever becomes of it.
        let kept = ready.kept.end(film);
        if let Some(Err(error)) = &kept {
            shell.error(error);
        }
        let image = picture.image.as_ref();
        let written = image.map(|image| pictures(&asked.outputs, image, &provenance, shell)).transpose()?;
        let Pictures { mut files, failed: mut elsewhere } = written.unwrap_or_default();
        let is_there = ready.is_kept && matches!(kept, Some(Ok(_)));
        if let Some(Rescued { written, name: path, elsewhere: is_elsewhere }) = part(asked, ready, film, is_there)? {
            elsewhere |= is_elsewhere;
            files.push(FileReport { path, format: "film", bytes: written.bytes, sha256: written.sha256 });
        }
        Ok(Written { files, kept, elsewhere })
    }
}

/// Writes the part, if it is one, unless the checkpoint that is there is just that.
///
/// # Errors
/// When it cannot be written anywhere.
fn part(asked: &Asked<'_>, ready: &Ready, film: &Film, is_there: bool) -> Result<Option<Rescued>, Failure> {
    let Some(file) = &asked.part_file else { return Ok(None) };
    let place = Place::File(file.named().to_owned());
    let rescued = rescue(&place, asked.shell, |place| match is_there {
        true => parts::written(place),
        false => parts::save(place, film, &ready.kept.notes, asked.shell),
    })?;
    Ok(Some(rescued))
}
