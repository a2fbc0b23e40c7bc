//! What `tracer check --fix` does to a text: fewer faults, or nothing; and nothing more when it is done again.

use scene_format::{LoadError, Severity, Syntax, load_str, mend};
use std::path::Path;

fn errors(text: &str, syntax: Syntax) -> usize {
    match load_str("scene", text, syntax, Path::new("tests/broken"), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            diagnostics.iter().filter(|fault| fault.severity == Severity::Error).count()
        }
        _ => 0,
    }
}

/// Why a text is not mended as it should be.
fn fault(text: &str, syntax: Syntax) -> Option<String> {
    let once = mend("scene", text, syntax, Path::new("tests/broken"));
    let twice = mend("scene", &once.text, syntax, Path::new("tests/broken"));
    let (before, after) = (errors(text, syntax), errors(&once.text, syntax));
    if twice.text != once.text {
        return Some(format!("is mended again:\n{}\nto\n{}", once.text, twice.text));
    }
    let better = after < before || before == 0 && after == 0;
    (once.text != text && !better).then(|| format!("{before} errors before, {after} after:\n{}", once.text))
}

#[test]
fn broken_scenes_get_fewer_errors_or_stay_as_they_are() {
    let mut wrong = Vec::new();
    let mut mended = 0;
    for (syntax, extension) in [(Syntax::Ron, "ron"), (Syntax::Toml, "toml"), (Syntax::Json, "json")] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken").join(extension);
        for entry in std::fs::read_dir(folder).expect("the folder of broken scenes") {
            let path = entry.expect("an entry of the folder").path();
            let Ok(text) = std::fs::read_to_string(&path) else { continue };
            if path.extension().is_some_and(|found| found == extension) {
                wrong.extend(fault(&text, syntax).map(|why| format!("{}: {why}", path.display())));
                mended += usize::from(mend("scene", &text, syntax, Path::new("")).text != text);
            }
        }
    }
    assert!(mended > 150, "only {mended} were mended");
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

/// A scene with one object that is written so.
fn with_object(object: &str) -> String {
    format!(
        "Scene(\n    background: 1,\n    objects: [\n        Sphere(center: (0, 0, 0), radius: 1),\n{object}\n    \
         ],\n)\n"
    )
}

