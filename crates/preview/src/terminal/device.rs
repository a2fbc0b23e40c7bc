//! The terminal as a device: opened by itself, so that it may be asked not to keep us waiting without that being so
//! for the shell as well; and left as it was, whatever happens.

use crate::shared::lock;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::OFlags;
use rustix::termios::{OptionalActions, QueueSelector, Termios, tcflush, tcgetattr, tcgetwinsize, tcsetattr, ttyname};
use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Read, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Another screen, so that what was there comes back; no cursor; lines that are too long are cut.
const ENTER: &str = "\x1b[?1049h\x1b[?25l\x1b[?7l\x1b[2J";
/// All of that undone. The first two end what may have been cut: a text, and an update of the screen.
const LEAVE: &str = "\x1b\\\x1b[?2026l\x1b[0m\x1b[?7h\x1b[?25h\x1b[?1049l";
/// A terminal that takes nothing gets so long to take the last words.
const LAST_WORDS: Duration = Duration::from_millis(500);

/// What has to be put back; whoever takes it out does so, once.
static BEFORE: Mutex<Option<Before>> = Mutex::new(None);

struct Before {
    file: File,
    settings: Termios,
    /// What takes pictures off the screen.
    farewell: String,
}

/// What woke us.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Woken {
    /// There are news, or a signal.
    pub rung: bool,
    /// The terminal is gone, with all that was in it.
    pub gone: bool,
}

/// Size of a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    pub columns: u16,
    pub rows: u16,
    /// Width and height of a cell in pixels, where the system knows.
    pub cell: Option<[u32; 2]>,
}

pub struct Device {
    file: File,
}

impl Device {
    /// The terminal that standard output is.
    ///
    /// # Errors
    /// When it is none, or cannot be opened.
    pub fn open() -> io::Result<Self> {
        let flags = OFlags::NOCTTY | OFlags::NONBLOCK;
        let open = |path: PathBuf| {
            OpenOptions::new().read(true).write(true).custom_flags(flags.bits().cast_signed()).open(path)
        };
        let named = ttyname(io::stdout(), Vec::new()).map_err(io::Error::from).and_then(|name| {
            let name = name.into_string().map_err(|_| io::Error::from(ErrorKind::InvalidFilename))?;
            open(name.into())
        });
        // In a container the name may be one of outside.
        let file = named.or_else(|error| open("/dev/tty".into()).map_err(|_| error))?;
        tcgetattr(&file)?;
        Ok(Device { file })
    }

    /// Keys come as they are pressed, and the screen is ours.
    ///
    /// # Errors
    /// When the system does not let us.
    pub fn enter(&self) -> io::Result<()> {
        let settings = tcgetattr(&self.file)?;
        let mut raw = settings.clone();
        raw.make_raw();
        let file = self.file.try_clone()?;
        // What was before us is kept, whatever became of the settings meanwhile.
        lock(&BEFORE).get_or_insert(Before { file, settings, farewell: String::new() });
        tcsetattr(&self.file, OptionalActions::Now, &raw)?;
        write(&self.file, ENTER.as_bytes(), || false, Some(LAST_WORDS)).map(drop)
    }

    /// What is written before the terminal is left.
    pub fn on_leaving(&self, farewell: String) {
        if let Some(before) = &mut *lock(&BEFORE) {
            before.farewell = farewell;
        }
    }

    /// Columns, rows, and what is known of cells.
    pub fn size(&self) -> Size {
        let Ok(size) = tcgetwinsize(&self.file) else { return Size { columns: 80, rows: 24, cell: None } };
        // Serial lines know of none.
        let (columns, rows) = if size.ws_col == 0 || size.ws_row == 0 { (80, 24) } else { (size.ws_col, size.ws_row) };
        let cell = [u32::from(size.ws_xpixel / columns), u32::from(size.ws_ypixel / rows)];
        Size { columns, rows, cell: cell.iter().all(|&side| side > 0).then_some(cell) }
    }

