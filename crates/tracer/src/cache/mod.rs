//! `--cache`: a folder in which meshes as they were read and trees as they were built are kept from run to run.
//!
//! What a file holds, and whether it may be used, `tracer_core` knows. Here is where it lies: names, locks, files that
//! appear whole or not at all as checkpoints do, and what goes when the folder is full. Nothing that goes wrong here
//! ends a rendering.

mod records;
mod room;

pub use records::subject;

use crate::args::CacheArgs;
use crate::checkpoint::{HashOf, Place, sha256_of};
use crate::failure::Failure;
use crate::memory::human;
use crate::shell::Shell;
use crate::write::advice;
use serde::Serialize;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::SystemTime;
use tracer_core::{ContentHash, Fill, Stamp, Store, StoreTold};

/// Bytes that a folder may take where nobody says how many.
const MOST: u64 = 10 << 30;

/// Smaller files are not recorded.
const LEAST_BYTES: u64 = 1 << 16;

/// A folder in use. Its clones are the same.
#[derive(Clone, Debug)]
pub struct Cache(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    folder: PathBuf,
    /// Bytes that it may take.
    most: u64,
    /// No record is taken for what a file holds now.
    verify: bool,
    /// Nothing is written beside the rendering.
    alone: bool,
    shell: Shell,
    told: Mutex<CacheReport>,
    writers: Mutex<Vec<JoinHandle<()>>>,
    /// Held while a file is written.
    writing: Mutex<()>,
}

/// What came from a cache.
#[derive(Clone, Debug, Default, Serialize)]
pub struct CacheReport {
    /// Meshes and trees that were there.
    pub hits: u64,
    /// Those that were read and built.
    pub misses: u64,
    /// Of these, damaged ones.
    pub broken: u64,
    /// Bytes that were read from it.
    pub bytes: u64,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Cache {
    /// As the command line says; one that cannot be had is told, and the rendering does without.
    ///
    /// # Errors
    /// What is named is no folder.
    pub fn open(args: &CacheArgs, threads: Option<u16>, shell: &Shell) -> Result<Option<Self>, Failure> {
        let Some(named) = &args.cache else { return Ok(None) };
        let shown = named.display();
        if named.exists() && !named.is_dir() {
            return Err(Failure::wrong(format!("--cache {shown}: it is no folder; name one, or one to be made")));
        }
        let folder = match fs::create_dir_all(named).and_then(|()| fs::canonicalize(named)) {
            Ok(folder) => folder,
            Err(error) => {
                let advice = advice(&error);
                shell.warn(&format!("--cache {shown} cannot be used: {error}; {advice} (it is done without)"));
                return Ok(None);
            }
        };
        Ok(Some(Cache(Arc::new(Inner {
            folder,
            most: args.cache_size.unwrap_or(MOST),
            verify: args.cache_verify,
            alone: threads == Some(1),
            shell: *shell,
            told: Mutex::default(),
            writers: Mutex::default(),
            writing: Mutex::default(),
        }))))
    }

    /// What has come from it so far.
    pub fn report(&self) -> CacheReport {
        lock(&self.0.told).clone()
    }

    /// The same as the engine wants it.
    pub fn store(&self) -> Arc<dyn Store> {
        Arc::new(self.clone())
    }

    /// Who makes hashes of files, or knows them from an earlier run.
    pub fn hashes(&self) -> Arc<HashOf> {
        let cache = self.clone();
        Arc::new(move |path| cache.hash_of(path))
    }

    /// SHA-256 of a file's contents, in hexadecimal digits: recorded, or made and recorded.
    fn hash_of(&self, path: &Path) -> io::Result<String> {
        if let Some(hash) = self.recorded(path) {
            return Ok(records::to_hex(&hash));
        }
        let stamp = Stamp::of(path)?;
        let digits = sha256_of(path)?;
        // Small files are hashed as fast as a record is read.
        if let Some(hash) = records::from_hex(&digits).filter(|_| stamp.bytes >= LEAST_BYTES) {
            self.record(path, &stamp, &hash);
        }
        Ok(digits)
    }

    /// Waits for what is being written.
    pub fn finish(&self) {
        // One at a time: a writer may be added meanwhile.
        while let Some(writer) = { lock(&self.0.writers).pop() } {
            let _ = writer.join();
        }
    }

    /// Does something beside the rendering, or now.
    fn beside(&self, work: impl FnOnce() + Send + 'static) {
        if self.0.alone {
            return work();
        }
        let mut writers = lock(&self.0.writers);
        writers.retain(|writer| !writer.is_finished());
        // Without a thread it is not kept this time.
        writers.extend(std::thread::Builder::new().name("cache".to_owned()).spawn(work));
    }
}

impl Inner {
    /// Writes a file; another process that writes the same one is left to it.
    fn write(&self, name: &str, bytes: u64, fill: Fill) -> io::Result<()> {
        let place = Place::unchecked(&self.folder.join(name))?;
        let Some(_lock) = place.try_lock()? else { return Ok(()) };
        // One at a time: two would find the same room.
        let _writing = lock(&self.writing);
        room::make(&self.folder, self.most, bytes)?;
        place.write(false, |file| fill(file))?;
        self.shell.explain(|| format!("kept for the next time: {name}, {}", human(bytes)));
        Ok(())
    }

