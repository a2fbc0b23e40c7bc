//! Any text as an argument of `--set`: `cargo +nightly fuzz run set` in `crates/scene-format`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use scene_format::render::{Style, text};
use scene_format::{LoadError, Override, Syntax, load_str};
use std::path::Path;

const SCENE: &str = include_str!("../../tests/common/full.ron");

fuzz_target!(|argument: &str| {
    let sets = [Override::from(argument)];
    if let Err(LoadError::Invalid { diagnostics, sources, .. }) =
        load_str("fuzz", SCENE, Syntax::Ron, Path::new(""), &sets)
    {
        text(&diagnostics, &sources, Style::default());
    }
});
