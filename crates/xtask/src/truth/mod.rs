//! `cargo xtask truth`: random scenes of everything that the language has, held against the plain path tracer and
//! against scenes that must look the
//! same.
//!
//! A scene's way: drawn from a seed (`kinds`), written as RON with its files, loaded and compiled as a person's would
//! be (`world`), rendered with
//! independent seeds (`trial`), judged (`judge`, where the statistics are derived; `squares`). One that fails is made
//! smaller while it still
//! fails (`shrink`) and kept with what was measured. `pairs` is a fixed list of scenes with exact truths, which CI
//! runs.

pub mod curved;
mod dark_shell;
pub mod draw;
pub mod examine;
mod furnace;
pub mod judge;
pub mod kinds;
pub mod made;
pub mod meshes;
pub mod pairs;
pub mod receivers;
pub mod relation;
mod report;
mod rings;
pub mod rooms;
pub mod shining;
mod shrink;
mod solids;
pub mod squares;
mod standing;
mod textures;
pub mod trial;
mod view;
pub mod world;
pub mod written;

use examine::{Against, Examined, Finding};
use kinds::Case;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// What is to be done.
#[derive(Clone, Debug)]
pub struct Options {
    /// How many scenes.
    pub scenes: usize,
    /// The seed of the first; the others follow it.
    pub seed: u64,
    /// Pixels along a side, a multiple of 32.
    pub size: u32,
    /// Where failing scenes are kept.
    pub keep: PathBuf,
    /// Scenes at a time, each on one thread; 0: one for each core.
    pub jobs: usize,
    /// Seconds to make one failing scene smaller; 0: it is kept as it is.
    pub shrink: u64,
    /// The kind of scenes to draw; all when empty.
    pub kind: String,
    /// Whether to hold the plain path tracer against itself: every finding is a false alarm then.
    pub itself: bool,
}

/// A scene that was examined.
pub(crate) struct Done {
    case: Case,
    examined: Examined,
    seconds: f64,
    kept: Option<PathBuf>,
}

/// Draws and examines scenes; gives how many have findings.
///
/// # Errors
/// The picture's size is no multiple of a tile's; no such kind; a failing scene cannot be written.
pub fn run(options: &Options) -> anyhow::Result<usize> {
    anyhow::ensure!(
        options.size > 0 && options.size.is_multiple_of(trial::TILE),
        "--size: not a multiple of {}",
        trial::TILE
    );
    let known = kinds::KINDS.iter().any(|kind| kind.0 == options.kind);
    let names = || kinds::KINDS.map(|kind| kind.0).join(", ");
    anyhow::ensure!(options.kind.is_empty() || known, "--kind: none of {}", names());
    let jobs = match options.jobs {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        jobs => jobs,
    };
    let seeds: Vec<u64> = (options.seed..)
        .filter(|&seed| options.kind.is_empty() || kinds::kind(seed) == options.kind)
        .take(options.scenes)
        .collect();
    let start = Instant::now();
    let (next, done) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || -> anyhow::Result<()> {
        while let Some(&seed) = seeds.get(next.fetch_add(1, Ordering::Relaxed)) {
            let scene = one(seed, options)?;
            let mut done = done.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            done.push(scene);
            report::progress(&done, options.scenes, start);
        }
        Ok(())
    };
    // Scenes side by side rather than one on all cores: small pictures do not fill many threads.
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..jobs).map(|_| scope.spawn(work)).collect();
        workers.into_iter().try_for_each(|worker| match worker.join() {
            Ok(result) => result,
            Err(panic) => std::panic::resume_unwind(panic),
        })
    })?;
    let mut done = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    done.sort_by_key(|scene| scene.case.seed);
    report::summary(&done, start);
    Ok(done.iter().filter(|scene| !scene.examined.findings.is_empty()).count())
}

/// Draws and examines one scene, and keeps it where it fails.
fn one(seed: u64, options: &Options) -> anyhow::Result<Done> {
    let start = Instant::now();
    let case = kinds::case(seed, options.size);
    let against = if options.itself { Against::Itself } else { Against::Truth };
    let examined = examine::examine(&case, against, 1);
    let seconds = start.elapsed().as_secs_f64();
    let kept = match examined.findings.first() {
        None => None,
        Some(first) => Some(keep(&case, first, &examined, options)?),
    };
    Ok(Done { case, examined, seconds, kept })
}

/// Makes a failing scene smaller and writes it, with the original beside it.
fn keep(case: &Case, first: &Finding, examined: &Examined, options: &Options) -> anyhow::Result<PathBuf> {
    let folder = options.keep.join(format!("{}-{}", case.seed, case.kind.replace(' ', "-")));
    let measured =
        |findings: &[Finding]| findings.iter().map(|f| format!("{:?}: {}\n", f.fault, f.text)).collect::<String>();
    let title = format!("Seed {}: {}, held against {:?}.\n", case.seed, case.kind, case.relation);
    case.world.write(&folder, "drawn", &(title.clone() + &measured(&examined.findings)))?;
    if options.shrink == 0 || options.itself {
        return Ok(folder.join("drawn.ron"));
    }
    let smallest = shrink::shrink(case, first, Duration::from_secs(options.shrink), 1);
    let comment = format!(
        "{title}Made smaller: {} of {} objects are left, {} scenes tried.\n{}",
        smallest.case.world.desc.objects.len(),
        case.world.desc.objects.len(),
        smallest.tried,
        measured(&[smallest.finding])
    );
    smallest.case.world.write(&folder, "smallest", &comment)
}
