//! What `-o` names, checked before any work is done.

use super::place;
use crate::args::RenderArgs;
use crate::failure::Failure;
use crate::loading::{expect_there, is_dash};
use crate::report::FileReport;
use crate::shell::Shell;
use crate::write::{Bits, Encoding, OutputKind, Place, is_one_file, spare_other};
use scene_format::SceneDesc;
use std::collections::HashSet;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use tracer_core::{Layer, LayerSet, Mattes};

/// A picture to write.
pub struct Output {
    pub place: Place,
    pub encoding: Encoding,
}

/// The name to show.
pub(super) fn name(place: &Place) -> String {
    match place {
        Place::File(path) => path.display().to_string(),
        Place::Stdout => "-".to_owned(),
    }
}

/// Whether one of the pictures to be written is there already.
pub fn are_there(outputs: &[Output]) -> bool {
    outputs.iter().any(|output| matches!(&output.place, Place::File(path) if path.is_file()))
}

/// The names of what was written, for the last line.
pub fn names(files: &[FileReport]) -> String {
    let name = |file: &FileReport| if file.path == "-" { "standard output".to_owned() } else { file.path.clone() };
    files.iter().map(name).collect::<Vec<_>>().join(", ")
}

/// The same options with the picture's name, if there is none: the scene's own with the extension of a picture, beside
/// it.
///
/// # Errors
/// Where the scene has no name, or something that is no picture has that one.
pub(super) fn named(args: &RenderArgs) -> Result<RenderArgs, Failure> {
    if args.part.is_some() {
        return super::parts::named(args);
    }
    let mut args = args.clone();
    if !args.output.is_empty() {
        return Ok(args);
    }
    let scene = &args.scene.scene;
    if is_dash(scene) {
        return Err(Failure::wrong("a scene from standard input has no name to make the picture's of; name it by -o"));
    }
    // That there is no folder to write to would be said of a scene that is not there.
    expect_there(scene)?;
    // Otherwise the option would be said to go with names that nobody has written.
    let kind = args.format.take().unwrap_or_else(|| "png".to_owned());
    let picture = match args.show {
        // A heat map is not the picture.
        Some(layer) => {
            let stem = scene.file_stem().unwrap_or_default().to_string_lossy();
            scene.with_file_name(format!("{stem}_{}.{kind}", layer_name(layer)))
        }
        None => scene.with_extension(&kind),
    };
    if Encoding::from_path(&picture, Bits::default()).is_ok() {
        spare_other(&picture, OutputKind::Picture).map_err(|error| Failure::wrong(format!("{error} by -o")))?;
    }
    args.output.push(picture);
    Ok(args)
}

/// A layer's name, as files have it.
pub(super) fn layer_name(layer: Layer) -> &'static str {
    LayerSet::from_iter([layer]).names().next().unwrap_or_default()
}

/// The pictures that the command line asks for.
///
/// # Errors
/// A kind of picture that is not written, two pictures in one place, options that belong to none.
pub fn outputs(args: &RenderArgs) -> Result<Vec<Output>, Failure> {
    let bits = args.bits.unwrap_or_default();
    let mut outputs: Vec<Output> = Vec::new();
    for path in &args.output {
        let place = place(path);
        if let Some(other) = outputs.iter().find(|output| is_same(&output.place, &place)) {
            let (one, two) = (name(&other.place), name(&place));
            let also = if one == two { String::new() } else { format!(" (it is {one})") };
            return Err(Failure::wrong(format!("-o {two} is given twice{also}; name two places")));
        }
        if args.report.as_deref().is_some_and(|report| is_same(&super::place(report), &place)) {
            return Err(Failure::wrong(format!("-o and --report both name {}; name two places", name(&place))));
        }
        outputs.push(Output { encoding: encoding(path, args, bits)?, place });
    }
    for (option, kept) in kept(args) {
        let place = Place::File(kept.to_owned());
        let report = args.report.as_deref().map(super::place);
        for beside in crate::checkpoint::BESIDE.map(|suffix| with_suffix(kept, suffix)) {
            if report.as_ref().is_some_and(|report| is_same(report, &Place::File(beside.clone()))) {
                let (beside, kept) = (beside.display(), kept.display());
                return Err(Failure::wrong(format!(
                    "--report {beside} is a file that {option} {kept} keeps beside it; name another file"
                )));
            }
        }
        let pictures = outputs.iter().map(|output| ("-o", &output.place));
        let mut others = pictures.chain(report.as_ref().map(|report| ("--report", report)));
        if let Some((other, _)) = others.find(|(_, other)| is_same(other, &place)) {
            return Err(Failure::wrong(format!("{other} and {option} both name {}; name two places", name(&place))));
        }
    }
    if args.format.is_some() && args.output.iter().all(|path| path.extension().is_some()) {
        return Err(Failure::wrong(
            "--format is for `-o -` and names without an extension; others say their kind by it",
        ));
    }
    if args.open && outputs.iter().all(|output| output.place == Place::Stdout) {
        return Err(Failure::wrong("--open is for pictures in files; standard output goes to another program"));
    }
    if args.bits.is_some() && !outputs.iter().any(|output| matches!(output.encoding, Encoding::Png(_))) {
        return Err(Failure::wrong("--bits is for PNG only; EXR, HDR and PFM hold floats"));
    }
    if args.show.is_some() && outputs.iter().any(|output| !matches!(output.encoding, Encoding::Png(_))) {
        return Err(Failure::wrong("--show is for PNG only; the numbers themselves are in an EXR with --layers"));
    }
    if !args.layers.is_empty() && !has_exr(&outputs) {
        return Err(Failure::wrong(format!(
            "--layers is for EXR, and no -o is one; add -o {}",
            exr_beside(&outputs, args)
        )));
    }
    Ok(outputs)
}

