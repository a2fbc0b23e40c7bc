//! The command line's words.

mod bench;
mod cache;
mod check;
mod denoise;
mod farm;
mod fmt;
mod golden;
mod info;
mod inspect;
mod marks;
mod merge;
mod preview;
mod render;
mod repro;

pub use bench::{BenchAccelerationArgs, BenchFiguresArgs};
pub use cache::CacheArgs;
use check::forms;
pub use check::{CheckArgs, DiagnosticsForm};
pub use denoise::{DenoiseArgs, DenoiseName};
pub use farm::{FarmArgs, FarmCancelArgs, FarmCommand, FarmSlurmArgs, FarmStatusArgs};
pub use fmt::FmtArgs;
pub use golden::{GoldenAcceptArgs, GoldenArgs, GoldenCommand, GoldenNewArgs, GoldenRunArgs};
pub use info::InfoArgs;
pub use inspect::{InspectArgs, InspectForm};
pub use marks::{MarksArgs, MarksForm};
pub use merge::MergeArgs;
pub use preview::{PreviewArgs, TerminalName};
pub use render::{AdaptiveName, Frames, IntegratorName, RenderArgs};
pub use repro::ReproArgs;

use crate::commands::{CompletedShell, Template};
use crate::write::Bits;
use clap::builder::styling::{AnsiColor, Styles};
use clap::{Args, Parser, Subcommand, ValueEnum};
use scene_format::codes::{Code, find};
use scene_format::{Override, Syntax};
use std::path::PathBuf;
use std::time::Duration;
use tracer_core::{Crop, Layer, LayerSet, Split};

const EXAMPLES: &str = "\
More: inspect marks convert repro bench-acceleration bench-figures
More: lsp schema completions man
Examples:
  tracer new ball.ron && tracer ball.ron
  tracer render scenes/fig4.ron -o fig4.png --samples 100
Exit codes: 0 done, 1 failed, 2 wrong input, 130 interrupted (TERM 143, HUP 129)";

/// No headings, and no empty line but before the examples: help fits a screen of 24 lines.
const TEMPLATE: &str = "{about}\n{usage-heading} {usage}\n{subcommands}\n{options}{after-help}";

const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

/// The version, and of a release build in a clone the commit that it was built of.
const VERSION: &str = match option_env!("TRACER_COMMIT") {
    Some(commit) => commit,
    None => env!("CARGO_PKG_VERSION"),
};

/// A declarative path tracer: a scene file becomes a picture.
#[derive(Debug, Parser)]
#[command(name = "tracer", version = VERSION, after_help = EXAMPLES, styles = STYLES, max_term_width = 100)]
#[command(disable_help_subcommand = true, arg_required_else_help = true, help_template = TEMPLATE)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// Colours
    #[arg(long, global = true, value_enum, value_name = "WHEN", default_value_t = When::Auto)]
    #[arg(hide_possible_values = true)]
    #[arg(help = "Colours: auto, always or never")]
    pub color: When,
    /// Say what is loaded and how long it takes
    #[arg(short, long, global = true)]
    pub verbose: bool,
    /// Say nothing of warnings of this code, and do not count them: W0511 (repeatable)
    #[arg(long, global = true, value_name = "CODE", value_parser = warning)]
    pub allow: Vec<Code>,
}

/// The code of a warning.
fn warning(text: &str) -> Result<Code, String> {
    let entry = find(text).ok_or("there is no such code; `tracer explain` lists them".to_owned())?;
    match entry.code.as_str().starts_with('W') {
        true => Ok(entry.code),
        false => Err("that is an error, and errors cannot be left standing; warnings begin with W".to_owned()),
    }
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a scene into pictures; Ctrl-C keeps what there is
    Render(Box<RenderArgs>),
    /// Merge parts of a rendering into pictures
    Merge(MergeArgs),
    /// Render on many machines: slurm, status, cancel
    Farm(FarmArgs),
    /// See a scene in the browser or here, again at every save
    #[command(alias = "watch")]
    Preview(PreviewArgs),
    /// Find everything that is wrong with a scene
    Check(CheckArgs),
    /// Tell what is in a scene, a picture or a checkpoint
    Info(InfoArgs),
    /// Translate a scene between RON, TOML and JSON
    Convert(ConvertArgs),
    /// Lay out scenes as everybody's are, comments kept
    Fmt(FmtArgs),
    /// Start a small scene that renders well
    New(NewArgs),
    /// Make a picture again, and see that it is the same
    Repro(ReproArgs),
    /// Measure how two pictures differ
    Compare(CompareArgs),
    /// Keep pictures what they are: run, accept, new
    Golden(GoldenArgs),
    /// Tell how one sample of a pixel came about
    Inspect(Box<InspectArgs>),
    /// Tell where a scene's marks are in its picture, for labels
    Marks(Box<MarksArgs>),
    /// Time a scene with no boxes, one per mesh, a tree
    BenchAcceleration(BenchAccelerationArgs),
    /// Time the report's figures at its own settings
    BenchFigures(BenchFiguresArgs),
    /// Explain a diagnostic's code, or a word of the language
    Explain(ExplainArgs),
    /// Help an editor, as a language server (LSP)
    #[command(after_help = LSP_EXAMPLES)]
    Lsp,
    /// Print the JSON Schema of scene files
    #[command(after_help = SCHEMA_EXAMPLES)]
    Schema,
    /// Print a completion script for a shell
    Completions(CompletionsArgs),
    /// Print a manual page (roff)
    Man(ManArgs),
}

