//! Textures by name: that a name says what stands at it, whose names win, and what is said where one is wrong.

mod common;

use common::generated::plain;
use common::{diagnostics, errors, load};
use scene_format::desc::{Albedo, Material, SolidMapping};
use scene_format::{
    Defaults, LoadError, Loaded, Override, SceneDesc, Syntax, convert, hash_hex, load as load_file, load_str, to_text,
};
use std::path::{Path, PathBuf};

/// Whether two say the same once names are what they stand for.
fn same(a: &Albedo, b: &Albedo) -> bool {
    let (a, b) = (a.resolved(), b.resolved());
    let (Some(first), Some(second)) = (a.pattern(), b.pattern()) else { return a == b };
    let (parts, others) = (first.parts(), second.parts());
    let lies = |mapping: Option<SolidMapping>| mapping.map(|mapping| format!("{mapping:?}"));
    std::mem::discriminant(a) == std::mem::discriminant(b)
        && lies(first.mapping()) == lies(second.mapping())
        && parts.len() == others.len()
        && parts.into_iter().zip(others).all(|(part, other)| same(part, other))
}

fn albedo(scene: &SceneDesc, name: &str) -> Albedo {
    let named = scene.materials.iter().find(|named| &*named.name.value == name);
    let material = &named.unwrap_or_else(|| panic!("no material {name}")).material;
    material.varying().first().map_or_else(|| panic!("{name} has no colour"), |&color| color.clone())
}

/// A scene with these textures, whose ball has this colour.
fn with(textures: &str, color: &str) -> String {
    format!(
        "Scene(background: 1, textures: {{ {textures} }}, materials: {{ \"m\": Diffuse(albedo: {color}) }}, \
         objects: [Sphere(center: (0, 0, 0), radius: 1, material: \"m\")])"
    )
}

/// Codes and messages.
fn told(text: &str) -> Vec<String> {
    diagnostics(text, Syntax::Ron).iter().map(|fault| format!("{} {}", fault.code, fault.message)).collect()
}

const NAMED: &str = r##"Scene(
    background: 1,
    textures: {
        // In any order, one in the other.
        "wall": Mix(a: "bricks", b: "moss", weight: "clouds"),
        "bricks": Texture(file: "bricks.png"),
        "moss": "green",
        "green": "#205010",
        "clouds": ColorRamp(input: Noise(a: 0.2), stops: [(at: 0, color: 0), (at: 1, color: 1)]),
    },
    materials: {
        "a": Diffuse(albedo: "wall"),
        "b": BlinnPhong(
            albedo: Checkerboard(a: "green", b: "wall", mapping: Uv(scale: 8)), exponent: 9, specular: 0.1,
        ),
        "c": Conductor(reflectance: "clouds"),
        "d": Diffuse(albedo: "#205010"),
    },
    objects: [
        Box(material: "a"), Box(material: "b"), Box(material: "c"), Box(material: "d"),
        Box(material: Diffuse(albedo: "moss")),
    ],
)"##;

/// The same without names.
fn inline() -> String {
    let clouds = "ColorRamp(input: Noise(a: 0.2), stops: [(at: 0, color: 0), (at: 1, color: 1)])";
    let wall = format!("Mix(a: Texture(file: \"bricks.png\"), b: \"#205010\", weight: {clouds})");
    format!(
        r##"Scene(
            background: 1,
            materials: {{
                "a": Diffuse(albedo: {wall}),
                "b": BlinnPhong(
                    albedo: Checkerboard(a: "#205010", b: {wall}, mapping: Uv(scale: 8)), exponent: 9, specular: 0.1,
                ),
                "c": Conductor(reflectance: {clouds}),
                "d": Diffuse(albedo: "#205010"),
            }},
            objects: [
                Box(material: "a"), Box(material: "b"), Box(material: "c"), Box(material: "d"),
                Box(material: Diffuse(albedo: "#205010")),
            ],
        )"##
    )
}

fn right(text: &str, syntax: Syntax) -> SceneDesc {
    match load(text, syntax) {
        Ok(Loaded { scene, warnings }) if warnings.is_empty() => scene,
        other => panic!("{other:?}\n{text}"),
    }
}

