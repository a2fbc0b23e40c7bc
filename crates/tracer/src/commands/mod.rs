//! One file per command.

mod bench_acceleration;
mod bench_figures;
mod check;
mod compare;
mod compare_folders;
mod completions;
mod convert;
mod explain;
mod farm;
mod fix;
mod fmt;
mod from_picture;
pub mod golden;
mod info;
mod inspect;
mod lsp;
mod man;
mod marks;
pub(crate) mod merge;
mod new;
mod preview;
mod render;
mod repro;
mod scenes;
mod schema;

pub use completions::CompletedShell;
pub use new::Template;

use crate::args::Command;
use crate::failure::Failure;
use crate::shell::Shell;
use std::process::ExitCode;
use std::time::Instant;

/// Does what the command says; `started` is when the program began.
///
/// # Errors
/// Why it was not done.
pub fn run(command: &Command, shell: &Shell, started: Instant) -> Result<ExitCode, Failure> {
    match command {
        Command::Render(args) => render::run(args, shell, started),
        Command::Merge(args) => merge::run(args, shell, started),
        Command::Farm(args) => farm::run(&args.command, shell),
        Command::Preview(args) => preview::run(args, shell),
        Command::Check(args) => check::run(args, shell),
        Command::Info(args) => info::run(args, shell),
        Command::Inspect(args) => inspect::run(args, shell),
        Command::Marks(args) => marks::run(args, shell),
        Command::Convert(args) => convert::run(args, shell),
        Command::Fmt(args) => fmt::run(args, shell),
        Command::New(args) => new::run(args, shell),
        Command::Repro(args) => repro::run(args, shell),
        Command::Compare(args) => compare::run(args),
        Command::Golden(args) => golden::run(&args.command, shell),
        Command::BenchAcceleration(args) => bench_acceleration::run(args, shell),
        Command::BenchFigures(args) => bench_figures::run(args, shell),
        Command::Explain(args) => explain::run(args),
        Command::Schema => schema::run(),
        Command::Completions(args) => completions::run(args),
        Command::Lsp => lsp::run(),
        Command::Man(args) => man::run(args),
    }
}
