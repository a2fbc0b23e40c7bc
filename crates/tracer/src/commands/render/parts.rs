//! `--part`: a part of the rendering into a file, for `tracer merge`.

use super::outputs::kept;
use crate::args::RenderArgs;
use crate::checkpoint::{Flushing, Place, is_film, note, now, part_told, sha256_of};
use crate::failure::Failure;
use crate::loading::is_dash;
use crate::shell::Shell;
use crate::write::{Encoding, Place as Output, WriteError, Written, is_one_file};
use scene_format::{SceneDesc, hash_hex};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, Write};
use tracer_core::{Crop, Film, FilmError, Note, Part, SavedFilm, Split};

/// The extension of a part.
pub const EXTENSION: &str = "tracer";

/// The same options with the part's name, if there is none: beside the scene, with its number, so that `ls` has them in
/// order.
pub(super) fn named(args: &RenderArgs) -> Result<RenderArgs, Failure> {
    let mut args = args.clone();
    let Some([k, n]) = args.part.filter(|_| args.output.is_empty()) else { return Ok(args) };
    if is_dash(&args.scene.scene) {
        return Err(Failure::wrong("a scene from standard input has no name to make the part's of; name it by -o"));
    }
    let digits = n.to_string().len();
    args.output.push(args.scene.scene.with_extension(format!("{k:0digits$}of{n}.{EXTENSION}")));
    Ok(args)
}

/// Where the part goes, as `-o` says.
///
/// # Errors
/// What is no place for it.
pub(in crate::commands) fn place(args: &RenderArgs) -> Result<Place, Failure> {
    let [path] = &args.output[..] else {
        return Err(Failure::wrong("a part is one file: name it by one -o; pictures are made by `tracer merge`"));
    };
    let shown = path.display();
    if is_dash(path) {
        return Err(Failure::wrong("a part is a file: it cannot be standard output"));
    }
    if path.extension().is_none_or(|extension| extension != EXTENSION) {
        let is_picture = Encoding::from_path(path, Default::default()).is_ok();
        let why = if is_picture { "a part is no picture" } else { "this is no name of a part" };
        let better = path.with_extension(EXTENSION);
        return Err(Failure::wrong(format!("-o {shown}: {why}; name it {}", better.display())));
    }
    let report = args.report.as_deref().filter(|report| !is_dash(report));
    if report.is_some_and(|report| is_one_file(report, path)) {
        return Err(Failure::wrong(format!("-o and --report both name {shown}; name two places")));
    }
    if let Some((option, path)) = kept(args).find(|(_, path)| report.is_some_and(|report| is_one_file(report, path))) {
        return Err(Failure::wrong(format!("--report and {option} both name {}; name two places", path.display())));
    }
    if path.try_exists().unwrap_or(true) && !is_film(path) {
        return Err(Failure::wrong(format!(
            "-o {shown} would replace what is no part, or cannot be read; name another file"
        )));
    }
    let place = Place::new(path)?;
    place.spare_beside()?;
    Ok(place)
}

/// Sees that a part does not replace another finished one of the same rendering: a slip of the name would lose it.
///
/// # Errors
/// That it would.
pub(super) fn spare_other(place: &Place, part: &Part, desc: &SceneDesc) -> Result<(), Failure> {
    let saved = File::open(place.file()).map_err(FilmError::Io).and_then(SavedFilm::open);
    let Ok(saved) = saved else { return Ok(()) };
    let (head, there) = (saved.head(), saved.head().part());
    let of = |part: &Part| (part.of_crop, part.of_samples);
    let is_other = head.is_finished() && there != *part && of(&there) == of(part);
    if !is_other || note(head, "hash") != hash_hex(desc) {
        return Ok(());
    }
    Err(Failure::wrong(format!(
        "-o {} would replace another part of this rendering, {}, which is finished; name another file, or delete it",
        place.name(),
        part_told(Some(there))
    )))
}

