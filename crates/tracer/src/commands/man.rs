//! `tracer man`: the manual pages, one of the program and one of each command.

use crate::args::{Cli, ManArgs};
use crate::failure::{Failure, exit};
use crate::write::Provenance;
use clap::CommandFactory;
use std::io::{IsTerminal, Write};
use std::process::{Command, ExitCode, Stdio};

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
    // What stands behind the options are examples.
    let page = String::from_utf8_lossy(&page).replace(".SH EXTRA", ".SH EXAMPLES") + SECTIONS;
    if std::io::stdout().is_terminal() && shown(&page) {
        return Ok(ExitCode::from(exit::DONE));
    }
    let mut out = std::io::stdout().lock();
    out.write_all(page.as_bytes())?;
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}

/// What all pages end with.
const SECTIONS: &str = r#"
.SH "EXIT STATUS"
.TP
0
All is done.
.TP
1
It could not be done, or pictures that were compared are not the same.
.TP
2
The command line, a scene or another file is wrong, or a file is there already that is not replaced unasked.
.TP
129, 130, 143
It was interrupted by SIGHUP, SIGINT or SIGTERM; what there was of the picture is written.
.SH FILES
.TP
\fISCENE\fR.ron, .toml, .json
Scenes.
.TP
\fIFILE\fR.tracer
Parts and checkpoints: samples that may be gone on with and merged.
.TP
golden.toml
Settings of a folder of golden pictures.
.SH ENVIRONMENT
.TP
NO_COLOR
Messages have no colours.
.TP
TRACER_OIDN
Where Open Image Denoise is, a folder or the library itself, for \fB\-\-denoise oidn\fR.
"#;

/// Shows a page to a person, as `man` does; `false` where there is no such program, or it cannot.
fn shown(page: &str) -> bool {
    let man = Command::new("man").args(["-l", "-"]).stdin(Stdio::piped()).stderr(Stdio::null()).spawn();
    let Ok(mut man) = man else { return false };
    if let Some(mut input) = man.stdin.take() {
        // Whoever leaves before its end has seen enough.
        let _ = input.write_all(page.as_bytes());
    }
    man.wait().is_ok_and(|status| status.success())
}

/// A command, or one of a command: `golden-run`.
fn found<'a>(cli: &'a clap::Command, name: &str) -> Option<&'a clap::Command> {
    let within = || name.split_once(['-', ' ']).and_then(|(of, name)| cli.find_subcommand(of)?.find_subcommand(name));
    cli.find_subcommand(name).or_else(within)
}
