//! What is drawn at random for scenes of every kind: colours, materials, textures, lamps, lenses, filters.

use super::meshes::{Point, Shape};
use super::textures::{albedo, number, textured};
use super::world::{World, diffuse, inline};
use crate::picture::Picture;
use glam::DVec3;
use scene_format::desc::{
    Amount, Background, BlinnPhong, Color, Conductor, Diffuse, Emissive, Environment, Extent, Instances, Light,
    LightGroup, Material, MaterialRef, Mesh, Metal, Mirror, NamedMaterial, Number, Object, PixelFilter, Placements,
    Reflectance, ToneMap, Transform, Transparent,
};
use scene_format::diagnostic::Spanned;
use std::sync::Arc;
use tracer_reference::Random;

/// One of several.
pub fn one_of<T: Clone>(random: &mut Random, from: &[T]) -> T {
    from[random.below(from.len())].clone()
}

/// Whether something happens that does so once in `n` times.
pub fn once_in(random: &mut Random, n: usize) -> bool {
    random.below(n) == 0
}

/// Hides some of the objects and lamps from the camera.
pub fn hide(world: &mut World, random: &mut Random) {
    for object in &mut world.desc.objects {
        *object.value.camera_visible_mut() = once_in(random, 2);
    }
    for light in &mut world.desc.lights {
        let Light::SphereLight(lamp) = &mut light.value;
        lamp.camera_visible = once_in(random, 2);
    }
}

/// Spread evenly over the decades between.
pub fn magnitude(random: &mut Random, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.number())
}

/// A colour that may be vivid.
pub fn color(random: &mut Random) -> Color {
    let brightness = random.between(0.2, 0.9);
    if once_in(random, 2) { [brightness; 3] } else { [0; 3].map(|_| random.between(0.05, 0.9)) }
}

/// Names groups of some of the lights. They show in no picture, as no scene has `light_groups`.
pub fn light_groups(world: &mut World, random: &mut Random) {
    let mut group = || LightGroup::from(once_in(random, 3).then(|| ["key", "fill"][random.below(2)]));
    for light in &mut world.desc.lights {
        let Light::SphereLight(lamp) = &mut light.value;
        lamp.group = group();
    }
    if let Background::Environment(environment) = &mut world.desc.background {
        environment.group = group();
    }
    for object in &mut world.desc.objects {
        let MaterialRef::Inline(material) = object.value.material() else { continue };
        if let Material::Emissive(emissive) = &material.value {
            let grouped = Emissive { group: group(), ..(**emissive).clone() };
            set_material(&mut object.value, Material::Emissive(Box::new(grouped)));
        }
    }
}

/// Light from where no object is: a colour, or a coarse picture of it with a bright patch.
pub fn background(world: &mut World, random: &mut Random) -> Background {
    let sky = color(random);
    if once_in(random, 2) {
        return sky.into();
    }
    let (sun_u, sun_v, size) = (random.number(), random.between(0.3, 0.9), random.between(0.03, 0.2));
    let times = magnitude(random, 1.0, 12.0);
    let paint = |u: f64, v: f64| {
        let in_sun = (u - sun_u).abs() < size && (v - sun_v).abs() < size;
        let brightness = if in_sun { 1.0 } else { (0.4 + 0.6 * v) / times };
        // The picture's numbers are sRGB.
        DVec3::from_array(sky.map(|c| (brightness * c).powf(1.0 / 2.2)))
    };
    let Ok(bytes) = Picture::from_fn(16, 8, paint).png() else { return sky.into() };
    let file = world.file("sky", "png", bytes).into();
    let up = if once_in(random, 2) { [0.0, 1.0, 0.0] } else { [0; 3].map(|_| random.between(0.1, 1.0)) };
    let rotation = if once_in(random, 2) { 0.0 } else { random.between(-180.0, 180.0) };
    let scale = if once_in(random, 2) { [times; 3] } else { color(random).map(|c| times * c) };
    let camera_visible = !once_in(random, 3);
    let group = LightGroup::default();
    Background::Environment(Box::new(Environment { file, scale, rotation, up: up.into(), camera_visible, group }))
}

