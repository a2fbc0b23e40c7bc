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

/// Which of some words one is nearest to that is none of them: the caller's own way, which is that of scenes.
pub type Nearest<'a> = &'a dyn Fn(&str, &[&str]) -> Option<String>;

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
    #[error("{}{wrong}", path.display())]
    Wrong {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        wrong: Wrong,
    },
}

/// What is wrong with the text of such a file. Shown, it follows the file's name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// Line and column, from 1, where there is one.
    pub at: Option<[usize; 2]>,
    /// In a sentence.
    pub message: String,
}

impl std::fmt::Display for Wrong {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some([line, column]) = self.at {
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.message)
    }
}

impl Wrong {
    fn new(message: impl Into<String>) -> Self {
        Wrong { at: None, message: message.into() }
    }

    /// What the reader of TOML says, in the words of scenes.
    fn of(error: &toml::de::Error, text: &str, nearest: Nearest<'_>) -> Self {
        let at = error.span().map(|span| {
            let before = text.get(..span.start).unwrap_or(text);
            let line = before.rsplit('\n').next().unwrap_or(before);
            [before.matches('\n').count() + 1, line.chars().count() + 1]
        });
        let said = error.message().trim_end().replace('\n', "; ");
        // As serde words it: "unknown field `a`, expected one of `b`, `c`".
        let words: Vec<&str> = said.split('`').skip(1).step_by(2).collect();
        let message = match words.as_slice() {
            [unknown, known @ ..] if said.starts_with("unknown ") => {
                let tip = nearest(unknown, known).map(|near| format!("did you mean `{near}`?"));
                let listed = || format!("expected one of `{}`", known.join("`, `"));
                let what = if said.starts_with("unknown field") { "setting" } else { "word" };
                format!("there is no {what} `{unknown}`; {}", tip.unwrap_or_else(listed))
            }
            _ => said.replace("expected u32", "expected a whole number from 0"),
        };
        Wrong { at, message }
    }
}

impl Settings {
    /// Those of a folder.
    ///
    /// # Errors
    /// When there are none, or they cannot be understood.
    pub fn load(folder: &Path, nearest: Nearest<'_>) -> Result<Self, SettingsError> {
        let path = folder.join(FILE);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                return Err(SettingsError::None(folder.to_owned()));
            }
            Err(source) => return Err(SettingsError::Io { path, source }),
        };
        Settings::parse(&text, nearest).map_err(|wrong| SettingsError::Wrong { path, wrong })
    }

    /// Reads the text of such a file.
    ///
    /// # Errors
    /// What is wrong, with its line.
    pub fn parse(text: &str, nearest: Nearest<'_>) -> Result<Self, Wrong> {
        let settings: Settings = toml::from_str(text).map_err(|error| Wrong::of(&error, text, nearest))?;
        let own = settings.scene.iter().map(|(name, own)| (name.as_str(), own.size, own.samples));
        for (name, size, samples) in own.chain([("", settings.size, settings.samples)]) {
            let of = if name.is_empty() { String::new() } else { format!("scene.\"{name}\": ") };
            if size.is_some_and(|[width, height]| !(1..=65_536).contains(&width) || !(1..=65_536).contains(&height)) {
                return Err(Wrong::new(format!("{of}size is two numbers of 1 to 65536, as in [128, 96]")));
            }
            if samples == Some(0) {
                return Err(Wrong::new(format!("{of}samples is a number from 1")));
            }
        }
        if settings.flip.is_some_and(|flip| !(0.0..=1.0).contains(&flip)) {
            return Err(Wrong::new("flip is a number from 0 to 1, as in 0.01"));
        }
        if settings.noise && settings.flip.is_some() {
            return Err(Wrong::new("flip is for folders that keep no noise: it goes with noise = false"));
        }
        Ok(settings)
    }

    /// Sees that scenes of their own settings are scenes of the folder: a slip would leave one without them.
    ///
    /// # Errors
    /// The first that is none.
    pub fn expect_scenes(&self, folder: &Path, names: &[&str], nearest: Nearest<'_>) -> Result<(), SettingsError> {
        let Some(unknown) = self.scene.keys().find(|name| !names.contains(&name.as_str())) else { return Ok(()) };
        let tip = nearest(unknown, names).map_or_else(
            || {
                "its name is its path from the folder, without extension; the name alone where `scenes` lists it"
                    .to_owned()
            },
            |near| format!("did you mean {near}?"),
        );
        let wrong = Wrong::new(format!("scene.\"{unknown}\": there is no scene of that name; {tip}"));
        Err(SettingsError::Wrong { path: folder.join(FILE), wrong })
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

    /// The first word that begins alike.
    fn parse(text: &str) -> Result<Settings, Wrong> {
        Settings::parse(text, &alike)
    }

    fn alike(word: &str, known: &[&str]) -> Option<String> {
        known.iter().find(|known| known.get(..3) == word.get(..3)).map(|&near| near.to_owned())
    }

    #[test]
    fn a_scene_goes_before_all() {
        let settings = parse(
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
        assert_eq!(parse(""), Ok(Settings::default()));
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, said) in [
            ("noise = true\n  samles = 3", ":2:3: there is no setting `samles`; did you mean `samples`?"),
            ("\n[scene.a]\nsead = 3", ":3:1: there is no setting `sead`; expected one of `size`, `samples`, `seed`,"),
            ("samples = 0", "samples is a number from 1"),
            ("samples = -1", "expected a whole number from 0"),
            ("samples = ", ":1:1"),
            ("size = [0, 3]", "as in [128, 96]"),
            ("flip = 2.0\nnoise = false", "0 to 1"),
            ("flip = 0.1", "noise = false"),
            ("[scene.a]\nsize = [1, 70000]", "scene.\"a\": size"),
            ("shows = \"all\"", ":1:9: there is no word `all`; expected one of `picture`, `layer`"),
        ] {
            let error = parse(text).expect_err(text).to_string();
            assert!(error.contains(said) && !error.contains('\n'), "{text}: {error}");
        }
    }

    /// What is said of a scene that there is not would count for none.
    #[test]
    fn settings_of_no_scene_are_told() {
        let settings = parse("[scene.\"family/case\"]\nseed = 1\n[scene.doors]\nseed = 2").expect("right");
        let told = |names: &[&str]| {
            settings.expect_scenes(Path::new("golden"), names, &alike).map_err(|error| error.to_string())
        };
        assert_eq!(told(&["doors", "family/case", "more"]), Ok(()));
        let error = told(&["door", "family/case"]).expect_err("no `doors`");
        assert!(error.starts_with("golden/golden.toml: scene.\"doors\": there is no scene of that name"), "{error}");
        assert!(error.ends_with("did you mean door?"), "{error}");
        assert!(told(&["gate", "family/case"]).expect_err("none alike").contains("path from the folder"));
    }
}
