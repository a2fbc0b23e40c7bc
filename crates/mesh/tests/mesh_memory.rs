//! Memory stays in proportion to the file: at its peak within ten times the file and 64 MB, whatever the file promises.
//!
//! One test alone in its process, because the count is that of the whole process.

#[path = "support/peak.rs"]
mod peak;

use peak::peak_of;
use std::path::Path;
use tracer_mesh::{MeshFormat, Wanted, parse_as};

type File = (&'static str, MeshFormat, Vec<u8>, usize);

/// A PLY file: its encoding and elements, the head of its data, and what is repeated to 8 MB and counted in the header.
fn ply(encoding: &str, elements: &str, head: &[u8], item: &[u8]) -> Vec<u8> {
    let count = (8 << 20) / item.len();
    let elements = elements.replace("COUNT", &count.to_string());
    let header = format!("ply\nformat {encoding} 1.0\n{elements}end_header\n");
    [header.into_bytes(), head.to_vec(), item.repeat(count)].concat()
}

/// With the most bytes that each may take for one of its own.
fn ply_files() -> Vec<File> {
    let (text, binary) = ("ascii", "binary_little_endian");
    let xyz = "property char x\nproperty char y\nproperty char z\n";
    let all = format!("{xyz}property char nx\nproperty char ny\nproperty char nz\nproperty char u\nproperty char v\n");
    let rgb = "property uchar r\nproperty uchar g\nproperty uchar b\n";
    let four = format!("element vertex 4\n{xyz}");
    let nine = format!("element vertex 9\n{xyz}");
    let places = b"\0\0\0\x01\0\0\x01\x01\0\0\x01\0";
    let words = b"0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    let parabola: Vec<u8> = (0..9).flat_map(|i| [i, i * i, 0]).collect();
    let list = |kind: &str| format!("element face COUNT\nproperty list uchar {kind} vertex_indices\n");
    let one_strip = |kind: &str, index: [&[u8]; 4]| {
        let count = (8_u32 << 20) / 4;
        let elements = format!("{four}element tristrips 1\nproperty list uint {kind} vertex_indices\n");
        let header = format!("ply\nformat binary_little_endian 1.0\n{elements}end_header\n");
        [header.as_bytes(), places, &(4 * count).to_le_bytes(), &index.concat().repeat(count as usize)].concat()
    };
    let promise = |elements: &str, data: &[u8]| {
        let header = format!("ply\nformat binary_little_endian 1.0\n{elements}end_header\n");
        [header.as_bytes(), data].concat()
    };
    let file = |what, bytes, times| (what, MeshFormat::Ply, bytes, times);
    vec![
        file("PLY of 10^12 vertices", promise(&format!("element vertex 1000000000000\n{xyz}"), places), 9),
        file(
            "PLY of 10^12 faces",
            promise(&(four.clone() + &list("int").replace("COUNT", "1000000000000")), places),
            9,
        ),
        file("PLY of 10^12 empty items", promise(&format!("element a 1000000000000\n{four}"), places), 9),
        file(
            "PLY face of 2^32 corners",
            {
                let faces = "element face 1\nproperty list uint int vertex_index\n";
                promise(&(four.clone() + faces), &[&places[..], &[0xff; 64]].concat())
            },
            9,
        ),
        file("PLY header", ply(text, &"element a 1\n".repeat(700_000), b"", b"\n"), 9),
        file(
            "PLY properties",
            ply(text, &format!("element a 1\n{}", "property int a\n".repeat(500_000)), b"", b"\n"),
            9,
        ),
        file("PLY vertices", ply(binary, &format!("element vertex COUNT\n{xyz}"), b"", &[1, 2, 3]), 9),
        file("PLY vertices with all", ply(binary, &format!("element vertex COUNT\n{all}"), b"", &[0; 8]), 9),
        file("PLY vertices with colours", ply(binary, &format!("element vertex COUNT\n{xyz}{rgb}"), b"", &[0; 6]), 9),
        file("PLY vertices in ASCII", ply(text, &format!("element vertex COUNT\n{xyz}"), b"", b"0 0 0\n"), 9),
        file(
            "PLY triangles",
            ply(binary, &(four.clone() + &list("int")), places, b"\x03\0\0\0\0\x01\0\0\0\x02\0\0\0"),
            9,
        ),
        file("PLY triangles of bytes", ply(binary, &(four.clone() + &list("char")), places, b"\x03\0\x01\x02"), 9),
        file("PLY triangles in ASCII", ply(text, &(four.clone() + &list("int")), words, b"3 0 1 2\n"), 9),
        file("PLY faces of nothing", ply(binary, &(four.clone() + &list("int")), places, b"\0"), 9),
        file(
            "PLY polygons",
            {
                let corners: Vec<u8> = [9].into_iter().chain((0..9).flat_map(|i: u16| i.to_le_bytes())).collect();
                ply(binary, &(nine.clone() + &list("short")), &parabola, &corners)
            },
            9,
        ),
        file("PLY strips of ints", one_strip("int", [&[0; 4], &[1, 0, 0, 0], &[2, 0, 0, 0], &[3, 0, 0, 0]]), 9),
        // Where a corner is a byte, a triangle of 12 bytes may be one, too: only 256 vertices can be named so.
        file(
            "PLY polygons of bytes",
            ply(binary, &(nine.clone() + &list("char")), &parabola, &[9, 0, 1, 2, 3, 4, 5, 6, 7, 8]),
            28,
        ),
        file("PLY strips of bytes", one_strip("char", [&[0], &[1], &[2], &[3]]), 28),
    ]
}

/// As [`ply_files`].
fn stl_files() -> Vec<File> {
    let count = (8 << 20) / 50;
    let bytes = |corner: &dyn Fn(u32) -> f32| {
        let mut bytes = [&[0; 80][..], &(count as u32).to_le_bytes()].concat();
        for number in 0..count as u32 {
            bytes.extend([0; 12]);
            bytes.extend((0..9).flat_map(|k| corner(9 * number + k).to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    };
    let facet = "facet\nouter\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let file = |what, bytes, times| (what, MeshFormat::Stl, bytes, times);
    vec![
        file("STL of 2^32 triangles", [&[0; 80][..], &[0xff; 54]].concat(), 9),
        file("STL of corners all apart", bytes(&|k| (k % 97) as f32 + k as f32), 9),
        file("STL of the same triangle", bytes(&|k| [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0][k as usize % 9]), 9),
        file("STL in ASCII", format!("solid\n{}endsolid\n", facet.repeat((8 << 20) / facet.len())).into_bytes(), 9),
    ]
}

/// As [`ply_files`]. What lists of JSON hold is a word in memory for two bytes of the file, and a list that grows is
/// there twice.
fn gltf_files() -> Vec<File> {
    let repeated = |head: &str, item: &str, tail: &str| {
        let items = item.repeat((8 << 20) / item.len().max(1));
        format!("{{\"asset\":{{\"version\":\"2.0\"}},{head}{}{tail}}}", items.trim_end_matches(',')).into_bytes()
    };
    let container = |json: &str, binary: &[u8]| {
        let json = format!("{json}{}", " ".repeat(json.len().next_multiple_of(4) - json.len()));
        let mut bytes =
            [&b"glTF\x02\0\0\0"[..], &(28 + json.len() as u32 + binary.len() as u32).to_le_bytes()].concat();
        for (kind, content) in [(b"JSON", json.as_bytes()), (b"BIN\0", binary)] {
            bytes.extend([&(content.len() as u32).to_le_bytes()[..], kind, content].concat());
        }
        bytes
    };
    let vertices = |count: usize, indices: usize, mode: u32| {
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}},\
             \"indices\":1,\
             \"mode\":{mode}}}]}}],\"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\
             \"type\":\"VEC3\",\"count\":{count}}},\
             {{\"bufferView\":1,\"componentType\":5121,\"type\":\"SCALAR\",\"count\":{indices}}}],\
             \"bufferViews\":[{{\"buffer\":0,\
             \"byteLength\":{0}}},{{\"buffer\":0,\"byteOffset\":{0},\"byteLength\":{indices}}}],\
             \"buffers\":[{{\"byteLength\":{1}}}]}}",
            12 * count,
            12 * count + indices
        )
    };
    let floats =
        |count: usize| -> Vec<u8> { (0..3 * count).flat_map(|k| ((k * k % 97) as f32).to_le_bytes()).collect() };
    let data = "AAAA".repeat(2 << 20);
    let file = |what, bytes, times| (what, MeshFormat::Gltf, bytes, times);
    vec![
        file("glTF nodes", repeated("\"nodes\":[", "{},", "]"), 28),
        file("glTF nodes that are none", repeated("\"nodes\":[", "0,", "]"), 28),
        file("glTF roots", repeated("\"nodes\":[{}],\"scenes\":[{\"nodes\":[", "0,", "]}]"), 28),
        file("glTF chain of nodes", chain(), 28),
        file("glTF primitives", repeated("\"meshes\":[{\"primitives\":[", "0,", "]}]"), 28),
        file("glTF extensions", repeated("\"extensionsUsed\":[", "\"\",", "]"), 28),
        file("glTF of things not read", repeated("\"extras\":[", "[0],", "]"), 9),
        file(
            "glTF buffer in text",
            repeated(
                &format!(
                    "\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}}}}]}}],\
                     \"accessors\":[{{\"bufferView\":0,\
                     \"componentType\":5126,\"type\":\"VEC3\",\"count\":3}}],\
                      \"bufferViews\":[{{\"buffer\":0,\"byteLength\":36}}],\
                     \"buffers\":[{{\"byteLength\":36,\"uri\":\"data:;base64,{data}\"}}],\"extras\":[0"
                ),
                "",
                "]",
            ),
            9,
        ),
        file("GLB vertices", container(&vertices(700_000, 3, 4), &[floats(700_000), vec![0, 1, 2]].concat()), 9),
        file(
            "GLB strip of bytes",
            container(
                &vertices(200, 8 << 20, 5),
                &[floats(200), (0..8 << 20).map(|k| (k % 200) as u8).collect()].concat(),
            ),
            28,
        ),
    ]
}

/// Nodes, each the only child of the one before.
fn chain() -> Vec<u8> {
    let count = 300_000;
    let nodes: String = (1..count).map(|child| format!("{{\"children\":[{child}]}},")).collect();
    format!("{{\"asset\":{{\"version\":\"2.0\"}},\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{nodes}{{}}]}}").into_bytes()
}

#[test]
fn memory_is_in_proportion_to_the_file() {
    // The shortest statements that give the most data, 8 MB of each.
    let repeated = |head: &str, line: &str| head.to_owned() + &line.repeat((8 << 20) / line.len());
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
    // On a parabola, so that they are the corners of a convex polygon.
    let nine: String = (0..9).map(|i| format!("v {i} {} 0\n", i * i)).collect();
    let files = [
        ("a header of 10^12 vertices", MeshFormat::Off, "OFF\n1000000000000 1 0\n0 0 0\n".to_owned()),
        ("a header of 10^12 faces", MeshFormat::Off, "OFF\n1 1000000000000 0\n0 0 0\n3 0 0 0\n".to_owned()),
        ("a face of 10^12 corners", MeshFormat::Off, "OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n1000000000000 0 1 2\n".to_owned()),
        ("OBJ vertices", MeshFormat::Obj, repeated(square, "v 0 0 0\n") + "f 1 2 3\n"),
        ("OBJ vertices with colours", MeshFormat::Obj, repeated(square, "v 0 0 0 1 1 1\n") + "f 1 2 3\n"),
        ("OBJ vertices and a colour", MeshFormat::Obj, repeated(square, "v 0 0 0\n") + "v 0 0 0 .1 1 1\nf 1 2 3\n"),
        ("OBJ texture coordinates", MeshFormat::Obj, repeated(square, "vt 0\n") + "f 1/1 2/1 3/1\n"),
        ("OBJ normals", MeshFormat::Obj, repeated(square, "vn 0 0 1\n") + "f 1//1 2//1 3//1\n"),
        ("OBJ triangles", MeshFormat::Obj, repeated(square, "f 1 2 3\n")),
        ("OBJ triangles with all", MeshFormat::Obj, repeated(square, "f 1/1/1 2/1/1 3/1/1\n")),
        (
            "OBJ triangles with holes in attributes",
            MeshFormat::Obj,
            repeated(square, "f 1 2 3\n") + "f 1/1/1 2/1/1 3/1/1\n",
        ),
        ("OBJ triangles counted back", MeshFormat::Obj, repeated(square, "f -1 -2 -3\n")),
        ("OBJ polygons", MeshFormat::Obj, repeated(&nine, "f 1 2 3 4 5 6 7 8 9\n")),
        ("OBJ groups", MeshFormat::Obj, repeated(square, "usemtl a\n") + "f 1 2 3\n"),
        ("OBJ objects", MeshFormat::Obj, repeated(square, "o a\no b\n") + "f 1 2 3\n"),
        ("OBJ names of groups", MeshFormat::Obj, repeated(square, "g b c a\ng c\n") + "f 1 2 3\n"),
        ("OBJ other groups", MeshFormat::Obj, repeated(square, "g b b b b b b b\n") + "f 1 2 3\n"),
        ("OBJ triangles in and out of a part", MeshFormat::Obj, repeated(square, "o a\nf 1 2 3\no b\nf 1 2 3\n")),
        ("OBJ oddities", MeshFormat::Obj, repeated(square, "x\ny\n") + "f 1 2 3\n"),
    ];
    let files = files.map(|(what, format, text)| (what, format, text.into_bytes(), 9));
    for (what, format, text, times) in files.into_iter().chain(ply_files()).chain(stl_files()).chain(gltf_files()) {
        let peak = peak_of(|| {
            let _ = parse_as(&text, format, Path::new("none/m"), Wanted { colors: true, part: None });
        });
        let of_part = peak_of(|| {
            let _ = parse_as(&text, format, Path::new("none/m"), Wanted { colors: true, part: Some("a") });
        });
        let peak = peak.max(of_part);
        println!("{what}: {:.1} times {} bytes", peak as f64 / text.len() as f64, text.len());
        // The text itself is the tenth.
        assert!(peak <= times * text.len() + (1 << 20), "{what}: {peak} bytes for {}", text.len());
    }
}
