//! The JSON Schema by an independent validator: right scenes validate, scenes whose structure is wrong do not.

mod common;

use common::{FULL_RON, FULL_TOML};
use jsonschema::Validator;
use scene_format::{LoadError, Syntax, convert, examples, load_bytes, schema};
use serde_json::Value;
use std::path::Path;

fn validator() -> Validator {
    let schema: Value = serde_json::from_str(&schema()).expect("the schema is JSON");
    assert!(jsonschema::meta::is_valid(&schema), "the schema is a schema");
    jsonschema::draft7::new(&schema).expect("the schema can be used")
}

fn value(toml: &str) -> Value {
    toml::from_str(toml).unwrap_or_else(|error| panic!("{error}\n{toml}"))
}

#[test]
fn right_scenes_validate() {
    let validator = validator();
    let mut scenes = vec![FULL_TOML.to_owned()];
    let ron = examples().into_iter().map(|example| example.ron).chain([FULL_RON.to_owned()]);
    scenes.extend(ron.map(|ron| convert("scene", &ron, Syntax::Ron, Syntax::Toml).expect("the scene is right")));
    // All scenes of the repository: the figures, the gallery, the goldens, the templates.
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut folders = ["scenes", "golden", "crates/tracer/templates"].map(|folder| top.join(folder)).to_vec();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if let Some(syntax) = Syntax::from_path(&path) {
                let text = std::fs::read_to_string(&path).expect("a scene");
                // A library, which scenes include, has no objects.
                if !text.contains("objects") {
                    continue;
                }
                let name = path.display().to_string();
                let toml = match syntax {
                    Syntax::Toml => text,
                    Syntax::Ron => {
                        convert(&name, &text, syntax, Syntax::Toml).unwrap_or_else(|error| panic!("{name}: {error:?}"))
                    }
                };
                scenes.push(format!("# {name}\n{toml}"));
            }
        }
    }
    assert!(scenes.len() > 60, "only {} scenes", scenes.len());
    for scene in scenes {
        let errors: Vec<String> = validator.iter_errors(&value(&scene)).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{errors:#?}\n{scene}");
    }
    let with_schema = format!("\"$schema\" = \"scene.schema.json\"\n{FULL_TOML}");
    assert!(validator.is_valid(&value(&with_schema)));
}

/// What only the reader can tell: which names there are, and how values go together.
const BEYOND_A_SCHEMA: [&str; 16] = [
    "E0211", "E0307", "E0308", "E0309", "E0401", "E0406", "E0407", "E0408", "E0540", "E0560", "E0601", "E0602",
    "E0603", "E0604", "E0605", "E0606",
];

#[test]
fn broken_toml_scenes_do_not_validate() {
    let validator = validator();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken/toml");
    let mut refused = 0;
    for entry in std::fs::read_dir(folder).expect("the folder of broken scenes") {
        let path = entry.expect("an entry").path();
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        // Broken syntax is no value that a schema could judge.
        let Ok(value) = toml::from_str::<Value>(&text) else { continue };
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let Err(LoadError::Invalid { diagnostics, .. }) =
            load_bytes("scene", text.into_bytes(), Some(Syntax::Toml), Path::new("tests/broken"), &[])
        else {
            continue;
        };
        // Nor does it see what stands in other files.
        if diagnostics.iter().all(|fault| fault.span.source > 0 || BEYOND_A_SCHEMA.contains(&fault.code.as_str())) {
            continue;
        }
        assert!(!validator.is_valid(&value), "the schema takes {}", path.display());
        refused += 1;
    }
    assert!(refused >= 35, "only {refused} scenes were judged");
}
