//! The studio: one thread that makes the pictures. It reads the scene, compiles it, renders a draft and then the
//! picture, and begins anew whenever there is an order.

use crate::files::{Fingerprint, News, Stamp, fingerprint};
use crate::options::Options;
use crate::shared::{Frame, FrameNoise, Orders, Phase, Pose, Shared, Stage, State, lock};
use crate::told::{Told, file_of, told};
use scene_format::codes;
use scene_format::diagnostic::{Source, keep_first};
use scene_format::{LoadError, Loaded, MAX_FILE_BYTES, SceneDesc, Syntax, Viewpoint};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, mpsc};
use std::time::{Duration, Instant, SystemTime};
use tracer_core::{CompileError, Crop, Film, Kept, LayerSet, Observer, Progress, RenderOptions, Scene};

/// Pictures are shown no faster than this.
const FASTEST: Duration = Duration::from_millis(40);
/// Passes are no longer than this, so that something new is seen.
const LONGEST_PASS: Duration = Duration::from_millis(1500);
/// A draft has a quarter of the picture's rows and columns, and so many samples: a quarter of the work of the first
/// whole pass.
const DRAFT: u32 = 4;
/// A picture with fewer pixels is there as soon as its draft.
const SMALL: u64 = 200 * 200;

/// Makes pictures until it is told to quit.
pub fn run(shared: &Arc<Shared>) {
    let (noise, frames) = mpsc::channel();
    let teller = Arc::clone(shared);
    // Without it there is no noise to be seen, and all else goes on.
    let _ = std::thread::Builder::new().name("noise".to_owned()).spawn(move || tell_noise(&teller, &frames));
    let kept = shared.host.store().map_or_else(Kept::default, Kept::storing);
    let mut studio = Studio { shared, read: None, fit: None, stages: 0, kept, noise };
    loop {
        let orders = shared.orders();
        if orders.quit {
            return;
        }
        // A fault of ours in one scene must not end the preview: the next text may go well.
        if catch_unwind(AssertUnwindSafe(|| studio.follow(&orders))).is_err() {
            studio.read = None;
            shared.change(|state| {
                state.phase = Phase::Wrong;
                state.told = vec![Told::plain(
                    "error: tracer failed on this scene, which is a fault of tracer; please report it with the scene",
                )];
            });
        }
    }
}

/// Measures the noise of the latest frame, beside the rendering: for a large picture it takes a while.
fn tell_noise(shared: &Shared, frames: &mpsc::Receiver<Arc<Frame>>) {
    while let Ok(mut frame) = frames.recv() {
        while let Ok(later) = frames.try_recv() {
            frame = later;
        }
        let noise =
            FrameNoise { frame: frame.number, relative: frame.film.relative_noise(), few: frame.film.few_noisy() };
        shared.change(|state| state.noise = Some(noise));
    }
}

/// A scene that was read and is right as far as its text goes.
struct Read {
    desc: SceneDesc,
    warnings: Vec<Told>,
    written: Pose,
    /// The files as they were read.
    stamps: BTreeMap<PathBuf, Stamp>,
}

struct Studio<'a> {
    shared: &'a Arc<Shared>,
    read: Option<Read>,
    /// Pixels that can be seen, where there are bounds.
    fit: Option<[u32; 2]>,
    stages: u64,
    /// What has not changed since the last scene.
    kept: Kept,
    noise: mpsc::Sender<Arc<Frame>>,
}

