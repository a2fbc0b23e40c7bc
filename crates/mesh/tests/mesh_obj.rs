//! OBJ files: every form of faces, polygons, oddities, the exact text of errors, and tobj as an oracle.

use std::path::Path;
use tracer_mesh::{MeshData, MeshError, MeshFormat, NO_INDEX, parse};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn read(text: &str) -> MeshData {
    parse(text.as_bytes(), MeshFormat::Obj, Path::new("m.obj")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The message, and what was expected.
fn error(text: impl AsRef<[u8]>) -> [String; 2] {
    match parse(text.as_ref(), MeshFormat::Obj, Path::new("m.obj")) {
        Ok(mesh) => panic!("{mesh:?} of {}", String::from_utf8_lossy(text.as_ref())),
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

/// Each triangle's corners as positions: what a picture sees, whatever the indices are.
fn soup(mesh: &MeshData) -> Vec<[[f64; 3]; 3]> {
    mesh.triangles.iter().map(|triangle| triangle.map(|corner| mesh.positions[corner as usize])).collect()
}

#[test]
fn faces_of_positions_alone() {
    let mesh = read(&format!("{SQUARE}f 1 2 3\n"));
    assert_eq!(mesh.positions[2], [1.0, 1.0, 0.0]);
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert!(mesh.normals.is_empty() && mesh.uvs.is_empty() && mesh.triangle_material.is_empty());
    assert_eq!((mesh.normal_triangles, mesh.uv_triangles, mesh.warnings), (None, None, Vec::new()));
}

#[test]
fn faces_with_texture_coordinates() {
    let mesh = read(&format!("{SQUARE}vt 0.5\nvt 0 1 0\nf 1/2 2/1 3/2\n"));
    assert_eq!(mesh.uvs, [[0.5, 0.0], [0.0, 1.0]]);
    assert_eq!(mesh.uv_triangles, Some(vec![[1, 0, 1]]));
    assert_eq!(mesh.normal_triangles, None);
}

#[test]
fn faces_with_normals() {
    let mesh = read(&format!("{SQUARE}vn 0 0 2\nvn 3 0 4\nf 1//1 2//2 3//1\n"));
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]]);
    assert_eq!(mesh.normal_triangles, Some(vec![[0, 1, 0]]));
    assert!(mesh.uvs.is_empty());
}

#[test]
fn faces_with_both_and_slashes_without_an_index() {
    let mesh = read(&format!("{SQUARE}vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n f\t1/1/ 2/1 3/1 \nf 1// 2/ 3\n"));
    assert_eq!(mesh.triangles, [[0, 1, 2]; 3]);
    assert_eq!(mesh.uv_triangles, Some(vec![[0; 3], [0; 3], [NO_INDEX; 3]]));
    assert_eq!(mesh.normal_triangles, Some(vec![[0; 3], [NO_INDEX; 3], [NO_INDEX; 3]]));
    assert_eq!(
        warnings(&mesh),
        ["W0510 the mesh has oddities: 2 triangles without vertex normals (flat); \
          1 triangle without texture coordinates (kept)"]
    );
}

#[test]
fn indices_that_are_those_of_the_positions_are_not_kept_twice() {
    let normals = "vn 0 0 1\n".repeat(4);
    let mesh = read(&format!("{SQUARE}{normals}vt 0 0\nf 1/1/1 2/1/2 3/1/3\nf 1/1/1 3/1/3 4/1/4\n"));
    assert_eq!(mesh.normal_triangles, None);
    assert_eq!(mesh.normals.len(), 4);
    assert_eq!(mesh.uv_triangles, Some(vec![[0; 3]; 2]));
}

#[test]
fn negative_indices_count_back_from_the_face() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nf -3/-1/-1 -2/-1/-1 -1/-1/-1\n\
                v 5 0 0\nv 6 0 0\nv 6 1 0\nvt 1 1\nf -3/-1/1 -2/-2/-1 -1/1/-1\n";
    let mesh = read(text);
    assert_eq!(mesh.triangles, [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(mesh.uv_triangles, Some(vec![[0, 0, 0], [1, 0, 0]]));
    assert_eq!(mesh.normal_triangles, Some(vec![[0; 3]; 2]));
}

#[test]
fn vertices_may_come_after_their_faces() {
    assert_eq!(read(&format!("f 1 2 3\n{SQUARE}")).triangles, [[0, 1, 2]]);
}

#[test]
fn quadrilaterals_become_the_fan_and_concave_ones_do_not() {
    assert_eq!(read(&format!("{SQUARE}f 1 2 3 4\n")).triangles, [[0, 1, 2], [0, 2, 3]]);
    // The second corner of the face is the dent.
    let dent = "v 0 0 0\nv 1 1 0\nv 2 0 0\nv 1 3 0\nf 1 2 3 4\n";
    assert_eq!(read(dent).triangles, [[1, 2, 3], [1, 3, 0]]);
}

#[test]
fn concave_polygons_keep_area_winding_and_attributes() {
    // An L, in the plane z = 7, with its own texture coordinate at each corner.
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let mut text = String::new();
    for [x, y] in corners {
        text += &format!("v {x} {y} 7\nvt {x} {y}\n");
    }
    let mesh = read(&format!("{text}f 1/1 2/2 3/3 4/4 5/5 6/6\n"));
    let mut area = 0.0;
    for [a, b, c] in soup(&mesh) {
        let part = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!(part > 0.0);
        area += part / 2.0;
    }
    assert_eq!((mesh.triangles.len(), area), (4, 3.0));
    // Texture coordinates go with their corners: here they are the positions.
    assert_eq!(mesh.uv_triangles, None);
    for (position, uv) in mesh.positions.iter().zip(&mesh.uvs) {
        assert_eq!([position[0] as f32, position[1] as f32], *uv);
    }
}

#[test]
fn line_ends_continuations_comments_and_names_of_groups() {
    let plain = read(&format!("{SQUARE}f 1 2 3\nf 1 3 4\n"));
    for text in [
        format!("{SQUARE}f 1 2 3\nf 1 3 4").replace('\n', "\r\n"),
        format!("\u{feff}# C:\\models\\\n{SQUARE}f 1 \\\n 2 3# all\n\n\t f \\\r\n1 3\t4  \ng a b\no \ns off\ns 1\n"),
        format!("{SQUARE}g größe\nf 1 2 3\nfo 1 3 4\n"),
        format!("v 0.0e0 -0 +0.\n{}f 1 2 3\nf 1 3 4\n", &SQUARE[8..]),
    ] {
        assert_eq!(read(&text), plain, "{text}");
    }
}

#[test]
fn coordinates_keep_all_their_digits() {
    let mesh = read("v 100000.000000001 1e5 -0.1\nv 1e-300 123456789.12345678 2\nv 0 0 0\nf 1 2 3\n");
    assert_eq!(mesh.positions[0], [100000.000000001, 1e5, -0.1]);
    assert_eq!(mesh.positions[1], [1e-300, 123456789.12345678, 2.0]);
}

#[test]
fn the_barycentre_is_the_mean_of_all_vertices() {
    let mesh = read("v 100001 0 0\nv 100002 0 0\nv 100003 3 0\nv 100002 9 8\nf 1 2 3\n");
    assert_eq!(mesh.barycentre(), [100002.0, 3.0, 2.0]);
    assert_eq!(MeshData::default().barycentre(), [0.0; 3]);
}

#[test]
fn oddities_are_counted_in_one_warning() {
    let mesh = read(&format!(
        "{SQUARE}v 2 2 2 0.5\nv 0 0 1 1 0 0\nv 0 0 1 1 0.1 0.2 0.3\nvt 0 0\nvn 0 0 0\nvn 0 0 1\nf 1//1 2//2 3//2\n\
         f 1 2 2\n\
         f 1 2 3 3\nl 1 2 3\np 1\np 2\ncurv 1\ncurv 2\nshadow_obj x\n"
    ));
    assert_eq!(
        warnings(&mesh),
        ["W0510 the mesh has oddities: 2 triangles without area (left out); 1 line (`l`) (left out); \
          2 point elements (`p`) (left out); 1 triangle without vertex normals (flat); \
          1 vertex normal of length zero (ignored); 1 texture coordinate that no face names (ignored); \
          2 vertex colours (ignored); 1 vertex weight other than 1 (ignored); \
          3 statements not known here: `curv` `shadow_obj` (ignored)"]
    );
    assert_eq!(mesh.triangles, [[0, 1, 2], [2, 0, 1]]);
    assert_eq!(mesh.normal_triangles, Some(vec![[NO_INDEX, 1, 1], [NO_INDEX; 3]]));
    assert!(mesh.uvs.is_empty());
    let warning = &mesh.warnings[0];
    assert_eq!(
        warning.elsewhere.as_ref().map(|place| (place.path.as_path(), place.line)),
        Some((Path::new("m.obj"), 0))
    );
}

#[test]
fn errors_say_the_line_and_what_was_expected() {
    const VERTEX: &str = "a vertex: `v x y z`, possibly with a weight or a colour (3, 4, 6 or 7 numbers)";
    const UV: &str = "texture coordinates: `vt u v` (1 to 3 numbers)";
    const NORMAL: &str = "a vertex normal: `vn x y z`";
    const FACE: &str =
        "a face of 3 or more corners: `f 1 2 3`, `f 1/1 2/2 3/3`, `f 1//1 2//2 3//3` or `f 1/1/1 2/2/2 3/3/3`";
    for (bad, message, expected) in [
        ("v 1 2", "a number is missing at the end of the line", VERTEX),
        ("v", "a number is missing at the end of the line", VERTEX),
        ("v 1 2 x3", "`x3` is not a number", VERTEX),
        ("v 1,5 2 3", "`1,5` is not a number", VERTEX),
        ("v 1 nan 2", "`nan` is not a finite number", VERTEX),
        ("v 1 -inf 2", "`-inf` is not a finite number", VERTEX),
        ("v 1 2 1e999", "`1e999` is not a finite number", VERTEX),
        ("v 1 2 -1e31", "the coordinate `-1e31` is too large", "a magnitude of at most 1e30"),
        ("v 1 2 3 4 5", "a vertex with 5 numbers", VERTEX),
        ("v 1 2 3 4 5 6 7 8", "`8` is too much", VERTEX),
        ("vt", "a number is missing at the end of the line", UV),
        ("vt 1 2 3 4", "`4` is too much", UV),
        ("vt 1e39", "a texture coordinate is too large", "at most 3.4e38"),
        ("vn 0 0", "a number is missing at the end of the line", NORMAL),
        ("vn 0 0 1 0", "`0` is too much", NORMAL),
        ("f", "a face with 0 corners", FACE),
        ("f 1 2", "a face with 2 corners", FACE),
        ("f 1 2 x", "`x` is no corner of a face", FACE),
        ("f 1 2 3.5", "`3.5` is no corner of a face", FACE),
        ("f 1 2 3/1/1/1", "`3/1/1/1` is no corner of a face", FACE),
        ("f 1 2 /1", "`/1` is no corner of a face", FACE),
        ("f 1 2 0", "the corner `0` has the index 0: indices count from 1, or back from -1", FACE),
        ("f 1//0 2//1 3//1", "the corner `1//0` has the index 0: indices count from 1, or back from -1", FACE),
        ("f 1 2 99999999999999999999", "the corner `99999999999999999999` has an index far out of range", FACE),
        ("f 1 2 -4294967297", "the corner `-4294967297` has an index far out of range", FACE),
        (
            "f 1 2 5",
            "the corner `5` names a vertex that does not exist",
            "a vertex index from 1 to 4, or counting back from -1",
        ),
        (
            "f 1 2 -5",
            "the corner `-5` names a vertex that does not exist",
            "a vertex index from 1 to 4, or counting back from -1",
        ),
        (
            "f 1 2 3/7",
            "the corner `3/7` names a texture coordinate that does not exist",
            "no texture coordinate index, as the file has none",
        ),
        (
            "f 1 1 1//2",
            "the corner `1//2` names a vertex normal that does not exist",
            "a vertex normal index from 1 to 1, or counting back from -1",
        ),
        ("usemtl", "a name is missing at the end of the line", "the name of a material: `usemtl NAME`"),
        ("mtllib # none", "a name is missing at the end of the line", "the name of an MTL file: `mtllib FILE.mtl`"),
    ] {
        let text = format!("# head\r\n{SQUARE}vn 0 0 1\n\n{bad}\nf 1 2 3\n");
        let [found, expectation] = error(&text);
        assert_eq!(found, format!("m.obj:8: {message}"));
        assert_eq!(expectation, expected, "{bad}");
    }
}

#[test]
fn the_line_is_that_of_the_word_even_in_a_continued_statement() {
    assert_eq!(error(format!("{SQUARE}f 1 2 \\\n 3 \\\n x\n"))[0], "m.obj:7: `x` is no corner of a face");
    assert_eq!(
        error(format!("{SQUARE}f 1 2 \\\n 9\n"))[0],
        "m.obj:6: the corner `9` names a vertex that does not exist"
    );
    assert_eq!(error("v 0 0 0\nv 1 2")[0], "m.obj:2: a number is missing at the end of the line");
    assert_eq!(error("v 0 0 0\nv 1 2\n")[0], "m.obj:2: a number is missing at the end of the line");
}

#[test]
fn text_in_other_encodings_is_refused_where_it_matters() {
    let latin = |line: &[u8]| [SQUARE.as_bytes(), line, b"\nf 1 2 3\n"].concat();
    assert_eq!(error(latin(b"v 1 2 \xe4"))[0], "m.obj:5: `\u{fffd}` is not UTF-8 text");
    assert_eq!(error(latin(b"usemtl gr\xfcn"))[0], "m.obj:5: the name `gr\u{fffd}n` is not UTF-8 text");
    // Comments and names of groups do not matter.
    assert!(parse(&latin(b"# gr\xfcn"), MeshFormat::Obj, Path::new("m.obj")).is_ok());
    assert!(parse(&latin(b"g gr\xfcn"), MeshFormat::Obj, Path::new("m.obj")).is_ok());
    let utf16: Vec<u8> = "\u{feff}v 0 0 0\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(error(utf16)[0], "m.obj:1: the file is UTF-16 text");
    assert_eq!(error(b"L\x01\x02\0\0\0rest")[0], "m.obj:1: the file is binary");
}

#[test]
fn files_without_triangles_say_what_they_have() {
    for (text, hint) in [
        ("", "the file has no vertices (`v`)"),
        ("v 0 0 0\nv 1 0 0\n", "the file has 2 vertices and no faces (`f`)"),
        ("v 0 0 0\nv 1 0 0\nl 1 2\n", "the file has 2 vertices; 1 line (`l`) (left out)"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "the file has 3 vertices; 1 triangle without area (left out)"),
        (
            "<!DOCTYPE html>\n<html>\n",
            "the file has no vertices (`v`); is it an OBJ file? 2 statements not known here: `<!DOCTYPE` `<html>` \
             (ignored)",
        ),
    ] {
        assert_eq!(error(text), ["m.obj: the mesh has no triangles", hint]);
    }
}

#[test]
fn diagnostics_carry_code_line_and_expectation() {
    let span = scene_format::diagnostic::Span { source: 0, start: 3, end: 9 };
    let broken = parse(b"v 0 0\n", MeshFormat::Obj, Path::new("m.obj")).expect_err("broken").to_diagnostic(span);
    assert_eq!((broken.code.as_str(), broken.span), ("E0510", span));
    assert_eq!(broken.message, "the mesh file is broken: a number is missing at the end of the line");
    assert!(broken.expected.starts_with("a vertex"));
    assert_eq!(broken.elsewhere.map(|place| (place.path, place.line)), Some(("m.obj".into(), 1)));
    let empty = parse(b"", MeshFormat::Obj, Path::new("m.obj")).expect_err("empty").to_diagnostic(span);
    assert_eq!(empty.code, "E0511");
}

/// A well-formed file with all statements that tobj reads too, without polygons (which it cuts otherwise).
fn well_formed() -> String {
    let side = 40;
    let mut text = String::from("# wave\no wave\n");
    let mut state = 3_u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f64 / f64::from(1 << 24)
    };
    for _ in 0..side * side {
        text += &format!("v {:.7} {:.5e} {}\n", 100.0 * next(), next() - 0.5, next());
        text += &format!(
            "vt {:.6} {:.6}\nvn {:.4} {:.4} {:.4}\n",
            next(),
            next(),
            next() - 0.5,
            next() - 0.5,
            next() + 0.1
        );
    }
    for row in 1..side {
        for column in 1..side {
            let a = row * side + column;
            let (b, c) = (a - side, a - 1);
            // Texture coordinates and normals by other numbers than positions, some counted from the end.
            let back = side * side + 1;
            text += &format!("f {a}/{b}/{c} {b}/{c}/{a} {c}/{}/{b}\n", a as i64 - back as i64);
        }
    }
    text
}

#[test]
fn tobj_reads_the_same() {
    let text = well_formed();
    let mesh = read(&text);
    let options = tobj::LoadOptions::default();
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Ok(Default::default())).expect("tobj");
    let [model] = &models[..] else { panic!("{} models", models.len()) };
    let oracle = &model.mesh;
    assert_eq!(mesh.triangles.len() * 3, oracle.indices.len());
    let normals = mesh.normal_triangles.as_ref().expect("own indices").as_flattened();
    let uvs = mesh.uv_triangles.as_ref().expect("own indices").as_flattened();
    for (corner, &position) in mesh.triangles.as_flattened().iter().enumerate() {
        let [p, t, n] = [&oracle.indices, &oracle.texcoord_indices, &oracle.normal_indices].map(|i| i[corner] as usize);
        let position = mesh.positions[position as usize].map(|x| x as f32);
        assert_eq!(position[..], oracle.positions[3 * p..3 * p + 3]);
        assert_eq!(mesh.uvs[uvs[corner] as usize][..], oracle.texcoords[2 * t..2 * t + 2]);
        let normal = &oracle.normals[3 * n..3 * n + 3];
        let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
        for (ours, theirs) in mesh.normals[normals[corner] as usize].iter().zip(normal) {
            // Ours are of unit length and rounded once from f64: tobj's f32 and this test's division differ by a few
            // ulp.
            assert!((ours - theirs / length).abs() < 1e-6);
        }
    }
}
