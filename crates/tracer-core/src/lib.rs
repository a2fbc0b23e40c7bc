//! x
pub mod mesh;
pub mod texture;
