//! The committed files are what the programs make.

use std::path::Path;
use xtask::File;

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn cat() {
    assert_committed(xtask::cat::files().unwrap(), "cat");
}

#[test]
fn gallery() {
    assert_committed(xtask::gallery::files().unwrap(), "gallery");
}

fn assert_committed(files: Vec<File>, subcommand: &str) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for file in files {
        let committed = std::fs::read(root.join(file.path)).unwrap_or_else(|error| panic!("{}: {error}", file.path));
        // Another version of the encoder may pack the same picture otherwise.
        let same = if file.path.ends_with(".png") {
            pixels(&committed) == pixels(&file.bytes)
        } else {
            committed == file.bytes
        };
        assert!(
            same,
            "{} is not what the program makes: run `cargo xtask {subcommand}`, look at it, commit it",
            file.path
        );
    }
}

fn pixels(png: &[u8]) -> Vec<u8> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    pixels
}
