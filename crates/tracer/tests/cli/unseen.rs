//! Solids of which nothing is left, what takes nothing away, and what lies behind a plane: warned of by `check` and
//! `render`.

use crate::support::Sandbox;
use crate::unmeant::{codes, scene};

#[test]
fn solids_of_which_nothing_is_left_are_told() {
    let sandbox = Sandbox::new();
    let code = |objects: &str| codes(&sandbox, &scene("background: 0.5,", objects));
    let ball = |x: f64, radius: f64| format!("Sphere(center: ({x}, 0, 0), radius: {radius})");
    let of = |word: &str, parts: &[&str]| format!("{word}(objects: [{}])", parts.join(", "));
    let [here, there, large] = [ball(0.0, 1.0), ball(2.1, 1.0), ball(0.0, 2.0)];
    let beside = |x: &str| format!("Box(center: ({x:?}, 0, 0), size: 1)");
    let torus = "Torus(radius: 1, tube_radius: 0.25)";
    for nothing in [
        of("Intersection", &[&here, &there]),
        // Their boxes overlap.
        of("Intersection", &[&here, "Sphere(center: (1.3, 1.3, 1.3), radius: 1)"]),
        of("Intersection", &[torus, &ball(0.0, 0.7)]),
        // Two and two of them overlap.
        of("Intersection", &["Box(size: 2)", &ball(1.5, 1.0), &ball(-0.4, 0.6)]),
        of("Difference", &[&here, &large]),
        of("Difference", &[&here, &here]),
        // Covered by two.
        of("Difference", &["Box(size: 1)", &ball(0.5, 0.9), &ball(-0.5, 0.9)]),
        of("Union", &[&here, &of("Intersection", &[&here, &there])]),
        of("Difference", &[&large, &of("Difference", &[&here, &large])]),
        format!(
            "Repeat(count: 3, index: \"i\", items: [{}])",
            of("Intersection", &["Box(size: 1)", &beside("=2 + i")])
        ),
    ] {
        assert!(code(&nothing).contains(&"W0323".to_owned()), "{nothing}");
    }
    for something in [
        of("Intersection", &[&here, &ball(1.9, 1.0)]),
        of("Difference", &[&large, &here]),
        // A thin shell, a plate, a lens.
        of("Difference", &[&here, &ball(0.0, 0.9999)]),
        of("Difference", &["Box(size: 1)", "Box(center: (0, 0.001, 0), size: 1)"]),
        of("Intersection", &[&here, "Sphere(center: (0, 0, 1.99), radius: 1)"]),
        of("Intersection", &["Plane()", &here]),
        of("Difference", &[&here, "Plane()"]),
        // Some of the copies only.
        format!("Repeat(count: 3, index: \"i\", items: [{}])", of("Intersection", &["Box(size: 1)", &beside("=i")])),
    ] {
        assert_eq!(code(&something), [""; 0], "{something}");
    }
}

#[test]
fn what_takes_nothing_away_is_told() {
    let sandbox = Sandbox::new();
    let code = |objects: &str| codes(&sandbox, &scene("background: 0.5,", objects));
    let of = |parts: &str| format!("Difference(objects: [{parts}])");
    for nothing in [
        "Box(size: 1), Sphere(center: (2, 0, 0), radius: 1)",
        "Box(size: 1), Cylinder(from: (2, -1, 0), to: (2, 1, 0), radius: 0.25)",
        "Box(size: 1), Sphere(center: (0, 0, 0), radius: 0.6), Sphere(center: (0, 3, 0), radius: 0.6)",
        "Box(size: 1), Plane(point: (0, -2, 0))",
        "Box(size: 1), Union(objects: [Box(center: (3, 0, 0), size: 1), Box(center: (4, 0, 0), size: 1)])",
        "Box(size: 1), Repeat(count: 3, index: \"i\", items: [Box(center: (\"=2 + i\", 0, 0), size: 1)])",
    ] {
        assert_eq!(code(&of(nothing)), ["W0324"], "{nothing}");
    }
    for something in [
        "Box(size: 1), Sphere(center: (1, 0, 0), radius: 0.6)",
        "Box(size: 1), Plane(point: (0, 0.2, 0))",
        // Some of the windows are in the wall.
        "Box(size: 1), Repeat(count: 3, index: \"i\", items: [Box(center: (\"=0.4 + 0.9 * i\", 0, 0), size: 1)])",
    ] {
        assert!(code(&of(something)).is_empty(), "{something}");
    }
}

