//! Brackets that are closed too early, and fields outside of the brackets that they belong to: one error, whose edit
//! makes the scene right.

use scene_format::{LoadError, Severity, Syntax, load_str, mend};
use std::path::Path;

fn errors(text: &str, syntax: Syntax) -> Vec<String> {
    match load_str("scene", text, syntax, Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            let errors = diagnostics.into_iter().filter(|fault| fault.severity == Severity::Error);
            errors.map(|fault| format!("{} {}", fault.code, fault.message)).collect()
        }
        _ => Vec::new(),
    }
}

/// Each scene is right with `right`, has so many errors with `written` in its place, and is mended to `right`.
fn check(scene: &str, syntax: Syntax, cases: &[(&str, &str, usize)]) {
    let mut wrong = Vec::new();
    for (right, written, faults) in cases {
        let whole = scene.replace("..", right);
        assert_eq!(errors(&whole, syntax), Vec::<String>::new(), "{whole}");
        let broken = scene.replace("..", written);
        let found = errors(&broken, syntax);
        let mended = mend("scene", &broken, syntax, Path::new("")).text;
        if found.len() != *faults || mended != whole {
            wrong.push(format!("{broken}\nhas {found:#?} and becomes\n{mended}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn a_round_bracket_that_is_closed_too_early() {
    let objects = "Scene(\n    background: 1,\n    objects: [\n        ..\n        Box(size: 1),\n    ],\n)\n";
    let boxes = "Box(size: (1, 1, 1), name: \"a\"),\n        Box(size: 2, name: \"b\"),";
    check(
        objects,
        Syntax::Ron,
        &[
            ("Box(size: (1, 1, 1), material: Mirror()),", "Box(size: (1, 1, 1)), material: Mirror()),", 1),
            ("Box(size: (1, 1, 1), material: Mirror()),", "Box(size: (1, 1, 1)), material: Mirror(),", 1),
            ("Box(size: 2, name: \"b)\"),", "Box(size: 2), name: \"b)\"),", 1),
            ("Box(size: 2, name: \"b\"), // (a box", "Box(size: 2), name: \"b\"), // (a box", 1),
            ("Box(size: 2, material: Mirror(), name: \"b\"),", "Box(size: 2), material: Mirror(), name: \"b\"),", 1),
            (boxes, "Box(size: (1, 1, 1)), name: \"a\"),\n        Box(size: 2), name: \"b\"),", 2),
        ],
    );
    check(
        "Scene(\n    camera: ..\n    background: 1,\n    objects: [Box(size: 1)],\n)\n",
        Syntax::Ron,
        &[
            ("Camera(position: (0, 1, 4), fov: 30),", "Camera(position: (0, 1, 4)), fov: 30),", 1),
            ("Camera(\n        position: (0, 1, 4),\n    ),", "Camera(\n        position: (0, 1, 4)),\n    ),", 1),
        ],
    );
    check(
        "Scene(\n    background: 1,\n    objects: [..],\n)\n",
        Syntax::Ron,
        &[("Box(size: 2, name: \"a\"), Box(size: 2)", "Box(size: 2), name: \"a\"), Box(size: 2)", 1)],
    );
    check(
        "Scene(\n    background: 1,\n    materials: {\n        ..\n    },\n    objects: [Box(size: 1)],\n)\n",
        Syntax::Ron,
        &[("\"a\": Conductor(metal: Gold, roughness: 0.1),", "\"a\": Conductor(metal: Gold), roughness: 0.1),", 1)],
    );
}

#[test]
fn a_list_without_its_brackets() {
    check(
        "Scene(\n    background: 1,\n    objects: [\n        Box(size: 2, ..),\n    ],\n)\n",
        Syntax::Ron,
        &[
            (
                "transform: [Translate((1, 2, 3)), Scale(3), Scale(2)]",
                "transform: Translate((1, 2, 3)), Scale(3), Scale(2)",
                1,
            ),
            (
                "transform: [Translate((1, 2, 3)), Scale(2)], material: Mirror()",
                "transform: Translate((1, 2, 3)), Scale(2), material: Mirror()",
                1,
            ),
        ],
    );
}

#[test]
fn the_header_of_a_kind_without_the_list() {
    check(
        "background = 1\n\n[[objects]]\n..\n\n[[objects]]\n[objects.Box]\nsize = 1\n",
        Syntax::Toml,
        &[
            ("[objects.Box]\nsize = 2", "[Box]\nsize = 2", 1),
            ("[objects.Box]\nsize = 2\n[objects.Box.material.Mirror]", "[Box]\nsize = 2\n[Box.material.Mirror]", 2),
        ],
    );
}

#[test]
fn fields_beside_a_kind_are_told_where_they_belong() {
    let text = "background = 1\n[[objects]]\nname = \"a\"\n[objects.Box]\nsize = 2\n";
    assert_eq!(errors(text, Syntax::Toml), ["E0201 beside `Box` nothing else can stand here"]);
    let text = "{\"background\": 1, \"objects\": [{\"name\": \"a\", \"Box\": {\"size\": 2}}]}";
    assert_eq!(errors(text, Syntax::Json), ["E0201 beside `Box` nothing else can stand here"]);
}
