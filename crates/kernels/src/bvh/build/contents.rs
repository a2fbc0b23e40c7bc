//! What the leaves hold: triangles gathered from meshes, spheres, other curved shapes, and the boxes of instances.

use super::super::bounds::Bounds;
use super::super::geometry::{Geometry, MeshGeometry, NONE, ShapeGeometry, SphereGeometry};
use super::super::layout::{Parts4, Ref, Shape, Spheres4, Triangles4, Unit};
use super::super::ray_space::{PAD, RANGE};
use super::BuildError;
use super::binary::Item;
use super::parts::Part;
use super::wide::WriteLeaves;
use glam::{Affine3A, DMat3, DVec3, Mat3A, Vec3A, Vec4};
use rayon::prelude::*;

/// Meshes of fewer triangles are looked through by one thread.
const SHORT: usize = 4096;

/// The lists that a tree's leaves refer into, in the order of the leaves.
#[derive(Default)]
pub struct Contents<'a> {
    pub triangles: Triangles<'a>,
    pub spheres: Spheres<'a>,
    pub shapes: Shapes<'a>,
    pub instances: Instances,
    /// The box of everything.
    pub bounds: Bounds,
}

#[derive(Default)]
pub struct Triangles<'a> {
    pub list: TriangleList<'a>,
    pub order: Vec<u32>,
}

#[derive(Default)]
pub struct Spheres<'a> {
    pub list: &'a [SphereGeometry],
    pub order: Vec<u32>,
}

#[derive(Default)]
pub struct Shapes<'a> {
    pub list: &'a [ShapeGeometry],
    /// The id of the first.
    pub first: u32,
    pub order: Vec<u32>,
}

#[derive(Default)]
pub struct Instances {
    pub order: Vec<u32>,
}

impl Triangles<'_> {
    /// How many triangles are in the tree, each counted once.
    pub fn count(&self) -> u64 {
        (self.order.len() + self.list.cut - self.list.parts()) as u64
    }

    fn leaf(&self, first: u32, count: u32) -> Triangles4 {
        let order = &self.order[first as usize..(first + count) as usize];
        let mut leaf = Triangles4 { vertices: [[[0.0; 4]; 3]; 3], ids: [NONE; 4] };
        for place in 0..4 {
            // What is left over is one point of the first triangle three times: without area, never hit.
            let (vertices, id) = match order.get(place) {
                Some(&index) => self.list.triangle(index),
                None => ([self.list.triangle(order[0]).0[0]; 3], NONE),
            };
            for (vertex, position) in vertices.into_iter().enumerate() {
                for (axis, coordinate) in position.into_iter().enumerate() {
                    leaf.vertices[vertex][axis][place] = coordinate;
                }
            }
            leaf.ids[place] = id;
        }
        leaf
    }

    fn leaf_of_parts(&self, first: u32, count: u32) -> Parts4 {
        let order = &self.order[first as usize..(first + count) as usize];
        let (lower, upper) = ([[f32::INFINITY; 4]; 3], [[f32::NEG_INFINITY; 4]; 3]);
        let mut leaf = Parts4 { triangles: self.leaf(first, count), lower, upper };
        for (place, &index) in order.iter().enumerate() {
            // What is in the tree has a box.
            let bounds = self.list.bounds(index).unwrap_or(Bounds::EMPTY);
            for axis in 0..3 {
                leaf.lower[axis][place] = bounds.lower[axis];
                leaf.upper[axis][place] = bounds.upper[axis];
            }
            if !self.list.is_part(index) {
                std::mem::swap(&mut leaf.lower[0][place], &mut leaf.upper[0][place]);
            }
        }
        leaf
    }
}

