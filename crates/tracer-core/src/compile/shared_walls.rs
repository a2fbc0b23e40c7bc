//! Bodies that share a wall: water that is as wide as the glass is within, a shining band about a pillar. Where flat
//! sides touch, the tree says who is seen, and light passes from one glass into the other ([`tracer_kernels::bvh`]); so
//! it is with flat walls of solids, which are moved a little ([`super::csg`]). Round walls are two, which rays meet
//! in an order that rounding decides: some miss one of them, and are bent too often or too little, or a lamp lights
//! that nobody sees.

use super::csg::{SolidObject, WallOf as Operand};
use super::curved::Curved;
use glam::{DAffine3, DMat4, DVec3, DVec4};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::BTreeSet;
use tracer_kernels::scene::Material;
use tracer_kernels::scene::materials::BxdfFlags;
use tracer_kernels::shapes::UnitShape;

/// With more bodies than this none are compared, or none but those of glass: each is with each.
const MOST: usize = 512;
/// Surfaces whose equations, in the size of the one, differ by no more are one to rays of single precision.
const ALIKE: f64 = 1e-5;

/// What light does at a body.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Glass,
    Lamp,
    Opaque,
}

/// A shape, or one that a solid is made of.
#[derive(Clone)]
struct Body {
    /// Its object.
    number: u32,
    unit: UnitShape,
    map: DAffine3,
    /// Where it is, or what is left of it in its solid.
    bounds: [DVec3; 2],
    of_solid: bool,
    kind: Kind,
    material: u32,
}

/// Warns of the first two that share a wall, and says how many more there are.
pub fn warn(
    desc: &SceneDesc,
    (curved, solids): (&[Curved], &[SolidObject]),
    materials: &[Material],
    diagnostics: &mut Diagnostics,
) {
    let mut bodies = bodies((curved, solids), materials, false);
    if bodies.len() > MOST {
        bodies = self::bodies((curved, solids), materials, true);
    }
    if bodies.len() > MOST {
        return;
    }
    let mut of_glass = false;
    let mut sharing: BTreeSet<[u32; 2]> = BTreeSet::new();
    for (k, one) in bodies.iter().enumerate() {
        for other in &bodies[k + 1..] {
            if one.number != other.number && one.may_differ(other, materials) && one.shares_a_wall(other) {
                of_glass |= sharing.is_empty() && one.kind == Kind::Glass && other.kind == Kind::Glass;
                sharing.insert([one.number.min(other.number), one.number.max(other.number)]);
            }
        }
    }
    let Some(&[first, second]) = sharing.first() else { return };
    let span = desc.objects.get(second as usize).map_or(Span::NONE, |object| object.span);
    let more = match sharing.len() - 1 {
        0 => String::new(),
        more => format!(", as {more} more pairs do"),
    };
    let (what, hint) = match of_glass {
        true => (
            "are bodies of glass that share a wall",
            "make the inner one larger by a hundredth, so that it reaches into the other: water into its glass",
        ),
        false => ("share a wall: which of the two is seen rounding decides", "make one of them larger by a hundredth"),
    };
    diagnostics.push(
        Diagnostic::warning(codes::SHARED_WALL, span, format!("objects[{first}] and objects[{second}] {what}{more}"))
            .expected("bodies that reach a little into each other, or do not touch")
            .hint(hint),
    );
}

fn bodies((curved, solids): (&[Curved], &[SolidObject]), materials: &[Material], glass_only: bool) -> Vec<Body> {
    let kind = |index: u32, shines: bool| {
        let transmits = materials.get(index as usize).is_some_and(|m| m.traits().flags.has(BxdfFlags::TRANSMISSION));
        let kind = if shines { Kind::Lamp } else { Kind::Opaque };
        if transmits { Kind::Glass } else { kind }
    };
    let counts = |kind: Kind| !glass_only || kind == Kind::Glass;
    let mut bodies = Vec::new();
    for object in curved.iter().filter(|object| !object.unit.is_endless()) {
        let kind = kind(object.material, object.emissive.is_some());
        if !counts(kind) {
            continue;
        }
        let body = |map: &DAffine3| Body {
            number: object.number,
            unit: object.unit,
            map: *map,
            bounds: object.unit.bounds(map),
            of_solid: false,
            kind,
            material: object.material,
        };
        bodies.extend(object.maps.iter().take(MOST + 1).map(body));
        // There may be millions.
        if bodies.len() > MOST {
            return bodies;
        }
    }
    for solid in solids {
        for map in solid.maps().iter().take(MOST + 1) {
            let whole = solid.bounds(map);
            let operands = solid.walls(map).map(|wall| (kind(wall.material, wall.shines), wall));
            bodies.extend(operands.filter(|(kind, _)| counts(*kind)).map(|(kind, wall)| {
                let Operand { unit, map, material, .. } = wall;
                let [low, high] = unit.bounds(&map);
                let bounds = [low.max(whole[0]), high.min(whole[1])];
                Body { number: solid.number(), unit, map, bounds, of_solid: true, kind, material }
            }));
            if bodies.len() > MOST {
                return bodies;
            }
        }
    }
    bodies
}

