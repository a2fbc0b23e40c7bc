//! Descriptions by serde: what the crates `ron`, `toml` and `serde_json` write is what they read, and what the reader
//! reads.

mod common;

use common::Random;
use common::generated::{plain, scene};
use scene_format::desc::{Camera, Material, MaterialRef, Name, NamedMaterial, Object, Render, Transform};
use scene_format::diagnostic::Span;
use scene_format::{SceneDesc, Syntax, load_str};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};

/// A value as each crate writes it.
fn written<T: Serialize>(value: &T) -> [(String, Syntax); 4] {
    let names = ron::ser::PrettyConfig::new().struct_names(true);
    [
        (ron::to_string(value).expect("RON"), Syntax::Ron),
        (ron::ser::to_string_pretty(value, names).expect("RON"), Syntax::Ron),
        (toml::to_string(value).expect("TOML"), Syntax::Toml),
        (serde_json::to_string(value).expect("JSON"), Syntax::Json),
    ]
}

/// A text as the crate of its syntax reads it.
fn read<T: DeserializeOwned>(text: &str, syntax: Syntax) -> Result<T, String> {
    match syntax {
        Syntax::Ron => ron::from_str(text).map_err(|error| error.to_string()),
        Syntax::Toml => toml::from_str(text).map_err(|error| error.to_string()),
        Syntax::Json => serde_json::from_str(text).map_err(|error| error.to_string()),
    }
}

/// A scene goes through each crate, and each crate's text through the reader.
fn goes_round(scene: &SceneDesc, name: &str) {
    let wanted = plain(scene.clone());
    for (text, syntax) in written(&wanted) {
        let back: SceneDesc = read(&text, syntax).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
        assert_eq!(plain(back), wanted, "{name} by the crate:\n{text}");
        let loaded = load_str(name, &text, syntax, Path::new(""), &[]);
        let loaded = loaded.unwrap_or_else(|error| panic!("{name}: {error:?}\n{text}"));
        assert_eq!(plain(loaded.scene), wanted, "{name} by the reader:\n{text}");
    }
}

#[test]
fn generated_scenes_go_round() {
    let mut random = Random(9);
    for _ in 0..300 {
        goes_round(&scene(&mut random), "a generated scene");
    }
}

/// All files of the repository: what is read of them goes round, and the crates read the files themselves as the
/// reader does.
#[test]
fn scenes_of_the_repository_go_round() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut folders = ["scenes", "golden", "crates/tracer/templates"].map(|folder| top.join(folder)).to_vec();
    let (mut seen, mut including) = (0, 0);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let Some(syntax) = Syntax::from_path(&path) else { continue };
            let text = std::fs::read_to_string(&path).expect("a scene");
            // A library, which scenes include, is none by itself.
            let Ok(loaded) = load_str("s", &text, syntax, &folder, &[]) else { continue };
            let name = path.display().to_string();
            let by_crate = read::<SceneDesc>(&text, syntax);
            if loaded.scene.includes.is_empty() {
                let by_crate = by_crate.unwrap_or_else(|error| panic!("{name}: {error}"));
                assert_eq!(plain(by_crate), plain(loaded.scene.clone()), "{name}");
            } else {
                // Nobody who only deserializes looks at other files.
                assert!(by_crate.is_err(), "{name}");
                including += 1;
            }
            goes_round(&SceneDesc { includes: Vec::new(), ..loaded.scene }, &name);
            seen += 1;
        }
    }
    assert!(seen > 100 && including > 0, "{seen} scenes, {including} of which include others");
}

