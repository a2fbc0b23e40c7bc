//! The generator of `cargo xtask truth` draws every word of the language: it is held against the schema that prints the
//! manual.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use xtask::truth::kinds;

/// Words that are not drawn, and why.
const NOT_DRAWN: [(&str, &str); 42] = [
    ("Render.samples", "the command says how many"),
    ("Render.seed", "the command says which"),
    ("Render.clamp", "takes light on purpose"),
    ("Render.noise", "the command says how many samples"),
    ("Render.adaptive", "from 64 samples on, and the default is what is tested: proofs::adaptive"),
    ("Adaptive.", "from 64 samples on, and the default is what is tested: proofs::adaptive"),
    ("Render.time", "the command says how many samples"),
    ("Render.acceleration", "the same bytes: proofs::same_bytes"),
    ("Acceleration.", "the same bytes: proofs::same_bytes"),
    ("Render.integrator", "the default is what is tested, the other is the truth"),
    ("Integrator.", "the default is what is tested, the other is the truth"),
    ("AmbientOcclusion.", "no light: proofs::integrators"),
    ("Render.reuse", "the default is what is tested"),
    ("Reuse.", "the default is what is tested"),
    ("Render.caustics", "the default is what is tested"),
    ("Caustics.", "the default is what is tested"),
    ("Render.indirect", "the default is what is tested"),
    ("Indirect.", "the default is what is tested"),
    ("Scene.vars", "expressions are values before anything is compiled"),
    ("Scene.animation", "a frame is a scene whose expressions are values"),
    ("Animation.", "a frame is a scene whose expressions are values"),
    ("Camera.shutter", "the mean of scenes that stand still, which are drawn: proofs::motion"),
    ("Scene.cameras", "one of them is the camera, which is drawn"),
    ("Group.", "says the same as objects with these placements: compile::placing"),
    ("Object.Group", "says the same as objects with these placements: compile::placing"),
    ("Include.", "says the same as objects with these placements: compile::placing"),
    ("Object.Include", "says the same as objects with these placements: compile::placing"),
    ("Scene.include", "what it brings is the same as written out"),
    ("Pick.", "says the same as the value that it picks"),
    ("Repeat.", "says the same as writing its items out"),
    ("PlacementPattern.", "says the same as writing its placements out: compile::patterns"),
    ("Grid.", "says the same as writing its placements out: compile::patterns"),
    ("Ring.", "says the same as writing its placements out: compile::patterns"),
    ("Scatter.", "says the same as writing its placements out: compile::patterns"),
    ("Scene.output", "the picture is the same with layers: proofs::layers"),
    ("Output.", "the picture is the same with layers: proofs::layers"),
    ("Layer.", "the picture is the same with layers: proofs::layers"),
    ("Matte.", "the picture is the same with mattes: proofs::mattes"),
    ("Emissive.None", "as `SphereLight.None`"),
    ("ThinLens.None", "as `SphereLight.None`"),
    ("Conductor.None", "as `SphereLight.None`"),
    ("SphereLight.None", "says the same as leaving the field out, which two of three always are"),
];

/// Fields that have the same value in all scenes, and why.
const ALWAYS_THE_SAME: [(&str, &str); 1] = [("Scene.version", "there is one version")];

fn not_drawn(word: &str) -> bool {
    NOT_DRAWN.iter().any(|(name, _)| if name.ends_with('.') { word.starts_with(name) } else { word == *name })
        || ALWAYS_THE_SAME.iter().any(|(name, _)| word == *name)
}

/// A walk along a scene and the schema at once, which notes the words that the scene uses.
struct Walk<'a> {
    definitions: &'a Value,
    used: BTreeSet<String>,
}

impl Walk<'_> {
    /// A value by its part of the schema; `name` is the definition that it belongs to.
    fn value(&mut self, schema: &Value, name: &str, value: &Value) {
        if let Some(reference) = schema["$ref"].as_str() {
            let name = reference.trim_start_matches("#/definitions/");
            let schema = &self.definitions[name];
            return self.value(schema, name, value);
        }
        for part in ["allOf", "anyOf"] {
            for choice in schema[part].as_array().into_iter().flatten() {
                self.value(choice, name, value);
            }
        }
        if let Some(word) = value.as_str()
            && schema["enum"].as_array().is_some_and(|words| words.iter().any(|w| w == word))
        {
            self.used.insert(format!("{name}.{word}"));
        }
        if let (Some(fields), Some(properties)) = (value.as_object(), schema["properties"].as_object()) {
            for (field, value) in fields {
                let Some(schema) = properties.get(field) else { continue };
                if schema.get("default") != Some(value) {
                    self.used.insert(format!("{name}.{field}"));
                }
                self.value(schema, name, value);
            }
        }
        if let (Some(fields), false) = (value.as_object(), schema["additionalProperties"].is_boolean()) {
            fields.values().for_each(|value| self.value(&schema["additionalProperties"], name, value));
        }
        for value in value.as_array().into_iter().flatten() {
            self.value(&schema["items"], name, value);
        }
    }
}

