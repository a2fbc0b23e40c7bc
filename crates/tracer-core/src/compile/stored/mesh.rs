//! Meshes of files as they were read.
//!
//! A mesh goes by the contents of its file alone: what its warnings tell of, and where its other files lie, is told
//! anew by its path. Materials are read again, since they go by files and pictures that may come and go; the contents
//! of a glTF file's buffers are told by their hashes.

use super::file::{self, KeptError, KeptFile, KeptKind};
use super::{ContentHash, Key, Stamp, Store, Told};
use rayon::prelude::*;
use scene_format::codes::{self, Code};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Severity};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;
use tracer_mesh::{self as mesh, Files, MAX_COORDINATE, MaterialNames, MeshData, MeshError, MeshFormat, NO_INDEX};
use tracer_mesh::{ColorValues, VertexColors, Wanted};

/// Smaller files are read as fast.
const LEAST_BYTES: u64 = 1 << 16;

/// What readers may warn of in a mesh that is kept; the number is its place.
const CODES: [Code; 3] = [codes::MESH_ODDITIES, codes::MTL_UNSUPPORTED, codes::GLTF_UNSUPPORTED];

/// The mesh of a file: kept, or read and kept.
///
/// # Errors
/// As [`mesh::load`].
pub fn load_mesh(store: &dyn Store, path: &Path, wanted: Wanted<'_>) -> Result<Arc<MeshData>, MeshError> {
    let (stamp, format) = (Stamp::of(path).ok(), MeshFormat::of(path));
    // What a glTF file holds lies beside it.
    let is_large = |stamp: &Stamp| stamp.bytes >= LEAST_BYTES || format == Some(MeshFormat::Gltf);
    let (Some(stamp), Some(format)) = (stamp.filter(is_large), format) else {
        return mesh::load_as(path, &Files::default(), wanted).map(Arc::new);
    };
    let began = SystemTime::now();
    let what = path.display().to_string();
    let with: &[u8] = if wanted.colors { b"colors" } else { b"" };
    let of = |hash: &ContentHash| {
        let whole = [format.extension().as_bytes(), with, hash];
        let part = wanted.part.map(str::as_bytes);
        Key::new(KeptKind::Mesh, &whole.into_iter().chain(part).collect::<Vec<_>>())
    };
    let known = store.recorded(path);
    if let Some(mesh) = known.and_then(|hash| taken(store, &of(&hash), path, &what)) {
        return Ok(mesh);
    }
    let bytes = mesh::read_regular_file(path)?;
    // Of the very bytes that are read: whatever becomes of the file meanwhile.
    let hash: ContentHash = Sha256::digest(&bytes).into();
    store.record(path, &stamp, &hash);
    if known != Some(hash)
        && let Some(mesh) = taken(store, &of(&hash), path, &what)
    {
        return Ok(mesh);
    }
    store.told(Told::Missing { what: &what });
    let mesh = Arc::new(mesh::parse_as(&bytes, format, path, wanted)?);
    drop(bytes);
    if let Some(meta) = Meta::of(&mesh, path, store, began) {
        keep(store, of(&hash), Arc::clone(&mesh), meta.bytes());
    }
    Ok(mesh)
}

/// The mesh that is kept, where it is and can be used.
fn taken(store: &dyn Store, key: &Key, path: &Path, what: &str) -> Option<Arc<MeshData>> {
    let name = key.name();
    let file = store.open(&name)?;
    match KeptFile::open(file).and_then(|file| Ok((file.bytes, read(file.expect(key)?, path, store)?))) {
        Ok((bytes, mesh)) => {
            let mesh = mesh?;
            store.told(Told::Taken { what, bytes });
            Some(Arc::new(mesh))
        }
        Err(broken) => {
            store.told(Told::Broken { name: &name, why: &broken.to_string() });
            None
        }
    }
}

