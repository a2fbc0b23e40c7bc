//! A scene rendered and held against its expected picture.

use super::host_path::host_path;
use super::made::{Made, Record};
use super::rendering::{NoPicture, Rendered, make};
use crate::commands::scenes::is_scene;
use crate::compare::flip::flip;
use crate::compare::magma;
use crate::failure::{Failure, leads_nowhere, why};
use std::path::{Path, PathBuf};
use std::time::Instant;
use tracer_core::Level;
use tracer_golden::folder::{Case, Folder};
use tracer_golden::measured::Measured;
use tracer_golden::noise::{Judgement, judge};
use tracer_golden::outcome::{Flip, Outcome, Verdict};
use tracer_golden::picture::Rgb8;
use tracer_golden::settings::{FILE, Settings};
use tracer_golden::stored;

/// A folder of scenes and expected pictures.
pub struct Opened {
    /// As it is told.
    pub name: String,
    /// Where it is.
    pub path: PathBuf,
    /// What its `golden.toml` says.
    pub settings: Settings,
    /// What is in it.
    pub folder: Folder,
}

/// A scene that was examined.
pub struct Examined {
    /// What came of it.
    pub outcome: Outcome,
    /// The files that the scene was made of, or names.
    pub files: Vec<PathBuf>,
    /// The picture waits to be accepted there.
    pub kept: Option<Made>,
}

/// The false colours of FLIP's map.
pub fn colours(x: f32) -> [u8; 3] {
    magma(x).map(|c| (c * 255.0 + 0.5) as u8)
}

/// The word that is meant, as in scenes.
pub(super) fn nearest(word: &str, known: &[&str]) -> Option<String> {
    scene_format::nearest(word, known.iter().copied()).map(str::to_owned)
}

/// A file stands where a folder is expected: that of the scene, often.
fn no_folder(file: &Path) -> Failure {
    let shown = file.display();
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let way = if folder.join(FILE).is_file() {
        format!("name its folder, {}", folder.display())
    } else {
        "name one that `tracer golden new` has made".to_owned()
    };
    Failure::wrong(format!("{shown} is a file, and a folder is expected; {way}"))
}

impl Opened {
    /// Opens a folder.
    ///
    /// # Errors
    /// When it is none, its settings are wrong, or it has no scenes.
    pub fn open(path: &Path, name: &str) -> Result<Self, Failure> {
        let shown = path.display();
        match path.metadata() {
            Err(error) if !leads_nowhere(&error) => {
                return Err(Failure::could_not(format!("cannot read the folder {shown}: {}", why(&error))));
            }
            Ok(found) if found.is_dir() => {}
            Ok(_) => return Err(no_folder(path)),
            Err(_) => return Err(Failure::wrong(format!("there is no folder {shown}; `tracer golden new` makes one"))),
        }
        let settings = Settings::load(path, &nearest).map_err(|error| Failure::Wrong(error.into()))?;
        let folder = Folder::find(path, &settings, &is_scene).map_err(|error| Failure::Wrong(error.into()))?;
        let names: Vec<&str> = folder.cases.iter().map(|case| case.name.as_str()).collect();
        settings.expect_scenes(path, &names, &nearest).map_err(|error| Failure::Wrong(error.into()))?;
        Ok(Opened { name: name.to_owned(), path: path.to_owned(), settings, folder })
    }

    /// Where pictures are kept that were made.
    pub fn made(&self) -> PathBuf {
        self.path.join(&self.settings.made)
    }

    /// Renders a scene and compares; a picture that is not the expected one is kept.
    ///
    /// # Errors
    /// When Ctrl-C ended it (`None`), or what was made cannot be kept.
    pub fn examine(&self, case: &Case, threads: usize, level: Level) -> Result<Option<Examined>, Failure> {
        let begun = Instant::now();
        let made = Made::of(&self.made(), &case.name);
        made.clear();
        let mut outcome = Outcome {
            folder: self.name.clone(),
            name: case.name.clone(),
            file: host_path(&case.scene),
            scene: std::fs::read_to_string(&case.scene).unwrap_or_default(),
            verdict: Verdict::Equal,
            seconds: 0.0,
            expected: None,
            actual: None,
            flip: None,
        };
        let wrong = |what: String| Verdict::Wrong { what };
        let rendered = match make(case, &self.settings, threads, level) {
            Ok(rendered) => rendered,
            Err(NoPicture::Interrupted) => return Ok(None),
            Err(NoPicture::Wrong { what, files }) => {
                (outcome.verdict, outcome.seconds) = (wrong(what), begun.elapsed().as_secs_f64());
                return Ok(Some(Examined { outcome, files, kept: None }));
            }
        };
        let expected = Expected::read(case, self.settings.noise);
        match expected {
            Err(what) => outcome.verdict = wrong(what),
            Ok(None) => outcome.verdict = Verdict::Missing,
            Ok(Some(expected)) => {
                if expected.picture.has_size_of(&rendered.picture) && expected.picture != rendered.picture {
                    outcome.flip = Some(flip_of(&expected.picture, &rendered.picture));
                }
                outcome.verdict = verdict(&expected, &rendered, &self.settings, outcome.flip.as_ref());
                outcome.expected = Some(expected.picture);
            }
        }
        let kept = if outcome.verdict == Verdict::Equal { None } else { Some(self.keep(&rendered, case, made)?) };
        outcome.actual = Some(rendered.picture);
        outcome.seconds = begun.elapsed().as_secs_f64();
        Ok(Some(Examined { outcome, files: rendered.files, kept }))
    }

