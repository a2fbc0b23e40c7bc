//! Damaged files: meshes, materials and placements with random mutations never panic, never take long, and give
//! either an error or data that keeps every promise of its type.
//!
//! `TRACER_MUTANTS=100000` sets the number of mutants of each kind.

#[path = "support/mutate.rs"]
mod mutate;

use mutate::{mutants, run};
use std::path::Path;
use tracer_mesh::placements::parse_placements;
use tracer_mesh::{ColorValues, MAX_COORDINATE, MeshData, MeshFormat, NO_INDEX, Wanted, load, parse, parse_as};

const OBJ: &str = "# a box with a dent\r\nmtllib none.mtl\nv 0 0 0\nv 1 0 0 \\\n 1.0\nv 1 1 0\nv 0.5 0.25 0\nv 0 1 0\n\
    v -1e-3 2.5E2 .5 0.1 0.2 0.3\nvt 0 0\nvt 1 0.5\nvn 0 0 1\nvn 0.1 0.2 0.3\no box\ng a b\ns 1\nusemtl m\n\
    f 1/1/1 2/2/1 3/1/2 4/2/2 5/1/1\nf -1//-1 -2//-2 \\\r\n -3//-1\nl 1 2\nf 1 2 3 4\nusemtl n\nf 6 5 4\n";
const OFF: &str = "OFF\n6 4 0\n0 0 0\n1 0 0\n1 1 0 # c\n0.5 0.25 0\n0 1 0\n-1e-3 2.5E2 .5\n5 0 1 2 3 4\n\
                   3 0 1 5 255 0 0\n\
    4 1 2 3 5\n2 0 1\n";
const CNOFF: &str = "STCNOFF 3 1 0\n0 0 0 0 0 1 255 0 0 255 0 1\n1 0 0 0 0 1 0 255 0 255 1 1\n\
                     0 1 0 0 0 0 1 2 3 4 0.5 0\n\
    3 0 1 2\n";
const PLY: &str = "ply\nformat ascii 1.0\ncomment c\nelement vertex 5\nproperty float x\nproperty float y\n\
    property double z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty float u\n\
    property float v\nelement edge 1\nproperty list char int a\nelement face 2\n\
    property list uchar int vertex_indices\n\
    element tristrips 1\nproperty list int int vertex_index\nend_header\n0 0 0 0 0 1 255 0 0\n1 0 0 0 0 1 0 1 0\n\
    1 1 0 0 0 0 0 1 1\n0.5 0.25 0 1 2 3 7 0.5 0.5\n0 1 -1e-3 0 1 0 9 0 1\n2 0 1\n5 0 1 2 3 4\n3 0 1 2\n\
    8 0 1 2 4 -1 1 2 3\n";
const STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0.5 1e0 0\nendloop\n\
    endfacet\nendsolid a\nsolid b\n  facet normal 0 0 0\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n\
    vertex 0 -1 2\nendloop\n  endfacet\nendsolid\n";
const MTL: &str = "# m\nnewmtl m\nKa 1 1 1\nKd 0.8 0.7 0.6\nKs 0.5 0.5 0.5\nNs 250\nNi 1.45\nd 1.0\nillum 2\n\
    map_Kd -s 1 1 1 -clamp on fur.png\nnewmtl n\nd 0.5\nTf 1 1 1\nmap_Bump b.png\n";
const PLACEMENTS: &str = "# where\n1 2 3\n1,2,3,0.5\n-1 2e3 3 2 0 1 0 45\n\n1 0 0 5 0 1 0 6 0 0 1 7\n";

