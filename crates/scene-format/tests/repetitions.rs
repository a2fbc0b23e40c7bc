//! Repetitions: what they stand for, and how many items they may make.

mod common;

use common::load;
use scene_format::{LoadError, Syntax, convert, hash};

/// `Repeat` says the same as its items written out, wherever a list stands, in both syntaxes; the converter keeps it
/// with its comments.
#[test]
fn repetitions_say_what_they_stand_for() {
    let short = r#"Scene(
    background: 1,
    vars: { "n": 3 },
    objects: [
        // a row
        Repeat(count: "=n", vars: { "x": "=2*i" }, items: [
            Sphere(center: ("=x", "=i", 0), radius: 1), // one of them
            Repeat(count: 2, index: "k", items: [Sphere(center: ("=x + k", 0, 0), radius: "=1 + i + k")]),
        ]),
        Box(size: 0.3, placements: [Repeat(count: 2, items: [[Translate(("=i - 2", -1, 0)),
            Repeat(count: 2, items: [Scale(2)])]])]),
    ],
)"#;
    let sphere = |x: u32, y: u32, r: u32| format!("Sphere(center: ({x}, {y}, 0), radius: {r}), ");
    let row = |i: u32| sphere(2 * i, i, 1) + &sphere(2 * i, 0, 1 + i) + &sphere(2 * i + 1, 0, 2 + i);
    let copies = "[Translate((-2, -1, 0)), Scale(2), Scale(2)], [Translate((-1, -1, 0)), Scale(2), Scale(2)]";
    let long = format!(
        "Scene(background: 1, objects: [{}{}{} Box(size: 0.3, placements: [{copies}])])",
        row(0),
        row(1),
        row(2)
    );
    let (short_scene, long_scene) = (load(short, Syntax::Ron), load(&long, Syntax::Ron));
    let (short_scene, long_scene) = (short_scene.expect("right").scene, long_scene.expect("right").scene);
    assert_eq!(short_scene.objects, long_scene.objects);
    assert_eq!(hash(&short_scene), hash(&long_scene));
    let toml = convert("short.ron", short, Syntax::Ron, Syntax::Toml).expect("right");
    assert!(toml.contains("# a row") && toml.contains("# one of them") && toml.contains("\"=x + k\""), "{toml}");
    let back = convert("short.toml", &toml, Syntax::Toml, Syntax::Ron).expect("right");
    for (text, syntax) in [(&toml, Syntax::Toml), (&back, Syntax::Ron)] {
        let scene = load(text, syntax).unwrap_or_else(|error| panic!("{error:?}: {text}")).scene;
        assert_eq!(scene.objects, long_scene.objects, "{text}");
    }
}

/// A million spheres of three lines. What they take is in `memory.rs`.
#[test]
fn a_million_items_are_read() {
    let text = r#"Scene(background: 1, objects: [
        Repeat(count: 1000, index: "x", items: [Repeat(count: 1000, index: "z", items: [
            Sphere(center: ("=x", 0, "=z"), radius: "=0.2 + 0.2*random(x, z)")])])])"#;
    let scene = load(text, Syntax::Ron).expect("right").scene;
    assert_eq!(scene.objects.len(), 1_000_000);
}

/// A thousand times a thousand times a thousand is counted, not made.
#[test]
fn too_many_items_are_refused_at_once() {
    let text = r#"Scene(background: 1, objects: [
        Repeat(count: 1_000, items: [Repeat(count: 1000, index: "j", items: [Repeat(count: 1000, index: "k", items: [
            Sphere(center: ("=i", "=j", "=k"), radius: 0.1)])])]),
        Repeat(count: 1000000, items: [Repeat(count: 0, items: [Box()]), Box()])])"#;
    let before = std::time::Instant::now();
    let Err(LoadError::Invalid { diagnostics, .. }) = load(text, Syntax::Ron) else { panic!("too many") };
    assert!(before.elapsed().as_secs_f64() < 1.0, "{:?}", before.elapsed());
    let [only] = diagnostics.as_slice() else { panic!("{diagnostics:?}") };
    assert_eq!((only.code.as_str(), only.message.as_str()), ("E0606", "repetitions make more than 10000000 items"));
}
