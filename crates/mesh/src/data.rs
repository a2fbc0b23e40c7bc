//! A mesh as readers give it.

use super::colors::VertexColors;
use scene_format::Diagnostics;
use scene_format::desc::NamedMaterial;
use std::path::PathBuf;

/// In a corner of [`MeshData::normal_triangles`] or [`MeshData::uv_triangles`]: the file gives none here. In
/// [`MeshData::triangle_material`]: the default material.
pub const NO_INDEX: u32 = u32::MAX;

/// Largest magnitude of a coordinate that a mesh or placements file may have: its fourth power still fits an `f64`.
pub const MAX_COORDINATE: f64 = 1e30;

/// A mesh as its file gives it, polygons cut into triangles, every index checked.
///
/// Triangles keep the winding of the file's faces, no triangle has zero area, and all attributes that corners name
/// exist.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// All vertices of the file in its order, also those that no triangle uses; each coordinate is finite and at most
    /// [`MAX_COORDINATE`] in magnitude. `f64`, because a mesh may lie far from its origin.
    pub positions: Vec<[f64; 3]>,
    /// Indices into `positions`; never empty.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals of the file; empty when no corner has one.
    pub normals: Vec<[f32; 3]>,
    /// Indices into `normals`, one triple per triangle; [`NO_INDEX`] in a corner that has none. `None` while `normals`
    /// is not empty: the corners use the indices of `triangles` (and `normals` is as long as `positions`).
    pub normal_triangles: Option<Vec<[u32; 3]>>,
    /// Texture coordinates (u to the right, v upwards, (0, 0) at the lower left of the picture); empty when no corner
    /// has any.
    pub uvs: Vec<[f32; 2]>,
    /// As `normal_triangles`, for `uvs`.
    pub uv_triangles: Option<Vec<[u32; 3]>>,
    /// The colours of all vertices, as many as `positions`; `None` where the file has none, or where nobody wanted them
    /// ([`Wanted`](crate::Wanted)).
    pub colors: Option<VertexColors>,
    /// The materials of the file, or of its MTL files, that triangles use, in order of first use. File names of
    /// textures are complete: they start at the folder of the MTL file as this mesh's path gave it, and must not be
    /// joined to the scene's folder again. A picture within a glTF file is called as [`file_of`](crate::file_of) says.
    pub materials: Vec<NamedMaterial>,
    /// Index into `materials` per triangle, or [`NO_INDEX`]; empty: all have the default.
    pub triangle_material: Vec<u32>,
    /// What the file names of materials, where its triangles use them: what `materials` and `triangle_material` were
    /// made of.
    pub material_names: MaterialNames,
    /// Further files that were read for it: MTL files, buffers of glTF.
    pub libraries: Vec<PathBuf>,
    /// Recoverable oddities: at most one `W0510` for the mesh file, one `W0511` for its materials, and one
    /// `W0512` for what else of it is not taken. They have no span.
    pub warnings: Diagnostics,
}

/// What a file names of materials.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialNames {
    /// The names of MTL files as it has them (`mtllib`).
    pub libraries: Vec<String>,
    /// The names of materials that faces use, in order of first use, and whether the MTL files have them; of glTF their
    /// numbers.
    pub used: Vec<(String, bool)>,
}

impl MeshData {
    /// Mean of all `positions` (of the vertices in the file, used or not); the origin for a mesh without any.
    #[expect(clippy::indexing_slicing, reason = "three axes")]
    pub fn barycentre(&self) -> [f64; 3] {
        // Summed as differences from the first vertex: a small mesh far away keeps its digits.
        let Some(&origin) = self.positions.first() else { return [0.0; 3] };
        let mut sum = [0.0; 3];
        for position in &self.positions {
            for axis in 0..3 {
                sum[axis] += position[axis] - origin[axis];
            }
        }
        let count = self.positions.len() as f64;
        std::array::from_fn(|axis| origin[axis] + sum[axis] / count)
    }
}