/// A sphere that shines around all there is: a lamp, or a ball that shines to both sides and may be painted.
pub fn sky(world: &mut World, middle: Point, radius: f64, random: &mut Random) {
    let radiance = [random.between(0.3, 1.0); 3];
    if once_in(random, 2) {
        return world.lamp(middle, radius, radiance);
    }
    let color = if once_in(random, 2) { textured(world, random) } else { color(random).into() };
    let (amount, group) = (Amount::Radiance(radiance).into(), LightGroup::default());
    world.sphere(middle, radius, Material::Emissive(Box::new(Emissive { color, amount, two_sided: true, group })));
}

/// Blinn-Phong with an exponent from dull to shiny: photons take over from 50 on, so both sides of that occur.
pub fn shiny(world: &mut World, low: f64, high: f64, random: &mut Random) -> Material {
    let conserving = !once_in(random, 3);
    // The report's lobe reflects up to four times its share.
    let share = number(world, 0.05, if conserving { 1.0 } else { 0.25 }, random);
    let (albedo, exponent) = (albedo(world, random), number(world, low, high, random));
    Material::BlinnPhong(Box::new(BlinnPhong { albedo, exponent, specular: share, energy_conserving: conserving }))
}

/// Lambert, or dull enough to count as such.
pub fn matt(world: &mut World, random: &mut Random) -> Material {
    match random.below(8) {
        0 => shiny(world, 1.0, 45.0, random),
        1 => metal(world, 0.5, 1.0, random),
        _ => Material::Diffuse(Diffuse { albedo: albedo(world, random) }),
    }
}

/// Metal of a roughness in this range, said in one of the three ways.
pub fn metal(world: &mut World, low: f64, high: f64, random: &mut Random) -> Material {
    const METALS: [Metal; 11] = [
        Metal::Silver,
        Metal::Gold,
        Metal::Copper,
        Metal::Aluminum,
        Metal::Iron,
        Metal::Chromium,
        Metal::Nickel,
        Metal::Titanium,
        Metal::Brass,
        Metal::Platinum,
        Metal::Steel,
    ];
    let reflectance = match random.below(4) {
        0 | 1 => Reflectance::Metal(one_of(random, &METALS)),
        2 => Reflectance::Complex {
            ior: [0; 3].map(|_| random.between(0.1, 3.0)).into(),
            k: [0; 3].map(|_| random.between(1.0, 6.0)).into(),
        },
        _ => Reflectance::Tinted {
            reflectance: albedo(world, random),
            edge_tint: if once_in(random, 2) { [1.0; 3].into() } else { albedo(world, random) },
        },
    };
    let roughness = number(world, low, high, random);
    Material::Conductor(Box::new(Conductor { reflectance, roughness, multiple_scattering: !once_in(random, 4) }))
}

/// What throws caustics: glass, mirrors, shiny lobes, metal.
pub fn caster(world: &mut World, random: &mut Random) -> Material {
    match random.below(7) {
        5 => metal(world, 0.05, 0.44, random),
        6 => metal(world, 0.0, 0.0, random),
        0 => Material::Mirror(Mirror { reflectance: albedo(world, random) }),
        1 => Material::Mirror(Mirror { reflectance: [1.0; 3].into() }),
        2 => shiny(world, 50.0, 5000.0, random),
        _ => clear(world, random),
    }
}

/// Glass of any index, clear or coloured.
pub fn clear(world: &mut World, random: &mut Random) -> Material {
    let ior: f64 = one_of(random, &[1.0, 1.05, 1.33, 1.5, 1.5, 2.4]);
    let transmittance = match random.below(9) {
        0 => albedo(world, random),
        1 | 2 => [0; 3].map(|_| random.between(0.5, 1.0)).into(),
        _ => [1.0; 3].into(),
    };
    Material::Transparent(Box::new(Transparent { ior: ior.into(), transmittance }))
}

