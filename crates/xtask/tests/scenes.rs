//! The scenes in `scenes/` are valid, and the files they name are there and right.

use rayon::prelude::*;
use scene_format::{LoadError, SceneDesc, codes, render};
use std::path::{Path, PathBuf};

fn scenes() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut paths: Vec<PathBuf> = [root.clone(), root.join("gallery"), root.join("cookbook")]
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
    // Nine figures, two of them in TOML too, a gallery, a cookbook.
    assert!(scenes.len() >= 11 + 8 + 19, "{scenes:?}");
    scenes.into_par_iter().for_each(|path| {
        let scene = match tracer_core::compile(&load(&path)) {
            Ok(scene) => scene,
            Err(error) => panic!("{}: {error}", path.display()),
        };
        // The report's Blinn-Phong reflects more than it gets, which is said of its figures; nothing else is odd
        // anywhere.
        let figure = path.parent().is_some_and(|folder| folder.ends_with("scenes"));
        let odd: Vec<_> = scene.warnings.iter().filter(|w| !figure || w.code != codes::REFLECTS_MORE).collect();
        assert!(odd.is_empty(), "{}: {odd:?}", path.display());
    });
}

#[test]
fn twins_in_toml_say_the_same() {
    for path in scenes().iter().filter(|path| path.extension().is_some_and(|extension| extension == "toml")) {
        let (toml, ron) = (load(path), load(&path.with_extension("ron")));
        assert_eq!(scene_format::hash_hex(&toml), scene_format::hash_hex(&ron), "{}", path.display());
    }
}

/// `docs/cookbook.md` has every recipe with its picture, and no others.
#[test]
fn the_cookbook_is_complete() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let page = std::fs::read_to_string(root.join("docs/cookbook.md")).unwrap();
    let mut recipes = 0;
    for path in scenes().iter().filter(|path| path.parent().is_some_and(|folder| folder.ends_with("cookbook"))) {
        let name = path.file_stem().unwrap().to_str().unwrap();
        assert!(page.contains(&format!("](cookbook/{name}.jpg)](../scenes/cookbook/{name}.ron)")), "{name}");
        assert!(root.join(format!("docs/cookbook/{name}.jpg")).is_file(), "{name} has no picture");
        let text = std::fs::read_to_string(path).unwrap();
        let about = text.lines().next().and_then(|line| line.strip_prefix("// ")).unwrap_or_default();
        assert!(!about.is_empty() && page.contains(about), "{name}: its first line is not in the page");
        recipes += 1;
    }
    assert_eq!(page.matches("## ..").count(), recipes);
}
