//! glTF 2.0 (Khronos, "glTF 2.0 Specification", 2021), as text (`.gltf`) and in its binary container (`.glb`): the
//! triangles of the default scene, in the frame of the scene.
//!
//! - The default scene; without one the first, without scenes all nodes that are nobody's children, without nodes all
//!   meshes. Nodes with `matrix` or translation, rotation and scale; a mirrored node's triangles are wound the other
//!   way, as the specification asks.
//! - A part that is wanted alone is a node with all that is below it, or a mesh wherever it stands, by its name.
//! - Triangles, strips and fans; `POSITION`, `NORMAL`, `TEXCOORD_0` (its v runs downwards, ours upwards), indices;
//!   accessors of all types, interleaved, sparse, normalized. Buffers: of the container, `data:` URIs, files beside the
//!   mesh.
//! - Its materials, as far as the scene language has such ([`materials`](mod@materials)), with pictures beside the file
//!   and within it.
//! - Required extensions that are known are `KHR_mesh_quantization` and `EXT_mesh_gpu_instancing`; those of materials
//!   and textures are told with them, those of lights are passed over. Another is an error `E0513`.
//! - Skins, morph targets, animations and optional extensions are told in a warning `W0512`.
//!
//! A few bytes of a file may say that a mesh stands in a million places, or a million zeros: what all of it takes is at
//! most 256 MB more than nine times the file with its buffers.

mod accessor;
mod document;
mod instancing;
mod materials;
mod pictures;
mod walk;

use super::builder::Builder;
use super::colors::Wanted;
use super::cursor::{Fault, shown};
use super::data::{MaterialNames, MeshData};
use super::error::MeshError;
use super::files::Files;
use super::oddities::Oddity;
use super::parts;
use accessor::Buffers;
use document::{Document, EXPECTED};
use scene_format::Diagnostic;
use scene_format::codes;
use scene_format::desc::NamedMaterial;
use scene_format::diagnostic::Span;
use std::path::Path;
use walk::Walk;

/// The required extensions that are read.
const KNOWN: [&str; 2] = ["KHR_mesh_quantization", "EXT_mesh_gpu_instancing"];

