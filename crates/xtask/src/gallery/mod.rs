//! What the scenes in `scenes/gallery` are furnished with.

pub mod planet;
pub mod solids;
pub mod textures;

use crate::File;

/// Makes the gallery's files.
///
/// # Errors
/// When a PNG cannot be encoded.
pub fn files() -> anyhow::Result<Vec<File>> {
    let herd = planet::herd();
    Ok(vec![
        File { path: "assets/marble.png", bytes: textures::marble().png()? },
        File { path: "assets/globe.png", bytes: textures::globe().png()? },
        File { path: "assets/wood.png", bytes: textures::wood().png()? },
        File { path: "assets/rod.obj", bytes: solids::rod().into() },
        File { path: "assets/table.obj", bytes: solids::table().into() },
        File { path: "scenes/gallery/cat_planet.tabby.txt", bytes: planet::placements(&herd.tabby).into() },
        File { path: "scenes/gallery/cat_planet.gold.txt", bytes: planet::placements(&herd.gold).into() },
    ])
}
