//! What files held when they were read, by their hashes: so that nothing is hashed at every start.

use crate::write::{WriteError, save, sha256};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use tracer_core::{ContentHash, Stamp};

/// How a record begins.
const FIRST: &str = "tracer hash 1";
/// A record is no longer: a path and a few numbers.
const MOST_BYTES: u64 = 1 << 16;

/// Where the record of a file lies, and its whole name.
fn place(folder: &Path, path: &Path) -> Option<(PathBuf, PathBuf)> {
    let whole = fs::canonicalize(path).ok()?;
    let number = sha256(whole.as_os_str().as_encoded_bytes());
    Some((folder.join(format!("hash-{}.kept", number.get(..32)?)), whole))
}

/// What a record says before the hash.
fn head(whole: &Path, stamp: &Stamp) -> String {
    format!("{FIRST}\n{}\n{stamp}\n", whole.display())
}

/// The file whose hash a record tells; `None` where this is no record.
pub fn subject(record: &Path) -> Option<String> {
    let mut start = [0; FIRST.len()];
    let mut file = Some(record).filter(|record| record.is_file()).and_then(|record| File::open(record).ok())?;
    file.read_exact(&mut start).ok().filter(|()| start == *FIRST.as_bytes())?;
    let mut rest = String::new();
    file.take(MOST_BYTES).read_to_string(&mut rest).ok()?;
    rest.lines().nth(1).map(str::to_owned)
}

/// The hash that a file had when it was recorded, if it is as it was then.
pub fn find(folder: &Path, path: &Path) -> Option<ContentHash> {
    let (place, whole) = place(folder, path)?;
    let mut text = String::new();
    File::open(place).ok()?.take(MOST_BYTES).read_to_string(&mut text).ok()?;
    let (told, sum) = text.trim_end_matches('\n').rsplit_once('\n')?;
    let digits = told.strip_prefix(&head(&whole, &Stamp::of(path).ok()?)).filter(|_| sha256(told.as_bytes()) == sum)?;
    from_hex(digits)
}

/// The record of a file that was read after it had this stamp: where it lies, and what it says. `None` where it may
/// have changed since without a sign of it.
pub fn of(folder: &Path, path: &Path, stamp: &Stamp, hash: &ContentHash) -> Option<(PathBuf, String)> {
    let is_as_it_was = stamp.is_settled(stamp.seen) && Stamp::of(path).is_ok_and(|now| now.is_same(stamp));
    let (place, whole) = place(folder, path).filter(|_| is_as_it_was)?;
    let told = head(&whole, stamp) + &to_hex(hash);
    let sum = sha256(told.as_bytes());
    Some((place, format!("{told}\n{sum}\n")))
}

/// Writes a record, whole or not at all.
pub fn write(place: &Path, text: &[u8]) -> io::Result<()> {
    save(place, text).map_err(|error| match error {
        WriteError::Io { why, .. } => why,
        other => io::Error::other(other.to_string()),
    })
}

/// Two digits a byte.
pub fn to_hex(hash: &ContentHash) -> String {
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The hash that [`to_hex`] has written.
pub fn from_hex(digits: &str) -> Option<ContentHash> {
    let mut hash = ContentHash::default();
    if digits.len() != 2 * hash.len() || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    for (byte, digits) in hash.iter_mut().zip(digits.as_bytes().chunks(2)) {
        *byte = u8::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()?;
    }
    Some(hash)
}
