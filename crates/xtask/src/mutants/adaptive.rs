//! Faults of adaptive sampling (`render.adaptive`).

use super::{Mutant, proofs, suite, units};

const FILM: &str = "crates/tracer-core/src/film/adaptive.rs";
const ENGINE: &str = "crates/tracer-core/src/engine/adaptive.rs";
const NOISE: &str = "crates/tracer-core/src/film/noise.rs";
const CELLS: &str = "crates/tracer-core/src/film/cells.rs";
const PASSES: &str = "crates/tracer-core/src/engine/passes.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "light-paths-of-all-indices-count-where-tiles-rest",
        file: FILM,
        find: "f64::from(taken(tile.rest, self.light_samples).saturating_sub(taken(tile.rest, self.first())))",
        replace: "self.light_count()",
        caught_by: proofs(&["adaptive::it_is_as_bright"]),
    },
    Mutant {
        name: "light-paths-fall-on-tiles-that-rest",
        file: CELLS,
        find: ".filter(|tile| tile.takes(sample))",
        replace: "",
        caught_by: proofs(&["adaptive::it_is_as_bright"]),
    },
    Mutant {
        name: "tiles-rest-for-nothing",
        file: ENGINE,
        find: "(gain >= WORTH).then(|| below(limit, &both))",
        replace: "Some(below(limit, &both))",
        caught_by: suite("film_adaptive", &["quiet_tiles_rest_and_others_do_not"]),
    },
    Mutant {
        name: "tiles-rest-by-what-the-same-pictures-say",
        file: ENGINE,
        find: "hash3(film.seed(), 0x_ada9_71fe, k)",
        replace: "hash3(film.seed(), 0x_ada9_71fe, k / 2)",
        caught_by: suite("film_adaptive", &["quiet_tiles_rest_and_others_do_not"]),
    },
    Mutant {
        name: "passes-go-over-the-end-of-a-rest",
        file: PASSES,
        find: "let of_rest = if self.rests { run_end(start) - start } else { u32::MAX };",
        replace: "let of_rest = u32::MAX;",
        caught_by: suite("film_adaptive", &["threads_lanes_and_passes_do_not_show", "it_is_gone_on_with"]),
    },
    Mutant {
        name: "halves-of-unequal-lengths-as-equal-ones",
        file: NOISE,
        find: "let unequal = first / (all - first);",
        replace: "let unequal = 1.0;",
        caught_by: proofs(&["adaptive::it_tells_its_noise"]),
    },
    Mutant {
        name: "halves-of-tiles-that-rest-by-the-index-alone",
        file: FILM,
        find: "usize::from(offset << (rest + 1) >= top)",
        replace: "half_of(sample)",
        caught_by: units(&["indices_are_counted_as_they_are_taken"]),
    },
];