impl WriteLeaves for Contents<'_> {
    fn triangles(&self, first: u32, count: u32, units: &mut [Unit]) {
        units.copy_from_slice(bytemuck::cast_slice(&[self.triangles.leaf(first, count)]));
    }

    fn parts(&self, first: u32, count: u32, units: &mut [Unit]) {
        units.copy_from_slice(bytemuck::cast_slice(&[self.triangles.leaf_of_parts(first, count)]));
    }

    fn spheres(&self, first: u32, count: u32, units: &mut [Unit]) {
        let order = &self.spheres.order[first as usize..(first + count) as usize];
        let nan = [f32::NAN; 4];
        let mut leaf = Spheres4 { anchor: [nan; 3], normal: [nan; 3], curvature: nan, ids: [NONE; 4] };
        for (place, &index) in order.iter().enumerate() {
            let sphere = &self.spheres.list[index as usize];
            for axis in 0..3 {
                leaf.anchor[axis][place] = sphere.anchor[axis];
                leaf.normal[axis][place] = sphere.normal[axis];
            }
            leaf.curvature[place] = sphere.curvature;
            leaf.ids[place] = index;
        }
        units.copy_from_slice(bytemuck::cast_slice(&[leaf]));
    }

    fn shape(&self, first: u32, units: &mut [Unit]) {
        let index = self.shapes.order[first as usize];
        let leaf = Shape::new(self.shapes.list[index as usize].row, self.shapes.first + index);
        units.copy_from_slice(bytemuck::cast_slice(&[leaf]));
    }

    fn instance(&self, first: u32) -> Ref {
        Ref(Ref::INSTANCE | self.instances.order[first as usize])
    }
}

/// The triangles of several meshes, numbered through.
#[derive(Default)]
pub struct TriangleList<'a> {
    meshes: Vec<MeshGeometry<'a>>,
    /// The indices of `meshes` in the geometry.
    indices: Vec<u32>,
    /// The number of each mesh's first triangle.
    starts: Vec<u32>,
    count: u32,
    /// Parts of triangles that have been cut; numbered on from the triangles.
    parts: Vec<Part>,
    /// How many triangles these are the parts of.
    pub cut: usize,
}

impl<'a> TriangleList<'a> {
    /// Meshes have fewer than 2^32 triangles in all: their primitive ids have been checked.
    pub fn new(geometry: &Geometry<'a>, indices: &[u32]) -> Self {
        let meshes: Vec<_> = indices.iter().map(|&index| geometry.meshes[index as usize]).collect();
        let mut count = 0;
        let starts = meshes
            .iter()
            .map(|mesh| {
                count += mesh.triangles.len() as u32;
                count - mesh.triangles.len() as u32
            })
            .collect();
        Self { meshes, indices: indices.to_vec(), starts, count, parts: Vec::new(), cut: 0 }
    }

    /// How many parts there are.
    pub fn parts(&self) -> usize {
        self.parts.len()
    }

    /// Whether a number is that of a part.
    pub fn is_part(&self, index: u32) -> bool {
        index >= self.count
    }

    /// Returns the part's number.
    pub fn add(&mut self, part: Part) -> u32 {
        self.parts.push(part);
        self.count + self.parts.len() as u32 - 1
    }

    /// Which of the meshes a triangle, or a part of one, belongs to.
    pub fn mesh_of(&self, index: u32) -> usize {
        self.place(index).0
    }

    fn place(&self, index: u32) -> (usize, usize) {
        let index = if self.is_part(index) { self.parts[(index - self.count) as usize].triangle } else { index };
        let mesh = self.starts.partition_point(|&start| start <= index) - 1;
        (mesh, (index - self.starts[mesh]) as usize)
    }

    /// The corners of a triangle whose indices have been checked.
    pub fn corners(&self, index: u32) -> [[f32; 3]; 3] {
        self.triangle(index).0
    }

    /// The corners and the primitive id of a triangle, or of the triangle of a part, whose indices have been checked.
    fn triangle(&self, index: u32) -> ([[f32; 3]; 3], u32) {
        let (mesh, triangle) = self.place(index);
        let mesh = &self.meshes[mesh];
        let vertices = mesh.triangles[triangle].map(|vertex| mesh.positions[vertex as usize]);
        (vertices, mesh.first_primitive + triangle as u32)
    }

    /// The triangles to build a tree from, and the box of them all. Triangles with a corner that is not finite, or
    /// beyond the range of the arithmetic, are left out: nothing can hit them.
    pub fn items(&self) -> Result<(Vec<Item>, Bounds), BuildError> {
        self.check()?;
        let item = |index: u32| Item::new(&self.bounds(index).unwrap_or(Bounds::EMPTY), index);
        let mut items: Vec<Item> = (0..self.count).into_par_iter().map(item).collect();
        let (bounds, all) = items.par_iter().map(|item| (item.bounds(), !item.bounds().is_empty())).reduce(
            || (Bounds::EMPTY, true),
            |(mut a, all_a), (b, all_b)| {
                a.include(&b);
                (a, all_a && all_b)
            },
        );
        if !all {
            items.retain(|item| !item.bounds().is_empty());
        }
        Ok((items, bounds))
    }

