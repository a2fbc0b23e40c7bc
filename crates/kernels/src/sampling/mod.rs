//! Where random choices come from ([`sampler`]) and how they become directions and points (`warp`), and which pixels
//! share them (`blocks`).

pub mod blocks;
pub mod sampler;
pub mod sobol;
pub mod warp;
