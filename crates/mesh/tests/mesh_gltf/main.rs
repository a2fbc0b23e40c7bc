//! glTF files: both forms, nodes, primitives, accessors of all sorts, and what is not taken.

mod faults;
mod materials;
mod support;

use serde_json::json;
use std::path::Path;
use support::{FLOAT, File, SQUARE};
use tracer_mesh::{MeshFormat, NO_INDEX, load, parse};

/// A square on one node.
fn square() -> File {
    let mut file = File::new();
    let positions = file.floats(&SQUARE);
    let indices = file.shorts(&[0, 1, 2, 0, 2, 3]);
    let mesh = file.mesh(json!([{ "attributes": { "POSITION": positions }, "indices": indices }]));
    file.root(json!({ "mesh": mesh }));
    file
}

#[test]
fn a_square_comes_as_it_is() {
    let mesh = square().read();
    assert_eq!(mesh.positions, SQUARE.map(|point| point.map(f64::from)));
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert!(mesh.normals.is_empty() && mesh.uvs.is_empty() && mesh.warnings.is_empty());
    // Content tells the form, not the name.
    let swapped = parse(&square().glb(), MeshFormat::Gltf, Path::new("m.gltf")).expect("a mesh");
    assert_eq!(swapped.triangles, mesh.triangles);
}

/// Corners behind the last triangle are told.
#[test]
fn corners_that_make_no_triangle() {
    let mut file = File::new();
    let positions = file.floats(&SQUARE);
    let indices = file.shorts(&[0, 1, 2, 0, 2]);
    let mesh = file.mesh(json!([{ "attributes": { "POSITION": positions }, "indices": indices }]));
    file.root(json!({ "mesh": mesh }));
    let mesh = file.read();
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert!(mesh.warnings[0].message.contains("1 face of fewer than 3 corners (left out)"), "{:?}", mesh.warnings);
}

#[test]
fn strips_and_fans_are_unwound() {
    for (mode, expected) in [(5, vec![[0, 1, 2], [1, 3, 2], [2, 3, 4]]), (6, vec![[1, 2, 0], [2, 3, 0], [3, 4, 0]])] {
        let mut file = File::new();
        let positions =
            file.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 2.0, 0.0], [-1.0, 1.0, 1.0]]);
        let mesh = file.mesh(json!([{ "attributes": { "POSITION": positions }, "mode": mode }]));
        file.root(json!({ "mesh": mesh }));
        assert_eq!(file.read().triangles, expected);
    }
}

