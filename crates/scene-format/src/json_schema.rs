//! The schema as JSON Schema draft-07, for editors: completion and checks while a TOML or JSON scene is written.
//!
//! Draft-07 because taplo and most editors know it best: vectors are `items` with `minItems` and `maxItems`,
//! descriptions stand beside `allOf`, since draft-07 ignores what stands beside a `$ref`.

use crate::desc::Scene;
use crate::examples::CHOICES;
use crate::form::Form;
use crate::read::{PICK, REPEAT};
use crate::schema::{Content, EnumDef, FieldDef, Rule, StructDef, Type, VariantDef, prose};
use serde_json::{Map, Value, json};

/// The JSON Schema (draft-07) of a scene.
pub fn schema() -> String {
    let mut definitions = Map::new();
    let mut root = struct_schema(&Scene::DEF, &mut definitions);
    let extra = json!({ "type": "string", "description": "Where this schema is, for the editor." });
    if let Some(Value::Object(properties)) = root.get_mut("properties") {
        properties.insert("$schema".to_owned(), extra);
        if let Some(Value::Object(objects)) = properties.get_mut("objects") {
            objects.insert("minItems".to_owned(), json!(1));
            objects.remove("default");
        }
    }
    root.insert("required".to_owned(), json!(["objects"]));
    let mut out = Map::new();
    out.insert("$schema".to_owned(), json!("http://json-schema.org/draft-07/schema#"));
    out.insert("title".to_owned(), json!("A scene of tracer"));
    out.extend(root);
    out.insert("definitions".to_owned(), Value::Object(definitions));
    let mut text = serde_json::to_string_pretty(&Value::Object(out)).unwrap_or_default();
    text.push('\n');
    text
}

fn struct_schema(def: &'static StructDef, definitions: &mut Map<String, Value>) -> Map<String, Value> {
    let mut properties = Map::new();
    for field in def.fields {
        properties.insert(field.name.to_owned(), Value::Object(field_schema(field, definitions)));
    }
    let required: Vec<&str> =
        def.fields.iter().filter(|field| field.default.is_none()).map(|field| field.name).collect();
    let mut out = Map::new();
    out.insert("type".to_owned(), json!("object"));
    out.insert("description".to_owned(), json!(prose(def.doc)));
    out.insert("properties".to_owned(), Value::Object(properties));
    if !required.is_empty() {
        out.insert("required".to_owned(), json!(required));
    }
    if !def.exactly_one.is_empty() {
        let choices: Vec<Value> = def.exactly_one.iter().map(|name| json!({ "required": [name] })).collect();
        out.insert("oneOf".to_owned(), json!(choices));
    }
    out.insert("additionalProperties".to_owned(), json!(false));
    out
}

fn field_schema(field: &FieldDef, definitions: &mut Map<String, Value>) -> Map<String, Value> {
    let mut out = type_schema(field.kind, &field.rule, definitions);
    match field.kind {
        Type::List(_) | Type::Map(_) | Type::Struct(_) | Type::Value => {}
        _ => {
            let pick = alone(&PICK, definitions);
            match out.get_mut("anyOf") {
                Some(Value::Array(choices)) => choices.push(pick),
                _ => {
                    let value = std::mem::take(&mut out);
                    out.insert("anyOf".to_owned(), json!([value, pick]));
                }
            }
        }
    }
    if out.contains_key("$ref") {
        let reference = std::mem::take(&mut out);
        out.insert("allOf".to_owned(), json!([reference]));
    }
    let mut description = prose(field.doc);
    if !field.rule.unit.is_empty() && !description.contains(field.rule.unit) {
        description = format!("{description} Unit: {}.", field.rule.unit.trim_start_matches("in "));
    }
    out.insert("description".to_owned(), json!(description));
    if let Some(default) = field.default.map(|default| default())
        && default != Form::Absent
    {
        out.insert("default".to_owned(), json_form(&default));
    }
    out
}

