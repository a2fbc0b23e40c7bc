//! The exact text of errors, the line or the byte, and what was expected.

use super::{ENCODINGS, Element, Encoding, ascii, parse_ply, ply, read, sides, single, vertices};
use tracer_mesh::{MeshError, Place};

/// The message, and what was expected.
pub(super) fn error(file: impl AsRef<[u8]>) -> [String; 2] {
    match parse_ply(file.as_ref()) {
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

#[test]
fn errors_of_headers_say_the_line_and_what_was_expected() {
    const FILE: &str = "a PLY file: `ply`, its `format`, its elements with their properties, and `end_header`";
    const FORMAT: &str = "`format ascii 1.0`, `format binary_little_endian 1.0` or `format binary_big_endian 1.0`";
    const ELEMENT: &str = "an element: `element NAME COUNT`";
    const PROPERTY: &str = "a property: `property TYPE NAME` or `property list TYPE TYPE NAME`";
    const TYPES: &str =
        "one of char, uchar, short, ushort, int, uint, float, double (int8 to uint32, float32, float64)";
    const LINE: &str = "`comment`, `obj_info`, `element`, `property` or `end_header`";
    const END: &str = "`end_header` on a line of its own";
    let large: String = (0..300).map(|k| format!("element e{k} 0\n")).collect();
    for (text, message, expected) in [
        ("", "1: the file is empty", FILE),
        ("OFF\n3 1 0\n", "1: the file starts with `OFF`", FILE),
        ("plywood\n", "1: the file starts with `plywood`", FILE),
        ("ply\rformat ascii 1.0\r", "1: lines end with carriage returns alone", "lines that end with LF, or CR and LF"),
        ("ply\n", "1: the header does not end", END),
        ("ply\nformat ascii 1.0\nelement vertex 3\n", "3: the header does not end", END),
        ("ply\nend_header\n", "2: the header has no `format`", FORMAT),
        ("ply\nformat\n", "2: a word is missing at the end of the line", FORMAT),
        ("ply\nformat binary 1.0\n", "2: `binary` is no format of a PLY file", FORMAT),
        ("ply\nformat ascii 2.0\n", "2: `2.0` is no version of PLY", FORMAT),
        ("ply\nformat ascii 1.0 please\n", "2: `please` is too much", "the end of the line"),
        ("ply\nformat ascii 1.0\nformat ascii 1.0\n", "3: a second `format`", FORMAT),
        ("ply\nformat ascii 1.0\nvertex 3\n", "3: `vertex` is no line of a header", LINE),
        ("ply\nformat ascii 1.0\nproperty int x\n", "3: a property before the first element", ELEMENT),
        ("ply\nelement\n", "2: a name is missing at the end of the line", ELEMENT),
        ("ply\nelement vertex\n", "2: a number is missing at the end of the line", ELEMENT),
        ("ply\nelement vertex -3\n", "2: `-3` is not a whole number from 0", ELEMENT),
        ("ply\nelement a 1\nproperty flaot x\n", "3: `flaot` is no type of a property", TYPES),
        ("ply\nelement a 1\nproperty float\n", "3: a name is missing at the end of the line", PROPERTY),
        ("ply\nelement a 1\nproperty list int\n", "3: a type is missing at the end of the line", PROPERTY),
        ("ply\nelement a 1\nproperty int x y\n", "3: `y` is too much", "the end of the line"),
        (
            "ply\nelement a 1\nproperty list float int x\n",
            "3: the length of a list is of the type `float`",
            "an integer type, such as `uchar`",
        ),
        (&format!("ply\n{large}"), "258: too many elements", "at most 256"),
    ] {
        assert_eq!(error(text), [format!("m.ply:{message}"), expected.to_owned()], "{text}");
    }
}

#[test]
fn headers_that_are_no_mesh_are_refused() {
    const XYZ: &str = "the properties `x`, `y` and `z` of the element `vertex`, each a number";
    const LIST: &str = "one list `vertex_indices` or `vertex_index` of an integer type";
    const VERTEX: &str = "element vertex 1\nproperty int x\nproperty int y\nproperty int z\n";
    for (text, message, expected) in [
        ("ply\nformat ascii 1.0\nend_header\n", "3: the header has no element `vertex`", "one element `vertex`"),
        (
            &format!("ply\nformat ascii 1.0\n{VERTEX}{VERTEX}end_header\n"),
            "7: a second element `vertex`",
            "one element `vertex`",
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int z\nend_header\n",
            "3: the vertices have no property `y`",
            XYZ,
        ),
        (
            &format!("ply\nformat ascii 1.0\n{VERTEX}property float y\nend_header\n"),
            "3: the vertices have two properties `y`",
            XYZ,
        ),
        (
            &format!("ply\nformat ascii 1.0\n{VERTEX}element face 1\nproperty list int int corners\nend_header\n"),
            "7: the faces have no list of vertices",
            LIST,
        ),
        (
            &format!(
                "ply\nformat ascii 1.0\n{VERTEX}element face 0\nproperty list int int vertex_index\n\
                 property list int int vertex_indices\nend_header\n"
            ),
            "7: the faces have two lists of vertices",
            LIST,
        ),
        (
            &format!(
                "ply\nformat ascii 1.0\n{VERTEX}element tristrips 1\nproperty list int float vertex_index\nend_header\n"
            ),
            "7: the items of `tristrips` name their vertices by fractional numbers",
            LIST,
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 1000000000000\nproperty int x\nproperty int y\nproperty int z\n\
             end_header\n0 0 0\n",
            "3: the header promises 1000000000000 vertices, but the file is too short for them",
            "at most 1 vertices in the 6 bytes that follow",
        ),
        (
            "ply\nformat binary_big_endian 1.0\nelement vertex 99999999999999999999999\nproperty int x\n\
             property double y\nproperty int z\nend_header\n0123456789abcdef01",
            "3: the header promises 18446744073709551615 vertices, but the file is too short for them",
            "at most 1 vertices in the 18 bytes that follow",
        ),
    ] {
        assert_eq!(error(text), [format!("m.ply:{message}"), expected.to_owned()], "{text}");
    }
}

#[test]
fn errors_in_text_say_the_line_and_what_was_expected() {
    const VERTEX: &str = "one line with `x` `y` `z` `q`";
    const FACE: &str = "one line with `vertex_indices`";
    let good = ["0 0 0 1", "1 0 0 1", "0 1 0 1"];
    let line = |text: String| text.lines().position(|line| line == "end_header").expect("an end") + 2;
    let first = line(ascii("x y z q", good, ""));
    for (vertex, message, expected) in [
        ("0 0", "a number is missing at the end of the line", VERTEX),
        ("0 0 0", "a number is missing at the end of the line", VERTEX),
        ("0 0 0 1 2", "`2` is too much", VERTEX),
        ("0 x 0 1", "`x` is not a number", VERTEX),
        ("0 nan 0 1", "`nan` is not a finite number", VERTEX),
        ("0 -inf 0 1", "`-inf` is not a finite number", VERTEX),
        ("0 0 1e999 1", "`1e999` is not a finite number", VERTEX),
        ("0 0 -2e30 1", "the coordinate `-2e30` is too large", "a magnitude of at most 1e30"),
    ] {
        let text = ascii("x y z q", [good[0], vertex, good[2]], "3 0 1 2\n");
        assert_eq!(error(&text), [format!("m.ply:{}: {message}", first + 1), expected.to_owned()], "{text}");
    }
    for (face, message, expected) in [
        ("", "the file ends after 0 of 1 faces", "as many faces as the header says"),
        ("3 0 1", "a number is missing at the end of the line", FACE),
        ("3 0 1 2 0", "`0` is too much", FACE),
        ("-3 0 1 2", "`-3` is not a whole number from 0", FACE),
        ("3.0 0 1 2", "`3.0` is not a whole number from 0", FACE),
        ("3 0 1 2.0", "`2.0` is not a whole number", FACE),
        ("3 0 1 x", "`x` is not a whole number", FACE),
        ("3 0 1 -1", "there is no vertex -1", "an index from 0 to 2, as there are 3 vertices"),
        ("3 0 1 3", "there is no vertex 3", "an index from 0 to 2, as there are 3 vertices"),
        ("999999999999 0 1 2", "a number is missing at the end of the line", FACE),
    ] {
        let text = ascii("x y z q", good, &format!("{face}\n"));
        assert_eq!(error(&text), [format!("m.ply:{}: {message}", first + 3), expected.to_owned()], "{text}");
    }
    // No outline passes so often through so few vertices, and it would take long to see how it crosses itself.
    let long = format!("30000{}\n", " 0 1 2".repeat(10_000));
    let simple = "a simple outline; let the modelling program triangulate this face".to_owned();
    let message = "a face of 30000 corners is too intricate to be cut into triangles";
    assert_eq!(error(ascii("x y z q", good, &long)), [format!("m.ply:{}: {message}", first + 3), simple]);
    let text = ascii("x y z u v", ["0 0 0 1 1", "1 0 0 1e300 1", "0 1 0 1 1"], "3 0 1 2\n");
    assert_eq!(
        error(text),
        [format!("m.ply:{}: a texture coordinate is too large", first + 2), "at most 3.4e38".into()]
    );
}

/// A binary file of three vertices of 16 bytes and a face of a byte and three indices of 4 bytes, its data changed, and
/// where its data starts.
fn changed(change: &dyn Fn(&mut Vec<u8>)) -> (usize, Vec<u8>) {
    let place = |x: f64, y: f64| single(&[x, y, 0.0, 9.0]);
    let file = ply(
        Encoding::Little,
        &[
            Element {
                name: "vertex",
                properties: &["float x", "float y", "float z", "float q"],
                items: vec![place(0.0, 0.0), place(1.0, 0.0), place(0.0, 1.0)],
            },
            Element {
                name: "face",
                properties: &["list char int vertex_indices"],
                items: vec![vec![vec![0.0, 1.0, 2.0]]],
            },
        ],
    );
    let data = file.windows(11).position(|bytes| bytes == b"end_header\n").expect("an end") + 11;
    let mut changed = file[data..].to_vec();
    change(&mut changed);
    (data, [&file[..data], &changed].concat())
}

#[test]
fn errors_in_binary_data_say_the_byte() {
    let put = |at: usize, bytes: &[u8], data: &mut Vec<u8>| data[at..at + bytes.len()].copy_from_slice(bytes);
    // What is stepped over may be anything.
    assert_eq!(read(changed(&|data| put(12, &[0xff; 4], data)).1).triangles, [[0, 1, 2]]);
    let indices = "an index from 0 to 2, as there are 3 vertices";
    type Change<'a> = &'a dyn Fn(&mut Vec<u8>);
    let faults: [(Change, usize, &str, &str); 9] = [
        (&|data| put(20, &f32::NAN.to_le_bytes(), data), 20, "`NaN` is not a finite number", "finite numbers"),
        (
            &|data| put(40, &f32::NEG_INFINITY.to_le_bytes(), data),
            40,
            "`-inf` is not a finite number",
            "finite numbers",
        ),
        (
            &|data| put(16, &f32::MAX.to_le_bytes(), data),
            16,
            "the coordinate `3.4028234663852886e38` is too large",
            "a magnitude of at most 1e30",
        ),
        (&|data| put(53, &3_i32.to_le_bytes(), data), 53, "there is no vertex 3", indices),
        (&|data| put(57, &(-1_i32).to_le_bytes(), data), 57, "there is no vertex -1", indices),
        (&|data| data[48] = 0xff, 48, "`-1` is not a whole number from 0", "the length of a list"),
        (
            &|data| data[48] = 4,
            48,
            "a list of 4 values, but the file is too short for them",
            "at most 3 values in the bytes that follow",
        ),
        (
            &|data| data.truncate(60),
            48,
            "a list of 3 values, but the file is too short for them",
            "at most 2 values in the bytes that follow",
        ),
        (
            &|data| data.truncate(50),
            48,
            "a list of 3 values, but the file is too short for them",
            "at most 0 values in the bytes that follow",
        ),
    ];
    for (change, byte, message, expected) in faults {
        let (data, file) = changed(change);
        assert_eq!(error(file), [format!("m.ply: byte {}: {message}", data + byte), expected.to_owned()]);
    }
}

#[test]
fn binary_data_that_ends_too_early_is_an_error() {
    let (data, cut) = changed(&|data| data.truncate(48));
    let [message, _] = error(cut);
    assert_eq!(message, "m.ply:9: the header promises 1 faces, but the file is too short for them");
    // Two faces where there is one and a bit.
    let header = String::from_utf8_lossy(&changed(&|_| {}).1[..data]).replace("face 1", "face 2");
    let body = &changed(&|data| data.push(3)).1[data..];
    assert_eq!(
        error([header.as_bytes(), body].concat()),
        [
            format!("m.ply: byte {}: a list of 3 values, but the file is too short for them", data + 61),
            "at most 0 values in the bytes that follow".to_owned()
        ]
    );
    // Lists make items longer than the least that is compared with the file's length.
    let vertex = |x: f64| vec![vec![x], vec![0.0], vec![0.0], vec![0.5; 2]];
    let properties = ["float x", "float y", "float z", "list char double q"];
    let items = vec![vertex(0.0), vertex(1.0), vertex(2.0)];
    let mut file = ply(Encoding::Big, &[Element { name: "vertex", properties: &properties, items }]);
    file.truncate(file.len() - 29 + 5);
    assert_eq!(
        error(&file),
        [
            format!("m.ply: byte {}: the file ends after 2 of 3 vertices", file.len()),
            "as many vertices as the header says".to_owned()
        ]
    );
}

#[test]
fn files_without_triangles_say_what_they_have() {
    let head = "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\n";
    for (text, hint) in [
        (format!("{head}end_header\n1 2 3\n"), "the file has 1 vertices and 0 faces"),
        (format!("{head}element face 0\nend_header\n1 2 3\n"), "the file has 1 vertices and 0 faces"),
        (
            format!("{head}element face 1\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n2 0 0\n"),
            "the file has 1 vertices and 1 faces: 1 face of fewer than 3 corners (left out)",
        ),
    ] {
        assert_eq!(error(text), ["m.ply: the mesh has no triangles", hint]);
    }
}

/// A truncated file is always an error, never a smaller mesh.
#[test]
fn truncated_files_are_errors() {
    for encoding in ENCODINGS {
        let file = ply(
            encoding,
            &[
                Element { name: "vertex", properties: &["float x", "char y", "double z"], items: vertices() },
                Element { name: "edge", properties: &["list char char a"], items: vec![vec![vec![1.0]]] },
                Element { name: "face", properties: &["list uchar int vertex_indices"], items: sides() },
            ],
        );
        let whole = if encoding == Encoding::Ascii { file.trim_ascii_end().len() } else { file.len() };
        for end in 0..whole {
            assert!(matches!(parse_ply(&file[..end]), Err(MeshError::Broken { .. })), "{encoding:?} {end}");
        }
    }
}

#[test]
fn diagnostics_carry_code_and_place() {
    let span = scene_format::diagnostic::Span { source: 0, start: 3, end: 9 };
    let text = b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
        property float z\nend_header\n\0\0\0\0\0\0\0\0\0\0\xc0\x7f";
    let error = parse_ply(text).expect_err("broken");
    let MeshError::Broken { place, .. } = &error else { panic!("{error}") };
    assert_eq!(*place, Place::Byte(text.len() as u64 - 4));
    let broken = error.to_diagnostic(span);
    assert_eq!((broken.code.as_str(), broken.span), ("E0510", span));
    assert_eq!(
        broken.message,
        format!("the mesh file is broken at byte {}: `NaN` is not a finite number", text.len() - 4)
    );
    assert_eq!(broken.elsewhere.map(|place| (place.path, place.line)), Some(("m.ply".into(), 0)));
}
