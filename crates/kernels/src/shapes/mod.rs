//! Curved shapes: each a unit shape, of a size of about one about the origin of its object space, under an affine map.
//!
//! What knows a kind of shape is its own file and its lines in [`UnitShape`] here; tree, surfaces, compiler and casters
//! ask by [`Row`].
//!
//! A hit is one scalar function of ray and row in `f64`, without fused operations: rows hold the inverse of the map in
//! `f64`, so that nothing is lost wherever the shape lies and however thin or large it is, and t is the root rounded
//! once to `f32`. The same function is called by all kernels for one ray at a time, hence the same bits at all levels
//! and widths. A scalar `f64` operation takes as long as one in `f32`. Closed shapes are one primitive each: their hits
//! are the ends of the interval in which the line is within all of their parts, so that no ray slips between cap and
//! side. What is made of several ([`csg`]) is one primitive, too.
//!
//! A ray that leaves a shape knows it and starts on it but for a rounding: the part that it starts on is found from the
//! point, and its root there is 0 exactly. Convex shapes are then met on the way out only, by rays that go inwards, and
//! of a torus the root of the start is known by the way that the ray takes; no epsilon.

mod capsule;
mod cone;
pub mod csg;
mod cube;
mod disk;
mod lamp;
mod plane;
mod sphere;
mod torus;

use bytemuck::{Pod, Zeroable};
use glam::{DAffine3, DMat3, DVec2, DVec3};
pub use lamp::{Lamp, Start, Towards};

/// A unit shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UnitShape {
    /// About the origin, of radius 1; an ellipsoid under a map. Texture coordinates are those of spheres.
    Sphere,
    /// In the plane z = 0, of radius 1, facing +z; x is to the right, y up. Open.
    Disk {
        /// Radius of its hole.
        inner: f64,
    },
    /// About the z axis from z = -1 to 1.
    Cone {
        /// Radii at z = -1 and 1, of which the larger is 1.
        radii: [f64; 2],
        /// Disks close its ends.
        caps: bool,
        /// Its axis is upright where it was written: "right" on a cap is +x on both then.
        upright: bool,
    },
    /// All points at most 1 away from the z axis between z = -half and half.
    Capsule {
        /// Half the distance between its centres.
        half: f64,
    },
    /// All points at most `tube` away from the circle of radius 1 about the origin in the plane z = 0.
    Torus {
        /// Radius of its section, at most 1.
        tube: f64,
    },
    /// The plane z = 0, facing +z; x is to the right, y up, and both are its texture coordinates. Open and without an
    /// end.
    Plane,
    /// About the origin, of side 1: a box that is an operand. Boxes by themselves are triangles.
    Cube,
    /// Made of others, in render space: a range of the parts of all solids. Its own map is not asked.
    Solid(Solid),
}

/// What is made of other shapes ([`csg`]), in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// The first of its parts among those of all solids, and how many they are.
    pub parts: [u32; 2],
    /// As well its steps ([`crate::scene::Step`]).
    pub steps: [u32; 2],
    /// As well its operands.
    pub operands: [u32; 2],
    /// A box that it lies in.
    pub bounds: [DVec3; 2],
}

/// Bits of the third parameter of cones.
const CAPS: u32 = 1;
const UPRIGHT: u32 = 2;

/// A ray in object space.
#[derive(Clone, Copy, Debug)]
struct ObjectRay {
    /// The point of the ray that is nearest to the anchor in render space, or its origin where it leaves the shape.
    o: DVec3,
    d: DVec3,
    /// The ray's own t at `o`.
    t0: f64,
}

/// The surface of a unit shape near a point of object space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnUnit {
    /// The nearest point of the part that the given one lies on, about.
    pub q: DVec3,
    /// Normal there, outwards, of any length.
    pub n: DVec3,
    /// Texture coordinates, v upwards.
    pub uv: DVec2,
}

