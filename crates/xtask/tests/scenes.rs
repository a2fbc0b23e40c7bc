//! The scenes in `scenes/` are valid, and the files they name are there and right.

use scene_format::{LoadError, SceneDesc, codes, render};
use std::path::{Path, PathBuf};

fn scenes() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut paths: Vec<PathBuf> = [root.clone(), root.join("gallery")]
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron" || extension == "toml"))
        .collect();
    paths.sort();
    paths
}

/// Warnings count: a scene that people copy from has none.
fn load(path: &Path) -> SceneDesc {
    let style = render::Style { color: false, width: 120 };
    match scene_format::load(path) {
        Ok(loaded) => {
            let warnings = render::text(&loaded.warnings, &loaded.scene.sources, style);
            assert!(loaded.warnings.is_empty(), "{warnings}");
            loaded.scene
        }
        Err(LoadError::Invalid { diagnostics, sources, .. }) => {
            panic!("{}", render::text(&diagnostics, &sources, style))
        }
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn all_scenes_compile() {
    let scenes = scenes();
    // Nine figures, two of them in TOML too, and a gallery of eight.
    assert_eq!(scenes.len(), 19);
    for path in scenes {
        let scene = match tracer_core::compile(&load(&path)) {
            Ok(scene) => scene,
            Err(error) => panic!("{}: {error}", path.display()),
        };
        // The report's Blinn-Phong reflects more than it gets, which is said of its figures; nothing else is odd
        // anywhere.
        let figure = path.parent().is_some_and(|folder| folder.ends_with("scenes"));
        let odd: Vec<_> = scene.warnings.iter().filter(|w| !figure || w.code != codes::REFLECTS_MORE).collect();
        assert!(odd.is_empty(), "{}: {odd:?}", path.display());
    }
}

#[test]
fn twins_in_toml_say_the_same() {
    for path in scenes().iter().filter(|path| path.extension().is_some_and(|extension| extension == "toml")) {
        let (toml, ron) = (load(path), load(&path.with_extension("ron")));
        assert_eq!(scene_format::hash_hex(&toml), scene_format::hash_hex(&ron), "{}", path.display());
    }
}
