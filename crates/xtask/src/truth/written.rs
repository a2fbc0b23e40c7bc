//! Scenes that are written as text, as a person would.

use anyhow::Context as _;
use std::path::Path;
use tracer_core::Scene;

/// Loads and compiles a scene that names no files.
///
/// # Errors
/// It is refused.
pub fn compiled(text: &str) -> anyhow::Result<Scene> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("scene.ron");
    std::fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))?;
    loaded(&path)
}

/// Loads and compiles a scene.
///
/// # Errors
/// It is refused.
pub fn loaded(path: &Path) -> anyhow::Result<Scene> {
    loaded_at(path, None)
}

/// The same, of another size in pixels where one is given.
///
/// # Errors
/// It is refused.
pub fn loaded_at(path: &Path, size: Option<[u32; 2]>) -> anyhow::Result<Scene> {
    let mut loaded = scene_format::load(path).map_err(|error| match error {
        scene_format::LoadError::Invalid { diagnostics, sources, .. } => {
            let style = scene_format::render::Style { color: false, width: 120 };
            anyhow::anyhow!("{}", scene_format::render::text(&diagnostics, &sources, style))
        }
        other => anyhow::anyhow!("{other}"),
    })?;
    if let Some([width, height]) = size {
        (loaded.scene.image.width, loaded.scene.image.height) = (width.into(), height.into());
    }
    tracer_core::compile(&loaded.scene).map_err(|error| anyhow::anyhow!("{error}: {:?}", error.diagnostics))
}
