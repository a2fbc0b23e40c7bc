//! `tracer golden run`: renders the scenes of folders and compares.

use super::accept::files_of_scenes;
use super::examine::{Opened, colours};
use super::made::PAGE;
use crate::args::GoldenRunArgs;
use crate::failure::{Failure, exit};
use crate::loading::{is_dash, use_threads};
use crate::shell::Shell;
use crate::write::{OutputKind, is_one_file, leads_to_same, probe, save, spare_other};
use crate::{interrupt, lanes};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use tracer_golden::folder::Case;
use tracer_golden::outcome::Outcome;
use tracer_golden::outputs::{counts, github, html, json, junit, lines};
use tracer_golden::settings::FILE;

pub(super) fn run(args: &GoldenRunArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let level = lanes::from_environment()?;
    use_threads(args.threads)?;
    let folders = open(&args.folders)?;
    let chosen = chosen(&folders, &args.only)?;
    let outputs = Outputs::new(args)?;
    outputs.spare_folders(&folders)?;
    interrupt::listen(*shell)?;
    let threads = args.threads.map_or(0, usize::from);
    let to_stdout = outputs.files.iter().any(|(_, path)| is_dash(path));
    let mut outcomes: Vec<Outcome> = Vec::new();
    let mut read: Vec<PathBuf> = Vec::new();
    for (opened, cases) in folders.iter().zip(chosen) {
        let first = read.len();
        let begin = outcomes.len();
        for case in cases {
            let Some(examined) = opened.examine(case, threads, level)? else {
                return Ok(ExitCode::from(interrupt::requested().unwrap_or(exit::INTERRUPTED)));
            };
            tell(&examined.outcome, to_stdout)?;
            read.extend(examined.files);
            outcomes.push(examined.outcome);
        }
        // Where only some are run, nobody knows what the others read.
        if args.only.is_empty() {
            for orphan in opened.orphans(&read[first..]) {
                tell(&orphan, to_stdout)?;
                outcomes.push(orphan);
            }
        }
        keep_page(opened, &outcomes[begin..], shell)?;
    }
    outputs.spare(&read)?;
    outputs.write(&outcomes)?;
    if args.github || std::env::var_os("GITHUB_ACTIONS").is_some_and(|value| value == "true") {
        say(&github::annotations(&outcomes), to_stdout)?;
    }
    say(&lines::summary(&outcomes), to_stdout)?;
    Ok(ExitCode::from(if counts(&outcomes)[1] == 0 { exit::DONE } else { exit::FAILED }))
}

/// The folders, each once.
///
/// # Errors
/// When one is none.
fn open(paths: &[PathBuf]) -> Result<Vec<Opened>, Failure> {
    let mut folders: Vec<Opened> = Vec::new();
    for path in paths {
        if !folders.iter().any(|opened| leads_to_same(&opened.path, path)) {
            let shown = path.display().to_string();
            let name = shown.trim_end_matches(['/', '\\']);
            folders.push(Opened::open(path, if name.is_empty() { &shown } else { name })?);
        }
    }
    Ok(folders)
}

/// The scenes that are run, folder by folder.
///
/// # Errors
/// When a name is none of theirs.
fn chosen<'a>(folders: &'a [Opened], only: &[String]) -> Result<Vec<Vec<&'a Case>>, Failure> {
    let all = || folders.iter().flat_map(|opened| &opened.folder.cases);
    for name in only {
        if !all().any(|case| case.name == *name) {
            let near = scene_format::nearest(name, all().map(|case| case.name.as_str()));
            let tip = near.map_or(String::new(), |near| format!("; did you mean {near}?"));
            return Err(Failure::wrong(format!("--only {name}: there is no scene of that name{tip}")));
        }
    }
    let is_chosen = |case: &&Case| only.is_empty() || only.contains(&case.name);
    Ok(folders.iter().map(|opened| opened.folder.cases.iter().filter(is_chosen).collect()).collect())
}

/// A line as soon as it is known.
fn tell(outcome: &Outcome, to_stdout: bool) -> Result<(), Failure> {
    say(&lines::line(outcome), to_stdout)
}

