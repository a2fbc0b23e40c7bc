//! The picture in a terminal: the same studio and watch as the page has, drawn here.
//!
//! One thread does it all: it waits for keys or for the bell, which news of the studio and signals ring, and draws
//! what is new. Nothing it does waits for the terminal longer than it takes to see that the program is to end.

mod ask;
mod blocks;
mod device;
mod inline;
mod input;
mod layout;
mod orbit;
mod scaled;
mod screen;
mod signals;
mod sixel;
mod words;

pub use ask::Protocol;

use crate::camera::{self, Outcome, Refused, Undo};
use crate::options::{Host, Options};
use crate::shared::{Phase, Pose, Shared};
use crate::{picture, work};
use ask::{ASKS_KITTY, Abilities, Environment, QUESTIONS};
use device::{Device, Leaving, Panics, leave};
use input::{Input, Key, Token};
use scene_format::Viewpoint;
use screen::{Screen, View};
use signals::Signals;
use std::io::{self, Write};
use std::os::unix::net::UnixStream;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use words::Status;

/// How a preview in the terminal came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// By a key.
    Quit,
    /// By Ctrl-C.
    Interrupted,
    /// By a signal.
    Signal(i32),
    /// The terminal is gone.
    Gone,
}

/// A terminal that has not answered by then does not answer.
const PATIENCE: Duration = Duration::from_secs(1);
/// What has begun as a sequence and does not go on was a key.
const SEQUENCE: Duration = Duration::from_millis(100);
/// Pictures are drawn no faster than this.
const FASTEST: Duration = Duration::from_millis(100);
/// While something is rendered, the status is so fresh.
const TICK: Duration = Duration::from_millis(250);
/// A note stands so long.
const NOTE: Duration = Duration::from_secs(4);
/// Without news there is nothing to do.
const LONG: Duration = Duration::from_secs(600);

/// A step of an orbit, in radians; of a dolly, a factor; of the exposure, in stops.
const TURN: f64 = 0.06;
const NEARER: f64 = 1.08;
const STOP: f64 = 1.0 / 3.0;

/// Shows the scene in the terminal that standard output is, until a key or a signal ends it. The terminal is then as
/// it was. The scene need not be right, nor there.
///
/// # Errors
/// When there is no terminal, or the system lacks something.
pub fn run(options: Options, host: Box<dyn Host>, wanted: Option<Protocol>) -> io::Result<End> {
    let mut device = Device::open()?;
    let signals = Signals::listen()?;
    let _panics = Panics::listen();
    let _leaving = Leaving;
    device.enter()?;
    let mut input = Input::default();
    let environment = Environment::of_process();
    let kitty = if wanted.is_none() && !environment.is_multiplexed() { ASKS_KITTY } else { "" };
    let questions = format!("{kitty}{QUESTIONS}");
    let (abilities, early) = match asked(&questions, &mut device, &mut input, &signals)? {
        Answers::Told(abilities, early) => (abilities, early),
        Answers::End(end) => return Ok(end),
    };
    let screen = Screen::new(&abilities, &environment, wanted, device.size());
    device.on_leaving(screen.farewell());
    let shared = Arc::new(Shared::new(options, host));
    let mut session = Session::new(Arc::clone(&shared), screen);
    session.fit();
    let _studio = work::begin(&shared)?;
    ring_for_news(&shared, signals.rope()?)?;
    let end = session.run(&mut device, &mut input, &signals, early);
    shared.order(|orders| orders.quit = true);
    end
}

/// What came of asking.
enum Answers {
    /// What it can, and keys that were pressed meanwhile.
    Told(Abilities, Vec<Key>),
    /// There is nobody to ask any more.
    End(End),
}

