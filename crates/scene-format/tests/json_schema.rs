//! The JSON Schema by an independent validator: right scenes validate, scenes whose structure is wrong do not.

mod common;

use common::{FULL_JSON, FULL_RON, FULL_TOML};
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

/// A scene as TOML and as JSON have it.
fn values(name: &str, text: &str, syntax: Syntax) -> [(String, Value); 2] {
    let written = |to: Syntax| {
        if syntax == to {
            return text.to_owned();
        }
        convert(name, text, syntax, to).unwrap_or_else(|error| panic!("{name}: {error:?}"))
    };
    let (toml, json) = (written(Syntax::Toml), written(Syntax::Json));
    let of_json = serde_json::from_str(&json).unwrap_or_else(|error| panic!("{name}: {error}\n{json}"));
    [(toml.clone(), value(&toml)), (json, of_json)]
}

#[test]
fn right_scenes_validate() {
    let validator = validator();
    let mut scenes = values("full.toml", FULL_TOML, Syntax::Toml).to_vec();
    scenes.extend(values("full.json", FULL_JSON, Syntax::Json));
    for ron in examples().into_iter().map(|example| example.ron).chain([FULL_RON.to_owned()]) {
        scenes.extend(values("scene", &ron, Syntax::Ron));
    }
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
                if text.contains("objects") {
                    scenes.extend(values(&path.display().to_string(), &text, syntax));
                }
            }
        }
    }
    assert!(scenes.len() > 120, "only {} scenes", scenes.len());
    for (text, scene) in scenes {
        let errors: Vec<String> = validator.iter_errors(&scene).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{errors:#?}\n{text}");
    }
    let with_schema = format!("\"$schema\" = \"scene.schema.json\"\n{FULL_TOML}");
    assert!(validator.is_valid(&value(&with_schema)));
    // `null` is `None`.
    let pinhole = FULL_JSON.replace("{ \"ThinLens\": { \"aperture\": 2, \"focus_distance\": 55 } }", "null");
    assert!(pinhole.contains("null") && validator.is_valid(&serde_json::from_str(&pinhole).expect("JSON")));
}

/// What only the reader can tell: which names there are (`"red"` may be that of a texture), what is there twice (in
/// JSON), and how values go together.
const BEYOND_A_SCHEMA: [&str; 27] = [
    "E0205", "E0402", "E0211", "E0306", "E0307", "E0308", "E0309", "E0401", "E0406", "E0407", "E0408", "E0409",
    "E0410", "E0412", "E0540", "E0545", "E0546", "E0560", "E0601", "E0602", "E0603", "E0604", "E0605", "E0606",
    "W0312", "W0313", "E0543",
];

#[test]
fn broken_scenes_do_not_validate() {
    let refused = [refused("toml", Syntax::Toml), refused("json", Syntax::Json)];
    assert!(refused[0] >= 35 && refused[1] >= 12, "only {refused:?} scenes were judged");
}

/// How many broken scenes the schema refuses; it must not take any that a schema could judge.
fn refused(extension: &str, syntax: Syntax) -> usize {
    let validator = validator();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken").join(extension);
    let mut refused = 0;
    for entry in std::fs::read_dir(folder).expect("the folder of broken scenes") {
        let path = entry.expect("an entry").path();
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        // Broken syntax is no value that a schema could judge.
        let value = match syntax {
            Syntax::Json => serde_json::from_str::<Value>(&text).ok(),
            _ => toml::from_str::<Value>(&text).ok(),
        };
        let Some(value) = value.filter(|_| path.extension().is_some_and(|found| found == extension)) else { continue };
        let Err(LoadError::Invalid { diagnostics, .. }) =
            load_bytes("scene", text.clone().into_bytes(), Some(syntax), Path::new("tests/broken"), &[])
        else {
            continue;
        };
        // To a schema these are null, as JSON has no word for them.
        if [" nan", " inf"].iter().any(|number| text.contains(number)) {
            continue;
        }
        // Nor does it see what stands in other files.
        if diagnostics.iter().all(|fault| fault.span.source > 0 || BEYOND_A_SCHEMA.contains(&fault.code.as_str())) {
            continue;
        }
        assert!(!validator.is_valid(&value), "the schema takes {}", path.display());
        refused += 1;
    }
    refused
}