/// Automatic, or as the person says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum When {
    /// As the terminal and NO_COLOR say.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// The syntax of a scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SyntaxName {
    /// Rusty Object Notation.
    Ron,
    /// Tom's Obvious Minimal Language.
    Toml,
    /// JavaScript Object Notation.
    Json,
}

impl From<SyntaxName> for Syntax {
    fn from(name: SyntaxName) -> Self {
        match name {
            SyntaxName::Ron => Syntax::Ron,
            SyntaxName::Toml => Syntax::Toml,
            SyntaxName::Json => Syntax::Json,
        }
    }
}

/// What a rendering is divided by into parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SplitName {
    /// Samples of all pixels.
    Samples,
    /// All samples of some rows.
    Rows,
}

impl From<SplitName> for Split {
    fn from(name: SplitName) -> Self {
        match name {
            SplitName::Samples => Split::Samples,
            SplitName::Rows => Split::Rows,
        }
    }
}

/// The scene, and how faults of it are told.
#[derive(Clone, Debug, Default, Args)]
pub struct SceneArgs {
    /// Scene file (.ron, .toml, .json), or - for standard input
    pub scene: PathBuf,
    /// Set a field of the scene: camera.fov=40 (repeatable)
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Use this one of the scene's `cameras`
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Frame of the scene's `animation`, from 0
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = frame)]
    pub frame: Option<u32>,
    /// Whether the frame is one of those that `--frames` asks for.
    #[arg(skip)]
    pub is_of_frames: bool,
    /// Syntax of the scene [default: by its extension, else by its looks]
    #[arg(long, value_enum, value_name = "SYNTAX", hide_possible_values = true)]
    #[arg(help = "Syntax: ron, toml or json [default: by the file's name]")]
    pub syntax: Option<SyntaxName>,
    /// How to print what is wrong: text, json or github
    #[arg(long, value_parser = forms(), value_name = "FORM", default_value = "text")]
    #[arg(hide_possible_values = true, hide_default_value = true)]
    pub diagnostics: DiagnosticsForm,
}

impl SceneArgs {
    /// The scene alone, as it is written.
    pub fn plain(scene: PathBuf) -> Self {
        let diagnostics = DiagnosticsForm::Text;
        SceneArgs { scene, set: Vec::new(), camera: None, frame: None, is_of_frames: false, syntax: None, diagnostics }
    }

    /// The fields to set.
    pub fn overrides(&self) -> Vec<Override> {
        let mut all = overrides(&self.set, self.camera.as_deref(), None);
        let of = if self.is_of_frames { Override::of_frames } else { Override::frame };
        all.extend(self.frame.map(of));
        all
    }

    /// The same as arguments of `--set`.
    pub fn sets(&self) -> Vec<String> {
        self.overrides().into_iter().map(|set| set.argument).collect()
    }
}

/// One frame.
fn frame(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| match text {
        "all" => "one frame has a number; all are rendered by `tracer render --frames all`".to_owned(),
        _ if text.contains(['-', '.']) && !text.starts_with('-') => {
            format!("one frame has a number; several are rendered by `tracer render --frames {text}`")
        }
        _ => "expected the number of a frame, counted from 0".to_owned(),
    })
}

/// What is set in a scene. Camera and frame count more than `--set`.
fn overrides(set: &[String], camera: Option<&str>, frame: Option<u32>) -> Vec<Override> {
    let chosen = camera.map(Override::camera).into_iter().chain(frame.map(Override::frame));
    set.iter().cloned().map(Override::from).chain(chosen).collect()
}

