//! Cameras and lamps that are shut in closed opaque bodies: balls, boxes, cylinders, cones, capsules, whatever becomes
//! a closed mesh, and solids; and in hollows of solids.
//!
//! Light goes in straight lines from one point to another, and none goes through what is opaque: where the camera is
//! surely in a body and all lamps are surely beside it, all is black, and so is what a lamp does that is surely in a
//! body and the camera beside it. A body in which there are both is a room.

use super::bodies::{Extent, MeshBody, Side, UnitBody};
use super::csg::SolidObject;
use super::curved::Curved;
use super::meshes::Loaded;
use super::placed::Placed;
use super::polygonal::{Geometry, Polygonal, UnitShape, polygonal};
use super::unmeant::material_of;
use glam::{DAffine3, DVec3};
use scene_format::desc::{Integrator, Light, Material, MaterialRef, Object, Projection};
use scene_format::diagnostic::{Span, Spanned};
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::collections::{BTreeMap, BTreeSet};
use tracer_kernels::shapes;
use tracer_mesh::MeshData;

/// More copies of an object than this are not looked at: millions of them must not take their time twice.
const MOST_COPIES: usize = 10_000;

/// More pairs of a body and a lamp than this neither.
const MOST_PAIRS: usize = 10_000_000;

/// So many triangles are looked at, those that are looked at again counted again: a tenth of a second.
const MOST_TRIANGLES: usize = 1 << 22;

/// The objects of a scene as they are compiled.
pub struct Made<'a> {
    /// The meshes.
    pub loaded: &'a Loaded,
    /// Where they are.
    pub placed: &'a Placed,
    /// Those with curved sides.
    pub curved: &'a [Curved],
    /// Those that are made of several.
    pub solids: &'a [SolidObject],
}

/// What one can be in. There may be a million, so they are small: [`UnitBody`] is made of one as it is looked at.
enum Body<'a> {
    /// A closed unit shape, with the map of a copy.
    Unit(&'a shapes::UnitShape, &'a DAffine3),
    /// In a copy of a solid.
    Hollow(Box<UnitBody>),
    /// With its place among the meshes, so that all copies have one, and its map.
    Mesh(usize, &'a DAffine3),
    /// With the map of a copy.
    Solid(&'a SolidObject, &'a DAffine3),
}

struct Lamp {
    extent: Extent,
    span: Span,
    name: String,
}

/// All bodies, each with its object, the meshes that some of them are, and all lamps.
#[derive(Default)]
struct Found<'a> {
    bodies: Vec<(Body<'a>, usize)>,
    meshes: Vec<MeshBody<'a>>,
    lamps: Vec<Lamp>,
    /// There are lamps that are not among these: too many copies.
    has_more_lamps: bool,
}

/// Warns of them, of each body once.
pub fn warn(desc: &SceneDesc, made: &Made<'_>, diagnostics: &mut Diagnostics) {
    // What is of no light is not dark without it, and where rays start far from the camera it may see into a body.
    if matches!(desc.render.integrator, Integrator::AmbientOcclusion { .. }) || desc.camera.near.is_some() {
        return;
    }
    let found = find(desc, made);
    let eye = eye(desc);
    let mut left = MOST_TRIANGLES;
    let few = found.bodies.len().saturating_mul(found.lamps.len()) <= MOST_PAIRS;
    let mut told = BTreeSet::new();
    let mut is_shut_in = false;
    for (body, index) in &found.bodies {
        let of_unit = if let Body::Unit(unit, map) = body { UnitBody::of(unit, map) } else { None };
        let mut side = |extent: &Extent| match body {
            Body::Unit(..) => of_unit.as_ref().map_or(Side::Unknown, |convex| convex.side(extent)),
            Body::Hollow(convex) => convex.side(extent),
            Body::Mesh(mesh, map) => found.meshes[*mesh].side(map, extent, &mut left),
            Body::Solid(solid, map) => solid.side(map, extent),
        };
        let of_object = desc.objects[*index].span;
        match side(&eye) {
            Side::In
                if !is_shut_in
                    && !found.has_more_lamps
                    && found.lamps.iter().all(|lamp| side(&lamp.extent) == Side::Out) =>
            {
                is_shut_in = true;
                diagnostics.push(
                    Diagnostic::warning(
                        codes::CAMERA_SHUT_IN,
                        desc.camera.position.span,
                        format!("the camera stands inside {}, where there is no light", called(desc, *index)),
                    )
                    .hint("move the camera out of it, or make the object smaller")
                    .label(of_object, "this object is not seen through"),
                );
            }
            Side::Out if few => {
                let shut_in = found.lamps.iter().filter(|lamp| side(&lamp.extent) == Side::In);
                let shut_in: Vec<&Lamp> = shut_in.filter(|lamp| told.insert(&lamp.name)).collect();
                diagnostics.extend(light_shut_in(&shut_in, &called(desc, *index), of_object));
            }
            _ => {}
        }
    }
}