/// All words of a part of the schema.
fn words(schema: &Value, name: &str, definitions: &Value, out: &mut BTreeSet<String>) {
    for choice in ["allOf", "anyOf"].iter().flat_map(|part| schema[part].as_array().into_iter().flatten()) {
        words(choice, name, definitions, out);
    }
    let units = schema["enum"].as_array().into_iter().flatten().filter_map(Value::as_str);
    out.extend(units.map(|word| format!("{name}.{word}")));
    for (field, schema) in schema["properties"].as_object().into_iter().flatten() {
        if !field.starts_with('$') {
            out.insert(format!("{name}.{field}"));
        }
        words(schema, name, definitions, out);
    }
    words_of_parts(schema, name, definitions, out);
}

fn words_of_parts(schema: &Value, name: &str, definitions: &Value, out: &mut BTreeSet<String>) {
    for part in ["items", "additionalProperties"] {
        if schema[part].is_object() {
            words(&schema[part], name, definitions, out);
        }
    }
}

#[test]
fn every_word_of_the_language_is_drawn() {
    let schema: Value = serde_json::from_str(&scene_format::schema()).unwrap();
    let definitions = &schema["definitions"];
    let mut all = BTreeSet::new();
    words(&schema, "Scene", definitions, &mut all);
    for (name, definition) in definitions.as_object().unwrap() {
        words(definition, name, definitions, &mut all);
    }
    // `None` for a field that may be left out is no kind of anything; `Repeat` may stand in every list, `Pick` for
    // every value. No picture shows a name.
    all.retain(|word| {
        !not_drawn(word) && !word.ends_with(".Repeat") && !word.ends_with(".Pick") && !word.ends_with(".name")
    });
    let mut walk = Walk { definitions, used: BTreeSet::new() };
    let mut kinds_drawn: BTreeMap<&str, usize> = BTreeMap::new();
    for seed in 0..2000 {
        let case = kinds::case(seed, 128);
        *kinds_drawn.entry(case.kind).or_default() += 1;
        let text = scene_format::to_toml(&case.world.desc, scene_format::Defaults::Shown);
        let scene: toml::Value = toml::from_str(&text).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        walk.value(&schema, "Scene", &serde_json::to_value(scene).unwrap());
    }
    let missing: Vec<&String> = all.difference(&walk.used).collect();
    assert!(missing.is_empty(), "never drawn in 2000 scenes, and not said why: {missing:?}");
    assert_eq!(kinds_drawn.len(), kinds::KINDS.len(), "{kinds_drawn:?}");
}

/// What is not drawn is in the language: a word that is taken out must be taken out of the lists.
#[test]
fn what_is_not_drawn_exists() {
    let schema: Value = serde_json::from_str(&scene_format::schema()).unwrap();
    let definitions = &schema["definitions"];
    let mut all = BTreeSet::new();
    words(&schema, "Scene", definitions, &mut all);
    for (name, definition) in definitions.as_object().unwrap() {
        words(definition, name, definitions, &mut all);
    }
    for (name, _) in NOT_DRAWN.iter().chain(&ALWAYS_THE_SAME) {
        assert!(all.iter().any(|word| word.starts_with(name)), "{name}");
    }
}

/// The same seed draws the same scene, and all are legal.
#[test]
fn scenes_are_legal_and_repeat_themselves() {
    for seed in 0..60 {
        let case = kinds::case(seed, 128);
        assert_eq!(case.world.text(""), kinds::case(seed, 128).world.text(""), "seed {seed}");
        assert_eq!(case.kind, kinds::kind(seed));
        for world in case.relation.others(&case.world).iter().chain([&case.world]) {
            world.compiled().unwrap_or_else(|error| panic!("seed {seed}, {}: {error}", case.kind));
        }
    }
}
