//! The program `tracer`.
fn main() {}