/// A shape as rays are tested with it, 112 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Row {
    /// Rows of the linear part of the map from render space to object space.
    object: [[f64; 3]; 3],
    /// Where the origin of object space is in render space.
    anchor: [f64; 3],
    kind: u32,
    parameters: [f32; 3],
}

impl UnitShape {
    const DISK: u32 = 0;
    const CONE: u32 = 1;
    const CAPSULE: u32 = 2;
    const SPHERE: u32 = 3;
    const CUBE: u32 = 4;
    const SOLID: u32 = 5;
    const PLANE: u32 = 6;
    const TORUS: u32 = 7;

    fn numbers(&self) -> (u32, [f32; 3]) {
        match *self {
            UnitShape::Sphere => (Self::SPHERE, [0.0; 3]),
            UnitShape::Disk { inner } => (Self::DISK, [inner as f32, 0.0, 0.0]),
            UnitShape::Cone { radii, caps, upright } => {
                let bits = if caps { CAPS } else { 0 } + if upright { UPRIGHT } else { 0 };
                (Self::CONE, [radii[0] as f32, radii[1] as f32, f32::from_bits(bits)])
            }
            UnitShape::Capsule { half } => (Self::CAPSULE, [half as f32, 0.0, 0.0]),
            UnitShape::Torus { tube } => (Self::TORUS, [tube as f32, 0.0, 0.0]),
            UnitShape::Cube => (Self::CUBE, [0.0; 3]),
            UnitShape::Solid(Solid { parts: [first, count], .. }) => {
                (Self::SOLID, [f32::from_bits(first), f32::from_bits(count), 0.0])
            }
            UnitShape::Plane => (Self::PLANE, [0.0; 3]),
        }
    }

    /// The largest w.q over its points q: with w a row of a map it says how far the shape reaches along an axis.
    pub fn reach(&self, w: DVec3) -> f64 {
        match *self {
            UnitShape::Sphere => w.length(),
            UnitShape::Disk { .. } => w.truncate().length(),
            UnitShape::Cone { radii: [first, last], .. } => {
                let across = w.truncate().length();
                (first * across - w.z).max(last * across + w.z)
            }
            UnitShape::Capsule { half } => w.length() + half * w.z.abs(),
            UnitShape::Torus { tube } => w.truncate().length() + tube * w.length(),
            UnitShape::Cube => 0.5 * w.abs().element_sum(),
            UnitShape::Solid(Solid { bounds: [low, high], .. }) => (w * low).max(w * high).element_sum(),
            UnitShape::Plane if w.truncate() == glam::DVec2::ZERO => 0.0,
            UnitShape::Plane => f64::INFINITY,
        }
    }

    /// Whether it has an inside.
    pub fn is_closed(&self) -> bool {
        match self {
            UnitShape::Disk { .. } | UnitShape::Plane => false,
            UnitShape::Cone { caps, .. } => *caps,
            UnitShape::Sphere
            | UnitShape::Capsule { .. }
            | UnitShape::Torus { .. }
            | UnitShape::Cube
            | UnitShape::Solid(_) => true,
        }
    }

    /// Whether it has no end: no box holds it, and no tree.
    pub fn is_endless(&self) -> bool {
        matches!(self, UnitShape::Plane)
    }

    /// The exact box of the shape under a map.
    pub fn bounds(&self, map: &DAffine3) -> [DVec3; 2] {
        let reach = |sign: f64| DVec3::from([0, 1, 2].map(|axis| self.reach(sign * map.matrix3.row(axis))));
        [map.translation - reach(-1.0), map.translation + reach(1.0)]
    }
}

impl Row {
    /// The shape under a map from object space to render space that can be undone.
    pub fn new(shape: &UnitShape, map: &DAffine3) -> Self {
        let inverse = map.matrix3.inverse();
        let (kind, parameters) = shape.numbers();
        Row {
            object: [0, 1, 2].map(|k| inverse.row(k).to_array()),
            anchor: map.translation.to_array(),
            kind,
            parameters,
        }
    }

