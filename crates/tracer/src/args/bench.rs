//! The words of `tracer bench-acceleration` and `tracer bench-figures`.

use super::{SceneArgs, Size, count, size};
use clap::Args;
use std::path::PathBuf;

const BENCH_EXAMPLES: &str = "\
Examples:
  tracer bench-acceleration scenes/fig3.ron
  tracer bench-acceleration scene.ron --size 64x64 --samples 4";

/// `tracer bench-acceleration`
#[derive(Debug, Args)]
#[command(after_help = BENCH_EXAMPLES)]
pub struct BenchAccelerationArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneArgs,
    /// Samples per pixel
    #[arg(short, long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub samples: Option<u32>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    /// Threads [default: one per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

const FIGURES_EXAMPLES: &str = "\
Examples:
  tracer bench-figures
  tracer bench-figures 1 4 --samples 10";

/// The number of a figure.
fn figure(text: &str) -> Result<u8, String> {
    let number = text.parse().ok().filter(|number| (1..=9).contains(number));
    number.ok_or_else(|| "expected the number of a figure, in 1..=9".to_owned())
}

/// `tracer bench-figures`
#[derive(Debug, Args)]
#[command(after_help = FIGURES_EXAMPLES)]
pub struct BenchFiguresArgs {
    /// Figures, 1 to 9 [default: all]
    #[arg(value_name = "FIGURE", value_parser = figure)]
    pub figures: Vec<u8>,
    /// Folder of fig1.ron to fig9.ron
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    pub scenes: PathBuf,
    /// At most so many samples per pixel, for a quick look
    #[arg(short, long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub samples: Option<u32>,
    /// Threads [default: one per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}