/// All that `MeshData` promises.
fn assert_whole(mesh: &MeshData) {
    assert!(!mesh.triangles.is_empty());
    assert!(mesh.positions.iter().flatten().all(|x| x.abs() <= MAX_COORDINATE));
    assert!(mesh.triangles.iter().flatten().all(|&index| (index as usize) < mesh.positions.len()));
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize]);
        assert!(a != b && b != c && c != a);
    }
    for (indices, count) in [(&mesh.normal_triangles, mesh.normals.len()), (&mesh.uv_triangles, mesh.uvs.len())] {
        match indices {
            Some(indices) => {
                assert_eq!(indices.len(), mesh.triangles.len());
                assert!(indices.iter().flatten().all(|&index| index == NO_INDEX || (index as usize) < count));
                assert!(indices.iter().flatten().any(|&index| index != NO_INDEX));
            }
            None => assert!(count == 0 || count == mesh.positions.len()),
        }
    }
    let corners = mesh.normal_triangles.as_ref().unwrap_or(&mesh.triangles);
    for &index in corners.iter().flatten().filter(|&&index| index != NO_INDEX && !mesh.normals.is_empty()) {
        let length: f64 = mesh.normals[index as usize].iter().map(|&x| f64::from(x) * f64::from(x)).sum();
        // Three parts, each rounded to f32.
        assert!((length - 1.0).abs() < 1e-6);
    }
    assert!(mesh.uvs.iter().flatten().all(|x| x.is_finite()));
    if let Some(colors) = &mesh.colors {
        assert_eq!(colors.len(), mesh.positions.len());
        match &colors.values {
            ColorValues::Bytes(bytes) => assert!(bytes.iter().all(|word| word >> 24 == 0)),
            ColorValues::Numbers(numbers) => assert!(numbers.iter().flatten().all(|x| (0.0..=1.0).contains(x))),
        }
    }
    assert!(mesh.triangle_material.is_empty() || mesh.triangle_material.len() == mesh.triangles.len());
    assert!(mesh.triangle_material.iter().all(|&m| m == NO_INDEX || (m as usize) < mesh.materials.len()));
    assert!(mesh.barycentre().iter().all(|x| x.is_finite()));
    assert!(mesh.warnings.len() <= 3);
}

fn mutate_mesh(seed: u64, format: MeshFormat, original: impl AsRef<[u8]>) {
    mutate_brittle(seed, format, original, 50);
}

