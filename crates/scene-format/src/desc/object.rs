//! Objects: spheres and meshes.

use super::{MaterialRef, Transform, Vec3};
use crate::diagnostic::Spanned;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::{Item, Kind};
use crate::words::{Words, scene_enum, scene_struct, scene_words};
use std::path::PathBuf;

scene_enum! {
    /// A thing in the scene.
    pub enum Object, "object" {
        /// A sphere.
        Sphere(Sphere);
        /// A triangle mesh from a file.
        Mesh(Mesh);
    }
}

scene_struct! {
    /// A sphere.
    pub struct Sphere as "Sphere", "a sphere" {
        /// Centre.
        center: Spanned<Vec3> => Rule::point();
        /// Radius.
        radius: Spanned<f64> => Rule::length("a length");
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
    }
}

scene_struct! {
    /// A triangle mesh.
    pub struct Mesh as "Mesh", "a mesh" {
        /// OFF or OBJ file, relative to the scene file.
        file: Spanned<PathBuf>;
        /// Its material, by name or written here; without one what the file's MTL says, else `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a
        /// placements file, one placement a line.
        placements: Placements = Placements::One;
        /// Whether normals are interpolated.
        shading: Shading = Shading::Auto;
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

/// Many copies of one mesh.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum Placements {
    /// One copy, where `transform` puts it.
    #[default]
    One,
    /// Copies, each with its own transforms (about the origin of the scene unless they say `about`).
    List(Vec<Vec<Spanned<Transform>>>),
    /// A text file of placements, one a line, relative to the scene file.
    File(Spanned<PathBuf>),
}

impl Words for Placements {
    const TYPE: Type = Type::OneOf(&[Type::List(&Type::List(&Transform::TYPE)), Type::File]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        match item.kind() {
            Kind::Text => <Spanned<PathBuf>>::read(reader, item, at).map(Placements::File),
            Kind::List => {
                let list = <Vec<Vec<Spanned<Transform>>>>::read(reader, item, at)?;
                Some(if list.is_empty() { Placements::One } else { Placements::List(list) })
            }
            _ => reader.wrong_type(item, at, "a list of lists of transforms, or the name of a placements file"),
        }
    }

    fn form(&self, all: bool) -> Form {
        match self {
            Placements::One => Form::List(Vec::new()),
            Placements::List(list) => list.form(all),
            Placements::File(file) => file.form(all),
        }
    }
}
