//! Golden pictures: every `golden/<family>/<case>.ron` is rendered and compared with the `.png` beside it, byte for
//! byte.
//!
//! All of it is what `tracer golden run golden` does (`golden/golden.toml` has the settings), a test for each scene. A
//! missing picture fails, and so do a picture without a scene and a combination of material, shape and effect that no
//! scene shows. A failure keeps what was made and one page that shows it (`target/goldens/<family>/<case>/index.html`),
//! and prints the command that accepts the new picture.

#[path = "goldens/coverage.rs"]
mod coverage;

use libtest_mimic::{Arguments, Failed, Trial};
use std::path::Path;
use std::sync::Arc;
use tracer::commands::golden::{Opened, colours};
use tracer_core::Level;
use tracer_golden::folder::Case;
use tracer_golden::outcome::accept_command;
use tracer_golden::outputs::html;

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let golden = root.join("golden");
    let mut arguments = Arguments::from_args();
    // One picture at a time: each is rendered on all cores.
    arguments.test_threads = Some(1);
    let opened = Arc::new(Opened::open(&golden, "golden").unwrap_or_else(|failure| panic!("{failure:?}")));
    let mut trials = Vec::new();
    for case in opened.folder.cases.clone() {
        let opened = opened.clone();
        trials.push(Trial::test(case.name.clone(), move || compare(&opened, &case)));
    }
    let scenes: Vec<_> = opened.folder.cases.iter().map(|case| case.scene.clone()).collect();
    for file in strays(&golden, &opened) {
        trials.push(Trial::test(file.clone(), move || {
            Err(Failed::from(format!("golden/{file} belongs to no scene: remove it")))
        }));
    }
    trials.push(Trial::test("coverage", move || coverage::check_coverage(&scenes)));
    libtest_mimic::run(&arguments, trials).exit();
}

/// Files in the families' folders that are neither a scene nor a scene's picture.
fn strays(golden: &Path, opened: &Opened) -> Vec<String> {
    let entries = |folder: &Path| {
        let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("cannot read {}: {e}", folder.display()));
        entries.map(|entry| entry.expect("a readable folder").path()).collect::<Vec<_>>()
    };
    let cases = &opened.folder.cases;
    let families = entries(golden).into_iter().filter(|path| path.is_dir() && !path.ends_with("assets"));
    let files = families.flat_map(|family| entries(&family));
    let strays = files.filter(|file| !cases.iter().any(|case| case.scene == *file || case.png == *file));
    let mut names: Vec<String> =
        strays.map(|file| file.strip_prefix(golden).unwrap_or(&file).display().to_string()).collect();
    names.sort();
    names
}

fn compare(opened: &Opened, case: &Case) -> Result<(), Failed> {
    let examined = opened.examine(case, 0, Level::best()).map_err(|failure| format!("{failure:?}"))?;
    let examined = examined.ok_or("interrupted")?;
    let outcome = examined.outcome;
    if outcome.verdict.passes() {
        return Ok(());
    }
    let mut told = outcome.sentence();
    if let Some(made) = examined.kept {
        let page = made.path("index.html");
        let html = html::page(std::slice::from_ref(&outcome), &colours).map_err(|e| e.to_string())?;
        std::fs::write(&page, html).map_err(|e| format!("cannot write {}: {e}", page.display()))?;
        let command = accept_command("golden", &case.name).replacen("tracer", "cargo run -p tracer --", 1);
        told += &format!("\n  look at {}\n  accept it with: {command}", page.display());
    }
    Err(told.into())
}
