//! Lamps of other shapes than spheres, and shapes with flat sides.

use super::draw::{magnitude, once_in};
use super::meshes::{Point, Shape};
use super::textures::textured;
use super::world::{World, inline};
use scene_format::desc::{
    Albedo, Amount, Color, Emissive, Light, Material, Name, Number, Object, PerAxis, Placements, RectBox, Rectangle,
    Transform,
};
use scene_format::diagnostic::Spanned;
use tracer_reference::Random;

/// Steps that turn a shape about its middle, and sometimes mirror it or make it longer.
fn steps(random: &mut Random) -> Vec<Spanned<Transform>> {
    let axis = random.direction().to_array();
    let turn = Transform::Rotate { axis, degrees: random.between(0.0, 360.0), about: None };
    let stretch = Transform::Scale { factor: [1.0, random.between(0.4, 1.0), -1.0], about: None };
    if once_in(random, 3) { vec![turn.into(), stretch.into()] } else { vec![turn.into()] }
}

/// Adds a rectangle within a sphere.
pub fn rectangle(world: &mut World, center: Point, radius: f64, material: Material, random: &mut Random) {
    let angle = random.between(0.2, 1.3);
    let size =
        if once_in(random, 3) { [radius * 1.4; 2] } else { [2.0 * radius * angle.cos(), 2.0 * radius * angle.sin()] };
    let copied = once_in(random, 4);
    let there = vec![Transform::Translate(center).into()];
    let rectangle = Rectangle {
        center: if copied { [0.0; 3] } else { center }.into(),
        normal: random.direction().to_array().into(),
        size: PerAxis(size).into(),
        material: inline(material),
        transform: if once_in(random, 2) { steps(random) } else { Vec::new() },
        placements: if copied { std::iter::once(there).collect() } else { Placements::One },
        camera_visible: true,
        name: Name::default(),
    };
    world.desc.objects.push(Object::Rectangle(Box::new(rectangle)).into());
}

/// Adds a box within a sphere, written where it is or copied there.
pub fn cuboid(world: &mut World, center: Point, radius: f64, material: Material, random: &mut Random) {
    let size = [0; 3].map(|_| random.between(0.2, 1.15) * radius);
    let copied = once_in(random, 3);
    let there = vec![Transform::Translate(center).into()];
    let size = if once_in(random, 3) { [1.1 * radius; 3] } else { size };
    let shortest = size.into_iter().fold(f64::INFINITY, f64::min);
    // Up to where nothing of its sides is left.
    let rounding = if once_in(random, 4) { 0.5 * shortest * random.between(0.1, 1.1).min(1.0) } else { 0.0 };
    let cuboid = RectBox {
        center: if copied { [0.0; 3] } else { center }.into(),
        size: PerAxis(size).into(),
        rounding: rounding.into(),
        material: inline(material),
        transform: if once_in(random, 2) { steps(random) } else { Vec::new() },
        placements: if copied { std::iter::once(there).collect() } else { Placements::One },
        camera_visible: true,
        name: Name::default(),
    };
    world.desc.objects.push(Object::Box(Box::new(cuboid)).into());
}

/// The colour of an amount: this one, or a texture where the amount is of points.
fn color_of(world: &mut World, amount: &Amount, tint: Color, random: &mut Random) -> Albedo {
    let of_points = matches!(amount, Amount::Radiance(_) | Amount::Luminance(_));
    if of_points && once_in(random, 3) { textured(world, random) } else { tint.into() }
}

/// Makes objects that shine of some of the lamps, within the spheres that those were and about as strong.
pub fn other_lamps(world: &mut World, random: &mut Random) {
    for light in std::mem::take(&mut world.desc.lights) {
        let Light::SphereLight(lamp) = &light.value;
        let Amount::Radiance(color) = lamp.amount.value else {
            world.desc.lights.push(light);
            continue;
        };
        let (center, radius) = (lamp.center.value, lamp.radius.value);
        let two_sided = once_in(random, 2);
        let strength = magnitude(random, 0.5, 2.0);
        // Of a power that of a ball's surface.
        let power = 4.0 * (std::f64::consts::PI * radius).powi(2);
        let seen = 683.0 * strength * Number::of_color(color);
        let kind = random.below(9);
        // What a ball shows of itself. Only balls and flat shapes have an intensity.
        let disc = std::f64::consts::PI * radius * radius;
        let (amount, tint) = match random.below(8) {
            // Of solids nobody knows the area.
            _ if kind == 8 => (Amount::Radiance(color.map(|c| c * strength)), [1.0; 3]),
            3 if matches!(kind, 0 | 1 | 3) => (Amount::Intensity(color.map(|c| c * strength * disc)), [1.0; 3]),
            4 if matches!(kind, 0 | 1 | 3) => (Amount::LuminousIntensity(seen * disc), color),
            0 => (Amount::Power(color.map(|c| c * strength * power)), [1.0; 3]),
            1 => (Amount::LuminousPower(seen * power), color),
            2 => (Amount::Luminance(seen), color),
            _ => (Amount::Radiance(color.map(|c| c * strength)), [1.0; 3]),
        };
        let material = Material::Emissive(Box::new(Emissive {
            color: color_of(world, &amount, tint, random),
            amount: amount.into(),
            two_sided,
            group: lamp.group.clone(),
        }));
        match kind {
            5 | 6 => super::curved::shape(world, center, radius, material, random),
            7 => super::curved::ball(world, center, radius, material, random),
            8 => super::solids::lamp(world, center, radius, material, random),
            0 | 1 => rectangle(world, center, radius, material, random),
            2 => cuboid(world, center, radius, material, random),
            3 => world.sphere(center, radius, material),
            _ => {
                let shape = if once_in(random, 2) { Shape::ball(1) } else { Shape::ring(0.4, 12, 6) };
                let file = world.file("lamp", "obj", shape.obj().into_bytes());
                let size = Transform::Scale { factor: [0.7 * radius; 3], about: None };
                world.placed(file, material, vec![size, Transform::Translate(center)]);
            }
        }
    }
}
