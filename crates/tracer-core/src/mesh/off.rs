//! The Object File Format (OFF), as Geomview's manual describes its ASCII form and as other programs write it.
//!
//! - Header: `OFF` with the prefixes `ST`, `C` and `N`, or none; the counts on its line, glued to it, or on the next; the
//!   number of edges may be missing. `4OFF`, `nOFF` and binary files are refused.
//! - One vertex a line: `x y z`, then the normal (N), the colour (C, or unannounced) and
//!   texture coordinates (ST).
//! - One face a line: the number of corners, their 0-based indices, and possibly a colour.
//!
//! The counts of the header are only compared with what is there; memory is reserved by the size of the file.

use super::cursor::{Blanks, Cursor, Fault, shown};
use super::normals::unit;
use super::oddities::{Oddities, Oddity};
use super::polygon::{PolygonCutter, TooIntricate, is_degenerate};
use super::{MeshData, MeshError, NO_INDEX};
use std::path::Path;

/// Shortest lines of a vertex (`0 0 0`) and a face (`1 0`) with their line break.
const SHORTEST_VERTEX: u64 = 6;
const SHORTEST_FACE: u64 = 4;

/// Largest number of vertices, so that an index is never mistaken for [`NO_INDEX`].
const MOST_VERTICES: u64 = 1 << 31;

/// What each vertex has besides its position.
#[derive(Clone, Copy, Default)]
struct VertexLayout {
    uv: bool,
    color: bool,
    normal: bool,
}

impl VertexLayout {
    fn expected(self) -> String {
        let mut expected = String::from("a vertex on a line of its own: 3 coordinates");
        for (has, words) in [
            (self.normal, "3 numbers of its normal"),
            (self.color, "3 or 4 numbers of its colour"),
            (self.uv, "2 texture coordinates"),
        ] {
            if has {
                expected += ", ";
                expected += words;
            }
        }
        expected
    }
}

struct Counts {
    vertices: usize,
    faces: usize,
}

/// Reads an OFF file.
pub(super) fn read(text: &[u8], path: &Path) -> Result<MeshData, MeshError> {
    let mut reader = Reader {
        cursor: Cursor::new(text, Blanks { comma: false, continuation: false }),
        mesh: MeshData::default(),
        zero_normals: Vec::new(),
        cutter: PolygonCutter::default(),
        oddities: Oddities::default(),
    };
    let counts = reader.read_all().map_err(|fault| MeshError::at_fault(path, text, *fault))?;
    let Reader { mut mesh, zero_normals, oddities, .. } = reader;
    if mesh.triangles.is_empty() {
        let mut hint = format!("the file has {} vertices and {} faces", counts.vertices, counts.faces);
        let odd = oddities.summary();
        if !odd.is_empty() {
            hint += ": ";
            hint += &odd;
        }
        return Err(MeshError::Empty { path: path.to_owned(), hint });
    }
    if zero_normals.len() == mesh.normals.len() {
        mesh.normals = Vec::new();
    } else if !zero_normals.is_empty() {
        let without = |corner: u32| if zero_normals.binary_search(&corner).is_ok() { NO_INDEX } else { corner };
        mesh.normal_triangles = Some(mesh.triangles.iter().map(|triangle| triangle.map(without)).collect());
    }
    mesh.warnings.extend(oddities.to_warning(path));
    Ok(mesh)
}

struct Reader<'a> {
    cursor: Cursor<'a>,
    mesh: MeshData,
    /// Vertices whose normal has no length, ascending.
    zero_normals: Vec<u32>,
    cutter: PolygonCutter,
    oddities: Oddities,
}