/// The picture that `--open` shows: one that all programs show, if there is one.
pub(super) fn to_open(files: &[FileReport]) -> Option<PathBuf> {
    let pictures = || files.iter().filter(|file| file.path != "-");
    pictures().find(|file| file.format == "png").or_else(|| pictures().next()).map(|file| PathBuf::from(&file.path))
}

/// Shows a picture. It is written, so that nobody shows it is no failure.
pub(super) fn open(picture: &Path, shell: &Shell) {
    // What begins with a dash would be an option.
    let path = std::path::absolute(picture).unwrap_or_else(|_| picture.to_owned());
    if let Err(why) = crate::opening::open(path) {
        shell.say(&format!("warning: cannot open {}: {why}; open it yourself", picture.display()));
    }
}

fn with_suffix(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    name.into()
}

/// Layers go into this kind of picture only.
pub(in crate::commands) fn has_exr(outputs: &[Output]) -> bool {
    outputs.iter().any(|output| output.encoding == Encoding::Exr)
}

/// An EXR to suggest, beside the first picture.
fn exr_beside(outputs: &[Output], args: &RenderArgs) -> String {
    let first = outputs.iter().find_map(|output| match &output.place {
        Place::File(path) => Some(path.as_path()),
        Place::Stdout => None,
    });
    let scene = || Path::new(args.scene.scene.file_stem().unwrap_or("picture".as_ref()));
    first.unwrap_or_else(scene).with_extension("exr").display().to_string()
}

/// Says where a scene's layers go nowhere: a quick look at it is no fault.
pub(super) fn tell_of_layers(outputs: &[Output], args: &RenderArgs, desc: &SceneDesc, shell: &Shell) {
    let layers = tracer_core::layer_set(&desc.output.layers);
    if !layers.is_empty() && !has_exr(outputs) {
        shell.warn(&format!(
            "the scene's layers ({layers}) are written into EXR only; add -o {}",
            exr_beside(outputs, args)
        ));
    }
    let mattes: Vec<String> = Mattes::asked(&desc.output).names().collect();
    if !mattes.is_empty() && !has_exr(outputs) {
        shell.warn(&format!(
            "the scene's mattes ({}) are written into EXR only; add -o {}",
            mattes.join(", "),
            exr_beside(outputs, args)
        ));
    }
    if desc.output.light_groups && !has_exr(outputs) {
        shell.warn(&format!(
            "the scene's light groups are written into EXR only, and each takes as long as a picture; add -o {}, or \
             --set output.light_groups=false",
            exr_beside(outputs, args)
        ));
    }
    if desc.output.alpha {
        tell_of_alpha(outputs, shell);
    }
}

/// Says where alpha goes nowhere.
pub(in crate::commands) fn tell_of_alpha(outputs: &[Output], shell: &Shell) {
    let clear = |output: &&Output| matches!(output.encoding, Encoding::Hdr | Encoding::Pfm);
    if let Some(without) = outputs.iter().find(clear) {
        let name = without.encoding.name().to_uppercase();
        shell.warn(&format!("{name} files hold no alpha: the background is black there; PNG and EXR hold it"));
    }
}

/// The checkpoints that the command line names.
pub(super) fn kept(args: &RenderArgs) -> impl Iterator<Item = (&'static str, &Path)> {
    let named = [("--checkpoint", &args.checkpoint), ("--resume", &args.resume)];
    named.into_iter().filter_map(|(option, path)| Some((option, path.as_deref()?)))
}

/// Sees that nothing that is written would replace what the scene was made of: its own file, meshes, materials,
/// placements, pictures.
///
/// # Errors
/// The first place that would.
pub fn spare_inputs(outputs: &[Output], args: &RenderArgs, files: &[PathBuf]) -> Result<(), Failure> {
    let scene = Some(&args.scene.scene).filter(|scene| !is_dash(scene)).map(|scene| ("the scene", scene));
    let inputs: Vec<(&str, &PathBuf)> =
        scene.into_iter().chain(files.iter().map(|f| ("a file of the scene", f))).collect();
    let report = args.report.as_deref().map(|report| ("--report", super::place(report)));
    let kept = kept(args).map(|(option, path)| (option, Place::File(path.to_owned())));
    for (option, place) in outputs.iter().map(|output| ("-o", output.place.clone())).chain(report).chain(kept) {
        let Place::File(path) = &place else { continue };
        let Some((what, input)) = inputs.iter().find(|(_, input)| is_one_file(path, input)) else { continue };
        let also = if path == *input { String::new() } else { format!(" (it is {})", input.display()) };
        return Err(Failure::wrong(format!(
            "{option} {} would replace {what}{also}; name another file",
            path.display()
        )));
    }
    Ok(())
}

