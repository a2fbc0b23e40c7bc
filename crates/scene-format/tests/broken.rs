//! Broken scene files and the exact text that is said about each: `broken/<syntax>/<name>.<syntax>` with `<name>.txt`
//! beside it.
//!
//! `UPDATE_EXPECT=1 cargo test -p scene-format --test broken` writes the texts anew; read the difference before
//! committing it.

use scene_format::{LoadError, Syntax, load_bytes, render};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn files(extension: &str, folder: &Path) -> BTreeSet<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the folder of broken scenes");
    let paths = entries.map(|entry| entry.expect("an entry of the folder").path());
    paths.filter(|path| path.extension().is_some_and(|found| found == extension)).collect()
}

/// What is said about a scene file, in text and as JSON lines.
fn output(path: &Path, syntax: Syntax) -> String {
    let name = path.file_name().and_then(|name| name.to_str()).expect("a plain name");
    let bytes = std::fs::read(path).expect("a scene file");
    match load_bytes(name, bytes, Some(syntax), Path::new("tests/broken"), &[]) {
        Ok(loaded) => {
            assert!(!loaded.warnings.is_empty(), "nothing is wrong with {name}");
            render::text(&loaded.warnings, &loaded.scene.sources, render::Style::default())
        }
        Err(LoadError::Invalid { diagnostics, sources, .. }) => {
            render::text(&diagnostics, &sources, render::Style::default())
        }
        Err(error) => panic!("{name}: {error}"),
    }
}

fn check(syntax: Syntax, extension: &str, least: usize) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken").join(extension);
    let update = std::env::var_os("UPDATE_EXPECT").is_some();
    let scenes = files(extension, &folder);
    assert!(scenes.len() >= least, "only {} broken scenes in {extension}", scenes.len());
    let mut wrong = Vec::new();
    for scene in &scenes {
        let expected = scene.with_extension("txt");
        let actual = output(scene, syntax);
        if update {
            std::fs::write(&expected, &actual).expect("write the expected text");
        }
        match std::fs::read_to_string(&expected) {
            Ok(text) if text == actual => {}
            Ok(text) => wrong.push(format!("{}\nexpected:\n{text}\nactual:\n{actual}", scene.display())),
            Err(_) => wrong.push(format!("{} has no expected text; it gives:\n{actual}", scene.display())),
        }
    }
    for text in files("txt", &folder) {
        if !scenes.contains(&text.with_extension(extension)) {
            wrong.push(format!("{} belongs to no scene", text.display()));
        }
    }
    assert!(wrong.is_empty(), "{} of {} differ:\n\n{}", wrong.len(), scenes.len(), wrong.join("\n\n"));
}

#[test]
fn broken_ron_scenes_are_told_word_for_word() {
    check(Syntax::Ron, "ron", 120);
}

#[test]
fn broken_toml_scenes_are_told_word_for_word() {
    check(Syntax::Toml, "toml", 120);
}

#[test]
fn broken_json_scenes_are_told_word_for_word() {
    check(Syntax::Json, "json", 60);
}

/// The files `seven_faults.*` hold seven faults of seven kinds: those are said, each once, and nothing else.
#[test]
fn seven_faults_are_exactly_seven_diagnostics() {
    for (syntax, extension) in [(Syntax::Ron, "ron"), (Syntax::Toml, "toml"), (Syntax::Json, "json")] {
        let path =
            Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/broken/{extension}/seven_faults.{extension}"));
        let bytes = std::fs::read(&path).expect("the file with seven faults");
        let Err(LoadError::Invalid { diagnostics, .. }) = load_bytes("seven", bytes, Some(syntax), Path::new(""), &[])
        else {
            panic!("seven faults")
        };
        let mut codes: Vec<&str> = diagnostics.iter().map(|diagnostic| diagnostic.code.as_str()).collect();
        codes.sort_unstable();
        assert_eq!(codes, ["E0104", "E0201", "E0202", "E0203", "E0204", "E0301", "E0401"], "{extension}");
    }
}
