//! How fast the tree is: million rays a second, one thread, for each set of rays, level and mode.
//!
//! `cargo run --release -p tracer-core --example rays -- [room | field | FILE.obj] [TRIANGLES] [SIZE] [SETS] [ROUNDS]`
//!
//! SETS are letters, for instance `ac`; only the best level is timed where they are given.
//!
//! Times of one run on a shared machine say little: compare within a run.

// Rays that are only timed reach no picture.
#![allow(clippy::disallowed_methods)]

mod sets;

use sets::{Answers, Set, batches, build, field, load, room, sets, trace};
use std::path::Path;
use std::time::Instant;
use tracer_core::Level;
use tracer_core::bvh::{Accel, Acceleration, Coherence, Counters};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let what = words.next().unwrap_or_else(|| "room".to_string());
    let triangles: usize = words.next().map_or(Ok(70_000), |word| word.parse())?;
    let size: usize = words.next().map_or(Ok(512), |word| word.parse())?;
    let only = words.next();
    let levels = if only.is_some() { vec![Level::best()] } else { Level::available() };
    let only = only.unwrap_or_else(|| "abcde".to_string());
    let rounds: usize = words.next().map_or(Ok(5), |word| word.parse())?;
    let scene = match what.as_str() {
        "room" => room(triangles),
        "field" => field(triangles),
        path => load(Path::new(path))?,
    };
    let accel = build(&scene, Acceleration::Bvh);
    let stats = accel.stats();
    println!(
        "{what}: {} triangles, {} parts of some; built in {:.3} s ({:.2} M triangles/s), {:.1} bytes a triangle, {} \
         nodes, {} leaves ({:.2} full), depth {}",
        stats.triangles,
        stats.parts,
        stats.seconds,
        stats.triangles as f64 / stats.seconds / 1e6,
        stats.bytes as f64 / stats.triangles as f64,
        stats.nodes,
        stats.leaves,
        stats.triangles as f64 / stats.leaves as f64,
        stats.depth,
    );
    let mut sets = sets(&scene, &accel, size);
    println!(
        "{:18} {:>9} {:>10} {:>13} {:>9}  visits a ray: nodes, leaves",
        "set", "rays", "level", "coherence", "Mrays/s"
    );
    let mut accel = accel;
    sets.retain(|set| set.name.chars().next().is_some_and(|letter| only.contains(letter)));
    for set in &mut sets {
        let mut answers = Answers::new(set);
        for coherence in [Coherence::Incoherent, Coherence::Coherent] {
            set.coherence = coherence;
            for &level in &levels {
                accel = accel.with_level(level);
                let mut best = f64::INFINITY;
                for _ in 0..rounds {
                    let start = Instant::now();
                    trace(&accel, set, &mut answers);
                    best = best.min(start.elapsed().as_secs_f64());
                }
                let speed = set.len() as f64 / best / 1e6;
                let visits = count(&accel, set, &mut answers);
                let each = |visits: u64| visits as f64 / set.len() as f64;
                println!(
                    "{:18} {:>9} {:>10} {:>13} {speed:>9.2}  {:.2}, {:.2}",
                    set.name,
                    set.len(),
                    level.name(),
                    format!("{coherence:?}"),
                    each(visits.nodes),
                    each(visits.triangle_leaves)
                );
            }
        }
    }
    if triangles <= 10_000 {
        for mode in [Acceleration::None, Acceleration::BoundingBox] {
            let accel = build(&scene, mode);
            for set in &sets {
                let mut answers = Answers::new(set);
                let start = Instant::now();
                trace(&accel, set, &mut answers);
                let speed = set.len() as f64 / start.elapsed().as_secs_f64() / 1e6;
                println!("{:18} {:>9} {mode:?} {speed:.4}", set.name, set.len());
            }
        }
    }
    Ok(())
}

/// Traces a set in batches and says what was visited.
fn count(accel: &Accel, set: &Set, answers: &mut Answers) -> Counters {
    let total = std::cell::Cell::new(Counters::default());
    let add = |counters: Counters| {
        let sum = total.get();
        total.set(Counters {
            nodes: sum.nodes + counters.nodes,
            triangle_leaves: sum.triangle_leaves + counters.triangle_leaves,
            sphere_leaves: sum.sphere_leaves + counters.sphere_leaves,
            instances: sum.instances + counters.instances,
        });
    };
    batches(
        set,
        answers,
        |rays, active, hits| add(accel.closest(rays, active, hits, set.coherence)),
        |rays, active, ends| add(accel.occluded(rays, active, ends, set.coherence)),
    );
    total.get()
}
