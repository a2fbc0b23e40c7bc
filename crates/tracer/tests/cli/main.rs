//! The program `tracer`, run as a person runs it: exit codes, messages, files.

mod alpha;
mod checkpoint;
mod commands;
mod compare;
mod denoise;
mod examples;
mod faults;
mod fmt;
mod goals;
mod golden;
mod habits;
mod height_field;
#[cfg(unix)]
mod interrupt;
mod layers;
mod parts;
mod render;
mod report;
mod support;
mod tutorial;
mod unmeant;
