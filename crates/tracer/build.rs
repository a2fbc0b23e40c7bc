//! Which commit a release is built of, for `tracer --version`. It is no part of pictures and reports: these depend on
//! what the program does.

use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // Others are built at each commit anew, for nobody who would ask.
    if std::env::var("PROFILE").as_deref() != Ok("release") {
        return;
    }
    // In a package, or without git, the version has to do.
    let Some(folder) = git(&["rev-parse", "--absolute-git-dir"]) else { return };
    let Some(commit) = git(&["log", "-1", "--format=%h %cs", "--abbrev=10"]) else { return };
    // The first changes with a checkout, the second with a commit.
    for file in ["HEAD", "logs/HEAD"].map(|name| Path::new(&folder).join(name)) {
        if file.exists() {
            println!("cargo::rerun-if-changed={}", file.display());
        }
    }
    let version = std::env::var("CARGO_PKG_VERSION").unwrap_or_default();
    println!("cargo::rustc-env=TRACER_COMMIT={version} ({commit})");
}

/// The line that git answers with, of a clone of tracer: a package that lies in another one's is none.
fn git(arguments: &[&str]) -> Option<String> {
    let inside = Path::new("../../Cargo.toml").exists() && Path::new("../../crates/tracer/build.rs").exists();
    let output =
        Command::new("git").args(arguments).output().ok().filter(|output| inside && output.status.success())?;
    let line = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    Some(line).filter(|line| !line.is_empty())
}
