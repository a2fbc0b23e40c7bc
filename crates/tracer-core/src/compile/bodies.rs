//! Whether a thing lies within a closed body, or beside it, for sure: unit shapes under a map, closed meshes, and, by
//! [`Side::or`] and [`Side::not`], solids that are made of several.

use super::curved::is_similar;
use glam::{DAffine3, DVec3};
use std::cell::OnceCell;
use std::collections::BTreeMap;
use tracer_kernels::shapes::UnitShape;
use tracer_mesh::MeshData;

/// Where a thing lies, as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Within the body.
    In,
    /// Beside it.
    Out,
    /// In part, or nobody knows.
    Unknown,
}

impl Side {
    /// Of two bodies as one.
    pub fn or(self, other: Side) -> Side {
        match (self, other) {
            (Side::In, _) | (_, Side::In) => Side::In,
            (Side::Out, Side::Out) => Side::Out,
            _ => Side::Unknown,
        }
    }

    /// Of all that is not in the body.
    pub fn not(self) -> Side {
        match self {
            Side::In => Side::Out,
            Side::Out => Side::In,
            Side::Unknown => Side::Unknown,
        }
    }
}

/// What a thing lies in: the convex hull of balls of one radius.
#[derive(Clone, Debug)]
pub struct Extent {
    corners: Vec<DVec3>,
    radius: f64,
}

impl Extent {
    /// Of a ball.
    pub fn ball(center: DVec3, radius: f64) -> Extent {
        Extent { corners: vec![center], radius }
    }

    /// Of a box with these corners under a map.
    pub fn of_box([low, high]: [DVec3; 2], map: &DAffine3) -> Extent {
        let pick = |k: usize, axis: usize| if k >> axis & 1 == 0 { low[axis] } else { high[axis] };
        let corner = |k| map.transform_point3(DVec3::new(pick(k, 0), pick(k, 1), pick(k, 2)));
        Extent { corners: (0..8).map(corner).collect(), radius: 0.0 }
    }

    /// Of a unit shape under a map.
    pub fn of_unit(unit: &UnitShape, map: &DAffine3) -> Extent {
        if *unit == UnitShape::Sphere && is_similar(map) {
            return Extent::ball(map.translation, map.matrix3.x_axis.length());
        }
        Extent::of_box(unit.bounds(map), &DAffine3::IDENTITY)
    }

    /// A ball around it.
    fn around(&self) -> (DVec3, f64) {
        let (low, high) = bounds(self.corners.iter().copied());
        let center = 0.5 * (low + high);
        let reach = self.corners.iter().map(|corner| corner.distance(center)).fold(0.0, f64::max);
        (center, reach + self.radius)
    }
}

fn bounds(points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}

/// At least the most by which a map makes anything longer.
fn stretch(map: &DAffine3) -> f64 {
    let m = map.matrix3;
    if is_similar(map) {
        return m.x_axis.length() * (1.0 + 1e-9);
    }
    // The Frobenius norm is no less than the spectral one.
    (m.x_axis.length_squared() + m.y_axis.length_squared() + m.z_axis.length_squared()).sqrt()
}

/// A body with round or flat sides: a unit shape under an affine map.
pub struct UnitBody {
    to_unit: DAffine3,
    unit: Unit,
}

enum Unit {
    /// Of a size of one about the origin.
    Cube,
    /// All that is at most 1 away from the z axis between -half and half.
    Round { half: f64 },
    /// Closed, about the z axis from -1 to 1, with these radii at its ends.
    Cone { radii: [f64; 2] },
    /// At most `tube` away from the circle of radius 1 in the plane z = 0. It is not convex.
    Ring { tube: f64 },
    /// What is behind the plane z = 0.
    Behind,
}

/// The ball's largest reach in units of the cone along normals of its side; between so many of them it is no more by
/// half a percent.
fn reach_across(to_unit: &DAffine3, slope: f64) -> f64 {
    const NORMALS: u32 = 64;
    let reach = |k: u32| {
        let (sin, cos) = libm::sincos(f64::from(k) * std::f64::consts::TAU / f64::from(NORMALS));
        (to_unit.matrix3.transpose() * DVec3::new(cos, sin, -slope)).length()
    };
    1.005 * (0..NORMALS).map(reach).fold(0.0, f64::max)
}