#[test]
fn a_name_says_what_stands_at_it() {
    let (named, inline) = (right(NAMED, Syntax::Ron), right(&inline(), Syntax::Ron));
    for name in ["a", "b", "c", "d"] {
        let (one, other) = (albedo(&named, name), albedo(&inline, name));
        assert!(same(&one, &other), "{name}: {one:?}\n{other:?}");
        assert_eq!((one.images(), one.wants_uv()), (other.images(), other.wants_uv()), "{name}");
    }
    assert!(matches!(albedo(&named, "a"), Albedo::Named(wall) if &*wall.name.value == "wall"));
    assert!(matches!(albedo(&named, "d"), Albedo::Color(_)));
    let names: Vec<&str> = named.textures.iter().map(|texture| &*texture.name.value).collect();
    assert_eq!(names, ["wall", "bricks", "moss", "green", "clouds"]);
}

#[test]
fn names_stay_names_in_every_syntax_and_by_serde() {
    let scene = right(NAMED, Syntax::Ron);
    for syntax in Syntax::ALL {
        for defaults in [Defaults::Hidden, Defaults::Shown] {
            let text = to_text(&scene, syntax, defaults);
            assert_eq!(text.matches("bricks.png").count(), 1, "{text}");
            let back = right(&text, syntax);
            assert_eq!(hash_hex(&back), hash_hex(&scene));
            assert_eq!(plain(back), plain(scene.clone()), "{text}");
        }
        let there = convert("s", NAMED, Syntax::Ron, syntax).expect("it is right");
        assert_eq!(hash_hex(&right(&there, syntax)), hash_hex(&scene), "{there}");
    }
    let json = serde_json::to_string(&scene).expect("JSON");
    let back: SceneDesc = serde_json::from_str(&json).expect("it is right");
    assert_eq!((&back.textures, &back.materials), (&scene.textures, &scene.materials));
    // A part by itself knows no names.
    let alone = serde_json::from_str::<Material>(r#"{ "Diffuse": { "albedo": "wall" } }"#).expect_err("no names");
    assert!(alone.to_string().contains("there is no texture \"wall\""), "{alone}");
    let toml = "background = 1\n[textures]\nstripes = { Lines = { width = 0.2 } }\n[textures.stone.Marble]\n\
                distortion = 2\n[[objects]]\nBox = { material = { Diffuse = { albedo = \"stripes\" } } }\n[[objects]]\n\
                Box = { material = { Diffuse = { albedo = \"stone\" } } }\n";
    assert_eq!(right(toml, Syntax::Toml).textures.len(), 2);
}

#[test]
fn what_is_no_colour_and_no_name_is_told() {
    let bricks = "\"bricks\": Lines(), \"clouds\": Noise()";
    for (color, wanted) in [
        ("\"briks\"", "E0406 there is no texture \"briks\""),
        ("\"sandstone\"", "E0406 there is no texture \"sandstone\""),
        ("Mix(a: \"bricks\", b: \"cloud\")", "E0406 there is no texture \"cloud\""),
        ("\"red\"", "E0306 the albedo of a diffuse material cannot be read from the text \"red\""),
        ("\"b3202c\"", "E0306 the albedo of a diffuse material cannot be read from the text \"b3202c\""),
        ("\"#b3202\"", "E0306 the albedo of a diffuse material cannot be read from the text \"#b3202\""),
        ("\"Checkerboard\"", "E0203 a colour cannot be the text \"Checkerboard\""),
    ] {
        let found = errors(&with(bricks, color), Syntax::Ron);
        let found: Vec<String> = found.iter().map(|fault| format!("{} {}", fault.code, fault.message)).collect();
        assert_eq!(found, [wanted], "{color}");
    }
    let unknown = &errors(&with(bricks, "\"briks\""), Syntax::Ron)[0];
    assert_eq!(unknown.expected, "a colour, or a name from `textures`: `bricks` or `clouds`");
    assert_eq!(unknown.hint, "did you mean `bricks`?");
    let nothing = &errors(&with("", "\"sandstone\""), Syntax::Ron)[0];
    assert_eq!(nothing.expected, "a colour, or a texture written here: `textures` is empty");
    let bare = &errors(&with(bricks, "bricks"), Syntax::Ron)[0];
    assert_eq!(
        (bare.message.as_str(), bare.hint.as_str()),
        ("names of textures stand between double quotes", "write \"bricks\"")
    );
    let material = with(bricks, "\"bricks\"").replace("material: \"m\"", "material: \"clouds\"");
    assert_eq!(
        errors(&material, Syntax::Ron)[0].hint,
        "it is a texture, and a material has one: Diffuse(albedo: \"clouds\")"
    );
    // A text with `#` or `=` can be no name.
    assert_eq!(told(&with("\"#1\": Noise()", "1")), ["E0408 \"#1\" cannot be the name of a texture"]);
    assert_eq!(told(&with("\"a\": Noise(), \"a\": Wood()", "\"a\"")), ["E0402 two textures have the name \"a\""]);
    // Where names may be missing none is called unknown.
    assert_eq!(
        told(&with("", "\"x\"").replace("textures: {  }", "textures: 3")),
        ["E0203 the textures of the scene cannot be the number 3"]
    );
}

#[test]
fn circles_are_shown() {
    for (textures, wanted) in [
        ("\"a\": \"a\"", "the texture \"a\" names itself"),
        ("\"a\": \"b\", \"b\": \"a\"", "the texture \"a\" names \"b\", which names \"a\""),
        (
            "\"a\": Mix(b: \"b\"), \"b\": ColorRamp(input: \"c\", stops: [(at: 0, color: 0), (at: 1, color: 1)]), \
             \"c\": Multiply(a: 0.5, b: \"a\")",
            "the texture \"a\" names \"b\", which names \"c\", which names \"a\"",
        ),
    ] {
        assert_eq!(told(&with(textures, "\"a\"")), [format!("E0407 {wanted}")]);
    }
}

#[test]
fn depth_and_number_count_through_names() {
    let deep = |count: usize, link: &dyn Fn(usize) -> String, reversed: bool| {
        let mut all: Vec<String> = (1..count).map(|k| format!("\"t{k}\": {}", link(k - 1))).collect();
        all.insert(0, "\"t0\": Noise()".to_owned());
        if reversed {
            all.reverse();
        }
        with(&all.join(", "), &format!("\"t{}\"", count - 1))
    };
    let product = |k: usize| format!("Multiply(a: \"t{k}\")");
    let alias = |k: usize| format!("\"t{k}\"");
    for reversed in [false, true] {
        for link in [&product as &dyn Fn(usize) -> String, &alias] {
            assert_eq!(told(&deep(16, link, reversed)), Vec::<String>::new());
            let found = errors(&deep(17, link, reversed), Syntax::Ron);
            assert!(found.iter().all(|fault| fault.message == "textures stand more than 16 deep"), "{found:?}");
            assert!(!found.is_empty());
        }
        // A long chain ends soon.
        assert!(!errors(&deep(50_000, &alias, reversed), Syntax::Ron).is_empty());
    }
    // Each is two of the one before: 2^k - 1 textures.
    let twice = |k: usize| format!("Multiply(a: \"t{k}\", b: \"t{k}\")");
    assert_eq!(told(&deep(10, &twice, false)), Vec::<String>::new());
    assert_eq!(told(&deep(11, &twice, false)), ["E0606 a texture is made of more than 1024 others"]);
}

#[test]
fn what_nothing_names_is_warned_of() {
    assert_eq!(told(&with("\"a\": Noise(), \"b\": Wood()", "\"b\"")), ["W0402 nothing uses the texture \"a\""]);
    assert_eq!(told(&with("\"a\": Noise(), \"b\": Multiply(a: \"a\")", "\"b\"")), Vec::<String>::new());
    let film = with("\"a\": Noise(), \"b\": Wood()", "Pick(from: [\"a\", \"b\"], index: \"=frame\")");
    assert_eq!(told(&film.replace("background", "animation: Animation(frames: 2), background")), Vec::<String>::new());
}

#[test]
fn parts_are_set_from_the_command_line() {
    let text = with("\"bricks\": Lines(width: 0.1)", "\"bricks\"");
    let set = |argument: &str| load_str("s", &text, Syntax::Ron, Path::new(""), &[Override::from(argument)]);
    let width = |loaded: Result<Loaded, LoadError>| match albedo(&loaded.expect("it is right").scene, "m").resolved() {
        Albedo::Lines(lines) => lines.width,
        other => panic!("{other:?}"),
    };
    assert_eq!(width(set("textures.bricks.width=0.25")), 0.25);
    assert_eq!(width(set("textures.bricks=Lines(width: 0.5)")), 0.5);
    let hint = |argument: &str| match set(argument) {
        Err(LoadError::Invalid { diagnostics, .. }) => format!("{}: {}", diagnostics[0].message, diagnostics[0].hint),
        other => panic!("{other:?}"),
    };
    assert_eq!(
        hint("materials.m.albedo.width=1"),
        "the albedo of a diffuse material is one of `textures`, by its name: set the texture of that name: \
         textures.bricks"
    );
    assert_eq!(hint("textures.brick.width=1"), "the scene has no texture \"brick\": did you mean `bricks`?");
}

/// A folder of its own with these files.
fn folder(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("textures_by_name").join(name);
    for (file, text) in files {
        let path = folder.join(file);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder is made");
        std::fs::write(path, text).expect("a file is written");
    }
    folder
}

fn of_color(scene: &SceneDesc, name: &str) -> f64 {
    match albedo(scene, name).resolved() {
        Albedo::Color(color) => color.value[0],
        other => panic!("{other:?}"),
    }
}

#[test]
fn included_textures_give_way_to_the_files_own() {
    let one = r#"Scene(textures: { "own": 0.1, "both": 0.1, "one": 0.1, "left": 0.1 },
        materials: { "of one": Diffuse(albedo: Multiply(a: "own")), "kept": Diffuse(albedo: "both") })"#;
    let two = r#"Scene(textures: { "both": 0.2, "two": "one" })"#;
    let text = r#"Scene(
        include: ["one.ron", "two.ron"],
        background: 1,
        textures: { "own": 0.3 },
        materials: { "a": Diffuse(albedo: "own"), "b": Diffuse(albedo: "both"), "c": Diffuse(albedo: "two") },
        objects: [Box(material: "a"), Box(material: "b"), Box(material: "c"), Box(material: "of one"),
            Box(material: "kept")],
    )"#;
    let folder = folder("include", &[("s.ron", text), ("one.ron", one), ("two.ron", two)]);
    let Loaded { scene, warnings } = load_file(&folder.join("s.ron")).expect("it is right");
    assert_eq!(warnings, Vec::new());
    // Names of this file win, and of two files those of the later; a file's materials keep what it says itself.
    assert_eq!(["a", "b", "c", "kept"].map(|name| of_color(&scene, name)), [0.3, 0.2, 0.1, 0.1]);
    let Albedo::Multiply(product) = albedo(&scene, "of one") else { panic!("a product") };
    assert_eq!(product.a.resolved(), &Albedo::Color([0.1; 3].into()));
    let names: Vec<&str> = scene.textures.iter().map(|texture| &*texture.name.value).collect();
    assert_eq!(names, ["one", "left", "both", "two", "own", "one.ron: own", "one.ron: both"]);
    let text = to_text(&scene, Syntax::Ron, Defaults::Hidden);
    let back = load_str("s", &text, Syntax::Ron, Path::new(""), &[]).expect("it is right").scene;
    assert_eq!((&back.textures, &back.materials), (&scene.textures, &scene.materials), "{text}");
}