/// Asks the terminal what it can.
fn asked(questions: &str, device: &mut Device, input: &mut Input, signals: &Signals) -> io::Result<Answers> {
    let mut abilities = Abilities::default();
    let mut early = Vec::new();
    let until = Instant::now() + PATIENCE;
    if device.write(questions.as_bytes(), || signals.end().is_some() || Instant::now() > until).is_err() {
        return Ok(Answers::End(End::Gone));
    }
    while let Some(left) = until.checked_duration_since(Instant::now()) {
        let woken = device.wait(&signals.bell, left);
        if let Some(signal) = signals.end() {
            return Ok(Answers::End(End::Signal(signal)));
        }
        let Ok(bytes) = device.read() else { return Ok(Answers::End(End::Gone)) };
        if woken.gone {
            return Ok(Answers::End(End::Gone));
        }
        let mut all = false;
        for token in input.feed(&bytes) {
            match token {
                Token::Key(key) => early.push(key),
                Token::Reply(reply) => all |= abilities.take(reply),
            }
        }
        if all {
            break;
        }
    }
    Ok(Answers::Told(abilities, early))
}

/// Rings at every change of the state.
fn ring_for_news(shared: &Shared, mut rope: UnixStream) -> io::Result<()> {
    let mut versions = shared.versions();
    let runtime = tokio::runtime::Builder::new_current_thread().build()?;
    let ring = move || {
        while runtime.block_on(versions.changed()).is_ok() {
            // Where it cannot ring any more it rings already.
            let _ = rope.write(&[0]);
        }
    };
    std::thread::Builder::new().name("news".to_owned()).spawn(ring).map(drop)
}

struct Session {
    shared: Arc<Shared>,
    screen: Screen,
    undo: Mutex<Undo>,
    /// The camera where it was moved to last, ahead of the picture, and what stood in the file then.
    pose: Option<(Pose, Pose)>,
    /// Stops beside the scene's exposure.
    exposure: f64,
    help: bool,
    /// The stage that is shown, and the first frame of it that was.
    first: [u64; 2],
    note: Option<(String, Instant)>,
    /// Something has changed since it was drawn.
    stale: bool,
    /// Nothing is drawn before that.
    not_before: Instant,
}

impl Session {
    fn new(shared: Arc<Shared>, screen: Screen) -> Self {
        let (undo, now) = (Mutex::default(), Instant::now());
        let (pose, note) = (None, None);
        Session {
            shared,
            screen,
            undo,
            pose,
            exposure: 0.0,
            help: false,
            first: [0; 2],
            note,
            stale: true,
            not_before: now,
        }
    }

    /// The studio makes no more pixels than can be seen, and no longer lines.
    fn fit(&self) {
        let visible = self.screen.visible();
        // Excerpts of fewer columns are no excerpts.
        let columns = usize::from(self.screen.size().columns).clamp(40, crate::told::WIDTH);
        self.shared.columns.store(columns, Ordering::Relaxed);
        self.shared.order(|orders| orders.fit = Some(visible));
    }

    fn run(&mut self, device: &mut Device, input: &mut Input, signals: &Signals, early: Vec<Key>) -> io::Result<End> {
        for key in early {
            if let Some(end) = self.key(key, device)? {
                return Ok(end);
            }
        }
        let mut heard = Instant::now();
        loop {
            if let Some(signal) = signals.end() {
                return Ok(End::Signal(signal));
            }
            if !self.draw(device, signals)? {
                continue;
            }
            let longest = if input.is_waiting() { SEQUENCE.min(self.patience()) } else { self.patience() };
            let woken = device.wait(&signals.bell, longest);
            if woken.rung {
                self.stale = true;
            }
            let continued = signals.continued();
            if continued {
                // The shell's settings may be there.
                device.enter()?;
            }
            if signals.resized() || continued {
                self.screen.resize(device.size());
                self.fit();
                self.stale = true;
            }
            let Ok(bytes) = device.read() else { return Ok(End::Gone) };
            if woken.gone {
                return Ok(End::Gone);
            }
            let mut tokens = input.feed(&bytes);
            if !bytes.is_empty() {
                heard = Instant::now();
            } else if input.is_waiting() && heard.elapsed() >= SEQUENCE {
                tokens.extend(input.give_up());
            }
            for token in tokens {
                if let Token::Key(key) = token
                    && let Some(end) = self.key(key, device)?
                {
                    return Ok(end);
                }
            }
        }
    }

