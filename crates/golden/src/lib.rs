//! Expected pictures, kept beside scenes: whether a new one is the same but for noise, and how that is told.
//!
//! Nothing here renders or develops: `tracer golden` does, and so does the test of this repository's own pictures. What
//! is here is the judgement ([`noise`]), the files of a folder of expected pictures ([`settings`], [`stored`],
//! [`folder`], [`log`]) and what is told of a run ([`outputs`]).

#![forbid(unsafe_code)]

pub mod folder;
pub mod log;
pub mod measured;
pub mod noise;
pub mod outcome;
pub mod outputs;
pub mod picture;
pub mod settings;
pub mod stored;
