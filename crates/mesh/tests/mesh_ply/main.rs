//! PLY files: all encodings, types and ways to write a mesh, what is passed over; `faults` has the text of errors.

mod faults;

use std::path::Path;
use tracer_mesh::{MeshData, MeshError, MeshFormat, NO_INDEX, parse};

fn parse_ply(file: &[u8]) -> Result<MeshData, MeshError> {
    parse(file, MeshFormat::Ply, Path::new("m.ply"))
}

fn read(file: impl AsRef<[u8]>) -> MeshData {
    parse_ply(file.as_ref()).unwrap_or_else(|error| panic!("{error}\n{}", String::from_utf8_lossy(file.as_ref())))
}

fn warnings(mesh: &MeshData) -> Vec<String> {
    mesh.warnings.iter().map(|warning| format!("{} {}", warning.code, warning.message)).collect()
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Encoding {
    Ascii,
    Little,
    Big,
}

const ENCODINGS: [Encoding; 3] = [Encoding::Ascii, Encoding::Little, Encoding::Big];

/// A number as a file of this encoding has it.
fn number(encoding: Encoding, kind: &str, value: f64) -> Vec<u8> {
    if encoding == Encoding::Ascii {
        return format!("{value} ").into_bytes();
    }
    let mut bytes = match kind {
        "char" | "int8" => (value as i8).to_le_bytes().to_vec(),
        "uchar" | "uint8" => (value as u8).to_le_bytes().to_vec(),
        "short" | "int16" => (value as i16).to_le_bytes().to_vec(),
        "ushort" | "uint16" => (value as u16).to_le_bytes().to_vec(),
        "int" | "int32" => (value as i32).to_le_bytes().to_vec(),
        "uint" | "uint32" => (value as u32).to_le_bytes().to_vec(),
        "float" | "float32" => (value as f32).to_le_bytes().to_vec(),
        "double" | "float64" => value.to_le_bytes().to_vec(),
        _ => panic!("{kind}"),
    };
    if encoding == Encoding::Big {
        bytes.reverse();
    }
    bytes
}

/// An element: its name, its properties (`float x`, `list uchar int vertex_indices`), and for each item the values of
/// each property.
struct Element<'a> {
    name: &'a str,
    properties: &'a [&'a str],
    items: Vec<Vec<Vec<f64>>>,
}

fn ply(encoding: Encoding, elements: &[Element]) -> Vec<u8> {
    let name = match encoding {
        Encoding::Ascii => "ascii",
        Encoding::Little => "binary_little_endian",
        Encoding::Big => "binary_big_endian",
    };
    let mut header = format!("ply\nformat {name} 1.0\ncomment by hand\n");
    let mut data = Vec::new();
    for element in elements {
        header += &format!("element {} {}\n", element.name, element.items.len());
        element.properties.iter().for_each(|property| header += &format!("property {property}\n"));
        for item in &element.items {
            for (property, values) in element.properties.iter().zip(item) {
                let words: Vec<&str> = property.split(' ').collect();
                if words[0] == "list" {
                    data.extend(number(encoding, words[1], values.len() as f64));
                    values.iter().for_each(|&value| data.extend(number(encoding, words[2], value)));
                } else {
                    data.extend(number(encoding, words[0], values[0]));
                }
            }
            if encoding == Encoding::Ascii {
                data.push(b'\n');
            }
        }
    }
    header += "end_header\n";
    [header.into_bytes(), data].concat()
}

const CUBE: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 2.0],
    [1.0, 0.0, 2.0],
    [1.0, 1.0, 2.0],
    [0.0, 1.0, 2.0],
];
const SIDES: [[u32; 4]; 6] = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

/// One value a property.
fn single(values: &[f64]) -> Vec<Vec<f64>> {
    values.iter().map(|&value| vec![value]).collect()
}

fn vertices() -> Vec<Vec<Vec<f64>>> {
    CUBE.iter().map(|place| single(place)).collect()
}

fn sides() -> Vec<Vec<Vec<f64>>> {
    SIDES.iter().map(|side| vec![side.map(f64::from).to_vec()]).collect()
}

fn obj_cube() -> MeshData {
    let mut text = String::new();
    CUBE.iter().for_each(|[x, y, z]| text += &format!("v {x} {y} {z}\n"));
    SIDES
        .iter()
        .for_each(|side| text += &format!("f {} {} {} {}\n", side[0] + 1, side[1] + 1, side[2] + 1, side[3] + 1));
    parse(text.as_bytes(), MeshFormat::Obj, Path::new("m.obj")).expect("a cube")
}

