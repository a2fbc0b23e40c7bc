//! Proofs that the picture is right: the engine against the reference tracer, against formulas, and against itself.
//!
//! `TRACER_PROOFS=long` gives the statistical ones 16 times the samples.

// What a proof expects reaches no picture: it may be computed by std.
#![allow(clippy::disallowed_methods)]

mod adaptive;
mod aimed;
mod amounts;
mod analytic;
mod backdrop;
mod cameras;
mod caustics;
mod clamp;
mod compiling;
mod convergence;
mod coplanar;
mod curved;
mod direct;
mod distances;
mod environment;
mod figures;
mod glints;
mod glow;
mod hidden;
mod inspect;
mod integrators;
mod layers;
mod light_groups;
mod marks;
mod materials_of_meshes;
mod matrix;
mod mattes;
mod metals;
mod motion;
mod noise;
mod overlapping_lamps;
mod patterns;
mod planes;
mod random_scenes;
mod range;
mod reuse;
mod same_bytes;
mod sampler;
mod seams;
mod sequence;
mod shared_roulette;
mod shining;
mod shining_curved;
mod shining_solids;
mod sky;
mod solids;
mod suns;
mod support;
mod surfaces;
mod textures;
mod touching_solids;
mod varying;
mod vertex_color;
