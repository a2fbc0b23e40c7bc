//! Scenes that compile and are surely not meant: a picture on a mesh that has no place for it, glass that is inside
//! out, a camera or a lamp shut in an opaque object.

use super::curved::Curved;
use super::meshes::{Assigned, Loaded, Placed};
use super::polygonal::{Geometry, UnitShape, polygonal};
use glam::{DAffine3, DVec3};
use scene_format::desc::{Albedo, Integrator, Light, Material, MaterialRef, Object};
use scene_format::diagnostic::{Span, Spanned};
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::BTreeMap;
use tracer_kernels::scene::{Camera, Frame, Projection};
use tracer_kernels::shapes;
use tracer_mesh::MeshData;

/// More copies of an object than this are not looked at: millions of them must not take their time twice.
const MOST_COPIES: usize = 10_000;

/// More pairs of a solid and a lamp than this neither.
const MOST_PAIRS: usize = 10_000_000;

/// Marks are of that many copies only.
const MOST_MARKED: usize = 1024;

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
        if pictured && data.uvs.is_empty() {
            // A material of the file has no `mapping` to write.
            let way = if own {
                "export the mesh with UVs, or give it a material with `mapping: Triplanar()` in its texture"
            } else {
                "write `mapping: Triplanar()` in the texture, which needs none, or export the mesh with UVs"
            };
            diagnostics.push(
                Diagnostic::warning(codes::NO_COORDINATES, span, "the mesh has a texture and no texture coordinates")
                    .expected("texture coordinates in the mesh file (`vt` in OBJ)")
                    .hint(format!("one colour of the texture is all that shows: {way}")),
            );
        }
        // The outside of a mirrored mesh stays outside.
        if material.is_some_and(Material::transmits) && is_inside_out(data) {
            diagnostics.push(
                Diagnostic::warning(
                    codes::INSIDE_OUT,
                    span,
                    "this glass is inside out: its faces are wound the other way",
                )
                .expected("faces whose corners go round counterclockwise, seen from outside")
                .hint("flip its faces and export it again: in Blender Mesh > Normals > Recalculate Outside"),
            );
        }
    }
    shut_in(desc, placed, curved, &materials, diagnostics);
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
        diagnostics.push(
            Diagnostic::warning(
                codes::FAR_VIEW,
                desc.camera.position.span,
                format!("the view is so far and so narrow that single precision shows: in steps of {steps:.0} pixels"),
            )
            .expected("a camera nearer to what it looks at")
            .hint("bring the camera nearer, with a wider `fov`, or the objects nearer to the camera"),
        );
    }
}

