//! What is kept from one run of a program to the next: meshes as they were read, trees as they were built.
//!
//! Where files lie, and how many, is for the program to know ([`Store`]); what stands in them, for this. Meshes go by
//! the contents of their file, trees by all that they are built of, both by the program's version: nothing that is
//! found can be out of date, and where it lies in the world does not count.

mod file;
mod mesh;
mod stamp;
mod tree;

pub use file::{KeptError, KeptFile, KeptKind, is_kept_file};
pub use stamp::Stamp;
pub(super) use {mesh::load_mesh, tree::build_tree};

use crate::film::PROGRAM;
use std::fs::File;
use std::io::{self, Write};
use std::path::Path;
use xxhash_rust::xxh3::Xxh3;

/// SHA-256 of a file's contents.
pub type ContentHash = [u8; 32];

/// Puts the bytes of a file where it is told to.
pub type Fill = Box<dyn FnOnce(&mut dyn Write) -> io::Result<u64> + Send>;

/// A folder of a program's where meshes and trees are kept ([`compile_storing`](crate::compile_storing)).
pub trait Store: std::fmt::Debug + Send + Sync {
    /// The hash of a file that was recorded, if the file is surely as it was then.
    fn recorded(&self, path: &Path) -> Option<ContentHash>;

    /// Records the hash of a file that was read after it had this stamp.
    fn record(&self, path: &Path, stamp: &Stamp, hash: &ContentHash);

    /// The file of this name, if there is one.
    fn open(&self, name: &str) -> Option<File>;

    /// Keeps a file of so many bytes under this name, in place of one that is there: whole or not at all, now or soon.
    fn keep(&self, name: &str, bytes: u64, fill: Fill);

    /// What became of one that was looked for.
    fn told(&self, told: Told<'_>);
}

/// What became of a mesh or a tree that was looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Told<'a> {
    /// It was there.
    Taken {
        /// What it is.
        what: &'a str,
        /// The size of its file.
        bytes: u64,
    },
    /// It was not there, or of other files.
    Missing {
        /// What it is.
        what: &'a str,
    },
    /// It is damaged, and is made anew.
    Broken {
        /// The name of the file.
        name: &'a str,
        /// What is wrong with it.
        why: &'a str,
    },
}

/// What a file is known by.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Key {
    kind: KeptKind,
    hash: u128,
}

impl Key {
    /// Of all that it is made of; so is the program.
    fn new(kind: KeptKind, of: &[&[u8]]) -> Self {
        let mut hash = Xxh3::new();
        for piece in of.iter().copied().chain([PROGRAM.as_bytes()]) {
            hash.update(&(piece.len() as u64).to_le_bytes());
            hash.update(piece);
        }
        Key { kind, hash: hash.digest128() }
    }

    fn name(&self) -> String {
        format!("{}-{:032x}.kept", self.kind.name(), self.hash)
    }
}

#[cfg(test)]
mod tests;
