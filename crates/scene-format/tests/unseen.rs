//! What is asked for and cannot be seen is told, and nothing else is.

use scene_format::{Syntax, load_str};
use std::path::Path;

fn of_object(object: &str) -> String {
    format!("Scene(background: 1, objects: [{object}])")
}

/// The codes of the warnings of a scene.
fn warnings(scene: &str) -> Vec<String> {
    let loaded = load_str("scene", scene, Syntax::Ron, Path::new(""), &[]).expect("a scene");
    loaded.warnings.iter().map(|fault| fault.code.to_string()).collect()
}

#[test]
fn a_checkerboard_of_one_square_is_told() {
    let of = |shape: &str, mapping: &str| {
        warnings(&of_object(&format!("{shape}material: Diffuse(albedo: Checkerboard({mapping})))")))
    };
    for shape in
        ["Sphere(radius: 1, ", "Box(", "Cylinder(radius: 1, ", "Torus(radius: 1, tube_radius: 0.3, ", "Rectangle("]
    {
        assert_eq!(of(shape, ""), ["W0326"], "{shape}");
        assert_eq!(of(shape, "mapping: Uv(scale: 0.5)"), ["W0326"], "{shape}");
        for several in ["Uv(scale: 8)", "Uv(scale: (1, 2))", "Uv(rotation: 45)", "Uv(offset: (0.5, 0))", "Object()"] {
            assert!(of(shape, &format!("mapping: {several}")).is_empty(), "{shape} {several}");
        }
    }
    assert!(of("Box(", "a: 0.5, b: 0.5").is_empty());
    let shifted = of_object("Box(material: Diffuse(albedo: Checkerboard(mapping: Uv(offset: (1, 2)))))");
    let told = load_str("scene", &shifted, Syntax::Ron, Path::new(""), &[]).expect("a scene").warnings;
    assert!(told.len() == 1 && told[0].message.ends_with("only its `b` is seen"), "{told:?}");
    // What has no end shows more; coordinates of meshes are their own, and polygons may have others.
    assert!(of("Plane(", "").is_empty());
    assert!(of("Mesh(points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]], ", "").is_empty());
    let named = |objects: &str| {
        let materials = "textures: { \"t\": Checkerboard() }, materials: { \"c\": Diffuse(albedo: \"t\") }";
        warnings(&format!("Scene(background: 1, {materials}, objects: [{objects}])"))
    };
    assert_eq!(named("Box(material: \"c\"), Sphere(radius: 1, material: \"c\")"), ["W0326"]);
    // On the floor it is what it is meant to be.
    assert!(named("Plane(material: \"c\"), Box(material: \"c\")").is_empty());
    // Each is told once, however often a rule makes it.
    let many = "Repeat(count: 9, items: [Box(center: (\"=2*i\", 0, 0), material: Diffuse(albedo: Checkerboard()))])";
    assert_eq!(warnings(&of_object(many)), ["W0326"]);
}

#[test]
fn groups_of_lights_without_a_light_of_one_are_told() {
    let of = |more: &str| warnings(&format!("Scene(output: Output(light_groups: true), {more})"));
    assert_eq!(of("background: 1, objects: [Box()]"), ["W0404"]);
    let lamp = "SphereLight(center: (0, 5, 0), radius: 1, power: 9, group: \"key\")";
    for light in [
        format!("lights: [{lamp}], objects: [Box()]"),
        format!("objects: [Box(), Group(objects: [Box(size: 2)], lights: [{lamp}])]"),
        "objects: [Box(material: Emissive(radiance: 1, group: \"key\"))]".to_owned(),
        "materials: { \"m\": Emissive(radiance: 1, group: \"key\") }, objects: [Box(material: \"m\")]".to_owned(),
        "background: Environment(file: \"sky.hdr\", group: \"key\"), objects: [Box()]".to_owned(),
    ] {
        assert!(of(&light).is_empty(), "{light}");
    }
}