    /// How long there is nothing to do, unless something comes.
    fn patience(&self) -> Duration {
        let now = Instant::now();
        let (rendering, paused) = {
            let state = self.shared.state();
            (state.phase == Phase::Rendering, state.paused.is_some())
        };
        let news = if self.stale { self.not_before.saturating_duration_since(now) } else { LONG };
        let tick = if rendering && !paused { TICK } else { LONG };
        let note = self.note.as_ref().map_or(LONG, |(_, until)| until.saturating_duration_since(now));
        news.min(tick).min(note)
    }

    /// Does what a key says; whether that is the end.
    fn key(&mut self, key: Key, device: &Device) -> io::Result<Option<End>> {
        self.stale = true;
        match key {
            Key::Char('q') | Key::Escape => return Ok(Some(End::Quit)),
            Key::Ctrl('c' | '\\') => return Ok(Some(End::Interrupted)),
            Key::Ctrl('z') => {
                leave();
                signals::stop();
                device.enter()?;
                device.on_leaving(self.screen.farewell());
                self.screen.resize(device.size());
            }
            Key::Ctrl('l') => self.screen.resize(device.size()),
            Key::Char(' ') => {
                let rests = self.shared.state().paused.is_some();
                self.shared.pause(!rests);
            }
            Key::Right | Key::Char('l') => self.orbit(TURN, 0.0),
            Key::Left | Key::Char('h') => self.orbit(-TURN, 0.0),
            Key::Up | Key::Char('k') => self.orbit(0.0, TURN),
            Key::Down | Key::Char('j') => self.orbit(0.0, -TURN),
            Key::Char('+' | '=') => self.moved(|pose| orbit::dolly(pose, 1.0 / NEARER)),
            Key::Char('-' | '_') => self.moved(|pose| orbit::dolly(pose, NEARER)),
            Key::Char('r') => {
                self.pose = None;
                self.shared.move_camera(Viewpoint::default());
            }
            Key::Char('w') => self.write(),
            Key::Char('u') => match camera::undo(&self.shared, &self.undo) {
                Ok(()) => self.say("the file is as it was before"),
                Err(Refused::Now(why) | Refused::Unwritten(why)) => self.say(&why),
            },
            Key::Char('e') => self.exposure = (self.exposure + STOP).min(64.0),
            Key::Char('E') => self.exposure = (self.exposure - STOP).max(-64.0),
            Key::Char('m') => {
                if let Err(why) = work::twice(&self.shared) {
                    self.say(why);
                }
            }
            Key::Char('?') => self.help = !self.help,
            Key::Char(_) | Key::Ctrl(_) => {}
        }
        Ok(None)
    }

    fn say(&mut self, note: &str) {
        self.note = Some((note.to_owned(), Instant::now() + NOTE));
    }

    fn orbit(&mut self, right: f64, above: f64) {
        self.moved(|pose| orbit::orbit(pose, right, above));
    }

    /// The camera as the person has it, since what is rendered is behind while it moves, and as the file had it then.
    fn pose(&mut self) -> Option<(Pose, Pose)> {
        let state = self.shared.state();
        // Who has written another camera meanwhile wants to see that one.
        self.pose = self.pose.filter(|(_, written)| Some(*written) == state.written);
        self.pose.or_else(|| state.stage.as_ref().map(|stage| (Pose::of(&stage.desc), stage.written)))
    }

    fn moved(&mut self, how: impl FnOnce(&Pose) -> Pose) {
        let Some((pose, written)) = self.pose() else { return self.say("there is no picture yet") };
        let pose = how(&pose);
        if let Err(why) = camera::moved(&self.shared, &pose, Some(&written)) {
            return self.say(&why);
        }
        self.pose = Some((pose, written));
    }

