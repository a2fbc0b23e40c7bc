//! STL files: ASCII and binary ones, which is which, joined corners, and the exact text of errors.

use std::path::Path;
use tracer_mesh::{MeshData, MeshError, MeshFormat, parse};

fn parse_stl(file: &[u8]) -> Result<MeshData, MeshError> {
    parse(file, MeshFormat::Stl, Path::new("m.stl"))
}

fn read(file: impl AsRef<[u8]>) -> MeshData {
    parse_stl(file.as_ref()).unwrap_or_else(|error| panic!("{error}\n{}", String::from_utf8_lossy(file.as_ref())))
}

/// The message, and what was expected.
fn error(file: impl AsRef<[u8]>) -> [String; 2] {
    match parse_stl(file.as_ref()) {
        Ok(mesh) => panic!("{mesh:?} of {}", String::from_utf8_lossy(file.as_ref())),
        Err(error) => {
            let expected = match &error {
                MeshError::Broken { expected, .. } => expected.clone(),
                MeshError::Empty { hint, .. } => hint.clone(),
                _ => String::new(),
            };
            [error.to_string(), expected]
        }
    }
}

fn warnings(mesh: &MeshData) -> Vec<String> {
    mesh.warnings.iter().map(|warning| format!("{} {}", warning.code, warning.message)).collect()
}

type Triangle = [[f32; 3]; 3];

fn binary(title: &str, triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = [title.as_bytes(), &[0; 80]].concat();
    bytes.truncate(80);
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        // A normal that nobody should take.
        bytes.extend([f32::NAN, 5.0, 7.0].map(f32::to_le_bytes).concat());
        bytes.extend(triangle.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([1, 2]);
    }
    bytes
}

fn ascii(name: &str, triangles: &[Triangle]) -> String {
    let mut text = format!("solid {name}\n");
    for triangle in triangles {
        text += "  facet normal nan 5 7\n    outer loop\n";
        triangle.iter().for_each(|[x, y, z]| text += &format!("      vertex {x:e} {y} {z}\n"));
        text += "    endloop\n  endfacet\n";
    }
    text + &format!("endsolid {name}\n")
}

/// A cube as triangles, and the same as an OBJ file whose vertices are in the order in which the triangles name them.
fn cube() -> (Vec<Triangle>, MeshData) {
    let corner = |k: u32| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { 1.5_f32 } else { -0.1 });
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let indices: Vec<[u32; 3]> = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mut order: Vec<u32> = Vec::new();
    indices.iter().flatten().for_each(|k| {
        if !order.contains(k) {
            order.push(*k);
        }
    });
    let mut obj = String::new();
    for &k in &order {
        let [x, y, z] = corner(k).map(f64::from);
        obj += &format!("v {x} {y} {z}\n");
    }
    for triangle in &indices {
        let [a, b, c] = triangle.map(|k| 1 + order.iter().position(|&o| o == k).expect("a corner"));
        obj += &format!("f {a} {b} {c}\n");
    }
    let mesh = parse(obj.as_bytes(), MeshFormat::Obj, Path::new("m.obj")).expect("a cube");
    (indices.iter().map(|triangle| triangle.map(corner)).collect(), mesh)
}

#[test]
fn a_cube_is_the_same_in_every_encoding() {
    let (triangles, expected) = cube();
    for file in [binary("made by hand", &triangles), binary("solid cube", &triangles), binary("", &triangles)] {
        assert_eq!(read(file), expected);
    }
    // Single precision as text is not the same number in double precision: -0.1 is rounded in the binary file.
    let rounded = |mesh: MeshData| MeshData {
        positions: mesh.positions.iter().map(|place| place.map(|x| f64::from(x as f32))).collect(),
        ..mesh
    };
    let text = ascii("cube", &triangles);
    for text in [
        text.clone(),
        text.replace('\n', "\r\n"),
        text.replace('\n', "\n\n \t\n"),
        text.to_uppercase().replace("E0", "e0"),
        format!("\u{feff} \n{text}"),
        text.replace("solid cube", "solid"),
        text.replace("solid cube", "solid two words # \u{e4}"),
        text.trim_end().to_owned(),
    ] {
        assert_eq!(rounded(read(&text)), expected, "{text}");
    }
    let halves = ascii("one", &triangles[..5]) + &ascii("two", &[]) + "\n" + &ascii("three", &triangles[5..]);
    assert_eq!(rounded(read(halves)), expected);
}

