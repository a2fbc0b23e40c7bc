//! What stands in a scene, in render space.

use super::curved::Curved;
use super::materials::Finished;
use super::measured::Measured;
use super::{Objects, csg, lights_in_one_place, meshes, radiances, unmeant, vertex_colors};
use glam::{DAffine3, DVec3};
use scene_format::{Diagnostics, SceneDesc, desc};
use std::collections::BTreeMap;
use tracer_kernels::scene::{
    Camera, ColorTable, CurvedLight, Light, NONE, Program, Projection, Shape, Solids, Space, Sphere, SphereTable,
};

/// All shapes and lights.
pub(super) struct Shaped {
    /// Those of objects and lights in the order of their primitive ids (see [`SphereTable`]).
    pub(super) spheres: Vec<Sphere>,
    /// The other curved shapes; those without an end are the last.
    pub(super) shapes: Vec<Shape>,
    /// What those of them are made of that are made of several.
    pub(super) solids: Solids,
    /// The groups of the lights that are parts of solids.
    pub(super) solid_groups: BTreeMap<u32, String>,
    pub(super) lights: Vec<Light>,
    /// Triangles.
    pub(super) built: meshes::Built,
    /// The colours of vertices that textures read.
    pub(super) colors: ColorTable,
    /// Where a pattern asks for it: from the coordinates that things are written in to the world, the first the
    /// world's own.
    pub(super) written: Option<Vec<DAffine3>>,
}

impl Shaped {
    /// Of the objects as they are written; `mesh_radiances`: what copies of those of triangles shine, by object. Both
    /// are there no more afterwards: the tree is what takes the most.
    pub(super) fn new(
        desc: &SceneDesc,
        objects: Objects,
        mesh_radiances: Vec<Vec<[f64; 3]>>,
        finished: &Finished,
        measured: &Measured,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let Objects { loaded, assigned, curved, solids: solid_objects, placed } = objects;
        let Finished { patterns, programs, .. } = finished;
        let is_solid =
            patterns.iter().any(|pattern| pattern.space != Space::Uv) || programs.iter().any(Program::is_solid);
        let mut written = is_solid.then(|| vec![DAffine3::IDENTITY]);
        let (spheres, mut shapes, mut lights) = curved_and_lights(desc, measured, curved, written.as_mut());
        let standing = (&mut shapes, &mut lights);
        let (solids, solid_groups) = add_solids(&solid_objects, measured, standing, written.as_mut());
        let parts = meshes::Parts {
            desc,
            loaded: &loaded,
            placed: &placed,
            assigned: &assigned,
            radiances: &mesh_radiances,
            radiance_unit: measured.radiance_unit,
            first_light: lights.len() as u32,
        };
        let mut built = meshes::build(&measured.frame, &parts, written.as_mut());
        lights.append(&mut built.lights);
        lights_in_one_place::keep_first(&mut lights);
        diagnostics.extend(built.unlit.iter().map(|&span| unmeant::unlit(span)));
        let colors = vertex_colors::table(programs, &loaded, &built);
        Shaped { spheres, shapes, solids, solid_groups, lights, built, colors, written }
    }
}

