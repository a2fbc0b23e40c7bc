//! Files that a scene includes: whose names win, where paths start, what is said of faults, and that nothing goes on
//! for ever.

use scene_format::desc::{Albedo, Background, Material, MaterialRef, Object};
use scene_format::{FileKind, LoadError, Loaded, Override, SceneDesc, Syntax, convert, hash_hex, load, load_with};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A folder of its own with these files.
fn folder(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("includes").join(name);
    for (file, text) in files {
        let path = folder.join(file);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder is made");
        std::fs::write(path, text).expect("a file is written");
    }
    folder
}

const CHAIR: &str = r##"Scene(
    include: ["parts/wood.toml"],
    vars: { "height": 0.5 },
    materials: { "seat": Diffuse(albedo: "#ff0000"), "back": Diffuse(albedo: Texture(file: "grain.png")) },
    objects: [
        Box(center: (0, "=height", 0), material: "seat"),
        Box(center: (0, "=2*height", 0), material: "wood"),
        Mesh(file: "parts/leg.obj", material: "back", placements: "parts/legs.txt"),
    ],
    lights: [SphereLight(center: (0, "=height", 0), radius: 0.1, radiance: 1)],
)"##;
const WOOD: &str =
    "[vars]\nshade = 0.25\n[materials]\nwood = { Diffuse = { albedo = \"=shade\" } }\nseat = \"unused\"\n";

fn room(name: &str, room: &str) -> Result<Loaded, LoadError> {
    let wood = WOOD.replace(
        "seat = \"unused\"\n",
        "seat = { Mirror = {} }\nother = { Diffuse = { albedo = { Texture = { file = \"x.png\" } } } }\n",
    );
    let folder = folder(name, &[("scenes/chair.ron", CHAIR), ("scenes/parts/wood.toml", &wood), ("room.ron", room)]);
    load(&folder.join("room.ron"))
}

/// Two libraries that build on a third bring its names once; what the later one says of them holds.
#[test]
fn a_library_may_be_included_by_several() {
    let base = r##"Scene(vars: { "w": 0.25, "h": 3 }, textures: { "t": Checkerboard() },
        materials: { "m": Diffuse(albedo: "=w") })"##;
    let files = [
        ("lib.ron", base),
        ("a.ron", r##"Scene(include: ["lib.ron"], vars: { "h": 4 })"##),
        ("b.ron", r##"Scene(include: ["lib.ron"], vars: { "w": 0.75 })"##),
        (
            "twice.ron",
            r##"Scene(version: 1, background: 1, include: ["lib.ron", "lib.ron"],
            objects: [Sphere(center: (0, 0, 0), radius: "=h", material: "m"),
                Sphere(center: (9, 0, 0), radius: 1, material: Diffuse(albedo: "t"))])"##,
        ),
        (
            "room.ron",
            r##"Scene(version: 1, background: 1, include: ["a.ron", "b.ron"],
            objects: [Sphere(center: (0, 0, 0), radius: "=h", material: "m"),
                Sphere(center: (9, 0, 0), radius: 1, material: Diffuse(albedo: "t"))])"##,
        ),
    ];
    let folder = folder("several", &files);
    for (name, w) in [("twice.ron", 0.25), ("room.ron", 0.75)] {
        let loaded = load(&folder.join(name)).expect("right");
        let Object::Sphere(ball) = &loaded.scene.objects[0].value else { panic!("a ball") };
        assert_eq!(ball.radius.value, 3.0, "{name}");
        let Albedo::Color(albedo) = albedo(&loaded, 0) else { panic!("a colour") };
        assert_eq!(albedo.value, [w; 3], "{name}");
    }
}

