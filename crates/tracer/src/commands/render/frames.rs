//! `--frames`: one picture after the other. Assets and trees are kept from frame to frame.

use super::{one, outputs};
use crate::args::{self, RenderArgs};
use crate::cache::Cache;
use crate::checkpoint::Hashes;
use crate::failure::{Failure, exit};
use crate::loading::{is_dash, load};
use crate::shell::{Shell, counted};
use crate::write::{OutputKind, spare_other};
use crate::{frames, interrupt};
use scene_format::SceneDesc;
use scene_format::diagnostic::Source;
use std::cell::OnceCell;
use std::ops::{Deref, DerefMut, RangeInclusive};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use tracer_core::Kept;

/// What frames have in common.
pub(super) struct Frames {
    pub kept: Kept,
    pub hashes: Hashes,
    /// The texts of the scene as the first frame was made of them.
    sources: OnceCell<Vec<Source>>,
}

impl Frames {
    /// With what an earlier run of the program has left.
    fn new(cache: Option<&Cache>) -> Self {
        Frames {
            kept: cache.map_or_else(Kept::default, |cache| Kept::storing(cache.store())),
            hashes: Hashes::by(cache.map(Cache::hashes)),
            sources: OnceCell::new(),
        }
    }

    /// Sees that a frame is of the scene that the first one was of.
    ///
    /// # Errors
    /// The files were changed since.
    pub fn is_as_before(&self, desc: &SceneDesc) -> Result<(), Failure> {
        let texts = || desc.sources.iter().filter(|source| !source.name.starts_with("--")).cloned().collect();
        let now: Vec<Source> = texts();
        if *self.sources.get_or_init(texts) == now {
            return Ok(());
        }
        let why = "the scene was changed while its frames were rendered: the rest would not fit; render them anew";
        Err(Failure::wrong(why))
    }
}

/// A value that is not taken apart at the end where the process ends with it: a large scene would take its time for
/// nothing. Of frames it is.
pub(super) struct AtEnd<T> {
    value: Option<T>,
    is_dropped: bool,
}

impl<T> AtEnd<T> {
    pub fn new(value: T, frames: Option<&Frames>) -> Self {
        AtEnd { value: Some(value), is_dropped: frames.is_some() }
    }
}

impl<T> Deref for AtEnd<T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.value.as_ref().expect("it is taken when this is dropped")
    }
}

impl<T> DerefMut for AtEnd<T> {
    fn deref_mut(&mut self) -> &mut T {
        self.value.as_mut().expect("it is taken when this is dropped")
    }
}

impl<T> Drop for AtEnd<T> {
    fn drop(&mut self) {
        if let Some(value) = self.value.take().filter(|_| !self.is_dropped) {
            std::mem::forget(value);
        }
    }
}

/// The options of one frame: its number is in the names of files.
///
/// # Errors
/// A name that is no text.
pub(super) fn numbered(args: &RenderArgs) -> Result<RenderArgs, Failure> {
    let mut args = args.clone();
    let Some(frame) = args.scene.frame else { return Ok(args) };
    if args.output.is_empty() && args.part.is_none() && !is_dash(&args.scene.scene) {
        args.output.push(beside(&args));
    }
    for path in files(&mut args) {
        if let Some(name) = path.to_str().and_then(|name| with_number(name, frame)) {
            *path = PathBuf::from(name);
        }
    }
    Ok(args)
}

/// The name of pictures that were given none.
fn beside(args: &RenderArgs) -> PathBuf {
    let stem = args.scene.scene.file_stem().unwrap_or_default().to_string_lossy();
    let kind = args.format.as_deref().unwrap_or("png");
    let layer = args.show.map_or(String::new(), |layer| format!("_{}", super::outputs::layer_name(layer)));
    args.scene.scene.with_file_name(format!("{stem}{layer}_####.{kind}"))
}

/// All files that are written, with their options.
fn files(args: &mut RenderArgs) -> impl Iterator<Item = &mut PathBuf> {
    let RenderArgs { output, report, checkpoint, resume, .. } = args;
    output.iter_mut().chain(report).chain(checkpoint).chain(resume)
}

