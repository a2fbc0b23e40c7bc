//! Flat walls of solids that lie in one plane with flat faces of other objects: a glass that stands on a table.
//!
//! Of triangles, disks and planes in one place the tree says who is seen ([`tracer_kernels::bvh`]); what the walls of a
//! solid leave of a plane only its own parts know. So such walls are moved a little, by [`PART`] of their distance:
//! where the two bodies touch, into the other one, so that nothing gets between them; where both face the same way, as
//! a lamp or a rug on a wall does, back behind the other, which is seen then.

use super::{DAffine3, DVec3, Node, OperandWritten, PartWritten, SolidObject, Surface, surfaces};
use crate::compile::curved::Curved;
use crate::compile::meshes::Loaded;
use crate::compile::placed::Placed;
use scene_format::SceneDesc;
use tracer_kernels::shapes::UnitShape;
use tracer_kernels::shapes::csg::Operation;

/// How far a wall is moved, in parts of the size of its solid and the distance to the camera: sixteen times what single
/// precision has for the way.
const PART: f64 = 1.0 / 65_536.0;
/// Walls are in one plane with faces that are no further than this, in the same parts.
const NEAR: f64 = 1e-6;
/// No more pairs of a wall and a face than this are looked at, nor more faces: a tenth of a second, and 40 MB. Those
/// beyond are left out.
const MOST_PAIRS: usize = 20_000_000;
const MOST_FACES: usize = 400_000;
/// Of an object that has more triangles than this, its copies' counted, none is looked at.
const MOST_TRIANGLES: usize = 4_000_000;

/// A flat face of another object, in the world.
struct Face {
    point: DVec3,
    /// Outwards; of what has no inside to where it faces.
    normal: DVec3,
    bounds: [DVec3; 2],
}

/// Which walls of a solid's copies are moved.
#[derive(Clone, Default)]
pub(super) struct Moved(Vec<(u32, u32, DVec3)>);

impl Moved {
    /// By how much a part of a copy is, in the world.
    pub(super) fn of(&self, copy: u32, part: usize) -> DVec3 {
        let found = self.0.binary_search_by_key(&(copy, part as u32), |(copy, part, _)| (*copy, *part));
        found.map_or(DVec3::ZERO, |at| self.0[at].2)
    }

    /// No wall of a copy is moved further than this along any axis.
    pub(super) fn most(&self, copy: u32) -> DVec3 {
        let first = self.0.partition_point(|(other, ..)| *other < copy);
        let own = self.0[first..].iter().take_while(|(other, ..)| *other == copy);
        own.fold(DVec3::ZERO, |most, (.., by)| most.max(by.abs()))
    }
}

impl SolidObject {
    /// An operand of a copy as its moved walls make it: its shape, and from its object space to the world. `map`: that
    /// of the copy.
    pub(super) fn moved_operand(&self, copy: u32, number: usize, map: &DAffine3) -> (UnitShape, DAffine3) {
        let operand = &self.operands[number];
        let map = *map * operand.moved * operand.local;
        let own = self.parts.iter().enumerate().filter(|(_, part)| part.operand == number);
        let mut further = [DVec3::ZERO; 2];
        for ((part, _), (_, wall)) in own.zip(surfaces(&operand.unit)) {
            let by = self.moved.of(copy, part);
            if by != DVec3::ZERO {
                // Along an axis, by as much as brings the wall to the plane that is moved along its normal.
                let out = wall.matrix3.z_axis;
                let along = by.length_squared() / (map.matrix3 * out).dot(by);
                further[usize::from(out.element_sum() > 0.0)] += along * out.abs();
            }
        }
        if further == [DVec3::ZERO; 2] { (operand.unit, map) } else { with_ends(&operand.unit, &map, further) }
    }
}

