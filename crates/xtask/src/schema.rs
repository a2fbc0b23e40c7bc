//! What the JSON Schema of scenes is asked about: right scenes, which it must take, and scenes whose structure is
//! wrong, which it must refuse. `cargo xtask prove schema` has an independent validator ask it.

use anyhow::{Context as _, ensure};
use scene_format::{LoadError, Syntax, convert, examples, load_bytes, schema};
use serde_json::Value;
use std::fs::{create_dir_all, read_dir, read_to_string, write};
use std::path::{Path, PathBuf};

/// What only the reader can tell: which names there are (`"red"` may be that of a texture), what is there twice (in
/// JSON), and how values go together.
const BEYOND_A_SCHEMA: [&str; 27] = [
    "E0205", "E0402", "E0211", "E0306", "E0307", "E0308", "E0309", "E0401", "E0406", "E0407", "E0408", "E0409",
    "E0410", "E0412", "E0540", "E0545", "E0546", "E0560", "E0601", "E0602", "E0603", "E0604", "E0605", "E0606",
    "W0312", "W0313", "E0543",
];

/// Scenes as values, each with what it was.
type Cases = Vec<(String, Value)>;

/// Writes `schema.json`, and as JSON the scenes that are right (`right/`) and those that are wrong (`wrong/`).
///
/// # Errors
/// When files cannot be read or written, when a scene that is right does not load, or when there are few of either.
pub fn run(root: &Path, folder: &Path) -> anyhow::Result<()> {
    if folder.exists() {
        std::fs::remove_dir_all(folder).with_context(|| format!("cannot remove {}", folder.display()))?;
    }
    let (right, wrong) = (right(root)?, wrong(root)?);
    ensure!(right.len() > 1000, "only {} scenes that are right", right.len());
    ensure!(wrong.len() >= 100, "only {} scenes that are wrong", wrong.len());
    for (name, cases) in [("right", right), ("wrong", wrong)] {
        let folder = folder.join(name);
        create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
        for (k, (name, value)) in cases.iter().enumerate() {
            let name: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
            write(folder.join(format!("{k:04}_{name}.json")), serde_json::to_string_pretty(value)?)?;
        }
    }
    Ok(write(folder.join("schema.json"), schema())?)
}

/// All scenes of the repository, the example of each word and the scenes with every word, as TOML and as JSON have
/// them.
fn right(root: &Path) -> anyhow::Result<Cases> {
    let mut cases = Cases::new();
    let full = root.join("crates/scene-format/tests/common");
    let mut texts: Vec<(String, String, Syntax)> =
        examples().into_iter().map(|example| ("example".to_owned(), example.ron, Syntax::Ron)).collect();
    for (name, syntax) in [("full.ron", Syntax::Ron), ("full.toml", Syntax::Toml), ("full.json", Syntax::Json)] {
        texts.push((name.to_owned(), text(&full.join(name))?, syntax));
    }
    for path in files(["scenes", "golden", "crates/tracer/templates"].map(|folder| root.join(folder)).to_vec())? {
        let Some(syntax) = Syntax::from_path(&path) else { continue };
        let text = text(&path)?;
        // A library, which scenes include, has no objects.
        if text.contains("objects") {
            texts.push((path.strip_prefix(root).unwrap_or(&path).display().to_string(), text, syntax));
        }
    }
    for (name, text, syntax) in &texts {
        let as_toml = of_toml(&written(name, text, *syntax, Syntax::Toml)?)?;
        let as_json = written(name, text, *syntax, Syntax::Json)?;
        cases.push((format!("{name} toml"), as_toml));
        cases.push((format!("{name} json"), serde_json::from_str(&as_json).with_context(|| name.clone())?));
    }
    let full = text(&full.join("full.toml"))?;
    cases.push(("with its schema".to_owned(), of_toml(&format!("\"$schema\" = \"scene.schema.json\"\n{full}"))?));
    Ok(cases)
}

/// The broken scenes of the language's tests that a schema can judge.
fn wrong(root: &Path) -> anyhow::Result<Cases> {
    let mut cases = Cases::new();
    let broken = root.join("crates/scene-format/tests/broken");
    for (extension, syntax) in [("toml", Syntax::Toml), ("json", Syntax::Json)] {
        for path in files(vec![broken.join(extension)])? {
            // Some are no text.
            let Ok(text) = read_to_string(&path) else { continue };
            // Broken syntax is no value that a schema could judge.
            let value = match syntax {
                Syntax::Json => serde_json::from_str(&text).ok(),
                _ => of_toml(&text).ok(),
            };
            let Some(value) = value.filter(|_| path.extension().is_some_and(|found| found == extension)) else {
                continue;
            };
            let loaded = load_bytes("scene", text.clone().into_bytes(), Some(syntax), &broken, &[]);
            let Err(LoadError::Invalid { diagnostics, .. }) = loaded else { continue };
            // To a schema these are null, as JSON has no word for them.
            let is_number = ![" nan", " inf"].iter().any(|number| text.contains(number));
            // Nor does it see what stands in other files.
            let judged = |code: &str, source| source == 0 && !BEYOND_A_SCHEMA.contains(&code);
            if is_number && diagnostics.iter().any(|fault| judged(fault.code.as_str(), fault.span.source)) {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                cases.push((name.into_owned(), value));
            }
        }
    }
    Ok(cases)
}

fn text(path: &Path) -> anyhow::Result<String> {
    read_to_string(path).with_context(|| format!("cannot read {}", path.display()))
}

fn of_toml(text: &str) -> anyhow::Result<Value> {
    toml::from_str(text).with_context(|| text.to_owned())
}

/// A scene in another syntax.
fn written(name: &str, text: &str, from: Syntax, to: Syntax) -> anyhow::Result<String> {
    if from == to {
        return Ok(text.to_owned());
    }
    convert(name, text, from, to).map_err(|fault| anyhow::anyhow!("{name}: {fault:?}"))
}

/// All files below some folders, in order.
fn files(mut folders: Vec<PathBuf>) -> anyhow::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in read_dir(&folder).with_context(|| format!("cannot read {}", folder.display()))? {
            let path = entry?.path();
            if path.is_dir() { folders.push(path) } else { files.push(path) }
        }
    }
    files.sort();
    Ok(files)
}
