//! The fifth hand, by its name here: pictures become files (`tracer_picture`).

pub use tracer_picture::*;
