//! The program as one file that runs on every Linux: static, with musl, small; and the image of a container that holds
//! nothing else.
//!
//! No C compiler takes part: no dependency has C in it, and rustc brings the linker and the C library with it.

mod container;

pub use container::image;

use anyhow::{Context as _, ensure};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What it is built for.
pub const TARGET: &str = "x86_64-unknown-linux-musl";

/// It is smaller than that.
pub const MOST_BYTES: u64 = 16_000_000;

/// Where it is put, from the root of the repository; `Containerfile` takes it from there.
pub const PLACE: &str = "target/static/tracer";

/// At a fixed address it needs none of the half a million bytes that would tell what to correct when it is loaded
/// elsewhere.
const OF_ALL: &str = "-Crelocation-model=static";

/// Of functions with the same code one is kept, a hundredth of the file, and no symbol.
const OF_LINKING: [&str; 2] = ["-Clink-arg=--icf=all", "-Clink-arg=--strip-all"];

/// Golden scenes that every build renders: a lens, a mesh file, textures through a tone map.
const SOME: [&str; 3] = ["depth_of_field/blades", "mesh/gltf", "texture/instances_tone_map"];

/// Builds it (the profile `static`), and sees that it is static, small, and starts, that it makes the expected pictures
/// byte for byte, some or all, and that it says what it cannot do. Gives its place.
///
/// # Errors
/// When the target's library is missing and cannot be had; when it is not as it should be.
pub fn run(root: &Path, all_pictures: bool) -> anyhow::Result<PathBuf> {
    add_target(root)?;
    let build = ["rustc", "--profile", "static", "--locked", "--target", TARGET, "--package", "tracer"];
    let build = [&build[..], &["--bin", "tracer", "--"], &OF_LINKING].concat();
    println!("$ cargo {}", build.join(" "));
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut cargo = Command::new(cargo);
    // The first goes before RUSTFLAGS, which may ask for this machine's own processor.
    cargo.args(build).current_dir(root).env("CARGO_ENCODED_RUSTFLAGS", OF_ALL);
    cargo.env("CARGO_TARGET_X86_64_UNKNOWN_LINUX_MUSL_LINKER", "rust-lld");
    let status = cargo.status().context("cannot run cargo")?;
    ensure!(status.success(), "cargo build: {status}");
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let built = target.join(TARGET).join("static/tracer");
    check(&built)?;
    pictures(&built, root, all_pictures)?;
    refuses_libraries(&built)?;
    let place = root.join(PLACE);
    fs::create_dir_all(root.join("target/static"))?;
    fs::copy(&built, &place).with_context(|| format!("cannot write {}", place.display()))?;
    println!("{}: {} bytes, static", place.display(), fs::metadata(&place)?.len());
    Ok(place)
}

fn add_target(root: &Path) -> anyhow::Result<()> {
    let installed = || {
        let list = Command::new("rustup").args(["target", "list", "--installed"]).current_dir(root).output();
        list.is_ok_and(|list| String::from_utf8_lossy(&list.stdout).lines().any(|line| line == TARGET))
    };
    // A compiler without rustup may have it, too: cargo says where it does not.
    let rustup = Command::new("rustup").arg("--version").output();
    if rustup.is_ok_and(|rustup| rustup.status.success()) && !installed() {
        println!("$ rustup target add {TARGET}");
        let added = Command::new("rustup").args(["target", "add", TARGET]).current_dir(root).status();
        ensure!(
            added.is_ok_and(|status| status.success()) && installed(),
            "the library for {TARGET} is missing: rustup target add {TARGET}"
        );
    }
    Ok(())
}

/// Sees that a program needs nothing else, is no larger than it may be, and starts.
///
/// # Errors
/// What is not so.
pub fn check(program: &Path) -> anyhow::Result<()> {
    let shown = program.display();
    let bytes = fs::read(program).with_context(|| format!("cannot read {shown}"))?;
    let needs = needs(&bytes).with_context(|| format!("{shown} is no program for Linux on x86-64"))?;
    ensure!(needs.is_empty(), "{shown} is not static: it has {}", needs.join(" and "));
    ensure!((bytes.len() as u64) < MOST_BYTES, "{shown} has {} bytes, {MOST_BYTES} or more", bytes.len());
    // The same as the C library's own tool tells it, where that is there.
    if let Ok(ldd) = Command::new("ldd").arg(program).output() {
        let said = [ldd.stdout, ldd.stderr].concat();
        let said = String::from_utf8_lossy(&said);
        let is_static = said.contains("statically linked") || said.contains("not a dynamic executable");
        ensure!(is_static, "{shown} is not static; ldd says: {}", said.trim());
    }
    let version = Command::new(program).arg("--version").output().with_context(|| format!("cannot run {shown}"))?;
    let said = String::from_utf8_lossy(&version.stdout);
    ensure!(said.starts_with("tracer "), "{shown} --version says {said:?}");
    Ok(())
}

