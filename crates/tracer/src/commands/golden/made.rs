//! Pictures that were made and are not accepted: kept where the settings say, each in a folder of its name.

use crate::failure::Failure;
use crate::write::{Bits, Encoding, Provenance, Setting, WriteError, encode, is_one_file, save};
use serde::{Deserialize, Serialize};
use std::io;
use std::path::{Path, PathBuf};
use tracer_golden::picture::Rgb8;

/// The picture as it was made.
pub const PICTURE: &str = "actual.png";
/// With its noise.
pub const NOISE: &str = "actual.exr";
/// What it was made of.
const RECORD: &str = "made.json";
/// The page that shows it.
pub const PAGE: &str = "index.html";

/// What a picture was made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The scene's name in its folder.
    pub name: String,
    /// What the scene and its files are known by.
    pub stamp: String,
    /// The files.
    pub files: Vec<PathBuf>,
}

/// Where a scene's picture is kept until it is accepted.
#[derive(Clone, Debug)]
pub struct Made {
    folder: PathBuf,
}

/// Of all scenes whose pictures wait, the names, in their order.
pub fn waiting(made: &Path) -> Vec<String> {
    fn find(folder: &Path, below: &str, names: &mut Vec<String>) {
        let Ok(entries) = std::fs::read_dir(folder) else { return };
        for path in
            entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| path.is_dir() && !path.is_symlink())
        {
            let own = path.file_name().unwrap_or_default().to_string_lossy();
            let name = if below.is_empty() { own.into_owned() } else { format!("{below}/{own}") };
            if path.join(RECORD).is_file() {
                names.push(name.clone());
            }
            find(&path, &name, names);
        }
    }
    let mut names = Vec::new();
    find(made, "", &mut names);
    names.sort();
    names
}

impl Made {
    /// That of a scene.
    pub fn of(made: &Path, name: &str) -> Self {
        Made { folder: made.join(name) }
    }

    /// A file of it.
    pub fn path(&self, file: &str) -> PathBuf {
        self.folder.join(file)
    }

    /// What the picture was made of; `None` where there is none.
    ///
    /// # Errors
    /// When it is there and cannot be read.
    pub fn record(&self) -> Result<Option<Record>, Failure> {
        let path = self.path(RECORD);
        match std::fs::read(&path) {
            Ok(bytes) => Ok(serde_json::from_slice(&bytes).ok()),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(Failure::could_not(format!("cannot read {}: {error}", path.display()))),
        }
    }

    /// Keeps a picture, its noise where that is known, and what it was made of.
    ///
    /// # Errors
    /// When it cannot be written, or would replace what the scene was made of.
    pub fn keep(&self, picture: &Rgb8, noise: Option<&[u8]>, record: &Record) -> Result<(), WriteError> {
        let io = |why| WriteError::Io { path: self.folder.clone(), why };
        std::fs::create_dir_all(&self.folder).map_err(io)?;
        let read = [PICTURE, NOISE, RECORD].map(|file| self.path(file));
        if let Some(path) = read.iter().find(|path| record.files.iter().any(|file| is_one_file(path, file))) {
            return Err(WriteError::There { path: path.clone() });
        }
        save(&self.path(PICTURE), &png(picture, &record.name)?)?;
        if let Some(noise) = noise {
            save(&self.path(NOISE), noise)?;
        }
        let record = serde_json::to_vec_pretty(record).map_err(|error| io(io::Error::other(error)))?;
        save(&self.path(RECORD), &record)
    }

    /// Takes it away, with folders that are empty then; only what [`Made::keep`] made is.
    pub fn clear(&self) {
        if !matches!(self.record(), Ok(Some(_))) {
            return;
        }
        for file in [PICTURE, NOISE, RECORD, PAGE] {
            // What is not there needs no removing, and what cannot be removed is replaced by the next one.
            let _ = std::fs::remove_file(self.path(file));
        }
        let mut folder = self.folder.as_path();
        // An empty one only.
        while std::fs::remove_dir(folder).is_ok()
            && let Some(above) = folder.parent()
        {
            folder = above;
        }
    }
}

/// The bytes of the picture's file, which say what it is of.
fn png(picture: &Rgb8, name: &str) -> Result<Vec<u8>, WriteError> {
    let display: Vec<f32> = picture.rgb.iter().map(|&code| f32::from(code) / 255.0).collect();
    let image = tracer_core::Image {
        width: picture.width,
        height: picture.height,
        linear: display.clone(),
        display,
        alpha: None,
        layers: Vec::new(),
        mattes: Default::default(),
        light_groups: Vec::new(),
    };
    let settings = vec![Setting { name: "golden", value: name.to_owned() }];
    encode(&image, Encoding::Png(Bits::Eight), &Provenance { settings, ..Provenance::default() })
}
