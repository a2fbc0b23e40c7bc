//! `tracer farm`: a rendering in parts on many machines, by Slurm.

mod cancel;
mod parts;
mod queue;
mod record;
mod scripts;
mod settings;
mod slurm;
mod status;

use crate::args::FarmCommand;
use crate::failure::Failure;
use crate::shell::Shell;
use std::process::ExitCode;

pub(super) fn run(command: &FarmCommand, shell: &Shell) -> Result<ExitCode, Failure> {
    match command {
        FarmCommand::Slurm(args) => slurm::run(args, shell),
        FarmCommand::Status(args) => status::run(args),
        FarmCommand::Cancel(args) => cancel::run(args, shell),
    }
}