    fn write(&mut self) {
        match camera::write(&self.shared, &self.undo) {
            Ok(Outcome { edits: 0, .. }) => self.say("the file has this camera already"),
            Ok(Outcome { expressions: 0, .. }) => self.say("the camera is written into the file; u takes it back"),
            Ok(_) => self.say("the camera is written into the file, in place of expressions too; u takes it back"),
            Err(Refused::Now(why) | Refused::Unwritten(why)) => self.say(&why),
        }
    }

    /// Draws, if it is time to, and there is something new. Not all of it, if the program is to end: then `false`.
    fn draw(&mut self, device: &Device, signals: &Signals) -> io::Result<bool> {
        if Instant::now() < self.not_before {
            return Ok(true);
        }
        self.stale = false;
        let view = self.view();
        let began = Instant::now();
        let text = self.screen.draw(&view);
        if text.is_empty() {
            return Ok(true);
        }
        let whole = match device.write(text.as_bytes(), || signals.end().is_some()) {
            Ok(whole) => whole,
            // Which reading it tells, too.
            Err(_) => return Ok(true),
        };
        // A slow terminal gets no more than it can take, and keys are heard.
        self.not_before = began + FASTEST.max(2 * began.elapsed());
        Ok(whole)
    }

    fn view(&mut self) -> View {
        let shared = Arc::clone(&self.shared);
        let state = shared.state();
        let size = self.screen.size();
        let columns = usize::from(size.columns);
        let rows = usize::from(size.rows).saturating_sub(1);
        // Errors may take half of the screen, and all of it where there is no picture; warnings a line each.
        let mut lines = match (state.phase, &state.frame) {
            (Phase::Wrong, None) => words::faults(&state.told, columns, rows),
            (Phase::Wrong, Some(_)) => words::faults(&state.told, columns, rows.div_ceil(2)),
            _ => words::warnings(&state.told, columns, (rows / 6).min(3)),
        };
        if self.help {
            lines.extend(words::help(columns).into_iter().map(|line| (line, None)));
            lines.truncate(rows);
        }
        let frame = state.frame.clone();
        let of_stage = frame.as_ref().filter(|frame| state.stage.as_ref().is_some_and(|s| s.number == frame.stage));
        if let Some(frame) = frame.as_ref().filter(|frame| frame.stage != self.first[0]) {
            self.first = [frame.stage, frame.number];
        }
        // It comes a frame or two later.
        let noise = state.noise.filter(|noise| noise.relative > 0.0 && noise.frame >= self.first[1]);
        let name = shared.options.scene.file_name().unwrap_or_default().to_string_lossy();
        let status = Status {
            name: &name,
            phase: state.phase,
            paused: state.paused.is_some(),
            samples: of_stage.filter(|frame| !frame.draft).map(|frame| frame.samples),
            asked: state.asked,
            begun: state.begun,
            done: shared.done.load(Ordering::Relaxed),
            total: shared.total.load(Ordering::Relaxed),
            seconds: state.seconds(),
            noise: noise.map(|noise| noise.few.map_or(noise.relative, |few| few.rest)),
            noisier: noise.and_then(|noise| noise.few).map_or(0, |few| few.pixels),
            exposure: self.exposure,
            moved: !state.moves.is_empty(),
            told: state.told.iter().filter(|told| (told.severity == "error") == (state.phase == Phase::Wrong)).count(),
        };
        self.note.take_if(|(_, until)| *until <= Instant::now());
        let status = match &self.note {
            // What has no room in one line takes some of the picture's for a while: it ends with what to do.
            Some((note, _)) => {
                let mut said = words::wrapped(note, columns);
                let last = said.pop().unwrap_or_default();
                lines.extend(said.into_iter().map(|line| (line, None)));
                lines.drain(..lines.len().saturating_sub(rows));
                last
            }
            None => status.line(columns),
        };
        let look = picture::look(state.stage.as_deref());
        let look = tracer_core::Look { exposure: look.exposure + self.exposure, ..look };
        View { frame, look, lines, status }
    }
}