/// What people wrote who came from other programs: one error, whose hint says how it is written here.
#[test]
fn constructs_of_other_languages_are_told_once_and_left_as_they_are() {
    let mut wrong = Vec::new();
    let in_ron = [
        (
            with_object(
                "        for i in 0..8 { Group(\n            items: [Sphere(center: (0, i, 0), radius: \
             1)],\n        ) }",
            ),
            "Repeat(count: 8, items: [..])",
        ),
        (with_object("        for k in range(3): Sphere(center: (0, 0, 0), radius: 1),"), "index: \"k\""),
        (
            with_object("        sphere { <0, 1, 0>, 1 pigment { color rgb <1, 0, 0> } }"),
            "Sphere(center: (x, y, z), \
         radius: ..)",
        ),
        (
            with_object(
                "        sphere {\n            <0, 1, 0>, 1\n            pigment { color rgb <1, 0, 0> }\n        \
         }",
            ),
            "Sphere(center:",
        ),
        (with_object("        torus { 1, 0.2 rotate <90, 0, 0> }"), "Torus(radius:"),
        (with_object("        julia_fractal { <-0.08, 0, -0.8, -0.03> }"), "tracer explain Object"),
        (with_object("        #declare R = 2;"), "`vars`"),
        (
            with_object(
                "        Sphere(center: (0, 0, 0), radius: 1, material: texture { pigment { rgb <1, 0, 0> } \
         }),",
            ),
            "Diffuse(albedo:",
        ),
        (
            "Scene(background: 1, objects: [Sphere(center: (i, 0, 0), radius: 1) for i in range(8)])".to_owned(),
            "count: \
         8",
        ),
        (
            "Scene(\n    camera { location <0, 1, 5> look_at <0, 0, 0> }\n    background: 1,\n    objects: \
         [Sphere(center: (0, 0, 0), radius: 1)],\n)"
                .to_owned(),
            "camera: Camera(",
        ),
    ];
    for (text, way) in in_ron {
        check(&text, Syntax::Ron, way, &mut wrong);
        if mend("scene", &text, Syntax::Ron, Path::new("")).text != text {
            wrong.push(format!("{text}\nis changed"));
        }
    }
    let in_toml = [
        (
            "background = 1\n[[objects]]\nSphere(center: [0, 0, 0], radius: 1)\n",
            "Sphere = { center = [0, 0, 0], radius = 1 }",
        ),
        (
            "background = 1\nobjects = [\n    Sphere(\n        center: (0, 0, 0),\n        radius: 1,\n    ),\n]\n",
            "{ Sphere = { center = [0, 0, 0], radius = 1 } }",
        ),
        (
            "background = 1\ncamera = Camera(\n    fov: 40,\n)\n[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 \
             }\n",
            "{ fov = 40 }",
        ),
        ("background = 1\n[[objects]]\nsphere { <0, 1, 0>, 1 }\n", "{ Sphere = { center = [x, y, z], radius = .. } }"),
        (
            "background = 1\n[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 }\nfor i in 0..8 {\n}\n",
            "{ Repeat = { count = 8, items = [..] } }",
        ),
    ];
    for (text, way) in in_toml {
        check(text, Syntax::Toml, way, &mut wrong);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

fn check(text: &str, syntax: Syntax, way: &str, wrong: &mut Vec<String>) {
    let found = match load_str("scene", text, syntax, Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => diagnostics,
        _ => Vec::new(),
    };
    let [only] = found.as_slice() else {
        let all: Vec<String> = found.iter().map(|fault| format!("{} ({})", fault.message, fault.hint)).collect();
        return wrong.push(format!("{text}\ngives {} errors: {all:#?}", all.len()));
    };
    if !only.hint.contains(way) {
        wrong.push(format!("{text}\nis told {:?} with the hint {:?}, not {way:?}", only.message, only.hint));
    }
    wrong.extend(fault(text, syntax).map(|why| format!("{text}\n{why}")));
}

/// Where something is wrong that nobody can mend for certain, what stands beside it is left alone.
#[test]
fn a_line_with_an_unclear_fault_is_not_edited() {
    let text = with_object("        Sphere(center: (0, 0, 0), radius: \"wide\", material: \"red\", raduis: 1),");
    assert_eq!(mend("scene", &text, Syntax::Ron, Path::new("")).text, text);
    let text = with_object(
        "        Sphere(center: (0, 0, 0), raduis: 1),\n        Sphere(center: (0, 0, 0), radius: \"wide\"),",
    );
    let mended = mend("scene", &text, Syntax::Ron, Path::new(""));
    assert_eq!((mended.text, mended.faults), (text.replace("raduis", "radius"), 1));
}

/// What says two things is told, with both, and left as it is: the hint, followed, makes the scene right.
#[test]
fn what_may_mean_two_things_is_told_and_not_mended() {
    let mut wrong = Vec::new();
    for (object, way) in [
        ("Plane(width: 10, height: 8)", "Rectangle(size: (10, 8))"),
        ("Plane(depth: 4)", "Rectangle(size: 4)"),
        ("Plane(height: 2)", "by a point of it: `point: (0, 2, 0)`"),
        ("Sphere(size: 2)", "write `radius: 1`"),
        ("Disk(size: 3)", "write `radius: 1.5`"),
        ("Sphere(size: (1, 2, 1))", "write `radius: 0.5, transform: [Scale((1, 2, 1))]`"),
        (
            "Capsule(center: (0, 1, 0), height: 2, radius: 0.5)",
            "where its whole length is meant, `from: (0, 0.5, 0), to",
        ),
        ("Capsule(height: 2, radius: 0.5)", "write `from: (0, 0, 0), to: (0, 2, 0)`"),
        ("Cylinder(axis: (0, 0, 1), radius: 1)", "`from: (x, y, z), to: (x, y, z)`"),
        ("Box(rotation: (0, 1.57, 0))", "in radians, write `transform: [Rotate(axis: (0, 1, 0), degrees: 90)]`"),
        ("Box(transform: [RotateY(0.7854)])", "if that is in radians, write Rotate(axis: (0, 1, 0), degrees: 45)"),
        ("Box(transform: [Rotate(x: 1.57)])", "if that is in radians, write Rotate(axis: (1, 0, 0), degrees: 90)"),
        (
            "Repeat(values: [1, 3], index: \"v\", items: [Box(size: \"=v\")])",
            "write `count: 2, vars: { \"v\": Pick(from: [1, 3], index: \"=i\") }`, and no `index`",
        ),
        ("Repeat(from: 1, to: 8, items: [Box(size: 1)])", "it counts from 0"),
        ("Cylinder(p1: (0, 2, 0), radius: 1)", "`from: (0, 2, 0)` or `to: (0, 2, 0)`?"),
        ("Box(material: Diffuse(albedo: (1,0, 0, 1)))", "point: (1.0, 0, 1); or, without an alpha, (1, 0, 0)"),
        ("Sphere(center: (0,5, 1, 2), radius: 1)", "numbers have a decimal point: (0.5, 1, 2)"),
        ("Box(material: Diffuse(albedo: (1, 2, 3)))", "of values up to 255 write \"#010203\""),
        ("Box(material: Diffuse(albedo: rgb(1, 2, 3)))", "of values up to 255 write \"#010203\""),
        ("Box(material: Diffuse(albedo: (50, 25, 0)))", "write \"#321900\", of percents (0.5, 0.25, 0)"),
        ("Box(material: Emissive(radiance: rgb(255, 200, 100)))", "\"#ffc864\" for a colour of bytes, or (255, 200"),
        ("Box(rotation: (0, 1, 0))", "write `transform: [Rotate(axis: (0, 1, 0), degrees: 1)]` with the degrees"),
        ("Box(transform: [Rotate((0, 1, 0))])", "write Rotate(axis: (0, 1, 0), degrees: 1) with the degrees"),
        ("Box(transform: (scale: (1, 2, 1), rotate: (0, 0, 1)))", "is that an axis, or an angle for each axis?"),
        ("Sphere(radius: 1,024)", "write 1024, or 1.024"),
        // Kinds of other programs, as they are written here.
        ("Box(material: Emission(strength: 5))", "`Emissive(radiance: 5)`"),
        ("Box(material: Emission(color: (1, 0.9, 0.8)))", "`Emissive(radiance: 5, color: (1, 0.9, 0.8))`"),
        ("BoxGeometry(1, 2, 3)", "`Box(size: (1, 2, 3))`"),
        ("BoxGeometry(width: 1, height: 2, depth: 3)", "`Box(size: (1, 2, 3))`"),
        ("PlaneGeometry(width: 1, height: 2)", "`Rectangle(size: (1, 2))`"),
        ("IcoSphere(radius: 2, subdivisions: 3)", "`Sphere(radius: 2)`"),
        (
            "Trianglemesh(P: [0, 0, 0, 1, 0, 0], indices: [0, 1, 2])",
            "(points: [(0, 0, 0), (1, 0, 0)], faces: [[0, 1, 2]]",
        ),
        ("Box(material: MeshStandardMaterial(color: 0xff0000, roughness: 0.5))", "BlinnPhong(albedo: \"#ff0000\""),
    ] {
        let text = with_object(&format!("        {object},"));
        check(&text, Syntax::Ron, way, &mut wrong);
        if mend("scene", &text, Syntax::Ron, Path::new("")).text != text {
            wrong.push(format!("{text}\nis changed"));
        }
    }
    for (text, syntax, way) in [
        (
            "objects = [{ Box = { size = 1 } }]\nbackground = 1\n[camera]\nprojection = \"orthographic\"\n",
            Syntax::Toml,
            "write { Orthographic = { height = 8 } }",
        ),
        (
            "{ \"background\": 1, \"objects\": [{ \"Box\": {} }], \"camera\": { \"projection\": \"Orthographic\" } }",
            Syntax::Json,
            "write { \"Orthographic\": { \"height\": 8 } }",
        ),
        ("background = 1\nobjects = [{ Sphere = { size = 3 } }]\n", Syntax::Toml, "write `radius = 1.5`"),
    ] {
        check(text, syntax, way, &mut wrong);
        if mend("scene", text, syntax, Path::new("")).text != text {
            wrong.push(format!("{text}\nis changed"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// An edit that has no place for a comment is offered, and not made.
#[test]
fn comments_are_kept() {
    for object in [
        "Sphere(center: vec3(1, /* up */ 2, 3), radius: 1)",
        "Sphere(radius: 1, color: /* red */ (1, 0, 0))",
        "Box(transform: [Scale(2, /* y */ 2, 2)])",
        "Polygon(points: [0, 0, 0, // \"first\"\n            1, 0, 0, 0, 1, 0])",
    ] {
        let text = with_object(&format!("        {object},"));
        assert_eq!(mend("scene", &text, Syntax::Ron, Path::new("")).text, text);
        assert_eq!(errors(&text, Syntax::Ron), 1, "{object}");
    }
    let text = "background = 1\n[[objects]]\nPolygon = { points = [0, 0, 0, # first\n1, 0, 0, 0, 1, 0] }\n";
    assert_eq!(mend("scene", text, Syntax::Toml, Path::new("")).text, text);
    // Where it stays, or is none, the rest is mended.
    for (object, right) in [
        ("Sphere(raduis: /* one */ 1)", "Sphere(radius: /* one */ 1)"),
        ("Mesh(path: '//host/a.obj')", "Mesh(file: \"//host/a.obj\")"),
        (
            "Sphere(radius: 1, material: Diffuse(pigment: /* red */ red))",
            "Sphere(radius: 1, material: Diffuse(albedo: /* red */ \"#ff0000\"))",
        ),
    ] {
        assert_eq!(mend("scene", &with_object(object), Syntax::Ron, Path::new("")).text, with_object(right));
    }
}

/// What surrounds objects, and comments in lists.
#[test]
fn backgrounds_cameras_and_comments_of_others_are_mended() {
    let scene = |rest: &str| format!("Scene({rest}, objects: [Box()])");
    for (written, right) in [
        ("background: rgb(0.1, 0.2, 0.3)", "background: (0.1, 0.2, 0.3)"),
        ("background: '#ff0000'", "background: \"#ff0000\""),
        ("background: 1, camera: Camera(sensor: (36, 24))", "background: 1, camera: Camera(sensor_width: 36)"),
    ] {
        assert_eq!(mend("scene", &scene(written), Syntax::Ron, Path::new("")).text, scene(right));
    }
    let slashes = "background = 1\nobjects = [\n  // first\n  { Box = {} }, // second\n]\n";
    let mended = mend("scene", slashes, Syntax::Toml, Path::new(""));
    assert_eq!((mended.text, mended.changes.len()), (slashes.replace("//", "#"), 2));
}

/// Names of the scene's own go before those of CSS.
#[test]
fn own_names_are_meant_before_those_of_colors() {
    for (object, right) in [
        ("Box(material: Diffuse(albedo: red))", "Box(material: Diffuse(albedo: \"=red\"))"),
        ("Box(material: Diffuse(albedo: \"red\"))", "Box(material: Diffuse(albedo: \"=red\"))"),
        ("Box(material: Diffuse(albedo: blue))", "Box(material: Diffuse(albedo: \"blue\"))"),
        ("Box(material: Diffuse(albedo: lime))", "Box(material: Diffuse(albedo: \"#00ff00\"))"),
        ("Box(material: Emissive(radiance: red))", "Box(material: Emissive(radiance: \"=red\"))"),
        ("Box(color: red)", "Box(material: Diffuse(albedo: \"=red\"))"),
        ("Box(color: \"blue\")", "Box(material: Diffuse(albedo: \"blue\"))"),
        ("Box(material: { color: \"red\" })", "Box(material: Diffuse(albedo: \"=red\"))"),
        ("Box(material: Diffuse(\"red\"))", "Box(material: Diffuse(albedo: \"=red\"))"),
        (
            "Repeat(count: 1, vars: { \"teal\": 0.5 }, items: [Box(color: teal)])",
            "Repeat(count: 1, vars: { \"teal\": 0.5 }, items: [Box(material: Diffuse(albedo: \"=teal\"))])",
        ),
    ] {
        let scene = |object: &str| {
            let names = "vars: { \"red\": (0.6, 0.1, 0.1) }, textures: { \"blue\": Noise() }";
            format!("Scene(background: red, {names}, objects: [{object}])")
        };
        let mended = mend("scene", &scene(object), Syntax::Ron, Path::new(""));
        assert_eq!(mended.text, scene(right).replace("background: red", "background: \"=red\""));
    }
}

/// What is surely of one kind is mended: ends by their numbers, bytes, transforms by fields in the order of programs.
#[test]
fn what_is_said_in_one_way_is_mended() {
    const ALL: &str = "[Scale((1, 2, 1)), Rotate(axis: (0, 1, 0), degrees: 45), Translate((0, 1, 0))]";
    for (object, right) in [
        ("Cylinder(p1: (0, 1, 0), p2: (0, 2, 0), radius: 1)", "Cylinder(from: (0, 1, 0), to: (0, 2, 0), radius: 1)"),
        ("Cone(p2: (0, 2, 0), p1: (0, 1, 0), radius: 1)", "Cone(from: (0, 1, 0), to: (0, 2, 0), radius: 1)"),
        ("Capsule(p0: (0, 1, 0), p1: (0, 2, 0), radius: 1)", "Capsule(from: (0, 1, 0), to: (0, 2, 0), radius: 1)"),
        ("Cylinder(p1: (0, 1, 0), to: (0, 2, 0), radius: 1)", "Cylinder(from: (0, 1, 0), to: (0, 2, 0), radius: 1)"),
        ("Box(material: Diffuse(albedo: (64, 32, 16)))", "Box(material: Diffuse(albedo: \"#402010\"))"),
        ("Box(material: Diffuse(albedo: rgb(200, 25, 25)))", "Box(material: Diffuse(albedo: \"#c81919\"))"),
        ("Box(material: Emissive(radiance: rgb(5, 4, 3)))", "Box(material: Emissive(radiance: (5, 4, 3)))"),
        ("Box(material: Diffuse(albedo: '#ff0000'))", "Box(material: Diffuse(albedo: \"#ff0000\"))"),
        ("Sphere(center: (1,5, 2,0, 3), radius: 1)", "Sphere(center: (1.5, 2.0, 3), radius: 1)"),
        (
            "Box(rotation: (0, 30, 1))",
            "Box(transform: [Rotate(axis: (0, 1, 0), degrees: 30), Rotate(axis: (0, 0, 1), degrees: 1)])",
        ),
        (
            "Box(transform: { translate: (0, 1, 0), rotate: (0, 45, 0), scale: (1, 2, 1) })",
            &format!("Box(transform: {ALL})"),
        ),
        ("Box(translate: (0, 1, 0), scale: (1, 2, 1), rotate: (0, 45, 0))", &format!("Box(transform: {ALL})")),
        (
            "Box(placements: [(position: (0, 1, 0), rotation: (0, 45, 0), scale: (1, 2, 1))])",
            &format!("Box(placements: [{ALL}])"),
        ),
    ] {
        let (text, right) = (with_object(object), with_object(right));
        let mended = mend("scene", &text, Syntax::Ron, Path::new(""));
        assert_eq!(mended.text, right);
        assert_eq!(errors(&right, Syntax::Ron), 0, "{right}");
    }
}

/// Ends along an axis, and lengths that are reckoned.
#[test]
fn what_goes_along_an_axis_keeps_it() {
    for (object, right) in [
        (
            "Cylinder(base: (0, 0, 0), axis: (1, 0, 0), length: 2, radius: 0.5)",
            "Cylinder(from: (0, 0, 0), to: (2, 0, 0), radius: 0.5)",
        ),
        (
            "Cylinder(center: (0, 1, 0), height: 2, axis: (0, 0, 5), radius: 0.5)",
            "Cylinder(from: (0, 1, -1), to: (0, 1, 1), radius: 0.5)",
        ),
        ("Cone(from: (1, 0, 0), axis: x, height: 2, radius: 1)", "Cone(from: (1, 0, 0), to: (3, 0, 0), radius: 1)"),
        ("Cylinder(height: \"=2*r+1\", radius: 1)", "Cylinder(from: (0, 0, 0), to: (0, \"=2*r+1\", 0), radius: 1)"),
        (
            "Cylinder(base: (0, \"=r\", 1), height: \"=2*r\", radius: 1)",
            "Cylinder(from: (0, \"=r\", 1), to: (0, \"=r+2*r\", 1), radius: 1)",
        ),
        (
            "Cylinder(center: (0, 1, 0), height: \"=2*r\", radius: 1)",
            "Cylinder(from: (0, \"=1-(2*r)/2\", 0), to: (0, \"=1+(2*r)/2\", 0), radius: 1)",
        ),
        ("Box(transform: [RotateY(\"=20*r\")])", "Box(transform: [Rotate(axis: (0, 1, 0), degrees: \"=20*r\")])"),
        (
            "Torus(radius: 1, tube_radius: 0.2, rotation: (0, \"=r\", 0))",
            "Torus(radius: 1, tube_radius: 0.2, transform: \
         [Rotate(axis: (0, 1, 0), degrees: \"=r\")])",
        ),
    ] {
        let scene = |object: &str| format!("Scene(background: 1, vars: {{ \"r\": 2 }}, objects: [{object}])");
        let mended = mend("scene", &scene(object), Syntax::Ron, Path::new(""));
        assert_eq!(mended.text, scene(right));
        assert_eq!((mended.changes.len(), mended.changes[0].line), (1, 1), "{:?}", mended.changes);
        assert_eq!(errors(&mended.text, Syntax::Ron), 0, "{}", mended.text);
    }
}

/// What `changes` tell: each made of the text as it is after those before.
#[test]
fn changes_in_one_another_are_told_and_made() {
    let scenes = [
        (Syntax::Ron, "Scene{backgrond: 1, objects: [Spere{radius: 1}]}"),
        (
            Syntax::Json,
            r#"{"Scene": {"backgrond": 1, "objects": [{"sphere": {"Radius": 1, "color": "red"}},
                {"box": {"Size": "2"}}]}}"#,
        ),
    ];
    for (syntax, text) in scenes {
        assert_eq!(fault(text, syntax), None, "{text}");
        let mended = mend("scene", text, syntax, Path::new(""));
        assert!(mended.text != text && !mended.changes.is_empty(), "{}", mended.text);
    }
}