/// What wins does so in what the files say, too: materials, cameras, other vars.
#[test]
fn vars_that_win_do_so_in_the_files() {
    let lib = r##"Scene(vars: { "n": 1.5, "twice": "=2*n" },
        cameras: { "c": Camera(position: (0, "=n", 9), look_at: (0, 0, 0)) },
        materials: { "m": Diffuse(albedo: "=n/4"), "t": Diffuse(albedo: "=twice/8") })"##;
    let scene = |vars: &str| {
        format!(
            "Scene(include: [\"lib.ron\"], {vars} background: 1, objects: [Sphere(center: (0, 0, 0), radius: \
             \"=twice\", material: \"m\"), Sphere(center: (0, 0, 0), radius: 1, material: \"t\")])"
        )
    };
    let [own, without] = [scene("vars: { \"n\": 2 },"), scene("")];
    let folder = folder("winning", &[("lib.ron", lib), ("own.ron", &own), ("without.ron", &without)]);
    let set = [Override::from("vars.n=2")];
    for (loaded, n) in [
        (load(&folder.join("own.ron")), 2.0),
        (load(&folder.join("without.ron")), 1.5),
        (load_with(&folder.join("without.ron"), &set), 2.0),
    ] {
        let loaded = loaded.expect("right");
        let Object::Sphere(ball) = &loaded.scene.objects[0].value else { panic!("a ball") };
        assert_eq!(ball.radius.value, 2.0 * n);
        for object in 0..2 {
            let Albedo::Color(albedo) = albedo(&loaded, object) else { panic!("a colour") };
            assert_eq!(albedo.value, [n / 4.0; 3]);
        }
        // The only camera that there is is meant.
        assert_eq!(loaded.scene.camera.position.value, [0.0, n, 9.0]);
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    }
}

