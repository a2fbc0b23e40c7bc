//! The words of `tracer farm`.

use super::render::frames;
use super::{
    AdaptiveName, CacheArgs, DenoiseArgs, Frames, IntegratorName, RenderArgs, SceneArgs, Size, SplitName, bits, count,
    crop, exposure, interval, layer, size,
};
use crate::write::Bits;
use clap::{Args, Subcommand};
use std::path::PathBuf;
use std::time::Duration;
use tracer_core::{Crop, Layer};

const FARM_EXAMPLES: &str = "\
Examples:
  tracer farm slurm scene.ron -o scene.exr --parts 64
  tracer farm status scene.farm

docs/scale.md has all of it, and how other schedulers do the same.";

/// `tracer farm`
#[derive(Debug, Args)]
#[command(after_help = FARM_EXAMPLES)]
pub struct FarmArgs {
    /// What to do.
    #[command(subcommand)]
    pub command: FarmCommand,
}

/// What to do with a rendering on many machines.
#[derive(Debug, Subcommand)]
pub enum FarmCommand {
    /// Render parts as a job array of Slurm, and merge them
    Slurm(Box<FarmSlurmArgs>),
    /// Tell how far each part is, and why one failed
    Status(FarmStatusArgs),
    /// Cancel the jobs and keep what is rendered
    Cancel(FarmCancelArgs),
}

const SLURM_EXAMPLES: &str = "\
Examples:
  tracer farm slurm scene.ron -o scene.exr --parts 64 --time-limit 4h -j 16
  tracer farm slurm a.ron -o a.exr --parts 8 --sbatch-arg=--mem=8G --dry-run
The same line goes on. `tracer farm slurm --help` has --denoise and more.";

/// `tracer farm slurm`
#[derive(Clone, Debug, Args)]
#[command(after_help = SLURM_EXAMPLES)]
pub struct FarmSlurmArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneArgs,
    /// Picture: .png .exr .hdr .pfm (repeatable)
    #[arg(short, long = "output", value_name = "FILE", required = true)]
    pub output: Vec<PathBuf>,
    /// A farm for each of these frames: 0-47 or all
    #[arg(long, value_name = "A-B", value_parser = frames, conflicts_with = "frame")]
    #[arg(help = "A farm for each frame: 0-47, all; names have ####")]
    pub frames: Option<Frames>,
    /// How many parts, which are tasks of one job array
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub parts: u32,
    /// Parts, logs, scripts [default: beside the picture]
    #[arg(long, value_name = "DIR", help = "Folder of parts and logs [default: PICTURE.farm]")]
    pub folder: Option<PathBuf>,
    /// Slurm's limit for a part: 4h, 1-12:00:00
    #[arg(long, value_name = "TIME", value_parser = time_limit)]
    pub time_limit: Option<String>,
    /// Time between checkpoints of a part [default: 60s]
    #[arg(long, value_name = "TIME", value_parser = interval)]
    pub every: Option<Duration>,
    /// Slurm's partition
    #[arg(long, value_name = "NAME")]
    pub partition: Option<String>,
    /// Word for sbatch, of parts and merge (repeatable)
    #[arg(long, value_name = "WORD", allow_hyphen_values = true)]
    pub sbatch_arg: Vec<String>,
    /// How often a part that fails is started again [default: 3]
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(..=1000))]
    #[arg(hide_default_value = true, help = "New tries of a part that fails [default: 3]")]
    pub retries: u32,
    /// Wait before a part that has failed is started again
    #[arg(long, value_name = "TIME", value_parser = interval, default_value = "10s")]
    pub pause: Duration,
    /// The program as the nodes find it [default: this one]
    #[arg(long, value_name = "FILE")]
    pub program: Option<PathBuf>,
    /// Print scripts and commands, submit nothing
    #[arg(long)]
    pub dry_run: bool,
    /// Cores of each part [default: as Slurm gives]
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Samples per pixel of all parts together
    #[arg(short, long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub samples: Option<u32>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    /// Render this part of the picture
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    pub crop: Option<Crop>,
    /// Parts have samples or rows [default: samples if there are enough]
    #[arg(long, value_enum, value_name = "WHAT", hide_possible_values = true)]
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
    /// Bits per channel of a PNG: 8 or 16
    #[arg(long, value_name = "BITS", value_parser = bits)]
    pub bits: Option<Bits>,
    /// What to render: full, path, direct or ambient_occlusion
    #[arg(long, value_enum, value_name = "NAME", hide_possible_values = true)]
    pub integrator: Option<IntegratorName>,
    /// Fewer samples where it is quiet: always or never
    #[arg(long, value_enum, value_name = "WHEN", hide_possible_values = true)]
    pub adaptive: Option<AdaptiveName>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub denoise: DenoiseArgs,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub cache: CacheArgs,
    /// The picture tells nothing: no program, no scene
    #[arg(long)]
    pub no_metadata: bool,
}

