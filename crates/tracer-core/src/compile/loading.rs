//! Where triangles come from: mesh files loaded once each, what the scene writes out itself, shapes that triangles are
//! made for, pictures of heights.

use super::assets::Sources;
use super::polygonal::{Geometry, UnitShape, polygonal};
use super::vertex_colors::Readers;
use rayon::prelude::*;
use scene_format::codes;
use scene_format::desc::{HeightField, MaterialRef};
use scene_format::diagnostic::{Span, Spanned};
use scene_format::{Diagnostic, Diagnostics, SceneDesc};
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::Arc;
use tracer_mesh::shapes::{Triangulated, height_field};
use tracer_mesh::{MeshData, Wanted, mesh_of};

/// The meshes of a scene: its files, what it writes out itself, and the shapes that are made of triangles.
pub struct Loaded {
    /// Each file once, then each mesh of the scene itself, each shape that triangles are made for and each landscape,
    /// those that are alike once, then each unit shape once.
    pub(super) files: Vec<Arc<MeshData>>,
    /// Per object of triangles: its file, or `None` where that could not be loaded.
    pub(super) file_of_object: Vec<Option<usize>>,
}

impl Loaded {
    /// The mesh of an object of triangles, if it could be loaded.
    pub fn file(&self, object: usize) -> Option<&MeshData> {
        self.file_of_object.get(object).copied().flatten().and_then(|file| self.files.get(file)).map(|file| &**file)
    }

    /// Further files that were read: MTL, buffers of glTF.
    pub fn libraries(&self) -> impl Iterator<Item = &PathBuf> {
        self.files.iter().flat_map(|file| &file.libraries)
    }
}

