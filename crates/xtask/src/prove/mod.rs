//! The long proofs: what takes longer than the README's test command may, or needs more than a compiler.
//!
//! Each is a line of [`PROOFS`]: its name, whether CI runs it, what it needs, and its commands. What it needs is
//! installed on Debian by root; anywhere else the proof says what is missing.

mod need;
mod table;

use anyhow::{Context as _, ensure};
pub use need::Need;
use std::path::Path;
use std::process::Command;
use std::time::Instant;
pub use table::{MDBOOK, PROOFS};

/// A long proof.
#[derive(Clone, Copy, Debug)]
pub struct Proof {
    /// Its name on the command line.
    pub name: &'static str,
    /// Whether CI runs it.
    pub when: When,
    /// What it proves, and about how long it takes on two free cores.
    pub what: &'static str,
    /// What has to be installed.
    pub needs: &'static [Need],
    /// Its commands for a shell in the root of the repository, one after the other; `python` has the packages that it
    /// needs.
    pub commands: &'static [&'static str],
}

/// Who runs a proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// CI, and `cargo xtask prove` without names: twenty minutes together.
    Always,
    /// Whoever has touched what it proves, by its name.
    Asked,
}

/// The proofs of these names; those of CI where there are none.
///
/// # Errors
/// When there is none of a name.
pub fn chosen(names: &[String], all: bool) -> anyhow::Result<Vec<&'static Proof>> {
    if names.is_empty() {
        return Ok(PROOFS.iter().filter(|proof| all || proof.when == When::Always).collect());
    }
    let by_name = |name: &String| {
        let found = PROOFS.iter().find(|proof| proof.name == name);
        found.with_context(|| format!("there is no proof {name}; `cargo xtask prove --list` lists them"))
    };
    names.iter().map(by_name).collect()
}

/// Runs proofs one after the other. All are run, also where one has failed.
///
/// # Errors
/// Which have failed.
pub fn run(root: &Path, proofs: &[&Proof]) -> anyhow::Result<()> {
    let mut failed = Vec::new();
    for proof in proofs {
        println!("== {}: {}", proof.name, proof.what);
        let start = Instant::now();
        let outcome = prove(root, proof);
        println!("== {}: {:.0} s", proof.name, start.elapsed().as_secs_f64());
        if let Err(fault) = outcome {
            println!("{fault:#}");
            failed.push(proof.name);
        }
    }
    ensure!(failed.is_empty(), "failed: {}", failed.join(", "));
    Ok(())
}

fn prove(root: &Path, proof: &Proof) -> anyhow::Result<()> {
    for need in proof.needs {
        need.meet(root)?;
    }
    for text in proof.commands {
        println!("$ {text}");
        let status = command(root, text).status().with_context(|| format!("cannot run {text}"))?;
        ensure!(status.success(), "{text}: {status}");
    }
    Ok(())
}

/// A command as it stands in the table.
fn command(root: &Path, text: &str) -> Command {
    let mut command = Command::new("sh");
    command.args(["-c", text]).current_dir(root).env("PATH", need::path(root));
    command
}

/// The proofs, a line each.
pub fn list() -> String {
    let line = |proof: &Proof| {
        let when = if proof.when == When::Always { "CI" } else { "  " };
        format!("{:20} {when}  {}\n", proof.name, proof.what)
    };
    PROOFS.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn proofs_have_names_of_their_own_and_commands() {
        let names: BTreeSet<&str> = PROOFS.iter().map(|proof| proof.name).collect();
        assert_eq!(names.len(), PROOFS.len());
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        for proof in PROOFS {
            assert!(!proof.commands.is_empty() && proof.what.len() < 200, "{}", proof.name);
            for text in proof.commands {
                // A proof that runs a test program names one that there is.
                let words: Vec<&str> = text.split_whitespace().collect();
                for pair in words.windows(2).filter(|pair| pair[0] == "--test") {
                    assert!(has_test(&root, pair[1]), "{}: there is no test {}", proof.name, pair[1]);
                }
            }
        }
    }

    fn has_test(root: &Path, name: &str) -> bool {
        let crates = std::fs::read_dir(root.join("crates")).unwrap();
        name == "goldens"
            || crates.flatten().any(|of_crate| {
                let tests = of_crate.path().join("tests");
                tests.join(format!("{name}.rs")).is_file() || tests.join(name).join("main.rs").is_file()
            })
    }

    #[test]
    fn a_proof_fails_where_a_command_does() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let of = |commands| Proof { name: "p", when: When::Asked, what: "", needs: &[], commands };
        let (good, bad) = (of(&["A='b c'; test \"$A\" = 'b c'", "cd src && test -f lib.rs"]), of(&["true", "exit 3"]));
        run(root, &[&good]).unwrap();
        assert_eq!(run(root, &[&bad, &good]).unwrap_err().to_string(), "failed: p");
    }

    #[test]
    fn proofs_are_chosen_by_name() {
        let names = |names: &[&str], all| -> Vec<&str> {
            let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
            chosen(&names, all).unwrap().iter().map(|proof| proof.name).collect()
        };
        assert_eq!(names(&["mutants", "truth"], false), ["mutants", "truth"]);
        assert!(names(&[], false).len() < names(&[], true).len());
        assert_eq!(names(&[], true).len(), PROOFS.len());
        let fault = chosen(&["no-such".to_owned()], false).unwrap_err().to_string();
        assert!(fault.contains("no-such") && fault.contains("--list"), "{fault}");
    }

    /// What CONTRIBUTING.md tells of them is what there is.
    #[test]
    fn the_table_of_the_document_is_this_one() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../CONTRIBUTING.md");
        let text = std::fs::read_to_string(path).unwrap();
        for proof in PROOFS {
            let row = format!("| `{}` | {} |", proof.name, proof.what);
            assert!(text.contains(&row), "CONTRIBUTING.md lacks the row\n{row}");
        }
    }
}
