//! What compiles and is surely not meant: warned of by `check` and `render`.

use crate::support::{Sandbox, repository};

const CUBE: [[i32; 3]; 12] = [
    [1, 3, 2],
    [1, 4, 3],
    [5, 6, 7],
    [5, 7, 8],
    [1, 2, 6],
    [1, 6, 5],
    [2, 3, 7],
    [2, 7, 6],
    [3, 4, 8],
    [3, 8, 7],
    [4, 1, 5],
    [4, 5, 8],
];

/// A cube in OBJ, its faces wound this way or the other.
fn cube(outwards: bool) -> String {
    let mut text = String::new();
    for z in [0, 1] {
        text += &format!("v 0 0 {z}\nv 1 0 {z}\nv 1 1 {z}\nv 0 1 {z}\n");
    }
    for [a, b, c] in CUBE {
        let [b, c] = if outwards { [b, c] } else { [c, b] };
        text += &format!("f {a} {b} {c}\n");
    }
    text
}

/// A scene of some objects, its camera at (0, 1, 6).
pub fn scene(top: &str, objects: &str) -> String {
    format!(
        "Scene(camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0)), image: Image(width: 16, height: 16), \
         render: Render(samples: 2), {top} objects: [{objects}])"
    )
}

/// The codes of warnings that both commands give.
pub fn codes(sandbox: &Sandbox, scene: &str) -> Vec<String> {
    sandbox.write("odd.ron", scene);
    let of = |arguments: &[&str]| -> Vec<String> {
        let ran = sandbox.run(&[arguments, &["--diagnostics", "json"]].concat()).ends(0);
        let lines = ran.err.lines().filter(|line| line.starts_with('{'));
        let value = |line: &str| serde_json::from_str::<serde_json::Value>(line).expect("JSON");
        lines.map(|line| value(line)["code"].as_str().expect("a code").to_owned()).collect()
    };
    let (checked, rendered) = (of(&["check", "odd.ron"]), of(&["render", "odd.ron", "-o", "a.png"]));
    assert_eq!(rendered[..checked.len()], checked[..]);
    rendered
}

#[test]
fn a_texture_needs_coordinates() {
    let sandbox = Sandbox::new();
    sandbox.write("cube.obj", cube(true));
    sandbox.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    let with = |file: &str| format!("Mesh(file: {file:?}, material: Diffuse(albedo: Checkerboard()))");
    assert_eq!(codes(&sandbox, &scene("background: 1,", &with("cube.obj"))), ["W0521"]);
    assert!(codes(&sandbox, &scene("background: 1,", &with("flat.obj"))).is_empty());
    // The way that is offered works.
    sandbox.write("odd.ron", scene("background: 1,", &with("cube.obj")));
    sandbox.run(&["check", "odd.ron"]).ends(0).says(&["W0521", "write `mapping: Triplanar()` in the texture"]);
    let mended = with("cube.obj").replace("Checkerboard()", "Checkerboard(mapping: Triplanar())");
    assert!(codes(&sandbox, &scene("background: 1,", &mended)).is_empty());
    assert!(codes(&sandbox, &scene("background: 1,", "Mesh(file: \"cube.obj\")")).is_empty());
}

#[test]
fn glass_inside_out_is_told() {
    let sandbox = Sandbox::new();
    sandbox.write("out.obj", cube(true));
    sandbox.write("in.obj", cube(false));
    // Not closed: it has no inside, which is told in other words.
    sandbox.write("open.obj", cube(false).lines().take(19).map(|line| format!("{line}\n")).collect::<String>());
    let with = |file: &str, material: &str| {
        scene(
            "background: (1, 0.5, 0.2),",
            &format!("Mesh(file: {file:?}, material: {material}), Sphere(center: (2, 0, 0), radius: 0.5)"),
        )
    };
    assert_eq!(codes(&sandbox, &with("in.obj", "Transparent(ior: 1.5)")), ["W0305"]);
    // To mirror it turns nothing: its outside stays inside.
    let mirrored = "Transparent(ior: 1.5), transform: [Scale((-1, 1, 1))]";
    assert_eq!(codes(&sandbox, &with("in.obj", mirrored)), ["W0305"]);
    assert!(codes(&sandbox, &with("out.obj", mirrored)).is_empty());
    assert_eq!(codes(&sandbox, &with("open.obj", "Transparent(ior: 1.5)")), ["W0310"]);
    for (file, material) in [("out.obj", "Transparent(ior: 1.5)"), ("in.obj", "Diffuse()")] {
        assert!(codes(&sandbox, &with(file, material)).is_empty(), "{file} {material}");
    }
}

