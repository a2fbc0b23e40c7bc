//! What watch, studio and server share: orders to the studio, and what it has made.

use crate::files::{Fingerprint, Watched};
use crate::options::{Host, Options};
use crate::told::{Told, WIDTH};
use scene_format::{SceneDesc, Viewpoint};
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;
use tokio::sync::watch;
use tracer_core::{FewNoisy, Film, Scene};

/// Locks; what a thread that panicked has left is whole, since all that is stored is stored at once.
pub fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A camera as the page moves it, in the scene's unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    pub position: [f64; 3],
    pub look_at: [f64; 3],
    pub up: [f64; 3],
    /// How much it sees, by the one of these three that the scene's camera goes by. One that sees all around has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fov: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub focal_length: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
}

impl Pose {
    pub fn of(desc: &SceneDesc) -> Self {
        let camera = &desc.camera;
        let Viewpoint { fov, focal_length, height, .. } = Viewpoint::of(camera);
        Pose {
            position: camera.position.value,
            look_at: camera.look_at.value,
            up: camera.up.value,
            fov,
            focal_length,
            height,
        }
    }

    /// What it says otherwise than another one. Numbers that have gone to a page and come back may have lost a bit.
    pub fn changes(&self, from: &Pose) -> Viewpoint {
        let differs = |a: f64, b: f64| (a - b).abs() > 1e-13 * a.abs().max(b.abs());
        let place = |new: [f64; 3], old: [f64; 3]| (0..3).any(|k| differs(new[k], old[k])).then_some(new);
        let number = |new: Option<f64>, old: Option<f64>| new.filter(|new| old.is_none_or(|old| differs(*new, old)));
        Viewpoint {
            position: place(self.position, from.position),
            look_at: place(self.look_at, from.look_at),
            up: place(self.up, from.up),
            fov: number(self.fov, from.fov),
            focal_length: number(self.focal_length, from.focal_length),
            height: number(self.height, from.height),
        }
    }

    /// This one, moved so. By what it does not go by nothing is moved.
    pub fn moved(&self, moves: &Viewpoint) -> Pose {
        Pose {
            position: moves.position.unwrap_or(self.position),
            look_at: moves.look_at.unwrap_or(self.look_at),
            up: moves.up.unwrap_or(self.up),
            fov: self.fov.map(|fov| moves.fov.unwrap_or(fov)),
            focal_length: self.focal_length.map(|length| moves.focal_length.unwrap_or(length)),
            height: self.height.map(|height| moves.height.unwrap_or(height)),
        }
    }
}

/// A scene that was compiled.
pub struct Stage {
    /// Counts the pictures that were begun.
    pub number: u64,
    pub desc: SceneDesc,
    /// The camera as the scene has it, where it was not moved.
    pub written: Pose,
    pub scene: Scene,
}

/// How noisy a frame is.
#[derive(Clone, Copy)]
pub struct FrameNoise {
    /// Its number.
    pub frame: u64,
    /// Relative to its mean luminance.
    pub relative: f64,
    pub few: Option<FewNoisy>,
}

/// A picture, as far as it is.
pub struct Frame {
    /// Counts the frames.
    pub number: u64,
    pub stage: u64,
    pub film: Arc<Film>,
    /// It has fewer pixels than the picture will have.
    pub draft: bool,
    /// Size of the picture that it will become.
    pub size: [u32; 2],
    /// Samples that all pixels have.
    pub samples: u32,
}

/// What the studio is at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// It reads the scene.
    Loading,
    /// It renders.
    Rendering,
    /// The picture is done.
    Done,
    /// The scene is wrong; the picture is that of an earlier text.
    Wrong,
}

/// What the pages show.
pub struct State {
    /// Goes up with every change.
    pub version: u64,
    pub phase: Phase,
    /// Errors and warnings of the text as it is now.
    pub told: Vec<Told>,
    pub stage: Option<Arc<Stage>>,
    pub frame: Option<Arc<Frame>>,
    pub noise: Option<FrameNoise>,
    /// The camera that stands in the file, as it was read last.
    pub written: Option<Pose>,
    /// The file's contents then.
    pub read: Option<Fingerprint>,
    /// What persons have changed of that camera, and not written yet.
    pub moves: Viewpoint,
    /// Samples per pixel that are being made.
    pub asked: u32,
    /// Camera samples that were there when the rendering began.
    pub begun: u64,
    /// When the rendering began, and how long it took when it had ended.
    pub began: Instant,
    pub took: Option<f64>,
    /// Since when it rests, if it does.
    pub paused: Option<Instant>,
}

impl State {
    /// The rendering begins now.
    pub fn begin(&mut self) {
        let now = Instant::now();
        (self.began, self.took, self.paused) = (now, None, self.paused.map(|_| now));
    }

    /// Seconds that the rendering takes, rests left out.
    pub fn seconds(&self) -> f64 {
        let now = self.paused.unwrap_or_else(Instant::now);
        self.took.unwrap_or_else(|| now.saturating_duration_since(self.began).as_secs_f64())
    }
}

