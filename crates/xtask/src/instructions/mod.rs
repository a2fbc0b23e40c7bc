//! Instructions that the hot paths take, counted by valgrind: no noise, so a gate. `cargo xtask instructions`; needs
//! valgrind.
//!
//! The program starts itself under callgrind, once for each path, which counts while `counted` runs: what is measured
//! are the libraries as they are built for everybody (`release`), and nothing is compiled for it. Valgrind knows AVX2
//! but no AVX-512, so the counts are those of the AVX2 kernels. The limits are the counts of the commit that set them
//! plus three per cent; whoever makes something cheaper lowers its limit, whoever must make it dearer says why beside
//! it.

pub mod scenes;

use anyhow::{Context as _, bail, ensure};
use scene_format::{Syntax, load_str};
use scenes::{alone, balls, copies, hills, lamps, many_spheres, rendered};
use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use tracer_core::{Scene, develop};

/// A path whose instructions are counted.
struct Gate {
    name: &'static str,
    /// It takes no more.
    most: u64,
    /// Makes ready, and does under [`counted`] what is counted.
    run: fn(),
}

const GATES: &[Gate] = &[
    // Pixels that share, and photons where they are worth it: 64x64 pixels, 4 samples. The balls were 161 M before each
    // sample index had photons of its own (1024 of them at least), rays were aimed, and glint chains followed: 187 M
    // then. The map of indirect light by default, whose records a picture as small as this has most of: 201 M then, and
    // 6 to 9 % more for the others. Tables looked up row by row, columns of known length and small spheres about their
    // centre: 151 M then. Every segment between pixels that counts is tested now, a sixteenth was before; photons guide
    // rays instead of being gathered, and the map is gone: 209 M, the hills 422 M (221 M before), a hundred lamps 277 M
    // (190 M), a thousand copies 931 M (1196 M). Shafts tell what can be between a suffix and its group, and light
    // paths come from the lights: 190, 386, 203 and 918 M. Blocks are ragged and reach over 31 columns and rows instead
    // of 16: more spheres can be between, a hundred lamps 219 M. Blocks deal their columns and rows by hash instead of
    // every other one, and the tree always counts: 196, 378, 221 and 901 M. A batch's columns lie on pages of their
    // own, which nobody fills with zeros: 181, 370, 214 and 894 M. Rays are aimed from rough metals and around cones,
    // and roulette spares those that were aimed: 187.4 M, 372, 896 and 206 M, for 0.6 of the variance behind panes and
    // 0.87 to 0.89 of it over round glass.
    Gate { name: "sharing: balls", most: 189_000_000, run: || picture(&balls(64, 4)) },
    Gate { name: "sharing: hills", most: 380_800_000, run: || picture(&hills(20_000, 64, 4)) },
    Gate { name: "sharing: copies", most: 921_000_000, run: || picture(&copies(1_000, 64, 4)) },
    Gate { name: "sharing: lamps", most: 220_600_000, run: || picture(&lamps(100, 64, 4)) },
    // The plain path tracer. The balls were 41.5 M when this limit was first set. Since then their samples of pixel and
    // lens are four dimensions of one sequence, and gathers of eight have become permutations and transpositions:
    // 52.9 M, and fewer cycles. With what is said above 39.5 M then. The film's exact sums are whole numbers with a
    // wider window, and the sampler's words are looked up by block: 44.4 M and 85.9 M then. Pixels of a block may lie
    // anywhere in four tiles, and are sorted by these before they are added: 46.3 M and 87.7 M then. The tree always
    // counts what it visits, without a second copy of its code: 46.9 M and 88.6 M then. Nobody fills a batch's columns
    // with zeros: 42.8 M and 84.8 M now, 57.6 M and 100.6 M before, when these had room for rays aimed from later
    // vertices.
    Gate { name: "plain: balls", most: 44_100_000, run: || picture(&alone(balls(64, 4))) },
    Gate { name: "plain: hills", most: 87_300_000, run: || picture(&alone(hills(20_000, 64, 4))) },
    // Film to picture. 16.9 M while closures of arrays' `map` were called, which the compiler inlines or not by what is
    // around them; 13.8 M then. Sums of whole numbers of 128 bits become fractions: 25.6 M then. What light paths
    // brought is added: 27.9 M then. 29.1 M as `release` builds it, in one piece; the build that it was counted in
    // before, of sixteen pieces, still gives 28.7 M.
    Gate { name: "developed: balls", most: 28_300_000, run: developed },
    // Reading and checking a scene file of 1000 spheres. 10.0 M before what other programs write was looked for where
    // values stand, 11.9 M then. Kinds are not held against the names of functions any more: 0.36 M less (callgrind on
    // the same text), 11.5 M. Spheres have two more fields, `transform` and `placements`, since: 1.13 M (callgrind of
    // `convert` on 4000 spheres). They have names, and any value may be picked, any item repeated, grouped or included
    // since: 2.1 M (callgrind of `check` on 500 and 1500 spheres); 14.8 M then, 13.0 M by what the compiler inlines
    // since descriptions are serde's, too. What is asked for and cannot be seen is looked for (W0326, W0404): 13.4 M.
    Gate { name: "read: spheres", most: 13_600_000, run: read },
];

