//! `tracer man`: the manual pages, one of the program and one of each command.

use crate::args::{Cli, ManArgs};
use crate::failure::{Failure, exit};
use crate::write::Provenance;
use clap::CommandFactory;
use std::io::Write;
use std::process::ExitCode;

pub(super) fn run(args: &ManArgs) -> Result<ExitCode, Failure> {
    let mut cli = Cli::command();
    // Gives the subcommands their full names.
    cli.build();
    let command = match &args.command {
        None => cli,
        // Pages of commands within commands are named as git's are: golden-run.
        Some(name) => found(&cli, name).cloned().ok_or_else(|| {
            let names: Vec<&str> = cli.get_subcommands().map(|command| command.get_name()).collect();
            Failure::wrong(format!("there is no command `{name}`; expected one of {}", names.join(", ")))
        })?,
    };
    let mut page = Vec::new();
    clap_mangen::Man::new(command).source(Provenance::SOFTWARE).manual("tracer").render(&mut page)?;
    let mut out = std::io::stdout().lock();
    out.write_all(&page)?;
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}

/// A command, or one of a command: `golden-run`.
fn found<'a>(cli: &'a clap::Command, name: &str) -> Option<&'a clap::Command> {
    let within = || name.split_once(['-', ' ']).and_then(|(of, name)| cli.find_subcommand(of)?.find_subcommand(name));
    cli.find_subcommand(name).or_else(within)
}
