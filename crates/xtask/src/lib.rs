//! Programs that make what the repository holds, and those that try it: [`mutants`] its tests, [`truth`],
//! [`sweeps`] and [`mod@denoise`] its pictures, [`instructions`] its hot paths, [`layers`] its source, [`site`] its
//! manual, [`musl`] the program that needs nothing else, [`prove`] all that takes longer. [`cat`] and [`gallery`] are
//! pure functions from nothing to files: no randomness, no network.

#![forbid(unsafe_code)]

pub mod cat;
pub mod denoise;
mod file;
pub mod gallery;
pub mod instructions;
pub mod layers;
pub mod musl;
pub mod mutants;
pub mod noise;
pub mod picture;
pub mod prove;
pub mod schema;
pub mod site;
pub mod sweeps;
pub mod truth;

pub use file::File;
