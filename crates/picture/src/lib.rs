//! The fifth hand: a developed [`Image`] becomes a file, whole or not at all.
//!
//! ```
//! use scene_format::{Syntax, load_str};
//! use std::path::Path;
//! use tracer_core::{RenderOptions, Unobserved, compile, develop, render};
//! use tracer_picture::{Bits, Encoding, Place, Provenance, encode, write};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let text = "Scene(image: Image(width: 16, height: 12), background: 1, \
//!             objects: [Sphere(center: (0, 0, 0), radius: 1)])";
//! let scene = compile(&load_str("ball.ron", text, Syntax::Ron, Path::new(""), &[])?.scene)?;
//! let film = render(&scene, &RenderOptions { samples: Some(2), ..RenderOptions::default() }, &Unobserved);
//! let image = develop(&film, &scene.look);
//! let png = encode(&image, Encoding::Png(Bits::Eight), &Provenance::default())?;
//! assert!(png.starts_with(b"\x89PNG"));
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("ball.exr");
//! let written = write(&image, Encoding::from_path(&path, Bits::Eight)?, &Place::File(path), &Provenance::default())?;
//! assert!(written.bytes > 0 && written.sha256.len() == 64);
//! # Ok(())
//! # }
//! ```
//!
//! EXR, HDR and PFM hold linear exposed radiance; PNG holds display values, rounded to the nearest code value. The
//! bytes depend on the picture and its [`Provenance`] only: no dates, no paths, nothing of the machine. [`told()`]
//! reads what a file tells of itself.
#![forbid(unsafe_code)]

mod encoding;
mod error;
mod exr;
mod hdr;
mod pfm;
mod png;
mod provenance;
mod told;
mod whole_file;

pub use encoding::{Bits, Encoding, UnknownEncoding};
pub use error::{WriteError, advice};
pub use provenance::{Provenance, Setting};
pub use told::{Told, ToldError, told, told_in};
pub use whole_file::{
    OutputKind, forget_unfinished, is_one_file, leads_to_same, probe, real_place, remember_unfinished,
    remove_unfinished, save, spare, spare_other, try_remove_unfinished,
};

use sha2::{Digest, Sha256};
use std::io::Write;
use std::path::PathBuf;
use tracer_core::Image;

/// Where a picture goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A file. It appears whole or not at all, and an older one stays if this one fails.
    File(PathBuf),
    /// Standard output.
    Stdout,
}

/// What was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Bytes of the file.
    pub bytes: u64,
    /// SHA-256 of the file, in hexadecimal.
    pub sha256: String,
}

/// Writes the picture: the fifth hand, [`Image`] to a file.
///
/// # Errors
/// When the place cannot be written: no such folder, no permission, read-only, disk full, the reader of standard output
/// gone.
pub fn write(image: &Image, encoding: Encoding, place: &Place, provenance: &Provenance) -> Result<Written, WriteError> {
    let bytes = encode(image, encoding, provenance)?;
    match place {
        Place::File(path) => save(path, &bytes)?,
        Place::Stdout => {
            let mut out = std::io::stdout().lock();
            out.write_all(&bytes).and_then(|()| out.flush()).map_err(WriteError::Stdout)?;
        }
    }
    Ok(Written { bytes: bytes.len() as u64, sha256: sha256(&bytes) })
}

/// The bytes of the file that [`write()`] makes.
///
/// # Errors
/// When the picture has too few numbers for its size.
pub fn encode(image: &Image, encoding: Encoding, provenance: &Provenance) -> Result<Vec<u8>, WriteError> {
    let numbers = 3 * image.width as usize * image.height as usize;
    if numbers == 0 || image.linear.len() != numbers || image.display.len() != numbers {
        return Err(WriteError::Picture { width: image.width, height: image.height });
    }
    let hidden = Provenance::hidden();
    let provenance = if provenance.is_hidden { &hidden } else { provenance };
    match encoding {
        Encoding::Png(bits) => png::encode(image, bits, provenance),
        Encoding::Exr => exr::encode(image, provenance),
        Encoding::Hdr => Ok(hdr::encode(image, provenance)),
        Encoding::Pfm => Ok(pfm::encode(image)),
    }
}

/// SHA-256 of the bytes, in hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
