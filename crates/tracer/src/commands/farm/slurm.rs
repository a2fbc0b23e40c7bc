//! `tracer farm slurm`: writes the scripts, submits the parts that are missing, and the merge.

use super::parts::{self, State, Told};
use super::queue::{self, Queued};
use super::record::{Layout, Record, whole};
use super::scripts::{self, MERGE, PART, Scripts};
use super::settings::{self, text};
use crate::args::FarmSlurmArgs;
use crate::command_line::quoted;
use crate::commands::render::{self, frames};
use crate::failure::{Failure, exit};
use crate::loading::{asset_files, is_dash};
use crate::shell::{Shell, counted};
use crate::write::{is_one_file, save};
use rayon::prelude::*;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

pub(super) fn run(args: &FarmSlurmArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let of_frame = |frame| args.of_frame(frame, |path| frames::of_frame(path, frame));
    let Some(asked) = args.frames else {
        return args.scene.frame.map_or_else(|| one(args, shell), |frame| one(&of_frame(frame), shell));
    };
    if is_dash(&args.scene.scene) {
        return Err(Failure::wrong(DASH));
    }
    for path in args.output.iter().chain(&args.folder) {
        frames::expect_number(path)?;
    }
    // A farm for each frame: what is wrong with one is told before any is submitted, and the same line goes on.
    let (first, last, _) = frames::range(&args.as_render(), asked, shell)?;
    for frame in first..=last {
        one(&of_frame(frame), shell)?;
    }
    Ok(ExitCode::from(exit::DONE))
}

/// Nodes and this program read the same files.
const DASH: &str = "the nodes of a farm read and write files: scene and picture cannot be -";

/// The farm of a picture.
fn one(args: &FarmSlurmArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let rendering = args.as_render();
    if is_dash(&args.scene.scene) || args.output.iter().any(|path| is_dash(path)) {
        return Err(Failure::wrong(DASH));
    }
    let outputs = render::outputs::outputs(&rendering)?;
    render::outputs::probe(&outputs, None)?;
    let mut desc = render::of_parts(&rendering, args.parts, shell)?;
    let named: Vec<PathBuf> = asset_files(&desc).into_iter().map(|file| desc.base_dir.join(file)).collect();
    render::outputs::spare_inputs(&outputs, &rendering, &named)?;
    let mut record = settings::record(args, &mut desc, shell)?;
    let layout = layout(args)?;
    let scripts = Scripts::new(args, &desc, &layout, &record)?;
    if args.dry_run {
        let mut out = std::io::stdout().lock();
        out.write_all(dry_run(args, &layout, &scripts)?.as_bytes())?;
        out.flush()?;
        return Ok(ExitCode::from(exit::DONE));
    }
    if layout.folder.exists() && !layout.is_farm() && !is_empty(&layout.folder) {
        let shown = layout.folder.display();
        return Err(Failure::wrong(format!("{shown} is there already and is no farm; name another by --folder")));
    }
    check_size(args)?;
    layout.make()?;
    let _lock = layout.lock()?;
    if layout.is_farm() {
        let there = layout.load()?;
        let differences = settings::differences(&there, &record);
        if !differences.is_empty() {
            return Err(Failure::wrong(format!(
                "{} is of another rendering: {}; name another folder by --folder, or delete it",
                layout.folder.display(),
                differences.join("; ")
            )));
        }
        (record.arrays, record.merge) = (there.arrays, there.merge);
    }
    let queued = queue::queue(&jobs(&record))?;
    let told = sound(&layout, &record, &queued, shell)?;
    record.arrays.retain(|job| queued.iter().any(|entry| entry.job == *job));
    for (name, text) in [(PART, &scripts.part), (MERGE, &scripts.merge)] {
        save(&layout.folder.join(name), text.as_bytes())?;
    }
    layout.save(&record)?;
    submit(args, &layout, &mut record, &told, &queued)?;
    tell(&layout, &record, &told, shell);
    Ok(ExitCode::from(exit::DONE))
}

/// Where the farm is, or will be.
fn layout(args: &FarmSlurmArgs) -> Result<Layout, Failure> {
    let folder = match &args.folder {
        Some(folder) => folder.clone(),
        None => args.output[0].with_extension("farm"),
    };
    let folder = whole(&folder)?;
    // In the names of logs sbatch has a meaning of its own for it, and takes no other sign for that.
    if text(&folder)?.contains(['\\', '\n']) {
        let shown = folder.display();
        return Err(Failure::wrong(format!(
            "the folder {shown} has a backslash or a line's end in its name, which Slurm does not take in the names of \
             logs; name another by --folder"
        )));
    }
    if is_one_file(&folder, &args.scene.scene) {
        return Err(Failure::wrong("--folder names the scene; name another place"));
    }
    Ok(Layout { folder })
}

fn is_empty(folder: &Path) -> bool {
    // What a run that was refused has left may be there.
    let ours = ["farm.lock", "parts", "logs", "state"];
    fs::read_dir(folder).is_ok_and(|mut entries| {
        entries.all(|entry| entry.is_ok_and(|entry| ours.iter().any(|name| entry.file_name() == *name)))
    })
}

fn jobs(record: &Record) -> Vec<String> {
    record.arrays.iter().chain(&record.merge).cloned().collect()
}

/// An array that Slurm would refuse is refused here, with the number that it takes.
fn check_size(args: &FarmSlurmArgs) -> Result<(), Failure> {
    match queue::largest_task()? {
        Some(largest) if args.parts > largest => Err(Failure::wrong(format!(
            "--parts {}: the arrays of this cluster end at {largest} (its MaxArraySize is {}); take no more parts",
            args.parts,
            largest + 1
        ))),
        _ => Ok(()),
    }
}

