//! Cursors are written as `|` in the texts.

use super::*;
use crate::diagnostic::Edit;
use crate::files::FileKind;
use crate::render::apply_edits;
use crate::syntax::Syntax::{Json, Ron, Toml};
use crate::{Syntax, examples, load_str};
use std::path::Path;

/// A text and where its cursor stands.
fn cursor(text: &str) -> (String, usize) {
    (text.replacen('|', "", 1), text.find('|').expect("a cursor"))
}

fn labels(text: &str, syntax: Syntax) -> Vec<String> {
    let (text, at) = cursor(text);
    complete(&text, syntax, at).items.into_iter().map(|item| item.label).collect()
}

fn offers(text: &str, syntax: Syntax, wanted: &[&str], unwanted: &[&str]) {
    let labels = labels(text, syntax);
    for word in wanted {
        assert!(labels.iter().any(|label| label == word), "{word} is not offered: {labels:?}\n{text}");
    }
    for word in unwanted {
        assert!(!labels.iter().any(|label| label == word), "{word} is offered: {labels:?}\n{text}");
    }
}

#[test]
fn fields_are_offered_where_their_names_stand() {
    offers("Scene(ba|", Ron, &["background", "camera", "objects"], &["radius", "Sphere"]);
    offers("Scene(background: 1, |)", Ron, &["camera"], &["background"]);
    offers("Scene(objects: [Sphere(center: (0, 0, 0), |", Ron, &["radius", "material"], &["center", "fov"]);
    offers("Scene(objects: [Sphere(radius: 1), Box(size: 1, ma|", Ron, &["material", "center"], &["size", "radius"]);
    offers("Scene(camera: Camera(fov: 4, |), objects: [", Ron, &["position"], &["fov"]);
    offers("Scene(materials: { \"a\": Diffuse(|", Ron, &["albedo"], &["ior"]);
    offers("Scene(effects: (|", Ron, &["exposure"], &[]);
    offers("Scene(objects: [Repeat(count: 3, items: [Sphere(|", Ron, &["radius"], &["count"]);
    offers("[[objects]]\nRepeat = { count = 2, |", Toml, &["items"], &["count"]);
    offers("[[objects.Repeat.items]]\n|", Toml, &["Sphere"], &["count"]);
    offers("Scene(objects: [Repeat(|", Ron, &["count", "items", "vars"], &["radius"]);
    offers("// a ( [ {\n/* \"( */ Scene(|", Ron, &["camera"], &[]);
    offers("|", Toml, &["camera", "background", "objects"], &["radius"]);
    offers("background = 1\n[camera]\nfov = 40\n|", Toml, &["position"], &["fov", "background"]);
    offers("[[objects]]\n|", Toml, &["Sphere", "Mesh"], &["radius"]);
    offers("[[objects]]\nSphere = { center = [0, 0, 0], |", Toml, &["radius"], &["center"]);
    offers("[objects.Sphere]\nra|", Toml, &["radius"], &[]);
    offers("[materials]\nred = { Diffuse = { |", Toml, &["albedo"], &[]);
    offers("[materials.red.Diffuse]\n|", Toml, &["albedo"], &[]);
    offers("[cam|", Toml, &["camera"], &["fov"]);
    offers("effects.|", Toml, &["exposure"], &[]);
    offers("{ |", Json, &["camera", "objects"], &["radius"]);
    offers("{ \"background\": 1, \"cam|\" }", Json, &["camera"], &["background"]);
    offers("{ \"objects\": [{ |", Json, &["Sphere"], &["radius"]);
    offers("{ \"objects\": [{ \"Sphere\": { \"center\": [0, 0, 0], \"|", Json, &["radius"], &["center", "fov"]);
    offers("{ \"objects\": [{ \"Repeat\": { \"count\": 2, \"items\": [{ \"Box\": { |", Json, &["size"], &["count"]);
    offers("{ \"materials\": { \"red\": { \"Diffuse\": { |", Json, &["albedo"], &["ior"]);
}

