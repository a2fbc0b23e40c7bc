//! `format`: scenes as everybody's looks, with what a person put beside the words.

mod common;

use common::{FULL_JSON, FULL_RON, FULL_TOML};
use scene_format::{Syntax, convert, examples, format, hash_hex, load_str};
use std::path::Path;

const MESSY_RON: &str = "\
// Head



Scene(  background:1, // sky


    objects: [

        // a ball

        // on the floor
        Sphere(center:(0,0,0),
          radius: 1),


        Sphere(center: (0, -1000, 0), radius: 999),
    ],
)


// End

";

const TIDY_RON: &str = "\
// Head

Scene(
    background: 1, // sky

    objects: [
        // a ball

        // on the floor
        Sphere(center: (0, 0, 0), radius: 1),

        Sphere(center: (0, -1000, 0), radius: 999),
    ],
)

// End
";

const MESSY_TOML: &str = "\
# Head



background = 1   # sky


# much light
effects = {exposure=1}
[camera]

position = [0,0,5]


fov = 40
[[objects]]
# a ball
Sphere = {center=[0,0,0],radius=1}



";

const MESSY_JSON: &str = r##"
{"$schema":"scene.schema.json", "background":1,


    "camera":{"fov":4e1,
    "look_at":[0,0,0]}, "render": { "clamp": null, "noise": "None" },
    "objects":[
        {"Sphere":{"center":[0,0,0], "radius":1.50, "name": "b", "material": {"Diffuse":{"albedo":"#808080"}}}},

        {"Box":{"size": 1}}]}"##;

const TIDY_JSON: &str = r##"{
    "$schema": "scene.schema.json",
    "background": 1,

    "camera": { "fov": 4e1, "look_at": [0, 0, 0] },
    "render": { "clamp": null, "noise": "None" },
    "objects": [
        { "Sphere": {
            "center": [0, 0, 0],
            "radius": 1.50,
            "name": "b",
            "material": { "Diffuse": { "albedo": "#808080" } }
        } },

        { "Box": { "size": 1 } }
    ]
}
"##;

#[test]
fn messy_scenes_become_tidy() {
    assert_eq!(format("messy.ron", MESSY_RON, Syntax::Ron).expect("right"), TIDY_RON);
    let tidy = format("messy.toml", MESSY_TOML, Syntax::Toml).expect("right");
    let lines =
        ["# Head\n\nbackground = 1 # sky\n", "position = [0, 0, 5]\n\nfov = 40\n", "# a ball\ncenter = [0, 0, 0]\n"];
    for line in lines {
        assert!(tidy.contains(line), "{line:?} is not in\n{tidy}");
    }
    assert!(!tidy.contains("\n\n\n") && tidy.ends_with("radius = 1\n"), "{tidy}");
    assert_eq!(format("messy.json", MESSY_JSON, Syntax::Json).expect("right"), TIDY_JSON);
}

#[test]
fn a_tidy_scene_says_the_same_and_stays_as_it_is() {
    let mut texts = vec![
        (MESSY_RON.to_owned(), Syntax::Ron),
        (MESSY_TOML.to_owned(), Syntax::Toml),
        (FULL_RON.to_owned(), Syntax::Ron),
        (FULL_TOML.to_owned(), Syntax::Toml),
        (FULL_JSON.to_owned(), Syntax::Json),
        (MESSY_JSON.to_owned(), Syntax::Json),
    ];
    for example in examples() {
        let toml = convert("example", &example.ron, Syntax::Ron, Syntax::Toml).expect("right");
        let json = convert("example", &example.ron, Syntax::Ron, Syntax::Json).expect("right");
        texts.extend([(example.ron, Syntax::Ron), (toml, Syntax::Toml), (json, Syntax::Json)]);
    }
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes"));
    for folder in [folder.to_owned(), folder.join("gallery")] {
        for entry in std::fs::read_dir(folder).expect("scenes") {
            let path = entry.expect("a file").path();
            let Some(syntax) = Syntax::from_path(&path) else { continue };
            let text = std::fs::read_to_string(&path).expect("text");
            let comments = |text: &str| text.lines().filter(|line| line.contains("// ")).count();
            if syntax == Syntax::Ron {
                let tidy = format("scene", &text, syntax).expect("right");
                assert_eq!(comments(&tidy), comments(&text), "{tidy}");
            }
            texts.push((text, syntax));
        }
    }
    let hash =
        |text: &str, syntax| hash_hex(&load_str("s", text, syntax, common::base_dir(), &[]).expect("right").scene);
    for (text, syntax) in texts {
        let tidy = format("scene", &text, syntax).expect("right");
        assert_eq!(hash(&tidy, syntax), hash(&text, syntax), "{tidy}");
        assert_eq!(format("scene", &tidy, syntax).expect("right"), tidy, "{text}");
    }
}

