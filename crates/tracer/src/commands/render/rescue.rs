//! Pictures whose place is gone when they are done: hours of work are not lost for a folder.

use super::outputs::name;
use crate::shell::Shell;
use crate::write::{Place, WriteError, Written};
use std::fs;
use std::path::{Path, PathBuf};

/// A picture that was written, and where.
pub struct Rescued {
    pub written: Written,
    /// As in the report.
    pub name: String,
    /// It is not where it was asked for.
    pub elsewhere: bool,
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