impl UnitBody {
    /// A unit shape under a map; `None`: it is not closed. What is behind a plane is a body, too, for solids.
    pub fn of(unit: &UnitShape, map: &DAffine3) -> Option<UnitBody> {
        let unit = match *unit {
            UnitShape::Sphere => Unit::Round { half: 0.0 },
            UnitShape::Capsule { half } => Unit::Round { half },
            UnitShape::Cone { radii, caps: true, .. } => Unit::Cone { radii },
            UnitShape::Cube => Unit::Cube,
            UnitShape::Torus { tube } => Unit::Ring { tube },
            UnitShape::Plane => Unit::Behind,
            UnitShape::Cone { .. } | UnitShape::Disk { .. } | UnitShape::Solid(_) => return None,
        };
        Some(UnitBody { to_unit: map.inverse(), unit })
    }

    /// Where a thing lies.
    pub fn side(&self, extent: &Extent) -> Side {
        let corners = || extent.corners.iter().map(|corner| self.to_unit.transform_point3(*corner));
        if let Unit::Ring { .. } = self.unit {
            // Two corners may lie in it without what is between them.
            let (center, radius) = extent.around();
            if self.holds(self.to_unit.transform_point3(center), radius) {
                return Side::In;
            }
        } else if corners().all(|corner| self.holds(corner, extent.radius)) {
            return Side::In;
        }
        let (low, high) = bounds(corners());
        let rows = DVec3::from([0, 1, 2].map(|axis| extent.radius * self.to_unit.matrix3.row(axis).length()));
        if self.is_beside(low - rows, high + rows) { Side::Out } else { Side::Unknown }
    }

    /// Whether a ball lies in it as a whole; `p`: its centre in units of the shape.
    fn holds(&self, p: DVec3, radius: f64) -> bool {
        let row = |axis: usize| radius * self.to_unit.matrix3.row(axis).length();
        match self.unit {
            // The distance of a side is what is left to it in units over the length of its row.
            Unit::Cube => (0..3).all(|axis| 0.5 - p[axis].abs() > row(axis)),
            Unit::Round { half } => {
                let from_axis = DVec3::new(p.x, p.y, (p.z.abs() - half).max(0.0)).length();
                1.0 - from_axis > if radius > 0.0 { radius * stretch(&self.to_unit) } else { 0.0 }
            }
            Unit::Cone { radii: [first, last] } => {
                let slope = 0.5 * (last - first);
                // R(z) - |(x, y)| is what is left to the side, along its normal (x, y, -slope).
                let side = 0.5 * (first + last) + slope * p.z - p.truncate().length();
                1.0 - p.z.abs() > row(2)
                    && side > if radius > 0.0 { radius * reach_across(&self.to_unit, slope) } else { 0.0 }
            }
            Unit::Ring { tube } => {
                let from_middle = libm::hypot(p.truncate().length() - 1.0, p.z);
                tube - from_middle > if radius > 0.0 { radius * stretch(&self.to_unit) } else { 0.0 }
            }
            Unit::Behind => -p.z > row(2),
        }
    }

    /// Whether a box in units of the shape lies beside it.
    fn is_beside(&self, low: DVec3, high: DVec3) -> bool {
        // The nearest point of the box to the axis.
        let [x, y] = [0, 1].map(|axis| 0.0f64.clamp(low[axis], high[axis]));
        match self.unit {
            Unit::Cube => (0..3).any(|axis| low[axis] > 0.5 || high[axis] < -0.5),
            Unit::Round { half } => {
                let beyond = (low.z - half).max(-half - high.z).max(0.0);
                DVec3::new(x, y, beyond).length() > 1.0
            }
            Unit::Cone { radii: [first, last] } => {
                low.z > 1.0 || high.z < -1.0 || x * x + y * y > first.max(last) * first.max(last)
            }
            Unit::Ring { tube } => {
                let farthest = low.truncate().abs().max(high.truncate().abs()).length();
                low.z > tube || high.z < -tube || libm::hypot(x, y) > 1.0 + tube || farthest < 1.0 - tube
            }
            Unit::Behind => low.z > 0.0,
        }
    }
}

/// A mesh that may be a closed body.
pub struct MeshBody<'a> {
    data: &'a MeshData,
    low: DVec3,
    high: DVec3,
    closed: OnceCell<bool>,
}

