//! Seeds the faults one at a time in a copy of the tree and runs the tests that must notice.

use super::{Mutant, Program, Tests, all};
use anyhow::{Context as _, bail, ensure};
use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// What to seed, and how long to wait.
#[derive(Clone, Debug)]
pub struct Options {
    /// Faults by name; all when empty.
    pub names: Vec<String>,
    /// Seconds that the tests of one fault may run: a fault that makes them run longer is noticed, too.
    pub limit: u64,
}

/// Seeds the faults and prints a line for each as it is known.
///
/// # Errors
/// When a name is unknown, the tests fail without any fault, a fault does not compile, or one is not noticed.
pub fn run(root: &Path, options: &Options) -> anyhow::Result<()> {
    let chosen = choose(&options.names)?;
    let copy = Copy::of(root)?;
    let limit = Duration::from_secs(options.limit);
    println!("{} faults; first the tests without any", chosen.len());
    for (program, filters) in programs(&chosen) {
        let tests = copy.build(program)?.context("the tests do not compile without any fault")?;
        // Many tests at once: they may take their time.
        match copy.test(program, &tests, &filters, 10 * limit)? {
            Outcome::Passed => {}
            outcome => bail!("the tests of {} fail without any fault: {outcome:?}", name_of(program)),
        }
    }
    println!("| fault | noticed by | seconds |\n|---|---|---:|");
    let mut unnoticed = Vec::new();
    for mutant in &chosen {
        let start = Instant::now();
        let outcome = copy.try_mutant(mutant, limit).with_context(|| mutant.name)?;
        let noticed = match outcome {
            Outcome::Failed(tests) => tests.join(", "),
            Outcome::TooSlow => format!("no end within {} s", options.limit),
            Outcome::Passed => {
                unnoticed.push(mutant.name);
                "**nothing**".to_owned()
            }
        };
        println!("| {} | {noticed} | {:.0} |", mutant.name, start.elapsed().as_secs_f64());
        std::io::stdout().flush()?;
    }
    ensure!(unnoticed.is_empty(), "not noticed: {}", unnoticed.join(", "));
    println!("all {} faults are noticed", chosen.len());
    Ok(())
}

fn choose(names: &[String]) -> anyhow::Result<Vec<&'static Mutant>> {
    if names.is_empty() {
        return Ok(all().collect());
    }
    names
        .iter()
        .map(|name| all().find(|m| m.name == name).with_context(|| format!("there is no fault named {name:?}")))
        .collect()
}

/// The test programs of these faults, each with all filters: `None` stands for all of its tests.
fn programs(mutants: &[&Mutant]) -> BTreeMap<Program, Vec<&'static str>> {
    let mut programs: BTreeMap<Program, Option<Vec<&'static str>>> = BTreeMap::new();
    for Tests { program, filters } in mutants.iter().map(|m| m.caught_by) {
        let entry = programs.entry(program).or_insert_with(|| Some(Vec::new()));
        match entry {
            Some(all) if !filters.is_empty() => all.extend(filters),
            _ => *entry = None,
        }
    }
    programs.into_iter().map(|(program, filters)| (program, filters.unwrap_or_default())).collect()
}

fn name_of(Program { package, name, .. }: Program) -> String {
    format!("{package}, {}", name.unwrap_or("the unit tests"))
}

/// What came of tests.
#[derive(Debug)]
enum Outcome {
    Passed,
    /// The names of those that failed.
    Failed(Vec<String>),
    TooSlow,
}

/// Where the engine's stages are compiled per CPU level.
const KERNELS: &str = "crates/kernels/src/engine/kernels.rs";

#[cfg(target_arch = "x86_64")]
fn has_avx2() -> bool {
    // What `tracer_core`'s levels ask for.
    is_x86_feature_detected!("avx2")
        && is_x86_feature_detected!("fma")
        && is_x86_feature_detected!("bmi1")
        && is_x86_feature_detected!("bmi2")
        && is_x86_feature_detected!("lzcnt")
        && is_x86_feature_detected!("popcnt")
}

