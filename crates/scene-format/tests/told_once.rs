//! What people write from habit or leave half written: so many errors and no more, with the way.

use scene_format::{LoadError, Severity, Syntax, load_str, mend};
use std::path::Path;

use Syntax::{Json, Ron, Toml};

/// Codes and hints of the errors.
fn errors(text: &str, syntax: Syntax) -> Vec<String> {
    match load_str("scene", text, syntax, Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            let errors = diagnostics.into_iter().filter(|fault| fault.severity == Severity::Error);
            errors.map(|fault| format!("{} {}; {}", fault.code, fault.message, fault.hint)).collect()
        }
        _ => Vec::new(),
    }
}

/// What is written is mended to what stands behind it, which has no errors.
fn mends(cases: &[(Syntax, &str, &str)]) {
    for (syntax, written, right) in cases {
        let mended = mend("scene", written, *syntax, Path::new("")).text;
        assert_eq!(mended, *right);
        assert_eq!(errors(right, *syntax), Vec::<String>::new(), "{right}");
    }
}

/// What is written has one error, of which this is told.
fn told(syntax: Syntax, written: &str, way: &str) {
    let found = errors(written, syntax);
    assert!(found.len() == 1 && found[0].contains(way), "{written}\n{way}\n{found:#?}");
}

#[test]
fn position_rotation_and_scale_become_one_transform() {
    let scene = |mesh: &str| format!("Scene(background: 1, objects: [{mesh}])");
    let points = "points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]]";
    for (written, right) in [
        (
            format!("Mesh({points}, position: (1, 2, 3), rotation: (0, 45, 0), scale: 2)"),
            format!(
                "Mesh({points}, transform: [Scale(2), Rotate(axis: (0, 1, 0), degrees: 45), Translate((1, 2, 3))])"
            ),
        ),
        (
            format!("Mesh(position: (1, 2, 3), {points}, scale: (1, 2, 1), color: \"red\")"),
            format!(
                "Mesh(transform: [Scale((1, 2, 1)), Translate((1, 2, 3))], {points}, material: Diffuse(albedo: \
                 \"#ff0000\"))"
            ),
        ),
        (
            "Box(position: (1, 2, 3), scale: 2, color: (1, 0, 0))".to_owned(),
            "Box(center: (1, 2, 3), transform: [Scale(2)], material: Diffuse(albedo: (1, 0, 0)))".to_owned(),
        ),
    ] {
        mends(&[(Ron, &scene(&written), &scene(&right))]);
    }
    // What is written already stays, and what stands behind a comment is not moved.
    for written in [
        "Box(transform: [Scale(2)], scale: 3)",
        "Mesh(file: \"a.obj\", position: (1, 2, 3), // here\n scale: 2)",
        "Mesh(file: \"a.obj\", position: 3)",
    ] {
        let written = scene(written);
        assert_eq!(mend("scene", &written, Ron, Path::new("")).text, written);
    }
    let json = |mesh: &str| format!("{{\"background\": 1, \"objects\": [{{\"Box\": {mesh}}}]}}");
    mends(&[(
        Json,
        &json("{\"size\": 1, \"scale\": 2, \"color\": \"red\"}"),
        &json(
            "{\"size\": 1, \"transform\": [{ \"Scale\": 2 }], \"material\": { \"Diffuse\": { \"albedo\": \"#ff0000\" } \
             }}",
        ),
    )]);
}

