//! What a scene names and programs have in memory, and where compiling takes files from.

use super::kept::{self, Kept};
use super::stored::{self, Store};
use crate::texture::{self, Landscape, Panorama, Pixels, Reading, Texture, TextureError};
use glam::DAffine3;
use scene_format::plain_path;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};
use tracer_mesh::placements::{PlacementsError, load_placements, parse_placements};
use tracer_mesh::{self as mesh, Files, MeshArrays, MeshData, MeshError, Wanted, file_of};

/// Something that a scene names as a file and that is in memory.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Asset {
    /// The bytes of a file, whose name tells its format where files' names do.
    File(Arc<[u8]>),
    /// A mesh. Its name needs no extension.
    Mesh(Arc<MeshArrays>),
    /// A picture: a texture, a background, heights.
    Pixels(Arc<Pixels>),
}

/// Files in memory, by the names that a scene gives them: relative to its folder, as all its files are. What is not
/// among them is read from the disk. Scenes that a scene includes are read when it is loaded, and always from there.
///
/// ```
/// use scene_format::{Syntax, desc::Faces, load_str};
/// use std::path::Path;
/// use tracer_core::{Assets, compile_from, mesh::MeshArrays, texture::Pixels};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let text = r#"Scene(background: 1, objects: [
///     Mesh(file: "sail", material: Diffuse(albedo: Texture(file: "stripes"))),
/// ])"#;
/// let mut faces = Faces::default();
/// faces.push(&[0, 1, 2]);
/// let sail = MeshArrays {
///     points: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
///     faces,
///     uvs: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
///     ..MeshArrays::default()
/// };
/// let mut assets = Assets::default();
/// assets.insert("sail", sail);
/// assets.insert("stripes", Pixels::srgb8(1, 2, 3, vec![200, 20, 20, 250, 250, 250])?);
/// let scene = compile_from(&load_str("sail.ron", text, Syntax::Ron, Path::new(""), &[])?.scene, &assets)?;
/// assert_eq!(scene.statistics().triangles, 1);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, Default)]
pub struct Assets {
    by_name: BTreeMap<PathBuf, Asset>,
}

impl Assets {
    /// Puts something there under a name; what was there before comes back.
    pub fn insert(&mut self, name: impl AsRef<Path>, asset: impl Into<Asset>) -> Option<Asset> {
        self.by_name.insert(plain_path(name.as_ref()), asset.into())
    }

    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        self.by_name.is_empty()
    }

    /// The names of what is there.
    pub fn names(&self) -> impl Iterator<Item = &Path> {
        self.by_name.keys().map(PathBuf::as_path)
    }
}

impl From<Vec<u8>> for Asset {
    fn from(bytes: Vec<u8>) -> Self {
        Asset::File(bytes.into())
    }
}

impl From<MeshArrays> for Asset {
    fn from(mesh: MeshArrays) -> Self {
        Asset::Mesh(Arc::new(mesh))
    }
}

impl From<Pixels> for Asset {
    fn from(pixels: Pixels) -> Self {
        Asset::Pixels(Arc::new(pixels))
    }
}

/// Where compiling takes what it reads: memory, what was kept, the disk.
#[derive(Clone, Default)]
pub(super) struct Sources<'a> {
    /// What the last compiling has kept.
    pub kept: Option<&'a Kept>,
    /// What the last run of the program has kept.
    pub store: Option<&'a dyn Store>,
    /// By whole path.
    meshes: BTreeMap<PathBuf, Arc<MeshArrays>>,
    pixels: BTreeMap<PathBuf, Arc<Pixels>>,
    files: Files,
}

/// The disk alone.
pub(super) static DISK: LazyLock<Sources<'static>> = LazyLock::new(Sources::default);

impl<'a> Sources<'a> {
    /// The assets of a scene in this folder.
    pub fn new(assets: &Assets, base_dir: &Path) -> Self {
        let mut sources = Sources::default();
        for (name, asset) in &assets.by_name {
            let path = plain_path(&base_dir.join(name));
            match asset {
                Asset::File(bytes) => sources.files.insert(path, Arc::clone(bytes)),
                Asset::Mesh(mesh) => drop(sources.meshes.insert(path, Arc::clone(mesh))),
                Asset::Pixels(pixels) => drop(sources.pixels.insert(path, Arc::clone(pixels))),
            }
        }
        sources
    }