impl Studio<'_> {
    fn follow(&mut self, orders: &Orders) {
        self.fit = orders.fit.or(self.fit);
        let anew = orders.reload && self.reload();
        // Over what is wrong the last picture stays as it is; the camera is moved when all is well again.
        if self.shared.state().phase == Phase::Wrong && !anew {
            return;
        }
        if anew || orders.moved || self.is_resized() {
            self.make();
        } else if let Some(samples) = orders.samples {
            self.go_on(samples);
        }
    }

    /// Whether the picture that is there has another size than is wanted now.
    fn is_resized(&self) -> bool {
        let Some(read) = &self.read else { return false };
        let moves = self.shared.state().moves;
        let desc = described(&read.desc, &moves, self.fit, &self.shared.options);
        let size = [desc.image.width.value, desc.image.height.value];
        self.shared.state().stage.as_ref().is_none_or(|stage| stage.scene.size != size)
    }

    /// Adds samples to a picture that is done.
    fn go_on(&self, samples: u32) {
        let (stage, frame) = {
            let state = self.shared.state();
            (state.stage.clone(), state.frame.clone())
        };
        let (Some(stage), Some(frame)) = (stage, frame) else { return };
        if frame.stage != stage.number || frame.draft {
            return;
        }
        let size = frame.size.map(u64::from);
        self.shared.change(|state| {
            state.phase = Phase::Rendering;
            state.asked = samples;
            state.begun = u64::from(frame.samples) * size[0] * size[1];
            state.begin();
        });
        // What the scene has for an end is behind it: a noise goal, a time.
        let options = RenderOptions { samples: Some(samples), noise: Some(f64::MIN_POSITIVE), ..self.options() };
        let film = Film::clone(&frame.film);
        let watching = self.observer(stage.number, None);
        match tracer_core::resume(&stage.scene, &options, film, &watching) {
            Ok(film) => self.is_done(stage.number, film),
            Err(misfit) => self.shared.change(|state| {
                state.phase = Phase::Done;
                state.told.push(Told::plain(format!("error: cannot go on with this picture: {misfit}")));
            }),
        }
    }

    /// Columns for what is told.
    fn width(&self) -> usize {
        self.shared.columns.load(Ordering::Relaxed)
    }

    fn options(&self) -> RenderOptions {
        RenderOptions {
            threads: self.shared.options.threads,
            longest_pass: Some(LONGEST_PASS),
            // Who looks at the picture does not wait for shares of it that are not shown.
            light_groups: Some(false),
            ..RenderOptions::default()
        }
    }

    /// Shows a picture that is done, unless something else is wanted by now.
    fn is_done(&self, stage: u64, film: Film) {
        if self.shared.is_wanted(false) {
            show(self.shared, &self.noise, stage, Arc::new(film), None);
            self.shared.change(|state| {
                state.phase = Phase::Done;
                state.took = Some(state.began.elapsed().as_secs_f64());
            });
        }
    }

    /// Reads the scene. Whether there is a picture to make of it: it is right, and not what it was.
    fn reload(&mut self) -> bool {
        let began = SystemTime::now();
        let options = &self.shared.options;
        let stamps = lock(&self.shared.watched).stamps();
        let (Loaded { scene, warnings }, contents) = match load(&options.scene, options) {
            Ok(read) => read,
            Err(error) => {
                let (told, files) = faults(error, &options.scene, self.width());
                self.is_wrong(told, files, began);
                return false;
            }
        };
        let written = Pose::of(&scene);
        {
            let mut state = self.shared.state();
            if let Some(before) = state.written {
                state.moves = still(state.moves, &written, &before);
            }
            (state.written, state.read) = (Some(written), contents);
        }
        let same = self.read.as_ref().is_some_and(|read| read.desc.sources == scene.sources && read.stamps == stamps);
        // One that was interrupted by this order is made again.
        if same && self.shared.state().phase == Phase::Done {
            return false;
        }
        let warnings = told(&warnings, &scene.sources, &options.scene, self.width());
        self.read = Some(Read { desc: scene, warnings, written, stamps });
        true
    }

    /// What is wrong is shown over the last picture.
    fn is_wrong(&self, told: Vec<Told>, files: Vec<PathBuf>, began: SystemTime) {
        let mut watched = lock(&self.shared.watched);
        // Those of before, too: a text that cannot be read names none.
        let before: Vec<PathBuf> = watched.stamps().into_keys().collect();
        watched.after_reading(before.into_iter().chain(files), began, News::Anything);
        drop(watched);
        let faults: Vec<&str> = told.iter().map(|told| told.text.trim_end()).collect();
        let faults = faults.join("\n\n");
        let news = self.shared.change(|state| {
            state.phase = Phase::Wrong;
            let news = state.told != told;
            state.told = told;
            news
        });
        if news {
            self.shared.host.wrong(Some(&faults));
        }
    }

    /// Compiles and renders.
    fn make(&mut self) {
        let began = SystemTime::now();
        let width = self.width();
        let Some(read) = &mut self.read else { return };
        let moves = self.shared.change(|state| {
            state.phase = Phase::Loading;
            state.moves
        });
        let options = &self.shared.options;
        let desc = described(&read.desc, &moves, self.fit, options);
        if let Some(why) = too_large(&desc, self.shared.host.free_memory()) {
            let files = tracer_core::named_files(&desc);
            return self.is_wrong(vec![Told::plain(why)], files, began);
        }
        let scene = match tracer_core::compile_keeping(&desc, &self.kept) {
            Ok(scene) => scene,
            Err(CompileError { diagnostics }) => {
                let mut faults = told(&diagnostics, &desc.sources, &options.scene, width);
                faults.extend(read.warnings.iter().cloned());
                return self.is_wrong(faults, tracer_core::named_files(&desc), began);
            }
        };
        let files = scene.files.iter().cloned().chain(more_files(&desc, &options.scene));
        let mut watched = lock(&self.shared.watched);
        let odd = scene.warnings.iter().any(|warning| warning.code == codes::MTL_UNSUPPORTED);
        watched.after_reading(files, began, if odd { News::Pictures } else { News::None });
        read.stamps = watched.stamps();
        drop(watched);
        let mut warnings = read.warnings.clone();
        warnings.extend(told(&scene.warnings, &desc.sources, &options.scene, width));
        let written = read.written;
        self.stages += 1;
        self.shared.done.store(0, Ordering::Relaxed);
        let was_wrong = self.shared.change(|state| {
            state.phase = Phase::Rendering;
            let before = std::mem::replace(&mut state.told, warnings);
            (state.asked, state.begun) = (scene.samples, 0);
            state.begin();
            before.iter().any(|told| told.severity == "error")
        });
        if was_wrong {
            self.shared.host.wrong(None);
        }
        self.render(desc, scene, written);
    }

    fn render(&mut self, desc: SceneDesc, mut scene: Scene, written: Pose) {
        let number = self.stages;
        let size = scene.size;
        let threads = self.shared.options.threads;
        if u64::from(size[0]) * u64::from(size[1]) > SMALL {
            scene.size = size.map(|side| side.div_ceil(DRAFT));
            let few = RenderOptions {
                samples: Some(DRAFT),
                caustics: Some(false),
                layers: Some(LayerSet::default()),
                threads,
                ..RenderOptions::default()
            };
            let film = tracer_core::render(&scene, &few, &self.observer(number, Some(size)));
            scene.size = size;
            if *film.samples().start() > 0 {
                show(self.shared, &self.noise, number, Arc::new(film), Some(size));
            }
        }
        let stage = Arc::new(Stage { number, desc, written, scene });
        self.shared.change(|state| state.stage = Some(Arc::clone(&stage)));
        if !self.shared.is_wanted(false) {
            return;
        }
        self.shared.change(State::begin);
        let film = tracer_core::render(&stage.scene, &self.options(), &self.observer(number, None));
        if let Some(faults) = &film.fault {
            let faults = told(faults, &stage.desc.sources, &self.shared.options.scene, self.width());
            self.shared.change(|state| state.told.extend(faults));
        }
        self.is_done(number, film);
    }

    fn observer(&self, stage: u64, draft: Option<[u32; 2]>) -> Watching<'_> {
        Watching { shared: self.shared, noise: Mutex::new(self.noise.clone()), stage, draft, shown: Mutex::new(None) }
    }
}

