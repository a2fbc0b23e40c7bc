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
        (
            "Torus(radius: 1, thickness: 0.4)",
            "the `tube_radius` is half of the size from side to side: write `tube_radius: 0.2`",
        ),
        ("Box(transform: [Rotate(z: \"=30*2\")])", "write `axis: (0, 0, 1), degrees: \"=30*2\"`"),
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
        ("Diffuse(albedo: Wood(direction: (1, 0, 0)))", "its direction is `axis`: `axis: (1, 0, 0)`"),
        ("Diffuse(albedo: Noise(rotation: 90))", "a pattern turns with its object"),
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

/// Repetitions over lists, copies by a rule in brackets, radii of two ends, lamps without shadows and others.
#[test]
fn shapes_and_lists_of_other_programs() {
    let cases = [
        ("Sphere(radius: 1, placements: [Ring(count: 6, radius: 2)])", "write `placements: Ring(count: 6, radius: 2)`"),
        ("Sphere(radius: 1, placements: [[Grid(count: (2, 1, 2))]])", "write `placements: Grid(count: (2, 1, 2))`"),
        (
            "Sphere(radius: 1, placements: [Grid(count: (2, 1, 2)), Ring(count: 6, radius: 2)])",
            "each other has an object of its own",
        ),
        (
            "Repeat(for_each: [1, 2], items: [Box()])",
            "`count: 2, vars: { \"v\": Pick(from: [1, 2], index: \"=i\") }`: in",
        ),
        (
            "Repeat(list: [1, 2], index: \"r\", items: [Box()])",
            "{ \"r\": Pick(from: [1, 2], index: \"=i\") }`, and no `index`",
        ),
        ("Repeat(list: [Box()], count: 2)", "did you mean `items`?"),
        ("Repeat(for: 5, items: [Box()])", "`count: 5`"),
        ("Cylinder(radius: 1, chamfer: 0.1)", "Lathe(profile: [(0, 0), (0.9, 0), (1, 0.1)"),
        ("Cylinder(radius: 1, depth: 2)", "write `from: (0, 0, 0), to: (0, 2, 0)`"),
        ("Screw(pitch: 0.1)", "Tube(points: [Repeat("),
        ("Thread()", "Tube(points: [Repeat("),
        ("Cone(from: (0, 0, 0), to: (0, 1, 0), radius: 1, radius_to: 0.5)", "did you mean `tip_radius`?"),
        ("Cone(from: (0, 0, 0), to: (0, 1, 0), r1: 1)", "did you mean `radius`?"),
        ("Cone(from: (0, 0, 0), to: (0, 1, 0), r0: 1, r1: 0.5)", "write `radius: 1, tip_radius: 0.5`"),
        ("Torus(radius: 1, r2: 0.2)", "did you mean `tube_radius`?"),
        ("Box(corner: (0, 0, 1), size: 1)", "write `center: (0.5, 0.5, 1.5)`"),
        ("Box(min: (0, 0, 0), size: (1, 2, 3))", "write `center: (0.5, 1, 1.5)`"),
        ("Box(corner: (0, 0, 0))", "about its `center`"),
        ("Box(min: (0, 0, 0), max: (1, 2, 3))", "write `center: (0.5, 1, 1.5), size: (1, 2, 3)`"),
        (
            "Difference(objects: [Group(objects: [Box(), Sphere(radius: 1)]), Box()])",
            "write Union(objects: [Box(), Sph",
        ),
        ("Difference(objects: [Group(objects: [Box()], transform: [Scale(2)]), Box()])", "a group about the origin"),
        ("Difference(objects: [Include(file: \"a.ron\"), Box()])", "write its shapes here, in a `Union`"),
        ("Difference(Sphere(radius: 1), Box(), material: Mirror())", "write `objects: [Sphere(radius: 1), Box()]`"),
        ("Sphere(radius: 1, center: Keyframes([(0, (0, 0, 0))]))", "\"=keyframes(time, 0, (0, 0, 0), 1, (1, 0, 0))\""),
        ("Box(rounding: Animated([0, 1]))", "\"=keyframes(time, 0, 1, 1, 2)\""),
        ("Dimension(from: (0, 0, 0), to: (1, 0, 0))", "two Arrows that meet in its middle"),
        ("ShadowCatcher()", "there is no shadow catcher"),
        ("Box(shadow_catcher: true)", "there is no shadow catcher"),
        ("Cloth()", "a mesh that another program has draped"),
        ("Text(string: \"A\")", "an Extrude of their outlines"),
        ("Checkerboard()", "Plane(material: Diffuse(albedo: Checkerboard()))"),
        ("Repeat(count: 5, items: [Box(size: (1, \"=4-i\", 1))])", "write \"=max(4-i, 0.001)\", which stays above 0"),
        ("Repeat(count: 2, items: [Sphere(radius: \"=i\")])", "write \"=max(i, 0.001)\""),
    ];
    check(&cases, Syntax::Ron, of_object);
    let of_list = |repeat: &str| format!("Scene(background: 1, vars: {{ \"p\": [(0, 0, 0)] }}, objects: [{repeat}])");
    let cases = [
        (
            "Repeat(over: \"=p\", as: \"a\", items: [Box(center: \"=a\")])",
            "`count: \"=len(p)\", vars: { \"a\": \"=p[i]\" }`",
        ),
        ("Repeat(for: \"a\", in: p, items: [Box(center: \"=a\")])", "`count: \"=len(p)\", vars: { \"a\": \"=p[i]\" }`"),
        ("Repeat(over: \"=p\", as: \"a\", index: \"k\", items: [Box()])", "{ \"a\": \"=p[k]\" }`"),
        ("Repeat(over: \"=p\", items: [Box()])", "in its items \"=v\" is one of them"),
        ("Repeat(over: \"=p\", as: \"a\", count: 1, items: [Box()])", "write `vars: { \"a\": \"=p[i]\" }`"),
        (
            "Repeat(over: \"=p\", as: \"a\", vars: { \"b\": 1 }, items: [Box(size: \"=b\")])",
            "write `count: \"=len(p)\"`, and into its `vars` `\"a\": \"=p[i]\"`",
        ),
    ];
    check(&cases, Syntax::Ron, of_list);
    let cases = [
        (
            r#"{"Sphere": {"radius": 1, "placements": [{"Ring": {"count": 6, "radius": 2}}]}}"#,
            r#"write `"placements": {"Ring""#,
        ),
        (
            r#"{"Repeat": {"over": "=p", "as": "a", "items": [{"Box": {}}]}}"#,
            r#"write `"count": "=len(p)", "vars": { "a": "#,
        ),
        (
            r#"{"Difference": {"objects": [{"Group": {"objects": [{"Box": {}}]}}]}}"#,
            r#"write "Union" in place of "Group""#,
        ),
    ];
    check(&cases, Syntax::Json, |object| format!("{{\"background\": 1, \"objects\": [{object}]}}"));
}