#[cfg(not(target_arch = "x86_64"))]
fn has_avx2() -> bool {
    false
}

/// The source of the entry functions with every level running those of AVX2.
fn slimmed(text: &str) -> anyhow::Result<String> {
    let mut slim = text.to_owned();
    for other in ["portable", "scalar_fma", "avx512"] {
        let find = format!("=> {other}::kernels(level),");
        ensure!(slim.matches(&find).count() == 1, "{find:?} does not occur once in {KERNELS}");
        slim = slim.replace(&find, "=> avx2::kernels(level),");
    }
    // The other entry functions are now unused, which is no fault here.
    Ok(format!("#![allow(dead_code)]\n{slim}"))
}

/// A copy of the repository, with its own build folder that is kept between runs.
struct Copy {
    tree: PathBuf,
    build: PathBuf,
}

impl Copy {
    fn of(root: &Path) -> anyhow::Result<Self> {
        let root = root.canonicalize().context("the repository")?;
        let place = root.join("target/mutants");
        let copy = Copy { tree: place.join("tree"), build: place.join("build") };
        mirror(&root, &copy.tree, &|path| [root.join("target"), root.join(".git")].iter().any(|p| p == path))?;
        copy.slim()?;
        Ok(copy)
    }

    /// Compiles the engine's stages for one lane type instead of four: most of the time goes into them, and all make
    /// the same bytes, which `same_bytes` proves. Where the CPU lacks it, all four stay.
    fn slim(&self) -> anyhow::Result<()> {
        if !has_avx2() {
            return Ok(());
        }
        let path = self.tree.join(KERNELS);
        let text = std::fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
        std::fs::write(&path, slimmed(&text)?).with_context(|| format!("cannot write {}", path.display()))
    }

    /// Builds a test program; `None` where it does not compile.
    fn build(&self, program: Program) -> anyhow::Result<Option<PathBuf>> {
        let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.current_dir(&self.tree).env("CARGO_TARGET_DIR", &self.build).env("CARGO_INCREMENTAL", "1");
        // Debug information takes time, and nobody looks at it.
        cargo.args(["--config", "profile.dev.package.tracer-core.debug=0"]);
        cargo.args(["test", "--quiet", "--locked", "--no-run", "--message-format=json", "-p", program.package]);
        match program.name {
            Some(name) => cargo.args(["--test", name]),
            None => cargo.arg("--lib"),
        };
        let output = cargo.stderr(Stdio::inherit()).output().context("cannot run cargo")?;
        if !output.status.success() {
            return Ok(None);
        }
        // One message a line; the last with an executable is the test program.
        let messages = String::from_utf8_lossy(&output.stdout);
        let found = messages.lines().rev().find_map(|line| line.split_once("\"executable\":\"")?.1.split('"').next());
        let executable = found.context("cargo names no test program")?;
        Ok(Some(PathBuf::from(executable)))
    }

    /// Runs the tests whose names contain one of the filters.
    fn test(&self, of: Program, program: &Path, filters: &[&str], limit: Duration) -> anyhow::Result<Outcome> {
        // To a file: nobody reads a pipe before the end.
        let log = self.build.join("tests.log");
        let file = std::fs::File::create(&log).with_context(|| format!("cannot write {}", log.display()))?;
        let mut child = Command::new(program)
            .args(filters)
            .arg("--include-ignored")
            .current_dir(self.tree.join("crates").join(of.folder))
            .stdout(file)
            .stderr(Stdio::null())
            .spawn()
            .with_context(|| format!("cannot run {}", program.display()))?;
        let start = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait()? {
                break status;
            }
            if start.elapsed() > limit {
                child.kill()?;
                child.wait()?;
                return Ok(Outcome::TooSlow);
            }
            std::thread::sleep(Duration::from_millis(20));
        };
        let text = std::fs::read_to_string(&log)?;
        if status.success() {
            ensure!(!text.contains("ok. 0 passed"), "no test of {} matches {filters:?}", program.display());
            return Ok(Outcome::Passed);
        }
        let failed = text.lines().filter_map(|line| line.strip_prefix("test ")?.strip_suffix(" ... FAILED"));
        let mut failed: Vec<String> = failed.map(str::to_owned).collect();
        if failed.is_empty() {
            // Overflow of the stack, or a process killed.
            failed.push(status.to_string());
        }
        failed.sort();
        Ok(Outcome::Failed(failed))
    }

    fn try_mutant(&self, mutant: &Mutant, limit: Duration) -> anyhow::Result<Outcome> {
        let path = self.tree.join(mutant.file);
        let right = std::fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
        let wrong = mutant.apply(&right).map_err(anyhow::Error::msg)?;
        std::fs::write(&path, wrong)?;
        let built = self.build(mutant.caught_by.program);
        let outcome = match &built {
            Ok(Some(program)) => self.test(mutant.caught_by.program, program, mutant.caught_by.filters, limit),
            Ok(None) => Err(anyhow::anyhow!("does not compile")),
            Err(_) => Ok(Outcome::Passed),
        };
        std::fs::write(&path, right)?;
        built?;
        outcome
    }
}