#[test]
fn a_cube_is_the_same_in_every_encoding_and_type() {
    let expected = obj_cube();
    let integers =
        ["char", "int8", "uchar", "uint8", "short", "int16", "ushort", "uint16", "int", "int32", "uint", "uint32"];
    for encoding in ENCODINGS {
        for kind in integers.into_iter().chain(["float", "float32", "double", "float64"]) {
            let places = ["x", "y", "z"].map(|axis| format!("{kind} {axis}"));
            let properties = places.each_ref().map(String::as_str);
            for (number, count) in integers.into_iter().enumerate() {
                let item = integers[(number + 5) % integers.len()];
                let list = format!("list {count} {item} {}", ["vertex_indices", "vertex_index"][number % 2]);
                let file = ply(
                    encoding,
                    &[
                        Element { name: "vertex", properties: &properties, items: vertices() },
                        Element { name: "face", properties: &[&list], items: sides() },
                    ],
                );
                assert_eq!(read(file), expected, "{encoding:?} {kind} {list}");
            }
        }
    }
}

#[test]
fn what_is_not_needed_is_stepped_over() {
    let mut expected = obj_cube();
    expected.normals = vec![[0.0, 0.6, 0.8]; 8];
    expected.uvs = (0..8_u16).map(|k| [f32::from(k), -f32::from(k)]).collect();
    let vertex = |number: usize| {
        let [x, y, z] = CUBE[number].map(|place| vec![place]);
        let (u, normal) = (number as f64, [vec![3.0], vec![4.0], vec![0.0]]);
        let [ny, nz, nx] = normal;
        vec![vec![-u], vec![7.0; number], z, nz, vec![9.0], y, ny, vec![], x, nx, vec![u], vec![0.5], vec![1.0, 2.0]]
    };
    let properties = [
        "double t",
        "list uchar short neighbours",
        "float z",
        "short nz",
        "char flag",
        "double y",
        "int ny",
        "list int double none",
        "ushort x",
        "float nx",
        "short s",
        "float confidence",
        "list uint double more",
    ];
    let edges = (0..5).map(|k| vec![vec![f64::from(k)], vec![1.0; k as usize]]).collect::<Vec<_>>();
    for encoding in ENCODINGS {
        let face = |side: &[u32; 4]| vec![vec![0.25; 3], vec![5.0], side.map(f64::from).to_vec(), vec![6.0]];
        let file = ply(
            encoding,
            &[
                Element { name: "camera", properties: &["float view", "list uchar uchar name"], items: edges.clone() },
                Element { name: "nothing", properties: &[], items: vec![vec![]; 3] },
                Element { name: "vertex", properties: &properties, items: (0..8).map(vertex).collect() },
                Element { name: "edge", properties: &["int first", "list char float all"], items: edges.clone() },
                Element {
                    name: "face",
                    properties: &["list uchar float x", "int flags", "list uchar uint vertex_indices", "double area"],
                    items: SIDES.iter().map(face).collect(),
                },
                Element { name: "material", properties: &["int a", "list uchar int b"], items: edges.clone() },
            ],
        );
        assert_eq!(read(&file), expected, "{encoding:?}");
    }
}

#[test]
fn elements_come_in_any_order() {
    for encoding in ENCODINGS {
        let properties = ["double x", "double y", "double z"];
        let file = ply(
            encoding,
            &[
                Element { name: "face", properties: &["list uchar int vertex_indices"], items: sides() },
                Element { name: "edge", properties: &["int a"], items: vec![vec![vec![1.0]]; 3] },
                Element { name: "vertex", properties: &properties, items: vertices() },
                Element { name: "edge", properties: &["int a"], items: vec![vec![vec![1.0]]; 3] },
            ],
        );
        assert_eq!(read(file), obj_cube(), "{encoding:?}");
    }
}

/// A text of three vertices and a triangle, its vertices with these properties.
fn ascii(properties: &str, vertices: [&str; 3], rest: &str) -> String {
    let properties: String = properties.split(' ').map(|name| format!("property float {name}\n")).collect();
    let vertices = vertices.map(|line| format!("{line}\n")).concat();
    format!(
        "ply\nformat ascii 1.0\nelement vertex 3\n{properties}element face 1\nproperty list uchar int vertex_indices\n\
         end_header\n{vertices}{rest}"
    )
}

#[test]
fn headers_may_have_comments_blank_lines_and_other_line_ends() {
    let plain = ascii("x y z", ["0 0 0", "1 0 0", "0 1 0"], "3 0 1 2\n");
    let expected = read(&plain);
    assert_eq!(expected.triangles, [[0, 1, 2]]);
    assert!(expected.warnings.is_empty());
    for text in [
        plain.replace('\n', "\r\n"),
        plain.replace("element", "comment of \u{e4} # property int q\nobj_info\n\nelement"),
        plain.replace("ply\n", "ply \ncomment made by hand\n"),
        plain.replace(' ', " \t "),
        plain.replace("0 0 0\n", "\n0 0 0  \n\n"),
        format!("\u{feff}{}", plain.trim_end()),
    ] {
        assert_eq!(read(&text), expected, "{text}");
    }
    // The data of a binary file starts right after the line's end, whatever it is.
    let binary = ply(
        Encoding::Little,
        &[
            Element { name: "vertex", properties: &["char x", "char y", "char z"], items: vertices() },
            Element { name: "face", properties: &["list char char vertex_index"], items: sides() },
        ],
    );
    let end = binary.windows(11).position(|bytes| bytes == b"end_header\n").expect("an end") + 11;
    let header = String::from_utf8_lossy(&binary[..end]).replace('\n', "\r\n");
    assert_eq!(read([header.as_bytes(), &binary[end..]].concat()), obj_cube());
}

