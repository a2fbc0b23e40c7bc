//! Colours of vertices: which meshes must have them, and as the engine reads them.

use super::loading::Loaded;
use super::meshes::Built;
use super::polygonal::{Geometry, polygonal};
use rayon::prelude::*;
use scene_format::desc::{MaterialRef, Object, with_operands};
use scene_format::diagnostic::{Span, Spanned};
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use tracer_kernels::scene::{Coded, ColorTable, Made, MeshColors, Program, VertexSpace};
use tracer_kernels::srgb::linear_of_srgb;
use tracer_mesh::{ColorValues, VertexColors};

/// Which materials read the colours of vertices.
pub struct Readers<'d> {
    named: BTreeSet<&'d str>,
}

impl<'d> Readers<'d> {
    /// Of a scene.
    pub fn of(desc: &'d SceneDesc) -> Self {
        let reads = desc.materials.iter().filter(|named| named.material.reads_vertex_colors());
        Readers { named: reads.map(|named| &*named.name.value).collect() }
    }

    /// Where the material of an object stands, if it reads them.
    pub fn place_of(&self, material: &MaterialRef) -> Option<Span> {
        match material {
            MaterialRef::Default => None,
            MaterialRef::Named { name, span } => self.named.contains(&**name).then_some(*span),
            MaterialRef::Inline(inline) => inline.value.reads_vertex_colors().then_some(inline.span),
        }
    }
}

/// Objects whose material reads colours that they do not have. Of the same material on the same file, or on shapes of
/// the same kind, the first is told.
pub fn check<'d>(desc: &'d SceneDesc, loaded: &Loaded, diagnostics: &mut Diagnostics) {
    let readers = Readers::of(desc);
    let mut known: BTreeSet<(Option<&str>, Span, String)> = BTreeSet::new();
    let mut told = |object: &'d Spanned<Object>, fault: Option<Diagnostic>| {
        let material = object.value.material();
        let (Some(at), Some(fault)) = (readers.place_of(material), fault) else { return };
        let (name, place) = match material {
            MaterialRef::Named { name, .. } => (Some(&**name), Span::NONE),
            _ => (None, at),
        };
        if known.insert((name, place, fault.message.clone())) {
            diagnostics.push(if at == fault.span { fault } else { fault.label(at, "its material shows them") });
        }
    };
    for (number, object) in polygonal(desc).enumerate() {
        let of_scene = &desc.objects[object.number as usize];
        let lacks = loaded.file(number).is_some_and(|mesh| mesh.colors.is_none());
        match object.geometry {
            Geometry::File(file) => told(of_scene, lacks.then(|| of_file(&file.value, file.span))),
            Geometry::Inline(mesh) => told(of_scene, lacks.then(|| of_points(mesh.span))),
            _ => {}
        }
    }
    for object in with_operands(&desc.objects).filter(|object| !matches!(&object.value, Object::Mesh(_))) {
        told(object, Some(of_shape(object)));
    }
}

fn of_file(file: &Path, at: Span) -> Diagnostic {
    let message = format!("the mesh {} has no colours of vertices, and its material shows them", file.display());
    let is_stl = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("stl"));
    let hint = if is_stl {
        "STL has none: export the mesh as PLY or GLB"
    } else {
        "export the mesh with its colours, or give it a material without `VertexColor`"
    };
    let expected = "`v x y z r g b` of OBJ, `COFF`, `red green blue` of PLY, or `COLOR_0` of glTF";
    Diagnostic::error(codes::NO_VERTEX_COLORS, at, message).expected(expected).hint(hint)
}

fn of_points(at: Span) -> Diagnostic {
    let message = "the mesh has no `colors`, and its material shows them";
    let fault = Diagnostic::error(codes::NO_VERTEX_COLORS, at, message).expected("a colour for each of its `points`");
    fault.hint("write `colors: [..]` beside them, or give it a material without `VertexColor`")
}

fn of_shape(object: &Spanned<Object>) -> Diagnostic {
    let message = format!("a `{}` has no vertices with colours, and its material shows them", object.value.kind());
    let fault = Diagnostic::error(codes::NO_VERTEX_COLORS, object.span, message).expected("`VertexColor` on a `Mesh`");
    fault.hint("give it a material of another texture")
}

/// The colours of vertices that textures read.
pub fn table(programs: &[Program], loaded: &Loaded, built: &Built) -> ColorTable {
    let ops = programs.iter().flat_map(|program| &program.ops);
    let spaces: BTreeSet<VertexSpace> =
        ops.filter_map(|op| if let Made::VertexColor(space) = op.made { Some(space) } else { None }).collect();
    let mut words = Words::default();
    let mut of_meshes: [Vec<Option<MeshColors>>; 3] = Default::default();
    for space in spaces {
        let of_mesh = |&(file, first_vertex): &(usize, u32)| {
            let colors = loaded.files.get(file)?.colors.as_ref()?;
            let (coded, first_word) = words.of(file, colors, space);
            Some(MeshColors { coded, first_word, first_vertex })
        };
        if let Some(meshes) = of_meshes.get_mut(space as usize) {
            *meshes = built.vertices_of.iter().map(of_mesh).collect();
        }
    }
    if of_meshes.iter().all(Vec::is_empty) {
        return ColorTable::default();
    }
    ColorTable::new(words.words, of_meshes, &built.instances())
}

/// Colours of files, each once for each way that they stand.
#[derive(Default)]
struct Words {
    words: Vec<u32>,
    /// By file, and whether floats were decoded from sRGB.
    known: BTreeMap<(usize, bool), u32>,
}

impl Words {
    /// How the colours of a file stand, and where.
    fn of(&mut self, file: usize, colors: &VertexColors, space: VertexSpace) -> (Coded, u32) {
        let is_srgb = match space {
            VertexSpace::AsFile => colors.is_srgb,
            VertexSpace::Srgb => true,
            VertexSpace::Linear => false,
        };
        let next = self.words.len() as u32;
        match &colors.values {
            ColorValues::Bytes(bytes) => {
                let first = *self.known.entry((file, false)).or_insert(next);
                if first == next {
                    self.words.extend_from_slice(bytes);
                }
                (if is_srgb { Coded::Srgb8 } else { Coded::Linear8 }, first)
            }
            ColorValues::Numbers(numbers) => {
                let first = *self.known.entry((file, is_srgb)).or_insert(next);
                if first == next {
                    let light = |x: f32| if is_srgb { linear_of_srgb(f64::from(x)) as f32 } else { x };
                    let bits = |color: &[f32; 3]| color.map(|x| light(x).to_bits());
                    let words: Vec<[u32; 3]> = numbers.par_iter().map(bits).collect();
                    self.words.extend_from_slice(words.as_flattened());
                }
                (Coded::Floats, first)
            }
        }
    }
}
