//! The types of scenes for Python (`tracer/words.py`) are made of the schema, and are those of today.
//! `UPDATE_EXPECT=1 cargo test -p tracer-python --test words` makes them anew.

mod python;

use std::path::Path;

#[test]
fn the_types_are_those_of_the_schema() {
    let schema = serde_json::from_str(&scene_format::schema()).expect("the schema is JSON");
    let made = python::module(&schema);
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tracer/words.py");
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&file, &made).expect("the file can be written");
    }
    let there = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(
        there == made,
        "tracer/words.py is not of this schema: UPDATE_EXPECT=1 cargo test -p tracer-python --test words"
    );
}

#[test]
fn kinds_lists_and_choices_become_types() {
    let schema = serde_json::json!({
        "properties": { "objects": { "type": "array", "items": { "$ref": "#/definitions/Object" } } },
        "required": ["objects"],
        "definitions": {
            "Object": { "anyOf": [
                { "type": "object", "properties": { "Ball": { "$ref": "#/definitions/Ball" } }, "required": ["Ball"] },
                { "enum": ["Nothing"] },
            ] },
            "Ball": { "type": "object", "description": "A ball.", "required": ["radius"], "properties": {
                "radius": {
                    "anyOf": [{ "type": "number" }, { "type": "string", "pattern": "^=" }],
                    "description": "How large.",
                },
                "center": { "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 },
            } },
        },
    });
    let made = python::module(&schema);
    for expected in [
        "Object = Either[\"BallItem\", Literal[\"Nothing\"]]\n",
        "BallItem = TypedDict(\"BallItem\", {\"Ball\": \"Ball\"})\n",
        "class _BallRequired(TypedDict):\n    radius: Either[float, str]\n",
        "class Ball(_BallRequired, total=False):\n    \"\"\"A ball.\n\n    radius: How large.\n    \"\"\"\n\n    \
         center: Either[Sequence[float], Array]\n",
        "class _SceneDictRequired(TypedDict):\n    objects: Sequence[Object]\n",
    ] {
        assert!(made.contains(expected), "{expected}\nis not in\n{made}");
    }
}