/// A binary file is one by its length, or by a zero among its first bytes.
#[test]
fn binary_files_may_start_with_solid() {
    let (triangles, _) = cube();
    let spaces = format!("solid{}", " ".repeat(75));
    assert_eq!(read(binary(&spaces, &triangles)).triangles.len(), 12);
    let mut longer = binary(&spaces, &triangles);
    longer.extend(b"rest");
    let mesh = read(longer);
    assert_eq!(mesh.triangles.len(), 12);
    assert_eq!(warnings(&mesh), ["W0510 the mesh has oddities: 4 bytes after the last face (ignored)"]);
}

#[test]
fn corners_are_one_vertex_where_all_their_bits_are_the_same() {
    let next = f32::from_bits(1.0_f32.to_bits() + 1);
    let triangles = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
        [[-0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [next, 0.0, 0.0]],
        [[1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [-0.0, 0.0, 0.0]],
    ];
    for file in [binary("", &triangles), ascii("", &triangles).into_bytes()] {
        let mesh = read(file);
        assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 3], [4, 2, 5], [3, 2, 4]]);
        assert_eq!(mesh.positions[4][0].to_bits(), (-0.0_f64).to_bits());
        assert!(mesh.normals.is_empty() && mesh.uvs.is_empty() && mesh.warnings.is_empty());
    }
}

#[test]
fn what_is_odd_is_counted() {
    let triangles = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
        [[3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [2.0, 5.0, 0.0]],
    ];
    let mesh = read(ascii("a", &triangles) + "rest\nof it\n");
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(
        warnings(&mesh),
        ["W0510 the mesh has oddities: 2 triangles without area (left out); 2 lines after the last face (ignored)"]
    );
    let mesh = read([binary("a", &triangles), vec![7]].concat());
    assert_eq!(
        warnings(&mesh),
        ["W0510 the mesh has oddities: 2 triangles without area (left out); 1 byte after the last face (ignored)"]
    );
}

#[test]
fn errors_in_text_say_the_line_and_what_was_expected() {
    const SOLID: &str = "`facet normal x y z` or `endsolid`";
    const CORNER: &str = "one of the three corners of a facet: `vertex x y z`";
    const LOOP: &str = "`outer loop`";
    const END: &str = "`endloop` after three corners";
    const GOOD: [&str; 8] = [
        "solid a",
        "facet normal 0 0 1",
        "outer loop",
        "vertex 0 0 0",
        "vertex 1 0 0",
        "vertex 0 1 0",
        "endloop",
        "endfacet",
    ];
    // The line that is put in place of another.
    for (line, text, message, expected) in [
        (2, "vertex 0 0 0", "`vertex` stands in a solid", SOLID),
        (2, "solid b", "`solid` stands in a solid", SOLID),
        (3, "vertex 0 0 0", "`vertex` stands in a facet", LOOP),
        (4, "endloop", "`endloop` stands in a facet", CORNER),
        (5, "endloop", "`endloop` stands in a facet", CORNER),
        (6, "endloop", "`endloop` stands in a facet", CORNER),
        (7, "vertex 1 1 0", "`vertex` stands in a facet", END),
        (7, "endloop 1", "`1` is too much", END),
        (8, "facet normal 0 0 1", "`facet` stands in a facet", "`endfacet`"),
        (4, "vertex 0 0", "a number is missing at the end of the line", CORNER),
        (4, "vertex", "a number is missing at the end of the line", CORNER),
        (5, "vertex 0 x 0", "`x` is not a number", CORNER),
        (5, "vertex 0 0,5 0", "`0,5` is not a number", CORNER),
        (6, "vertex 0 0 nan", "`nan` is not a finite number", CORNER),
        (6, "vertex 0 -inf 0", "`-inf` is not a finite number", CORNER),
        (6, "vertex 0 2e30 0", "the coordinate `2e30` is too large", "a magnitude of at most 1e30"),
        (6, "vertex 0 1 0 0", "`0` is too much", CORNER),
        (9, "endsolit", "`endsolit` stands in a solid", SOLID),
        (9, "", "the file ends within a solid", SOLID),
    ] {
        let mut lines: Vec<&str> = GOOD.into_iter().chain(["endsolid"]).collect();
        lines[line - 1] = text;
        let text = lines.join("\n");
        let line = if text.ends_with('\n') { 8 } else { line };
        assert_eq!(error(&text), [format!("m.stl:{line}: {message}"), expected.to_owned()], "{text}");
    }
    // Ends in the midst of a facet.
    for (lines, expected) in [(2, LOOP), (3, CORNER), (6, END), (7, "`endfacet`")] {
        let text = GOOD[..lines].join("\n");
        assert_eq!(error(text), [format!("m.stl:{lines}: the file ends within a solid"), expected.to_owned()]);
    }
}

