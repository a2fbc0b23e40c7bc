//! The words of `tracer golden`.

use super::{Size, count, size};
use clap::{Args, Subcommand};
use std::path::PathBuf;

const GOLDEN_EXAMPLES: &str = "\
Examples:
  tracer golden run golden
  tracer golden accept golden lamp --reason \"the lamp is warmer\"

docs/golden.md has all of it, for GitHub Actions too.";

/// `tracer golden`
#[derive(Debug, Args)]
#[command(after_help = GOLDEN_EXAMPLES)]
pub struct GoldenArgs {
    /// What to do.
    #[command(subcommand)]
    pub command: GoldenCommand,
}

/// What to do with expected pictures.
#[derive(Debug, Subcommand)]
pub enum GoldenCommand {
    /// Render the scenes of folders and compare with what is expected
    Run(GoldenRunArgs),
    /// Make what was rendered what is expected, with a reason
    Accept(GoldenAcceptArgs),
    /// Make a folder one of expected pictures
    New(GoldenNewArgs),
}

const RUN_EXAMPLES: &str = "\
Examples:
  tracer golden run golden
  tracer golden run golden rooms --junit golden.xml --html golden.html

Equal bytes pass, and pictures that differ by noise alone.
Exit codes: 0 all pass, 1 a picture fails, 2 no such folder";

/// `tracer golden run`
#[derive(Debug, Args)]
#[command(after_help = RUN_EXAMPLES)]
pub struct GoldenRunArgs {
    /// Folders with a golden.toml
    #[arg(required = true, value_name = "DIR")]
    pub folders: Vec<PathBuf>,
    /// Only the scene of this name (repeatable)
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
    /// Write a page that shows all pictures; `-`: to standard output
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Write XML for CI servers; `-` as above
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Write it as JSON; `-` as above
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Print annotations [default: where GITHUB_ACTIONS is true]
    #[arg(long)]
    pub github: bool,
    /// Threads [default: one per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

const ACCEPT_EXAMPLES: &str = "\
Examples:
  tracer golden accept golden lamp --reason \"the lamp is warmer\"
  tracer golden accept golden --all-failed --reason \"first pictures\"

It takes what the last run made; the reason goes into log.md of the folder.";

/// `tracer golden accept`
#[derive(Debug, Args)]
#[command(after_help = ACCEPT_EXAMPLES)]
pub struct GoldenAcceptArgs {
    /// Folder with a golden.toml
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Scenes by name
    #[arg(value_name = "NAME", required_unless_present = "all_failed", conflicts_with = "all_failed")]
    pub names: Vec<String>,
    /// All whose pictures were not equal in the last run
    #[arg(long)]
    pub all_failed: bool,
    /// Why the new pictures are right
    #[arg(long, value_name = "TEXT", required = true)]
    pub reason: String,
}

const NEW_EXAMPLES: &str = "\
Examples:
  tracer golden new golden --samples 32 --size 128x96
  tracer golden new golden --scene scenes/fig4.ron --scene room.ron";

/// `tracer golden new`
#[derive(Debug, Args)]
#[command(after_help = NEW_EXAMPLES)]
pub struct GoldenNewArgs {
    /// Folder, made where there is none
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Scene that lies elsewhere (repeatable) [default: those in DIR]
    #[arg(long = "scene", value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// Size of all pictures in pixels
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    /// Samples per pixel; 32 and more tell noise
    #[arg(short, long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub samples: Option<u32>,
    /// Seed of all random choices
    #[arg(long, value_name = "N", value_parser = super::whole::<u32>, allow_negative_numbers = true)]
    pub seed: Option<u32>,
    /// Use this one of the scenes' `cameras`
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Set a field of all scenes: camera.fov=40 (repeatable)
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Every byte counts: keep no noise
    #[arg(long)]
    pub bytes: bool,
}
