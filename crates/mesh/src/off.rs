//! The Object File Format (OFF), as Geomview's manual describes its ASCII form and as other programs write it.
//!
//! - Header: `OFF` with the prefixes `ST`, `C` and `N`, or none; the counts on its line, glued to it, or on the next;
//!   the number of edges may be missing. `4OFF`, `nOFF` and binary files are refused.
//! - One vertex a line: `x y z`, then the normal (N), the colour (C, or unannounced) and
//!   texture coordinates (ST). Colours are in sRGB, from 0 to 255 where any number of them is above 1, else from 0 to
//!   1, since files of both kinds say the same of themselves; a fourth number of them is passed over.
//! - One face a line: the number of corners, their 0-based indices, and possibly a colour.
//!
//! The counts of the header are only compared with what is there; memory is reserved by the size of the file.

use super::builder::{Builder, MOST_VERTICES, check_room};
use super::colors::Wanted;
use super::cursor::{Blanks, Cursor, Fault, shown};
use super::data::MeshData;
use super::error::MeshError;
use super::oddities::Oddity;
use std::path::Path;

/// Shortest lines of a vertex (`0 0 0`) and a face (`1 0`) with their line break.
const SHORTEST_VERTEX: u64 = 6;
const SHORTEST_FACE: u64 = 4;

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
pub(super) fn read(text: &[u8], path: &Path, wanted: Wanted<'_>) -> Result<MeshData, MeshError> {
    let cursor = Cursor::new(text, Blanks { comma: false, continuation: false });
    let mut reader = Reader { cursor, builder: Builder::default(), wanted };
    let counts = reader.read_all().map_err(|fault| MeshError::at_line(path, text, *fault))?;
    let scale = if reader.builder.largest_color() > 1.0 { 1.0 / 255.0 } else { 1.0 };
    reader.builder.colors_are = (scale, true);
    reader.builder.finish(path, &format!("the file has {} vertices and {} faces", counts.vertices, counts.faces))
}

struct Reader<'a> {
    cursor: Cursor<'a>,
    builder: Builder,
    wanted: Wanted<'a>,
}

impl Reader<'_> {
    fn read_all(&mut self) -> Result<Counts, Box<Fault>> {
        if self.cursor.rest().starts_with(b"\xef\xbb\xbf") {
            self.cursor.advance(3);
        }
        let layout = self.read_keyword()?;
        let counts = self.read_counts()?;
        self.builder.mesh.positions.reserve_exact(counts.vertices);
        for number in 0..counts.vertices {
            self.find_line("vertices", number, counts.vertices)?;
            self.read_vertex(layout)?;
        }
        self.builder.mesh.triangles.reserve_exact(counts.faces);
        let mut corners = Vec::new();
        for number in 0..counts.faces {
            self.find_line("faces", number, counts.faces)?;
            self.read_face(&mut corners)?;
        }
        while self.cursor.find_statement() {
            self.builder.oddities.add(Oddity::TrailingLine);
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
        let vertices = self.cursor.count(EXPECTED)?;
        self.cursor.skip_blanks();
        let faces_at = self.cursor.at();
        let faces = self.cursor.count(EXPECTED)?;
        self.cursor.skip_blanks();
        if !self.cursor.is_at_end_of_statement() {
            self.cursor.count(EXPECTED)?;
        }
        self.cursor.end_of_line(EXPECTED)?;
        // The last line may lack its line break.
        let bytes = self.cursor.rest().len();
        for (at, count, shortest, what) in
            [(vertices_at, vertices, SHORTEST_VERTEX, "vertices"), (faces_at, faces, SHORTEST_FACE, "faces")]
        {
            check_room(at, count, (bytes as u64 + 1) / shortest, what, bytes)?;
        }
        if vertices > MOST_VERTICES {
            return Err(Fault::new(vertices_at, format!("{vertices} vertices"), format!("at most {MOST_VERTICES}")));
        }
        Ok(Counts { vertices: vertices as usize, faces: faces as usize })
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
            Some(3 | 4) if self.wanted.colors => {
                let first = if layout.normal { 3 } else { 0 };
                self.builder.lack_colors(self.builder.mesh.positions.len());
                self.builder.add_color([numbers[first], numbers[first + 1], numbers[first + 2]]);
            }
            Some(3 | 4) => self.builder.oddities.add(Oddity::VertexColor),
            _ => {
                let message = format!("a vertex with {} numbers", 3 + count);
                return Err(Fault::new(self.cursor.at(), message, layout.expected()));
            }
        }
        self.builder.mesh.positions.push(position);
        if layout.normal {
            self.builder.add_normal([numbers[0], numbers[1], numbers[2]]);
        }
        if layout.uv {
            self.builder.add_uv([numbers[count - 2], numbers[count - 1]], self.cursor.at())?;
        }
        self.cursor.skip_statement();
        Ok(())
    }

    fn read_face(&mut self, corners: &mut Vec<u32>) -> Result<(), Box<Fault>> {
        const EXPECTED: &str = "a face on a line of its own: the number of its corners, then their indices";
        let start = self.cursor.at();
        let count = self.cursor.count(EXPECTED)?;
        corners.clear();
        for _ in 0..count {
            self.cursor.skip_blanks();
            let at = self.cursor.at();
            let corner = self.cursor.count(EXPECTED)?;
            corners.push(self.builder.corner(corner as i64, at)?);
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
            self.builder.oddities.add(Oddity::FaceColor);
        }
        self.builder.add_face(corners, start)?;
        self.cursor.skip_statement();
        Ok(())
    }
}
