//! Parts of mesh files: the mesh of a part is that of a file with nothing else in it.

use scene_format::diagnostic::Span;
use std::path::Path;
use tracer_mesh::{MeshData, MeshError, MeshFormat, Wanted, parse, parse_as};

fn part(text: &str, name: &str) -> Result<MeshData, MeshError> {
    let wanted = Wanted { colors: true, part: Some(name) };
    parse_as(text.as_bytes(), MeshFormat::Obj, Path::new("m.obj"), wanted)
}

fn told(result: Result<MeshData, MeshError>) -> String {
    let fault = result.expect_err("it is told").to_diagnostic(Span::NONE);
    format!("{}: {} | {} | {}", fault.code, fault.message, fault.expected, fault.hint)
}

/// Two objects with coordinates, normals, colours and materials of their own; the second comes twice.
const CAR: &str = "mtllib none.mtl\nv -9 -9 -9 0.2 0.3 0.4\n\
    o body\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n\
    usemtl paint\nf 2/1/1 3/2/1 4/3/1\nf 2 4 5\n\
    o wheel\nv 5 0 0 0.5 0 0\nv 6 0 0 0.25 0 0\nv 5 1 0 1 0 0\nvt 0.5 0.5\nvn 1 0 0\n\
    usemtl rubber\nf -3/-1 -2/-1 -1/-1\n\
    o roof\nf 2//1 3//1 5//1\n\
    o wheel\nv 7 0 0 0.125 0 0\nf -1 -2 -3\n";

#[test]
fn a_part_is_what_a_file_of_it_alone_would_be() {
    let alone = "mtllib none.mtl\nv 5 0 0 0.5 0 0\nv 6 0 0 0.25 0 0\nv 5 1 0 1 0 0\nvt 0.5 0.5\nusemtl rubber\n\
        f -3/-1 -2/-1 -1/-1\nv 7 0 0 0.125 0 0\nf -1 -2 -3\n";
    let wanted = Wanted { colors: true, part: None };
    let alone = parse_as(alone.as_bytes(), MeshFormat::Obj, Path::new("m.obj"), wanted).expect("a mesh");
    let wheel = part(CAR, "wheel").expect("a mesh");
    assert_eq!(wheel, alone);
    assert_eq!((wheel.positions.len(), wheel.triangles.len(), wheel.uvs.len(), wheel.normals.len()), (4, 2, 1, 0));
    // That there are no colours is of the part, too.
    let roof = part(CAR, "roof").expect("a mesh");
    assert!(roof.colors.is_none() && roof.uvs.is_empty() && roof.material_names.used == [("rubber".to_owned(), false)]);
    assert_eq!(roof.normals, [[0.0, 0.0, 1.0]]);
    // All there is, in parts.
    let whole = parse(CAR.as_bytes(), MeshFormat::Obj, Path::new("m.obj")).expect("a mesh");
    let counts = ["body", "wheel", "roof"].map(|name| part(CAR, name).expect("a mesh").triangles.len());
    assert_eq!(counts.iter().sum::<usize>(), whole.triangles.len());
}

#[test]
fn groups_are_several_and_stay_until_the_next() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\ng left top\nf 1 2 4\no thing\nf 1 3 4\ng top # or bottom\n\
        f 2 3 4\ng\nf 4 3 2\no My Thing\nf 3 2 1\n";
    let triangles = |name: &str| part(text, name).expect("a mesh").triangles.len();
    assert_eq!(["left", "top", "left top", "thing", "My Thing"].map(triangles), [2, 3, 2, 3, 1]);
    assert_eq!(
        told(part(text, "My Thin")),
        "E0514: m.obj: there is no part `My Thin` | one of its objects and groups: `left`, `top`, `thing`, `My Thing` \
         | did you mean `My Thing`?"
    );
    // Case counts.
    assert!(told(part(text, "LEFT")).ends_with("did you mean `left`?"));
}