impl<'a> MeshBody<'a> {
    /// Of this mesh, which lies in a box with these corners.
    pub fn new(data: &'a MeshData, [low, high]: [DVec3; 2]) -> Self {
        MeshBody { data, low, high, closed: OnceCell::new() }
    }

    /// Where a thing lies of the mesh under a map; `left`: how many triangles may still be looked at.
    ///
    /// The winding number of a closed surface, the sum of the solid angles of its triangles over 4 pi, is the same at
    /// all points that a way joins that does not cross the surface, and 0 far away. So no way leads from a point where
    /// it is not 0 to one where it is.
    pub fn side(&self, map: &DAffine3, extent: &Extent, left: &mut usize) -> Side {
        let to_local = map.inverse();
        let (center, radius) = extent.around();
        let (p, radius) = (to_local.transform_point3(center), radius * stretch(&to_local));
        if (0..3).any(|axis| p[axis] - radius > self.high[axis] || p[axis] + radius < self.low[axis]) {
            return Side::Out;
        }
        let count = self.data.triangles.len();
        if count > *left {
            return Side::Unknown;
        }
        *left -= count;
        let mut angle = 0.0;
        for corners in &self.data.triangles {
            let [a, b, c] = corners.map(|k| DVec3::from(self.data.positions[k as usize]) - p);
            if may_touch([a, b, c], radius) {
                return Side::Unknown;
            }
            angle += solid_angle([a, b, c]);
        }
        let turns = angle / (4.0 * std::f64::consts::PI);
        if (turns - turns.round()).abs() > 1e-3 || !*self.closed.get_or_init(|| is_closed(self.data)) {
            return Side::Unknown;
        }
        if turns.round() == 0.0 { Side::Out } else { Side::In }
    }
}

/// Whether a triangle may come as near to the origin as this: both its plane and its box do.
fn may_touch([a, b, c]: [DVec3; 3], radius: f64) -> bool {
    let (low, high) = bounds([a, b, c].into_iter());
    let normal = (b - a).cross(c - a).normalize_or_zero();
    DVec3::ZERO.clamp(low, high).length() <= radius && normal.dot(a).abs() <= radius
}

/// The solid angle of a triangle seen from the origin, with the sign of its winding (Van Oosterom and Strackee 1983):
/// tan(angle / 2) = a . (b x c) / (|a| |b| |c| + (a . b) |c| + (b . c) |a| + (c . a) |b|).
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let [la, lb, lc] = [a, b, c].map(DVec3::length);
    let beside = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * libm::atan2(a.dot(b.cross(c)), beside)
}

/// Whether each edge is between triangles that go along it as often in one way as in the other.
pub fn is_closed(data: &MeshData) -> bool {
    open_edges(data) == 0
}

