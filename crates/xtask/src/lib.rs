//! Programs that make what the repository holds. Each is a pure function from nothing to files: no randomness, no network.

pub mod cat;