/// Each part by itself.
#[test]
fn parts_go_round() {
    fn goes_round<T: Serialize + DeserializeOwned + PartialEq + std::fmt::Debug>(value: &T) {
        let ron = ron::to_string(&vec![value]).expect("RON");
        let json = serde_json::to_string(&vec![value]).expect("JSON");
        for (text, syntax) in [(ron, Syntax::Ron), (json, Syntax::Json)] {
            let back: Vec<T> = read(&text, syntax).unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert_eq!(back.as_slice(), std::slice::from_ref(value), "{text}");
        }
    }
    fn toml<T: Serialize>(value: &T) -> String {
        toml::to_string(value).expect("TOML")
    }
    let mut random = Random(10);
    for _ in 0..100 {
        let scene = plain(scene(&mut random));
        goes_round(&scene.camera);
        goes_round(&scene.image);
        goes_round(&scene.render);
        goes_round(&scene.effects);
        goes_round(&scene.background);
        scene.lights.iter().for_each(goes_round);
        // What names a texture is whole only in a scene.
        let whole = |part: &dyn std::fmt::Debug| !format!("{part:?}").contains("NamedTexture");
        scene.materials.iter().filter(|named| whole(named)).for_each(goes_round);
        scene.textures.iter().filter(|named| whole(&named.texture)).for_each(|named| goes_round(&**named));
        for object in scene.objects.iter().filter(|object| whole(object)) {
            object.value.transform().iter().for_each(goes_round);
            goes_round(object.value.material());
            // The groups that an object stands in are no part of it.
            if object.value.placements().files().is_empty() && !format!("{object:?}").contains("Within") {
                goes_round(object.value.placements());
                goes_round(object);
            }
        }
    }
    goes_round(&MaterialRef::Default);
    goes_round(&Name::from(Some("a name")));
    goes_round(&Name::default());
    assert_eq!(toml(&Camera::default()), "");
    assert_eq!(
        serde_json::to_string(&Render { samples: 9.into(), ..Render::default() }).expect("JSON"),
        "{\"samples\":9}"
    );
    let named = NamedMaterial { name: "red".to_owned().into(), material: Material::default() };
    assert_eq!(serde_json::to_string(&named).expect("JSON"), "{\"red\":{\"Diffuse\":{}}}");
    let steps: Vec<Transform> =
        ron::from_str("[Scale(2), Translate((1, 2, 3)), CenterTo((4, 5, 6)), DropTo(y: 0)]").expect("RON");
    assert_eq!(steps[1..3], [Transform::Translate([1.0, 2.0, 3.0]), Transform::CenterTo { point: [4.0, 5.0, 6.0] }]);
    let in_json: Vec<Transform> =
        serde_json::from_str(r#"[{ "CenterTo": [4, 5, 6] }, { "CenterTo": { "point": [4, 5, 6] } }]"#).expect("JSON");
    assert_eq!(in_json, [steps[2].clone(), steps[2].clone()]);
    goes_round(&steps[2]);
}

/// What a description keeps of where it was written: nothing, as if it had been made in a program.
#[test]
fn what_is_deserialized_points_nowhere() {
    let text = r#"{
        "background": 1,
        "objects": [{ "Box": { "size": 2, "material": "red" } }],
        "materials": { "red": { "Mirror": {} } }
    }"#;
    let scene: SceneDesc = serde_json::from_str(text).expect("a scene");
    let Object::Box(found) = &scene.objects[0].value else { panic!("a box") };
    assert_eq!(
        (scene.objects[0].span, found.size.span, scene.materials[0].name.span),
        (Span::NONE, Span::NONE, Span::NONE)
    );
    assert_eq!((scene.base_dir, scene.sources.len()), (PathBuf::new(), 0));
}

#[test]
fn faults_are_told_with_their_place() {
    let ball = |ball: &str| format!("{{ \"background\": 1, \"objects\": [{{ \"Sphere\": {ball} }}] }}");
    for (text, wanted) in [
        (
            ball(r#"{ "center": [0, 0, 0], "radius": -1 }"#),
            "objects[0].radius: the radius of a sphere must be positive",
        ),
        (ball(r#"{ "center": [0, 0], "radius": 1 }"#), "objects[0].center"),
        (ball(r#"{ "center": [0, 0, 0], "radius": 1, "radus": 1 }"#), "`radus`"),
        (ball(r#"{ "center": [0, 0, 0], "radius": 1, "material": "red" }"#), "there is no material \"red\""),
        (r#"{ "background": 1 }"#.to_owned(), "the scene has no objects"),
        (r#"{ "include": ["a.ron"], "objects": [{ "Box": { "size": 1 } }] }"#.to_owned(), "a.ron"),
        (r#"{ "objects": [{ "Include": { "file": "a.ron" } }] }"#.to_owned(), "a.ron"),
    ] {
        let error = read::<SceneDesc>(&text, Syntax::Json).expect_err("it is wrong");
        assert!(error.contains(wanted), "{error}\n{text}");
    }
    let error = ron::from_str::<SceneDesc>("Scene(background: NaN, objects: [Box(size: 1)])").expect_err("it is wrong");
    assert!(error.to_string().contains("finite"), "{error}");
    let error = ron::from_str::<Camera>("Camera(fov: 300)").expect_err("it is wrong");
    assert!(error.to_string().contains("fov"), "{error}");
}
