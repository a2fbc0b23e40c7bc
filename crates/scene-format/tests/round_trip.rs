//! Whatever is written is read again as the same scene; what RON's own crate reads has the same values.

mod common;

use common::generated::{plain, scene};
use common::{FULL, FULL_JSON, FULL_RON, FULL_TOML, Random, load};
use scene_format::desc::*;
use scene_format::diagnostic::Span;
use scene_format::{Defaults, SceneDesc, Syntax, convert, examples, format, hash, hash_hex, to_text};

fn read(text: &str, syntax: Syntax) -> SceneDesc {
    match load(text, syntax) {
        Ok(loaded) => loaded.scene,
        Err(error) => panic!("{error:?}\n{text}"),
    }
}

#[test]
fn generated_scenes_are_read_as_they_were_written() {
    let mut random = Random(1);
    for _ in 0..1500 {
        let written = scene(&mut random);
        let expected = plain(written.clone());
        for syntax in Syntax::ALL {
            for defaults in [Defaults::Hidden, Defaults::Shown] {
                let text = to_text(&written, syntax, defaults);
                let back = read(&text, syntax);
                assert_eq!(hash(&back), hash(&written), "{text}");
                assert_eq!(plain(back), expected, "{text}");
            }
        }
    }
}

#[test]
fn converted_scenes_say_the_same() {
    let mut random = Random(2);
    let mut texts: Vec<(String, Syntax)> = FULL.iter().map(|(text, syntax)| ((*text).to_owned(), *syntax)).collect();
    texts.extend(examples().into_iter().map(|example| (example.ron, Syntax::Ron)));
    texts.extend((0..300).map(|_| (to_text(&scene(&mut random), Syntax::Ron, Defaults::Hidden), Syntax::Ron)));
    for (text, syntax) in texts {
        let expected = hash_hex(&read(&text, syntax));
        for other in Syntax::ALL.into_iter().filter(|other| *other != syntax) {
            let there = convert("scene", &text, syntax, other).expect("the scene is right");
            assert_eq!(hash_hex(&read(&there, other)), expected, "{there}");
            assert_eq!(format("scene", &there, other).expect("the scene is right"), there);
            let back = convert("scene", &there, other, syntax).expect("the converted scene is right");
            assert_eq!(hash_hex(&read(&back, syntax)), expected, "{back}");
            // Once converted, a text stays as it is.
            let again = convert("scene", &back, syntax, other).expect("the scene is right");
            assert_eq!(again, there);
        }
    }
}

#[test]
fn the_full_scenes_are_the_same_and_their_hash_stays() {
    let (ron, toml) = (read(FULL_RON, Syntax::Ron), read(FULL_TOML, Syntax::Toml));
    assert_eq!(plain(ron.clone()), plain(toml.clone()));
    assert_eq!(hash_hex(&ron), hash_hex(&toml));
    assert_eq!(plain(read(FULL_JSON, Syntax::Json)), plain(toml));
    // Fields at their default are left out of it, so that version 1 files keep their hash when the language gets new
    // fields.
    let shown = to_text(&ron, Syntax::Ron, Defaults::Shown);
    assert_eq!(hash_hex(&read(&shown, Syntax::Ron)), hash_hex(&ron));
    assert_eq!(hash_hex(&ron), "49b55913529e6d0e1b6b07bfcacabea51e0c84883c4319ef21ea4ea7ec0d523d");
}

#[test]
fn the_hash_sees_values_and_not_their_form() {
    let hash = |objects: &str| hash_hex(&read(&format!("Scene(background: 1, objects: [{objects}])"), Syntax::Ron));
    let one = hash("Sphere(center: (0, 0, 0), radius: 1)");
    assert_eq!(hash("Sphere(radius: 1.0, center: [0.0, -0.0, 0e5]) /* one */"), one);
    assert_eq!(hash("Sphere(center: (0, 0, 0), radius: 1_0e-1,)"), one);
    assert_ne!(hash("Sphere(center: (0, 0, 0), radius: 1.0000000000000002)"), one);
    assert_ne!(hash("Sphere(center: (0, 0, 0), radius: 1, material: Mirror())"), one);
}

