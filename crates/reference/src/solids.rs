//! Shapes that are made of several: a line is cut where it crosses any surface of any of them, and between two cuts one
//! point says whether the line is inside. The engine combines intervals instead, and knows no points.

use crate::Ray;
use crate::shapes::{self, NEAREST};
use crate::surface::Surface;
use glam::DVec3;
use tracer_core::scene::{NONE, Shape, Solids, Step};
use tracer_core::shapes::csg::Operation;
use tracer_core::shapes::{Solid, UnitShape};

/// Cuts that are nearer to each other are one: rounding, where surfaces coincide.
const ONE_CUT: f64 = 1e-10;

/// The operands as shapes of their own.
fn operands<'a>(solids: &'a Solids, solid: &Solid) -> impl Iterator<Item = (u32, Shape)> + use<'a> {
    let [first, count] = solid.operands;
    (first..first + count).map(|k| {
        let operand = solids.operands[k as usize];
        (
            k,
            Shape {
                unit: operand.unit,
                placement: operand.placement,
                material: operand.material,
                light: NONE,
                object: 0,
                copy: 0,
                is_plain: false,
                coordinates: operand.coordinates,
            },
        )
    })
}

/// Whether a point of object space is in a shape: by what it is.
fn contains(unit: &UnitShape, q: DVec3) -> bool {
    match *unit {
        UnitShape::Sphere => q.length() < 1.0,
        UnitShape::Cube => q.abs().max_element() < 0.5,
        UnitShape::Cone { radii: [a, b], .. } => {
            q.z.abs() < 1.0 && q.truncate().length() < a + (b - a) * (q.z + 1.0) / 2.0
        }
        UnitShape::Capsule { half } => q.distance(DVec3::new(0.0, 0.0, q.z.clamp(-half, half))) < 1.0,
        UnitShape::Torus { tube } => q.z.hypot(q.truncate().length() - 1.0) < tube,
        UnitShape::Plane => q.z < 0.0,
        UnitShape::Disk { .. } | UnitShape::Solid(_) => false,
    }
}

/// Of each operand, whether a point is in it.
fn inside_of(operands: &[(u32, Shape)], p: DVec3) -> Vec<bool> {
    let within = |(_, shape): &(u32, Shape)| contains(&shape.unit, shape.placement.inverse().transform_point3(p));
    operands.iter().map(within).collect()
}

/// What the steps make of it.
fn whole(solids: &Solids, solid: &Solid, inside: &[bool]) -> bool {
    let [first, count] = solid.steps.map(|n| n as usize);
    let mut stack = Vec::new();
    for step in &solids.steps[first..first + count] {
        match *step {
            Step::Operand(k) => stack.push(inside[(k - solid.operands[0]) as usize]),
            Step::Operation(operation) => {
                let (b, a) = (stack.pop().expect("two"), stack.pop().expect("two"));
                stack.push(match operation {
                    Operation::Union => a || b,
                    Operation::Intersection => a && b,
                    Operation::Difference => a && !b,
                });
            }
        }
    }
    stack.pop().expect("one")
}

/// Where the line is cut, in order.
fn cuts(ray: &Ray, operands: &[(u32, Shape)]) -> Vec<f64> {
    let mut cuts: Vec<f64> = operands.iter().flat_map(|(_, shape)| shapes::crossings(ray, shape)).collect();
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|b, a| *b - *a < ONE_CUT);
    cuts
}

/// What is on both sides of a cut, operand by operand.
fn both_sides(ray: &Ray, operands: &[(u32, Shape)], cuts: &[f64], k: usize) -> [Vec<bool>; 2] {
    let before = if k == 0 { cuts[0] - 1.0 } else { 0.5 * (cuts[k - 1] + cuts[k]) };
    let after = cuts.get(k + 1).map_or(cuts[k] + 1.0, |next| 0.5 * (next + cuts[k]));
    [before, after].map(|t| inside_of(operands, ray.origin + t * ray.direction))
}

/// The nearest hit ahead.
pub fn meet(ray: &Ray, solids: &Solids, solid: &Solid) -> Option<f64> {
    let operands: Vec<_> = operands(solids, solid).collect();
    let cuts = cuts(ray, &operands);
    let border = |k: usize| {
        let [before, after] = both_sides(ray, &operands, &cuts, k);
        whole(solids, solid, &before) != whole(solids, solid, &after)
    };
    (0..cuts.len()).find(|&k| cuts[k] > NEAREST && border(k)).map(|k| cuts[k])
}

/// The surface at a hit at `t`: of the first operand that is entered or left there and makes a difference. Bodies of
/// operands are numbered from `first_body`.
pub fn surface(ray: &Ray, t: f64, solids: &Solids, solid: &Solid, first_body: u32) -> Surface {
    let operands: Vec<_> = operands(solids, solid).collect();
    let cuts = cuts(ray, &operands);
    let k = (0..cuts.len()).min_by(|&a, &b| (cuts[a] - t).abs().total_cmp(&(cuts[b] - t).abs())).expect("a cut");
    let sides = both_sides(ray, &operands, &cuts, k);
    let differs = |j: usize| {
        let changes = |side: &Vec<bool>| {
            let mut other = side.clone();
            other[j] = !other[j];
            whole(solids, solid, side) != whole(solids, solid, &other)
        };
        sides[0][j] != sides[1][j] && sides.iter().any(changes)
    };
    let owner = (0..operands.len()).find(|&j| differs(j)).expect("an operand");
    let (number, shape) = &operands[owner];
    let mut surface = shapes::surface(first_body + number, shape, ray.origin + t * ray.direction, ray.direction);
    surface.outside = !whole(solids, solid, &sides[0]);
    surface
}