#[test]
fn cameras_lamps_and_surfaces_of_other_programs() {
    let cases = [
        ("Diffuse(albedo: 0.5, transmission: 0.5)", "no light goes through it"),
        ("Diffuse(albedo: 0.5, translucency: 0.5)", "no light goes through it"),
        ("Diffuse(albedo: 0.5, two_sided: true)", "look alike from both: leave it out"),
        ("Mirror(two_sided: true)", "look alike from both: leave it out"),
        ("Unlit(color: 0.5)", "Emissive(radiance: 1"),
        ("ShadowCatcher()", "there is no shadow catcher"),
        ("Emissive(lux: 500)", "lux times the square of the distance"),
    ];
    check(&cases, Syntax::Ron, of_material);
    let light = |light: &str| {
        format!("Scene(lights: [SphereLight(center: (0, 3, 0), radius: 1, {light})], objects: [Box(size: 1)])")
    };
    let cases = [
        ("power: 9, cast_shadows: false", "no lamp does without"),
        ("power: 9, falloff: 2", "with the square of the distance, as it does"),
        ("lux: 500", "`luminous_intensity: 2000`"),
    ];
    check(&cases, Syntax::Ron, light);
    let top = |top: &str| format!("Scene(background: 1, {top}, objects: [Box(size: 1)])");
    let cases = [
        ("camera: Camera(projection: Orthographic(width: 12))", "write `height: 12`: in a picture of 512x512 pixels"),
        (
            "image: Image(width: 640, height: 480), camera: Camera(projection: Orthographic(width: 12))",
            "write `height: 9`: in a picture of 640x480 pixels that is 12 across",
        ),
        ("camera: Camera(projection: Orthographic(width: \"=2*6\"))", "the width times the picture's height over"),
        ("camera: Camera(shutter: 180)", "180 degrees are 0.5"),
        (
            "effects: Effects(depth_of_field: DepthOfField(f_stop: 2.8, focus_distance: 3))",
            "`ThinLens(aperture: 0.1, focus_distance: 3)`; its aperture is the diameter",
        ),
        ("effects: Effects(depth_of_field: DepthOfField)", "write ThinLens(aperture: 0.1, focus_distance: 5)"),
        ("effects: Effects(antialiasing: true)", "leave it out: edges are smooth without it"),
        ("render: Render(antialiasing: true)", "edges are smooth without it: leave it out"),
        ("render: Render(pixel_filter: \"box\")", "how samples become pixels is said by `effects"),
        ("image: \"out.png\"", "tracer render scene.ron -o out.png"),
        ("animation: Animation(start: 0, end: 2)", "2 seconds with 24 frames in each are `frames: 48`"),
        ("animation: Animation(end: 250, fps: 25)", "if these are frames, write `frames: 251`"),
        ("animation: Animation(start: 1, end: 9, frames: 9)", "which are rendered is said on the command line"),
    ];
    check(&cases, Syntax::Ron, top);
}

