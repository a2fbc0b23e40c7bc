//! Signals: noted, and a bell rung for whoever waits.

use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGWINCH};
use signal_hook::{flag, low_level};
use std::io;
use std::os::unix::net::UnixStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The signals that end a program.
const ENDS: [i32; 4] = [SIGTERM, SIGHUP, SIGINT, SIGQUIT];

pub struct Signals {
    ended: Arc<AtomicUsize>,
    resized: Arc<AtomicBool>,
    continued: Arc<AtomicBool>,
    registered: Vec<signal_hook::SigId>,
    /// Rings when there is a signal, or other news.
    pub bell: UnixStream,
    rope: UnixStream,
}

impl Signals {
    /// From now on they are noted.
    ///
    /// # Errors
    /// When the system lets nobody listen.
    pub fn listen() -> io::Result<Self> {
        let (bell, rope) = UnixStream::pair()?;
        bell.set_nonblocking(true)?;
        // Where it rings already, nobody has to wait to pull it.
        rope.set_nonblocking(true)?;
        let ended = Arc::new(AtomicUsize::new(0));
        let [resized, continued] = [(); 2].map(|()| Arc::new(AtomicBool::new(false)));
        let mut registered = Vec::new();
        for signal in ENDS {
            registered.push(flag::register_usize(signal, Arc::clone(&ended), signal.unsigned_abs() as usize)?);
            registered.push(low_level::pipe::register(signal, rope.try_clone()?)?);
        }
        for (signal, noted) in [(SIGWINCH, &resized), (SIGCONT, &continued)] {
            registered.push(flag::register(signal, Arc::clone(noted))?);
            registered.push(low_level::pipe::register(signal, rope.try_clone()?)?);
        }
        Ok(Signals { ended, resized, continued, registered, bell, rope })
    }

    /// What rings the bell.
    ///
    /// # Errors
    /// When the system has no more files for us.
    pub fn rope(&self) -> io::Result<UnixStream> {
        self.rope.try_clone()
    }

    /// The signal that ends the program.
    pub fn end(&self) -> Option<i32> {
        Some(self.ended.load(Ordering::Relaxed) as i32).filter(|&signal| signal != 0)
    }

    /// Whether the terminal may have another size; asked once.
    pub fn resized(&self) -> bool {
        self.resized.swap(false, Ordering::Relaxed)
    }

    /// Whether the program was stopped, and goes on; asked once.
    pub fn continued(&self) -> bool {
        self.continued.swap(false, Ordering::Relaxed)
    }
}

impl Drop for Signals {
    fn drop(&mut self) {
        for id in self.registered.drain(..) {
            low_level::unregister(id);
        }
    }
}

/// Stops the program, as Ctrl-Z does, until it is told to go on.
pub fn stop() {
    // Where nobody could tell it to go on, the system does not stop it.
    let _ = low_level::raise(signal_hook::consts::SIGTSTP);
}