/// What callgrind counts: everything from its first instruction to its last.
#[inline(never)]
fn counted<T>(work: impl FnOnce() -> T) -> T {
    black_box(work())
}

fn picture(scene: &Scene) {
    counted(|| rendered(black_box(scene), 1));
}

/// Instructions of other threads are not counted, so this thread becomes the only one that a film is developed on.
fn developed() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build().expect("no pool before");
    // It lasts as long as the process.
    std::mem::forget(pool);
    let film = rendered(&balls(256, 1), 1);
    counted(|| develop(black_box(&film), &Default::default()));
}

fn read() {
    let text = many_spheres(1_000);
    let load = |text: &str| load_str("many.ron", text, Syntax::Ron, Path::new("."), &[]);
    counted(|| load(black_box(&text))).expect("a scene that is right");
}

/// Runs one path, for callgrind.
///
/// # Errors
/// When there is none of this name.
pub fn run_one(name: &str) -> anyhow::Result<()> {
    let gate = GATES.iter().find(|gate| gate.name == name);
    (gate.with_context(|| format!("there is no path {name:?}"))?.run)();
    Ok(())
}

/// Counts the instructions of all paths whose names contain `name`, and prints them beside their limits.
///
/// # Errors
/// When one takes more than it may; when valgrind is missing or fails.
pub fn run(name: &str) -> anyhow::Result<()> {
    let mut above = Vec::new();
    println!("{:<18} {:>14} {:>14}", "", "instructions", "at most");
    for gate in GATES.iter().filter(|gate| gate.name.contains(name)) {
        let instructions = count(gate.name)?;
        println!("{:<18} {instructions:>14} {:>14}", gate.name, gate.most);
        if instructions > gate.most {
            above.push(gate.name);
        }
    }
    ensure!(above.is_empty(), "more than they may: {}", above.join("; "));
    Ok(())
}

/// The instructions of one path, run by this program under callgrind.
fn count(name: &str) -> anyhow::Result<u64> {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("callgrind.out");
    let ran = Command::new("valgrind")
        .args(["--quiet", "--tool=callgrind", "--collect-atstart=no", "--toggle-collect=xtask::instructions::counted*"])
        .arg(format!("--callgrind-out-file={}", out.display()))
        .arg(std::env::current_exe()?)
        .args(["instructions", "--run", name])
        .output()
        .context("cannot run valgrind")?;
    if !ran.status.success() {
        bail!("valgrind, {name}: {}\n{}", ran.status, String::from_utf8_lossy(&ran.stderr));
    }
    let text = std::fs::read_to_string(&out).context("callgrind has written nothing")?;
    let total = text.lines().find_map(|line| line.strip_prefix("totals: ")?.trim().parse().ok());
    let total = total.context("callgrind tells no total")?;
    ensure!(total > 0, "callgrind has not met what is to be counted of {name}");
    Ok(total)
}
