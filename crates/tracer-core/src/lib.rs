//! x
pub mod bvh;
