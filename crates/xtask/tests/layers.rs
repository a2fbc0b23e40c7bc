//! Arrows between the rooms of the source point one way, functions and lines are short (`crates/xtask/layers.toml`).

use std::path::Path;
use xtask::layers::{Rules, examine};

#[test]
fn the_source_keeps_its_layers() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap();
    let findings = examine(&root, &Rules::read(&root).unwrap()).unwrap();
    assert!(findings.faults.is_empty(), "{}", findings.faults.join("\n"));
    // Nothing was read past: the engine has rooms, and they use each other.
    let arrows = |name: &str| findings.arrows[name].iter().map(|(_, uses)| uses.len()).sum::<usize>();
    let arrows = [arrows("tracer-kernels"), arrows("tracer-core")];
    assert!(arrows[0] > 60 && arrows[1] > 20, "{arrows:?}");
}
