//! `tracer farm cancel`: no job of it waits or runs any more, and all films stay.

use super::parts::{self, State};
use super::queue;
use super::record::find;
use crate::args::FarmCancelArgs;
use crate::command_line::quoted;
use crate::failure::{Failure, exit};
use crate::shell::Shell;
use std::path::Path;
use std::process::ExitCode;

pub(super) fn run(args: &FarmCancelArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    for farm in &args.farms {
        cancel(farm, shell)?;
    }
    Ok(ExitCode::from(exit::DONE))
}

fn cancel(farm: &Path, shell: &Shell) -> Result<(), Failure> {
    let (layout, record) = find(farm)?;
    let shown = layout.folder.display();
    let jobs: Vec<String> = record.arrays.iter().chain(&record.merge).cloned().collect();
    let queued = queue::queue(&jobs)?;
    let in_queue = |job: &&String| queued.iter().any(|entry| entry.job == **job);
    // The merge first: it would begin when the parts have ended.
    let merge: Vec<String> = record.merge.iter().filter(in_queue).cloned().collect();
    let arrays: Vec<String> = record.arrays.iter().filter(in_queue).cloned().collect();
    if merge.is_empty() && arrays.is_empty() {
        shell.say(&format!("{shown}: no job of it waits or runs"));
        return Ok(());
    }
    queue::cancel(&merge)?;
    queue::cancel(&arrays)?;
    let done = parts::parts(&layout, &record, &[]).iter().filter(|told| told.state == State::Done).count();
    let jobs = [arrays, merge].concat().join(", ");
    let words: Vec<String> = record.command.iter().map(|word| quoted(word)).collect();
    shell
        .say(&format!("{shown}: cancelled jobs {jobs}; {done} of {} parts are done, all films are kept", record.parts));
    shell.say(&format!("to go on: cd {} && {}", quoted(&record.directory), words.join(" ")));
    Ok(())
}
