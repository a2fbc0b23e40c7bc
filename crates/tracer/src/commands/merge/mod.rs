//! `tracer merge`: the parts of a rendering become its pictures, or a larger part.

mod part;

use super::render::outputs::{self, Output};
use super::render::parts;
use super::render::rescue::{Pictures, pictures};
use super::render::write_report;
use crate::args::{DenoiseName, MergeArgs};
use crate::checkpoint::{Asked, differences, is_of_scene, look, mattes, part_told, picture_layers, provenance};
use crate::denoising::{self, Denoiser, Developed};
use crate::failure::{Failure, exit, leads_nowhere, why};
use crate::loading::{is_dash, nearby, use_threads};
use crate::memory;
use crate::merge_report::{MergeReport, PartReport};
use crate::shell::{Shell, counted};
use crate::write::{Place, Provenance, is_one_file, leads_to_same};
use rayon::prelude::*;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use tracer_core::{Backdrop, Film, FilmError, FilmHead, Gap, Gaps, MergeError, Part, SavedFilm, film_faults};

pub(super) fn run(args: &MergeArgs, shell: &Shell, started: Instant) -> Result<ExitCode, Failure> {
    if part::is_asked(args) {
        return part::run(args, shell, started);
    }
    let as_rendered = args.as_render();
    let outputs = outputs::outputs(&as_rendered)?;
    use_threads(args.threads)?;
    outputs::probe(&outputs, args.report.as_deref())?;
    spare_parts(args, files(&outputs))?;
    let denoiser = Denoiser::ready(args.denoise.how())?;
    let found = read(&args.parts)?;
    let allowed = if args.allow_missing { Gaps::Allowed } else { Gaps::Refused };
    let Sorted { parts, gaps } = sorted(found, args, allowed, shell)?;
    let heads: Vec<FilmHead> = parts.iter().map(|(_, head)| head.clone()).collect();
    spare_scene(args, files(&outputs), &heads)?;
    outputs::spare_others(&outputs, args.report.as_deref())?;
    if args.denoise.is_on() {
        denoising::check(heads[0].has_halves(), heads[0].layers())?;
    }
    check_memory(&heads[0], args.denoise.how())?;
    let film = film_of(&parts, &heads, allowed, shell)?;
    let merged = started.elapsed().as_secs_f64();

    // Of the first in the rendering's own order: so the order of the command line does not show.
    let notes = &heads[0].notes;
    let first = &parts[0].0;
    let look = look(notes).ok_or_else(|| {
        Failure::wrong(format!("{} does not tell how its picture is developed; render it again", first.display()))
    })?;
    if look.backdrop == Backdrop::Clear {
        outputs::tell_of_alpha(&outputs, shell);
    }
    let layers = picture_layers(notes).unwrap_or(film.layers());
    let developed = denoising::picture((&film, false), &look, layers, denoiser.as_ref(), shell)?;
    let is_noisy = developed.is_noisy(shell);
    let Developed { mut image, denoised, .. } = developed;
    let mattes = mattes(notes).unwrap_or_default();
    if outputs::has_exr(&outputs) {
        image.mattes = mattes.develop(&film);
    }
    let developed = started.elapsed().as_secs_f64();
    let provenance = match args.no_metadata {
        true => Provenance::hidden(),
        false => provenance(notes, &film, denoiser.filter(|_| denoised.is_some()).map(|by| by.name().name())),
    };
    let Pictures { files, failed } = pictures(&outputs, &image, &provenance, shell)?;
    let total = started.elapsed().as_secs_f64();
    if let Some(denoised) = denoised.as_ref().filter(|_| shell.is_told()) {
        shell.say(&denoised.to_text());
    }
    if shell.is_told() {
        let names = outputs::names(&files);
        let (fewest, most) = film.samples().into_inner();
        let samples = if fewest == most { most.to_string() } else { format!("{fewest} to {most}") };
        let of = counted(parts.len(), "part");
        shell.say(&format!("{names} of {of} in {total:.2} s, {samples} samples per pixel"));
    }
    if let Some(path) = &args.report {
        let of_parts = parts.iter().map(|(path, head)| PartReport::new(path, &head.part())).collect();
        let seconds = [merged, developed - merged, total - developed, total];
        let layers = layers.names().map(str::to_owned).chain(mattes.names()).collect();
        let report =
            MergeReport::new(args.command(), &film, &heads[0], of_parts, &gaps, (layers, denoised), seconds, files);
        write_report(path, report.to_json())?;
    }
    Ok(ExitCode::from(if failed || is_noisy { exit::FAILED } else { exit::DONE }))
}

