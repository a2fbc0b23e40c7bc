//! The command line of tracer. The fifth hand, [`write()`], which puts a developed picture into a file, is a crate of
//! its own, `tracer_picture`.
#![forbid(unsafe_code)]

pub mod args;
pub mod cache;
pub mod checkpoint;
pub mod command_line;
pub mod commands;
pub mod compare;
pub mod denoising;
pub mod failure;
pub mod frames;
pub mod help;
pub mod interrupt;
pub mod lanes;
pub mod layer_view;
pub mod loading;
pub mod memory;
pub mod merge_report;
pub mod opening;
pub mod progress;
pub mod report;
pub mod shell;
pub mod write;

pub use write::write;

use args::{Cli, Command, DiagnosticsForm, When};
use clap::{ColorChoice, FromArgMatches};
use failure::{Failure, exit};
use scene_format::render::json_error;
use shell::{Shell, Verbosity};
use std::process::ExitCode;
use std::time::Instant;

/// The program: reads the command line, does what it says, and gives the exit code.
pub fn main() -> ExitCode {
    let started = Instant::now();
    let arguments = help::meant(std::env::args_os().collect());
    let asked = arguments.iter().take_while(|argument| *argument != "--").any(|argument| argument == "--help");
    let words = if asked { help::whole() } else { help::command() };
    let matches = words.color(color_of_help(&arguments)).try_get_matches_from(&arguments);
    let cli = match matches.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) => {
            let error = help::with_tip(error, &arguments);
            // Help goes to standard output, faults to standard error; that nobody reads them is no reason to fail.
            let _ = error.print();
            return ExitCode::from(if error.use_stderr() { exit::WRONG } else { exit::DONE });
        }
    };
    let quiet = match &cli.command {
        Command::Render(args) => args.quiet,
        Command::Merge(args) => args.quiet,
        Command::Repro(args) => args.quiet,
        Command::Check(args) => args.quiet,
        Command::Compare(args) => args.quiet,
        _ => false,
    };
    let verbosity = match (quiet, cli.verbose) {
        (true, _) => Verbosity::Quiet,
        (false, false) => Verbosity::Normal,
        (false, true) => Verbosity::Verbose,
    };
    let shell = Shell::new(cli.color, verbosity, cli.allow);
    // Where the system does not let us, such a file ends the program, as it always did.
    #[cfg(unix)]
    let _ = interrupt::outlive_large_files();
    commands::run(&cli.command, &shell, started).unwrap_or_else(|failure| {
        if let Failure::Wrong(error) | Failure::CouldNot(error) = &failure {
            match form(&cli.command) {
                DiagnosticsForm::Json => shell.say(&json_error(&format!("{error:#}"))),
                _ => shell.error(error),
            }
        }
        failure.exit_code()
    })
}

/// How a command tells what is wrong.
fn form(command: &Command) -> DiagnosticsForm {
    match command {
        Command::Render(args) => args.scene.diagnostics,
        Command::Info(args) => args.scene.diagnostics,
        Command::Check(args) => args.diagnostics,
        _ => DiagnosticsForm::Text,
    }
}

/// `--color` for help and for faults of the command line itself, which end the reading of it.
fn color_of_help(arguments: &[std::ffi::OsString]) -> ColorChoice {
    let mut choice = When::Auto;
    for (k, argument) in arguments.iter().enumerate() {
        let value = match argument.to_str() {
            Some("--color") => arguments.get(k + 1).and_then(|value| value.to_str()),
            Some(argument) => argument.strip_prefix("--color="),
            None => None,
        };
        choice = match value {
            Some("always") => When::Always,
            Some("never") => When::Never,
            _ => choice,
        };
    }
    match choice {
        When::Auto => ColorChoice::Auto,
        When::Always => ColorChoice::Always,
        When::Never => ColorChoice::Never,
    }
}
