//! `tracer repro`: makes a picture again by what it tells of itself, and sees whether it is the same.

use super::from_picture::{layers, record, rendered, told};
use super::render::check_memory;
use crate::args::{DenoiseName, DiagnosticsForm, ReproArgs};
use crate::checkpoint::{
    Hashes, Record, RecordedFile, files_are_told, note_differences, picture_notes, provenance, show_note, told_name,
};
use crate::command_line::printable;
use crate::compare::Picture;
use crate::denoising::{self, Denoiser, Developed};
use crate::failure::{Failure, exit};
use crate::loading::{
    Known, compile, expect_all_moments, is_dash, told as told_load, use_threads, with_faults_of_files,
};
use crate::progress::Watch;
use crate::shell::Shell;
use crate::write::{Encoding, OutputKind, encode, is_one_file, probe, save, sha256, spare_other};
use crate::{interrupt, lanes, layer_view};
use scene_format::{MAX_FILE_BYTES, SceneDesc};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use tracer_core::{Note, PROGRAM, RenderOptions, Scene, layer_set, layer_word, render};
use tracer_picture::Told;

pub(super) fn run(args: &ReproArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let shown = args.picture.display();
    let told = told(&args.picture)?;
    let record = record(&told, &args.picture)?;
    check_output(args, &told)?;
    let [fewest, most] = record.samples;
    if fewest != most && record.plan.is_none() {
        return Err(Failure::could_not(format!(
            "{shown} cannot be made again: it was interrupted while some pixels had {fewest} samples and others {most}"
        )));
    }
    use_threads(args.threads)?;
    let Source { text, folder } = source(args, &told, &record, shell)?;
    let missing = missing(&record, &folder, &text);
    if !missing.is_empty() {
        let tip = if args.scene.is_some() { "" } else { "; --scene FILE says where its scene lies" };
        return Err(not_again(&shown.to_string(), &missing, tip));
    }
    let mut desc = rendered(&record, layers(&told), &text, &folder)
        .map_err(|error| told_load(with_faults_of_files(error, &folder), DiagnosticsForm::Text, shell))?;
    if let Some(layer) = record.shown() {
        desc.output.layers.push(layer_word(layer));
    }
    let scene = compile(&desc, DiagnosticsForm::Text, Known::Nothing, &shell.without_warnings())?;
    spare_files(args, &scene.files)?;
    let Some(mut files) = Hashes::default().begin(&scene.files, &folder, args.threads).end() else {
        return Err(Failure::could_not("a file of the scene cannot be read any more"));
    };
    files.retain(|(name, _)| name.starts_with("file:"));
    let mut reasons = changed(&record, &files, &text);
    if !reasons.is_empty() && args.output.is_none() {
        return Err(not_again(&shown.to_string(), &reasons, "; -o FILE renders it as it is now"));
    }
    let Some(bytes) = again(args, &record, &told, desc, scene, &files, shell)? else {
        return Ok(ExitCode::from(interrupt::requested().unwrap_or(exit::INTERRUPTED)));
    };
    if let Some(output) = &args.output {
        save(output, &bytes)?;
    }
    let there =
        fs::read(&args.picture).map_err(|error| Failure::could_not(format!("cannot read {shown} again: {error}")))?;
    if there == bytes {
        say(shell, &format!("{shown}: made again, the same bytes"));
        return Ok(ExitCode::from(exit::DONE));
    }
    if record.program != PROGRAM {
        let of = printable(&record.program);
        reasons.push(format!("it was made by tracer {of}, and this is {PROGRAM}"));
    }
    if record.denoise.as_deref() == Some(DenoiseName::Oidn.name()) {
        reasons.push("Open Image Denoise may do otherwise in another version, or on another processor".to_owned());
    }
    if let Some(difference) = difference(&there, &bytes, &args.picture)? {
        if reasons.is_empty() {
            reasons.push(
                "nothing that it tells of has changed, so it was edited afterwards, or this is a fault of tracer"
                    .to_owned(),
            );
        }
        return Err(not_again(&shown.to_string(), &reasons, &format!("; {difference}")));
    }
    let why = if reasons.is_empty() { "another program has written it anew".to_owned() } else { reasons.join(", ") };
    say(shell, &format!("{shown}: made again, the same colours in other bytes: {why}"));
    Ok(ExitCode::from(exit::DONE))
}