/// The arrays of a mesh, in the order of a file; `meta` comes first.
fn sections<'a>(mesh: &'a MeshData, meta: &'a [u8]) -> [&'a [u8]; 9] {
    let corners = |corners: &'a Option<Vec<[u32; 3]>>| corners.as_deref().map_or(&[][..], bytemuck::cast_slice);
    let colors = match mesh.colors.as_ref().map(|colors| &colors.values) {
        Some(ColorValues::Bytes(bytes)) => bytemuck::cast_slice(bytes),
        Some(ColorValues::Numbers(numbers)) => bytemuck::cast_slice(numbers),
        None => &[],
    };
    [
        meta,
        bytemuck::cast_slice(&mesh.positions),
        bytemuck::cast_slice(&mesh.triangles),
        bytemuck::cast_slice(&mesh.normals),
        corners(&mesh.normal_triangles),
        bytemuck::cast_slice(&mesh.uvs),
        corners(&mesh.uv_triangles),
        bytemuck::cast_slice(&mesh.triangle_material),
        colors,
    ]
}

fn keep(store: &dyn Store, key: Key, mesh: Arc<MeshData>, meta: Vec<u8>) {
    let bytes = file::bytes_of(&sections(&mesh, &meta));
    let name = key.name();
    store.keep(&name, bytes, Box::new(move |to| file::write(to, &key, &sections(&mesh, &meta))));
}

/// Reads a mesh; `None` where other files of it have changed.
fn read(file: KeptFile, path: &Path, store: &dyn Store) -> Result<Option<MeshData>, KeptError> {
    let meta =
        Meta::read(&file.array::<u8>(0)?).ok_or(KeptError::Unfit("what it says of the mesh is not to be read"))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let is_same = |(name, hash): &(String, ContentHash)| hash_of(&folder.join(name), store).as_ref() == Some(hash);
    if !meta.files.iter().all(is_same) {
        return Ok(None);
    }
    let corners = |k: usize, is_there: bool| is_there.then(|| file.array::<[u32; 3]>(k)).transpose();
    let colors = |coded: u64| -> Result<Option<VertexColors>, KeptError> {
        let values = match coded {
            0 => return Ok(None),
            1 | 3 => ColorValues::Bytes(file.array(8)?),
            _ => ColorValues::Numbers(file.array(8)?),
        };
        Ok(Some(VertexColors { values, is_srgb: coded >= 3 }))
    };
    let mut mesh = MeshData {
        positions: file.array(1)?,
        triangles: file.array(2)?,
        normals: file.array(3)?,
        normal_triangles: corners(4, meta.has_normal_triangles)?,
        uvs: file.array(5)?,
        uv_triangles: corners(6, meta.has_uv_triangles)?,
        triangle_material: file.array(7)?,
        colors: colors(meta.colors)?,
        materials: Vec::new(),
        libraries: meta.files.iter().map(|(name, _)| folder.join(name)).collect(),
        warnings: meta.warnings.iter().map(|warning| warning.told(path)).collect(),
        material_names: meta.material_names,
    };
    let materials = mesh.material_names.used.iter().filter(|(_, is_defined)| *is_defined).count();
    sound(&mesh, materials)?;
    if !mesh.material_names.used.is_empty() && !mesh.read_materials(path, &Files::default()).unwrap_or(false) {
        return Ok(None);
    }
    Ok(Some(mesh))
}

/// Sees that a mesh is what readers promise.
fn sound(mesh: &MeshData, materials: usize) -> Result<(), KeptError> {
    let within = |corners: &[[u32; 3]], count: usize, or: Option<u32>| {
        corners.par_iter().all(|corners| corners.iter().all(|&k| (k as usize) < count || Some(k) == or))
    };
    // Where corners have no indices of their own, they are those of the positions.
    let attribute = |values: usize, corners: &Option<Vec<[u32; 3]>>| match corners {
        Some(corners) => corners.len() == mesh.triangles.len() && within(corners, values, Some(NO_INDEX)),
        None => values == 0 || values == mesh.positions.len(),
    };
    let is_sound = !mesh.triangles.is_empty()
        && mesh.positions.par_iter().all(|p| p.iter().all(|x| x.abs() <= MAX_COORDINATE))
        && within(&mesh.triangles, mesh.positions.len(), None)
        && attribute(mesh.normals.len(), &mesh.normal_triangles)
        && attribute(mesh.uvs.len(), &mesh.uv_triangles)
        && mesh.colors.as_ref().is_none_or(|colors| are_colors(colors, mesh.positions.len()))
        && (mesh.triangle_material.is_empty() || mesh.triangle_material.len() == mesh.triangles.len())
        && mesh.triangle_material.par_iter().all(|&k| (k as usize) < materials || k == NO_INDEX)
        && mesh.normals.par_iter().all(|n| n.iter().all(|x| x.abs() <= 2.0))
        && mesh.uvs.par_iter().all(|uv| uv.iter().all(|x| x.is_finite()));
    if is_sound { Ok(()) } else { Err(KeptError::Unfit("its numbers are none of a mesh")) }
}

