//! The command line as it is read: help that fits a terminal of 80 columns and 24 lines, and tips for what was probably meant.

use crate::args::Cli;
use crate::command_line::quoted;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, CommandFactory};
use std::ffi::OsString;
use std::path::Path;
use tracer_core::mesh::MeshFormat;

/// The parts of a command's help, without headings and arguments that the usage line names and the first line explains.
const TEMPLATE: &str = "{about}\n\n{usage-heading} {usage}\n\n{options}{after-help}";

/// The words of the command line. The help of one command leaves out what all commands take: `tracer --help` has it. (Manual
/// pages and completions are made from [`Cli`] itself and have everything.)
pub fn command() -> Command {
    let cli = Cli::command();
    let everywhere: Vec<Arg> =
        cli.get_arguments().filter(|arg| arg.is_global_set()).map(|arg| arg.clone().hide(true)).collect();
    cli.mut_subcommands(|command| command.args(everywhere.clone()).help_template(TEMPLATE))
        // A screen has no room for all: its last line says where these are.
        .mut_subcommand("render", |command| {
            ["syntax", "diagnostics", "format", "bits", "stats"]
                .into_iter()
                .fold(command, |command, name| command.mut_arg(name, |arg| arg.hide(true)))
        })
}

/// Adds to a fault of the command line what was probably meant.
pub fn with_tip(mut error: clap::Error, arguments: &[OsString]) -> clap::Error {
    let words: Vec<String> = arguments.iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    let tip = match error.kind() {
        ErrorKind::InvalidSubcommand => context(&error, ContextKind::InvalidSubcommand).and_then(|word| of_file(&word)),
        ErrorKind::UnknownArgument => {
            // An option of a command, without the command.
            let before = words.iter().all(|word| Cli::command().find_subcommand(word).is_none());
            context(&error, ContextKind::InvalidArg).filter(|_| before).and_then(|option| of_option(&option))
        }
        ErrorKind::MissingRequiredArgument if words.first().is_some_and(|word| word == "render") => {
            let scene = words.iter().skip(1).find(|word| is_scene(word));
            let named = words.iter().any(|word| word.starts_with("-o") || word.starts_with("--output"));
            scene.filter(|_| !named).map(|scene| format!("name the picture: {}", render(scene)))
        }
        _ => None,
    };
    if let Some(tip) = tip {
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![StyledStr::from(tip)]));
    }
    error
}

fn context(error: &clap::Error, kind: ContextKind) -> Option<String> {
    match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word.clone()),
        _ => None,
    }
}

fn is_scene(word: &str) -> bool {
    scene_format::Syntax::from_path(Path::new(word)).is_some()
}

/// The command that renders a scene into a picture of its name in this folder.
fn render(scene: &str) -> String {
    let picture = Path::new(Path::new(scene).file_name().unwrap_or_default()).with_extension("png");
    format!("tracer render {} -o {}", quoted(scene), quoted(&picture.to_string_lossy()))
}

/// A file stands where the command should.
fn of_file(word: &str) -> Option<String> {
    let extension = Path::new(word).extension().map(|extension| extension.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("ron" | "toml") => Some(format!("to render a scene: {}", render(word))),
        Some(_) if MeshFormat::of(Path::new(word)).is_some() => {
            Some("a mesh stands in a scene, as Mesh(file: \"..\"); to start a scene: tracer new scene.ron".to_owned())
        }
        Some("png" | "exr" | "hdr" | "pfm") => Some(format!("to compare pictures: tracer compare {} ..", quoted(word))),
        _ => None,
    }
}

/// The commands that take an option.
fn of_option(option: &str) -> Option<String> {
    let cli = Cli::command();
    let takes = |command: &&Command| {
        command.get_arguments().any(|arg| {
            let long = arg.get_long().is_some_and(|long| option.strip_prefix("--") == Some(long));
            long || arg.get_short().is_some_and(|short| option == format!("-{short}"))
        })
    };
    let names: Vec<String> =
        cli.get_subcommands().filter(takes).map(|command| format!("tracer {}", command.get_name())).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    match names.as_slice() {
        [] => None,
        [only] => Some(format!("{option} belongs to {only}")),
        [first, ..] => Some(format!("{option} belongs to a command, as in {first}; write the command first")),
    }
}