/// A shape whose flat ends on the negative and on the positive side of the axes lie that much further out.
fn with_ends(unit: &UnitShape, map: &DAffine3, [low, high]: [DVec3; 2]) -> (UnitShape, DAffine3) {
    let half = match unit {
        UnitShape::Cube => 0.5,
        UnitShape::Cone { .. } => 1.0,
        // A plane has one end. Others have no flat ones.
        _ => return (*unit, *map * DAffine3::from_translation(high)),
    };
    let middle = 0.5 * (high - low);
    // A slab that is thinner than it is moved has nothing in it.
    let mut scale = (DVec3::ONE + (low + high) / (2.0 * half)).max(DVec3::splat(f64::EPSILON));
    let mut unit = *unit;
    if let UnitShape::Cone { radii, .. } = &mut unit {
        let [a, b] = *radii;
        let ends = [middle.z - scale.z, middle.z + scale.z].map(|z| (a + 0.5 * (b - a) * (z + 1.0)).max(0.0));
        let most = ends[0].max(ends[1]);
        (*radii, scale) = (ends.map(|r| r / most), DVec3::new(most, most, scale.z));
    }
    (unit, *map * DAffine3::from_translation(middle) * DAffine3::from_scale(scale))
}

/// Finds the walls that are moved.
pub fn part(desc: &SceneDesc, loaded: &Loaded, placed: &Placed, curved: &[Curved], solids: &mut [SolidObject]) {
    let walls: usize = solids.iter().map(|solid| solid.maps.len() * solid.parts.len()).sum();
    if walls == 0 {
        return;
    }
    let copies = solids.iter().flat_map(|solid| solid.maps.iter().map(|map| solid.bounds(map)));
    let [low, high] = copies
        .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], [least, most]| [low.min(least), high.max(most)]);
    let margin = 1e-3 * (high - low).max_element();
    let mut faces =
        faces((loaded, placed, curved), [low - margin, high + margin], (MOST_PAIRS / walls).min(MOST_FACES));
    let eye = DVec3::from(desc.camera.position.value);
    // Of two solids the later one is moved.
    for solid in solids {
        let mut moved = Vec::new();
        for (copy, map) in (0..).zip(&solid.maps) {
            let own = solid.walls_of(map);
            for wall in &own {
                let size = wall.face.bounds[0].distance(wall.face.bounds[1]);
                let size = if size.is_finite() { size } else { 0.0 };
                let unit = size + (wall.face.point - eye).length();
                if let Some(by) = wall.face.moves(&faces, unit) {
                    moved.extend(wall.parts.iter().map(|part| (copy, *part, by)));
                }
            }
            if (faces.len() + own.len()).saturating_mul(walls) <= MOST_PAIRS {
                faces.extend(own.into_iter().map(|wall| wall.face));
            }
        }
        moved.sort_unstable_by_key(|(copy, part, _)| (*copy, *part));
        solid.moved = Moved(moved);
    }
}

/// A plane of a solid's copy, and its parts that lie in it.
struct Wall {
    face: Face,
    parts: Vec<u32>,
}

impl SolidObject {
    /// The planes that a copy has, facing outwards where one of the operands that are not taken away does.
    fn walls_of(&self, map: &DAffine3) -> Vec<Wall> {
        let mut taken = vec![false; self.operands.len()];
        mark_taken(&self.node, false, &mut taken);
        let mut walls: Vec<(DAffine3, bool, Wall)> = Vec::new();
        for (k, part) in (0u32..).zip(&self.parts).filter(|(_, part)| part.surface == Surface::Plane) {
            let is_taken = taken[part.operand];
            let face = face_of(part, &self.operands[part.operand], map, is_taken);
            match walls.iter_mut().find(|(known, ..)| *known == part.map) {
                Some((_, from_taken, wall)) => {
                    wall.parts.push(k);
                    let [low, high] = wall.face.bounds;
                    let bounds = [low.min(face.bounds[0]), high.max(face.bounds[1])];
                    if *from_taken && !is_taken {
                        (*from_taken, wall.face.normal) = (false, face.normal);
                    }
                    wall.face.bounds = bounds;
                }
                None => walls.push((part.map, is_taken, Wall { face, parts: vec![k] })),
            }
        }
        walls.into_iter().map(|(.., wall)| wall).collect()
    }
}

/// Which operands are taken away.
fn mark_taken(node: &Node, is_taken: bool, taken: &mut [bool]) {
    match node {
        Node::Operand(k) => taken[*k] = is_taken,
        Node::Made(operation, nodes) => {
            for (k, node) in nodes.iter().enumerate() {
                mark_taken(node, is_taken != (*operation == Operation::Difference && k > 0), taken);
            }
        }
    }
}