    fn warn(&self, error: &io::Error) {
        let folder = self.folder.display();
        self.shell.warn(&format!("cannot write to the cache {folder}: {error}; {}", advice(error)));
    }
}

impl Store for Cache {
    fn recorded(&self, path: &Path) -> Option<ContentHash> {
        if self.0.verify { None } else { records::find(&self.0.folder, path) }
    }

    fn record(&self, path: &Path, stamp: &Stamp, hash: &ContentHash) {
        if let Some((file, text)) = records::of(&self.0.folder, path, stamp, hash) {
            let inner = Arc::clone(&self.0);
            self.beside(move || records::write(&file, text.as_bytes()).unwrap_or_else(|error| inner.warn(&error)));
        }
    }

    fn open(&self, name: &str) -> Option<File> {
        let path = self.0.folder.join(name);
        let is_file = match fs::metadata(&path) {
            Ok(found) => found.is_file(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => return None,
            Err(_) => true,
        };
        match File::open(&path) {
            Ok(file) if is_file => {
                // What was used last stays longest. Where this may not be changed, nothing is written either.
                let _ = file.set_modified(SystemTime::now());
                Some(file)
            }
            Ok(_) => None,
            Err(error) => {
                self.0.shell.warn(&format!("cannot read {}: {error}; it is made anew", path.display()));
                None
            }
        }
    }

    fn keep(&self, name: &str, bytes: u64, fill: Fill) {
        if bytes > self.0.most {
            let (bytes, most) = (human(bytes), human(self.0.most));
            return self.0.shell.warn(&format!("{name} takes {bytes}, and the cache has {most}; raise --cache-size"));
        }
        let (inner, name) = (Arc::clone(&self.0), name.to_owned());
        self.beside(move || inner.write(&name, bytes, fill).unwrap_or_else(|error| inner.warn(&error)));
    }

    fn told(&self, told: StoreTold<'_>) {
        let mut report = lock(&self.0.told);
        match told {
            StoreTold::Taken { what, bytes } => {
                report.hits += 1;
                report.bytes += bytes;
                self.0.shell.explain(|| format!("from the cache: {what}, {}", human(bytes)));
            }
            StoreTold::Missing { .. } => report.misses += 1,
            StoreTold::Broken { name, why } => {
                report.broken += 1;
                let place = self.0.folder.join(name);
                self.0.shell.warn(&format!("{} cannot be used: {why}; it is made anew", place.display()));
            }
            _ => {}
        }
    }
}