/// Shows a film.
fn show(shared: &Shared, noise: &mpsc::Sender<Arc<Frame>>, stage: u64, film: Arc<Film>, draft: Option<[u32; 2]>) {
    let samples = *film.samples().start();
    let frame = shared.change(|state| {
        let number = state.frame.as_ref().map_or(1, |frame| frame.number + 1);
        let size = draft.unwrap_or(film.size());
        let frame = Arc::new(Frame { number, stage, film, draft: draft.is_some(), size, samples });
        state.frame = Some(Arc::clone(&frame));
        frame
    });
    if draft.is_none() {
        // That nobody measures is told by there being no noise.
        let _ = noise.send(frame);
    }
}

/// Ends a rendering that nobody wants any more, and shows what there is of it.
struct Watching<'a> {
    shared: &'a Shared,
    noise: Mutex<mpsc::Sender<Arc<Frame>>>,
    stage: u64,
    draft: Option<[u32; 2]>,
    shown: Mutex<Option<Instant>>,
}

impl Observer for Watching<'_> {
    fn progress(&self, progress: Progress) -> ControlFlow<()> {
        self.shared.rest(self.draft.is_some());
        if self.draft.is_none() {
            self.shared.done.store(progress.samples_done, Ordering::Relaxed);
            self.shared.total.store(progress.samples_total, Ordering::Relaxed);
        }
        if self.shared.is_wanted(self.draft.is_some()) { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }

    fn pass(&self, film: &Film) {
        let mut shown = lock(&self.shown);
        // A draft is shown when it is whole.
        if self.draft.is_some() || shown.is_some_and(|at| at.elapsed() < FASTEST) {
            return;
        }
        show(self.shared, &lock(&self.noise), self.stage, Arc::new(film.clone()), None);
        *shown = Some(Instant::now());
    }
}

