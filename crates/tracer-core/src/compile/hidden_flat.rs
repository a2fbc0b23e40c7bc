//! Rectangles and boxes that nobody sees, since others lie in the same planes: of surfaces in one plane one is seen
//! wherever both are ([`tracer_kernels::bvh`]).

use super::placed::Placed;
use super::polygonal::{Geometry, UnitShape, polygonal};
use glam::{DAffine3, DMat3, DVec3};
use scene_format::desc::{Material, MaterialRef};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::{BTreeMap, BTreeSet};

/// With more faces than this none are looked at.
const MOST_FACES: usize = 1 << 16;
/// With more than this in places of their own none are compared: each is with each.
const MOST_PLACES: usize = 2048;
/// Planes this much apart, relative to the size of the faces, are one.
const APART: f64 = 1e-7;

/// A side of a box, or a rectangle.
struct Face {
    /// Its object among those of triangles.
    object: usize,
    corners: [DVec3; 4],
    /// To the square of a size of one about the origin, z being the distance from the plane.
    to_square: DAffine3,
    /// Planes that are no further than this are its own.
    apart: f64,
    /// Who is seen: the least, then the first.
    rank: (u32, usize),
}

impl Face {
    /// The face that `right` and `up` are the sides of, `None` where it has no area.
    fn new(object: usize, rank: (u32, usize), center: DVec3, right: DVec3, up: DVec3) -> Option<Face> {
        let normal = right.cross(up).try_normalize()?;
        let frame = DAffine3 { matrix3: DMat3::from_cols(right, up, normal), translation: center };
        let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
        let corners = corners.map(|(x, y)| center + x * right + y * up);
        let apart = APART * (right.length() + up.length() + center.length());
        Some(Face { object, corners, to_square: frame.inverse(), apart, rank })
    }

    /// Where it is, the same for all that are in the same place.
    fn place(&self) -> [[u64; 3]; 4] {
        // Zero has a sign, which is no place.
        let mut place = self.corners.map(|corner| corner.to_array().map(|x| (x + 0.0).to_bits()));
        place.sort_unstable();
        place
    }

    /// Whether it hides all of another face.
    fn hides(&self, other: &Face) -> bool {
        let within = |corner: &DVec3| {
            let p = self.to_square.transform_point3(*corner);
            let side = 0.5 + 1e-6;
            p.z.abs() <= self.apart.max(other.apart) && p.x.abs() <= side && p.y.abs() <= side
        };
        self.rank < other.rank && other.corners.iter().all(within)
    }
}

/// Warns of them, of all together once, but for those that were told of something else.
// Long: faces are gathered, sorted by place and held against each other, and each step needs what the one before has.
pub fn warn(desc: &SceneDesc, placed: &Placed, told: &BTreeSet<Span>, diagnostics: &mut Diagnostics) {
    let materials: BTreeMap<&str, &Material> =
        desc.materials.iter().map(|named| (&*named.name.value, &named.material)).collect();
    let mut faces: Vec<Face> = Vec::new();
    let mut objects = Vec::new();
    for (k, object) in polygonal(desc).enumerate() {
        objects.push((object.number, object.span));
        let Geometry::Unit(shape) = object.geometry else { continue };
        // What the camera does not see is in nobody's way there, and is not meant to be seen.
        if !desc.objects.get(object.number as usize).is_none_or(|written| written.value.camera_visible()) {
            continue;
        }
        let material = match object.material {
            MaterialRef::Default => None,
            MaterialRef::Named { name, .. } => materials.get(&**name).copied(),
            MaterialRef::Inline(material) => Some(&material.value),
        };
        let shines = material.is_some_and(|material| material.shines().is_some());
        let rank = if shines { 0 } else { 1 + u32::from(material.is_some_and(Material::transmits)) };
        for map in placed.maps_of(k) {
            let [x, y, z] = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis];
            let sides: &[(DVec3, DVec3, DVec3)] = match shape {
                UnitShape::Square => &[(DVec3::ZERO, x, y)],
                UnitShape::Cube => &[
                    (0.5 * x, y, z),
                    (-0.5 * x, y, z),
                    (0.5 * y, z, x),
                    (-0.5 * y, z, x),
                    (0.5 * z, x, y),
                    (-0.5 * z, x, y),
                ],
            };
            // Copies of an object are in order.
            let of_side =
                |&(off, right, up): &(DVec3, DVec3, DVec3)| Face::new(k, (rank, k), map.translation + off, right, up);
            faces.extend(sides.iter().filter_map(of_side));
            if faces.len() > MOST_FACES {
                return;
            }
        }
    }
    let mut by: BTreeMap<usize, usize> = BTreeMap::new();
    let mut seen: BTreeSet<usize> = BTreeSet::new();
    // Of those in the same place one hides the others.
    let mut places: BTreeMap<[[u64; 3]; 4], &Face> = BTreeMap::new();
    for face in &faces {
        let first = places.entry(face.place()).or_insert(face);
        if face.rank < first.rank {
            *first = face;
        }
    }
    if places.len() > MOST_PLACES {
        return;
    }
    let other_place = |face: &Face| places.values().find(|other| other.object != face.object && other.hides(face));
    for face in &faces {
        let first = places.get(&face.place()).filter(|first| first.object != face.object);
        match first.or_else(|| other_place(face)) {
            Some(other) => {
                by.entry(face.object).or_insert(other.object);
            }
            None => {
                seen.insert(face.object);
            }
        }
    }
    by.retain(|object, _| !seen.contains(object) && objects.get(*object).is_none_or(|(_, span)| !told.contains(span)));
    let Some((&hidden, &other)) = by.iter().next() else { return };
    let (Some((number, span)), Some((over, shown))) = (objects.get(hidden), objects.get(other)) else { return };
    let more = match by.len() - 1 {
        0 => String::new(),
        1 => ", and one more like it".to_owned(),
        more => format!(", and {more} more like it"),
    };
    let message = format!("nothing is seen of objects[{number}]: it lies in one plane with objects[{over}]{more}");
    diagnostics.push(
        Diagnostic::warning(codes::HIDDEN_FLAT, *span, message)
            .expected("surfaces that do not lie in each other")
            .hint("lift it a little, by a thousandth of its size, or leave it out")
            .label(*shown, "this one is seen in its place"),
    );
}
