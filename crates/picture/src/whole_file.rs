//! Files that appear whole or not at all: written beside their place under another name, forced to the disk, then
//! renamed.

use super::WriteError;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard};

/// Files under their other name; [`remove_unfinished`] deletes them when the program must leave at once.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// Deletes what [`save`] is in the middle of writing. For a program that is about to exit.
pub fn remove_unfinished() {
    for path in unfinished().drain(..) {
        // Nothing is left to do about one that stays.
        let _ = fs::remove_file(path);
    }
}

/// The same for a program that is about to exit in the middle of anything: where somebody has the list in hand, its
/// files stay.
pub fn try_remove_unfinished() {
    if let Ok(mut paths) = UNFINISHED.try_lock() {
        for path in paths.drain(..) {
            let _ = fs::remove_file(path);
        }
    }
}

/// Has [`remove_unfinished`] delete this one, too.
pub fn remember_unfinished(path: &Path) {
    unfinished().push(path.to_owned());
}

/// It is finished, or gone.
pub fn forget_unfinished(path: &Path) {
    unfinished().retain(|other| other != path);
}

/// Says whether [`save`] could write there now, before hours are spent on the picture. It changes nothing.
///
/// # Errors
/// Why it could not.
pub fn probe(path: &Path) -> Result<(), WriteError> {
    match Target::new(path)? {
        Target::Device => Ok(()),
        Target::File(file) => Unfinished::beside(&file).map(drop).map_err(|why| io_error(path, why)),
    }
}

/// What is made again and again, and replaces what was made before without a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputKind {
    /// A picture.
    Picture,
    /// A report, of a rendering or of expected pictures: JSON.
    Report,
    /// The report of expected pictures that CI servers read: XML.
    Junit,
    /// The page that shows expected pictures: HTML.
    Page,
    /// The drawing of a path: SVG.
    Drawing,
    /// Where marks are: TikZ or SVG.
    Marks,
}

impl OutputKind {
    fn noun(self) -> &'static str {
        match self {
            OutputKind::Picture => "picture",
            OutputKind::Report => "report of tracer",
            OutputKind::Junit => "JUnit report of tracer",
            OutputKind::Page => "page of golden pictures",
            OutputKind::Drawing => "drawing of tracer inspect",
            OutputKind::Marks => "file of tracer marks",
        }
    }

    /// Whether a file that begins so is of this kind: pictures by their first bytes, texts by their first lines.
    fn is_begun_by(self, head: &[u8]) -> bool {
        let text = String::from_utf8_lossy(head);
        match self {
            OutputKind::Picture => {
                let starts: [&[u8]; 9] = [
                    b"\x89PNG",
                    b"\x76\x2f\x31\x01",
                    b"#?RADIANCE",
                    b"#?RGBE",
                    b"PF",
                    b"Pf",
                    b"\xff\xd8\xff",
                    b"P6",
                    b"P3",
                ];
                starts.iter().any(|start| head.starts_with(start))
            }
            OutputKind::Report => {
                let ours = ["\"report_version\"", "\"golden_version\""].iter().any(|word| text.contains(word));
                text.trim_start().starts_with('{') && ours
            }
            OutputKind::Junit => text.starts_with("<?xml") && text.contains("name=\"tracer golden\""),
            OutputKind::Page => text.starts_with("<!doctype html>") && text.contains("<h1>Golden pictures"),
            OutputKind::Drawing => text.starts_with("<svg") && text.contains(", sample "),
            OutputKind::Marks => {
                text.starts_with("% tracer marks: ")
                    || text.starts_with("<svg") && text.contains("<!-- tracer marks -->")
            }
        }
    }
}

/// Sees that what is made again and again replaces only what is of the same kind, or an empty file: a scene or a list
/// of somebody's is not lost by a slip, however short it is.
///
/// # Errors
/// That something else is there.
pub fn spare_other(path: &Path, kind: OutputKind) -> Result<(), WriteError> {
    /// So much of a file tells what it is: the page of goldens has its policy first.
    const HEAD: u64 = 4096;
    let is_file = match fs::metadata(path) {
        Ok(found) => found.is_file(),
        Err(error) if is_nowhere(&error) => false,
        // Where nobody tells what is there, nothing is replaced.
        Err(error) => return Err(io_error(path, error)),
    };
    let mut head = Vec::new();
    // Who cannot read a file cannot say that it is a report.
    let known = is_file && fs::File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head)).is_ok();
    if !is_file || known && (head.is_empty() || kind.is_begun_by(&head)) {
        return Ok(());
    }
    Err(WriteError::Other { path: path.to_owned(), noun: kind.noun() })
}

/// Writes a file, whole or not at all. A link is followed; an older file's permissions are kept; what is no regular
/// file (a device, a pipe) is written directly.
///
/// # Errors
/// Why it could not be written; an older file is then as it was.
pub fn save(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let saved = match Target::new(path)? {
        Target::Device => write_device(path, bytes),
        Target::File(file) => write_file(&file, bytes),
    };
    saved.map_err(|why| io_error(path, why))
}

fn io_error(path: &Path, why: io::Error) -> WriteError {
    WriteError::Io { path: path.to_owned(), why }
}