#[test]
fn normals_and_texture_coordinates_belong_to_vertices() {
    for [u, v] in [["u", "v"], ["s", "t"], ["texture_u", "texture_v"]] {
        let names = format!("x y z nx ny nz {u} {v}");
        let mesh = read(ascii(&names, ["0 0 0 0 0 2 0 0.5", "1 0 0 0 0 0 1 1", "0 1 0 3 0 4 2 -1"], "3 0 1 2\n"));
        assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [0.0; 3], [0.6, 0.0, 0.8]]);
        assert_eq!(mesh.normal_triangles, Some(vec![[0, NO_INDEX, 2]]));
        assert_eq!(mesh.uvs, [[0.0, 0.5], [1.0, 1.0], [2.0, -1.0]]);
        assert_eq!(mesh.uv_triangles, None);
        assert_eq!(warnings(&mesh), ["W0510 the mesh has oddities: 1 vertex normal of length zero (ignored)"]);
    }
    // Where no normal has a length there are none; what is not whole is not taken.
    let mesh = read(ascii("x y z nx ny nz s", ["0 0 0 0 0 0 1", "1 0 0 0 0 0 1", "0 1 0 0 0 0 1"], "3 0 1 2\n"));
    assert_eq!((mesh.normals, mesh.normal_triangles, mesh.uvs), (vec![], None, vec![]));
    let vertices = ["0 0 0 nan inf 1 2 x y", "1 0 0 ? ? 1 2 x y", "0 1 0 ? ? 1 2 x y"];
    let mesh = read(ascii("x y z nx ny u v s t", vertices, "3 0 1 2\n"));
    assert_eq!((mesh.normals, mesh.uvs), (vec![], vec![[1.0, 2.0]; 3]));
}

#[test]
fn polygons_are_cut_and_what_is_no_triangle_is_counted() {
    let places = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [2.0, 0.0, 0.0], [1.0, 3.0, 0.0], [2.0, 2.0, 0.0]];
    let faces: [&[f64]; 6] = [&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0], &[3.0], &[], &[0.0, 1.0, 4.0], &[0.0, 2.0, 2.0]];
    for encoding in ENCODINGS {
        let mut file = ply(
            encoding,
            &[
                Element {
                    name: "vertex",
                    properties: &["float x", "float y", "float z", "uchar red", "uchar green", "uchar blue"],
                    items: places.iter().map(|&[x, y, z]| single(&[x, y, z, 1.0, 2.0, 3.0])).collect(),
                },
                Element {
                    name: "face",
                    properties: &["list uchar int vertex_indices", "list uchar float texcoord"],
                    items: faces.iter().map(|face| vec![face.to_vec(), vec![0.0; 6]]).collect(),
                },
            ],
        );
        file.extend(b"rest\nof it\n");
        let mesh = read(file);
        // The second corner of the first face is a dent.
        assert_eq!(mesh.triangles, [[1, 2, 3], [1, 3, 0]]);
        let rest = if encoding == Encoding::Ascii { "2 lines" } else { "11 bytes" };
        assert_eq!(
            warnings(&mesh),
            [format!(
                "W0510 the mesh has oddities: 2 triangles without area (left out); \
                 3 faces of fewer than 3 corners (left out); 5 vertex colours (ignored); \
                 {rest} after the last face (ignored); 6 faces with texture coordinates of their own (ignored)"
            )]
        );
    }
}

#[test]
fn strips_of_triangles_are_unwound() {
    for encoding in ENCODINGS {
        let file = |indices: &[f64]| {
            let properties = ["float x", "float y", "float z"];
            let list = ["list int int vertex_indices"];
            let strips = vec![vec![indices.to_vec()]];
            ply(
                encoding,
                &[
                    Element { name: "vertex", properties: &properties, items: vertices() },
                    Element { name: "tristrips", properties: &list, items: strips },
                ],
            )
        };
        let mesh = read(file(&[0.0, 1.0, 3.0, 2.0, 6.0, -1.0, 4.0, 5.0, -1.0, -1.0, 4.0, 5.0, 7.0, 6.0]));
        assert_eq!(mesh.triangles, [[0, 1, 3], [3, 1, 2], [3, 2, 6], [4, 5, 7], [7, 5, 6]]);
        assert!(mesh.warnings.is_empty());
        // Repeated corners join two strips into one.
        let mesh = read(file(&[0.0, 1.0, 3.0, 2.0, 2.0, 4.0, 4.0, 5.0, 7.0, 6.0]));
        assert_eq!(mesh.triangles, [[0, 1, 3], [3, 1, 2], [4, 5, 7], [7, 5, 6]]);
        let [message, expected] = faults::error(file(&[0.0, 1.0, 2.0, -2.0]));
        assert!(message.ends_with("there is no vertex -2"), "{message}");
        assert_eq!(expected, "an index from 0 to 7, as there are 8 vertices");
    }
}
