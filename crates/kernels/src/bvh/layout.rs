//! The bytes of the tree: nodes of eight boxes, leaves of four triangles, parts of triangles or spheres, curved shapes,
//! instance records.
//!
//! Everything lies in one arena of 32-byte units (see [`arena`](super::arena)) and is referred to by [`Ref`], a word
//! that says what it points to and where. Kernels read the arena through raw pointers, so the layout is `repr(C)`.

use super::bounds::Bounds;
use super::geometry::NONE;
use crate::shapes::Row;
use bytemuck::{Pod, Zeroable};

/// The arena's grain: every item starts at a unit.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Unit(pub [u32; 8]);

/// Eight children, 256 bytes.
#[repr(C, align(32))]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Node {
    /// Lower and upper planes of the boxes: x lower, x upper, y lower, y upper, z lower, z upper; so that the near and
    /// the far plane of an axis differ in one bit of the byte offset. A child that is not there has lower = +inf and
    /// upper = −inf, which no ray is inside.
    pub planes: [[f32; 8]; 6],
    /// What is in the boxes.
    pub children: [Ref; 8],
    /// Word j, bits 3k to 3k + 2: the child that comes j-th, farthest first, for a ray of octant k.
    pub order: [u32; 8],
}

/// Four triangles, 160 bytes. Places that are not used hold one point three times, which nothing hits, and
/// the id `NONE`.
#[repr(C, align(32))]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Triangles4 {
    /// Vertex, axis, triangle.
    pub vertices: [[[f32; 4]; 3]; 3],
    /// Primitive ids.
    pub ids: [u32; 4],
}

/// Four parts of triangles, or triangles that are not cut, 256 bytes.
#[repr(C, align(32))]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Parts4 {
    /// The triangles; the same one may be there more than once.
    pub triangles: Triangles4,
    /// The parts' boxes, padded: axis, part. A triangle that is not cut has its own box with the planes of x exchanged:
    /// it is tested as anywhere else.
    pub lower: [[f32; 4]; 3],
    pub upper: [[f32; 4]; 3],
}

/// Four spheres, 128 bytes. Places that are not used have the id `NONE` and NaNs, which nothing hits.
#[repr(C, align(32))]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Spheres4 {
    /// Anchors: axis, sphere.
    pub anchor: [[f32; 4]; 3],
    /// Normals at the anchors: axis, sphere.
    pub normal: [[f32; 4]; 3],
    /// 1 / radius.
    pub curvature: [f32; 4],
    /// Primitive ids.
    pub ids: [u32; 4],
}

/// A curved shape that is no sphere, 128 bytes: as long as four spheres, and with its ids at the same place, so that a
/// reference to spheres may lead to either. Its last id, which no primitive has, says which.
#[repr(C, align(32))]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Shape {
    /// What rays are tested with.
    pub row: Row,
    /// Primitive id, twice `NONE`, [`MARK`](Self::MARK).
    pub ids: [u32; 4],
}

impl Shape {
    /// The last id of the leaf of a shape.
    pub const MARK: u32 = NONE - 1;

    pub fn new(row: Row, id: u32) -> Self {
        Self { row, ids: [id, NONE, NONE, Self::MARK] }
    }
}

impl Spheres4 {
    /// Whether this is a [`Shape`].
    #[inline(always)]
    pub fn is_shape(&self) -> bool {
        self.ids[3] == Shape::MARK
    }
}

/// How a ray enters an instance, 64 bytes.
#[repr(C, align(32))]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct InstanceRecord {
    /// Rows of the object-from-world matrix, the translation last. Unused where the mesh is placed directly.
    pub object_from_world: [[f32; 4]; 3],
    /// The middle of the instance's world box.
    pub center: [f32; 3],
    /// Index of the mesh; [`DIRECT`](Self::DIRECT) set where its triangles are part of the top tree.
    pub mesh: u32,
}

impl InstanceRecord {
    /// Flag in `mesh`.
    pub const DIRECT: u32 = 1 << 31;

    /// The ray in object space. Its origin is first moved along the ray to the point nearest to the instance's middle,
    /// so that rays from far away lose no digits: a function of ray and instance alone.
    #[inline(always)]
    pub fn object_ray(&self, o: [f32; 3], d: [f32; 3]) -> ObjectRay {
        let dot = |a: [f32; 3], b: [f32; 3]| a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]));
        let c = self.center;
        let t0 = dot([c[0] - o[0], c[1] - o[1], c[2] - o[2]], d) / dot(d, d);
        let p = [t0.mul_add(d[0], o[0]), t0.mul_add(d[1], o[1]), t0.mul_add(d[2], o[2])];
        let [x, y, z] = self.object_from_world;
        let row = |m: [f32; 4], v: [f32; 3], w: f32| m[0].mul_add(v[0], m[1].mul_add(v[1], m[2].mul_add(v[2], w)));
        ObjectRay {
            origin: [row(x, p, x[3]), row(y, p, y[3]), row(z, p, z[3])],
            direction: [row(x, d, 0.0), row(y, d, 0.0), row(z, d, 0.0)],
            t0,
        }
    }
}

