//! JSON: what `serde_json` takes, and scenes that go through all syntaxes.

mod common;

use common::generated::{plain, scene};
use common::threads::for_all;
use common::{Random, errors};
use scene_format::{Defaults, Syntax, convert, to_text};
use std::path::Path;

/// Every scene of the repository goes from RON to JSON to TOML to RON, and says what it said, word for word but for
/// its comments.
#[test]
fn scenes_go_round_all_syntaxes() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut folders = ["scenes", "golden", "crates/tracer/templates"].map(|folder| top.join(folder)).to_vec();
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
            let path = entry.expect("an entry").path();
            match Syntax::from_path(&path) {
                _ if path.is_dir() => folders.push(path),
                Some(syntax) => files.push((folder.clone(), path, syntax)),
                None => {}
            }
        }
    }
    let seen = for_all(&files, |(folder, path, syntax)| goes_round(folder, path, *syntax));
    let seen = seen.into_iter().filter(|is_scene| *is_scene).count();
    assert!(seen > 100, "only {seen} scenes");
}

/// One of them; whether it is a scene.
fn goes_round(folder: &Path, path: &Path, syntax: Syntax) -> bool {
    let text = std::fs::read_to_string(path).expect("a scene");
    // A library, which scenes include, is none by itself.
    let Ok(loaded) = scene_format::load_str("s", &text, syntax, folder, &[]) else {
        assert!(!text.contains("objects"), "{}", path.display());
        return false;
    };
    let name = path.display().to_string();
    let go = |text: &str, from: Syntax, to: Syntax| {
        convert(&name, text, from, to).unwrap_or_else(|error| panic!("{name}: {error:?}\n{text}"))
    };
    let json = go(&text, syntax, Syntax::Json);
    assert!(serde_json::from_str::<serde_json::Value>(&json).is_ok(), "{name}:\n{json}");
    let toml = go(&json, Syntax::Json, Syntax::Toml);
    let ron = go(&toml, Syntax::Toml, Syntax::Ron);
    for (text, syntax) in [(&json, Syntax::Json), (&toml, Syntax::Toml), (&ron, Syntax::Ron)] {
        let back = scene_format::load_str("s", text, syntax, folder, &[]);
        let back = back.unwrap_or_else(|error| panic!("{name}: {error:?}\n{text}")).scene;
        assert_eq!(plain(back), plain(loaded.scene.clone()), "{name}:\n{text}");
    }
    // TOML has plain values before tables; the order of names in an object means nothing.
    let value = |text: &str| serde_json::from_str::<serde_json::Value>(text).expect("JSON");
    assert_eq!(value(&go(&ron, Syntax::Ron, Syntax::Json)), value(&json), "{name}");
    true
}

/// Every JSON text that loads is JSON for `serde_json`, too, with the same texts and numbers.
#[test]
fn serde_json_takes_what_loads() {
    let mut random = Random(8);
    for _ in 0..300 {
        let text = to_text(&scene(&mut random), Syntax::Json, Defaults::Shown);
        assert!(serde_json::from_str::<serde_json::Value>(&text).is_ok(), "{text}");
    }
    const PIECES: [&str; 40] = [
        "0", "1", "-", "+", ".", "e", "E5", "00", "\"", "\\", "\\n", "\\u0041", "\\ud83d", "\\udc08", "'", "a", "é",
        "true", "null", "NaN", "Infinity", "True", "[", "]", "{", "}", ",", ":", " ", "\n", "\t", "\r\n", "\u{a0}",
        "\u{feff}", "//", "/*", "*/", "#", "\u{1}", "_",
    ];
    // Values as `vars`, which take nearly all of them: what is right here is right there, and the other way round.
    let made = (0..20_000).map(|index| {
        let value: String = (0..1 + random.below(5)).map(|_| *random.pick(&PIECES)).collect();
        if index % 2 == 0 { value } else { format!("\"{value}\"") }
    });
    let right = for_all(&made.collect::<Vec<_>>(), |value| {
        let text = format!("{{\"$schema\": {value}, \"background\": 1, \"objects\": [{{\"Box\": {{\"size\": 1}}}}]}}");
        let oracle = serde_json::from_str::<serde_json::Value>(&text);
        let ours = errors(&text, Syntax::Json);
        let syntax = ours.iter().any(|fault| fault.code.as_str().starts_with("E01") || fault.code == "E0607");
        // What is deep or twice is JSON, and no scene.
        assert_eq!(syntax, oracle.is_err(), "{text}: {ours:?}");
        oracle.is_ok()
    });
    let right = right.into_iter().filter(|is_right| *is_right).count();
    assert!(right > 600, "only {right} are right");
}