fn say(shell: &Shell, line: &str) {
    if shell.is_told() {
        shell.say(line);
    }
}

/// It is not the same picture, or none can be made.
fn not_again(picture: &str, reasons: &[String], tip: &str) -> Failure {
    Failure::could_not(format!("{picture} is not made again: {}{tip}", reasons.join(", ")))
}

/// Sees that the picture made again goes to a place of its own.
fn check_output(args: &ReproArgs, told: &Told) -> Result<(), Failure> {
    let Some(output) = &args.output else { return Ok(()) };
    let shown = output.display();
    let bits = match told.encoding {
        Encoding::Png(bits) => bits,
        _ => Default::default(),
    };
    let name = told.encoding.name();
    if is_dash(output) || Encoding::from_path(output, bits) != Ok(told.encoding) {
        return Err(Failure::wrong(format!("-o {shown}: the picture is made again as it was, so name a .{name} file")));
    }
    if is_one_file(output, &args.picture) || args.scene.as_ref().is_some_and(|scene| is_one_file(output, scene)) {
        return Err(Failure::wrong(format!("-o {shown} would replace what is made again; name another file")));
    }
    probe(output)?;
    Ok(spare_other(output, OutputKind::Picture)?)
}

fn spare_files(args: &ReproArgs, files: &[PathBuf]) -> Result<(), Failure> {
    match &args.output {
        Some(output) if files.iter().any(|file| is_one_file(output, file)) => {
            Err(Failure::wrong(format!("-o {} would replace a file of the scene; name another file", output.display())))
        }
        _ => Ok(()),
    }
}

/// The scene's text, and the folder that its paths start from.
struct Source {
    text: String,
    folder: PathBuf,
}

fn source(args: &ReproArgs, told: &Told, record: &Record, shell: &Shell) -> Result<Source, Failure> {
    let beside = args.picture.parent().unwrap_or(Path::new("")).to_owned();
    // A name that leads elsewhere is none of ours.
    let name = Path::new(&record.scene).file_name().unwrap_or_default();
    let path = args.scene.clone().unwrap_or_else(|| beside.join(name));
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let shown = printable(&path.display().to_string());
    let is_file = fs::metadata(&path).is_ok_and(|file| file.is_file() && file.len() <= MAX_FILE_BYTES);
    let there = is_file.then(|| fs::read(&path).ok()).flatten();
    if args.scene.is_some() && there.is_none() {
        return Err(Failure::wrong(format!("cannot read the scene {shown}")));
    }
    let has_changed = there.as_ref().is_some_and(|there| sha256(there) != record.scene_sha256);
    match (&told.scene, there) {
        (Some(text), _) => {
            if has_changed {
                say(shell, &format!("{shown} has changed since; what is rendered is the text in the picture"));
            }
            Ok(Source { text: text.clone(), folder })
        }
        (None, Some(bytes)) if !has_changed => {
            let text = String::from_utf8(bytes).map_err(|_| Failure::wrong(format!("{shown} is no text")))?;
            Ok(Source { text, folder })
        }
        (None, Some(_)) => {
            let reason = format!("{shown} has changed, and its text was too long to be kept in the picture");
            Err(not_again(&args.picture.display().to_string(), &[reason], ""))
        }
        (None, None) => Err(Failure::wrong(format!(
            "{} does not hold its scene, and there is no {shown}; name it by --scene",
            args.picture.display()
        ))),
    }
}

/// The files that are not where they should be.
fn missing(record: &Record, folder: &Path, text: &str) -> Vec<String> {
    let files = record.files.iter().flatten();
    // Of what the picture has no path of, compiling tells.
    let is_named = |file: &&RecordedFile| file.name.contains(['/', '\\']) || text.contains(&file.name);
    let lost = files.filter(is_named).filter(|file| !folder.join(&file.name).is_file());
    lost.map(|file| format!("{} is missing", printable(&folder.join(&file.name).display().to_string()))).collect()
}

