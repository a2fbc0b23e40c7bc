//! Faults of photons (`render.caustics`).

use super::{Mutant, proofs, units};

const PHOTONS: &str = "crates/tracer-core/src/engine/stages/photons.rs";
const AIM: &str = "crates/tracer-core/src/engine/stages/aim.rs";
const GATHER: &str = "crates/tracer-core/src/engine/stages/gather.rs";
const SHADE: &str = "crates/tracer-core/src/engine/stages/shade.rs";
const GLINTS: &str = "crates/tracer-core/src/engine/glints.rs";
const BATCH: &str = "crates/tracer-core/src/engine/batch.rs";
const ENGINE: &str = "crates/tracer-core/src/engine/mod.rs";
const INDIRECT: &str = "crates/tracer-core/src/engine/indirect.rs";
const MAP: &str = "crates/tracer-core/src/engine/caustics/map.rs";
const PLAN: &str = "crates/tracer-core/src/engine/caustics/plan.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "light-by-photons-and-by-paths",
        file: SHADE,
        find: "weight = F::select(by_photons, zero, weight);",
        replace: "weight = F::select(by_photons, weight, weight);",
        caught_by: proofs(&["caustics::glass_ball"]),
    },
    Mutant {
        name: "narrow-lobes-by-photons-and-by-light-samples",
        file: SHADE,
        find: "F::select(by_photons, zero, glossy)",
        replace: "glossy",
        caught_by: proofs(&["caustics::glossy_lobes"]),
    },
    Mutant {
        name: "photons-end-at-glossy-lobes",
        file: PHOTONS,
        find: "let passes = bsdf.mirror | bsdf.transparent | narrow;",
        replace: "let passes = bsdf.mirror | bsdf.transparent;",
        caught_by: proofs(&["caustics::glossy_lobes"]),
    },
    Mutant {
        name: "both-ways-at-glass-with-all-the-light",
        file: SHADE,
        find: "share = F::select(both, one - fainter, one);",
        replace: "share = one;",
        caught_by: proofs(&["analytic::"]),
    },
    Mutant {
        name: "later-gathers-without-their-chance",
        file: SHADE,
        find: "c(std::f32::consts::FRAC_1_PI) / chance)",
        replace: "c(std::f32::consts::FRAC_1_PI))",
        caught_by: proofs(&["caustics::lamps_anywhere"]),
    },
    Mutant {
        name: "photons-without-the-cosine-at-the-light",
        file: PHOTONS,
        find: "let mut density = normal.dot(direction) * cone",
        replace: "let mut density = cone",
        caught_by: proofs(&["caustics::glass_ball"]),
    },
    Mutant {
        name: "photons-of-other-casters-kept",
        file: PHOTONS,
        find: "hit = hit & F::U::select(on_sphere, of_sphere, of_instance).eq(wanted);",
        replace: "hit = hit & !F::U::select(on_sphere, of_sphere, of_instance).eq(wanted + F::U::splat(1));",
        caught_by: proofs(&["caustics::many_casters"]),
    },
    Mutant {
        name: "photons-into-the-glass-they-leave",
        file: PHOTONS,
        find: "F::select(d.refracted, -s.offset, s.offset)",
        replace: "F::select(d.refracted, s.offset, -s.offset)",
        caught_by: proofs(&["caustics::meshes"]),
    },
    Mutant {
        name: "photons-tint-what-glass-reflects",
        file: PHOTONS,
        find: "weight = V3::select(bsdf.transparent & !d.refracted, V3::grey(one), weight);",
        replace: "weight = weight.scale(one);",
        caught_by: proofs(&["caustics::glass_of_several"]),
    },
    Mutant {
        name: "photons-one-event-too-long",
        file: GATHER,
        find: "F::U::splat(most_events + 1)",
        replace: "F::U::splat(most_events + 2)",
        caught_by: units(&["engine::caustics::map"]),
    },
    Mutant {
        name: "photons-through-thin-walls",
        file: GATHER,
        find: "near & same_side & short",
        replace: "near & (same_side | short)",
        caught_by: units(&["engine::caustics::map"]),
    },
    Mutant {
        name: "kernel-of-the-wrong-norm",
        file: MAP,
        find: "2.0 * std::f32::consts::FRAC_1_PI / (radius * radius)",
        replace: "1.5 * std::f32::consts::FRAC_1_PI / (radius * radius)",
        caught_by: units(&["engine::caustics::map"]),
    },
    Mutant {
        name: "cells-half-as-wide",
        file: MAP,
        find: "let inverse_cell = 0.5 / radius;",
        replace: "let inverse_cell = 1.0 / radius;",
        caught_by: units(&["engine::caustics::map"]),
    },
    Mutant {
        name: "radii-that-do-not-shrink",
        file: MAP,
        find: "const ALPHA: f64 = 2.0 / 3.0;",
        replace: "const ALPHA: f64 = 1.0;",
        caught_by: units(&["engine::caustics::map"]),
    },
    Mutant {
        name: "lights-that-cannot-see-the-caster",
        file: PLAN,
        find: "1.0 - (light.radius - caster.radius) / distance",
        replace: "1.0 - (light.radius + caster.radius) / distance",
        caught_by: proofs(&["caustics::glass_ball"]),
    },
    // Glint chains.
    Mutant {
        name: "chains-beside-paths-in-full",
        file: BATCH,
        find: "if self.glints >> k & 1 == 1 { WEIGHT } else { 1.0 }",
        replace: "1.0",
        caught_by: proofs(&["glints"]),
    },
    Mutant {
        name: "chains-that-are-alike",
        file: GLINTS,
        find: "sample * CHAINS + chain",
        replace: "sample * CHAINS",
        caught_by: proofs(&["glints"]),
    },
    Mutant {
        name: "chains-through-matt-surfaces",
        file: SHADE,
        find: "surfaces = surfaces & (bsdf.mirror | bsdf.transparent);",
        replace: "",
        caught_by: proofs(&["glints"]),
    },
    // The indirect map.
    Mutant {
        name: "records-of-lamps-that-light-samples-bring",
        file: SHADE,
        find: "emits = emits & !has(slot, path::INDIRECT);",
        replace: "",
        caught_by: proofs(&["indirect"]),
    },
    Mutant {
        name: "records-with-the-light-sample-at-their-own-vertex",
        file: SHADE,
        find: "has(slot, path::SHARED) & !second }",
        replace: "has(slot, path::SHARED) }",
        caught_by: proofs(&["indirect"]),
    },
    Mutant {
        name: "records-with-the-albedo-of-their-own-vertex",
        file: SHADE,
        find: "carried = V3::select(second, V3::grey(one), carried);",
        replace: "",
        caught_by: proofs(&["indirect"]),
    },
    Mutant {
        name: "paths-go-on-where-the-map-answers",
        file: SHADE,
        find: "{ valid & !known }",
        replace: "{ valid }",
        caught_by: proofs(&["indirect"]),
    },
    Mutant {
        name: "pixels-share-outdoors",
        file: ENGINE,
        find: "sharing == Sharing::Indoors && has_second >= INDOORS",
        replace: "sharing == Sharing::Indoors",
        caught_by: proofs(&["indirect"]),
    },
    Mutant {
        name: "second-vertices-of-any-number-are-alike",
        file: INDIRECT,
        find: "key.wrapping_add(u64::from(vertex).wrapping_mul(0xd6e8_feb8_6659_fd93)).max(1)",
        replace: "key",
        caught_by: units(&["engine::indirect"]),
    },
    Mutant {
        name: "from-near-told-as-from-far",
        file: INDIRECT,
        find: "!counted[k] && farther_than < records[k].distance",
        replace: "!counted[k]",
        caught_by: units(&["engine::indirect"]),
    },
    Mutant {
        name: "records-that-count-in-cells-of-every-level",
        file: INDIRECT,
        find: "!counted[k] && farther_than < records[k].distance",
        replace: "farther_than < records[k].distance",
        caught_by: units(&["engine::indirect"]),
    },
    // Rays aimed at casters.
    Mutant {
        name: "aimed-rays-count-in-full",
        file: AIM,
        find: "(by_itself + density(aims, p, n, wi))",
        replace: "density(aims, p, n, wi)",
        caught_by: units(&["engine::stages::aim"]),
    },
    Mutant {
        name: "aimed-rays-without-their-chance",
        file: AIM,
        find: "within * c(CHANCE / TWO_PI) / sum",
        replace: "within * c(1.0 / TWO_PI) / sum",
        caught_by: units(&["engine::stages::aim"]),
    },
    Mutant {
        name: "own-rays-count-in-full-beside-aimed-ones",
        file: SHADE,
        find: "throughput = V3::select(both_find, throughput.scale(weight), throughput);",
        replace: "let _ = weight;",
        caught_by: proofs(&["aimed"]),
    },
    Mutant {
        name: "aimed-rays-that-bring-anything",
        file: SHADE,
        find: "surfaces = surfaces & !(aimed & bsdf.diffuse);",
        replace: "",
        caught_by: proofs(&["aimed"]),
    },
];
