//! The words of `tracer marks`.

use super::SceneArgs;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const MARKS_EXAMPLES: &str = "\
Examples:
  tracer marks room.ron -o room.tex
  tracer marks room.ron -o labels.svg --picture room.png
The scene names them: output: Output(marks: { \"A\": (0, 1, 0) }).";

/// `tracer marks`
#[derive(Debug, Args)]
#[command(after_help = MARKS_EXAMPLES)]
pub struct MarksArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneArgs,
    /// Write them for TikZ (.tex), or as labels (.svg)
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// The picture that labels of an .svg are laid over
    #[arg(long, value_name = "FILE")]
    pub picture: Option<PathBuf>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = super::size)]
    pub size: Option<super::Size>,
    /// How to print them: text or json
    #[arg(long, value_enum, value_name = "FORM", default_value_t = MarksForm::Text)]
    #[arg(hide_possible_values = true, hide_default_value = true)]
    pub format: MarksForm,
}

/// How `tracer marks` prints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum MarksForm {
    /// For people.
    #[default]
    Text,
    /// For programs.
    Json,
}
