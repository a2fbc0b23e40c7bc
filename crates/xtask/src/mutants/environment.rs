//! Faults in pictures of all directions, and in spheres that shine around all there is.

use super::{Mutant, kernel_units, proofs};

const LIGHT: &str = "crates/kernels/src/engine/stages/lights/environment.rs";
const PICTURE: &str = "crates/kernels/src/scene/environment.rs";
const SELECTION: &str = "crates/kernels/src/engine/stages/lights/selection.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "environment-turned-the-other-way",
        file: PICTURE,
        find: "[right * cos + front * sin, up, front * cos - right * sin]",
        replace: "[right * cos - front * sin, up, front * cos + right * sin]",
        caught_by: proofs(&["environment::directions_see_their_texels"]),
    },
    Mutant {
        name: "environment-half-a-texel-off",
        file: LIGHT,
        find: "(x * c(width as f32) + c(0.5), y * c(height as f32) + c(0.5))",
        replace: "(x * c(width as f32) + c(1.0), y * c(height as f32) + c(0.5))",
        caught_by: proofs(&["environment::directions_see_their_texels"]),
    },
    Mutant {
        name: "environment-rows-alike",
        file: PICTURE,
        find: "total += sum * f64::from(heights[j as usize] - heights[j as usize + 1]);",
        replace: "total += sum;",
        caught_by: kernel_units(&["environment"]),
    },
    Mutant {
        name: "environment-whose-neighbours-are-not-sampled",
        file: PICTURE,
        find: "(k * size / of) as i64 - 1..=(((k + 1) * size).div_ceil(of)) as i64",
        replace: "(k * size / of) as i64..=(((k + 1) * size).div_ceil(of)) as i64 - 1",
        caught_by: kernel_units(&["environment"]),
    },
    Mutant {
        name: "environment-chosen-more-often-than-reckoned",
        file: SELECTION,
        find: "environment = u.lt(F::splat(ENVIRONMENT));",
        replace: "environment = u.lt(F::splat(0.75));",
        caught_by: proofs(&["environment::skies_as_the_reference_sees_them"]),
    },
    Mutant {
        name: "environment-counts-twice",
        file: "crates/kernels/src/engine/stages/shade/emission.rs",
        find: "light = ray.throughput.mul(sky.radiance).scale(shown * weight);",
        replace: "light = ray.throughput.mul(sky.radiance).scale(shown * (weight * F::splat(0.5) + F::splat(0.5)));",
        caught_by: proofs(&["environment::a_picture_of_one_colour_is_a_background_of_that_colour"]),
    },
    Mutant {
        name: "sky-weighed-as-if-it-were-asked",
        file: "crates/kernels/src/engine/stages/lights/mod.rs",
        find: "near = F::select(is_sky, F::splat(0.0), near);",
        replace: "",
        caught_by: proofs(&["sky::a_sky_of_one_colour_is_a_background"]),
    },
    Mutant {
        name: "sky-not-met-behind-the-last-vertex",
        file: "crates/kernels/src/engine/stages/shade.rs",
        find: "open: scene.is_under_sky(),",
        replace: "open: scene.is_open(),",
        caught_by: proofs(&["sky::a_sky_of_one_colour_is_a_background"]),
    },
    Mutant {
        name: "a-lamp-around-all-takes-the-photons",
        file: "crates/kernels/src/engine/guide/plan.rs",
        find: "distance.max(radius).max(caster.radius)",
        replace: "distance.max(caster.radius)",
        caught_by: proofs(&["sky::a_lamp_around_all_leaves_photons_to_the_others"]),
    },
    Mutant {
        name: "lamps-within-a-lamp-are-starved",
        file: SELECTION,
        find: "to.dot(to).max(F::select(is_sphere, r2, zero))",
        replace: "to.dot(to)",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
];
