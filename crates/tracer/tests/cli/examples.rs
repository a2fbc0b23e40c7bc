//! Every example of `docs/scene-reference.md` is rendered: each kind of thing in the language, and each block of the
//! page.

use crate::support::{Sandbox, repository};
use scene_format::{Syntax, examples, load_str};
use std::fs;
use std::path::Path;
use std::process::Command;
use tracer_core::{RenderOptions, Unobserved, develop, render};

/// Renders a scene with one sample in 16x16 pixels and says whether every pixel is a finite number.
fn picture(name: &str, text: &str, syntax: Syntax, folder: &Path) {
    let sets = ["image=Image(width: 16, height: 16)", "render.samples=1"].map(Into::into);
    let loaded =
        load_str(name, text, syntax, folder, &sets).unwrap_or_else(|error| panic!("{name}: {error:?}\n{text}"));
    let scene = tracer_core::compile(&loaded.scene).unwrap_or_else(|error| panic!("{name}: {error:?}\n{text}"));
    let film = render(&scene, &RenderOptions::default(), &Unobserved);
    let image = develop(&film, &scene.look);
    assert_eq!((image.width, image.height), (16, 16), "{name}");
    assert!(image.linear.iter().all(|value| value.is_finite() && *value >= 0.0), "{name}");
    assert!(image.linear.iter().any(|value| *value > 0.0), "{name} is black");
    assert_eq!(film.counters.dropped, 0, "{name}");
}

/// Runs a script of the page, where there is a Python to run it; its picture is made of one sample.
fn python(text: &str) {
    if Command::new("python3").arg("--version").output().is_err() {
        return;
    }
    let small = text.replace("\"-o\"", "\"--size\", \"16x16\", \"--samples\", \"1\", \"-o\"");
    assert!(small != text, "{text}");
    let sandbox = Sandbox::new();
    sandbox.write("script.py", small);
    sandbox.shell(r#"mkdir bin && ln -s "$T" bin/tracer && PATH="$PWD/bin:$PATH" python3 script.py"#).ends(0);
    assert!(!sandbox.read("balls.png").is_empty());
}

/// The fenced blocks of a page: their language and their text.
fn blocks(page: &str) -> Vec<(String, String)> {
    let mut blocks: Vec<(String, String)> = Vec::new();
    let mut open = false;
    for line in page.lines() {
        match line.strip_prefix("```") {
            Some(language) => {
                open = !open;
                if open {
                    blocks.push((language.to_owned(), String::new()));
                }
            }
            None if open => {
                let (_, text) = blocks.last_mut().expect("a block is open");
                *text += line;
                text.push('\n');
            }
            None => {}
        }
    }
    blocks
}

/// Dev profile, 33 scenes of 16x16 pixels and one sample: a second or two.
#[test]
fn every_example_of_the_reference_renders() {
    let examples = examples();
    for example in &examples {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for file in example.files {
            fs::write(folder.path().join(file.name), file.bytes).expect("the folder can be written");
        }
        picture(&example.title, &example.ron, Syntax::Ron, folder.path());
    }
    let page = fs::read_to_string(repository().join("docs/scene-reference.md")).expect("the reference");
    let (mut scenes, mut parts) = (0, 0);
    for (language, text) in blocks(&page) {
        match language.as_str() {
            "ron" if text.starts_with("Scene(") => {
                picture("the reference", &text, Syntax::Ron, Path::new(""));
                scenes += 1;
            }
            "toml" if text.contains("[[objects]]") => {
                picture("the reference", &text, Syntax::Toml, Path::new(""));
                scenes += 1;
            }
            // Fields of the scene, as many as show a group of them.
            "ron"
                if text.starts_with(char::is_lowercase)
                    && !examples.iter().any(|e| e.ron.contains(text.trim_end())) =>
            {
                let ball = "Sphere(center: (0, 1, 0), radius: 1, material: Emissive(radiance: 1), name: \"ball\")";
                let rest = match text.starts_with("objects") {
                    true => "background: 1".to_owned(),
                    false => format!("objects: [{ball}]"),
                };
                let scene = format!("Scene({}, {rest})", text.trim_end());
                picture("the reference", &scene, Syntax::Ron, Path::new(""));
                parts += 1;
            }
            // Part of an example, that has been rendered.
            "ron" => {
                let found = examples.iter().any(|example| example.ron.contains(text.trim_end()));
                assert!(found, "no example shows:\n{text}");
                parts += 1;
            }
            "json" => {
                picture("the reference", &text, Syntax::Json, Path::new(""));
                scenes += 1;
            }
            "python" => python(&text),
            // How an editor finds the schema.
            "toml" => assert!(text.starts_with("#:schema "), "{text}"),
            // A placements file, of all kinds of lines.
            "text" => {
                let folder = tempfile::tempdir().expect("a temporary folder");
                fs::write(folder.path().join("copies.txt"), &text).expect("the folder can be written");
                let scene = "Scene(background: 1, objects: [Box(size: 1, placements: \"copies.txt\")])";
                picture("the placements of the reference", scene, Syntax::Ron, folder.path());
            }
            other => panic!("a block in `{other}`"),
        }
    }
    assert!(scenes == 7 && parts >= 30, "{scenes} scenes and {parts} parts");
}