/// What somebody has given a line for each entry stays so, for the next one to be added; what `tracer new` makes is
/// laid out as everybody's.
#[test]
fn entries_on_lines_of_their_own_keep_them() {
    let head = "Scene(\n    version: 1,\n    background: 1,\n";
    for (written, laid_out) in [
        (
            "    objects: [\n  Sphere(center: (0, 0, 0),\n radius: 1) ],\n)\n",
            "    objects: [\n        Sphere(center: (0, 0, 0), radius: 1),\n    ],\n)\n",
        ),
        (
            "    objects: [Sphere(\n center: (0, 0, 0), radius: 1)])",
            "    objects: [\n        Sphere(\n            center: (0, 0, 0),\n            radius: 1,\n        ),\n\
             \x20   ],\n)\n",
        ),
        (
            "    objects: [Sphere(center: (0, 0, 0),\n radius: 1)])",
            "    objects: [Sphere(center: (0, 0, 0), radius: 1)],\n)\n",
        ),
    ] {
        let tidy = format("scene", &format!("{head}{written}"), Syntax::Ron).expect("right");
        assert_eq!(tidy, format!("{head}{laid_out}"));
        assert_eq!(format("scene", &tidy, Syntax::Ron).expect("right"), tidy);
    }
    let templates = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../tracer/templates"));
    for entry in std::fs::read_dir(templates).expect("templates") {
        let text = std::fs::read_to_string(entry.expect("a file").path()).expect("text");
        assert_eq!(format("scene", &text, Syntax::Ron).expect("right"), text);
    }
}

/// Lists of vars stay lists, whatever is in them, and comments in them stay where they are; from syntax to syntax, too.
#[test]
fn lists_of_vars_stay_lists() {
    let of = |list: &str| {
        let objects = "[Box(size: \"=1 + 0 * len(h)\")]";
        format!("Scene(background: 1, vars: {{ \"h\": {list} }}, objects: {objects})")
    };
    let load =
        |text: &str, syntax| load_str("s", text, syntax, Path::new(""), &[]).map(|loaded| hash_hex(&loaded.scene));
    for list in [
        "[]",
        "[1]",
        "[0.2, 0.5]",
        "[0.2, 0.5, 0.3]",
        "[0.2, 0.5, 0.3, 0.9]",
        "[\"#ff0000\"]",
        "[\"#ff0000\", \"#00ff00\"]",
        "[true, false]",
        "[(0, 0, 0)]",
        "[(0, 0), (1, 2)]",
        "[(0, 0, 0), (1, 2, 3), (4, 5, 6), (7, 8, 9)]",
        "[\"=2\", 1, 2, 3]",
    ] {
        let text = of(list);
        let before = load(&text, Syntax::Ron).unwrap_or_else(|error| panic!("{list}: {error:?}"));
        let tidy = format("s", &text, Syntax::Ron).expect("right");
        assert!(tidy.contains(&format!("vars: {{ \"h\": {list} }}")), "{list} became\n{tidy}");
        assert_eq!(load(&tidy, Syntax::Ron).ok().as_ref(), Some(&before), "{tidy}");
        for syntax in [Syntax::Toml, Syntax::Json] {
            let there = convert("s", &text, Syntax::Ron, syntax).expect("right");
            assert_eq!(load(&there, syntax).ok().as_ref(), Some(&before), "{there}");
            let back = convert("s", &there, syntax, Syntax::Ron).expect("right");
            assert_eq!(load(&back, Syntax::Ron).ok().as_ref(), Some(&before), "{back}");
        }
    }
    let tidy = format("s", &of("[\n  1, // one\n  // two\n  2, 3, 4]"), Syntax::Ron).expect("right");
    let [one, two, h] = ["// one", "// two", "objects"].map(|text| tidy.find(text).expect("it stays"));
    assert!(one < two && two < h && tidy[one..].starts_with("// one\n"), "{tidy}");
}