#[test]
fn who_is_shut_in_is_told() {
    let sandbox = Sandbox::new();
    let lamp = "lights: [SphereLight(center: (0, 3, 0), radius: 0.5, radiance: 10)],";
    let ball = "Sphere(center: (0, 0, 0), radius: 1)";
    let code = |top: &str, objects: &str| codes(&sandbox, &scene(top, objects));
    // The camera in a ball, a box, a box that is turned. That the picture is black then is told once.
    sandbox.write("box.obj", cube(true));
    for solid in [
        "Sphere(center: (0, 1, 6), radius: 2)",
        "Sphere(center: (0, 0, 0), radius: 2, transform: [Translate((0, 1, 6))])",
        "Capsule(from: (0, 0, 6), to: (0, 2, 6), radius: 1)",
        "Group(objects: [Sphere(center: (0, 1, 0), radius: 2)], transform: [Translate((0, 0, 6))])",
        "Mesh(file: \"box.obj\", transform: [Translate((-0.5, 0.5, 5.5))])",
        "Lathe(profile: [(0, 0), (1, 0), (1, 2), (0, 2)], transform: [Translate((0, 0, 6))])",
        "Extrude(outline: [[(-1, -1), (1, -1), (0, 1)]], depth: 2, transform: [Translate((0, 1, 5))])",
        "Box(center: (0, 1, 6), size: 2, rounding: 0.2)",
        "Torus(radius: 6, tube_radius: 1.5)",
        "Difference(objects: [Box(center: (0, 1, 6), size: 4), Sphere(center: (1.5, 1, 6), radius: 0.5)])",
        "Union(objects: [Box(center: (0, 1, 6), size: 1), Sphere(center: (0, 1, 5), radius: 1)])",
        "Difference(objects: [Box(center: (0, 1, 6), size: 4), Box(center: (0, 1, 6), size: 3)])",
        "Box(center: (0, 1, 6), size: 2)",
        "Box(size: 2, transform: [Rotate(axis: (0, 1, 0), degrees: 30), Translate((0, 1, 6))])",
        "Cylinder(from: (-3, 1, 6), to: (2, 1, 6), radius: 1)",
        "Cone(from: (0, -1, 6), to: (0, 5, 6), radius: 1)",
    ] {
        assert_eq!(code(lamp, &format!("{ball}, {solid}")), ["W0306"], "{solid}");
    }
    // A lamp in a ball; in a box that is moved.
    for solid in [
        "Sphere(center: (0, 3, 0), radius: 1)",
        "Box(size: 2, placements: [[Translate((0, 3, 0))]])",
        "Cylinder(from: (-1, 3, 0), to: (1, 3, 0), radius: 0.51)",
        "Cone(from: (0, 2, 0), to: (0, 8, 0), radius: 1)",
        "Group(objects: [Box(size: 2)], placements: [[Translate((0, 3, 0))]])",
        "Mesh(file: \"box.obj\", transform: [Scale(factor: 3, about: (0, 0, 0)), Translate((-1.5, 1.5, -1.5))])",
        "Box(center: (0, 3, 0), size: 2, rounding: 0.2)",
        "Lathe(profile: [(0, 0), (1, 0), (1, 2), (0, 2)], transform: [Translate((0, 2, 0))])",
        "Difference(objects: [Box(center: (0, 3, 0), size: 4), Box(center: (0, 4.5, 0), size: 1)])",
        "Difference(objects: [Sphere(center: (0, 3, 0), radius: 1), Sphere(center: (0, 3, 0), radius: 0.8)])",
        "Union(objects: [Box(center: (0, 3, 0), size: 2), Sphere(center: (0, 3, 0), radius: 0.8)])",
    ] {
        assert_eq!(code(&format!("background: 0.5, {lamp}"), &format!("{ball}, {solid}")), ["W0307"], "{solid}");
    }
    // What shines in a ball.
    let shining =
        "Sphere(center: (0, 3, 0), radius: 0.5, material: Emissive(radiance: 5)), Sphere(center: (0, 3, 0), radius: 1)";
    assert_eq!(code("background: 0.5,", &format!("{ball}, {shining}")), ["W0307"]);
    // Of many lamps in one body it is told once; so is what shines a mesh.
    let three = "lights: [SphereLight(center: (0, 3, 0), radius: 0.1, radiance: 9), SphereLight(center: (0.5, 3, 0), \
                 radius: 0.1, radiance: 9), SphereLight(center: (0, 3, 0.5), radius: 0.1, radiance: 9)],";
    let shade = "Sphere(center: (0, 3, 0), radius: 1)";
    assert_eq!(code(&format!("background: 0.5, {three}"), &format!("{ball}, {shade}")), ["W0307"]);
    sandbox.run(&["check", "odd.ron"]).ends(0).says(&["lights[0] and 2 more are shut in by objects[1]"]);
    let ring =
        "Torus(radius: 0.5, tube_radius: 0.1, transform: [Translate((0, 3, 0))], material: Emissive(radiance: 5))";
    assert_eq!(code("background: 0.5,", &format!("{ball}, {ring}, {shade}")), ["W0307"]);
    // A pane without thickness bends light once.
    let pane = "Rectangle(size: 3, material: Transparent(ior: 1.5))";
    assert_eq!(code("background: 0.5,", &format!("{ball}, {pane}")), ["W0310"]);
    // Water as wide as its glass: both walls are in one place. In a glass that is wider or narrower they are not.
    let filled = |radius: &str| {
        let glass = "Difference(objects: [Cylinder(from: (0, 2, 0), to: (0, 3, 0), radius: 0.5), \
                     Cylinder(from: (0, 2.1, 0), to: (0, 3.1, 0), radius: 0.4)], material: Transparent(ior: 1.5))";
        format!(
            "{ball}, {glass}, Cylinder(from: (0, 2.05, 0), to: (0, 2.7, 0), radius: {radius}, material: \
             Transparent(ior: 1.33))"
        )
    };
    let deep = |objects: &str| {
        let scene = scene("background: 0.5,", objects);
        codes(&sandbox, &scene.replace("samples: 2", "samples: 2, max_bounces: 16"))
    };
    assert_eq!(deep(&filled("0.4")), ["W0321"]);
    sandbox.run(&["check", "odd.ron"]).ends(0).says(&["objects[1] and objects[2]"]);
    for apart in ["0.404", "0.396"] {
        assert!(deep(&filled(apart)).is_empty(), "{apart}");
    }
    // Eight sides of glass and the wall behind them are more than five bounces, and told when that is seen.
    let drink = "Sphere(center: (0, 0, 0), radius: 1, material: Transparent(ior: 1.5)), \
                 Sphere(center: (0, 0, 0), radius: 0.9, material: Transparent(ior: 1)), \
                 Sphere(center: (0, 0, 0), radius: 0.8, material: Transparent(ior: 1.5)), \
                 Sphere(center: (0, 0, 0), radius: 0.7, material: Transparent(ior: 1))";
    let shown = |bounces: u32| {
        let camera = "camera: Camera(position: (0, 0, 4), look_at: (0, 0, 0), fov: 40)";
        let small = format!("image: Image(width: 16, height: 12), render: Render(samples: 2, max_bounces: {bounces})");
        sandbox.write(
            "drink.ron",
            format!(
                "Scene({camera}, {small}, background: 1, objects: [{drink}, \
             Rectangle(center: (0, 0, -3), normal: (0, 0, 1), size: 20)])"
            ),
        );
        sandbox.run(&["render", "drink.ron", "-o", "drink.png"])
    };
    shown(5).ends(0).says(&["W0322", "see nothing but black", "--set render.max_bounces=16"]);
    shown(16).ends(0).silent();
    // A mesh with a hole bends light once, too.
    let of_faces = |faces: &str| {
        let points = "(0, 3, 0), (1, 3, 0), (0, 4, 0), (0, 3, 1)";
        format!("{ball}, Mesh(points: [{points}], faces: [{faces}], material: Transparent(ior: 1.5))")
    };
    assert!(code("background: 0.5,", &of_faces("[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]")).is_empty());
    assert_eq!(code("background: 0.5,", &of_faces("[0, 2, 1], [0, 1, 3], [0, 3, 2]")), ["W0310"]);
    sandbox.run(&["check", "odd.ron"]).ends(0).says(&["3 edges have no face"]);
    // Glass lets light through, a room holds camera and lamp, and a lamp may stick out.
    sandbox.write("room.obj", cube(false));
    for solid in [
        "Mesh(file: \"room.obj\", transform: [Scale(factor: 30, about: (0, 0, 0)), Translate((-15, -15, -15))])",
        "Torus(radius: 6, tube_radius: 0.9)",
        "Difference(objects: [Box(size: 30), Box(size: 20)])",
        "Union(objects: [Box(center: (0, 3, 0), size: 0.9), Sphere(center: (0, 3, 0), radius: 0.3)])",
        "Difference(objects: [Box(center: (0, 1, 6), size: 4, material: Transparent(ior: 1.5)), \
         Sphere(center: (1.5, 1, 6), radius: 0.5)])",
        "Box(center: (0, 1, 6), size: 2, camera_visible: false)",
        "Box(center: (0, 3, 0), size: 2, camera_visible: false)",
        "Sphere(center: (0, 3, 0), radius: 1, material: Transparent(ior: 1.5))",
        "Box(center: (0, 0, 0), size: 20)",
        "Sphere(center: (0, 3, 0), radius: 0.4)",
        "Cylinder(from: (-1, 3, 0), to: (1, 3, 0), radius: 0.49)",
        "Box(center: (0, 3, 0), size: 0.9)",
    ] {
        assert!(code(lamp, &format!("{ball}, {solid}")).is_empty(), "{solid}");
    }
}

