//! What `tracer check --fix` does to a text: fewer faults, or nothing; and nothing more when it is done again.

use scene_format::{LoadError, Severity, Syntax, load_str, mend};
use std::path::Path;

fn errors(text: &str, syntax: Syntax) -> usize {
    match load_str("scene", text, syntax, Path::new("tests/broken"), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            diagnostics.iter().filter(|fault| fault.severity == Severity::Error).count()
        }
        _ => 0,
    }
}

/// Why a text is not mended as it should be.
fn fault(text: &str, syntax: Syntax) -> Option<String> {
    let once = mend("scene", text, syntax, Path::new("tests/broken"));
    let twice = mend("scene", &once.text, syntax, Path::new("tests/broken"));
    let (before, after) = (errors(text, syntax), errors(&once.text, syntax));
    if twice.text != once.text {
        return Some(format!("is mended again:\n{}\nto\n{}", once.text, twice.text));
    }
    let better = after < before || before == 0 && after == 0;
    (once.text != text && !better).then(|| format!("{before} errors before, {after} after:\n{}", once.text))
}

#[test]
fn broken_scenes_get_fewer_errors_or_stay_as_they_are() {
    let mut wrong = Vec::new();
    let mut mended = 0;
    for (syntax, extension) in [(Syntax::Ron, "ron"), (Syntax::Toml, "toml"), (Syntax::Json, "json")] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken").join(extension);
        for entry in std::fs::read_dir(folder).expect("the folder of broken scenes") {
            let path = entry.expect("an entry of the folder").path();
            let Ok(text) = std::fs::read_to_string(&path) else { continue };
            if path.extension().is_some_and(|found| found == extension) {
                wrong.extend(fault(&text, syntax).map(|why| format!("{}: {why}", path.display())));
                mended += usize::from(mend("scene", &text, syntax, Path::new("")).text != text);
            }
        }
    }
    assert!(mended > 150, "only {mended} were mended");
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

/// A scene with one object that is written so.
fn with_object(object: &str) -> String {
    format!(
        "Scene(\n    background: 1,\n    objects: [\n        Sphere(center: (0, 0, 0), radius: 1),\n{object}\n    \
         ],\n)\n"
    )
}

/// What people wrote who came from other programs: one error, whose hint says how it is written here.
#[test]
fn constructs_of_other_languages_are_told_once_and_left_as_they_are() {
    let mut wrong = Vec::new();
    let in_ron = [
        (
            with_object(
                "        for i in 0..8 { Group(\n            items: [Sphere(center: (0, i, 0), radius: \
             1)],\n        ) }",
            ),
            "Repeat(count: 8, items: [..])",
        ),
        (with_object("        for k in range(3): Sphere(center: (0, 0, 0), radius: 1),"), "index: \"k\""),
        (
            with_object("        sphere { <0, 1, 0>, 1 pigment { color rgb <1, 0, 0> } }"),
            "Sphere(center: (x, y, z), \
         radius: ..)",
        ),
        (
            with_object(
                "        sphere {\n            <0, 1, 0>, 1\n            pigment { color rgb <1, 0, 0> }\n        \
         }",
            ),
            "Sphere(center:",
        ),
        (with_object("        torus { 1, 0.2 rotate <90, 0, 0> }"), "Torus(radius:"),
        (with_object("        julia_fractal { <-0.08, 0, -0.8, -0.03> }"), "tracer explain Object"),
        (with_object("        #declare R = 2;"), "`vars`"),
        (
            with_object(
                "        Sphere(center: (0, 0, 0), radius: 1, material: texture { pigment { rgb <1, 0, 0> } \
         }),",
            ),
            "Diffuse(albedo:",
        ),
        (
            "Scene(background: 1, objects: [Sphere(center: (i, 0, 0), radius: 1) for i in range(8)])".to_owned(),
            "count: \
         8",
        ),
        (
            "Scene(\n    camera { location <0, 1, 5> look_at <0, 0, 0> }\n    background: 1,\n    objects: \
         [Sphere(center: (0, 0, 0), radius: 1)],\n)"
                .to_owned(),
            "camera: Camera(",
        ),
    ];
    for (text, way) in in_ron {
        check(&text, Syntax::Ron, way, &mut wrong);
        if mend("scene", &text, Syntax::Ron, Path::new("")).text != text {
            wrong.push(format!("{text}\nis changed"));
        }
    }
    let in_toml = [
        (
            "background = 1\n[[objects]]\nSphere(center: [0, 0, 0], radius: 1)\n",
            "Sphere = { center = [0, 0, 0], radius = 1 }",
        ),
        (
            "background = 1\nobjects = [\n    Sphere(\n        center: (0, 0, 0),\n        radius: 1,\n    ),\n]\n",
            "{ Sphere = { center = [0, 0, 0], radius = 1 } }",
        ),
        (
            "background = 1\ncamera = Camera(\n    fov: 40,\n)\n[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 \
             }\n",
            "{ fov = 40 }",
        ),
        ("background = 1\n[[objects]]\nsphere { <0, 1, 0>, 1 }\n", "{ Sphere = { center = [x, y, z], radius = .. } }"),
        (
            "background = 1\n[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 }\nfor i in 0..8 {\n}\n",
            "{ Repeat = { count = 8, items = [..] } }",
        ),
    ];
    for (text, way) in in_toml {
        check(text, Syntax::Toml, way, &mut wrong);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

fn check(text: &str, syntax: Syntax, way: &str, wrong: &mut Vec<String>) {
    let found = match load_str("scene", text, syntax, Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => diagnostics,
        _ => Vec::new(),
    };
    let [only] = found.as_slice() else {
        let all: Vec<String> = found.iter().map(|fault| format!("{} ({})", fault.message, fault.hint)).collect();
        return wrong.push(format!("{text}\ngives {} errors: {all:#?}", all.len()));
    };
    if !only.hint.contains(way) {
        wrong.push(format!("{text}\nis told {:?} with the hint {:?}, not {way:?}", only.message, only.hint));
    }
    wrong.extend(fault(text, syntax).map(|why| format!("{text}\n{why}")));
}

/// Where something is wrong that nobody can mend for certain, what stands beside it is left alone.
#[test]
fn a_line_with_an_unclear_fault_is_not_edited() {
    let text = with_object("        Sphere(center: (0, 0, 0), radius: \"wide\", material: \"red\", raduis: 1),");
    assert_eq!(mend("scene", &text, Syntax::Ron, Path::new("")).text, text);
    let text = with_object(
        "        Sphere(center: (0, 0, 0), raduis: 1),\n        Sphere(center: (0, 0, 0), radius: \"wide\"),",
    );
    let mended = mend("scene", &text, Syntax::Ron, Path::new(""));
    assert_eq!((mended.text, mended.faults), (text.replace("raduis", "radius"), 1));
}