/// A comment behind the last line of a TOML table is that table's, not the next one's.
#[test]
fn comments_stay_with_their_table() {
    let text = "background = 1\n\n[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 } # red\n\n[[objects]]\n\
                Sphere = { center = [2, 0, 0], radius = 1 } # blue\n\n[[lights]]\n\
                SphereLight = { center = [0, 9, 0], radius = 1, radiance = 9 } # key\n";
    let tidy = format("s.toml", text, Syntax::Toml).expect("right");
    let place = |text: &str| tidy.find(text).expect("it stays");
    let objects: Vec<usize> = tidy.match_indices("[[objects]]").map(|(at, _)| at).collect();
    assert!(place("# red") < objects[1] && objects[1] < place("# blue"), "{tidy}");
    assert!(place("# blue") < place("[[lights]]") && place("# key") > place("[[lights]]"), "{tidy}");
    assert_eq!(format("s.toml", &tidy, Syntax::Toml).expect("right"), tidy);
}

/// What somebody has commented out at the end of a list, a map, an object or the scene stays within its brackets: it
/// can be taken in again there.
#[test]
fn comments_stay_within_their_brackets() {
    let text = "Scene(\n    background: 1,\n    materials: {\n        \"a\": Diffuse(albedo: 0.5),\n        // \"b\": \
                Mirror(),\n    },\n    objects: [\n        Sphere(\n            center: (0, 0, 0),\n            \
                radius: 1,\n            // material: \"a\",\n        ),\n        // Sphere(center: (2, 0, 0), \
                radius: 1),\n    ],\n    // lights: [],\n)\n";
    assert_eq!(format("s.ron", text, Syntax::Ron).expect("right"), text);
    let taken_in = format("s.ron", &text.replace("// ", ""), Syntax::Ron).expect("it can be taken in");
    assert_eq!(taken_in.matches("Sphere(").count(), 2, "{taken_in}");
    // In an empty list, too.
    let empty = text.replace("    background: 1,\n", "    background: 1,\n    cameras: {\n        // none\n    },\n");
    assert_eq!(format("s.ron", &empty, Syntax::Ron).expect("right"), empty);
    let toml = convert("s.ron", text, Syntax::Ron, Syntax::Toml).expect("right");
    let place = |text: &str| toml.find(text).unwrap_or_else(|| panic!("{text} is lost: {toml}"));
    assert!(place("# \"b\"") > place("[materials]") && place("# \"b\"") < place("[[objects]]"), "{toml}");
    assert!(place("# Sphere(") > place("[[objects]]") && place("# lights") > place("# Sphere("), "{toml}");
    let tidy = format("s.toml", &toml, Syntax::Toml).expect("right");
    assert_eq!(tidy.matches('#').count(), 4, "{tidy}");
    assert_eq!(format("s.toml", &tidy, Syntax::Toml).expect("right"), tidy);
    let json = convert("s.ron", text, Syntax::Ron, Syntax::Json).expect("right");
    assert!(!json.contains("lights") && load_str("s", &json, Syntax::Json, Path::new(""), &[]).is_ok(), "{json}");
    // Of a list of a TOML file that takes several lines.
    let list = "background = 1\n\n[vars]\nway = [\n    [0, 0, 0],\n    [1, 0, 0],\n    # [2, 0, 0],\n]\n\n[[objects]]\n\
                Sphere = { center = \"=way[1]\", radius = 1 }\n";
    assert_eq!(format("s.toml", list, Syntax::Toml).expect("right"), list);
}

