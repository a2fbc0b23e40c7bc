//! From JSON Schema to types of Python.

use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write as _;

const HEAD: &str = r#""""The words of scenes as types, for editors and type checkers.

Made of the schema (`tracer schema`); `UPDATE_EXPECT=1 cargo test -p tracer-python --test words` makes it anew.

>>> from tracer.words import SceneDict
>>> scene: SceneDict = {"background": 1, "objects": [{"Sphere": {"center": [0, 0, 0], "radius": 1}}]}
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict, Literal, Sequence, TypedDict
from typing import Union as Either

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._assets import Mesh as MeshArrays

    Array = npt.NDArray[Any]
    File = Either[str, "os.PathLike[str]", Array, MeshArrays]
else:
    Array = Any
    File = Any

"#;

/// Words of Python, which are no names of fields there.
const KEYWORDS: [&str; 8] = ["from", "in", "is", "as", "for", "with", "global", "class"];

/// What is made of a schema.
#[derive(Default)]
struct Made {
    text: String,
    /// Objects of one field, by their names: the field, and the type of what it holds.
    items: BTreeMap<String, (String, String)>,
}

/// The module of a schema.
pub fn module(schema: &Value) -> String {
    let mut made = Made::default();
    for (name, definition) in schema["definitions"].as_object().into_iter().flatten() {
        made.definition(name, definition);
    }
    made.definition("SceneDict", schema);
    let mut text = HEAD.to_owned();
    for (name, (field, held)) in &made.items {
        let _ = writeln!(text, "{name} = TypedDict(\"{name}\", {{\"{field}\": {}}})", quoted(held));
    }
    text + "\n" + &made.text
}

/// A type in quotes: what it names may come later.
fn quoted(kind: &str) -> String {
    let single = kind.replace('"', "'");
    format!("\"{single}\"")
}

impl Made {
    fn definition(&mut self, name: &str, definition: &Value) {
        let Some(fields) = definition["properties"].as_object() else {
            let kind = self.kind(definition);
            let _ = writeln!(self.text, "{name} = {}\n", forward(&kind));
            return;
        };
        let required =
            |field: &str| definition["required"].as_array().is_some_and(|names| names.iter().any(|name| name == field));
        let mut doc = prose(&definition["description"]);
        let (mut must, mut may) = (Vec::new(), Vec::new());
        for (field, schema) in fields {
            let kind = if field == "file" { "File".to_owned() } else { self.kind(schema) };
            let told = prose(&schema["description"]);
            if !told.is_empty() {
                let _ = write!(
                    doc,
                    "{}{field}: {told}",
                    if doc.contains(": ") && doc.contains('\n') { "\n" } else { "\n\n" }
                );
            }
            if required(field) { must.push((field, kind)) } else { may.push((field, kind)) }
        }
        if fields.keys().any(|field| KEYWORDS.contains(&field.as_str()) || field.starts_with('$')) {
            // As calls, which take any name.
            let list = |fields: &[(&String, String)]| {
                let pairs: Vec<String> =
                    fields.iter().map(|(field, kind)| format!("    \"{field}\": {},\n", quoted(kind))).collect();
                pairs.concat()
            };
            let base = format!("_{name}Fields");
            let _ = writeln!(
                self.text,
                "_{name}Required = TypedDict(\n    \"_{name}Required\",\n    {{\n{}    }},\n)",
                list(&must)
            );
            let _ = writeln!(self.text, "{base} = TypedDict(\"{base}\", {{\n{}}}, total=False)\n\n", list(&may));
            let _ = writeln!(self.text, "class {name}(_{name}Required, {base}, total=False):\n{}\n", docstring(&doc));
            return;
        }
        let lines = |fields: &[(&String, String)]| -> String {
            fields.iter().map(|(field, kind)| format!("    {field}: {kind}\n")).collect()
        };
        let base = if must.is_empty() {
            "TypedDict".to_owned()
        } else {
            let _ = writeln!(self.text, "class _{name}Required(TypedDict):\n{}\n", lines(&must));
            format!("_{name}Required")
        };
        let _ = write!(self.text, "class {name}({base}, total=False):\n{}", docstring(&doc));
        let _ = writeln!(self.text, "{}{}\n", if may.is_empty() { "" } else { "\n" }, lines(&may));
    }