/// Settings are taken field by field: of the scene itself, of the later file, of what that includes.
#[test]
fn settings_of_files_are_taken() {
    let files = [
        (
            "style.toml",
            "background = 0.5\n[image]\nwidth = 360\nheight = 240\n[render]\nsamples = 32\nseed = 9\n\
             [output]\nalpha = true\n",
        ),
        ("fine.ron", r##"Scene(include: ["style.toml"], render: Render(samples: 64), effects: Effects(exposure: 1))"##),
        ("a.ron", r##"Scene(include: ["fine.ron"], image: Image(width: 100), objects: [Box(size: 1)])"##),
        ("b.ron", r##"Scene(include: ["fine.ron", "style.toml"], background: 1, objects: [Box(size: 1)])"##),
    ];
    let folder = folder("settings", &files);
    let [a, b] = ["a.ron", "b.ron"].map(|name| load(&folder.join(name)).expect("right").scene);
    let told = |scene: &SceneDesc| {
        let (image, render) = (&scene.image, &scene.render);
        ([image.width.value, image.height.value, render.samples.value, render.seed.value], scene.output.alpha)
    };
    assert_eq!(told(&a), ([100, 240, 64, 9], true));
    assert_eq!(told(&b), ([360, 240, 32, 9], true));
    assert_eq!((a.effects.exposure.value, b.effects.exposure.value), (1.0, 1.0));
    assert_eq!([&a.background, &b.background], [&Background::Color([0.5; 3]), &Background::Color([1.0; 3])]);
    let set =
        load_with(&folder.join("a.ron"), &[Override::from("render.samples=5"), Override::from("output.alpha=false")]);
    assert_eq!(told(&set.expect("right").scene), ([100, 240, 5, 9], false));
    // What is wrong there is told, and where it is included.
    for (text, code) in [
        ("[image]\nwidht = 3\n", "E0201"),
        ("[output]\nalhpa = true\n", "E0201"),
        ("[render]\nsamples = \"many\"\n", "E0203"),
        ("image = 3\n", "E0203"),
        ("[camera]\nposition = [0, 0, 5]\n", "E0560"),
        ("[animation]\nframes = 3\n", "E0560"),
        ("[imagge]\nwidth = 3\n", "E0201"),
    ] {
        std::fs::write(folder.join("wrong.toml"), text).expect("a file");
        for own in ["", "image: Image(height: 100), render: Render(seed: 1), output: Output(layers: []),"] {
            let scene = format!("Scene(include: [\"wrong.toml\"], {own} background: 1, objects: [Box(size: 1)])");
            std::fs::write(folder.join("c.ron"), scene).expect("a file");
            let Err(LoadError::Invalid { diagnostics, .. }) = load(&folder.join("c.ron")) else { panic!("{text}") };
            let told: Vec<_> = diagnostics.iter().map(|fault| fault.code.as_str()).collect();
            assert_eq!(told, [code], "{text} {own}");
            assert!(diagnostics[0].labels.iter().any(|label| label.text.ends_with("is included here")), "{text}");
        }
    }
}

/// A scene that takes cameras of a file says which one it means where they are several.
#[test]
fn one_of_several_cameras_of_files_is_chosen() {
    let camera = |name: &str, y: u32| format!("{name:?}: Camera(position: (0, {y}, 9), look_at: (0, 0, 0))");
    let lib = format!("Scene(cameras: {{ {}, {} }})", camera("a", 1), camera("b", 2));
    let scene = |own: &str| format!("Scene(include: [\"lib.ron\"], {own} background: 1, objects: [Box(size: 1)])");
    let [none, named, own] =
        [scene(""), scene("camera: \"b\","), scene(&format!("cameras: {{ {} }},", camera("own", 3)))];
    let folder = folder("cameras", &[("lib.ron", &lib), ("none.ron", &none), ("named.ron", &named), ("own.ron", &own)]);
    assert_eq!(codes(load(&folder.join("none.ron"))), ["E0411"]);
    let height = |name: &str| load(&folder.join(name)).expect("right").scene.camera.position.value[1];
    assert_eq!([height("named.ron"), height("own.ron")], [2.0, 3.0]);
    // A field of it would make another one, of which nothing else is said.
    let set = |name: &str, set: &str| load_with(&folder.join(name), &[Override::from(set)]);
    assert_eq!(codes(set("none.ron", "camera.fov=20")), ["E0403"]);
    let whole = set("none.ron", "camera=Camera(position: (0, 7, 9), look_at: (0, 0, 0))").expect("right");
    assert_eq!(whole.scene.camera.position.value[1], 7.0);
    let of_file = set("named.ron", "cameras.b=Camera(position: (0, 8, 9), look_at: (0, 0, 0))").expect("right");
    assert_eq!(of_file.scene.camera.position.value[1], 8.0);
}

fn codes(result: Result<Loaded, LoadError>) -> Vec<String> {
    match result {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            diagnostics.iter().map(|fault| fault.code.as_str().to_owned()).collect()
        }
        Ok(_) => Vec::new(),
        Err(error) => panic!("{error}"),
    }
}

fn albedo(loaded: &Loaded, object: usize) -> Albedo {
    let material = match loaded.scene.objects[object].value.material() {
        MaterialRef::Named { name, .. } => {
            let named = loaded.scene.materials.iter().find(|named| named.name.value == *name);
            &named.expect("a material of this name").material
        }
        MaterialRef::Inline(material) => &material.value,
        MaterialRef::Default => panic!("no material"),
    };
    let Material::Diffuse(diffuse) = material else { panic!("no diffuse material") };
    diffuse.albedo.clone()
}

#[test]
fn an_included_scene_has_names_and_paths_of_its_own() {
    let text = r#"Scene(
        background: 1,
        vars: { "height": 7, "shade": 1 },
        materials: { "seat": Mirror() },
        objects: [Sphere(center: (0, "=height*shade", 0), radius: 1, material: "seat"),
            Include(file: "scenes/chair.ron")],
    )"#;
    let loaded = room("names", text).expect("a scene");
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    assert_eq!(loaded.scene.objects.len(), 5, "a sphere, two boxes, a mesh, a light");
    assert!(matches!(&loaded.scene.objects[1].value, Object::Box(seat) if seat.center.value == [0.0, 0.5, 0.0]));
    assert_eq!(albedo(&loaded, 1), Albedo::Color([1.0, 0.0, 0.0].into()));
    assert_eq!(albedo(&loaded, 2), Albedo::Color([0.25; 3].into()));
    let Object::Mesh(leg) = &loaded.scene.objects[3].value else { panic!("a mesh") };
    assert_eq!(&*leg.file().expect("a file").value, Path::new("scenes/parts/leg.obj"));
    let files: Vec<&Path> = leg.placements.files().iter().map(|file| &*file.value).collect();
    assert_eq!(files, [Path::new("scenes/parts/legs.txt")]);
    let Albedo::Texture(grain) = albedo(&loaded, 3) else { panic!("a picture") };
    assert_eq!(&*grain.file.value, Path::new("scenes/grain.png"));
    let includes: Vec<&Path> = loaded.scene.includes.iter().map(|file| &**file).collect();
    assert_eq!(includes, [Path::new("scenes/chair.ron"), Path::new("scenes/parts/wood.toml")]);
}

#[test]
fn vars_and_materials_are_given_for_its_own() {
    let text = r##"Scene(
        background: 1,
        materials: { "oak": Diffuse(albedo: 0.1) },
        objects: [
            Include(file: "scenes/chair.ron", vars: { "height": "=2*3", "shade": 0.5 },
                materials: { "seat": "oak", "back": Diffuse(albedo: 0.9) }, placements: Ring(count: 4, radius: 3)),
            Repeat(count: 2, items: [Include(file: "scenes/chair.ron", vars: { "height": "=i" },
                transform: [Translate(("=i", 0, 0))])]),
        ],
    )"##;
    let loaded = room("given", text).expect("a scene");
    assert!(matches!(&loaded.scene.objects[1].value, Object::Box(seat) if seat.center.value == [0.0, 12.0, 0.0]));
    assert_eq!(albedo(&loaded, 0), Albedo::Color([0.1; 3].into()));
    assert_eq!(albedo(&loaded, 1), Albedo::Color([0.5; 3].into()));
    assert_eq!(albedo(&loaded, 2), Albedo::Color([0.9; 3].into()));
    assert_eq!(loaded.scene.objects[0].value.placements().known_copies(), 4);
    assert!(matches!(&loaded.scene.objects[8].value, Object::Box(seat) if seat.center.value == [0.0, 1.0, 0.0]));
    assert!(loaded.scene.objects[8].value.placements().within().is_some());
    // Of equal materials there is one, whatever the number of chairs.
    let names: Vec<&str> = loaded.scene.materials.iter().map(|named| &*named.name.value).collect();
    let chair = Path::new("scenes/chair.ron").display().to_string();
    let of = |name: &str| format!("{chair}: {name}");
    assert_eq!(names, ["oak".to_owned(), of("wood"), of("seat"), of("wood (2)"), of("back")]);
    assert!(codes(room("left", &text.replace("\"shade\": 0.5", "\"shad\": 0.5"))).contains(&"E0406".to_owned()));
}

