//! The program as one file that runs on every Linux: static, with musl, small.

use anyhow::{Context as _, bail, ensure};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What it is built for.
pub const TARGET: &str = "x86_64-unknown-linux-musl";

/// It is no larger than that.
pub const MOST_BYTES: u64 = 16_000_000;

/// Builds it (the profile `static`), and sees that it is static, small, and starts. Gives its place.
///
/// # Errors
/// When the target's library is missing and cannot be had; when it is not as it should be.
pub fn run(root: &Path) -> anyhow::Result<PathBuf> {
    let installed = || {
        let list = Command::new("rustup").args(["target", "list", "--installed"]).current_dir(root).output();
        list.is_ok_and(|list| String::from_utf8_lossy(&list.stdout).lines().any(|line| line == TARGET))
    };
    if !installed() {
        println!("$ rustup target add {TARGET}");
        let added = Command::new("rustup").args(["target", "add", TARGET]).current_dir(root).status();
        ensure!(
            added.is_ok_and(|status| status.success()) && installed(),
            "the library for {TARGET} is missing: rustup target add {TARGET}"
        );
    }
    let build = ["build", "--profile", "static", "--locked", "--target", TARGET, "-p", "tracer"];
    println!("$ cargo {}", build.join(" "));
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo).args(build).current_dir(root).status().context("cannot run cargo")?;
    ensure!(status.success(), "cargo build: {status}");
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let built = target.join(TARGET).join("static/tracer");
    check(&built)?;
    let place = root.join("target/static/tracer");
    fs::create_dir_all(root.join("target/static"))?;
    fs::copy(&built, &place).with_context(|| format!("cannot write {}", place.display()))?;
    println!("{}, {} bytes, static", place.display(), fs::metadata(&place)?.len());
    Ok(place)
}

/// Sees that a program is static by what `ldd` says, no larger than it may be, and starts.
///
/// # Errors
/// What is not so.
pub fn check(program: &Path) -> anyhow::Result<()> {
    let shown = program.display();
    let bytes = fs::metadata(program).with_context(|| format!("there is no {shown}"))?.len();
    ensure!(bytes <= MOST_BYTES, "{shown} has {bytes} bytes, more than {MOST_BYTES}");
    let ldd = Command::new("ldd").arg(program).output().context("cannot run ldd")?;
    let said = [ldd.stdout, ldd.stderr].concat();
    let said = String::from_utf8_lossy(&said);
    if !said.contains("statically linked") && !said.contains("not a dynamic executable") {
        bail!("{shown} is not static; ldd says: {}", said.trim());
    }
    let version = Command::new(program).arg("--version").output().with_context(|| format!("cannot run {shown}"))?;
    ensure!(
        version.stdout.starts_with(b"tracer "),
        "{shown} --version says {:?}",
        String::from_utf8_lossy(&version.stdout)
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A program that needs libraries, and one that is not there, are told.
    #[test]
    fn what_is_not_static_is_told() {
        let told = check(Path::new("/bin/sh")).unwrap_err().to_string();
        assert!(told.contains("is not static"), "{told}");
        let told = check(Path::new("/no/such")).unwrap_err().to_string();
        assert!(told.contains("there is no /no/such"), "{told}");
    }
}
