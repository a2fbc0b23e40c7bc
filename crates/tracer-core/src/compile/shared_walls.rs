//! Bodies that let light through and share a wall: water that is as wide as the glass is within. Where flat sides of
//! bodies by themselves touch, light passes from one into the other ([`tracer_kernels::bvh`]); round walls, and those
//! of solids, are two, which rays meet in an order that rounding decides: some miss one of them, and are bent too often
//! or too little.

use super::csg::SolidObject;
use super::curved::Curved;
use super::placed::Placed;
use super::polygonal::{self, Geometry, polygonal};
use super::unmeant::material_of;
use glam::{DAffine3, DMat4, DVec3, DVec4};
use scene_format::desc::Material as Written;
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::{BTreeMap, BTreeSet};
use tracer_kernels::scene::Material;
use tracer_kernels::scene::materials::BxdfFlags;
use tracer_kernels::shapes::UnitShape;

/// With more bodies of glass than this none are compared: each is with each.
const MOST: usize = 512;
/// Surfaces whose equations, in the size of the one, differ by no more are one to rays of single precision.
const ALIKE: f64 = 1e-5;

/// A shape of glass, or one that a solid of glass is made of.
struct Body {
    /// Its object.
    number: u32,
    unit: UnitShape,
    map: DAffine3,
    /// Where it is, or what is left of it in its solid.
    bounds: [DVec3; 2],
    of_solid: bool,
}

