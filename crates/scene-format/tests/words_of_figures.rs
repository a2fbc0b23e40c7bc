//! Words of programs that draw figures of data: what is offered for them is right when it is pasted.

use scene_format::render::apply_edits;
use scene_format::{Diagnostic, LoadError, Severity, Syntax, load_str, mend};
use std::path::Path;

fn told(text: &str, syntax: Syntax, severity: Severity) -> Vec<Diagnostic> {
    let all = match load_str("scene", text, syntax, Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => diagnostics,
        Ok(loaded) => loaded.warnings,
        Err(error) => panic!("{error}"),
    };
    all.into_iter().filter(|fault| fault.severity == severity).collect()
}

fn errors(text: &str, syntax: Syntax) -> Vec<Diagnostic> {
    told(text, syntax, Severity::Error)
}

fn scene(object: &str) -> String {
    format!("Scene(background: 1, objects: [{object}])")
}

fn of_material(material: &str) -> String {
    scene(&format!("Sphere(radius: 1, material: {material})"))
}

/// Each is told once, and mended to the other.
fn check_mended(cases: &[(&str, &str)], around: impl Fn(&str) -> String) {
    for (written, right) in cases {
        let text = around(written);
        let found = errors(&text, Syntax::Ron);
        let [only] = found.as_slice() else { panic!("{written}: {found:#?}") };
        let edit = only.edit.clone().unwrap_or_else(|| panic!("no edit: {only:#?}"));
        assert_eq!(apply_edits(&text, &[edit]), around(right));
        assert_eq!(mend("scene", &text, Syntax::Ron, Path::new("")).text, around(right));
        assert_eq!(errors(&around(right), Syntax::Ron), []);
    }
}