/// What a solid is made of has the materials of the scene that it stands in, too.
#[test]
fn solids_in_an_included_scene_keep_their_materials() {
    let cup = r##"Scene(materials: { "clay": Diffuse(albedo: "#ff0000") }, objects: [
        Difference(objects: [Box(), Union(objects: [Sphere(center: (0, 0, 0), radius: 0.4, material: "clay")])]),
    ])"##;
    let room = r#"Scene(background: 1, materials: { "clay": Mirror() }, objects: [
        Sphere(center: (0, 0, 0), radius: 1, material: "clay"), Include(file: "cup.ron"),
    ])"#;
    let folder = folder("solids", &[("cup.ron", cup), ("room.ron", room)]);
    let scene = load(&folder.join("room.ron")).expect("it is right").scene;
    let inner = &scene.objects[1].value.operands().expect("a solid").0[1].value.operands().expect("a solid").0[0];
    let MaterialRef::Named { name, .. } = inner.value.material() else { panic!("a name") };
    let named = scene.materials.iter().find(|named| named.name.value == *name).expect("a material of this name");
    assert!(matches!(named.material, Material::Diffuse(_)), "{name}: {:?}", named.material);
}

#[test]
fn names_of_the_file_itself_win_and_of_two_files_those_of_the_later() {
    let text = r#"Scene(
        include: ["a.ron", "b.ron"],
        background: 1,
        vars: { "own": 3 },
        objects: [Box(center: "=(own, both, twice)", material: "m"), Box(material: "n")],
        materials: { "n": Diffuse(albedo: 0.75) },
    )"#;
    let a = r#"Scene(vars: { "own": 1, "both": 1, "twice": "=2*own" }, materials: { "m": Mirror(), "n": Mirror() })"#;
    let b = r#"Scene(vars: { "both": 2 }, materials: { "m": Diffuse(albedo: 0.5) })"#;
    let folder = folder("wins", &[("s.ron", text), ("a.ron", a), ("b.ron", b)]);
    let loaded = load(&folder.join("s.ron")).expect("a scene");
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    assert!(matches!(&loaded.scene.objects[0].value, Object::Box(cuboid) if cuboid.center.value == [3.0, 2.0, 6.0]));
    assert_eq!(albedo(&loaded, 0), Albedo::Color([0.5; 3].into()));
    assert_eq!(albedo(&loaded, 1), Albedo::Color([0.75; 3].into()));
    // The same by --set, and in TOML.
    let without = text.replace("include: [\"a.ron\", \"b.ron\"],", "");
    std::fs::write(folder.join("t.ron"), without).expect("a file");
    let set = load_with(&folder.join("t.ron"), &[Override::from("include=[\"a.ron\", \"b.ron\"]")]).expect("a scene");
    assert_eq!(hash_hex(&set.scene), hash_hex(&loaded.scene));
    let toml = convert("s", text, Syntax::Ron, Syntax::Toml).expect("what is included need not be there");
    assert!(toml.contains("include = [\"a.ron\", \"b.ron\"]"), "{toml}");
    std::fs::write(folder.join("s.toml"), toml).expect("a file");
    assert_eq!(hash_hex(&load(&folder.join("s.toml")).expect("a scene").scene), hash_hex(&loaded.scene));
}

