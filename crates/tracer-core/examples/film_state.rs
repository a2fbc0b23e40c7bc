//! What it costs to keep the state of a rendering: `cargo run --release -p tracer-core --example film_state --
//! scenes/fig4.ron 3840x2160 12 FILE` (scene, size, samples, file to write).
//!
//! Renders twice, without and with a state after every pass, and tells for both the time and the longest time in which
//! no thread finished a batch; for the states their size, and how fast they were written. Light paths finish no
//! batches: `render.integrator: Path` has none.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom, Write};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;
use tracer_core::{FilmState, Observer, Progress, RenderOptions, compile, render};

struct Gaps {
    keep: Option<String>,
    start: Instant,
    last: AtomicU64,
    longest: AtomicU64,
    writer: Mutex<Option<std::thread::JoinHandle<()>>>,
}

impl Gaps {
    fn new(keep: Option<String>) -> Self {
        Gaps {
            keep,
            start: Instant::now(),
            last: AtomicU64::new(0),
            longest: AtomicU64::new(0),
            writer: Mutex::new(None),
        }
    }

    fn join(&self) {
        if let Some(writer) = self.writer.lock().expect("no panic").take() {
            writer.join().expect("no panic");
        }
    }
}

impl Observer for Gaps {
    fn progress(&self, _: Progress) -> ControlFlow<()> {
        let now = self.start.elapsed().as_micros() as u64;
        let last = self.last.swap(now, Ordering::Relaxed);
        if last > 0 {
            self.longest.fetch_max(now.saturating_sub(last), Ordering::Relaxed);
        }
        ControlFlow::Continue(())
    }

    fn wants_state(&self) -> bool {
        self.keep.is_some() && self.writer.lock().expect("no panic").as_ref().is_none_or(|writer| writer.is_finished())
    }

    fn state(&self, state: FilmState) {
        let path = self.keep.clone().unwrap_or_default();
        *self.writer.lock().expect("no panic") = Some(std::thread::spawn(move || {
            let started = Instant::now();
            let mut file = File::create(path).expect("a file");
            let samples = *state.head().samples.start();
            let bytes = state.save(&mut file, &[]).expect("room");
            let packed = started.elapsed().as_secs_f64();
            file.sync_all().expect("a disk");
            let seconds = started.elapsed().as_secs_f64();
            println!(
                "  {samples} samples: {:.1} MB, told after {packed:.2} s, on the disk after {seconds:.2} s: {:.0} MB/s",
                bytes as f64 / 1e6,
                bytes as f64 / 1e6 / seconds
            );
        }));
    }
}

/// Writes the same bytes at once: what the disk gives.
fn disk(path: &str) {
    let mut bytes = Vec::new();
    File::open(path).and_then(|mut file| file.read_to_end(&mut bytes)).expect("a file");
    let mut file = File::create(path).expect("a file");
    for what in ["new", "again"] {
        let started = Instant::now();
        file.seek(SeekFrom::Start(0)).and_then(|_| file.write_all(&bytes)).expect("room");
        file.sync_all().expect("a disk");
        println!("  the same bytes, {what}: {:.0} MB/s", bytes.len() as f64 / 1e6 / started.elapsed().as_secs_f64());
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scene, size, samples, path, set @ ..] = &arguments[..] else { panic!("scene, size, samples, file") };
    let (width, height) = size.split_once('x').expect("as 640x480");
    let mut set: Vec<scene_format::Override> = set.iter().cloned().map(Into::into).collect();
    set.extend([format!("image.width={width}").into(), format!("image.height={height}").into()]);
    let loaded = scene_format::load_with(Path::new(scene), &set).expect("a scene");
    let scene = compile(&loaded.scene).expect("a scene");
    let options = RenderOptions { samples: samples.parse().ok(), ..RenderOptions::default() };
    for keep in [None, Some(path.clone())] {
        println!("{}", if keep.is_some() { "with states" } else { "without" });
        let gaps = Gaps::new(keep);
        let film = render(&scene, &options, &gaps);
        println!(
            "  {:.2} s, no batch for {:.1} ms at most, film {:.1} MB",
            gaps.start.elapsed().as_secs_f64(),
            gaps.longest.load(Ordering::Relaxed) as f64 / 1e3,
            film.bytes() as f64 / 1e6
        );
        gaps.join();
        let (started, mut bytes) = (Instant::now(), Vec::new());
        film.save(&mut bytes, &[]).expect("memory");
        let rate = bytes.len() as f64 / 1e6 / started.elapsed().as_secs_f64();
        println!("  {:.1} MB packed by one thread: {rate:.0} MB/s", bytes.len() as f64 / 1e6);
    }
    disk(path);
}