    /// Rows of the linear part of the map from render space to object space.
    fn object_from_render(&self) -> DMat3 {
        DMat3::from_cols_array_2d(&self.object).transpose()
    }

    /// The flat parts of its surface.
    pub fn flat_faces(&self) -> impl Iterator<Item = FlatFace> + use<> {
        let faces = match self.kind {
            UnitShape::DISK => [Some(disk::face(&self.parameters)), None],
            UnitShape::CONE => cone::faces(&self.parameters),
            UnitShape::PLANE => [Some(plane::face()), None],
            _ => [None; 2],
        };
        let row = *self;
        faces.into_iter().flatten().map(move |(z, radii)| FlatFace { row, z, radii })
    }

    /// The least t > 0 at which the ray meets the shape; `leaves`: it starts on this very shape and is not met there.
    /// The direction need not be unit.
    pub fn hit(&self, origin: [f32; 3], direction: [f32; 3], leaves: bool) -> Option<f32> {
        self.hit_among(&[], origin, direction, leaves)
    }

    /// As [`hit`](Self::hit); `parts`: those of all solids.
    // Once, for plain instructions: inlined it would stand in every kernel beside the triangles.
    #[inline(never)]
    pub fn hit_among(&self, parts: &[csg::Part], origin: [f32; 3], direction: [f32; 3], leaves: bool) -> Option<f32> {
        let [origin, direction] = [origin, direction].map(|v| DVec3::from(v.map(f64::from)));
        let t = self.meet_among(parts, origin, direction, leaves)? as f32;
        (t > 0.0 && t < f32::INFINITY).then_some(t)
    }

    #[inline(always)]
    fn meet_among(&self, parts: &[csg::Part], origin: DVec3, direction: DVec3, leaves: bool) -> Option<f64> {
        match self.kind {
            UnitShape::SOLID => csg::hit(self.parts(parts), origin, direction, leaves),
            _ => self.meet(origin, direction, leaves),
        }
    }

    /// Whether no part of its surface stands before another one that faces the same point.
    fn is_convex(&self) -> bool {
        match self.kind {
            UnitShape::CONE => self.parameters[2].to_bits() & CAPS != 0,
            UnitShape::TORUS | UnitShape::SOLID => false,
            _ => true,
        }
    }

    /// Whether a part of it stands between a ray's origin and its end at `t_max`, which lies on it, on a side that
    /// faces the origin; `leaves`: the origin lies on it, too. Where it is convex none does. Asked from the end back:
    /// what starts on the shape is not met where it starts.
    #[inline(never)]
    pub fn hides_itself(
        &self,
        parts: &[csg::Part],
        origin: [f32; 3],
        direction: [f32; 3],
        leaves: bool,
        t_max: f32,
    ) -> bool {
        if self.is_convex() {
            return false;
        }
        let [origin, direction] = [origin, direction].map(|v| DVec3::from(v.map(f64::from)));
        let t_max = f64::from(t_max);
        let end = origin + t_max * direction;
        match self.meet_among(parts, end, -direction, true).filter(|t| *t < t_max) {
            Some(back) if leaves => {
                // From both ends the other one is met where nothing is between: t_max twice. What is between is met
                // from both before half of that.
                let ahead = self.meet_among(parts, origin, direction, true);
                ahead.is_some_and(|ahead| ahead + back < 1.5 * t_max)
            }
            back => back.is_some(),
        }
    }