impl Body {
    /// Whether it shows which of the two is seen.
    fn may_differ(&self, other: &Body, materials: &[Material]) -> bool {
        let of = |body: &Body| materials.get(body.material as usize);
        self.kind != Kind::Opaque || other.kind != Kind::Opaque || of(self) != of(other)
    }

    /// Whether they have a round wall in common.
    fn shares_a_wall(&self, other: &Body) -> bool {
        let both = self.bounds[1].min(other.bounds[1]) - self.bounds[0].max(other.bounds[0]);
        let touching = 1e-9 * (self.bounds[1] - self.bounds[0]).max_element();
        // What touches at an edge or a flat side has no round wall in common.
        if both.min_element() <= touching {
            return false;
        }
        // Of what is the same one is left out, which is told.
        if !self.of_solid && !other.of_solid && self.unit == other.unit && self.map == other.map {
            return false;
        }
        let whole = other.map.inverse() * self.map;
        let there = DMat4::from(whole);
        let is_there = |(one, patch): &(DMat4, Patch)| {
            let mut others = surfaces(&other.unit).into_iter();
            others.any(|(another, its)| is_one(*one, there.transpose() * another * there) && patch.meets(&its, &whole))
        };
        surfaces(&self.unit).iter().any(is_there)
    }
}

/// Which part of a round surface a shape has, in the space of the shape.
#[derive(Clone, Copy, Debug)]
enum Patch {
    Whole,
    /// Between two heights.
    Between([f64; 2]),
    /// Half a ball, on this side along z.
    Half(f64),
}

/// Pieces of one pipe that reach into each other by a smaller share of the shorter one meet end to end, but for the
/// digits that their ends were written with.
const END_TO_END: f64 = 1e-3;

impl Patch {
    /// Whether it and a part of the same surface have more in common than a ring; `there`: to the space of the other's
    /// shape.
    fn meets(&self, other: &Patch, there: &DAffine3) -> bool {
        match (*self, *other) {
            (Patch::Between([low, high]), Patch::Between([its_low, its_high])) => {
                let [a, b] = [low, high].map(|z| there.transform_point3(DVec3::new(0.0, 0.0, z)).z);
                let both = a.max(b).min(its_high) - a.min(b).max(its_low);
                both > END_TO_END * (a - b).abs().min(its_high - its_low)
            }
            (Patch::Half(side), Patch::Half(its)) => {
                let out = there.transform_vector3(DVec3::new(0.0, 0.0, side));
                out.normalize_or_zero().z * its > END_TO_END - 1.0
            }
            _ => true,
        }
    }
}

/// Whether two equations are one, but for a factor.
fn is_one(one: DMat4, other: DMat4) -> bool {
    let size = |m: &DMat4| m.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
    let (one, other) = (one * (1.0 / size(&one)), other * (1.0 / size(&other)));
    // NaN, where a map has no inverse, is nothing.
    size(&(one - other)) <= ALIKE || size(&(one + other)) <= ALIKE
}