/// How many edges are not; corners at one place are one.
pub fn open_edges(data: &MeshData) -> usize {
    let mut places: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let welded: Vec<u32> = data
        .positions
        .iter()
        .enumerate()
        // -0 and 0 are one place.
        .map(|(k, p)| *places.entry(p.map(|x| (x + 0.0).to_bits())).or_insert(k as u32))
        .collect();
    let mut edges: Vec<([u32; 2], i32)> = Vec::with_capacity(3 * data.triangles.len());
    for &[a, b, c] in &data.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (Some(&from), Some(&to)) = (welded.get(from as usize), welded.get(to as usize)) else { continue };
            if from != to {
                edges.push(([from.min(to), from.max(to)], if from < to { 1 } else { -1 }));
            }
        }
    }
    edges.sort_unstable();
    edges.chunk_by(|a, b| a.0 == b.0).filter(|ways| ways.iter().map(|(_, way)| way).sum::<i32>() != 0).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;

    fn ball(p: [f64; 3], radius: f64) -> Extent {
        Extent::ball(DVec3::from(p), radius)
    }

    /// A cube of a size of two as a mesh, its faces wound outwards or the other way.
    fn cube(outwards: bool) -> MeshData {
        let mut mesh = super::super::polygonal::UnitShape::Cube.mesh();
        mesh.positions.iter_mut().for_each(|p| *p = p.map(|x| 2.0 * x));
        if !outwards {
            mesh.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
        }
        mesh
    }

    #[test]
    fn unit_bodies_hold_what_lies_in_them() {
        let map = DAffine3 { matrix3: DMat3::from_diagonal(DVec3::new(2.0, 2.0, 4.0)), translation: DVec3::X };
        let shapes = [
            (UnitShape::Sphere, [0.0, 0.0, 3.8], [0.0, 0.0, 4.2]),
            (UnitShape::Capsule { half: 1.0 }, [0.0, 1.8, 4.0], [0.0, 2.2, 4.0]),
            (UnitShape::Cone { radii: [1.0, 0.0], caps: true, upright: false }, [0.9, 0.0, 0.0], [2.1, 0.0, 0.0]),
            (UnitShape::Torus { tube: 0.5 }, [0.0, 2.8, 0.0], [0.0, 0.8, 0.0]),
            (UnitShape::Cube, [0.9, 0.9, 1.9], [0.9, 1.1, 1.9]),
            (UnitShape::Plane, [9.0, 9.0, -0.1], [9.0, 9.0, 0.1]),
        ];
        for (unit, inside, outside) in shapes {
            let body = UnitBody::of(&unit, &map).expect("is closed");
            let at = |p: [f64; 3], radius: f64| body.side(&Extent::ball(DVec3::from(p) + DVec3::X, radius));
            assert_eq!((at(inside, 0.0), at(outside, 0.0)), (Side::In, Side::Out), "{unit:?}");
            assert_eq!((at(inside, 0.5), at(outside, 0.5)), (Side::Unknown, Side::Unknown), "{unit:?}");
            assert_eq!((at(inside, 0.01), at(outside, 0.01)), (Side::In, Side::Out), "{unit:?}");
        }
        assert!(UnitBody::of(&UnitShape::Disk { inner: 0.0 }, &map).is_none());
    }

    /// The same of meshes whichever way they are wound, under maps; what is not closed has no inside.
    #[test]
    fn closed_meshes_hold_what_lies_in_them() {
        let map = DAffine3 { matrix3: DMat3::from_diagonal(DVec3::new(-3.0, 1.0, 1.0)), translation: DVec3::Y };
        for outwards in [true, false] {
            let mesh = cube(outwards);
            let body = MeshBody::new(&mesh, [DVec3::NEG_ONE, DVec3::ONE]);
            let mut left = 1000;
            let mut at = |p: [f64; 3], radius: f64| body.side(&map, &ball(p, radius), &mut left);
            assert_eq!(at([2.8, 1.8, 0.3], 0.0), Side::In);
            assert_eq!(at([2.8, 2.2, 0.3], 0.0), Side::Out);
            assert_eq!(at([0.0, 1.0, 0.0], 0.5), Side::In);
            assert_eq!(at([0.0, 2.0, 0.0], 0.5), Side::Unknown);
            assert_eq!(body.side(&map, &ball([0.0, 1.0, 0.0], 0.5), &mut 3), Side::Unknown);
        }
        let mut open = cube(true);
        open.triangles.truncate(10);
        let body = MeshBody::new(&open, [DVec3::NEG_ONE, DVec3::ONE]);
        assert_eq!(body.side(&DAffine3::IDENTITY, &ball([0.0; 3], 0.0), &mut 1000), Side::Unknown);
        assert!(is_closed(&cube(true)) && !is_closed(&open));
    }

    /// A ring: what lies in its hole lies beside it, though in its box.
    #[test]
    fn holes_are_beside() {
        let ring = "Lathe(profile: [(1.5, -0.5), (2.5, -0.5), (2.5, 0.5), (1.5, 0.5), (1.5, -0.5)])";
        let scene = &format!("Scene(background: 1, objects: [{ring}])");
        let loaded = scene_format::load_str("a.ron", scene, scene_format::Syntax::Ron, std::path::Path::new(""), &[]);
        let desc = loaded.expect("is right").scene;
        let made = tracer_mesh::shapes::of_object(&desc.objects[0].value).expect("becomes triangles");
        let mesh = made.mesh(scene_format::diagnostic::Span::NONE).expect("has triangles");
        let (low, high) = bounds(mesh.positions.iter().map(|p| DVec3::from(*p)));
        let body = MeshBody::new(&mesh, [low, high]);
        let mut left = usize::MAX;
        let mut at = |p: [f64; 3]| body.side(&DAffine3::IDENTITY, &ball(p, 0.1), &mut left);
        assert_eq!(at([0.0; 3]), Side::Out);
        assert_eq!(at([0.1, 0.2, 2.1]), Side::In);
    }
}
