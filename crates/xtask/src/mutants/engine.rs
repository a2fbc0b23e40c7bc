//! Faults in the engine: scattering, surfaces, lights, camera.

use super::{Mutant, kernel_units, proofs};

const TRIANGLES: &str = "crates/kernels/src/engine/stages/triangles.rs";
const MIS: &str = "crates/kernels/src/engine/stages/shade/mis.rs";
const LIGHT_SAMPLE: &str = "crates/kernels/src/engine/stages/shade/light_sample.rs";
const EMISSION: &str = "crates/kernels/src/engine/stages/shade/emission.rs";
const BSDF: &str = "crates/kernels/src/engine/stages/materials/mod.rs";
const BLINN_PHONG: &str = "crates/kernels/src/engine/stages/materials/blinn_phong.rs";
const CONDUCTOR: &str = "crates/kernels/src/engine/stages/materials/conductor.rs";
const SEEN_NORMAL: &str = "crates/kernels/src/engine/stages/materials/seen.rs";
const DIELECTRIC: &str = "crates/kernels/src/engine/stages/materials/dielectric.rs";
const SURFACE_AT: &str = "crates/kernels/src/engine/stages/surface_at.rs";
const LIGHTS: &str = "crates/kernels/src/engine/stages/lights/mod.rs";
const LIGHT: &str = "crates/kernels/src/scene/light.rs";
const LIGHT_SELECTION: &str = "crates/kernels/src/engine/stages/lights/selection.rs";
const SPHERE_LIGHT: &str = "crates/kernels/src/engine/stages/lights/sphere.rs";
const FLAT_LIGHT: &str = "crates/kernels/src/engine/stages/lights/flat.rs";
const CAMERA: &str = "crates/kernels/src/engine/stages/camera.rs";
const PERSPECTIVE: &str = "crates/kernels/src/engine/stages/cameras/perspective.rs";
const SHADE: &str = "crates/kernels/src/engine/stages/shade.rs";
const SHARE: &str = "crates/kernels/src/engine/stages/share.rs";
const SPHERES: &str = "crates/kernels/src/engine/stages/spheres.rs";
const FAN: &str = "crates/kernels/src/engine/stages/fan.rs";
const REUSE: &str = "crates/tracer-core/src/engine/techniques/reuse.rs";
const TEXTURES: &str = "crates/kernels/src/engine/stages/textures.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    // Scattering.
    Mutant {
        name: "cosine-twice",
        file: LIGHT_SAMPLE,
        find: "scale(cos_i * l.inverse_pdf",
        replace: "scale(cos_i * cos_i * l.inverse_pdf",
        caught_by: proofs(&["analytic::a_sphere_light_above_and_partly_below_the_horizon"]),
    },
    Mutant {
        name: "glossy-cosine-twice",
        file: BSDF,
        find: "cos_i / F::select(usable, density, c(1.0))",
        replace: "cos_i * cos_i / F::select(usable, density, c(1.0))",
        caught_by: kernel_units(&["engine::stages::materials"]),
    },
    Mutant {
        name: "half-vectors-behind-the-viewer",
        file: BSDF,
        find: "let usable = counted & c(0.0).lt(cos_i)",
        replace: "let usable = c(0.0).lt(cos_i)",
        caught_by: kernel_units(&["engine::stages::materials"]),
    },
    Mutant {
        name: "raised-starts-bury-what-sinks",
        file: "crates/kernels/src/engine/stages/surface.rs",
        find: "self.smooth & wi.dot(self.ng).le(F::splat(0.0)) & !self.raised()",
        replace: "self.smooth & wi.dot(self.ng).le(F::splat(0.0))",
        caught_by: proofs(&["surfaces::the_terminator_of_a_low_poly_ball_is_smooth"]),
    },
    Mutant {
        name: "panoramas-see-above-the-circle-of-the-eyes",
        file: "crates/kernels/src/engine/stages/cameras/stereo.rs",
        find: "zero.lt(s2));",
        replace: "zero.lt(square));",
        caught_by: kernel_units(&["engine::stages::cameras"]),
    },
    Mutant {
        name: "glossy-pdf-without-jacobian",
        file: BLINN_PHONG,
        find: "(f, lobe * ((alpha + c(1.0)) * c(0.125 * FRAC_1_PI)) / wo_h)",
        replace: "(f, lobe * ((alpha + c(1.0)) * c(0.5 * FRAC_1_PI)))",
        caught_by: kernel_units(&["engine::stages::materials"]),
    },
    Mutant {
        name: "glossy-norm-alpha-plus-one",
        file: BLINN_PHONG,
        find: "(alpha + c(2.0)) * c(0.5 * FRAC_1_PI)",
        replace: "(alpha + c(1.0)) * c(0.5 * FRAC_1_PI)",
        caught_by: kernel_units(&["engine::stages::materials"]),
    },
    Mutant {
        name: "diffuse-share-not-lessened-by-glossy",
        file: BSDF,
        find: "(c(1.0) - self.share) * lobes.lambert, lobes.lambert)",
        replace: "lobes.lambert, lobes.lambert)",
        caught_by: kernel_units(&["engine::stages::materials"]),
    },
    Mutant {
        name: "fresnel-wrong-side",
        file: DIELECTRIC,
        find: "F::select(s.outside, one / ior, ior)",
        replace: "F::select(s.outside, ior, one / ior)",
        caught_by: kernel_units(&["engine::stages::materials"]),
    },
    Mutant {
        name: "fresnel-cosines-swapped",
        file: DIELECTRIC,
        find: "let (a, b) = (eta * cos_i, eta * cos_t);",
        replace: "let (a, b) = (eta * cos_t, eta * cos_i);",
        caught_by: kernel_units(&["engine::stages::materials"]),
    },
    Mutant {
        name: "fresnel-one-polarisation",
        file: DIELECTRIC,
        find: "rs.fma(rs, rp * rp) * F::splat(0.5)",
        replace: "rp.fma(rp, rp * rp) * F::splat(0.5)",
        caught_by: kernel_units(&["engine::stages::materials"]),
    },
    Mutant {
        name: "metal-without-masking",
        file: CONDUCTOR,
        find: "d * c(0.5) / cos_o.fma(root_i, cos_i * root_o)",
        replace: "d * c(0.25) / (cos_o * cos_i)",
        caught_by: kernel_units(&["engine::stages::materials::conductor"]),
    },
    Mutant {
        name: "gloss-by-the-cosine-to-another-normal",
        file: SEEN_NORMAL,
        find: "cos_i / by_callers.max(F::splat(1e-20))",
        replace: "one",
        caught_by: kernel_units(&["engine::stages::materials"]),
    },
    Mutant {
        name: "gloss-black-from-behind-its-normal",
        file: SEEN_NORMAL,
        find: "c(LEAST_COSINE) - ns.dot(wo)",
        replace: "c(-LEAST_COSINE - 2.0) - ns.dot(wo)",
        caught_by: kernel_units(&["engine::stages::materials"]),
    },
    Mutant {
        name: "metal-several-reflections-sampled-evenly",
        file: CONDUCTOR,
        find: "let aim = number * self.at(",
        replace: "let aim = number * number * self.at(",
        caught_by: kernel_units(&["engine::stages::materials::conductor"]),
    },
    Mutant {
        name: "metal-sampled-by-all-normals",
        file: CONDUCTOR,
        find: "let height = one - u * (one + stretched.2);",
        replace: "let height = one - u;",
        caught_by: kernel_units(&["engine::stages::materials::conductor"]),
    },
    Mutant {
        name: "metal-several-reflections-without-the-light's-side",
        file: CONDUCTOR,
        find: "several.scale(loss_o * loss_i * self.scale)",
        replace: "several.scale(loss_o * self.scale)",
        caught_by: kernel_units(&["engine::stages::materials::conductor"]),
    },
    Mutant {
        name: "metal-fresnel-one-polarisation",
        file: CONDUCTOR,
        find: "c(0.5) * rs * (one + (t3 - t4) / (t3 + t4))",
        replace: "rs",
        caught_by: kernel_units(&["engine::stages::materials::conductor"]),
    },
    Mutant {
        name: "radiance-not-scaled-in-glass",
        file: DIELECTRIC,
        find: "reflectance, eta2: eta * eta }",
        replace: "reflectance, eta2: one }",
        caught_by: proofs(&["analytic::a_light_within_glass"]),
    },
    Mutant {
        name: "radiance-scaled-the-wrong-way",
        file: DIELECTRIC,
        find: "reflectance, eta2: eta * eta }",
        replace: "reflectance, eta2: one / (eta * eta) }",
        caught_by: proofs(&["analytic::a_light_within_glass"]),
    },
    Mutant {
        name: "roulette-without-one-over-q",
        file: SHADE,
        find: "onward.carried = onward.carried.scale(one / F::select(zero.lt(survival), survival, one));",
        replace: "onward.carried = onward.carried.scale(one);",
        caught_by: proofs(&["analytic::a_lambertian_furnace_is_one_over_one_minus_albedo"]),
    },
    Mutant {
        name: "mis-by-the-balance-heuristic-one-sided",
        file: MIS,
        find: "F::splat(1.0) / ratio.fma(ratio, F::splat(1.0))",
        replace: "F::splat(1.0) / ratio.fma(ratio, F::splat(0.5))",
        caught_by: kernel_units(&["engine::stages::shade"]),
    },
    // What pixels share.
    Mutant {
        name: "shared-by-half-and-reckoned-with-all",
        file: SHARE,
        find: "batch.groups.hidden[j] = segments.blocked | !users;",
        replace: "batch.groups.hidden[j] = segments.blocked;",
        caught_by: proofs(&["reuse::"]),
    },
    Mutant {
        name: "sharing-through-spheres",
        file: SHARE,
        find: "let hidden = faces & !own & blocked(",
        replace: "let hidden = !faces & !own & blocked(",
        caught_by: proofs(&["reuse::"]),
    },
    Mutant {
        name: "sharing-without-the-second-cosine",
        file: SHARE,
        find: "(cos_member * inverse) * (cos_suffix * inverse)",
        replace: "(cos_member * inverse) * inverse",
        caught_by: proofs(&["reuse::"]),
    },
    Mutant {
        name: "sharing-through-walls",
        file: REUSE,
        find: "u64::from(occluded) << (tag & 63)",
        replace: "u64::from(occluded & 0) << (tag & 63)",
        caught_by: proofs(&["reuse::"]),
    },
    Mutant {
        name: "sharing-forgets-roulette",
        file: SHARE,
        find: "density * survival",
        replace: "density",
        caught_by: proofs(&["shared_roulette"]),
    },
    // Surfaces.
    Mutant {
        name: "sphere-normal-flipped",
        file: SURFACE_AT,
        find: "V3::select(outside, outward, outward.neg())",
        replace: "V3::select(outside, outward.neg(), outward)",
        caught_by: proofs(&["analytic::a_diffuse_ball_in_a_white_furnace", "figures::figure_6"]),
    },
    Mutant {
        name: "smooth-normal-flipped",
        file: TRIANGLES,
        find: "let facing = V3::select(turned, unit.neg(), unit);",
        replace: "let facing = V3::select(turned, unit, unit.neg());",
        caught_by: proofs(&["figures::figure_5"]),
    },
    Mutant {
        name: "barycentrics-swapped",
        file: TRIANGLES,
        find: "[b0 * rescale, b1 * rescale, b2 * rescale]",
        replace: "[b0 * rescale, b2 * rescale, b1 * rescale]",
        caught_by: proofs(&["textures", "seams"]),
    },
    Mutant {
        name: "instance-normal-by-the-matrix",
        file: TRIANGLES,
        find: "V3(b.cross(c).dot(n), c.cross(a).dot(n), a.cross(b).dot(n))",
        replace: "V3(a.dot(n), b.dot(n), c.dot(n))",
        caught_by: proofs(&["random_scenes"]),
    },
    Mutant {
        name: "mirrored-instance-inside-out",
        file: TRIANGLES,
        find: "mirrored = self.transformed & self.placement.determinant().lt(F::splat(0.0));",
        replace: "mirrored = self.transformed & self.placement.determinant().lt(F::splat(-f32::INFINITY));",
        caught_by: proofs(&["random_scenes"]),
    },
    Mutant {
        name: "shading-starts-on-the-triangle",
        file: TRIANGLES,
        find: "smooth.start = V3::select(lanes, moved, p);",
        replace: "smooth.start = V3::select(lanes, p, p);",
        caught_by: proofs(&["surfaces::the_terminator_of_a_low_poly_ball_is_smooth"]),
    },
    Mutant {
        name: "no-offset-from-meshes",
        file: TRIANGLES,
        find: "let start = ng.mad(offset, start);",
        replace: "let start = ng.mad(zero, start);",
        caught_by: proofs(&["seams", "figures::figure_2", "analytic::n_bounces"]),
    },
    Mutant {
        name: "longitude-half-a-turn-off",
        file: SURFACE_AT,
        find: "(turns + c(0.5), acos",
        replace: "(turns, acos",
        caught_by: proofs(&["random_scenes", "textures"]),
    },
    Mutant {
        name: "small-spheres-only-from-outside",
        file: SPHERES,
        find: "let candidate = F::select(zero.lt(first), first, second);",
        replace: "let candidate = first;",
        caught_by: proofs(&["surfaces::the_camera_on_and_within_surfaces", "figures::figure_4"]),
    },
    Mutant {
        name: "spheres-beyond-the-light-shade",
        file: SPHERES,
        find: "let dips = beta.lt(zero) & (-beta).lt(kt) & zero.lt(disc);",
        replace: "let dips = beta.lt(zero) & zero.lt(disc);",
        caught_by: proofs(&["figures::figure_6"]),
    },
    Mutant {
        name: "sphere-meets-itself",
        file: SPHERES,
        find: "(beta, F::select(own, c(0.0), gamma))",
        replace: "(beta, gamma)",
        caught_by: proofs(&["surfaces::huge_spheres_have_no_rings", "figures::figure_6"]),
    },
    Mutant {
        name: "small-sphere-meets-itself",
        file: SPHERES,
        find: "F::select(own, middle * middle, disc)",
        replace: "disc",
        caught_by: kernel_units(&["engine::stages::spheres"]),
    },
    Mutant {
        name: "small-spheres-let-out-what-leaves-them-inwards",
        file: SPHERES,
        find: "(middle * middle).lt(disc) | (own & inwards)",
        replace: "(middle * middle).lt(disc)",
        caught_by: kernel_units(&["engine::stages::spheres"]),
    },
    // Lights.
    Mutant {
        name: "light-sample-without-the-choice-of-light",
        file: LIGHTS,
        find: "sample.inverse_pdf = sample.inverse_pdf / choice.probability;",
        replace: "",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
    Mutant {
        name: "mis-without-the-choice-of-light",
        file: LIGHTS,
        find: "selection::probability(lights, k, at) / inverse",
        replace: "F::splat(1.0) / inverse",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
    Mutant {
        name: "dim-lamps-are-never-asked",
        file: LIGHT_SELECTION,
        find: "F::select(zero.lt(a) & zero.lt(b), bounded, first)",
        replace: "F::select(zero.lt(a) & zero.lt(a), first, bounded)",
        caught_by: proofs(&["range::dim_lamps_are_asked_beside_bright_ones"]),
    },
    Mutant {
        name: "cone-as-a-disc",
        file: SPHERE_LIGHT,
        find: "F::select(inside, F::splat(2.0), sin2 / (one + cos))",
        replace: "F::select(inside, F::splat(2.0), sin2 / (one + one))",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
    Mutant {
        name: "far-side-of-a-light-from-within",
        file: SPHERE_LIGHT,
        find: "F::select(inside, along + half_chord, along - half_chord)",
        replace: "along - half_chord",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
    Mutant {
        name: "light-tree-takes-the-other-child",
        file: LIGHT_SELECTION,
        find: "let second = step.first.le(u);",
        replace: "let second = u.lt(step.first);",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
    Mutant {
        name: "light-tree-loses-lights-on-the-horizon",
        file: LIGHT_SELECTION,
        find: "(middle + r).max(zero)",
        replace: "(middle - r).max(zero)",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
    Mutant {
        name: "lights-met-as-if-from-the-other-side",
        file: EMISSION,
        find: "Receiver { p: ray.origin, n: normal }",
        replace: "Receiver { p: ray.origin, n: normal.neg() }",
        caught_by: proofs(&["analytic::several_lamps"]),
    },
    // Flat lights.
    Mutant {
        name: "flat-lights-without-their-cosine",
        file: FLAT_LIGHT,
        find: "row.area * wi.dot(row.normal).abs() / d2",
        replace: "row.area / d2",
        caught_by: kernel_units(&["engine::stages::lights::flat"]),
    },
    Mutant {
        name: "triangles-that-shine-as-parallelograms",
        file: FLAT_LIGHT,
        find: "self.has(LightTable::TRIANGLE) & one.lt(u + v)",
        replace: "self.has(LightTable::TRIANGLE) & one.lt(u - v)",
        caught_by: kernel_units(&["engine::stages::lights::flat"]),
    },
    Mutant {
        name: "backs-that-shine",
        file: FLAT_LIGHT,
        find: "V3::select(outside | row.has(LightTable::TWO_SIDED), row.radiance, V3::zero())",
        replace: "row.radiance",
        caught_by: kernel_units(&["engine::stages::lights::flat"]),
    },
    Mutant {
        name: "rays-that-end-on-the-light",
        file: FLAT_LIGHT,
        find: "F::select(front, row.offset, -row.offset)",
        replace: "F::select(front, -row.offset, row.offset)",
        caught_by: proofs(&["shining"]),
    },
    Mutant {
        name: "light-tree-asks-backs",
        file: LIGHT_SELECTION,
        find: "(cos + self.around).max(F::splat(0.0))",
        replace: "(cos.abs() + self.around)",
        caught_by: kernel_units(&["engine::stages::lights::flat"]),
    },
    Mutant {
        name: "fan-without-margins",
        file: FAN,
        find: "const MARGIN: f32 = 1.0 / 131_072.0;",
        replace: "const MARGIN: f32 = 0.0;",
        caught_by: kernel_units(&["engine::stages::fan"]),
    },
    Mutant {
        name: "fan-beside-one-edge",
        file: FAN,
        find: "let beside = zero.lt(most) & least.lt(zero);",
        replace: "let beside = zero.lt(most);",
        caught_by: kernel_units(&["engine::stages::fan"]),
    },
    Mutant {
        name: "fan-always-from-above",
        file: FAN,
        find: "let sign = F::select(above, c(1.0), c(-1.0));",
        replace: "let sign = c(1.0);",
        caught_by: kernel_units(&["engine::stages::fan"]),
    },
    Mutant {
        name: "fan-without-the-slack-of-t",
        file: FAN,
        find: "let slack = reach * F::load(&table.slack[base..]);",
        replace: "let slack = reach;",
        caught_by: kernel_units(&["engine::stages::fan"]),
    },
    Mutant {
        name: "fan-hides-by-the-own-triangle",
        file: FAN,
        find: "doubt = doubt | !(beside | before | from.eq(F::U::splat(id)));",
        replace: "doubt = doubt | !(beside | before | from.eq(F::U::splat(u32::MAX - 1)));",
        caught_by: kernel_units(&["engine::stages::fan"]),
    },
    Mutant {
        name: "light-clusters-without-size",
        file: LIGHT,
        find: "slack: radius * scale",
        replace: "slack: 0.0",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
    Mutant {
        name: "light-clusters-of-one-normal",
        file: LIGHT,
        find: "around: sin * scale + Self::LEAST",
        replace: "around: Self::LEAST",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
    Mutant {
        name: "light-clusters-face-everywhere",
        file: LIGHT,
        find: "if cos <= 0.0 {",
        replace: "if cos <= 1.0 {",
        caught_by: kernel_units(&["engine::stages::lights"]),
    },
    // Camera and filters.
    Mutant {
        name: "picture-upside-down",
        file: CAMERA,
        find: "c(-1.0 / middle[1])",
        replace: "c(1.0 / middle[1])",
        caught_by: proofs(&["figures::figure_6"]),
    },
    Mutant {
        name: "box-filter-off-centre",
        file: CAMERA,
        find: "Filter::Box => (u - c(0.5), v - c(0.5)),",
        replace: "Filter::Box => (u, v),",
        caught_by: proofs(&["analytic::the_other_filters_have_their_step_responses"]),
    },
    Mutant {
        name: "gaussian-sigma-as-a-variance",
        file: CAMERA,
        find: "* c(sigma as f32);",
        replace: "* c(sigma as f32).sqrt();",
        caught_by: proofs(&["analytic::a_gaussian_filter_has_its_step_response"]),
    },
    Mutant {
        name: "lens-moved-the-wrong-way",
        file: PERSPECTIVE,
        find: "None => direction.scale(focus).sub(offset),",
        replace: "None => direction.scale(focus).add(offset),",
        caught_by: proofs(&["analytic::the_blur_disc_is_that_of_a_thin_lens", "figures::figure_7"]),
    },
    // Textures.
    Mutant {
        name: "texture-v-flipped",
        file: TEXTURES,
        find: "let (x, y) = (u, c(1.0) - v);",
        replace: "let (x, y) = (u, v);",
        caught_by: proofs(&["figures::figure_1"]),
    },
    Mutant {
        name: "texels-shifted-by-a-half",
        file: TEXTURES,
        find: "F::select(nearest, c(0.0), c(0.5))",
        replace: "F::select(nearest, c(0.5), c(0.0))",
        caught_by: proofs(&["textures", "figures::figure_1"]),
    },
    Mutant {
        name: "mirror-wrap-as-a-saw",
        file: TEXTURES,
        find: "F::select(c(1.0).lt(wave), c(2.0) - wave, wave)",
        replace: "F::select(c(1.0).lt(wave), wave - c(1.0), wave)",
        caught_by: proofs(&["textures"]),
    },
    Mutant {
        name: "repeat-clamped-at-its-seam",
        file: TEXTURES,
        find: "F::U::select(before, F::U::select(clamp_edge, F::U::splat(0), last), first - one)",
        replace: "F::U::select(before, F::U::splat(0), first - one)",
        caught_by: proofs(&["textures"]),
    },
    Mutant {
        name: "cameras-see-what-is-hidden-from-them",
        file: "crates/kernels/src/scene/met.rs",
        find: "Some(seen) if camera =>",
        replace: "Some(seen) if camera && seen.hidden.is_empty() =>",
        caught_by: proofs(&["hidden::first_hits"]),
    },
    Mutant {
        name: "light-paths-show-what-is-hidden",
        file: "crates/tracer-core/src/engine/techniques/light_paths.rs",
        find: "arrives(k) && !is_hidden(k)",
        replace: "arrives(k)",
        caught_by: proofs(&["hidden::light_paths"]),
    },
];