/// Of a format where most damage breaks the file: one of so many mutants must be read all the same.
fn mutate_brittle(seed: u64, format: MeshFormat, original: impl AsRef<[u8]>, of: usize) {
    let count = mutants();
    let good = run(seed, count, original.as_ref(), |bytes| {
        let name = Path::new("none/m");
        match parse_as(bytes, format, name, Wanted { colors: true, part: Some("a") }) {
            Ok(mesh) => assert_whole(&mesh),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
        // What is wrong with colours is wrong only where they are wanted.
        match (parse_as(bytes, format, name, Wanted { colors: true, part: None }), parse(bytes, format, name)) {
            (Ok(mesh), Ok(without)) => {
                assert_whole(&mesh);
                assert_whole(&without);
                assert!(without.colors.is_none() && mesh.triangles == without.triangles);
                true
            }
            (Err(error), Ok(without)) => {
                assert!(!error.to_string().is_empty());
                assert_whole(&without);
                false
            }
            (Ok(_), Err(error)) => panic!("without colours it is wrong: {error}"),
            (Err(error), Err(_)) => {
                assert!(!error.to_string().is_empty());
                false
            }
        }
    });
    assert!(good > count / of && good < count, "{good} of {count}");
}

#[test]
fn mutated_obj_files() {
    mutate_mesh(1, MeshFormat::Obj, OBJ);
}

#[test]
fn mutated_off_files() {
    mutate_mesh(2, MeshFormat::Off, OFF);
    mutate_mesh(3, MeshFormat::Off, CNOFF);
}

/// The data of `PLY` in binary, of either order of bytes.
fn binary_ply(name: &str, order: fn(&mut [u8])) -> Vec<u8> {
    let data = PLY.find("end_header\n").expect("an end") + "end_header\n".len();
    let mut bytes = PLY[..data].replace("ascii", name).into_bytes();
    let put = |bytes: &mut Vec<u8>, mut number: Vec<u8>| {
        order(&mut number);
        bytes.extend(number);
    };
    for (line, text) in PLY[data..].lines().enumerate() {
        let numbers: Vec<f64> = text.split(' ').map(|word| word.parse().expect("a number")).collect();
        for (place, &number) in numbers.iter().enumerate() {
            let raw = match (line, place) {
                (0..5, 2) => number.to_le_bytes().to_vec(),
                (0..5, 6) | (5..8, 0) => vec![number as u8],
                (0..5, _) => (number as f32).to_le_bytes().to_vec(),
                _ => (number as i32).to_le_bytes().to_vec(),
            };
            put(&mut bytes, raw);
        }
    }
    bytes
}

#[test]
fn mutated_ply_files() {
    mutate_mesh(8, MeshFormat::Ply, PLY);
    mutate_mesh(9, MeshFormat::Ply, binary_ply("binary_little_endian", |_| {}));
    mutate_mesh(10, MeshFormat::Ply, binary_ply("binary_big_endian", |bytes| bytes.reverse()));
}

#[test]
fn mutated_stl_files() {
    mutate_mesh(11, MeshFormat::Stl, STL);
    let mut bytes = [&b"solid made by hand"[..], &[b' '; 62], &4_u32.to_le_bytes()].concat();
    for k in 0..4_u8 {
        let number = |axis: u8| f32::from(k * axis % 5 + axis / 3).to_le_bytes();
        bytes.extend((0..12).flat_map(number).chain([0, 0]));
    }
    mutate_mesh(12, MeshFormat::Stl, bytes);
}

/// A square of all attributes and a sparse triangle on nodes, as text with its buffer in it.
const GLTF: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 2]}],
"nodes": [{"children": [1], "translation": [1, 2, 3]}, {"mesh": 0, "rotation": [0, 0, 0.6, 0.8], "scale": [-1, 2, 3]},
 {"mesh": 1, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 9, 1]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "COLOR_0": 1},
  "indices": 3, "material": 0},
  {"attributes": {"POSITION": 0}, "mode": 5}]}, {"primitives": [{"attributes": {"POSITION": 4}, "mode": 6}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4},
 {"bufferView": 0, "byteOffset": 12, "componentType": 5126, "type": "VEC3", "count": 4},
 {"bufferView": 0, "byteOffset": 24, "componentType": 5126, "type": "VEC2", "count": 4},
 {"bufferView": 1, "componentType": 5121, "type": "SCALAR", "count": 6},
 {"componentType": 5120, "normalized": true, "type": "VEC3", "count": 3,
  "sparse": {"count": 2, "indices": {"bufferView": 2, "componentType": 5121}, "values": {"bufferView": 3}}}],
"bufferViews": [{"buffer": 0, "byteLength": 128, "byteStride": 32}, {"buffer": 0, "byteOffset": 128, "byteLength": 6},
 {"buffer": 0, "byteOffset": 134, "byteLength": 2}, {"buffer": 0, "byteOffset": 136, "byteLength": 6}],
"materials": [{"name": "m", "emissiveFactor": [0, 0, 0], "pbrMetallicRoughness": {"metallicFactor": 0,
  "roughnessFactor": 1, "baseColorFactor": [0.5, 1, 1, 1], "baseColorTexture": {"index": 0, "texCoord": 0,
   "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "rotation": 1, "scale": [2, 2]}}}},
  "extensions": {"KHR_materials_ior": {"ior": 1.5}, "KHR_materials_transmission": {"transmissionFactor": 0},
   "KHR_materials_volume": {"attenuationDistance": 1}, "KHR_materials_emissive_strength": {"emissiveStrength": 1}}}],
"textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": 33071, "magFilter": 9728}],
"images": [{"bufferView": 3, "mimeType": "image/png"}],
"buffers": [{"byteLength": 142, "uri": "data:application/octet-stream;base64,DATA"}],
"extensionsUsed": ["KHR_mesh_quantization", "KHR_materials_ior"]}"#;