/// Adds a thing of a material: a sphere, or a mesh placed by every kind of step.
pub fn thing(world: &mut World, center: Point, radius: f64, mut material: Material, random: &mut Random) {
    if once_in(random, 2) {
        return world.sphere(center, radius, material);
    }
    match random.below(10) {
        8 | 9 => return super::made::shape(world, center, radius, material, random),
        0 => return super::shining::cuboid(world, center, radius, material, random),
        5 | 6 => return super::curved::shape(world, center, radius, material, random),
        7 => return super::curved::ball(world, center, radius, material, random),
        2 | 3 => return super::solids::shape(world, center, radius, material, random),
        // Glass without an inside is no glass.
        1 if !material.transmits() => {
            return super::shining::rectangle(world, center, radius, material, random);
        }
        _ => {}
    }
    let (name, shape) = match random.below(4) {
        0 => ("ball", Shape::ball(random.below(3) as u32)),
        1 => ("ring", Shape::ring(0.4, 16, 8)),
        2 => ("cube", Shape::block([-1.0; 3], [1.0; 3])),
        _ => ("ball", Shape { normals: Vec::new(), ..Shape::ball(1) }),
    };
    let form = random.below(4);
    let size = 0.7 * radius;
    let factor = if once_in(random, 4) { [size, 0.6 * size, -size] } else { [size; 3] };
    let mut steps = vec![
        Transform::Scale { factor, about: None },
        Transform::Rotate { axis: random.direction().to_array(), degrees: random.between(0.0, 360.0), about: None },
        Transform::Translate(center),
    ];
    if once_in(random, 4) {
        // Whatever is as high as wide and deep, turned or not, or nearly so.
        let extent = one_of(random, &[Extent::Height, Extent::Width, Extent::Depth]);
        steps.push(Transform::FitTo { extent, length: 0.8 * size, about: None });
        // Away and back. Drawn aside, so that all else stays as it is without it.
        if once_in(&mut random.clone(), 3) {
            steps.extend([Transform::Translate([300.0, -500.0, 400.0]), Transform::CenterTo { point: center }]);
        }
    }
    if form == 0 {
        let colors = super::textures::of_vertices(&mut material, shape.positions.len(), random);
        return world.written_out((&shape, colors), material, steps);
    }
    let file = match form {
        1 => world.file(name, "off", shape.off().into_bytes()),
        _ => world.file(name, "obj", shape.obj().into_bytes()),
    };
    world.placed(file, material, steps);
}

/// Changes the mesh that was added last.
pub fn last_mesh(world: &mut World, change: impl FnOnce(&mut Mesh)) {
    if let Some(Object::Mesh(mesh)) = world.desc.objects.last_mut().map(|object| &mut object.value) {
        change(mesh);
    }
}

/// Many copies of a mesh on the floor, written in the scene or in a file.
pub fn crowd(world: &mut World, count: usize, reach: f64, floor: f64, material: Material, random: &mut Random) {
    let (name, shape) = match random.below(3) {
        0 => ("ball", Shape::ball(1)),
        1 => ("cube", Shape::block([-1.0; 3], [1.0; 3])),
        _ => ("blade", Shape::grass(6, random)),
    };
    let file = world.file(name, "obj", shape.obj().into_bytes());
    world.placed(file, material, Vec::new());
    let mut lines = String::new();
    let mut list = Vec::new();
    for _ in 0..count {
        let size = random.between(0.03, 0.12);
        let at = [random.between(-reach, reach), floor + size, random.between(-reach, reach)];
        lines += &format!("{} {} {} {size}\n", at[0], at[1], at[2]);
        let turn = random.between(0.0, 360.0);
        list.push(vec![
            Spanned::from(Transform::Scale { factor: [size; 3], about: None }),
            Spanned::from(Transform::Rotate { axis: [0.0, 1.0, 0.0], degrees: turn, about: None }),
            Spanned::from(Transform::Translate(at)),
        ]);
    }
    let placements = if once_in(random, 2) {
        Placements::from(world.file("crowd", "txt", lines.into_bytes()))
    } else {
        list.into_iter().collect()
    };
    let instances = one_of(random, &[Instances::Auto, Instances::Always, Instances::Never]);
    last_mesh(world, |mesh| (mesh.placements, mesh.instances) = (placements, instances));
}

