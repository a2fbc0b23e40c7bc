//! The manual as a site: the documents of this repository as a book of mdBook, with a picture for every entry of the
//! reference.
//!
//! The book's source (`target/site/src`) has the folders of the repository, so that every link of a document leads
//! where it leads there; `links` sees that it does.

mod links;
mod pages;

pub use links::{broken, documents, targets};
pub use pages::with_pictures;

use crate::prove::MDBOOK;
use anyhow::{Context as _, ensure};
use rayon::prelude::*;
use scene_format::{Example, Syntax, load_str};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use tracer_core::{RenderOptions, Unobserved, compile, develop, render};
use tracer_picture::{Bits, Encoding, Provenance, encode};

/// The chapters: title and document, in this order.
const CHAPTERS: [(&str, &str); 26] = [
    ("tracer", "README.md"),
    ("Tutorial", "docs/tutorial.md"),
    ("Cookbook", "docs/cookbook.md"),
    ("The scene language", "docs/scene-reference.md"),
    ("Diagnostics", "docs/diagnostics.md"),
    ("In an editor", "docs/editors.md"),
    ("Preview", "docs/preview.md"),
    ("Animation", "docs/animation.md"),
    ("Layers and mattes", "docs/layers.md"),
    ("Teaching", "docs/teaching.md"),
    ("Noise", "docs/noise.md"),
    ("Denoising", "docs/denoise.md"),
    ("Checkpoints", "docs/checkpoints.md"),
    ("Many machines", "docs/scale.md"),
    ("The report", "docs/report.md"),
    ("A picture made again", "docs/again.md"),
    ("Expected pictures", "docs/golden.md"),
    ("Python", "docs/python.md"),
    ("Installing", "docs/install.md"),
    ("Correctness", "docs/correctness.md"),
    ("Performance", "docs/performance.md"),
    ("Benchmarks", "bench/README.md"),
    ("Other programs", "bench/peers/README.md"),
    ("Architecture", "ARCHITECTURE.md"),
    ("Contributing", "CONTRIBUTING.md"),
    ("Changelog", "CHANGELOG.md"),
];

/// The documents that have a chapter.
pub fn chapters() -> impl Iterator<Item = &'static str> {
    CHAPTERS.iter().map(|(_, document)| *document)
}

/// Folders of what documents show and lead to.
const FOLDERS: [&str; 2] = ["docs", "scenes"];
const BOOK: &str = "\
[book]
title = \"tracer\"
language = \"en\"
src = \"src\"

[build]
build-dir = \"book\"
create-missing = false
# One of them renames README.md, to which pages lead.
use-default-preprocessors = false

[output.html]
no-section-label = true
";

/// Makes the site; gives its first page.
///
/// # Errors
/// When mdBook is missing, a picture cannot be made, or a link leads nowhere.
pub fn run(root: &Path) -> anyhow::Result<PathBuf> {
    let is_there = Command::new("mdbook").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    ensure!(
        is_there.is_ok_and(|status| status.success()),
        "mdbook is missing, which makes the pages: cargo install mdbook --version {MDBOOK} --locked"
    );
    let broken = broken(root)?;
    ensure!(broken.is_empty(), "links that lead nowhere:\n{}", broken.join("\n"));
    let site = root.join("target/site");
    let source = site.join("src");
    if source.exists() {
        fs::remove_dir_all(&source).context("cannot remove the last site's source")?;
    }
    for document in chapters() {
        copy(&root.join(document), &source.join(document))?;
    }
    for folder in FOLDERS {
        copy_all(&root.join(folder), &source.join(folder))?;
    }
    for file in targets(root)?.into_iter().filter(|file| root.join(file).is_file()) {
        copy(&root.join(&file), &source.join(&file))?;
    }
    let summary: String = CHAPTERS.iter().map(|(title, document)| format!("- [{title}]({document})\n")).collect();
    fs::write(source.join("SUMMARY.md"), format!("# Summary\n\n{summary}"))?;
    fs::write(site.join("book.toml"), BOOK)?;
    let reference = source.join("docs/scene-reference.md");
    let (text, shown) = with_pictures(&fs::read_to_string(&reference)?);
    fs::write(&reference, text)?;
    fs::create_dir_all(source.join("docs/reference"))?;
    let pictures: Vec<(String, Vec<u8>)> = shown.par_iter().map(picture).collect::<anyhow::Result<_>>()?;
    for (path, bytes) in &pictures {
        fs::write(source.join("docs").join(path), bytes)?;
    }
    let status = Command::new("mdbook").arg("build").arg(&site).status().context("cannot run mdbook")?;
    ensure!(status.success(), "mdbook build: {status}");
    let first = site.join("book/index.html");
    ensure!(first.is_file(), "mdbook has made no {}", first.display());
    println!("{} chapters, {} pictures of entries: {}", CHAPTERS.len(), pictures.len(), first.display());
    Ok(first)
}

/// The picture of an entry of the reference, with its name.
fn picture(example: &Example) -> anyhow::Result<(String, Vec<u8>)> {
    let of = || format!("the picture of {}", example.title);
    let folder = tempfile::tempdir()?;
    for file in example.files {
        fs::write(folder.path().join(file.name), file.bytes)?;
    }
    let sets = ["image=Image(width: 240, height: 160)", "render.samples=64"].map(Into::into);
    let loaded = load_str(&example.title, &example.ron, Syntax::Ron, folder.path(), &sets).with_context(of)?;
    let scene = compile(&loaded.scene).with_context(of)?;
    let film = render(&scene, &RenderOptions { threads: 1, ..RenderOptions::default() }, &Unobserved);
    let image = develop(&film, &scene.look);
    let bytes = encode(&image, Encoding::Png(Bits::Eight), &Provenance::hidden())?;
    Ok((pages::picture_of(&example.title), bytes))
}

fn copy(from: &Path, to: &Path) -> anyhow::Result<()> {
    if let Some(folder) = to.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::copy(from, to).with_context(|| format!("cannot copy {}", from.display()))?;
    Ok(())
}

fn copy_all(from: &Path, to: &Path) -> anyhow::Result<()> {
    for entry in fs::read_dir(from).with_context(|| format!("cannot list {}", from.display()))? {
        let entry = entry?;
        let to = to.join(entry.file_name());
        match entry.file_type()?.is_dir() {
            true => copy_all(&entry.path(), &to)?,
            false => copy(&entry.path(), &to)?,
        }
    }
    Ok(())
}
