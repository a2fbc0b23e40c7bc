//! `tracer preview`: a picture in the browser, or in the terminal, that follows its scene file.
//!
//! Five parts, each in a file of its own, that meet in `shared::Shared` and nowhere else:
//!
//! - the **watch** (`watch.rs`) looks at all files that the scene uses and orders a new picture when one has changed;
//! - the **studio** (`studio.rs`), one thread, loads, compiles and renders, and ends early when there is a new order;
//! - the **server** (`server.rs`, `guard.rs`, `answers/`) gives one page, in this program, and what the page asks
//!   for: the state,
//!   pictures, pixels;
//! - the **page** (`page/`) draws them. It asks again and again: a request waits until there is something new;
//! - the **terminal** (`terminal/`) is in place of the last two where there is no browser.
//!
//! Pictures are developed here, by the code that writes files, so that the page shows the bytes that a PNG has. What
//! this crate cannot do itself, writing files, comes from its caller as a [`Host`].
#![forbid(unsafe_code)]

mod answers;
mod camera;
mod editor;
mod files;
mod guard;
mod layers;
mod options;
mod picture;
mod pixel;
mod server;
mod shared;
mod studio;
#[cfg(unix)]
pub mod terminal;
mod told;
mod watch;
mod work;

pub use editor::Editor;
pub use layers::colours as layer_colours;
pub use options::{Host, Kind, Listen, Options};
pub use server::{Preview, StartError};
