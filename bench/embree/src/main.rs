//! The tracer's tree against Embree: the same rays in the same run, one thread, million rays a second.
//!
//! `cargo run --release -- [room | field | FILE.obj] [TRIANGLES] [SIZE] [ROUNDS]`
//!
//! Contestants take turns, and each one's best round counts, in CPU time of the thread: the machine may be shared.

mod embree;
#[path = "../../../crates/tracer-core/examples/rays/sets.rs"]
mod sets;

use embree::{Embree, Way};
use sets::{Answers, Scene, Set, build, field, load, room, sets, trace};
use std::path::Path;
use tracer_core::bvh::{Acceleration, Coherence};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let what = words.next().unwrap_or_else(|| "room".to_string());
    let triangles: usize = words.next().map_or(Ok(70_000), |word| word.parse())?;
    let size: usize = words.next().map_or(Ok(512), |word| word.parse())?;
    let rounds: usize = words.next().map_or(Ok(9), |word| word.parse())?;
    let mut scene: Scene = match what.as_str() {
        "room" => room(triangles),
        "field" => field(triangles),
        path => load(Path::new(path))?,
    };
    let accel = build(&scene, Acceleration::Bvh);
    let sets = sets(&scene, &accel, size);
    scene.mesh.positions.push([0.0; 3]);
    let fast = Embree::new(&scene.mesh, true, false);
    let robust = Embree::new(&scene.mesh, true, true);
    let stats = accel.stats();
    println!(
        "{what}, {} triangles; level {}, Embree {}; build seconds {:.3} and {:.3}; {:.1} bytes a triangle",
        stats.triangles,
        accel.level().name(),
        fast.version(),
        stats.seconds,
        fast.seconds,
        stats.bytes as f64 / stats.triangles as f64
    );
    println!(
        "{:16} {:>7} | {:>10} {:>8} | {:>7} {:>7} {:>7} | {:>7} {:>7} | {:>6} differ",
        "Mrays/s", "rays", "incoherent", "coherent", "single", "16", "16 coh.", "robust1", "rob. 16", "ratio"
    );
    for set in &sets {
        let coherent = Set { coherence: Coherence::Coherent, ..clone(set) };
        let incoherent = Set { coherence: Coherence::Incoherent, ..clone(set) };
        let (mut ours, mut theirs) = (Answers::new(set), Answers::new(set));
        let mut best = [f64::INFINITY; 7];
        let packets = |coherent| Way::Packets { coherent };
        for _ in 0..rounds {
            let mut time = |i: usize, run: &mut dyn FnMut()| {
                let start = thread_seconds();
                run();
                best[i] = best[i].min(thread_seconds() - start);
            };
            time(0, &mut || trace(&accel, &incoherent, &mut ours));
            time(2, &mut || fast.trace(set, Way::Single, &mut theirs));
            time(1, &mut || trace(&accel, &coherent, &mut ours));
            time(3, &mut || fast.trace(set, packets(false), &mut theirs));
            time(4, &mut || fast.trace(set, packets(true), &mut theirs));
            time(5, &mut || robust.trace(set, Way::Single, &mut theirs));
            time(6, &mut || robust.trace(set, packets(true), &mut theirs));
        }
        let differ = differing(set, &ours, &theirs);
        let speed = best.map(|seconds| set.len() as f64 / seconds / 1e6);
        let (us, them) = (speed[0].max(speed[1]), speed[2].max(speed[3]).max(speed[4]));
        println!(
            "{:16} {:>7} | {:>10.2} {:>8.2} | {:>7.2} {:>7.2} {:>7.2} | {:>7.2} {:>7.2} | {:>6.2} {differ}",
            set.name,
            set.len(),
            speed[0],
            speed[1],
            speed[2],
            speed[3],
            speed[4],
            speed[5],
            speed[6],
            us / them
        );
    }
    Ok(())
}

/// How many answers differ: blocked or not, or t by more than a part in 10 000.
fn differing(set: &Set, ours: &Answers, theirs: &Answers) -> usize {
    let differs = |i: usize| {
        if set.tmax.is_empty() {
            let (a, b) = (ours.t[i], theirs.t[i]);
            a != b && (a - b).abs() > 1e-4 * a.abs().min(b.abs())
        } else {
            ours.occluded[i] != theirs.occluded[i]
        }
    };
    (0..set.len()).filter(|&i| differs(i)).count()
}

fn clone(set: &Set) -> Set {
    Set {
        name: set.name,
        coherence: set.coherence,
        origin: set.origin.clone(),
        direction: set.direction.clone(),
        from: set.from.clone(),
        tmax: set.tmax.clone(),
    }
}

/// CPU time of this thread.
fn thread_seconds() -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the clock exists on Linux, and `time` is a timespec.
    unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut time) };
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}