/// Rectangles that shine to one side, where there is nothing.
fn turned_away(
    desc: &SceneDesc,
    placed: &Placed,
    curved: &[Curved],
    materials: &BTreeMap<&str, &Material>,
    diagnostics: &mut Diagnostics,
) {
    let is_few = polygonal(desc).enumerate().all(|(k, _)| placed.maps_of(k).len() <= MOST_MARKED)
        && curved.iter().all(|object| object.maps.len() <= MOST_MARKED);
    const CORNERS: [DVec3; 4] = [
        DVec3::new(-0.5, -0.5, 0.0),
        DVec3::new(0.5, -0.5, 0.0),
        DVec3::new(0.5, 0.5, 0.0),
        DVec3::new(-0.5, 0.5, 0.0),
    ];
    let polygonal_count = polygonal(desc).count();
    let mut left = MOST_PAIRS / 10;
    let eye = DVec3::from(desc.camera.position.value);
    for (k, object) in polygonal(desc).enumerate() {
        let emissive = material_of(materials, object.material).and_then(Material::shines);
        let is_lamp = emissive.is_some_and(|emissive| !emissive.two_sided);
        let is_flat = matches!(object.geometry, Geometry::Unit(UnitShape::Square));
        if !is_lamp || !is_flat || !is_few {
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
    let polygonal_count = polygonal(desc).count();
    let is_few = (0..polygonal_count).all(|k| placed.maps_of(k).len() <= MOST_MARKED)
        && curved.iter().all(|object| object.maps.len() <= MOST_MARKED);
    let mut left = MOST_PAIRS / 10;
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
fn material_of<'d>(materials: &BTreeMap<&str, &'d Material>, reference: &'d MaterialRef) -> Option<&'d Material> {
    match reference {
        MaterialRef::Default => None,
        MaterialRef::Named { name, .. } => materials.get(&**name).copied(),
        MaterialRef::Inline(material) => Some(&material.value),
    }
}

/// Warns where there is no light, as far as only the files of meshes could tell: the reader has told of all others.
pub fn no_light(desc: &SceneDesc, assigned: &Assigned, diagnostics: &mut Diagnostics) {
    let of_files = desc.objects.iter().any(|object| object.value.has_materials_of_file());
    let dark = desc.lights.is_empty() && desc.background.is_black() && !assigned.shines_by_file();
    let inline = |object: &Spanned<Object>| match object.value.material() {
        MaterialRef::Inline(material) => material.value.shines().is_some(),
        MaterialRef::Named { .. } | MaterialRef::Default => false,
    };
    let shines = desc.materials.iter().any(|named| named.material.shines().is_some())
        || matches!(desc.render.integrator, Integrator::AmbientOcclusion { .. });
    if of_files && dark && !shines && !desc.objects.iter().any(inline) {
        let message = "the scene has no light, so the picture will be black";
        diagnostics.push(
            Diagnostic::warning(codes::BLACK_PICTURE, Span::NONE, message)
                .expected("a light, a `background`, or an object that shines")
                .hint("add a `SphereLight` to `lights`, or a `background`"),
        );
    }
}

/// A mesh whose own file says that parts of it shine, in too many copies for each to have triangles of its own.
pub fn unlit(span: Span) -> Diagnostic {
    let message =
        "this mesh's own materials shine (`Ke`), but its many copies share their triangles: none of them shines";
    Diagnostic::warning(codes::MTL_UNSUPPORTED, span, message)
        .expected("lamps as objects of their own, with `material: Emissive(radiance: ..)`")
        .hint("with `instances: Never` each copy has triangles of its own, and shines")
}

/// Whether a material has another colour at another place of a surface's texture coordinates.
fn wants_uv(material: &Material) -> bool {
    material.varying().into_iter().any(Albedo::wants_uv)
}

/// Whether a closed mesh has its inside outside: a negative volume.
fn is_inside_out(data: &MeshData) -> bool {
    let corner = |k: u32| data.positions.get(k as usize).map_or(DVec3::ZERO, |p| DVec3::from(*p));
    let about = DVec3::from(data.barycentre());
    let of_one = |&[a, b, c]: &[u32; 3]| (corner(a) - about).dot((corner(b) - about).cross(corner(c) - about));
    let volume: f64 = data.triangles.iter().map(of_one).sum();
    volume < 0.0 && is_closed(data)
}

/// Whether each edge is between two triangles that go along it in opposite ways; corners at one place are one.
fn is_closed(data: &MeshData) -> bool {
    let mut places: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let welded: Vec<u32> = data
        .positions
        .iter()
        .enumerate()
        // -0 and 0 are one place.
        .map(|(k, p)| *places.entry(p.map(|x| (x + 0.0).to_bits())).or_insert(k as u32))
        .collect();
    let mut edges: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    for &[a, b, c] in &data.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (Some(&from), Some(&to)) = (welded.get(from as usize), welded.get(to as usize)) else { return false };
            let way = if from < to { 1 } else { -1 };
            if from != to {
                *edges.entry([from.min(to), from.max(to)]).or_insert(0) += way;
            }
        }
    }
    edges.values().all(|ways| *ways == 0)
}

/// An opaque solid that one can be in.
enum Solid {
    Ball {
        center: DVec3,
        radius: f64,
    },
    /// From the world to the cube of a size of one about the origin.
    Cube(DAffine3),
    /// From the world to the closed cone about the z axis from -1 to 1, with these radii at its ends.
    Cone(DAffine3, [f64; 2]),
}

/// The ball's largest reach in units of the cone along normals of its side; between so many of them it is no more by
/// half a percent.
fn reach_across(to_unit: &DAffine3, slope: f64) -> f64 {
    const NORMALS: u32 = 64;
    let reach = |k: u32| {
        let (sin, cos) = libm::sincos(f64::from(k) * std::f64::consts::TAU / f64::from(NORMALS));
        (to_unit.matrix3.transpose() * DVec3::new(cos, sin, -slope)).length()
    };
    1.005 * (0..NORMALS).map(reach).fold(0.0, f64::max)
}

impl Solid {
    /// Whether a ball lies in it as a whole.
    fn holds(&self, point: DVec3, radius: f64) -> bool {
        match self {
            Solid::Ball { center, radius: of_solid } => point.distance(*center) + radius < *of_solid,
            Solid::Cone(to_unit, [first, last]) => {
                let p = to_unit.transform_point3(point);
                let slope = 0.5 * (last - first);
                // R(z) - |(x, y)| is what is left to the side, along its normal (x, y, -slope).
                let side = 0.5 * (first + last) + slope * p.z - p.truncate().length();
                1.0 - p.z.abs() > radius * to_unit.matrix3.row(2).length()
                    && side > if radius > 0.0 { radius * reach_across(to_unit, slope) } else { 0.0 }
            }
            Solid::Cube(to_unit) => {
                let p = to_unit.transform_point3(point);
                // The distance of a side is what is left to it in units over the length of its row.
                (0..3).all(|axis| (0.5 - p[axis].abs()) > radius * to_unit.matrix3.row(axis).length())
            }
        }
    }
}

/// The camera or lamps within opaque balls, boxes, cylinders and cones. One that holds the camera and a lamp is a room.
fn shut_in(
    desc: &SceneDesc,
    placed: &Placed,
    curved: &[Curved],
    materials: &BTreeMap<&str, &Material>,
    diagnostics: &mut Diagnostics,
) {
    let mut solids: Vec<(Solid, usize)> = Vec::new();
    let mut lamps: Vec<(DVec3, f64, Span, String)> = Vec::new();
    let mut flat = polygonal(desc).enumerate().peekable();
    let mut curved = curved.iter().peekable();
    for (index, object) in desc.objects.iter().enumerate() {
        let material = material_of(materials, object.value.material());
        let shines = material.is_some_and(|material| material.shines().is_some());
        let opaque = !shines && !material.is_some_and(Material::transmits);
        if let Some(curved) = curved.next_if(|curved| curved.number == index as u32) {
            if let shapes::UnitShape::Cone { radii, caps: true, .. } = curved.unit
                && opaque
            {
                let maps = curved.maps.iter().take(MOST_COPIES);
                solids.extend(maps.map(|map| (Solid::Cone(map.inverse(), radii), index)));
            }
            let Some((center, radius)) = curved.plain_ball() else { continue };
            if shines {
                lamps.push((center, radius, object.span, format!("objects[{index}], which shines,")));
            } else if opaque {
                solids.push((Solid::Ball { center, radius }, index));
            }
            continue;
        }
        let Some((k, polygonal)) = flat.next_if(|(_, flat)| flat.number == index as u32) else { continue };
        let maps = placed.maps_of(k).iter().take(MOST_COPIES);
        if shines {
            // Where the middle of it is tells enough of where it is.
            let middle = placed.middle_of(k);
            let lamp = |map: &DAffine3| {
                (map.transform_point3(middle), 0.0, object.span, format!("objects[{index}], which shines,"))
            };
            lamps.extend(maps.map(lamp));
        } else if opaque && matches!(polygonal.geometry, Geometry::Unit(UnitShape::Cube)) {
            solids.extend(maps.map(|map| (Solid::Cube(map.inverse()), index)));
        }
    }
    for (index, light) in desc.lights.iter().enumerate() {
        let Light::SphereLight(sphere) = &light.value;
        lamps.push((DVec3::from(sphere.center.value), sphere.radius.value, light.span, format!("lights[{index}]")));
    }
    let eye = DVec3::from(desc.camera.position.value);
    let few = solids.len().saturating_mul(lamps.len()) <= MOST_PAIRS;
    for (solid, index) in &solids {
        let camera = solid.holds(eye, 0.0) && desc.objects[*index].value.camera_visible();
        let of_object = desc.objects[*index].span;
        if camera && !lamps.iter().any(|(center, ..)| solid.holds(*center, 0.0)) {
            diagnostics.push(
                Diagnostic::warning(
                    codes::CAMERA_SHUT_IN,
                    desc.camera.position.span,
                    format!("the camera stands inside objects[{index}], where there is no light"),
                )
                .hint("move the camera out of it, or make the object smaller")
                .label(of_object, "this object is not seen through"),
            );
        }
        for (center, radius, span, name) in lamps.iter().filter(|_| few && !camera) {
            if solid.holds(*center, *radius) {
                diagnostics.push(
                    Diagnostic::warning(
                        codes::LIGHT_SHUT_IN,
                        *span,
                        format!("{name} is shut in by objects[{index}]: its light gets nowhere"),
                    )
                    .hint("move it out, or make the object of Transparent(ior: 1.5)")
                    .label(of_object, "this object is not seen through"),
                );
            }
        }
    }
}
