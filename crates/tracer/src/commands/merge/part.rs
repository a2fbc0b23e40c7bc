//! `tracer merge -o FILE.tracer`: parts that lie together become one part, so that many machines can merge.

use super::{Sorted, check_film, failure, read, sorted, spare_parts, spare_scene};
use crate::args::MergeArgs;
use crate::checkpoint::part_told;
use crate::failure::{Failure, exit};
use crate::loading::use_threads;
use crate::merge_report::{MergeReport, PartReport};
use crate::report::FileReport;
use crate::shell::{Shell, counted};
use crate::write::Place;
use std::fs::File;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;
use tracer_core::{Film, FilmError, FilmHead, Gaps, Note, SavedFilm};

use super::super::render::{parts, write_report};

/// Whether a part is asked for.
pub(super) fn is_asked(args: &MergeArgs) -> bool {
    args.output.iter().any(|path| path.extension().is_some_and(|extension| extension == parts::EXTENSION))
}

pub(super) fn run(args: &MergeArgs, shell: &Shell, started: Instant) -> Result<ExitCode, Failure> {
    not_of_pictures(args)?;
    let place = parts::place(&args.as_render())?;
    use_threads(args.threads)?;
    let path = place.named().to_owned();
    let written = || std::iter::once(("-o", path.as_path()));
    spare_parts(args, written())?;
    let Sorted { parts, .. } = sorted(read(&args.parts)?, args, Gaps::Around, shell)?;
    let heads: Vec<FilmHead> = parts.iter().map(|(_, head)| head.clone()).collect();
    check_film(&heads[0])?;
    spare_scene(args, written(), &heads)?;
    let open = |part: usize| File::open(&parts[part].0).map_err(FilmError::Io).and_then(SavedFilm::open);
    let film = Film::merge(&heads, open, Gaps::Around).map_err(|error| failure(&error, &parts))?;
    let merged = started.elapsed().as_secs_f64();
    // As of a part that was rendered at once; it says when it was written itself.
    let notes: Vec<Note> = heads[0].notes.iter().filter(|(name, _)| name != "when").cloned().collect();
    let written = parts::save(&Place::File(path.clone()), &film, &notes, shell)?;
    let total = started.elapsed().as_secs_f64();
    if shell.is_told() {
        let (name, of) = (path.display(), counted(parts.len(), "part"));
        shell.say(&format!("{name} of {of} in {total:.2} s: {}", part_told(film.part())));
    }
    if let Some(report) = &args.report {
        let of_parts = parts.iter().map(|(path, head)| PartReport::new(path, &head.part())).collect();
        let layers = heads[0].layers().map(str::to_owned).collect();
        let name = path.display().to_string();
        let file = FileReport { path: name, format: "film", bytes: written.bytes, sha256: written.sha256 };
        let seconds = [merged, 0.0, total - merged, total];
        let told =
            MergeReport::new(args.command(), &film, &heads[0], of_parts, &[], (layers, None), seconds, vec![file]);
        write_report(Path::new(report), told.to_json())?;
    }
    Ok(ExitCode::from(exit::DONE))
}

/// Refuses what is for pictures only.
fn not_of_pictures(args: &MergeArgs) -> Result<(), Failure> {
    let asked = [
        ("--format", args.format.is_some()),
        ("--bits", args.bits.is_some()),
        ("--denoise", args.denoise.is_on()),
        ("--no-metadata", args.no_metadata),
        ("--allow-missing", args.allow_missing),
    ];
    match asked.into_iter().find(|(_, is_asked)| *is_asked) {
        Some((option, _)) => Err(Failure::wrong(format!(
            "{option} is for pictures, and a `.{}` file is a part; give it where the picture is merged",
            parts::EXTENSION
        ))),
        None => Ok(()),
    }
}
