//! The words of `tracer repro`.

use clap::Args;
use std::path::PathBuf;

const REPRO_EXAMPLES: &str = "\
Examples:
  tracer repro fig4.png
  tracer repro out/fig4.exr --scene scenes/fig4.ron -o again.exr

PNG and EXR hold their scene; the files that it names are looked for beside
the picture, or beside the file that --scene names.
Exit codes: 0 the same picture, 1 not so, and why, 2 it does not tell enough";

/// `tracer repro`
#[derive(Debug, Args)]
#[command(after_help = REPRO_EXAMPLES)]
pub struct ReproArgs {
    /// Picture that tracer has written (.png, .exr)
    pub picture: PathBuf,
    /// Where its scene lies [default: beside the picture]
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// Keep the picture made again, whatever came of it
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Threads [default: one per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Say nothing but why it is not the same
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
}
