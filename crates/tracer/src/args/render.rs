//! The words of `tracer render`.

use super::{
    CacheArgs, DenoiseArgs, SceneArgs, Size, SplitName, bits, count, crop, exposure, interval, layer, noise, part, size,
};
use crate::write::Bits;
use clap::{Args, ValueEnum};
use scene_format::desc::{Adaptive, Integrator};
use std::path::PathBuf;
use std::time::Duration;
use tracer_core::{Crop, Layer, Plan};

const RENDER_EXAMPLES: &str = "\
Examples:
  tracer render film.ron --frames 0-47 -o shot_####.png
  tracer render fig4.ron -o a.exr -o a.png --resume a.checkpoint --every 5m
`tracer render --help` has --checkpoint, --crop, --layers, --report and more.";

/// `tracer render`
#[derive(Clone, Debug, Default, Args)]
#[command(after_help = RENDER_EXAMPLES)]
pub struct RenderArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneArgs,
    /// Picture: .png .exr .hdr .pfm, or - (repeatable)
    #[arg(short, long = "output", value_name = "FILE", help = "Picture: .png .exr .hdr .pfm, - [default: SCENE.png]")]
    pub output: Vec<PathBuf>,
    /// Render these frames: 0-47 or all; #### in file names is the number
    #[arg(long, value_name = "A-B", value_parser = frames, conflicts_with_all = ["frame", "open"])]
    #[arg(allow_negative_numbers = true)]
    #[arg(help = "Frames of an animation: 0-47, all; names have ####")]
    pub frames: Option<Frames>,
    /// Leave frames out whose files are there
    #[arg(long, requires = "frames")]
    pub skip_existing: bool,
    /// Open the picture when it is done
    #[arg(long, conflicts_with = "part")]
    pub open: bool,
    /// Kind of picture for `-o -`: png, exr, hdr or pfm
    #[arg(long, value_name = "KIND")]
    pub format: Option<String>,
    /// Bits per channel of a PNG: 8 or 16
    #[arg(long, value_name = "BITS", value_parser = bits)]
    pub bits: Option<Bits>,
    /// Samples per pixel; beside --noise or --time the most
    #[arg(short, long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub samples: Option<u32>,
    /// End when the noise is no more than this: 0.01, 1%
    #[arg(long, value_name = "SHARE", value_parser = noise)]
    pub noise: Option<f64>,
    /// Whether quiet parts take fewer samples: with_noise, always or never
    #[arg(long, value_enum, value_name = "WHEN", hide_possible_values = true)]
    #[arg(help = "Fewer samples where it is quiet: with_noise, always or never")]
    pub adaptive: Option<AdaptiveName>,
    /// End after this time, all written: 60s, 5m, 1h
    #[arg(long, value_name = "TIME", value_parser = interval)]
    pub time: Option<Duration>,
    /// End where a rendering with --time has ended, as its report says
    #[arg(long, value_name = "PLAN", conflicts_with_all = ["noise", "time", "samples", "part", "resume"])]
    pub plan: Option<Plan>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    /// Render this part: the same bytes as in the whole
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop, allow_hyphen_values = true)]
    pub crop: Option<Crop>,
    /// Render this part of N, for `tracer merge`: 3/16
    #[arg(long, value_name = "K/N", value_parser = part, conflicts_with_all = ["noise", "time", "format", "bits"])]
    pub part: Option<[u32; 2]>,
    /// Divide by samples or rows [default: samples]
    #[arg(long, value_enum, value_name = "WHAT", requires = "part", hide_possible_values = true)]
    #[arg(help = "Parts have samples or rows [default: samples if there are enough]")]
    pub split: Option<SplitName>,
    /// Seed of all random choices
    #[arg(long, value_name = "N", value_parser = super::whole::<u32>, allow_negative_numbers = true)]
    pub seed: Option<u32>,
    /// Stops to brighten the picture by
    #[arg(long, value_name = "STOPS", value_parser = exposure, allow_negative_numbers = true)]
    pub exposure: Option<f64>,
    /// Layers of the EXR beside the scene's: albedo,depth
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = layer)]
    pub layers: Vec<Layer>,
    /// A layer to see: PNG files show it in false colours
    #[arg(long, value_name = "LAYER", value_parser = layer, conflicts_with_all = ["part", "denoise"])]
    pub show: Option<Layer>,
    /// What to render: full, path, direct, ambient_occlusion, or reference, slow and in double precision
    #[arg(long, value_enum, value_name = "NAME", hide_possible_values = true)]
    #[arg(help = "full, path, direct, ambient_occlusion or reference")]
    pub integrator: Option<IntegratorName>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub denoise: DenoiseArgs,
    /// Pictures tell nothing: no program, no scene, no command
    #[arg(long)]
    pub no_metadata: bool,
    /// Threads [default: one per core]
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Keep the state in this file while rendering
    #[arg(long, value_name = "FILE")]
    pub checkpoint: Option<PathBuf>,
    /// Time between checkpoints: 60s, 5m, 1h [default: 60s]
    #[arg(long, value_name = "TIME", value_parser = interval)]
    pub every: Option<Duration>,
    /// Go on from this checkpoint, and keep it up to date
    #[arg(long, value_name = "FILE")]
    pub resume: Option<PathBuf>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub cache: CacheArgs,
    /// Report of times, rays and memory to write as JSON
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Tell where the time goes, in the report too
    #[arg(long)]
    pub stats: bool,
    /// Print errors only
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
}