const LSP_EXAMPLES: &str = "\
Examples:
  tracer lsp
  tracer lsp 2> lsp.log

docs/editors.md tells how editors start it.";

const SCHEMA_EXAMPLES: &str = "\
Examples:
  tracer schema > scene.schema.json
  tracer schema | jq .properties.camera";

const CONVERT_EXAMPLES: &str = "\
Examples:
  tracer convert scene.ron -o scene.toml
  tracer convert - --to ron < scene.toml";

/// `tracer convert`
#[derive(Debug, Args)]
#[command(after_help = CONVERT_EXAMPLES)]
pub struct ConvertArgs {
    /// Scene file, or - for standard input
    pub scene: PathBuf,
    /// Syntax of the scene: ron, toml or json [default: by its name]
    #[arg(long, value_enum, value_name = "SYNTAX", hide_possible_values = true)]
    pub syntax: Option<SyntaxName>,
    /// Syntax to write [default: by -o, else the other one]
    #[arg(long, value_enum, value_name = "SYNTAX", hide_possible_values = true)]
    pub to: Option<SyntaxName>,
    /// File to write [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Replace a file that is there
    #[arg(long)]
    pub force: bool,
    /// How to print what is wrong: text, json or github
    #[arg(long, value_parser = forms(), value_name = "FORM", default_value = "text")]
    #[arg(hide_possible_values = true, hide_default_value = true)]
    pub diagnostics: DiagnosticsForm,
}

const NEW_EXAMPLES: &str = "\
Examples:
  tracer new room.toml --template room
  tracer new again.ron --from fig4.png

With --from it is the scene as it was rendered: what options had set is in
it, comments are not; with --as-written both are as they were.";

/// `tracer new`
#[derive(Debug, Args)]
#[command(after_help = NEW_EXAMPLES)]
pub struct NewArgs {
    /// Scene file to make (.ron, .toml, .json)
    pub scene: PathBuf,
    /// What to start from: ball, materials or room
    #[arg(long, value_enum, value_name = "NAME", default_value_t = Template::Ball, hide_possible_values = true)]
    pub template: Template,
    /// The scene that a picture was rendered of, instead
    #[arg(long, value_name = "PICTURE", conflicts_with = "template")]
    pub from: Option<PathBuf>,
    /// The text as it was, without what options had set
    #[arg(long, requires = "from")]
    pub as_written: bool,
    /// Replace a file that is there
    #[arg(long)]
    pub force: bool,
}

const COMPARE_EXAMPLES: &str = "\
Examples:
  tracer compare a.png b.png -o difference.png
  tracer compare new old --fail-above flip-mean=0.01

Metrics: max, rmse, relmse, flip-mean, flip-max. Two EXR, HDR or PFM files are
compared in linear radiance, others in display values of 0 to 1.
Of two folders, pictures of one name are compared, and none may be missing.
Exit codes: 0 within the limits, 1 above one, 2 a picture missing, two sizes";

/// `tracer compare`
#[derive(Debug, Args)]
#[command(after_help = COMPARE_EXAMPLES)]
pub struct CompareArgs {
    /// Picture, or a folder of pictures
    pub a: PathBuf,
    /// Picture or folder that it is measured against
    pub b: PathBuf,
    /// Write a map of FLIP's difference (.png): black none, red half, yellow all
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Exit code 1 above it (repeatable)
    #[arg(long, value_name = "METRIC=X")]
    pub fail_above: Vec<String>,
    /// As JSON
    #[arg(long)]
    pub json: bool,
    /// Print nothing: the exit code tells
    #[arg(short, long, conflicts_with_all = ["verbose", "json"])]
    pub quiet: bool,
}

const EXPLAIN_EXAMPLES: &str = "\
Examples:
  tracer explain E0301
  tracer explain radius";

/// `tracer explain`
#[derive(Debug, Args)]
#[command(after_help = EXPLAIN_EXAMPLES)]
pub struct ExplainArgs {
    /// Code, as E0102, or a word of the scene language, as Sphere [default: list all codes]
    #[arg(value_name = "CODE|WORD", help = "Code or word of the language [default: list all codes]")]
    pub code: Vec<String>,
}

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  tracer completions bash > ~/.local/share/bash-completion/completions/tracer
  tracer completions fish > ~/.config/fish/completions/tracer.fish";

