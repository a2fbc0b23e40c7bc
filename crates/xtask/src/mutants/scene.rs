//! Faults in compiling, the scene's tables, the tree, the film and developing.

use super::{Mutant, kernel_units, proofs, suite, units};

const PREPARED: &str = "crates/tracer-core/src/compile/prepared.rs";
const SHAPED: &str = "crates/tracer-core/src/compile/shaped.rs";
const COMPILE_CAMERA: &str = "crates/tracer-core/src/compile/camera.rs";
const CAMERA_WORDS: &str = "crates/scene-format/src/desc/camera.rs";
const MESHES: &str = "crates/tracer-core/src/compile/meshes.rs";
const PLACING: &str = "crates/tracer-core/src/compile/placing.rs";
const LIGHT: &str = "crates/kernels/src/scene/light.rs";
const SPHERE: &str = "crates/kernels/src/scene/sphere.rs";
const FILM: &str = "crates/tracer-core/src/film.rs";
const NOISE: &str = "crates/tracer-core/src/film/noise.rs";
const ENGINE: &str = "crates/tracer-core/src/engine/mod.rs";
const DEVELOP: &str = "crates/tracer-core/src/develop/mod.rs";
const SRGB: &str = "crates/tracer-core/src/develop/srgb.rs";

const TREE: &str = "crates/kernels/src/bvh/mod.rs";
const COPLANAR: &str = "crates/kernels/src/bvh/coplanar/mod.rs";
const COPLANAR_FIND: &str = "crates/kernels/src/bvh/coplanar/find.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "coplanar-whoever-is-found-wins",
        file: TREE,
        find: "coplanar.settle(rays, active, hits);",
        replace: "let _ = coplanar;",
        caught_by: suite("bvh_coplanar", &[]),
    },
    Mutant {
        name: "coplanar-rays-end-in-the-plane",
        file: COPLANAR,
        find: "if before < ends[ray] { ends[ray] - before } else { 0.0 };",
        replace: "if before < ends[ray] { ends[ray] } else { 0.0 };",
        caught_by: suite("bvh_coplanar", &["rays_to_what_loses"]),
    },
    Mutant {
        name: "coplanar-losers-are-reached",
        file: TREE,
        find: "coplanar.cover(rays, active, occlusion);",
        replace: "",
        caught_by: suite("bvh_coplanar", &["rays_to_what_loses"]),
    },
    Mutant {
        name: "coplanar-lamps-lose",
        file: COPLANAR_FIND,
        find: "(self.rank, self.is_endless(), self.id())",
        replace: "(0, self.is_endless(), self.id())",
        caught_by: proofs(&["coplanar::"]),
    },
    Mutant {
        name: "coplanar-real-gaps-are-none",
        file: COPLANAR_FIND,
        find: "= (DVec3::ZERO, 2.0, corners, false);",
        replace: "= (DVec3::ZERO, 2000.0, corners, false);",
        caught_by: suite("bvh_coplanar", &["what_is_apart"]),
    },
    Mutant {
        name: "covered-lamps-shine",
        file: "crates/kernels/src/scene/glow.rs",
        find: "accel.is_some_and(|accel| shines && accel.is_covered(primitive, instance))",
        replace: "accel.is_some_and(|accel| !shines && accel.is_covered(primitive, instance))",
        caught_by: proofs(&["overlapping_lamps::"]),
    },
    Mutant {
        name: "lamps-end-in-wide-ceilings",
        file: "crates/kernels/src/engine/glow.rs",
        find: "light.keep_off(offset.into())",
        replace: "light.keep_off(0.0 * f64::from(offset))",
        caught_by: proofs(&["coplanar::a_lamp_let_into_the_ceiling"]),
    },
    Mutant {
        name: "small-lamps-in-their-own-way",
        file: "crates/kernels/src/engine/stages/lights/flat.rs",
        find: "const SHORT: f32 = 1.0 - 1.0 / 524_288.0;",
        replace: "const SHORT: f32 = 1.0;",
        caught_by: proofs(&["shining::a_lamp_at_the_origin"]),
    },
    Mutant {
        name: "touching-glass-as-if-alone",
        file: "crates/kernels/src/engine/stages/materials/mod.rs",
        find: "self.parameter / ior",
        replace: "self.parameter",
        caught_by: proofs(&["coplanar::glass_that_touches_glass"]),
    },
    Mutant {
        name: "one-bounce-too-many",
        file: PREPARED,
        find: "max_bounces: desc.render.max_bounces.value,",
        replace: "max_bounces: desc.render.max_bounces.value + 1,",
        caught_by: proofs(&["analytic::n_bounces_are_the_partial_sum_of_a_series"]),
    },
    Mutant {
        name: "photons-in-the-plain-path-tracer",
        file: PREPARED,
        find: "caustics: full && desc.render",
        replace: "caustics: desc.render",
        caught_by: proofs(&["same_bytes::integrators"]),
    },
    Mutant {
        name: "lens-radius-for-its-diameter",
        file: COMPILE_CAMERA,
        find: "frame.length(lens.aperture.value / 2.0)",
        replace: "frame.length(lens.aperture.value)",
        caught_by: proofs(&["analytic::the_blur_disc_is_that_of_a_thin_lens"]),
    },
    Mutant {
        name: "field-of-view-for-its-half",
        file: CAMERA_WORDS,
        find: "libm::tan(self.fov.value.to_radians() / 2.0);",
        replace: "libm::tan(self.fov.value.to_radians());",
        caught_by: proofs(&["surfaces::huge_spheres_have_no_rings"]),
    },
    Mutant {
        name: "width-taken-for-square",
        file: CAMERA_WORDS,
        find: "[half, half * width / height]",
        replace: "[half, half]",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "up-is-down",
        file: COMPILE_CAMERA,
        find: "let up = right.cross(forward);",
        replace: "let up = forward.cross(right);",
        caught_by: proofs(&["surfaces::huge_spheres_have_no_rings"]),
    },
    Mutant {
        name: "power-of-a-hemisphere",
        file: "crates/tracer-core/src/compile/radiances.rs",
        find: "x / (4.0 * std::f64::consts::PI * disc)",
        replace: "x / (2.0 * std::f64::consts::PI * disc)",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "intensity-over-the-sphere's-surface",
        file: "crates/tracer-core/src/compile/radiances.rs",
        find: "i.map(|x| x / disc)",
        replace: "i.map(|x| x / (4.0 * disc))",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "light-of-the-neighbour",
        file: SHAPED,
        find: "*index = k as u32;",
        replace: "*index = (k as u32).saturating_sub(1);",
        caught_by: proofs(&["figures::figure_6"]),
    },
    Mutant {
        name: "mirrored-mesh-keeps-its-winding",
        file: MESHES,
        find: "if mirrored { [a, c, b] } else { [a, b, c] }",
        replace: "if mirrored { [a, b, c] } else { [a, b, c] }",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "normals-moved-like-points",
        file: MESHES,
        find: "let inverse = map.matrix3.inverse().transpose();",
        replace: "let inverse = map.matrix3;",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "smooth-without-normals",
        file: MESHES,
        find: "Shading::Auto => !loaded.files[file].normals.is_empty(),",
        replace: "Shading::Auto => true,",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "copies-forget-their-own-material",
        file: MESHES,
        find: "built.add_copy(bvh::InstanceGeometry { mesh, placement }, whole, polygonal.number);",
        replace: "built.add_copy(bvh::InstanceGeometry { mesh, placement }, 0, polygonal.number);",
        caught_by: proofs(&["compiling", "random_scenes"]),
    },
    Mutant {
        name: "flattened-copies-lie-as-the-first",
        file: MESHES,
        find: "built.add_mesh(data, variant.smooth, &world, frame.scale, whole, own_materials)",
        replace: "built.add_mesh(data, variant.smooth, &placed.maps[object][0], frame.scale, whole, own_materials)",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "transforms-last-to-first",
        file: PLACING,
        find: "Ok(step) => map = step * map,",
        replace: "Ok(step) => map = map * step,",
        caught_by: units(&["compile::placing"]),
    },
    Mutant {
        name: "barycentre-left-behind",
        file: PLACING,
        find: "|middle| map.transform_point3(middle));",
        replace: "|middle| middle);",
        caught_by: units(&["compile::placing"]),
    },
    Mutant {
        name: "fixed-point-moves",
        file: PLACING,
        find: "translation: point - matrix * point",
        replace: "translation: matrix * point - point",
        caught_by: units(&["compile::placing"]),
    },
    Mutant {
        name: "dropped-by-too-much",
        file: PLACING,
        find: "y - (subject.reach)(&map, 1)[0]",
        replace: "y + (subject.reach)(&map, 1)[0]",
        caught_by: units(&["compile::placing"]),
    },
    Mutant {
        name: "light-tree-forgets-the-way",
        file: LIGHT,
        find: "trail | 1 << depth, depth + 1",
        replace: "trail, depth + 1",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
    Mutant {
        name: "curvature-is-the-radius",
        file: SPHERE,
        find: "let k = 1.0 / s.radius;",
        replace: "let k = s.radius;",
        caught_by: proofs(&["surfaces::huge_spheres_have_no_rings"]),
    },
    // Film and picture.
    Mutant {
        name: "film-z-order-transposed",
        file: FILM,
        find: "z_order(x % TILE, y % TILE)",
        replace: "z_order(y % TILE, x % TILE)",
        caught_by: proofs(&["figures::figure_6"]),
    },
    Mutant {
        name: "film-rounds-what-is-small-by-half",
        file: "crates/tracer-core/src/film/exact.rs",
        find: "f64::from(x) * PER_ONE + WHOLE - WHOLE",
        replace: "f64::from(x) * PER_ONE * 0.5",
        caught_by: units(&["film"]),
    },
    Mutant {
        name: "squares-without-their-carry",
        file: "crates/tracer-core/src/film/exact.rs",
        find: "carry = whole >> 64;",
        replace: "carry = 0 * (whole >> 64);",
        caught_by: units(&["film"]),
    },
    Mutant {
        name: "light-in-the-wrong-unit",
        file: FILM,
        find: "[r * self.unit, g * self.unit, b * self.unit]",
        replace: "[r, g, b]",
        caught_by: proofs(&["range::"]),
    },
    Mutant {
        name: "grid-that-moves-half-as-far",
        file: "crates/tracer-core/src/engine/grid.rs",
        find: "map(|x| (x * TILE as f32) as u8)",
        replace: "map(|x| (x * 8.0) as u8)",
        caught_by: units(&["grid"]),
    },
    Mutant {
        name: "blocks-whose-pixels-touch",
        file: "crates/kernels/src/sampling/blocks.rs",
        find: "+ 2 * steps as i32",
        replace: "+ steps as i32",
        caught_by: kernel_units(&["blocks", "grid"]),
    },
    Mutant {
        name: "blocks-cut-in-half-of-the-places",
        file: "crates/kernels/src/sampling/blocks.rs",
        find: ">> 61",
        replace: ">> 62",
        caught_by: kernel_units(&["blocks"]),
    },
    Mutant {
        name: "film-drops-negative-samples",
        file: FILM,
        find: "x.abs() <= LARGEST",
        replace: "(0.0..=LARGEST).contains(&x)",
        caught_by: units(&["film"]),
    },
    Mutant {
        name: "clamped-channel-by-channel",
        file: FILM,
        find: "(f64::from(sample[c]) * limit / f64::from(largest)) as f32",
        replace: "sample[c].min(limit as f32)",
        caught_by: proofs(&["clamp::a_lamp_in_view"]),
    },
    Mutant {
        name: "negative-samples-clamped",
        file: FILM,
        find: "if f64::from(largest) <= limit ||",
        replace: "if f64::from(largest.abs()) <= limit ||",
        caught_by: units(&["film"]),
    },
    Mutant {
        name: "rests-of-what-was-taken-lost",
        file: FILM,
        find: "fixed(sample[c]) - fixed(after)",
        replace: "fixed(sample[c] - after)",
        caught_by: units(&["film"]),
    },
    Mutant {
        name: "clamp-of-the-scene-not-heard",
        file: ENGINE,
        find: "options.clamp.or(scene.clamp)",
        replace: "options.clamp",
        caught_by: proofs(&["clamp::"]),
    },
    Mutant {
        name: "variance-of-a-sample-not-of-the-mean",
        file: NOISE,
        find: "((tile.squares.of(pixel) / n - mean * mean) / (n - 1.0)).max(0.0)",
        replace: "(tile.squares.of(pixel) / n - mean * mean).max(0.0)",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "exposure-sign",
        file: DEVELOP,
        find: "libm::exp2(look.exposure);\n    let backdrop",
        replace: "libm::exp2(-look.exposure);\n    let backdrop",
        caught_by: proofs(&["analytic::exposure_and_tone_maps"]),
    },
    Mutant {
        name: "srgb-as-a-pure-power",
        file: SRGB,
        find: "1.055 * libm::pow(linear, EXPONENT) - 0.055",
        replace: "libm::pow(linear, 1.0 / 2.2)",
        caught_by: units(&["develop"]),
    },
    Mutant {
        name: "srgb-estimate-taken-for-exact",
        file: SRGB,
        find: "const MARGIN: f64 = 1e-12;",
        replace: "const MARGIN: f64 = 0.0;",
        caught_by: units(&["develop"]),
    },
    // Tree.
    Mutant {
        name: "boxes-not-padded",
        file: "crates/kernels/src/bvh/ray_space.rs",
        find: "pub const PAD: f32 = 1.0 / 524_288.0;",
        replace: "pub const PAD: f32 = 0.0;",
        caught_by: suite("bvh_watertight", &["closed_meshes_do_not_leak"]),
    },
    Mutant {
        name: "triangle-edges-leak",
        file: "crates/kernels/src/bvh/triangle.rs",
        find: "let w = b[0] * a[1] - b[1] * a[0];",
        replace: "let w = b[0] * a[1] - b[1] * a[0] - 1e-6;",
        caught_by: suite("bvh_closest", &["coplanar_grid", "few_triangles", "soup"]),
    },
    Mutant {
        name: "boxes-of-a-corner-too-few",
        file: "crates/kernels/src/bvh/bounds.rs",
        find: "self.upper = self.upper.max(other.upper);",
        replace: "self.upper = self.upper.min(other.upper).max(self.lower);",
        caught_by: suite("bvh_closest", &["soup", "few_triangles"]),
    },
    Mutant {
        name: "parts-without-slack",
        file: "crates/kernels/src/bvh/triangle.rs",
        find: "pub const SLACK: f32 = 1.0 / 1_048_576.0;",
        replace: "pub const SLACK: f32 = 0.0;",
        caught_by: suite("bvh_closest", &["a_cut_takes_no_hit_away_and_adds_none"]),
    },
    Mutant {
        name: "parts-beside-their-boxes",
        file: "crates/kernels/src/bvh/kernels/leaves.rs",
        find: "let cut = isa.le4(lower[0], upper[0]);",
        replace: "let cut = 0;",
        caught_by: suite("bvh_closest", &["triangles_that_are_cut"]),
    },
    Mutant {
        name: "whole-triangles-as-parts",
        file: "crates/kernels/src/bvh/kernels/leaves.rs",
        find: "let cut = isa.le4(lower[0], upper[0]);",
        replace: "let cut = 15;",
        caught_by: suite("bvh_closest", &["triangles_beside_those_that_are_cut_are_tested_as_anywhere_else"]),
    },
    Mutant {
        name: "half-a-triangle-is-lost",
        file: "crates/kernels/src/bvh/build/parts.rs",
        find: "Some(halves) => halves.iter().for_each",
        replace: "Some(halves) => halves.iter().skip(1).for_each",
        caught_by: suite("bvh_closest", &["triangles_that_are_cut"]),
    },
    Mutant {
        name: "parts-without-padding",
        file: "crates/kernels/src/bvh/build/parts.rs",
        find: "let pad = Vec4::splat(padding(self.corners(triangle)));",
        replace: "let pad = Vec4::splat(0.0 * padding(self.corners(triangle)));",
        caught_by: suite("bvh_watertight", &["closed_meshes_of_triangles_that_are_cut_do_not_leak"]),
    },
    Mutant {
        name: "cuts-that-do-not-pay",
        file: "crates/kernels/src/bvh/build/parts.rs",
        find: "const PAYS: f64 = 0.1;",
        replace: "const PAYS: f64 = 0.0;",
        caught_by: suite("bvh_closest", &["only_long_triangles_aslant_are_cut"]),
    },
    Mutant {
        name: "cuts-without-end",
        file: "crates/kernels/src/bvh/build/parts.rs",
        find: "let least = least.max(total / most);",
        replace: "let least = least.min(total / most);",
        caught_by: suite("bvh_same_bits", &["triangles_are_cut_the_same_for_any_number_of_threads"]),
    },
];