    /// Where the ray meets it, before that is rounded; a solid is not met.
    #[inline(always)]
    fn meet(&self, origin: DVec3, d: DVec3, leaves: bool) -> Option<f64> {
        let map = self.object_from_render();
        let from_anchor = origin - DVec3::from(self.anchor);
        let t0 = if leaves { 0.0 } else { -(from_anchor.dot(d) / d.dot(d)) };
        let ray = ObjectRay { o: map * (from_anchor + t0 * d), d: map * d, t0 };
        match self.kind {
            UnitShape::DISK => disk::hit(&self.parameters, &ray, leaves),
            UnitShape::CONE => cone::hit(&self.parameters, &ray, leaves),
            UnitShape::CAPSULE => capsule::hit(&self.parameters, &ray, leaves),
            UnitShape::CUBE => cube::hit(&ray, leaves),
            UnitShape::PLANE => plane::hit(&ray, leaves),
            UnitShape::TORUS => torus::hit(&self.parameters, &ray, leaves),
            _ => sphere::hit(&ray, leaves),
        }
    }

    /// Of the parts of all solids its own, where it is a solid.
    fn parts<'a>(&self, parts: &'a [csg::Part]) -> &'a [csg::Part] {
        let [first, count] = [0, 1].map(|k| self.parameters[k].to_bits() as usize);
        parts.get(first..first + count).unwrap_or(&[])
    }

    /// Where it is a solid: its surface near a point of render space.
    #[inline(never)]
    pub fn on_solid(&self, parts: &[csg::Part], point: DVec3) -> Option<csg::OnSolid> {
        if self.kind == UnitShape::SOLID { csg::surface(self.parts(parts), point) } else { None }
    }

    /// The surface at a point of render space near the shape: point and outward unit normal in render space, texture
    /// coordinates.
    #[inline(never)]
    pub fn surface(&self, point: DVec3) -> OnUnit {
        let map = self.object_from_render();
        let q = map * (point - DVec3::from(self.anchor));
        let on = match self.kind {
            UnitShape::DISK => disk::surface(&self.parameters, q),
            UnitShape::CONE => cone::surface(&self.parameters, q),
            UnitShape::CAPSULE => capsule::surface(&self.parameters, q),
            UnitShape::CUBE => cube::surface(q),
            UnitShape::PLANE => plane::surface(q),
            UnitShape::TORUS => torus::surface(&self.parameters, q),
            _ => sphere::surface(q),
        };
        let step = match self.kind {
            UnitShape::DISK | UnitShape::PLANE => (on.q.z - q.z) * last_of_inverse(&map),
            _ => map.inverse() * (on.q - q),
        };
        OnUnit { q: point + step, n: (map.transpose() * on.n).normalize(), uv: on.uv }
    }
}

/// The last column of the inverse, to the bit as `DMat3::inverse` makes it.
fn last_of_inverse(m: &DMat3) -> DVec3 {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = *m;
    let first = y.cross(z);
    let one_over = 1.0 / x.dot(first);
    DVec3::new(first.z, z.x * x.y - x.x * z.y, x.x * y.y - y.x * x.y) * one_over
}

/// A flat part of a shape: what of the plane z = `z` of its object space is between two circles about the z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatFace {
    row: Row,
    z: f64,
    /// Radii of both circles.
    radii: [f64; 2],
}

impl FlatFace {
    /// Corners of the square about it, in render space, one after the other.
    pub fn corners(&self) -> [DVec3; 4] {
        let (map, r) = (self.row.object_from_render().inverse(), self.radii[1]);
        [(r, r), (-r, r), (-r, -r), (r, -r)].map(|(x, y)| DVec3::from(self.row.anchor) + map * DVec3::new(x, y, self.z))
    }

    /// Whether it is all of a plane.
    pub fn is_endless(&self) -> bool {
        self.radii[1] == f64::INFINITY
    }

    /// The unit normal to the front, and n.p of all points p of its plane.
    pub fn equation(&self) -> (DVec3, f64) {
        let map = self.row.object_from_render();
        let normal = (map.transpose() * DVec3::Z).normalize();
        let point = DVec3::from(self.row.anchor) + map.inverse() * DVec3::new(0.0, 0.0, self.z);
        (normal, normal.dot(point))
    }