/// What is lit within its walls by whatever shines is a room, and so is what one sees into.
#[test]
fn rooms_are_meant() {
    let sandbox = Sandbox::new();
    let code = |top: &str, objects: &str| codes(&sandbox, &scene(top, objects));
    let room = "Box(center: (0, 1, 6), size: 4)";
    let shining = "material: Emissive(radiance: 1)";
    for lamp in [
        format!("Disk(center: (0, 2.9, 6), normal: (0, -1, 0), radius: 0.5, {shining})"),
        format!("Cylinder(from: (-1, 2.5, 6), to: (1, 2.5, 6), radius: 0.1, {shining})"),
        format!("Rectangle(center: (0, 2.9, 6), normal: (0, -1, 0), size: 1, {shining})"),
        // Its middle is not in the room.
        format!("Sphere(center: (0, 3.4, 6), radius: 1, {shining})"),
        format!(
            "Rectangle(center: (0, 2.5, 0), normal: (0, 0, 1), size: (1, 30), transform: [Rotate(axis: (1, 0, 0), \
                 degrees: 90)], {shining})"
        ),
    ] {
        assert!(code("", &format!("{room}, {lamp}")).is_empty(), "{lamp}");
    }
    // A ring of light around a ball: its middle is in the ball, and it is not.
    let ring = format!("Sphere(center: (0, 0, 0), radius: 1), Torus(radius: 1.5, tube_radius: 0.1, {shining})");
    assert!(code("background: 0.1,", &ring).is_empty());
    // What is open lets light in.
    sandbox.write("open.obj", cube(true).lines().take(18).map(|line| format!("{line}\n")).collect::<String>());
    let open = "Mesh(file: \"open.obj\", transform: [Scale(factor: 4, about: (0, 0, 0)), Translate((-2, -1, 4.5))])";
    assert!(code("background: 0.5,", open).is_empty());
    let windowed = "Difference(objects: [Box(center: (0, 1, 6), size: 4), Box(center: (0, 1, 6), size: 3), \
                    Box(center: (0, 1, 3), size: (1, 1, 4))])";
    assert!(code("background: 0.5,", windowed).is_empty());
    // Rays that start far from the camera, in front of it or beside it, may see into what it stands in, or out of it.
    let ball = "Sphere(center: (0, 1, 6), radius: 0.5), Sphere(center: (0, 0, 0), radius: 1)";
    let camera = |words: &str| {
        let text = scene("background: 0.5,", ball);
        codes(&sandbox, &text.replace("look_at: (0, 0.5, 0)", &format!("look_at: (0, 0.5, 0), {words}")))
    };
    assert_eq!(camera("fov: 40"), ["W0306"]);
    // What shines lights the room that it stands in, a solid too, whole or in a part.
    for lamp in [
        "Union(material: Emissive(radiance: 0.3), objects: [Sphere(center: (0, 1, 4), radius: 1)])",
        "Difference(objects: [Box(center: (0, 1, 3), size: 2), \
         Sphere(center: (0, 1, 4), radius: 0.5, material: Emissive(radiance: 0.3))])",
    ] {
        assert!(code("", &format!("Box(center: (0, 1, 4), size: 9), {lamp}")).is_empty(), "{lamp}");
    }
    let shut = "Union(material: Emissive(radiance: 3), objects: [Box(size: 1)], transform: [Translate((0, 3, 0))]), \
                Sphere(center: (0, 3, 0), radius: 2)";
    assert_eq!(code("background: 0.5,", shut), ["W0307"]);
    assert!(camera("near: 1").is_empty());
    assert!(camera("projection: Orthographic(height: 4)").is_empty());
}