#[test]
fn errors_in_bytes_say_the_byte_and_what_was_expected() {
    const STL: &str =
        "an STL file: `solid` and its facets, or 80 bytes, the number of triangles, and 50 bytes for each";
    let good = binary("a", &[[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]; 2]);
    let changed = |at: usize, bytes: &[u8]| {
        let mut file = good.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        file
    };
    for (file, byte, message, expected) in [
        (vec![], 0, "the file is empty", STL),
        (b"sol".to_vec(), 0, "the file starts with `sol`", STL),
        (b"<!DOCTYPE html>\n".repeat(20), 0, "the file starts with `<!DOCTYPE`", STL),
        (b"solidity\n".repeat(20), 0, "the file starts with `solidity`", STL),
        (b"OFF\n3 1 0\n".to_vec(), 0, "the file starts with `OFF`", STL),
        (good[..80].to_vec(), 80, "the file ends within its header", STL),
        (good[..83].to_vec(), 83, "the file ends within its header", STL),
        (
            good[..84].to_vec(),
            80,
            "the header promises 2 triangles, but the file is too short for them",
            "at most 0 triangles in the 0 bytes that follow",
        ),
        (
            good[..183].to_vec(),
            80,
            "the header promises 2 triangles, but the file is too short for them",
            "at most 1 triangles in the 99 bytes that follow",
        ),
        (
            changed(80, &[0xff; 4]),
            80,
            "the header promises 4294967295 triangles, but the file is too short for them",
            "at most 2 triangles in the 100 bytes that follow",
        ),
        (changed(96, &f32::NAN.to_le_bytes()), 96, "`NaN` is not a finite number", "finite coordinates"),
        (changed(128, &f32::INFINITY.to_le_bytes()), 128, "`inf` is not a finite number", "finite coordinates"),
        (changed(150, &f32::NEG_INFINITY.to_le_bytes()), 150, "`-inf` is not a finite number", "finite coordinates"),
        (
            changed(154, &f32::MAX.to_le_bytes()),
            154,
            "the coordinate `3.4028234663852886e38` is too large",
            "a magnitude of at most 1e30",
        ),
        (
            changed(178, &f32::MIN.to_le_bytes()),
            178,
            "the coordinate `-3.4028234663852886e38` is too large",
            "a magnitude of at most 1e30",
        ),
    ] {
        assert_eq!(error(file), [format!("m.stl: byte {byte}: {message}"), expected.to_owned()]);
    }
}

#[test]
fn files_without_triangles_say_what_they_have() {
    let flat = [[[0.0; 3]; 3]; 2];
    for (file, hint) in [
        (b"solid".to_vec(), None),
        (b"solid nothing\nendsolid\n".to_vec(), Some("the file has 0 facets")),
        (binary("", &[]), Some("the file has 0 facets")),
        (binary("", &flat), Some("the file has 2 facets: 2 triangles without area (left out)")),
        (ascii("", &flat).into_bytes(), Some("the file has 2 facets: 2 triangles without area (left out)")),
    ] {
        match hint {
            Some(hint) => assert_eq!(error(file), ["m.stl: the mesh has no triangles", hint]),
            None => assert_eq!(error(file)[0], "m.stl:1: the file ends within a solid"),
        }
    }
}

/// A truncated file is always an error, never a smaller mesh.
#[test]
fn truncated_files_are_errors() {
    let triangles = cube().0;
    let text = ascii("a", &triangles[..2]);
    let needed = text.find("endsolid").expect("an end") + 8;
    for end in 0..needed {
        assert!(matches!(parse_stl(&text.as_bytes()[..end]), Err(MeshError::Broken { .. })), "{end}");
    }
    for title in ["", "solid", &" ".repeat(80)] {
        let bytes = binary(title, &triangles[..3]);
        for end in 0..bytes.len() {
            assert!(matches!(parse_stl(&bytes[..end]), Err(MeshError::Broken { .. })), "{title} {end}");
        }
    }
}