/// `tracer completions`
#[derive(Debug, Args)]
#[command(after_help = COMPLETIONS_EXAMPLES)]
pub struct CompletionsArgs {
    /// Shell: bash, elvish, fish, nushell, powershell or zsh
    #[arg(value_enum, hide_possible_values = true)]
    pub shell: CompletedShell,
}

const MAN_EXAMPLES: &str = "\
Examples:
  tracer man | man -l -
  tracer man render > tracer-render.1";

/// `tracer man`
#[derive(Debug, Args)]
#[command(after_help = MAN_EXAMPLES)]
pub struct ManArgs {
    /// Command [default: the page of the program]
    pub command: Option<String>,
}

/// A size in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

/// The most pixels along a side; the scene language has the same limit.
const MAX_SIDE: u32 = 65_536;

/// A number of samples: 64, 1_000, 1k, 2M, 1e3.
fn count(text: &str) -> Result<u32, String> {
    let expected = || "expected a whole number in 1..=1000000000, as in 64, 1k or 1e3".to_owned();
    let plain = text.replace('_', "");
    let (number, factor) = match plain.strip_suffix(['k', 'K']) {
        Some(thousands) => (thousands, 1e3),
        None => plain.strip_suffix('M').map_or((plain.as_str(), 1.0), |millions| (millions, 1e6)),
    };
    let digits = number.bytes().all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'e' | b'E' | b'+'));
    let value = number.parse::<f64>().ok().filter(|_| digits).ok_or_else(expected)? * factor;
    // Exact: whole numbers of this size are doubles.
    if value.fract() == 0.0 && (1.0..=1e9).contains(&value) { Ok(value as u32) } else { Err(expected()) }
}

/// A whole number that fits into so many bits: a port, a seed.
fn whole<T: TryFrom<u64>>(text: &str) -> Result<T, String> {
    let most = u64::MAX >> (64 - 8 * size_of::<T>().clamp(1, 8));
    let value = text.parse::<u64>().ok().and_then(|value| T::try_from(value).ok());
    value.ok_or_else(|| format!("expected a whole number in 0..={most}"))
}

fn size(text: &str) -> Result<Size, String> {
    let expected = || format!("expected width and height in pixels, 1 to {MAX_SIDE}, as in 640x480");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(expected)?;
    let side = |side: &str| side.parse().ok().filter(|n| (1..=MAX_SIDE).contains(n)).ok_or_else(expected);
    Ok(Size { width: side(width)?, height: side(height)? })
}

fn crop(text: &str) -> Result<Crop, String> {
    let expected = "expected four whole numbers: left, top, width and height in pixels, as in 100,50,64,64";
    let numbers: Vec<u32> =
        text.split(',').map(|n| n.trim().parse()).collect::<Result<_, _>>().map_err(|_| expected.to_owned())?;
    match numbers[..] {
        [x, y, width, height] if width > 0 && height > 0 => Ok(Crop { x, y, width, height }),
        _ => Err(expected.to_owned()),
    }
}

/// A part: 3/16.
fn part(text: &str) -> Result<[u32; 2], String> {
    let expected = || "expected which part of how many, as in 3/16: from 1/16 to 16/16".to_owned();
    let (k, n) = text.split_once('/').ok_or_else(expected)?;
    match (k.trim().parse(), n.trim().parse()) {
        (Ok(k), Ok(n)) if 1 <= k && k <= n && n <= 1_000_000 => Ok([k, n]),
        _ => Err(expected()),
    }
}

fn layer(text: &str) -> Result<Layer, String> {
    let names = || LayerSet::all().names().collect::<Vec<_>>();
    let near = || scene_format::nearest(text.trim(), names()).map(|near| format!("; did you mean {near}?"));
    let fault = || format!("expected the name of a layer: {}{}", names().join(", "), near().unwrap_or_default());
    LayerSet::by_name(text.trim()).ok_or_else(fault)
}

fn bits(text: &str) -> Result<Bits, String> {
    match text {
        "8" => Ok(Bits::Eight),
        "16" => Ok(Bits::Sixteen),
        _ => Err("expected 8 or 16".to_owned()),
    }
}

fn interval(text: &str) -> Result<Duration, String> {
    let expected = || "expected a time from 1ms to 1000h, as in 60s, 5m, 1.5h or 500ms".to_owned();
    let digits = text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.').len();
    let (number, unit) = text.split_at(digits);
    let of_one = match unit {
        "ms" => 1e-3,
        "s" | "" => 1.0,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        _ => return Err(expected()),
    };
    let seconds = number.parse::<f64>().map_err(|_| expected())? * of_one;
    (1e-3..=3.6e6).contains(&seconds).then(|| Duration::from_secs_f64(seconds)).ok_or_else(expected)
}