/// Lamps that shine with nothing: each is told where others give light, and all at once where none does.
#[test]
fn lamps_without_light_are_told() {
    let sandbox = Sandbox::new();
    let ball = "Sphere(center: (0, 0, 0), radius: 1)";
    let code = |top: &str, objects: &str| codes(&sandbox, &scene(top, &format!("{ball}, {objects}")));
    let light = |words: &str| format!("lights: [SphereLight(center: (0, 3, 0), radius: 0.5, {words})],");
    let shining = |words: &str| format!("Sphere(center: (0, 3, 0), radius: 0.5, material: Emissive({words}))");
    for words in [
        "radiance: 0",
        "power: (0, 0, 0)",
        "intensity: \"#000000\"",
        "luminance: 0",
        "luminous_power: 800, color: 0",
        "radiance: 5, color: (0, 0, 0)",
    ] {
        assert_eq!(code(&light(words), ""), ["W0301"], "{words}");
        assert_eq!(code("", &shining(words)), ["W0301"], "{words}");
        assert_eq!(code(&format!("background: 0.5, {}", light(words)), ""), ["W0320"], "{words}");
        assert_eq!(code("background: 0.5,", &shining(words)), ["W0320"], "{words}");
        sandbox.run(&["check", "odd.ron"]).ends(0).says(&["the material of objects[1] shines with nothing"]);
    }
    // Of two one is told for both; of a material with a name its name, however many have it.
    assert_eq!(code(&light("power: 0"), &shining("power: 0")), ["W0301"]);
    sandbox.run(&["check", "odd.ron"]).ends(0).says(&["lights[0] and 1 more shine with nothing"]);
    let named =
        "Box(center: (0, 3, 0), size: 1, material: \"lamp\"), Box(center: (3, 3, 0), size: 1, material: \"lamp\")";
    let top = "materials: { \"lamp\": Emissive(power: 0) }, background: 0.5,";
    assert_eq!(code(top, named), ["W0320"]);
    sandbox.run(&["check", "odd.ron"]).ends(0).says(&["the material \"lamp\" shines with nothing"]);
    // One that is off by an expression or by --set is meant so; without any light W0308 tells what comes of it.
    assert!(code(&format!("background: 0.5, {}", light("power: \"=0*2\"")), "").is_empty());
    assert_eq!(code(&light("power: \"=0*2\""), ""), ["W0308"]);
    sandbox.write("odd.ron", scene(&format!("background: 0.5, {}", light("power: 9")), ball));
    sandbox.run(&["check", "odd.ron", "--set", "lights[0].power=0"]).ends(0).silent();
    // Pictures of no light need none.
    let occlusion = scene(&light("power: 0"), ball).replace("samples: 2", "samples: 2, integrator: AmbientOcclusion()");
    assert!(codes(&sandbox, &occlusion).is_empty());
    // Where only what a mesh brings might shine, it is told at the mesh.
    sandbox.write("box.obj", cube(true));
    sandbox.write("odd.ron", scene("", "Mesh(file: \"box.obj\")"));
    sandbox.run(&["check", "odd.ron", "--diagnostics", "github"]).says(&["file=odd.ron,line=", "W0301"]);
    // That there is no light at all is told once, too.
    assert_eq!(codes(&sandbox, &scene("", ball)), ["W0301"]);
}

