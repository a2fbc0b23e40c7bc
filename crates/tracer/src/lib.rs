//! The command line of tracer, and its fifth hand: [`write()`] puts a developed picture into a file.
#![forbid(unsafe_code)]

pub mod write;

pub use write::write;