/// What the studio is to do next; the last word of each kind counts.
#[derive(Default)]
pub struct Orders {
    /// A file has changed.
    pub reload: bool,
    /// The camera was moved, or is the file's again.
    pub moved: bool,
    /// A picture that is done is to have so many samples.
    pub samples: Option<u32>,
    /// Nobody sees more pixels than these: a larger picture is made so small that it fits.
    pub fit: Option<[u32; 2]>,
    pub quit: bool,
}

impl Orders {
    fn is_empty(&self) -> bool {
        let none = self.samples.is_none() && self.fit.is_none();
        !self.reload && !self.moved && none && !self.quit
    }
}

/// How urgent the orders are that wait, in [`Shared::waiting`].
const NONE: u64 = 0;
const MOVED: u64 = 1;
const CHANGED: u64 = 2;

pub struct Shared {
    pub options: Options,
    pub host: Box<dyn Host>,
    /// The files that the scene uses.
    pub watched: Mutex<Watched>,
    state: Mutex<State>,
    /// The state's version, for those who wait for the next one.
    version: watch::Sender<u64>,
    orders: Mutex<Orders>,
    ordered: Condvar,
    waiting: AtomicU64,
    /// The rendering rests.
    paused: AtomicBool,
    /// Columns that there are for diagnostics.
    pub columns: AtomicUsize,
    /// Camera samples done, of all.
    pub done: AtomicU64,
    pub total: AtomicU64,
}

impl Shared {
    pub fn new(options: Options, host: Box<dyn Host>) -> Self {
        let state = State {
            version: 1,
            phase: Phase::Loading,
            told: Vec::new(),
            stage: None,
            frame: None,
            noise: None,
            written: None,
            read: None,
            moves: Viewpoint::default(),
            asked: 0,
            begun: 0,
            began: Instant::now(),
            took: None,
            paused: None,
        };
        Shared {
            watched: Mutex::new(Watched::new(&options.scene)),
            options,
            host,
            state: Mutex::new(state),
            version: watch::Sender::new(1),
            orders: Mutex::new(Orders { reload: true, ..Orders::default() }),
            ordered: Condvar::new(),
            waiting: AtomicU64::new(NONE),
            paused: AtomicBool::new(false),
            columns: AtomicUsize::new(WIDTH),
            done: AtomicU64::new(0),
            total: AtomicU64::new(0),
        }
    }

    /// The state, to look at.
    pub fn state(&self) -> MutexGuard<'_, State> {
        lock(&self.state)
    }

    /// Changes the state, and wakes all who wait for that.
    pub fn change<T>(&self, change: impl FnOnce(&mut State) -> T) -> T {
        let mut state = self.state();
        let result = change(&mut state);
        state.version += 1;
        let version = state.version;
        drop(state);
        self.version.send_replace(version);
        result
    }

    /// Tells of later versions.
    pub fn versions(&self) -> watch::Receiver<u64> {
        self.version.subscribe()
    }

    /// Has the rendering rest, or go on.
    pub fn pause(&self, rest: bool) {
        if self.paused.swap(rest, Ordering::Relaxed) == rest {
            return;
        }
        self.change(|state| match (rest, state.paused.take()) {
            (true, _) => state.paused = Some(Instant::now()),
            (false, Some(since)) => state.began += since.elapsed(),
            (false, None) => {}
        });
        // Whoever waits holds the lock while it looks, and so does not miss this.
        drop(lock(&self.orders));
        self.ordered.notify_all();
    }

    /// Waits while the rendering rests and is still wanted.
    pub fn rest(&self, draft: bool) {
        if !self.paused.load(Ordering::Relaxed) {
            return;
        }
        let mut orders = lock(&self.orders);
        while self.paused.load(Ordering::Relaxed) && self.is_wanted(draft) {
            orders = self.ordered.wait(orders).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Orders something. What is being made ends early, and what rests goes on.
    pub fn order(&self, add: impl FnOnce(&mut Orders)) {
        self.pause(false);
        let mut orders = lock(&self.orders);
        add(&mut orders);
        let urgency = match *orders {
            Orders { reload: true, .. } | Orders { quit: true, .. } => CHANGED,
            Orders { moved: true, .. } | Orders { fit: Some(_), .. } => MOVED,
            _ => NONE,
        };
        self.waiting.store(urgency, Ordering::Relaxed);
        self.ordered.notify_all();
    }

    /// Has the camera stand so far from where the file has it.
    pub fn move_camera(&self, moves: Viewpoint) {
        self.state().moves = moves;
        self.order(|orders| orders.moved = true);
    }

    /// The next orders, when there are any.
    pub fn orders(&self) -> Orders {
        let mut orders = lock(&self.orders);
        while orders.is_empty() {
            orders = self.ordered.wait(orders).unwrap_or_else(PoisonError::into_inner);
        }
        self.waiting.store(NONE, Ordering::Relaxed);
        std::mem::take(&mut orders)
    }

    /// Whether what is being made is still wanted. A draft is whatever the camera does meanwhile: else nothing would
    /// be seen of a camera that moves on and on.
    pub fn is_wanted(&self, draft: bool) -> bool {
        self.waiting.load(Ordering::Relaxed) < if draft { CHANGED } else { MOVED }
    }
}
