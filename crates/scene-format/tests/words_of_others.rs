//! Words of other programs: each gets one error, whose hint says what the language has for it, or that it has none.

use scene_format::{Diagnostic, LoadError, Severity, Syntax, load_str};
use std::path::Path;

fn errors(text: &str) -> Vec<Diagnostic> {
    match load_str("scene", text, Syntax::Ron, Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            diagnostics.into_iter().filter(|fault| fault.severity == Severity::Error).collect()
        }
        _ => Vec::new(),
    }
}

/// A scene with something in one place.
fn scene(top: &str, camera: &str, object: &str) -> String {
    format!(
        "Scene({top} background: 1, camera: Camera({camera}), objects: [Sphere(center: (0, 0, 0), radius: 1), \
         {object}])"
    )
}

fn check(cases: &[(&str, &str)], scene: impl Fn(&str) -> String) {
    let mut wrong = Vec::new();
    for (written, told) in cases {
        let errors = errors(&scene(written));
        let hints: Vec<&str> = errors.iter().map(|fault| &*fault.hint).collect();
        if errors.len() != 1 || !hints[0].contains(told) {
            let messages: Vec<&str> = errors.iter().map(|fault| &*fault.message).collect();
            wrong.push(format!("{written}: {messages:?}, hints {hints:?}, not {told:?}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), cases.len(), wrong.join("\n"));
}

#[test]
fn kinds_of_objects() {
    let cases = [
        ("AreaLight(size: 1)", "Emissive(radiance: 5)"),
        ("Pyramid(radius: 1)", "Mesh(points: ["),
        ("Prism(height: 1)", "Extrude(outline: [["),
        ("Cone(from: (0, 0, 0), to: (0, 1, 0), radius: 1, to_radius: 0.5)", "`tip_radius`"),
        ("Cone(from: (0, 0, 0), to: (0, 1, 0), from_radius: 1, tip_radius: 0.5)", "`radius`"),
        ("Lens(r1: 0.5, r2: 0.5)", "Intersection(objects: [Sphere("),
        ("ParaboloidMirror(focal_length: 1)", "`Lathe`"),
        ("Function(z: 1)", "HeightField(file"),
        ("Metaball(balls: [])", "`Mesh`"),
        ("Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 1, open: true)", "`caps: false`"),
        ("Box(size: \"50 cm\")", "scene's own unit"),
        ("Box(size: 1, transform: [Rotate(axis: (0, 1, 0), degrees: \"30°\")])", "write 30: angles are in degrees"),
        ("Box(size: \"1,5\")", "write 1.5"),
        ("Box(size: 1, material: Transparent(ior: 1.5, dispersion: 0.02))", "no wavelengths"),
        ("Box(size: 1, material: Diffuse(albedo: 0.5, rough: 0.2))", "`exponent` of BlinnPhong"),
        ("Ellipsoid(radius: 1)", "`transform: [Scale((1, 2, 1))]`"),
        ("Collection(objects: [])", "did you mean `Group`?"),
        ("Instance(of: 1)", "`placements`"),
        ("Boolean(a: 1)", "Difference(objects: [..])"),
        ("Merge(objects: [Box(size: 1)])", "did you mean `Union`?"),
        ("Plane(y: 0)", "`point: (0, 0, 0)`"),
        ("Plane(size: 20)", "`Rectangle`, with a `size`"),
        ("Ground(normal: (0, 1, 0))", "did you mean `Plane`?"),
        ("Plane(position: (0, 1, 0))", "did you mean `point`?"),
        ("PointLight(radius: 1)", "`lights`"),
        ("Box(size: 1, id: 1)", "has a `name`"),
        ("Box(size: 1, visible: false)", "leave the object out"),
        ("Box(size: 1, hide: true)", "`camera_visible: false`"),
        ("Box(size: 1, no_image: true)", "`camera_visible: false`"),
        ("Box(size: 1, primary_visibility: false)", "did you mean `camera_visible`?"),
        ("Box(size: 1, no_shadow: true)", "all throws shadows"),
        ("Box(size: 1, emission: 3)", "Emissive(radiance: 5)"),
        ("Box(size: 1, transform: [Matrix([1, 0, 0])])", "write `rows: value`"),
        ("Box(size: 1, transform: [LookAt((0, 0, 0))])", "Align(from: (0, 0, 1), to: (1, 0, 0))"),
        ("Box(size: 1, transform: [Shear(1)])", "a `Matrix` may shear"),
        ("Box(size: 1, transform: [Orient((0, 0, 1))])", "the nearest here is `Align(to: ..)`"),
        ("Box(size: 1, transform: [Resize((1, 2, 3))])", "the nearest here is `FitTo(size: ..)`"),
        ("Box(size: 1, transform: [Recenter((1, 2, 3))])", "write CenterTo((1, 2, 3))"),
        ("Box(size: 1, transform: [GeometryToOrigin()])", "CenterTo((0, 0, 0))"),
        ("Box(size: 1, transform: [Centre(1, 2, 3)])", "write CenterTo((1, 2, 3))"),
        ("Box(size: 1, transform: [CenterTo(1, 2, 3)])", "write CenterTo((1, 2, 3))"),
        ("Box(size: 1, transform: [CenterTo(x: 1, y: 2, z: 3)])", "write CenterTo((1, 2, 3))"),
        ("Box(size: 1, transform: [CenterTo(position: (1, 2, 3))])", "did you mean `point`?"),
        ("Box(size: 1, transform: [Center])", "CenterTo(point: ..)"),
        ("Box(size: 1, transform: [Center()])", "CenterTo((0, 0, 0))"),
        ("Mesh(file: \"a.obj\", center: true)", "`transform: [CenterTo((0, 0, 0))]`"),
        ("Mesh(file: \"a.obj\", recenter: true)", "`transform: [CenterTo((0, 0, 0))]`"),
        ("Box(size: 1, transform: [FitTo(2)])", "write `FitTo(height: 2)`, or `width`, `depth` or `size` as"),
        ("Box(size: 1, transform: [Scale(2, 3)])", "three factors stand in brackets: `Scale((2, 3, 1))`"),
        ("Box(size: 1, transform: [FitTo(height: 2, width: 1)])", "remove all but one"),
        ("Box(size: 1, transform: [FitTo(about: (0, 0, 0))])", "add `height: ..`"),
        ("Box(size: 1, matrix: 1)", "`transform: [Matrix(rows: "),
    ];
    check(&cases, |object| scene("", "", object));
}

/// Matrices of other programs, each told once, and mended where it is certain.
#[test]
fn matrices() {
    let ours = "((2, 0, 0, 5), (0, 0, -1, 6), (0, 1, 0, 7))";
    let cases = [
        // Blender and Mitsuba: a fourth row.
        ("Matrix(rows: ((2, 0, 0, 5), (0, 0, -1, 6), (0, 1, 0, 7), (0, 0, 0, 1)))", "write ((2, 0, 0, 5), "),
        ("Matrix((2, 0, 0, 5), (0, 0, -1, 6), (0, 1, 0, 7), (0, 0, 0, 1))", "write Matrix(rows: ((2, 0, 0, 5), "),
        ("Matrix(rows: (2, 0, 0, 5, 0, 0, -1, 6, 0, 1, 0, 7, 0, 0, 0, 1))", "write ((2, 0, 0, 5), "),
        // glTF and pbrt: columns.
        ("Matrix(rows: (2, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 5, 6, 7, 1))", "write ((2, 0, 0, 5), "),
        ("matrix(2, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 5, 6, 7, 1)", "write Matrix(rows: ((2, 0, 0, 5), "),
        ("Matrix(rows: ((2, 0, 0), (0, 0, 1), (0, -1, 0), (5, 6, 7)))", "write ((2, 0, 0, 5), "),
        ("Matrix([(2, 0, 0, 5), (0, 0, -1, 6), (0, 1, 0, 7)])", "write Matrix(rows: [(2, 0, 0, 5), "),
        ("Matrix(((2, 0, 0), (0, 0, -1), (0, 1, 0)))", "write Matrix(rows: ((2, 0, 0, 0), "),
        // Rows or columns: nobody knows.
        ("Matrix(rows: (2, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1))", "glTF and pbrt list them by columns"),
        ("Matrix(rows: (2, 0, 0, 0, 0, 1, 0, -1, 0, 5, 6, 7))", "POV-Ray lists them by columns"),
        ("to_world(matrix: 1)", "the nearest here is `Matrix(rows: ..)`; its rows are these, and a fourth"),
        ("ConcatTransform([1, 0])", "`Matrix(rows: ..)`; pbrt lists columns"),
    ];
    check(&cases, |step| scene("", "", &format!("Box(size: 1, transform: [{step}])")));
    for (written, _) in &cases[..8] {
        let text = scene("", "", &format!("Box(size: 1, transform: [{written}])"));
        let edit = errors(&text)[0].edit.clone().expect("an edit");
        let mended =
            format!("{}{}{}", &text[..edit.span.start as usize], edit.replacement, &text[edit.span.end as usize..]);
        assert!(errors(&mended).is_empty(), "{mended}");
        let turned = ours.replace("), (", ") (");
        let same = mended.replace(['[', ']'], "(").replace("), (", ") (").contains(&turned[1..turned.len() - 9]);
        assert!(same || written.contains("(0, 1, 0)))"), "{mended}");
    }
    let wrong = [
        ("((1, 0, 0, 0), (0, 1, 0, 0), (1, 1, 0, 0))", "E0540", "it leaves nothing along one axis"),
        ("((1, 2, 3, 0), (4, 5, 6, 0), (7, 8, 9, 0))", "E0540", "flattens everything"),
        ("((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, inf, 0))", "E0304", "the third number of a row of the matrix"),
        ("((1, 0, 0, 0), (0, 1, 0), (0, 0, 1, 0))", "E0206", "a row of the matrix has four numbers, not 3"),
        ("((1, 0, 0, 0), (0, 1, 0, 0), 3)", "E0203", "a row of the matrix cannot be"),
        ("\"=1\"", "E0203", "the rows of a matrix cannot be"),
        ("((1, 0, 0, 0), (0, 1, 0, 0))", "E0206", "three rows of four numbers, not 2 rows of 4"),
    ];
    for (rows, code, message) in wrong {
        let errors = errors(&scene("", "", &format!("Box(size: 1, transform: [Matrix(rows: {rows})])")));
        let told: Vec<_> = errors.iter().map(|fault| (fault.code.as_str(), &*fault.message)).collect();
        assert!(matches!(told[..], [(c, m)] if c == code && m.contains(message)), "{rows}: {told:?}");
    }
}

#[test]
fn kinds_of_materials_and_textures() {
    let cases = [
        ("Translucent()", "no such material"),
        ("Principled(roughness: 0.2)", "BlinnPhong("),
        ("RoughConductor(alpha: 0.1)", "`Conductor(reflectance: ..)`"),
        ("Glass(roughness: 0.1)", "`Transparent(ior: ..)`"),
        ("FrostedGlass()", "smooth"),
        ("Mix(materials: [1])", "cannot be mixed"),
        ("Mix(a: 1)", "write Diffuse(albedo: Mix(a: 1))"),
        ("Diffuse(bump: 1)", "no bumps"),
        ("Diffuse(roughness: 1)", "`exponent` of BlinnPhong"),
        ("Diffuse(albedo: Perlin())", "write Noise(kind: Perlin)"),
        ("Diffuse(albedo: Turbulence())", "write Noise(kind: Turbulence)"),
        ("Diffuse(albedo: Checker())", "did you mean `Checkerboard`?"),
        ("Diffuse(albedo: Bricks(a: 1))", "bricks are Lines over a colour"),
        ("Diffuse(albedo: Worley())", "did you mean `Voronoi`?"),
        ("Diffuse(albedo: Crackle())", "did you mean `Voronoi`?"),
        ("Diffuse(albedo: Granite())", "did you mean `Noise`?"),
        ("Diffuse(albedo: Agate())", "did you mean `Marble`?"),
        ("Diffuse(albedo: Wave())", "Marble(..) in planes"),
        ("Diffuse(albedo: ValToRgb(input: 1))", "the nearest here is `ColorRamp(input: 1, stops: ..)`"),
        ("Diffuse(albedo: MixRgb(a: 1))", "did you mean `Mix`?"),
        ("Diffuse(albedo: Math(a: 1))", "did you mean `Multiply`?"),
        ("Diffuse(albedo: Invert(a: 1))", "Mix(a: .., b: .., weight: ..)"),
        ("Diffuse(albedo: Attribute())", "did you mean `VertexColor`?"),
        ("Diffuse(albedo: mesh_attribute)", "write VertexColor()"),
        ("Diffuse(albedo: Vertex_Color())", "did you mean `VertexColor`?"),
        ("Diffuse(albedo: COLOR_0())", "did you mean `VertexColor`?"),
        ("Diffuse(albedo: Noise(a: Worley()))", "did you mean `Voronoi`?"),
        ("Diffuse(albedo: Mix(a: Perlin()))", "write Noise(kind: Perlin)"),
        ("Diffuse(albedo: Lines(mapping: Box()))", "did you mean `Triplanar`?"),
        ("Diffuse(albedo: Lines(mapping: Cylindrical()))", "Spherical(..), Triplanar(..)"),
        ("Diffuse(albedo: Noise(mapping: LatLong()))", "did you mean `Spherical`?"),
        ("Diffuse(albedo: Lines(mapping: Object()))", "lie on surfaces: Uv(..)"),
        ("Diffuse(albedo: Texture(file: \"a.png\", mapping: World()))", "lie on surfaces: Uv(..)"),
        ("Diffuse(albedo: Noise(mapping: Local()))", "did you mean `Object`?"),
        ("Diffuse(albedo: Grid())", "did you mean `Lines`?"),
    ];
    check(&cases, |material| scene("", "", &format!("Box(size: 1, material: {material})")));
}

#[test]
fn fields_of_patterns() {
    let cases = [
        ("Marble(scale: 4)", "write `mapping: Object(scale: 4)`: so many cells"),
        ("Wood(scale: (1, 2, 3))", "write `mapping: Object(scale: (1, 2, 3))`"),
        ("Checkerboard(scale: 8)", "write `mapping: Uv(scale: 8)`: so many along each side"),
        ("Texture(file: \"a.png\", scale: (2, 1))", "write `mapping: Uv(scale: (2, 1))`"),
        ("Wood(scale: 3, mapping: World())", "it belongs to its `mapping`: Object(scale: 3)"),
        ("Voronoi(size: 0.1)", "one over the size of a cell"),
        ("Noise(offset: (1, 2, 3))", "write `mapping: Object(offset: (1, 2, 3))`"),
        ("Wood(rotation: 90)", "its direction is `axis`: `axis: (1, 0, 0)`; or it turns with its object"),
        ("Noise(rotation: 90)", "a pattern turns with its object"),
        ("Lines(rotation: 45)", "write `mapping: Uv(rotation: 45)`"),
        ("Noise(type: Perlin)", "did you mean `kind`?"),
        ("Noise(detail: 3)", "did you mean `octaves`?"),
        ("Noise(roughness: 0.5)", "did you mean `gain`?"),
        ("Noise(turbulence: 1)", "`kind: Turbulence`"),
        ("Noise(contrast: 2)", "for more contrast"),
        ("Noise(seed: 2)", "another `offset`"),
        ("Marble(turbulence: 1)", "did you mean `distortion`?"),
        ("Marble(octaves: 3)", "how far it bends is `distortion`"),
        ("Noise(color_map: [1])", "ColorRamp(input: Noise(..), stops: [(at: 0"),
        ("Wood(ramp: 1)", "ColorRamp(input: Noise(..), stops: [(at: 0"),
        ("Mix(factor: 1)", "did you mean `weight`?"),
        ("ColorRamp(input: Noise(), stops: [(at: 0, color: 0), (at: 1, color: 1)], mapping: 1)", "its `input` has a"),
        ("Mix(mapping: 1)", "what it is made of has a `mapping`"),
        ("Multiply(scale: 2)", "what it is made of has a `mapping`"),
        ("ColorRamp(input: Noise(), color_map: [(at: 0, color: 0), (at: 1, color: 1)])", "did you mean `stops`?"),
        ("ColorRamp(fac: Noise(), stops: [(at: 0, color: 0), (at: 1, color: 1)])", "did you mean `input`?"),
        ("ColorRamp(input: Noise(), stops: [(0, 0.1), (at: 1, color: 1)])", "write `(at: 0, color: 0.1)`"),
        ("Dots(color: 1)", "two colours: `a` and `b`"),
        ("Wood(color1: (1, 0, 0))", "did you mean `a`?"),
        ("Wood(color2: (1, 0, 0))", "did you mean `b`?"),
        ("Voronoi(randomness: 1)", "did you mean `jitter`?"),
        ("Noise(kind: \"perlin\")", "write Perlin"),
        ("Noise(mapping: Object(10))", "write `Object(scale: 10)`"),
        ("Lines(mapping: Uv((2, 3)))", "write `Uv(scale: (2, 3))`"),
        ("\"wood\"", "write Wood()"),
        ("Noise(mapping: 10)", "write Object(scale: 10): so many cells along a unit of length"),
        ("Noise(mapping: (1, 2, 3))", "write Object(scale: (1, 2, 3))"),
        ("Lines(mapping: 10)", "write Uv(scale: 10): so many along each side"),
        ("wood", "write Wood()"),
        ("perlin", "write Noise(kind: Perlin)"),
        ("ramp", "write Gradient()"),
        ("image", "write Texture(file: \"picture.png\")"),
        ("color_map", "write ColorRamp(input: Noise(), stops: [..])"),
    ];
    check(&cases, |albedo| scene("", "", &format!("Box(size: 1, material: Diffuse(albedo: {albedo}))")));
    let told = |albedo: &str| {
        let errors = errors(&scene("", "", &format!("Box(size: 1, material: Diffuse(albedo: {albedo}))")));
        errors.first().map(|fault| fault.message.clone()).unwrap_or_default()
    };
    assert_eq!(told("Voronoi(x: 1)"), "a pattern of cells has no field `x`");
    assert_eq!(told("Noise(kind: Waves)"), "`Waves` is not a kind of noise");
    let stops = |stops: &str| told(&format!("ColorRamp(input: Noise(), stops: [{stops}])"));
    assert_eq!(stops(""), "a ramp of colours has 0 stops");
    assert_eq!(stops("(at: 0.5, color: 1)"), "a ramp of colours has 1 stops");
    assert_eq!(stops(&"(at: 0.5, color: 1), ".repeat(64)), "");
    assert_eq!(stops(&"(at: 0.5, color: 1), ".repeat(65)), "a ramp of colours has 65 stops");
    assert_eq!(stops("(at: 0.5, color: 1), (at: 0.4, color: 1)"), "the stop at 0.4 comes after that at 0.5");
    assert_eq!(stops("(at: 1.5, color: 1), (at: 1, color: 1)"), "the at of a stop must be at most 1");
    assert_eq!(told("Mix(a: Noise(b: 1.5))"), "the b of noise must be at most 1");
    let nested = |depth: usize| told(&format!("{}0.5{}", "Multiply(a: ".repeat(depth), ")".repeat(depth)));
    assert_eq!((&*nested(16), &*nested(17)), ("", "textures stand more than 16 deep"));
    let wide = |parts: usize| {
        let one =
            |k: usize| format!("ColorRamp(input: Noise(), stops: [(at: 0, color: 0), (at: 1, color: {})])", k % 2);
        let mut all: Vec<String> = (0..parts).map(one).collect();
        while all.len() > 1 {
            all = all.chunks(2).map(|pair| format!("Multiply(a: {}, b: {})", pair[0], pair[1])).collect();
        }
        told(&all[0])
    };
    // Each ramp is two textures, and there are as many products but one.
    assert_eq!((&*wide(256), &*wide(512)), ("", "a texture is made of more than 1024 others"));
}

#[test]
fn fields_of_shapes() {
    let outline = "outline: [[(0, 0), (1, 0), (0, 1)]]";
    let tube = |curve: &str| {
        format!("Tube(points: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (2, 1, 0)], radius: 0.1, curve: {curve})")
    };
    let cases = [
        (format!("Extrude({outline}, height: 1)"), "did you mean `depth`?"),
        (format!("Extrude({outline}, depth: 1, holes: [1])"), "holes are rings of the `outline`"),
        (format!("Extrude({outline}, depth: 1, bevel: 0.1)"), "only a `Box` has round ones"),
        ("Box(size: 1, bevel: 0.1)".to_owned(), "its `rounding`"),
        ("Box(size: 1, roundness: 0.1)".to_owned(), "rounding"),
        (format!("Extrude({outline}, depth: 1, bezier: true)"), "its `curve`"),
        ("Extrude(points: [(0, 0), (1, 0), (0, 1)], depth: 1)".to_owned(), "outline: [[(0, 0)"),
        ("Extrude(points: [[(0, 0), (1, 0), (0, 1)]], depth: 1)".to_owned(), "did you mean `outline`?"),
        ("Lathe(points: [(0, 0), (1, 1)])".to_owned(), "did you mean `profile`?"),
        ("Lathe(profile: [(0, 0), (1, 1)], height: 1)".to_owned(), "its `profile`"),
        ("Lathe(profile: [(0, 0), (1, 1)], angle: 180)".to_owned(), "all the way round"),
        ("Lathe(profile: [(0, 0), (1, 1)], spline: 1)".to_owned(), "its `curve`"),
        ("Lathe(profile: [(0, 0), (1, 1)], curve: cubic_spline)".to_owned(), "did you mean `CatmullRom`?"),
        ("Lathe(profile: [(0, 0), (1, 1)], curve: linear_spline)".to_owned(), "did you mean `Linear`?"),
        ("Lathe(profile: [(0, 0), (1, 1)], curve: Bezier)".to_owned(), "no control points"),
        ("Mesh(file: \"a.obj\", submesh: \"wheel\")".to_owned(), "did you mean `part`?"),
        (tube("bezier_spline"), "did you mean `Bezier`?"),
        (tube("cubic_spline"), "did you mean `CatmullRom`?"),
        (tube("linear_spline"), "did you mean `Linear`?"),
        (tube("b_spline"), "or make it `Bezier`"),
        (tube("hermite"), "a third of the tangents"),
        (tube("Linear, bezier: true"), "its `curve`"),
        (tube("Bezier, handles: [(0, 0, 0)]"), "among the `points`"),
        ("Lathe(profile: [(0, 0), (1, 1)], curve: \"cubic_spline\")".to_owned(), "write CatmullRom"),
        ("Polygon(points: [(0, 0), (1, 0), (0, 1)])".to_owned(), ""),
        ("Lathe(profile: [(0, 0, 0), (1, 1, 0)])".to_owned(), ""),
        ("Extrude(outline: [[(0, 0, 0), (1, 0, 0), (0, 1, 0)]], depth: 1)".to_owned(), ""),
        ("Polygon(points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], holes: [1])".to_owned(), "Extrude(outline:"),
        ("Cylinder(radius: 1, height: 2)".to_owned(), "`from: (0, 0, 0), to: (0, 2, 0)`"),
        ("Box(width: 2)".to_owned(), "its `size`"),
        ("HeightField(file: \"a.png\", size: (1, 1, 1), height: 2)".to_owned(), "the second number of its `size`"),
        ("HeightField(file: \"a.png\", size: (1, 1, 1), water_level: 0.2)".to_owned(), "a `Rectangle` at its height"),
        ("HeightField(file: \"a.png\", size: (1, 1, 1), subdivisions: 2)".to_owned(), "its picture's pixels"),
        ("HeightMap(file: \"a.png\", size: (1, 1, 1))".to_owned(), "did you mean `HeightField`?"),
        ("Terrain(scale: 3)".to_owned(), "the nearest here is `HeightField(file: .., size: ..)`"),
        ("Sphere(center: (0, 0, 0), radius: 1, height: 2)".to_owned(), ""),
    ];
    let cases: Vec<(&str, &str)> = cases.iter().map(|(written, told)| (written.as_str(), *told)).collect();
    check(&cases, |object| scene("", "", object));
}

#[test]
fn shapes_in_braces() {
    let cases = [
        ("torus {}", "write Torus(radius: .., tube_radius: ..)"),
        ("torus { 1, 0.2 }", "write Torus(radius: .., tube_radius: ..)"),
        ("torus { major: 1, minor: 0.2, material: \"x\" }", "write Torus(radius: .., tube_radius: ..)"),
        ("sphere_sweep { linear_spline 2, <0, 0, 0>, 1, <1, 0, 0>, 1 }", "write Tube(points:"),
        ("height_field { png \"a.png\" smooth }", "write HeightField(file:"),
        ("isosurface { function { x } }", "Mesh(file: \"shape.obj\")"),
        ("prism { linear_spline 0, 1, 4, <0, 0>, <1, 0>, <0, 1>, <0, 0> }", "write Extrude(outline:"),
        ("prism {}", "write Extrude(outline:"),
        ("sor {}", "write Lathe(profile:"),
        ("lathe { profile: [(0, 0), (1, 1)] }", "write Lathe(profile:"),
        ("sphere { center: (0, 0, 0), radius: 1 }", "write Sphere(center:"),
    ];
    check(&cases, |object| scene("", "", object));
    // What there is is mended by one edit.
    let text = scene("", "", "sphere { center: (0, 2, 0), radius: 1 }");
    let edits: Vec<_> = errors(&text).into_iter().filter_map(|fault| fault.edit).collect();
    let [edit] = edits.as_slice() else { panic!("{edits:?}") };
    let mended =
        format!("{}{}{}", &text[..edit.span.start as usize], edit.replacement, &text[edit.span.end as usize..]);
    assert!(errors(&mended).is_empty(), "{mended}");
}

/// What newcomers wrote, each with a hint that leads to a scene in one step.
#[test]
fn first_tries() {
    let objects = [
        ("Box(size: 1, material: Diffuse(albedo: Texture(file: \"a.png\", mapping: Uv(repeat: 6))))", "`scale: 6`"),
        ("Repeat(count: 5, Box(size: 1))", "write `items: [Box(size: 1)]`"),
        ("Quad(corners: [(0, 0, 0), (1, 0, 0), (1, 1, 0)])", "Polygon(points: [(0, 0, 0), (1, 0, 0), (1, 1, 0)])"),
        ("Polygon(a: (0, 0, 0), b: (1, 0, 0), c: (1, 1, 0))", "write `points: [(0, 0, 0), (1, 0, 0), (1, 1, 0)]`"),
        ("Sphere(radii: (1, 2, 3))", "write `radius: 1, transform: [Scale((1, 2, 3))]`"),
        ("Sphere(center: (0, 1, 0), radii: (1, 2, 3))", "Scale(factor: (1, 2, 3), about: (0, 1, 0))"),
        ("Sphere(center: (0, 0, 0), radius: (1, 2, 3))", "`radius: 1, transform: [Scale(factor: (1, 2, 3), about:"),
        ("Sphere(center: (0, 1, -(3)), radius: 1)", "write \"=-(3)\""),
        ("Sphere(center: (0, 1, \"=sin(radians(30))\"), radius: 1)", "sin(30) is 0.5: leave it out"),
        ("Box(size: 1, material: Diffuse(0.5))", "write `Diffuse(albedo: 0.5)`"),
        ("Box(size: 1, material: Transparent(ior: (1.5, 1.52, 1.55)))", "no wavelengths: write one number, 1.52"),
    ];
    check(&objects, |object| scene("", "", object));
    let fields = [
        ("render: Render(caustics: false),", "write None"),
        ("output: Output(layers: Depth),", "write [Depth]"),
        ("render: 16,", "write Render(samples: 16)"),
        ("materials: [Diffuse(albedo: 0.5)],", "each has a name here, by which objects have it: { \"a\": Diffuse("),
        ("lights: [SphereLight(center: (0, 5, 0), radius: 0, power: 9)],", "a small sphere: radius: 0.1"),
        ("lights: [SphereLight(center: (0, 5, 0), radius: 1, power: 9, color: 3000K)],", "write \"=blackbody(3000)\""),
    ];
    check(&fields, |field| scene(field, "", ""));
}

#[test]
fn options_of_the_command_line() {
    let cases = [
        ("denoise: true", "tracer render scene.ron --denoise"),
        ("OIDN: true", "tracer render scene.ron --denoise oidn"),
        ("oidn: true", "tracer render scene.ron --denoise oidn"),
    ];
    check(&cases, |field| scene(&format!("render: Render({field}),"), "", ""));
    let text = scene("", "", "");
    for (set, told) in [
        ("render.denoise=true", "tracer render scene.ron --denoise"),
        ("denoise=true", "tracer render scene.ron --denoise"),
        ("render.threads=4", "tracer render scene.ron --threads 4"),
    ] {
        let sets = [scene_format::Override::from(set)];
        let Err(LoadError::Invalid { diagnostics, .. }) = load_str("scene", &text, Syntax::Ron, Path::new(""), &sets)
        else {
            panic!("{set} is none");
        };
        assert!(diagnostics.len() == 1 && diagnostics[0].hint.contains(told), "{set}: {diagnostics:?}");
    }
}

#[test]
fn kinds_of_lights() {
    let cases = [
        ("EnvironmentMap(file: 1)", "`Environment(file: \"sky.hdr\")`"),
        ("DirectionalLight(direction: (0, 1, 0))", "a sun is a sphere light far away"),
        ("SpotLight(position: (0, 1, 0))", "there is no spotlight"),
        ("AreaLight(size: 1)", "Emissive(radiance: 5)"),
        (
            "PointLight(position: (0, 5, 0), intensity: 3)",
            "`SphereLight(center: (0, 5, 0), radius: 0.1, intensity: 3)`",
        ),
        ("SphereLight(center: (0, 5, 0), radius: 1, tint: (1, 1, 1))", "per channel"),
        ("SphereLight(center: (0, 5, 0), radius: 1, lumens: 800)", "`luminous_power`"),
        ("SphereLight(center: (0, 5, 0), radius: 1, brightness: 3)", "`radiance`"),
    ];
    check(&cases, |light| scene(&format!("lights: [{light}],"), "", ""));
}

#[test]
fn fields_of_the_scene_and_of_the_camera() {
    let of_scene = [
        ("sky: 1,", "`background`"),
        ("emission: 1,", "Emissive(radiance: 5)"),
        ("vertices: 1,", "Mesh(file:"),
        ("bump: 1,", "no bumps"),
        ("roughness: 1,", "`exponent`"),
        ("resolution: 1,", "Image(width: 640, height: 480)"),
        ("name: 1,", "comment"),
    ];
    check(&of_scene, |field| scene(field, "", ""));
    let of_camera = [
        ("dof: 1", "ThinLens(aperture: 0.1, focus_distance: 5)"),
        ("lens: 50", "ThinLens(aperture: 0.1, focus_distance: 5)"),
        ("zoom: 2", "`focal_length` in millimetres"),
        ("ortho_scale: 8", "`projection: Orthographic(height: 8)`"),
        ("latlong: true", "`projection: Panorama`"),
        ("dome: true", "`projection: Fisheye(fov: 180)`"),
        ("stereo: Stereo(ipd: 0.064)", "did you mean `separation`?"),
        ("stereo: Stereo(separation: 0.064, convergence_distance: 2)", "did you mean `convergence`?"),
        ("stereo: Stereo(separation: 0.064, layout: OverUnder)", "did you mean `TopBottom`?"),
        ("far: 100", "leave it out"),
        ("direction: (0, 0, -1)", "`look_at`"),
    ];
    check(&of_camera, |field| scene("", field, ""));
    let of_motion = ["motion_blur: true", "shutter_open: 0", "shutter_close: 0.5", "shutter_angle: 180"];
    let of_motion = of_motion.map(|field| (field, "the camera's `shutter`, a share of a frame"));
    check(&of_motion, |field| scene("", field, ""));
    check(&of_motion, |field| scene(&format!("{field},"), "", ""));
}

#[test]
fn fields_of_patterns_in_toml_and_json() {
    let hints = |text: &str, syntax: Syntax| match load_str("scene", text, syntax, Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => diagnostics.into_iter().map(|fault| fault.hint).collect(),
        _ => Vec::new(),
    };
    let cases = [
        ("\"wood\"", "write { Wood = {} }", "write { \"Wood\": {} }"),
        (
            "{ Marble = { scale = 4 } }",
            "write `mapping = { Object = { scale = 4 } }`: so many cells along a unit of length",
            "write `\"mapping\": { \"Object\": { \"scale\": 4 } }`: so many cells along a unit of length",
        ),
        (
            "{ Noise = { mapping = 10 } }",
            "write { Object = { scale = 10 } }: so many cells along a unit of length",
            "write { \"Object\": { \"scale\": 10 } }: so many cells along a unit of length",
        ),
    ];
    for (albedo, in_toml, in_json) in cases {
        let toml =
            format!("background = 1\n[[objects]]\nBox = {{ material = {{ Diffuse = {{ albedo = {albedo} }} }} }}\n");
        assert_eq!(hints(&toml, Syntax::Toml), [in_toml], "{toml}");
        let mut albedo = albedo.to_owned();
        for name in ["Marble", "scale", "Noise", "mapping"] {
            albedo = albedo.replace(&format!("{name} = "), &format!("\"{name}\": "));
        }
        let json = format!(
            r#"{{ "background": 1,
                "objects": [{{ "Box": {{ "material": {{ "Diffuse": {{ "albedo": {albedo} }} }} }} }}] }}"#
        );
        assert_eq!(hints(&json, Syntax::Json), [in_json], "{json}");
    }
}

/// What hints tell to write is right.
#[test]
fn what_hints_tell_to_write_loads() {
    let objects = [
        "Rectangle(size: 20)",
        "Rectangle(size: 1, material: Emissive(radiance: 5))",
        "Box(size: 1, material: BlinnPhong(albedo: 0.5, exponent: 1000, specular: 1, energy_conserving: true))",
        "Box(size: 1, material: Transparent(ior: 1.5), transform: [Scale((-1, 1, 1)), Rotate(axis: (0, 1, 0), degrees: \
         90)])",
        "Repeat(count: 2, items: [Box(size: 1)])",
    ];
    for object in objects {
        assert!(errors(&scene("", "", object)).is_empty(), "{object}");
    }
    let top = "image: Image(width: 640, height: 480), effects: Effects(depth_of_field: ThinLens(aperture: 0.1, \
     focus_distance: 5)),";
    assert!(errors(&scene(top, "", "")).is_empty());
}

#[test]
fn what_is_written_beside_the_picture() {
    let cases = [
        ("layers: [CryptoObject]", "`cryptomatte: [Objects, Materials]`"),
        ("layers: [Mask]", "masks: [..]"),
        ("crypto: [Objects]", "did you mean `cryptomatte`?"),
        ("cryptomatte: [CryptoObject]", "did you mean `Objects`?"),
        ("cryptomatte: [Material]", "did you mean `Materials`?"),
        ("mask: [\"a\"]", "did you mean `masks`?"),
        ("aovs: [Depth]", "did you mean `layers`?"),
        ("labels: { \"A\": (0, 0, 0) }", "did you mean `marks`?"),
    ];
    check(&cases, |words| scene(&format!("output: Output({words}),"), "", ""));
}

#[test]
fn marks_are_points_with_names() {
    let faults = |words: &str| -> Vec<String> {
        let faults = errors(&scene(&format!("output: Output({words}),"), "", ""));
        faults.into_iter().map(|fault| format!("{} {}: {}", fault.code, fault.path, fault.message)).collect()
    };
    assert!(faults(r#"marks: { "A": (0, 1, 0), "B": ["=1+1", 0, 0] }"#).is_empty());
    assert!(faults("marks: {}").is_empty());
    assert_eq!(faults(r#"marks: { "A": 1 }"#).len(), 1);
    let twice = faults(r#"marks: { "A": (0, 1, 0), "A": (0, 2, 0) }"#);
    assert_eq!(twice, ["E0402 output.marks.A: the mark \"A\" is there twice"]);
    assert_eq!(faults(r#"marks: { " ": (0, 1, 0) }"#).len(), 1);
    assert_eq!(faults(r#"marks: [(0, 1, 0)]"#).len(), 1);
    // Masks are of what has the name; the nearest is offered.
    let masks = faults(r#"masks: ["nothing"]"#);
    assert_eq!(masks, ["E0410 output.masks[0]: no object has the name \"nothing\""]);
}

#[test]
fn what_newcomers_wrote() {
    let cases = [
        ("Box(from: (0, 0, 0), to: (1, 1, 1))", "center: (0.5, 0.5, 0.5)"),
        ("Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 1, inner_radius: 0.5)", "Difference"),
        ("Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 1, h: 1)", "from: (0, 0, 0)"),
        ("Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 1, height: 3)", "from: (0, 0, 0)"),
        ("Cylinder(from: (0, 0, 0), height: 3, radius: 1)", "write `from: (0, 0, 0), to: (0, 3, 0)`"),
        ("Cylinder(height: 3, from: (0, 0, 0), radius: 1)", "write `from: (0, 0, 0), to: (0, 3, 0)`"),
        ("Tube(points: [(0, 0, 0), (1, 0, 0)], radius: 0.1, start: (0, 0, 0))", "`points`"),
        ("Arrow(from: (0, 0, 0), to: (1, 0, 0), radius: 0.1, origin: (0, 0, 0))", "`from`"),
        ("Torus(radius: 1, tube_radius: 0.2, thickness: 0.2)", "tube_radius"),
        ("Translate((0, 1, 0))", "Group("),
        ("CenterTo((0, 1, 0))", "Group("),
        ("repeat(count: 2, items: [])", "Repeat(count"),
        ("Box(size: 1, material: Metal(preset: \"gold\", roughness: 0.2))", "Conductor(metal: Gold, roughness: 0.2)"),
        ("Box(size: 1, material: Metal(kind: Brass))", "Conductor(metal: Brass)"),
        ("Box(size: 1, material: Transparent(ior: 1.5, attenuation: 1))", "transmittance"),
        ("Box(size: 1, material: \"=if(1 > 0, 1, 2)\")", "Pick("),
        ("Box(size: \"=vec3(1, 2, 3)\")", "(1, 2, 3)"),
        ("Box(size: \"=range(3)\")", "Repeat("),
        ("Box(size: \"=0.1*i\")", "within it"),
    ];
    check(&cases, |object| scene("", "", object));
    let cases = [
        ("vars: { \"a\": 1, \"b\": \"a*2\", \"c\": \"=a + b\" },", "\"=a*2\""),
        ("vars: { \"a\": \"north\", \"c\": \"=a\" },", "an expression begins with `=`"),
        ("materials: { \"floor\": Diffuse() },", "write \"floor\""),
    ];
    let with = |top: &str| {
        let last = if top.contains("floor") { "Box(material: \"=floor\")" } else { "Box(size: \"=c\")" };
        scene(top, "", last)
    };
    check(&cases, with);
    let foreign = |text: &str| errors(text).first().map_or(String::new(), |fault| fault.message.clone());
    for openscad in ["translate([0, 0, 5]) cylinder(h=10, r1=2, r2=0);", "$fn = 50;\nsphere(2);", "difference() {\n}"] {
        assert!(foreign(openscad).contains("OpenSCAD"), "{openscad}: {}", foreign(openscad));
    }
}

#[test]
fn more_kinds_and_fields() {
    let cases = [
        ("Bevel(size: 1)", "rounding"),
        ("Instances()", "placements"),
        ("Empty()", "Group"),
        ("Line(from: (0, 0, 0), to: (1, 0, 0))", "Tube"),
        ("Tetrahedron()", "Mesh(points: [(1, 1, 1), (1, -1, -1), "),
        ("Octahedron(size: 1)", "faces: [[0, 2, 4], "),
        ("Icosahedron()", "scenes/cookbook/platonic_solids.ron"),
        ("Box(size: 1, material: AreaLightSource(radiance: 3))", "Emissive"),
        ("Box(size: 1, material: MixShader())", "Mix"),
        ("Box(size: 1, material: Clearcoat())", "BlinnPhong"),
        ("Box(size: 1, material: Pigment())", "albedo"),
        ("Box(size: 1, material: Transparent(ior: 1.5, attenuation_color: 1))", "transmittance"),
        ("Box(size: 1, material: Transparent(ior: 1.5, roughness: 0.1))", "smooth"),
        ("Box(size: 1, material: Transparent(ior: 1.5, priority: 1))", "leave it out"),
        ("Box(size: 1, material: Diffuse(albedo: Constant(value: 1)))", "by itself"),
        ("Box(size: 1, material: Diffuse(albedo: Volume()))", "Noise"),
        ("Box(size: 1, parent: \"a\")", "Group"),
        ("Box(size: 1, velocity: (1, 0, 0))", "time"),
        ("Box(size: 1, placements: Array(count: (3, 1, 1), spacing: (2, 1, 1)))", "Grid"),
    ];
    check(&cases, |object| scene("", "", object));
    let cases = [
        ("roll: 3", "`up`"),
        ("focal_point: (0, 0, 0)", "focus_on"),
        ("interocular: 0.06", "Stereo"),
        ("projection: Isometric(height: 3)", "Orthographic"),
    ];
    check(&cases, |camera| scene("", camera, "Sphere(center: (3, 0, 0), radius: 1)"));
    let cases = [("title: \"a\"", "comment"), ("driver: 1", "vars"), ("sky: 1", "Environment")];
    let with = |top: &str| {
        let background = if top.starts_with("sky") { "" } else { "background: 1, " };
        format!("Scene({top}, {background}objects: [Sphere(center: (0, 0, 0), radius: 1)])")
    };
    check(&cases, with);
}
