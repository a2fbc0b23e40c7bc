//! The words of the scene language: what a person writes, read with positions, checked, and given as a [`SceneDesc`].
//!
//! This crate knows the language (its three syntaxes, defaults, ranges, names) and nothing of rays, threads or printing.
//!
//! The way of a scene file: text → tape of spanned nodes (`tree`, by `syntax`) → `--set` edits (`overrides`) → checked reader
//! (`read`, going by the schema that the macros of `words` make from the types in [`desc`]) → [`SceneDesc`] or all its faults as
//! [`Diagnostic`]s, which [`render`] turns into text.
#![forbid(unsafe_code)]

pub mod analysis;
pub mod codes;
mod convert;
pub mod desc;
pub mod diagnostic;
mod edit;
mod examples;
mod explain;
mod expression;
mod files;
mod follow_ups;
mod form;
mod include;
mod json_schema;
mod load;
mod overrides;
mod print;
mod read;
mod reference;
pub mod render;
mod schema;
mod suggest;
mod syntax;
mod tape;
mod tree;
mod words;
mod write;

pub use codes::explain;
pub use convert::{comments, convert, format};
pub use desc::SceneDesc;
pub use diagnostic::{Diagnostic, Diagnostics, Severity};
pub use edit::{Viewpoint, ViewpointError, write_viewpoint};
pub use examples::{Example, ExampleFile, examples};
pub use explain::{explain_word, words};
pub use files::{FileKind, MAX_FILE_BYTES, NamedFile};
pub use json_schema::schema;
pub use load::{LoadError, Loaded, load, load_bytes, load_str, load_with};
pub use overrides::Override;
pub use reference::{diagnostics_reference, reference};
pub use suggest::nearest;
pub use syntax::Syntax;
pub use write::{Defaults, hash, hash_hex, to_json, to_ron, to_text, to_toml};
