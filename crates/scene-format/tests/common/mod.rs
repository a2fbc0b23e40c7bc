//! What the tests of this crate share: scenes that use every word of the language, and a small generator of random
//! numbers.
#![allow(dead_code, reason = "each test file uses its part")]

pub mod generated;
mod lights;
mod solid;
mod textures;
pub mod threads;

use scene_format::{Diagnostic, LoadError, Loaded, Severity, Syntax, load_str};
use std::path::Path;

/// A scene with every field and kind, in RON.
pub const FULL_RON: &str = include_str!("full.ron");
/// The same scene in TOML.
pub const FULL_TOML: &str = include_str!("full.toml");

/// The same scene in JSON.
pub const FULL_JSON: &str = include_str!("full.json");
/// All three.
pub const FULL: [(&str, Syntax); 3] = [(FULL_RON, Syntax::Ron), (FULL_TOML, Syntax::Toml), (FULL_JSON, Syntax::Json)];

/// Where the files lie that examples include.
pub fn base_dir() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src"))
}

/// Loads a text; the diagnostics are errors and warnings, or warnings alone.
pub fn load(text: &str, syntax: Syntax) -> Result<Loaded, LoadError> {
    load_str("scene", text, syntax, base_dir(), &[])
}

/// All diagnostics of a text.
pub fn diagnostics(text: &str, syntax: Syntax) -> Vec<Diagnostic> {
    match load(text, syntax) {
        Ok(loaded) => loaded.warnings,
        Err(LoadError::Invalid { diagnostics, .. }) => diagnostics,
        Err(error) => panic!("a text cannot be unreadable: {error}"),
    }
}

/// The errors of a text, without warnings.
pub fn errors(text: &str, syntax: Syntax) -> Vec<Diagnostic> {
    let mut all = diagnostics(text, syntax);
    all.retain(|diagnostic| diagnostic.severity == Severity::Error);
    all
}

/// SplitMix64 (Steele, Lea, Flood 2014): enough for tests, the same on every machine.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// 0 to `count - 1`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    /// 0 to 1.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn pick<'t, T>(&mut self, items: &'t [T]) -> &'t T {
        &items[self.below(items.len())]
    }
}
