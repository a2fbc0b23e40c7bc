//! What is kept from one compiling to the next, for programs that compile a scene again and again while it is edited.

use super::stored::{self, Store};
use crate::texture::{self, Landscape, Panorama, Reading, Texture, TextureError};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;
use tracer_kernels::bvh::{Accel, Acceleration, BuildError, Geometry, Ranks};
use tracer_mesh::{MeshData, MeshError, Wanted};
use xxhash_rust::xxh3::Xxh3;

/// Meshes and textures as they were read, and trees as they were built, of the last scene that was compiled with it
/// ([`compile_keeping`](crate::compile_keeping)). A file is read again when it has another time or size, a tree built
/// again when anything that it is built of is another: bytes of the picture do not depend on what was kept.
#[derive(Default)]
pub struct Kept {
    meshes: Mutex<BTreeMap<MeshKey, Entry<MeshData>>>,
    textures: Mutex<BTreeMap<(PathBuf, Reading), Entry<Texture>>>,
    heights: Mutex<BTreeMap<PathBuf, Entry<Landscape>>>,
    environments: Mutex<BTreeMap<PathBuf, Entry<Panorama>>>,
    /// Files are as they were when they were read, whatever became of them since.
    is_frozen: bool,
    /// What is kept from one run of the program to the next.
    pub(super) store: Option<Arc<dyn Store>>,
    /// By what they were built of.
    trees: Mutex<BTreeMap<u128, (bool, Arc<Accel>)>>,
}

/// A file, whether with the colours of its vertices, and the part of it.
type MeshKey = (PathBuf, bool, Option<String>);

/// What was made of a file.
struct Entry<T> {
    /// The files that it was made of, and what tells that they are the same.
    stamps: Vec<(PathBuf, Stamp)>,
    value: Arc<T>,
    /// Whether the scene that is being compiled uses it.
    used: bool,
}

type Stamp = Option<(SystemTime, u64)>;