/// Loads every mesh file that the scene names, each once, in parallel; all faults become diagnostics.
// Long: one arm for each way that triangles come into a scene.
pub fn load(desc: &SceneDesc, sources: &Sources<'_>, diagnostics: &mut Diagnostics) -> Loaded {
    let mut paths: Vec<(PathBuf, Span, Option<&Spanned<String>>)> = Vec::new();
    let mut index_of_path: BTreeMap<(PathBuf, Option<&str>), usize> = BTreeMap::new();
    let mut shapes: Vec<UnitShape> = Vec::new();
    let mut inline: Vec<Result<MeshData, Box<Diagnostic>>> = Vec::new();
    let mut made: Vec<(&dyn Triangulated, Span)> = Vec::new();
    let mut fields: Vec<&HeightField> = Vec::new();
    let mut geometry_of_object: Vec<Geometry<usize, usize, usize, usize>> = Vec::new();
    // Whether an object takes the materials of the file: what these say in vain matters only then.
    let mut own_materials: Vec<bool> = Vec::new();
    let (readers, mut wanted) = (Readers::of(desc), Vec::new());
    for object in polygonal(desc) {
        geometry_of_object.push(match object.geometry {
            Geometry::File(file) => {
                let path = desc.base_dir.join(&file.value);
                let part = object.part.map(|part| part.value.as_str());
                let index = *index_of_path.entry((path, part)).or_insert_with_key(|(path, _)| {
                    paths.push((path.clone(), file.span, object.part));
                    own_materials.push(false);
                    wanted.push(Wanted { colors: false, part });
                    paths.len() - 1
                });
                own_materials[index] |= *object.material == MaterialRef::Default;
                wanted[index].colors |= readers.place_of(object.material).is_some();
                Geometry::File(index)
            }
            Geometry::Inline(mesh) => {
                inline.push(mesh_of(&mesh.value, mesh.span));
                Geometry::Inline(inline.len() - 1)
            }
            Geometry::Unit(shape) => {
                if !shapes.contains(&shape) {
                    shapes.push(shape);
                }
                Geometry::Unit(shape)
            }
            Geometry::Made(shape) => {
                made.push((shape, object.span));
                Geometry::Made(made.len() - 1)
            }
            Geometry::Heights(field) => {
                fields.push(field);
                Geometry::Heights(fields.len() - 1)
            }
        });
    }
    let read = |((path, ..), wanted): (&(PathBuf, Span, _), &Wanted<'_>)| sources.mesh(path, *wanted);
    let results: Vec<_> = paths.par_iter().zip(&wanted).map(read).collect();
    let mut files = Vec::new();
    let mut file_of_path = Vec::new();
    let mut of_materials = Diagnostics::new();
    let shown = wanted.iter().map(|wanted| wanted.colors);
    for (((result, (_, span, part)), own), shown) in results.into_iter().zip(&paths).zip(own_materials).zip(shown) {
        match result {
            Ok(data) => {
                for warning in &data.warnings {
                    let mut told = Diagnostic { span: *span, ..warning.clone() };
                    // Here and not with the mesh: only the scene shows them.
                    if !shown && warning.code == codes::MESH_ODDITIES && warning.message.contains(" vertex colour") {
                        told.hint = "the mesh shows the colours of its vertices with `material: Diffuse(albedo: \
                                     VertexColor())`"
                            .to_owned();
                    }
                    if warning.code != codes::MTL_UNSUPPORTED {
                        diagnostics.push(told);
                    } else if own {
                        of_materials.push(told);
                    }
                }
                file_of_path.push(Some(files.len()));
                files.push(data);
            }
            Err(error) => {
                let of_part = part.filter(|part| error.is_of_part() && part.span != Span::NONE);
                diagnostics.push(error.to_diagnostic(of_part.map_or(*span, |part| part.span)));
                file_of_path.push(None);
            }
        }
    }
    diagnostics.extend(as_one(of_materials));
    let made: Vec<_> = made.par_iter().map(|(shape, span)| shape.mesh(*span)).collect();
    let fields = height_fields(desc, sources, &fields, diagnostics);
    let mut known: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    let mut written = |results: Vec<Result<MeshData, Box<Diagnostic>>>| -> Vec<Option<usize>> {
        let file_of = |result| match result {
            Ok(data) => {
                let data: MeshData = data;
                diagnostics.extend(data.warnings.iter().cloned());
                // Pawns of a `Repeat` are one mesh, as copies by `placements` are.
                let alike = known.entry(digest(&data)).or_default();
                if let Some(&file) = alike.iter().find(|&&file| *files[file] == data) {
                    return Some(file);
                }
                alike.push(files.len());
                files.push(Arc::new(data));
                Some(files.len() - 1)
            }
            Err(fault) => {
                let fault: Box<Diagnostic> = fault;
                // What several things are made of is wrong once.
                if !diagnostics.contains(&fault) {
                    diagnostics.push(*fault);
                }
                None
            }
        };
        results.into_iter().map(file_of).collect()
    };
    let (file_of_inline, file_of_made, file_of_field) = (written(inline), written(made), written(fields));
    let first_shape = files.len();
    files.extend(shapes.iter().map(|shape| Arc::new(shape.mesh())));
    let of_geometry = |geometry| match geometry {
        Geometry::File(path) => file_of_path[path],
        Geometry::Inline(mesh) => file_of_inline[mesh],
        Geometry::Made(shape) => file_of_made[shape],
        Geometry::Heights(field) => file_of_field[field],
        Geometry::Unit(shape) => shapes.iter().position(|&s| s == shape).map(|k| first_shape + k),
    };
    Loaded { files, file_of_object: geometry_of_object.into_iter().map(of_geometry).collect() }
}

/// A number that meshes which are alike have in common, and hardly any others.
fn digest(data: &MeshData) -> u64 {
    let mut hasher = DefaultHasher::new();
    data.triangles.hash(&mut hasher);
    // No two positions that are alike differ in the sign of a zero only: the same steps made them.
    data.positions.iter().flatten().for_each(|x| hasher.write_u64(x.to_bits()));
    hasher.finish()
}

/// What is told of the materials of several mesh files, as one warning: a model of a hundred files has one exporter to
/// thank for all of them.
fn as_one(of_materials: Diagnostics) -> Option<Diagnostic> {
    const SHOWN: usize = 3;
    let mut all = of_materials.into_iter();
    let mut first = all.next()?;
    let others: Diagnostics = all.collect();
    match others.len() {
        0 => {}
        1 => first.message += "; the same goes for 1 more mesh file",
        more => first.message += &format!("; the same goes for {more} more mesh files"),
    }
    Some(others.iter().take(SHOWN).fold(first, |first, other| first.label(other.span, "of this one, too")))
}

/// The triangles of height fields. A picture that several of them have is read once, and told of where the first is.
fn height_fields(
    desc: &SceneDesc,
    sources: &Sources<'_>,
    fields: &[&HeightField],
    diagnostics: &mut Diagnostics,
) -> Vec<Result<MeshData, Box<Diagnostic>>> {
    let mut paths: Vec<(PathBuf, Span)> = Vec::new();
    let path_of_field: Vec<usize> = fields
        .iter()
        .map(|field| {
            let path = desc.base_dir.join(&field.file.value);
            paths.iter().position(|(known, _)| *known == path).unwrap_or_else(|| {
                paths.push((path, field.file.span));
                paths.len() - 1
            })
        })
        .collect();
    let read: Vec<_> = paths.par_iter().map(|(path, _)| sources.heights(path)).collect();
    for (landscape, (_, span)) in read.iter().zip(&paths) {
        let warnings = landscape.iter().flat_map(|landscape| &landscape.warnings);
        diagnostics.extend(warnings.map(|w| Diagnostic { span: *span, ..w.clone() }));
    }
    let of_field = |(field, path): (&&HeightField, usize)| match &read[path] {
        Ok(landscape) => height_field(field, &landscape.heights, field.file.span),
        Err(error) => Err(Box::new(error.to_heights_diagnostic(paths[path].1))),
    };
    fields.iter().zip(path_of_field).map(of_field).collect()
}