#[test]
fn empty_pictures_are_told() {
    let sandbox = Sandbox::new();
    let behind = "Sphere(center: (0, 1, 20), radius: 1)";
    assert_eq!(codes(&sandbox, &scene("background: (0.2, 0.4, 0.8),", behind)), ["W0309"]);
    let lamp = "lights: [SphereLight(center: (0, 1, 30), radius: 0.5, radiance: 10)],";
    assert_eq!(codes(&sandbox, &scene(lamp, behind)), ["W0309"]);
    // That nothing can be in view is told before the picture is made: behind, aside, above; not what is seen in part.
    let check = |camera: &str, objects: &str| {
        let text = format!("Scene(background: 0.5, camera: Camera({camera}), objects: [{objects}])");
        sandbox.write("odd.ron", text);
        sandbox.run(&["check", "odd.ron"]).ends(0).err.contains("W0309")
    };
    let ball = |center: &str| format!("Sphere(center: {center}, radius: 1)");
    // A mesh may be brought to where the camera looks; one that has been brought somewhere is meant to be there.
    sandbox.write("box.obj", cube(true));
    let of_mesh = |steps: &str| {
        check("position: (0, 0, 8), look_at: (0, 0.5, 0)", &format!("Mesh(file: \"box.obj\", transform: [{steps}])"));
        sandbox.run(&["check", "odd.ron"]).ends(0).err
    };
    let steps = "FitTo(size: 2.9), CenterTo((0, 0.5, 0))";
    let told = of_mesh("Translate((5e5, 0, 0))");
    assert!(told.contains(&format!("or bring a mesh there by `transform: [{steps}]`")), "{told}");
    assert!(told.contains(&format!("or the objects nearer to the camera, a mesh by `transform: [{steps}]`")), "{told}");
    let told = of_mesh("CenterTo((5e5, 0, 0))");
    assert!(told.contains("W0309") && !told.contains("bring a mesh"), "{told}");
    assert_eq!(of_mesh(&format!("Translate((5e5, 0, 0)), {steps}")), "");
    for projection in ["fov: 40", "projection: Orthographic(height: 3)"] {
        let camera = format!("position: (0, 0, 8), look_at: (0, 0, 0), {projection}");
        for away in ["(0, 0, 10)", "(60, 0, 0)", "(0, -60, 0)", "(0, 60, -1)"] {
            assert!(check(&camera, &ball(away)), "{projection} {away}");
        }
        for seen in ["(0, 0, 0)", "(1.5, 0, 0)", "(0, 2, 0)"] {
            assert!(!check(&camera, &ball(seen)), "{projection} {seen}");
            assert!(!check(&camera, &format!("{}, {}", ball("(60, 0, 0)"), ball(seen))), "{projection} {seen}");
        }
        assert!(!check(&camera, "Plane(point: (0, -9, 0))"));
    }
    let ball = "Sphere(center: (0, 0, 0), radius: 1)";
    assert!(codes(&sandbox, &scene(&lamp.replace("radiance: 10", "radiance: 100"), ball)).is_empty());
    // A background does not help who stands within something, whatever it is.
    let within = "Capsule(name: \"hull\", from: (0, 0, 6), to: (0, 2, 6), radius: 1)";
    sandbox.write("within.ron", scene("background: 0.5,", within));
    sandbox.run(&["check", "within.ron"]).ends(0).says(&["the camera stands inside \"hull\" (objects[0])"]);
    assert_eq!(codes(&sandbox, &scene("background: 0.5,", within)), ["W0306"]);
    // So little light that nearly all of it is shown black; what a tone map makes of it, nobody knows.
    assert_eq!(codes(&sandbox, &scene(lamp, ball)), ["W0308"]);
    let exposed = |exposure: i32| scene(&format!("background: 0.5, effects: Effects(exposure: {exposure}),"), ball);
    assert_eq!(codes(&sandbox, &exposed(-14)), ["W0308"]);
    assert_eq!(codes(&sandbox, &exposed(-8)), ["W0308"]);
    // Three quarters of what is seen before the background are dim.
    assert_eq!(codes(&sandbox, &exposed(-6)), ["W0308"]);
    assert!(codes(&sandbox, &exposed(-4)).is_empty());
    // Lamps below the floor.
    let below = "lights: [SphereLight(center: (0, -3, 0), radius: 0.5, radiance: 10)],";
    sandbox.write("below.ron", scene(below, "Plane(), Sphere(center: (0, 1, 0), radius: 1)"));
    let ran = sandbox.run(&["render", "below.ron", "-o", "a.png"]).ends(0);
    ran.says(&["W0308", "the lights are behind the plane objects[0], which faces (0, 1, 0)"]);
    // The exposure that is told shows it.
    sandbox.write("dark.ron", exposed(-8));
    sandbox.run(&["render", "dark.ron", "-o", "a.png"]).ends(0).says(&["try `--set effects.exposure=0`"]);
    sandbox.run(&["render", "dark.ron", "-o", "a.png", "--set", "effects.exposure=0"]).ends(0).silent();
    // Where an option has said it, that is to be changed.
    sandbox.write("lit.ron", exposed(0));
    let told = sandbox.run(&["render", "lit.ron", "-o", "a.png", "--exposure", "-8"]).ends(0);
    told.says(&["W0308", "try `--exposure 0`"]);
    // Three quarters are white, of which one is told, too; a lamp that is seen is not.
    let sky = |objects: &str| scene("background: 8,", objects);
    assert_eq!(codes(&sandbox, &sky(ball)), ["W0318"]);
    assert!(codes(&sandbox, &sky("Plane(point: (0, -1, 0), material: Diffuse(albedo: 0.1))")).is_empty());
    // White under white light from everywhere is as bright as that.
    let white = "Sphere(center: (0, 0, 0), radius: 1, material: Diffuse(albedo: 1))";
    assert!(codes(&sandbox, &scene("background: 1,", white)).is_empty());
    // A part of a picture may be empty.
    sandbox.write("some.ron", scene("background: (0.2, 0.4, 0.8),", "Sphere(center: (0, 0, 0), radius: 1)"));
    sandbox.run(&["render", "some.ron", "-o", "a.png", "--crop", "0,0,2,2"]).ends(0).silent();
}