    /// The type of a schema.
    fn kind(&mut self, schema: &Value) -> String {
        if let Some(reference) = schema["$ref"].as_str() {
            return reference.rsplit('/').next().unwrap_or_default().to_owned();
        }
        if let Some(choices) = schema["anyOf"].as_array().or(schema["allOf"].as_array()) {
            return self.union(choices);
        }
        if let Some(words) = schema["enum"].as_array() {
            let words: Vec<String> = words.iter().map(Value::to_string).collect();
            return format!("Literal[{}]", words.join(", "));
        }
        if let Some(word) = schema.get("const") {
            return format!("Literal[{word}]");
        }
        match schema["type"].as_str() {
            Some("number") => "float".to_owned(),
            Some("integer") => "int".to_owned(),
            Some("string") => "str".to_owned(),
            Some("boolean") => "bool".to_owned(),
            Some("array") => {
                let item = self.kind(&schema["items"]);
                let list = format!("Sequence[{item}]");
                if is_numbers(&item) { format!("Either[{list}, Array]") } else { list }
            }
            Some("object") => self.object(schema),
            _ => "Any".to_owned(),
        }
    }

    fn object(&mut self, schema: &Value) -> String {
        match schema["properties"].as_object() {
            Some(fields) if fields.len() == 1 => {
                let (field, held) = fields.iter().next().expect("there is one");
                let held = self.kind(held);
                let mut name = format!("{field}Item");
                // The same word may hold something else somewhere else.
                while self.items.get(&name).is_some_and(|(_, other)| *other != held) {
                    name.push('_');
                }
                self.items.insert(name.clone(), (field.clone(), held));
                name
            }
            Some(_) => "Dict[str, Any]".to_owned(),
            None => {
                let held = schema.get("additionalProperties").filter(|held| held.is_object());
                format!("Dict[str, {}]", held.map_or("Any".to_owned(), |held| self.kind(held)))
            }
        }
    }

    fn union(&mut self, choices: &[Value]) -> String {
        let mut kinds: Vec<String> = Vec::new();
        for choice in choices {
            let kind = self.kind(choice);
            let inner = kind.strip_prefix("Either[").and_then(|kind| kind.strip_suffix(']'));
            let parts = inner.map_or(vec![kind.clone()], parts);
            kinds.extend(parts.into_iter().filter(|part| !kinds.contains(part)).collect::<Vec<_>>());
        }
        if kinds.iter().any(|kind| kind == "Any") {
            return "Any".to_owned();
        }
        match kinds.as_slice() {
            [only] => only.clone(),
            kinds => format!("Either[{}]", kinds.join(", ")),
        }
    }
}

/// The members of a union, whose own brackets may hold commas.
fn parts(list: &str) -> Vec<String> {
    let (mut depth, mut parts, mut part) = (0, Vec::new(), String::new());
    for c in list.chars() {
        match c {
            '[' => depth += 1,
            ']' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(std::mem::take(&mut part).trim().to_owned());
                continue;
            }
            _ => {}
        }
        part.push(c);
    }
    parts.push(part.trim().to_owned());
    parts
}

/// Whether arrays can stand for a list of these.
fn is_numbers(kind: &str) -> bool {
    let words: Vec<&str> = kind.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let known = ["float", "int", "str", "Either", "Sequence", "Array", "RepeatItem", "PickItem"];
    words.iter().any(|word| ["float", "int"].contains(word)) && words.iter().all(|word| known.contains(word))
}

/// A type as an alias holds it: names in quotes, as they may come later.
fn forward(kind: &str) -> String {
    let Some(inner) = kind.strip_prefix("Either[").and_then(|kind| kind.strip_suffix(']')) else {
        return kind.to_owned();
    };
    let quoted: Vec<String> = parts(inner)
        .into_iter()
        .map(|part| if part.starts_with("Literal[") { part } else { format!("\"{part}\"") })
        .collect();
    format!("Either[{}]", quoted.join(", "))
}

fn prose(text: &Value) -> String {
    let text = text.as_str().unwrap_or_default().replace('\\', "\\\\").replace("\"\"\"", "'''");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn docstring(doc: &str) -> String {
    let indented = doc.trim_start().replace('\n', "\n    ").replace("\n    \n", "\n\n");
    match indented.contains('\n') {
        true => format!("    \"\"\"{indented}\n    \"\"\"\n"),
        false => format!("    \"\"\"{indented}\"\"\"\n"),
    }
}
