//! `tracer completions`: a script that completes command lines.

use crate::args::{Cli, CompletionsArgs};
use crate::failure::{Failure, exit};
use clap::{CommandFactory, ValueEnum};
use clap_complete::{Generator, Shell, generate};
use std::io::Write;
use std::process::ExitCode;

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
    generate(shell, &mut Cli::command(), "tracer", &mut script);
    script
}