/// An object by its place, and its name where it has one.
fn called(desc: &SceneDesc, index: usize) -> String {
    let name = desc.objects.get(index).and_then(|object| object.value.name().as_str());
    name.map_or_else(|| format!("objects[{index}]"), |name| format!("\"{name}\" (objects[{index}])"))
}

fn light_shut_in(lamps: &[&Lamp], object: &str, of_object: Span) -> Option<Diagnostic> {
    let (first, others) = lamps.split_first()?;
    let name = &first.name;
    let message = match others.len() {
        0 => format!("{name} is shut in by {object}: its light gets nowhere"),
        more => format!("{name} and {more} more are shut in by {object}: their light gets nowhere"),
    };
    Some(
        Diagnostic::warning(codes::LIGHT_SHUT_IN, first.span, message)
            .hint(
                "move it out; or open the object, a Cylinder or Cone by `caps: false`, others by a Difference; or make \
                 it of Transparent(ior: 1.5)",
            )
            .label(of_object, "this object is not seen through"),
    )
}

/// Where the camera's rays start.
fn eye(desc: &SceneDesc) -> Extent {
    let camera = &desc.camera;
    let [width, height] = [desc.image.width.value, desc.image.height.value].map(f64::from);
    let [right, up] = camera.shift.value;
    let across = match &camera.projection {
        Projection::Orthographic { height: seen } => {
            let half = DVec3::new(0.5 * width / height + right.abs(), 0.5 + up.abs(), 0.0);
            seen.value * half.length()
        }
        _ => 0.0,
    };
    let lens = desc.effects.depth_of_field.as_ref().map_or(0.0, |lens| lens.aperture.value);
    let eyes = camera.stereo.as_ref().map_or(0.0, |stereo| stereo.separation.value);
    Extent::ball(DVec3::from(camera.position.value), across + lens + eyes)
}

