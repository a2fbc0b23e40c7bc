//! The scenes that a command line names: files, and folders of them.

use crate::failure::Failure;
use scene_format::Syntax;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// The scenes of files and folders, those of a folder in order of their names, each once however often it is named.
///
/// # Errors
/// A folder has none.
pub fn named(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut scenes = Vec::new();
    for path in paths {
        if path.is_dir() {
            let before = scenes.len();
            find(path, &mut scenes);
            if scenes.len() == before && paths.len() > 1 {
                // Told in its turn, beside what the others are.
                scenes.push(path.clone());
            } else if scenes.len() == before {
                return Err(Failure::wrong(format!("there is no scene in the folder {}", path.display())));
            }
        } else {
            scenes.push(path.clone());
        }
    }
    let mut known = HashSet::new();
    // Links are files of their own.
    scenes.retain(|path| known.insert(std::path::absolute(path).unwrap_or_else(|_| path.clone())));
    Ok(scenes)
}

/// The scenes in a folder and below, in order of their names: `.ron`, and `.toml` and `.json` that have objects.
/// Hidden folders are left out.
fn find(folder: &Path, scenes: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        // A link may lead back to where it stands.
        if path.is_dir() && !path.is_symlink() && !hidden {
            find(&path, scenes);
        } else if path.is_file() && is_scene(&path) {
            scenes.push(path);
        }
    }
}

/// TOML and JSON files are many things.
pub(super) fn is_scene(path: &Path) -> bool {
    match Syntax::from_path(path) {
        Some(Syntax::Ron) => true,
        Some(Syntax::Toml) => std::fs::read(path).is_ok_and(|bytes| bytes.windows(7).any(|word| word == b"objects")),
        Some(Syntax::Json) => std::fs::read(path).is_ok_and(|bytes| has_list_of_objects(&bytes)),
        None => false,
    }
}

/// Whether `"objects": [` stands in a text: a report counts objects, and a schema describes them.
fn has_list_of_objects(text: &[u8]) -> bool {
    const NAME: &[u8] = b"\"objects\"";
    text.windows(NAME.len()).enumerate().filter(|(_, word)| *word == NAME).any(|(at, _)| {
        let mut signs = text[at + NAME.len()..].iter().filter(|byte| !byte.is_ascii_whitespace());
        signs.next() == Some(&b':') && signs.next() == Some(&b'[')
    })
}
