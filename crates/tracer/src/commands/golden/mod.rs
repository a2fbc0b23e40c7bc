//! `tracer golden`: pictures that must stay what they are. The pictures of this repository (`golden/`) go through
//! [`Opened`], too.

mod accept;
mod examine;
mod host_path;
mod made;
mod new;
mod rendering;
mod run;

pub use examine::{Examined, Opened, colours};
pub use made::Made;
pub use rendering::{NoPicture, Rendered, make};

use crate::args::GoldenCommand;
use crate::failure::Failure;
use crate::shell::Shell;
use std::process::ExitCode;

pub(super) fn run(command: &GoldenCommand, shell: &Shell) -> Result<ExitCode, Failure> {
    match command {
        GoldenCommand::New(args) => new::run(args, shell),
        GoldenCommand::Run(args) => run::run(args, shell),
        GoldenCommand::Accept(args) => accept::run(args, shell),
    }
}
