//! Faults in the sampler, and in what its numbers are warped to.

use super::{Mutant, kernel_units, proofs};

const SAMPLER: &str = "crates/kernels/src/sampling/sampler.rs";
const WARP: &str = "crates/kernels/src/sampling/warp.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "disc-without-a-root",
        file: WARP,
        find: "let r = u.sqrt();",
        replace: "let r = u;",
        caught_by: kernel_units(&["sampling::warp"]),
    },
    Mutant {
        name: "cosine-lobe-not-of-unit-length",
        file: WARP,
        find: "V3(x, y, (F::splat(1.0) - u).sqrt())",
        replace: "V3(x, y, F::splat(1.0) - u)",
        caught_by: kernel_units(&["sampling::warp"]),
    },
    Mutant {
        name: "glossy-lobe-of-the-wrong-exponent",
        file: WARP,
        find: "(F::splat(2.0) / (alpha + one))",
        replace: "(F::splat(2.0) / (alpha + one + one))",
        caught_by: kernel_units(&["sampling::warp"]),
    },
    Mutant {
        name: "light-points-reuse-the-direction's",
        file: SAMPLER,
        find: "Purpose::Light(k) => 5 + 4 * k,",
        replace: "Purpose::Light(k) => 4 + 4 * k,",
        caught_by: proofs(&["sampler::points_are_uniform_over_seeds_and_pairs_unrelated"]),
    },
    Mutant {
        name: "bounces-share-their-light-points",
        file: SAMPLER,
        find: "Purpose::Light(k) => 5 + 4 * k,",
        replace: "Purpose::Light(k) => 5 + 0 * k,",
        caught_by: proofs(&["sampler::points_are_uniform_over_seeds_and_pairs_unrelated"]),
    },
    Mutant {
        name: "seed-reused",
        file: SAMPLER,
        find: "let b = hash3(seed, purpose.id(), 0x0ddc_0ffe);",
        replace: "let b = hash3(0, purpose.id(), 0x0ddc_0ffe);",
        caught_by: proofs(&["sampler::means_over_64_seeds_are_right", "sampler::points_are_uniform"]),
    },
    Mutant {
        name: "pixels-share-their-points",
        file: SAMPLER,
        find: "parts[k].0 ^ x[k].reverse_bits()",
        replace: "parts[k].0",
        caught_by: kernel_units(&["sampling::sampler"]),
    },
    Mutant {
        name: "groups-of-pixels-are-clumped",
        file: SAMPLER,
        find: "pascal_upper(second_of_pixel(y[k]))",
        replace: "pascal_upper(y[k])",
        caught_by: kernel_units(&["sampling::sampler::tests::groups_of_pixels_are_spread_in_two_dimensions"]),
    },
    Mutant {
        name: "numbers-reach-one",
        file: SAMPLER,
        find: "F::splat(1.0 / 16_777_216.0)",
        replace: "F::splat(1.0 / 16_777_215.0)",
        caught_by: proofs(&["sequence::numbers_stay_below_one"]),
    },
];