/// What is wrong with values and names is laid out whole: nothing of the text is lost but blanks, commas, signs,
/// and how comments are marked.
#[test]
fn nothing_of_a_wrong_scene_is_lost() {
    let letters = |text: &str| {
        let mut letters: Vec<char> =
            text.chars().filter(|c| !c.is_whitespace() && !",+*/\u{feff}".contains(*c)).collect();
        letters.sort_unstable();
        letters
    };
    let mut laid_out = 0;
    for (folder, syntax) in [("ron", Syntax::Ron), ("json", Syntax::Json)] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken").join(folder);
        for entry in std::fs::read_dir(folder).expect("broken scenes") {
            let path = entry.expect("a file").path();
            let Some(text) = Syntax::from_path(&path).and_then(|_| std::fs::read_to_string(&path).ok()) else {
                continue;
            };
            if let Ok(tidy) = format("s", &text, syntax) {
                assert_eq!(letters(&tidy), letters(&text), "{}:\n{tidy}", path.display());
                laid_out += 1;
            }
        }
    }
    assert!(laid_out > 20, "{laid_out}");
}

#[test]
fn a_wrong_scene_is_not_touched() {
    assert!(format("s.ron", "Scene(objects: [Sphere(radus: 1)])", Syntax::Ron).is_err());
    // What is missing does not stand in the way of what is there.
    let begun = format("s.ron", "Scene(objects: [Sphere(radius:1)])", Syntax::Ron).expect("it is laid out");
    assert_eq!(begun, "Scene(\n    objects: [Sphere(radius: 1)],\n)\n");
}

/// Comments within numbers that stand on one line move up before it; nothing that stands behind goes along.
#[test]
fn comments_within_numbers_stay_with_their_field() {
    let toml = "[[objects]]\n[objects.Sphere]\ncenter = [0, 0, # across\n  0] # after\nradius = 1 # r\n";
    let tidy = "[[objects]]\n[objects.Sphere]\n# across\ncenter = [0, 0, 0] # after\nradius = 1 # r\n";
    let text = |objects: &str| format!("background = [0.5, # red\n  0.6, # green\n  0.7] # blue\n\n{objects}");
    let laid_out = format!("# red\n# green\n\nbackground = [0.5, 0.6, 0.7] # blue\n\n{tidy}");
    assert_eq!(format("a.toml", &text(toml), Syntax::Toml).expect("it is right"), laid_out);
    assert_eq!(format("a.toml", &laid_out, Syntax::Toml).expect("it is right"), laid_out);
    let ron = "\
Scene(
    // red
    // green
    background: (0.5, 0.6, 0.7), // blue
    objects: [
        Sphere(
            // across
            center: (0, 0, 0), // after
            radius: 1, // r
        ),
    ],
)
";
    assert_eq!(convert("a.toml", &text(toml), Syntax::Toml, Syntax::Ron).expect("it is right"), ron);
    let within = "Scene(background: (0.5, /* green */ 0.6, 0.7), objects: [Sphere(center: (0, 0, 0), radius: 1)])";
    let tidy = "Scene(\n    // green\n    background: (0.5, 0.6, 0.7),\n    \
                objects: [Sphere(center: (0, 0, 0), radius: 1)],\n)\n";
    assert_eq!(format("a.ron", within, Syntax::Ron).expect("it is right"), tidy);
}

