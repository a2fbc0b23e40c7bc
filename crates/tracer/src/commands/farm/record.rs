//! What a farm keeps of itself, and where: its folder has `farm.json`, the scripts, and folders for parts, logs and
//! states.

use super::queue;
use crate::failure::Failure;
use crate::write::save;
use serde::{Deserialize, Serialize};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};
use tracer_core::Note;

/// The version of `farm.json`.
pub const VERSION: u32 = 1;
const FILE: &str = "farm.json";

/// `farm.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    pub farm_version: u32,
    /// The command line that goes on with it, and where it was typed.
    pub command: Vec<String>,
    pub directory: String,
    pub scene: String,
    pub pictures: Vec<String>,
    pub parts: u32,
    /// What must be the same to go on: names and values to be shown.
    pub settings: Vec<Note>,
    /// What the parts are known by, as films have it.
    pub notes: Vec<Note>,
    /// The arrays that have been submitted, and the last merge.
    pub arrays: Vec<String>,
    pub merge: Option<String>,
}

/// Where things lie in a farm's folder, which is a whole path.
#[derive(Clone, Debug)]
pub struct Layout {
    pub folder: PathBuf,
}

impl Layout {
    fn record(&self) -> PathBuf {
        self.folder.join(FILE)
    }

    /// A part's film.
    pub fn film(&self, part: u32, of: u32) -> PathBuf {
        let digits = digits(of);
        self.folder.join(format!("parts/{part:0digits$}of{of}.tracer"))
    }

    /// What a script keeps of a part, or of the merge.
    pub fn state(&self, of: &str, what: &str) -> PathBuf {
        self.folder.join(format!("state/{of}.{what}"))
    }

    /// What a script and what it has run have said.
    pub fn log(&self, of: &str) -> PathBuf {
        self.folder.join(format!("logs/{of}.log"))
    }

    /// Whether there is a farm.
    pub fn is_farm(&self) -> bool {
        self.record().is_file()
    }

    /// Makes its folders.
    ///
    /// # Errors
    /// When they cannot be made.
    pub fn make(&self) -> Result<(), Failure> {
        for name in ["parts", "logs", "state"] {
            let folder = self.folder.join(name);
            let could_not = |error| Failure::could_not(format!("cannot make {}: {error}", folder.display()));
            fs::create_dir_all(&folder).map_err(could_not)?;
        }
        Ok(())
    }

    /// Keeps others from submitting the same parts; the lock ends with the process.
    ///
    /// # Errors
    /// When another does.
    pub fn lock(&self) -> Result<File, Failure> {
        let path = self.folder.join("farm.lock");
        let could_not = |error| Failure::could_not(format!("cannot lock {}: {error}", path.display()));
        let file = OpenOptions::new().create(true).truncate(false).write(true).open(&path).map_err(could_not)?;
        match file.try_lock() {
            Ok(()) => Ok(file),
            Err(TryLockError::Error(error)) => Err(could_not(error)),
            Err(TryLockError::WouldBlock) => {
                let folder = self.folder.display();
                Err(Failure::could_not(format!("another `tracer farm slurm` is at work in {folder}; wait for it")))
            }
        }
    }

    /// Reads `farm.json`.
    ///
    /// # Errors
    /// When it cannot be read, or is of another version.
    pub fn load(&self) -> Result<Record, Failure> {
        let path = self.record();
        let shown = path.display();
        let could_not = |error: &dyn std::fmt::Display| Failure::could_not(format!("cannot read {shown}: {error}"));
        let text = fs::read_to_string(&path).map_err(|error| could_not(&error))?;
        let value: serde_json::Value = serde_json::from_str(&text).map_err(|error| could_not(&error))?;
        if value["farm_version"] != VERSION {
            let version = &value["farm_version"];
            return Err(Failure::could_not(format!(
                "{shown} has version {version}, and this program knows {VERSION}: use the program that has made it"
            )));
        }
        serde_json::from_value(value).map_err(|error| could_not(&error))
    }

    /// Writes `farm.json`.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn save(&self, record: &Record) -> Result<(), Failure> {
        let could_not = |error| Failure::could_not(format!("cannot write {}: {error}", self.record().display()));
        let json = serde_json::to_string_pretty(record).map_err(could_not)?;
        Ok(save(&self.record(), format!("{json}\n").as_bytes())?)
    }
}

/// Decimal digits of a number.
pub fn digits(number: u32) -> usize {
    number.to_string().len()
}

/// The farm that a word on the command line means: its folder, or one of its jobs.
///
/// # Errors
/// When there is none.
pub fn find(word: &Path) -> Result<(Layout, Record), Failure> {
    let shown = word.display();
    if let Some(job) = word.to_str().filter(|word| is_job(word) && !Path::new(word).exists()) {
        let layout = of_job(job)?.ok_or_else(|| {
            Failure::wrong(format!(
                "there is no farm of job {job} in this folder, nor does Slurm tell of one; name the farm's folder"
            ))
        })?;
        return layout.load().map(|record| (layout, record));
    }
    let layout = Layout { folder: whole(word)? };
    if layout.is_farm() {
        return layout.load().map(|record| (layout, record));
    }
    let near = word.with_extension("farm");
    let tip = match (Layout { folder: near.clone() }).is_farm() {
        true => format!("did you mean {}?", near.display()),
        false => "`tracer farm slurm` makes one".to_owned(),
    };
    Err(Failure::wrong(match word.exists() {
        true => format!("{shown} is no farm: it has no {FILE}; {tip}"),
        false => format!("there is no farm {shown}; {tip}"),
    }))
}

/// A whole path.
///
/// # Errors
/// When the system does not tell where we are.
pub fn whole(path: &Path) -> Result<PathBuf, Failure> {
    std::path::absolute(path).map_err(|error| Failure::could_not(format!("cannot find {}: {error}", path.display())))
}

/// `4711`, or a task of it: `4711_3`.
fn is_job(word: &str) -> bool {
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    word.split_once('_').map_or_else(|| digits(word), |(job, task)| digits(job) && digits(task))
}

/// The farm of a job: one in this folder, else the one that Slurm names.
fn of_job(job: &str) -> Result<Option<Layout>, Failure> {
    let job = job.split('_').next().unwrap_or(job);
    for entry in fs::read_dir(".").into_iter().flatten().flatten() {
        let layout = Layout { folder: whole(&entry.path())? };
        let has = |record: Record| record.arrays.iter().chain(&record.merge).any(|of| of == job);
        if layout.is_farm() && layout.load().is_ok_and(has) {
            return Ok(Some(layout));
        }
    }
    Ok(queue::folder_of(job)?.map(|folder| Layout { folder }).filter(Layout::is_farm))
}
