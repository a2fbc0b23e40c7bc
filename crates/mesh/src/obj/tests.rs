use super::*;

/// Every kind of statement, index and line end, so that pieces are cut in all kinds of places.
const SAMPLE: &str = "# sample\r\nmtllib none.mtl\nv 0 0 0\nv 1 0 0 \\\n\nv 1 1 0\nv 0 1 0 .1 .2 0\nvt 0 0\nvt \
                      1 0\\\n 0\n\
                      vn 0 0 1\n\
    usemtl a\nf 1/1/1 2/2/1 3/1/1\ng one\nv 0 0 1\nv 1 0 1 1 1 0 2\nusemtl b\nf -2//-1 \\\r\n -1//-1 \\\n -3//-1\nvn \
    0 0 0\n\
    f 1 2 3 4\nusemtl c\nusemtl a\nl 1 2\nf 1 2 2\nf 6/-1 5/-2 4\nvn 0 1 0\nf 1//2 2//2 3//3\ncurv 1 2\nf 7 1 2\n\
    v 5 5 5\n\
    s1\ns2\ns3\ns4\ns5\ns1\ns6\ns7\ns8\ns9\ns1\n";

fn read(text: &str, piece_bytes: usize) -> Result<MeshData, String> {
    let wanted = Wanted { colors: true, part: None };
    read_in_pieces(text.as_bytes(), (Path::new("m.obj"), &Files::default()), wanted, piece_bytes)
        .map_err(|error| error.to_string())
}

#[test]
fn the_size_of_pieces_does_not_matter() {
    let whole = read(SAMPLE, usize::MAX / 2).expect("a mesh");
    assert_eq!(whole.triangles.len(), 7);
    for bytes in 1..SAMPLE.len() {
        assert_eq!(read(SAMPLE, bytes).as_ref(), Ok(&whole), "pieces of {bytes} bytes");
    }
}

/// Faces are in a group over the ends of pieces.
#[test]
fn the_size_of_pieces_does_not_matter_to_parts() {
    let text = format!("o it\n{SAMPLE}o other\nf 1 2 3\ng one two\nf 1 2 4\n");
    let read = |name: &str, piece_bytes: usize| {
        let wanted = Wanted { colors: true, part: Some(name) };
        read_in_pieces(text.as_bytes(), (Path::new("m.obj"), &Files::default()), wanted, piece_bytes)
            .map_err(|error| error.to_string())
    };
    for (name, triangles) in [("it", 7), ("one", 8), ("two", 1), ("other", 2)] {
        let whole = read(name, usize::MAX / 2).expect("a mesh");
        assert_eq!(whole.triangles.len(), triangles, "{name}");
        for bytes in 1..text.len() {
            assert_eq!(read(name, bytes).as_ref(), Ok(&whole), "{name} in pieces of {bytes} bytes");
        }
    }
    assert_eq!(read("none", 1), read("none", usize::MAX / 2));
}

/// Two faults at different ends of the file, of both kinds: the same one is told for every size of pieces.
#[test]
fn the_size_of_pieces_does_not_change_the_error() {
    let bad_statement_later = format!("{SAMPLE}f 1 2 99\nv 1 2\nvn 0 0\n");
    let bad_indices = format!("{SAMPLE}f 1 2 99\nf 1 2 98\n");
    let line = SAMPLE.lines().count();
    for bytes in 1..SAMPLE.len() {
        assert_eq!(
            read(&bad_statement_later, bytes),
            Err(format!("m.obj:{}: a number is missing at the end of the line", line + 2))
        );
        assert_eq!(
            read(&bad_indices, bytes),
            Err(format!("m.obj:{}: the corner `99` names a vertex that does not exist", line + 1))
        );
    }
}