#[test]
fn what_is_offered_in_json_has_its_quotes_once() {
    let snippet = |text: &str, label: &str| {
        let (text, at) = cursor(text);
        let found = complete(&text, Json, at);
        let item = found.items.iter().find(|item| item.label == label).unwrap_or_else(|| panic!("{label} in {text}"));
        format!("{}{}{}", &text[..found.range.start], item.snippet, &text[found.range.end..])
    };
    assert_eq!(snippet("{ ima|", "image"), "{ \"image\": $0");
    assert_eq!(snippet("{ \"ima|", "image"), "{ \"image\": $0");
    assert_eq!(snippet("{ \"ima|\" }", "image"), "{ \"image\" }");
    assert_eq!(snippet("{ \"objects\": [{ \"Bo|\" }", "Box"), "{ \"objects\": [{ \"Box\" }");
    assert_eq!(snippet("{ \"objects\": [|", "Mesh"), "{ \"objects\": [{ \"Mesh\": { $0 } }");
}

/// A header of TOML is names alone: no `=` and no brackets come with them.
#[test]
fn names_alone_are_offered_in_headers() {
    let written = |text: &str, label: &str| {
        let (text, at) = cursor(text);
        let found = complete(&text, Toml, at);
        let item = found.items.iter().find(|item| item.label == label).unwrap_or_else(|| panic!("{label} in {text}"));
        format!("{}{}{}", &text[..found.range.start], item.snippet, &text[found.range.end..])
    };
    for (text, label, whole) in [
        ("[ren|]", "render", "[render]"),
        ("[ren|", "render", "[render"),
        ("[[li|]]", "lights", "[[lights]]"),
        ("[objects.|]", "Sphere", "[objects.Sphere]"),
        ("[[objects]]\n[objects.Sph|]", "Sphere", "[[objects]]\n[objects.Sphere]"),
        ("[materials.red.|]", "Diffuse", "[materials.red.Diffuse]"),
        ("[[objects.Repeat.it|]]", "items", "[[objects.Repeat.items]]"),
        ("[ effects . ant|]", "antialiasing", "[ effects . antialiasing]"),
    ] {
        assert_eq!(written(text, label), whole);
    }
    // What is no table has no header.
    offers("[|]", Toml, &["camera", "vars", "materials"], &["version"]);
    offers("[camera.|]", Toml, &[], &["fov", "position"]);
    offers("[\"|\"]", Toml, &[], &["camera"]);
    // Every name there is one.
    for text in ["[|]", "[objects.|]", "[objects.Mesh.|]", "[lights.|]", "[materials.a.|]", "[effects.|]"] {
        let (text, at) = cursor(text);
        for item in complete(&text, Toml, at).items {
            assert_eq!(item.snippet, item.label, "{text}");
        }
    }
    // Behind it all is as it was.
    offers("[camera]\nfo|", Toml, &["fov"], &[]);
}

