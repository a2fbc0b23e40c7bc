//! `tracer completions`: a script that completes command lines.

use crate::args::{Cli, CompletionsArgs};
use crate::failure::{Failure, exit};
use clap::CommandFactory;
use std::io::Write;
use std::process::ExitCode;

pub(super) fn run(args: &CompletionsArgs) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "tracer", &mut script);
    let mut out = std::io::stdout().lock();
    out.write_all(&script)?;
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}