/// How the names of extensions begin that say nothing of triangles.
const OF_LOOKS: [&str; 5] = ["KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "KHR_xmp"];

/// How many names a warning shows.
const NAMES: usize = 8;

/// Reads a glTF file; its content tells which of the two forms it has.
pub(super) fn read(bytes: &[u8], (path, files): (&Path, &Files), wanted: Wanted<'_>) -> Result<MeshData, MeshError> {
    let (parts, is_container) = Parts::of(bytes).map_err(|fault| MeshError::at_byte(path, *fault))?;
    let told = |fault: Box<Fault>| parts.told(*fault, is_container, path);
    let document = parts.document().map_err(told)?;
    if let Some(name) = document.required.iter().find(|name| !KNOWN.contains(&name.as_str()) && !is_of_looks(name)) {
        return Err(MeshError::Extension { path: path.to_owned(), name: plain(name) });
    }
    let mut builder = Builder::default();
    builder.oddities.add_many(Oddity::TrailingByte, parts.trailing);
    let mut buffers = Buffers::new(&document, (path, files), parts.binary, bytes.len() as u64);
    let mut walk = Walk::new(&document, &mut builder, &mut buffers, wanted);
    walk.all().map_err(told)?;
    if let (Some(part), Some(names)) = (wanted.part, walk.names_without_part()) {
        return Err(parts::unknown(path, part, names, "nodes and meshes"));
    }
    let walk::Found { meshes, morphs, materials: used, triangle_material, without_uvs, uvs } = walk.found;
    let (materials, warning) = materials::turn(&document, &used, path, files).map_err(told)?;
    // What is one colour does without texture coordinates.
    let plain = used.iter().zip(&materials).filter(|(_, named)| named.material.textures().is_empty());
    let plain: Vec<Option<u32>> = plain.map(|(number, _)| Some(*number)).collect();
    for (_, count) in without_uvs.into_iter().filter(|(material, _)| !plain.contains(material)) {
        builder.oddities.add_many(Oddity::MissingUvs, count);
    }
    let libraries = buffers.files();
    builder.mesh.uv_triangles = uvs;
    let whole = wanted.part.map_or("scene of the file".to_owned(), |part| format!("part {}", shown(part.as_bytes())));
    let found = format!("the {whole} has {meshes} {}", if meshes == 1 { "mesh" } else { "meshes" });
    let mut mesh = builder.finish(path, &found)?;
    mesh.libraries = libraries;
    let numbers = used.iter().map(|number| (number.to_string(), true)).collect();
    mesh.material_names = MaterialNames { libraries: Vec::new(), used: numbers };
    (mesh.materials, mesh.triangle_material) = (materials, triangle_material);
    mesh.warnings.extend(warning);
    mesh.warnings.extend(of_the_rest(&document, morphs, path));
    Ok(mesh)
}

/// The materials of these numbers, of a file that was read before.
///
/// # Errors
/// When it cannot be read any more, or they are broken.
pub(super) fn materials(
    path: &Path,
    files: &Files,
    used: &[u32],
) -> Result<(Vec<NamedMaterial>, Option<Diagnostic>), MeshError> {
    let bytes = files.read(path)?;
    let (parts, is_container) = Parts::of(&bytes).map_err(|fault| MeshError::at_byte(path, *fault))?;
    let told = |fault: Box<Fault>| parts.told(*fault, is_container, path);
    let document = parts.document().map_err(told)?;
    materials::turn(&document, used, path, files).map_err(told)
}

/// The bytes of a picture that a file holds; the text says why there are none.
pub(super) fn picture(bytes: &[u8], (path, files): (&Path, &Files), index: u32) -> Result<Vec<u8>, String> {
    let read = || {
        let (parts, _) = Parts::of(bytes)?;
        let document = parts.document()?;
        let mut buffers = Buffers::new(&document, (path, files), parts.binary, bytes.len() as u64);
        pictures::read(&document, &mut buffers, index)
    };
    read().map_err(|fault: Box<Fault>| fault.message)
}

fn is_of_looks(name: &str) -> bool {
    OF_LOOKS.iter().any(|start| name.starts_with(start))
}

/// A name of sensible length.
fn plain(name: &str) -> String {
    shown(name.as_bytes()).trim_matches('`').to_owned()
}

/// The parts of a container.
struct Parts<'a> {
    json: &'a [u8],
    /// Where in the file it starts.
    json_at: usize,
    binary: Option<&'a [u8]>,
    /// Bytes after its end.
    trailing: u64,
}

/// Four bytes of a binary file as a number.
fn number(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|four| u32::from_le_bytes(*four))
}

impl<'a> Parts<'a> {
    /// Of a file, whose content tells which of the two forms it has; whether it is a container.
    fn of(bytes: &'a [u8]) -> Result<(Parts<'a>, bool), Box<Fault>> {
        if bytes.starts_with(b"glTF") {
            return Ok((Parts::of_container(bytes)?, true));
        }
        Ok((Parts { json: bytes, json_at: 0, binary: None, trailing: 0 }, false))
    }

