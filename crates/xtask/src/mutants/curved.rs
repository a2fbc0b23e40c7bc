//! Faults in curved shapes and planes.

use super::{Mutant, kernel_units, proofs, suite};

const CONE: &str = "crates/kernels/src/shapes/cone.rs";
const TORUS: &str = "crates/kernels/src/shapes/torus.rs";
const CSG: &str = "crates/kernels/src/shapes/csg.rs";
const PLANES: &str = "crates/kernels/src/engine/stages/planes.rs";
const LAMP: &str = "crates/kernels/src/shapes/lamp/mod.rs";

/// The faults.
pub const MUTANTS: &[Mutant] = &[
    Mutant {
        name: "cones-are-double",
        file: CONE,
        find: "Some(if widens { after(first.max(second)) } else { before(first.min(second)) })",
        replace: "Some(if widens { after(first.min(second)) } else { before(first.max(second)) })",
        caught_by: suite("shapes", &[]),
    },
    Mutant {
        name: "rays-come-back-to-the-cap-that-they-leave",
        file: CONE,
        find: "&& z * ray.d.z >= 0.0",
        replace: "&& z * ray.d.z >= 1e9",
        caught_by: suite("shapes", &[]),
    },
    Mutant {
        name: "capsules-are-met-on-their-balls-only",
        file: "crates/kernels/src/shapes/capsule.rs",
        find: "let parts = [side, ball_at(-half), ball_at(half)];",
        replace: "let parts = [None, ball_at(-half), ball_at(half)];",
        caught_by: suite("shapes", &[]),
    },
    Mutant {
        name: "tori-are-met-where-rays-leave-them",
        file: TORUS,
        find: "let mut inside = start.unwrap_or(false);",
        replace: "let mut inside = false;",
        caught_by: suite("shapes", &["rays_that_leave_a_torus"]),
    },
    Mutant {
        name: "tori-have-one-way-in",
        file: TORUS,
        find: "([root(2.0 * PI / 3.0), root(-2.0 * PI / 3.0), root(0.0)], 3)",
        replace: "([root(2.0 * PI / 3.0), root(-2.0 * PI / 3.0), root(0.0)], 1)",
        caught_by: suite("shapes", &[]),
    },
    Mutant {
        name: "glowing-tori-are-told-of-one-front",
        file: "crates/kernels/src/shapes/lamp/ring.rs",
        find: "within.intervals().iter().map(",
        replace: "within.intervals().iter().take(1).map(",
        caught_by: kernel_units(&["shapes::lamp"]),
    },
    Mutant {
        name: "rings-do-not-hide-themselves",
        file: "crates/kernels/src/shapes/mod.rs",
        find: "UnitShape::TORUS | UnitShape::SOLID => false,",
        replace: "UnitShape::TORUS | UnitShape::SOLID => true,",
        caught_by: proofs(&["solids::nothing_shines"]),
    },
    Mutant {
        name: "samples-of-an-operand-take-what-they-meet",
        file: "crates/kernels/src/shapes/lamp/solid.rs",
        find: "operand == self.number && (two_sided",
        replace: "operand < u32::MAX && (two_sided",
        caught_by: proofs(&["shining_solids::shining_solids_as"]),
    },
    Mutant {
        name: "solids-do-not-light-themselves",
        file: "crates/kernels/src/engine/stages/lights/curved.rs",
        find: "on[lane] == light.primitive)",
        replace: "on[lane] == light.primitive + 1)",
        caught_by: proofs(&["shining_solids::shining_solids_as"]),
    },
    Mutant {
        name: "disks-have-no-hole",
        file: "crates/kernels/src/shapes/disk.rs",
        find: "at.dot(at) >= inner * inner",
        replace: "at.dot(at) >= -inner * inner",
        caught_by: proofs(&["curved::curved_shapes"]),
    },
    Mutant {
        name: "normals-of-curved-shapes-go-by-the-map",
        file: "crates/kernels/src/shapes/mod.rs",
        find: "(map.transpose() * on.n).normalize()",
        replace: "(map.inverse() * on.n).normalize()",
        caught_by: proofs(&["curved::curved_shapes"]),
    },
    Mutant {
        name: "curved-glass-has-no-side",
        file: "crates/kernels/src/engine/stages/shapes.rs",
        find: "u32::from(on.n.dot(direction) < 0.0) << lane",
        replace: "1 << lane",
        caught_by: proofs(&["curved::curved_shapes"]),
    },
    Mutant {
        name: "shapes-in-the-tree-are-nowhere-left",
        file: "crates/kernels/src/bvh/kernels/leaves.rs",
        find: "leaf.row.hit_among(parts, origin, direction, leaf.ids[0] == from)",
        replace: "leaf.row.hit_among(parts, origin, direction, leaf.ids[1] == from)",
        caught_by: suite("shapes", &["the_tree"]),
    },
    Mutant {
        name: "rays-start-on-one-of-two-faces",
        file: CSG,
        find: "cosine.abs() >= ALONG",
        replace: "cosine.abs() >= 2.0",
        caught_by: suite("solids", &["there_are_no_inner_walls"]),
    },
    Mutant {
        name: "cuts-face-the-wrong-way",
        file: CSG,
        find: "outward: if sides[0] { -self.normal[k] } else { self.normal[k] }, sign })",
        replace: "outward: self.normal[k], sign })",
        caught_by: suite("solids", &["hits_are_the_first"]),
    },
    Mutant {
        name: "rays-meet-the-plane-that-they-leave",
        file: PLANES,
        find: "& (from[k] != id);",
        replace: "& (from[k] != id + 1000.0);",
        caught_by: proofs(&["planes::it_reaches"]),
    },
    Mutant {
        name: "pixels-share-through-planes",
        file: PLANES,
        find: "let mut beyond = sides[usize::from(height < 0.0)];",
        replace: "let mut beyond = sides[usize::from(height < 0.0)] & 0;",
        caught_by: proofs(&["planes::sharing"]),
    },
    Mutant {
        name: "planes-throw-no-shadow",
        file: PLANES,
        find: "t < f64::from(shadows.t_max[i]) && other",
        replace: "t < f64::from(-shadows.t_max[i]) && other",
        caught_by: proofs(&["planes::planes_as"]),
    },
    Mutant {
        name: "planes-hide-lamps-in-them",
        file: PLANES,
        find: "primitive != NONE && met.accel",
        replace: "primitive == NONE && met.accel",
        caught_by: proofs(&["planes::a_lamp"]),
    },
    Mutant {
        name: "squeezed-lamps-keep-their-densities",
        file: LAMP,
        find: "let inverse_pdf = self.growth * length * length * length / density;",
        replace: "let inverse_pdf = self.growth / (density + 0.0 * length);",
        caught_by: kernel_units(&["shapes::lamp"]),
    },
    Mutant {
        name: "open-lamps-show-through-themselves",
        file: LAMP,
        find: "if hidden || !(density",
        replace: "if hidden && density > 1e9 || !(density",
        caught_by: kernel_units(&["shapes::lamp"]),
    },
    Mutant {
        name: "light-starts-uniform-in-the-lamps-own-space",
        file: LAMP,
        find: "own * area::growth(&self.map, n) / area",
        replace: "own * area::growth(&self.map, n).signum() / area",
        caught_by: kernel_units(&["shapes::lamp"]),
    },
    Mutant {
        name: "closed-lamps-shine-inwards",
        file: LAMP,
        find: "if self.two_sided { 1.0 } else { 0.0 }",
        replace: "1.0",
        caught_by: proofs(&["shining_curved::within"]),
    },
    Mutant {
        name: "lamps-in-shapes-are-sampled-past-their-holes",
        file: "crates/kernels/src/shapes/lamp/flat.rs",
        find: "from = self.hole[1];",
        replace: "from = self.hole[0];",
        caught_by: kernel_units(&["shapes::lamp"]),
    },
];
