//! How much two pictures differ.

mod false_colours;
pub mod flip;
mod metrics;
mod picture;

pub use false_colours::{false_colours, magma};
pub use metrics::{Difference, Metric, Place, difference};
pub use picture::{Kind, Picture, PictureError, before_checkerboard};