/// Its round surfaces as x^T Q x = 0 in the space of the shape, and what it has of each.
fn surfaces(unit: &UnitShape) -> Vec<(DMat4, Patch)> {
    let ball = |z: f64| DMat4 {
        x_axis: DVec4::X,
        y_axis: DVec4::Y,
        z_axis: DVec4::new(0.0, 0.0, 1.0, -z),
        w_axis: DVec4::new(0.0, 0.0, -z, z * z - 1.0),
    };
    // x^2 + y^2 = (middle + slope z)^2
    let cone = |middle: f64, slope: f64| DMat4 {
        x_axis: DVec4::X,
        y_axis: DVec4::Y,
        z_axis: DVec4::new(0.0, 0.0, -slope * slope, -slope * middle),
        w_axis: DVec4::new(0.0, 0.0, -slope * middle, -middle * middle),
    };
    match *unit {
        UnitShape::Sphere => vec![(ball(0.0), Patch::Whole)],
        UnitShape::Cone { radii: [low, high], .. } => {
            vec![(cone(0.5 * (low + high), 0.5 * (high - low)), Patch::Between([-1.0, 1.0]))]
        }
        UnitShape::Capsule { half } => vec![
            (cone(1.0, 0.0), Patch::Between([-half, half])),
            (ball(-half), Patch::Half(-1.0)),
            (ball(half), Patch::Half(1.0)),
        ],
        UnitShape::Cube | UnitShape::Disk { .. } | UnitShape::Torus { .. } | UnitShape::Plane | UnitShape::Solid(_) => {
            Vec::new()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DQuat};

    fn body(unit: UnitShape, size: DVec3, at: DVec3) -> Body {
        let map = DAffine3 { matrix3: DMat3::from_diagonal(size), translation: at };
        Body { number: 0, unit, map, bounds: unit.bounds(&map), of_solid: false, kind: Kind::Glass, material: 0 }
    }

    fn can(radius: f64, [low, high]: [f64; 2]) -> Body {
        let unit = UnitShape::Cone { radii: [1.0, 1.0], caps: true, upright: true };
        let half = 0.5 * (high - low);
        body(unit, DVec3::new(radius, radius, half), DVec3::new(3.0, 2.0, 0.5 * (low + high)))
    }

    #[test]
    fn walls_that_are_one_are_found() {
        let hole = can(0.4, [0.1, 1.1]);
        assert!(hole.shares_a_wall(&can(0.4, [0.1, 0.7])) && can(0.4, [0.2, 0.7]).shares_a_wall(&hole));
        assert!(!hole.shares_a_wall(&can(0.404, [0.05, 0.7])));
        // One above the other.
        assert!(!hole.shares_a_wall(&can(0.4, [1.1, 2.0])));
        let ball = |radius: f64| body(UnitShape::Sphere, DVec3::splat(radius), DVec3::ONE);
        let of_solid = Body { of_solid: true, ..ball(0.5) };
        assert!(ball(0.5).shares_a_wall(&of_solid) && !ball(0.51).shares_a_wall(&of_solid));
        assert!(!ball(0.5).shares_a_wall(&ball(0.5)), "one of them is left out");
        let capsule = body(UnitShape::Capsule { half: 1.0 }, DVec3::splat(0.4), DVec3::new(3.0, 2.0, 0.5));
        assert!(capsule.shares_a_wall(&hole));
    }

    /// Two halves of a bond, in the colours of their atoms, whose ends were written to four digits; capsules meet in a
    /// ring there. Askew, so that the boxes around them reach into each other.
    #[test]
    fn what_meets_end_to_end_shares_no_wall() {
        let along = |unit: UnitShape, from: DVec3, to: DVec3, half: f64| {
            let turn = DQuat::from_rotation_arc(DVec3::Z, (to - from).normalize());
            let scale = DVec3::new(0.1, 0.1, 0.5 * (to - from).length() / half);
            let map = DAffine3::from_scale_rotation_translation(scale, turn, 0.5 * (from + to));
            Body { unit, map, bounds: unit.bounds(&map), ..can(1.0, [0.0, 1.0]) }
        };
        let (from, to) = (DVec3::new(-0.3068, -1.6836, -0.7169), DVec3::new(-1.3752, -1.0212, -0.0571));
        let middle = 0.5 * (from + to);
        let cone = UnitShape::Cone { radii: [1.0, 1.0], caps: true, upright: true };
        let over = |share: f64| middle + share * (to - middle);
        assert!(!along(cone, from, over(1e-4), 1.0).shares_a_wall(&along(cone, to, middle, 1.0)));
        assert!(along(cone, from, over(0.1), 1.0).shares_a_wall(&along(cone, to, middle, 1.0)));
        let half = 0.25 * (to - from).length() / 0.1;
        let capsule = |from: DVec3, to: DVec3| along(UnitShape::Capsule { half }, from, to, half);
        assert!(!capsule(from, middle).shares_a_wall(&capsule(to, middle)));
        assert!(!capsule(from, middle).shares_a_wall(&capsule(middle, to)));
        // At an angle there are lunes of one ball on both.
        assert!(capsule(from, middle).shares_a_wall(&capsule(middle, middle + DVec3::X * (to - middle).length())));
    }
}
