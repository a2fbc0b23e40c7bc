//! Pictures whose place is gone when they are done: hours of work are not lost for a folder.

use super::outputs::{Output, name};
use crate::failure::Failure;
use crate::report::FileReport;
use crate::shell::Shell;
use crate::write::{Place, Provenance, WriteError, Written, write};
use std::fs;
use std::path::{Path, PathBuf};
use tracer_core::Image;

/// A picture that was written, and where.
pub struct Rescued {
    pub written: Written,
    /// As in the report.
    pub name: String,
    /// It is not where it was asked for.
    pub elsewhere: bool,
}

/// What became of all pictures.
#[derive(Default)]
pub struct Pictures {
    pub files: Vec<FileReport>,
    /// One is not where it was asked for.
    pub failed: bool,
}

/// Writes a picture to all its places. One that cannot be written is told, and keeps no other from its place.
///
/// # Errors
/// When the reader of standard output is gone.
pub fn pictures(
    outputs: &[Output],
    image: &Image,
    provenance: &Provenance,
    shell: &Shell,
) -> Result<Pictures, Failure> {
    let mut pictures = Pictures::default();
    let mut closed = Ok(());
    for Output { place, encoding } in outputs {
        match rescue(place, shell, |place| write(image, *encoding, place, provenance)) {
            Ok(Rescued { written, name: path, elsewhere }) => {
                pictures.failed |= elsewhere;
                let Written { bytes, sha256 } = written;
                pictures.files.push(FileReport { path, format: encoding.name(), bytes, sha256 });
            }
            Err(error) if error.is_broken_pipe() => closed = Err(error.into()),
            Err(error) => {
                shell.error(&error.into());
                pictures.failed = true;
            }
        }
    }
    closed.map(|()| pictures)
}

/// Writes a picture: into a folder that is made again if it is gone, else to the system's temporary folder. Either is
/// said aloud.
///
/// # Errors
/// Why it could not be written at its place, if it could not be written elsewhere either.
pub fn rescue(
    place: &Place,
    shell: &Shell,
    write: impl Fn(&Place) -> Result<Written, WriteError>,
) -> Result<Rescued, WriteError> {
    let there = |written| Rescued { written, name: name(place), elsewhere: false };
    let mut error = match write(place) {
        Ok(written) => return Ok(there(written)),
        Err(error) => error,
    };
    if let WriteError::NoFolder { path, folder } = &error
        && fs::create_dir_all(folder).is_ok()
    {
        shell.say(&format!("the folder of {} was gone: it is made again", path.display()));
        match write(place) {
            Ok(written) => return Ok(there(written)),
            Err(second) => error = second,
        }
    }
    let Place::File(path) = place else { return Err(error) };
    // Not what is a device or a pipe: nobody looks for a file then.
    if path.exists() && !path.is_file() {
        return Err(error);
    }
    let other = Place::File(elsewhere(path));
    let Ok(written) = write(&other) else { return Err(error) };
    shell.say(&format!("warning: {error}; the picture is in {}", name(&other)));
    Ok(Rescued { written, name: name(&other), elsewhere: true })
}

/// A name of this process in the temporary folder.
fn elsewhere(path: &Path) -> PathBuf {
    let part = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let name = format!("{}-{}.{}", part(path.file_stem()), std::process::id(), part(path.extension()));
    std::env::temp_dir().join(name)
}
