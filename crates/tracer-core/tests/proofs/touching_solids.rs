//! Solids whose flat walls lie in one plane with flat faces of other things: nothing gets between what touches, and
//! what lies flush in a wall is seen.

use crate::support::{compiled, film};
use scene_format::{SceneDesc, Syntax, load_str};
use std::path::Path;
use tracer_reference::{Reference, Smoothing};

fn described(camera: &str, objects: &str) -> SceneDesc {
    let text = format!(
        "Scene(image: Image(width: 32, height: 32), render: Render(max_bounces: 12), camera: Camera({camera}), \
         objects: [{objects}])"
    );
    load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}\n{text}")).scene
}

/// The brightest and the least of all pixels.
fn range(desc: &SceneDesc) -> [f64; 2] {
    let film = film(&compiled(desc), 64, 1);
    let pixels = (0..32 * 32).map(|k| film.radiance(k % 32, k / 32)[0]);
    pixels.fold([0.0, f64::INFINITY], |[most, least], x| [f64::max(most, x), least.min(x)])
}

/// The same of every fourth pixel as the reference sees it.
fn range_of_reference(desc: &SceneDesc) -> [f64; 2] {
    let scene = compiled(desc);
    let reference = Reference::new(&scene, Smoothing::Hanika);
    let pixels = (0..16 * 16).map(|k| reference.pixel([2 * (k % 16), 2 * (k / 16)], 8, 1)[0].x);
    pixels.fold([0.0, f64::INFINITY], |[most, least], x| [f64::max(most, x), least.min(x)])
}

/// A tumbler on a table, and other bodies.
const BODIES: [&str; 4] = [
    "Difference(material: @, objects: [Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 0.5), \
     Cylinder(from: (0, 0.1, 0), to: (0, 1.1, 0), radius: 0.4)])",
    "Union(material: @, objects: [Box(center: (0, 0.4, 0), size: 0.8)])",
    "Difference(material: @, transform: [Rotate(axis: (0, 1, 0), degrees: 20)], objects: [\
     Box(center: (0, 0.4, 0), size: 0.8), Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 0.2)])",
    "Intersection(material: @, objects: [Sphere(center: (0, 0, 0), radius: 0.7), Plane(normal: (0, -1, 0))])",
];

/// Each of them of each material on each kind of floor, over a lamp.
fn over_a_lamp() -> impl Iterator<Item = SceneDesc> {
    let lamp = "Sphere(center: (0, -1.5, 0), radius: 0.4, material: Emissive(radiance: 50))";
    let floors = [
        "Rectangle(size: 40, material: Diffuse(albedo: 0.7))",
        "Plane(material: Diffuse(albedo: 0.7))",
        "Box(center: (0, -0.5, 0), size: (30, 1, 30), material: Diffuse(albedo: 0.7))",
        "Cylinder(from: (0, -0.5, 0), to: (0, 0, 0), radius: 30, material: Diffuse(albedo: 0.7))",
        "Difference(objects: [Box(center: (0, -0.5, 0), size: (30, 1, 30)), Box(center: (9, 0, 0), size: 1)])",
    ];
    let materials = ["Transparent(ior: 1.5)", "Diffuse(albedo: 0.6)", "Mirror(reflectance: 0.9)"];
    let all = BODIES.into_iter().flat_map(move |body| materials.map(|material| body.replace('@', material)));
    all.flat_map(move |body| {
        let camera = "position: (0.5, 2.2, 4), look_at: (0, 0.3, 0), fov: 30";
        floors.map(|floor| described(camera, &format!("{floor}, {body}, {lamp}")))
    })
}

/// A lamp under an opaque floor shines through nothing that stands on it. Seven is prime: each body, material and floor
/// is among the scenes of which one in seven is taken.
#[test]
fn nothing_gets_between_a_solid_and_what_it_stands_on() {
    for desc in over_a_lamp().step_by(7) {
        assert_eq!(range(&desc)[0], 0.0, "{:?}", desc.objects);
    }
}

/// All of them.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn nothing_gets_between_any_solid_and_any_floor() {
    for desc in over_a_lamp() {
        assert_eq!(range(&desc)[0], 0.0, "{:?}", desc.objects);
    }
}

/// Nor does it for the reference, which has no parts of solids but asks what is inside of each shape.
#[test]
fn nothing_gets_between_them_for_the_reference() {
    for desc in over_a_lamp() {
        assert_eq!(range_of_reference(&desc)[0], 0.0, "{:?}", desc.objects);
    }
}

/// Without light outside, no light comes out under a shade that stands on the floor.
#[test]
fn no_light_comes_out_under_a_shade_of_solids() {
    let shade =
        "Difference(objects: [Box(center: (0, 0.5, 0), size: 1), Box(center: (0, 0.4, 0), size: (0.9, 1, 0.9))])";
    let lamp = "Sphere(center: (0, 0.4, 0), radius: 0.1, material: Emissive(radiance: 50))";
    for floor in ["Rectangle(size: 40)", "Plane()", "Box(center: (0, -0.5, 0), size: (30, 1, 30))"] {
        let desc =
            described("position: (0.5, 2.2, 4), look_at: (0, 0.3, 0), fov: 30", &format!("{floor}, {shade}, {lamp}"));
        assert_eq!(range(&desc)[0], 0.0, "{floor}");
    }
}

/// What lies in a wall of a solid and faces the same way is seen, all of it: the camera sees nothing else.
#[test]
fn what_lies_flush_in_a_wall_is_seen() {
    let lamp = "Emissive(radiance: 3)";
    for wall in [
        "Union(objects: [Box(center: (0, -0.5, 0), size: (6, 1, 6))])",
        "Difference(objects: [Box(center: (0, -0.5, 0), size: (6, 1, 6)), Sphere(center: (2, 0, 2), radius: 0.5)])",
        "Difference(material: Mirror(), objects: [Box(center: (0, 0, 0), size: (6, 2, 6)), \
         Box(center: (0, 1, 0), size: (5, 2, 5))])",
    ] {
        for flush in [
            format!("Rectangle(size: 2, material: {lamp})"),
            format!("Disk(radius: 1, material: {lamp})"),
            format!("Polygon(points: [(-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)], material: {lamp})"),
        ] {
            let camera = "position: (0, 3, 0.5), look_at: (0, 0, 0), fov: 20";
            let desc = described(camera, &format!("{wall}, {flush}"));
            for [most, least] in [range(&desc), range_of_reference(&desc)] {
                assert!((most - 3.0).abs() < 1e-5 && (least - 3.0).abs() < 1e-5, "{wall} {flush}: {least} to {most}");
            }
        }
    }
}
