//! OFF files: all variants of the header, colours, polygons, oddities and the exact text of errors.

use std::path::Path;
use tracer_mesh::{MeshData, MeshError, MeshFormat, NO_INDEX, parse};

fn read(text: &str) -> MeshData {
    parse(text.as_bytes(), MeshFormat::Off, Path::new("m.off")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The message, and what was expected.
fn error(text: &str) -> [String; 2] {
    match parse(text.as_bytes(), MeshFormat::Off, Path::new("m.off")) {
        Ok(mesh) => panic!("{mesh:?} of {text}"),
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

const BODY: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

#[test]
fn headers_of_all_kinds_give_the_same_mesh() {
    let plain = read(&format!("OFF\n4 2 0\n{BODY}"));
    assert_eq!(plain.positions, [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(plain.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert!(plain.warnings.is_empty());
    let spaced = BODY.replace('\n', "  # end\n\n # between\n");
    for text in [
        format!("OFF 4 2 5\n{BODY}"),
        format!("OFF4 2 0\n{BODY}"),
        format!("OFF\n4 2\n{BODY}"),
        format!("4 2 0\n{BODY}"),
        format!("# made by hand\n\nOFF # keyword\n\n# counts\n4 2 0 # of all\n{spaced}"),
        format!("OFF\n4 2 0\n{BODY}").replace('\n', "\r\n"),
        format!("\u{feff}OFF\n4 2 0\n{}", BODY.trim_end()),
    ] {
        assert_eq!(read(&text), plain, "{text}");
    }
}

#[test]
fn colours_are_counted_and_ignored() {
    let plain = read("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    let colored = "0 0 0 255 0 0 255\n1 0 0 0 0 1 1\n0 1 0 0.5 0.5 0.5 1\n3 0 1 2";
    for (text, vertices, faces) in [
        (format!("COFF\n3 1 0\n{colored}\n"), 3, 0),
        (format!("OFF\n3 1 0\n{colored}\n"), 3, 0),
        (format!("COFF\n3 1 0\n{colored} 255 0 0\n").replace(" 255\n", "\n").replace(" 1\n", " \n"), 3, 1),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2  17\n".to_owned(), 0, 1),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0.1 0.2 0.3 1.0\n".to_owned(), 0, 1),
    ] {
        let mesh = read(&text);
        let mut parts = Vec::new();
        if vertices > 0 {
            parts.push(format!("{vertices} vertex colours (ignored)"));
        }
        if faces > 0 {
            parts.push(format!("{faces} face colour (ignored)"));
        }
        assert_eq!(warnings(&mesh), [format!("W0510 the mesh has oddities: {}", parts.join("; "))], "{text}");
        assert_eq!((mesh.positions, mesh.triangles), (plain.positions.clone(), plain.triangles.clone()));
    }
}

#[test]
fn normals_and_texture_coordinates_belong_to_vertices() {
    let mesh = read("NOFF\n3 1 0\n0 0 0 0 0 2\n1 0 0 0 0 0\n0 1 0 3 0 4\n3 0 1 2\n");
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [0.0; 3], [0.6, 0.0, 0.8]]);
    assert_eq!(mesh.normal_triangles, Some(vec![[0, NO_INDEX, 2]]));
    assert_eq!(warnings(&mesh), ["W0510 the mesh has oddities: 1 vertex normal of length zero (ignored)"]);
    let mesh = read(
        "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 0.1 0.2\n1 0 0 0 1 0 255 0 0 0.3 0.4\n0 1 0 1 0 0 9 9 9 9 0.5 0.6\n\
         3 0 1 2\n",
    );
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
    assert_eq!(mesh.uvs, [[0.1, 0.2], [0.3, 0.4], [0.5, 0.6]]);
    assert_eq!((mesh.normal_triangles, mesh.uv_triangles), (None, None));
    let mesh = read("STOFF\n3 1 0\n0 0 0 0 1\n1 0 0 1 1\n0 1 0 0.5 0\n3 0 1 2\n");
    assert_eq!(mesh.uvs, [[0.0, 1.0], [1.0, 1.0], [0.5, 0.0]]);
    // Where no normal has a length there are none.
    let mesh = read("NOFF\n3 1 0\n0 0 0 0 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n");
    assert_eq!((mesh.normals, mesh.normal_triangles), (vec![], None));
}

#[test]
fn polygons_are_cut_and_what_is_no_triangle_is_counted() {
    let mesh =
        read("OFF\n5 5 0\n0 0 0\n1 1 0\n2 0 0\n1 3 0\n2 2 0\n4 0 1 2 3\n2 0 1\n1 3\n3 0 1 4\n3 0 2 2\nrest\nof it\n");
    // The second corner of the first face is a dent.
    assert_eq!(mesh.triangles, [[1, 2, 3], [1, 3, 0]]);
    assert_eq!(
        warnings(&mesh),
        ["W0510 the mesh has oddities: 2 triangles without area (left out); \
          2 faces of fewer than 3 corners (left out); 2 lines after the last face (ignored)"]
    );
}

#[test]
fn errors_say_the_line_and_what_was_expected() {
    const OFF: &str = "an ASCII OFF file: `OFF` (COFF, NOFF, STOFF ...), then the numbers of vertices, faces and edges";
    const COUNTS: &str = "the numbers of vertices, faces and edges: `8 6 12`";
    const VERTEX: &str = "a vertex on a line of its own: 3 coordinates";
    const FACE: &str = "a face on a line of its own: the number of its corners, then their indices";
    const HEAD: &str = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
    for (text, message, expected) in [
        ("", "1: the file is empty", OFF),
        ("\n# only this\n", "2: the file is empty", OFF),
        ("ply\nformat", "1: the file starts with `ply`", OFF),
        ("OFFICE\n", "1: the file starts with `OFFICE`", OFF),
        ("4OFF\n3 1 0\n", "1: `4OFF` files are not supported", OFF),
        ("nOFF\n3\n3 1 0\n", "1: `nOFF` files are not supported", OFF),
        ("OFF BINARY\n\0\0", "1: binary OFF files are not supported", OFF),
        ("OFF\n", "1: the file ends before its counts", COUNTS),
        ("OFF\n3\n", "2: a number is missing at the end of the line", COUNTS),
        ("OFF\n3 -1 0\n", "2: `-1` is not a whole number from 0", COUNTS),
        ("OFF\n3 1.5 0\n", "2: `1.5` is not a whole number from 0", COUNTS),
        ("OFF\n3 1 0 4\n", "2: `4` is too much", COUNTS),
        (
            "OFF\n1000000000000 1 0\n0 0 0\n",
            "2: the header promises 1000000000000 vertices, but the file is too short for them",
            "at most 1 vertices in the 6 bytes that follow",
        ),
        ("OFF 1\n 1000000000000 0\n0 0 0\n", "1: a number is missing at the end of the line", COUNTS),
        (
            "OFF\n1 99999999999999999999999 0\n0 0 0\n",
            "2: the header promises 9223372036854775807 faces, but the file is too short for them",
            "at most 1 faces in the 6 bytes that follow",
        ),
        (
            "OFF\n3 1 0\n0 0 0\n1 0 0 # two\n\n#\n",
            "6: the file ends after 2 of 3 vertices",
            "as many vertices as the header says",
        ),
        (
            "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
            "6: the file ends after 1 of 2 faces",
            "as many faces as the header says",
        ),
        ("OFF\n2 1 0\n0 0\n1 0 0\n3 0 0 0\n", "3: a number is missing at the end of the line", VERTEX),
        ("OFF\n2 1 0\n0 0 nan\n1 0 0\n3 0 0 0\n", "3: `nan` is not a finite number", VERTEX),
        (
            "OFF\n2 1 0\n0 0 -2e30\n1 0 0\n3 0 0 0\n",
            "3: the coordinate `-2e30` is too large",
            "a magnitude of at most 1e30",
        ),
        ("OFF\n2 1 0\n0 0 0 1 0 0 1 1\n1 0 0\n", "3: a vertex with 8 numbers", VERTEX),
        (
            "CNOFF\n2 1 0\n0 0 0 0 0 1\n1 0 0 1 0 0\n",
            "3: a vertex with 6 numbers",
            "a vertex on a line of its own: 3 coordinates, 3 numbers of its normal, 3 or 4 numbers of its colour",
        ),
        ("STOFF\n2 1 0\n0 0 0 0 1e300\n1 0 0 0 0\n", "3: a texture coordinate is too large", "at most 3.4e38"),
    ] {
        assert_eq!(error(text), [format!("m.off:{message}"), expected.to_owned()], "{text}");
    }
    for (face, message, expected) in [
        ("3 0 1", "a number is missing at the end of the line", FACE),
        ("3 0 1 -2", "`-2` is not a whole number from 0", FACE),
        ("3 0 1 x", "`x` is not a whole number from 0", FACE),
        ("999999999999 0 1 2", "a number is missing at the end of the line", FACE),
        ("3 0 1 3", "there is no vertex 3", "an index from 0 to 2, as there are 3 vertices"),
        ("3 0 1 4294967296", "there is no vertex 4294967296", "an index from 0 to 2, as there are 3 vertices"),
        ("3 0 1 2 red", "`red` is not a number", "nothing more, or a colour"),
        ("3 0 1 2 0 0 0 0 9", "`9` is too much after a face of 3 corners", "at most 4 numbers of a colour"),
    ] {
        assert_eq!(error(&format!("{HEAD}{face}\n")), [format!("m.off:6: {message}"), expected.to_owned()]);
    }
}

#[test]
fn files_without_triangles_say_what_they_have() {
    for (text, hint) in [
        ("OFF\n0 0 0\n", "the file has 0 vertices and 0 faces"),
        ("OFF\n1 1 0\n0 0 0\n1 0\n", "the file has 1 vertices and 1 faces: 1 face of fewer than 3 corners (left out)"),
    ] {
        assert_eq!(error(text), ["m.off: the mesh has no triangles", hint]);
    }
}

/// A truncated file is always an error, never a smaller mesh.
#[test]
fn truncated_files_are_errors() {
    let text = format!("OFF\n4 2 0\n{BODY}");
    for end in 0..text.trim_end().len() {
        let cut = &text[..end];
        let result = parse(cut.as_bytes(), MeshFormat::Off, Path::new("m.off"));
        assert!(matches!(result, Err(MeshError::Broken { .. })), "{cut}");
    }
}