/// The film of the parts; of a checkpoint alone, however far it is, what it holds.
fn film_of(parts: &[Head], heads: &[FilmHead], allowed: Gaps, shell: &Shell) -> Result<Film, Failure> {
    let open = |part: usize| File::open(&parts[part].0).map_err(FilmError::Io).and_then(SavedFilm::open);
    if !is_begun(parts) {
        return Film::merge(heads, open, allowed).map_err(|error| failure(&error, parts));
    }
    let path = parts[0].0.display();
    let film = open(0).and_then(SavedFilm::film);
    let film = film.map_err(|error| Failure::wrong(format!("{path} cannot be used: {error}")))?;
    let (fewest, most) = film.samples().into_inner();
    shell.say(&format!("{path} holds {fewest} to {most} samples per pixel; --resume {path} goes on"));
    Ok(film)
}

/// Whether it is the checkpoint of a whole rendering that was ended within a pass.
fn is_begun(parts: &[Head]) -> bool {
    matches!(parts, [(_, head)] if !head.is_part() && !head.is_finished() && *head.samples.end() > 0)
}

/// The pictures that are files.
fn files(outputs: &[Output]) -> impl Iterator<Item = (&'static str, &Path)> {
    outputs.iter().filter_map(|output| match &output.place {
        Place::File(path) => Some(("-o", path.as_path())),
        Place::Stdout => None,
    })
}

/// The report, where it is a file.
fn report(args: &MergeArgs) -> Option<(&'static str, &Path)> {
    args.report.as_deref().filter(|report| !is_dash(report)).map(|report| ("--report", report))
}

/// Sees that nothing that is written replaces a file of the scene, as the parts know those.
fn spare_scene<'a>(
    args: &'a MergeArgs,
    written: impl Iterator<Item = (&'static str, &'a Path)>,
    heads: &[FilmHead],
) -> Result<(), Failure> {
    for (option, path) in written.chain(report(args)).filter(|(_, path)| path.is_file()) {
        if heads.iter().any(|head| is_of_scene(path, &head.notes)) {
            let shown = path.display();
            return Err(Failure::wrong(format!(
                "{option} {shown} would replace a file of the scene; name another file"
            )));
        }
    }
    Ok(())
}

/// Sees that nothing that is written replaces a part.
fn spare_parts<'a>(
    args: &'a MergeArgs,
    written: impl Iterator<Item = (&'static str, &'a Path)>,
) -> Result<(), Failure> {
    for (option, path) in written.chain(report(args)) {
        if args.parts.iter().any(|part| is_one_file(path, part)) {
            return Err(Failure::wrong(format!("{option} {} would replace a part; name another file", path.display())));
        }
    }
    Ok(())
}

/// A file and its head.
type Head = (PathBuf, FilmHead);

/// What the named files hold.
struct Found {
    /// The parts that are whole.
    parts: Vec<Head>,
    /// What is wrong with the others.
    lost: Vec<String>,
    /// Whether one of the others is not there: then the command line is wrong.
    is_misnamed: bool,
}

