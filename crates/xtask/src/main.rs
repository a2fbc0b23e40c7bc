//! `cargo xtask SUBCOMMAND`: makes files that the repository holds.

use anyhow::Context as _;
use clap::Parser;
use std::path::Path;

/// Makes files that the repository holds.
#[derive(Parser)]
enum Command {
    /// The cat: its meshes and texture in assets/.
    Cat,
    /// What the gallery's scenes are furnished with: textures and small meshes in assets/, placements beside the scenes.
    Gallery,
}

fn main() -> anyhow::Result<()> {
    let files = match Command::parse() {
        Command::Cat => xtask::cat::files()?,
        Command::Gallery => xtask::gallery::files()?,
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for file in files {
        let path = root.join(file.path);
        std::fs::write(&path, &file.bytes).with_context(|| format!("cannot write {}", path.display()))?;
        println!("{:>9} bytes  {}", file.bytes.len(), file.path);
    }
    Ok(())
}
