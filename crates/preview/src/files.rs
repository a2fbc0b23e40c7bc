//! The files of a scene, and what tells that one has changed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// What tells that a file is another than before; `None`: there is none.
pub type Stamp = Option<(SystemTime, u64, u64)>;

/// The stamp of a file now.
pub fn stamp(path: &Path) -> Stamp {
    let found = fs::metadata(path).ok()?;
    #[cfg(unix)]
    let number = std::os::unix::fs::MetadataExt::ino(&found);
    #[cfg(not(unix))]
    let number = 0;
    Some((found.modified().unwrap_or(SystemTime::UNIX_EPOCH), found.len(), number))
}

/// The files that are watched, and their stamps as they were read.
pub struct Watched {
    pub scene: PathBuf,
    files: BTreeMap<PathBuf, Stamp>,
    /// What counts beside them.
    news: News,
    /// What was in the scene's own file.
    text: Option<Fingerprint>,
}

/// What counts beside the files that are known: one that nobody knows the name of may be missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum News {
    /// Nothing.
    None,
    /// Pictures: the materials of a mesh's file name some that are not there, or cannot be read.
    Pictures,
    /// Whatever comes into the folders may mend the scene.
    Anything,
}

/// A number for what is in a file.
pub type Fingerprint = u64;

/// The number of these contents.
pub fn fingerprint(bytes: &[u8]) -> Fingerprint {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    hasher.finish()
}

/// `None` of what is no file, too: a pipe would be waited for.
fn contents(path: &Path) -> Option<Fingerprint> {
    fs::metadata(path).ok().filter(fs::Metadata::is_file)?;
    Some(fingerprint(&fs::read(path).ok()?))
}

impl Watched {
    pub fn new(scene: &Path) -> Self {
        Watched {
            scene: scene.to_owned(),
            files: BTreeMap::from([(scene.to_owned(), stamp(scene))]),
            news: News::None,
            text: contents(scene),
        }
    }

    /// Before files are read: looks at those that are known, and at what is new of these.
    pub fn before_reading(&mut self, came: &[PathBuf]) {
        let new: Vec<PathBuf> = came.iter().filter(|path| self.is_news(path)).cloned().collect();
        self.files.extend(new.into_iter().map(|path| (path, None)));
        for (path, known) in &mut self.files {
            *known = stamp(path);
        }
        self.text = contents(&self.scene);
    }

    /// Whether something has happened that asks for another look at the scene; `came`: what the system told of.
    pub fn counts(&self, came: &[PathBuf]) -> bool {
        self.has_changed() || came.iter().any(|path| self.is_news(path))
    }

    fn is_news(&self, path: &Path) -> bool {
        const PICTURES: [&str; 5] = ["png", "jpg", "jpeg", "exr", "hdr"];
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        match self.news {
            News::None => false,
            News::Pictures => PICTURES.contains(&extension.as_str()) && !self.files.contains_key(path),
            News::Anything => true,
        }
    }

    /// Whether the scene was saved as it was, and no other file has changed: a picture that takes long need not begin
    /// anew.
    pub fn is_only_touched(&self) -> bool {
        let others = self.files.iter().all(|(path, known)| *path == self.scene || stamp(path) == *known);
        others && self.news == News::None && self.text.is_some() && self.text == contents(&self.scene)
    }

    /// After that: what the scene uses now. A file that is new here and was written since `began` may have been read
    /// before that.
    pub fn after_reading(&mut self, files: impl IntoIterator<Item = PathBuf>, began: SystemTime, news: News) {
        self.news = news;
        let mut known = std::mem::take(&mut self.files);
        let fresh = |path: &Path| stamp(path).filter(|(written, ..)| *written < began);
        let scene = self.scene.clone();
        self.files = std::iter::once(scene)
            .chain(files)
            .map(|path| {
                let stamp = known.remove(&path).unwrap_or_else(|| fresh(&path));
                (path, stamp)
            })
            .collect();
    }

    /// The stamps of all files but the scene's own, for whoever asks whether the same ones were read.
    pub fn stamps(&self) -> BTreeMap<PathBuf, Stamp> {
        let others = self.files.iter().filter(|(path, _)| **path != self.scene);
        others.map(|(path, stamp)| (path.clone(), *stamp)).collect()
    }

    fn has_changed(&self) -> bool {
        self.files.iter().any(|(path, known)| stamp(path) != *known)
    }

    /// The stamps as they are now.
    pub fn now(&self) -> Vec<Stamp> {
        self.files.keys().map(|path| stamp(path)).collect()
    }

    /// Folders of the files, and of what links lead to.
    pub fn folders(&self) -> BTreeSet<PathBuf> {
        let mut folders = BTreeSet::new();
        for path in self.files.keys() {
            for path in [Some(path.clone()), path.canonicalize().ok()].into_iter().flatten() {
                let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
                if folder.is_dir() {
                    folders.insert(folder.to_owned());
                }
            }
        }
        folders
    }
}
