//! Scenes that compile and are surely not meant: a picture on a mesh that has no place for it, glass that is inside
//! out, light that is turned away.

use super::bodies::{is_closed, open_edges};
use super::curved::Curved;
use super::meshes::Loaded;
use super::out_of_view::mesh_brought;
use super::placed::Placed;
use super::polygonal::{Geometry, UnitShape, polygonal};
use glam::{DAffine3, DVec3};
use scene_format::desc::{Albedo, Material, MaterialRef};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::BTreeMap;
use tracer_kernels::scene::{Camera, Frame, Projection};
use tracer_kernels::shapes;
use tracer_mesh::MeshData;

/// More pairs of a lamp and another object than this are not looked at.
const MOST_PAIRS: usize = 1_000_000;

/// Marks are of that many copies only.
const MOST_MARKED: usize = 1024;

/// Whether a mesh of glass has holes is not looked at beyond so many triangles: it takes as long as they are many.
const MOST_OF_GLASS: usize = 300_000;

/// Warns of all of it.
pub fn warn(desc: &SceneDesc, loaded: &Loaded, placed: &Placed, curved: &[Curved], diagnostics: &mut Diagnostics) {
    let materials: BTreeMap<&str, &Material> =
        desc.materials.iter().map(|named| (&*named.name.value, &named.material)).collect();
    for (k, object) in polygonal(desc).enumerate() {
        let span = match object.geometry {
            Geometry::File(file) => file.span,
            Geometry::Inline(mesh) => mesh.span,
            Geometry::Unit(_) | Geometry::Made(_) | Geometry::Heights(_) => continue,
        };
        let Some(data) = loaded.file(k) else { continue };
        let material = material_of(&materials, object.material);
        let own = matches!(object.material, MaterialRef::Default);
        let pictured =
            material.is_some_and(wants_uv) || own && data.materials.iter().any(|named| wants_uv(&named.material));
        let inline = matches!(object.geometry, Geometry::Inline(_));
        if pictured && data.uvs.is_empty() {
            // A material of the file has no `mapping` to write, and a mesh that is written out no coordinates.
            let way = if inline {
                "write `mapping: Triplanar()` in the texture, which needs none"
            } else if own {
                "export the mesh with UVs, or give it a material with `mapping: Triplanar()` in its texture"
            } else {
                "write `mapping: Triplanar()` in the texture, which needs none, or export the mesh with UVs"
            };
            diagnostics.push(
                Diagnostic::warning(codes::NO_COORDINATES, span, "the mesh has a texture and no texture coordinates")
                    .expected(match inline {
                        true => "a texture whose `mapping` needs no texture coordinates, which meshes written out lack",
                        false => "texture coordinates in the mesh file (`vt` in OBJ)",
                    })
                    .hint(format!("one colour of the texture is all that shows: {way}")),
            );
        }
        if !material.is_some_and(Material::transmits) {
            continue;
        }
        if data.triangles.len() <= MOST_OF_GLASS {
            diagnostics.extend(open_glass(data, span));
        }
        // The outside of a mirrored mesh stays outside.
        if is_inside_out(data) {
            diagnostics.push(
                Diagnostic::warning(
                    codes::INSIDE_OUT,
                    span,
                    "this glass is inside out: its faces are wound the other way",
                )
                .expected("faces whose corners go round counterclockwise, seen from outside")
                .hint(match inline {
                    true => "turn the numbers of each face round: [0, 2, 1] for [0, 1, 2]",
                    false => "flip its faces and export it again: in Blender Mesh > Normals > Recalculate Outside",
                }),
            );
        }
    }
    turned_away(desc, placed, curved, &materials, diagnostics);
    disks_turned_away(desc, placed, curved, diagnostics);
}

