//! What the engine of tracer reads and does in its inner loops: scene tables, the tree, and shading over lanes,
//! compiled once for each level of vector instructions. A crate of its own because it takes longer to compile than all
//! else together, and changes less often.
//!
//! Programs use `tracer-core`, which shows of this crate what is for them. It knows nothing of the scene language:
//! `tracer-core` compiles descriptions into a [`scene::Scene`].

// What a test expects reaches no picture: it may be computed by std. See clippy.toml.
#![cfg_attr(test, allow(clippy::disallowed_methods))]
// Its documentation is for those who work on it.
#![allow(rustdoc::private_intra_doc_links)]
#![deny(unsafe_code)]
#![warn(clippy::undocumented_unsafe_blocks)]

pub mod bvh;
pub mod engine;
// Private: lanes of a level are safe to use only where the CPU has been seen to have it.
mod lanes;
pub mod layers;
pub mod level;
mod math;
pub mod report;
pub mod sampling;
pub mod scene;
pub mod shapes;
pub mod srgb;
