//! Solids that stand on an opaque floor with a flat side of theirs, under which all lamps are: the picture is black.

use super::draw::{self, one_of};
use super::world::World;
use scene_format::{Syntax, load_str};
use std::path::Path;
use tracer_reference::Random;

/// A few bodies of glass, metal and matt stuff on a floor of one of the flat shapes.
pub fn standing(world: &mut World, random: &mut Random) {
    let size = draw::magnitude(random, 0.02, 50.0);
    let height = one_of(random, &[0.0, 1.0, 0.1, -3.7, 12.34]) * size;
    let floor = one_of(
        random,
        &[
            "Rectangle(center: (0, @, 0), size: {40}, material: Diffuse(albedo: 0.7))",
            "Plane(point: (0, @, 0), material: Diffuse(albedo: 0.7))",
            "Box(center: (0, \"=@ - {0.5}\", 0), size: ({30}, {1}, {30}), material: Diffuse(albedo: 0.7))",
            "Cylinder(from: (0, \"=@ - {0.5}\", 0), to: (0, @, 0), radius: {20}, material: Diffuse(albedo: 0.7))",
            "Difference(objects: [Box(center: (0, \"=@ - {0.5}\", 0), size: ({30}, {1}, {30})), \
             Box(center: ({9}, @, 0), size: {1})], material: Diffuse(albedo: 0.7))",
        ],
    );
    let mut objects = vec![floor.to_owned()];
    for k in 0..1 + random.below(4) {
        let place = [1.3 * (k % 2) as f64 - 0.6, 1.3 * (k / 2) as f64 - 0.6];
        objects.push(body(place, random));
    }
    for _ in 0..1 + random.below(2) {
        let (x, z, radius) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(0.1, 0.6));
        let center = format!("({{{x}}}, \"=@ - {{2}}\", {{{z}}})");
        objects.push(format!("Sphere(center: {center}, radius: {{{radius}}}, material: Emissive(radiance: 100))"));
    }
    let text = written(&format!("Scene(background: 0, objects: [{}])", objects.join(",\n")), size, height);
    // What this writes is right.
    let Ok(loaded) = load_str("standing.ron", &text, Syntax::Ron, Path::new(""), &[]) else { return };
    world.desc.objects.extend(loaded.scene.objects);
    let eye = [random.between(-2.0, 2.0) * size, height + random.between(0.5, 3.0) * size, 4.0 * size];
    world.camera(eye, [0.0, height + 0.3 * size, 0.0], random.between(25.0, 50.0));
}

/// With numbers in braces times this size, and the floor's height for `@`.
fn written(text: &str, size: f64, height: f64) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        let (number, after) = after.split_once('}').unwrap_or((after, ""));
        out += before;
        out += &format!("{}", number.parse::<f64>().unwrap_or(1.0) * size);
        rest = after;
    }
    (out + rest).replace('@', &format!("{height}"))
}

/// A solid on the floor.
fn body([x, z]: [f64; 2], random: &mut Random) -> String {
    let (radius, high) = (random.between(0.2, 0.6), random.between(0.3, 1.2));
    let at = |up: f64| format!("({{{x}}}, \"=@ + {{{up}}}\", {{{z}}})");
    let ior = random.between(1.2, 2.0);
    let material = match random.below(5) {
        0 => "Mirror(reflectance: 0.9)".to_owned(),
        1 => "Diffuse(albedo: 0.6)".to_owned(),
        2 => format!("Conductor(metal: Gold, roughness: {})", random.between(0.05, 0.5)),
        _ => format!("Transparent(ior: {ior})"),
    };
    let cylinder = |from: f64, to: f64, share: f64| {
        format!("Cylinder(from: {}, to: {}, radius: {{{}}})", at(from), at(to), share * radius)
    };
    let block = format!("Box(center: {}, size: ({{{}}}, {{{high}}}, {{{radius}}}))", at(0.5 * high), 2.0 * radius);
    let ball = |up: f64, share: f64| format!("Sphere(center: {}, radius: {{{}}})", at(up), share * radius);
    let (kind, parts) = match random.below(5) {
        0 => ("Difference", [cylinder(0.0, high, 1.0), cylinder(0.1 * high, 1.2 * high, 0.8)]),
        1 => ("Union", [block, ball(high, 0.7)]),
        2 => ("Difference", [block, cylinder(0.0, 2.0 * high, 0.4)]),
        3 => ("Intersection", [ball(0.0, 1.0), format!("Plane(point: {}, normal: (0, -1, 0))", at(0.0))]),
        _ => {
            let cone = format!("Cone(from: {}, to: {}, radius: {{{radius}}}, tip_radius: {{0.1}})", at(0.0), at(high));
            ("Difference", [cone, ball(high, 0.5)])
        }
    };
    format!("{kind}(objects: [{}], material: {material})", parts.join(", "))
}