/// Makes `to` hold what `from` holds; files that are the same already keep their times, so that little is built anew.
fn mirror(from: &Path, to: &Path, skip: &dyn Fn(&Path) -> bool) -> anyhow::Result<()> {
    std::fs::create_dir_all(to).with_context(|| format!("cannot make {}", to.display()))?;
    let mut kept = Vec::new();
    for entry in std::fs::read_dir(from).with_context(|| format!("cannot read {}", from.display()))? {
        let entry = entry?;
        let (source, name) = (entry.path(), entry.file_name());
        if skip(&source) {
            continue;
        }
        let target = to.join(&name);
        kept.push(name);
        if entry.file_type()?.is_dir() {
            mirror(&source, &target, skip)?;
        } else {
            let bytes = std::fs::read(&source).with_context(|| format!("cannot read {}", source.display()))?;
            if std::fs::read(&target).ok().as_ref() != Some(&bytes) {
                std::fs::write(&target, bytes).with_context(|| format!("cannot write {}", target.display()))?;
            }
        }
    }
    for entry in std::fs::read_dir(to)? {
        let entry = entry?;
        if !kept.contains(&entry.file_name()) {
            let path = entry.path();
            if entry.file_type()?.is_dir() { std::fs::remove_dir_all(&path) } else { std::fs::remove_file(&path) }
                .with_context(|| format!("cannot remove {}", path.display()))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_holds_what_the_original_does_and_no_more() {
        let folder = std::env::temp_dir().join(format!("xtask-mirror-{}", std::process::id()));
        let (from, to) = (folder.join("from"), folder.join("to"));
        for (path, text) in [("a.txt", "1"), ("b/c.txt", "2"), ("target/d.txt", "3")] {
            let path = from.join(path);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
            std::fs::write(path, text).expect("written");
        }
        std::fs::create_dir_all(to.join("old")).expect("made");
        std::fs::write(to.join("stray.txt"), "4").expect("written");
        mirror(&from, &to, &|path| path == from.join("target")).expect("mirrored");
        assert_eq!(std::fs::read_to_string(to.join("b/c.txt")).expect("there"), "2");
        assert!(to.join("a.txt").exists());
        assert!(!to.join("old").exists() && !to.join("stray.txt").exists() && !to.join("target").exists());
        std::fs::remove_dir_all(folder).expect("removed");
    }

    #[test]
    fn the_stages_can_be_compiled_for_one_lane_type() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let text = std::fs::read_to_string(root.join(KERNELS)).expect("the entry functions");
        assert_eq!(slimmed(&text).expect("slimmed").matches("avx2::kernels(level),").count(), 4);
    }

    #[test]
    fn faults_are_chosen_by_name() {
        assert_eq!(choose(&[]).expect("all").len(), all().count());
        assert_eq!(choose(&["cosine-twice".to_owned()]).expect("one")[0].name, "cosine-twice");
        assert!(choose(&["cosine".to_owned()]).is_err());
    }
}