    fn keep(&self, rendered: &Rendered, case: &Case, made: Made) -> Result<Made, Failure> {
        let noise = rendered.measured.as_ref().map(stored::encode).transpose().map_err(Failure::could_not)?;
        let record = Record { name: case.name.clone(), stamp: rendered.stamp.clone(), files: rendered.files.clone() };
        made.keep(&rendered.picture, noise.as_deref(), &record)?;
        Ok(made)
    }

    /// Pictures without a scene, those that scenes read left out.
    pub fn orphans(&self, read: &[PathBuf]) -> Vec<Outcome> {
        let real = |path: &Path| std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let read: Vec<PathBuf> = read.iter().map(|file| real(file)).collect();
        let orphans = self.folder.orphans(&|file| read.contains(&real(file)));
        let outcome = |file: PathBuf| Outcome {
            folder: self.name.clone(),
            name: file.strip_prefix(&self.path).unwrap_or(&file).display().to_string(),
            scene: String::new(),
            verdict: Verdict::Orphan,
            seconds: 0.0,
            expected: std::fs::read(&file).ok().and_then(|bytes| Rgb8::from_png(&bytes).ok()),
            actual: None,
            flip: None,
            file: host_path(&file),
        };
        orphans.into_iter().map(outcome).collect()
    }
}

/// What is expected of a scene.
struct Expected {
    picture: Rgb8,
    measured: Option<Measured>,
}

impl Expected {
    /// `None` where no picture is expected yet.
    fn read(case: &Case, noise: bool) -> Result<Option<Self>, String> {
        let bytes = |path: &Path| match std::fs::read(path) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(format!("cannot read {}: {}", path.display(), why(&error))),
        };
        let Some(png) = bytes(&case.png)? else { return Ok(None) };
        let broken =
            |path: &Path, what: String| format!("the expected picture {} cannot be read: {what}", path.display());
        let picture = Rgb8::from_png(&png).map_err(|error| broken(&case.png, error.to_string()))?;
        let exr = if noise { bytes(&case.exr)? } else { None };
        let measured = exr.map(|exr| stored::decode(&exr)).transpose().map_err(|what| broken(&case.exr, what))?;
        Ok(Some(Expected { picture, measured }))
    }
}

fn verdict(expected: &Expected, rendered: &Rendered, settings: &Settings, flip: Option<&Flip>) -> Verdict {
    let (e, a) = (&expected.picture, &rendered.picture);
    let different = |why: String| Verdict::Different { why, findings: Vec::new() };
    if !e.has_size_of(a) {
        return different(format!("the size is {}x{}, expected {}x{}", a.width, a.height, e.width, e.height));
    }
    let difference = a.difference(e);
    let why = format!("{} pixels differ, by up to {} of 255", difference.count, difference.largest);
    let same = difference.count == 0;
    match (&expected.measured, &rendered.measured) {
        (Some(of_e), Some(of_a)) if of_e.rgb == of_a.rgb && of_e.look == of_a.look => {
            if same {
                Verdict::Equal
            } else {
                different(format!("{why}: the light is the same, and developed otherwise"))
            }
        }
        (Some(of_e), Some(of_a)) => match judge(of_e, of_a) {
            Judgement::Noise { probability } => Verdict::WithinNoise { probability },
            // What clips on a display differs in the light alone.
            Judgement::Different { findings } => Verdict::Different { why, findings },
            Judgement::Unknown { why: more } => different(format!("{why}; {more}")),
        },
        _ if same => Verdict::Equal,
        (None, Some(_)) => {
            different(format!("{why}; no noise is kept of the expected picture, so that all bytes count"))
        }
        _ => match (settings.flip, flip) {
            (Some(limit), Some(flip)) if flip.mean <= limit => Verdict::WithinFlip { limit },
            _ => different(why),
        },
    }
}

/// FLIP of two pictures of one size.
fn flip_of(expected: &Rgb8, actual: &Rgb8) -> Flip {
    let display = |p: &Rgb8| -> Vec<f32> { p.rgb.iter().map(|&x| f32::from(x) / 255.0).collect() };
    let values = flip(&display(expected), &display(actual), actual.width as usize);
    let mean = values.iter().copied().map(f64::from).sum::<f64>() / values.len().max(1) as f64;
    let max = values.iter().copied().fold(0.0, f32::max).into();
    let rgb = values.iter().flat_map(|&x| colours(x)).collect();
    Flip { mean, max, map: Rgb8 { width: actual.width, height: actual.height, rgb } }
}
