//! Where random choices come from ([`sampler`]) and how they become directions and points (`warp`), and which pixels share them (`blocks`).

pub(crate) mod blocks;
pub mod sampler;
pub(crate) mod sobol;
pub(crate) mod warp;