fn stamp(path: &Path) -> Stamp {
    let found = fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Entries that share their values with these.
fn of_last_scene<K: Ord + Clone, T>(entries: &Mutex<BTreeMap<K, Entry<T>>>) -> Mutex<BTreeMap<K, Entry<T>>> {
    let entries = lock(entries);
    let used = entries.iter().filter(|(_, entry)| entry.used);
    let shared = |entry: &Entry<T>| Entry { stamps: Vec::new(), value: Arc::clone(&entry.value), used: true };
    Mutex::new(used.map(|(key, entry)| (key.clone(), shared(entry))).collect())
}

/// What was made of a file, if it would be made again as it was, or files are frozen; else it is made, and kept. `key`:
/// the file, and how it is read.
fn file<K: Ord, T, E>(
    is_frozen: bool,
    entries: &Mutex<BTreeMap<K, Entry<T>>>,
    key: K,
    path: &Path,
    load: impl FnOnce() -> Result<Arc<T>, E>,
    others: impl FnOnce(&T) -> Vec<PathBuf>,
) -> Result<Arc<T>, E> {
    if let Some(entry) = lock(entries).get_mut(&key)
        && (is_frozen || entry.stamps.iter().all(|(path, known)| known.is_some() && stamp(path) == *known))
    {
        entry.used = true;
        return Ok(Arc::clone(&entry.value));
    }
    // Before it is read: what is written meanwhile is read the next time.
    let own = stamp(path);
    let began = SystemTime::now();
    let value = load()?;
    let fresh = |path: &Path| stamp(path).filter(|(written, _)| *written < began);
    let others = others(&value).into_iter().map(|path| (path.clone(), fresh(&path)));
    let stamps = std::iter::once((path.to_owned(), own)).chain(others).collect();
    lock(entries).insert(key, Entry { stamps, value: Arc::clone(&value), used: true });
    Ok(value)
}

/// A mesh file, read or kept.
pub(super) fn load_mesh(
    kept: &Kept,
    path: &Path,
    wanted: Wanted<'_>,
    read: impl FnOnce() -> Result<Arc<MeshData>, MeshError>,
) -> Result<Arc<MeshData>, MeshError> {
    // What is odd may be that a file is missing, and it may come: no file has the empty name, so this one is read
    // again.
    let others = |mesh: &MeshData| {
        let odd = (!mesh.warnings.is_empty()).then(PathBuf::new);
        mesh.libraries.iter().cloned().chain(odd).collect()
    };
    let key = (path.to_owned(), wanted.colors, wanted.part.map(str::to_owned));
    file(kept.is_frozen, &kept.meshes, key, path, read, others)
}

/// A texture, read or kept.
pub(super) fn load_texture(kept: &Kept, path: &Path, reading: Reading) -> Result<Arc<Texture>, TextureError> {
    let load = || texture::load_as(path, reading).map(Arc::new);
    file(kept.is_frozen, &kept.textures, (path.to_owned(), reading), tracer_mesh::file_of(path), load, |_| Vec::new())
}

/// Heights, read or kept.
pub(super) fn load_heights(kept: &Kept, path: &Path) -> Result<Arc<Landscape>, TextureError> {
    let load = || texture::load_heights(path).map(Arc::new);
    file(kept.is_frozen, &kept.heights, path.to_owned(), path, load, |_| Vec::new())
}

/// The picture of a background, read or kept.
pub(super) fn load_environment(kept: &Kept, path: &Path) -> Result<Arc<Panorama>, TextureError> {
    let load = || texture::load_environment(path).map(Arc::new);
    file(kept.is_frozen, &kept.environments, path.to_owned(), path, load, |_| Vec::new())
}

/// A tree, built or kept.
pub(super) fn build_tree(
    (kept, store): (Option<&Kept>, Option<&dyn Store>),
    geometry: &Geometry<'_>,
    acceleration: Acceleration,
    ranks: &Ranks,
) -> Result<Arc<Accel>, BuildError> {
    let build = || Accel::build_with(geometry, acceleration, ranks).map(Arc::new);
    if kept.is_none() && store.is_none() {
        return build();
    }
    let key = key(geometry, acceleration, ranks);
    let build = || match store {
        Some(store) => stored::build_tree(store, geometry, ranks, key, build),
        None => build(),
    };
    let Some(kept) = kept else { return build() };
    if let Some((used, tree)) = lock(&kept.trees).get_mut(&key) {
        *used = true;
        return Ok(Arc::clone(tree));
    }
    let tree = build()?;
    lock(&kept.trees).insert(key, (true, Arc::clone(&tree)));
    Ok(tree)
}

impl Kept {
    /// What is kept in memory of what is kept from one run of the program to the next.
    pub fn storing(store: Arc<dyn Store>) -> Self {
        Kept { store: Some(store), ..Kept::default() }
    }

    /// What the last scene has used, its files as they are now for ever.
    pub(super) fn frozen(&self) -> Kept {
        let trees = lock(&self.trees);
        let used = trees.iter().filter(|(_, (used, _))| *used);
        let trees = used.map(|(key, (_, tree))| (*key, (true, Arc::clone(tree)))).collect();
        Kept {
            meshes: of_last_scene(&self.meshes),
            textures: of_last_scene(&self.textures),
            heights: of_last_scene(&self.heights),
            environments: of_last_scene(&self.environments),
            is_frozen: true,
            // Each moment has trees of its own.
            store: None,
            trees: Mutex::new(trees),
        }
    }

    /// Lets go of the trees that the last scene did not use.
    pub(super) fn sweep_trees(&self) {
        lock(&self.trees).retain(|_, (used, _)| std::mem::take(used));
    }

    /// Lets go of what the last scene did not use.
    pub(super) fn sweep(&self) {
        lock(&self.meshes).retain(|_, entry| std::mem::take(&mut entry.used));
        lock(&self.textures).retain(|_, entry| std::mem::take(&mut entry.used));
        lock(&self.heights).retain(|_, entry| std::mem::take(&mut entry.used));
        lock(&self.environments).retain(|_, entry| std::mem::take(&mut entry.used));
        self.sweep_trees();
    }
}

/// 128 bits of all that a tree is built of: two scenes in 10^19 have the same.
fn key(geometry: &Geometry<'_>, acceleration: Acceleration, ranks: &Ranks) -> u128 {
    let mut hash = Xxh3::new();
    let mut add = |bytes: &[u8]| {
        // With its length: no piece runs into the next.
        hash.update(&(bytes.len() as u64).to_le_bytes());
        hash.update(bytes);
    };
    add(&[match acceleration {
        Acceleration::Bvh => 0,
        Acceleration::BoundingBox => 1,
        Acceleration::None => 2,
    }]);
    for sphere in geometry.spheres {
        let tracer_kernels::bvh::SphereGeometry { anchor, normal, curvature, lower, upper } = sphere;
        for part in [anchor, normal, lower, upper] {
            add(bytemuck::cast_slice(part));
        }
        add(&curvature.to_bits().to_le_bytes());
    }
    for shape in geometry.shapes {
        add(bytemuck::bytes_of(&shape.row));
        [shape.lower, shape.upper].iter().for_each(|corner| add(bytemuck::cast_slice(corner)));
    }
    add(bytemuck::cast_slice(geometry.parts));
    add(&geometry.first_shape.to_le_bytes());
    add(bytemuck::cast_slice(geometry.planes));
    // All meshes of a scene share their positions.
    let mut positions: Option<&[[f32; 3]]> = None;
    for mesh in geometry.meshes {
        if positions.is_none_or(|known| !std::ptr::eq(known, mesh.positions)) {
            add(bytemuck::cast_slice(mesh.positions));
            positions = Some(mesh.positions);
        }
        add(bytemuck::cast_slice(mesh.triangles));
        add(&mesh.first_primitive.to_le_bytes());
    }
    for instance in geometry.instances {
        add(&instance.mesh.to_le_bytes());
        add(instance.placement.as_ref().map_or(&[], |rows| bytemuck::cast_slice(rows)));
    }
    for flags in [geometry.left_out.spheres, geometry.left_out.shapes, geometry.left_out.instances] {
        add(bytemuck::cast_slice(flags));
    }
    add(&ranks.triangles);
    add(&ranks.shapes);
    let whole: Vec<u8> = ranks.instances.iter().map(|rank| rank.unwrap_or(u8::MAX)).collect();
    add(&whole);
    if let Some(materials) = &ranks.materials {
        add(bytemuck::cast_slice(&materials.triangles));
        add(bytemuck::cast_slice(&materials.shapes));
        let whole: Vec<u32> = materials.instances.iter().map(|of| of.unwrap_or(u32::MAX)).collect();
        add(bytemuck::cast_slice(&whole));
    }
    hash.digest128()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{compile, compile_keeping};
    use scene_format::{SceneDesc, Syntax, load_str};

    const OFF: &str = "OFF\n4 4 0\n-1 -1 -1\n1 1 -1\n1 -1 1\n-1 1 1\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n";

    fn scene(folder: &Path, albedo: &str, x: f64) -> SceneDesc {
        let text = format!(
            "Scene(background: 1, objects: [Mesh(file: \"t.off\", transform: [Translate(({x}, 0, 0))], \
             material: Diffuse(albedo: {albedo}))])"
        );
        load_str("s.ron", &text, Syntax::Ron, folder, &[]).expect("the scene is right").scene
    }

    fn tree(scene: &crate::Scene) -> *const Accel {
        scene.accel.as_ref().map_or(std::ptr::null(), Arc::as_ptr)
    }

    #[test]
    fn only_what_has_changed_is_built_anew() {
        let folder = tempfile::tempdir().expect("a folder");
        let mesh = folder.path().join("t.off");
        fs::write(&mesh, OFF).expect("a file");
        let key = (mesh.clone(), false, None);
        let kept = Kept::default();
        let compiled = |albedo, x| compile_keeping(&scene(folder.path(), albedo, x), &kept).expect("it compiles");
        let first = compiled("0.5", 0.0);
        let read = Arc::downgrade(&lock(&kept.meshes)[&key].value);
        // A material leaves mesh and tree as they are.
        let second = compiled("0.2", 0.0);
        assert_eq!(tree(&first), tree(&second));
        assert_ne!(first.materials, second.materials);
        // Another place is another tree of the same mesh; the old one is let go.
        let third = compiled("0.2", 3.0);
        assert_ne!(tree(&second), tree(&third));
        assert!(std::ptr::eq(read.as_ptr(), Arc::as_ptr(&lock(&kept.meshes)[&key].value)));
        assert_eq!(lock(&kept.trees).len(), 1);
        // Another file is another mesh.
        fs::write(&mesh, OFF.replace("1 1 -1", "1 1 -1.5")).expect("a file");
        let fourth = compiled("0.2", 3.0);
        assert_ne!(fourth.triangles.positions, third.triangles.positions);
        assert!(read.upgrade().is_none(), "the mesh of before is let go");
        // What is kept never shows.
        let plain = compile(&scene(folder.path(), "0.2", 3.0)).expect("it compiles");
        assert_eq!(plain.triangles.positions, fourth.triangles.positions);
        assert_eq!(plain.accel.as_ref().map(|tree| tree.bytes()), fourth.accel.as_ref().map(|tree| tree.bytes()));
        // Nor does it stay where a scene does without.
        let ball = "Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)])";
        let ball = load_str("s.ron", ball, Syntax::Ron, folder.path(), &[]).expect("right").scene;
        compile_keeping(&ball, &kept).expect("it compiles");
        assert!(lock(&kept.meshes).is_empty() && lock(&kept.trees).is_empty());
    }

    #[test]
    fn meshes_of_the_scene_itself_are_not_mixed_up() {
        let folder = tempfile::tempdir().expect("a folder");
        let kept = Kept::default();
        let desc = |height: f64| {
            let mesh =
                |z: f64| format!("Mesh(points: [(0, 0, {z}), (1, 0, {z}), (0, {height}, {z})], faces: [[0, 1, 2]])");
            let text = format!("Scene(background: 1, objects: [{}, {}])", mesh(0.0), mesh(-1.0));
            load_str("s.ron", &text, Syntax::Ron, folder.path(), &[]).expect("the scene is right").scene
        };
        for height in [1.0, 2.0, 1.0] {
            let with = compile_keeping(&desc(height), &kept).expect("it compiles");
            let plain = compile(&desc(height)).expect("it compiles");
            assert_eq!(with.triangles.positions, plain.triangles.positions);
            assert_eq!(with.accel.as_ref().map(|tree| tree.bytes()), plain.accel.as_ref().map(|tree| tree.bytes()));
        }
        let first = compile_keeping(&desc(1.0), &kept).expect("it compiles");
        let second = compile_keeping(&desc(1.0), &kept).expect("it compiles");
        assert_eq!(tree(&first), tree(&second));
        assert!(lock(&kept.meshes).is_empty());
    }

    #[test]
    fn a_file_that_is_gone_is_told_though_it_was_kept() {
        let folder = tempfile::tempdir().expect("a folder");
        let mesh = folder.path().join("t.off");
        fs::write(&mesh, OFF).expect("a file");
        let kept = Kept::default();
        compile_keeping(&scene(folder.path(), "0.5", 0.0), &kept).expect("it compiles");
        fs::remove_file(&mesh).expect("it can be deleted");
        assert!(compile_keeping(&scene(folder.path(), "0.5", 0.0), &kept).is_err());
        fs::write(&mesh, OFF).expect("a file");
        compile_keeping(&scene(folder.path(), "0.5", 0.0), &kept).expect("it compiles");
    }
}