/// Adds a lamp, small or wide, that gives about as much light as any other.
pub fn lamp(world: &mut World, center: Point, largest: f64, random: &mut Random) -> f64 {
    let radius = magnitude(random, 0.15 * largest, largest);
    let power = magnitude(random, 0.5, 5.0);
    let tint = if once_in(random, 3) { color(random) } else { [1.0; 3] };
    world.lamp(center, radius, tint.map(|c| c * power / (radius * radius)));
    radius
}

/// Filter, lens, exposure, tone map and the words that say the same in another way.
pub fn film(world: &mut World, random: &mut Random) {
    let desc = &mut world.desc;
    desc.effects.antialiasing = match random.below(5) {
        0 => PixelFilter::None,
        1 => PixelFilter::Box,
        2 => PixelFilter::Gaussian { sigma: random.between(0.2, 1.0).into() },
        3 => PixelFilter::BlackmanHarris { radius: random.between(1.0, 2.5).into() },
        _ => PixelFilter::default(),
    };
    if once_in(random, 8) {
        desc.effects.exposure = random.between(-3.0, 3.0).into();
    }
    desc.effects.tone_map = one_of(random, &[ToneMap::None, ToneMap::None, ToneMap::Filmic, ToneMap::AgX]);
    if once_in(random, 8) {
        desc.camera.up = random.direction().to_array().into();
    }
    for light in &mut desc.lights {
        let Light::SphereLight(lamp) = &mut light.value;
        let Amount::Radiance(color) = lamp.amount.value else { continue };
        let area = std::f64::consts::PI * lamp.radius.value.powi(2);
        let seen = 683.0 * Number::of_color(color);
        let (amount, is_seen) = match random.below(6) {
            0 => (Amount::Intensity(color.map(|c| c * area)), false),
            1 => (Amount::Power(color.map(|c| c * 4.0 * std::f64::consts::PI * area)), false),
            2 => (Amount::Luminance(seen), true),
            3 => (Amount::LuminousIntensity(seen * area), true),
            4 => (Amount::LuminousPower(seen * 4.0 * std::f64::consts::PI * area), true),
            _ => continue,
        };
        lamp.amount = amount.into();
        if is_seen {
            lamp.color = color;
        }
    }
}

/// Gives names to the materials, as a person would who uses one twice.
pub fn name_materials(world: &mut World) {
    for (k, object) in world.desc.objects.iter_mut().enumerate() {
        let material = object.value.material_mut();
        if let MaterialRef::Inline(inner) = material {
            let name: Arc<str> = format!("m{k}").into();
            let named = NamedMaterial { name: (*name).to_owned().into(), material: inner.value.clone() };
            world.desc.materials.push(named);
            *material = MaterialRef::Named { name, span: scene_format::diagnostic::Span::NONE };
        }
    }
}

/// The material of an object, whether it is named or written in place.
pub fn material_of<'a>(world: &'a World, object: &'a Object) -> Option<&'a Material> {
    match object.material() {
        MaterialRef::Inline(inner) => Some(&inner.value),
        MaterialRef::Named { name, .. } => {
            world.desc.materials.iter().find(|named| named.name.value == *name).map(|named| &named.material)
        }
        MaterialRef::Default => None,
    }
}

/// Writes another material for an object.
pub fn set_material(object: &mut Object, material: Material) {
    *object.material_mut() = inline(material);
}

/// A wall's colour.
pub fn wall(random: &mut Random) -> Material {
    diffuse(if once_in(random, 4) { [0.9; 3] } else { color(random) })
}
