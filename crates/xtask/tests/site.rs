//! The manual: no link leads nowhere, and every entry of the reference has its picture.

use std::path::{Path, PathBuf};
use xtask::site::{broken, with_pictures};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

#[test]
fn every_link_leads_somewhere() {
    let broken = broken(&root()).expect("the documents can be read");
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// What a page leads to is in the site, and a document that one leads to is a page of it.
#[test]
fn what_pages_lead_to_is_there() {
    let targets = xtask::site::targets(&root()).expect("the documents can be read");
    let documents = xtask::site::documents(&root()).expect("the documents can be listed");
    assert!(targets.contains(Path::new("scenes/cookbook/glass.ron")) && targets.len() > 50, "{targets:?}");
    let is_document = |path: &&PathBuf| path.extension().is_some_and(|extension| extension == "md");
    for document in targets.iter().filter(is_document) {
        assert!(documents.contains(document), "{} has no chapter", document.display());
    }
}

#[test]
fn every_entry_has_its_picture() {
    let page = std::fs::read_to_string(root().join("docs/scene-reference.md")).expect("the reference");
    let (text, shown) = with_pictures(&page);
    let titles: std::collections::BTreeSet<&str> = shown.iter().map(|example| example.title.as_str()).collect();
    let all = scene_format::examples();
    let missing: Vec<&str> = all
        .iter()
        .map(|example| example.title.as_str())
        .filter(|title| title.contains("::") && !titles.contains(title))
        .collect();
    assert!(missing.is_empty(), "these have no entry: {missing:?}");
    assert_eq!((text.matches("](reference/").count(), titles.len()), (shown.len(), shown.len()), "none twice");
    assert_eq!(page.lines().filter(|line| line.starts_with("### ")).count(), shown.len(), "an entry has none");
    // Nothing of the page is lost.
    let without: String = text.lines().filter(|line| !line.contains("](reference/")).collect();
    assert_eq!(without.len(), page.lines().collect::<String>().len());
}
