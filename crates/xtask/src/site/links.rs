//! The links of the documents, and where they lead.

use super::chapters;
use anyhow::Context as _;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// All documents of the repository, from its root.
///
/// # Errors
/// When a folder cannot be listed.
pub fn documents(root: &Path) -> anyhow::Result<BTreeSet<PathBuf>> {
    let mut found: BTreeSet<PathBuf> = chapters().map(PathBuf::from).collect();
    for folder in ["", "docs"] {
        for entry in fs::read_dir(root.join(folder)).with_context(|| format!("cannot list {folder}"))? {
            let name = PathBuf::from(entry?.file_name());
            if name.extension().is_some_and(|extension| extension == "md") {
                found.insert(Path::new(folder).join(name));
            }
        }
    }
    Ok(found)
}

/// The links that lead to no file and no heading, a line each; documents without a chapter, too.
///
/// # Errors
/// When a document cannot be read.
pub fn broken(root: &Path) -> anyhow::Result<Vec<String>> {
    let mut broken = Vec::new();
    for document in documents(root)? {
        let shown = document.display();
        if !chapters().any(|chapter| Path::new(chapter) == document) {
            broken.push(format!("{shown} has no chapter"));
        }
        let read = |path: &Path| {
            fs::read_to_string(root.join(path)).with_context(|| format!("cannot read {}", path.display()))
        };
        let text = read(&document)?;
        for link in links(&text) {
            if link.contains("://") || link.starts_with("mailto:") {
                continue;
            }
            let (file, anchor) = link.split_once('#').map_or((link.as_str(), None), |(file, of)| (file, Some(of)));
            let folder = document.parent().unwrap_or(Path::new(""));
            let target = if file.is_empty() { document.clone() } else { resolved(&folder.join(file)) };
            if !root.join(&target).exists() {
                broken.push(format!("{shown}: {link}: there is no {}", target.display()));
            } else if let Some(anchor) = anchor
                && !anchors(&read(&target)?).contains(anchor)
            {
                broken.push(format!("{shown}: {link}: there is no such heading in {}", target.display()));
            }
        }
    }
    Ok(broken)
}

/// The files that documents lead to, from the root.
///
/// # Errors
/// When a document cannot be read.
pub fn targets(root: &Path) -> anyhow::Result<BTreeSet<PathBuf>> {
    let mut found = BTreeSet::new();
    for document in documents(root)? {
        let text = fs::read_to_string(root.join(&document))?;
        let folder = document.parent().unwrap_or(Path::new(""));
        let files = links(&text).into_iter().filter(|link| !link.contains("://"));
        let files = files.map(|link| resolved(&folder.join(link.split('#').next().unwrap_or_default())));
        found.extend(files);
    }
    Ok(found)
}

/// A path without `..`.
fn resolved(path: &Path) -> PathBuf {
    let mut resolved = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir if resolved.pop() => {}
            Component::CurDir => {}
            other => resolved.push(other),
        }
    }
    resolved
}

/// The lines of a document that are no code.
fn prose(text: &str) -> impl Iterator<Item = &str> {
    let mut is_code = false;
    text.lines().filter(move |line| {
        let is_fence = line.trim_start().starts_with("```");
        is_code ^= is_fence;
        !is_code && !is_fence
    })
}

/// What the links and pictures of a document lead to.
fn links(text: &str) -> Vec<String> {
    let mut links = Vec::new();
    for line in prose(text) {
        // What stands between back quotes is no link.
        let plain: String = line.split('`').step_by(2).collect::<Vec<_>>().join("``");
        for after in plain.split("](").skip(1) {
            links.extend(after.split_once(')').map(|(link, _)| link.to_owned()));
        }
    }
    links
}

/// The anchors of a document's headings: small letters, digits, `_` and `-`, blanks as `-`; a number behind the second
/// of a name.
fn anchors(text: &str) -> BTreeSet<String> {
    let mut anchors = BTreeSet::new();
    for line in prose(text) {
        let Some(heading) = line.strip_prefix('#').map(|rest| rest.trim_start_matches('#')) else { continue };
        let kept = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | ' ');
        let name: String = heading.trim().to_lowercase().chars().filter(|c| kept(*c)).collect();
        let name = name.replace(' ', "-");
        let again = (1..).map(|k| format!("{name}-{k}"));
        let free = std::iter::once(name.clone()).chain(again).find(|name| !anchors.contains(name));
        anchors.extend(free);
    }
    anchors
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_found_where_they_are() {
        let text = "See [a](b.md#c-d), `[no](x)` and [![p](q.jpg)](../r.ron).\n```sh\n[no](y)\n```\n";
        assert_eq!(links(text), ["b.md#c-d", "q.jpg", "../r.ron"]);
        assert_eq!(resolved(Path::new("docs/../scenes/./a.ron")), Path::new("scenes/a.ron"));
    }

    #[test]
    fn anchors_are_those_of_the_pages() {
        let text =
            "# The `scene` language\n## E0101: what, now?\n### Orthographic\n### Orthographic\n```\n# code\n```\n";
        let expected = ["the-scene-language", "e0101-what-now", "orthographic", "orthographic-1"];
        assert_eq!(anchors(text), expected.map(str::to_owned).into());
    }
}
