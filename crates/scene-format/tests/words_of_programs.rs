//! Words that people bring from other programs, wherever they write them: one error, and what to write here.

use scene_format::{Diagnostic, LoadError, Override, Severity, Syntax, load_str};
use std::path::Path;

fn errors(text: &str, sets: &[Override]) -> Vec<Diagnostic> {
    match load_str("scene", text, Syntax::Ron, Path::new(""), sets) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            diagnostics.into_iter().filter(|fault| fault.severity == Severity::Error).collect()
        }
        _ => Vec::new(),
    }
}

/// Each is told once, with these words in its hint.
fn check(cases: &[(&str, &str)], scene: impl Fn(&str) -> String) {
    let mut wrong = Vec::new();
    for (written, told) in cases {
        let errors = errors(&scene(written), &[]);
        let hints: Vec<&str> = errors.iter().map(|fault| &*fault.hint).collect();
        if errors.len() != 1 || !hints[0].contains(told) {
            let messages: Vec<&str> = errors.iter().map(|fault| &*fault.message).collect();
            wrong.push(format!("{written}: {messages:?}, hints {hints:?}, not {told:?}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), cases.len(), wrong.join("\n"));
}

const BALL: &str = "Sphere(center: (0, 0, 0), radius: 1)";

#[test]
fn among_the_objects() {
    let cases = [
        ("sphere_sweep(radius: 1)", "`Tube(points: .., radius: 1)`"),
        ("PlyMesh(file: \"a.ply\")", "did you mean `Mesh`?"),
        ("glass()", "that is a material"),
        ("emitter()", "material: Emissive(radiance: 5)"),
        ("envmap()", "`background`"),
        ("sky()", "`background`"),
        ("area_light()", "material: Emissive(radiance: 5)"),
        ("point_light()", "`lights`"),
        ("Box(size: 1, pigment: 1)", "`material: Diffuse(albedo: 1)`"),
        ("Box(size: 1, finish: 1)", "Conductor(..)"),
        ("Box(size: 1, rgb: (1, 0, 0))", "`material: Diffuse(albedo: (1, 0, 0))`"),
        ("Box(size: 1, hex: \"#ff0000\")", "`material: Diffuse(albedo: \"#ff0000\")`"),
        ("Box(size: 1, bsdf: Mirror())", "did you mean `material`?"),
        ("Box(radius: 1)", "its `size`"),
        ("Rectangle(radius: 1)", "a `Disk`"),
        ("Box(size: 1, move: (1, 0, 0))", "`transform: [Translate((1, 0, 0))]`"),
        ("Box(size: 1, rotateX: 30)", "`transform: [Rotate(axis: (1, 0, 0), degrees: 30)]`"),
        ("Box(size: 1, ior: 1.5)", "`material: Transparent(ior: 1.5)`"),
        ("Box(size: 1, interior: 1)", "Transparent(ior: 1.5)"),
        ("Box(size: 1, instances: 3)", "there is `placements`"),
        ("Box(size: 1, emitter: 3)", "Emissive(radiance: 5)"),
        ("Box(size: 1, transform: [Move((1, 0, 0))])", "did you mean `Translate`?"),
        ("Box(size: 1, transform: [Turn(30)])", "`Rotate(axis: .., degrees: ..)`"),
        ("Sphere(center: (0, 0, 0), radius: 2**3)", "write \"=2^3\""),
        ("Sphere(center: (0, 0, 0), radius: 1?2:3)", "write \"=if(1, 2, 3)\""),
        ("Sphere(center: (0, 0, 0), radius: \"=2**3\")", "`^`"),
        ("Sphere(center: (0, 0, 0), radius: \"=true?2:3\")", "if(condition, a, b)"),
        ("Sphere(center: (0, 0, 0), radius: \"=1 < 2 and 3\")", "`&&`"),
        ("Sphere(center: (0, 0, 0), radius: \"=math.sin(3)\")", "sin(x)"),
        ("Sphere(center: (0, 0, 0), radius: \"=PI\")", "`pi`"),
    ];
    check(&cases, |object| format!("Scene(background: 1, objects: [{BALL}, {object}])"));
    // What is offered is right.
    let text = format!("Scene(background: 1, objects: [{BALL}, Box(size: 1, transform: [translate(1, 0, 0)])])");
    let errors = errors(&text, &[]);
    assert_eq!(errors[0].edit.as_ref().expect("an edit").replacement, "Translate((1, 0, 0))");
}

#[test]
fn among_the_materials() {
    let cases = [
        ("DiffuseBSDF()", "did you mean `Diffuse`?"),
        ("GlassBSDF()", "`Transparent(ior: ..)`"),
        ("coatedconductor()", "BlinnPhong("),
        ("twosided()", "two sides"),
        ("mask()", "leave the object out"),
        ("Sphere(radius: 1)", "that is a shape"),
        ("Transparent(int_ior: 1.5)", "did you mean `ior`?"),
        ("Transparent(ior: 1.5, color: 1)", "did you mean `transmittance`?"),
        ("Diffuse(rgb: (1, 0, 0))", "did you mean `albedo`?"),
        ("Diffuse(hex: \"#ff0000\")", "did you mean `albedo`?"),
        ("Diffuse(map_Kd: \"a.png\")", "write `albedo: Texture(file: \"a.png\")`"),
        ("Diffuse(albedo: hex(\"ff0000\"))", "write \"#ff0000\""),
        ("Diffuse(ior: 1.5)", "Transparent(ior: 1.5)"),
        ("Conductor(metal: Au)", "did you mean `Gold`?"),
        ("Emissive(strength: 3)", "by `radiance`, `power` in W"),
        ("Emissive(Ke: 3)", "by `radiance`, `power` in W"),
        ("Emissive(nits: 300)", "`luminance`"),
        ("Emissive(radiance: Blackbody(temperature: 2700))", "write \"=blackbody(2700)\""),
        ("Emissive(luminance: 300, color: blackbody(2700))", "write \"=blackbody(2700)\""),
        ("Emissive(luminance: 300, temperature: 2700)", "`color: \"=blackbody(2700)\"`"),
        ("BlinnPhong(Ns: 30, specular: 0.1)", "did you mean `exponent`?"),
        ("Diffuse(albedo: Checkerboard(uscale: 2, vscale: 3))", "write `mapping: Uv(scale: (2, 3))`"),
        ("Diffuse(albedo: Checkerboard(udelta: 2))", "Uv(scale: (u, v), offset: (u, v))"),
        ("Diffuse(albedo: Checkerboard(color0: 0.1, color1: 0.9))", "write `a: 0.1, b: 0.9`"),
    ];
    check(&cases, |material| format!("Scene(background: 1, objects: [Box(size: 1, material: {material})])"));
}

#[test]
fn in_the_camera() {
    let cases = [
        ("lookAt: (0, 0, 0)", "did you mean `look_at`?"),
        ("look_from: (0, 0, 5)", "did you mean `position`?"),
        ("fieldOfView: 40", "did you mean `fov`?"),
        ("hfov: 40", "fov_axis: Horizontal"),
        ("lensradius: 0.1", "ThinLens(aperture: 0.1, focus_distance: 5)"),
        ("focaldistance: 5", "ThinLens(aperture: 0.1, focus_distance: 5)"),
        ("up_vector: (0, 1, 0)", "did you mean `up`?"),
        ("aspect: 1.5", "Image(width: 640, height: 480)"),
        ("iso: 100", "`exposure`"),
        ("name: \"a\"", "`cameras`"),
        ("projection: Spherical", "did you mean `Panorama`?"),
        ("spp: 3", "that is `samples` here, a field of `render`"),
    ];
    check(&cases, |camera| format!("Scene(background: 1, camera: Camera({camera}), objects: [{BALL}])"));
}

#[test]
fn in_the_scene_and_its_groups() {
    let cases = [
        ("background: None", "`output: Output(alpha: true)`"),
        ("background: Sky()", "Environment(file: \"sky.hdr\")"),
        ("background: envmap(file: \"a.hdr\")", "Environment(file: \"sky.hdr\")"),
        ("background: \"a.hdr\"", "Environment(file: \"a.hdr\")"),
        ("background: black", "write \"#000000\""),
        ("background: Color(1, 1, 1)", "a colour stands alone"),
        ("background: 1, camera: Orthographic(height: 3)", "Camera(projection: Orthographic(height: 3))"),
        ("background: 1, spp: 3", "that is `samples` here, a field of `render`"),
        ("background: 1, maxdepth: 3", "that is `max_bounces` here, a field of `render`"),
        ("background: 1, bsdfs: {}", "did you mean `materials`?"),
        ("background: 1, emitters: []", "did you mean `lights`?"),
        ("background: 1, variables: {}", "did you mean `vars`?"),
        ("background: 1, repeat: 3", "`Repeat`"),
        ("background: 1, render: Render(sampleCount: 3)", "did you mean `samples`?"),
        ("background: 1, render: Render(maxDepth: 3)", "did you mean `max_bounces`?"),
        ("background: 1, render: Render(integrator: bdpt)", "did you mean `Full`?"),
        ("background: 1, render: Render(noise_threshold: 0.1)", "--noise 2%"),
        ("background: 1, image: Image(xresolution: 3)", "did you mean `width`?"),
        ("background: 1, image: Image(filename: \"a.png\")", "-o picture.png"),
        ("background: 1, lights: [point_light(position: (0, 1, 0))]", "a small sphere"),
        ("background: 1, lights: [area_light()]", "Rectangle(material: Emissive(radiance: 5))"),
        ("background: 1, lights: [Disk()]", "shapes stand in `objects`"),
    ];
    check(&cases, |top| format!("Scene({top}, objects: [{BALL}])"));
}

/// Every index of the repetitions in which a fault is met is told.
#[test]
fn faults_in_repetitions_name_their_indices() {
    let cases = [
        ("Repeat(count: 3, items: [Sphere(center: (0, 0, 0), radius: \"=i\")])", " (i = 0)"),
        (
            "Repeat(count: 5, items: [Repeat(count: 2, index: \"j\", items: [Box(size: \"=3 - i - j\")])])",
            " (i = 2, j = 1)",
        ),
        ("Box(size: 1, placements: [Repeat(count: 4, index: \"k\", items: [[Scale(\"=2 - k\")]])])", " (k = 2)"),
    ];
    for (object, indices) in cases {
        let errors = errors(&format!("Scene(background: 1, objects: [{object}])"), &[]);
        let messages: Vec<&str> = errors.iter().map(|fault| &*fault.message).collect();
        assert!(matches!(messages[..], [only] if only.ends_with(indices)), "{object}: {messages:?}");
    }
}

/// `--set` reaches the numbers of a vector that is written, and tells what to do where it cannot.
#[test]
fn parts_of_vectors_are_set() {
    let text = format!("Scene(background: 1, camera: Camera(position: (1, 2, 3)), objects: [{BALL}])");
    let load = |set: &str| load_str("scene", &text, Syntax::Ron, Path::new(""), &[Override::from(set)]);
    for (set, position) in [
        ("camera.position.x=7", [7.0, 2.0, 3.0]),
        ("camera.position[2]=-7", [1.0, 2.0, -7.0]),
        ("camera.position.y=\"=1+1.5\"", [1.0, 2.5, 3.0]),
    ] {
        assert_eq!(load(set).expect("right").scene.camera.position.value, position, "{set}");
    }
    for (set, hint) in [
        ("camera.look_at.x=7", "set it as a whole: (x, y, z)"),
        ("camera.look_from.x=7", "did you mean `position`?"),
        ("camera.position.w=7", ""),
        ("camera.position[3]=7", ""),
    ] {
        let errors = errors(&text, &[Override::from(set)]);
        let hints: Vec<&str> = errors.iter().map(|fault| &*fault.hint).collect();
        assert_eq!(hints, [hint], "{set}: {errors:?}");
    }
}

/// A name that is misspelt two hundred times is told once, with the first lines.
#[test]
fn a_name_that_is_misspelt_everywhere_is_told_once() {
    let boxes = "Box(size: 1, material: \"wod\"),\n".repeat(200);
    let text = format!("Scene(background: 1, materials: {{ \"wood\": Diffuse() }}, objects: [\n{boxes}])");
    let Err(LoadError::Invalid { diagnostics, sources, .. }) = load_str("s", &text, Syntax::Ron, Path::new(""), &[])
    else {
        panic!("wrong")
    };
    let shown = scene_format::render::text(&diagnostics, &sources, scene_format::render::Style::default());
    assert_eq!(shown.matches("there is no material").count(), 1, "{shown}");
    assert!(shown.contains("199 more like this, on lines 3, 4, 5"), "{shown}");
}

/// Calls and brackets of other languages, and words of theirs for transforms and solids.
#[test]
fn in_other_languages() {
    let ball = |center: &str| format!("Sphere(center: {center}, radius: 1)");
    let moved = |step: &str| format!("Box(size: 1, transform: [{step}])");
    let cases = [
        (ball("THREE.Vector3(0, 1, 6)"), "write (0, 1, 6)"),
        (ball("new THREE.Vector3(0, 1, 6)"), "write (0, 1, 6)"),
        (ball("glm::vec3(0, 1, -6.5)"), "write (0, 1, -6.5)"),
        (ball("np.array([0, 1, 6])"), "write (0, 1, 6)"),
        ("new Sphere(center: (0, 0, 0), radius: 1)".to_owned(), "write Sphere(..)"),
        (ball("{0, 1, 6}"), "write `(` and `)`"),
        (ball("(a -b, 0, 0)"), "write \"=a -b\""),
        (moved("Rotate(x: 30, y: 40)"), "Rotate(axis: (1, 0, 0), degrees: 30), Rotate(axis: (0, 1, 0), degrees: 40)"),
        (moved("Rotate(y: 40)"), "write Rotate(axis: (0, 1, 0), degrees: 40)"),
        (moved("Scale(x: 2)"), "write `factor: (2, 1, 1)`"),
        (moved("Scale(z: 3, x: 2)"), "write `factor: (2, 1, 3)`"),
        (moved("Matrix([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0])"), "four numbers are a row"),
        ("Difference(a: Box(size: 1), b: Box(size: 2))".to_owned(), "write `objects: [Box(size: 1), Box(size: 2)]`"),
        ("Union(left: Box(size: 1), right: Box(size: 2))".to_owned(), "write `objects: [Box(size: 1), Box(size: 2)]`"),
        ("Box(size: 1, material: Emissive(power: \"100 W\"))".to_owned(), "numbers carry no unit: write 100"),
        ("Mesh(file: a/b)".to_owned(), "write \"a/b\""),
        ("Shape \"sphere\" \"float radius\" [ 1 ]".to_owned(), "write Sphere(center: (x, y, z), radius: ..)"),
        (
            "Box(size: 1, material: Material \"diffuse\" \"rgb reflectance\" [ .5 .5 .5 ])".to_owned(),
            "write Diffuse(albedo: (r, g, b))",
        ),
        ("RectAreaLight(width: 1, height: 2)".to_owned(), "a lamp is an object that shines"),
    ];
    let cases: Vec<(&str, &str)> = cases.iter().map(|(written, told)| (written.as_str(), *told)).collect();
    check(&cases, |object| {
        // The names of these are given.
        format!("Scene(vars: {{ \"a\": 1, \"b\": 2 }}, background: \"=a*b\", objects: [{BALL}, {object}])")
    });
    // So it is where nobody knows the names.
    check(&[("(c -d, 0, 0)", "write \"=c -d\"")], |center| {
        format!("Scene(background: 1, objects: [{BALL}, Sphere(center: {center}, radius: 1)])")
    });
    let found = errors(&format!("Scene(version: \"1.0\", background: 1, objects: [{BALL}])"), &[]);
    let edits: Vec<&str> = found.iter().filter_map(|fault| Some(&*fault.edit.as_ref()?.replacement)).collect();
    assert_eq!((found.len(), edits), (1, vec!["1"]));
}

/// What is wrong with a value of `--set` is not said of a scene or a file.
#[test]
fn values_of_arguments() {
    let scene = format!(
        "Scene(background: 1, materials: {{ \"my glass\": Transparent(ior: 1.5) }}, objects: [{BALL}, Box(size: 1, \
         material: \"my glass\")], output: Output(marks: {{ \"A\": (0, 0, 0) }}))"
    );
    let told = |argument: &str| {
        let found = errors(&scene, &[Override::from(argument)]);
        assert_eq!(found.len(), 1, "{argument}: {found:#?}");
        format!("{} {} {}", found[0].message, found[0].expected, found[0].hint)
    };
    for (argument, says) in [
        ("camera.fov=40)", "this bracket closes nothing"),
        ("camera.fov=40 50", "the value ended before this"),
        ("camera.position=(0, 1, 6", "write `)` at its end"),
        ("materials.glass.ior=2", "did you mean `\"my glass\"`?"),
        ("objects[1].material.ior=2", "'materials.\"my glass\"'"),
        ("output.marks.B.x=2", "the scene has no mark \"B\""),
        ("camera.fov=30+5", "write --set 'camera.fov==30+5'"),
        ("camera.position=(0, 1+2, 3)", "write --set 'camera.position=(0, \"=1+2\", 3)'"),
        ("materials.my.ior=2", "the scene has no material \"my\""),
    ] {
        let told = told(argument);
        assert!(told.contains(says) && !told.contains("file"), "{argument}: {told}");
    }
}

/// Hints for `--set` have the whole argument as a shell takes it.
#[test]
fn first_tries_of_arguments() {
    let lit = "materials: { \"white\": Diffuse(albedo: 0.5) }, lights: [SphereLight(center: (0, 5, 0), radius: 0.1, \
               power: 3)],";
    let cases = [
        (lit, "objects[0].name=foo", "write --set 'objects[0].name=\"foo\"'"),
        (lit, "objects[0].name=my ball (1)", "write --set 'objects[0].name=\"my ball (1)\"'"),
        (lit, "objects[0].material=white #2", "write --set 'objects[0].material=\"white #2\"'"),
        (lit, "objects[0].name=it's #1", "write --set 'objects[0].name=\"it'\\''s #1\"'"),
        (lit, "lights[0].group=key", "write --set 'lights[0].group=\"key\"'"),
        (lit, "materials.white.albedo=a/b.png", "write --set 'materials.white.albedo=Texture(file: \"a/b.png\")'"),
        (lit, "include=style.ron", "write --set 'include=[\"style.ron\"]'"),
        (lit, "image.size=160x100", "write --size 160x100"),
        (lit, "image.size=(160,100)", "write --size 160x100"),
        (lit, "output.layers=depth", "write --set 'output.layers=[Depth]'"),
        (lit, "render.caustics=false", "write --set 'render.caustics=None'"),
        (lit, "lights[0].color=3000K", "write --set 'lights[0].color==blackbody(3000)'"),
        (lit, "materials.white=null", "write --set 'materials.white=Diffuse(albedo: 0.5)', say"),
        ("", "lights[0].power=3", "--set 'lights=[SphereLight("),
    ];
    for (top, set, told) in cases {
        let text = format!("Scene(background: 1, {top} camera: Camera(), objects: [{BALL}])");
        let errors = errors(&text, &[Override::from(set)]);
        assert!(errors.len() == 1 && errors[0].hint.contains(told), "{set}: {errors:#?}");
    }
}

/// A value of `--set` that begins with `=` is an expression, and a new name in a map is added.
#[test]
fn expressions_and_names_of_arguments() {
    let scene = format!(
        "Scene(background: 1, materials: {{ \"red\": Diffuse(albedo: 0.5) }}, objects: [{BALL}, Box(size: 1, \
         material: \"red\")])"
    );
    let load = |sets: &[&str]| {
        let sets: Vec<Override> = sets.iter().map(|set| Override::from(*set)).collect();
        load_str("scene", &scene, Syntax::Ron, Path::new(""), &sets).expect("right").scene
    };
    assert_eq!(load(&["camera.fov==30+5"]).camera.fov.value, 35.0);
    assert_eq!(load(&["vars.x=3", "camera.fov==10*x"]).camera.fov.value, 30.0);
    let added = load(&["materials.blue=Diffuse(albedo: 0.3)", "objects[1].material=blue"]);
    assert!(added.materials.iter().any(|material| &*material.name.value == "blue"));
    let quoted = load(&["materials.\"my blue\"=Mirror()", "materials[\"other one\"]=Mirror()"]);
    let names: Vec<&str> = quoted.materials.iter().map(|material| &*material.name.value).collect();
    assert_eq!(names, ["red", "my blue", "other one"]);
}

/// Declarations, and names in the ways of other languages.
#[test]
fn names_with_values_of_other_languages() {
    let top =
        ["let x = 3;", "let x = 3,", "var x = 3;", "const x = (1, 2, 3);", "x = 3,", "x = \"a\",", "#declare x = 3;\n"];
    let cases: Vec<(&str, &str)> = top.iter().map(|top| (*top, "`vars`")).collect();
    check(&cases, |top| format!("Scene({top}\n background: 1, objects: [{BALL}])"));
    let text = format!("Scene(let x = 3; background: 1, objects: [{BALL}])");
    assert!(errors(&text, &[]).iter().all(|fault| fault.edit.is_none()));
    let ways = ["vars.h", "{h}", "$h", "${h}", "h", "\"$h\"", "\"{h}\"", "\"vars.h\"", "\"h\""];
    let known: Vec<(&str, &str)> = ways.iter().map(|way| (*way, "write \"=h\"")).collect();
    check(&known, |h| {
        format!("Scene(background: 1, vars: {{ \"h\": 2 }}, objects: [Sphere(center: (0, {h}, 0), radius: 1)])")
    });
    let none: Vec<(&str, &str)> = ways[..8].iter().map(|way| (*way, "vars: { \"h\": .. }")).collect();
    check(&none, |h| format!("Scene(background: 1, objects: [Sphere(center: (0, {h}, 0), radius: 1)])"));
}

/// Numbers, colours and texts as pages and other programs have them.
#[test]
fn numbers_and_colors_of_other_programs() {
    let colors = [
        ("rgb(80%, 20%, 10%)", "write (0.8, 0.2, 0.1)"),
        ("(80%, 20%, 10%)", "write 0.8, 0.2, 0.1"),
        ("(208, 58, 43)", "write \"#d03a2b\""),
        ("(r: 1, g: 0, b: 0)", "write (1, 0, 0)"),
        ("(1, 0, 0, 1)", "write (1, 0, 0)"),
        ("(1, 0, 0, 0.5)", "no alpha"),
        ("Red", "write \"#ff0000\""),
    ];
    check(&colors, |color| {
        format!("Scene(background: 1, objects: [{BALL}, Box(size: 1, material: Diffuse(albedo: {color}))])")
    });
    let points = [
        ("(0 1.6 6)", "write 0, 1.6, 6"),
        ("[0 1.6 6]", "write 0, 1.6, 6"),
        ("\"0 1.6 6\"", "write (0, 1.6, 6)"),
        ("(0, \u{2212}35, 0)", "plain `-`"),
        ("(0\u{ff0c}1\u{ff0c}2)", "write 0, 1, 2"),
        ("(0\u{200b}, 1, 2)", "write 0, without"),
        ("(0, \u{200b}1, 2)", "remove it"),
    ];
    check(&points, |point| format!("Scene(background: 1, objects: [Sphere(center: {point}, radius: 1)])"));
    check(&[(",", "plain `,`")], |_| format!("Scene(background: 1\u{ff0c} objects: [{BALL}])"));
}

/// Fields and kinds that are one mistake.
#[test]
fn one_mistake_in_fields_and_kinds() {
    let mesh = "points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]]";
    let mesh = |more: &str| format!("Mesh({mesh}, {more})");
    let turned = |step: &str| format!("Box(size: 1, transform: [{step}])");
    let cases = [
        (mesh("color: (1, 0, 0)"), "write `material: Diffuse(albedo: (1, 0, 0))`"),
        (mesh("color: \"red\""), "write `material: Diffuse(albedo: \"#ff0000\")`"),
        (mesh("smooth: true"), "write `shading: Smooth`"),
        ("Mesh(file: \"a.obj\", vertices: [(0, 0, 0)])".to_owned(), "in its `file`"),
        (turned("RotateX(degrees: 30)"), "write Rotate(axis: (1, 0, 0), degrees: 30)"),
        (turned("RotateZ(angle: 30)"), "write Rotate(axis: (0, 0, 1), degrees: 30)"),
        (turned("RotateY(radians: 1.57)"), "write Rotate(axis: (0, 1, 0), degrees: 90)"),
        (turned("RotateZ"), "about z (0, 0, 1)"),
        (turned("Rotate(axis: (0, 1, 0), radians: 0.785)"), "write `degrees: 45`"),
        (turned("Rotate(axis: (0, 1, 0), radians: 1.56)"), "write `degrees: 89.38"),
        (turned("Scale(by: 2)"), "did you mean `factor`?"),
        ("Repeat(count: 3, object: Box(size: 1))".to_owned(), "write `items: [Box(size: 1)]`"),
        ("Repeat(count: 3, objects: [Box(size: 1)])".to_owned(), "did you mean `items`?"),
        (
            "Box(size: 1, placements: [(1, 0, 0), (2, 0, 0)])".to_owned(),
            "[[Translate((1, 0, 0))], [Translate((2, 0, 0))]]",
        ),
        (
            "Box(size: 1, placements: [Translate((1, 0, 0)), Translate((2, 0, 0))])".to_owned(),
            "[[Translate((1, 0, 0))], [Translate((2, 0, 0))]]",
        ),
        ("Box(size: 1, material: Red)".to_owned(), "write \"red\""),
        ("Box(size: 1, material: Gold())".to_owned(), "Conductor(metal: Gold)"),
        (
            "Box(size: 1, material: Diffuse(albedo: Checkerboard(repeat: 3)))".to_owned(),
            "write `mapping: Uv(scale: 3)`",
        ),
        ("Box(size: 1, material: Transparent(ior: 1.5, absorption: (1, 1, 1)))".to_owned(), "`transmittance`"),
    ];
    let cases: Vec<(&str, &str)> = cases.iter().map(|(written, told)| (written.as_str(), *told)).collect();
    check(&cases, |object| {
        let used = "Box(size: 1, material: \"red\")";
        format!("Scene(background: 1, materials: {{ \"red\": Mirror() }}, objects: [{BALL}, {used}, {object}])")
    });
    let rows = "((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 5))";
    let flat = "1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 5";
    let cases = [
        (format!("background: 1, camera: Camera(transform: Matrix(rows: {rows}))"), "write `matrix: ((1, 0, 0, 0)"),
        (format!("background: 1, camera: Camera(transform: Matrix([{flat}]))"), "write `matrix: ((1, 0, 0, 0)"),
        (format!("background: 1, camera: Camera(transform: [Matrix(rows: {rows})])"), "write `matrix: ((1, 0, 0, 0)"),
        ("background: 1, vars: (h: 2)".to_owned(), "write { \"h\": 2 }"),
        ("background: 1, output: \"a.png\"".to_owned(), "-o picture.png"),
        ("background: HosekSky(turbidity: 3)".to_owned(), "a large sphere that shines"),
        ("background: 1, effects: Effects(tone_map: ACES)".to_owned(), "a curve of that kind is `Filmic`"),
    ];
    let cases: Vec<(&str, &str)> = cases.iter().map(|(written, told)| (written.as_str(), *told)).collect();
    check(&cases, |top| format!("Scene({top}, objects: [{BALL}])"));
}

/// Files of other programs, and what is no text at all, are told as what they are.
#[test]
fn whole_files_of_other_programs() {
    let told = |text: &str| {
        let found = errors(text, &[]);
        assert_eq!(found.len(), 1, "{text}: {found:?}");
        format!("{}: {}", found[0].message, found[0].hint)
    };
    let gltf = "{ \"asset\": { \"version\": \"2.0\" }, \"accessors\": [], \"bufferViews\": [] }";
    assert!(told(gltf).starts_with("this looks like glTF"), "{}", told(gltf));
    let three = "{ \"metadata\": {}, \"geometries\": [], \"object\": { \"type\": \"Scene\" } }";
    assert!(told(three).contains("three.js") && told(three).contains("GLB"), "{}", told(three));
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    for (name, bytes, hint) in [
        ("room.ron", &b"BLENDER-v300\xff\x00"[..], "export a mesh"),
        ("picture.ron", b"\x89PNG\r\n\x1a\n", "as a texture or a background"),
    ] {
        let path = folder.join(name);
        std::fs::write(&path, bytes).expect("written");
        let Err(LoadError::Invalid { diagnostics, .. }) = scene_format::load(&path) else {
            panic!("{name} is no scene")
        };
        assert!(diagnostics.len() == 1 && diagnostics[0].hint.contains(hint), "{diagnostics:?}");
    }
}
