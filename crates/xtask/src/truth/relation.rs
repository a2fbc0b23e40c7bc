//! What a picture is held against: plain path tracing, or a scene that must look the same.

use super::draw::material_of;
use super::world::World;
use scene_format::desc::{Background, Copies, Focus, Instances, Light, Material, Object, Placements, Transform};

/// How the file of a mirror begins that fills the plane x = 0.
pub const PLANE_MIRROR: &str = "plane-mirror";

/// What is true of a scene's picture, on average over seeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// It is that of the plain path tracer.
    Path,
    /// It is that without glass of index 1.0. Passing such glass counts as a bounce, so scenes for this have many
    /// bounces and low albedos.
    Shells,
    /// It is that of the mirrored world where the mirror in the plane x = 0 was. All things are on one side of it, and
    /// no ray that
    /// matters passes beside it.
    Unfolded,
    /// It is the mirror image of the mirrored scene's.
    Flipped,
    /// It is the sum of those with each lamp alone, a black ball in place of the others.
    Sum,
    /// It is half of that with twice the light, but for the film's rounding.
    Twice,
    /// It is that with copies stored in the other way.
    Instances,
    /// It is that without the lamps that are shut in balls.
    ShutIn,
    /// Nothing is brighter than the white sky.
    Furnace,
    /// It is black.
    Dark,
}

impl Relation {
    /// The scenes whose pictures sum to this one's.
    pub fn others(self, world: &World) -> Vec<World> {
        match self {
            Relation::Path => vec![world.clone()],
            Relation::Shells => vec![without_shells(world)],
            Relation::Unfolded => vec![unfolded(world)],
            Relation::Flipped => vec![flipped(world)],
            Relation::Sum => (0..world.desc.lights.len()).map(|k| with_one_lamp(world, k)).collect(),
            Relation::Twice => vec![with_light_times(world, 2.0)],
            Relation::Instances => vec![stored_otherwise(world)],
            Relation::ShutIn => vec![without_shut_in(world)],
            Relation::Furnace | Relation::Dark => Vec::new(),
        }
    }
}

fn without_shells(world: &World) -> World {
    let shell = |object: &Object| {
        matches!(material_of(world, object), Some(Material::Transparent(glass))
            if glass.ior.value == 1.0 && glass.transmittance == [1.0; 3].into())
    };
    let mut other = world.clone();
    other.desc.objects.retain(|object| !shell(&object.value));
    other
}

fn without_shut_in(world: &World) -> World {
    let mut other = world.clone();
    let is_shut_in = |Light::SphereLight(lamp): &Light| {
        world.desc.objects.iter().any(|object| {
            let Object::Sphere(ball) = &object.value else { return false };
            let (ball_at, at) = (ball.center.value, lamp.center.value);
            let apart = (0..3).map(|k| (ball_at[k] - at[k]).powi(2)).sum::<f64>().sqrt();
            // Beside the room, where balls are black: a lamp may be in a ball of glass in it.
            let is_beside = at.iter().map(|x| x * x).sum::<f64>().sqrt() > 11.0;
            ball.transform.is_empty() && is_beside && apart + lamp.radius.value < ball.radius.value
        })
    };
    other.desc.lights.retain(|light| !is_shut_in(&light.value));
    other
}

fn mirror_x(p: [f64; 3]) -> [f64; 3] {
    [-p[0], p[1], p[2]]
}

/// An object on the other side of the plane x = 0.
fn mirrored(object: &Object) -> Object {
    let mut object = object.clone();
    let mirror = || Transform::Scale { factor: [-1.0, 1.0, 1.0], about: Some(Box::new([0.0; 3])) };
    if let Object::Sphere(sphere) = &mut object
        && sphere.transform.is_empty()
        && sphere.placements == Placements::One
    {
        sphere.center = mirror_x(sphere.center.value).into();
        return object;
    }
    object.transform_mut().push(mirror().into());
    // A copy P T becomes M P T = (M P M) (M T). What stands in a file is not drawn where scenes are mirrored.
    if let Placements::Many(copies) = object.placements_mut()
        && let Copies::List(list) = &mut **copies
    {
        let copies = list.iter().map(|steps| {
            let mut mirrored = vec![mirror().into()];
            mirrored.extend_from_slice(steps);
            mirrored.push(mirror().into());
            mirrored
        });
        **list = copies.collect();
    }
    object
}

fn mirrored_light(light: &Light) -> Light {
    let Light::SphereLight(lamp) = light;
    let mut lamp = lamp.clone();
    lamp.center = mirror_x(lamp.center.value).into();
    Light::SphereLight(lamp)
}

fn unfolded(world: &World) -> World {
    let mut other = world.clone();
    let is_mirror = |object: &Object| match object {
        Object::Mesh(mesh) => mesh.file().is_some_and(|file| file.value.to_string_lossy().starts_with(PLANE_MIRROR)),
        // No other plane is drawn where things are mirrored.
        Object::Plane(_) => true,
        _ => false,
    };
    other.desc.objects.retain(|object| !is_mirror(&object.value));
    let behind: Vec<_> = other.desc.objects.iter().map(|object| mirrored(&object.value).into()).collect();
    other.desc.objects.extend(behind);
    let behind: Vec<_> = other.desc.lights.iter().map(|light| mirrored_light(&light.value).into()).collect();
    other.desc.lights.extend(behind);
    other
}

fn flipped(world: &World) -> World {
    let mut other = world.clone();
    for object in &mut other.desc.objects {
        *object = mirrored(&object.value).into();
    }
    for light in &mut other.desc.lights {
        *light = mirrored_light(&light.value).into();
    }
    let camera = &mut other.desc.camera;
    camera.position = mirror_x(camera.position.value).into();
    camera.look_at = mirror_x(camera.look_at.value).into();
    camera.up = mirror_x(camera.up.value).into();
    camera.shift.value[0] = -camera.shift.value[0];
    if let Some(lens) = &mut other.desc.effects.depth_of_field {
        if let Focus::On(point) = &mut lens.focus.value {
            *point = mirror_x(*point);
        }
        lens.tilt.value[1] = -lens.tilt.value[1];
        // A round aperture has none.
        if lens.blades.value > 0 {
            lens.rotation.value = 180.0 - lens.rotation.value;
        }
    }
    other
}

fn with_one_lamp(world: &World, k: usize) -> World {
    let mut other = world.clone();
    let lights = std::mem::take(&mut other.desc.lights);
    for (j, light) in lights.into_iter().enumerate() {
        let Light::SphereLight(lamp) = &light.value;
        if j == k {
            other.desc.lights.push(light);
        } else {
            other.sphere(lamp.center.value, lamp.radius.value, super::world::matt(0.0));
        }
    }
    if k > 0 {
        other.desc.background = Background::default();
    }
    other
}

fn with_light_times(world: &World, factor: f64) -> World {
    let mut other = world.clone();
    other.desc.background = other.desc.background.scaled(factor);
    for light in &mut other.desc.lights {
        let Light::SphereLight(lamp) = &mut light.value;
        lamp.amount.value = lamp.amount.value.scaled(factor);
    }
    other
}

fn stored_otherwise(world: &World) -> World {
    let mut other = world.clone();
    for object in &mut other.desc.objects {
        if let Object::Mesh(mesh) = &mut object.value {
            mesh.instances = match mesh.instances {
                Instances::Always => Instances::Never,
                Instances::Never | Instances::Auto => Instances::Always,
            };
        }
    }
    other
}
