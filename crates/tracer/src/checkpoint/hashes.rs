//! What the files of a scene hold, by their hashes: read beside the rendering, which does not wait for it.

use super::sha256_of;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::SystemTime;
use std::{fs, io};
use tracer_core::Note;

/// What is known already: frames of a film have the same files.
#[derive(Clone, Default)]
pub struct Hashes {
    known: Arc<Mutex<Known>>,
    /// Who else makes them, or knows them.
    by: Option<Arc<HashOf>>,
}

/// Makes the hash of a file, or knows it.
pub type HashOf = dyn Fn(&Path) -> io::Result<String> + Send + Sync;

type Known = HashMap<PathBuf, (Stamp, String)>;

/// Size and time.
type Stamp = (u64, Option<SystemTime>);

/// Hashes that are being made.
pub struct Hashing(Result<JoinHandle<Option<Vec<Note>>>, Option<Vec<Note>>>);

impl Hashes {
    /// Made by somebody who may know them from an earlier run of the program, if there is one.
    pub fn by(by: Option<Arc<HashOf>>) -> Self {
        Hashes { by, ..Hashes::default() }
    }

    /// Begins with these files of a scene in this folder; where no other thread is wanted, it ends with them, too.
    pub fn begin(&self, files: &[PathBuf], folder: &Path, threads: Option<u16>) -> Hashing {
        if threads == Some(1) {
            return Hashing(Err(self.notes(files, folder)));
        }
        let (known, files, folder) = (self.clone(), files.to_vec(), folder.to_owned());
        let again = (files.clone(), folder.clone());
        let work = move || known.notes(&files, &folder);
        let thread = std::thread::Builder::new().name("hashes".to_owned()).spawn(work);
        // Without a thread it takes its time now.
        Hashing(thread.map_err(|_| self.notes(&again.0, &again.1)))
    }

    fn notes(&self, files: &[PathBuf], folder: &Path) -> Option<Vec<Note>> {
        let note = |file: &PathBuf| Some((file_note(file, folder), self.of(file)?));
        files.iter().map(note).collect()
    }

    fn of(&self, file: &Path) -> Option<String> {
        // What fails once, on a disk far away, is tried again.
        const TRIES: usize = 3;
        (0..TRIES).find_map(|_| self.tried(file))
    }

    fn tried(&self, file: &Path) -> Option<String> {
        let meta = fs::metadata(file).ok()?;
        let stamp = (meta.len(), meta.modified().ok());
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let found = known().get(file).filter(|(of, _)| *of == stamp && of.1.is_some()).map(|(_, hash)| hash.clone());
        found.or_else(|| {
            let hash = match &self.by {
                Some(by) => by(file).ok()?,
                None => sha256_of(file).ok()?,
            };
            known().insert(file.to_owned(), (stamp, hash.clone()));
            Some(hash)
        })
    }
}

impl Hashing {
    /// A note for each file, and that these are all; `None` where one could not be read any more.
    pub fn end(self) -> Option<Vec<Note>> {
        let notes = match self.0 {
            Ok(thread) => thread.join().unwrap_or_default(),
            Err(notes) => notes,
        };
        notes.map(|mut notes| {
            notes.push(files_are_told());
            notes
        })
    }
}

/// The name of a note of a file: as the scene in its folder names it.
pub fn file_note(file: &Path, folder: &Path) -> String {
    format!("file:{}", file.strip_prefix(folder).unwrap_or(file).display())
}

/// Says of notes that they have all files, if there are any.
pub fn files_are_told() -> Note {
    ("picture.files".to_owned(), "told".to_owned())
}