/// What is left of a person's moves when the file has this camera in place of that one: who has written another camera
/// wants to see it. Where a camera stands is one thing, how much it sees another.
fn still(moves: Viewpoint, now: &Pose, before: &Pose) -> Viewpoint {
    let place = |pose: &Pose| (pose.position, pose.look_at, pose.up);
    let zoom = |pose: &Pose| (pose.fov, pose.focal_length, pose.height);
    let mut moves = moves;
    if place(now) != place(before) {
        (moves.position, moves.look_at, moves.up) = (None, None, None);
    }
    if zoom(now) != zoom(before) {
        (moves.fov, moves.focal_length, moves.height) = (None, None, None);
    }
    moves
}

/// The scene, under its name without folders, and the contents of its file.
fn load(path: &Path, options: &Options) -> Result<(Loaded, Option<Fingerprint>), LoadError> {
    let io = |source| LoadError::Io { path: path.to_owned(), source };
    let file = std::fs::metadata(path).map_err(io)?;
    // Of a pipe nobody knows whether anybody will write into it: reading would wait for ever.
    if !file.is_file() && !file.is_dir() {
        return Err(io(std::io::Error::other("it is no regular file")));
    }
    if file.len() > MAX_FILE_BYTES {
        // Which tells so.
        return scene_format::load_with(path, &options.overrides).map(|loaded| (loaded, None));
    }
    let bytes = std::fs::read(path).map_err(io)?;
    let contents = fingerprint(&bytes);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let folder = path.parent().unwrap_or(Path::new(""));
    let syntax = options.syntax.or(Syntax::from_path(path));
    let loaded = scene_format::load_bytes(&name, bytes, syntax, folder, &options.overrides)?;
    Ok((loaded, Some(contents)))
}

