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
    /// Golden pictures.
    #[command(subcommand)]
    Golden(Golden),
}

/// What can be done with golden pictures.
#[derive(clap::Subcommand)]
enum Golden {
    /// Takes the picture that the last test run made as the golden one.
    Accept {
        /// FAMILY/CASE, as the test names it; several are accepted for the same reason.
        #[arg(required = true)]
        cases: Vec<String>,
        /// Why the picture is right; kept in golden/log.md.
        #[arg(long)]
        reason: String,
    },
}

fn main() -> anyhow::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let files = match Command::parse() {
        Command::Cat => xtask::cat::files()?,
        Command::Gallery => xtask::gallery::files()?,
        Command::Golden(Golden::Accept { cases, reason }) => return xtask::golden::accept(&root, &cases, &reason),
    };
    for file in files {
        let path = root.join(file.path);
        std::fs::write(&path, &file.bytes).with_context(|| format!("cannot write {}", path.display()))?;
        println!("{:>9} bytes  {}", file.bytes.len(), file.path);
    }
    Ok(())
}