/// The file that [`save`] would write for a name: two names of one file give the same. A link is followed even when
/// nothing is where it leads.
///
/// # Errors
/// When the system does not say: there is no such folder, or links lead in a circle.
pub fn real_place(path: &Path) -> io::Result<PathBuf> {
    /// As Linux: more links than this are taken for a circle.
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::metadata(&path) {
            Ok(_) => return fs::canonicalize(path),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(error),
        }
        match fs::read_link(&path) {
            Ok(target) => path = folder_of(&path).join(target),
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            Err(_) => {
                let name = path.file_name().ok_or(io::ErrorKind::NotFound)?;
                return Ok(fs::canonicalize(folder_of(&path))?.join(name));
            }
        }
    }
    Err(io::Error::other("too many links"))
}

/// Whether a place to write and another file's name lead to the same file, or would. Where the system does not tell
/// where a place lies, it is taken for the same, so that nothing is replaced.
pub fn is_one_file(place: &Path, other: &Path) -> bool {
    if place == other {
        return true;
    }
    // Asked once more: what cannot be read at all is told by whoever reads it.
    match (real_place(place), real_place(other).or_else(|_| real_place(other))) {
        (Ok(place), Ok(other)) => place == other,
        (Err(error), _) => !is_nowhere(&error),
        (_, Err(_)) => false,
    }
}

/// Whether two names lead to the same file, as far as the system tells.
pub fn leads_to_same(a: &Path, b: &Path) -> bool {
    a == b || matches!((real_place(a), real_place(b)), (Ok(a), Ok(b)) if a == b)
}

/// Sees that nothing is replaced by what is not a picture or a report of one: those are made anew again and again, a
/// scene is written once.
///
/// # Errors
/// When something of that name is there, and `force` does not allow to replace it; when the system does not tell.
pub fn spare(path: &Path, force: bool) -> Result<(), WriteError> {
    match path.symlink_metadata() {
        _ if force => Ok(()),
        Ok(found) if found.is_file() || found.is_symlink() => Err(WriteError::There { path: path.to_owned() }),
        Err(error) if !is_nowhere(&error) => Err(io_error(path, error)),
        _ => Ok(()),
    }
}

/// Whether a name leads to nothing.
fn is_nowhere(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory)
}

/// What a name stands for.
enum Target {
    /// A regular file, links followed; there may be none yet.
    File(PathBuf),
    /// Something else that can be written.
    Device,
}

impl Target {
    fn new(path: &Path) -> Result<Self, WriteError> {
        let owned = || path.to_owned();
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => Err(WriteError::Folder { path: owned() }),
            Ok(found) if !found.is_file() => Ok(Target::Device),
            Ok(found) if found.permissions().readonly() => Err(WriteError::ReadOnly { path: owned() }),
            Ok(_) => fs::canonicalize(path).map(Target::File).map_err(|why| io_error(path, why)),
            Err(error) if is_nowhere(&error) => {
                let ends_as_folder = path.as_os_str().as_encoded_bytes().last().is_some_and(|&b| b == b'/');
                let folder = if ends_as_folder { path } else { folder_of(path) };
                match fs::metadata(folder) {
                    Ok(found) if found.is_dir() => Ok(Target::File(owned())),
                    Err(why) if !is_nowhere(&why) => Err(io_error(path, why)),
                    _ => Err(WriteError::NoFolder { path: owned(), folder: folder.to_owned() }),
                }
            }
            Err(why) => Err(io_error(path, why)),
        }
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn write_device(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = OpenOptions::new().write(true).open(path)?;
    file.write_all(bytes)?;
    file.flush()
}

fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut unfinished = Unfinished::beside(path)?;
    unfinished.file.write_all(bytes)?;
    match fs::metadata(path) {
        Ok(old) => unfinished.file.set_permissions(old.permissions())?,
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        // What nobody else may read must not become what all may.
        Err(error) => return Err(error),
    }
    unfinished.file.sync_all()?;
    unfinished.become_file(path)?;
    // The name is on the disk only when the folder is; not all systems can do this, and the file is there without it.
    let _ = File::open(folder_of(path)).and_then(|folder| folder.sync_all());
    Ok(())
}

/// A file under another name than it will have; deleted when dropped.
struct Unfinished {
    file: File,
    path: PathBuf,
}

impl Unfinished {
    /// A new, empty file in the same folder.
    fn beside(path: &Path) -> io::Result<Self> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        loop {
            let count = COUNT.fetch_add(1, Ordering::Relaxed);
            let other = folder_of(path).join(format!(".tracer-{}-{count}.tmp", std::process::id()));
            match OpenOptions::new().write(true).create_new(true).open(&other) {
                Ok(file) => {
                    unfinished().push(other.clone());
                    return Ok(Unfinished { file, path: other });
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
                Err(error) => return Err(error),
            }
        }
    }

    fn become_file(self, path: &Path) -> io::Result<()> {
        fs::rename(&self.path, path)
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        let mut unfinished = unfinished();
        // After a rename there is nothing of that name any more.
        let _ = fs::remove_file(&self.path);
        unfinished.retain(|path| *path != self.path);
    }
}
