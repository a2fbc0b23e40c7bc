//! What of a file's own materials is not taken, told in one warning.

use super::files::Files;
use scene_format::Diagnostic;
use scene_format::codes;
use scene_format::diagnostic::Span;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// What a file says of materials and a scene cannot have.
#[derive(Default)]
pub(super) struct Notes {
    /// MTL files.
    pub(super) missing: BTreeSet<String>,
    /// Names of materials that there are not.
    pub(super) undefined: BTreeSet<String>,
    pub(super) pictures: BTreeSet<String>,
    /// What is taken where there is no picture.
    in_place_of_pictures: &'static str,
    /// What, and the materials that say it.
    unsupported: BTreeMap<String, BTreeSet<String>>,
    /// The material that is being turned; empty where the mesh has only one.
    pub(super) current: String,
}

impl Notes {
    pub(super) fn new(in_place_of_pictures: &'static str) -> Self {
        Notes { in_place_of_pictures, ..Notes::default() }
    }

    pub(super) fn unsupported(&mut self, what: &str) {
        let of = self.unsupported.entry(what.to_owned()).or_default();
        if !self.current.is_empty() {
            of.insert(self.current.clone());
        }
    }

    pub(super) fn into_warning(self, path: &Path) -> Option<Diagnostic> {
        let mut parts: Vec<String> = Vec::new();
        let unsupported: BTreeSet<String> =
            self.unsupported.iter().map(|(what, materials)| of_materials(what, materials)).collect();
        let no_picture = format!("no such picture ({} is taken)", self.in_place_of_pictures);
        for (names, what) in [
            (&self.missing, "MTL file not read"),
            (&self.undefined, "no such material (the default is taken)"),
            (&self.pictures, no_picture.as_str()),
            (&unsupported, "not supported"),
        ] {
            const SHOWN: usize = 8;
            let mut list: Vec<&str> = names.iter().take(SHOWN).map(String::as_str).collect();
            let more = format!("{} more", names.len().saturating_sub(SHOWN));
            if names.len() > SHOWN {
                list.push(&more);
            }
            if !list.is_empty() {
                parts.push(format!("{what}: {}", list.join(", ")));
            }
        }
        (!parts.is_empty()).then(|| {
            let message = format!("the mesh's own materials are taken only in part: {}", parts.join("; "));
            Diagnostic::warning(codes::MTL_UNSUPPORTED, Span::NONE, message)
                .hint("a `material` in the scene replaces those of the file")
                .at_line(path, 0)
        })
    }
}

/// `Ke (in lamp, window)`: the first few by name.
fn of_materials(what: &str, materials: &BTreeSet<String>) -> String {
    const SHOWN: usize = 3;
    let shown: Vec<&str> = materials.iter().take(SHOWN).map(String::as_str).collect();
    match materials.len() {
        0 => what.to_owned(),
        count if count > SHOWN => format!("{what} (in {} and {} more)", shown.join(", "), count - SHOWN),
        _ => format!("{what} (in {})", shown.join(", ")),
    }
}

/// A file named in another one: from that one's folder, with backslashes for slashes, or by its bare name beside it
/// (MTL files often keep the paths of their author's machine).
pub(super) fn find_beside(path: &Path, name: &str, files: &Files) -> Option<PathBuf> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let slashed = name.replace('\\', "/");
    let bare = slashed.rsplit('/').next().unwrap_or_default().to_owned();
    [name, &slashed, &bare].into_iter().map(|name| folder.join(name)).find(|path| files.has(path))
}