/// The spheres of objects and lights in the order of their primitive ids (see [`SphereTable`]), the other curved
/// shapes, and the lights.
fn curved_and_lights(
    desc: &SceneDesc,
    Measured { frame, camera, radiance_unit }: &Measured,
    curved: Vec<Curved>,
    mut written: Option<&mut Vec<DAffine3>>,
) -> (Vec<Sphere>, Vec<Shape>, Vec<Light>) {
    let mut lights: Vec<Light> = Vec::new();
    let mut shine = |radiance: [f64; 3], two_sided: bool| {
        let radiance = radiance.map(|x| x / radiance_unit);
        lights.push(Light::Sphere { sphere: NONE, radiance, two_sided, is_sky: false });
        lights.len() as u32 - 1
    };
    let mut spheres = Vec::with_capacity(curved.len() + desc.lights.len());
    let (mut shapes, mut lamps): (Vec<Shape>, Vec<CurvedLight>) = (Vec::new(), Vec::new());
    for object in &curved {
        object.build(frame, &mut shine, &mut spheres, (&mut shapes, &mut lamps), written.as_deref_mut());
    }
    // To put millions in order takes as much again.
    drop(curved);
    for (object, light) in (desc.objects.len() as u32..).zip(&desc.lights) {
        let desc::Light::SphereLight(light) = &light.value;
        let index = shine(radiances::of_light(light), true);
        let (center, radius) = (frame.point(DVec3::from(light.center.value)), frame.length(light.radius.value));
        spheres.push(Sphere { center, radius, material: NONE, object, copy: 0, light: index, coordinates: 0 });
    }
    SphereTable::order(&mut spheres);
    // Behind those that hang in the tree.
    shapes.sort_by_key(|shape| shape.unit.is_endless());
    for (k, sphere) in spheres.iter().enumerate() {
        if let Some(Light::Sphere { sphere: index, two_sided, is_sky, .. }) = lights.get_mut(sphere.light as usize) {
            *index = k as u32;
            *is_sky = *two_sided && is_seen(desc, sphere.object) && holds(sphere, camera);
        }
    }
    // Behind those of the spheres.
    let first = lights.len() as u32;
    for (k, shape) in (0..).zip(&mut shapes).filter(|(_, shape)| shape.light != NONE) {
        if let Some(lamp) = lamps.get_mut(shape.light as usize) {
            lamp.shape = k;
        }
        shape.light += first;
    }
    let in_unit = |lamp: CurvedLight| CurvedLight { radiance: lamp.radiance.map(|x| x / radiance_unit), ..lamp };
    lights.extend(lamps.into_iter().map(|lamp| Light::Curved(in_unit(lamp))));
    (spheres, shapes, lights)
}

/// Whether the camera sees an object, or a lamp that is none.
fn is_seen(desc: &SceneDesc, object: u32) -> bool {
    match desc.objects.get(object as usize) {
        Some(object) => object.value.camera_visible(),
        None => {
            let lamp = desc.lights.get((object as usize).wrapping_sub(desc.objects.len()));
            lamp.is_none_or(|lamp| lamp.value.camera_visible())
        }
    }
}

/// Whether all rays of the camera start in a sphere, by a hundredth of its radius; but those that a filter takes from
/// beyond the picture's border. It is about noise alone: a lamp that is never asked is found by rays that meet it.
fn holds(sphere: &Sphere, camera: &Camera) -> bool {
    let half = camera.right.length() + camera.up.length();
    let reach = match camera.projection {
        Projection::Perspective { lens, shift: [x, y] } => {
            let corner = 1.0 + camera.right.length() * (1.0 + x.abs()) + camera.up.length() * (1.0 + y.abs());
            lens.map_or(0.0, |lens| lens.radius) + camera.near * corner
        }
        Projection::Orthographic => half + camera.near,
        Projection::Panorama | Projection::Fisheye { .. } => camera.near,
    };
    let aside = camera.stereo.map_or(0.0, |stereo| stereo.aside.abs());
    camera.eye.distance(sphere.center) + reach + aside < 0.99 * sphere.radius
}

/// Adds objects that are made of several to the shapes, and their parts that shine to the lights; gives what they are
/// made of, and the groups of those lights.
fn add_solids(
    objects: &[csg::SolidObject],
    Measured { frame, radiance_unit, .. }: &Measured,
    (shapes, lights): (&mut Vec<Shape>, &mut Vec<Light>),
    mut written: Option<&mut Vec<DAffine3>>,
) -> (Solids, BTreeMap<u32, String>) {
    let (mut solids, mut groups) = (Solids::default(), BTreeMap::new());
    let mut lit = csg::Lit { lights, radiance_unit: *radiance_unit, groups: &mut groups };
    // What has no end stays behind them.
    let mut endless = shapes.split_off(shapes.partition_point(|shape| !shape.unit.is_endless()));
    for object in objects {
        object.build(frame, shapes, &mut solids, &mut lit, written.as_deref_mut());
    }
    shapes.append(&mut endless);
    (solids, groups)
}
