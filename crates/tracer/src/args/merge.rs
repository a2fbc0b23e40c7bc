//! `tracer merge`.

use super::{DenoiseArgs, RenderArgs, SceneArgs, bits};
use crate::command_line::quoted;
use crate::write::Bits;
use clap::Args;
use std::path::PathBuf;

const MERGE_EXAMPLES: &str = "\
Examples:
  tracer merge scene.*of16.tracer -o scene.exr -o scene.png
  tracer merge scene.0*.tracer -o first.tracer

The bytes are those of one machine, for any parts in any order (docs/scale.md).";

/// `tracer merge`
#[derive(Clone, Debug, Args)]
#[command(after_help = MERGE_EXAMPLES)]
pub struct MergeArgs {
    /// Parts that `tracer render --part` made
    #[arg(required = true, value_name = "PART")]
    pub parts: Vec<PathBuf>,
    /// Picture: .png .exr .hdr .pfm or -; larger part: .tracer
    #[arg(short, long = "output", value_name = "FILE", required = true)]
    pub output: Vec<PathBuf>,
    /// Kind of picture for `-o -`: png, exr, hdr or pfm
    #[arg(long, value_name = "KIND")]
    pub format: Option<String>,
    /// Bits per channel of a PNG: 8 or 16
    #[arg(long, value_name = "BITS", value_parser = bits)]
    pub bits: Option<Bits>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub denoise: DenoiseArgs,
    /// Merge what there is, and say what is missing
    #[arg(long)]
    pub allow_missing: bool,
    /// The picture tells nothing: no program, no scene
    #[arg(long)]
    pub no_metadata: bool,
    /// Threads [default: one per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Report of the picture and its parts to write as JSON
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Print errors only
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
}

impl MergeArgs {
    /// What a rendering that writes the same pictures is told.
    pub fn as_render(&self) -> RenderArgs {
        let scene = self.parts.first().cloned().unwrap_or_default();
        let scene = SceneArgs::plain(scene);
        RenderArgs {
            scene,
            output: self.output.clone(),
            format: self.format.clone(),
            bits: self.bits,
            denoise: self.denoise,
            threads: self.threads,
            report: self.report.clone(),
            no_metadata: self.no_metadata,
            quiet: self.quiet,
            ..RenderArgs::default()
        }
    }

    /// The command line.
    pub fn command(&self) -> String {
        let mut words = vec!["tracer".to_owned(), "merge".to_owned()];
        words.extend(self.parts.iter().map(|part| part.to_string_lossy().into_owned()));
        words.extend(self.output.iter().flat_map(|path| ["-o".to_owned(), path.to_string_lossy().into_owned()]));
        words.extend(self.format.iter().flat_map(|format| ["--format".to_owned(), format.clone()]));
        if let Some(bits) = self.bits {
            let bits = match bits {
                Bits::Eight => "8",
                Bits::Sixteen => "16",
            };
            words.extend(["--bits".to_owned(), bits.to_owned()]);
        }
        words.extend(self.denoise.words());
        words.extend(self.no_metadata.then(|| "--no-metadata".to_owned()));
        words.extend(self.allow_missing.then(|| "--allow-missing".to_owned()));
        words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
    }
}
