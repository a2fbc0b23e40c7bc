//! What is kept is what was made, and nothing that a file says is taken on trust.
//!
//! `CACHE_MUTANTS=100000` sets the number of mutants of each kind.

use super::file::{self, KeptFile, KeptKind};
use super::{ContentHash, Key, Stamp, Store, Told};
use crate::{Scene, compile, compile_storing};
use scene_format::{SceneDesc, Syntax, load_str};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use tracer_kernels::bvh::{Accel, Coherence, Hits, NONE, Rays};
use tracer_kernels::level::Level;

/// A folder that records no hashes.
#[derive(Debug)]
struct Folder {
    path: PathBuf,
    is_read_only: bool,
    told: Mutex<Vec<String>>,
}

impl Folder {
    fn new(path: &Path) -> Self {
        Folder { path: path.to_owned(), is_read_only: false, told: Mutex::default() }
    }

    /// What was told since.
    fn told(&self) -> Vec<String> {
        std::mem::take(&mut *self.told.lock().expect("nobody panics"))
    }

    fn names(&self) -> Vec<String> {
        let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name().into_string();
        let mut names: Vec<String> =
            fs::read_dir(&self.path).expect("a folder").map(|e| name(e).expect("text")).collect();
        names.sort();
        names
    }
}

impl Store for Folder {
    fn recorded(&self, _: &Path) -> Option<ContentHash> {
        None
    }
    fn record(&self, _: &Path, _: &Stamp, _: &ContentHash) {}
    fn open(&self, name: &str) -> Option<File> {
        File::open(self.path.join(name)).ok()
    }
    fn keep(&self, name: &str, bytes: u64, fill: super::Fill) {
        if !self.is_read_only {
            let mut file = File::create(self.path.join(name)).expect("a file");
            assert_eq!(fill(&mut file).expect("it is written"), bytes);
            assert_eq!(file.metadata().expect("a file").len(), bytes);
        }
    }
    fn told(&self, told: Told<'_>) {
        let word = match told {
            Told::Taken { .. } => "taken".to_owned(),
            Told::Missing { .. } => "missing".to_owned(),
            Told::Broken { why, .. } => format!("broken: {why}"),
        };
        self.told.lock().expect("nobody panics").push(word);
    }
}

const SIDE: usize = 80;

fn height(x: usize, y: usize) -> f64 {
    0.1 * (((x * 7 + y * 13) % 11) as f64)
}

/// The corners of a field's triangles.
fn triangles() -> impl Iterator<Item = [usize; 3]> {
    (0..SIDE * SIDE).flat_map(|k| {
        let corner = k / SIDE * (SIDE + 1) + k % SIDE;
        let (right, below) = (corner + 1, corner + SIDE + 1);
        [[corner, right, below], [right, below + 1, below]]
    })
}

fn points() -> impl Iterator<Item = [f64; 3]> {
    (0..(SIDE + 1) * (SIDE + 1)).map(|k| {
        let (x, y) = (k % (SIDE + 1), k / (SIDE + 1));
        [x as f64, height(x, y), y as f64]
    })
}

fn off() -> String {
    let mut text = format!("OFF\n{} {} 0\n", (SIDE + 1) * (SIDE + 1), 2 * SIDE * SIDE + 1);
    points().for_each(|[x, y, z]| text += &format!("{x} {y} {z}\n"));
    triangles().for_each(|[a, b, c]| text += &format!("3 {a} {b} {c}\n"));
    // Odd, and told.
    text + "3 5 5 5\n"
}

fn obj() -> String {
    let mut text = "mtllib m.mtl\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 1 0\n".to_owned();
    points().for_each(|[x, y, z]| text += &format!("v {x} {y} {z}\n"));
    for (k, corners) in triangles().enumerate() {
        let name = ["red", "none", "blue"][k * 3 / (2 * SIDE * SIDE)];
        let [a, b, c] = corners.map(|corner| corner + 1);
        text += &format!("usemtl {name}\nf {a}/1/1 {b}/2/1 {c}/3/1\n");
    }
    text
}

