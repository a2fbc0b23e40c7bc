//! Any bytes as a scene in RON: `cargo +nightly fuzz run ron` in `crates/scene-format`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use scene_format::render::{Style, json_lines, text};
use scene_format::{LoadError, Syntax, convert, hash, load_str};
use std::path::Path;

fuzz_target!(|source: &str| {
    match load_str("fuzz", source, Syntax::Ron, Path::new(""), &[]) {
        Ok(loaded) => {
            let converted = convert("fuzz", source, Syntax::Ron, Syntax::Toml).expect("what loads can be converted");
            let back = load_str("converted", &converted, Syntax::Toml, Path::new(""), &[]).expect("what is written \
             loads");
            assert_eq!(hash(&back.scene), hash(&loaded.scene), "{converted}");
        }
        Err(LoadError::Invalid { diagnostics, sources, .. }) => {
            text(&diagnostics, &sources, Style::default());
            json_lines(&diagnostics, &sources);
        }
        Err(error) => panic!("{error}"),
    }
});