    /// Whether all corners are there; of several faults the first is told. All threads are asked once, not mesh by
    /// mesh: a million boxes are a million meshes of twelve triangles, and to wake the threads takes longer than those.
    fn check(&self) -> Result<(), BuildError> {
        let fault = self.meshes.par_iter().zip(&self.indices).find_map_first(|(mesh, &index)| {
            let vertices = mesh.positions.len();
            let missing = |corners: &[u32; 3]| corners.iter().find(|&&vertex| vertex as usize >= vertices).copied();
            let triangle = match mesh.triangles.len() {
                SHORT.. => mesh.triangles.par_iter().position_first(|corners| missing(corners).is_some()),
                _ => mesh.triangles.iter().position(|corners| missing(corners).is_some()),
            }?;
            let vertex = missing(&mesh.triangles[triangle])?;
            Some(BuildError::Vertex { mesh: index, triangle: triangle as u32, vertex, vertices })
        });
        fault.map_or(Ok(()), Err)
    }

    /// The box of a part, or of a triangle whose indices have been checked, if it can be hit.
    fn bounds(&self, index: u32) -> Option<Bounds> {
        if self.is_part(index) {
            return Some(self.parts[(index - self.count) as usize].bounds);
        }
        let (corners, _) = self.triangle(index);
        let mut bounds = Bounds::EMPTY;
        for [x, y, z] in corners {
            let position = Vec4::new(x, y, z, 0.0);
            if !position.abs().cmple(Vec4::splat(RANGE)).all() {
                return None;
            }
            bounds.include_point(position);
        }
        // The same widening as in the triangle test (`padded_box`), so that this is the very box of that test.
        let pad = PAD * bounds.upper.max(-bounds.lower).max_element();
        Some(Bounds { lower: bounds.lower - Vec4::splat(pad), upper: bounds.upper + Vec4::splat(pad) })
    }
}

/// The map that takes rays into an instance: the inverse of its placement.
pub fn object_from_world(rows: &[[f32; 4]; 3]) -> Affine3A {
    let column = |k: usize| Vec3A::new(rows[0][k], rows[1][k], rows[2][k]);
    Affine3A { matrix3: Mat3A::from_cols(column(0), column(1), column(2)), translation: column(3) }.inverse()
}

/// The world box of a placed mesh, wide enough for the rounding of everything that happens in its object space; `None`
/// where the placement is of no use.
///
/// The corners go through the inverse, in f64, of the very matrix that rays go through, so that the two do not
/// disagree. A ray's point there is off by 2^-21 of the terms of its transformation and by 2^-18 of the mesh's reach
/// in its box and triangle tests (see [`RaySpace`](super::super::ray_space)); taken to the world, that is the padding.
pub fn instance_bounds(object_from_world: &Affine3A, mesh: &Bounds) -> Option<Bounds> {
    let rows = object_from_world.matrix3.to_cols_array().map(f64::from);
    let inverse = DMat3::from_cols_array(&rows);
    let translation = object_from_world.translation.as_dvec3();
    let matrix = inverse.inverse();
    let (mut lower, mut upper) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for corner in 0..8 {
        let pick = |axis: usize| if corner >> axis & 1 == 0 { mesh.lower[axis] } else { mesh.upper[axis] };
        let point = matrix * (DVec3::new(f64::from(pick(0)), f64::from(pick(1)), f64::from(pick(2))) - translation);
        lower = lower.min(point);
        upper = upper.max(point);
    }
    let farthest = lower.abs().max(upper.abs()) + (upper - lower);
    let reach = mesh.lower.abs().max(mesh.upper.abs()).truncate().max_element();
    let terms = abs(&inverse) * farthest + translation.abs();
    let error = terms / 2_097_152.0 + DVec3::splat(f64::from(reach) / 262_144.0);
    let pad = abs(&matrix) * error + farthest / 2_097_152.0;
    let (lower, upper) = ((lower - pad).as_vec3(), (upper + pad).as_vec3());
    let useful = lower.abs().max(upper.abs()).cmple(glam::Vec3::splat(RANGE)).all();
    useful.then(|| Bounds::new(lower.to_array(), upper.to_array()))
}

fn abs(m: &DMat3) -> DMat3 {
    DMat3::from_cols(m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs())
}
