//! Slurm's own programs: what is submitted, asked and cancelled.

use crate::command_line::quoted;
use crate::failure::Failure;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::process::{Command, Output};

/// A job that waits or runs, or a task of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Queued {
    /// Its number; of a task that of the array.
    pub job: String,
    /// The task.
    pub task: Option<u32>,
    /// Slurm's word: `PENDING`, `RUNNING`.
    pub state: String,
    /// Where it runs, or nothing.
    pub node: String,
    /// For how long it has run.
    pub time: String,
    /// Why it waits.
    pub why: String,
}

impl Queued {
    /// Whether it has a node.
    pub fn is_running(&self) -> bool {
        const WITH_NODE: [&str; 7] =
            ["RUNNING", "COMPLETING", "CONFIGURING", "SIGNALING", "STAGE_OUT", "SUSPENDED", "STOPPED"];
        WITH_NODE.contains(&self.state.as_str())
    }
}

/// Runs one of Slurm's programs.
fn run(program: &str, arguments: &[String]) -> Result<Output, Failure> {
    Command::new(program).args(arguments).output().map_err(|error| match error.kind() {
        ErrorKind::NotFound => Failure::could_not(format!(
            "there is no {program} here: run this where Slurm's programs are (they come with the cluster). \
             `tracer farm slurm .. --dry-run` shows what would be submitted, docs/scale.md how to do without Slurm"
        )),
        _ => Failure::could_not(format!("cannot run {program}: {error}")),
    })
}

/// What it has written, if it has done what it should.
fn done(program: &str, arguments: &[String]) -> Result<String, Failure> {
    let output = run(program, arguments)?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let words: Vec<String> = arguments.iter().map(|word| quoted(word)).collect();
    Err(Failure::could_not(format!("{program} fails: {}\n  of: {program} {}", said.trim(), words.join(" "))))
}

/// Submits a job; gives its number.
///
/// # Errors
/// When Slurm does not take it.
pub fn submit(arguments: &[String]) -> Result<String, Failure> {
    let said = done("sbatch", arguments)?;
    // With several clusters the number is followed by the cluster's name.
    let job = said.trim().lines().last().unwrap_or_default().split(';').next().unwrap_or_default().to_owned();
    if job.is_empty() || !job.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(Failure::could_not(format!("sbatch does not tell a job's number, but: {}", said.trim())));
    }
    Ok(job)
}

/// The largest number of a task that the cluster takes, where it tells.
///
/// # Errors
/// When Slurm cannot be asked.
pub fn largest_task() -> Result<Option<u32>, Failure> {
    Ok(largest_task_of(&done("scontrol", &["show".to_owned(), "config".to_owned()])?))
}

fn largest_task_of(config: &str) -> Option<u32> {
    let line = config.lines().find(|line| line.trim_start().starts_with("MaxArraySize"))?;
    // Its own documentation: the largest number is one less.
    line.split_once('=')?.1.trim().parse::<u32>().ok()?.checked_sub(1)
}

/// What waits or runs of these jobs.
///
/// # Errors
/// When Slurm cannot be asked.
pub fn queue(jobs: &[String]) -> Result<Vec<Queued>, Failure> {
    if jobs.is_empty() {
        return Ok(Vec::new());
    }
    let format = "--format=%F|%K|%T|%N|%M|%r".to_owned();
    let told = squeue(&["--noheader".to_owned(), "--array".to_owned(), format, format!("--jobs={}", jobs.join(","))])?;
    Ok(told.lines().filter_map(queued).collect())
}

/// The folder that a job was submitted for.
///
/// # Errors
/// When Slurm cannot be asked.
pub fn folder_of(job: &str) -> Result<Option<PathBuf>, Failure> {
    let words = ["--noheader", "--states=all", "--format=%Z"].map(str::to_owned);
    let told = squeue(&[&words[..], &[format!("--jobs={job}")]].concat())?;
    Ok(told.lines().next().map(|line| PathBuf::from(line.trim_end())).filter(|path| path.is_absolute()))
}

fn squeue(arguments: &[String]) -> Result<String, Failure> {
    let output = run("squeue", arguments)?;
    let said = String::from_utf8_lossy(&output.stderr);
    // Slurm forgets jobs some minutes after their end.
    if !output.status.success() && said.contains("Invalid job id") {
        return Ok(String::new());
    }
    if !output.status.success() {
        return Err(Failure::could_not(format!("squeue fails: {}", said.trim())));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

fn queued(line: &str) -> Option<Queued> {
    let fields: Vec<&str> = line.trim().splitn(6, '|').map(str::trim).collect();
    let [job, task, state, node, time, why] = fields[..] else { return None };
    let owned = str::to_owned;
    let task = task.parse().ok();
    Some(Queued { job: job.into(), task, state: owned(state), node: owned(node), time: owned(time), why: owned(why) })
}

/// Cancels jobs.
///
/// # Errors
/// When Slurm does not.
pub fn cancel(jobs: &[String]) -> Result<(), Failure> {
    if jobs.is_empty() {
        return Ok(());
    }
    done("scancel", jobs).map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_slurm_says_is_read() {
        let running = queued("4|2|RUNNING|n7|1:02:03|None").expect("a line");
        assert_eq!((running.job.as_str(), running.task, running.is_running()), ("4", Some(2), true));
        let waiting = queued("5|N/A|PENDING||0:00|Dependency").expect("a line");
        assert_eq!((waiting.task, waiting.is_running(), waiting.why.as_str()), (None, false, "Dependency"));
        assert_eq!(queued("slurm_load_jobs error"), None);
        assert_eq!(largest_task_of("A = 1\nMaxArraySize            = 1001\n"), Some(1000));
        assert_eq!(largest_task_of("A = 1\n"), None);
    }
}