#[test]
fn nodes_move_their_meshes() {
    let mut file = square();
    file.json["scenes"][0]["nodes"] = json!([1]);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    // A quarter turn about z after a scale, then a matrix: columns x, y, z and the translation.
    file.node(json!({ "translation": [1, 2, 3], "children": [2] }));
    file.node(json!({ "rotation": [0, 0, half, half], "scale": [2, 3, 4], "children": [3] }));
    file.node(json!({ "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1], "mesh": 0 }));
    let mesh = file.read();
    for (point, [x, y, z]) in mesh.positions.iter().zip(SQUARE.map(|point| point.map(f64::from))) {
        let expected = [1.0 - 3.0 * (y + 20.0), 2.0 + 2.0 * (x + 10.0), 3.0 + 4.0 * (z + 30.0)];
        assert!(point.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{point:?} {expected:?}");
    }
    // Node 0 is not in the scene.
    assert_eq!(mesh.triangles.len(), 2);
}

/// The specification: a negative determinant winds the triangles the other way, so that fronts stay fronts.
#[test]
fn mirrored_nodes_keep_their_fronts_and_normals() {
    let mut file = File::new();
    let positions = file.floats(&SQUARE);
    let normals = file.floats(&[[0.0, 0.0, 2.0], [0.0, 3.0, 4.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let uvs = file.floats(&[[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.25, 0.25]]);
    let attributes = json!({ "POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs });
    let mesh = file.mesh(json!([{ "attributes": attributes, "mode": 6 }]));
    file.root(json!({ "mesh": mesh, "scale": [-1, 1, 2] }));
    let mesh = file.read();
    assert_eq!(mesh.positions[1], [-1.0, 0.0, 0.0]);
    assert_eq!(mesh.triangles, [[1, 0, 2], [2, 0, 3]]);
    // By the inverse transposed: (0, 3, 4/2), and x is turned round.
    let length = 13.0_f64.sqrt();
    let expected = [[0.0, 0.0, 1.0], [0.0, 3.0 / length, 2.0 / length], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for (normal, expected) in mesh.normals.iter().zip(expected) {
        assert!(normal.iter().zip(expected).all(|(&a, b)| (f64::from(a) - b).abs() < 1e-7), "{normal:?} {expected:?}");
    }
    // v runs upwards here.
    assert_eq!(mesh.uvs, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.25, 0.75]]);
    assert!(mesh.normal_triangles.is_none() && mesh.uv_triangles.is_none());
}

#[test]
fn the_default_scene_is_taken_or_what_comes_next() {
    let two = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut file = square();
        file.root(json!({ "translation": [5, 0, 0], "children": [2] }));
        file.node(json!({ "mesh": 0 }));
        file.json["scenes"] = json!([{ "nodes": [0] }, { "nodes": [1] }]);
        change(&mut file.json);
        let mesh = file.read();
        (mesh.triangles.len(), mesh.positions[0][0])
    };
    assert_eq!(two(&|_| {}), (2, 0.0));
    assert_eq!(two(&|json| json["scene"] = 1.into()), (2, 5.0));
    let without = |json: &mut serde_json::Value, words: &[&str]| {
        words.iter().for_each(|word| drop(json.as_object_mut().expect("words").remove(*word)));
    };
    assert_eq!(two(&|json| without(json, &["scene"])), (2, 0.0));
    // Without scenes the nodes that are nobody's children.
    assert_eq!(two(&|json| without(json, &["scene", "scenes"])), (4, 0.0));
    assert_eq!(two(&|json| without(json, &["scene", "scenes", "nodes"])), (2, 0.0));
}

#[test]
fn accessors_may_be_interleaved_sparse_and_normalized() {
    // Positions and texture coordinates in turns, 20 bytes a vertex.
    let mut file = File::new();
    let bytes: Vec<u8> =
        SQUARE.iter().flat_map(|&[x, y, z]| [x, y, z, 0.5 * x, 1.0 - y]).flat_map(f32::to_le_bytes).collect();
    let positions = file.accessor(&bytes, FLOAT, "VEC3", 4);
    file.json["bufferViews"][0]["byteStride"] = 20.into();
    file.json["accessors"]
        .as_array_mut()
        .expect("some")
        .push(json!({ "bufferView": 0, "byteOffset": 12, "componentType": FLOAT, "type": "VEC2", "count": 4 }));
    let mesh = file.mesh(json!([{ "attributes": { "POSITION": positions, "TEXCOORD_0": 1 }, "mode": 6 }]));
    file.root(json!({ "mesh": mesh }));
    let read = file.read();
    assert_eq!(read.positions, SQUARE.map(|point| point.map(f64::from)));
    assert_eq!(read.uvs, [[0.0, 0.0], [0.5, 0.0], [0.5, 1.0], [0.0, 1.0]]);
    // Two of the positions anew.
    let indices = file.view(&[1, 2]);
    let values: Vec<u8> = [7.0_f32, 0.0, 0.0, 0.0, 9.0, 0.0].into_iter().flat_map(f32::to_le_bytes).collect();
    let values = file.view(&values);
    file.json["accessors"][0]["sparse"] = json!({
        "count": 2, "indices": { "bufferView": indices, "componentType": 5121 }, "values": { "bufferView": values },
    });
    assert_eq!(file.read().positions, [[0.0; 3], [7.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 1.0, 0.0]]);
    // Over zeros, where there is no view.
    file.json["accessors"][0].as_object_mut().expect("words").remove("bufferView");
    file.json["accessors"][0]["count"] = 4.into();
    assert_eq!(file.read().positions, [[0.0; 3], [7.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0; 3]]);

    // KHR_mesh_quantization: normalized bytes, plain shorts.
    let mut file = File::new();
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    file.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    let positions = file.accessor(&[0, 0, 0, 127, 0, 0, 0, 129, 0], 5120, "VEC3", 3);
    file.json["accessors"][0]["normalized"] = true.into();
    let shorts: Vec<u8> = [0_u16, 65535, 3, 4, 5, 6].into_iter().flat_map(u16::to_le_bytes).collect();
    let uvs = file.accessor(&shorts, 5123, "VEC2", 3);
    let mesh = file.mesh(json!([{ "attributes": { "POSITION": positions, "TEXCOORD_0": uvs } }]));
    file.root(json!({ "mesh": mesh }));
    let read = file.read();
    assert_eq!(read.positions, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]);
    assert_eq!(read.uvs, [[0.0, -65534.0], [3.0, -3.0], [5.0, -5.0]]);
    assert!(read.warnings.is_empty());
}

#[test]
fn primitives_may_share_vertices_and_lack_what_others_have() {
    let mut file = File::new();
    let positions = file.floats(&SQUARE);
    let normals = file.floats(&[[0.0, 0.0, 1.0]; 4]);
    let uvs = file.floats(&[[0.5, 0.5]; 4]);
    let (first, second) = (file.shorts(&[0, 1, 2]), file.shorts(&[0, 2, 3]));
    let full = json!({ "POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs });
    let mesh = file.mesh(json!([
        { "attributes": full, "indices": first },
        { "attributes": full, "indices": second },
        { "attributes": { "POSITION": positions }, "indices": second },
        { "attributes": { "POSITION": positions }, "mode": 1 },
        { "attributes": { "NORMAL": normals } },
    ]));
    file.root(json!({ "mesh": mesh }));
    let mesh = file.read();
    // Shared by the first two, again for the third.
    assert_eq!(mesh.positions.len(), 8);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [4, 6, 7]]);
    assert_eq!(mesh.normal_triangles, Some(vec![[0, 1, 2], [0, 2, 3], [NO_INDEX; 3]]));
    assert_eq!(mesh.uv_triangles, Some(vec![[0, 1, 2], [0, 2, 3], [NO_INDEX; 3]]));
    let told: Vec<&str> = mesh.warnings.iter().map(|warning| warning.message.as_str()).collect();
    assert_eq!(
        told,
        ["the mesh has oddities: 1 triangle without vertex normals (flat); 1 triangle without texture coordinates \
             (kept); \
          1 primitive of points or lines (left out); 1 primitive without `POSITION` (left out)"]
    );
}

#[test]
fn what_is_not_taken_is_told() {
    let mut file = square();
    file.json["materials"] = json!([
        { "name": "gold", "extensions": { "KHR_materials_sheen": {} } },
        {},
        { "name": "unused", "normalTexture": { "index": 0 } },
    ]);
    file.json["meshes"][0]["primitives"][0]["material"] = 1.into();
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{}]);
    let more = file.json["meshes"][0]["primitives"][0].clone();
    file.json["meshes"][0]["primitives"].as_array_mut().expect("some").push(more);
    file.json["meshes"][0]["primitives"][1]["material"] = 0.into();
    file.json["skins"] = json!([{ "joints": [0] }]);
    file.json["animations"] = json!([{}, {}]);
    file.json["extensionsUsed"] = json!(["KHR_materials_ior", "MSFT_lod", "KHR_lights_punctual"]);
    file.json["extensionsRequired"] = json!(["KHR_materials_ior"]);
    let mesh = file.read();
    let told: Vec<_> = mesh.warnings.iter().map(|w| (w.code.as_str(), w.message.as_str(), w.hint.as_str())).collect();
    assert_eq!(
        told,
        [
            (
                "W0511",
                "the mesh's own materials are taken only in part: not supported: `KHR_materials_sheen` (in gold)",
                "a `material` in the scene replaces those of the file"
            ),
            (
                "W0512",
                "the mesh is taken without some of its file: 1 skin, 2 morphed primitives, 2 animations, \
                 extension `MSFT_lod`",
                "in the program that made it, apply them before export"
            ),
        ]
    );
}

/// Each instance is the mesh once more, within its node.
#[test]
fn instances_stand_where_their_accessors_say() {
    let mut file = square();
    let moves = file.floats(&[[0.0, 0.0, 1.0], [5.0, 0.0, 0.0], [0.0, 7.0, 0.0]]);
    let scales = file.floats(&[[1.0; 3], [2.0; 3], [1.0, 1.0, -1.0]]);
    let attributes = json!({ "TRANSLATION": moves, "SCALE": scales });
    file.json["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
    file.json["nodes"][0]["translation"] = json!([100, 0, 0]);
    file.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
    file.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    let mesh = file.read();
    assert!(mesh.warnings.is_empty(), "{:?}", mesh.warnings);
    assert_eq!(mesh.triangles.len(), 6);
    for (k, ([x, y, z], s)) in
        [([100.0, 0.0, 1.0], 1.0), ([105.0, 0.0, 0.0], 2.0), ([100.0, 7.0, 0.0], 1.0)].into_iter().enumerate()
    {
        for (at, corner) in mesh.positions[4 * k..].iter().zip(SQUARE.map(|point| point.map(f64::from))) {
            assert_eq!(*at, [x + s * corner[0], y + s * corner[1], z], "{k}");
        }
    }
    // The third is mirrored, and wound the other way.
    assert_eq!(mesh.triangles[4], [8, 10, 9]);
    let short = file.floats(&[[1.0; 3]]);
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = short.into();
    let fault = support::fault_of(parse(&file.glb(), MeshFormat::Glb, Path::new("m.glb")));
    assert!(fault[0].contains("as many") || fault[1].contains("as many"), "{fault:?}");
}

#[test]
fn buffers_stand_beside_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut file = square();
    file.json["buffers"][0]["uri"] = "two%20words.bin".into();
    let path = folder.path().join("m.gltf");
    std::fs::write(&path, file.json.to_string()).expect("written");
    let bin = folder.path().join("two words.bin");
    let fault = support::fault_of(load(&path));
    assert_eq!(fault[0], format!("buffers[0]: there is no file {}", bin.display()));
    std::fs::write(&bin, &file.binary).expect("written");
    let mesh = load(&path).expect("a mesh");
    assert_eq!(mesh.triangles.len(), 2);
    // Who keeps the mesh must know when that file changes.
    assert_eq!(mesh.libraries, [bin]);
}
