//! Faults in picture layers.

use super::{Mutant, proofs, suite};

const FILM: &str = "crates/tracer-core/src/film/layers.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "depth-along-the-ray",
        file: "crates/kernels/src/engine/stages/cameras/mod.rs",
        find: "let depth = t * direction.dot(forward);",
        replace: "let depth = t + F::splat(0.0) * direction.dot(forward);",
        caught_by: proofs(&["layers::a_wall_seen_straight_has_one_depth"]),
    },
    Mutant {
        name: "normals-of-the-triangles",
        file: "crates/kernels/src/layers/normal.rs",
        find: "hit.surface.ns",
        replace: "hit.surface.ng",
        caught_by: proofs(&["layers::first_hits_are_those_of_the_reference"]),
    },
    Mutant {
        name: "triangles-move-as-others-do",
        file: "crates/kernels/src/scene/motion.rs",
        find: "primitive.checked_sub(self.tables.loose())?",
        replace: "primitive.checked_sub(self.tables.loose().min(1))?",
        caught_by: proofs(&["motion::motion_of_things"]),
    },
    Mutant {
        name: "copies-move-as-others-do",
        file: "crates/kernels/src/scene/motion.rs",
        find: "place[..2] < [object, copy][..]",
        replace: "place[..1] < [object][..]",
        caught_by: proofs(&["motion::motion_of_things"]),
    },
    Mutant {
        name: "what-is-round-jumps-at-the-vertical",
        file: "crates/kernels/src/scene/motion.rs",
        find: "if is_round && now.2 && then.2 {",
        replace: "if is_round && !now.2 && then.2 {",
        caught_by: proofs(&["motion::motion_of_things"]),
    },
    Mutant {
        name: "two-surfaces-are-direct",
        file: "crates/tracer-core/src/engine/direct.rs",
        find: "pub const LAST: u32 = 1;",
        replace: "pub const LAST: u32 = 2;",
        caught_by: proofs(&["direct::direct_light_is_the_picture_without_bounces"]),
    },
    Mutant {
        name: "chains-bring-no-direct-light",
        file: "crates/tracer-core/src/engine/techniques/glints.rs",
        find: "shade(engine, pass, vertex, batch);",
        replace: "kernels.shade(scene, pass, vertex, batch);",
        caught_by: proofs(&["direct::"]),
    },
    Mutant {
        name: "guides-see-without-tints",
        file: "crates/kernels/src/engine/stages/seen.rs",
        find: "weight: ray.throughput.scale(ray.eta2),",
        replace: "weight: crate::math::V3::grey(ray.eta2),",
        caught_by: proofs(&["layers::mirrors_and_glass_show_what_guides_denoisers"]),
    },
    Mutant {
        name: "guides-see-both-ways-in-full",
        file: "crates/kernels/src/engine/stages/seen.rs",
        find: "weight: ray.throughput.scale(ray.eta2),",
        replace: "weight: ray.throughput,",
        caught_by: proofs(&["layers::mirrors_and_glass_show_what_guides_denoisers"]),
    },
    Mutant {
        name: "polished-metals-show-no-lamps",
        file: "crates/kernels/src/engine/stages/seen.rs",
        find: "const SHARP: f32 = 20.0;",
        replace: "const SHARP: f32 = 1e30;",
        caught_by: suite("denoise", &["small_lamps_in_polished_metal_stay"]),
    },
    Mutant {
        name: "two-panes-hide-lamps",
        file: "crates/tracer-core/src/engine/trace.rs",
        find: "const LAMPS_BEHIND: u32 = 2 * BRANCHING;",
        replace: "const LAMPS_BEHIND: u32 = BRANCHING;",
        caught_by: suite("denoise", &["small_lamps_behind_two_panes_stay"]),
    },
    Mutant {
        name: "misses-do-not-count",
        file: FILM,
        find: "Pixel::Mean | Pixel::Seen | Pixel::Counted(_) => tile.samples[k].max(1)",
        replace: "Pixel::Mean | Pixel::Seen | Pixel::Counted(_) => hits.max(1)",
        caught_by: proofs(&["layers::layers_are_averaged_as_the_picture_is"]),
    },
    Mutant {
        name: "the-farthest-sample-names-the-object",
        file: FILM,
        find: "u64::from(!distance2.to_bits()) << 32",
        replace: "u64::from(distance2.to_bits()) << 32",
        caught_by: proofs(&["layers::a_ball_is_as_the_formula_says"]),
    },
    Mutant {
        name: "a-film-of-other-layers-is-taken",
        file: FILM,
        find: "self.layers == other.layers",
        replace: "self.layers.len() <= other.layers.len() + 64",
        caught_by: proofs(&["layers::films_with_layers_are_gone_on_with"]),
    },
];
