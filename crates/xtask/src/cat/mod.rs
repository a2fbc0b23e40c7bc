//! The cat: shape, meshes, texture, files.
//!
//! `anatomy` says what the cat is (a signed distance field), `polygonise` makes triangles of it, `decimate` and `relax`
//! make fewer and better ones, `unwrap` lays them out in the texture, `paint` colours it by `coat`, `write` makes the
//! files.

pub mod anatomy;
pub mod coat;
pub mod decimate;
pub mod mesh;
pub mod paint;
pub mod polygonise;
pub mod relax;
pub mod sdf;
pub mod unwrap;
pub mod write;

use crate::File;
use anatomy::Cat;
use glam::DVec3;
use mesh::Mesh;
use polygonise::Grid;
use unwrap::{Atlas, Charted};

/// Texels per side of the texture.
const TEXTURE_SIZE: usize = 1024;
/// Name of the material in the OBJ and MTL files.
const MATERIAL: &str = "tabby";

/// Makes the cat's files: two OBJ meshes that share one texture, the small one also as OFF.
///
/// # Errors
/// When the PNG cannot be encoded.
pub fn files() -> anyhow::Result<Vec<File>> {
    let cat = Cat::new();
    let fine = mesh(&cat, &finest(&cat), 60_000);
    let coarse = mesh(&cat, &fine, 4_000);
    let off = write::off(&coarse);
    let meshes = [Charted::new(fine, &cat), Charted::new(coarse, &cat)];
    let atlas = Atlas::pack(&meshes, TEXTURE_SIZE);
    let texture = paint::paint(&cat, &atlas, TEXTURE_SIZE, &meshes);
    let [fine, coarse] = &meshes;
    Ok(vec![
        File { path: "assets/cat.obj", bytes: write::obj(&cat, coarse, &atlas, MATERIAL)?.into() },
        File { path: "assets/cat_60k.obj", bytes: write::obj(&cat, fine, &atlas, MATERIAL)?.into() },
        File { path: "assets/cat.mtl", bytes: write::mtl(MATERIAL).into() },
        File { path: "assets/cat.off", bytes: off.into() },
        File { path: "assets/cat.png", bytes: texture.png()? },
    ])
}

/// The cat's surface in several hundred thousand triangles, many of them slivers.
fn finest(cat: &Cat) -> Mesh {
    let grid = Grid { min: DVec3::new(-34.5, -0.8, -8.5), max: DVec3::new(30.0, 44.5, 8.5), cell: 0.25 };
    polygonise::polygonise(&grid, |p| cat.distance(p))
}

/// The cat with about so many triangles, from a finer mesh of it.
fn mesh(cat: &Cat, finer: &Mesh, triangles: usize) -> Mesh {
    let mut mesh = finer.clone();
    decimate::decimate(&mut mesh, triangles, |p| cat.importance(p));
    relax::relax(&mut mesh, cat);
    for p in &mut mesh.positions {
        *p = write::rounded(*p);
    }
    mesh
}

impl relax::Surface for Cat {
    fn project(&self, p: DVec3) -> DVec3 {
        Cat::project(self, p)
    }

    fn normal(&self, p: DVec3) -> DVec3 {
        Cat::normal(self, p)
    }
}
