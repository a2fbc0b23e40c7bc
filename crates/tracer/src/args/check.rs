//! The words of `tracer check`, and the forms of what is told of a scene.

use super::{SceneArgs, SyntaxName};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// How diagnostics are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum DiagnosticsForm {
    /// For people.
    #[default]
    Text,
    /// One JSON object a line, for editors.
    Json,
    /// Annotations of GitHub's Actions.
    Github,
    /// One SARIF 2.1.0 document on standard output, of `tracer check` alone.
    Sarif,
}

/// The forms of all commands but `check`, whose output is one document.
pub(super) fn forms() -> impl TypedValueParser<Value = DiagnosticsForm> {
    PossibleValuesParser::new(["text", "json", "github"]).map(|form| match form.as_str() {
        "json" => DiagnosticsForm::Json,
        "github" => DiagnosticsForm::Github,
        _ => DiagnosticsForm::Text,
    })
}

const CHECK_EXAMPLES: &str = "\
Examples:
  tracer check room.ron --fix
  tracer check scenes ball.toml --deny-warnings

Diagnostics go to standard error, as SARIF to standard output. Exit code 2
when there is an error.";

/// `tracer check`
#[derive(Debug, Args)]
#[command(after_help = CHECK_EXAMPLES)]
pub struct CheckArgs {
    /// Scene files, folders of them, or - for standard input
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// Set a field of each scene: camera.fov=40 (repeatable)
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Syntax of the scenes [default: by their names]
    #[arg(long, value_enum, value_name = "SYNTAX", hide_possible_values = true)]
    #[arg(help = "Syntax: ron, toml or json [default: by the file's name]")]
    pub syntax: Option<SyntaxName>,
    /// How to print what is wrong: text, json, github or sarif
    #[arg(long, value_enum, value_name = "FORM", default_value_t = DiagnosticsForm::Text)]
    #[arg(hide_possible_values = true, hide_default_value = true)]
    pub diagnostics: DiagnosticsForm,
    /// Take warnings for errors
    #[arg(long)]
    pub deny_warnings: bool,
    /// Look through this one of the scenes' `cameras`
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Mend in the files what can be mended for certain
    #[arg(long, conflicts_with = "set")]
    pub fix: bool,
    /// Say nothing but what is wrong: no warnings, no `ok`
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
}

impl CheckArgs {
    /// The same for one scene.
    pub fn of(&self, scene: PathBuf) -> SceneArgs {
        SceneArgs {
            set: self.set.clone(),
            camera: self.camera.clone(),
            syntax: self.syntax,
            diagnostics: self.diagnostics,
            ..SceneArgs::plain(scene)
        }
    }
}
