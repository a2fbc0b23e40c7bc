//! tracer as a module of Python, `tracer._native`: what the package in `tracer/` is built on. Scenes go in as text or
//! path with what they name in memory, pictures come out as bytes.
//!
//! There are two functions of the module, made by hand: pyo3's macros would ask other features of what the kernels'
//! dependencies are compiled with, and the kernels, which take minutes, would be compiled twice.
#![deny(unsafe_code)]
// A test program is no module of Python, and finds none of its functions.

#[cfg(not(test))]
mod arrays;
#[cfg(not(test))]
mod attended;
#[cfg(not(test))]
mod entry;
#[cfg(not(test))]
mod picture;
#[cfg(not(test))]
mod rendering;
#[cfg(not(test))]
mod request;
#[cfg(not(test))]
mod scene;

#[cfg(not(test))]
pub use entry::PyInit__native;
