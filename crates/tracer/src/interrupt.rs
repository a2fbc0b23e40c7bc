//! Ctrl-C: the first one is a wish that the rendering heeds, the second one ends the program.

use crate::failure::{Failure, exit};
use crate::shell::{Shell, Verbosity};
use crate::write::remove_unfinished;
use std::sync::atomic::{AtomicUsize, Ordering};

static COUNT: AtomicUsize = AtomicUsize::new(0);

/// From now on Ctrl-C is a wish.
///
/// # Errors
/// When the system lets nobody listen.
pub fn listen(shell: Shell) -> Result<(), Failure> {
    ctrlc::set_handler(move || {
        if COUNT.fetch_add(1, Ordering::SeqCst) > 0 {
            remove_unfinished();
            std::process::exit(exit::INTERRUPTED.into());
        }
        if shell.verbosity > Verbosity::Quiet {
            shell.say("\nstopping; another Ctrl-C leaves at once, without a picture");
        }
    })
    .map_err(|error| Failure::could_not(format!("cannot listen for Ctrl-C: {error}")))
}

/// Whether there was a Ctrl-C.
pub fn requested() -> bool {
    COUNT.load(Ordering::SeqCst) > 0
}
