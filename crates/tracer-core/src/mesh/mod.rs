//! Triangle meshes from files: OBJ (with MTL), OFF, PLY and STL, placements of copies, and vertex normals.
//!
//! Everything here is in the file's own coordinates: nothing is moved, scaled or recentred. Reading is deterministic: the
//! same bytes give the same mesh, the same warnings and the same error, whatever the number of threads.

// What a file says must not end the program: exceptions stand where they are made, each with its reason.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::unreachable,
        clippy::todo,
        clippy::unimplemented,
        clippy::indexing_slicing,
        clippy::string_slice
    )
)]

mod builder;
mod cursor;
mod mtl;
mod obj;
mod oddities;
mod off;
mod ply;
mod polygon;
mod stl;

mod error;
pub mod normals;
pub mod placements;

pub use crate::files::FileError;
pub(crate) use crate::files::read_regular_file;
pub use error::{MeshError, Place};

use scene_format::Diagnostics;
use scene_format::desc::NamedMaterial;
use std::path::{Path, PathBuf};

/// In a corner of [`MeshData::normal_triangles`] or [`MeshData::uv_triangles`]: the file gives none here. In
/// [`MeshData::triangle_material`]: the default material.
pub const NO_INDEX: u32 = u32::MAX;

/// Largest magnitude of a coordinate that a mesh or placements file may have: its fourth power still fits an `f64`.
pub const MAX_COORDINATE: f64 = 1e30;

/// A mesh as its file gives it, polygons cut into triangles, every index checked.
///
/// Triangles keep the winding of the file's faces, no triangle has zero area, and all attributes that corners name exist.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// All vertices of the file in its order, also those that no triangle uses; each coordinate is finite and at most
    /// [`MAX_COORDINATE`] in magnitude. `f64`, because a mesh may lie far from its origin.
    pub positions: Vec<[f64; 3]>,
    /// Indices into `positions`; never empty.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals of the file; empty when no corner has one.
    pub normals: Vec<[f32; 3]>,
    /// Indices into `normals`, one triple per triangle; [`NO_INDEX`] in a corner that has none. `None` while `normals` is
    /// not empty: the corners use the indices of `triangles` (and `normals` is as long as `positions`).
    pub normal_triangles: Option<Vec<[u32; 3]>>,
    /// Texture coordinates (u to the right, v upwards, (0, 0) at the lower left of the picture); empty when no corner has any.
    pub uvs: Vec<[f32; 2]>,
    /// As `normal_triangles`, for `uvs`.
    pub uv_triangles: Option<Vec<[u32; 3]>>,
    /// The MTL materials that triangles use, in order of first use. File names of textures are complete: they start at the
    /// folder of the MTL file as this mesh's path gave it, and must not be joined to the scene's folder again.
    pub materials: Vec<NamedMaterial>,
    /// Index into `materials` per triangle, or [`NO_INDEX`]; empty: all have the default.
    pub triangle_material: Vec<u32>,
    /// The MTL files that were read for it.
    pub libraries: Vec<PathBuf>,
    /// Recoverable oddities: at most one `W0510` for the mesh file and one `W0511` for its materials. They have no span.
    pub warnings: Diagnostics,
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

/// A file format of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ with MTL.
    Obj,
    /// Object File Format (Geomview), ASCII: OFF with the prefixes ST, C and N.
    Off,
    /// Polygon File Format (Stanford), ASCII and binary of both byte orders.
    Ply,
    /// Stereolithography, ASCII and binary.
    Stl,
}

/// Makes a mesh of the bytes of its file; the path is for messages.
type Read = fn(&[u8], &Path) -> Result<MeshData, MeshError>;

impl MeshFormat {
    /// All there are: what else asks about formats of meshes asks these.
    pub const ALL: [MeshFormat; 4] = [MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply, MeshFormat::Stl];

    /// Name, extension and reader.
    const fn entry(self) -> (&'static str, &'static str, Read) {
        match self {
            MeshFormat::Obj => ("OBJ", "obj", obj::read),
            MeshFormat::Off => ("OFF", "off", off::read),
            MeshFormat::Ply => ("PLY", "ply", ply::read),
            MeshFormat::Stl => ("STL", "stl", stl::read),
        }
    }

    /// As people call it: `OBJ`.
    pub const fn name(self) -> &'static str {
        self.entry().0
    }

    /// The extension of its files, in lower case: `obj`.
    pub const fn extension(self) -> &'static str {
        self.entry().1
    }

    /// By the extension of a file name, in upper or lower case.
    pub fn of(path: &Path) -> Option<MeshFormat> {
        let extension = path.extension()?;
        Self::ALL.into_iter().find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }

    /// All formats in words: `OBJ, OFF or STL`.
    fn list(word: impl Fn(MeshFormat) -> String) -> String {
        let words = Self::ALL.map(word);
        match &words[..] {
            [others @ .., last] if !others.is_empty() => format!("{} or {last}", others.join(", ")),
            _ => words.concat(),
        }
    }
}

/// Reads the mesh in `path`, of the format that its extension says.
///
/// # Errors
/// When there is no such file, it cannot be read or has another extension, when it is broken (with the line or the
/// byte), and when no triangle is left.
pub fn load(path: &Path) -> Result<MeshData, MeshError> {
    let format = MeshFormat::of(path).ok_or_else(|| MeshError::UnknownFormat { path: path.to_owned() })?;
    let text = read_regular_file(path)?;
    parse(&text, format, path)
}

/// Reads a mesh from the bytes of its file. `path` is what messages show, and where MTL files are looked for beside.
///
/// # Errors
/// As [`load`].
pub fn parse(text: &[u8], format: MeshFormat, path: &Path) -> Result<MeshData, MeshError> {
    let (_, _, read) = format.entry();
    read(text, path)
}
