//! `cargo xtask SUBCOMMAND`: makes files that the repository holds, and tries its tests.
#![forbid(unsafe_code)]

use anyhow::Context as _;
use clap::Parser;
use std::path::{Path, PathBuf};

/// Makes files that the repository holds, and tries its tests.
#[derive(Parser)]
enum Command {
    /// The cat: its meshes and texture in assets/.
    Cat,
    /// What the gallery's scenes are furnished with: textures and small meshes in assets/, placements beside the
    /// scenes.
    Gallery,
    /// Measures what denoising does to ten scenes, and prints the table of docs/denoise.md; fails where one becomes
    /// worse.
    Denoise {
        /// Samples per pixel.
        #[arg(long, default_value_t = 16)]
        samples: u32,
        /// Samples of the reference.
        #[arg(long, default_value_t = 1024)]
        reference: u32,
        /// Pixels across and down.
        #[arg(long, num_args = 2, default_values_t = [240, 160])]
        size: Vec<u32>,
        /// Only scenes whose names contain this.
        #[arg(long, default_value = "")]
        name: String,
        /// Scene files instead of the ten.
        files: Vec<std::path::PathBuf>,
    },
    /// Counts the instructions of hot paths by valgrind, and fails where one takes more than it may; some minutes.
    Instructions {
        /// Only paths whose names contain this.
        #[arg(default_value = "")]
        name: String,
        /// Runs one path, as valgrind is told to.
        #[arg(long, hide = true, value_name = "NAME")]
        run: Option<String>,
    },
    /// Shows which room of each crate uses which, and fails where an arrow points upward (crates/xtask/layers.toml).
    Layers,
    /// Seeds faults in a copy of the source, one at a time, and shows which tests notice; fails when one is not
    /// noticed.
    ///
    /// All of them take about an hour on two cores. The copy lies in target/mutants.
    Mutants {
        /// Faults by name; all when none is named.
        names: Vec<String>,
        /// Prints the names and ends.
        #[arg(long)]
        list: bool,
        /// Seconds that the tests of one fault may run.
        #[arg(long, default_value_t = 300)]
        limit: u64,
    },
    /// Runs long proofs: those of CI, or those that are named. Installs what they need on Debian as root; else it says
    /// what is missing.
    Prove {
        /// Proofs by name; those of CI when none is named.
        names: Vec<String>,
        /// All of them.
        #[arg(long, conflicts_with = "names")]
        all: bool,
        /// Prints the names, what each proves and how long it takes, and ends.
        #[arg(long)]
        list: bool,
    },
    /// Writes the JSON Schema into a folder, and scenes that it must take and refuse (`cargo xtask prove schema`).
    SchemaCases {
        /// The folder; what lies in it goes.
        folder: PathBuf,
    },
    /// Makes the program as one static file of less than 16 MB (target/static/tracer), which runs on every Linux.
    ///
    /// Some minutes. It is seen to be static and small, and to make expected pictures byte for byte.
    Musl {
        /// All expected pictures; a few otherwise.
        #[arg(long)]
        all_pictures: bool,
        /// Makes the image of a container with it, too (target/static/image.tar), and renders in it. Needs buildah.
        #[arg(long)]
        container: bool,
    },
    /// Makes the manual as a site (target/site/book), with a picture for every entry of the reference.
    Site,
    /// Draws random scenes and holds the default picture against the truth; fails where one is wrong.
    ///
    /// The truth is the plain path tracer, or another scene that must look the same. Failing scenes are made smaller
    /// and kept with what was
    /// measured. A thousand take an hour or more on two cores.
    Truth {
        /// How many scenes.
        #[arg(long, default_value_t = 20)]
        scenes: usize,
        /// Seed of the first scene; the others follow it.
        #[arg(long, default_value_t = 0)]
        seed: u64,
        /// Pixels along a side, a multiple of 32.
        #[arg(long, default_value_t = 128)]
        size: u32,
        /// Where failing scenes are kept.
        #[arg(long, default_value = "target/truth")]
        keep: PathBuf,
        /// Scenes at a time; 0: one for each core.
        #[arg(long, default_value_t = 0)]
        jobs: usize,
        /// Seconds to make a failing scene smaller; 0 keeps it as it was drawn.
        #[arg(long, default_value_t = 60)]
        shrink: u64,
        /// Only scenes of this kind, as the table at the end names it; only pairs whose names contain this.
        #[arg(long, default_value = "")]
        kind: String,
        /// Holds the plain path tracer against itself: what is found then is a false alarm, or a pair that is none.
        #[arg(long)]
        itself: bool,
        /// Instead of random scenes: the fixed list of exact pairs, with so many pictures of each side.
        #[arg(long)]
        pairs: Option<usize>,
    },
    /// Changes parameters of scenes step by step and shows that neither noise nor mean jumps; fails where one does.
    Sweeps {
        /// Steps of each parameter; films have 24 frames at most.
        #[arg(long, default_value_t = 40)]
        steps: usize,
        /// Pictures of each step, default and plain.
        #[arg(long, default_value_t = 12)]
        pictures: u32,
        /// Samples per pixel.
        #[arg(long, default_value_t = 4)]
        samples: u32,
        /// Pixels along a side.
        #[arg(long, default_value_t = 64)]
        size: u32,
        /// Only sweeps whose names contain this.
        #[arg(long, default_value = "")]
        name: String,
    },
    /// Measures squares in the noise of ten rooms where light is hard to find; fails where one may show.
    Rooms {
        /// Samples per pixel; several are measured one after the other.
        #[arg(long, value_delimiter = ',', default_values_t = [4, 16, 64, 256])]
        samples: Vec<u32>,
        /// Only rooms whose names contain this.
        #[arg(long, default_value = "")]
        name: String,
        /// Pictures of each: more make the bound narrower.
        #[arg(long, default_value_t = xtask::truth::squares::PICTURES)]
        pictures: u32,
    },
}