impl Found {
    /// How it ends where what was found is not enough.
    fn failure(is_misnamed: bool, lost: &[String]) -> Failure {
        let told = lost.join("\n  ");
        if is_misnamed { Failure::wrong(told) } else { Failure::could_not(told) }
    }
}

/// The parts that are whole, and what is wrong with the others. Every file is read to its end before anything is made
/// of any.
fn read(paths: &[PathBuf]) -> Result<Found, Failure> {
    for (k, path) in paths.iter().enumerate() {
        if is_dash(path) {
            return Err(Failure::wrong("parts are files, which are read twice: standard input cannot be one"));
        }
        if paths[..k].iter().any(|other| leads_to_same(other, path)) {
            return Err(Failure::wrong(format!("{} is named twice; name each part once", path.display())));
        }
    }
    let check = |path: &PathBuf| {
        let file = File::open(path).map_err(FilmError::Io);
        file.and_then(SavedFilm::open).and_then(SavedFilm::check).map(|head| (path.clone(), head))
    };
    let checked: Vec<Result<Head, FilmError>> = paths.par_iter().map(check).collect();
    let mut found = Found { parts: Vec::new(), lost: Vec::new(), is_misnamed: false };
    for (path, checked) in paths.iter().zip(checked) {
        let shown = path.display();
        match checked {
            Ok(part) => found.parts.push(part),
            Err(FilmError::Io(error)) if leads_nowhere(&error) => {
                let is_part = |name: &Path| name.extension().is_some_and(|extension| extension == parts::EXTENSION);
                // One that is named already is not meant.
                let near = nearby(path, is_part).filter(|near| !paths.iter().any(|path| path == Path::new(near)));
                let tip = near.map_or(String::new(), |near| format!("; did you mean {near}?"));
                found.lost.push(format!("there is no part {shown}{tip}"));
                found.is_misnamed = true;
            }
            Err(FilmError::Io(_)) if path.is_dir() => {
                found.lost.push(format!("{shown} is a folder; name the parts in it"));
                found.is_misnamed = true;
            }
            Err(FilmError::Io(error)) => {
                found.lost.push(format!("{shown} cannot be used: it cannot be read: {}", why(&error)));
            }
            Err(FilmError::Foreign) => {
                return Err(Failure::wrong(format!(
                    "{shown} is no part; parts are made by `tracer render SCENE --part K/N`"
                )));
            }
            Err(error) => found.lost.push(format!("{shown} cannot be used: {error}")),
        }
    }
    Ok(found)
}

/// Parts that belong together, in the rendering's own order.
struct Sorted {
    parts: Vec<Head>,
    gaps: Vec<Gap>,
}

/// Sees that the parts belong together; all that is wrong is told at once.
fn sorted(found: Found, args: &MergeArgs, allowed: Gaps, shell: &Shell) -> Result<Sorted, Failure> {
    let Found { mut parts, mut lost, is_misnamed } = found;
    if is_begun(&parts) && lost.is_empty() {
        return Ok(Sorted { parts, gaps: Vec::new() });
    }
    parts.sort_by_key(|(path, head)| (head.part().first, head.part().crop.y, path.clone()));
    let mut wrong = foreign(&parts);
    let mut gaps = Vec::new();
    if wrong.is_empty() {
        parts.retain(|(path, head)| {
            if !head.is_finished() {
                let Part { first, end, .. } = head.part();
                let (held, asked) = (head.samples.start().saturating_sub(first), end - first);
                lost.push(format!("{} is not finished: it has {held} of {asked} samples per pixel", path.display()));
            }
            head.is_finished()
        });
        let heads: Vec<FilmHead> = parts.iter().map(|(_, head)| head.clone()).collect();
        for fault in film_faults(&heads, allowed) {
            match fault {
                MergeError::Missing(missing) => gaps = missing,
                MergeError::Empty => {}
                fault => wrong.push(told(&fault, &parts)),
            }
        }
    }
    let missing: Vec<String> = gaps.iter().map(|gap| format!("missing: {}", of_gap(gap))).collect();
    if !wrong.is_empty() {
        wrong.extend(lost);
        return Err(Failure::wrong(wrong.join("\n  ")));
    }
    if parts.is_empty() {
        lost.push("no part is left to be merged".to_owned());
        return Err(Found::failure(is_misnamed, &lost));
    }
    lost.extend(missing);
    if !args.allow_missing && !lost.is_empty() {
        lost.push(match allowed {
            Gaps::Around => "parts that become one must lie together: add what is missing between them".to_owned(),
            _ => "render what is missing, or leave it out of the picture by --allow-missing".to_owned(),
        });
        return Err(Found::failure(is_misnamed, &lost));
    }
    lost.iter().for_each(|line| shell.say(&format!("warning: {line}")));
    Ok(Sorted { parts, gaps })
}

