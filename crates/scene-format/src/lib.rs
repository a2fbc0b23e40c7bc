//! The words of the scene language: what a person writes, read with positions, checked, and given as a [`SceneDesc`].
//!
//! This crate knows the language (its three syntaxes, defaults, ranges, names) and nothing of rays, threads or
//! printing.
//!
//! The way of a scene file: text → tape of spanned nodes (`tree`, by `syntax`) → `--set` edits (`overrides`) → checked
//! reader (`read`, going by the schema that the macros of `words` make from the types in [`desc`]) → [`SceneDesc`] or
//! all its faults as [`Diagnostic`]s, which [`render`] turns into text.
//!
//! A program that makes scenes builds a [`SceneDesc`], and writes it in any syntax; what is written says the same
//! when it is read:
//!
//! ```
//! use scene_format::desc::{Background, Camera, Material, MaterialRef, Mirror, Name, Object, Placements, Sphere};
//! use scene_format::{Defaults, SceneDesc, Syntax, load_str, to_text};
//! use std::path::Path;
//!
//! let mirror = Material::Mirror(Mirror { reflectance: [0.9; 3].into() });
//! let ball = Sphere {
//!     center: [0.0, 1.0, 0.0].into(),
//!     radius: 1.0.into(),
//!     material: MaterialRef::Inline(Box::new(mirror.into())),
//!     transform: Vec::new(),
//!     placements: Placements::One,
//!     camera_visible: true,
//!     name: Name::from(Some("ball")),
//! };
//! let scene = SceneDesc {
//!     camera: Camera { fov: 30.0.into(), ..Camera::default() },
//!     background: Background::Color([0.5, 0.6, 0.8]),
//!     objects: vec![Object::from(ball).into()],
//!     ..SceneDesc::default()
//! };
//! for syntax in Syntax::ALL {
//!     let text = to_text(&scene, syntax, Defaults::Hidden);
//!     let back = load_str("ball", &text, syntax, Path::new(""), &[])?.scene;
//!     assert_eq!(back.objects, scene.objects);
//! }
//!
//! // The same by serde, with `serde_json`, `ron`, `toml` or any other crate whose format says itself what it holds.
//! let json = serde_json::to_string(&scene)?;
//! assert!(json.contains(r#""objects":[{"Sphere":{"center":[0.0,1.0,0.0],"radius":1.0"#));
//! let back: SceneDesc = serde_json::from_str(&json)?;
//! assert_eq!(back, scene);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

pub mod analysis;
mod changes;
pub mod codes;
mod convert;
mod css_colors;
pub mod desc;
mod deserialize;
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
mod mend;
mod mentioned;
mod nameless;
mod overrides;
pub mod path;
pub mod plane;
mod print;
mod read;
mod reference;
pub mod render;
mod schema;
mod serde_types;
mod serialize;
mod suggest;
mod syntax;
mod tape;
mod tree;
mod words;
mod write;
mod written;

pub use changes::Change;
pub use codes::explain;
pub use convert::{comments, convert, format, is_library};
pub use desc::SceneDesc;
pub use diagnostic::{Diagnostic, Diagnostics, Severity};
pub use edit::{Viewpoint, ViewpointError, write_viewpoint};
pub use examples::{Example, ExampleFile, examples};
pub use explain::{explain_word, words};
pub use files::{FileKind, MAX_FILE_BYTES, NamedFile, plain_path};
pub use json_schema::schema;
pub use load::{LoadError, Loaded, load, load_bytes, load_str, load_with};
pub use mend::{Mended, mend};
pub use mentioned::mentioned_in;
pub use overrides::Override;
pub use reference::{diagnostics_reference, reference};
pub use suggest::nearest;
pub use syntax::Syntax;
pub use write::{Defaults, hash, hash_hex, to_json, to_ron, to_text, to_toml};
