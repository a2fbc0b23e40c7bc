//! The lines of docs/scale.md.

use std::path::Path;

/// The first shell block after a heading.
pub fn block(heading: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scale.md");
    let manual = std::fs::read_to_string(path).expect("the manual");
    let (_, rest) = manual.split_once(heading).unwrap_or_else(|| panic!("{heading} is not in docs/scale.md"));
    let (_, rest) = rest.split_once("```sh\n").expect("a block");
    rest.split_once("```").expect("its end").0.to_owned()
}