/// Parts that are of another rendering than most of them, and in what.
fn foreign(parts: &[Head]) -> Vec<String> {
    let differs = |part: &FilmHead, from: &FilmHead| differences(part, &Asked::of_part(from));
    let alike = |of: &Head| parts.iter().filter(|other| differs(&other.1, &of.1).is_empty()).count();
    // Of so many as there are of one rendering, any will do; usually the first.
    let Some(of) = parts.iter().find(|part| 2 * alike(part) > parts.len()).or(parts.first()) else { return Vec::new() };
    let others = parts.iter().map(|(path, head)| (path, differs(head, &of.1)));
    let line = |(path, found): (&PathBuf, Vec<String>)| {
        let (path, of) = (path.display(), of.0.display());
        format!("{path} is of another rendering than {of} (here): {}", found.join("; "))
    };
    others.filter(|(_, found)| !found.is_empty()).map(line).collect()
}

fn of_gap(Gap { rows, samples }: &Gap) -> String {
    format!("samples {} to {} of rows {} to {}", samples.start, samples.end - 1, rows.start, rows.end - 1)
}

/// A fault with the names of files.
fn told(fault: &MergeError, parts: &[Head]) -> String {
    let name = |part: usize| parts[part].0.display();
    match fault {
        MergeError::Overlap { first, second } => {
            let of = |part: usize| part_told(Some(parts[part].1.part()));
            format!(
                "{} ({}) and {} ({}) have the same samples; leave one out",
                name(*first),
                of(*first),
                name(*second),
                of(*second)
            )
        }
        MergeError::Foreign { part, what } => {
            format!("{} is of another rendering than {}: it has another {what}", name(*part), name(0))
        }
        MergeError::Unfinished { part } => format!("{} is not finished", name(*part)),
        MergeError::Part { part, error } => format!("{} cannot be used: {error}", name(*part)),
        fault => fault.to_string(),
    }
}

fn failure(fault: &MergeError, parts: &[Head]) -> Failure {
    Failure::could_not(told(fault, parts))
}

/// A film that cannot fit is refused here; it is of all rows at most.
fn check_film(head: &FilmHead) -> Result<(), Failure> {
    fits(head, 0)
}

/// A picture that cannot fit is refused here.
fn check_memory(head: &FilmHead, denoise: DenoiseName) -> Result<(), Failure> {
    let crop = head.part().of_crop;
    // The developed picture, and an encoded one while it is made and written.
    let of_pixel = 48 + denoising::bytes_per_pixel(denoise);
    fits(head, of_pixel * u64::from(crop.width) * u64::from(crop.height))
}

fn fits(head: &FilmHead, beside: u64) -> Result<(), Failure> {
    let mut whole = head.clone();
    whole.crop = head.part().of_crop;
    let needed = whole.bytes() + beside;
    match memory::available() {
        Some(available) if needed > available => Err(Failure::could_not(format!(
            "the picture takes {} of memory, and {} are free",
            memory::human(needed),
            memory::human(available)
        ))),
        _ => Ok(()),
    }
}
