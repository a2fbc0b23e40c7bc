//! `tracer man`: the manual pages, one of the program and one of each command.

use crate::args::{Cli, ManArgs};
use crate::failure::{Failure, exit};
use crate::write::Provenance;
use clap::{Arg, ArgAction, CommandFactory};
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
    let (mut page, synopsis) = (Vec::new(), synopsis(&command));
    clap_mangen::Man::new(command).source(Provenance::SOFTWARE).manual("tracer").render(&mut page)?;
    // What stands behind the options are examples.
    let page = with_synopsis(&String::from_utf8_lossy(&page), &synopsis).replace(".SH EXTRA", ".SH EXAMPLES");
    // A page has all commands.
    let page: String = page.split_inclusive('\n').filter(|line| !line.starts_with("More: ")).collect();
    let page = page + SECTIONS;
    if std::io::stdout().is_terminal() && shown(&page) {
        return Ok(ExitCode::from(exit::DONE));
    }
    let mut out = std::io::stdout().lock();
    out.write_all(page.as_bytes())?;
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}

/// A page whose synopsis is this one: that of the library leaves out what options take.
fn with_synopsis(page: &str, synopsis: &str) -> String {
    const HEAD: &str = ".SH SYNOPSIS\n";
    let Some((before, rest)) = page.split_once(HEAD) else { return page.to_owned() };
    let after = rest.find(".SH ").map_or("", |at| &rest[at..]);
    format!("{before}{HEAD}{synopsis}\n{after}")
}

/// How a command is written, all of it: `tracer check [--set PATH=VALUE]... SCENE...`.
fn synopsis(command: &clap::Command) -> String {
    let name = command.get_bin_name().unwrap_or_else(|| command.get_name());
    let mut words = vec![format!("\\fB{}\\fR", escaped(name))];
    let (positional, options): (Vec<&Arg>, Vec<&Arg>) =
        command.get_arguments().filter(|arg| !arg.is_hide_set()).partition(|arg| arg.is_positional());
    words.extend(options.into_iter().chain(positional).map(written));
    if command.has_subcommands() {
        words.push("\\fICOMMAND\\fR".to_owned());
    }
    words.join(" ")
}

/// How an argument is written.
fn written(arg: &Arg) -> String {
    let values: Vec<String> = arg.get_value_names().unwrap_or_default().iter().map(|name| escaped(name)).collect();
    let values = format!("\\fI{}\\fR", values.join(" "));
    let takes = arg.get_action().takes_values();
    let name = match (arg.get_short(), arg.get_long()) {
        _ if arg.is_positional() => values,
        (Some(short), _) if takes => format!("\\fB\\-{short}\\fR {values}"),
        (Some(short), _) => format!("\\fB\\-{short}\\fR"),
        (None, Some(long)) if arg.is_require_equals_set() => format!("\\fB\\-\\-{}\\fR[={values}]", escaped(long)),
        (None, Some(long)) if takes => format!("\\fB\\-\\-{}\\fR {values}", escaped(long)),
        (None, long) => format!("\\fB\\-\\-{}\\fR", escaped(long.unwrap_or_default())),
    };
    let many = matches!(arg.get_action(), ArgAction::Append)
        || arg.is_positional() && arg.get_num_args().is_some_and(|range| range.max_values() > 1);
    let name = if arg.is_required_set() { name } else { format!("[{name}]") };
    if many { name + "..." } else { name }
}

/// Hyphens as roff writes those that are typed.
fn escaped(text: &str) -> String {
    text.replace('\\', "\\e").replace('-', "\\-")
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
