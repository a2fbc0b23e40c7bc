//! Where random choices come from ([`sampler`]) and how they become directions and points (`warp`).

pub mod sampler;
pub(crate) mod sobol;
pub(crate) mod warp;