impl FarmSlurmArgs {
    /// The rendering that the parts are of.
    pub fn as_render(&self) -> RenderArgs {
        // Whatever else is an option of `render`: the tests of `commands/farm/scripts.rs` see that it is handed on.
        RenderArgs {
            scene: self.scene.clone(),
            output: self.output.clone(),
            bits: self.bits,
            samples: self.samples,
            size: self.size,
            crop: self.crop,
            split: self.split,
            seed: self.seed,
            exposure: self.exposure,
            layers: self.layers.clone(),
            denoise: self.denoise,
            cache: self.cache.clone(),
            integrator: self.integrator,
            adaptive: self.adaptive,
            every: self.every,
            no_metadata: self.no_metadata,
            ..RenderArgs::default()
        }
    }
}

const STATUS_EXAMPLES: &str = "\
Examples:
  tracer farm status shot_*.farm
  tracer farm status 4711 --json

Exit codes: 0 merged, 1 something failed or was stopped, 2 no such farm,
3 parts or the merge wait or run";

/// `tracer farm status`
#[derive(Debug, Args)]
#[command(after_help = STATUS_EXAMPLES)]
pub struct FarmStatusArgs {
    /// Its folder, or a job of it (repeatable)
    #[arg(required = true, value_name = "FOLDER|JOB")]
    pub farms: Vec<PathBuf>,
    /// As JSON
    #[arg(long)]
    pub json: bool,
}

const CANCEL_EXAMPLES: &str = "\
Examples:
  tracer farm cancel scene.farm
  tracer farm cancel 4711

Parts at work write what they have; `tracer farm slurm` goes on with them.";

/// `tracer farm cancel`
#[derive(Debug, Args)]
#[command(after_help = CANCEL_EXAMPLES)]
pub struct FarmCancelArgs {
    /// Its folder, or a job of it (repeatable)
    #[arg(required = true, value_name = "FOLDER|JOB")]
    pub farms: Vec<PathBuf>,
}

impl FarmSlurmArgs {
    /// The farm of one frame.
    pub fn of_frame(&self, frame: u32, named: impl Fn(&PathBuf) -> PathBuf) -> Self {
        let mut args = self.clone();
        (args.frames, args.scene.frame) = (None, Some(frame));
        args.output = self.output.iter().map(&named).collect();
        args.folder = self.folder.as_ref().map(&named);
        args
    }
}

/// A limit as sbatch takes it: its own forms with `:` or `-`, or a time with a unit.
fn time_limit(text: &str) -> Result<String, String> {
    let expected =
        || "expected a time of a minute or more, as in 4h, 30m, 2d, 04:00:00 or 1-12:00:00 (days first)".to_owned();
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    if text.contains([':', '-']) {
        let (days, rest) = text.split_once('-').map_or((None, text), |(days, rest)| (Some(days), rest));
        let fields: Vec<&str> = rest.split(':').collect();
        let right = days.is_none_or(digits) && fields.iter().all(|field| digits(field)) && fields.len() <= 3;
        let some = text.bytes().any(|byte| (b'1'..=b'9').contains(&byte));
        return (right && some).then(|| text.to_owned()).ok_or_else(expected);
    }
    // Slurm takes a bare number for minutes, and other options here take one for seconds.
    if digits(text) {
        return Err(format!("is it minutes or seconds? Write {text}m or {text}s"));
    }
    let of_days = text.strip_suffix('d').and_then(|days| days.parse::<f64>().ok()).map(|days| days * 86_400.0);
    let seconds = match of_days {
        Some(seconds) => seconds,
        None => interval(text).map_err(|_| expected())?.as_secs_f64(),
    };
    if !(60.0..=3.2e7).contains(&seconds) {
        return Err(expected());
    }
    let seconds = seconds.ceil() as u64;
    Ok(format!("{}-{:02}:{:02}:{:02}", seconds / 86_400, seconds / 3600 % 24, seconds / 60 % 60, seconds % 60))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_those_of_slurm() {
        for (text, limit) in [
            ("4h", "0-04:00:00"),
            ("90s", "0-00:01:30"),
            ("1.5d", "1-12:00:00"),
            ("04:00:00", "04:00:00"),
            ("30:00", "30:00"),
            ("1-12", "1-12"),
        ] {
            assert_eq!(time_limit(text), Ok(limit.to_owned()));
        }
        for bad in ["", "4", "10s", "-4h", "4 h", "1-2-3", "1:2:3:4", "a:b", "00:00", "1e9d", "UNLIMITED"] {
            assert!(time_limit(bad).is_err(), "{bad}");
        }
    }
}