/// A name with the number of a frame in place of the last `####`; `None` where it has none.
fn with_number(name: &str, frame: u32) -> Option<String> {
    let end = name.rfind('#')? + 1;
    let start = name[..end].trim_end_matches('#').len();
    let digits = end - start;
    Some(format!("{}{frame:0digits$}{}", &name[..start], &name[end..]))
}

/// Says of names with `####` that they are taken as they stand where no frame is asked for.
pub(super) fn tell_of_names(args: &RenderArgs, shell: &Shell) {
    if args.scene.frame.is_some() {
        return;
    }
    for path in files(&mut args.clone()) {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        if without_printf(&stem) != stem {
            let message = format!(
                "{} is written under just that name: frames are rendered with --frames 0-47 -o {}",
                path.display(),
                example(path).display()
            );
            shell.warn(&message);
        }
        if path.to_string_lossy().contains("##") {
            let message = format!(
                "{} is written under just that name: # stands for a frame's number with --frames or --frame alone",
                path.display()
            );
            shell.warn(&message);
        }
    }
}

/// Renders frames.
///
/// # Errors
/// What is wrong with a frame; the ones before it are written.
pub(super) fn run(
    args: &RenderArgs,
    frames: args::Frames,
    cache: Option<&Cache>,
    shell: &Shell,
    started: Instant,
) -> Result<ExitCode, Failure> {
    let mut args = args.clone();
    if is_dash(&args.scene.scene) {
        return Err(Failure::wrong("a scene from standard input is read once: --frames needs one in a file"));
    }
    if args.output.is_empty() {
        let named = if args.part.is_some() { super::parts::named(&args)?.output.remove(0) } else { beside(&args) };
        args.output.push(match named.to_string_lossy().contains('#') {
            true => named,
            false => named.with_file_name(format!("####.{}", named.file_name().unwrap_or_default().to_string_lossy())),
        });
        args.format = None;
    }
    for path in files(&mut args) {
        expect_number(path)?;
    }
    interrupt::listen(*shell)?;
    let (first, last, desc) = range(&args, frames, shell)?;
    spare_inputs(&args, first..=last, &desc)?;
    let text = desc.sources.first().map(|source| source.text.clone()).unwrap_or_default();
    drop(desc);
    if args.part.is_none() && args.show.is_none() {
        let desc = super::described(&at(&args, first), &shell.without_warnings())?;
        outputs::tell_of_layers(&outputs::outputs(&outputs::named(&args)?)?, &args, &desc, shell);
    }
    let session = Frames::new(cache);
    let all = last - first + 1;
    // Not asked again: what is written meanwhile is rendered.
    let there: Vec<u32> = (first..=last).filter(|&frame| args.skip_existing && is_there(&args, frame)).collect();
    tell_of_others(&args, &there, &text, shell);
    let (mut made, mut skipped) = (0, 0);
    let shell = &shell.of_film();
    for frame in first..=last {
        if there.binary_search(&frame).is_ok() {
            skipped += 1;
            continue;
        }
        let of_frame = numbered(&at(&args, frame))?;
        let shell = &if made == 0 { *shell } else { shell.at_frame(frame) };
        let code = match interrupt::requested() {
            None => one(&of_frame, shell, if made == 0 { started } else { Instant::now() }, (Some(&session), cache))?,
            Some(code) => ExitCode::from(code),
        };
        if let Some(signal) = interrupt::requested() {
            let done = made + there.len() + usize::from(code == ExitCode::from(exit::DONE));
            let all = counted(all as usize, "frame");
            shell.say(&format!("interrupted: {done} of {all} done; {}", rest(&args)));
            return Ok(ExitCode::from(signal));
        }
        if code != ExitCode::from(exit::DONE) {
            return Ok(code);
        }
        made += 1;
    }
    if shell.is_told() {
        let there = match skipped {
            0 => String::new(),
            1 => ", 1 was there".to_owned(),
            more => format!(", {more} were there"),
        };
        let seconds = started.elapsed().as_secs_f64();
        shell.say(&format!("{} in {seconds:.2} s{there}", counted(made, "frame")));
    }
    Ok(ExitCode::from(exit::DONE))
}

