//! The generated documents are what the types say, and every explained code is what its example gives.

mod common;

use common::diagnostics;
use scene_format::codes::CODES;
use scene_format::{Syntax, diagnostics_reference, explain, reference, schema};
use std::path::Path;

/// Compares a committed file with what it should be; `UPDATE_EXPECT=1` writes it.
fn assert_file(name: &str, expected: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(name);
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, expected).unwrap_or_else(|error| panic!("cannot write {}: {error}", path.display()));
    }
    let actual = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        actual == expected,
        "docs/{name} is not what the types say; UPDATE_EXPECT=1 cargo test -p scene-format writes it anew"
    );
}

#[test]
fn the_reference_is_up_to_date() {
    assert_file("scene-reference.md", &reference());
}

#[test]
fn the_diagnostics_page_is_up_to_date() {
    assert_file("diagnostics.md", &diagnostics_reference());
}

#[test]
fn the_example_of_every_code_gives_that_code() {
    for code in CODES {
        let text: String =
            code.text.lines().map(|line| format!("{}\n", line.strip_prefix(' ').unwrap_or(line))).collect();
        for (fence, syntax) in [("```ron\n", Syntax::Ron), ("```toml\n", Syntax::Toml)] {
            let Some((_, rest)) = text.split_once(fence) else { continue };
            let (example, _) = rest.split_once("```").expect("the fence is closed");
            let codes: Vec<&str> =
                diagnostics(example, syntax).iter().map(|diagnostic| diagnostic.code.as_str()).collect();
            assert!(codes.contains(&code.code.as_str()), "the example of {} gives {codes:?}", code.code);
            assert!(
                codes.iter().all(|found| *found == code.code.as_str() || *found == "W0301"),
                "the example of {} gives more: {codes:?}",
                code.code
            );
        }
    }
}

#[test]
fn codes_are_unique_sorted_within_their_letter_and_explained() {
    for pair in CODES.windows(2) {
        assert!(pair[0].code < pair[1].code, "{} before {}", pair[0].code, pair[1].code);
    }
    for code in CODES {
        assert_eq!(explain(&code.code.as_str().to_lowercase()), Some(code.text));
        assert!(code.text.len() > 40, "{} says too little", code.code);
    }
    assert_eq!(explain("E9999"), None);
}

#[test]
fn every_part_of_the_schema_is_closed_and_described() {
    let schema: serde_json::Value = serde_json::from_str(&schema()).expect("the schema is JSON");
    assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    assert_eq!(schema["additionalProperties"], false);
    let definitions = schema["definitions"].as_object().expect("definitions");
    assert!(definitions.len() > 20);
    for (name, definition) in definitions {
        assert!(definition["description"].as_str().is_some_and(|text| !text.is_empty()), "{name} has no description");
        if definition["type"] == "object" {
            assert_eq!(definition["additionalProperties"], false, "{name}");
        }
    }
}
