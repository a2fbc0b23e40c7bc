//! What must hold of a run in which something failed.

use super::cases::{Case, Kind};
use super::run::{Call, Folder, Ran};
use std::collections::BTreeMap;
use std::fs::File;
use tracer_core::SavedFilm;

/// What fails.
#[derive(Clone, Debug)]
pub struct Fault {
    pub call: usize,
    /// A number of `errno`, or `short`.
    pub how: String,
    /// All that writes fails from then on.
    pub goes_on: bool,
    /// Nothing is lost by it: the run must do all the same.
    pub is_harmless: bool,
}

/// The run without faults.
pub struct Quiet {
    pub calls: Vec<Call>,
    before: BTreeMap<String, Vec<u8>>,
    after: BTreeMap<String, Vec<u8>>,
    out: Vec<u8>,
}

/// The words of a line, with one thread: so that calls come in one order.
pub fn words(case: &Case) -> Vec<String> {
    let mut words: Vec<String> = case.line.split(' ').map(str::to_owned).collect();
    if ["render", "merge"].contains(&words[0].as_str()) {
        words.extend(["--threads".to_owned(), "1".to_owned()]);
    }
    words
}

impl Quiet {
    pub fn of(case: &Case) -> Self {
        let folder = case.folder.copy();
        let ran = folder.run(&words(case), &[("FAULT_AT", "0".to_owned())]);
        assert_eq!(ran.code, Some(case.code), "{}: {}", case.name, ran.err);
        let quiet = Quiet { calls: ran.calls, before: case.folder.files(), after: folder.files(), out: ran.out };
        for (name, kind) in &case.outputs {
            let is_written = quiet.after.contains_key(*name) && quiet.before.get(*name) != quiet.after.get(*name);
            assert!(is_written || *kind == Kind::Film, "{}: {name} is written", case.name);
        }
        quiet
    }

    /// Runs it with a fault; what was wrong then, if anything.
    pub fn judge(&self, case: &Case, fault: &Fault) -> Option<String> {
        let folder = case.folder.copy();
        let mut told = vec![("FAULT_AT", fault.call.to_string()), ("FAULT_HOW", fault.how.clone())];
        if fault.goes_on {
            told.push(("FAULT_ON", "1".to_owned()));
        }
        let ran = folder.run(&words(case), &told);
        let mut wrong = self.wrong(case, &folder, &ran);
        if fault.is_harmless && ran.code != Some(case.code) {
            wrong.push("it fails of what is no fault".to_owned());
        }
        let hit = ran.hit.as_deref().unwrap_or("nothing");
        let on = if fault.goes_on { ", and all that writes after it" } else { "" };
        (!wrong.is_empty()).then(|| {
            let (name, how, said) = (case.name, &fault.how, ran.err.trim());
            format!("{name}: {hit} by {how}{on}: {}; exit code {:?}, it says: {said}", wrong.join("; "), ran.code)
        })
    }

    /// What is wrong with a run that may have failed.
    pub fn wrong(&self, case: &Case, folder: &Folder, ran: &Ran) -> Vec<String> {
        let mut wrong = Vec::new();
        if ran.timed_out {
            wrong.push("it does not end".to_owned());
        }
        if ran.signal.is_some() || ran.code.is_none_or(|code| code > 2) || ran.err.contains("panicked") {
            wrong.push(format!("it is killed by signal {:?}, or panics", ran.signal));
        }
        let files = folder.files();
        let is_done = ran.code == Some(0);
        if case.code != 0 {
            let mut left = files.clone();
            left.retain(|name, _| {
                !(ran.hit.as_ref().is_some_and(|hit| hit.contains(" unlink ")) && name.ends_with(".tmp"))
            });
            if is_done || left != self.before {
                wrong.push("what must be refused is done".to_owned());
            }
            return wrong;
        }
        for (name, kind) in &case.outputs {
            let (old, new, now) = (self.before.get(*name), self.after.get(*name), files.get(*name));
            let is_new = is_whole(*kind, now, new, folder, name);
            if !is_new && (is_done || now != old) {
                let what = if now.is_none() { "is gone" } else { "is neither old nor new" };
                wrong.push(format!("{name} {what}"));
            }
        }
        self.others(case, &files, ran, &mut wrong);
        // What is kept goes by what it holds.
        let kept = files.iter().filter(|(name, _)| name.starts_with("kept/") && name.ends_with(".kept"));
        for (name, _) in kept.filter(|(name, bytes)| self.after.get(*name) != Some(*bytes)) {
            wrong.push(format!("{name} is not what is kept without a fault"));
        }
        self.elsewhere(folder, &mut wrong);
        if is_done && ran.out != self.out && !case.line.contains("--report -") {
            wrong.push("it has put something else out".to_owned());
        }
        if !is_done {
            said(case, ran, &mut wrong);
        }
        if case.outputs.iter().any(|(name, _)| *name == "c.film") {
            self.goes_on(case, folder, &mut wrong);
        }
        wrong
    }