/// What is sure of these is mended, and what is not stays.
#[test]
fn lists_and_copies_are_mended() {
    for (written, right) in [
        (
            "Sphere(radius: 1, placements: [Ring(count: 6, radius: 2)])",
            "Sphere(radius: 1, placements: Ring(count: 6, radius: 2))",
        ),
        (
            "Cone(from: (0, 0, 0), to: (0, 1, 0), r1: 1, r2: 0.5)",
            "Cone(from: (0, 0, 0), to: (0, 1, 0), radius: 1, tip_radius: 0.5)",
        ),
        (
            "Repeat(over: [1, 2], as: \"r\", items: [Sphere(radius: \"=r\")])",
            "Repeat(count: 2, vars: { \"r\": Pick(from: [1, 2], index: \"=i\") }, items: [Sphere(radius: \"=r\")])",
        ),
        (
            "Difference(objects: [Group(objects: [Box()]), Box()])",
            "Difference(objects: [Union(objects: [Box()]), Box()])",
        ),
        ("Difference(Box(), Box(), material: Mirror())", "Difference(objects: [Box(), Box()], material: Mirror())"),
        ("Box(corner: (0, 0, 0), size: 1)", "Box(center: (0.5, 0.5, 0.5), size: 1)"),
    ] {
        assert_eq!(mend("scene", &of_object(written), Syntax::Ron, Path::new("")).text, of_object(right));
    }
    for written in [
        "Sphere(radius: 1, placements: [Grid(count: (2, 1, 2)), Ring(count: 6, radius: 2)])",
        "Repeat(over: [1, 2], items: [Box()])",
        "Difference(objects: [Group(objects: [Box()], transform: [Scale(2)]), Box()])",
        // A comment would swallow the bracket.
        "Difference(Box(), // a wall\n Box(), material: Mirror())",
    ] {
        let written = of_object(written);
        assert_eq!(mend("scene", &written, Syntax::Ron, Path::new("")).text, written);
    }
}

/// What stands in the new hints can be read.
#[test]
fn scenes_of_hints_can_be_read() {
    for object in [
        "Lathe(profile: [(0, 0), (0.9, 0), (1, 0.1), (1, 1.9), (0.9, 2), (0, 2)])",
        "Arrow(from: (0.5, 0, 0), to: (0, 0, 0), radius: 0.01)",
        "Box(material: Emissive(radiance: 0.2, color: (1, 0.8, 0.6)))",
        "Box(material: Emissive(radiance: 1, color: (0.8, 0.2, 0.1)))",
        "Sphere(radius: 1, center: \"=keyframes(time, 0, (0, 0, 0), 1, (1, 0, 0))\")",
        "Repeat(count: 5, items: [Box(size: (1, \"=max(4-i, 0.001)\", 1))])",
        "Repeat(count: 2, vars: { \"v\": Pick(from: [1, 2], index: \"=i\") }, items: [Box(size: \"=v\")])",
    ] {
        assert_eq!(errors(&of_object(object), Syntax::Ron), [], "{object}");
    }
    for word in ["text", "label", "labels", "letters", "caption", "annotation"] {
        let told = explain_word(word).unwrap_or_default();
        assert!(told.contains("marks") && told.contains("Extrude of their outlines"), "{word}: {told}");
    }
    assert!(explain_word("shadow catcher").is_some_and(|told| told.contains("there is no shadow catcher")));
}
