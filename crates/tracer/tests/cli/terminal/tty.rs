//! A terminal of our own: the program at one end, a screen that is read at the other.

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{Termios, Winsize, tcgetattr, tcsetwinsize};
use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::num::NonZero;
use std::process::{Child, Command};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// What comes late because other tests run beside it must not fail.
const PATIENCE: Duration = Duration::from_secs(60);

/// What a terminal of xterm's kind answers to what it is asked; the last word of each question, and the answer.
pub const XTERM: &[(&str, &str)] = &[("\x1b[c", "\x1b[?62;22c")];

/// A program in a terminal.
pub struct Tty {
    master: File,
    /// The other end, so that its settings can be read when the program has ended.
    slave: File,
    before: Termios,
    child: Child,
    seen: Arc<Mutex<Seen>>,
}

struct Seen {
    screen: vt100::Parser,
    /// All that was written.
    bytes: Vec<u8>,
}

fn side(n: u16) -> NonZero<u16> {
    NonZero::new(n).expect("a terminal has columns and rows")
}

fn winsize([columns, rows]: [u16; 2], cell: [u16; 2]) -> Winsize {
    Winsize { ws_col: columns, ws_row: rows, ws_xpixel: columns * cell[0], ws_ypixel: rows * cell[1] }
}

impl Tty {
    /// Starts a program in a terminal of so many columns and rows that gives these answers; a cell in pixels, or 0.
    pub fn start(command: &mut Command, size: [u16; 2], cell: [u16; 2], answers: Answers) -> Self {
        let mut tty = Tty::deaf(command, size, cell);
        tty.listen(answers);
        tty
    }

    /// The same, but that nobody reads what is written.
    pub fn deaf(command: &mut Command, size: [u16; 2], cell: [u16; 2]) -> Self {
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a terminal");
        grantpt(&master).expect("a terminal");
        unlockpt(&master).expect("a terminal");
        tcsetwinsize(&master, winsize(size, cell)).expect("a size");
        let name = ptsname(&master, Vec::new()).expect("a name").into_string().expect("a name");
        let slave = OpenOptions::new().read(true).write(true).open(name).expect("its other end");
        let before = tcgetattr(&slave).expect("settings");
        let end = || slave.try_clone().expect("its other end");
        let child = command.stdin(end()).stdout(end()).stderr(end()).spawn().expect("the program starts");
        let screen = vt100::Parser::new(side(size[1]), side(size[0]), 0);
        let seen = Arc::new(Mutex::new(Seen { screen, bytes: Vec::new() }));
        Tty { master: master.into(), slave, before, child, seen }
    }

    fn listen(&mut self, answers: Answers) {
        let (mut from, mut to) = (self.master.try_clone().expect("an end"), self.master.try_clone().expect("an end"));
        let seen = Arc::clone(&self.seen);
        std::thread::spawn(move || {
            let (mut bytes, mut asked) = ([0; 4096], Vec::new());
            while let Ok(length @ 1..) = from.read(&mut bytes) {
                asked.extend_from_slice(&bytes[..length]);
                for (question, answer) in answers {
                    if let Some(at) = asked.windows(question.len()).position(|some| some == question.as_bytes()) {
                        asked.drain(at..at + question.len());
                        to.write_all(answer.as_bytes()).expect("an answer");
                    }
                }
                let excess = asked.len().saturating_sub(256);
                asked.drain(..excess);
                let mut seen = seen.lock().expect("no panic");
                seen.bytes.extend_from_slice(&bytes[..length]);
                seen.screen.process(&bytes[..length]);
            }
        });
    }

    pub fn press(&mut self, keys: &str) {
        self.master.write_all(keys.as_bytes()).expect("keys");
    }

    pub fn signal(&self, name: &str) {
        let sent = Command::new("sh").args(["-c", &format!("kill -{name} {}", self.child.id())]).status();
        assert!(sent.expect("a shell").success());
    }

    pub fn resize(&mut self, size: [u16; 2]) {
        self.seen.lock().expect("no panic").screen.set_size(side(size[1]), side(size[0]));
        tcsetwinsize(&self.master, winsize(size, [0, 0])).expect("a size");
        // It is not the terminal that the program was started from, and so the system tells nobody.
        self.signal("WINCH");
    }

    /// What is on the screen, line by line.
    pub fn text(&self) -> String {
        self.seen.lock().expect("no panic").screen.screen().contents()
    }

    /// All bytes that were written up to now.
    pub fn bytes(&self) -> Vec<u8> {
        self.seen.lock().expect("no panic").bytes.clone()
    }

    pub fn wrote(&self, words: &str) -> bool {
        self.bytes().windows(words.len()).any(|some| some == words.as_bytes())
    }

    /// The colour of a point of half blocks.
    pub fn point(&self, x: u16, y: u16) -> Option<[u8; 3]> {
        let seen = self.seen.lock().expect("no panic");
        let cell = seen.screen.screen().cell(y / 2, x)?;
        let colour = if y.is_multiple_of(2) { cell.fgcolor() } else { cell.bgcolor() };
        match colour {
            vt100::Color::Rgb(r, g, b) if cell.contents() == "▀" => Some([r, g, b]),
            _ => None,
        }
    }

    /// Waits until this is so.
    #[track_caller]
    pub fn until(&self, what: impl Fn(&Tty) -> bool) {
        let began = Instant::now();
        while !what(self) {
            assert!(began.elapsed() < PATIENCE, "in vain; the screen:\n{}", self.text());
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    /// Waits for the end of the program; its exit code. The terminal is as it was before.
    #[track_caller]
    pub fn ends(mut self) -> (Option<i32>, Vec<u8>) {
        let code = self.waits();
        // All that was written has been read.
        self.until(|tty| tty.wrote("\x1b[?1049l"));
        let seen = self.seen.lock().expect("no panic");
        let screen = seen.screen.screen();
        assert!(!screen.alternate_screen(), "the other screen");
        assert!(!screen.hide_cursor(), "the cursor");
        (code, seen.bytes.clone())
    }

    /// The same where nobody reads.
    #[track_caller]
    pub fn waits(&mut self) -> Option<i32> {
        let began = Instant::now();
        let code = loop {
            if let Some(status) = self.child.try_wait().expect("a child") {
                break status.code();
            }
            assert!(began.elapsed() < PATIENCE, "it does not end; the screen:\n{}", self.text());
            std::thread::sleep(Duration::from_millis(10));
        };
        let after = tcgetattr(&self.slave).expect("settings");
        let told = |settings: &Termios| {
            (settings.input_modes, settings.output_modes, settings.control_modes, settings.local_modes)
        };
        assert_eq!(told(&after), told(&self.before), "the settings of the terminal");
        code
    }
}

impl Drop for Tty {
    fn drop(&mut self) {
        // It has ended, unless a test has failed.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// What is answered to what.
pub type Answers = &'static [(&'static str, &'static str)];
