//! Triangle meshes, from files or written out.

use super::Placements;
use super::inline_mesh::{Colors, InlineMesh, Points, Written, WrittenFaces};
use crate::codes;
use crate::desc::name::text_of_name;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform};
use crate::diagnostic::{Diagnostic, Spanned};
use crate::files::FileKind;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Told, Words, scene_struct, scene_words};
use std::path::Path;
use std::sync::Arc;

/// A triangle mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Its triangles.
    pub source: MeshSource,
    /// Of a file only this part.
    pub part: Part,
    /// Its material.
    pub material: MaterialRef,
    /// Transforms, applied first to last.
    pub transform: Vec<Spanned<Transform>>,
    /// Copies.
    pub placements: Placements,
    /// Whether copies share one tree of triangles.
    pub instances: Instances,
    /// Whether normals are interpolated.
    pub shading: Shading,
    /// Whether the camera sees it.
    pub camera_visible: bool,
    /// What it is called.
    pub name: Name,
}

/// Where the triangles of a mesh come from.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshSource {
    /// A file, relative to the scene file.
    File(Spanned<Arc<Path>>),
    /// The scene itself; the place is that of its points.
    Inline(Arc<Spanned<InlineMesh>>),
}

impl Mesh {
    /// The file that it comes from, if it does.
    pub fn file(&self) -> Option<&Spanned<Arc<Path>>> {
        match &self.source {
            MeshSource::File(file) => Some(file),
            MeshSource::Inline(_) => None,
        }
    }
}

scene_struct! {
    /// A triangle mesh, from a file or written out as `points` and `faces`.
    pub(crate) struct MeshWords as "Mesh", "a mesh", exactly one of [file, points] {
        /// OBJ, OFF, PLY, STL, glTF or GLB file, relative to the scene file. Of glTF the triangles of the default scene
        /// are taken, where its nodes place them, with its materials and pictures, and the colours of its vertices
        /// where a `VertexColor` reads them; its lights, cameras, skins, morph targets and animations are not.
        file: WrittenFile = WrittenFile::default() => Rule::file(FileKind::Mesh);
        /// With `file`: only this part of it, as if the file held nothing else. In OBJ the faces of objects (`o`) and
        /// groups (`g`) of this name, in glTF nodes, with all that is below them, and meshes of this name; all of them
        /// where several have it. It stays where the file has it. Other formats have no parts.
        part: Part = Part::default();
        /// Instead of a file: the points of the mesh, three or more.
        points: Points = Points::default() => Rule::point();
        /// With `points`: the faces, each the numbers of three or more points, counted from 0, counterclockwise seen
        /// from outside. Faces of more than three corners are cut into triangles, also where they are not convex.
        faces: WrittenFaces = WrittenFaces::default();
        /// With `points`: a colour for each of them, which a `VertexColor` of the material shows. Numbers are linear,
        /// or sRGB, as matplotlib gives them, with `VertexColor(color_space: Srgb)`.
        colors: Colors = Colors::default();
        /// Its material, by name or written here; without one those of the file (the MTL of OBJ, glTF's own), else
        /// `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the
        /// name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Whether copies share one tree of triangles, those of other objects with the same file and shading among
        /// them.
        instances: Instances = Instances::Auto;
        /// Whether normals are interpolated.
        shading: Shading = Shading::Auto;
        /// Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows,
        /// shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
        name: Name = Name::default();
    }
}

impl Told for Mesh {
    const ALSO: &'static [&'static str] =
        &["obj", "off", "ply", "stl", "gltf", "glb", "trianglemesh", "plymesh", "objmesh", "mesh2", "model", "shape"];
    const EXAMPLE: &'static str =
        "Mesh(file: \"tetrahedron.off\", placements: [[Translate((-1.5, 0, 0))], [Translate((1.5, 0, 0))]])";
}

impl ShapeWords for Mesh {
    const MANY: &'static str = "meshes";

    fn named_file(&self) -> Option<&Spanned<Arc<Path>>> {
        self.file()
    }
}

impl Faulty for Mesh {}

/// The name of a part of a file, if one is wanted alone. Eight bytes long.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Part(Option<Box<Spanned<String>>>);

impl Part {
    /// The name, and where it is written; `None`: the whole file.
    pub fn name(&self) -> Option<&Spanned<String>> {
        self.0.as_deref()
    }
}

impl<T: Into<String>> From<Option<T>> for Part {
    fn from(name: Option<T>) -> Self {
        Part(name.map(|name| Box::new(name.into().into())))
    }
}

