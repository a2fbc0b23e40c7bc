//! `tracer completions`: a script that completes command lines.

use crate::args::{Cli, CompletionsArgs};
use crate::failure::{Failure, exit};
use clap::builder::PossibleValuesParser;
use clap::{Arg, Command, CommandFactory, ValueEnum, ValueHint};
use clap_complete::{Generator, Shell, generate};
use std::io::Write;
use std::process::ExitCode;
use tracer_core::LayerSet;

/// A shell whose command lines are completed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CompletedShell {
    /// Bash
    Bash,
    /// Elvish
    Elvish,
    /// Fish
    Fish,
    /// Nushell
    Nushell,
    /// PowerShell
    #[value(name = "powershell")]
    PowerShell,
    /// Z shell
    Zsh,
}

pub(super) fn run(args: &CompletionsArgs) -> Result<ExitCode, Failure> {
    let script = match args.shell {
        CompletedShell::Bash => script(Shell::Bash),
        CompletedShell::Elvish => script(Shell::Elvish),
        CompletedShell::Fish => script(Shell::Fish),
        CompletedShell::Nushell => script(clap_complete_nushell::Nushell),
        CompletedShell::PowerShell => script(Shell::PowerShell),
        CompletedShell::Zsh => script(Shell::Zsh),
    };
    let mut out = std::io::stdout().lock();
    out.write_all(&script)?;
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}

fn script(shell: impl Generator) -> Vec<u8> {
    let mut script = Vec::new();
    generate(shell, &mut completed(Cli::command()), "tracer", &mut script);
    script
}

/// With all that can be chosen, and no names of files where none stand.
fn completed(command: Command) -> Command {
    let name = command.get_name().to_owned();
    command.mut_args(|arg| with_values(arg, &name)).mut_subcommands(completed)
}

fn with_values(arg: Arg, command: &str) -> Arg {
    /// What a value is called that is a file or a folder.
    const PATHS: [&str; 7] = ["FILE", "DIR", "FOLDER", "SCENE", "PICTURE", "PART", "PATH"];
    let choices: Vec<String> = match arg.get_id().as_str() {
        "layers" | "show" => LayerSet::all().names().map(str::to_owned).collect(),
        "bits" => ["8", "16"].map(str::to_owned).to_vec(),
        "format" if ["render", "merge", "slurm"].contains(&command) => {
            ["png", "exr", "hdr", "pfm"].map(str::to_owned).to_vec()
        }
        "allow" => {
            let codes = scene_format::codes::CODES.iter().map(|entry| entry.code.as_str().to_owned());
            codes.filter(|code| code.starts_with('W')).collect()
        }
        "code" if command == "explain" => {
            let codes = scene_format::codes::CODES.iter().map(|entry| entry.code.as_str().to_owned());
            scene_format::words().into_iter().chain(codes).collect()
        }
        _ => Vec::new(),
    };
    if !choices.is_empty() {
        // The words of a command live as long as the program, which ends when they are written.
        let choices = choices.into_iter().map(|choice| -> &'static str { choice.leak() });
        return arg.value_parser(PossibleValuesParser::new(choices));
    }
    let takes = arg.get_action().takes_values() && !arg.is_positional() && arg.get_possible_values().is_empty();
    let names = || arg.get_value_names().into_iter().flatten();
    // `PATH=VALUE` is one of a field.
    let is_path = names().any(|name| !name.contains('=') && PATHS.iter().any(|path| name.contains(path)));
    if takes && !is_path { arg.value_hint(ValueHint::Other) } else { arg }
}
