//! Diagnostics as a SARIF 2.1.0 document (OASIS, 2020), which code scanning of hosts and editors reads.

use super::{Lines, Severity, lines};
use crate::codes::find;
use crate::diagnostic::{Diagnostic, Source, Span};
use crate::written::in_their_syntax;
use serde_json::{Value, json};

/// What was found in any number of scenes; it becomes one document.
#[derive(Clone, Debug, Default)]
pub struct Sarif {
    rules: Vec<Value>,
    codes: Vec<&'static str>,
    results: Vec<Value>,
}

impl Sarif {
    /// Adds diagnostics; `sources` are the texts that their spans point into.
    pub fn add(&mut self, diagnostics: &[Diagnostic], sources: &[Source]) {
        let lines = lines(sources);
        for diagnostic in &in_their_syntax(diagnostics, sources) {
            let rule = self.rule(diagnostic);
            self.results.push(result(diagnostic, &lines, rule));
        }
    }

    /// The number of a code among the rules; a new one is added with its explanation.
    fn rule(&mut self, diagnostic: &Diagnostic) -> usize {
        let code = diagnostic.code.as_str();
        if let Some(known) = self.codes.iter().position(|known| *known == code) {
            return known;
        }
        let (title, text) = find(code).map_or((code, ""), |entry| (entry.title, entry.text));
        let text: Vec<&str> = text.trim_end().lines().map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
        let help = if text.is_empty() { title.to_owned() } else { text.join("\n") };
        self.codes.push(code);
        self.rules.push(json!({
            "id": code,
            "shortDescription": { "text": title },
            "help": { "text": help, "markdown": help },
            "defaultConfiguration": { "level": level(diagnostic.severity) },
        }));
        self.codes.len() - 1
    }

    /// The document, with a line feed at its end. `version`: the program's; `done`: whether it came to its end.
    pub fn document(&self, version: &str, done: bool) -> String {
        let driver = json!({ "name": "tracer", "version": version, "rules": self.rules });
        let document = json!({
            "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
            "version": "2.1.0",
            "runs": [{
                "tool": { "driver": driver },
                "columnKind": "unicodeCodePoints",
                "invocations": [{ "executionSuccessful": done }],
                "results": self.results,
            }],
        });
        // Texts and numbers only: this cannot fail.
        serde_json::to_string_pretty(&document).unwrap_or_default() + "\n"
    }
}

fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    }
}