/// The part that the command line asks for.
///
/// # Errors
/// There are not so many; a goal of the scene's that no part can know of.
pub(super) fn part(args: &RenderArgs, desc: &SceneDesc, crop: Crop) -> Result<Option<Part>, Failure> {
    let Some([k, n]) = args.part else { return Ok(None) };
    part_of(args, desc, crop, [k, n], &format!("--part {k}/{n}")).map(Some)
}

/// The k-th of n parts, as the option says that is to be named where there are not so many.
///
/// # Errors
/// As [`part`].
pub(super) fn part_of(
    args: &RenderArgs,
    desc: &SceneDesc,
    crop: Crop,
    [k, n]: [u32; 2],
    option: &str,
) -> Result<Part, Failure> {
    let render = &desc.render;
    for (name, is_set) in [("noise", render.noise.is_some()), ("time", render.time.is_some())] {
        if is_set {
            return Err(Failure::wrong(format!(
                "the scene's `render.{name}` is a goal for the whole picture, which a part does not know; all parts \
                 need one number of \
                 samples: --set render.{name}=None --samples N"
            )));
        }
    }
    let samples = render.samples.value;
    // By rows borders are done twice, so only where there are not enough samples.
    let most = |split| Part::most(crop, samples, split);
    let split = args.split.map(Split::from).unwrap_or(if n <= most(Split::Samples) || n > most(Split::Rows) {
        Split::Samples
    } else {
        Split::Rows
    });
    Part::of(crop, samples, split, k, n).ok_or_else(|| {
        let (by_samples, by_rows) = (most(Split::Samples), most(Split::Rows));
        let asked = if args.split.is_none() { String::new() } else { format!(" --split {}", split_name(split)) };
        Failure::wrong(format!(
            "{option}{asked}: there are {by_samples} parts by samples, {by_rows} by rows of 16 pixels, and no \
             more"
        ))
    })
}

/// Its word on the command line.
pub(super) fn split_name(split: Split) -> &'static str {
    match split {
        Split::Samples => "samples",
        Split::Rows => "rows",
    }
}

/// Writes the part: whole or not at all.
///
/// # Errors
/// When it cannot be written; an older one is then as it was.
pub(in crate::commands) fn save(
    place: &Output,
    film: &Film,
    notes: &[Note],
    shell: &Shell,
) -> Result<Written, WriteError> {
    let Output::File(path) = place else { return Err(WriteError::Stdout(io::ErrorKind::Unsupported.into())) };
    let could_not = |why: io::Error| WriteError::Io { path: path.clone(), why };
    // Its folder may be gone since.
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir());
    if let Some(folder) = folder {
        return Err(WriteError::NoFolder { path: path.clone(), folder: folder.to_owned() });
    }
    let target = Place::unchecked(path).map_err(could_not)?;
    let mut notes = notes.to_vec();
    notes.push(("when".to_owned(), now()));
    let mut sha256 = Sha256::new();
    let bytes =
        target.write(false, |file| film.save(&mut Summed { file, sum: &mut sha256 }, &notes)).map_err(could_not)?;
    shell.explain(|| format!("part {}: {}", path.display(), crate::memory::human(bytes)));
    let sha256 = sha256.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(Written { bytes, sha256 })
}

/// A file, and what goes into it summed.
struct Summed<'a> {
    file: &'a mut Flushing,
    sum: &'a mut Sha256,
}

impl Write for Summed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.file.write(bytes)?;
        self.sum.update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// The part that a checkpoint has left there already.
///
/// # Errors
/// When it is gone.
pub(super) fn written(place: &Output) -> Result<Written, WriteError> {
    let Output::File(path) = place else { return Err(WriteError::Stdout(io::ErrorKind::Unsupported.into())) };
    let could_not = |why: io::Error| WriteError::Io { path: path.clone(), why };
    let bytes = path.metadata().map_err(could_not)?.len();
    Ok(Written { bytes, sha256: sha256_of(path).map_err(could_not)? })
}
