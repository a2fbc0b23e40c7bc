//! `cargo xtask SUBCOMMAND`: makes files that the repository holds.

use anyhow::Context as _;
use clap::Parser;
use std::path::{Path, PathBuf};

/// Makes files that the repository holds.
#[derive(Parser)]
enum Command {
    /// The cat: assets/cat.obj, cat_60k.obj, cat.off, cat.mtl, cat.png.
    Cat,
}

fn main() -> anyhow::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    match Command::parse() {
        Command::Cat => write_all(&root.join("assets"), xtask::cat::files()?),
    }
}

fn write_all(folder: &Path, files: Vec<xtask::cat::File>) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    for file in files {
        let path: PathBuf = folder.join(file.name);
        std::fs::write(&path, &file.bytes).with_context(|| format!("cannot write {}", path.display()))?;
        println!("{:>9} bytes  {}", file.bytes.len(), file.name);
    }
    Ok(())
}
