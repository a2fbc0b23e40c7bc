//! Open Image Denoise 2 (<https://www.openimagedenoise.org>), loaded while the program runs where the machine has it:
//! nothing of it is needed to build tracer, and nothing of it comes with tracer.
//!
//! It filters by a neural network, on the processor here, since that is the device that every machine has. What comes
//! of it is its own business: it may differ between its versions and between processors.

#![deny(unsafe_code)]
#![warn(clippy::undocumented_unsafe_blocks)]

mod find;
#[allow(unsafe_code)]
mod library;
mod picture;

pub use find::{NAMED_BY, NotFound};
pub use library::Fault;
pub use picture::Picture;

use library::Device;
use std::path::{Path, PathBuf};

/// The library, ready to filter.
pub struct Oidn {
    device: Device,
    file: PathBuf,
}

impl Oidn {
    /// Loads it: from the file, or the folder, that [`NAMED_BY`] names in the environment; else by the system's loader.
    /// It uses that many threads, or as many as it likes for 0.
    ///
    /// # Errors
    /// When it is not there, or is not what is needed: what was looked for, and why that will not do.
    pub fn from_environment(threads: usize) -> Result<Self, NotFound> {
        let named = std::env::var_os(NAMED_BY).filter(|named| !named.is_empty());
        Oidn::find(named.as_deref().map(Path::new), threads)
    }

    /// The same, with the file or the folder as an argument.
    ///
    /// # Errors
    /// As of [`Oidn::from_environment`].
    pub fn find(named: Option<&Path>, threads: usize) -> Result<Self, NotFound> {
        let (file, functions) = find::find(named)?;
        let device = Device::new(functions, threads);
        let device = device.map_err(|why| NotFound::Useless { file: file.clone(), why: why.to_string() })?;
        Ok(Oidn { device, file })
    }

    /// What it is called: `Open Image Denoise 2.3.0`.
    pub fn name(&self) -> String {
        let [major, minor, patch] = self.device.version();
        format!("Open Image Denoise {major}.{minor}.{patch}")
    }

    /// The file that it was loaded from, as it was asked for.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The picture with less noise: linear RGB, rows from the top.
    ///
    /// # Errors
    /// When an array does not have the size that the picture tells; what the library says that went wrong, as that
    /// there is too little memory.
    pub fn denoise(&self, picture: &Picture<'_>) -> Result<Vec<f32>, Fault> {
        self.device.denoise(picture)
    }
}

impl std::fmt::Debug for Oidn {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        to.debug_struct("Oidn").field("name", &self.name()).field("file", &self.file).finish()
    }
}
