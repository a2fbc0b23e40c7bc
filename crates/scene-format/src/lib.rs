//! The words of the scene language: what a person writes, read with positions, checked, and given as a [`SceneDesc`].
//!
//! This crate knows the language (both syntaxes, defaults, ranges, names) and nothing of rays, threads or printing.
#![forbid(unsafe_code)]

pub mod desc;
pub mod diagnostic;

pub use desc::SceneDesc;
pub use diagnostic::{Diagnostic, Diagnostics, Severity};