/// Warns of the first two that share a wall, and says how many more there are.
pub fn warn(
    desc: &SceneDesc,
    placed: &Placed,
    (curved, solids): (&[Curved], &[SolidObject]),
    materials: &[Material],
    diagnostics: &mut Diagnostics,
) {
    let bodies = bodies(desc, placed, (curved, solids), materials);
    if bodies.len() > MOST {
        return;
    }
    let mut sharing: BTreeSet<[u32; 2]> = BTreeSet::new();
    for (k, one) in bodies.iter().enumerate() {
        for other in &bodies[k + 1..] {
            if one.number != other.number && one.shares_a_wall(other) {
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
    diagnostics.push(
        Diagnostic::warning(
            codes::SHARED_WALL,
            span,
            format!("objects[{first}] and objects[{second}] are bodies of glass that share a wall{more}"),
        )
        .expected("bodies of glass that reach a little into each other, or do not touch")
        .hint("make the inner one larger by a hundredth, so that it reaches into the other: water into its glass"),
    );
}

fn bodies(
    desc: &SceneDesc,
    placed: &Placed,
    (curved, solids): (&[Curved], &[SolidObject]),
    materials: &[Material],
) -> Vec<Body> {
    let is_glass =
        |index: u32| materials.get(index as usize).is_some_and(|m| m.traits().flags.has(BxdfFlags::TRANSMISSION));
    let mut bodies = Vec::new();
    let glass = curved.iter().filter(|object| is_glass(object.material) && !object.unit.is_endless());
    for object in glass {
        let body = |map: &DAffine3| Body {
            number: object.number,
            unit: object.unit,
            map: *map,
            bounds: object.unit.bounds(map),
            of_solid: false,
        };
        bodies.extend(object.maps.iter().take(MOST + 1).map(body));
        // There may be millions.
        if bodies.len() > MOST {
            return bodies;
        }
    }
    let written: BTreeMap<&str, &Written> =
        desc.materials.iter().map(|named| (&*named.name.value, &named.material)).collect();
    for (k, object) in polygonal(desc).enumerate() {
        let is_box = matches!(object.geometry, Geometry::Unit(polygonal::UnitShape::Cube));
        if !is_box || !material_of(&written, object.material).is_some_and(Written::transmits) {
            continue;
        }
        let (number, unit) = (object.number, UnitShape::Cube);
        let body = |map: &DAffine3| Body { number, unit, map: *map, bounds: unit.bounds(map), of_solid: false };
        bodies.extend(placed.maps_of(k).iter().take(MOST + 1).map(body));
        if bodies.len() > MOST {
            return bodies;
        }
    }
    for solid in solids {
        for map in solid.maps().iter().take(MOST + 1) {
            let whole = solid.bounds(map);
            let operands = solid.walls(map).filter(|(_, _, material)| is_glass(*material));
            bodies.extend(operands.map(|(unit, map, _)| {
                let [low, high] = unit.bounds(&map);
                let bounds = [low.max(whole[0]), high.min(whole[1])];
                Body { number: solid.number(), unit, map, bounds, of_solid: true }
            }));
            if bodies.len() > MOST {
                return bodies;
            }
        }
    }
    bodies
}

impl Body {
    fn shares_a_wall(&self, other: &Body) -> bool {
        let both = self.bounds[1].min(other.bounds[1]) - self.bounds[0].max(other.bounds[0]);
        let touching = 1e-9 * (self.bounds[1] - self.bounds[0]).max_element();
        if both.min_element() < -touching {
            return false;
        }
        let flat_counts = self.of_solid || other.of_solid;
        // What touches at an edge or a flat side has no round wall in common.
        let round_counts = both.min_element() > touching;
        let there = DMat4::from(other.map.inverse() * self.map);
        surfaces(&self.unit).iter().any(|one| {
            surfaces(&other.unit).iter().any(|another| {
                let counts = if one.flat { flat_counts } else { round_counts };
                one.flat == another.flat && counts && is_one(one.equation, there.transpose() * another.equation * there)
            })
        })
    }
}

/// A surface as x^T Q x = 0 in the space of its shape.
struct Surface {
    equation: DMat4,
    /// A plane: its four numbers times themselves.
    flat: bool,
}

/// Whether two equations are one, but for a factor.
fn is_one(one: DMat4, other: DMat4) -> bool {
    let size = |m: &DMat4| m.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
    let (one, other) = (one * (1.0 / size(&one)), other * (1.0 / size(&other)));
    // NaN, where a map has no inverse, is nothing.
    size(&(one - other)) <= ALIKE || size(&(one + other)) <= ALIKE
}

fn surfaces(unit: &UnitShape) -> Vec<Surface> {
    let round = |equation: DMat4| Surface { equation, flat: false };
    let plane = |normal: DVec3, height: f64| {
        let numbers = normal.extend(-height);
        let equation =
            DMat4::from_cols(numbers * numbers.x, numbers * numbers.y, numbers * numbers.z, numbers * numbers.w);
        Surface { equation, flat: true }
    };
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
        UnitShape::Sphere => vec![round(ball(0.0))],
        UnitShape::Cone { radii: [low, high], .. } => {
            let wall = round(cone(0.5 * (low + high), 0.5 * (high - low)));
            vec![wall, plane(DVec3::Z, -1.0), plane(DVec3::Z, 1.0)]
        }
        UnitShape::Capsule { half } => vec![round(cone(1.0, 0.0)), round(ball(-half)), round(ball(half))],
        UnitShape::Cube => DVec3::AXES.iter().flat_map(|&axis| [plane(axis, -0.5), plane(axis, 0.5)]).collect(),
        UnitShape::Disk { .. } | UnitShape::Torus { .. } | UnitShape::Plane | UnitShape::Solid(_) => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;

    fn body(unit: UnitShape, size: DVec3, at: DVec3) -> Body {
        let map = DAffine3 { matrix3: DMat3::from_diagonal(size), translation: at };
        Body { number: 0, unit, map, bounds: unit.bounds(&map), of_solid: false }
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
        // One above the other; their flat sides count where one is of a solid.
        let above = can(0.4, [1.1, 2.0]);
        assert!(!hole.shares_a_wall(&above));
        assert!(Body { of_solid: true, ..above }.shares_a_wall(&hole));
        let ball = |radius: f64| body(UnitShape::Sphere, DVec3::splat(radius), DVec3::ONE);
        assert!(ball(0.5).shares_a_wall(&ball(0.5)) && !ball(0.5).shares_a_wall(&ball(0.51)));
        let cube = |size: f64, of_solid: bool| Body { of_solid, ..body(UnitShape::Cube, DVec3::splat(size), DVec3::Y) };
        assert!(cube(2.0, true).shares_a_wall(&cube(2.0, false)) && !cube(2.0, false).shares_a_wall(&cube(2.0, false)));
        let capsule = body(UnitShape::Capsule { half: 1.0 }, DVec3::splat(0.4), DVec3::new(3.0, 2.0, 0.5));
        assert!(capsule.shares_a_wall(&hole));
    }
}
