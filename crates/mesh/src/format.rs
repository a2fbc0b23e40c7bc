//! The formats of meshes, by name and extension.

use std::path::Path;

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
    /// glTF 2.0 as text, with buffers beside it or within.
    Gltf,
    /// glTF 2.0 in its binary container.
    Glb,
}

impl MeshFormat {
    /// All there are: what else asks about formats of meshes asks these.
    pub const ALL: [MeshFormat; 6] =
        [MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply, MeshFormat::Stl, MeshFormat::Gltf, MeshFormat::Glb];

    /// Name and extension.
    const fn entry(self) -> (&'static str, &'static str) {
        match self {
            MeshFormat::Obj => ("OBJ", "obj"),
            MeshFormat::Off => ("OFF", "off"),
            MeshFormat::Ply => ("PLY", "ply"),
            MeshFormat::Stl => ("STL", "stl"),
            MeshFormat::Gltf => ("glTF", "gltf"),
            MeshFormat::Glb => ("GLB", "glb"),
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

    /// Whether its files have parts with names.
    pub const fn has_parts(self) -> bool {
        matches!(self, MeshFormat::Obj | MeshFormat::Gltf | MeshFormat::Glb)
    }

    /// All formats in words: `OBJ, OFF or STL`.
    pub(crate) fn list(word: impl Fn(MeshFormat) -> String) -> String {
        let words = Self::ALL.map(word);
        match &words[..] {
            [others @ .., last] if !others.is_empty() => format!("{} or {last}", others.join(", ")),
            _ => words.concat(),
        }
    }
}