/// A ray in an instance's object space; its t counts from `t0` of the world's.
pub struct ObjectRay {
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    pub t0: f32,
}

/// A typed reference: nodes `000…`, triangle leaves `100…`, leaves of parts `101…`, leaves of spheres or a shape
/// `110…`, instances `111…` (in bits), the rest of the word being the unit (for instances, their index).
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Ref(pub u32);

impl Ref {
    pub const TRIANGLES: u32 = 0x8000_0000;
    pub const PARTS: u32 = 0xA000_0000;
    pub const SPHERES: u32 = 0xC000_0000;
    pub const INSTANCE: u32 = 0xE000_0000;
    /// The bits of the unit.
    pub const UNIT: u32 = 0x1FFF_FFFF;
    /// Units that every kind of reference can reach, and instances that can be told apart from the two marks below.
    pub const LIMIT: u32 = 0x1FFF_FFFE;
    /// Nothing: the bottom of a stack, the root of an empty tree, a missing child.
    pub const END: Self = Self(u32::MAX);
    /// On a stack: the ray leaves the instance it is in.
    pub const LEAVE: Self = Self(u32::MAX - 1);

    /// What is referred to. Marks have no kind of their own.
    pub fn kind(self) -> Kind {
        match self {
            Self::END | Self::LEAVE => Kind::Nothing,
            Self(word) if word < Self::TRIANGLES => Kind::Node(word as usize),
            Self(word) if word < Self::PARTS => Kind::Triangles((word & Self::UNIT) as usize),
            Self(word) if word < Self::SPHERES => Kind::Parts((word & Self::UNIT) as usize),
            Self(word) if word < Self::INSTANCE => Kind::Spheres((word & Self::UNIT) as usize),
            Self(word) => Kind::Instance(word & Self::UNIT),
        }
    }
}

/// Up to N boxes of a tree, without those that hold nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boxes<const N: usize> {
    /// Lower and upper planes: x lower, x upper, y lower and so on.
    pub planes: [[f32; N]; 6],
    /// How many there are.
    pub len: usize,
}

/// The boxes under the root.
pub type TopBoxes = Boxes<8>;
/// Those under its children; of children that are no nodes, their own.
pub type SecondBoxes = Boxes<64>;

impl<const N: usize> Boxes<N> {
    /// No box.
    pub const NONE: Self = Self { planes: [[0.0; N]; 6], len: 0 };

    /// Adds one; there are never more than N.
    pub fn push(&mut self, planes: [f32; 6]) {
        for (column, plane) in self.planes.iter_mut().zip(planes) {
            column[self.len] = plane;
        }
        self.len += 1;
    }
}

impl TopBoxes {
    /// The boxes of the root's children; of a tree that is no node, the box of everything.
    pub fn of(root: Ref, units: &[Unit], everything: &Bounds) -> Self {
        let mut top = Self::NONE;
        match root.kind() {
            Kind::Node(unit) => node_at(units, unit).boxes().for_each(|(planes, _)| top.push(planes)),
            Kind::Nothing => {}
            Kind::Triangles(_) | Kind::Parts(_) | Kind::Spheres(_) | Kind::Instance(_) => top.push(around(everything)),
        }
        top
    }
}

impl SecondBoxes {
    /// The boxes of the children of the root's children.
    pub fn of(root: Ref, units: &[Unit], everything: &Bounds) -> Self {
        let mut second = Self::NONE;
        match root.kind() {
            Kind::Node(unit) => {
                for (planes, child) in node_at(units, unit).boxes() {
                    match child.kind() {
                        Kind::Node(unit) => node_at(units, unit).boxes().for_each(|(planes, _)| second.push(planes)),
                        _ => second.push(planes),
                    }
                }
            }
            Kind::Nothing => {}
            Kind::Triangles(_) | Kind::Parts(_) | Kind::Spheres(_) | Kind::Instance(_) => {
                second.push(around(everything))
            }
        }
        second
    }
}

/// Bounds as planes.
pub fn around(bounds: &Bounds) -> [f32; 6] {
    std::array::from_fn(|k| if k % 2 == 0 { bounds.lower[k / 2] } else { bounds.upper[k / 2] })
}

fn node_at(units: &[Unit], unit: usize) -> &Node {
    bytemuck::from_bytes(bytemuck::cast_slice(&units[unit..unit + NODE_UNITS as usize]))
}

impl Node {
    /// The children that are there, with their planes.
    pub fn boxes(&self) -> impl Iterator<Item = ([f32; 6], Ref)> + '_ {
        let there = (0..8).filter(|&child| self.children[child] != Ref::END);
        there.map(|child| (self.planes.map(|column| column[child]), self.children[child]))
    }
}

/// A [`Ref`] taken apart: units, or the instance's index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Node(usize),
    Triangles(usize),
    Parts(usize),
    Spheres(usize),
    Instance(u32),
    Nothing,
}

pub const NODE_UNITS: u32 = 8;
pub const TRIANGLES_UNITS: u32 = 5;
pub const PARTS_UNITS: u32 = 8;
pub const SPHERES_UNITS: u32 = 4;
pub const INSTANCE_UNITS: u32 = 2;
/// Nodes start on cache lines.
pub const LINE_UNITS: u32 = 2;