/// A view of which a pixel is smaller than the steps of single precision, where the camera stands or looks.
pub fn far_view(desc: &SceneDesc, camera: &Camera, frame: &Frame, diagnostics: &mut Diagnostics) {
    let target = frame.point(DVec3::from(desc.camera.look_at.value));
    let distance = (target - camera.eye).length();
    // Height of a pixel at what is looked at, in render units.
    let height = match camera.projection {
        Projection::Perspective { .. } => distance * 2.0 * camera.up.length(),
        Projection::Orthographic => 2.0 * camera.up.length(),
        Projection::Panorama | Projection::Fisheye { .. } => return,
    };
    let pixel = height / f64::from(desc.image.height.value);
    let step = camera.eye.abs().max_element().max(target.abs().max_element()) * f64::from(f32::EPSILON) / 2.0;
    if pixel < step {
        let steps = step / pixel;
        let mesh = mesh_brought(desc, camera, frame).map_or(String::new(), |steps| format!(", a mesh by {steps}"));
        diagnostics.push(
            Diagnostic::warning(
                codes::FAR_VIEW,
                desc.camera.position.span,
                format!("the view is so far and so narrow that single precision shows: in steps of {steps:.0} pixels"),
            )
            .expected("a camera nearer to what it looks at")
            .hint(format!("bring the camera nearer, with a wider `fov`, or the objects nearer to the camera{mesh}")),
        );
    }
}

/// Whether all objects have so few copies that all of them are looked at.
fn is_few(placed: &Placed, curved: &[Curved]) -> bool {
    placed.maps.iter().chain(curved.iter().map(|object| &object.maps)).all(|maps| maps.len() <= MOST_MARKED)
}

/// Rectangles that shine to one side, where there is nothing.
fn turned_away(
    desc: &SceneDesc,
    placed: &Placed,
    curved: &[Curved],
    materials: &BTreeMap<&str, &Material>,
    diagnostics: &mut Diagnostics,
) {
    let is_few = is_few(placed, curved);
    const CORNERS: [DVec3; 4] = [
        DVec3::new(-0.5, -0.5, 0.0),
        DVec3::new(0.5, -0.5, 0.0),
        DVec3::new(0.5, 0.5, 0.0),
        DVec3::new(-0.5, 0.5, 0.0),
    ];
    let polygonal_count = placed.maps.len();
    let mut left = MOST_PAIRS;
    let eye = DVec3::from(desc.camera.position.value);
    for (k, object) in polygonal(desc).enumerate() {
        if !is_few || !matches!(object.geometry, Geometry::Unit(UnitShape::Square)) {
            continue;
        }
        let emissive = material_of(materials, object.material).and_then(Material::shines);
        if emissive.is_none_or(|emissive| emissive.two_sided) {
            continue;
        }
        let is_turned_away = |map: &DAffine3| {
            let [right, up] = [map.matrix3.x_axis, map.matrix3.y_axis];
            let (normal, center) = (right.cross(up).normalize_or_zero(), map.translation);
            // In front by more than rounding.
            let least = 1e-6 * (right.length() + up.length() + center.length());
            let in_front = |p: DVec3| normal.dot(p - center) > least;
            let far = center + normal * 1e12;
            let others = (0..polygonal_count).filter(|&other| other != k).flat_map(|other| placed.marks_of(other, far));
            // A box about what is tilted sticks out in front of it: of its own copies the corners count.
            let own = placed.maps_of(k).iter().flat_map(|map| CORNERS.map(|corner| map.transform_point3(corner)));
            let mut all = others.chain(own).chain(curved.iter().flat_map(|object| object.marks(far)));
            // Which side is the front of what is mirrored is not asked.
            map.matrix3.determinant() > 0.0 && !in_front(eye) && !all.any(in_front)
        };
        let maps = placed.maps_of(k);
        // Each looks at all others.
        let others = desc.objects.len().saturating_mul(maps.len());
        if others > left {
            return;
        }
        left -= others;
        if !maps.is_empty() && maps.iter().all(is_turned_away) {
            diagnostics.push(unseen_light(object.number, object.span));
        }
    }
}

fn unseen_light(number: u32, span: Span) -> Diagnostic {
    let message = format!("objects[{number}] shines to where nothing is: nobody sees its light");
    Diagnostic::warning(codes::UNSEEN_LIGHT, span, message)
        .expected("an object, or the camera, before its front")
        .hint("turn it round (the other `normal`), or let it shine to both sides: `two_sided: true`")
}