/// Whether there is a colour for each vertex.
fn are_colors(colors: &VertexColors, vertices: usize) -> bool {
    let are_within = match &colors.values {
        ColorValues::Bytes(bytes) => bytes.par_iter().all(|word| word >> 24 == 0),
        ColorValues::Numbers(numbers) => numbers.par_iter().all(|color| color.iter().all(|x| (0.0..=1.0).contains(x))),
    };
    colors.len() == vertices && are_within
}

/// The hash of a file's contents, recorded or made.
fn hash_of(path: &Path, store: &dyn Store) -> Option<ContentHash> {
    store.recorded(path).or_else(|| {
        let stamp = Stamp::of(path).ok()?;
        let hash: ContentHash = Sha256::digest(&mesh::read_regular_file(path).ok()?).into();
        store.record(path, &stamp, &hash);
        Some(hash)
    })
}

/// What there is to say of a mesh beside its arrays.
#[derive(Debug, Default, PartialEq)]
struct Meta {
    has_normal_triangles: bool,
    has_uv_triangles: bool,
    /// 0: none; 1: bytes, 2: numbers, both linear; 3, 4: in sRGB.
    colors: u64,
    material_names: MaterialNames,
    /// Other files, from the folder of the mesh's, and the hashes of what they hold.
    files: Vec<(String, ContentHash)>,
    warnings: Vec<Warning>,
}

/// A warning, but for the path.
#[derive(Debug, PartialEq)]
struct Warning {
    code: usize,
    message: String,
    expected: String,
    hint: String,
    line: Option<u64>,
}

impl Warning {
    /// `None` where something of it is of no such warning.
    fn of(told: &Diagnostic, path: &Path) -> Option<Self> {
        let Diagnostic { severity, code, message, span, path: field, expected, hint, elsewhere, edit, labels } = told;
        let line = match elsewhere {
            Some(place) if place.path == path => Some(place.line),
            Some(_) => return None,
            None => None,
        };
        let is_plain = *severity == Severity::Warning && *span == Span::NONE && field.is_empty();
        let code = CODES.iter().position(|known| known == code)?;
        let (message, expected, hint) = (message.clone(), expected.clone(), hint.clone());
        let whole = Warning { code, message, expected, hint, line };
        (is_plain && edit.is_none() && labels.is_empty()).then_some(whole)
    }

    fn told(&self, path: &Path) -> Diagnostic {
        let code = CODES.get(self.code).copied().unwrap_or(codes::MESH_ODDITIES);
        let warning = Diagnostic::warning(code, Span::NONE, &*self.message);
        let warning = Diagnostic { expected: self.expected.clone(), hint: self.hint.clone(), ..warning };
        self.line.map_or(warning.clone(), |line| warning.at_line(path, line))
    }
}

impl Meta {
    /// Of a mesh that was read from `path` after a moment; `None` where it cannot be kept.
    fn of(mesh: &MeshData, path: &Path, store: &dyn Store, began: SystemTime) -> Option<Self> {
        let has_materials = !mesh.material_names.used.is_empty();
        let folder = path.parent().unwrap_or(Path::new(""));
        // Of what was written meanwhile nobody knows what was read.
        let file = |file: &PathBuf| {
            let name = file.strip_prefix(folder).ok()?.to_str()?;
            let settled = Stamp::of(file).ok()?.is_settled(began);
            settled.then(|| Some((name.to_owned(), hash_of(file, store)?)))?
        };
        // Those of MTL are read again.
        let has_mtl = !mesh.material_names.libraries.is_empty();
        let files = if has_mtl { Some(Vec::new()) } else { mesh.libraries.iter().map(file).collect() };
        let told = mesh.warnings.iter().filter(|warning| !has_materials || warning.code != codes::MTL_UNSUPPORTED);
        Some(Meta {
            has_normal_triangles: mesh.normal_triangles.is_some(),
            has_uv_triangles: mesh.uv_triangles.is_some(),
            colors: mesh.colors.as_ref().map_or(0, |colors| {
                let numbers = matches!(colors.values, ColorValues::Numbers(_));
                1 + u64::from(numbers) + 2 * u64::from(colors.is_srgb)
            }),
            material_names: mesh.material_names.clone(),
            files: files?,
            warnings: told.map(|warning| Warning::of(warning, path)).collect::<Option<_>>()?,
        })
    }