impl Reader<'_> {
    fn read_all(&mut self) -> Result<Counts, Box<Fault>> {
        if self.cursor.rest().starts_with(b"\xef\xbb\xbf") {
            self.cursor.advance(3);
        }
        let layout = self.read_keyword()?;
        let counts = self.read_counts()?;
        self.mesh.positions.reserve_exact(counts.vertices);
        for number in 0..counts.vertices {
            self.find_line("vertices", number, counts.vertices)?;
            self.read_vertex(layout)?;
        }
        self.mesh.triangles.reserve(counts.faces);
        let mut corners = Vec::new();
        for number in 0..counts.faces {
            self.find_line("faces", number, counts.faces)?;
            self.read_face(&mut corners)?;
        }
        while self.cursor.find_statement() {
            self.oddities.add(Oddity::TrailingLine);
            self.cursor.skip_statement();
        }
        Ok(counts)
    }

    fn read_keyword(&mut self) -> Result<VertexLayout, Box<Fault>> {
        const EXPECTED: &str =
            "an ASCII OFF file: `OFF` (COFF, NOFF, STOFF ...), then the numbers of vertices, faces and edges";
        if !self.cursor.find_statement() {
            return Err(Fault::new(self.cursor.at(), "the file is empty", EXPECTED));
        }
        let start = self.cursor.at();
        let mut layout = VertexLayout::default();
        let word = self.cursor.clone().word();
        if word.iter().all(u8::is_ascii_digit) {
            // Geomview takes files without the keyword.
            return Ok(layout);
        }
        let mut rest = word;
        let prefixes: [(&[u8], &mut bool); 3] =
            [(b"ST", &mut layout.uv), (b"C", &mut layout.color), (b"N", &mut layout.normal)];
        for (prefix, flag) in prefixes {
            if let Some(after) = rest.strip_prefix(prefix) {
                *flag = true;
                rest = after;
            }
        }
        // ModelNet has files with the first count glued to the keyword: `OFF490 518 0`.
        match rest.strip_prefix(b"OFF") {
            Some(count) if count.iter().all(u8::is_ascii_digit) => self.cursor.advance(word.len() - count.len()),
            _ if word.ends_with(b"OFF") => {
                return Err(Fault::new(start, format!("{} files are not supported", shown(word)), EXPECTED));
            }
            _ => return Err(Fault::new(start, format!("the file starts with {}", shown(word)), EXPECTED)),
        }
        self.cursor.skip_blanks();
        if self.cursor.rest().starts_with(b"BINARY") {
            return Err(Fault::new(self.cursor.at(), "binary OFF files are not supported", EXPECTED));
        }
        Ok(layout)
    }

    /// The counts, refused when the rest of the file has no room for as many lines.
    fn read_counts(&mut self) -> Result<Counts, Box<Fault>> {
        const EXPECTED: &str = "the numbers of vertices, faces and edges: `8 6 12`";
        if !self.cursor.find_statement() {
            return Err(Fault::new(self.cursor.at(), "the file ends before its counts", EXPECTED));
        }
        let vertices_at = self.cursor.at();
        let vertices = self.read_count(EXPECTED)?;
        self.cursor.skip_blanks();
        let faces_at = self.cursor.at();
        let faces = self.read_count(EXPECTED)?;
        self.cursor.skip_blanks();
        if !self.cursor.is_at_end_of_statement() {
            self.read_count(EXPECTED)?;
        }
        self.expect_end_of_line(EXPECTED)?;
        // The last line may lack its line break.
        let room = self.cursor.rest().len() as u64 + 1;
        for (at, count, shortest, what) in
            [(vertices_at, vertices, SHORTEST_VERTEX, "vertices"), (faces_at, faces, SHORTEST_FACE, "faces")]
        {
            if count > room / shortest {
                let message = format!("the header promises {count} {what}, but the file is too short for them");
                let expected = format!("at most {} {what} in the {} bytes that follow", room / shortest, room - 1);
                return Err(Fault::new(at, message, expected));
            }
        }
        if vertices > MOST_VERTICES {
            return Err(Fault::new(vertices_at, format!("{vertices} vertices"), format!("at most {MOST_VERTICES}")));
        }
        Ok(Counts { vertices: vertices as usize, faces: faces as usize })
    }

    fn read_count(&mut self, expected: &str) -> Result<u64, Box<Fault>> {
        let start = self.cursor.at();
        match self.cursor.integer() {
            Some(count @ 0..) if self.cursor.is_at_end_of_word() => Ok(count.unsigned_abs()),
            _ => Err(self.no_count(start, expected)),
        }
    }

    #[cold]
    fn no_count(&self, start: usize, expected: &str) -> Box<Fault> {
        let mut cursor = self.cursor.clone();
        cursor.go_back_to(start);
        let message = if cursor.is_at_end_of_statement() {
            "a number is missing at the end of the line".to_owned()
        } else {
            format!("{} is not a whole number from 0", shown(cursor.word()))
        };
        Fault::new(start, message, expected)
    }

    fn expect_end_of_line(&mut self, expected: &str) -> Result<(), Box<Fault>> {
        self.cursor.skip_blanks();
        if !self.cursor.is_at_end_of_statement() {
            let at = self.cursor.at();
            return Err(Fault::new(at, format!("{} is too much", shown(self.cursor.word())), expected));
        }
        self.cursor.skip_statement();
        Ok(())
    }

    fn find_line(&mut self, what: &str, number: usize, count: usize) -> Result<(), Box<Fault>> {
        if self.cursor.find_statement() {
            return Ok(());
        }
        let message = format!("the file ends after {number} of {count} {what}");
        Err(Fault::new(self.cursor.at(), message, format!("as many {what} as the header says")))
    }

    #[expect(clippy::indexing_slicing, reason = "no more than MOST numbers are read, and no fewer than are known")]
    fn read_vertex(&mut self, layout: VertexLayout) -> Result<(), Box<Fault>> {
        let expecting = |fault: Box<Fault>| fault.expecting(&layout.expected());
        let position = self.cursor.position().map_err(expecting)?;
        // Position apart: normal, colour, texture coordinates; one more tells a line that is too long.
        const MOST: usize = 3 + 4 + 2;
        let mut numbers = [0.0; MOST + 1];
        let mut count = 0;
        self.cursor.skip_blanks();
        while !self.cursor.is_at_end_of_statement() && count <= MOST {
            numbers[count] = self.cursor.number().map_err(expecting)?;
            count += 1;
            self.cursor.skip_blanks();
        }
        let known = 3 * usize::from(layout.normal) + 2 * usize::from(layout.uv);
        // Many programs write colours without saying C.
        match count.checked_sub(known) {
            Some(0) if !layout.color => {}
            Some(3 | 4) => self.oddities.add(Oddity::VertexColor),
            _ => {
                let message = format!("a vertex with {} numbers", 3 + count);
                return Err(Fault::new(self.cursor.at(), message, layout.expected()));
            }
        }
        let index = self.mesh.positions.len() as u32;
        self.mesh.positions.push(position);
        if layout.normal {
            let normal = unit([numbers[0], numbers[1], numbers[2]]);
            if normal.is_none() {
                self.zero_normals.push(index);
                self.oddities.add(Oddity::ZeroNormal);
            }
            self.mesh.normals.push(normal.unwrap_or_default());
        }
        if layout.uv {
            let uv = [numbers[count - 2] as f32, numbers[count - 1] as f32];
            if !uv.iter().all(|coordinate| coordinate.is_finite()) {
                return Err(Fault::new(self.cursor.at(), "a texture coordinate is too large", "at most 3.4e38"));
            }
            self.mesh.uvs.push(uv);
        }
        self.cursor.skip_statement();
        Ok(())
    }

    fn read_face(&mut self, corners: &mut Vec<u32>) -> Result<(), Box<Fault>> {
        const EXPECTED: &str = "a face on a line of its own: the number of its corners, then their indices";
        let start = self.cursor.at();
        let count = self.read_count(EXPECTED)?;
        let vertices = self.mesh.positions.len();
        corners.clear();
        for _ in 0..count {
            self.cursor.skip_blanks();
            let at = self.cursor.at();
            let corner = self.read_count(EXPECTED)?;
            if corner >= vertices as u64 {
                let expected = match vertices {
                    0 => "no face in a file without vertices".to_owned(),
                    _ => format!("an index from 0 to {}, as the file has {vertices} vertices", vertices - 1),
                };
                return Err(Fault::new(at, format!("there is no vertex {corner}"), expected));
            }
            corners.push(corner as u32);
        }
        self.cursor.skip_blanks();
        let mut color = 0;
        while !self.cursor.is_at_end_of_statement() {
            let at = self.cursor.at();
            if color == 4 {
                let message = format!("{} is too much after a face of {count} corners", shown(self.cursor.word()));
                return Err(Fault::new(at, message, "at most 4 numbers of a colour"));
            }
            self.cursor.number().map_err(|fault| fault.expecting("nothing more, or a colour"))?;
            color += 1;
            self.cursor.skip_blanks();
        }
        if color > 0 {
            self.oddities.add(Oddity::FaceColor);
        }
        self.add_polygon(corners, start)?;
        self.cursor.skip_statement();
        Ok(())
    }

    #[expect(clippy::indexing_slicing, reason = "the reader of faces has checked every index")]
    fn add_polygon(&mut self, corners: &[u32], start: usize) -> Result<(), Box<Fault>> {
        let MeshData { positions, triangles, .. } = &mut self.mesh;
        let position = |corner: u32| positions[corner as usize];
        match *corners {
            [] | [_] | [_, _] => self.oddities.add(Oddity::SmallFace),
            [a, b, c] => {
                if is_degenerate([a, b, c].map(position)) {
                    self.oddities.add(Oddity::DegenerateTriangle);
                } else {
                    triangles.push([a, b, c]);
                }
            }
            _ => {
                let cut = self
                    .cutter
                    .cut(corners.iter().map(|&corner| position(corner)))
                    .map_err(|TooIntricate| TooIntricate::fault(start, corners.len()))?;
                triangles.extend(cut.triangles.iter().map(|triangle| triangle.map(|number| corners[number as usize])));
                self.oddities.add_many(Oddity::DegenerateTriangle, (corners.len() - 2 - cut.triangles.len()) as u64);
                self.oddities.add_many(Oddity::CrossingPolygon, u64::from(cut.crossing));
            }
        }
        Ok(())
    }
}