#[test]
fn a_fault_in_an_included_file_says_the_way_there_and_the_files_are_known() {
    let text = "Scene(background: 1, objects: [Include(file: \"scenes/chair.ron\", vars: { \"height\": true })])";
    let Err(LoadError::Invalid { diagnostics, sources, files, .. }) = room("faults", text) else {
        panic!("a truth value")
    };
    assert!(diagnostics.iter().all(|fault| sources[fault.span.source as usize].name.ends_with("chair.ron")));
    assert!(diagnostics[0].labels.iter().any(|label| label.span.source == 0), "{:?}", diagnostics[0]);
    let scenes: Vec<&Path> = files.iter().filter(|file| file.kind == FileKind::Scene).map(|file| &*file.path).collect();
    assert_eq!(scenes, [Path::new("scenes/chair.ron"), Path::new("scenes/parts/wood.toml")]);
    assert_eq!(codes(room("folder", "Scene(background: 1, include: [\"scenes\"], objects: [Box()])")), ["E0560"]);
}

#[test]
fn circles_depth_and_number_are_bounded() {
    let chain = |k: usize, last: usize| {
        if k < last { format!("Scene(include: [\"{}.ron\"])", k + 1) } else { "Scene()".into() }
    };
    for (name, last, wanted) in [("eight", 8, vec![]), ("nine", 9, vec!["E0606".to_owned()])] {
        let texts: Vec<(String, String)> = (1..=last).map(|k| (format!("{k}.ron"), chain(k, last))).collect();
        let mut files: Vec<(&str, &str)> = texts.iter().map(|(file, text)| (file.as_str(), text.as_str())).collect();
        files.push(("s.ron", "Scene(include: [\"1.ron\"], background: 1, objects: [Box()])"));
        assert_eq!(codes(load(&folder(name, &files).join("s.ron"))), wanted, "{name}");
    }
    let names: Vec<String> = (0..300).map(|k| format!("\"{k}.ron\"")).collect();
    let many = format!("Scene(include: [{}], background: 1, objects: [Box()])", names.join(", "));
    let texts: Vec<(String, &str)> = (0..300).map(|k| (format!("{k}.ron"), "Scene()")).collect();
    let mut files: Vec<(&str, &str)> = texts.iter().map(|(file, text)| (file.as_str(), *text)).collect();
    files.push(("s.ron", &many));
    let found = codes(load(&folder("many", &files).join("s.ron")));
    assert!(!found.is_empty() && found.iter().all(|code| code == "E0606"), "{found:?}");
    let own = "Scene(background: 1, objects: [Include(file: \"s.ron\")])";
    assert_eq!(codes(load(&folder("own", &[("s.ron", own)]).join("s.ron"))), ["E0407"]);
}

#[test]
fn scenes_in_scenes_in_scenes_end_soon() {
    // Each includes the next thirty times: 30^7 boxes.
    let texts: Vec<(String, String)> = (0..8)
        .map(|k| {
            let next = format!("Include(file: \"{}.ron\")", k + 1);
            let item = if k < 7 { next } else { "Box()".to_owned() };
            (format!("{k}.ron"), format!("Scene(background: 1, objects: [Repeat(count: 30, items: [{item}])])"))
        })
        .collect();
    let files: Vec<(&str, &str)> = texts.iter().map(|(file, text)| (file.as_str(), text.as_str())).collect();
    let start = Instant::now();
    assert_eq!(codes(load(&folder("laughs", &files).join("0.ron"))), ["E0606"]);
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
}