#[test]
fn light_that_nobody_sees_is_told() {
    let sandbox = Sandbox::new();
    let with = |lamp: &str| scene("background: 0.5,", &format!("Sphere(center: (0, 0, 0), radius: 1), {lamp}"));
    let lamp = |normal: &str, more: &str| {
        with(&format!("Rectangle(center: (0, 3, 0), normal: {normal}, size: 1, material: Emissive(radiance: 5{more}))"))
    };
    assert_eq!(codes(&sandbox, &lamp("(0, 1, 0)", "")), ["W0315"]);
    assert_eq!(codes(&sandbox, &lamp("(0, 1, -0.4)", "")), ["W0315"]);
    // Turned down, to both sides, to the camera alone; with something above.
    let above = with(
        "Rectangle(center: (0, 3, 0), normal: (0, 1, 0), size: 1, material: Emissive(radiance: 5)), \
         Sphere(center: (9, 3.1, 0), radius: 0.2)",
    );
    for meant in [lamp("(0, -1, 0)", ""), lamp("(0, 1, 0)", ", two_sided: true"), lamp("(0, 0.001, 1)", ""), above] {
        assert!(codes(&sandbox, &meant).is_empty(), "{meant}");
    }
    // Of copies one that is of use is enough.
    let copies = with(
        "Rectangle(normal: (0, 1, 0), size: 1, material: Emissive(radiance: 5), \
         placements: [[Translate((0, 3, 0))], [Translate((0, -3, 0))]])",
    );
    assert!(codes(&sandbox, &copies).is_empty());
}