    fn bytes(&self) -> Vec<u8> {
        let mut to = Vec::new();
        number(&mut to, u64::from(self.has_normal_triangles));
        number(&mut to, u64::from(self.has_uv_triangles));
        number(&mut to, self.colors);
        number(&mut to, self.material_names.libraries.len() as u64);
        self.material_names.libraries.iter().for_each(|name| text(&mut to, name));
        number(&mut to, self.material_names.used.len() as u64);
        for (name, is_defined) in &self.material_names.used {
            text(&mut to, name);
            number(&mut to, u64::from(*is_defined));
        }
        number(&mut to, self.files.len() as u64);
        for (name, hash) in &self.files {
            text(&mut to, name);
            to.extend(hash);
        }
        number(&mut to, self.warnings.len() as u64);
        for Warning { code, message, expected, hint, line } in &self.warnings {
            number(&mut to, *code as u64);
            [message, expected, hint].into_iter().for_each(|words| text(&mut to, words));
            number(&mut to, line.map_or(0, |line| line.saturating_add(1)));
        }
        to
    }

    /// `None` where they are none of [`bytes`](Self::bytes).
    fn read(mut from: &[u8]) -> Option<Self> {
        let from = &mut from;
        let has_normal_triangles = taken_flag(from)?;
        let has_uv_triangles = taken_flag(from)?;
        let colors = taken_number(from).filter(|coded| *coded <= 4)?;
        let libraries = list(from, taken_text)?;
        let used = list(from, |from| Some((taken_text(from)?, taken_flag(from)?)))?;
        let files = list(from, |from| Some((taken_text(from)?, *from.split_off(..32)?.first_chunk::<32>()?)))?;
        let warnings = list(from, |from| {
            let code = usize::try_from(taken_number(from)?).ok().filter(|code| *code < CODES.len())?;
            let (message, expected, hint) = (taken_text(from)?, taken_text(from)?, taken_text(from)?);
            Some(Warning { code, message, expected, hint, line: taken_number(from)?.checked_sub(1) })
        })?;
        let material_names = MaterialNames { libraries, used };
        from.is_empty().then_some(Meta {
            has_normal_triangles,
            has_uv_triangles,
            colors,
            material_names,
            files,
            warnings,
        })
    }
}

fn number(to: &mut Vec<u8>, number: u64) {
    to.extend(number.to_le_bytes());
}

fn text(to: &mut Vec<u8>, text: &str) {
    number(to, text.len() as u64);
    to.extend(text.as_bytes());
}

fn taken_number(from: &mut &[u8]) -> Option<u64> {
    Some(u64::from_le_bytes(*from.split_off(..8)?.first_chunk::<8>()?))
}

fn taken_flag(from: &mut &[u8]) -> Option<bool> {
    match taken_number(from)? {
        0 => Some(false),
        1 => Some(true),
        _ => None,
    }
}

fn taken_text(from: &mut &[u8]) -> Option<String> {
    let length = usize::try_from(taken_number(from)?).ok()?;
    String::from_utf8(from.split_off(..length)?.to_vec()).ok()
}

/// A list; it is as long as there are bytes for at most.
fn list<T>(from: &mut &[u8], mut one: impl FnMut(&mut &[u8]) -> Option<T>) -> Option<Vec<T>> {
    let count = taken_number(from)?;
    (0..count).map(|_| one(from)).collect()
}