#[test]
fn comments_and_the_form_of_values_travel_with_their_items() {
    let ron = "\
// The room.
Scene(
    // Seen from the door.
    camera: Camera(fov: 6_0), // wide
    background: \"#ff8800\",
    objects: [
        // The big one.
        Sphere(center: (0, 0, 0), radius: 1e1), // round
        Mesh(
            file: \"cat.obj\", // ours
            // First to last.
            transform: [
                Scale(.5), // half
            ],
        ),
    ],
    // The end.
)
";
    let toml = convert("room.ron", ron, Syntax::Ron, Syntax::Toml).expect("the scene is right");
    assert_eq!(
        toml,
        "\
# The room.

background = \"#ff8800\"

# Seen from the door.
[camera] # wide
fov = 6_0

# The big one.
[[objects]]
Sphere = { center = [0, 0, 0], radius = 1e1 } # round

[[objects]]
[objects.Mesh]
file = \"cat.obj\" # ours
# First to last.
transform = [
    { Scale = 0.5 }, # half
]

# The end.
"
    );
}

/// A headline, a licence, how to render it: what stands at a file's top stays there, there and back.
#[test]
fn the_comment_at_the_top_stays_at_the_top() {
    let ron = "// A ball.\n//\n// Render it.\nScene(\n    background: 1,\n    // The view.\n    camera: Camera(fov: \
     60),\n    \
               objects: [Sphere(center: (0, 0, 0), radius: 1)],\n)\n";
    let toml = convert("s", ron, Syntax::Ron, Syntax::Toml).expect("the scene is right");
    assert!(toml.starts_with("# A ball.\n#\n# Render it.\n\nbackground = 1\n\n# The view.\n[camera]\n"), "{toml}");
    assert_eq!(convert("s", &toml, Syntax::Toml, Syntax::Ron).expect("the scene is right"), ron);
    // Also where no empty line follows, and where the entry below it moves: plain values come before tables in TOML.
    let toml = "# A ball.\nbackground = 1\n[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 }\n";
    let there = convert("s", toml, Syntax::Toml, Syntax::Ron).expect("the scene is right");
    assert!(there.starts_with("// A ball.\nScene(\n"), "{there}");
    let ron = "// A ball.\nScene(objects: [Sphere(center: (0, 0, 0), radius: 1)], background: 1)";
    let toml = convert("s", ron, Syntax::Ron, Syntax::Toml).expect("the scene is right");
    assert!(toml.starts_with("# A ball.\n\nbackground = 1\n"), "{toml}");
}

#[test]
fn a_wrong_scene_is_not_converted() {
    assert!(convert("s.ron", "Scene(objects: [Sphere()])", Syntax::Ron, Syntax::Toml).is_err());
}

/// What the `ron` crate reads of a sphere, for comparison.
#[derive(Debug, serde::Deserialize)]
#[serde(rename = "Scene")]
struct OracleScene {
    camera: OracleCamera,
    objects: Vec<OracleObject>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(rename = "Camera")]
struct OracleCamera {
    position: (f64, f64, f64),
    fov: f64,
}

#[derive(Debug, serde::Deserialize)]
enum OracleObject {
    Sphere { center: (f64, f64, f64), radius: f64, material: String },
}