fn gltf_buffer() -> Vec<u8> {
    let square = [[0.0_f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let floats = square.into_iter().flat_map(|[x, y]| [x, y, 0.0, 0.0, x, 1.0, x, y]);
    let rest = [0, 1, 2, 0, 2, 3, 1, 2, 127, 0, 0, 0, 129, 3];
    floats.flat_map(f32::to_le_bytes).chain(rest).collect()
}

fn gltf_text() -> String {
    use base64::Engine as _;
    GLTF.replace("DATA", &base64::engine::general_purpose::STANDARD.encode(gltf_buffer()))
}

fn glb() -> Vec<u8> {
    let mut json = GLTF.replace(", \"uri\": \"data:application/octet-stream;base64,DATA\"", "").into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let buffer = gltf_buffer();
    let chunk = |kind: &[u8; 4], bytes: &[u8]| [&(bytes.len() as u32).to_le_bytes()[..], kind, bytes].concat();
    let chunks = [chunk(b"JSON", &json), chunk(b"BIN\0", &buffer)].concat();
    [&b"glTF\x02\0\0\0"[..], &(12 + chunks.len() as u32).to_le_bytes(), &chunks].concat()
}

#[test]
fn mutated_gltf_files() {
    mutate_brittle(13, MeshFormat::Gltf, gltf_text(), 200);
    mutate_brittle(14, MeshFormat::Glb, glb(), 200);
}

/// Damage that leaves the JSON whole: numbers for other numbers.
#[test]
fn mutated_gltf_numbers() {
    const NUMBERS: [&str; 22] = [
        "0",
        "1",
        "2",
        "3",
        "4",
        "5",
        "6",
        "7",
        "12",
        "127",
        "128",
        "5120",
        "5121",
        "5123",
        "5125",
        "5126",
        "-1",
        "1e30",
        "4294967295",
        "4294967296",
        "18446744073709551615",
        "0.5",
    ];
    let text = gltf_text();
    let head = text.find("\"buffers\"").expect("buffers");
    let is_digit = |at: usize| text.as_bytes()[at].is_ascii_digit();
    let starts: Vec<usize> =
        (1..head).filter(|&at| is_digit(at) && !is_digit(at - 1) && text.as_bytes()[at - 1] != b'_').collect();
    let (count, mut random, mut good) = (mutants(), mutate::Random(15), 0);
    for number in 0..count {
        let mut bytes = text.clone();
        for _ in 0..=random.below(2) {
            let at = starts[random.below(starts.len())];
            // What was put in before may have moved it: then the JSON breaks, which is another mutant.
            let end =
                bytes.as_bytes()[at..].iter().position(|byte| !byte.is_ascii_digit()).map_or(at, |length| at + length);
            bytes.replace_range(at..end, NUMBERS[random.below(NUMBERS.len())]);
        }
        let start = std::time::Instant::now();
        let read = parse(bytes.as_bytes(), MeshFormat::Gltf, Path::new("none/m"));
        let took = start.elapsed();
        // A few numbers may stand for 256 MB of zeros, which machines that are busy may need a while for.
        assert!(took < std::time::Duration::from_secs(10), "mutant {number}: {took:?}: {bytes}");
        if let Ok(mesh) = read {
            assert_whole(&mesh);
            good += 1;
        }
    }
    assert!(good > count / 50 && good < count, "{good} of {count}");
}

#[test]
fn mutated_mtl_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let obj = folder.path().join("m.obj");
    std::fs::write(&obj, "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\nusemtl n\nf 1 2 3\n")
        .expect("written");
    // A fifth of the others: each is written to a file.
    let count = mutants() / 5;
    let good = run(4, count, MTL.as_bytes(), |bytes| {
        std::fs::write(folder.path().join("m.mtl"), bytes).expect("written");
        load(&obj).inspect(assert_whole).is_ok()
    });
    assert!(good > count / 50 && good < count, "{good} of {count}");
}

#[test]
fn mutated_placements() {
    let count = mutants();
    let good = run(5, count, PLACEMENTS.as_bytes(), |bytes| match parse_placements(bytes, Path::new("p")) {
        Ok(placements) => {
            assert!(placements.iter().all(|placement| placement.is_finite() && !placement.inverse().is_nan()));
            !placements.is_empty()
        }
        Err(_) => false,
    });
    assert!(good > count / 50 && good < count, "{good} of {count}");
}
