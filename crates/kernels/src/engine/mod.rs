//! Batches of paths and the stages that they go through, over lanes. Who calls the stages in which order is for
//! `tracer-core`.

pub mod batch;
pub mod glow;
pub mod guide;
// The unit tests do without them: they take most of the crate's time to compile.
#[cfg(not(test))]
#[allow(unsafe_code)]
pub mod kernels;
mod lane_io;
pub mod light_paths;
mod pages;
pub mod pass;
pub mod pool;
#[cfg_attr(test, allow(dead_code))]
mod stages;
pub mod told;
pub mod watch;

pub use stages::camera::{along_axis, density};
pub use stages::deposit::deposit;
pub use stages::light_paths::LightPass;
pub use stages::planes::{planes_closest, planes_hide, planes_occluded};
pub use stages::shade::ROULETTE_FROM;
pub use stages::shaft::Obstacles;
pub(crate) use stages::{cameras::depth, lights, materials::Bsdf, surface::Surface};
