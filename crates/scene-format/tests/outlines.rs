//! Outlines that are told of before they are made into triangles.

mod common;

use common::{errors, load};
use scene_format::Syntax;
use std::time::Instant;

fn codes(objects: &str) -> Vec<String> {
    let text = format!("Scene(background: 1, objects: [{objects}])");
    match load(&text, Syntax::Ron) {
        Ok(loaded) => loaded.warnings.iter().map(|fault| fault.code.as_str().to_owned()).collect(),
        Err(_) => errors(&text, Syntax::Ron).iter().map(|fault| fault.code.as_str().to_owned()).collect(),
    }
}

/// What is right is left alone: corners that touch their neighbours, profiles that go along the axis, vases with a
/// waist.
#[test]
fn what_is_meant_is_not_told() {
    for object in [
        "Polygon(points: [(0, 0, 0), (1, 0, 0), (1, 0, 0), (1, 1, 0), (0, 0, 0)])",
        "Polygon(points: [(0, 0, 0), (4, 0, 0), (4, 4, 0), (2, 0.5, 0), (0, 4, 0)])",
        "Extrude(outline: [[(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (2, 1), (2, 3)]], depth: 1)",
        "Extrude(outline: [[(0, 0), (4, 0), (4, 4), (0, 4)]], depth: 1, curve: CatmullRom)",
        "Lathe(profile: [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)], material: Transparent(ior: 1.5))",
        "Lathe(profile: [(0, -1), (0.8, -0.9), (0.4, 0), (0.7, 1)], curve: CatmullRom)",
        "Lathe(profile: [(0.3, 0), (0.5, 0.5), (0.15, 1), (0.3, 1.3)], curve: CatmullRom)",
        "Lathe(profile: [(0, 0), (1, 1), (1, 0), (0, 1)])",
    ] {
        assert_eq!(codes(object), Vec::<String>::new(), "{object}");
    }
}

#[test]
fn what_bounds_no_face_is_told() {
    for (object, code) in [
        ("Polygon(points: [(0, 0, 0), (1, 1, 2), (2, 2, 4)])", "E0542"),
        ("Polygon(points: [(0, 0, 0), (0, 0, 0), (1, 0, 0)])", "E0542"),
        ("Polygon(points: [(0, 0, 0), (1, 0, 0), (1, 1, 0.1), (0, 1, 0)])", "E0545"),
        ("Polygon(points: [(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)])", "E0545"),
        ("Lathe(profile: [(1, 0), (1, 0)])", "E0542"),
        ("Lathe(profile: [(0, 0), (0, 1)])", "E0542"),
    ] {
        assert_eq!(codes(object), [code], "{object}");
    }
}

