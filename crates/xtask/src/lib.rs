//! Programs that make what the repository holds, and [`mutants`] and [`truth`], which try its tests and its pictures; but for these and [`golden`], each is a pure function from nothing to files: no randomness,
//! no network.

#![forbid(unsafe_code)]

pub mod cat;
pub mod gallery;
pub mod golden;
pub mod mutants;
pub mod noise;
pub mod picture;
pub mod truth;

/// A file to be written.
pub struct File {
    /// Where, from the root of the repository.
    pub path: &'static str,
    /// What it holds.
    pub bytes: Vec<u8>,
}