#[test]
fn what_lies_behind_a_plane_is_told() {
    let sandbox = Sandbox::new();
    let code = |objects: &str| codes(&sandbox, &scene("background: 0.5,", objects));
    let seen = "Sphere(center: (0, 1, 0), radius: 1)";
    for hidden in [
        "Sphere(center: (0, -2, 0), radius: 1)",
        "Box(center: (0, -1, 0), size: 1)",
        "Cylinder(from: (0, -3, 0), to: (1, -1, 0), radius: 0.5)",
        "Difference(objects: [Box(center: (0, -3, 0), size: 1), Sphere(center: (0, -3, 0), radius: 0.6)])",
        "Sphere(center: (0, -2, 0), radius: 1, material: Emissive(radiance: 3))",
        "Sphere(center: (0, -2, 0), radius: 1, placements: [[], [Translate((-3, -1, 0))]])",
        "Repeat(count: 3, index: \"i\", items: [Sphere(center: (0, \"=-2 - i\", 0), radius: 1)])",
    ] {
        assert_eq!(code(&format!("Plane(), {seen}, {hidden}")), ["W0325"], "{hidden}");
        // Nobody is hidden by glass, nor from a camera that is there as well.
        for plane in ["Plane(material: Transparent(ior: 1.5))", "Plane(point: (0, 3, 0))"] {
            assert!(!code(&format!("{plane}, {seen}, {hidden}")).contains(&"W0325".to_owned()), "{plane} {hidden}");
        }
    }
    let lamp = "lights: [SphereLight(center: (0, -2, 0), radius: 1, power: 100)],";
    let of_lamp = codes(&sandbox, &scene(&format!("background: 0.5, {lamp}"), &format!("Plane(), {seen}")));
    assert_eq!(of_lamp, ["W0325"]);
    for shown in [
        "Sphere(center: (0, -0.99, 0), radius: 1)",
        "Sphere(center: (0, 1.5, 0), radius: 1)",
        "Box(center: (0, 0, 0), size: 1)",
        "Sphere(center: (0, -2, 0), radius: 1, placements: [[], [Translate((0, 3.5, 0))]])",
        "Repeat(count: 3, index: \"i\", items: [Sphere(center: (0, \"=2 * i - 2.5\", 0), radius: 1)])",
    ] {
        assert!(code(&format!("Plane(), {seen}, {shown}")).is_empty(), "{shown}");
    }
}

/// What is no larger than a few pixels was meant to be seen: a camera in millimetres, say.
#[test]
fn a_scene_that_is_a_speck_is_told() {
    let sandbox = Sandbox::new();
    let at = |z: f64, objects: &str| {
        let light = "SphereLight(center: (300, 400, 500), radius: 50, power: 1e6)";
        sandbox.write(
            "speck.ron",
            format!(
                "Scene(image: Image(width: 200, height: 150), camera: Camera(position: (0, 0, {z:?}), \
                 look_at: (0, 0, 0)), lights: [{light}], objects: [{objects}])"
            ),
        );
        sandbox.run(&["check", "speck.ron"]).ends(0).err
    };
    for objects in ["Box(size: 1)", "Sphere(center: (0, 0, 0), radius: 0.5), Box(center: (1, 0, 0), size: 0.5)"] {
        let told = at(500.0, objects);
        assert!(told.contains("warning[W0317]: all that the scene has is seen in"), "{told}");
        assert!(told.contains("the camera is 500 away from it"), "{told}");
        assert_eq!(at(5.0, objects), "");
    }
    // A mesh is brought to half of the view's height, where the camera looks; then nothing is said of it.
    sandbox.write("box.off", "OFF\n4 2 0\n8 0 0\n9 0 0\n9 1 0\n8 1 1\n3 0 1 2\n3 0 2 3\n");
    let told = at(500.0, "Mesh(file: \"box.off\")");
    let steps = "transform: [FitTo(size: 180), CenterTo((0, 0, 0))]";
    assert!(told.contains(&format!("A mesh is brought there by `{steps}`")), "{told}");
    assert_eq!(at(500.0, &format!("Mesh(file: \"box.off\", {steps})")), "");
    let told = at(500.0, "Box(size: 1), Plane(point: (0, -1, 0))");
    assert!(told.contains("warning[W0317]: all that the scene has beside its planes is seen in"), "{told}");
    assert_eq!(at(500.0, "Box(size: 1), Box(center: (30, 0, 0), size: 1)"), "");
    assert_eq!(at(500.0, "Plane(point: (0, -1, 0))"), "");
}