    /// The same of a disk that was full from the start, on which nothing can be gone on with.
    pub fn wrong_on_full_disk(&self, case: &Case, folder: &Folder, ran: &Ran) -> Vec<String> {
        let mut wrong = self.wrong(case, folder, ran);
        wrong.retain(|fault| !fault.starts_with("it cannot be gone on with"));
        wrong
    }

    /// Inputs stay, and nothing else is left.
    fn others(&self, case: &Case, files: &BTreeMap<String, Vec<u8>>, ran: &Ran, wrong: &mut Vec<String>) {
        let is_output = |name: &str| case.outputs.iter().any(|(output, _)| *output == name);
        let may_go = |name: &str| name.contains("/.golden/");
        for (name, bytes) in self.before.iter().filter(|(name, _)| !is_output(name) && !may_go(name)) {
            if files.get(name) != Some(bytes) {
                wrong.push(format!("{name} has changed"));
            }
        }
        // What cannot be deleted stays, and so does a lock of which the system does not tell whose it is.
        let hit = ran.hit.as_deref().unwrap_or_default();
        let stays = |name: &str| {
            // The log has the last part of a name.
            let name = name.rsplit('/').next().unwrap_or(name);
            (hit.contains(" unlink ") && (name.ends_with(".tmp") || hit.contains(&format!(" {name} "))))
                || (name.ends_with(".lock") && hit.contains("stat r ") && hit.contains(name))
        };
        for name in files.keys() {
            let known = self.before.contains_key(name) || self.after.contains_key(name) || is_output(name);
            if !known && !stays(name) {
                wrong.push(format!("{name} is left"));
            }
        }
    }

    /// A picture that has lost its place is whole where it is now.
    fn elsewhere(&self, folder: &Folder, wrong: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder.elsewhere()).expect("a folder").flatten() {
            let bytes = std::fs::read(entry.path()).expect("a file");
            let is_film = || File::open(entry.path()).is_ok_and(is_whole_film);
            if !self.after.values().any(|new| *new == bytes) && !is_film() {
                wrong.push(format!("{} is half written", entry.path().display()));
            }
        }
    }

    /// The checkpoint that is there is gone on with, to the bytes of a run that nothing has disturbed.
    fn goes_on(&self, case: &Case, folder: &Folder, wrong: &mut Vec<String>) {
        let words = words(case).iter().map(|word| word.replace("--checkpoint", "--resume")).collect::<Vec<_>>();
        let ran = folder.run(&words, &[]);
        if ran.code != Some(0) || folder.files().get("a.pfm") != self.after.get("a.pfm") {
            wrong.push(format!("it cannot be gone on with: {}", ran.err.trim()));
        }
    }
}

fn is_whole_film(file: File) -> bool {
    SavedFilm::open(file).and_then(SavedFilm::check).is_ok()
}

fn is_whole(kind: Kind, now: Option<&Vec<u8>>, new: Option<&Vec<u8>>, folder: &Folder, name: &str) -> bool {
    match (kind, now) {
        (Kind::Bytes, now) => now == new,
        (Kind::Json, Some(now)) => serde_json::from_slice::<serde_json::Value>(now).is_ok(),
        (Kind::Film, Some(_)) => File::open(folder.path(name)).is_ok_and(is_whole_film),
        // There is one before where there was time for two.
        (Kind::Film, None) => name.ends_with(".previous"),
        (Kind::Json, None) => false,
    }
}

/// A run that has failed says so: with a file's name, and, where one cannot be written, with what to do.
fn said(case: &Case, ran: &Ran, wrong: &mut Vec<String>) {
    let hit = ran.hit.as_deref().unwrap_or_default();
    let file = hit.split(' ').nth(3).unwrap_or_default();
    let outputs = case.outputs.iter().map(|(name, _)| *name);
    let names = case.line.split(' ').filter(|word| word.contains('.')).chain(outputs).chain([file, "standard output"]);
    let of_folder = format!("folder {file}:");
    let is_named = names.filter(|name| name.len() > 1).any(|name| ran.err.contains(name));
    let is_named = is_named || ran.err.contains(&of_folder) || ran.err.contains(&format!("{file}: "));
    if !is_named || !ran.err.contains("error") {
        wrong.push("it does not say which file".to_owned());
    }
    let tips = ["make room", "name another", "name a place"];
    if hit.contains(" w ") && !ran.err.contains("standard output") && !tips.iter().any(|tip| ran.err.contains(tip)) {
        wrong.push("it does not say what to do".to_owned());
    }
}