/// One file without the list around it: one error, and the edit mends it; the names that it would have brought are not
/// missed.
#[test]
fn a_file_without_its_list_is_one_error() {
    for (name, syntax, text) in [
        (
            "a.ron",
            Syntax::Ron,
            r#"Scene(background: 1, include: "wood.toml",
                objects: [Sphere(center: (0, 0, 0), radius: "=shade", material: "wood")])"#,
        ),
        (
            "a.toml",
            Syntax::Toml,
            "background = 1\ninclude = \"wood.toml\"\n[[objects]]\nSphere = { center = [0, 0, 0], radius = \"=shade\", \
             material = \"wood\" }\n",
        ),
    ] {
        let wood = "[vars]\nshade = 0.25\n[materials]\nwood = { Mirror = {} }\n";
        let folder = folder("without_list", &[("wood.toml", wood), (name, text)]);
        let Err(LoadError::Invalid { diagnostics, .. }) = load(&folder.join(name)) else { panic!("{name} is wrong") };
        let [fault] = diagnostics.as_slice() else { panic!("{}: {diagnostics:#?}", syntax.name()) };
        let edit = fault.edit.as_ref().expect("an edit");
        let (start, end) = (edit.span.start as usize, edit.span.end as usize);
        let mended = format!("{}{}{}", &text[..start], edit.replacement, &text[end..]);
        std::fs::write(folder.join(name), mended).expect("written");
        assert!(load(&folder.join(name)).is_ok(), "{}", syntax.name());
    }
}

/// What a library with objects would have brought is not missed besides.
#[test]
fn a_library_with_objects_is_one_mistake() {
    let library = r#"Scene(vars: {"r": 2}, materials: {"m": Mirror()}, cameras: {"c": Camera()},
        objects: [Sphere(center: (0, 0, 0), radius: 1)])"#;
    let text = r#"Scene(background: 1, include: ["library.ron"], camera: "c",
        objects: [Sphere(center: (0, 0, 0), radius: "=r", material: "m")])"#;
    let folder = folder("library_with_objects", &[("library.ron", library), ("s.ron", text)]);
    assert_eq!(codes(load(&folder.join("s.ron"))), ["E0560"]);
}

/// More files than can be included are so by one fault.
#[test]
fn too_many_files_are_told_once() {
    let names: Vec<String> = (0..300).map(|k| format!("\"none{k}.ron\"")).collect();
    let text = format!("Scene(include: [{}], background: 1, objects: [Box()])", names.join(", "));
    let folder = folder("many", &[("many.ron", &text)]);
    let Err(LoadError::Invalid { diagnostics, .. }) = load(&folder.join("many.ron")) else { panic!("is wrong") };
    let too_many = diagnostics.iter().filter(|fault| fault.code == "E0606").count();
    assert_eq!(too_many, 1, "{diagnostics:#?}");
}

/// Files are found wherever their names may come from, and what is wrong is told once.
#[test]
fn files_that_are_picked_repeated_and_set() {
    let part = "Scene(objects: [Box(center: (0, 1, 0)), Box()])";
    let files = |room: &'static str| {
        [("a.ron", part), ("b.ron", "Scene(objects: [Box()])"), ("c.ron", "Scene(vars: {})"), ("room.ron", room)]
    };
    let objects = |name: &str, room: &'static str, set: &[&str]| {
        let folder = folder(name, &files(room));
        let set: Vec<Override> = set.iter().map(|set| Override::from(*set)).collect();
        load_with(&folder.join("room.ron"), &set).map(|loaded| loaded.scene.objects.len())
    };
    let picked = "Scene(background: 1, objects: [Include(file: Pick(from: [\"a.ron\", \"b.ron\"], index: 1))])";
    assert_eq!(objects("picked", picked, &[]).expect("a scene"), 1);
    let repeated = "Scene(background: 1, include: [Repeat(count: 1, items: [\"c.ron\"])], objects: [Box()])";
    assert_eq!(objects("repeated", repeated, &[]).expect("a scene"), 1);
    let set = "Scene(background: 1, objects: [Include(file: \"b.ron\", name: \"part\")])";
    assert_eq!(objects("set", set, &["objects.part.file=\"a.ron\""]).expect("a scene"), 2);
    let faults = |name: &str, room: &'static str| match objects(name, room, &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => diagnostics,
        other => panic!("{other:?}"),
    };
    let wrong = faults("wrong", "Scene(background: 1, includes: [\"a.ron\"], objects: [Box()])");
    assert!(wrong.len() == 1 && wrong[0].hint.contains("include"), "{wrong:?}");
    let mesh = faults("mesh", "Scene(background: 1, objects: [Include(file: \"chair.OBJ\")])");
    assert!(mesh.len() == 1 && mesh[0].message.contains("it is a mesh"), "{mesh:?}");
}
