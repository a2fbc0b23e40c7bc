//! Faults of photons, guided rays and glint chains (`render.caustics`).

use super::{Mutant, kernel_units, proofs};

const VERTEX: &str = "crates/kernels/src/engine/stages/shade/vertex.rs";
const SHARING: &str = "crates/kernels/src/engine/stages/shade/sharing.rs";
const SCATTER: &str = "crates/kernels/src/engine/stages/shade/scatter.rs";
const EMISSION: &str = "crates/kernels/src/engine/stages/shade/emission.rs";
const PHOTONS: &str = "crates/kernels/src/engine/stages/photons.rs";
const AIM: &str = "crates/kernels/src/engine/stages/aim.rs";
const GLINTS: &str = "crates/tracer-core/src/engine/techniques/glints.rs";
const BATCH: &str = "crates/kernels/src/engine/batch.rs";
const REUSE: &str = "crates/tracer-core/src/engine/techniques/reuse.rs";
const LIGHT_PATHS: &str = "crates/kernels/src/engine/stages/light_paths.rs";
const CELLS: &str = "crates/kernels/src/engine/guide/cells.rs";
const PLAN: &str = "crates/kernels/src/engine/guide/plan.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    // Light paths from the bright parts of pictures.
    Mutant {
        name: "suns-send-no-light-paths",
        file: PLAN,
        find: "self.strays.push(center != caster.center || is_astray(before, caster));",
        replace: "self.strays.push(center != caster.center || !is_astray(before, caster));",
        caught_by: proofs(&["suns"]),
    },
    Mutant {
        name: "suns-over-glass-in-full-beside-light-paths",
        file: EMISSION,
        find: "let weight = self.beside_light_paths(ray, paths, lanes, &sky, weight);",
        replace: "",
        caught_by: proofs(&["suns"]),
    },
    Mutant {
        name: "light-paths-of-suns-weigh-by-light-samples",
        file: EMISSION,
        find: "(sky.pdf, sky.radiance), from",
        replace: "(sky.sampled, sky.radiance), from",
        caught_by: proofs(&["suns"]),
    },
    Mutant {
        name: "all-of-the-sky-has-light-paths",
        file: LIGHT_PATHS,
        find: "let mask = mask & bright.has(radiance);",
        replace: "",
        caught_by: proofs(&["suns"]),
    },
    Mutant {
        name: "suns-shine-through-planes",
        file: PHOTONS,
        find: " & !behind_planes(scene, point, from.wi)",
        replace: "",
        caught_by: proofs(&["suns"]),
    },
    Mutant {
        name: "both-ways-at-glass-with-all-the-light",
        file: SCATTER,
        find: "share = F::select(both, one - fainter, one);",
        replace: "share = one;",
        caught_by: proofs(&["analytic::"]),
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
        file: VERTEX,
        find: "self.surfaces = self.surfaces & self.bsdf.specular();",
        replace: "",
        caught_by: proofs(&["glints"]),
    },
    // Rays aimed at casters.
    Mutant {
        name: "aimed-rays-that-bring-anything",
        file: SHARING,
        find: "at.surfaces = at.surfaces & !(aimed & at.bsdf.diffuse);",
        replace: "",
        caught_by: proofs(&["aimed"]),
    },
    Mutant {
        name: "pixels-share-outdoors",
        file: REUSE,
        find: "((has_second - OUTDOORS) / (INDOORS - OUTDOORS)).clamp(0.0, 1.0)",
        replace: "1.0",
        caught_by: proofs(&["reuse::rooms_with_a_window"]),
    },
    // Guided rays. What makes a guide worse moves the variance only.
    Mutant {
        name: "photons-into-the-glass-they-leave",
        file: PHOTONS,
        find: "F::select(d.refracted, -s.offset, s.offset)",
        replace: "F::select(d.refracted, s.offset, -s.offset) * F::splat(1e3)",
        caught_by: proofs(&["caustics::photons_are_worth_it"]),
    },
    Mutant {
        name: "lights-send-photons-away-from-casters",
        file: PLAN,
        find: "(caster - center).try_normalize()",
        replace: "(center - caster).try_normalize()",
        caught_by: proofs(&["caustics::photons_are_worth_it"]),
    },
    Mutant {
        name: "flat-lights-that-send-to-both-sides",
        file: PLAN,
        find: "let sides = if light.two_sided() { 2.0 } else { 1.0 };",
        replace: "let sides = 2.0;",
        caught_by: proofs(&["shining::over_glass"]),
    },
    Mutant {
        name: "spheres-without-their-photons",
        file: CELLS,
        find: "radius.mul_add(1.0 + MARGIN, TO_NEXT * next)",
        replace: "(0.1 * radius)",
        caught_by: kernel_units(&["engine::guide::cells"]),
    },
    Mutant {
        name: "cells-of-other-places",
        file: CELLS,
        find: "cell = F::U::select(on, child, cell);",
        replace: "cell = F::U::select(on, child + F::U::splat(1), cell);",
        caught_by: kernel_units(&["engine::guide::cells"]),
    },
    Mutant {
        name: "aimed-rays-count-in-full",
        file: AIM,
        find: "let weight = by_itself / (by_itself + density);",
        replace: "let weight = by_itself / density;",
        caught_by: kernel_units(&["engine::stages::aim"]),
    },
    Mutant {
        name: "aimed-rays-without-their-chance",
        file: AIM,
        find: "over((one - casters) * lights.chance, sums[LIGHTS])",
        replace: "over(one - casters, sums[LIGHTS])",
        caught_by: kernel_units(&["engine::stages::aim"]),
    },
    Mutant {
        name: "no-rays-around-the-cones",
        file: AIM,
        find: "const AROUND: f32 = 0.2;",
        replace: "const AROUND: f32 = 0.0;",
        caught_by: kernel_units(&["engine::stages::aim"]),
    },
    Mutant {
        name: "rays-around-the-cones-as-dense-as-within",
        file: AIM,
        find: "c(AROUND / WIDER), c(0.0))",
        replace: "c(AROUND), c(0.0))",
        caught_by: kernel_units(&["engine::stages::aim"]),
    },
    Mutant {
        name: "rough-metals-aim-nothing",
        file: SHARING,
        find: "let aims = at.surfaces & at.bsdf.rough()",
        replace: "let aims = at.surfaces & at.bsdf.has_one_color()",
        caught_by: proofs(&["aimed::light_over_glass_is_found_from_rough_metals"]),
    },
    Mutant {
        name: "rough-metals-aim-with-their-colour-twice",
        file: SHARING,
        find: "carried = V3::select(at.bsdf.has_one_color(), carried, at.ray.throughput);",
        replace: "",
        caught_by: proofs(&["aimed::rough_metals"]),
    },
    Mutant {
        name: "own-rays-count-in-full-beside-aimed-ones",
        file: SHARING,
        find: "ray.eta2 = F::select(both_find, ray.eta2 * weight, ray.eta2);",
        replace: "let _ = weight;",
        caught_by: proofs(&["aimed"]),
    },
    Mutant {
        name: "own-rays-see-the-sky-in-full-beside-aimed-ones",
        file: EMISSION,
        find: "F::select(own, by_itself / both, one)",
        replace: "one",
        caught_by: proofs(&["aimed::windows_under_a_sky"]),
    },
    Mutant {
        name: "light-samples-see-the-sky-in-full-beside-aimed-rays",
        file: "crates/kernels/src/engine/stages/shade/light_sample.rs",
        find: "let by_rays = pdf + self.aimed_at_the_sky(at, l.wi, lit & choice.environment);",
        replace: "let by_rays = pdf;",
        caught_by: proofs(&["aimed::windows_under_a_picture"]),
    },
    Mutant {
        name: "no-photons-from-skies",
        file: "crates/kernels/src/engine/guide/bright.rs",
        find: "const LEAST_PART: f64 = 0.1;",
        replace: "const LEAST_PART: f64 = 2.0;",
        caught_by: proofs(&["aimed::a_sun_over_glass_is_found"]),
    },
    Mutant {
        name: "aimed-rays-end-in-panes",
        file: AIM,
        find: "path::AIMED | path::SPARED | path::SPECULAR",
        replace: "path::AIMED | path::SPECULAR",
        caught_by: proofs(&["aimed::aimed_rays_are_spared_by_roulette"]),
    },
    Mutant {
        name: "nothing-is-aimed-through-windows",
        file: "crates/kernels/src/engine/guide/sky.rs",
        find: "(matters * worth(",
        replace: "(0.0 * matters * worth(",
        caught_by: proofs(&["aimed::windows_are_found"]),
    },
    // Light paths.
    Mutant {
        name: "light-paths-beside-paths-in-full",
        file: EMISSION,
        find: "weight = F::select(found, one / (one + by_light), weight);",
        replace: "",
        caught_by: proofs(&["caustics::on_any_film"]),
    },
    Mutant {
        name: "light-paths-without-the-lights-cosine",
        file: LIGHT_PATHS,
        find: "F::select(everywhere, one, cos * cone * c(TWO_PI))",
        replace: "F::select(everywhere, one, cone * c(TWO_PI))",
        caught_by: proofs(&["caustics::on_any_film"]),
    },
    Mutant {
        name: "light-paths-over-bent-normals",
        file: LIGHT_PATHS,
        find: "F::select(alike(s, wo, wi, refracted, ior), factor, F::splat(0.0))",
        replace: "factor",
        caught_by: kernel_units(&["engine::stages::light_paths"]),
    },
    Mutant {
        name: "light-paths-with-one-index-of-refraction",
        file: LIGHT_PATHS,
        find: "of_glass = F::select(refracted, one / d.eta2, one);",
        replace: "",
        caught_by: proofs(&["caustics::seen_otherwise"]),
    },
    Mutant {
        name: "light-paths-through-walls",
        file: "crates/tracer-core/src/engine/techniques/light_paths.rs",
        find: "let arrives = |k: usize| batch.shadows.occluded[k] == 0;",
        replace: "let arrives = |_: usize| true;",
        caught_by: proofs(&["caustics::on_any_film"]),
    },
    Mutant {
        name: "photons-of-far-lights-start-at-them",
        file: PLAN,
        find: "if let Start::Before(way) = start { way as f32 } else { f32::INFINITY }",
        replace: "if let Start::Before(way) = start { f32::INFINITY.max(way as f32) } else { f32::INFINITY }",
        caught_by: proofs(&["distances::the_sun_may_be_as_far_as_it_is"]),
    },
    Mutant {
        name: "images-are-never-aimed-at",
        file: "crates/kernels/src/engine/guide/cells.rs",
        find: "if met <= seen {",
        replace: "if met <= f32::INFINITY * seen {",
        caught_by: kernel_units(&["engine::guide::cells"]),
    },
    Mutant {
        name: "lamps-let-far-light-through",
        file: "crates/kernels/src/engine/guide/approach.rs",
        find: ".filter(|(k, _)| *k != own)",
        replace: ".filter(|(k, _)| *k != own && scene.spheres.get(*k).is_none_or(|s| s.light == u32::MAX))",
        caught_by: proofs(&["distances::lamps_stand_in_the_way_of_the_sun"]),
    },
];
