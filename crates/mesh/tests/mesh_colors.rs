//! Colours of vertices, by format: which are read, what they mean, what is odd about them.

use base64::Engine;
use std::path::Path;
use tracer_mesh::{ColorValues, Files, MeshData, MeshError, MeshFormat, VertexColors, Wanted, parse, parse_as};

const COLORS: Wanted<'static> = Wanted { colors: true, part: None };

fn read(format: MeshFormat, bytes: impl AsRef<[u8]>) -> Result<MeshData, MeshError> {
    parse_as(bytes.as_ref(), format, Path::new("m"), COLORS)
}

fn mesh(format: MeshFormat, bytes: impl AsRef<[u8]>) -> MeshData {
    read(format, bytes).unwrap_or_else(|error| panic!("{error}"))
}

fn bytes(colors: &[[u8; 3]], is_srgb: bool) -> Option<VertexColors> {
    let pack = |&[r, g, b]: &[u8; 3]| u32::from_le_bytes([r, g, b, 0]);
    Some(VertexColors { values: ColorValues::Bytes(colors.iter().map(pack).collect()), is_srgb })
}

fn numbers(colors: &[[f32; 3]], is_srgb: bool) -> Option<VertexColors> {
    Some(VertexColors { values: ColorValues::Numbers(colors.to_vec()), is_srgb })
}

fn told(mesh: &MeshData) -> Vec<&str> {
    mesh.warnings.iter().map(|warning| warning.message.as_str()).collect()
}

#[test]
fn obj_has_them_behind_coordinates_and_weights() {
    let text = "v 0 0 0 0.1 0.25 1\nv 1 0 0 1 0 0.5 0.75\nv 0 1 0 0.2 0.3 0.4\nf 1 2 3\n";
    let read = mesh(MeshFormat::Obj, text);
    assert_eq!(read.colors, numbers(&[[0.1, 0.25, 1.0], [0.0, 0.5, 0.75], [0.2, 0.3, 0.4]], true));
    assert_eq!(told(&read), Vec::<&str>::new());
    // MeshLab writes bytes with six digits.
    let text = "v 0 0 0 0.392157 0.003922 1\nv 1 0 0 0 0.498039 0.501961\nv 0 1 0 0.996078 0 0\nf 1 2 3\n";
    assert_eq!(mesh(MeshFormat::Obj, text).colors, bytes(&[[100, 1, 255], [0, 127, 128], [254, 0, 0]], true));
}

/// Corners that share a position share its colour, whatever texture coordinates and normals they have.
#[test]
fn obj_colours_belong_to_positions() {
    let text = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 1 1 0 1 1 0\nvt 0 0\nvt 1 0\nvn 0 0 1\nvn 0 1 1\n\
                f 1/1/1 2/2/1 3/1/2\nf 2/1/2 4/2/1 3/2/2\nf -1//-1 -2//-2 -3//-1\n";
    let read = mesh(MeshFormat::Obj, text);
    assert_eq!(read.positions.len(), 4);
    assert_eq!(read.colors, bytes(&[[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]], true));
}

#[test]
fn vertices_without_are_white_and_what_is_beyond_is_clipped() {
    let read = mesh(MeshFormat::Obj, "v 0 0 0\nv 1 0 0 2 -1 0.5\nv 0 1 0\nv 1 1 0 0 0 0\nf 1 2 3\n");
    assert_eq!(read.colors, numbers(&[[1.0; 3], [1.0, 0.0, 0.5], [1.0; 3], [0.0; 3]], true));
    let message = "the mesh has oddities: 2 vertices without a colour (white); 1 vertex colour beyond 0 to 1 (clipped)";
    assert_eq!(told(&read), [message]);
}