/// What of an ELF file has to be found or corrected when it is started: a loader, tables of libraries. `None` where
/// this is no program for x86-64.
fn needs(bytes: &[u8]) -> Option<Vec<&'static str>> {
    const LOADER: u32 = 3;
    const TABLES: u32 = 2;
    let number = |at: usize, size: usize| -> Option<u64> {
        let field = bytes.get(at..at.checked_add(size)?)?;
        Some(field.iter().rev().fold(0, |sum, &byte| sum << 8 | u64::from(byte)))
    };
    // 64 bits, little-endian, x86-64.
    if bytes.get(..6)? != b"\x7fELF\x02\x01" || number(18, 2)? != 62 {
        return None;
    }
    let (first, size, count) = (number(32, 8)?, number(54, 2)?, number(56, 2)?);
    let mut needs = Vec::new();
    for k in 0..count {
        let at = usize::try_from(first.checked_add(k * size)?).ok()?;
        match u32::try_from(number(at, 4)?).ok()? {
            LOADER => needs.push("a loader (PT_INTERP)"),
            TABLES => needs.push("tables of libraries (PT_DYNAMIC)"),
            _ => {}
        }
    }
    Some(needs)
}

/// Sees that it makes the expected pictures, byte for byte.
fn pictures(program: &Path, root: &Path, all: bool) -> anyhow::Result<()> {
    let mut run = Command::new(program);
    run.args(["golden", "run", "golden"]).current_dir(root);
    if !all {
        run.args(SOME.iter().flat_map(|name| ["--only", name]));
    }
    let status = run.status().with_context(|| format!("cannot run {}", program.display()))?;
    ensure!(status.success(), "{} makes other pictures", program.display());
    Ok(())
}

/// Sees that it says that it cannot load Open Image Denoise.
fn refuses_libraries(program: &Path) -> anyhow::Result<()> {
    let folder = tempfile::tempdir()?;
    let scene = folder.path().join("ball.ron");
    fs::write(&scene, "Scene(version: 1, background: 1, objects: [Sphere(center: (0, 0, -5), radius: 1)])")?;
    let words = ["--denoise=oidn", "--size=8x8", "--samples=1", "--quiet", "-o"];
    let ran =
        Command::new(program).arg("render").arg(scene).args(words).arg(folder.path().join("ball.png")).output()?;
    let said = String::from_utf8_lossy(&ran.stderr);
    ensure!(
        !ran.status.success() && said.contains("a static program cannot load libraries"),
        "{} render --denoise=oidn says {said:?}",
        program.display()
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A program that needs libraries, what is no program, and one that is not there, are told.
    #[test]
    fn what_is_not_static_is_told() {
        let told = |path: &Path| format!("{:#}", check(path).unwrap_err());
        // This test itself, where programs are such.
        if cfg!(all(target_os = "linux", target_env = "gnu", target_arch = "x86_64")) {
            let told = told(&std::env::current_exe().unwrap());
            assert!(
                told.ends_with("is not static: it has a loader (PT_INTERP) and tables of libraries (PT_DYNAMIC)"),
                "{told}"
            );
        }
        let text = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
        assert!(told(&text).ends_with("is no program for Linux on x86-64"), "{}", told(&text));
        assert!(told(Path::new("/no/such")).starts_with("cannot read /no/such"), "{}", told(Path::new("/no/such")));
    }

    /// A head that says more program headers than the file has is no program; one without such entries needs nothing.
    #[test]
    fn heads_are_read_to_their_end() {
        let mut bytes = vec![0; 64 + 2 * 56];
        bytes[..6].copy_from_slice(b"\x7fELF\x02\x01");
        (bytes[18], bytes[32], bytes[54], bytes[56]) = (62, 64, 56, 2);
        bytes[64] = 1;
        assert_eq!(needs(&bytes), Some(vec![]));
        bytes[64 + 56] = 3;
        assert_eq!(needs(&bytes), Some(vec!["a loader (PT_INTERP)"]));
        assert_eq!(needs(&bytes[..64 + 56]), None);
        bytes[18] = 183;
        assert_eq!(needs(&bytes), None);
    }

    /// Every build renders scenes that there are.
    #[test]
    fn the_scenes_of_every_build_are_there() {
        let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden");
        for name in SOME {
            assert!(golden.join(format!("{name}.ron")).is_file(), "{name}");
        }
    }
}