#[test]
fn units_are_left_out() {
    let scene = |fov: &str, power: &str, size: &str| {
        format!(
            "Scene(camera: Camera(fov: {fov}), lights: [SphereLight(center: (0, 3, 0), radius: 1, power: {power})], \
             objects: [Box(size: {size})])"
        )
    };
    let right = scene("45", "60", "(1, 2, 3)");
    mends(&[
        (Ron, &scene("45deg", "60 W", "(1m, 2 m, 3)"), &right),
        (Ron, &scene("45 degrees", "60W", "(1, 2, 3)"), &right),
    ]);
    told(Ron, &scene("0.5rad", "60", "1"), "angles are in degrees: write 28.6479");
    let ball = "Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radius: rad(0.6))])";
    told(Ron, ball, "`rad` is no function of values: write the number");
    told(Ron, &scene("45", "60", "5cm"), "lengths are in the scene's own unit");
    told(Ron, &scene("45", "60lm", "1"), "numbers carry no unit");
    let toml =
        |power: &str| format!("background = 1\nobjects = [{{ Box = {{ size = 1 }} }}]\n[camera]\nfov = {power}\n");
    mends(&[(Toml, &toml("45 deg"), &toml("45")), (Toml, &toml("45deg # wide"), &toml("45 # wide"))]);
    let json = |fov: &str| {
        format!("{{\"camera\": {{\"fov\": {fov}}}, \"background\": 1, \"objects\": [{{\"Box\": {{\"size\": 1}}}}]}}")
    };
    mends(&[(Json, &json("45deg"), &json("45")), (Json, &json("45 deg"), &json("45"))]);
}

#[test]
fn headers_of_toml_that_have_a_kind_too_much_or_too_little() {
    let objects = "[[objects]]\n[objects.Box]\nsize = 1\n";
    let cases = [
        (
            format!("background = 1\n[camera.Camera]\nfov = 30\n{objects}"),
            format!("background = 1\n[camera]\nfov = 30\n{objects}"),
        ),
        (
            format!("background = 1\n[[camera]]\nfov = 30\n{objects}"),
            format!("background = 1\n[camera]\nfov = 30\n{objects}"),
        ),
        (
            format!("background = 1\ncamera = {{ Camera = {{ fov = 30 }} }}\n{objects}"),
            format!("background = 1\ncamera = {{ fov = 30 }}\n{objects}"),
        ),
        ("background = 1\n[[Box]]\nsize = 1\n".to_owned(), format!("background = 1\n{objects}")),
        (
            format!("[[SphereLight]]\ncenter = [0, 3, 0]\nradius = 1\npower = 9\n{objects}"),
            format!("[[lights]]\n[lights.SphereLight]\ncenter = [0, 3, 0]\nradius = 1\npower = 9\n{objects}"),
        ),
        (
            "background = 1\n[[objects]]\nkind = \"box\"\nsize = { x = 1, y = 2, z = 3 }\n".to_owned(),
            "background = 1\n[[objects]]\n[objects.Box]\nsize = [1, 2, 3]\n".to_owned(),
        ),
        (
            format!("background = 1\n{objects}transform = [{{ Rotate = [0, 30, 0] }}]\n"),
            format!("background = 1\n{objects}transform = [{{ Rotate = {{ axis = [0, 1, 0], degrees = 30 }} }}]\n"),
        ),
    ];
    for (written, right) in &cases {
        mends(&[(Toml, written, right)]);
    }
    let dotted = format!("background = 1\n[camera]\nposition.x = 0\nposition.y = 1\nposition.z = 5\n{objects}");
    told(Toml, &dotted, "write position = [0, 1, 5] in one line");
}

#[test]
fn a_text_that_is_cut_off_is_one_error() {
    let scene = "Scene(background: 1, camera: Camera(position: (0, 1, 5)), objects: [Sphere(center: (0, 0, 0), \
                 radius: 1), Box(size: 1, material: Transparent(ior: 1.5), name: \"box\")])";
    for end in scene.find("(0").expect("numbers")..scene.len() - 1 {
        let found = errors(&scene[..end], Ron);
        assert!(found.len() == 1, "{}\n{found:#?}", &scene[..end]);
    }
    let scene = "{\"background\": 1, \"camera\": {\"position\": [0, 1, 5]}, \"objects\": [{\"Box\": {\"size\": 1, \
                 \"name\": \"box\"}}]}";
    for end in 1..scene.len() - 1 {
        let found = errors(&scene[..end], Json);
        assert!(found.len() == 1, "{}\n{found:#?}", &scene[..end]);
    }
}

