//! The scenes of a folder, and the pictures that are expected of them.

use crate::settings::{FILE, Settings};
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

/// A scene and where its expected picture lies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// The path from the folder, without extension: `family/case`.
    pub name: String,
    /// The scene's file.
    pub scene: PathBuf,
    /// The expected picture, whether it is there or not: display values.
    pub png: PathBuf,
    /// Where its noise is kept ([`crate::stored`]), likewise.
    pub exr: PathBuf,
}

/// What is in a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Folder {
    /// In order of their names.
    pub cases: Vec<Case>,
    /// All pictures in it.
    pub pictures: Vec<PathBuf>,
}

/// Why a folder cannot be taken as one.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// It cannot be listed.
    #[error("cannot list {}", path.display())]
    Io {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Two scenes would have the same picture.
    #[error("{} and {} have one name, {name}: their pictures would lie in one place", a.display(), b.display())]
    Twice {
        /// The name.
        name: String,
        /// A scene.
        a: PathBuf,
        /// Another one.
        b: PathBuf,
    },
    /// There is none.
    #[error("there is no scene in {}; put some there, or name them in its {FILE}: scenes = [\"../room.ron\"]",
        .0.display())]
    Empty(PathBuf),
}

/// The extension in small letters.
fn extension(path: &Path) -> String {
    path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// A path from the folder without extension, with strokes on all systems.
fn name(folder: &Path, file: &Path) -> String {
    let relative = file.strip_prefix(folder).unwrap_or(file).with_extension("");
    relative.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
}

impl Folder {
    /// Looks through a folder. What is a scene, the caller says of files that are there.
    ///
    /// # Errors
    /// When it cannot be listed, has no scene, or has two of one name.
    pub fn find(folder: &Path, settings: &Settings, is_scene: &dyn Fn(&Path) -> bool) -> Result<Self, FolderError> {
        let mut files = Vec::new();
        let skipped: Vec<PathBuf> =
            settings.skip.iter().chain([&settings.made]).map(|path| folder.join(path)).collect();
        list(folder, &skipped, &mut files).map_err(|source| FolderError::Io { path: folder.to_owned(), source })?;
        let own = |file: &&PathBuf| !file.ends_with(FILE) && is_scene(file);
        let scenes: Vec<(String, PathBuf)> = if settings.scenes.is_empty() {
            files.iter().filter(own).map(|file| (name(folder, file), file.clone())).collect()
        } else {
            let stem = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            settings.scenes.iter().map(|path| (stem(path), folder.join(path))).collect()
        };
        let mut cases: BTreeMap<String, Case> = BTreeMap::new();
        for (name, scene) in scenes {
            if let Some(Case { scene: other, .. }) = cases.get(&name) {
                return Err(FolderError::Twice { name, a: other.clone(), b: scene });
            }
            let at = |extension: &str| folder.join(format!("{name}.{extension}"));
            cases.insert(name.clone(), Case { png: at("png"), exr: at("exr"), name, scene });
        }
        if cases.is_empty() {
            return Err(FolderError::Empty(folder.to_owned()));
        }
        files.retain(|file| matches!(extension(file).as_str(), "png" | "exr"));
        Ok(Folder { cases: cases.into_values().collect(), pictures: files })
    }

    /// Pictures that no scene of the folder makes and none reads.
    pub fn orphans(&self, read: &dyn Fn(&Path) -> bool) -> Vec<PathBuf> {
        let made = |file: &Path| self.cases.iter().any(|case| case.png == file || case.exr == file);
        self.pictures.iter().filter(|file| !made(file) && !read(file)).cloned().collect()
    }
}

/// All files below, in order of their names; hidden ones are left out, and links to folders, which may lead in a
/// circle.
fn list(folder: &Path, skipped: &[PathBuf], files: &mut Vec<PathBuf>) -> io::Result<()> {
    let mut paths = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<PathBuf>>>()?;
    paths.sort();
    for path in paths {
        let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if hidden || skipped.contains(&path) {
            continue;
        }
        if !path.is_dir() {
            files.push(path);
        } else if !path.is_symlink() {
            list(&path, skipped, files)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for file in files {
            let path = folder.path().join(file);
            std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
            std::fs::write(path, "").expect("a file");
        }
        folder
    }

    fn is_ron(path: &Path) -> bool {
        extension(path) == "ron"
    }

    #[test]
    fn scenes_and_pictures() {
        let files = [
            "golden.toml",
            "a/one.ron",
            "a/one.png",
            "two.ron",
            "three.png",
            "wood.png",
            "assets/t.png",
            ".golden/two.png",
        ];
        let at = folder(&files);
        let settings = Settings { skip: vec!["assets".into()], ..Settings::default() };
        let found = Folder::find(at.path(), &settings, &is_ron).expect("a folder");
        let names: Vec<&str> = found.cases.iter().map(|case| case.name.as_str()).collect();
        assert_eq!(names, ["a/one", "two"]);
        assert_eq!(found.cases[0].exr, at.path().join("a/one.exr"));
        assert_eq!(found.orphans(&|file| file.ends_with("wood.png")), [at.path().join("three.png")]);
    }

    #[test]
    fn scenes_elsewhere() {
        let at = folder(&["golden/golden.toml", "golden/inside.ron", "scenes/a.ron"]);
        let settings = Settings { scenes: vec!["../scenes/a.ron".into()], ..Settings::default() };
        let golden = at.path().join("golden");
        let found = Folder::find(&golden, &settings, &is_ron).expect("a folder");
        assert_eq!((found.cases.len(), found.cases[0].png.clone()), (1, golden.join("a.png")));
        assert_eq!(found.cases[0].scene, golden.join("../scenes/a.ron"));
    }

    #[test]
    fn what_is_no_folder() {
        let at = folder(&["a.ron"]);
        let both = Settings { scenes: vec!["a.ron".into(), "b/a.ron".into()], ..Settings::default() };
        assert!(matches!(Folder::find(at.path(), &both, &is_ron), Err(FolderError::Twice { .. })));
        let empty = folder(&["a.png"]);
        assert!(matches!(Folder::find(empty.path(), &Settings::default(), &is_ron), Err(FolderError::Empty(_))));
        let nowhere = empty.path().join("nowhere");
        assert!(matches!(Folder::find(&nowhere, &Settings::default(), &is_ron), Err(FolderError::Io { .. })));
    }
}