    /// The unit normal to the outside of the shape; `None`: it has no inside.
    pub fn outward(&self) -> Option<DVec3> {
        (self.z != 0.0).then(|| (self.row.object_from_render().transpose() * DVec3::Z * self.z).normalize())
    }

    /// t where a ray's line passes through it.
    pub fn passed(&self, origin: [f32; 3], direction: [f32; 3]) -> Option<f64> {
        let map = self.row.object_from_render();
        let d = DVec3::from(direction.map(f64::from));
        let from_anchor = DVec3::from(origin.map(f64::from)) - DVec3::from(self.row.anchor);
        let (o, d) = (map * from_anchor, map * d);
        let t = (self.z - o.z) / d.z;
        let at = o.truncate() + t * d.truncate();
        let squared = at.dot(at);
        // A line along the plane has no t, and none of these holds.
        let [inner, outer] = self.radii.map(|r| r * r);
        (inner <= squared && squared <= outer && t.is_finite()).then_some(t)
    }
}

/// Where a line is within a convex solid: t from the first to the second.
type Interval = [f64; 2];

/// What two solids have in common.
fn both(a: Interval, b: Interval) -> Option<Interval> {
    let [near, far] = [a[0].max(b[0]), a[1].min(b[1])];
    (near <= far).then_some([near, far])
}

/// Where a line is between the planes z = -h and h.
fn slab(ray: &ObjectRay, h: f64) -> Option<Interval> {
    if ray.d.z == 0.0 {
        return (ray.o.z.abs() <= h).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let [a, b] = [(-h - ray.o.z) / ray.d.z, (h - ray.o.z) / ray.d.z];
    Some([a.min(b), a.max(b)])
}

/// Where a line is within the sphere of radius 1 about a point of the z axis; `on`: it starts on it.
fn ball(ray: &ObjectRay, z: f64, on: bool) -> Option<Interval> {
    let g = ray.o - DVec3::new(0.0, 0.0, z);
    quadratic(ray.d.dot(ray.d), g.dot(ray.d), if on { 0.0 } else { g.dot(g) - 1.0 })
}

/// Where a t^2 + 2 beta t + gamma <= 0 for a > 0.
fn quadratic(a: f64, beta: f64, gamma: f64) -> Option<Interval> {
    let disc = beta * beta - a * gamma;
    if disc < 0.0 {
        return None;
    }
    let q = -(beta + disc.sqrt().copysign(beta));
    if q == 0.0 {
        return Some([0.0; 2]);
    }
    // -0 + 0 = 0: of a line that starts on the surface the root there is no number below zero.
    let [first, second] = [gamma / q + 0.0, q / a];
    Some([first.min(second), first.max(second)])
}

/// The first end of an interval ahead of the ray's origin; of a ray that leaves the solid the way out of it.
fn first_end(ray: &ObjectRay, [near, far]: Interval, leaves: bool) -> Option<f64> {
    let [near, far] = [ray.t0 + near, ray.t0 + far];
    let t = if near > 0.0 && !leaves { near } else { far };
    (t > 0.0).then_some(t)
}

/// u around the z axis: 1/2 where -y is, growing towards x.
fn longitude(q: DVec3) -> f64 {
    0.5 + libm::atan2(q.x, -q.y) / std::f64::consts::TAU
}

#[cfg(test)]
mod tests {
    use super::*;
    use tracer_reference::Random;

    #[test]
    fn the_last_column_of_an_inverse_is_that_of_the_inverse() {
        let mut random = Random::new(1);
        for _ in 0..1000 {
            let map = DMat3::from_cols_array(&[(); 9].map(|()| random.between(-3.0, 3.0)));
            let expected = map.inverse().z_axis;
            assert_eq!(last_of_inverse(&map).to_array().map(f64::to_bits), expected.to_array().map(f64::to_bits));
        }
    }
}