/// When quiet parts of the picture take fewer samples, in place of the scene's `render.adaptive`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AdaptiveName {
    /// Where a noise is asked for.
    #[value(name = "with_noise", alias = "with-noise")]
    WithNoise,
    /// From 64 samples on.
    Always,
    /// Nowhere.
    Never,
}

impl AdaptiveName {
    /// The word of the scene that it stands for.
    pub fn word(self) -> Adaptive {
        match self {
            AdaptiveName::WithNoise => Adaptive::WithNoise,
            AdaptiveName::Always => Adaptive::Always,
            AdaptiveName::Never => Adaptive::Never,
        }
    }

    /// As it is written on the command line.
    pub fn name(self) -> &'static str {
        match self {
            AdaptiveName::WithNoise => "with_noise",
            AdaptiveName::Always => "always",
            AdaptiveName::Never => "never",
        }
    }
}

/// What is rendered, in place of the scene's `render.integrator`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum IntegratorName {
    /// All light, with all that saves noise.
    Full,
    /// All light, by plain paths.
    Path,
    /// Direct light.
    Direct,
    /// How much of the sky is free.
    #[value(name = "ambient_occlusion", alias = "ambient-occlusion", alias = "ao")]
    AmbientOcclusion,
    /// The textbook in double precision.
    Reference,
}

impl IntegratorName {
    /// The word of the scene that it stands for; the reference has none.
    pub fn word(self) -> Option<Integrator> {
        match self {
            IntegratorName::Full => Some(Integrator::Full),
            IntegratorName::Path => Some(Integrator::Path),
            IntegratorName::Direct => Some(Integrator::Direct),
            IntegratorName::AmbientOcclusion => Some(Integrator::AmbientOcclusion { distance: None }),
            IntegratorName::Reference => None,
        }
    }

    /// As it is written on the command line.
    pub fn name(self) -> &'static str {
        match self {
            IntegratorName::Full => "full",
            IntegratorName::Path => "path",
            IntegratorName::Direct => "direct",
            IntegratorName::AmbientOcclusion => "ambient_occlusion",
            IntegratorName::Reference => "reference",
        }
    }
}

/// Frames of an animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frames {
    /// All that there are.
    All,
    /// From the first to the last of these.
    Range(u32, u32),
}

pub(super) fn frames(text: &str) -> Result<Frames, String> {
    if text == "all" {
        return Ok(Frames::All);
    }
    let expected = || {
        let apart = if text.contains(',') { "; frames apart are rendered one range after the other" } else { "" };
        format!("expected the first and the last frame, counted from 0, as in 0-47, or all{apart}")
    };
    let (first, last) = text.split_once("..").or_else(|| text.split_once('-')).unwrap_or((text, text));
    let number = |text: &str| text.trim().parse::<u32>().ok().filter(|&frame| frame < 1_000_000);
    match (number(first), number(last)) {
        (Some(first), Some(last)) if first <= last => Ok(Frames::Range(first, last)),
        _ => Err(expected()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_read() {
        for (text, read) in [
            ("0-47", Frames::Range(0, 47)),
            ("3..5", Frames::Range(3, 5)),
            ("12", Frames::Range(12, 12)),
            ("all", Frames::All),
        ] {
            assert_eq!(frames(text), Ok(read));
        }
        for bad in ["", "-", "5-3", "-3", "0-", "a-b", "0-1000000", "1.5", "0-4-8", "every"] {
            assert!(frames(bad).is_err(), "{bad}");
        }
    }
}