/// Each is told once, without an edit, with these words, and the code that they end with is right where it is put.
fn check_hinted(cases: &[(&str, &str)], around: impl Fn(&str) -> String) {
    let mut wrong = Vec::new();
    for (written, way) in cases {
        let found = errors(&around(written), Syntax::Ron);
        let good = matches!(found.as_slice(), [only] if only.edit.is_none() && only.hint.contains(way));
        if !good {
            let told: Vec<(&str, &str)> = found.iter().map(|fault| (&*fault.message, &*fault.hint)).collect();
            wrong.push(format!("{written}, not {way}: {told:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// What a hint has within these words.
fn between<'h>(hint: &'h str, start: &str, end: &str) -> &'h str {
    let from = hint.find(start).unwrap_or_else(|| panic!("no {start} in {hint}"));
    &hint[from..from + hint[from..].find(end).unwrap_or_else(|| panic!("no {end} in {hint}")) + end.len()]
}

fn hint_of(text: &str) -> String {
    let found = errors(text, Syntax::Ron);
    let [only] = found.as_slice() else { panic!("{text}: {found:#?}") };
    only.hint.clone()
}

#[test]
fn heads_of_arrows() {
    let arrow = |fields: &str| scene(&format!("Arrow(to: (0, 0, 2), {fields})"));
    let cases = [
        ("radius: 0.1, head: 0.3", "write `head_length: 0.3` for how long its head is, `head_radius: 0.3`"),
        ("radius: 0.1, tip: \"=1/4\"", "`head_length: \"=1/4\"`"),
    ];
    check_hinted(&cases, arrow);
    let cases = [
        ("radius: 0.1, head_width: 0.3", "radius: 0.1, head_radius: 0.15"),
        ("radius: 0.1, tip_length: 0.3", "radius: 0.1, head_length: 0.3"),
        ("radius: 0.1, tip_radius: 0.3", "radius: 0.1, head_radius: 0.3"),
        ("shaft_radius: 0.1", "radius: 0.1"),
    ];
    check_mended(&cases, arrow);
    check_mended(&[("Arrow(head: (1, 1, 1), radius: 0.1)", "Arrow(to: (1, 1, 1), radius: 0.1)")], scene);
}

#[test]
fn heights_of_landscapes() {
    let cases = [
        ("HeightField(file: \"z.exr\", scale: (6, 1, 6))", "HeightField(file: \"z.exr\", size: (6, 1, 6))"),
        ("HeightField(heights: \"z.exr\", size: (1, 1, 1))", "HeightField(file: \"z.exr\", size: (1, 1, 1))"),
    ];
    check_mended(&cases, scene);
    let cases = [
        ("HeightField(file: \"z.exr\", scale: 6)", "`size: (6, 1, 6)`"),
        ("HeightField(heights: [[1, 2], [3, 4]], size: (1, 1, 1))", "an EXR or a grey PNG of 16 bits"),
        ("HeightField(function: \"sin(x)\", size: (1, 1, 1))", "an EXR or a grey PNG of 16 bits"),
        ("Surface(z: [[1, 2], [3, 4]])", "an EXR or a grey PNG of 16 bits"),
        ("SurfacePlot()", "an EXR or a grey PNG of 16 bits"),
    ];
    check_hinted(&cases, scene);
    // What is offered is right.
    let hint = hint_of(&scene("Surface(z: 1)"));
    for way in [between(&hint, "HeightField(", "))"), between(&hint, "Mesh(", "]])])")] {
        assert_eq!(errors(&scene(way), Syntax::Ron), [], "{way}");
        assert_eq!(told(&scene(way), Syntax::Ron, Severity::Warning), [], "{way}");
    }
}

#[test]
fn indices_of_glass_and_metal() {
    let cases = [
        ("Transparent(n: 1.5)", "Transparent(ior: 1.5)"),
        ("Conductor(n: 0.2, k: 3.4)", "Conductor(ior: 0.2, k: 3.4)"),
        ("Conductor(n: (0.2, 0.5, 1.4), k: (3, 2, 2))", "Conductor(ior: (0.2, 0.5, 1.4), k: (3, 2, 2))"),
        ("Conductor(ior: 0.2, extinction: 3.4)", "Conductor(ior: 0.2, k: 3.4)"),
    ];
    check_mended(&cases, of_material);
}

const VIRIDIS: &str = "[(at: 0, color: \"#440154\"), (at: 0.25, color: \"#3b528b\"), (at: 0.5, color: \"#21918c\"), \
                       (at: 0.75, color: \"#5ec962\"), (at: 1, color: \"#fde725\")]";

#[test]
fn maps_of_colors() {
    let ramp = |fields: &str| of_material(&format!("Diffuse(albedo: ColorRamp(input: Gradient(), {fields}))"));
    let three = "stops: [(at: 0, color: \"#440154\"), (at: 0.5, color: \"#21918c\"), (at: 1, color: \"#fde725\")]";
    let viridis = format!("stops: {VIRIDIS}");
    let cases = [
        ("colors: [\"#440154\", \"#21918c\", \"#fde725\"]", three),
        ("palette: [\"#440154\", \"#21918c\", \"#fde725\"]", three),
        ("stops: [\"#440154\", \"#21918c\", \"#fde725\"]", three),
        ("colors: [\"white\", rgb(255, 0, 0)]", "stops: [(at: 0, color: \"#ffffff\"), (at: 1, color: \"#ff0000\")]"),
        ("stops: [0.1, (0.5, 0, 0)]", "stops: [(at: 0, color: 0.1), (at: 1, color: (0.5, 0, 0))]"),
        ("colormap: \"viridis\"", &viridis),
        ("cmap: \"cm.Viridis\"", &viridis),
        ("stops: \"viridis\"", &viridis),
    ];
    check_mended(&cases, ramp);
    // Two numbers are a stop: at 0.1 a grey of 0.5.
    let pairs = ramp("stops: [(0.1, 0.5), (1, 0.2)]");
    let pairs = mend("scene", &pairs, Syntax::Ron, Path::new("")).text;
    assert_eq!(pairs, ramp("stops: [(at: 0.1, color: 0.5), (at: 1, color: 0.2)]"));

    let toml = "background = 1\nobjects = [{ Sphere = { radius = 1, material = { Diffuse = { albedo = { ColorRamp = { \
                input = { Gradient = {} }, colors = [\"#440154\", \"#fde725\"] } } } } } }]\n";
    let now = mend("scene", toml, Syntax::Toml, Path::new("")).text;
    assert!(now.contains("stops = [{ at = 0, color = \"#440154\" }, { at = 1, color"), "{now}");
    assert_eq!(errors(&now, Syntax::Toml), []);
}

#[test]
fn maps_of_colors_of_surfaces() {
    let ramp = format!("ColorRamp(input: Gradient(), stops: {VIRIDIS})");
    let cases = [
        ("Mesh(file: \"a.obj\", colormap: \"viridis\")", "here from one end"),
        ("Sphere(radius: 1, material: Diffuse(colormap: \"viridis\"))", &*ramp),
        ("Sphere(radius: 1, material: Diffuse(albedo: \"viridis\"))", &*ramp),
        ("Sphere(radius: 1, material: Diffuse(albedo: Noise(cmap: \"viridis\")))", "ColorRamp(input: Noise(), stops: "),
        ("Tube(points: [(0, 0, 0), (1, 0, 0)], radius: 0.1, material: Diffuse(), colors: [0, 1])", "colours belong"),
    ];
    check_hinted(&cases, scene);
    let tube = |fields: &str| scene(&format!("Tube(points: [(0, 0, 0), (1, 0, 0)], radius: 0.1, {fields})"));
    let right = "material: Diffuse(albedo: ColorRamp(input: Gradient(), stops: [(at: 0, color: \"#ff0000\"), (at: 1, \
                 color: \"#00ff00\")]))";
    check_mended(&[("colors: [\"#ff0000\", \"lime\"]", right)], tube);
    let offered = hint_of(&scene(cases[0].0));
    let material = between(&offered, "material: ", ")]))");
    assert_eq!(errors(&scene(&format!("Sphere(radius: 1, {})", material.trim_end_matches('`'))), Syntax::Ron), []);
}

/// The nearest here is right as it is offered: with values as they are written here.
#[test]
fn the_nearest_here_is_right() {
    let cases = [
        ("Plastic(color: \"gray30\")", "albedo: \"#4d4d4d\","),
        ("Phong(color: rgb(0.2,0.2,1), shininess: 50)", "albedo: (0.2, 0.2, 1), exponent: 50,"),
        ("Plastic(color: \"white\")", "albedo: \"#ffffff\","),
        ("Plastic(color: (208, 58, 43))", "albedo: \"#d03a2b\","),
        ("Plastic(color: rgb(51, 51, 255))", "albedo: \"#3333ff\","),
        ("Plastic(color: \"hsl(120, 100%, 50%)\")", "albedo: \"#00ff00\","),
    ];
    check_hinted(&cases, of_material);
    for (written, _) in cases {
        let hint = hint_of(&of_material(written));
        let way = between(&hint, "BlinnPhong(", "true)");
        assert_eq!(errors(&of_material(way), Syntax::Ron), [], "{way}");
    }
    let hint = hint_of(&scene("Prism(points: [(0, 0), (1, 0), (0, 1)], height: 2)"));
    assert_eq!(between(&hint, "Extrude(", "2)"), "Extrude(outline: [[(0, 0), (1, 0), (0, 1)]], depth: 2)");
    // A texture of the scene keeps its name.
    let named = "Scene(background: 1, textures: { \"white\": Noise() }, objects: [Sphere(radius: 1, material: \
                 Plastic(color: \"white\"))])";
    assert!(hint_of(named).contains("albedo: \"white\""));
    let lamp = |light: &str| format!("Scene(lights: [{light}], objects: [Box(size: 1)])");
    let hint = hint_of(&lamp("PointLight(position: (5, 8, 10), color: \"white\", intensity: 500)"));
    let way = between(&hint, "SphereLight(", "\")");
    assert_eq!(errors(&lamp(way), Syntax::Ron), [], "{way}");
    check_mended(&[("Diffuse(albedo: \"gray30\")", "Diffuse(albedo: \"#4d4d4d\")")], of_material);
}

#[test]
fn cameras_of_parallel_rays() {
    let camera = |camera: &str| format!("Scene(background: 1, camera: Camera({camera}), objects: [Box(size: 1)])");
    let cases = [
        ("type: \"orthographic\", width: 8", "write `projection: Orthographic(height: 8)`"),
        ("height: 6, type: Orthographic", "write `projection: Orthographic(height: 6)`"),
        ("kind: \"ortho\"", "write `projection: Orthographic(height: 8)`"),
    ];
    check_hinted(&cases, camera);
    let json =
        "{\"background\": 1, \"camera\": {\"type\": \"orthographic\", \"width\": 8}, \"objects\": [{\"Box\": {}}]}";
    let found = errors(json, Syntax::Json);
    assert!(
        matches!(found.as_slice(), [only] if only.hint.contains("\"projection\": { \"Orthographic\": { ")),
        "{found:#?}"
    );
}

#[test]
fn radians_by_way_of_a_var_are_told() {
    let warned = |vars: &str, x: &str| {
        let ball = format!("Sphere(center: (\"={x}\", 0, 0), radius: 1)");
        let text = format!("Scene(background: 1, vars: {{ {vars} }}, objects: [{ball}])");
        let found = told(&text, Syntax::Ron, Severity::Warning);
        let found: Vec<Diagnostic> = found.into_iter().filter(|fault| fault.code.as_str() == "W0317").collect();
        found.first().map(|fault| fault.hint.clone())
    };
    let write = |call: &str| Some(format!("write `{call}`: a half turn is 180"));
    assert_eq!(warned("\"w\": \"=2*pi*0.3\"", "sin(w)"), write("sin(w*180/pi)"));
    assert_eq!(warned("\"w\": \"=2*pi\", \"a\": \"=3*w\"", "1 + cos(a + 1)"), write("cos((a + 1)*180/pi)"));
    assert_eq!(warned("\"w\": \"=2*pi*0.3\"", "sin(w*180/pi)"), None);
    assert_eq!(warned("\"w\": \"=180/pi\"", "sin(0.3*w)"), None);
    assert_eq!(warned("\"area\": \"=pi*3^2\"", "sqrt(area)"), None);
    // It is no angle itself.
    assert_eq!(warned("\"w\": \"=sin(2*pi*0.3)\"", "3*cos(w)"), write("sin(2*180*0.3)"));
    let within = "Scene(background: 1, objects: [Repeat(count: 3, vars: {\"w\": \"=pi*i\"}, items: [Sphere(center: \
                  (\"=sin(w)\", \"=i\", 0), radius: 0.1)])])";
    let found = told(within, Syntax::Ron, Severity::Warning);
    assert_eq!(found.iter().filter(|fault| fault.code.as_str() == "W0317").count(), 1, "{found:#?}");
}

#[test]
fn kinds_of_figures() {
    let cases = [
        ("Points(file: \"p.csv\")", "Sphere(radius: 0.05, placements: \"p.csv\")"),
        ("Spheres(file: \"p.csv\", radius: 0.1)", "Sphere(radius: 0.1, placements: \"p.csv\")"),
        ("Particles(file: \"p.ply\")", "Sphere(radius: 0.05, placements: \"points.csv\"); a line of the file"),
        ("Points()", "Sphere(radius: 0.05, placements: \"points.csv\"); a line of the file"),
        (
            "PointCloud(points: [(0, 0, 0), (1, 0, 0)], size: 0.2)",
            "Sphere(radius: 0.2, placements: [[Translate((0, 0, 0))], [Translate((1, 0, 0))]])",
        ),
        ("Axes()", "axes are Arrows: Arrow("),
        ("AxesHelper(size: 5)", "axes are Arrows: Arrow("),
        ("Molecule(file: \"caf.xyz\")", "bonds Cylinders"),
        ("Bond(from: (0, 0, 0), to: (1, 0, 0))", "bonds Cylinders"),
        ("Streamlines()", "Tube(points"),
        ("Colorbar()", "Rectangle(size: (0.2, 2)"),
        ("Contour()", "Lines(along: U"),
        ("Sphere(radius: 1, clip: 0.5)", "Difference(objects: [Sphere"),
        ("Mesh(file: \"a.obj\", clip_plane: 1)", "`camera: Camera(near: 4)`"),
    ];
    check_hinted(&cases, scene);
    let hint = hint_of(&scene("PointCloud(points: [(0, 0, 0), (1, 0, 0)], size: 0.2)"));
    assert_eq!(errors(&scene(between(&hint, "Sphere(", "]])")), Syntax::Ron), []);
    let cases = [
        ("ThinFilm(thickness: 500)", "Transparent(ior: 0.667)"),
        (
            "Material(color: (1, 0, 0), metallic: 1, roughness: 0.3)",
            "write Conductor(reflectance: (1, 0, 0), roughness: 0.3)",
        ),
        (
            "Material(color: \"red\", metallic: 0, roughness: 0.5)",
            "write BlinnPhong(albedo: \"#ff0000\", exponent: 32,",
        ),
        ("Material(color: \"red\")", "write Diffuse(albedo: \"#ff0000\")"),
    ];
    check_hinted(&cases, of_material);
    for (written, _) in &cases[1..] {
        let hint = hint_of(&of_material(written));
        assert_eq!(errors(&of_material(hint.trim_start_matches("write ")), Syntax::Ron), []);
    }
    check_hinted(&[("Laser()", "a slit")], |light| format!("Scene(lights: [{light}], objects: [Box(size: 1)])"));
    let json = "{\"background\": 1, \"objects\": [{\"Points\": {\"file\": \"p.csv\"}}]}";
    let found = errors(json, Syntax::Json);
    let way = "{ \"Sphere\": { \"radius\": 0.05, \"placements\": \"p.csv\" } }";
    assert!(matches!(found.as_slice(), [only] if only.hint.contains(way)), "{found:#?}");
}

/// What is said of words of every day is right where it is put.
#[test]
fn words_that_are_asked_for() {
    let explain = |word: &str| scene_format::explain_word(word).unwrap_or_else(|| panic!("{word}"));
    let check = |text: &str| assert_eq!(errors(text, Syntax::Ron), [], "{text}");
    let contour = explain("contour lines");
    check(&scene(&format!("Box(size: 1, {})", between(&contour, "material: ", "))))"))));
    for word in ["viridis", "colormap", "cmap"] {
        check(&of_material(&format!("Diffuse(albedo: {})", between(&explain(word), "ColorRamp(", "\")])"))));
    }
    for word in ["axes", "coordinate system"] {
        check(&scene(between(&explain(word), "Arrow(", "#2b5fd0\"))")));
    }
    for word in ["atom", "atoms", "molecule", "bonds"] {
        let text = explain(word);
        let (vars, rest) = (between(&text, "vars: {", "] }"), between(&text, "Repeat(", "0.1)])"));
        check(&format!("Scene(background: 1, {vars}, objects: [{rest}])"));
    }
    check(&scene(between(&explain("colorbar"), "Rectangle(", "])))")));
    check(&scene(between(&explain("streamlines"), "Tube(", "CatmullRom)")));
    // Each of several words is asked for by itself.
    assert_eq!(scene_format::explain_word("Lines Gradient.mapping"), None);
    assert!(explain("Gradient.mapping").starts_with("mapping of Gradient"));
}

#[test]
fn what_is_no_scene_is_told() {
    for text in ["24\ncaffeine\nH 0 0 0\n", "o Cube\nv 0 0 0\n", "1.5 2 3\n"] {
        let found = errors(text, Syntax::Ron);
        let good = matches!(found.as_slice(), [only] if only.message.starts_with("this is no scene: it begins with "));
        assert!(good, "{text}: {found:#?}");
    }
}
