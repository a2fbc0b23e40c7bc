//! Faults seeded on purpose: each is one exact change of the source, and tests other than the goldens must notice it.
//!
//! A list of plausible slips, not of random ones: what a person gets wrong in a path tracer. One that no test notices
//! is a missing test. `cargo xtask mutants` seeds them one at a time in a copy of the repository.

mod adaptive;
mod curved;
mod engine;
mod environment;
mod files;
mod layers;
mod photons;
mod run;
mod sampling;
mod scene;

pub use run::{Options, run};

/// A fault.
#[derive(Clone, Copy, Debug)]
pub struct Mutant {
    /// Says what is wrong.
    pub name: &'static str,
    /// From the root of the repository.
    pub file: &'static str,
    /// Occurs once in the file.
    pub find: &'static str,
    /// What stands there instead.
    pub replace: &'static str,
    /// The tests of which at least one must fail.
    pub caught_by: Tests,
}

/// A test program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Program {
    /// The folder of its crate below `crates`.
    pub folder: &'static str,
    /// The name of the package.
    pub package: &'static str,
    /// `None`: the crate's unit tests; else a program in its `tests`.
    pub name: Option<&'static str>,
}

impl Program {
    const fn of_core(name: Option<&'static str>) -> Program {
        Program { folder: "tracer-core", package: "tracer-core", name }
    }

    const fn of_kernels(name: Option<&'static str>) -> Program {
        Program { folder: "kernels", package: "tracer-kernels", name }
    }

    const fn of_mesh(name: Option<&'static str>) -> Program {
        Program { folder: "mesh", package: "tracer-mesh", name }
    }
}

/// Tests of one test program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Tests {
    /// The program.
    pub program: Program,
    /// What the names of the tests contain; all of the program's when empty.
    pub filters: &'static [&'static str],
}

/// Unit tests of `tracer-core`.
const fn units(filters: &'static [&'static str]) -> Tests {
    Tests { program: Program::of_core(None), filters }
}

/// Tests of `tests/proofs`.
const fn proofs(filters: &'static [&'static str]) -> Tests {
    suite("proofs", filters)
}

/// Tests of another program in `tests` of `tracer-core`.
const fn suite(program: &'static str, filters: &'static [&'static str]) -> Tests {
    Tests { program: Program::of_core(Some(program)), filters }
}

/// Unit tests of `tracer-kernels`.
const fn kernel_units(filters: &'static [&'static str]) -> Tests {
    Tests { program: Program::of_kernels(None), filters }
}

/// Unit tests of `tracer-mesh`.
const fn mesh_units(filters: &'static [&'static str]) -> Tests {
    Tests { program: Program::of_mesh(None), filters }
}

/// Tests of a program in `tests` of `tracer-mesh`.
const fn mesh_suite(program: &'static str, filters: &'static [&'static str]) -> Tests {
    Tests { program: Program::of_mesh(Some(program)), filters }
}

/// All faults.
pub fn all() -> impl Iterator<Item = &'static Mutant> {
    let rooms = [
        curved::MUTANTS,
        engine::MUTANTS,
        photons::MUTANTS,
        sampling::MUTANTS,
        scene::MUTANTS,
        files::MUTANTS,
        layers::MUTANTS,
    ];
    rooms.into_iter().chain([environment::MUTANTS, adaptive::MUTANTS]).flatten()
}

impl Mutant {
    /// The text of the file with the fault in it.
    ///
    /// # Errors
    /// What is to be replaced does not occur exactly once, or the replacement is no change.
    pub fn apply(&self, text: &str) -> Result<String, String> {
        let count = text.matches(self.find).count();
        if count != 1 {
            return Err(format!("{}: {:?} occurs {count} times in {}", self.name, self.find, self.file));
        }
        if self.find == self.replace {
            return Err(format!("{}: changes nothing", self.name));
        }
        Ok(text.replacen(self.find, self.replace, 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::path::Path;

    /// The list keeps up with the source: a patch that no longer applies is rewritten, not dropped.
    #[test]
    fn every_fault_applies_to_the_source() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let faults: Vec<String> = all()
            .filter_map(|mutant| {
                let text = std::fs::read_to_string(root.join(mutant.file)).map_err(|e| format!("{}: {e}", mutant.file));
                text.and_then(|text| mutant.apply(&text)).err()
            })
            .collect();
        assert!(faults.is_empty(), "{}", faults.join("\n"));
    }

    #[test]
    fn names_are_their_own_and_there_are_enough() {
        let names: BTreeSet<&str> = all().map(|m| m.name).collect();
        assert_eq!(names.len(), all().count());
        assert!(names.len() >= 45, "{}", names.len());
    }

    #[test]
    fn goldens_are_not_among_the_tests() {
        assert!(all().all(|m| m.caught_by.program.name != Some("goldens")));
    }
}