/// Whatever else is wrong, each at what is wrong, and the same as is told when a scene of code is compiled.
#[test]
fn faults_of_all_shapes_come_in_one_run() {
    let cases = [
        ("Torus(radius: 1, tube_radius: 2)", "E0303", "2", "`tube_radius` is 2"),
        ("Arrow(from: (1, 0, 0), to: (1, 0, 0), radius: 0.1)", "E0542", "(1, 0, 0)", "same point"),
        ("Arrow(radius: 0.1, head_length: 3)", "E0303", "3", "longer than it"),
        ("Arrow(radius: 0.2, head_radius: 0.1)", "E0303", "0.1", "thinner than its shaft"),
        ("Cylinder(to: (0, 0, 0), radius: 4)", "E0542", "(0, 0, 0)", "the cylinder has no length"),
        ("Cone(from: (0, 1, 0), radius: 5)", "E0542", "(0, 1, 0)", "the cone has no length"),
        ("Capsule(from: (2, 2, 2), to: (2, 2, 2), radius: 6)", "E0542", "(2, 2, 2)", "the capsule has no length"),
        ("Disk(radius: 1, inner_radius: 1)", "E0542", "1", "nothing of it is left"),
        ("Tube(points: [(3, 0, 0), (3, 0, 0)], radius: 7)", "E0542", "[(3, 0, 0), (3, 0, 0)]", "no extent"),
        ("Tube(points: [(0, 0, 0), (9, 0, 0)], radius: [1, 2, 3])", "E0206", "[1, 2, 3]", "2 points and 3 radii"),
        (
            "Tube(points: [(0, 0, 0), (5, 0, 0), (5, 1, 0)], radius: 1, curve: Bezier)",
            "E0206",
            "[(0, 0, 0), (5, 0, 0), (5, 1, 0)]",
            "ends within a span: it has 3 points",
        ),
        (
            "Tube(points: [(0, 0, 0), (8, 0, 0)], radius: 1, closed: true)",
            "E0542",
            "[(0, 0, 0), (8, 0, 0)]",
            "goes through two points only",
        ),
        (
            "Extrude(outline: [[(0, 0), (1, 1), (2, 2)]], depth: 1)",
            "E0542",
            "[[(0, 0), (1, 1), (2, 2)]]",
            "lies on one line",
        ),
        (
            "Extrude(outline: [[(0, 0), (4, 0), (0, 4)], [(5, 5), (6, 5), (5, 6)]], depth: 1)",
            "E0545",
            "[[(0, 0), (4, 0), (0, 4)], [(5, 5), (6, 5), (5, 6)]]",
            "hole 1 of the extrude is not within its outline",
        ),
        (
            "Extrude(outline: [[(0, 0), (9, 0), (0, 9)], [(1, 1), (5, 1), (1, 5)], [(2, 2), (3, 2), (2, 3)]], depth: \
             1)",
            "E0545",
            "[[(0, 0), (9, 0), (0, 9)], [(1, 1), (5, 1), (1, 5)], [(2, 2), (3, 2), (2, 3)]]",
            "hole 2 of the extrude is within another hole",
        ),
        (
            "Extrude(outline: [[(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)]], depth: 1)",
            "E0545",
            "[[(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)]]",
            "from (0, 0) to (4, 0) passes through another point",
        ),
        (
            "Extrude(outline: [[(0, 0), (4, 0), (0, 4)], [(0, 0), (1, 0.5), (0.5, 1)]], depth: 1)",
            "E0545",
            "[[(0, 0), (4, 0), (0, 4)], [(0, 0), (1, 0.5), (0.5, 1)]]",
            "hole 1 of the extrude touches the outline of the extrude at (0, 0)",
        ),
    ];
    let objects: Vec<&str> = cases.iter().map(|(object, ..)| *object).collect();
    let text = format!(
        "Scene(background: 1, colour: 1, materials: {{ \"lamp\": Emissive(power: 3) }}, objects: [Torus(), {}])",
        objects.join(",\n")
    );
    let errors = errors(&text, Syntax::Ron);
    let told: Vec<_> = errors.iter().map(|fault| fault.code.as_str()).collect();
    assert_eq!(told[..3], ["E0201", "E0202", "E0202"], "{errors:?}");
    assert_eq!(errors.len(), 3 + cases.len(), "{errors:?}");
    for (fault, (object, code, at, message)) in errors[3..].iter().zip(cases) {
        let place = &text[fault.span.start as usize..fault.span.end as usize];
        assert_eq!((fault.code.as_str(), place), (code, at), "{object}: {fault:?}");
        assert!(fault.message.contains(message), "{object}: {}", fault.message);
    }
}

/// Brackets of the wrong kind are one mistake, whatever is missing in them.
#[test]
fn wrong_brackets_are_one_mistake() {
    for object in ["Torus{radius: 1}", "Torus{}", "Sphere[radius: 1]", "Torus{radius: 1, tube_radius: 0.5}"] {
        assert_eq!(codes(object), ["E0203"], "{object}");
    }
    assert_eq!(codes("Torus(radius: 1)"), ["E0202"]);
}

/// A list that is none: what its files would have brought is not missing as well.
#[test]
fn an_include_without_brackets_is_one_mistake() {
    let text = "Scene(background: 1, include: \"a.ron\", vars: { \"x\": \"=y + 1\" }, objects: [Sphere(center: \"=p\", \
                radius: \"=x\", material: \"white\"), Repeat(count: \"=n\", items: [Box(size: \"=q\")])])";
    let told: Vec<_> = errors(text, Syntax::Ron).iter().map(|fault| fault.message.clone()).collect();
    assert_eq!(told, ["the include of the scene cannot be the text \"a.ron\""]);
}

/// A glass by its name, and one that another scene's objects share.
#[test]
fn glass_is_known_by_its_name() {
    let scene = r#"Scene(background: 1, materials: { "glass": Transparent(ior: 1.5) },
        objects: [Lathe(profile: [(0, 0), (1, 1), (1, 0), (0, 1)], material: "glass")])"#;
    let warnings = load(scene, Syntax::Ron).expect("right").warnings;
    let [only] = warnings.as_slice() else { panic!("{warnings:?}") };
    assert_eq!(only.code.as_str(), "W0313");
    assert!(only.message.contains("at (0.5, 0.5): after profile[0] and after profile[2]"), "{}", only.message);
}

/// Following the hint mends it.
#[test]
fn a_point_more_keeps_a_stem_from_thinning() {
    let stem = |more: &str| {
        codes(&format!("Lathe(profile: [(0.2, 0), (0.05, 0.16), {more} (0.05, 0.9), (0.2, 1)], curve: CatmullRom)"))
    };
    assert_eq!(stem(""), ["W0312"]);
    assert_eq!(stem("(0.05, 0.53),"), Vec::<String>::new());
}

