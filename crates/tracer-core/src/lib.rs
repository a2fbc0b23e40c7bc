//! The engine of tracer: a scene description becomes a picture.
//!
//! [`compile`] turns a [`scene_format::SceneDesc`] into a [`Scene`], [`render`] path-traces it into a [`Film`], [`develop`] makes a
//! picture of the film. The picture depends on the scene, the seed and the number of samples, and on nothing else.

pub mod bvh;
mod compile;
mod develop;
mod engine;
mod film;
pub mod lanes;
pub mod math;
pub mod mesh;
pub mod sampling;
pub mod scene;
pub mod texture;

pub use compile::{CompileError, CompileTimes, compile};
pub use develop::{Image, Look, develop, srgb_encode};
pub use engine::{Counters, Observer, Progress, RenderOptions, Unobserved, render};
pub use film::{Crop, Film};
pub use scene::Scene;