fn gltf() -> (String, Vec<u8>) {
    let count = (SIDE + 1) * (SIDE + 1);
    let mut bytes: Vec<u8> = points().flatten().flat_map(|x| (x as f32).to_le_bytes()).collect();
    let first = bytes.len();
    bytes.extend(triangles().flatten().flat_map(|k| (k as u32).to_le_bytes()));
    let (all, rest, indices) = (bytes.len(), bytes.len() - first, 6 * SIDE * SIDE);
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1, "material": 1}}]}}],
        "skins": [{{"joints": [0]}}],
        "materials": [{{}}, {{"name": "brass", "normalTexture": {{"index": 0}}}}],
        "buffers": [{{"uri": "b.bin", "byteLength": {all}}}],
        "bufferViews": [{{"buffer": 0, "byteLength": {first}}},
            {{"buffer": 0, "byteOffset": {first}, "byteLength": {rest}}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": {count}, "type": "VEC3"}},
            {{"bufferView": 1, "componentType": 5125, "count": {indices}, "type": "SCALAR"}}]}}"#
    );
    (text, bytes)
}

/// A scene of such a mesh with all that may hang in a tree.
fn scene(folder: &Path, file: &str) -> SceneDesc {
    let text = format!(
        "Scene(background: 1, objects: [
            Mesh(file: \"{file}\"),
            Mesh(file: \"{file}\", instances: Always, placements: [[Translate((0, 5, 0))], [Translate((0, 9, 0))]]),
            Disk(center: (4, 7, 4), normal: (0, 1, 0), radius: 3),
            Repeat(count: 200, items: [Sphere(center: (\"=0.4*i\", 3, 2), radius: 1)]),
        ])"
    );
    load_str("s.ron", &text, Syntax::Ron, folder, &[]).expect("the scene is right").scene
}

#[track_caller]
fn same(a: &Scene, b: &Scene) {
    assert_eq!(a.triangles.positions, b.triangles.positions);
    assert_eq!(a.triangles.vertices, b.triangles.vertices);
    assert_eq!(a.triangles.normals, b.triangles.normals);
    assert_eq!(a.triangles.normal_indices, b.triangles.normal_indices);
    assert_eq!(a.triangles.uvs, b.triangles.uvs);
    assert_eq!(a.triangles.uv_indices, b.triangles.uv_indices);
    assert_eq!(a.triangles.material, b.triangles.material);
    assert_eq!((&a.materials, &a.warnings, &a.files), (&b.materials, &b.warnings, &b.files));
    let (a, b) = (a.accel.as_ref().expect("a tree"), b.accel.as_ref().expect("a tree"));
    assert!(a.bytes() == b.bytes() && a.roots() == b.roots() && a.head() == b.head());
    assert_eq!((a.top_boxes(), a.second_boxes()), (b.top_boxes(), b.second_boxes()));
    let stats = |tree: &Accel| tracer_kernels::bvh::AccelStats { seconds: 0.0, ..tree.stats() };
    assert_eq!(stats(a), stats(b));
}

/// As it is compiled without anything kept, with it, and again.
#[track_caller]
fn thrice(desc: &SceneDesc, store: &Folder, told: [&[&str]; 2]) {
    let plain = compile(desc).expect("it compiles");
    for told in told {
        same(&plain, &compile_storing(desc, store).expect("it compiles"));
        assert_eq!(store.told(), told);
    }
}

#[test]
fn what_is_kept_is_what_was_made() {
    let (folder, cache) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let at = |name: &str| folder.path().join(name);
    fs::write(at("f.off"), off()).expect("a file");
    let store = Folder::new(cache.path());
    let desc = scene(folder.path(), "f.off");
    assert!(compile(&desc).expect("it compiles").warnings.iter().any(|told| told.message.contains("without area")));
    thrice(&desc, &store, [&["missing", "missing"], &["taken", "taken"]]);
    assert_eq!(store.names().len(), 2);
    // By its contents, wherever it lies.
    fs::create_dir(at("g")).expect("a folder");
    fs::rename(at("f.off"), at("g/h.off")).expect("it is moved");
    let moved = scene(folder.path(), "g/h.off");
    thrice(&moved, &store, [&["taken", "taken"], &["taken", "taken"]]);
    // Another file is another mesh and another tree.
    fs::write(at("g/h.off"), off().replacen("1 0 0\n", "1 0.5 0\n", 1)).expect("a file");
    thrice(&moved, &store, [&["missing", "missing"], &["taken", "taken"]]);
}

#[test]
fn other_files_of_a_mesh_count() {
    let (folder, cache) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let at = |name: &str| folder.path().join(name);
    fs::write(at("f.obj"), obj()).expect("a file");
    fs::write(at("m.mtl"), "newmtl red\nKd 1 0 0\nPr 0.5\nnewmtl blue\nKd 0 0 1\nmap_Kd p.png\n").expect("a file");
    let store = Folder::new(cache.path());
    let desc = scene(folder.path(), "f.obj");
    thrice(&desc, &store, [&["missing", "missing"], &["taken", "taken"]]);
    // Another colour: the mesh is the same.
    fs::write(at("m.mtl"), "newmtl red\nKd 1 1 0\nnewmtl blue\nKd 0 0 1\nmap_Kd p.png\n").expect("a file");
    thrice(&desc, &store, [&["taken", "taken"], &["taken", "taken"]]);
    // A name more: triangles have other materials.
    fs::write(at("m.mtl"), "newmtl red\nKd 1 1 0\nnewmtl none\nKd 0 1 0\nnewmtl blue\nKd 0 0 1\n").expect("a file");
    thrice(&desc, &store, [&["missing", "taken"], &["taken", "taken"]]);
    // No name at all: the mesh has one material, which its tree knows.
    fs::remove_file(at("m.mtl")).expect("it is there");
    thrice(&desc, &store, [&["missing", "missing"], &["taken", "taken"]]);

    let (text, bytes) = gltf();
    fs::write(at("f.gltf"), text).expect("a file");
    fs::write(at("b.bin"), &bytes).expect("a file");
    // Nobody knows whether it was written while it was read.
    let old = std::time::SystemTime::now() - std::time::Duration::from_secs(60);
    let desc = scene(folder.path(), "f.gltf");
    if !cfg!(unix) {
        File::options().write(true).open(at("b.bin")).and_then(|file| file.set_modified(old)).expect("a time");
    } else {
        std::thread::sleep(std::time::Duration::from_millis(2100));
    }
    thrice(&desc, &store, [&["missing", "missing"], &["taken", "taken"]]);
    let mut other = bytes;
    other[4..8].copy_from_slice(&0.25f32.to_le_bytes());
    fs::write(at("b.bin"), other).expect("a file");
    thrice(&desc, &store, [&["missing", "missing"], &["missing", "taken"]]);
}

fn mutants(default: usize) -> usize {
    std::env::var("CACHE_MUTANTS").ok().and_then(|count| count.parse().ok()).unwrap_or(default)
}

/// Numbers that look like chance.
struct Chance(u64);

impl Chance {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % most.max(1)
    }
}

/// A folder with both files, and the scene without them.
fn kept(folder: &Path) -> (Folder, SceneDesc, Scene) {
    let cache = folder.join("cache");
    fs::create_dir(&cache).expect("a folder");
    fs::write(folder.join("f.off"), off()).expect("a file");
    let (mut store, desc) = (Folder::new(&cache), scene(folder, "f.off"));
    let plain = compile_storing(&desc, &store).expect("it compiles");
    store.told();
    store.is_read_only = true;
    (store, desc, plain)
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn damaged_files_are_made_anew_mutants() {
    let folder = tempfile::tempdir().expect("a folder");
    let (store, desc, plain) = kept(folder.path());
    let mut chance = Chance(1);
    for name in store.names() {
        let place = store.path.join(&name);
        let bytes = fs::read(&place).expect("a file");
        for k in 0..mutants(30) {
            let mut mutant = bytes.clone();
            let near = [200, bytes.len()][chance.below(2)];
            let at = chance.below(near);
            match k % 6 {
                0 => mutant.truncate(at),
                1 => mutant.push(0),
                2 => mutant[at..(at + 4096).min(bytes.len())].fill(0xaa),
                3 => mutant = vec![7; at],
                _ => mutant[at] ^= 1 << chance.below(8),
            }
            fs::write(&place, &mutant).expect("a file");
            let scene = compile_storing(&desc, &store).expect("it compiles");
            let told = store.told();
            assert!(told.iter().any(|told| told.starts_with("broken: ")), "{name}, {k} at {at}: {told:?}");
            if k < 12 {
                same(&plain, &scene);
            }
        }
        fs::write(&place, &bytes).expect("a file");
    }
    // Each under the other's name.
    let [mesh, tree] = [0, 1].map(|k: usize| store.path.join(&store.names()[k]));
    fs::rename(&mesh, store.path.join("x")).expect("it is moved");
    fs::rename(&tree, &mesh).expect("it is moved");
    fs::rename(store.path.join("x"), &tree).expect("it is moved");
    same(&plain, &compile_storing(&desc, &store).expect("it compiles"));
    assert_eq!(store.told().iter().filter(|told| told.contains("another one under this name")).count(), 2);
}

/// Arrays of a file changed anyhow, with the right checksums: as by somebody who means harm.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn nothing_is_taken_on_trust_mutants() {
    let folder = tempfile::tempdir().expect("a folder");
    let (store, desc, _) = kept(folder.path());
    let mut chance = Chance(2);
    let (mut refused, mut traced) = (0, 0);
    for name in store.names() {
        let place = store.path.join(&name);
        let (kind, digits) = name.trim_end_matches(".kept").split_once('-').expect("two words");
        let kind = if kind == "mesh" { KeptKind::Mesh } else { KeptKind::Tree };
        let key = Key { kind, hash: u128::from_str_radix(digits, 16).expect("a number") };
        let whole = KeptFile::open(File::open(&place).expect("a file")).expect("it is sound");
        let arrays: Vec<Vec<u8>> = (0..).map_while(|k| whole.array::<u8>(k).ok()).collect();
        for _ in 0..mutants(80) {
            let mut mutant = arrays.clone();
            for _ in 0..=chance.below(3) {
                let array = chance.below(arrays.len());
                let array = &mut mutant[array];
                let words = array.len() / 4;
                if words == 0 {
                    continue;
                }
                let near = [words, words.min(64)][chance.below(2)];
                let at = 4 * chance.below(near);
                let old = u32::from_le_bytes(array[at..at + 4].try_into().expect("four"));
                let some = chance.below(usize::MAX) as u32;
                let new =
                    [0, u32::MAX, u32::MAX - 1, old ^ 1 << 31, old.wrapping_add(8), some, 0x7f80_0000, 0x8000_0000];
                let new = new[chance.below(new.len())];
                match chance.below(20) {
                    0 => array.truncate(at),
                    1 => array.extend([0; 32]),
                    _ => array[at..at + 4].copy_from_slice(&new.to_le_bytes()),
                }
            }
            let sections: Vec<&[u8]> = mutant.iter().map(Vec::as_slice).collect();
            file::write(&mut File::create(&place).expect("a file"), &key, &sections).expect("it is written");
            if let Ok(scene) = compile_storing(&desc, &store) {
                scene.accel.iter().for_each(|tree| trace(tree, &mut chance));
            }
            match store.told().iter().any(|told| told.starts_with("broken: ")) {
                true => refused += 1,
                false => traced += 1,
            }
        }
        let sections: Vec<&[u8]> = arrays.iter().map(Vec::as_slice).collect();
        file::write(&mut File::create(&place).expect("a file"), &key, &sections).expect("it is written");
    }
    // Boxes and corners may be any; where they lead to may not.
    assert!(refused > 20 && traced > 20, "{refused} refused, {traced} traced");
}

/// Sends rays from everywhere to everywhere.
fn trace(tree: &Accel, chance: &mut Chance) {
    const COUNT: usize = 256;
    let mut column = || -> Vec<f32> { (0..COUNT).map(|_| chance.below(2001) as f32 / 1000.0 - 1.0).collect() };
    let [ox, oy, oz, dx, dy, dz] = std::array::from_fn(|_| column());
    let none = vec![NONE; COUNT];
    let (ox, oy, oz, dx, dy, dz) = (&ox[..], &oy[..], &oz[..], &dx[..], &dy[..], &dz[..]);
    let rays = Rays { ox, oy, oz, dx, dy, dz, from_primitive: &none, from_instance: &none };
    let active: Vec<u32> = (0..COUNT as u32).collect();
    for (level, coherence) in [(Level::best(), Coherence::Incoherent), (Level::best(), Coherence::Coherent)] {
        let (mut t, mut primitive, mut instance) = (vec![f32::INFINITY; COUNT], none.clone(), none.clone());
        let mut hits = Hits { t: &mut t, primitive: &mut primitive, instance: &mut instance };
        tree.closest_at(level, &rays, &active, &mut hits, coherence);
    }
}