#[test]
fn what_is_no_part_is_told() {
    let plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    assert_eq!(
        told(part(plain, "a")),
        "E0514: m.obj: there is no part `a` | a file with names of objects and groups, which this one has none of, or \
         no `part` | "
    );
    let many: String = (0..30).map(|k| format!("o part{k}\nf 1 2 3\n")).collect();
    let many = told(part(&format!("{plain}{many}"), "x"));
    assert!(many.contains("`part0`, `part1`, ") && many.contains("`part11`, .. (30 in all)"), "{many}");
    assert_eq!(
        told(part(&format!("{plain}o empty\no full\nf 1 2 3\n"), "empty")),
        "E0511: m.obj: the mesh has no triangles | at least one triangle with an area | the part `empty` has no faces \
         (`f`)"
    );
    // Bad indices of the part's faces are told where they stand; those of other parts are not looked at.
    let bad = format!("{plain}o a\nf 1 2 9\no b\nf 1 2 3\nf 1 8 2\n");
    assert!(part(&bad, "b").expect_err("it is told").to_string().starts_with("m.obj:9: the corner `8` names a vertex"));
    assert!(told(part("o a\nf 1 2 x\n", "b")).contains("`x` is no corner of a face"));
    // Names that are no text, very long, or behind a byte that ends nothing.
    let odd =
        [b"o \xff\xfe\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng ".as_slice(), &[b'a'; 5000], b" b\nf 3 2 1\n"].concat();
    let wanted = |name| Wanted { colors: false, part: Some(name) };
    let of = |name| parse_as(&odd, MeshFormat::Obj, Path::new("m.obj"), wanted(name));
    assert_eq!(of("b").expect("a mesh").triangles.len(), 1);
    assert!(told(of("c")).len() < 1000);
    for format in [MeshFormat::Off, MeshFormat::Ply, MeshFormat::Stl] {
        let fault = told(parse_as(b"", format, Path::new("m"), wanted("a")));
        let name = format.name();
        assert_eq!(fault, format!("E0514: m: {name} files have no parts | an OBJ, glTF or GLB file, or no `part` | "));
    }
}

/// Two meshes on four nodes, one in another, one beside the scene.
const GLTF: &str = r#"{
    "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0, 2] }],
    "nodes": [
        { "name": "table", "mesh": 0, "translation": [1, 0, 0], "children": [1] },
        { "name": "lamp", "mesh": 1, "translation": [0, 2, 0] },
        { "name": "other", "mesh": 1 },
        { "name": "hidden", "mesh": 0 }
    ],
    "meshes": [
        { "name": "top", "primitives": [{ "attributes": { "POSITION": 0 } }] },
        { "name": "bulb", "primitives": [{ "attributes": { "POSITION": 0 } }] }
    ],
    "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
    "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
    "buffers": [{ "byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" }]
}"#;

#[test]
fn nodes_and_meshes_of_gltf() {
    let part = |name| {
        let wanted = Wanted { colors: false, part: Some(name) };
        parse_as(GLTF.as_bytes(), MeshFormat::Gltf, Path::new("m.gltf"), wanted)
    };
    let firsts = |name| -> Vec<[f64; 3]> { part(name).expect("a mesh").positions.into_iter().step_by(3).collect() };
    let (table, lamp, other) = ([1.0, 0.0, 0.0], [1.0, 2.0, 0.0], [0.0; 3]);
    assert_eq!(firsts("table"), [table, lamp]);
    assert_eq!(firsts("lamp"), [lamp]);
    assert_eq!(firsts("other"), [other]);
    assert_eq!(firsts("top"), [table]);
    assert_eq!(firsts("bulb"), [lamp, other]);
    assert_eq!(
        told(part("hidden")),
        "E0514: m.gltf: there is no part `hidden` | one of its nodes and meshes: `table`, `top`, `lamp`, `bulb`, \
         `other` | "
    );
    assert!(told(part("tabel")).ends_with("did you mean `table`?"));
}
