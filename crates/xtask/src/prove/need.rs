//! What proofs need beside a compiler, and how it is got.

use anyhow::{Context as _, bail, ensure};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What has to be installed for a proof.
#[derive(Clone, Copy, Debug)]
pub enum Need {
    /// A program, and Debian's package of it.
    Program(&'static str, &'static str),
    /// A file, and Debian's package of it.
    File(&'static str, &'static str),
    /// A program that cargo installs: its name, its package, its version.
    Cargo(&'static str, &'static str, &'static str),
    /// Python packages, in an environment of their own (`target/prove/python`).
    Python(&'static [&'static str]),
    /// The nightly compiler with these components.
    Nightly(&'static [&'static str]),
}

impl Need {
    /// Sees to it that it is there.
    ///
    /// # Errors
    /// When it is missing and cannot be installed.
    pub fn meet(&self, root: &Path) -> anyhow::Result<()> {
        match *self {
            Need::Program(program, package) => {
                if find(program).is_none() {
                    install(program, package)?;
                }
            }
            Need::File(file, package) => {
                if !Path::new(file).exists() {
                    install(file, package)?;
                }
            }
            Need::Cargo(program, package, version) => {
                if find(program).is_none() {
                    done(Command::new("cargo").args([
                        "install",
                        package,
                        "--version",
                        version,
                        "--locked",
                        "--quiet",
                    ]))?;
                }
            }
            Need::Python(packages) => {
                let folder = environment(root);
                let python = folder.join("bin/python");
                if !python.exists() {
                    if find("python3").is_none() {
                        install("python3", "python3 python3-venv")?;
                    }
                    done(Command::new("python3").args(["-m", "venv"]).arg(&folder))?;
                }
                let pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
                done(Command::new(python).args(pip).args(packages))?;
            }
            Need::Nightly(components) => {
                ensure!(
                    find("rustup").is_some(),
                    "rustup is missing: the nightly compiler comes by it (https://rustup.rs)"
                );
                let of_components = components.iter().flat_map(|component| ["-c", component]);
                let nightly = ["toolchain", "install", "nightly", "--profile", "minimal", "--no-self-update"];
                done(Command::new("rustup").args(nightly).args(of_components))?;
            }
        }
        Ok(())
    }
}

/// Where a program lies.
fn find(program: &str) -> Option<PathBuf> {
    std::env::split_paths(&with_cargo_bin()).map(|folder| folder.join(program)).find(|file| file.is_file())
}

/// The folders of programs for a proof: those of its Python first, those that cargo has installed last.
pub fn path(root: &Path) -> OsString {
    let path = with_cargo_bin();
    let python = environment(root).join("bin");
    std::env::join_paths([python].into_iter().chain(std::env::split_paths(&path))).unwrap_or(path)
}

fn with_cargo_bin() -> OsString {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let home = |name: &str| std::env::var_os(name).map(PathBuf::from);
    let cargo = home("CARGO_HOME").or_else(|| Some(home("HOME")?.join(".cargo")));
    let folders = std::env::split_paths(&path).chain(cargo.map(|cargo| cargo.join("bin")));
    std::env::join_paths(folders).unwrap_or(path)
}

fn environment(root: &Path) -> PathBuf {
    root.join("target/prove/python")
}

/// Installs Debian packages, if this is Debian and we are root.
fn install(what: &str, packages: &str) -> anyhow::Result<()> {
    let is_root = Command::new("id").arg("-u").output().is_ok_and(|output| output.stdout.trim_ascii() == b"0");
    if find("apt-get").is_none() || !is_root {
        bail!("{what} is missing: install it (Debian: apt-get install {packages})");
    }
    let apt = || {
        let mut apt = Command::new("apt-get");
        apt.env("DEBIAN_FRONTEND", "noninteractive").stdout(Stdio::null());
        apt
    };
    done(apt().args(["update", "-qq"]))?;
    done(apt().args(["install", "-y", "-qq"]).args(packages.split(' ')))
}

/// Runs a command to its good end.
fn done(command: &mut Command) -> anyhow::Result<()> {
    let told = format!("{command:?}");
    let status = command.status().with_context(|| format!("cannot run {told}"))?;
    ensure!(status.success(), "{told}: {status}");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_there_is_met_and_what_is_not_is_named() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        Need::File("/", "none").meet(root).unwrap();
        assert!(find("sh").is_some() && find("no-such-program").is_none());
        let told = done(&mut Command::new("no-such-program")).unwrap_err().to_string();
        assert!(told.contains("no-such-program"), "{told}");
        let told = done(Command::new("sh").args(["-c", "exit 3"])).unwrap_err().to_string();
        assert!(told.contains('3'), "{told}");
    }
}