fn type_schema(kind: Type, rule: &Rule, definitions: &mut Map<String, Value>) -> Map<String, Value> {
    let value = match kind {
        Type::Bool => or_expression(json!({ "type": "boolean" })),
        Type::Number => or_expression(Value::Object(number("number", rule))),
        Type::Integer => or_expression(Value::Object(number("integer", rule))),
        Type::Text | Type::File => json!({ "type": "string", "minLength": 1 }),
        Type::Pair => or_expression(vector(rule, 2)),
        Type::Vector => or_expression(vector(rule, 3)),
        Type::Rows => json!({ "type": "array", "items": or_expression(vector(rule, 4)), "minItems": 3, "maxItems": 3 }),
        Type::Color => json!({ "anyOf": [
            number("number", rule),
            vector(rule, 3),
            { "type": "string", "pattern": "^(#[0-9a-fA-F]{6}$|=)" },
        ] }),
        Type::Value => json!({}),
        Type::List(inner) => {
            let item = Value::Object(type_schema(*inner, rule, definitions));
            let (repeat, pick) = (alone(&REPEAT, definitions), alone(&PICK, definitions));
            let list = json!({ "type": "array", "items": { "anyOf": [item, repeat, pick] } });
            if kind.is_of_values() { or_expression(list) } else { list }
        }
        Type::Map(inner) => {
            json!({ "type": "object", "additionalProperties": type_schema(*inner, rule, definitions) })
        }
        // `null` is JSON's own word for it.
        Type::Optional(inner) => {
            json!({ "anyOf": [type_schema(*inner, rule, definitions), { "enum": ["None"] }, { "type": "null" }] })
        }
        Type::OneOf(kinds) => {
            let mut kinds: Vec<Value> =
                kinds.iter().map(|&kind| Value::Object(type_schema(kind, rule, definitions))).collect();
            if kind.is_texture() {
                kinds.push(json!({ "type": "string", "pattern": "^[^#=]", "description": "A name from `textures`." }));
            }
            json!({ "anyOf": kinds })
        }
        Type::Struct(def) => {
            // A kind may have the name of a choice, as a mapping by an object's coordinates has.
            let choice = CHOICES.iter().any(|choice| choice.name == def.name);
            let name = if choice { format!("{}Kind", def.name) } else { def.name.to_owned() };
            reference(&name, definitions, |definitions| struct_schema(def, definitions))
        }
        Type::Enum(def) => reference(def.name, definitions, |definitions| enum_schema(def, definitions)),
        Type::Later(kind) => return type_schema(kind(), rule, definitions),
    };
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// `{ "Repeat": { .. } }`
fn alone(def: &'static StructDef, definitions: &mut Map<String, Value>) -> Value {
    let fields = reference(def.name, definitions, |definitions| struct_schema(def, definitions));
    json!({
        "type": "object",
        "properties": { (def.name): fields },
        "required": [def.name],
        "additionalProperties": false,
    })
}

fn reference(
    name: &str,
    definitions: &mut Map<String, Value>,
    make: impl FnOnce(&mut Map<String, Value>) -> Map<String, Value>,
) -> Value {
    // The words of a type that has another form in Rust are the type's own in the schema.
    let name = name.trim_end_matches("Words");
    if !definitions.contains_key(name) {
        // Holds the place, so that definitions stand in the order of their first use.
        definitions.insert(name.to_owned(), Value::Null);
        let definition = make(definitions);
        definitions.insert(name.to_owned(), Value::Object(definition));
    }
    json!({ "$ref": format!("#/definitions/{name}") })
}

fn enum_schema(def: &'static EnumDef, definitions: &mut Map<String, Value>) -> Map<String, Value> {
    let units: Vec<&VariantDef> =
        def.variants.iter().filter(|variant| matches!(variant.content, Content::Unit)).collect();
    let mut choices = Vec::new();
    if !units.is_empty() {
        let names: Vec<&str> = units.iter().map(|variant| variant.name).collect();
        let docs: Vec<String> = units.iter().map(|variant| prose(variant.doc)).collect();
        choices.push(json!({ "enum": names, "x-taplo": { "docs": { "enumValues": docs } } }));
        if names.contains(&"None") {
            choices.push(json!({ "type": "null" }));
        }
    }
    for variant in def.variants {
        let content = match &variant.content {
            Content::Unit => continue,
            Content::Value(at) => type_schema(at.kind, &at.rule, definitions),
            Content::Struct(fields) => {
                let fields_schema = type_schema(Type::Struct(fields), &Rule::ANY, definitions);
                match fields.bare.and_then(|bare| fields.field(bare)) {
                    Some(bare) => {
                        let bare = type_schema(bare.kind, &bare.rule, definitions);
                        Map::from_iter([("anyOf".to_owned(), json!([fields_schema, bare]))])
                    }
                    None => fields_schema,
                }
            }
        };
        choices.push(json!({
            "type": "object",
            "description": variant.prose(),
            "properties": { variant.name: content },
            "required": [variant.name],
            "additionalProperties": false,
        }));
    }
    let mut out = Map::new();
    out.insert("description".to_owned(), json!(prose(def.doc)));
    out.insert("anyOf".to_owned(), json!(choices));
    out
}

fn number(kind: &str, rule: &Rule) -> Map<String, Value> {
    let range = &rule.range;
    let mut out = Map::new();
    out.insert("type".to_owned(), json!(kind));
    if range.low.is_finite() {
        out.insert(if range.above_low { "exclusiveMinimum" } else { "minimum" }.to_owned(), json_number(range.low));
    }
    // Where a texture's own colours end, what it is of decides.
    if range.high.is_finite() && !rule.of_texture {
        out.insert(if range.below_high { "exclusiveMaximum" } else { "maximum" }.to_owned(), json_number(range.high));
    }
    out
}

/// The value itself, or an expression in its place.
fn or_expression(value: Value) -> Value {
    json!({ "anyOf": [value, { "type": "string", "pattern": "^=" }] })
}

fn vector(rule: &Rule, count: usize) -> Value {
    let item = or_expression(Value::Object(number("number", rule)));
    json!({ "type": "array", "items": item, "minItems": count, "maxItems": count })
}

fn json_number(value: f64) -> Value {
    if value.fract() == 0.0 && value.abs() < 9e15 { json!(value as i64) } else { json!(value) }
}

/// A form as TOML and JSON write it.
fn json_form(form: &Form) -> Value {
    match form {
        Form::Absent => Value::Null,
        Form::Bool(value) => json!(value),
        Form::Number(value) => json_number(*value),
        Form::Integer(value) => json!(value),
        Form::Lexeme(text) | Form::Text(text) => json!(text),
        Form::Vector(numbers) => Value::Array(numbers.iter().map(json_form).collect()),
        Form::List(entries) => Value::Array(entries.iter().map(|entry| json_form(&entry.value)).collect()),
        Form::Map(entries) | Form::Struct { fields: entries, .. } => {
            Value::Object(entries.iter().map(|entry| (entry.name.to_string(), json_form(&entry.value))).collect())
        }
        Form::Variant { name, content: None } => json!(name),
        Form::Variant { name, content: Some(content) } => json!({ *name: json_form(content) }),
    }
}