/// Disks that shine to one side, where there is nothing.
fn disks_turned_away(desc: &SceneDesc, placed: &Placed, curved: &[Curved], diagnostics: &mut Diagnostics) {
    let polygonal_count = placed.maps.len();
    let is_few = is_few(placed, curved);
    let mut left = MOST_PAIRS;
    let eye = DVec3::from(desc.camera.position.value);
    for (k, object) in curved.iter().enumerate() {
        let is_lamp = object.emissive.as_ref().is_some_and(|emissive| !emissive.two_sided);
        let others = desc.objects.len().saturating_mul(object.maps.len());
        if !is_lamp || !matches!(object.unit, shapes::UnitShape::Disk { .. }) || !is_few || others > left {
            continue;
        }
        left -= others;
        let is_turned_away = |map: &DAffine3| {
            let normal = (map.matrix3.inverse().transpose() * DVec3::Z).normalize_or_zero();
            let center = map.translation;
            // In front by more than rounding.
            let least = 1e-9 * (map.matrix3.x_axis.length() + map.matrix3.y_axis.length() + center.length());
            let in_front = |p: DVec3| normal.dot(p - center) > least;
            let far = center + normal * 1e12;
            let flat = (0..polygonal_count).flat_map(|other| placed.marks_of(other, far));
            let round = curved.iter().enumerate().filter(|(other, _)| *other != k);
            let mut all = flat.chain(round.flat_map(|(_, object)| object.marks(far)));
            // Of its own copies the highest points.
            let height = |own: &DAffine3| {
                object.unit.reach(own.matrix3.transpose() * normal) + normal.dot(own.translation - center)
            };
            !in_front(eye) && !object.maps.iter().any(|own| height(own) > least) && !all.any(in_front)
        };
        if !object.maps.is_empty() && object.maps.iter().all(is_turned_away) {
            let span = desc.objects.get(object.number as usize).map_or(Span::NONE, |object| object.span);
            diagnostics.push(unseen_light(object.number, span));
        }
    }
}

/// The material that an object names or has; `None` for the default and those of its file.
pub(super) fn material_of<'d>(
    materials: &BTreeMap<&str, &'d Material>,
    reference: &'d MaterialRef,
) -> Option<&'d Material> {
    match reference {
        MaterialRef::Default => None,
        MaterialRef::Named { name, .. } => materials.get(&**name).copied(),
        MaterialRef::Inline(material) => Some(&material.value),
    }
}

/// A mesh whose own file says that parts of it shine, in too many copies for each to have triangles of its own.
pub fn unlit(span: Span) -> Diagnostic {
    let message = "this mesh's own materials shine, but its many copies share their triangles: none of them shines";
    Diagnostic::warning(codes::MTL_UNSUPPORTED, span, message)
        .expected("lamps as objects of their own, with `material: Emissive(radiance: ..)`")
        .hint("with `instances: Never` each copy has triangles of its own, and shines")
}

/// Whether a material has another colour at another place of a surface's texture coordinates.
fn wants_uv(material: &Material) -> bool {
    material.varying().into_iter().any(Albedo::wants_uv)
}

/// A mesh of glass that has holes.
fn open_glass(data: &MeshData, span: Span) -> Option<Diagnostic> {
    let open = open_edges(data);
    let edges = if open == 1 { "one edge has".to_owned() } else { format!("{open} edges have") };
    (open > 0).then(|| {
        Diagnostic::warning(
            codes::OPEN_GLASS,
            span,
            format!("glass of an open mesh has no inside: {edges} no face, or one wound against it, on the other side"),
        )
        .expected("a closed mesh: a ray is bent by glass on its way in, and back on its way out")
        .hint("close its holes, and give what is thin a thickness; in Blender Select > All by Trait > Non Manifold")
    })
}

/// Whether a closed mesh has its inside outside: a negative volume.
fn is_inside_out(data: &MeshData) -> bool {
    let corner = |k: u32| data.positions.get(k as usize).map_or(DVec3::ZERO, |p| DVec3::from(*p));
    let about = DVec3::from(data.barycentre());
    let of_one = |&[a, b, c]: &[u32; 3]| (corner(a) - about).dot((corner(b) - about).cross(corner(c) - about));
    let volume: f64 = data.triangles.iter().map(of_one).sum();
    volume < 0.0 && is_closed(data)
}
