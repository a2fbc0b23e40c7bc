//! The words of `tracer info`.

use super::SceneArgs;
use clap::Args;

const INFO_EXAMPLES: &str = "\
Examples:
  tracer info scene.toml --objects
  tracer info fig4.png

Of a picture it tells what made it; `tracer repro` makes it again.";

/// `tracer info`
#[derive(Debug, Args)]
#[command(after_help = INFO_EXAMPLES)]
pub struct InfoArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneArgs,
    /// As JSON
    #[arg(long)]
    pub json: bool,
    /// Tell instead where every object is, and in which pixels
    #[arg(long)]
    pub objects: bool,
    /// Print the scene with every default filled in instead
    #[arg(long, conflicts_with_all = ["json", "objects"])]
    pub resolved: bool,
}