fn main() -> anyhow::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let files = match Command::parse() {
        Command::Cat => xtask::cat::files()?,
        Command::Gallery => xtask::gallery::files()?,
        Command::Denoise { samples, reference, size, name, files } => {
            let options = xtask::denoise::Options { samples, reference, size: [size[0], size[1]], name, files };
            let worse = xtask::denoise::run(&root, &options)?;
            anyhow::ensure!(worse == 0, "{worse} pictures have become worse");
            return Ok(());
        }
        Command::Instructions { run: Some(name), .. } => return xtask::instructions::run_one(&name),
        Command::Instructions { name, run: None } => return xtask::instructions::run(&name),
        Command::Layers => {
            let findings = xtask::layers::examine(&root, &xtask::layers::Rules::read(&root)?)?;
            print!("{}", xtask::layers::table(&findings));
            anyhow::ensure!(findings.faults.is_empty(), "{}", findings.faults.join("\n"));
            return Ok(());
        }
        Command::Mutants { list: true, .. } => {
            for mutant in xtask::mutants::all() {
                println!("{:45} {}", mutant.name, mutant.file);
            }
            return Ok(());
        }
        Command::Mutants { names, limit, .. } => {
            return xtask::mutants::run(&root, &xtask::mutants::Options { names, limit });
        }
        Command::Prove { list: true, .. } => {
            print!("{}", xtask::prove::list());
            return Ok(());
        }
        Command::Prove { names, all, .. } => return xtask::prove::run(&root, &xtask::prove::chosen(&names, all)?),
        Command::Musl { all_pictures, container } => {
            let root = root.canonicalize()?;
            let program = xtask::musl::run(&root, all_pictures)?;
            if container {
                xtask::musl::image(&root, &program)?;
            }
            return Ok(());
        }
        Command::SchemaCases { folder } => return xtask::schema::run(&root.canonicalize()?, &folder),
        Command::Site => return xtask::site::run(&root.canonicalize()?).map(drop),
        Command::Sweeps { steps, pictures, samples, size, name } => {
            let options = xtask::sweeps::Options { steps, pictures, samples, size, name, only: 0..steps };
            let jumps = xtask::sweeps::run(&options)?;
            anyhow::ensure!(jumps == 0, "{jumps} jumps are too large");
            return Ok(());
        }
        Command::Rooms { samples, name, pictures } => {
            let above = xtask::truth::rooms::run(&samples, &name, pictures)?;
            anyhow::ensure!(above == 0, "{above} upper bounds are above the limit");
            return Ok(());
        }
        Command::Truth { pairs: Some(pictures), kind, itself, .. } => {
            let failing = xtask::truth::pairs::run(pictures, &kind, itself)?;
            anyhow::ensure!(failing == 0, "{failing} pairs differ");
            return Ok(());
        }
        Command::Truth { scenes, seed, size, keep, jobs, shrink, kind, itself, pairs: None } => {
            let options = xtask::truth::Options { scenes, seed, size, keep, jobs, shrink, kind, itself };
            let failing = xtask::truth::run(&options)?;
            anyhow::ensure!(failing == 0, "{failing} of {scenes} scenes have findings");
            return Ok(());
        }
    };
    for file in files {
        let path = root.join(file.path);
        std::fs::write(&path, &file.bytes).with_context(|| format!("cannot write {}", path.display()))?;
        println!("{:>9} bytes  {}", file.bytes.len(), file.path);
    }
    Ok(())
}