#[test]
fn values_are_offered_where_values_stand() {
    offers("Scene(objects: [|", Ron, &["Sphere", "Mesh", "Repeat"], &["Diffuse", "center"]);
    offers("Scene(objects: [Sphere(material: |", Ron, &["Diffuse", "Mirror"], &["Sphere"]);
    offers("Scene(materials: { \"red\": |", Ron, &["Diffuse"], &["red"]);
    offers("Scene(materials: { \"red\": Mirror() }, objects: [Sphere(material: \"|\")])", Ron, &["red"], &["Diffuse"]);
    offers("Scene(effects: Effects(tone_map: |", Ron, &["Filmic", "None"], &[]);
    offers("Scene(objects: [Box(transform: [|", Ron, &["Rotate", "Translate"], &["Sphere"]);
    offers("Scene(vars: { \"high\": 2 }, objects: [Sphere(radius: \"=h|\")])", Ron, &["high", "sin"], &["Sphere"]);
    offers(
        "Scene(materials: { \"a\": Diffuse(albedo: |",
        Ron,
        &["Texture", "Checkerboard", "(0.8, 0.8, 0.8)"],
        &["Diffuse"],
    );
    offers("{ \"effects\": { \"tone_map\": |", Json, &["Filmic"], &[]);
    offers("{ \"effects\": { \"tone_map\": \"|", Json, &["Filmic"], &[]);
    offers("{ \"render\": { \"clamp\": |", Json, &["null"], &["None"]);
    offers(
        "{ \"materials\": { \"a\": { \"Mirror\": {} } }, \"objects\": [{ \"Box\": { \"material\": \"|\"",
        Json,
        &["a"],
        &["Mirror"],
    );
    offers("{ \"objects\": [|", Json, &["Sphere", "Repeat"], &["Diffuse"]);
    offers("[effects]\ntone_map = |", Toml, &["Filmic"], &[]);
    offers("[effects]\ntone_map = \"|", Toml, &["Filmic"], &[]);
    offers("[materials]\nred = |", Toml, &["Diffuse"], &["red"]);
    offers("[materials]\nred = \"Mirror\"\n[[objects]]\nSphere = { material = \"|", Toml, &["red"], &[]);
    offers("objects = [{ |", Toml, &["Sphere", "Repeat"], &[]);
    offers("objects = [|", Toml, &["Sphere", "Repeat"], &[]);
    offers("[[objects]]\n|", Toml, &["Sphere", "Repeat", "Pick"], &[]);
    offers("{ \"objects\": [{ \"|\"", Json, &["Sphere", "Repeat", "Pick"], &[]);
    offers("Scene(objects: [Sphere(material: |", Ron, &["Pick"], &["Repeat"]);
    let (text, at) = cursor("Scene(objects: [Box(transform: [|])])");
    let proposals = complete(&text, Ron, at).items;
    let translate = proposals.iter().find(|item| item.label == "Translate").map(|item| item.snippet.as_str());
    assert_eq!(translate, Some("Translate(($0))"));
    assert!(labels("Scene( // |", Ron).is_empty() && labels("# |", Toml).is_empty());
    let (text, at) = cursor("Scene(objects: [Mesh(file: \"assets/c|\")])");
    assert_eq!(complete(&text, Ron, at).files, Some((FileKind::Mesh, "assets/c".to_owned())));
}

/// What is proposed for a kind loads, once its places are filled in.
#[test]
fn proposals_are_words_of_the_language() {
    let (text, at) = cursor("Scene(background: 1, objects: [|])");
    for item in complete(&text, Ron, at).items.iter().filter(|item| item.label == "Sphere" || item.label == "Box") {
        let filled = item.snippet.replace("($1)", "(0, 0, 0)").replace("$2", "1").replace("$1", "1").replace("$0", "");
        let scene = text.replace("[]", &format!("[{filled}]"));
        assert!(load_str("s", &scene, Ron, Path::new(""), &[]).is_ok(), "{scene}");
    }
}

/// A material that is named and not there can be added, in all syntaxes and wherever others stand.
#[test]
fn a_material_is_added_among_others_or_before_the_objects() {
    let (ron, toml) = ("Box(size: 1, material: \"new one\")", "Box = { size = 1, material = \"new one\" }");
    let json = "{ \"Box\": { \"size\": 1, \"material\": \"new one\" } }";
    for (text, object, syntax) in [
        ("Scene(\n    background: 1,\n    objects: [\n        OBJECT,\n    ],\n)\n", ron, Ron),
        ("Scene(background: 1, objects: [OBJECT])", ron, Ron),
        ("Scene(background: 1, materials: {}, objects: [OBJECT])", ron, Ron),
        ("Scene(background: 1, materials: {\"a\": Mirror()}, objects: [OBJECT])", ron, Ron),
        (
            "Scene(\n  background: 1,\n  materials: { // all\n    \"a\": Mirror(),\n  },\n  objects: [OBJECT],\n)",
            ron,
            Ron,
        ),
        ("background = 1\n\n[[objects]]\nOBJECT\n", toml, Toml),
        ("background = 1\nobjects = [{ OBJECT }]\n", toml, Toml),
        ("background = 1\n[materials]\na = { Mirror = {} }\n[[objects]]\nOBJECT\n", toml, Toml),
        ("background = 1\n[materials.a.Mirror]\nreflectance = 1\n[[objects]]\nOBJECT\n", toml, Toml),
        ("background = 1\n[ materials ]\na = { Mirror = {} }\n[[objects]]\nOBJECT\n", toml, Toml),
        ("background = 1\nmaterials.a.Diffuse.albedo = 1\n[[objects]]\nOBJECT\n", toml, Toml),
        ("{ \"background\": 1, \"objects\": [OBJECT] }", json, Json),
        (
            "{\n \"background\": 1,\n \"materials\": {\n  \"a\": { \"Mirror\": {} }\n },\n \"objects\": [OBJECT] }",
            json,
            Json,
        ),
    ] {
        let text = text.replace("OBJECT", object);
        let edit = material_to_add(&text, syntax, "new one").expect("a place");
        let more = apply_edits(&text, &[edit]);
        assert!(load_str("s", &text, syntax, Path::new(""), &[]).is_err());
        let loaded =
            load_str("s", &more, syntax, Path::new(""), &[]).unwrap_or_else(|error| panic!("{more}\n{error:?}"));
        assert!(loaded.scene.materials.iter().any(|named| &*named.name.value == "new one"), "{more}");
        assert_eq!(material_to_add(&more, syntax, "new one"), None);
    }
}

