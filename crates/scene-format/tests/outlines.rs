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
