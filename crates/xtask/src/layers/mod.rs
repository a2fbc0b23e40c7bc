//! Layers of the source: which room of a crate may use which, how long functions and lines are.
//!
//! `layers.toml` beside this crate's manifest has the order of the rooms of each crate; its head says how it is read.

pub mod source;

use anyhow::{Context as _, ensure};
use serde::Deserialize;
use source::Source;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;

/// Where the rules stand, from the root of the repository.
pub const RULES: &str = "crates/xtask/layers.toml";
/// Lines of the longest function that needs no reason.
pub const LONGEST_FUNCTION: usize = 80;
/// Characters of the longest line.
pub const LONGEST_LINE: usize = 120;

/// The order of rooms as the file has it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rules {
    /// Crates, by name.
    #[serde(rename = "crate")]
    pub crates: BTreeMap<String, CrateRules>,
    /// Files and folders whose lines are held short.
    pub lines: Held,
}

/// The order of the rooms of a crate.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CrateRules {
    /// Its `lib.rs` or `main.rs`.
    pub root: String,
    /// From the ground up: each may use itself and those before it.
    pub rooms: Vec<String>,
    /// Arrows that point upward for the time being.
    #[serde(default)]
    pub exceptions: Vec<Exception>,
}

/// An arrow that points upward for the time being.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exception {
    /// The room that uses.
    pub from: String,
    /// The room above that is used.
    pub to: String,
    /// What has to be done for it to go.
    pub why: String,
}

/// Files and folders whose lines are held short.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Held {
    /// Paths from the root of the repository.
    pub held: Vec<String>,
}

/// What was found.
#[derive(Debug, Default)]
pub struct Findings {
    /// What is wrong, a line each.
    pub faults: Vec<String>,
    /// Per crate and room: the rooms that it uses.
    pub arrows: BTreeMap<String, Vec<(String, BTreeSet<String>)>>,
}

impl Rules {
    /// Reads `crates/xtask/layers.toml` below the root of the repository.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn read(root: &Path) -> anyhow::Result<Self> {
        let path = root.join(RULES);
        let text = std::fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
        toml::from_str(&text).with_context(|| format!("in {}", path.display()))
    }
}

/// Examines the source below the root of the repository.
///
/// # Errors
/// When a file cannot be read.
pub fn examine(root: &Path, rules: &Rules) -> anyhow::Result<Findings> {
    let mut findings = Findings::default();
    for (name, of_crate) in &rules.crates {
        let source = Source::read(&root.join(&of_crate.root))?;
        arrows(name, of_crate, root, &source, &mut findings)?;
        hold_functions(root, &source, &mut findings.faults);
    }
    for held in &rules.lines.held {
        hold_lines(root, &root.join(held), &mut findings.faults)?;
    }
    Ok(findings)
}

/// The room of a module: the one whose path is the longest beginning of the module's.
fn room_of<'a>(path: &[String], rooms: &'a [String]) -> Option<&'a String> {
    let holds = |room: &&String| {
        let names: Vec<&str> = room.split('/').collect();
        names.len() <= path.len() && names.iter().zip(path).all(|(a, b)| a == b) || path.is_empty() && *room == "crate"
    };
    rooms.iter().filter(holds).max_by_key(|room| room.split('/').count())
}

/// Holds the arrows of a crate against the order of its rooms.
fn arrows(name: &str, rules: &CrateRules, root: &Path, source: &Source, findings: &mut Findings) -> anyhow::Result<()> {
    let rank: BTreeMap<&str, usize> = rules.rooms.iter().enumerate().map(|(k, room)| (room.as_str(), k)).collect();
    ensure!(rank.len() == rules.rooms.len(), "{name}: a room stands twice in layers.toml");
    let mut uses: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    let mut empty: BTreeSet<&str> = rank.keys().copied().collect();
    let mut needless: BTreeSet<(&str, &str)> = BTreeSet::new();
    for Exception { from, to, why } in &rules.exceptions {
        for room in [from, to] {
            ensure!(rank.contains_key(room.as_str()), "{name}: layers.toml excepts {room}, which is no room");
        }
        ensure!(!why.trim().is_empty(), "{name}: the exception {from} -> {to} has no reason");
        needless.insert((from, to));
    }
    let excepted = needless.clone();
    for (path, module) in &source.modules {
        let file = module.file.strip_prefix(root).unwrap_or(&module.file).display();
        let Some(room) = room_of(path, &rules.rooms) else {
            let fault = format!("{file} lies in no room of {name}: give it a place in {RULES}");
            findings.faults.push(fault);
            continue;
        };
        empty.remove(room.as_str());
        for mention in &module.mentions {
            let target = source.resolve(&mention.names);
            // Every module may name itself, those in it and those that hand on what is in it.
            let Some(to) = room_of(&target, &rules.rooms).filter(|&to| to != room) else { continue };
            let arrow = (room.as_str(), to.as_str());
            needless.remove(&arrow);
            let is_upward = rank[arrow.1] > rank[arrow.0];
            let mark = if is_upward { format!("^{to}") } else { to.clone() };
            uses.entry(room).or_default().insert(mark);
            if is_upward && !excepted.contains(&arrow) {
                let names = mention.names.join("::");
                findings.faults.push(format!("{file}:{}: {room} uses {to}, which is above it: {names}", mention.line));
            }
        }
    }
    for (from, to) in needless {
        let fault = format!("{name}: {from} uses {to} no more: take the exception out of {RULES}");
        findings.faults.push(fault);
    }
    for room in empty {
        findings.faults.push(format!("{name}: there is no room {room}: take it out of {RULES}"));
    }
    let of_room = |room: &String| (room.clone(), uses.remove(room.as_str()).unwrap_or_default());
    findings.arrows.insert(name.to_owned(), rules.rooms.iter().map(of_room).collect());
    Ok(())
}

