//! `tracer golden accept`: what was made becomes what is expected, with a reason.

use super::examine::Opened;
use super::made::{Made, NOISE, PICTURE, Record, waiting};
use super::rendering::{NoPicture, load, stamp};
use crate::args::GoldenAcceptArgs;
use crate::failure::{Failure, exit};
use crate::shell::Shell;
use crate::write::{advice, is_one_file, save};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use tracer_core::named_files;
use tracer_golden::folder::Case;
use tracer_golden::log::{FILE, with_line};

/// A picture to accept: whole, before the first one is written.
struct Acceptance<'a> {
    case: &'a Case,
    made: Made,
    png: Vec<u8>,
    exr: Option<Vec<u8>>,
}

pub(super) fn run(args: &GoldenAcceptArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    if args.reason.trim().is_empty() {
        return Err(Failure::wrong("say why the new picture is right: --reason \"...\""));
    }
    let shown = args.folder.display().to_string();
    let opened = Opened::open(&args.folder, shown.trim_end_matches('/'))?;
    let names = if args.all_failed { waiting(&opened.made()) } else { args.names.clone() };
    if names.is_empty() {
        return Err(Failure::wrong(format!(
            "nothing waits to be accepted in {shown}; `tracer golden run {shown}` first"
        )));
    }
    let read = files_of_scenes(&opened)?;
    let accepted = names.iter().map(|name| acceptance(&opened, name, &read)).collect::<Result<Vec<_>, Failure>>()?;
    let log = opened.path.join(FILE);
    let mut out = std::io::stdout().lock();
    for Acceptance { case, made, png, exr } in accepted {
        let is_new = !case.png.exists();
        if let Some(folder) = case.png.parent() {
            let io =
                |error| Failure::could_not(format!("cannot make {}: {error}; {}", folder.display(), advice(&error)));
            std::fs::create_dir_all(folder).map_err(io)?;
        }
        // The reason comes first: should the program be ended here, there is a reason without a picture, and never a
        // picture without one.
        let old = match std::fs::read_to_string(&log) {
            Ok(old) => old,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(Failure::could_not(format!("cannot read {}: {error}", log.display()))),
        };
        save(&log, with_line(&old, &case.name, is_new, &args.reason).as_bytes())?;
        if let Some(exr) = exr {
            save(&case.exr, &exr)?;
        }
        save(&case.png, &png)?;
        made.clear();
        writeln!(out, "{}/{}: {}", opened.name, case.name, if is_new { "new" } else { "changed" })?;
    }
    out.flush()?;
    if shell.is_told() {
        shell.say(&format!("the reason is in {}", log.display()));
    }
    Ok(ExitCode::from(exit::DONE))
}

/// What the scenes of a folder read, as far as they say: their own files, what they name, and what runs found that
/// these name.
///
/// # Errors
/// When what a run found cannot be read.
pub(super) fn files_of_scenes(opened: &Opened) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    for case in &opened.folder.cases {
        files.push(case.scene.clone());
        files.extend(Made::of(&opened.made(), &case.name).record()?.map(|record| record.files).unwrap_or_default());
        match load(case, &opened.settings) {
            Ok(desc) => files.extend(named_files(&desc)),
            Err(NoPicture::Wrong { files: named, .. }) => files.extend(named),
            Err(NoPicture::Interrupted) => {}
        }
    }
    Ok(files)
}

/// # Errors
/// When there is no such scene, no picture of it as it is now, or a scene reads what would be replaced.
fn acceptance<'a>(opened: &'a Opened, name: &str, read: &[PathBuf]) -> Result<Acceptance<'a>, Failure> {
    let folder = &opened.name;
    let cases = &opened.folder.cases;
    let case = cases.iter().find(|case| case.name == name).ok_or_else(|| {
        let near = scene_format::nearest(name, cases.iter().map(|case| case.name.as_str()));
        let tip = near.map_or(String::new(), |near| format!("; did you mean {near}?"));
        Failure::wrong(format!("there is no scene {name} in {folder}{tip}"))
    })?;
    let made = Made::of(&opened.made(), name);
    let again = format!("`tracer golden run {folder} --only {name}` makes one");
    let Some(Record { stamp: known, files, .. }) = made.record()? else {
        let why = "no picture waits to be accepted: either none was made yet, or what was made is as expected";
        return Err(Failure::wrong(format!(
            "{folder}/{name}: {why}; `tracer golden run {folder} --only {name}` tells"
        )));
    };
    let now = match load(case, &opened.settings) {
        Ok(desc) => Some(stamp(&desc, &files)),
        Err(NoPicture::Wrong { what, .. }) => return Err(Failure::wrong(format!("{folder}/{name}: {what}; {again}"))),
        Err(NoPicture::Interrupted) => None,
    };
    if now.is_none_or(|now| now != known) {
        let what = "the scene, a file that it uses or the settings have changed since the picture was made";
        return Err(Failure::wrong(format!("{folder}/{name}: {what}; {again}")));
    }
    let bytes = |path: &Path| {
        std::fs::read(path).map_err(|error| Failure::could_not(format!("cannot read {}: {error}", path.display())))
    };
    let png = bytes(&made.path(PICTURE))?;
    let exr = opened.settings.noise.then(|| bytes(&made.path(NOISE))).transpose()?;
    let targets = [Some(&case.png), exr.as_ref().map(|_| &case.exr)];
    for target in targets.into_iter().flatten() {
        if read.iter().any(|file| is_one_file(target, file)) {
            let shown = target.display();
            return Err(Failure::wrong(format!(
                "{folder}/{name}: {shown} is read by a scene and is not replaced; give the scene or that file \
                another name"
            )));
        }
    }
    Ok(Acceptance { case, made, png, exr })
}
