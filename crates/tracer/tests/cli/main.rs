//! The program `tracer`, run as a person runs it: exit codes, messages, files.

mod alpha;
mod cache;
mod checkpoint;
mod commands;
mod compare;
mod denoise;
mod examples;
#[cfg(unix)]
mod farm;
mod faults;
mod fmt;
mod frames;
mod goals;
mod golden;
mod habits;
mod height_field;
mod inspect;
mod integrators;
#[cfg(unix)]
mod interrupt;
#[cfg(unix)]
mod kubernetes;
mod layers;
mod light_groups;
mod marks;
mod mattes;
mod mistaken;
mod motion;
mod named;
mod parts;
mod render;
mod report;
mod repro;
mod support;
mod teaching;
#[cfg(unix)]
mod terminal;
mod tutorial;
mod unmeant;
mod unseen;
