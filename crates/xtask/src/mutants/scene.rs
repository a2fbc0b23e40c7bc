//! Faults in compiling, the scene's tables, the tree, the film and developing.

use super::{Mutant, proofs, suite, units};

const COMPILE: &str = "crates/tracer-core/src/compile/mod.rs";
const MESHES: &str = "crates/tracer-core/src/compile/meshes.rs";
const PLACING: &str = "crates/tracer-core/src/compile/placing.rs";
const LIGHT: &str = "crates/tracer-core/src/scene/light.rs";
const SPHERE: &str = "crates/tracer-core/src/scene/sphere.rs";
const FILM: &str = "crates/tracer-core/src/film.rs";
const ENGINE: &str = "crates/tracer-core/src/engine/mod.rs";
const DEVELOP: &str = "crates/tracer-core/src/develop/mod.rs";
const SRGB: &str = "crates/tracer-core/src/develop/srgb.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "one-bounce-too-many",
        file: COMPILE,
        find: "max_bounces: desc.render.max_bounces.value,",
        replace: "max_bounces: desc.render.max_bounces.value + 1,",
        caught_by: proofs(&["analytic::n_bounces_are_the_partial_sum_of_a_series"]),
    },
    Mutant {
        name: "photons-in-the-plain-path-tracer",
        file: COMPILE,
        find: "caustics: full && desc.render",
        replace: "caustics: desc.render",
        caught_by: proofs(&["same_bytes::integrators"]),
    },
    Mutant {
        name: "lens-radius-for-its-diameter",
        file: COMPILE,
        find: "frame.length(l.aperture.value / 2.0)",
        replace: "frame.length(l.aperture.value)",
        caught_by: proofs(&["analytic::the_blur_disc_is_that_of_a_thin_lens"]),
    },
    Mutant {
        name: "field-of-view-for-its-half",
        file: COMPILE,
        find: "desc.camera.fov.value.to_radians() / 2.0;",
        replace: "desc.camera.fov.value.to_radians();",
        caught_by: proofs(&["surfaces::huge_spheres_have_no_rings"]),
    },
    Mutant {
        name: "width-taken-for-square",
        file: COMPILE,
        find: "half_height * f64::from(desc.image.width.value) / f64::from(desc.image.height.value)",
        replace: "half_height",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "up-is-down",
        file: COMPILE,
        find: "let up = right.cross(forward);",
        replace: "let up = forward.cross(right);",
        caught_by: proofs(&["surfaces::huge_spheres_have_no_rings"]),
    },
    Mutant {
        name: "power-of-a-hemisphere",
        file: COMPILE,
        find: "x / (4.0 * std::f64::consts::PI * disc)",
        replace: "x / (2.0 * std::f64::consts::PI * disc)",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "intensity-over-the-sphere's-surface",
        file: COMPILE,
        find: "i.map(|x| x / disc)",
        replace: "i.map(|x| x / (4.0 * disc))",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "light-of-the-neighbour",
        file: COMPILE,
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
        find: "material: whole,\n            placement: Some(",
        replace: "material: 0,\n            placement: Some(",
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
        find: "map = step * map;",
        replace: "map = map * step;",
        caught_by: units(&["compile::placing"]),
    },
    Mutant {
        name: "barycentre-left-behind",
        file: PLACING,
        find: "|| map.transform_point3(barycentre)",
        replace: "|| barycentre",
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
        find: "y - lowest(&map)",
        replace: "y + lowest(&map)",
        caught_by: units(&["compile::placing"]),
    },
    Mutant {
        name: "light-tree-forgets-the-way",
        file: LIGHT,
        find: "trail | 1 << depth, depth + 1",
        replace: "trail, depth + 1",
        caught_by: units(&["engine::stages::lights"]),
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
        name: "film-sums-as-they-come",
        file: FILM,
        find: "coarse_sums[pixel] += coarse;",
        replace: "coarse_sums[pixel] += f64::from(*x) - fine;",
        caught_by: units(&["film"]),
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
        find: "(f64::from(sample[c]) * f64::from(limit) / f64::from(largest)) as f32",
        replace: "sample[c].min(limit)",
        caught_by: proofs(&["clamp::a_lamp_in_view"]),
    },
    Mutant {
        name: "negative-samples-clamped",
        file: FILM,
        find: "if largest <= limit ||",
        replace: "if largest.abs() <= limit ||",
        caught_by: units(&["film"]),
    },
    Mutant {
        name: "rests-of-what-was-taken-lost",
        file: FILM,
        find: "taken.sums.fine[c][pixel] += before.1 - left.1;",
        replace: "taken.sums.fine[c][pixel] += 0.0 * (before.1 - left.1);",
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
        file: FILM,
        find: "((tile.squares[pixel] / n - mean * mean) / (n - 1.0)).max(0.0)",
        replace: "(tile.squares[pixel] / n - mean * mean).max(0.0)",
        caught_by: proofs(&["compiling"]),
    },
    Mutant {
        name: "exposure-sign",
        file: DEVELOP,
        find: "libm::exp2(look.exposure)",
        replace: "libm::exp2(-look.exposure)",
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
        file: "crates/tracer-core/src/bvh/ray_space.rs",
        find: "pub(crate) const PAD: f32 = 1.0 / 524_288.0;",
        replace: "pub(crate) const PAD: f32 = 0.0;",
        caught_by: suite("bvh_watertight", &["closed_meshes_do_not_leak"]),
    },
    Mutant {
        name: "triangle-edges-leak",
        file: "crates/tracer-core/src/bvh/triangle.rs",
        find: "let w = b[0] * a[1] - b[1] * a[0];",
        replace: "let w = b[0] * a[1] - b[1] * a[0] - 1e-6;",
        caught_by: suite("bvh_closest", &["coplanar_grid", "few_triangles", "soup"]),
    },
    Mutant {
        name: "boxes-of-a-corner-too-few",
        file: "crates/tracer-core/src/bvh/bounds.rs",
        find: "self.upper = self.upper.max(other.upper);",
        replace: "self.upper = self.upper.min(other.upper).max(self.lower);",
        caught_by: suite("bvh_closest", &["soup", "few_triangles"]),
    },
];
