//! Twenty scenes of `cargo xtask truth`: the default picture is right in scenes that nobody thought of.

use xtask::truth::{Options, run};

#[test]
fn twenty_random_scenes() {
    let keep = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("truth");
    let options =
        Options { scenes: 20, seed: 0, size: 128, keep, jobs: 0, shrink: 0, kind: String::new(), itself: false };
    let failing = run(&options).unwrap_or_else(|error| panic!("{error:?}"));
    assert_eq!(failing, 0, "scenes with findings; what was measured is printed above");
}