    /// What has come; empty: nothing has.
    ///
    /// # Errors
    /// When the terminal is gone.
    pub fn read(&mut self) -> io::Result<Vec<u8>> {
        let mut bytes = [0; 4096];
        loop {
            match self.file.read(&mut bytes) {
                Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
                Ok(length) => return Ok(bytes[..length].to_vec()),
                Err(error) if error.kind() == ErrorKind::WouldBlock => return Ok(Vec::new()),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Waits for keys, or to be woken, no longer than this.
    pub fn wait(&self, bell: &UnixStream, longest: Duration) -> Woken {
        let mut both = [PollFd::new(&self.file, PollFlags::IN), PollFd::new(bell, PollFlags::IN)];
        let longest =
            Timespec { tv_sec: longest.as_secs().min(3600).cast_signed(), tv_nsec: longest.subsec_nanos().into() };
        // A signal is one of the things that may wake us.
        let _ = poll(&mut both, Some(&longest));
        let (terminal, rung) = (both[0].revents(), both[1].revents());
        if rung.contains(PollFlags::IN) {
            // It rings once, however often it was pulled.
            let mut bell = bell;
            while bell.read(&mut [0; 64]).is_ok_and(|length| length > 0) {}
        }
        let gone = terminal.intersects(PollFlags::HUP | PollFlags::ERR | PollFlags::NVAL);
        Woken { rung: rung.contains(PollFlags::IN), gone: gone && !terminal.contains(PollFlags::IN) }
    }

    /// Writes all of it, unless `ends` meanwhile; whether it did.
    ///
    /// # Errors
    /// When the terminal is gone.
    pub fn write(&self, bytes: &[u8], ends: impl Fn() -> bool) -> io::Result<bool> {
        write(&self.file, bytes, ends, None)
    }
}

/// Writes to a terminal that may take nothing for a while.
fn write(mut file: &File, mut bytes: &[u8], ends: impl Fn() -> bool, longest: Option<Duration>) -> io::Result<bool> {
    const LOOK: Timespec = Timespec { tv_sec: 0, tv_nsec: 50_000_000 };
    let began = Instant::now();
    while !bytes.is_empty() {
        match file.write(bytes) {
            Ok(0) => return Err(ErrorKind::WriteZero.into()),
            Ok(length) => bytes = &bytes[length..],
            Err(error) if error.kind() == ErrorKind::WouldBlock => {
                if ends() || longest.is_some_and(|longest| began.elapsed() > longest) {
                    return Ok(false);
                }
                let _ = poll(&mut [PollFd::new(&file, PollFlags::OUT)], Some(&LOOK));
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(true)
}

/// Leaves the terminal as it was, if it is not yet.
pub fn leave() {
    let before = lock(&BEFORE).take();
    let Some(Before { file, settings, farewell }) = before else { return };
    // One that is gone needs none of this.
    let words = format!("\x1b\\{farewell}{LEAVE}");
    let _ = write(&file, words.as_bytes(), || false, Some(LAST_WORDS));
    // Answers that came late are not for the shell.
    let _ = tcflush(&file, QueueSelector::IFlush);
    let _ = tcsetattr(&file, OptionalActions::Now, &settings);
}

/// Leaves the terminal when it goes out of scope.
pub struct Leaving;

impl Drop for Leaving {
    fn drop(&mut self) {
        leave();
    }
}

/// Whether there is a message of a panic to be told, once the terminal is left.
static PANICS: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Has panics of this thread leave the terminal before they are told, and those of others told afterwards: the
/// picture would be written over. What the hook was is put back when this goes out of scope.
pub struct Panics {
    before: std::sync::Arc<dyn Fn(&std::panic::PanicHookInfo<'_>) + Send + Sync>,
    on: std::sync::Arc<AtomicBool>,
}

impl Panics {
    pub fn listen() -> Self {
        let before: std::sync::Arc<dyn Fn(&std::panic::PanicHookInfo<'_>) + Send + Sync> =
            std::panic::take_hook().into();
        let on = std::sync::Arc::new(AtomicBool::new(true));
        let (tell, told, here) =
            (std::sync::Arc::clone(&before), std::sync::Arc::clone(&on), std::thread::current().id());
        std::panic::set_hook(Box::new(move |panic| {
            if told.load(Ordering::Relaxed) && std::thread::current().id() != here {
                lock(&PANICS).push(panic.to_string());
            } else {
                leave();
                tell(panic);
            }
        }));
        Panics { before, on }
    }
}

impl Drop for Panics {
    fn drop(&mut self) {
        self.on.store(false, Ordering::Relaxed);
        leave();
        for panic in lock(&PANICS).drain(..) {
            // That nobody reads it is no reason to fail.
            let _ = writeln!(io::stderr(), "{panic}");
        }
        // Of a thread that panics the hook cannot be changed; it ends with it.
        if !std::thread::panicking() {
            let before = std::sync::Arc::clone(&self.before);
            std::panic::set_hook(Box::new(move |panic| before(panic)));
        }
    }
}
