//! Mistakes of those who come from other programs, which compile: warned of by `check` and `render`.

use crate::support::Sandbox;
use crate::unmeant::{codes, scene};

const BALL: &str = "Sphere(center: (0, 1, 0), radius: 1)";

fn told(top: &str, objects: &str) -> Vec<String> {
    codes(&Sandbox::new(), &scene(&format!("background: 0.5, {top}"), objects))
}

#[test]
fn round_walls_in_one_place_are_told() {
    let matt = |color: f64| format!("Diffuse(albedo: {color})");
    let shining = "Emissive(radiance: 3)".to_owned();
    let glass = "Transparent(ior: 1.5)".to_owned();
    let pillar =
        |material: &str| format!("Cylinder(from: (0, 0, 0), to: (0, 2, 0), radius: 0.5, material: {material})");
    let band = |radius: f64, material: &str| {
        format!("Cylinder(from: (0, 0.5, 0), to: (0, 1, 0), radius: {radius}, caps: false, material: {material})")
    };
    for (of_pillar, of_band) in
        [(matt(0.5), shining.clone()), (matt(0.5), matt(0.2)), (glass.clone(), matt(0.2)), (shining.clone(), matt(0.5))]
    {
        let both = |radius: f64| told("", &format!("{}, {}", pillar(&of_pillar), band(radius, &of_band)));
        assert_eq!(both(0.5)[..1], ["W0321"], "{of_pillar} {of_band}");
        assert!(both(0.505).is_empty(), "{of_pillar} {of_band}");
    }
    // Which of two that are the same is seen nobody sees.
    assert!(told("", &format!("{}, {}", pillar(&matt(0.5)), band(0.5, &matt(0.5)))).is_empty());
    let stacked = "Cylinder(from: (0, 2, 0), to: (0, 3, 0), radius: 0.5, material: Diffuse(albedo: 0.2))";
    assert!(told("", &format!("{}, {stacked}", pillar(&matt(0.5)))).is_empty());
    // A lamp as large as the ball that it is in.
    let lamp = "lights: [SphereLight(center: (0, 3, 0), radius: 0.5, power: 100)],";
    assert_eq!(told(lamp, &format!("{BALL}, Sphere(center: (0, 3, 0), radius: 0.5)")), ["W0307"]);
}

#[test]
fn copies_that_turn_in_one_place_are_told() {
    let ring = |shape: &str, about: &str| {
        let transform =
            format!("transform: [Translate((1.6, 0, 0)), Rotate(axis: (0, 1, 0), degrees: \"=30*i\"{about})]");
        format!("Repeat(count: 12, items: [{}])", shape.replace('@', &transform))
    };
    for shape in ["Box(size: (0.5, 0.5, 0.3), @)", "Sphere(center: (0, 0, 0), radius: 0.3, @)"] {
        let in_union = |about: &str| format!("Union(objects: [Box(size: 1), {}])", ring(shape, about));
        assert_eq!(told("", &ring(shape, "")), ["W0316"], "{shape}");
        assert_eq!(told("", &in_union("")), ["W0316"], "{shape}");
        assert!(told("", &ring(shape, ", about: (0, 0, 0)")).is_empty(), "{shape}");
        assert!(told("", &in_union(", about: (0, 0, 0)")).is_empty(), "{shape}");
    }
    // One that is turned, and a star about its own middle.
    assert!(
        told("", "Box(size: 1, transform: [Translate((1, 0, 0)), Rotate(axis: (0, 1, 0), degrees: 30)])").is_empty()
    );
    let star = "Repeat(count: 3, items: [Box(center: (0, 1, 0), size: (2, 0.3, 0.3), transform: [\
                Rotate(axis: (0, 0, 1), degrees: \"=60*i\")])])";
    assert!(!told("", star).contains(&"W0316".to_owned()));
}