#[test]
fn words_are_explained() {
    let (text, at) = cursor("Scene(objects: [Sphere(center: (0, 0, 0), rad|ius: 1)])");
    let found = hover(&text, Ron, at).expect("a word");
    assert_eq!(&text[found.range], "radius");
    assert!(found.markdown.contains("a length > 0"), "{}", found.markdown);
    let (text, at) = cursor("[[objects]]\nSph|ere = { radius = 1 }");
    let found = hover(&text, Toml, at).expect("a word");
    assert_eq!(&text[found.range], "Sphere");
    assert!(found.markdown.contains("`radius`"), "{}", found.markdown);
    let (text, at) = cursor("Scene(effects: Effects(tone_map: Fil|mic))");
    assert!(hover(&text, Ron, at).expect("a word").markdown.contains("**Filmic**"));
    assert_eq!(hover("Scene(background: 1)", Ron, 20), None);
}

/// A value shows what its field takes, in all syntaxes; what is not of a field shows nothing.
#[test]
fn values_show_their_fields() {
    let shown = |text: &str, syntax: Syntax| {
        let (text, at) = cursor(text);
        hover(&text, syntax, at).map(|found| (text[found.range].to_owned(), found.markdown))
    };
    let explained = |text: &str, syntax: Syntax, value: &str, words: &[&str]| {
        let (range, markdown) = shown(text, syntax).unwrap_or_else(|| panic!("nothing in {text}"));
        assert_eq!(range, value, "{text}");
        for word in words {
            assert!(markdown.contains(word), "{word} is missing: {markdown}");
        }
    };
    explained(
        "Scene(camera: Camera(fov: 3|5))",
        Ron,
        "35",
        &["**fov**", "degrees", "between 0 and 180", "default `40`"],
    );
    explained("Scene(background: 1|)", Ron, "1", &["**background**"]);
    explained("Scene(objects: [Sphere(center: (0, 1|2, 0), radius: 1)])", Ron, "12", &["**center**"]);
    explained("Scene(objects: [Sphere(center: (0, 1, 0), radius: |2)])", Ron, "2", &["**radius**", "a length > 0"]);
    explained("Scene(materials: { \"a\": Diffuse(albedo: \"#ff|0000\") })", Ron, "\"#ff0000\"", &["**albedo**"]);
    explained("Scene(objects: [Repeat(count: 1|0, items: [])])", Ron, "10", &["**count**"]);
    explained("Scene(objects: [Box(size: Pick(from: [1, 2|]))])", Ron, "2", &["**size**"]);
    explained("[camera]\nfov = 3|5\n", Toml, "35", &["**fov**", "degrees"]);
    explained("[[objects]]\nSphere = { radius = |1 }\n", Toml, "1", &["**radius**"]);
    explained("{ \"objects\": [{ \"Box\": { \"center\": [0, 0|.5, 0] } }] }", Json, "0.5", &["**center**"]);
    // A name says what it stands for, an expression what its words mean.
    let name = "Scene(materials: { \"red\": Mirror() }, objects: [Sphere(radius: 1, material: \"r|ed\")])";
    explained(name, Ron, "red", &["**red**: `Mirror()`"]);
    explained("Scene(objects: [Sphere(radius: \"=s|in(3)\")])", Ron, "sin", &["**sin(degrees)**"]);
    for text in [
        "Scene(objects: [Sphere(radus: |1)])",
        "Scene(vars: { \"h\": 2| })",
        "Scene(objects:| [Sphere(radius: 1)])",
        "Scene(objects: [Sphere(radius: 1) | ])",
        "Scene(objects: [Sphere(center: (0, | 1, 0))])",
    ] {
        assert_eq!(shown(text, Ron), None, "{text}");
    }
}