/// The files that do not hold what they held.
fn changed(record: &Record, files: &[Note], text: &str) -> Vec<String> {
    let note = |name: &str, hash: &str| (format!("file:{}", printable(name)), hash.to_owned());
    let told = |(name, hash): &Note| note(told_name(name.trim_start_matches("file:"), text), hash);
    let here: Vec<Note> = files.iter().map(told).collect();
    let mut found = Vec::new();
    match (&record.files, &record.assets) {
        (Some(there), _) => {
            let there: Vec<Note> = there.iter().map(|file| note(&file.name, &file.sha256)).collect();
            note_differences(&mut found, &there, &here);
        }
        (None, Some(assets)) if Some(assets) != crate::checkpoint::assets_hash(&here).as_ref() => {
            found.push(format!("the contents of one of its {} files have changed", files.len()));
        }
        _ => {}
    }
    found
}

/// The bytes of the picture made again; none where it was interrupted.
fn again(
    args: &ReproArgs,
    record: &Record,
    told: &Told,
    desc: SceneDesc,
    mut scene: Scene,
    files: &[Note],
    shell: &Shell,
) -> Result<Option<Vec<u8>>, Failure> {
    let how = record.denoise.as_deref().unwrap_or(DenoiseName::Off.name());
    let Some(how) = DenoiseName::by_name(how) else {
        let other = printable(how);
        return Err(Failure::could_not(format!("it was denoised by {other}, which this program does not know")));
    };
    let (is_denoised, denoiser) = (how.is_on(), Denoiser::ready(how)?);
    let crop = record.crop();
    check_memory(crop, &desc, how)?;
    denoising::prepare(&mut scene, is_denoised)?;
    let level = lanes::from_environment()?;
    interrupt::listen(*shell)?;
    let watch = Watch::new(shell, u64::from(crop.width) * u64::from(crop.height) * u64::from(scene.samples));
    let options = RenderOptions {
        crop: Some(crop),
        threads: args.threads.map_or(0, usize::from),
        level: Some(level),
        halves: is_denoised,
        plan: record.plan(),
        mattes: scene.mattes.kept(),
        ..RenderOptions::default()
    };
    let film = render(&scene, &options, &watch);
    watch.finish();
    expect_all_moments(&film, &desc, DiagnosticsForm::Text, shell)?;
    if interrupt::requested().is_some() {
        return Ok(None);
    }
    let layers = layer_set(&desc.output.layers);
    let developed = denoising::picture((&film, false), &scene.look, layers, denoiser.as_ref(), shell)?;
    let Developed { mut image, denoised, fault, is_ended } = developed;
    if is_ended {
        return Ok(None);
    }
    if let Some(fault) = fault {
        return Err(Failure::could_not(format!("the picture cannot be denoised again: {fault}")));
    }
    if told.encoding == Encoding::Exr {
        image.mattes = scene.mattes.develop(&film);
    }
    let mut notes = picture_notes(&desc, &scene.mattes, &record.set);
    if let Some(layer) = record.shown().and_then(|layer| film.layer(layer)) {
        (image, _) = layer_view::picture(&layer, film.crop().width, &scene.look);
        notes.extend(record.show.as_deref().map(show_note));
    }
    if record.files.is_some() || record.assets.is_some() {
        notes.extend(files.iter().cloned().chain([files_are_told()]));
    }
    Ok(Some(encode(&image, told.encoding, &provenance(&notes, &film, denoised.map(|_| how.name())))?))
}

/// How far the colours are from what they were; none where they are the same.
fn difference(there: &[u8], here: &[u8], path: &Path) -> Result<Option<String>, Failure> {
    let read = |bytes: &[u8]| Picture::of(bytes, path).map_err(|error| Failure::could_not(error.to_string()));
    let (there, here) = (read(there)?, read(here)?);
    if [there.width, there.height] != [here.width, here.height] {
        return Ok(Some(format!("it has {}x{} pixels now", there.width, there.height)));
    }
    let pixels = there.values.chunks(3).zip(here.values.chunks(3)).filter(|(there, here)| there != here).count();
    Ok((pixels > 0).then(|| format!("{pixels} of {} pixels have another colour", there.values.len() / 3)))
}