/// Holds functions short that give no reason to be long.
fn hold_functions(root: &Path, source: &Source, faults: &mut Vec<String>) {
    for module in source.modules.values() {
        let file = module.file.strip_prefix(root).unwrap_or(&module.file).display();
        for function in module.functions.iter().filter(|f| f.lines > LONGEST_FUNCTION && !f.reason) {
            let (name, line, lines) = (&function.name, function.line, function.lines);
            let most = LONGEST_FUNCTION;
            faults.push(format!(
                "{file}:{line}: {name} has {lines} lines: cut it to {most}, or say above it why not (// Long: ..)"
            ));
        }
    }
}

/// Holds the lines of a file, or of all Rust files below a folder.
fn hold_lines(root: &Path, at: &Path, faults: &mut Vec<String>) -> anyhow::Result<()> {
    if at.is_dir() {
        let mut entries = Vec::new();
        for entry in std::fs::read_dir(at).with_context(|| format!("cannot read {}", at.display()))? {
            entries.push(entry?.path());
        }
        entries.sort();
        for entry in entries.iter().filter(|path| path.is_dir() || path.extension().is_some_and(|end| end == "rs")) {
            hold_lines(root, entry, faults)?;
        }
        return Ok(());
    }
    let text = std::fs::read_to_string(at).with_context(|| format!("cannot read {}", at.display()))?;
    for (k, line) in text.lines().enumerate() {
        let length = line.chars().count();
        if length > LONGEST_LINE {
            let file = at.strip_prefix(root).unwrap_or(at).display();
            faults.push(format!("{file}:{}: {length} characters, {LONGEST_LINE} at most", k + 1));
        }
    }
    Ok(())
}

/// The rooms of each crate from the top down, with what each uses; `^` marks what is above it.
pub fn table(findings: &Findings) -> String {
    let mut text = String::new();
    for (name, rooms) in &findings.arrows {
        let _ = writeln!(text, "{name}");
        for (room, uses) in rooms.iter().rev() {
            let uses: Vec<&str> = uses.iter().map(String::as_str).collect();
            let _ = writeln!(text, "  {room:32} {}", uses.join(" "));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(rules: &str, files: &[(&str, &str)]) -> Vec<String> {
        let folder = tempfile::tempdir().unwrap();
        for (path, text) in files {
            let path = folder.path().join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
        examine(folder.path(), &toml::from_str(rules).unwrap()).unwrap().faults
    }

    const FILES: [(&str, &str); 4] = [
        ("c/lib.rs", "mod film;\nmod engine;"),
        ("c/film.rs", "use crate::engine::stages::Stage;"),
        ("c/engine/mod.rs", "use crate::film::Film;\npub mod stages;"),
        ("c/engine/stages.rs", "use super::render;"),
    ];

    #[test]
    fn upward_arrows_are_found_and_excepted_only_while_they_are_there() {
        let rules = |more: &str| {
            let rooms = "['film', 'engine/stages', 'engine', 'crate']";
            format!("lines.held = []\n[crate.c]\nroot = 'c/lib.rs'\nrooms = {rooms}\n{more}")
        };
        assert_eq!(
            faults(&rules(""), &FILES),
            [
                "c/engine/stages.rs:1: engine/stages uses engine, which is above it: engine::render",
                "c/film.rs:1: film uses engine/stages, which is above it: engine::stages::Stage",
            ]
        );
        let exceptions = "exceptions = [{ from = 'film', to = 'engine/stages', why = 'x' }, \
                          { from = 'engine/stages', to = 'engine', why = 'y' }, \
                          { from = 'film', to = 'engine', why = 'z' }]";
        assert_eq!(
            faults(&rules(exceptions), &FILES),
            ["c: film uses engine no more: take the exception out of crates/xtask/layers.toml"]
        );
        let rules = "lines.held = []\n[crate.c]\nroot = 'c/lib.rs'\nrooms = ['film', 'other', 'crate']";
        assert_eq!(
            faults(rules, &FILES),
            [
                "c/engine/mod.rs lies in no room of c: give it a place in crates/xtask/layers.toml",
                "c/engine/stages.rs lies in no room of c: give it a place in crates/xtask/layers.toml",
                "c: there is no room other: take it out of crates/xtask/layers.toml",
            ]
        );
    }

    #[test]
    fn long_functions_and_lines_are_found() {
        let long = format!("fn f() {{{}}}", "\n".repeat(80));
        let reason = format!("// Long: a table.\nfn g() {{{}}}\n//{}", "\n".repeat(80), "é".repeat(119));
        let files = [("c/lib.rs", "mod a;\nmod b;"), ("c/a.rs", &*long), ("c/b.rs", &*reason)];
        let rules = "lines.held = ['c']\n[crate.c]\nroot = 'c/lib.rs'\nrooms = ['a', 'b', 'crate']\n";
        assert_eq!(
            faults(rules, &files),
            [
                "c/a.rs:1: f has 81 lines: cut it to 80, or say above it why not (// Long: ..)",
                "c/b.rs:83: 121 characters, 120 at most",
            ]
        );
    }
}