/// The options of one frame.
fn at(args: &RenderArgs, frame: u32) -> RenderArgs {
    let mut of_frame = args.clone();
    (of_frame.frames, of_frame.scene.frame, of_frame.scene.is_of_frames) = (None, Some(frame), true);
    of_frame
}

/// Whether all files of a frame are there. A part that is its own checkpoint may be one that is not done yet.
fn is_there(args: &RenderArgs, frame: u32) -> bool {
    let is_kept = |path: &PathBuf| [&args.checkpoint, &args.resume].into_iter().flatten().any(|kept| kept == path);
    if args.output.iter().any(is_kept) {
        return false;
    }
    let is_there = |path: &PathBuf| path.metadata().is_ok_and(|file| file.is_file() && file.len() > 0);
    numbered(&at(args, frame)).is_ok_and(|args| args.output.iter().chain(&args.report).all(is_there))
}

/// Warns of pictures that are left as they are and were made of another text than the scene has now, as far as they
/// tell.
fn tell_of_others(args: &RenderArgs, there: &[u32], text: &str, shell: &Shell) {
    let is_other = |path: &Path| {
        let told = tracer_picture::told(path).ok().and_then(|told| told.scene);
        told.is_some_and(|made_of| made_of != text)
    };
    let of_frame = |&frame: &u32| numbered(&at(args, frame)).ok();
    let others: Vec<PathBuf> = there
        .iter()
        .filter_map(of_frame)
        .filter_map(|args| args.output.into_iter().find(|path| is_other(path)))
        .collect();
    let Some(first) = others.first() else { return };
    let (first, count) = (first.display(), others.len());
    let which = match count {
        1 => format!("{first} was there and is left as it is, but was"),
        _ => format!("{count} pictures were there and are left as they are, but were"),
    };
    let example = if count == 1 { String::new() } else { format!(" ({first}, ..)") };
    shell.warn(&format!(
        "{which} made of another text than the scene has now{example}; without --skip-existing they are made anew"
    ));
}

/// How the frames that are left are rendered, without losing what one was begun with.
fn rest(args: &RenderArgs) -> String {
    let mut more = Vec::new();
    if !args.skip_existing {
        more.push("--skip-existing".to_owned());
    }
    if let (Some(checkpoint), None) = (&args.checkpoint, &args.resume) {
        more.push(format!("--resume {}", checkpoint.display()));
    }
    match more.is_empty() {
        true => "the same line does the rest".to_owned(),
        false => format!("the same line with {} does the rest", more.join(" ")),
    }
}

/// The same path with a frame's number in place of `####`, if it has that.
pub fn of_frame(path: &Path, frame: u32) -> PathBuf {
    path.to_str().and_then(|name| with_number(name, frame)).map_or_else(|| path.to_owned(), PathBuf::from)
}

/// Sees that each frame has a file of its own.
///
/// # Errors
/// When there is no `####` in the name.
pub fn expect_number(path: &Path) -> Result<(), Failure> {
    if !is_dash(path) && path.to_str().and_then(|name| with_number(name, 0)).is_some() {
        return Ok(());
    }
    let named = example(path);
    if is_of_films(path) {
        return Err(Failure::wrong(format!(
            "--frames: frames are pictures, of which another program makes a film: -o {}",
            named.with_extension("png").display()
        )));
    }
    Err(Failure::wrong(format!(
        "--frames: each frame has files of its own: put #### for its number into {}, as in {}",
        path.display(),
        named.display()
    )))
}

/// Whether a file would be a film.
fn is_of_films(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    matches!(&*extension, "gif" | "mp4" | "webm" | "avi" | "mov" | "mkv" | "apng")
}

/// A name without the `%04d` at its end that other programs have for `####`.
fn without_printf(stem: &str) -> &str {
    let digits = stem.strip_suffix(['d', 'i']).map(|stem| stem.trim_end_matches(|c: char| c.is_ascii_digit()));
    digits.and_then(|stem| stem.strip_suffix('%')).map_or(stem, |name| name.trim_end_matches(['_', '-', '.']))
}