/// On standard output; on standard error where a document goes there.
fn say(text: &str, document_to_stdout: bool) -> Result<(), Failure> {
    if document_to_stdout {
        return Ok(std::io::stderr().lock().write_all(text.as_bytes())?);
    }
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes())?;
    Ok(out.flush()?)
}

/// Where something failed, the page that shows it, beside what was made.
fn keep_page(opened: &Opened, outcomes: &[Outcome], shell: &Shell) -> Result<(), Failure> {
    let made = opened.made();
    if counts(outcomes)[1] == 0 {
        return Ok(());
    }
    let io = |error: std::io::Error| Failure::could_not(format!("cannot make {}: {error}", made.display()));
    std::fs::create_dir_all(&made).map_err(io)?;
    // Nothing in it is for a repository.
    let ignore = made.join(".gitignore");
    if !ignore.exists() {
        save(&ignore, b"*\n")?;
    }
    let page = made.join(PAGE);
    save(&page, page_of(outcomes)?.as_bytes())?;
    if shell.is_told() {
        shell.say(&format!("look at {}", page.display()));
    }
    Ok(())
}

fn page_of(outcomes: &[Outcome]) -> Result<String, Failure> {
    html::page(outcomes, &colours).map_err(|error| Failure::could_not(format!("cannot encode a picture: {error}")))
}

/// The files that the command line asks for.
struct Outputs<'a> {
    files: Vec<(&'static str, &'a Path)>,
}

impl<'a> Outputs<'a> {
    /// # Errors
    /// When two are one, or one cannot be written.
    fn new(args: &'a GoldenRunArgs) -> Result<Self, Failure> {
        let named = [("--junit", &args.junit), ("--json", &args.json), ("--html", &args.html)];
        let files: Vec<(&str, &Path)> =
            named.into_iter().filter_map(|(option, path)| Some((option, path.as_deref()?))).collect();
        for (k, (option, path)) in files.iter().enumerate() {
            if let Some((other, _)) = files[..k].iter().find(|(_, other)| is_one_file(other, path)) {
                let shown = path.display();
                return Err(Failure::wrong(format!("{other} and {option} both name {shown}; name two places")));
            }
            if !is_dash(path) {
                probe(path)?;
            }
        }
        Ok(Outputs { files })
    }

    /// Sees that none of them replaces a file of the folders or one that a scene reads.
    ///
    /// # Errors
    /// The first that would.
    fn spare(&self, read: &[PathBuf]) -> Result<(), Failure> {
        for (option, path) in &self.files {
            if let Some(input) = read.iter().find(|input| is_one_file(path, input)) {
                let also = if *path == input { String::new() } else { format!(" (it is {})", input.display()) };
                let shown = path.display();
                return Err(Failure::wrong(format!(
                    "{option} {shown} would replace a file of the scenes{also}; name another file"
                )));
            }
        }
        Ok(())
    }

    /// The same for all files of the folders, and all that their scenes read, also those that are not run.
    ///
    /// # Errors
    /// The first that would, or what a run before found cannot be read.
    fn spare_folders(&self, folders: &[Opened]) -> Result<(), Failure> {
        for opened in folders.iter().filter(|_| !self.files.is_empty()) {
            let mut own = files_of_scenes(opened)?;
            own.extend(opened.folder.pictures.clone());
            own.extend([opened.path.join(FILE), opened.path.join("log.md")]);
            self.spare(&own)?;
        }
        let kind = |option: &str| match option {
            "--junit" => OutputKind::Junit,
            "--json" => OutputKind::Report,
            _ => OutputKind::Page,
        };
        let mut files = self.files.iter().filter(|(_, path)| !is_dash(path));
        files.try_for_each(|(option, path)| Ok(spare_other(path, kind(option))?))
    }

    fn write(&self, outcomes: &[Outcome]) -> Result<(), Failure> {
        for (option, path) in &self.files {
            let text = match *option {
                "--junit" => junit::report(outcomes),
                "--json" => json::report(outcomes).map_err(|error| Failure::could_not(error.to_string()))?,
                _ => page_of(outcomes)?,
            };
            match is_dash(path) {
                true => say(&text, false)?,
                false => save(path, text.as_bytes())?,
            }
        }
        Ok(())
    }
}