#[test]
fn long_outlines_are_read_in_time() {
    let zigzag = |count: usize| -> String { (0..count).map(|k| format!("({}, {}), ", k % 2, k)).collect() };
    let comb: String = (0..40_000).map(|k| format!("({k}, {}), ", 9 * (k % 2))).collect();
    let curved = format!("Extrude(depth: 1, curve: CatmullRom, outline: [[{} (9, 5000), (9, -1)]]),", zigzag(30_000));
    let lathes = format!("Lathe(curve: CatmullRom, material: Transparent(ior: 1.5), profile: [{}]),", zigzag(100));
    for objects in [
        curved,
        lathes.repeat(200),
        format!("Extrude(depth: 1, outline: [[{comb} (40000, -1), (0, -1)]]),"),
        format!("Extrude(depth: 1, outline: [[{} (9, 5000), (9, -1)]]),", zigzag(40_000)),
    ] {
        let before = Instant::now();
        codes(&objects);
        assert!(before.elapsed().as_secs_f64() < 1.0, "{:?}: {}", before.elapsed(), &objects[..60]);
    }
}

/// What is neither flat nor a ball has no intensity; by name or written there, and told once where it is repeated.
#[test]
fn only_some_shapes_shine_by_an_intensity() {
    let told = |object: &str| {
        let text = format!(
            "Scene(materials: {{ \"lamp\": Emissive(luminous_intensity: 90) }}, objects: [{object}, \
             Sphere(center: (0, 5, 0), radius: 1, material: \"lamp\")])"
        );
        match common::load(&text, scene_format::Syntax::Ron) {
            Ok(_) => Vec::new(),
            Err(scene_format::LoadError::Invalid { diagnostics, .. }) => {
                diagnostics.iter().map(|fault| fault.code.as_str().to_owned()).collect()
            }
            Err(other) => panic!("{other:?}"),
        }
    };
    for shape in ["Disk(", "Rectangle(", "Polygon(points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], "] {
        assert_eq!(told(&format!("{shape}material: \"lamp\")")), [""; 0], "{shape}");
    }
    for object in [
        "Box(material: \"lamp\")",
        "Box(material: Emissive(intensity: 3))",
        "Cylinder(radius: 1, material: Emissive(luminous_intensity: 3))",
        "Repeat(count: 5, items: [Box(center: (\"=i\", 0, 0), material: Emissive(intensity: 3))])",
        "Group(objects: [Torus(radius: 1, tube_radius: 0.1, material: \"lamp\")])",
    ] {
        assert_eq!(told(object), ["E0212"], "{object}");
    }
}

/// A texture says how much each point shines; what is said of the whole lamp has no use for one, by whatever name.
#[test]
fn textures_are_of_what_points_shine() {
    let told = |material: &str| {
        let text = format!(
            "Scene(textures: {{ \"clouds\": Noise(), \"warm\": (1, 0.6, 0.2) }}, \
             objects: [Sphere(center: (0, 0, 0), radius: 1, material: Emissive({material}))])"
        );
        let errors = common::diagnostics(&text, scene_format::Syntax::Ron).into_iter();
        let errors = errors.filter(|fault| fault.severity == scene_format::Severity::Error);
        errors.map(|fault| (fault.code.as_str().to_owned(), fault.hint)).collect::<Vec<_>>()
    };
    for right in [
        "radiance: 3, color: \"clouds\"",
        "luminance: 300, color: Checkerboard()",
        "radiance: 3, color: (5, 3, 2)",
        "power: 3, color: \"warm\"",
        "luminous_power: 800, color: \"=blackbody(2700)\"",
    ] {
        assert_eq!(told(right), [], "{right}");
    }
    for (wrong, code, hint) in [
        ("power: 3, color: \"clouds\"", "E0212", "write `radiance` in place of `power`"),
        ("luminous_power: 3, color: Noise()", "E0212", "write `luminance` in place of `luminous_power`"),
        ("intensity: 3, color: Noise()", "E0212", "write `radiance` in place of `intensity`"),
        ("luminous_intensity: 3, color: Noise()", "E0212", "write `luminance` in place of `luminous_intensity`"),
        ("radiance: 3, color: Noise(b: 4)", "E0303", "channels go from 0 to 1"),
        ("radiance: Noise()", "E0203", "the texture of a lamp is the `color` of `Emissive`"),
        ("radiance: 3, texture: Noise()", "E0201", "a texture stands in `color`"),
    ] {
        let faults = told(wrong);
        let [(found, told)] = &faults[..] else { panic!("{wrong}: {faults:?}") };
        assert!(found == code && told.contains(hint), "{wrong}: {found} {told}");
    }
}
