//! Faults of glTF files, each with its message and its place.

use super::square;
use super::support::{File, SQUARE, fault_of, glb};
use scene_format::diagnostic::Span;
use serde_json::{Value, json};
use std::path::Path;
use tracer_mesh::{MeshFormat, parse};

const GLTF: &str = "a glTF 2.0 file";

fn text(text: &str) -> [String; 2] {
    match parse(text.as_bytes(), MeshFormat::Gltf, Path::new("m.gltf")) {
        Err(error) => {
            let shown = error.to_string();
            [shown, error.to_diagnostic(Span::NONE).expected]
        }
        Ok(mesh) => panic!("{mesh:?}"),
    }
}

#[test]
fn json_that_is_broken_has_its_line() {
    for (words, message) in [
        ("", "m.gltf:1: the JSON is broken: EOF while parsing a value"),
        ("{\n \"asset\": {\"version\": \"2.0\"},\n \"nodes\": [}\n}", "m.gltf:3: the JSON is broken: expected value"),
        ("{\n\n\"nodes\": 7}", "m.gltf:3: the JSON is broken: invalid type: integer `7`, expected a sequence"),
        ("{}", "m.gltf:1: the file has no `asset`, so it is no glTF"),
        ("{\n\"asset\": {}}", "m.gltf:2: asset: missing field `version`"),
        ("{\n\"asset\": {\"version\": \"1.0\"}}", "m.gltf:2: version `1.0` of glTF cannot be read"),
    ] {
        assert_eq!(text(words), [message, GLTF], "{words}");
    }
    let broken = "{\"asset\": {\"version\": \"2.0\"},\n\"nodes\": [{},\n{\"mesh\": -1}]}";
    assert_eq!(text(broken), ["m.gltf:3: nodes[1]: invalid value: integer `-1`, expected u32", GLTF]);
    let invalid = [&b"{\"asset\": \""[..], &[0xff], b"\"}"].concat();
    let fault = fault_of(parse(&invalid, MeshFormat::Gltf, Path::new("m.gltf")));
    assert_eq!(fault, ["the text is not UTF-8", GLTF]);
}

#[test]
fn containers_that_are_broken_have_their_byte() {
    const WHOLE: &str = "a whole GLB file: a header of 12 bytes, a chunk of JSON, and one of binary data";
    let whole = square().glb();
    let with = |at: usize, bytes: &[u8]| {
        let mut changed = whole.clone();
        changed[at..at + bytes.len()].copy_from_slice(bytes);
        changed
    };
    let length = whole.len();
    let json = u32::from_le_bytes(whole[12..16].try_into().expect("four")) as usize;
    let longer = (length as u32 + 1).to_le_bytes();
    for (bytes, message, expected) in [
        (whole[..11].to_vec(), "m.glb: byte 11: the file ends within its header".to_owned(), WHOLE),
        (with(4, &[1]), "m.glb: byte 4: version 1 of the container cannot be read".to_owned(), GLTF),
        (
            with(8, &longer),
            format!("m.glb: byte 8: the header promises {} bytes, but the file has {length}", length + 1),
            WHOLE,
        ),
        (with(8, &[13, 0, 0, 0]), "m.glb: byte 12: a chunk is missing, or ends within its header".to_owned(), WHOLE),
        (with(16, b"BIN\0"), "m.glb: byte 16: the first chunk is not JSON".to_owned(), WHOLE),
        (
            with(20 + json, &longer),
            format!("m.glb: byte {}: a chunk of {} bytes goes beyond the end", 20 + json, length + 1),
            WHOLE,
        ),
    ] {
        let error = parse(&bytes, MeshFormat::Glb, Path::new("m.glb")).expect_err("a fault");
        assert_eq!([error.to_string(), error.to_diagnostic(Span::NONE).expected], [message, expected.to_owned()]);
    }
    // What follows the end is counted.
    let mesh = parse(&[&whole[..], b"more"].concat(), MeshFormat::Glb, Path::new("m.glb")).expect("a mesh");
    assert!(mesh.warnings.iter().any(|warning| warning.message.contains("4 bytes after the last face (ignored)")));
}