/// A number of bytes: 500MB, 10GiB.
fn bytes(text: &str) -> Result<u64, String> {
    let expected = || "expected a size from 1MB to 1000TB, as in 500MB, 20GB or 20GiB".to_owned();
    let digits = text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.').len();
    let (number, unit) = text.split_at(digits);
    let of_one = match unit.trim_start().to_ascii_lowercase().as_str() {
        "b" => 1.0,
        "m" | "mb" => 1e6,
        "mib" => f64::from(1 << 20),
        "g" | "gb" => 1e9,
        "gib" => f64::from(1 << 30),
        "t" | "tb" => 1e12,
        "tib" => f64::from(1 << 20) * f64::from(1 << 20),
        _ => return Err(expected()),
    };
    let bytes = number.parse::<f64>().map_err(|_| expected())? * of_one;
    (1e6..=1e15).contains(&bytes).then_some(bytes as u64).ok_or_else(expected)
}

/// A relative error: 0.01, or 1%.
fn noise(text: &str) -> Result<f64, String> {
    let (number, unit) = text.strip_suffix('%').map_or((text, 1.0), |percent| (percent, 0.01));
    let share = number.trim_end().parse::<f64>().ok().map(|number| number * unit);
    let expected = || "expected a relative error, above 0 and below 1, as in 0.01 or 1%".to_owned();
    share.filter(|share| *share > 0.0 && *share < 1.0).ok_or_else(expected)
}

fn exposure(text: &str) -> Result<f64, String> {
    let expected = "expected a number of stops, -64 to 64, as in -0.5";
    text.parse().ok().filter(|stops: &f64| stops.abs() <= 64.0).ok_or_else(|| expected.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn sizes_and_crops_are_read() {
        assert_eq!(size("640x480"), Ok(Size { width: 640, height: 480 }));
        for bad in ["", "640", "0x4", "4x0", "4x70000", "-1x4", "4x4x4", "4 x 4"] {
            assert!(size(bad).is_err(), "{bad}");
        }
        for (text, milliseconds) in [("60s", 60_000), ("5m", 300_000), ("1.5h", 5_400_000), ("20ms", 20), ("7", 7000)] {
            assert_eq!(interval(text), Ok(Duration::from_millis(milliseconds)));
        }
        for bad in ["", "s", "0s", "-1s", "1d", "1e400s", "nan", "1.2.3s", "5 m", "1001h"] {
            assert!(interval(bad).is_err(), "{bad}");
        }
        for (text, samples) in [("64", 64), ("1k", 1000), ("1e3", 1000), ("2.5M", 2_500_000), ("1_000", 1000)] {
            assert_eq!(count(text), Ok(samples));
        }
        for bad in ["", "0", "-1", "1.5", "1e10", "k", "inf", "nan", "1kk", "0x10"] {
            assert!(count(bad).is_err(), "{bad}");
        }
        for (text, size) in [
            ("500MB", 500_000_000),
            ("10GiB", 10 << 30),
            ("1.5 g", 1_500_000_000),
            ("1TiB", 1 << 40),
            ("1234567B", 1_234_567),
        ] {
            assert_eq!(bytes(text), Ok(size));
        }
        for bad in ["", "10", "10B", "1KB", "0GB", "-1GB", "nanGB", "2000TB", "GB"] {
            assert!(bytes(bad).is_err(), "{bad}");
        }
        assert_eq!((noise("0.01"), noise("1%"), noise("2.5 %")), (Ok(0.01), Ok(0.01), Ok(0.025)));
        for bad in ["", "0", "1", "-1%", "100%", "nan", "%", "1 percent"] {
            assert!(noise(bad).is_err(), "{bad}");
        }
        assert_eq!((part("3/16"), part("16/16")), (Ok([3, 16]), Ok([16, 16])));
        for bad in ["", "3", "0/16", "17/16", "3/", "-1/3", "1/2/3", "1.5/3", "1/9999999"] {
            assert!(part(bad).is_err(), "{bad}");
        }
        assert_eq!(crop("1,2,3,4"), Ok(Crop { x: 1, y: 2, width: 3, height: 4 }));
        for bad in ["", "1,2,3", "1,2,0,4", "1,2,3,4,5", "-1,2,3,4", "a,b,c,d"] {
            assert!(crop(bad).is_err(), "{bad}");
        }
    }
}
