//! Triangle meshes from files.

use super::Placements;
use crate::desc::{MaterialRef, Name, Transform};
use crate::diagnostic::Spanned;
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{scene_struct, scene_words};
use std::path::Path;
use std::sync::Arc;

scene_struct! {
    /// A triangle mesh.
    pub struct Mesh as "Mesh", "a mesh" {
        /// OBJ, OFF, PLY or STL file, relative to the scene file.
        file: Spanned<Arc<Path>> => Rule::file(FileKind::Mesh);
        /// Its material, by name or written here; without one what the file's MTL says, else `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a
        /// placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Whether copies share one tree of triangles, those of other objects with the same file and shading among them.
        instances: Instances = Instances::Auto;
        /// Whether normals are interpolated.
        shading: Shading = Shading::Auto;
        /// What it is called: `--set objects.NAME.radius=2` finds it where no other has this name.
        name: Name = Name::default();
    }
}

scene_words! {
    /// Whether normals are interpolated over triangles (Phong smoothing).
    pub enum Shading, "shading" {
        /// Smooth when the file has vertex normals, else flat.
        Auto,
        /// Smooth: by the file's vertex normals, or by area- and angle-weighted ones where it has none.
        Smooth,
        /// Flat: the triangles' own normals.
        Flat,
    }
}

scene_words! {
    /// Whether copies of a mesh share its triangles. The picture is the same but for rounding.
    pub enum Instances, "instances" {
        /// As `Never` where there are at most 1024 copies and they have 262144 triangles together at most; else as `Always`.
        Auto,
        /// They do: a further copy takes 64 bytes, whatever the mesh. Rays take up to a third longer.
        Always,
        /// Each copy has its own triangles in the scene's one tree, 80 to 130 bytes each: the fastest rays.
        Never,
    }
}