fn find<'a>(desc: &'a SceneDesc, made: &Made<'a>) -> Found<'a> {
    let materials: BTreeMap<&str, &Material> =
        desc.materials.iter().map(|named| (&*named.name.value, &named.material)).collect();
    let mut found = Found::default();
    let mut flat = polygonal(desc).enumerate().peekable();
    let mut curved = made.curved.iter().peekable();
    let mut solids = made.solids.iter().peekable();
    for (index, object) in desc.objects.iter().enumerate() {
        let number = index as u32;
        let material = material_of(&materials, object.value.material());
        let shines = material.is_some_and(|material| material.shines().is_some());
        // Whoever looks through an object sees into it.
        let opaque = object.value.camera_visible() && is_opaque(&materials, object, None);
        let lamp =
            |extent: Extent| Lamp { extent, span: object.span, name: format!("objects[{index}], which shines,") };
        if let Some(curved) = curved.next_if(|curved| curved.number == number) {
            let maps = curved.maps.iter().take(MOST_COPIES);
            if shines {
                found.has_more_lamps |= curved.maps.len() > MOST_COPIES;
                found.lamps.extend(maps.map(|map| lamp(Extent::of_unit(&curved.unit, map))));
            } else if opaque
                && curved.unit != shapes::UnitShape::Plane
                && UnitBody::of(&curved.unit, &DAffine3::IDENTITY).is_some()
            {
                found.bodies.extend(maps.map(|map| (Body::Unit(&curved.unit, map), index)));
            }
        } else if let Some(solid) = solids.next_if(|solid| solid.number() == number) {
            let maps = solid.maps().iter().take(MOST_COPIES);
            if solid.shines() {
                found.has_more_lamps |= solid.maps().len() > MOST_COPIES;
                found.lamps.extend(maps.clone().map(|map| lamp(solid.extent(map))));
            }
            for map in maps.filter(|_| opaque) {
                found.bodies.push((Body::Solid(solid, map), index));
                let hollows = solid.hollows(map).into_iter();
                found.bodies.extend(hollows.map(|hollow| (Body::Hollow(Box::new(hollow)), index)));
            }
        } else if let Some((k, polygonal)) = flat.next_if(|(_, flat)| flat.number == number) {
            let Some(data) = made.loaded.file(k) else { continue };
            let maps = made.placed.maps_of(k).iter().take(MOST_COPIES);
            let corners = made.placed.box_of(k);
            let own = own_materials(&polygonal, data);
            if shines || own.clone().any(|material| material.shines().is_some()) {
                found.has_more_lamps |= made.placed.maps_of(k).len() > MOST_COPIES;
                found.lamps.extend(maps.map(|map| lamp(Extent::of_box(corners, map))));
            } else if opaque && !own.clone().any(Material::transmits) {
                found.add_bodies(&polygonal, data, corners, maps);
            }
        }
    }
    for (index, light) in desc.lights.iter().enumerate() {
        let Light::SphereLight(sphere) = &light.value;
        // One that is as large as a ball about it is within.
        let extent = Extent::ball(DVec3::from(sphere.center.value), (1.0 - 1e-6) * sphere.radius.value);
        found.lamps.push(Lamp { extent, span: light.span, name: format!("lights[{index}]") });
    }
    found
}

impl<'a> Found<'a> {
    /// The copies of an object of triangles.
    fn add_bodies(
        &mut self,
        object: &Polygonal<'_>,
        data: &'a MeshData,
        corners: [DVec3; 2],
        maps: impl Iterator<Item = &'a DAffine3>,
    ) {
        let index = object.number as usize;
        match object.geometry {
            Geometry::Unit(UnitShape::Square) | Geometry::Heights(_) => {}
            Geometry::Unit(UnitShape::Cube) => {
                self.bodies.extend(maps.map(|map| (Body::Unit(&shapes::UnitShape::Cube, map), index)));
            }
            Geometry::File(_) | Geometry::Inline(_) | Geometry::Made(_) => {
                let mesh = self.meshes.len();
                self.meshes.push(MeshBody::new(data, corners));
                self.bodies.extend(maps.map(|map| (Body::Mesh(mesh, map), index)));
            }
        }
    }
}

/// The materials of a mesh's own file, where it has them.
fn own_materials<'a>(object: &Polygonal<'_>, data: &'a MeshData) -> impl Iterator<Item = &'a Material> + Clone {
    let own = if matches!(object.material, MaterialRef::Default) { &data.materials[..] } else { &[] };
    own.iter().map(|named| &named.material)
}

/// Whether no light goes through an object, of a solid through none of its operands. `inherited`: the material of what
/// has none of its own.
fn is_opaque<'a>(
    materials: &BTreeMap<&str, &'a Material>,
    object: &'a Spanned<Object>,
    inherited: Option<&'a Material>,
) -> bool {
    let material = material_of(materials, object.value.material()).or(inherited);
    let operands = object.value.operands().map_or(&[][..], |operands| &operands.0);
    if operands.is_empty() {
        return !material.is_some_and(|material| material.shines().is_some() || material.transmits());
    }
    operands.iter().all(|operand| is_opaque(materials, operand, material))
}
