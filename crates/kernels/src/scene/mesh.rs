//! Triangle meshes, all in one set of buffers.

use super::NONE;
use glam::DVec3;

/// A mesh, once, however often it is placed: a range of triangles of [`Triangles`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mesh {
    /// First triangle in [`Triangles`]. Its primitive id is this plus the number of spheres.
    pub first_triangle: u32,
    /// Number of triangles.
    pub triangle_count: u32,
}

/// A mesh placed in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Index into `Scene::meshes`.
    pub mesh: u32,
    /// Index into `Scene::materials` for the whole of it; [`NONE`]: the triangles' own.
    pub material: u32,
    /// Its object's place in the scene.
    pub object: u32,
    /// Rows of the 3x4 matrix from the mesh's frame to render space; `None`: the mesh is in render space already (it is
    /// placed once).
    pub placement: Option<[[f32; 4]; 3]>,
}

/// All triangles of all meshes. Indices point into the whole buffers.
#[derive(Clone, Debug, Default)]
pub struct Triangles {
    /// Vertices: in render space where the mesh is placed once, else in its own frame.
    pub positions: Vec<[f32; 3]>,
    /// Three vertices per triangle, counter-clockwise seen from outside.
    pub vertices: Vec<[u32; 3]>,
    /// Unit vertex normals, in the frame of the positions.
    pub normals: Vec<[f32; 3]>,
    /// Three normals per triangle, all [`NONE`] where it is flat; empty when no mesh is smooth.
    pub normal_indices: Vec<[u32; 3]>,
    /// Texture coordinates (u to the right, v upwards).
    pub uvs: Vec<[f32; 2]>,
    /// Three texture coordinates per triangle, all [`NONE`] where there are none; empty when no mesh has any.
    pub uv_indices: Vec<[u32; 3]>,
    /// Material per triangle (index into `Scene::materials`), where the instance names none.
    pub material: Vec<u32>,
    /// Index into `Scene::lights` per triangle, [`NONE`] where it does not shine; none beyond the last one that does.
    /// Meshes that shine are in render space.
    pub light: Vec<u32>,
}

impl Triangles {
    /// The corners of a triangle, in its mesh's frame.
    pub fn corners(&self, triangle: u32) -> Option<[DVec3; 3]> {
        let v = self.vertices.get(triangle as usize)?;
        let corner = |k: usize| self.positions.get(v[k] as usize).map(|p| DVec3::from(p.map(f64::from)));
        Some([corner(0)?, corner(1)?, corner(2)?])
    }

    /// The vertex normals of a triangle, in its mesh's frame; `None` where it is flat.
    pub fn corner_normals(&self, triangle: u32) -> Option<[DVec3; 3]> {
        let n = self.normal_indices.get(triangle as usize).filter(|n| n[0] != NONE)?;
        let corner = |k: usize| self.normals.get(n[k] as usize).map(|p| DVec3::from(p.map(f64::from)));
        Some([corner(0)?, corner(1)?, corner(2)?])
    }

    /// The texture coordinates of a triangle; `None` where it has none.
    pub fn corner_uvs(&self, triangle: u32) -> Option<[[f64; 2]; 3]> {
        let t = self.uv_indices.get(triangle as usize).filter(|t| t[0] != NONE)?;
        let corner = |k: usize| self.uvs.get(t[k] as usize).map(|p| p.map(f64::from));
        Some([corner(0)?, corner(1)?, corner(2)?])
    }
}

/// Instances as the engine reads them: index = instance.
#[derive(Default)]
pub struct InstanceTable {
    /// Rows of the 3x4 matrices to render space, 12 numbers per instance (the identity where the mesh is there
    /// already); empty when no instance is placed by a matrix.
    pub matrices: Vec<f32>,
    /// The material of the whole instance, or [`NONE`]; empty as `matrices`.
    pub material: Vec<u32>,
}

impl InstanceTable {
    /// Of the instances, in their order.
    pub fn new(instances: &[Instance]) -> Self {
        if instances.iter().all(|i| i.placement.is_none()) {
            return InstanceTable::default();
        }
        const IDENTITY: [[f32; 4]; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        InstanceTable {
            matrices: instances.iter().flat_map(|i| i.placement.unwrap_or(IDENTITY)).flatten().collect(),
            material: instances.iter().map(|i| i.material).collect(),
        }
    }
}