#[test]
fn an_included_scene_has_textures_of_its_own() {
    let chair = r#"Scene(background: 1, vars: { "shade": 0.5 },
        textures: { "cloth": "=shade", "unused": Noise(), "grain": Texture(file: "grain.png") },
        materials: { "seat": Diffuse(albedo: "cloth"), "leg": Diffuse(albedo: "grain") },
        objects: [Box(material: "seat"), Box(material: "leg")])"#;
    let room = r#"Scene(background: 1,
        textures: { "cloth": 0.9 },
        materials: { "wall": Diffuse(albedo: "cloth") },
        objects: [Box(material: "wall"), Include(file: "parts/chair.ron"), Include(file: "parts/chair.ron"),
            Include(file: "parts/chair.ron", materials: { "leg": Diffuse(albedo: "cloth"), "seat": "wall" }),
            Include(file: "parts/chair.ron", vars: { "shade": 0.25 })])"#;
    let folder = folder("scenes", &[("room.ron", room), ("parts/chair.ron", chair)]);
    let Loaded { scene, warnings } = load_file(&folder.join("room.ron")).expect("it is right");
    assert_eq!(warnings, Vec::new());
    let file = Path::new("parts/chair.ron").display().to_string();
    let names: Vec<&str> = scene.textures.iter().map(|texture| &*texture.name.value).collect();
    let of = |name: &str| format!("{file}: {name}");
    assert_eq!(names, ["cloth".to_owned(), of("cloth"), of("grain"), of("cloth (2)")]);
    assert_eq!(of_color(&scene, "wall"), 0.9);
    assert_eq!(of_color(&scene, &of("seat")), 0.5);
    assert_eq!(of_color(&scene, &of("seat (2)")), 0.25);
    let grain = albedo(&scene, &of("leg"));
    assert_eq!(&*grain.image().expect("a picture").file.value, Path::new("parts/grain.png"));
    // Names of this scene are not seen there.
    let blind = chair.replace("\"cloth\": \"=shade\", ", "");
    std::fs::write(folder.join("parts/chair.ron"), blind).expect("a file");
    let Err(LoadError::Invalid { diagnostics, .. }) = load_file(&folder.join("room.ron")) else { panic!("no cloth") };
    assert!(diagnostics.iter().any(|fault| fault.message == "there is no texture \"cloth\""), "{diagnostics:?}");
}
