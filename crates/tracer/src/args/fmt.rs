//! The words of `tracer fmt`.

use super::{DiagnosticsForm, SyntaxName, forms};
use clap::Args;
use std::path::PathBuf;

const FMT_EXAMPLES: &str = "\
Examples:
  tracer fmt room.ron scenes
  tracer fmt scenes --check

Exit codes: 0 done, 1 with --check when a scene would change, 2 a scene is wrong";

/// `tracer fmt`
#[derive(Debug, Args)]
#[command(after_help = FMT_EXAMPLES)]
pub struct FmtArgs {
    /// Scene files, folders of them, or - for standard input to standard output
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// Change nothing; name the scenes that would change
    #[arg(long)]
    pub check: bool,
    /// Syntax of the scenes [default: by their names]
    #[arg(long, value_enum, value_name = "SYNTAX", hide_possible_values = true)]
    #[arg(help = "Syntax: ron, toml or json [default: by the file's name]")]
    pub syntax: Option<SyntaxName>,
    /// How to print what is wrong: text, json or github
    #[arg(long, value_parser = forms(), value_name = "FORM", default_value = "text")]
    #[arg(hide_possible_values = true, hide_default_value = true)]
    pub diagnostics: DiagnosticsForm,
}