/// Lines end as they did, and a byte order mark stays; whoever converts gets neither.
#[test]
fn ends_of_lines_stay() {
    let of_windows = |text: &str| text.replace('\n', "\r\n");
    let messy = of_windows(MESSY_RON);
    let tidy = format("s.ron", &messy, Syntax::Ron).expect("it is right");
    assert_eq!(tidy, of_windows(&format("s.ron", MESSY_RON, Syntax::Ron).expect("it is right")));
    assert_eq!(format("s.ron", &tidy, Syntax::Ron).expect("it is right"), tidy);
    let marked = format!("\u{feff}{messy}");
    assert_eq!(format("s.ron", &marked, Syntax::Ron).expect("it is right"), format!("\u{feff}{tidy}"));
    let toml = convert("s.ron", &marked, Syntax::Ron, Syntax::Toml).expect("it is right");
    assert!(!toml.contains(['\r', '\u{feff}']), "{toml:?}");
    assert_eq!(toml, convert("s.ron", MESSY_RON, Syntax::Ron, Syntax::Toml).expect("it is right"));
}

/// What does not fit on a line: fields on two lines, else a list as the last of them behind their bracket, else a field
/// a line; entries that shared lines fill them.
#[test]
fn what_does_not_fit_on_a_line_is_laid_out_in_few() {
    let laid_out = r##"Scene(
    background: 1,
    materials: {
        "white": Diffuse(albedo: 0.73), "red": Diffuse(albedo: (0.61, 0.05, 0.05)),
        "green": Diffuse(albedo: (0.12, 0.42, 0.1)), "lamp": Emissive(radiance: (17, 12, 4)),
    },
    objects: [
        Box(center: (-0.35, 0.6, -0.3), size: (0.6, 1.2, 0.6), material: "white",
            transform: [Rotate(axis: (0, 1, 0), degrees: 18)]),
        Group(name: "table", material: "white", placements: Grid(count: (2, 1, 2), spacing: (1, 1, 1)), objects: [
            Box(center: (0, 0.74, 0), size: (1.1, 0.04, 1.1)),
            Sphere(center: (0, 0, 0), radius: 1),
        ]),
        Sphere(
            center: (0, 0, 0),
            radius: 1,
            material: BlinnPhong(albedo: (0.5, 0.5, 0.5), specular: 0.25, exponent: 1000, note),
            camera_visible: true,
            name: "one that is named at great length, for it has to be long",
        ),
        Lathe(
            profile: [
                (0, 0.01), (0.55, 0.01), (0.55, 0.04), (0.2, 0.09), (0.07, 0.2), (0.05, 0.35), (0.05, 0.5),
                (0.05, 0.65), (0.07, 0.85), (0.2, 1),
            ],
            curve: CatmullRom,
        ),
    ],
)
"##
    .replace(", note", ", energy_conserving: true");
    assert_eq!(format("scene", &laid_out, Syntax::Ron).expect("right"), laid_out);
    // However the lines were broken, where no bracket stood alone at its line's end.
    let one_line = laid_out.replace("material: \"white\",\n            transform", "material: \"white\", transform");
    assert_ne!(one_line, laid_out);
    assert_eq!(format("scene", &one_line, Syntax::Ron).expect("right"), laid_out);
}

/// What is said behind an object of TOML stays behind it.
#[test]
fn comments_behind_a_line_of_toml_stay_there() {
    let text = "background = 1\n\n[[objects]]\nBox = { size = 1 } # a box\n\n[[objects]]\nBox = { size = 2 }\n";
    assert_eq!(format("scene", text, Syntax::Toml).expect("right"), text);
}

/// The scenes that come with the program are laid out as it lays them out.
#[test]
fn all_our_scenes_are_laid_out() {
    let mut folders = vec![Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes")).to_owned()];
    let mut seen = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("scenes") {
            let path = entry.expect("a file").path();
            if path.is_dir() {
                folders.push(path);
            } else if let Some(syntax) = Syntax::from_path(&path) {
                let text = std::fs::read_to_string(&path).expect("text");
                let name = path.display().to_string();
                assert_eq!(format(&name, &text, syntax).expect("right"), text, "{name}");
                seen += 1;
            }
        }
    }
    assert!(seen > 50, "{seen}");
}