const NAMES: &str = "\
Scene(
    vars: { \"h\": 2, \"d\": \"=2*h + sin(h)\" },
    materials: { \"red\": Diffuse(albedo: \"#ff0000\") },
    objects: [
        Sphere(center: (0, \"=h\", 0), radius: 1, material: \"red\"),
        Repeat(count: 3, items: [Sphere(center: \"=(i, h, d)\", radius: 1, material: \"red\")]),
    ],
)
";

#[test]
fn names_are_found_and_renamed() {
    let at = NAMES.rfind("\"red\"").expect("red") + 2;
    let to = definition(NAMES, Ron, at).expect("defined");
    assert_eq!((&NAMES[to.clone()], NAMES[..to.start].ends_with("materials: { \"")), ("red", true));
    assert_eq!(occurrences(NAMES, Ron, at).len(), 3);
    let at = NAMES.find("=h").expect("h") + 1;
    assert_eq!(occurrences(NAMES, Ron, at).len(), 5);
    assert_eq!(definition(NAMES, Ron, at).expect("defined").start, NAMES.find("\"h\"").expect("h") + 1);
    let edits = rename(NAMES, Ron, at, "height").expect("a name");
    let renamed = applied(NAMES, &edits);
    assert!(renamed.contains("\"=2*height + sin(height)\"") && renamed.contains("=(i, height, d)"), "{renamed}");
    load_str("s", &renamed, Ron, Path::new(""), &[]).expect("still right");
    for bad in ["2h", "", "sin", "a b", "d"] {
        assert!(rename(NAMES, Ron, at, bad).is_err(), "{bad}");
    }
    let toml = crate::convert("s", NAMES, Ron, Toml).expect("right");
    let at = toml.find("red").expect("red");
    let renamed = applied(&toml, &rename(&toml, Toml, at, "dark red").expect("a name"));
    load_str("s", &renamed, Toml, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}\n{renamed}"));
    assert_eq!(renamed.matches("dark red").count(), 3);
}

fn applied(text: &str, edits: &[Edit]) -> String {
    let mut out = text.to_owned();
    for edit in edits.iter().rev() {
        out.replace_range(edit.span.start as usize..edit.span.end as usize, &edit.replacement);
    }
    out
}

#[test]
fn colours_are_found_and_written() {
    let found = colors(NAMES, Ron);
    assert_eq!(found.len(), 1);
    assert_eq!(&NAMES[found[0].range.clone()], "\"#ff0000\"");
    assert_eq!(found[0].linear, [1.0, 0.0, 0.0]);
    assert_eq!(color_texts([1.0, 0.0, 0.215_86], Ron), ["\"#ff0080\"".to_owned(), "(1, 0, 0.2159)".to_owned()]);
    let three = "Scene(background: (0.1, 0.2, 0.3), lights: [SphereLight(radiance: (20, 1, 1))])";
    let found = colors(three, Ron);
    assert_eq!(found.iter().map(|color| &three[color.range.clone()]).collect::<Vec<_>>(), ["(0.1, 0.2, 0.3)"]);
}

#[test]
fn the_outline_names_what_is_there() {
    let outline = symbols(NAMES, Ron);
    let sections: Vec<&str> = outline.iter().map(|symbol| symbol.name.as_str()).collect();
    assert_eq!(sections, ["vars", "materials", "objects"]);
    let names = |k: usize| outline[k].children.iter().map(|symbol| symbol.name.as_str()).collect::<Vec<_>>();
    assert_eq!((names(0), names(1), names(2)), (vec!["h", "d"], vec!["red"], vec!["Sphere", "Sphere"]));
    assert_eq!(outline[1].children[0].detail, "Diffuse");
    for symbol in outline.iter().flat_map(|section| section.children.iter().chain([section])) {
        assert!(symbol.range.start <= symbol.head.start && symbol.head.end <= symbol.range.end, "{symbol:?}");
    }
}

/// Whatever stands in a text, and wherever the cursor: no panic, and ranges are of the text.
#[test]
fn half_written_texts_are_looked_at() {
    for example in examples().into_iter().step_by(5) {
        let toml = crate::convert("s", &example.ron, Ron, Toml).expect("right");
        let json = crate::convert("s", &example.ron, Ron, Json).expect("right");
        for (text, syntax) in [(example.ron, Ron), (toml, Toml), (json, Json)] {
            for at in (0..text.len()).filter(|at| text.is_char_boundary(*at)).step_by(7) {
                for half in [&text[..at], &text[at..]] {
                    let end = half.len();
                    let found = complete(half, syntax, end);
                    assert!(half.get(found.range).is_some());
                    hover(half, syntax, end);
                    definition(half, syntax, end / 2);
                    for color in colors(half, syntax) {
                        assert!(half.get(color.range).is_some());
                    }
                    for symbol in symbols(half, syntax) {
                        assert!(half.get(symbol.range).is_some() && half.get(symbol.head).is_some());
                    }
                }
            }
        }
    }
}

#[test]
fn expressions_are_completed_with_what_is_known_there() {
    let scene = |inner: &str| format!("Scene(vars: {{ \"lamp\": (0, 3, 0) }}, objects: [{inner}])");
    let ball = |center: &str| format!("Sphere(center: (0, \"={center}\", 0), radius: 1)");
    offers(&scene(&ball("la|")), Ron, &["lamp", "time", "sin"], &["i", "x"]);
    offers(&scene(&ball("2 + lamp.|")), Ron, &["x", "y", "z", "r"], &["lamp", "sin"]);
    offers(&scene(&ball("lamp[0].x|")), Ron, &["x"], &["sin"]);
    offers(&scene(&ball("1.|")), Ron, &["lamp", "sin"], &["x"]);
    offers(&scene(&format!("Repeat(count: 3, items: [{}])", ball("|"))), Ron, &["i", "lamp"], &["x"]);
    let toml = "[[objects]]\n[objects.Repeat]\ncount = 3\nitems = [{ Sphere = { center = [\"=|\", 0, 0] } }]\n";
    offers(toml, Toml, &["i"], &[]);
}

#[test]
fn words_of_expressions_are_explained() {
    let text = "Scene(vars: { \"h\": 0.75, \"w\": \"=2*h\" }, objects: [Repeat(count: 2, index: \"k\", items: [\
                Sphere(center: (\"=k\", \"=w\", \"=sin(frame)\"), radius: 1)])])";
    for (word, told) in [
        ("2*|h", "**h**: `0.75`"),
        ("\"=|w", "**w**: `\"=2*h\"`"),
        ("(\"=|k", "**k**: counts from 0"),
        ("=s|in(", "**sin(degrees)**\n\nthe sine of an angle in degrees"),
        ("sin(fr|ame", "**frame**: the number of the frame"),
        ("Rep|eat(", "**Repeat**\n\nPuts its items into the list"),
    ] {
        let at = text.find(&word.replace('|', "")).expect("it is there") + word.find('|').expect("a cursor");
        let found = hover(text, Ron, at).unwrap_or_else(|| panic!("nothing at {word}"));
        assert!(found.markdown.starts_with(told), "{word}: {}", found.markdown);
    }
}

/// A name shows what it stands for, where it is given and where it is used; the name of a file is one.
#[test]
fn names_show_what_they_stand_for() {
    let shown = |text: &str, syntax: Syntax| {
        let (text, at) = cursor(text);
        hover(&text, syntax, at).map(|found| found.markdown)
    };
    let text = NAMES.replacen("material: \"red", "material: \"r|ed", 1);
    assert_eq!(shown(&text, Ron).as_deref(), Some("**red**: `Diffuse(albedo: \"#ff0000\")`"));
    let toml = "[materials.red.Diffuse]\nalbedo = 0.5\n[[objects]]\nBox = { size = 1, material = \"r|ed\" }\n";
    assert_eq!(shown(toml, Toml).as_deref(), Some("**red**: `[materials.red.Diffuse]`"));
    let camera = "Scene(camera: \"si|de\", cameras: { \"side\": Camera(fov: 20) })";
    assert_eq!(shown(camera, Ron).as_deref(), Some("**side**: `Camera(fov: 20)`"));
    let (text, at) = cursor("Scene(include: [\"p|art.ron\"], objects: [Mesh(file: \"a.obj\")])");
    assert_eq!(file_at(&text, Ron, at).expect("a file").1, "part.ron");
    assert_eq!(file_at(&text, Ron, text.find("obj\"").expect("a file")).expect("a file").1, "a.obj");
    assert_eq!(file_at(&text, Ron, 2), None);
}

#[test]
fn textures_are_found_and_renamed() {
    let text = "Scene(textures: { \"bricks\": Lines(), \"wall\": Mix(a: \"bricks\", b: \"#b3202c\"), \
                \"old\": \"bricks\" }, \
                materials: { \"bricks\": Diffuse(albedo: \"bricks\"), \"m\": Diffuse(albedo: \"|\") }, \
                objects: [Box(material: \"bricks\")])";
    offers(text, Ron, &["bricks", "wall"], &["Checkerboard", "m"]);
    offers(&text.replace("\"|\"", "|"), Ron, &["bricks", "Checkerboard"], &["m"]);
    let toml = "[textures]\nbricks = { Lines = {} }\n[materials]\nm = { Diffuse = { albedo = \"|\" } }";
    offers(toml, Toml, &["bricks"], &["m"]);
    let (text, _) = cursor(text);
    let first = text.find("bricks").expect("its definition");
    let used = text.rfind("albedo: \"bricks").expect("it is used") + 9;
    assert_eq!(definition(&text, Ron, used), Some(first..first + 6));
    let edits = rename(&text, Ron, first, "red tiles").expect("a free name");
    let renamed = applied(&text, &edits);
    assert_eq!((edits.len(), renamed.matches("red tiles").count()), (4, 4), "{renamed}");
    assert!(renamed.contains("\"bricks\": Diffuse(albedo: \"red tiles\")") && renamed.contains("material: \"bricks\""));
    assert!(rename(&text, Ron, first, "wall").is_err());
    let sections: Vec<String> = symbols(&text, Ron).into_iter().map(|symbol| symbol.name).collect();
    assert_eq!(sections, ["textures", "materials", "objects"]);
}

#[test]
fn masks_are_of_names_that_things_have() {
    let text = "Scene(output: Output(masks: [\"lamp\", \"|\"]), objects: [Group(objects: [Sphere(name: \"cup\")])], \
                lights: [SphereLight(name: \"lamp\")])";
    offers(text, Ron, &["cup", "lamp"], &["Albedo"]);
    offers("[output]\nmasks = [\"|\"]\n[[lights]]\nSphereLight = { name = \"lamp\" }", Toml, &["lamp"], &[]);
    let (text, _) = cursor(text);
    let mask = text.find("lamp").expect("a mask");
    let lamp = text.rfind("lamp").expect("a light");
    assert_eq!(definition(&text, Ron, mask), Some(lamp..lamp + 4));
    let edits = rename(&text, Ron, mask, "bulb").expect("a free name");
    assert_eq!(edits.iter().map(|edit| edit.span.start as usize).collect::<Vec<_>>(), [mask, lamp]);
    assert!(rename(&text, Ron, lamp, "cup").is_err());
}

/// The text after a renaming at its cursor, or why there is none.
fn renamed(text: &str, syntax: Syntax, name: &str) -> Result<String, String> {
    let (text, at) = cursor(text);
    rename(&text, syntax, at, name).map(|edits| apply_edits(&text, &edits))
}

#[test]
fn a_table_of_toml_is_renamed_wherever_it_goes_on() {
    let text = "[materials.r|ed.Diffuse.albedo.Noise]\na = 0.1\n\
                [materials . \"red\".Diffuse.albedo.Noise.mapping.Object]\nscale = 3\n[[objects]]\n\
                Sphere = { center = [0, 0, 0], radius = 1, material = 'red' }\n[materials]\n\
                red.Diffuse.x = 1\nblue = \"red\"\n";
    let after = renamed(text, Toml, "crimson").expect("a name");
    assert_eq!(after.matches("crimson").count(), 4, "{after}");
    assert!(after.contains("blue = \"red\""), "{after}");
}

#[test]
fn names_of_included_files_are_theirs() {
    let text = "Scene(vars: {\"hei|ght\": 0.7}, materials: {\"oak\": Mirror()}, objects: [Include(file: \"chair.ron\", \
                vars: {\"height\": \"=height\"}, materials: {\"seat\": \"oak\"})])";
    let after = renamed(text, Ron, "hh").expect("a name");
    assert!(after.contains("vars: {\"hh\": 0.7}") && after.contains("vars: {\"height\": \"=hh\"}"), "{after}");
    let text = text.replace("hei|ght", "height").replace("{\"oak", "{\"o|ak");
    let after = renamed(&text, Ron, "fir").expect("a name");
    assert!(after.contains("{\"fir\": Mirror()}") && after.contains("{\"seat\": \"fir\"}"), "{after}");
}

#[test]
fn names_within_a_repetition_are_known_there() {
    let text = "Scene(vars: {\"k\": 3}, objects: [Repeat(count: 2, index: \"k\", items: [Sphere(radius: \"=k\")]), \
                Sphere(radius: \"=|k\")])";
    let after = renamed(text, Ron, "n").expect("a name");
    assert!(after.contains("{\"n\": 3}") && after.contains("index: \"k\"") && after.ends_with("\"=n\")])"), "{after}");
    assert_eq!(after.matches("=k").count(), 1, "{after}");
    let within = text.replace("=|k", "=k").replacen("=k", "=|k", 1);
    let after = renamed(&within, Ron, "n").expect("a name");
    assert!(after.contains("{\"k\": 3}") && after.contains("index: \"n\"") && after.ends_with("\"=k\")])"), "{after}");
}

#[test]
fn what_cannot_be_renamed_is_told() {
    for (text, syntax, name, why) in [
        ("Scene(objects: [Repeat(count: 2, items: [Box(size: \"=|i\")])])", Ron, "n", "write `index`"),
        ("Scene(include: [\"lib.ron\"], objects: [Box(material: \"o|ak\")])", Ron, "fir", "not given in this file"),
        ("materials.'r|ed'.Mirror = {}\n", Toml, "it's", "single quotes"),
        ("Scene(textures: {\"a|b\": Noise()})", Ron, "#ffffff", "expression or a colour"),
        ("Scene(textures: {\"a|b\": Noise()})", Ron, "=1/2", "expression or a colour"),
    ] {
        let told = renamed(text, syntax, name).expect_err(text);
        assert!(told.contains(why), "{text}: {told}");
    }
    let raw = "Scene(materials: {\"red\": Mirror()}, objects: [Box(material: r#\"re|d\"#)])";
    assert!(renamed(raw, Ron, "blue").expect("a name").contains("material: r#\"blue\"#"));
    // A text that begins with `=` where a name is read is no expression.
    let text =
        "Scene(vars: {\"|h\": 1}, materials: {\"=h\": Mirror()}, objects: [Box(size: \"=h\", material: \"=h\")])";
    let after = renamed(text, Ron, "n").expect("a name");
    assert!(after.contains("size: \"=n\", material: \"=h\""), "{after}");
}

#[test]
fn names_are_completed_as_they_are_written() {
    let text = "Scene(materials: {\"a\\\\\\\"b\": Mirror()}, objects: [Sphere(material: |";
    let (text, at) = cursor(text);
    let item = complete(&text, Ron, at).items.into_iter().find(|item| item.label == "a\\\"b").expect("it is offered");
    assert_eq!(item.snippet, "\"a\\\\\\\\\\\\\"b\"");
}
