//! Triangle meshes from files: OBJ (with MTL), OFF, PLY, STL and glTF, placements of copies, vertex normals, and shapes
//! that become triangles.
//!
//! Everything here is in the file's own coordinates: nothing is moved, scaled or recentred. Reading is deterministic:
//! the same bytes give the same mesh, the same warnings and the same error, whatever the number of threads.
//!
//! `tracer_core` hands this crate on as `tracer_core::mesh`.

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
#![forbid(unsafe_code)]

mod arrays;
mod builder;
mod coloring;
mod colors;
mod cursor;
mod data;
mod files;
mod format;
mod gltf;
mod inline;
mod materials;
mod mtl;
mod notes;
mod obj;
mod oddities;
mod off;
mod parts;
mod ply;
mod polygon;
mod stl;
mod within;

mod error;
pub mod normals;
pub mod placements;
pub mod shapes;

pub use arrays::MeshArrays;
pub use colors::{ColorValues, VertexColors, Wanted};
pub use data::{MAX_COORDINATE, MaterialNames, MeshData, NO_INDEX};
pub use error::{MeshError, Place};
pub use files::{FileError, Files, read_regular_file};
pub use format::MeshFormat;
pub use inline::mesh_of;
pub use within::file_of;

use std::path::Path;

/// Reads the mesh in `path`, of the format that its extension says.
///
/// # Errors
/// When there is no such file, it cannot be read or has another extension, when it is broken (with the line or the
/// byte), when it lacks a part that is wanted, and when no triangle is left.
pub fn load(path: &Path) -> Result<MeshData, MeshError> {
    load_from(path, &Files::default())
}

/// As [`load`], of files that may be in memory, as may be those that it names in turn: MTL files, buffers of glTF.
///
/// # Errors
/// As [`load`].
pub fn load_from(path: &Path, files: &Files) -> Result<MeshData, MeshError> {
    load_as(path, files, Wanted::default())
}

/// As [`load_from`], with what is wanted of it.
///
/// # Errors
/// As [`load`].
pub fn load_as(path: &Path, files: &Files, wanted: Wanted<'_>) -> Result<MeshData, MeshError> {
    let format = MeshFormat::of(path).ok_or_else(|| MeshError::UnknownFormat { path: path.to_owned() })?;
    match files.get(path) {
        Some(bytes) => parse_from(bytes, format, (path, files), wanted),
        None => parse_from(&read_regular_file(path)?, format, (path, files), wanted),
    }
}

/// Reads a mesh from the bytes of its file. `path` is what messages show, and where MTL files are looked for beside.
///
/// # Errors
/// As [`load`].
pub fn parse(text: &[u8], format: MeshFormat, path: &Path) -> Result<MeshData, MeshError> {
    parse_as(text, format, path, Wanted::default())
}

/// As [`parse`], with what is wanted of it.
///
/// # Errors
/// As [`load`].
pub fn parse_as(text: &[u8], format: MeshFormat, path: &Path, wanted: Wanted<'_>) -> Result<MeshData, MeshError> {
    parse_from(text, format, (path, &Files::default()), wanted)
}

fn parse_from(
    text: &[u8],
    format: MeshFormat,
    from: (&Path, &Files),
    wanted: Wanted<'_>,
) -> Result<MeshData, MeshError> {
    if wanted.part.is_some() && !format.has_parts() {
        return Err(MeshError::NoParts { path: from.0.to_owned(), what: format!("{} files", format.name()) });
    }
    match format {
        MeshFormat::Obj => obj::read(text, from, wanted),
        MeshFormat::Off => off::read(text, from.0, wanted),
        MeshFormat::Ply => ply::read(text, from.0, wanted),
        MeshFormat::Stl => stl::read(text, from.0),
        MeshFormat::Gltf | MeshFormat::Glb => gltf::read(text, from, wanted),
    }
}