#[test]
fn views_that_are_too_far_are_told() {
    let sandbox = Sandbox::new();
    let far = |distance: f64, fov: f64| {
        format!(
            "Scene(camera: Camera(position: (0, 0, {distance:?}), look_at: (0, 0, 0), fov: {fov:.12}), \
             image: Image(width: 96, height: 96), render: Render(samples: 1), background: (1, 0.5, 0.2), \
             objects: [Sphere(center: (0, 0, 0), radius: 1, material: Diffuse(albedo: 0.5))])"
        )
    };
    let of_ball = |distance: f64| far(distance, 2.0 * (1.5 / distance).atan().to_degrees());
    for near in [5.0, 1e3, 3e5] {
        assert!(codes(&sandbox, &of_ball(near)).is_empty(), "{near}");
    }
    assert_eq!(codes(&sandbox, &of_ball(1e7)), ["W0314"]);
    sandbox.write("odd.ron", of_ball(1e7));
    sandbox.run(&["check", "odd.ron"]).ends(0).says(&["in steps of 19 pixels"]);
    // Far away and wide is fine, and so is what is far from the origin, but not from the camera.
    assert!(codes(&sandbox, &far(1e7, 40.0)).iter().all(|code| code != "W0314"));
    let elsewhere = of_ball(5.0).replace("(0, 0, 5.0)", "(1e8, 0, 5)").replace("(0, 0, 0)", "(1e8, 0, 0)");
    assert!(codes(&sandbox, &elsewhere).is_empty());
}

/// Scenes that people have looked at raise none of these warnings.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn scenes_that_are_meant_raise_nothing() {
    let sandbox = Sandbox::new();
    let folder = |name: &str| repository().join(name).display().to_string();
    let folders = ["scenes", "golden"].map(folder);
    let arguments = [&["check", "--diagnostics", "json"], &folders.each_ref().map(String::as_str)[..]].concat();
    let ran = sandbox.run(&arguments).ends(0);
    let lines = ran.err.lines().chain(ran.out_text().lines()).map(str::to_owned).collect::<Vec<_>>();
    let of_meant = ["W0305", "W0306", "W0307", "W0314", "W0315", "W0521"];
    let false_alarms: Vec<&String> =
        lines.iter().filter(|line| of_meant.iter().any(|code| line.contains(&format!("\"{code}\"")))).collect();
    assert!(false_alarms.is_empty(), "{false_alarms:#?}");
}

#[test]
fn numbers_on_another_scale_are_told() {
    let sandbox = Sandbox::new();
    let ball = "Sphere(center: (0, 0, 0), radius: 1)";
    let code = |top: &str, objects: &str| codes(&sandbox, &scene(top, objects));
    assert_eq!(code("background: (135, 206, 235),", ball), ["W0317", "W0318"]);
    // A grey, what is no whole number, and what is dark are meant.
    for meant in ["1", "(0.5, 0.8, 0.9)", "(1, 2, 3)"] {
        assert!(!code(&format!("background: {meant},"), ball).contains(&"W0317".to_owned()), "{meant}");
    }
    assert_eq!(code("background: 150,", ball), ["W0318"]);
    assert_eq!(code("background: 255,", ball), ["W0317", "W0318"]);
    // Radians, once however often they are reckoned with; not in a comment.
    let ring = |angle: &str| {
        let place = format!("\"=(2*cos({angle}), 0, 2*sin({angle}))\"");
        format!("{ball}, Repeat(count: 8, items: [Sphere(center: {place}, radius: 0.2)])")
    };
    assert_eq!(code("background: 0.5,", &ring("2*pi*i/8")), ["W0317"]);
    sandbox.run(&["check", "odd.ron"]).ends(0).says(&["`cos(2*pi*i/8)`", "write `cos(2*180*i/8)`"]);
    assert!(code("background: 0.5, /* \"=cos(pi)\" */", &ring("360*i/8")).is_empty());
    let lens =
        |words: &str| code(&format!("background: 0.5, effects: Effects(depth_of_field: ThinLens({words})),"), ball);
    assert_eq!(lens("aperture: 2.8, focus_distance: 6"), ["W0317"]);
    for meant in
        ["aperture: 0.28, focus_distance: 6", "aperture: 2.8, focus_distance: 60", "aperture: 2.7, focus_distance: 6"]
    {
        assert!(lens(meant).is_empty(), "{meant}");
    }
    assert_eq!(code("background: 0.5, effects: Effects(exposure: 12),", ball), ["W0317", "W0318"]);
    assert!(code("background: 0.0005, effects: Effects(exposure: 11),", ball).is_empty());
    let shining = |light: &str| code("", &format!("Sphere(center: (0, 3, 0), radius: 1, material: Emissive({light}))"));
    let lamp = |light: &str| code(&format!("lights: [SphereLight(center: (0, 3, 0), radius: 1, {light})],"), ball);
    for light in ["radiance: (255, 240, 200)", "power: (0, 255, 0)"] {
        for codes in [shining(light), lamp(light)] {
            assert!(codes.contains(&"W0317".to_owned()), "{light} {codes:?}");
        }
    }
    assert!(lamp("intensity: (255, 0, 0)").contains(&"W0317".to_owned()));
    // Grey, another amount, parts, a colour.
    for light in
        ["power: 255", "power: (256, 240, 200)", "power: (254, 0, 0)", "power: (255, 0.5, 0)", "radiance: \"#ff0000\""]
    {
        for codes in [shining(light), lamp(light)] {
            assert!(!codes.contains(&"W0317".to_owned()), "{light} {codes:?}");
        }
    }
    let turned = |degrees: &str| {
        code("background: 0.5,", &format!("Box(transform: [Rotate(axis: (0, 1, 0), degrees: {degrees})])"))
    };
    for radians in ["0.785", "1.5708", "3.14159", "-0.5236"] {
        assert_eq!(turned(radians), ["W0317"], "{radians}");
    }
    for degrees in ["45", "0.8", "1.5", "3", "0"] {
        assert!(turned(degrees).is_empty(), "{degrees}");
    }
    for (fov, warned) in [("0.7", true), ("2", false), ("0.1", false), ("40", false)] {
        let camera = format!("Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: {fov})");
        let text =
            scene("background: 0.5,", ball).replace("Camera(position: (0, 1, 6), look_at: (0, 0.5, 0))", &camera);
        assert_eq!(codes(&sandbox, &text), if warned { vec!["W0317"] } else { vec![] }, "{fov}");
    }
}