    fn document(&self) -> Result<Document<'a>, Box<Fault>> {
        let text = std::str::from_utf8(self.json)
            .map_err(|error| Fault::new(error.valid_up_to(), "the text is not UTF-8", EXPECTED))?;
        Document::parse(text)
    }

    /// A fault of the JSON, at its place in the file.
    fn told(&self, mut fault: Fault, is_container: bool, path: &Path) -> MeshError {
        if is_container {
            fault.at += self.json_at;
            MeshError::at_byte(path, fault)
        } else {
            MeshError::at_line(path, self.json, fault)
        }
    }

    /// Of a file that starts with `glTF`: version and length, then chunks, each with its length, its kind and its
    /// bytes.
    fn of_container(bytes: &'a [u8]) -> Result<Parts<'a>, Box<Fault>> {
        const HEADER: usize = 12;
        const CHUNK: usize = 8;
        const JSON: u32 = 0x4e4f_534a;
        const BINARY: u32 = 0x004e_4942;
        const WHOLE: &str = "a whole GLB file: a header of 12 bytes, a chunk of JSON, and one of binary data";
        let (Some(version), Some(length)) = (number(bytes, 4), number(bytes, 8)) else {
            return Err(Fault::new(bytes.len(), "the file ends within its header", WHOLE));
        };
        if version != 2 {
            return Err(Fault::new(4, format!("version {version} of the container cannot be read"), EXPECTED));
        }
        let Some(file) = bytes.get(..length as usize) else {
            let message = format!("the header promises {length} bytes, but the file has {}", bytes.len());
            return Err(Fault::new(8, message, WHOLE));
        };
        let chunk = |at: usize| -> Result<(u32, &'a [u8]), Box<Fault>> {
            let (Some(length), Some(kind)) = (number(file, at), number(file, at + 4)) else {
                return Err(Fault::new(at, "a chunk is missing, or ends within its header", WHOLE));
            };
            match file.get(at + CHUNK..).and_then(|rest| rest.get(..length as usize)) {
                Some(content) => Ok((kind, content)),
                None => Err(Fault::new(at, format!("a chunk of {length} bytes goes beyond the end"), WHOLE)),
            }
        };
        let (kind, json) = chunk(HEADER)?;
        if kind != JSON {
            return Err(Fault::new(HEADER + 4, "the first chunk is not JSON", WHOLE));
        }
        let mut at = HEADER + CHUNK + json.len();
        let mut binary = None;
        // Chunks of other kinds are stepped over, as the specification asks.
        while binary.is_none() && at < file.len() {
            let (kind, content) = chunk(at)?;
            at += CHUNK + content.len();
            binary = (kind == BINARY).then_some(content);
        }
        let trailing = (bytes.len() - file.len()) as u64;
        Ok(Parts { json, json_at: HEADER + CHUNK, binary, trailing })
    }
}

/// The first of some names, for a warning.
fn some<'n>(names: impl ExactSizeIterator<Item = &'n str>) -> String {
    let more = if names.len() > NAMES { ", .." } else { "" };
    let names: Vec<String> = names.take(NAMES).map(|name| shown(name.as_bytes())).collect();
    format!("{}{more}", names.join(", "))
}

/// `W0512`: what else is not taken.
fn of_the_rest(document: &Document<'_>, morphs: u64, path: &Path) -> Option<Diagnostic> {
    let counted = |count: u64, one: &str| match count {
        0 => None,
        1 => Some(format!("1 {one}")),
        count => Some(format!("{count} {one}s")),
    };
    let mut parts: Vec<String> = [
        counted(document.skins as u64, "skin"),
        counted(morphs, "morphed primitive"),
        counted(document.animations as u64, "animation"),
    ]
    .into_iter()
    .flatten()
    .collect();
    let others: Vec<&str> =
        document.used.iter().map(String::as_str).filter(|name| !KNOWN.contains(name) && !is_of_looks(name)).collect();
    if !others.is_empty() {
        let word = if others.len() == 1 { "extension" } else { "extensions" };
        parts.push(format!("{word} {}", some(others.iter().copied())));
    }
    (!parts.is_empty()).then(|| {
        let message = format!("the mesh is taken without some of its file: {}", parts.join(", "));
        Diagnostic::warning(codes::GLTF_UNSUPPORTED, Span::NONE, message)
            .expected("triangles that stand still: meshes on nodes")
            .hint("in the program that made it, apply them before export")
            .at_line(path, 0)
    })
}