    /// The disk, and what was kept of it.
    pub fn keeping(kept: &'a Kept) -> Self {
        Sources { kept: Some(kept), store: kept.store.as_deref(), ..Sources::default() }
    }

    /// The disk, and what was kept of it by the last run of the program.
    pub fn storing(store: &'a dyn Store) -> Self {
        Sources { store: Some(store), ..Sources::default() }
    }

    /// The same without what was kept.
    pub fn in_memory(&self) -> Sources<'static> {
        let (meshes, pixels, files) = (self.meshes.clone(), self.pixels.clone(), self.files.clone());
        Sources { kept: None, store: None, meshes, pixels, files }
    }

    /// The same with what was kept.
    pub fn with<'k>(&self, kept: &'k Kept, store: Option<&'k dyn Store>) -> Sources<'k> {
        Sources { kept: Some(kept), store, ..self.in_memory() }
    }

    pub fn mesh(&self, path: &Path, wanted: Wanted<'_>) -> Result<Arc<MeshData>, MeshError> {
        if let Some(arrays) = self.meshes.get(&plain_path(path)) {
            if wanted.part.is_some() {
                return Err(MeshError::NoParts { path: path.to_owned(), what: "meshes in memory".to_owned() });
            }
            return arrays.mesh(path).map(Arc::new);
        }
        if self.pixels.contains_key(&plain_path(path)) {
            let (message, expected) = ("it is a picture".to_owned(), "a mesh".to_owned());
            return Err(MeshError::Arrays { path: path.to_owned(), message, expected });
        }
        let read = || match self.store {
            Some(store) if self.files.get(path).is_none() => stored::load_mesh(store, path, wanted),
            _ => mesh::load_as(path, &self.files, wanted).map(Arc::new),
        };
        match self.kept {
            Some(kept) => kept::load_mesh(kept, path, wanted, read),
            None => read(),
        }
    }

    pub fn texture(&self, path: &Path, reading: Reading) -> Result<Arc<Texture>, TextureError> {
        if let Some(pixels) = self.pixels(path)? {
            return pixels.texture(path, reading).map(Arc::new);
        }
        match (self.files.get(file_of(path)), self.kept) {
            (Some(_), _) => texture::decode_as(&self.files.read_picture(path)?, path, reading).map(Arc::new),
            (None, Some(kept)) => kept::load_texture(kept, path, reading),
            (None, None) => texture::load_as(path, reading).map(Arc::new),
        }
    }

    pub fn heights(&self, path: &Path) -> Result<Arc<Landscape>, TextureError> {
        if let Some(pixels) = self.pixels(path)? {
            return pixels.landscape(path).map(Arc::new);
        }
        match (self.files.get(path), self.kept) {
            (Some(bytes), _) => texture::decode_heights(bytes, path).map(Arc::new),
            (None, Some(kept)) => kept::load_heights(kept, path),
            (None, None) => texture::load_heights(path).map(Arc::new),
        }
    }

    pub fn environment(&self, path: &Path) -> Result<Panorama, TextureError> {
        if let Some(pixels) = self.pixels(path)? {
            return Ok(pixels.panorama(path));
        }
        match (self.files.get(path), self.kept) {
            (Some(bytes), _) => texture::decode_environment(bytes, path),
            (None, Some(kept)) => kept::load_environment(kept, path).map(|picture| (*picture).clone()),
            (None, None) => texture::load_environment(path),
        }
    }

    pub fn placements(&self, path: &Path) -> Result<Vec<DAffine3>, PlacementsError> {
        match self.files.get(path) {
            Some(bytes) => parse_placements(bytes, path),
            None => load_placements(path),
        }
    }

    /// The picture of this path that is in memory as numbers; an error where a mesh is.
    fn pixels(&self, path: &Path) -> Result<Option<&Pixels>, TextureError> {
        if self.meshes.contains_key(&plain_path(path)) {
            return Err(TextureError::Mesh { path: path.to_owned() });
        }
        Ok(self.pixels.get(&plain_path(path)).map(|pixels| &**pixels))
    }
}
