//! The image of a container with the static program in it and nothing else, built and run by buildah: it needs no
//! daemon, and by `chroot` no more rights than those of root in a container itself.

use anyhow::{Context as _, bail, ensure};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The image is smaller than that, not compressed.
const MOST_BYTES: u64 = 20_000_000;

/// What is rendered in the container: it reads a mesh, its materials and a picture beside the scene.
const SCENE: &str = "golden/texture/instances_tone_map.ron";

/// Builds the image of `Containerfile` with the program that is there, sees that it is small, and renders in it: the
/// same bytes as outside. The image lies in a file then, for `docker load` and `podman load`. Gives its place.
///
/// # Errors
/// When buildah is missing, or the image is not as it should be.
pub fn image(root: &Path, program: &Path) -> anyhow::Result<PathBuf> {
    let store = tempfile::tempdir()?;
    let buildah = Buildah { root, store: store.path() };
    buildah.run(&["build", "--isolation", "chroot", "--tag", "tracer", "."])?;
    let archive = root.join("target/static/image.tar");
    if archive.exists() {
        fs::remove_file(&archive)?;
    }
    let to = format!("docker-archive:{}:tracer:latest", archive.display());
    buildah.run(&["push", "--quiet", "tracer", &to])?;
    let bytes = fs::metadata(&archive)?.len();
    ensure!(bytes < MOST_BYTES, "{} has {bytes} bytes, {MOST_BYTES} or more", archive.display());

    let container = buildah.run(&["from", "tracer"])?;
    let files = buildah.files(container.trim())?;
    ensure!(files == ["tracer"], "the image holds {files:?}, not the program alone");
    let pictures = tempfile::tempdir()?;
    let (repository, made) = (format!("{}:/work:ro", root.display()), format!("{}:/made", pictures.path().display()));
    // In the container: the repository is where one works, and pictures go elsewhere.
    let words = ["render", SCENE, "--quiet", "--no-metadata", "-o"];
    let volumes = ["--volume", &repository, "--volume", &made];
    let render = [&words[..], &["/made/inside.png"]].concat();
    buildah.run(
        &[&["run", "--isolation", "chroot"], &volumes[..], &[container.trim(), "--", "/tracer"], &render].concat(),
    )?;
    let outside = pictures.path().join("outside.png");
    let status = Command::new(program).args(words).arg(&outside).current_dir(root).status()?;
    ensure!(status.success(), "{} {words:?}: {status}", program.display());
    let inside = fs::read(pictures.path().join("inside.png")).context("the container has made no picture")?;
    ensure!(inside == fs::read(&outside)?, "the picture of {SCENE} is another one in the container");
    println!("{}: {bytes} bytes; {SCENE} has the same bytes in it as outside", archive.display());
    Ok(archive)
}

/// Its images and containers lie in a folder of their own, which goes with them.
struct Buildah<'a> {
    root: &'a Path,
    store: &'a Path,
}

impl Buildah<'_> {
    /// Runs a command to its good end; gives what it says.
    fn run(&self, words: &[&str]) -> anyhow::Result<String> {
        println!("$ buildah {}", words.join(" "));
        let mut buildah = Command::new("buildah");
        buildah.args(["--storage-driver", "vfs", "--root"]).arg(self.store.join("images"));
        buildah.arg("--runroot").arg(self.store.join("run"));
        let ran = match buildah.args(words).current_dir(self.root).output() {
            Ok(ran) => ran,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                bail!("buildah is missing, which builds and runs the image (Debian: apt-get install buildah)")
            }
            Err(error) => return Err(error).context("cannot run buildah"),
        };
        let said = String::from_utf8_lossy(&ran.stderr);
        ensure!(ran.status.success(), "buildah {}: {}\n{}", words.join(" "), ran.status, said.trim());
        Ok(String::from_utf8_lossy(&ran.stdout).into_owned())
    }

    /// The files of a container.
    fn files(&self, container: &str) -> anyhow::Result<Vec<String>> {
        let place = PathBuf::from(self.run(&["mount", container])?.trim());
        let mut files = Vec::new();
        let mut folders = vec![place.clone()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(&folder).with_context(|| format!("cannot list {}", folder.display()))? {
                let entry = entry?;
                match entry.file_type()?.is_dir() {
                    true => folders.push(entry.path()),
                    false => files.push(entry.path().strip_prefix(&place)?.display().to_string()),
                }
            }
        }
        self.run(&["umount", container])?;
        files.sort();
        Ok(files)
    }
}