/// Files that are written, with their options.
pub(super) fn written(args: &RenderArgs) -> impl Iterator<Item = (&'static str, &Path)> {
    let pictures = args.output.iter().map(|path| ("-o", path.as_path()));
    let report = args.report.as_deref().map(|path| ("--report", path));
    pictures.chain(report).chain(kept(args)).filter(|(_, path)| !is_dash(path))
}

/// Sees that nothing that is written would replace a file that the scene names anywhere: what this frame does not pick,
/// another one may.
///
/// # Errors
/// The first place that would.
pub(super) fn spare_mentioned(written: &[(&str, PathBuf)], desc: &SceneDesc) -> Result<(), Failure> {
    // Texts are looked through only where something can be replaced.
    let there = written.iter().filter_map(|(option, path)| Some((option, path, path.canonicalize().ok()?)));
    let there: Vec<_> = there.filter(|(_, _, real)| real.is_file()).collect();
    if there.is_empty() {
        return Ok(());
    }
    let mentioned: HashSet<PathBuf> = desc.mentioned().iter().filter_map(|path| path.canonicalize().ok()).collect();
    let Some((option, path, _)) = there.into_iter().find(|(_, _, real)| mentioned.contains(real)) else {
        return Ok(());
    };
    Err(Failure::wrong(format!(
        "{option} {} would replace a file that the scene names; name another file",
        path.display()
    )))
}

/// Whether two places are one: by name, or because both names lead to the same file.
fn is_same(a: &Place, b: &Place) -> bool {
    match (a, b) {
        (Place::File(a), Place::File(b)) => is_one_file(a, b),
        _ => a == b,
    }
}

fn encoding(path: &Path, args: &RenderArgs, bits: Bits) -> Result<Encoding, Failure> {
    let kinds = Encoding::NAMES.join(", ");
    if path.extension().is_none() {
        // What goes to another program is a PNG as a picture without a name is.
        let format = args.format.as_deref().or(is_dash(path).then_some("png"));
        let Some(format) = format else { return Err(Failure::wrong(without_extension(path, args))) };
        if is_dash(path) && std::io::stdout().is_terminal() {
            return Err(Failure::wrong(
                "a picture does not go to a terminal; send standard output into a file or a pipe",
            ));
        }
        return Encoding::from_name(format, bits)
            .map_err(|_| Failure::wrong(format!("--format {format} is unknown; expected one of {kinds}")));
    }
    Encoding::from_path(path, bits).map_err(|_| {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let shown = path.display();
        Failure::wrong(format!("-o {shown}: `.{extension}` is no kind of picture; expected one of {kinds}"))
    })
}

/// What is wrong with the name of a picture that has no extension, where nothing else says the kind.
fn without_extension(path: &Path, args: &RenderArgs) -> String {
    let shown = path.display();
    let within = |folder: &Path, kind: &str| {
        let mut name = args.scene.scene.file_stem().unwrap_or("picture".as_ref()).to_owned();
        name.push(format!(".{kind}"));
        folder.join(name).display().to_string()
    };
    // A kind alone, as in `shots/.png`: the name before it was empty.
    let kind = path.file_name().and_then(|name| name.to_str()?.strip_prefix('.'));
    let kind = kind.filter(|kind| Encoding::from_name(kind, Bits::default()).is_ok());
    if let Some(kind) = kind {
        let folder = path.parent().unwrap_or(Path::new(""));
        format!("-o {shown} has no name before its extension; name it -o {}", within(folder, kind))
    } else if path.is_dir() {
        format!("-o {shown} is a folder; name the picture in it: -o {}", within(path, "png"))
    } else if shown.to_string().ends_with(std::path::is_separator) {
        format!("there is no folder {shown}; make it, and name the picture in it: -o {}", within(path, "png"))
    } else {
        format!("-o {shown} has no extension; name it {shown}.png (or exr, hdr, pfm), or give --format")
    }
}

/// Finds out whether everything can be written, while nothing has been spent yet.
///
/// # Errors
/// The first place that cannot be written.
pub fn probe(outputs: &[Output], report: Option<&Path>) -> Result<(), Failure> {
    let pictures = outputs.iter().filter_map(|output| match &output.place {
        Place::File(path) => Some(path.as_path()),
        Place::Stdout => None,
    });
    for path in pictures.chain(report.filter(|report| !is_dash(report))) {
        crate::write::probe(path)?;
    }
    Ok(())
}

/// Sees that pictures and a report replace pictures and reports alone.
///
/// # Errors
/// The first place where something else is.
pub fn spare_others(outputs: &[Output], report: Option<&Path>) -> Result<(), Failure> {
    for output in outputs {
        if let Place::File(path) = &output.place {
            spare_other(path, OutputKind::Picture)?;
        }
    }
    report.filter(|report| !is_dash(report)).map_or(Ok(()), |report| Ok(spare_other(report, OutputKind::Report)?))
}