#[test]
fn the_ron_crate_reads_the_same_numbers_and_texts() {
    let numbers = ["0", "-0.0", "1", "-17", "3.25", "1e3", "-2.5E-3", "1_000", ".5", "7.", "1.7976931348623157e300"];
    let texts = [r#""a""#, r#""a\"b\\c""#, r##"r#"raw "x""#"##, r#""\u{e9}\x41\n""#, r#""é赤""#];
    let mut random = Random(3);
    for _ in 0..500 {
        let n: Vec<&str> = (0..4).map(|_| *random.pick(&numbers)).collect();
        let name = *random.pick(&texts);
        let source = format!(
            "#![enable(implicit_some)]\n/* a */ Scene( // b\n camera: Camera(position: (1, {}, 5), fov: 4_0.5,), \
             objects: [ \
             Sphere(center: ({}, {}, {},), radius: 2, material: {name}) , ] )",
            n[0], n[1], n[2], n[3]
        );
        let oracle: OracleScene = ron::from_str(&source).unwrap_or_else(|error| panic!("{error}\n{source}"));
        let with_material = source.replacen("objects:", &format!("materials: {{ {name}: Mirror() }}, objects:"), 1);
        let large = n.iter().any(|number| number.contains("e300"));
        match load(&with_material, Syntax::Ron) {
            Err(_) => assert!(large, "{with_material}"),
            Ok(loaded) => {
                let Object::Sphere(sphere) = &loaded.scene.objects[0].value else { panic!("a sphere") };
                let OracleObject::Sphere { center, radius, material } = &oracle.objects[0];
                assert_eq!(sphere.center.value, [center.0, center.1, center.2], "{source}");
                assert_eq!(sphere.radius.value, *radius);
                assert_eq!(sphere.material, MaterialRef::Named { name: material.as_str().into(), span: Span::NONE });
                assert_eq!(loaded.scene.camera.fov.value, oracle.camera.fov);
                assert_eq!(loaded.scene.camera.position.value[1], oracle.camera.position.1);
            }
        }
    }
}

/// Every TOML text that loads is TOML for the `toml` crate too, and no other.
#[test]
fn the_toml_crate_takes_what_loads() {
    assert!(toml::from_str::<toml::Value>(FULL_TOML).is_ok());
    let mut random = Random(4);
    for _ in 0..300 {
        let text = to_text(&scene(&mut random), Syntax::Toml, Defaults::Shown);
        assert!(toml::from_str::<toml::Value>(&text).is_ok(), "{text}");
    }
}

/// Materials are numbered in the order that they are written in, so it is the same in every syntax.
#[test]
fn the_order_of_materials_stays() {
    let long = "BlinnPhong(albedo: Checkerboard(a: (0.8, 0.7, 0.6), b: (0.1, 0.1, 0.1), mapping: Planar(size: 0.5)), \
                exponent: 1000, specular: 0.05)";
    let text = format!(
        "Scene(background: 1, materials: {{ \"b\": Mirror(), \"floor\": {long}, \"a\": Diffuse(albedo: 0.5) }},
            objects: [Sphere(center: (0, 0, 0), radius: 1, material: \"a\")])"
    );
    for syntax in [Syntax::Toml, Syntax::Json] {
        let there = convert("s", &text, Syntax::Ron, syntax).expect("right");
        let scene = read(&there, syntax);
        let names: Vec<&str> = scene.materials.iter().map(|named| &*named.name.value).collect();
        assert_eq!(names, ["b", "floor", "a"], "{there}");
    }
}

/// Where comments of TOML stand in RON: with the item, the field or the end of the table that they were written by.
#[test]
fn comments_of_toml_stay_with_their_items() {
    let toml = "# Head.\n\nbackground = 1 # sky\n\n# the camera\n[camera] # cam\nfov = 40 # wide\n# end of camera\n\n\
                [materials]\nred = { Diffuse = { albedo = [1, 0, 0] } } # r\n# end of materials\n\n\
                # a ball\n[[objects]] # first\nSphere = { center = [0, 0, 0], radius = 1 } # ball\n\n\
                # a box\n[[objects]]\n[objects.Box]\nsize = 1 # one\n\n# The end.\n";
    let ron = "// Head.\nScene(\n    background: 1, // sky\n    // the camera\n    camera: Camera(\n        \
               fov: 40, // wide\n        // end of camera\n    ), // cam\n    materials: {\n        \
               \"red\": Diffuse(albedo: (1, 0, 0)), // r\n        // end of materials\n    },\n    objects: [\n        \
               // a ball\n        // first\n        Sphere(center: (0, 0, 0), radius: 1), // ball\n        \
               // a box\n        Box(\n            size: 1, // one\n        ),\n    ],\n)\n// The end.\n";
    assert_eq!(convert("s", toml, Syntax::Toml, Syntax::Ron).expect("right"), ron);
}