/// A name with room for a number.
fn example(path: &Path) -> PathBuf {
    if is_dash(path) {
        return PathBuf::from("shot_####.png");
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let stem = without_printf(&stem);
    match path.extension() {
        Some(extension) => path.with_file_name(format!("{stem}_####.{}", extension.to_string_lossy())),
        None => path.with_file_name(format!("{stem}_####")),
    }
}

/// The first and the last frame; all are looked at, so that what is wrong with one is told before any is rendered.
/// The scene goes with them, as its first frame is.
///
/// # Errors
/// A frame is wrong.
pub fn range(args: &RenderArgs, frames: args::Frames, shell: &Shell) -> Result<(u32, u32, SceneDesc), Failure> {
    let mut scene = args.scene.clone();
    if let args::Frames::Range(first, _) = frames {
        (scene.frame, scene.is_of_frames) = (Some(first), true);
    }
    if let args::Frames::Range(first, last) = frames
        && first > 0
    {
        // What is told of the last one holds for those before.
        let of_last = args::SceneArgs { frame: Some(last), ..scene.clone() };
        load(&of_last, &shell.without_warnings())?;
    }
    let desc = load(&scene, &shell.without_warnings())?;
    if let args::Frames::Range(_, last) = frames
        && last >= desc.animation.frames.value
    {
        load(&args::SceneArgs { frame: Some(last), ..scene.clone() }, &shell.without_warnings())?;
    }
    let (first, last) = match frames {
        args::Frames::Range(first, last) => (first, last),
        args::Frames::All => (0, desc.animation.frames.value - 1),
    };
    frames::told(&args.scene, &desc, Some((first, last)), shell)?;
    Ok((first, last, desc))
}

/// Sees that no file of any frame would replace one that the scene names, or one of another kind, before the first is
/// rendered.
///
/// # Errors
/// The first that would.
fn spare_inputs(args: &RenderArgs, frames: RangeInclusive<u32>, desc: &SceneDesc) -> Result<(), Failure> {
    let named = if args.part.is_some() { super::parts::named(args)? } else { args.clone() };
    let written = frames.flat_map(|frame| {
        let numbered = move |path: &Path| Some(PathBuf::from(with_number(path.to_str()?, frame)?));
        outputs::written(&named).filter_map(move |(option, path)| Some((option, numbered(path)?)))
    });
    let written = written.collect::<Vec<_>>();
    outputs::spare_mentioned(&written, desc)?;
    // What is there may belong to a frame that is left out.
    for (option, path) in written.iter().filter(|_| !args.skip_existing) {
        match *option {
            "-o" if args.part.is_none() => spare_other(path, OutputKind::Picture)?,
            "--report" => spare_other(path, OutputKind::Report)?,
            _ => {}
        }
    }
    Ok(())
}

/// What is left of a frame that was interrupted: its checkpoint. A picture would be taken for a whole one.
///
/// # Errors
/// The checkpoint could not be written.
pub(super) fn unfinished(kept: Option<Result<String, anyhow::Error>>, shell: &Shell) -> Result<ExitCode, Failure> {
    match kept {
        Some(Err(error)) => shell.error(&error),
        Some(Ok(name)) => shell.say(&format!("the unfinished frame is kept in {name}; --resume goes on with it")),
        None => {}
    }
    Ok(ExitCode::from(interrupt::requested().unwrap_or(exit::INTERRUPTED)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_in_names() {
        assert_eq!(with_number("shot_####.png", 7).as_deref(), Some("shot_0007.png"));
        assert_eq!(with_number("a#/b##.exr", 123).as_deref(), Some("a#/b123.exr"));
        assert_eq!(with_number("##/film.png", 3).as_deref(), Some("03/film.png"));
        assert_eq!(with_number("film.png", 3), None);
        assert_eq!(example(Path::new("out/film.png")), Path::new("out/film_####.png"));
        assert_eq!(example(Path::new("out/film_%04d.png")), Path::new("out/film_####.png"));
        assert_eq!(example(Path::new("%d")), Path::new("_####"));
        assert_eq!(example(Path::new("method.png")), Path::new("method_####.png"));
    }
}
