//! `golden.toml`: how the scenes of a folder are rendered, and what is kept of their pictures.

use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The file's name.
pub const FILE: &str = "golden.toml";

/// What is said of all scenes of a folder.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Scenes that lie elsewhere, from the folder; none: those in the folder and below.
    pub scenes: Vec<PathBuf>,
    /// Folders and files below it that hold no scenes and no expected pictures.
    pub skip: Vec<PathBuf>,
    /// Pixels across and down; those of the scene.
    pub size: Option<[u32; 2]>,
    /// Samples of a pixel; those of the scene.
    pub samples: Option<u32>,
    /// Seed of all random choices; that of the scene.
    pub seed: Option<u32>,
    /// Which of the scenes' `cameras`; the one that a scene chooses itself.
    pub camera: Option<String>,
    /// Fields of the scenes to set: `camera.fov=40`.
    pub set: Vec<String>,
    /// Whether the noise is kept beside the picture: pictures of other bytes then pass when they differ by noise alone.
    pub noise: bool,
    /// Without noise: the mean of FLIP up to which a picture of other bytes passes; none does.
    pub flip: Option<f64>,
    /// What is kept as the picture of a scene that asks for layers.
    pub shows: Shows,
    /// Where pictures are kept that were made and not accepted, from the folder.
    pub made: PathBuf,
    /// Scenes of their own settings, by name.
    pub scene: BTreeMap<String, OfScene>,
}

/// What is kept as a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shows {
    /// The picture.
    #[default]
    Picture,
    /// The first layer that the scene asks for, where it does: its least number black, its greatest white.
    Layer,
}

/// What is said of one scene; it goes before what is said of all, and its fields are set after those.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OfScene {
    /// Pixels across and down.
    pub size: Option<[u32; 2]>,
    /// Samples of a pixel.
    pub samples: Option<u32>,
    /// Seed of all random choices.
    pub seed: Option<u32>,
    /// Which of its `cameras`.
    pub camera: Option<String>,
    /// Fields to set.
    pub set: Vec<String>,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            scenes: Vec::new(),
            skip: Vec::new(),
            size: None,
            samples: None,
            seed: None,
            camera: None,
            set: Vec::new(),
            noise: true,
            flip: None,
            shows: Shows::Picture,
            made: PathBuf::from(".golden"),
            scene: BTreeMap::new(),
        }
    }
}

/// Why there are no settings.
#[derive(Debug, thiserror::Error)]
pub enum SettingsError {
    /// There is no such file.
    #[error("{} is no folder of expected pictures: it has no {FILE}; `tracer golden new {}` makes it one",
        .0.display(), .0.display())]
    None(PathBuf),
    /// It cannot be read.
    #[error("cannot read {}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// It is wrong.
    #[error("{}: {message}", path.display())]
    Wrong {
        /// The file.
        path: PathBuf,
        /// What is wrong, with its line.
        message: String,
    },
}

impl Settings {
    /// Those of a folder.
    ///
    /// # Errors
    /// When there are none, or they cannot be understood.
    pub fn load(folder: &Path) -> Result<Self, SettingsError> {
        let path = folder.join(FILE);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                return Err(SettingsError::None(folder.to_owned()));
            }
            Err(source) => return Err(SettingsError::Io { path, source }),
        };
        Settings::parse(&text).map_err(|message| SettingsError::Wrong { path, message })
    }

    /// Reads the text of such a file.
    ///
    /// # Errors
    /// What is wrong, with its line.
    pub fn parse(text: &str) -> Result<Self, String> {
        let settings: Settings = toml::from_str(text).map_err(|error| error.to_string().trim_end().to_owned())?;
        let own = settings.scene.iter().map(|(name, own)| (name.as_str(), own.size, own.samples));
        for (name, size, samples) in own.chain([("", settings.size, settings.samples)]) {
            let of = if name.is_empty() { String::new() } else { format!("scene.\"{name}\": ") };
            if size.is_some_and(|[width, height]| !(1..=65_536).contains(&width) || !(1..=65_536).contains(&height)) {
                return Err(format!("{of}size is two numbers of 1 to 65536, as in [128, 96]"));
            }
            if samples == Some(0) {
                return Err(format!("{of}samples is a number from 1"));
            }
        }
        if settings.flip.is_some_and(|flip| !(0.0..=1.0).contains(&flip)) {
            return Err("flip is a number from 0 to 1, as in 0.01".to_owned());
        }
        if settings.noise && settings.flip.is_some() {
            return Err("flip is for folders that keep no noise: it goes with noise = false".to_owned());
        }
        Ok(settings)
    }

    /// What holds for a scene.
    pub fn of(&self, name: &str) -> OfScene {
        let own = self.scene.get(name).cloned().unwrap_or_default();
        OfScene {
            size: own.size.or(self.size),
            samples: own.samples.or(self.samples),
            seed: own.seed.or(self.seed),
            camera: own.camera.or_else(|| self.camera.clone()),
            set: self.set.iter().chain(&own.set).cloned().collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_goes_before_all() {
        let settings = Settings::parse(
            "size = [48, 32]\nsamples = 32\ncamera = \"above\"\nset = [\"a=1\"]\n[scene.\"family/case\"]\n\
             samples = 64\nset = [\"b=2\"]\n[scene.door]\ncamera = \"door\"\n",
        )
        .expect("right");
        assert!(settings.noise && settings.shows == Shows::Picture);
        let own = settings.of("family/case");
        assert_eq!((own.size, own.samples, own.seed), (Some([48, 32]), Some(64), None));
        assert_eq!(own.set, ["a=1", "b=2"]);
        assert_eq!(settings.of("other").samples, Some(32));
        let cameras = ["other", "door"].map(|name| settings.of(name).camera);
        assert_eq!(cameras, [Some("above".to_owned()), Some("door".to_owned())]);
        assert_eq!(Settings::parse(""), Ok(Settings::default()));
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, said) in [
            ("sample = 3", "line 1"),
            ("samples = 0", "samples is a number from 1"),
            ("samples = -1", "line 1"),
            ("size = [0, 3]", "as in [128, 96]"),
            ("flip = 2.0\nnoise = false", "0 to 1"),
            ("flip = 0.1", "noise = false"),
            ("[scene.a]\nsize = [1, 70000]", "scene.\"a\": size"),
            ("shows = \"all\"", "layer"),
        ] {
            let error = Settings::parse(text).expect_err(text);
            assert!(error.contains(said), "{text}: {error}");
        }
    }
}