/// What is wrong with a scene that did not load and with the files that it names, and those files.
fn faults(error: LoadError, scene: &Path, width: usize) -> (Vec<Told>, Vec<PathBuf>) {
    let folder = scene.parent().unwrap_or(Path::new(""));
    match error {
        LoadError::Io { source, .. } => {
            let name = scene.file_name().unwrap_or_default().to_string_lossy();
            let text = if source.kind() == std::io::ErrorKind::NotFound {
                format!("error: {name} is not there any more; as soon as it is, it is shown")
            } else {
                format!("error: cannot read {name}: {source}")
            };
            (vec![Told::plain(text)], Vec::new())
        }
        LoadError::Invalid { mut diagnostics, sources, files, .. } => {
            diagnostics.extend(tracer_core::check_files(&files, folder, &sources));
            diagnostics.sort_by_key(|fault| fault.span);
            keep_first(&mut diagnostics);
            let files = files.iter().map(|file| folder.join(&file.path));
            let files = files.chain(sources.iter().skip(1).filter_map(|source| file_of(source, scene))).collect();
            (told(&diagnostics, &sources, scene, width), files)
        }
    }
}

/// Texts of the scene beside its first.
fn more_files(desc: &SceneDesc, scene: &Path) -> Vec<PathBuf> {
    let more = desc.sources.iter().skip(1).filter(|source: &&Source| !source.name.starts_with("--"));
    more.filter_map(|source| file_of(source, scene)).collect()
}

/// The scene with what options and page say, no larger than can be seen.
fn described(desc: &SceneDesc, moves: &Viewpoint, fit: Option<[u32; 2]>, options: &Options) -> SceneDesc {
    let mut desc = desc.clone();
    if let Some([width, height]) = options.size {
        desc.image.width = width.into();
        desc.image.height = height.into();
    }
    if let Some(fit) = fit {
        let [width, height] = fitted([desc.image.width.value, desc.image.height.value], fit);
        desc.image.width = width.into();
        desc.image.height = height.into();
    }
    if let Some(samples) = options.samples {
        desc.render.samples = samples.into();
    }
    moves.give(&mut desc.camera);
    desc
}

/// The largest size of the same shape that is neither larger nor beyond these bounds.
fn fitted(size: [u32; 2], bounds: [u32; 2]) -> [u32; 2] {
    let scale = |k: usize| f64::from(bounds[k]) / f64::from(size[k].max(1));
    let scale = scale(0).min(scale(1)).min(1.0);
    size.map(|side| ((f64::from(side) * scale).round() as u32).max(1))
}

/// Why a picture cannot be shown: later the system would end the program.
fn too_large(desc: &SceneDesc, free: Option<u64>) -> Option<String> {
    // What is rendered, what is shown, and what was shown before that; each developed once for a page.
    const FILMS: u64 = 3;
    const BYTES_PER_PIXEL: u64 = 64;
    let size = [desc.image.width.value, desc.image.height.value];
    let layers = tracer_core::layer_set(&desc.output.layers);
    let film = Film::bytes_of(Crop::whole(size), desc.render.clamp.is_some(), true, layers, false);
    let needed = FILMS * film + BYTES_PER_PIXEL * u64::from(size[0]) * u64::from(size[1]);
    let gib = |bytes: u64| bytes as f64 / f64::from(1 << 30);
    (needed > free?).then(|| {
        format!(
            "error: to preview {}x{} pixels takes {:.1} GiB of memory, and {:.1} are free\n\
             hint: start it with --size, as in --size {}x{}",
            size[0],
            size[1],
            gib(needed),
            gib(free.unwrap_or(0)),
            size[0].div_ceil(8),
            size[1].div_ceil(8),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_seen_bounds_the_size_and_keeps_the_shape() {
        assert_eq!(fitted([512, 512], [80, 46]), [46, 46]);
        assert_eq!(fitted([1920, 1080], [80, 46]), [80, 45]);
        assert_eq!(fitted([64, 20], [80, 46]), [64, 20]);
        assert_eq!(fitted([4000, 1], [80, 46]), [80, 1]);
        assert_eq!(fitted([1, 1], [0, 0]), [1, 1]);
    }
}
