//! Ctrl-C and the signals that end a program (SIGTERM of `docker stop`, Slurm or systemd, SIGHUP of a lost ssh): the
//! first one is a wish that the rendering heeds, the second one ends the program.

use crate::failure::{Failure, exit};
use crate::shell::{Shell, Verbosity};
use crate::write::remove_unfinished;
use std::sync::atomic::{AtomicU8, Ordering};
#[cfg(unix)]
use std::time::{Duration, Instant};

/// The exit code that the first signal asks for; 0: there was none.
static ASKED: AtomicU8 = AtomicU8::new(0);

/// A terminal that goes away sends SIGHUP, and so does the shell in it; a scheduler sends SIGTERM to all processes of a
/// job, and so does the script that it has started; the end of a session sends one after the other. Within this time it
/// is one wish.
#[cfg(unix)]
const ONE_WISH: Duration = Duration::from_secs(1);

/// From now on Ctrl-C and the signals that end a program are wishes.
///
/// # Errors
/// When the system lets nobody listen.
pub fn listen(shell: Shell) -> Result<(), Failure> {
    by_system(shell).map_err(|error| Failure::could_not(format!("cannot listen for Ctrl-C: {error}")))
}

#[cfg(unix)]
fn by_system(shell: Shell) -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    // Whoever started us with `nohup` wants no end when the terminal goes; a shell that has put us into the background
    // of a script wants none by the Ctrl-C that ends the script.
    let ignored = ignored();
    let asked =
        [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| *signal == SIGTERM || ignored >> (signal - 1) & 1 == 0);
    let mut signals = signal_hook::iterator::Signals::new(asked)?;
    std::thread::Builder::new().name("signals".to_owned()).spawn(move || {
        let mut last: Option<(i32, Instant)> = None;
        for signal in &mut signals {
            // None of them is a person's, who presses Ctrl-C twice and means it.
            let again = last.is_some_and(|(before, at)| before != SIGINT && at.elapsed() < ONE_WISH);
            if again && signal != SIGINT {
                continue;
            }
            last = Some((signal, Instant::now()));
            match signal {
                SIGTERM => came("SIGTERM", exit::TERMINATED, shell),
                SIGHUP => came("SIGHUP", exit::HUNG_UP, shell),
                _ => came("Ctrl-C", exit::INTERRUPTED, shell),
            }
        }
    })?;
    Ok(())
}

/// From now on a file that would be larger than the system allows (`ulimit -f`) is an error of its writing, as a full
/// disk is, and does not end the program.
///
/// # Errors
/// When the system lets nobody say so.
#[cfg(unix)]
pub fn outlive_large_files() -> std::io::Result<()> {
    use signal_hook::consts::SIGXFSZ;
    signal_hook::flag::register(SIGXFSZ, std::sync::Arc::default()).map(drop)
}

/// The signals that were ignored when the program started, as Linux tells, bit `n - 1` for signal `n`; elsewhere all
/// are taken to be heeded.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

#[cfg(not(unix))]
fn by_system(shell: Shell) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(move || came("Ctrl-C", exit::INTERRUPTED, shell))
}

/// Heeds a signal.
fn came(name: &str, code: u8, shell: Shell) {
    if ASKED.compare_exchange(0, code, Ordering::SeqCst, Ordering::SeqCst).is_err() {
        remove_unfinished();
        std::process::exit(code.into());
    }
    if shell.verbosity > Verbosity::Quiet {
        shell.say(&format!("\nstopping; another {name} leaves at once, without a picture"));
    }
}

/// The exit code that a signal has asked for, if there was one.
pub fn requested() -> Option<u8> {
    Some(ASKED.load(Ordering::SeqCst)).filter(|&code| code != 0)
}