/// How far the parts are. Films that are done are read to their end: of a damaged one the part is rendered again.
fn sound(layout: &Layout, record: &Record, queued: &[Queued], shell: &Shell) -> Result<Vec<Told>, Failure> {
    let mut told = parts::parts(layout, record, queued);
    let film = |k: usize| layout.film(k as u32 + 1, record.parts);
    let damaged: Vec<(usize, String)> = told
        .par_iter()
        .enumerate()
        .filter(|(_, told)| told.state == State::Done)
        .filter_map(|(k, _)| parts::check(&film(k)).err().map(|error| (k, error.to_string())))
        .collect();
    for (k, error) in damaged {
        let path = film(k);
        let aside = path.with_extension("damaged");
        let could_not = |error| Failure::could_not(format!("cannot rename {}: {error}", path.display()));
        fs::rename(&path, &aside).map_err(could_not)?;
        shell.say(&format!(
            "warning: {} cannot be used: {error}; it is {} now, and the part is rendered again",
            path.display(),
            aside.display()
        ));
        told[k].state = State::Stopped;
    }
    Ok(told)
}

/// Submits what is neither done nor in the queue, and a merge that comes after all of it.
fn submit(
    args: &FarmSlurmArgs,
    layout: &Layout,
    record: &mut Record,
    told: &[Told],
    queued: &[Queued],
) -> Result<(), Failure> {
    for (k, told) in told.iter().enumerate() {
        let name = (k + 1).to_string();
        match told.state {
            // A job may have been killed between its film and this.
            State::Done => save(&layout.state(&name, "done"), b"")?,
            State::Failed | State::Stopped => forget(layout, &name, &["done", "failed", "tries"])?,
            State::Running | State::Waiting => {}
        }
    }
    let missing = missing(told);
    let is_merging = record.merge.as_ref().filter(|job| queued.iter().any(|entry| entry.job == **job));
    let is_merged = layout.state("merge", "done").exists()
        && args.output.iter().all(|picture| picture.exists())
        && told.iter().all(|told| told.state == State::Done);
    if missing.is_empty() && (is_merging.is_some() || is_merged) {
        return Ok(());
    }
    if !missing.is_empty() {
        record.arrays.push(queue::submit(&scripts::array(args, layout, &missing)?)?);
        // Kept at once: what is submitted must not be submitted again, whatever comes.
        layout.save(record)?;
    }
    // One that is in the queue waits for the parts before alone.
    queue::cancel(&is_merging.cloned().into_iter().collect::<Vec<_>>())?;
    forget(layout, "merge", &["done", "failed"])?;
    record.merge = Some(queue::submit(&scripts::merge(args, layout, &record.arrays)?)?);
    layout.save(record)
}

/// The parts that are neither done nor in the queue.
fn missing(told: &[Told]) -> Vec<u32> {
    let lost = told.iter().enumerate().filter(|(_, told)| told.state.is_lost());
    lost.map(|(k, _)| k as u32 + 1).collect()
}

/// Deletes what a script has kept.
fn forget(layout: &Layout, name: &str, what: &[&str]) -> Result<(), Failure> {
    for what in what {
        let path = layout.state(name, what);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(Failure::could_not(format!("cannot delete {}: {error}", path.display())));
            }
            _ => {}
        }
    }
    Ok(())
}

/// Says what was done, and what to type next.
fn tell(layout: &Layout, record: &Record, told: &[Told], shell: &Shell) {
    let folder =
        std::env::current_dir().ok().and_then(|here| layout.folder.strip_prefix(here).ok()).unwrap_or(&layout.folder);
    let (shown, quoted) = (folder.display(), quoted(&folder.to_string_lossy()));
    let count = |state: State| told.iter().filter(|told| told.state == state).count();
    let missing = missing(told);
    let pictures = record.pictures.join(", ");
    let parts = counted(told.len(), "part");
    if missing.is_empty() && count(State::Done) == told.len() && layout.state("merge", "done").exists() {
        shell.say(&format!("{shown}: all {parts} are done and merged: {pictures}"));
        return;
    }
    let mut said = Vec::new();
    for (state, verb) in [(State::Done, "done already"), (State::Running, "running"), (State::Waiting, "waiting")] {
        if count(state) > 0 {
            said.push(format!("{} {verb}", count(state)));
        }
    }
    if let (false, Some(job)) = (missing.is_empty(), record.arrays.last()) {
        said.push(format!("{} submitted as job {job}", missing.len()));
    }
    let merge = record.merge.as_deref().unwrap_or("none");
    shell.say(&format!("{shown}: of {parts} {}; job {merge} merges them: {pictures}", said.join(", ")));
    shell.say(&format!("  tracer farm status {quoted}\n  tracer farm cancel {quoted}"));
}

/// The scripts and the commands, as text.
fn dry_run(args: &FarmSlurmArgs, layout: &Layout, scripts: &Scripts) -> Result<String, Failure> {
    let all: Vec<u32> = (1..=args.parts).collect();
    let line = |words: Vec<String>| words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ");
    let shown = |name: &str| layout.folder.join(name).display().to_string();
    Ok(format!(
        "# {}\n{}\n# {}\n{}\n# submitted by\nsbatch {}\nsbatch {}\n",
        shown(PART),
        scripts.part,
        shown(MERGE),
        scripts.merge,
        line(scripts::array(args, layout, &all)?),
        line(scripts::merge(args, layout, &["JOB".to_owned()])?)
    ))
}
