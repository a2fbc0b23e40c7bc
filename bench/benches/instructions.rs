//! Instructions that the hot paths take, counted by valgrind: no noise, so a gate. `cargo bench --bench instructions`,
//! in this folder; needs valgrind and `cargo install gungraun-runner --version 0.20.0`.
//!
//! Valgrind knows AVX2 but no AVX-512, so the counts are those of the AVX2 kernels. The limits are the counts of the
//! commit that set them plus three per cent; whoever makes something cheaper lowers its limit, whoever must make it
//! dearer says why beside it.

use gungraun::prelude::*;
use gungraun::{Callgrind, EventKind};
use scene_format::{Loaded, Syntax, load_str};
use std::hint::black_box;
use std::path::Path;
use tracer_bench::{alone, balls, copies, hills, lamps, many_spheres, rendered};
use tracer_core::{Film, Image, Scene, develop};

/// At most so many instructions.
fn at_most(instructions: u64) -> LibraryBenchmarkConfig {
    let mut config = LibraryBenchmarkConfig::default();
    config.tool(Callgrind::with_args(["--cache-sim=no"]).hard_limits([(EventKind::Ir, instructions)]));
    config
}

// Pixels that share, and photons where they are worth it: 64x64 pixels, 4 samples. The balls were 161 M before each
// sample index had photons of its own (1024 of them at least), rays were aimed, and glint chains followed: 187 M then.
// The map of indirect light by default, whose records a picture as small as this has most of: 201 M then, and 6 to 9 %
// more for the others. Tables looked up row by row, columns of known length and small spheres about their centre: 151 M
// then. Every segment between pixels that counts is tested now, a sixteenth was before; photons guide rays instead of
// being gathered, and the map is gone: 209 M, the hills 422 M (221 M before), a hundred lamps 277 M (190 M), a thousand
// copies 931 M (1196 M). Shafts tell what can be between a suffix and its group, and light paths come from the lights:
// 190, 386, 203 and 918 M. Blocks are ragged and reach over 31 columns and rows instead of 16: more spheres can be
// between, a hundred lamps 219 M. Blocks deal their columns and rows by hash instead of every other one, and the tree
// always counts: 196, 378, 221 and 901 M.
#[library_benchmark]
#[bench::balls(args = (balls(64, 4)), config = at_most(201_400_000))]
#[bench::hills(args = (hills(20_000, 64, 4)), config = at_most(389_500_000))]
#[bench::copies(args = (copies(1_000, 64, 4)), config = at_most(928_000_000))]
#[bench::lamps(args = (lamps(100, 64, 4)), config = at_most(227_500_000))]
fn sharing(scene: Scene) -> Film {
    black_box(rendered(black_box(&scene), 1))
}

// The plain path tracer. The balls were 41.5 M when this limit was first set. Since then their samples of pixel and
// lens are four dimensions of one sequence, and gathers of eight have become permutations and transpositions: 52.9 M,
// and fewer cycles. With what is said above 39.5 M then. The film's exact sums are whole numbers with a wider window,
// and the sampler's words are looked up by block: 44.4 M and 85.9 M then. Pixels of a block may lie anywhere in four
// tiles, and are sorted by these before they are added: 46.3 M and 87.7 M then. The tree always counts what it visits,
// without a second copy of its code: 46.9 M and 88.6 M now.
#[library_benchmark]
#[bench::balls(args = (alone(balls(64, 4))), config = at_most(48_300_000))]
#[bench::hills(args = (alone(hills(20_000, 64, 4))), config = at_most(91_200_000))]
fn plain(scene: Scene) -> Film {
    black_box(rendered(black_box(&scene), 1))
}

/// Instructions of other threads are not counted, so this thread becomes the only one that a film is developed on.
fn film_of_this_thread(scene: &Scene) -> Film {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build().expect("no pool before");
    // It lasts as long as the process.
    std::mem::forget(pool);
    rendered(scene, 1)
}

// Film to picture. 16.9 M while closures of arrays' `map` were called, which the compiler inlines or not by what is
// around them; 13.8 M then. Sums of whole numbers of 128 bits become fractions: 25.6 M then. What light paths brought
// is added: 27.9 M now.
#[library_benchmark]
#[bench::balls(args = (film_of_this_thread(&balls(256, 1))), config = at_most(28_800_000))]
fn developed(film: Film) -> Image {
    black_box(develop(black_box(&film), &Default::default()))
}

// Reading and checking a scene file of 1000 spheres. 10.0 M before what other programs write was looked for where
// values stand, 11.9 M then. Kinds are not held against the names of functions any more: 0.36 M less (callgrind on the
// same text), 11.5 M. Spheres have two more fields, `transform` and `placements`, since: 1.13 M (callgrind of `convert`
// on 4000 spheres). They have names, and any value may be picked, any item repeated, grouped or included since: 2.1 M
// (callgrind of `check` on 500 and 1500 spheres); 14.8 M then, 13.0 M by what the compiler inlines since descriptions
// are serde's, too.
#[library_benchmark]
#[bench::ron(args = (many_spheres(1_000)), config = at_most(13_400_000))]
fn read(text: String) -> Loaded {
    black_box(load_str("many.ron", black_box(&text), Syntax::Ron, Path::new("."), &[]).expect("a scene that is right"))
}

library_benchmark_group!(name = hot_paths, benchmarks = [sharing, plain, developed, read]);
main!(library_benchmark_groups = hot_paths);
