//! What the tree needs to know of a scene: positions, placements and spheres, all in render space.
//!
//! Render space is the world moved and scaled so that the scene is about 1 in size; every length here is an f32 in it.

use crate::shapes::Row;
use crate::shapes::csg::Part;
use glam::DVec3;

/// No primitive, or no instance: rays that leave no surface, spheres (which belong to no instance), and misses.
pub const NONE: u32 = u32::MAX;

/// The whole geometry, borrowed while an [`Accel`](super::Accel) is built from it.
#[derive(Clone, Copy, Default)]
pub struct Geometry<'a> {
    /// Sphere `i` is primitive `i`.
    pub spheres: &'a [SphereGeometry],
    /// Curved shapes of other kinds; shape `i` is primitive `first_shape + i`.
    pub shapes: &'a [ShapeGeometry],
    /// The id of shape 0, not below the number of spheres; anything where there are neither shapes nor planes.
    pub first_shape: u32,
    /// The parts of all shapes that are made of several.
    pub parts: &'a [Part],
    /// Planes without an end, which hang in no tree: the tree knows of them what lies in them. Plane `i` is primitive
    /// `first_shape + shapes.len() + i`.
    pub planes: &'a [Row],
    /// Every mesh once, however often it is placed.
    pub meshes: &'a [MeshGeometry<'a>],
    /// Where the meshes stand. A mesh without an instance is not in the scene.
    pub instances: &'a [InstanceGeometry],
    /// What is not to be met.
    pub left_out: LeftOut<'a>,
}

/// What keeps its numbers and is not in the tree, a flag each; nothing where a list ends before.
#[derive(Clone, Copy, Default)]
pub struct LeftOut<'a> {
    /// Of the spheres.
    pub spheres: &'a [bool],
    /// Of the curved shapes, and behind them of the planes.
    pub shapes: &'a [bool],
    /// Of the instances.
    pub instances: &'a [bool],
}

impl LeftOut<'_> {
    /// Whether such a list leaves out its `k`th.
    pub fn holds(list: &[bool], k: usize) -> bool {
        list.get(k).copied().unwrap_or(false)
    }
}

/// A triangle mesh. Triangle `k` is primitive `first_primitive + k` in every instance of the mesh.
#[derive(Clone, Copy)]
pub struct MeshGeometry<'a> {
    /// Vertex positions, in object space (render space where the mesh is placed directly).
    pub positions: &'a [[f32; 3]],
    /// Three indices into `positions` for each triangle.
    pub triangles: &'a [[u32; 3]],
    /// The id of triangle 0. The id ranges of meshes, shapes and spheres must not overlap, and meshes come in rising
    /// order.
    pub first_primitive: u32,
}

/// One mesh in the scene.
#[derive(Clone, Copy)]
pub struct InstanceGeometry {
    /// Index into [`Geometry::meshes`].
    pub mesh: u32,
    /// Rows of the 3x4 matrix from object space to render space; `None` where the positions are in render space
    /// already. No inverse beside it: a million of them would be the larger part of the memory.
    pub placement: Option<[[f32; 4]; 3]>,
}

/// A curved shape that is no sphere: how rays meet it (see [`Row::hit`]), and where it is.
#[derive(Clone, Copy, Debug)]
pub struct ShapeGeometry {
    /// What rays are tested with.
    pub row: Row,
    /// A box that holds the shape, rounding included: lower corner.
    pub lower: [f32; 3],
    /// A box that holds the shape, rounding included: upper corner.
    pub upper: [f32; 3],
}

/// A sphere, described at one point of its surface so that nothing of the size of its radius enters the arithmetic.
///
/// With g = p − `anchor`, the surface is `curvature`·g·g + 2 `normal`·g = 0 (see [`sphere_hit`](super::sphere_hit)).
#[derive(Clone, Copy, Debug)]
pub struct SphereGeometry {
    /// The point of the surface nearest to the origin of render space, the scene's middle.
    pub anchor: [f32; 3],
    /// The outward unit normal at the anchor.
    pub normal: [f32; 3],
    /// 1 / radius.
    pub curvature: f32,
    /// A box that holds the sphere, rounding included: lower corner.
    pub lower: [f32; 3],
    /// A box that holds the sphere, rounding included: upper corner.
    pub upper: [f32; 3],
}

impl SphereGeometry {
    /// The sphere about `center`, in render space. The anchor is found in f64 and then rounded.
    pub fn new(center: DVec3, radius: f64) -> Self {
        let distance = center.length();
        let normal = if distance > 0.0 { -center / distance } else { DVec3::X };
        let anchor = center + normal * radius;
        // The stored anchor and normal are rounded, which moves the sphere by about radius * 2^-24, and the roots
        // are good to some 2^-20 of the radius across the ray; 2^-17 leaves room.
        let reach = radius * (1.0 + 1.0 / 131_072.0) + (center.abs().max_element() + radius) / 1_048_576.0;
        Self {
            anchor: anchor.as_vec3().to_array(),
            normal: normal.as_vec3().to_array(),
            curvature: (1.0 / radius) as f32,
            lower: (center - reach).as_vec3().to_array(),
            upper: (center + reach).as_vec3().to_array(),
        }
    }
}