#[test]
fn what_lies_in_the_plane_of_another_is_told() {
    let sandbox = Sandbox::new();
    let code = |objects: &str| {
        // Of a pane of glass it is told that it has no inside, too.
        let told = codes(&sandbox, &scene("background: 0.5,", objects));
        told.into_iter().filter(|code| code != "W0310").collect::<Vec<_>>()
    };
    let red = "material: Diffuse(albedo: (0.8, 0.1, 0.1))";
    for hidden in [
        format!("Rectangle(size: 6), Rectangle(size: 2, {red})"),
        format!("Rectangle(size: 6), Rectangle(size: 6, {red})"),
        format!("Box(size: 1), Box(size: 1, {red})"),
        format!("Box(size: 2), Rectangle(center: (0, 1, 0), size: 1, {red})"),
        format!("Rectangle(size: 6), Rectangle(size: 1, {red}, transform: [Rotate(axis: (0, 1, 0), degrees: 30)])"),
        "Rectangle(size: 1, material: Transparent(ior: 1.5)), Rectangle(size: 6)".to_owned(),
    ] {
        assert_eq!(code(&hidden), ["W0319"], "{hidden}");
    }
    for seen in [
        // Above it, over its edge, first in the scene, shining, of glass below.
        format!("Rectangle(size: 6), Rectangle(center: (0, 0.001, 0), size: 2, {red})"),
        format!("Rectangle(size: 6), Rectangle(center: (3, 0, 0), size: 2, {red})"),
        format!("Rectangle(size: 2, {red}), Rectangle(size: 6)"),
        "Rectangle(size: 6), Rectangle(size: 2, material: Emissive(radiance: 0.5))".to_owned(),
        format!("Rectangle(size: 6, material: Transparent(ior: 1.5)), Rectangle(size: 2, {red})"),
        format!("Rectangle(size: 6), Box(center: (0, 0.5, 0), size: 1, {red})"),
    ] {
        assert!(code(&seen).is_empty(), "{seen}");
    }
}

/// Of flat lamps in one place one is seen, and one shines.
#[test]
fn lamps_in_one_place_are_one_lamp() {
    let sandbox = Sandbox::new();
    let floor = "Rectangle(size: 20, material: Diffuse(albedo: 0.5))";
    let lamps = [
        "Rectangle(center: (0, 1, 0), normal: (0, -1, 0), size: 1, material: Emissive(radiance: 3))",
        "Disk(center: (0, 1, 0), normal: (0, -1, 0), radius: 0.5, material: Emissive(radiance: 3))",
        "Box(center: (0, 1, 0), size: 0.5, material: Emissive(radiance: 3))",
        "Polygon(points: [(0, 1, 0), (0, 1, 1), (1, 1, 0)], material: Emissive(radiance: 3, two_sided: true))",
    ];
    for lamp in lamps {
        for (name, objects) in
            [("one", format!("{floor}, {lamp}")), ("three", format!("{floor}, {lamp}, {lamp}, {lamp}"))]
        {
            let look = "camera: Camera(position: (0, 1, 4), look_at: (0, 0, 0)), image: Image(width: 24, height: 24)";
            sandbox.write(&format!("{name}.ron"), format!("Scene({look}, objects: [{objects}])"));
            let picture = format!("{name}.exr");
            sandbox.run(&["render", &format!("{name}.ron"), "-o", &picture, "--samples", "16"]).ends(0);
        }
        // Rays start a little farther off surfaces in one plane, so that roundings differ; a second lamp would show.
        sandbox.run(&["compare", "one.exr", "three.exr", "--fail-above", "max=0.0001"]).ends(0);
    }
}
