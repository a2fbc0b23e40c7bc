//! What the program gives the preview: what to show, and what it does for it.

use crate::editor::Editor;
use scene_format::{Override, SceneDesc, Syntax};
use std::net::IpAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tracer_core::{Film, Look, Store};

/// What to preview.
#[derive(Clone, Debug)]
pub struct Options {
    /// The scene file.
    pub scene: PathBuf,
    /// Its syntax, where its name does not tell.
    pub syntax: Option<Syntax>,
    /// Fields of the scene set from outside, each time that it is read.
    pub overrides: Vec<Override>,
    /// Samples per pixel in place of the scene's.
    pub samples: Option<u32>,
    /// Width and height in place of the scene's.
    pub size: Option<[u32; 2]>,
    /// Threads that render; 0: one for each core.
    pub threads: usize,
    /// What opens a file at a line; `None`: the page names the place.
    pub editor: Option<Editor>,
}

/// Where the page is given away.
#[derive(Clone, Copy, Debug)]
pub struct Listen {
    /// The address to listen at.
    pub address: IpAddr,
    /// The port; 0: one that is free.
    pub port: u16,
}

/// A kind of file that the page offers to save.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Display values, 8 bits.
    Png,
    /// Linear floats, with the scene's layers.
    Exr,
}

/// What the program does for the preview.
pub trait Host: Send + Sync + 'static {
    /// The bytes of a picture file.
    ///
    /// # Errors
    /// Why there is none, in words for the person.
    fn encode(&self, desc: &SceneDesc, film: &Film, look: &Look, kind: Kind) -> Result<Vec<u8>, String>;

    /// Writes a file, whole or not at all; an older one stays if that fails.
    ///
    /// # Errors
    /// Why it was not written, in words for the person.
    fn save(&self, path: &Path, bytes: &[u8]) -> Result<(), String>;

    /// Bytes of memory that are free, if the system tells.
    fn free_memory(&self) -> Option<u64>;

    /// What is wrong with the scene, for whoever looks elsewhere than at the page; `None`: it is right again.
    fn wrong(&self, _faults: Option<&str>) {}

    /// Where meshes and trees are kept from one run of the program to the next, if anywhere.
    fn store(&self) -> Option<Arc<dyn Store>> {
        None
    }
}