#[test]
fn numbers_that_lead_nowhere_are_told() {
    type Change = fn(&mut File);
    let cases: [(Change, &str, &str); 24] = [
        (|f| f.json["scene"] = 3.into(), "there is no scenes[3]", "a number from 0 to 0"),
        (|f| f.json["scenes"][0]["nodes"] = json!([9]), "there is no nodes[9]", "a number from 0 to 0"),
        (|f| f.json["nodes"][0]["mesh"] = 4.into(), "there is no meshes[4]", "a number from 0 to 0"),
        (
            |f| f.json["nodes"][0]["children"] = json!([0]),
            "nodes[0] is met twice on the way down from the scene",
            "nodes with one parent each, and no circle",
        ),
        (
            |f| f.json["nodes"][0]["rotation"] = json!([0, 0, 0, 0]),
            "the rotation of nodes[0] is zero",
            "a quaternion of length one",
        ),
        (
            |f| f.json["nodes"][0]["matrix"] = json!([1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
            "the matrix of nodes[0] is no affine one",
            "0, 0, 0, 1 as its last row",
        ),
        (
            |f| f.json["nodes"][0]["scale"] = json!([1e31, 1, 1]),
            "the coordinate `1e31` is too large",
            "a magnitude of at most 1e30",
        ),
        (
            |f| f.json["meshes"][0]["primitives"][0]["mode"] = 7.into(),
            "meshes[0].primitives[0] has the mode 7",
            "a mode from 0 to 6",
        ),
        (
            |f| f.json["meshes"][0]["primitives"][0]["attributes"] = Value::Null,
            "meshes[0].primitives[0]: invalid type: null, expected struct Attributes",
            GLTF,
        ),
        (
            |f| f.json["meshes"][0]["primitives"][0]["indices"] = 0.into(),
            "accessors[0] (indices) is `VEC3`",
            "the type SCALAR",
        ),
        (
            |f| f.json["accessors"][1]["componentType"] = 5126.into(),
            "accessors[1] (indices) has the componentType 5126",
            "5121, 5123 or 5125 (whole numbers from 0)",
        ),
        (
            |f| f.json["accessors"][0]["componentType"] = 5125.into(),
            "accessors[0] (POSITION) has the componentType 5125",
            "5126 (float), or 5120 to 5123",
        ),
        (
            |f| f.json["accessors"][0]["count"] = 5.into(),
            "accessors[0] (POSITION) needs 60 bytes of bufferViews[0], which has 48",
            "elements within their view",
        ),
        (
            |f| f.json["accessors"][0]["count"] = 3.into(),
            "element 5 of accessors[1] (indices) names vertex 3, but there are 3",
            "indices below the number of vertices",
        ),
        (
            |f| f.json["accessors"][0]["count"] = 5_000_000_000_u64.into(),
            "accessors[0] (POSITION) has 5000000000 elements",
            "at most 4294967295",
        ),
        (
            |f| f.json["accessors"][0]["byteOffset"] = u64::MAX.into(),
            "accessors[0] (POSITION) needs 18446744073709551615 bytes of bufferViews[0], which has 48",
            "elements within their view",
        ),
        (
            |f| f.json["bufferViews"][0]["byteStride"] = 8.into(),
            "bufferViews[0] has a `byteStride` of 8, but accessors[0] (POSITION) has elements of 12 bytes",
            "a `byteStride` of at least an element",
        ),
        (
            |f| f.json["bufferViews"][0]["byteLength"] = 61.into(),
            "bufferViews[0] goes from byte 0 over 61 bytes, but buffers[0] has 60",
            "a view within its buffer",
        ),
        (|f| f.json["bufferViews"][0]["buffer"] = 1.into(), "there is no buffers[1]", "a number from 0 to 0"),
        (
            |f| f.json["buffers"][0]["byteLength"] = 99.into(),
            "buffers[0] has 60 bytes instead of 99",
            "as many bytes as `byteLength` says",
        ),
        (
            |f| f.json["buffers"][0]["uri"] = "https://example.com/a.bin".into(),
            "buffers[0] is at `https://example.com/a.bin`, which is not fetched",
            "the name of a file beside the mesh, or a `data:` URI",
        ),
        (
            |f| f.json["buffers"][0]["uri"] = "data:text/plain,abc".into(),
            "the data of buffers[0] are not in base 64",
            "data:application/octet-stream;base64, and the bytes in base 64",
        ),
        (
            |f| f.json["buffers"][0]["uri"] = "data:;base64,a*c".into(),
            "the data of buffers[0] are broken: Invalid symbol 42, offset 1.",
            "data:application/octet-stream;base64, and the bytes in base 64",
        ),
        (
            |f| f.binary[0..4].copy_from_slice(&f32::NAN.to_le_bytes()),
            "element 0 of accessors[0] (POSITION) is not a finite number",
            "finite numbers",
        ),
    ];
    for (change, message, expected) in cases {
        let mut file = square();
        change(&mut file);
        assert_eq!(file.fault(), [message, expected]);
    }
}

#[test]
fn attributes_have_as_many_elements_as_positions() {
    let mut file = File::new();
    let positions = file.floats(&SQUARE);
    let normals = file.floats(&[[0.0, 0.0, 1.0]; 3]);
    let mesh = file.mesh(json!([{ "attributes": { "POSITION": positions, "NORMAL": normals } }]));
    file.root(json!({ "mesh": mesh }));
    let message = "accessors[1] (NORMAL) has 3 elements, but accessors[0] (POSITION) has 4";
    assert_eq!(file.fault(), [message, "as many of each attribute as there are positions"]);
    let indices = file.view(&[2, 1]);
    let values = file.view(&[0; 24]);
    file.json["accessors"][0]["sparse"] = json!({
        "count": 2, "indices": { "bufferView": indices, "componentType": 5121 }, "values": { "bufferView": values },
    });
    let message = "the sparse indices of accessors[0] (POSITION) do not ascend, or name elements that are not there";
    assert_eq!(file.fault(), [message, "ascending numbers below 4"]);
}

#[test]
fn required_extensions_are_named() {
    let mut file = square();
    for (name, hint) in [
        ("KHR_draco_mesh_compression", "export it without compression"),
        ("MSFT_lod", "export it without this extension"),
    ] {
        file.json["extensionsRequired"] = json!(["KHR_texture_transform", name]);
        let error = parse(&file.glb(), MeshFormat::Glb, Path::new("m.glb")).expect_err("an error");
        assert_eq!(error.to_string(), format!("m.glb: the file requires the glTF extension `{name}`"));
        let told = error.to_diagnostic(Span::NONE);
        assert_eq!(told.code, "E0513");
        assert_eq!(
            told.message,
            format!("the mesh file requires the glTF extension `{name}`, which is not known here")
        );
        assert_eq!(
            told.expected,
            "a glTF file that requires no extension but KHR_mesh_quantization and EXT_mesh_gpu_instancing"
        );
        assert_eq!(told.hint, hint);
    }
}

/// A few bytes that stand for a scene of terabytes.
#[test]
fn repeats_have_an_end() {
    let mut file = square();
    let zeros = json!({ "componentType": 5126, "type": "VEC3", "count": 4_000_000_000_u32 });
    file.json["accessors"][0] = zeros;
    let [message, expected] = file.fault();
    assert!(message.starts_with("the scene of the file repeats its meshes, or zeros, beyond 256 MB"), "{message}");
    assert_eq!(expected, "one of each mesh; copies stand in the scene, as `placements`");

    let mut file = File::new();
    let positions = file.floats(&[[1.0; 3]; 1000]);
    let mesh = file.mesh(json!([{ "attributes": { "POSITION": positions } }]));
    for _ in 0..10_000 {
        file.root(json!({ "mesh": mesh }));
    }
    assert!(file.fault()[0].starts_with("the scene of the file repeats its meshes"));

    // Instances by a few bytes, of a mesh in which there is nothing.
    let mut file = File::new();
    file.json["accessors"] = json!([{ "componentType": 5126, "type": "VEC3", "count": 4_000_000_000_u32 }]);
    let mesh = file.mesh(json!([]));
    let extensions = json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 0 } } });
    file.root(json!({ "mesh": mesh, "extensions": extensions }));
    assert!(file.fault()[0].starts_with("the scene of the file repeats its meshes"));
    file.json["accessors"] = json!([{ "componentType": 5126, "type": "VEC4", "count": 2 }]);
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = json!({ "ROTATION": 0 });
    let message = "rotation 0 of EXT_mesh_gpu_instancing is zero";
    assert_eq!(file.fault(), [message, "a quaternion of length one"]);
}

#[test]
fn a_scene_without_triangles_is_an_error() {
    let mut file = square();
    file.json["scenes"][0]["nodes"] = json!([]);
    let error = parse(&file.glb(), MeshFormat::Glb, Path::new("m.glb")).expect_err("an error");
    let told = error.to_diagnostic(Span::NONE);
    assert_eq!((told.code.as_str(), told.hint.as_str()), ("E0511", "the scene of the file has 0 meshes"));
    // A container without binary data, as of a scene of lights.
    let empty = glb("{\"asset\": {\"version\": \"2.0\"}}", b"");
    assert!(parse(&empty, MeshFormat::Glb, Path::new("m.glb")).is_err());
}