fn result(diagnostic: &Diagnostic, lines: &[Lines<'_>], rule: usize) -> Value {
    let mut text = diagnostic.message.clone();
    for (what, more) in [("expected", &diagnostic.expected), ("hint", &diagnostic.hint)] {
        if !more.is_empty() {
            text += &format!("\n{what}: {more}");
        }
    }
    let mut result = json!({
        "ruleId": diagnostic.code.as_str(),
        "ruleIndex": rule,
        "level": level(diagnostic.severity),
        "message": { "text": text },
    });
    let at_line = diagnostic.elsewhere.as_ref().map(|file| {
        let uri = uri(&file.path.display().to_string());
        match file.line {
            0 => json!({ "artifactLocation": { "uri": uri } }),
            line => json!({ "artifactLocation": { "uri": uri }, "region": { "startLine": line } }),
        }
    });
    let mut related: Vec<Value> = Vec::new();
    let place = physical(diagnostic.span, lines);
    if let Some(physical) = place.clone().or_else(|| at_line.clone()) {
        let mut location = json!({ "physicalLocation": physical });
        if !diagnostic.path.is_empty() {
            location["logicalLocations"] = json!([{ "fullyQualifiedName": diagnostic.path, "kind": "member" }]);
        }
        result["locations"] = json!([location]);
    }
    for label in &diagnostic.labels {
        let physical = physical(label.span, lines);
        related.extend(physical.map(|place| json!({ "physicalLocation": place, "message": { "text": label.text } })));
    }
    if let (Some(_), Some(file)) = (place, at_line) {
        related.push(json!({ "physicalLocation": file, "message": { "text": "in this file" } }));
    }
    if !related.is_empty() {
        result["relatedLocations"] = related.into();
    }
    if let Some(edit) = &diagnostic.edit
        && let Some(file) = physical(edit.span, lines)
    {
        let inserted = json!({ "text": edit.replacement });
        let replacement = json!({ "deletedRegion": file["region"], "insertedContent": inserted });
        let change = json!({ "artifactLocation": file["artifactLocation"], "replacements": [replacement] });
        result["fixes"] = json!([{ "description": { "text": diagnostic.hint }, "artifactChanges": [change] }]);
    }
    result
}

/// A file and a region in it; columns count characters from 1, and the end is one past the last.
fn physical(span: Span, lines: &[Lines<'_>]) -> Option<Value> {
    let source = lines.get(span.source as usize)?;
    let range = source.range(span);
    let position = |byte| source.index.position(&source.source.text, byte);
    let (start, end) = (position(range.start), position(range.end));
    let region = json!({
        "startLine": start.line,
        "startColumn": start.column,
        "endLine": end.line,
        "endColumn": end.column,
    });
    Some(json!({ "artifactLocation": { "uri": uri(&source.source.name) }, "region": region }))
}

/// A path as a URI reference: relative paths stay so.
fn uri(path: &str) -> String {
    let mut out = String::new();
    // Of Windows: C:\scenes is file:///C:/scenes.
    let drive = path.as_bytes().get(1) == Some(&b':');
    if path.starts_with('/') {
        out += "file://";
    } else if drive {
        out += "file:///";
    }
    for (at, byte) in path.bytes().enumerate() {
        match byte {
            b'\\' => out.push('/'),
            b':' if drive && at == 1 => out.push(':'),
            b'/' | b'.' | b'-' | b'_' | b'~' => out.push(byte.into()),
            byte if byte.is_ascii_alphanumeric() => out.push(byte.into()),
            byte => out += &format!("%{byte:02X}"),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LoadError, Syntax, load_str};
    use std::path::Path;

    #[test]
    fn paths_are_uris() {
        for (path, expected) in [
            ("scenes/a b.ron", "scenes/a%20b.ron"),
            ("/tmp/ä.ron", "file:///tmp/%C3%A4.ron"),
            ("C:\\x\\y.ron", "file:///C:/x/y.ron"),
            ("<stdin>", "%3Cstdin%3E"),
        ] {
            assert_eq!(uri(path), expected);
        }
    }

    /// What the schema asks of the objects that are written here (SARIF 2.1.0, sections 3.13 to 3.57).
    #[test]
    fn a_document_has_what_the_standard_asks_for() {
        let text =
            "Scene(\n  background: 1, // ä\n  objects: [Sphere(center: (0, 0, 0), radus: 1), Sphere(center: 1)],\n)";
        let Err(LoadError::Invalid { diagnostics, sources, .. }) =
            load_str("a b.ron", text, Syntax::Ron, Path::new(""), &[])
        else {
            panic!("faults")
        };
        let mut sarif = Sarif::default();
        sarif.add(&diagnostics, &sources);
        sarif.add(&diagnostics, &sources);
        let document: Value = serde_json::from_str(&sarif.document("1.2.3", true)).expect("JSON");
        assert_eq!(document["version"], "2.1.0");
        let run = &document["runs"][0];
        let driver = &run["tool"]["driver"];
        assert_eq!((&driver["name"], &driver["version"]), (&json!("tracer"), &json!("1.2.3")));
        let rules = driver["rules"].as_array().expect("rules");
        let results = run["results"].as_array().expect("results");
        assert_eq!(results.len(), 2 * diagnostics.len());
        for result in results {
            let rule = &rules[result["ruleIndex"].as_u64().expect("a number") as usize];
            assert_eq!(rule["id"], result["ruleId"]);
            assert!(rule["help"]["text"].as_str().is_some_and(|help| help.len() > 20), "{rule}");
            assert!(result["message"]["text"].is_string() && result["level"] == "error");
            let place = &result["locations"][0]["physicalLocation"];
            assert_eq!(place["artifactLocation"]["uri"], "a%20b.ron");
            let region = &place["region"];
            for field in ["startLine", "startColumn", "endLine", "endColumn"] {
                assert!(region[field].as_u64().is_some_and(|number| number > 0), "{region}");
            }
        }
        let mistyped = results.iter().find(|result| result["ruleId"] == "E0201").expect("radus");
        let change = &mistyped["fixes"][0]["artifactChanges"][0];
        assert_eq!(change["replacements"][0]["insertedContent"]["text"], "radius");
        let region = json!({ "startLine": 3, "startColumn": 39, "endLine": 3, "endColumn": 44 });
        assert_eq!(change["replacements"][0]["deletedRegion"], region);
        // Codes are rules once.
        let mut ids: Vec<&str> = rules.iter().filter_map(|rule| rule["id"].as_str()).collect();
        ids.dedup();
        assert_eq!(ids.len(), rules.len());
        assert!(ids.len() < results.len());
    }
}