/// A plane of an operand of a copy.
fn face_of(part: &PartWritten, operand: &OperandWritten, map: &DAffine3, is_taken: bool) -> Face {
    let plane = *map * part.map;
    let facing = if part.flipped != is_taken { -1.0 } else { 1.0 };
    let bounds = operand.unit.bounds(&(*map * operand.moved * operand.local));
    Face { bounds: if operand.unit.is_endless() { endless() } else { bounds }, ..Face::of_map(&plane, facing) }
}

fn endless() -> [DVec3; 2] {
    [DVec3::NEG_INFINITY, DVec3::INFINITY]
}

impl Face {
    /// The plane z = 0 of a map, facing +z or, with -1, the other way; without an end.
    fn of_map(map: &DAffine3, facing: f64) -> Face {
        let normal = map.matrix3.x_axis.cross(map.matrix3.y_axis).normalize_or_zero();
        let normal = normal * map.matrix3.determinant().signum() * facing;
        Face { point: map.translation, normal, bounds: endless() }
    }

    /// By how much this wall is moved for the faces that it lies in one plane with.
    fn moves(&self, faces: &[Face], unit: f64) -> Option<DVec3> {
        let near = NEAR * unit;
        let mut by = None;
        for face in faces {
            let along = face.normal.dot(self.normal);
            let in_plane = (face.point - self.point).dot(self.normal).abs() <= near && along.abs() >= 1.0 - 1e-12;
            let [low, high] = self.bounds;
            if !in_plane || !overlap(&[low - near, high + near], &face.bounds) {
                continue;
            }
            if along > 0.0 {
                return Some(-PART * unit * self.normal);
            }
            by = Some(PART * unit * self.normal);
        }
        by
    }
}

/// Whether two boxes have a point in common.
fn overlap(a: &[DVec3; 2], b: &[DVec3; 2]) -> bool {
    a[0].cmple(b[1]).all() && b[0].cmple(a[1]).all()
}

/// The flat faces of all objects but solids that reach into this box, so many at most.
fn faces((loaded, placed, curved): (&Loaded, &Placed, &[Curved]), within: [DVec3; 2], most: usize) -> Vec<Face> {
    let mut faces = Vec::new();
    for object in curved {
        // Where its flat sides are, and which way they face.
        let sides: &[(f64, f64)] = match object.unit {
            UnitShape::Plane | UnitShape::Disk { .. } => &[(0.0, 1.0)],
            UnitShape::Cone { caps: true, .. } => &[(1.0, 1.0), (-1.0, -1.0)],
            _ => continue,
        };
        let copies = object.maps.iter().map(|map| {
            let bounds = if object.is_endless() { endless() } else { object.unit.bounds(map) };
            (map, bounds)
        });
        for (map, bounds) in copies.filter(|(_, bounds)| overlap(bounds, &within)) {
            faces.extend(sides.iter().map(|(at, facing)| {
                let side = *map * DAffine3::from_translation(*at * DVec3::Z);
                Face { bounds, ..Face::of_map(&side, *facing) }
            }));
        }
        faces.truncate(most);
    }
    for k in 0..placed.maps.len() {
        let Some(data) = loaded.file(k) else { continue };
        let maps = placed.maps_of(k);
        if data.triangles.len().saturating_mul(maps.len()) > MOST_TRIANGLES {
            continue;
        }
        for map in maps.iter().filter(|map| overlap(&box_under(placed.box_of(k), map), &within)) {
            let facing = map.matrix3.determinant().signum();
            let of_triangle = |corners: &[u32; 3]| {
                let [a, b, c] =
                    corners.map(|k| data.positions.get(k as usize).map_or(DVec3::ZERO, |p| DVec3::from(*p)));
                let [a, b, c] = [a, b, c].map(|p| map.transform_point3(p));
                let bounds = [a.min(b).min(c), a.max(b).max(c)];
                let normal = (b - a).cross(c - a).try_normalize()? * facing;
                overlap(&bounds, &within).then_some(Face { point: a, normal, bounds })
            };
            faces.extend(data.triangles.iter().filter_map(of_triangle).take(most.saturating_sub(faces.len())));
        }
    }
    faces
}

/// A box around a box under a map.
fn box_under([low, high]: [DVec3; 2], map: &DAffine3) -> [DVec3; 2] {
    let pick = |k: usize, axis: usize| if k >> axis & 1 == 0 { low[axis] } else { high[axis] };
    let corners = (0..8).map(|k| map.transform_point3(DVec3::new(pick(k, 0), pick(k, 1), pick(k, 2))));
    corners.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
}