impl Words for Part {
    const TYPE: Type = Type::Optional(&Type::Text);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if item.is_word("None") {
            return Some(Part::default());
        }
        let item = item.without_some();
        let span = item.span();
        let value = text_of_name(reader, item, at)?.into_owned();
        Some(Part(Some(Box::new(Spanned { value, span }))))
    }

    fn form(&self, _all: bool) -> Form {
        self.name().map_or(Form::word("None"), |name| Form::Text(name.value.clone()))
    }
}

/// What `file` holds; nothing where it is not written.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct WrittenFile(Option<Spanned<Arc<Path>>>);

impl Words for WrittenFile {
    const TYPE: Type = Type::File;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        <Spanned<Arc<Path>>>::read(reader, item, at).map(|file| WrittenFile(Some(file)))
    }

    fn form(&self, all: bool) -> Form {
        self.0.as_ref().map_or(Form::Absent, |file| file.form(all))
    }
}

impl Words for Mesh {
    const TYPE: Type = MeshWords::TYPE;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        reader.points = None;
        let words = MeshWords::read(reader, item, at)?;
        let MeshWords { file, part, points, faces, colors, material, transform, placements, .. } = words;
        let MeshWords { instances, shading, camera_visible, name, .. } = words;
        let colors = match colors.0 {
            Written::Not => Vec::new(),
            Written::Wrong => return None,
            Written::As(colors) if file.0.is_some() => {
                let message = "a mesh has both `file` and `colors`";
                reader.report(
                    Diagnostic::error(codes::EXACTLY_ONE, colors.span, message)
                        .expected("`colors` with `points` and `faces`; a file has its own"),
                );
                return None;
            }
            Written::As(colors) => colors.value,
        };
        if let (None, Written::As(_), Some(name)) = (&file.0, &points.0, part.name()) {
            reader.report(
                Diagnostic::error(codes::NO_USE, name.span, "a mesh has both `points` and `part`")
                    .expected("`part` with `file`: the name of an object, a group or a node in it"),
            );
            return None;
        }
        let source = match (file.0, points.0, faces.0) {
            (Some(file), Written::Not, Written::Not) => MeshSource::File(file),
            (Some(_), Written::Not, Written::As(faces)) => {
                let message = "a mesh has both `file` and `faces`";
                reader.report(
                    Diagnostic::error(codes::EXACTLY_ONE, faces.span, message)
                        .expected("either `file`, or `points` and `faces`"),
                );
                return None;
            }
            (None, Written::As(points), Written::As(faces)) => {
                let span = points.span;
                let value = InlineMesh { points: points.value, faces: faces.value, colors };
                MeshSource::Inline(Arc::new(Spanned { value, span }))
            }
            // What could not be read may have been the faces.
            (None, Written::As(_), Written::Not) if item.is_damaged() => return None,
            (None, Written::As(points), Written::Not) => {
                reader.report(
                    Diagnostic::error(codes::MISSING_FIELD, points.span, "a mesh of points needs the field `faces`")
                        .expected("faces, each the numbers of three or more points: [[0, 1, 2]]"),
                );
                return None;
            }
            // None was written, two were, or one is wrong: reported.
            _ => return None,
        };
        Some(Mesh { source, part, material, transform, placements, instances, shading, camera_visible, name })
    }

    fn form(&self, all: bool) -> Form {
        let mut words = MeshWords {
            file: WrittenFile::default(),
            part: self.part.clone(),
            points: Points::default(),
            faces: WrittenFaces::default(),
            colors: Colors::default(),
            material: self.material.clone(),
            transform: self.transform.clone(),
            placements: self.placements.clone(),
            instances: self.instances,
            shading: self.shading,
            camera_visible: self.camera_visible,
            name: self.name.clone(),
        };
        match &self.source {
            MeshSource::File(file) => words.file = WrittenFile(Some(file.clone())),
            MeshSource::Inline(mesh) => {
                let InlineMesh { points, faces, colors } = &mesh.value;
                words.points = Points(Written::As(points.clone().into()));
                words.faces = WrittenFaces(Written::As(faces.clone().into()));
                if !colors.is_empty() {
                    words.colors = Colors(Written::As(colors.clone().into()));
                }
            }
        }
        words.form(all)
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
        /// As `Never` where there are at most 1024 copies and they have 262144 triangles together at most; else as
        /// `Always`.
        Auto,
        /// They do: a further copy takes 64 bytes, whatever the mesh. Rays take up to a third longer.
        Always,
        /// Each copy has its own triangles in the scene's one tree, 80 to 130 bytes each: the fastest rays.
        Never,
    }
}
