//! Each edit that is offered makes a file better: every stored broken scene, every edit of it by itself, and all of
//! them together.

use scene_format::diagnostic::Edit;
use scene_format::{Diagnostic, LoadError, Severity, Syntax, load_bytes, render};
use std::path::Path;

/// The errors of a text.
fn errors(bytes: &[u8], syntax: Syntax) -> Vec<Diagnostic> {
    match load_bytes("scene", bytes.to_vec(), Some(syntax), Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            diagnostics.into_iter().filter(|fault| fault.severity == Severity::Error).collect()
        }
        _ => Vec::new(),
    }
}

/// Edits after which as many errors are left, for the reason beside them.
const NO_FEWER: [(&str, &str); 2] = [
    ("word_true_capital.toml", "true is a word then, but not where it stands"),
    ("word_undefined.json", "null is a value then, but not where it stands"),
];

#[test]
fn every_offered_edit_leaves_fewer_errors() {
    let mut wrong = Vec::new();
    let mut tried = 0;
    for (syntax, extension) in [(Syntax::Ron, "ron"), (Syntax::Toml, "toml"), (Syntax::Json, "json")] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken").join(extension);
        for entry in std::fs::read_dir(folder).expect("the folder of broken scenes") {
            let path = entry.expect("an entry of the folder").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.extension().is_none_or(|found| found != extension) || NO_FEWER.iter().any(|(file, _)| *file == name)
            {
                continue;
            }
            let bytes = std::fs::read(&path).expect("a scene file");
            let Ok(text) = String::from_utf8(bytes.clone()) else { continue };
            let before = errors(&bytes, syntax);
            let edits: Vec<Edit> = before.iter().filter_map(|fault| fault.edit.clone()).collect();
            let all = (edits.len() > 1).then(|| edits.clone());
            for edits in edits.into_iter().map(|edit| vec![edit]).chain(all) {
                tried += 1;
                let mended = render::apply_edits(&text, &edits);
                let after = errors(mended.as_bytes(), syntax);
                if after.len() >= before.len() {
                    let messages: Vec<&str> = after.iter().map(|fault| &*fault.message).collect();
                    wrong.push(format!(
                        "{name}: {} before, {} after {edits:?}: {messages:#?}",
                        before.len(),
                        after.len()
                    ));
                }
            }
        }
    }
    assert!(tried > 150, "only {tried} edits");
    assert!(wrong.is_empty(), "{} of {tried}:\n{}", wrong.len(), wrong.join("\n"));
}
