//! What people wrote in their first hours: one error, and a hint with which the scene works.

use scene_format::{Diagnostic, LoadError, Severity, Syntax, explain_word, load_str, mend};
use std::path::Path;

fn errors(text: &str, syntax: Syntax) -> Vec<Diagnostic> {
    match load_str("scene", text, syntax, Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            diagnostics.into_iter().filter(|fault| fault.severity == Severity::Error).collect()
        }
        _ => Vec::new(),
    }
}

/// Each is told once, with these words in its hint.
fn check(cases: &[(&str, &str)], syntax: Syntax, scene: impl Fn(&str) -> String) {
    let mut wrong = Vec::new();
    for (written, told) in cases {
        let errors = errors(&scene(written), syntax);
        let hints: Vec<&str> = errors.iter().map(|fault| &*fault.hint).collect();
        if errors.len() != 1 || !hints[0].contains(told) {
            let messages: Vec<&str> = errors.iter().map(|fault| &*fault.message).collect();
            wrong.push(format!("{written}: {messages:?}, hints {hints:?}, not {told:?}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), cases.len(), wrong.join("\n"));
}

fn of_object(object: &str) -> String {
    format!("Scene(background: 1, objects: [{object}])")
}

fn of_material(material: &str) -> String {
    of_object(&format!("Box(size: 1, material: {material})"))
}

#[test]
fn shapes_and_their_fields() {
    let cases = [
        ("Tube(path: [(0, 0, 0), (1, 0, 0)], radius: 0.1)", "did you mean `points`?"),
        ("Tube(points: [(0, 0, 0), (1, 0, 0)], thickness: 0.1)", "write `radius: 0.05`"),
        ("Tube(points: [(0, 0, 0), (1, 0, 0)], width: \"=2*pi\")", "write `radius: \"=(2*pi)/2\"`"),
        ("Lathe(profile: [(1, 0), (0, 1)], axis: (0, 0, 1))", "Align(to: (0, 0, 1))"),
        ("Lathe(profile: [(1, 0), (0, 1)], thickness: 0.1)", "up outside, and down again inside"),
        (
            "Extrude(outline: [[(0, 0), (1, 0), (0, 1)]], depth: 1, axis: (0, 1, 0))",
            "Align(from: (0, 0, 1), to: (0, 1, 0))",
        ),
        ("Rectangle(facing: (0, 0, 1))", "did you mean `normal`?"),
        ("Sphere(d: 2)", "write `radius: 1`"),
        ("Cylinder(from: (0, 0, 0), to: (0, 1, 0), d: 0.5)", "write `radius: 0.25`"),
        ("Rectangle(u: (1, 0, 0))", "the two numbers of its `size`"),
        ("Rectangle(corners: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])", "Polygon(points: [(0, 0, 0)"),
        ("HeightField(file: \"a.png\", size: (2, 1, 2), scale: 0.5)", "the second number of its `size`"),
        ("Difference(objects: [Lathe(profile: [(0, 0), (1, 0), (0, 1)]), Box()])", "`near` of the camera"),
        ("Union(objects: [Repeat(count: 65, items: [Box(size: \"=i+1\")])])", "side by side"),
        ("Rectangle(up: (0, 0, 1))", "which way it faces is its `normal`"),
        ("Disk(axis: (0, 0, 1))", "did you mean `normal`?"),
        ("Rectangle(min: (0, 0, 0), max: (1, 0, 3))", "write `center: (0.5, 0, 1.5), normal: (0, 1, 0), size: (1, 3)`"),
        ("Rectangle(min: (0, 0, 1), max: (2, 4, 1))", "write `center: (1, 2, 1), normal: (0, 0, 1), size: (2, 4)`"),
        ("Plane(x: 2)", "write `point: (2, 0, 0), normal: (1, 0, 0)`"),
        ("Plane(z: -3)", "write `point: (0, 0, -3), normal: (0, 0, 1)`"),
        ("HeightField(file: \"a.png\", size: 2)", "write (2, 0.5, 2), say"),
        ("Ring(inner: 1, outer: 2)", "the nearest here is `Disk(radius: 2, inner_radius: 1)`"),
        ("ForEach(items: [Box(size: 1)])", "count: \"=len(list)\""),
        ("Repeat(count: (10, 8), items: [Box(size: 1)])", "Grid(count: (10, 1, 8))"),
        ("Box(size: 1, placements: Grid(count: (3, 1, 3), step: 2))", "write `spacing: (2, 2, 2)`"),
        ("Box(size: 1, placements: Grid(count: (3, 1, 3), size: 2))", "is its `spacing`"),
        ("Box(size: 1, placements: Scatter(count: 5, on: \"ground\"))", "`min: (-5, 0, -5), max: (5, 0, 5)`"),
        ("Box(size: 1, placements: Scatter(count: 5, radius: 3))", "`min: (-3, 0, -3), max: (3, 0, 3)`"),
        ("Box(transform: [Rotate(axis: (0, 1, 0), degrees: 45, pivot: (0, 0, 0))])", "did you mean `about`?"),
        ("Box(transform: [Translate(0, 1)])", "a vector has three numbers"),
        ("Group(objects: [Box(size: 1)], pivot: (0, 0, 0))", "about: (0, 0, 0)"),
        ("Difference(objects: [Box(rounding: 0.1), Sphere(radius: 0.6)])", "Intersection(objects: [Box(size: 1)"),
        ("Icosahedron(radius: 1)", "Mesh(points: ["),
        ("Star()", "Extrude(outline: [[Repeat("),
        ("Gear(teeth: 12)", "Extrude(outline: [[Repeat("),
        ("Heart()", "curve: CatmullRom"),
        ("Box(size: \"=random(min: 0, max: 1)\")", "mix(2, 5, random(i))"),
        ("Repeat(count: 2, items: [Box(material: Pick([Mirror(), Diffuse()]))])", "index: \"=i\")"),
    ];
    check(&cases, Syntax::Ron, of_object);
    let cases = [
        (r#"{"Box": {"rotation": {"y": 45}}}"#, r#""axis": [0, 1, 0], "degrees": 45"#),
        (r#"{"geometry": "sphere", "castShadow": true}"#, r#"{ "Sphere": { "radius": 1 } }"#),
        (r#"{"Box": {"castShadow": true}}"#, "all throws shadows"),
        (r#"{"Box": {"geometry": {"type": "BoxGeometry"}}}"#, "a shape is a kind of its own"),
        (r#"{"Mesh": {"geometry": {"type": "BoxGeometry"}}}"#, "a shape is a kind of its own"),
    ];
    check(&cases, Syntax::Json, |object| format!("{{\"background\": 1, \"objects\": [{object}]}}"));
}

#[test]
fn materials_and_textures() {
    let cases = [
        (
            "PBR(base_color: (1, 0.8, 0.3), metallic: 1, roughness: 0.2)",
            "write Conductor(reflectance: (1, 0.8, 0.3), roughness: 0.2)",
        ),
        (
            "PBR(base_color: 0.5, metallic: 0, roughness: 0.2)",
            "write BlinnPhong(albedo: 0.5, exponent: 1250, specular: 0.1, energy_conserving: true)",
        ),
        ("Metal(color: (1, 0.8, 0.3), roughness: 0.1)", "`Conductor(reflectance: (1, 0.8, 0.3), roughness: 0.1)`"),
        (
            "Plastic(color: \"#ff0000\")",
            "`BlinnPhong(albedo: \"#ff0000\", exponent: 1000, specular: 0.1, energy_conserving: true)`",
        ),
        ("CarPaint(color: \"#ff0000\")", "write BlinnPhong(albedo: \"#ff0000\", exponent: 1000"),
        ("Fresnel()", "by themselves"),
        ("Random()", "Diffuse(albedo: Noise())"),
        ("Diffuse(albedo: Random())", "Noise(..)"),
        ("BlinnPhong(albedo: 0.5, exponent: 100, specular: \"#ffffff\")", "one number for all colours"),
        ("Diffuse(albedo: 0.5, alpha: Texture(file: \"leaf.png\"))", "no picture cuts holes here"),
        ("Diffuse(albedo: Checkerboard(colors: [0.1, 0.9]))", "write `a: 0.1, b: 0.9`"),
        (
            "Diffuse(albedo: Checker(a: 0.1, b: 0.9, size: 0.5))",
            "`Checkerboard(a: 0.1, b: 0.9)`; its `mapping` says how fine it is",
        ),
        ("Diffuse(albedo: Wood(scale: 0.2))", "`mapping: Object(scale: 5)` for a pattern of 0.2 of the size"),
        ("Diffuse(albedo: Marble(scale: (0.5, 1, 0.3)))", "`mapping: Object(scale: (2, 1, 3.333))`"),
        ("Diffuse(\"green\")", "write `Diffuse(albedo: \"#008000\")`"),
        ("Diffuse(specular: 0.5)", "BlinnPhong("),
        ("\"earth.png\"", "Diffuse(albedo: Texture(file: \"earth.png\"))"),
    ];
    check(&cases, Syntax::Ron, of_material);
    let both = errors(&of_material("Diffuse(albedo: Gradient(from: 0, to: 1))"), Syntax::Ron);
    assert_eq!(both.iter().map(|fault| &*fault.hint).collect::<Vec<_>>(), ["did you mean `a`?", "did you mean `b`?"]);
    let named = |object: &str| {
        format!(
            "Scene(background: 1, vars: {{ \"w\": 1 }}, materials: {{ \"a\": Mirror(), \"c\": Diffuse() }}, objects: \
                 [Box(size: \"=w\", material: \"a\"), Box(size: 1, material: \"c\"), Box(size: 1, material: {object})])"
        )
    };
    let cases = [
        ("Mix(a: \"a\", b: \"c\", amount: 0.5)", "materials cannot be mixed, but colours can"),
        ("\"=d\"", "Pick(from: [\"a\", \"c\"], index"),
    ];
    check(&cases, Syntax::Ron, named);
    let vars = |vars: &str| named("\"=mat\"").replace("\"w\": 1", &format!("\"w\": 1, {vars}"));
    check(
        &[("\"mat\": \"a\"", "it is a material"), ("\"mat\": \"c\"", "Pick(from: [\"c\", ..], index: 0)")],
        Syntax::Ron,
        vars,
    );
}

#[test]
fn what_surrounds_objects() {
    let camera = |camera: &str| format!("Scene(background: 1, camera: Camera({camera}), objects: [Box(size: 1)])");
    let cases = [
        ("projection: Thinlens(aperture: 0.1)", "depth_of_field: ThinLens(aperture: 0.1"),
        ("projection: ThinLens", "depth_of_field: ThinLens(aperture: 0.1"),
        ("vignette: 1", "corners are as bright"),
    ];
    check(&cases, Syntax::Ron, camera);
    let top = |top: &str| {
        format!("Scene({top}, objects: [Box(size: 1), Sphere(radius: 1, material: Emissive(radiance: 1))])")
    };
    let cases = [
        ("gamma: 2.2", "pictures are sRGB"),
        ("effects: Effects(bloom: 1)", "nothing glows beyond its edge"),
        ("render: Render(bloom: true)", "nothing glows beyond its edge"),
        ("radiosity: Radiosity(count: 100)", "is always there"),
        ("background: 1, image: Image(transparent: true)", "`output: Output(alpha: true)`"),
        ("background: 1, image: Image(film_transparent: true)", "`output: Output(alpha: true)`"),
        ("background: \"transparent\"", "`output: Output(alpha: true)`"),
        ("background: transparent", "`output: Output(alpha: true)`"),
        ("render: Render(quality: \"high\")", "`samples: 256`"),
        ("background: Environment(file: \"sky.hdr\", intensity: 2)", "did you mean `scale`?"),
        ("background: Environment(file: \"sky.hdr\", rotate: 90)", "did you mean `rotation`?"),
        ("vars: { \"d\": (1, 2, 3, 4) }", "write [1, 2, 3, 4]"),
    ];
    check(&cases, Syntax::Ron, top);
    let text = "// a library\ninclude: \"lib.ron\"\nScene(background: 1, objects: [Box(size: 1)])\n";
    let found = errors(text, Syntax::Ron);
    assert!(matches!(&*found, [only] if only.message.contains("stands within `Scene(..)`")), "{found:#?}");
    let light = |light: &str| format!("Scene(lights: [{light}], objects: [Box(size: 1)])");
    let cases = [
        ("SphereLight(center: (0, 3, 0), size: 1, power: 10)", "write `radius: 0.5`"),
        ("SphereLight(center: (0, 3, 0), radius: 1, power: 10, direction: (0, -1, 0))", "it shines to all sides"),
    ];
    check(&cases, Syntax::Ron, light);
    let json = r#"{"background": 1, "camera": {"PerspectiveCamera": {"fov": 50}}, "objects": [{"Box": {}}]}"#;
    let found = errors(json, Syntax::Json);
    assert!(matches!(&*found, [only] if only.hint.contains("stand in `camera` itself")), "{found:#?}");
}

/// What is certain is mended in one go.
#[test]
fn what_is_certain_is_mended() {
    for (written, right) in [
        ("Diffuse(\"green\")", "Diffuse(albedo: \"#008000\")"),
        ("Diffuse(albedo: Checkerboard(colors: [0.1, 0.9]))", "Diffuse(albedo: Checkerboard(a: 0.1, b: 0.9))"),
        ("Diffuse(albedo: Gradient(from: 0, to: 1))", "Diffuse(albedo: Gradient(a: 0, b: 1))"),
    ] {
        assert_eq!(mend("scene", &of_material(written), Syntax::Ron, Path::new("")).text, of_material(right));
    }
    // What may mean a size or how fine it is stays.
    let wood = of_material("Diffuse(albedo: Wood(scale: 0.2))");
    assert_eq!(mend("scene", &wood, Syntax::Ron, Path::new("")).text, wood);
    for (written, right) in [
        ("Plane(x: 2)", "Plane(point: (2, 0, 0), normal: (1, 0, 0))"),
        ("Disk(axis: (0, 0, 1))", "Disk(normal: (0, 0, 1))"),
        (
            "Box(transform: [Rotate(axis: (0, 1, 0), degrees: 45, pivot: (0, 0, 0))])",
            "Box(transform: [Rotate(axis: (0, 1, 0), degrees: 45, about: (0, 0, 0))])",
        ),
    ] {
        assert_eq!(mend("scene", &of_object(written), Syntax::Ron, Path::new("")).text, of_object(right));
    }
}

/// The scenes in hints and in answers of `tracer explain` can be read.
#[test]
fn what_is_offered_can_be_read() {
    for object in [
        "Extrude(outline: [[Repeat(count: 10, items: [\"=if(i % 2 == 0, 1, 0.4)*(cos(36*i), sin(36*i))\"])]], depth: \
         0.2)",
        "Extrude(outline: [[(0, -1), (1, 0.2), (0.5, 0.8), (0, 0.4), (-0.5, 0.8), (-1, 0.2)]], depth: 0.2, curve: \
         CatmullRom)",
        "Intersection(objects: [Box(size: 1), Sphere(radius: 0.7)])",
        "Repeat(count: 8, items: [Box(center: (\"=0.3*i\", \"=0.2*i\", 0), size: (0.3, 0.2, 1))])",
        "Lathe(profile: [(0, 0), (0.4, 0), (0.5, 0.4), (0.2, 0.8), (0.3, 1)], curve: CatmullRom)",
        "Repeat(count: 3, vars: { \"v\": Pick(from: [1,3,5], index: \"=i\") }, items: [Box(size: \"=v\")])",
        "Box(size: 1, material: Emissive(radiance: 20, color: \"=blackbody(1900)\"))",
    ] {
        assert_eq!(errors(&of_object(object), Syntax::Ron), [], "{object}");
    }
    for (word, told) in [("stairs", "Repeat(count: 8"), ("vase", "Lathe(profile"), ("look at", "look_at of Camera")] {
        assert!(explain_word(word).is_some_and(|text| text.contains(told)), "{word}");
    }
}