#[test]
fn brackets_that_are_missing_at_one_place_are_one_error() {
    let scene = |line: &str| format!("Scene(\n    background: 1,\n    objects: [\n        {line}\n    ],\n)\n");
    told(Ron, &scene("Box(size: 1, material: Diffuse(albedo:"), "this bracket and 1 within it");
    told(Ron, &scene("Box(size: 1, material: Diffuse(albedo: (1, 0, 0"), "this bracket and 2 within it");
    told(Ron, "Sphere(center: (0, 1, 0), radius: 1),\nBox(size: 1),\n],\n)\n", "an object stands in a scene");
}

#[test]
fn words_of_languages_do_not_bring_others() {
    told(
        Ron,
        "Scene(background: 1, let h = 3\n objects: [Sphere(center: (0, h, 0), radius: h)])",
        "vars: { \"h\": 3 }",
    );
    told(
        Ron,
        "Scene(background: 1, objects: [\n  for i in range(10):\n    Sphere(center: (i, 0, 0), radius: 1)\n])",
        "Repeat(count: 10",
    );
}

#[test]
fn points_and_faces_in_one_row_are_one_fault_each() {
    let scene =
        |points: &str, faces: &str| format!("Scene(background: 1, objects: [Mesh(points: {points}, faces: {faces})])");
    let right = scene("[(0, 0, 0), (1, 0, 0), (0, 1, 0)]", "[[0, 1, 2]]");
    mends(&[(Ron, &scene("[0,0,0, 1,0,0, 0,1,0]", "[0, 1, 2]"), &right)]);
    told(Ron, &scene("[0, 0, 0, 1]", "[[0, 1, 2]]"), "3 numbers each in brackets of their own");
    let lathe = |profile: &str| format!("Scene(background: 1, objects: [Lathe(profile: {profile})])");
    mends(&[(Ron, &lathe("[0, 0, 1, 1]"), &lathe("[(0, 0), (1, 1)]"))]);
}

#[test]
fn materials_by_their_names_and_by_a_color_alone() {
    let scene = |material: &str| format!("Scene(background: 1, objects: [Box(size: 1, material: {material})])");
    for (name, way) in [
        ("glass", "Transparent(ior: 1.5)"),
        ("gold_ring", "Conductor(metal: Gold)"),
        ("dark red", "Diffuse(albedo: \"#ff0000\")"),
        ("mirror1", "Mirror(reflectance: 0.9)"),
        ("wall", "Diffuse(albedo: 0.5)"),
    ] {
        told(Ron, &scene(&format!("\"{name}\"")), way);
    }
    let red = scene("Diffuse(albedo: \"#ff0000\")");
    mends(&[(Ron, &scene("{ \"color\": \"red\" }"), &red), (Ron, &scene("(color: \"red\")"), &red)]);
    told(Ron, "Scene(background: 1, objects: [Model(path: \"a.obj\")])", "Mesh(file: \"a.obj\")");
    let toml = "background = 1\n[[objects]]\n[objects.Box]\nsize = 1\n[objects.Box.material]\ncolor = \"red\"\n";
    told(Toml, toml, "below [objects.Box.material.Diffuse] write albedo = \"#ff0000\"");
    let sky = |sky: &str| format!("Scene(background: {sky}, objects: [Box(size: 1)])");
    mends(&[(Ron, &sky("(color: (0, 0, 1))"), &sky("(0, 0, 1)"))]);
}

#[test]
fn what_is_missing_follows_from_what_is_called_otherwise() {
    told(
        Ron,
        "Scene(background: 1, objects: [Repeat(count: 5, item: Box(size: \"=k\"))])",
        "write `items: [Box(size: \"=k\")]`",
    );
    told(Ron, "Scene(background: 1, output: (file: \"a.png\"), objects: [Box(size: 1)])", "-o picture.png");
    for (written, way) in
        [("=1, 2, 3", "three numbers in brackets"), ("=[1, 2, 3]", "the brackets of a point are round")]
    {
        told(Ron, &format!("Scene(background: 1, objects: [Box(size: \"{written}\")])"), way);
    }
}