#[test]
fn numbers_of_other_programs_are_told() {
    let with_camera = |camera: &str| {
        let text = scene("background: 0.5,", BALL).replace("look_at: (0, 0.5, 0)", camera);
        codes(&Sandbox::new(), &text)
    };
    assert_eq!(with_camera("look_at: (0, 0.5, 0), focal_length: 0.05")[..1], ["W0317"]);
    assert!(with_camera("look_at: (0, 0.5, 0), focal_length: 50").is_empty());
    assert_eq!(with_camera("look_at: (0, 0.5, 0), up: (0, 0.001, 1)"), ["W0317"]);
    assert_eq!(with_camera("look_at: (0, 0.5, 0), up: (0, 0, 1)"), ["W0317"]);
    assert!(with_camera("look_at: (0, 0.5, 0), up: (0.1, 1, 0)").is_empty());
    let down = with_camera("look_at: (0.001, -9, 5.9)");
    assert!(!down.contains(&"W0317".to_owned()), "nearly straight down");
    let random = |call: &str| {
        told("", &format!("Repeat(count: 3, items: [Sphere(center: (\"=2*i - 2\", \"={call}\", 0), radius: 0.5)])"))
    };
    assert_eq!(random("random(-1, 1)"), ["W0317"]);
    assert!(random("random(i, 1)").is_empty());
    let lens = |aperture: &str| {
        let lens = format!("effects: Effects(depth_of_field: ThinLens(aperture: {aperture}, focus_distance: 6)),");
        told(&lens, BALL)
    };
    assert_eq!(lens("30"), ["W0317"]);
    assert!(lens("0.3").is_empty());
    let animated = |ball: &str| told("animation: Animation(frames: 24),", ball);
    assert_eq!(animated(BALL), ["W0403"]);
    assert!(animated("Sphere(center: (0, \"=1 + time\", 0), radius: 1)").is_empty());
    assert!(animated("Sphere(center: (0, 1, 0), radius: \"=1 + 0*frame\")").is_empty());
}

/// Half of what is seen is so bright that its colours are lost.
#[test]
fn colours_that_are_too_bright_are_told() {
    let lit = |power: u32| {
        let lamp = format!("lights: [SphereLight(center: (0, 5, 4), radius: 1, power: {power})],");
        let floor = "Rectangle(size: 40, material: Diffuse(albedo: (0.2, 0.5, 0.8)))";
        codes(&Sandbox::new(), &scene(&lamp, &format!("{floor}, {BALL}")).replace("samples: 2", "samples: 16"))
    };
    assert!(lit(300).is_empty());
    assert_eq!(lit(3000), ["W0318"]);
}

/// What an expression names beside `time` is not unused where there is no such frame.
#[test]
fn names_are_used_where_there_is_no_frame() {
    let sandbox = Sandbox::new();
    let vars = "vars: { \"T\": 3 }, animation: Animation(frames: 4), background: 1,";
    sandbox.write("film.ron", scene(vars, "Sphere(center: (\"=cos(360*time/T)\", 1, 0), radius: 1)"));
    let ran = sandbox.run(&["render", "film.ron", "--frame", "9", "-o", "a.png"]).ends(2);
    assert!(!ran.err.contains("W0402") && ran.err.contains("there is no frame 9"), "{}", ran.err);
    sandbox.run(&["render", "film.ron", "--frames", "0-9", "-o", "a_#.png"]).ends(2).says(&["Animation(frames: 10)"]);
    sandbox.run(&["render", "film.ron", "--frames", "5-9", "-o", "a_#.png"]).ends(2).says(&["Animation(frames: 10)"]);
    sandbox.run(&["render", "film.ron", "--frame", "all"]).ends(2).says(&["--frames all"]);
    sandbox.run(&["render", "film.ron", "--set", "camera.fov", "20"]).ends(2).says(&["--set camera.fov=20"]);
    sandbox.run(&["render", "film.ron", "--layers", "albedo", "depth"]).ends(2).says(&["--layers albedo,depth"]);
}
