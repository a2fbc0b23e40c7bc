//! Scenes and the files that they include: names that the one gives and the other uses.

use crate::documents::{Document, Documents, uri_of};
use crate::positions::Lines;
use lsp_types::{Location, TextEdit, Uri};
use scene_format::Syntax;
use scene_format::analysis::{self, Given};
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Files that are looked at for one answer, at most, and how long they may be.
const MOST_FILES: usize = 200;
const LONGEST: u64 = 1 << 20;

/// Another file, as the editor has it, else as it lies on the disk.
pub struct Other {
    /// Where it lies.
    pub path: PathBuf,
    /// Its address.
    pub uri: Uri,
    /// All of it.
    pub text: Arc<str>,
    /// By its name, else by its looks.
    pub syntax: Syntax,
}

impl Other {
    fn at(documents: &Documents, path: &Path) -> Option<Other> {
        let path = path.canonicalize().ok()?;
        let uri = uri_of(&path)?;
        let open = documents.all().find(|document| is_at(document, &path));
        let text = match open {
            Some(document) => document.text.clone(),
            None if path.metadata().is_ok_and(|data| data.is_file() && data.len() <= LONGEST) => {
                std::fs::read_to_string(&path).ok()?.into()
            }
            None => return None,
        };
        let syntax = Syntax::from_path(&path).unwrap_or_else(|| Syntax::guess(&text));
        Some(Other { uri: open.map_or(uri, |document| document.uri.clone()), path, text, syntax })
    }
}

fn is_at(document: &Document, path: &Path) -> bool {
    document.path.as_deref().and_then(|own| own.canonicalize().ok()).as_deref() == Some(path)
}

/// Where a name at a byte is given that the document has from a file that it includes, or from one that that includes.
pub fn definition(documents: &Documents, document: &Document, byte: usize) -> Option<(Other, std::ops::Range<usize>)> {
    let used = analysis::used_at(&document.text, document.syntax, byte)?;
    let mut seen = HashSet::new();
    let names = |text: &str, syntax, folder: &Path| -> Vec<PathBuf> {
        analysis::includes(text, syntax).into_iter().map(|name| folder.join(name)).collect()
    };
    let mut next =
        document.path.as_ref().map_or_else(Vec::new, |_| names(&document.text, document.syntax, document.folder()));
    while let Some(path) = next.pop() {
        let Some(other) = Other::at(documents, &path).filter(|other| seen.insert(other.path.clone())) else { continue };
        if let Some(place) = analysis::place_of(&other.text, other.syntax, &used) {
            return Some((other, place));
        }
        if seen.len() >= MOST_FILES {
            return None;
        }
        next.extend(names(&other.text, other.syntax, other.path.parent().unwrap_or(Path::new(""))));
    }
    None
}

/// The place of a range in a file.
pub fn location(documents: &Documents, other: &Other, range: std::ops::Range<usize>) -> Location {
    let lines = Lines::new(&other.text, documents.client.encoding);
    Location { uri: other.uri.clone(), range: lines.range(&other.text, range) }
}

/// What is to be changed in the scenes that include a document, where a name that it gives gets another: those that are
/// open, and those beside it and in the folder above.
///
/// # Errors
/// One of them gives that name to something of its own.
pub fn renamed(
    documents: &Documents,
    document: &Document,
    given: &Given,
    name: &str,
) -> Result<Vec<(Uri, Vec<TextEdit>)>, String> {
    let Some(own) = document.path.as_deref().and_then(|path| path.canonicalize().ok()) else { return Ok(Vec::new()) };
    let Some(file_name) = own.file_name().and_then(|name| name.to_str()) else { return Ok(Vec::new()) };
    let folders = own.ancestors().skip(1).take(2);
    let listed = folders.filter_map(|folder| std::fs::read_dir(folder).ok()).flatten().take(10 * MOST_FILES);
    let beside = listed.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| Syntax::from_path(path).is_some());
    let open = documents.all().filter_map(|document| document.path.clone());
    let mut seen = HashSet::from([own.clone()]);
    let mut found = Vec::new();
    for path in open.chain(beside.take(MOST_FILES)) {
        let Some(other) = Other::at(documents, &path).filter(|other| seen.insert(other.path.clone())) else { continue };
        let folder = other.path.parent().unwrap_or(Path::new(""));
        let includes = || {
            let mut names = analysis::includes(&other.text, other.syntax).into_iter();
            names.any(|name| folder.join(name).canonicalize().is_ok_and(|path| path == own))
        };
        if !other.text.contains(file_name) || !includes() {
            continue;
        }
        let lines = Lines::new(&other.text, documents.client.encoding);
        let edits = analysis::rename_used(&other.text, other.syntax, given, name);
        let edits = edits.into_iter().map(|edit| {
            let range = edit.span.start as usize..edit.span.end as usize;
            TextEdit { range: lines.range(&other.text, range), new_text: edit.replacement }
        });
        let edits: Vec<TextEdit> = edits.collect();
        if !edits.is_empty() {
            if analysis::place_of(&other.text, other.syntax, &given.named(name)).is_some() {
                return Err(format!("there is another {name:?} already in {}", other.path.display()));
            }
            found.push((other.uri.clone(), edits));
        }
    }
    Ok(found)
}