#[test]
fn off_has_them_of_both_scales() {
    let off = |keyword: &str, colors: [&str; 3]| {
        let [a, b, c] = colors;
        format!("{keyword}\n3 1 0\n0 0 0 {a}\n1 0 0 {b}\n0 1 0 {c}\n3 0 1 2\n")
    };
    let of_255 = bytes(&[[255, 0, 7], [1, 2, 3], [0, 0, 0]], true);
    for keyword in ["OFF", "COFF"] {
        assert_eq!(mesh(MeshFormat::Off, off(keyword, ["255 0 7 255", "1 2 3 255", "0 0 0 0"])).colors, of_255);
        assert_eq!(mesh(MeshFormat::Off, off(keyword, ["255 0 7", "1 2 3", "0 0 0"])).colors, of_255);
        let of_one = mesh(MeshFormat::Off, off(keyword, ["0.1 0.2 0.3", "1 1 1", "0 0.5 1"]));
        assert_eq!(of_one.colors, numbers(&[[0.1, 0.2, 0.3], [1.0; 3], [0.0, 0.5, 1.0]], true));
        assert!(told(&of_one).is_empty());
    }
    // Between normals and texture coordinates.
    let all =
        "STCNOFF 3 1 0\n0 0 0 0 0 1 255 0 0 9 0.25 1\n1 0 0 0 0 1 0 255 0 9 1 1\n0 1 0 0 0 1 1 2 3 9 0.5 0\n3 0 1 2\n";
    let read = mesh(MeshFormat::Off, all);
    assert_eq!(read.colors, bytes(&[[255, 0, 0], [0, 255, 0], [1, 2, 3]], true));
    assert_eq!((read.uvs[0], read.normals[0]), ([0.25, 1.0], [0.0, 0.0, 1.0]));
    // Of faces they are passed over.
    let faces = mesh(MeshFormat::Off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n");
    assert_eq!(faces.colors, None);
    assert_eq!(told(&faces), ["the mesh has oddities: 1 face colour (ignored)"]);
}

fn ply(properties: &str, values: [&str; 3]) -> String {
    let [a, b, c] = values;
    format!(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n{properties}\
         element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 {a}\n1 0 0 {b}\n0 1 0 {c}\n3 0 1 2\n"
    )
}

fn of(kind: &str, names: [&str; 3]) -> String {
    names.iter().map(|name| format!("property {kind} {name}\n")).collect()
}

#[test]
fn ply_has_them_by_three_names_of_each_type() {
    let three = ["255 0 7", "1 2 3", "0 0 0"];
    for names in [["red", "green", "blue"], ["diffuse_red", "diffuse_green", "diffuse_blue"], ["r", "g", "b"]] {
        let read = mesh(MeshFormat::Ply, ply(&of("uchar", names), three));
        assert_eq!(read.colors, bytes(&[[255, 0, 7], [1, 2, 3], [0, 0, 0]], true), "{names:?}");
        assert!(told(&read).is_empty());
    }
    let names = ["red", "green", "blue"];
    for kind in ["int", "short"] {
        let read = mesh(MeshFormat::Ply, ply(&of(kind, names), three));
        assert_eq!(read.colors, bytes(&[[255, 0, 7], [1, 2, 3], [0, 0, 0]], true), "{kind}");
    }
    let deep = mesh(MeshFormat::Ply, ply(&of("ushort", names), ["65535 0 1000", "0 0 0", "0 257 514"]));
    assert_eq!(deep.colors, numbers(&[[1.0, 0.0, 1000.0 / 65535.0], [0.0; 3], [0.0, 1.0 / 255.0, 2.0 / 255.0]], true));
    // Floats are linear.
    for kind in ["float", "double"] {
        let read = mesh(MeshFormat::Ply, ply(&of(kind, names), ["0.1 0.2 0.3", "1 0.5 0", "0.7 0 1"]));
        assert_eq!(read.colors, numbers(&[[0.1, 0.2, 0.3], [1.0, 0.5, 0.0], [0.7, 0.0, 1.0]], false), "{kind}");
    }
    // Alpha, and whatever stands between, is passed over.
    let mixed = "property uchar alpha\nproperty uchar blue\nproperty float quality\nproperty uchar red\nproperty uchar \
                 green\n";
    let read = mesh(MeshFormat::Ply, ply(mixed, ["9 7 0.5 255 0", "9 3 0.5 1 2", "9 0 0.5 0 0"]));
    assert_eq!(read.colors, bytes(&[[255, 0, 7], [1, 2, 3], [0, 0, 0]], true));
    // Two of three are none.
    assert_eq!(mesh(MeshFormat::Ply, ply("property uchar red\nproperty uchar green\n", ["1 2"; 3])).colors, None);
}

#[test]
fn binary_ply_is_the_same() {
    let head = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty \
                uchar green\nproperty uchar blue\nproperty uchar alpha\nelement face 1\nproperty list uchar int \
                vertex_indices\nend_header\n";
    let vertex = |p: [f32; 3], color: [u8; 3], big: bool| {
        let number = |x: f32| if big { x.to_be_bytes() } else { x.to_le_bytes() };
        let place: Vec<u8> = p.into_iter().flat_map(number).collect();
        [&place[..], &color, &[9]].concat()
    };
    for big in [false, true] {
        let index = |k: u32| if big { k.to_be_bytes() } else { k.to_le_bytes() };
        let order = if big { "big" } else { "little" };
        let file = [
            format!("ply\nformat binary_{order}_endian 1.0\n{head}").as_bytes(),
            &vertex([0.0; 3], [255, 0, 7], big),
            &vertex([1.0, 0.0, 0.0], [1, 2, 3], big),
            &vertex([0.0, 1.0, 0.0], [0, 128, 0], big),
            &[3],
            &[index(0), index(1), index(2)].concat(),
        ]
        .concat();
        assert_eq!(mesh(MeshFormat::Ply, file).colors, bytes(&[[255, 0, 7], [1, 2, 3], [0, 128, 0]], true));
    }
}

/// A primitive for each set of colours: three vertices, and `COLOR_0` of this component and type.
fn gltf(colors: &[Option<(u32, &str, &[u8])>]) -> String {
    let places: Vec<u8> =
        [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let mut binary = places.clone();
    let (mut views, mut accessors, mut primitives) = (Vec::new(), Vec::new(), Vec::new());
    views.push(format!(r#"{{"buffer": 0, "byteLength": {}}}"#, places.len()));
    accessors.push(r#"{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}"#.to_owned());
    for color in colors {
        let Some((component, kind, values)) = color else {
            primitives.push(r#"{"attributes": {"POSITION": 0}}"#.to_owned());
            continue;
        };
        let number = accessors.len();
        views.push(format!(r#"{{"buffer": 0, "byteOffset": {}, "byteLength": {}}}"#, binary.len(), values.len()));
        let normalized = *component != 5126;
        accessors.push(format!(
            r#"{{"bufferView": {number}, "componentType": {component}, "type": "{kind}", "count": 3,
                "normalized": {normalized}}}"#
        ));
        binary.extend(*values);
        primitives.push(format!(r#"{{"attributes": {{"POSITION": 0, "COLOR_0": {number}}}}}"#));
    }
    let data = base64::engine::general_purpose::STANDARD.encode(&binary);
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "meshes": [{{"primitives": [{}]}}], "accessors": [{}], "bufferViews": [{}],
            "buffers": [{{"byteLength": {}, "uri": "data:application/octet-stream;base64,{data}"}}]}}"#,
        primitives.join(", "),
        accessors.join(", "),
        views.join(", "),
        binary.len()
    )
}

fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

#[test]
fn gltf_has_them_of_every_type_and_linear() {
    let (three, four) =
        ([[255, 0, 7], [1, 2, 3], [0, 0, 0]], [[255, 0, 7, 9], [1, 2, 3, 9], [0, 0, 0, 9]].as_flattened().to_vec());
    let read = |colors: (u32, &str, &[u8])| mesh(MeshFormat::Gltf, gltf(&[Some(colors)])).colors;
    assert_eq!(read((5121, "VEC3", three.as_flattened())), bytes(&three, false));
    assert_eq!(read((5121, "VEC4", &four)), bytes(&three, false));
    let shorts: Vec<u8> = [65535_u16, 0, 1000, 0, 0, 0, 0, 257, 514].iter().flat_map(|x| x.to_le_bytes()).collect();
    let deep = numbers(&[[1.0, 0.0, 1000.0 / 65535.0], [0.0; 3], [0.0, 1.0 / 255.0, 2.0 / 255.0]], false);
    assert_eq!(read((5123, "VEC3", &shorts)), deep);
    let light = [0.1, 0.2, 0.3, 1.0, 0.5, 0.0, 0.7, 0.0, 1.0];
    let expected = numbers(&[[0.1, 0.2, 0.3], [1.0, 0.5, 0.0], [0.7, 0.0, 1.0]], false);
    assert_eq!(read((5126, "VEC3", &floats(&light))), expected);
    let with_alpha = [0.1, 0.2, 0.3, 0.9, 1.0, 0.5, 0.0, 0.9, 0.7, 0.0, 1.0, 0.9];
    assert_eq!(read((5126, "VEC4", &floats(&with_alpha))), expected);
}

/// Primitives that share positions have vertices of their own where they have other colours.
#[test]
fn primitives_of_gltf_have_their_own() {
    let (red, none, grey) = ([255, 0, 0].repeat(3), None, floats(&[0.25; 9]));
    let read = mesh(MeshFormat::Gltf, gltf(&[Some((5121, "VEC3", &red)), none, Some((5126, "VEC3", &grey))]));
    let expected = [[[1.0, 0.0, 0.0]; 3], [[1.0; 3]; 3], [[0.25; 3]; 3]].concat();
    assert_eq!(read.colors, numbers(&expected, false));
    assert_eq!(told(&read), ["the mesh has oddities: 3 vertices without a colour (white)"]);
    let wrong = read_wrong(&gltf(&[Some((5121, "VEC2", &red))]));
    assert!(wrong.contains("accessors[1] (COLOR_0) is `VEC2`"), "{wrong}");
    let few = gltf(&[Some((5121, "VEC3", &red))]).replacen(
        r#""VEC3", "count": 3,
"#,
        "\"VEC3\", \"count\": 2,\n",
        1,
    );
    let few = read_wrong(&few);
    assert!(few.contains("accessors[1] (COLOR_0) has 2 elements, but accessors[0] (POSITION) has 3"), "{few}");
}

fn read_wrong(text: &str) -> String {
    read(MeshFormat::Gltf, text).expect_err("a fault").to_string()
}

/// Bits that VisCAM, SolidView and Magics hide in the attributes of binary files are passed over.
#[test]
fn stl_has_none() {
    let mut file = [&b"COLOR=\xff\0\0\xff"[..], &[0; 70], &1_u32.to_le_bytes(), &[0; 12]].concat();
    file.extend([0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|x| x.to_le_bytes()));
    file.extend(0x8123_u16.to_le_bytes());
    assert_eq!(mesh(MeshFormat::Stl, file).colors, None);
}

/// A mesh whose colours nobody wants has none, and its warning counts them, as ever.
#[test]
fn what_nobody_wants_is_not_kept() {
    let obj = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n".to_owned();
    let off = "COFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n".to_owned();
    let ply = ply(&of("uchar", ["red", "green", "blue"]), ["255 0 0", "0 255 0", "0 0 255"]);
    let gltf = gltf(&[Some((5121, "VEC3", &[9; 9]))]);
    for (format, text) in
        [(MeshFormat::Obj, obj), (MeshFormat::Off, off), (MeshFormat::Ply, ply), (MeshFormat::Gltf, gltf)]
    {
        let without = parse(text.as_bytes(), format, Path::new("m")).expect("a mesh");
        assert_eq!(without.colors, None);
        assert_eq!(told(&without), ["the mesh has oddities: 3 vertex colours (ignored)"], "{format:?}");
        let with = mesh(format, text);
        assert!(with.colors.is_some() && told(&with).is_empty(), "{format:?}");
        assert_eq!((with.positions, with.triangles), (without.positions, without.triangles));
    }
}

#[test]
fn files_in_memory_have_them_too() {
    let mut files = Files::default();
    files.insert("a.obj", *b"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
    let read = tracer_mesh::load_as(Path::new("a.obj"), &files, COLORS).expect("a mesh");
    assert_eq!(read.colors, bytes(&[[255, 0, 0], [0, 255, 0], [0, 0, 255]], true));
}
