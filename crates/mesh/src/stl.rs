//! Stereolithography (STL), ASCII and binary, as 3D Systems describe it ("StereoLithography Interface Specification",
//! 1989) and as programs write it.
//!
//! - ASCII: all `solid`s are one mesh; keywords in any case; what else stands after `solid`, `facet` and `outer` does
//!   not matter.
//! - Binary: 80 bytes of anything, the number of triangles, 50 bytes each. Such a file may start with `solid`, too.
//! - Colours that VisCAM, SolidView and Magics hide in the attributes of binary files are passed over: they are of
//!   triangles, and mean different things by program.
//! - Normals are not taken, as they are those of the triangles. Corners with the same bits are one vertex.

use super::builder::{Builder, MOST_VERTICES, check_room, coordinate};
use super::cursor::{Blanks, Cursor, Fault, shown};
use super::data::{MAX_COORDINATE, MeshData};
use super::error::MeshError;
use super::oddities::{Oddities, Oddity};
use rayon::prelude::*;
use std::path::Path;

/// Bytes of a binary file before the number of its triangles, and before the triangles themselves.
const TITLE: usize = 80;
const HEADER: usize = TITLE + 4;

/// Bytes of a triangle: its normal, its corners, and two more.
const TRIANGLE: usize = 50;
const NORMAL: usize = 12;
const CORNER: usize = 12;

/// Reads an STL file.
pub(super) fn read(text: &[u8], path: &Path) -> Result<MeshData, MeshError> {
    let mut oddities = Oddities::default();
    let (facets, mut builder) = if is_text(text) {
        let read = Text::new(text).read(&mut oddities);
        let corners = read.map_err(|fault| MeshError::at_line(path, text, *fault))?;
        (corners.len() / 3, join(corners, f64::from_bits))
    } else {
        let read = read_binary(text, &mut oddities);
        let corners = read.map_err(|fault| MeshError::at_byte(path, *fault))?;
        (corners.len() / 3, join(corners, |bits| f64::from(f32::from_bits(bits))))
    };
    builder.oddities.merge(oddities);
    let found = format!("the file has {facets} facets");
    builder.finish(path, &found)
}

/// Whether a file is ASCII STL. Binary ones may start with the same word, but have the length that they say, or a zero
/// among their first bytes: else they had 2^24 triangles.
fn is_text(text: &[u8]) -> bool {
    const LOOKED_AT: usize = 1024;
    let start = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text).trim_ascii_start();
    let word = start.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    let exact = promised(text).is_some_and(|count| text.len() as u64 == HEADER as u64 + TRIANGLE as u64 * count);
    word.eq_ignore_ascii_case(b"solid") && !exact && !text.iter().take(LOOKED_AT).any(|&byte| byte == 0)
}

/// The number of triangles that a binary file has by its header.
fn promised(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(TITLE..).and_then(<[u8]>::first_chunk)?;
    Some(u64::from(u32::from_le_bytes(*count)))
}

/// The bits of all corners of a binary file, three for each triangle.
fn read_binary(bytes: &[u8], oddities: &mut Oddities) -> Result<Vec<[u32; 3]>, Box<Fault>> {
    const EXPECTED: &str =
        "an STL file: `solid` and its facets, or 80 bytes, the number of triangles, and 50 bytes for each";
    let after = bytes.get(HEADER..).unwrap_or_default();
    let most = (after.len() / TRIANGLE) as u64;
    let count = match promised(bytes) {
        _ if bytes.is_empty() => return Err(Fault::new(0, "the file is empty", EXPECTED)),
        Some(count) if count <= most => count,
        // A binary file has a zero here, a text of another kind has none.
        _ if !bytes.iter().take(HEADER).any(|&byte| byte == 0) => {
            let word = bytes.split(u8::is_ascii_whitespace).find(|word| !word.is_empty()).unwrap_or_default();
            return Err(Fault::new(0, format!("the file starts with {}", shown(word)), EXPECTED));
        }
        Some(count) => {
            check_room(TITLE, count, most, "triangles", after.len())?;
            count
        }
        None => return Err(Fault::new(bytes.len(), "the file ends within its header", EXPECTED)),
    };
    if 3 * count > MOST_VERTICES {
        return Err(Fault::new(TITLE, format!("{count} triangles"), format!("at most {}", MOST_VERTICES / 3)));
    }
    let mut corners = Vec::with_capacity(3 * count as usize);
    let triangles = after.chunks_exact(TRIANGLE).take(count as usize);
    for (triangle, number) in triangles.zip(0..) {
        let three = triangle.get(NORMAL..).unwrap_or_default().as_chunks::<CORNER>().0;
        for (corner, place) in three.iter().zip(0..) {
            let mut bits = [0; 3];
            for ((bits, bytes), axis) in bits.iter_mut().zip(corner.as_chunks::<4>().0).zip(0..) {
                *bits = u32::from_le_bytes(*bytes);
                let value = f32::from_bits(*bits);
                let at = || HEADER + number * TRIANGLE + NORMAL + place * CORNER + axis * 4;
                if !value.is_finite() {
                    let message = format!("`{value}` is not a finite number");
                    return Err(Fault::new(at(), message, "finite coordinates"));
                }
                if f64::from(value.abs()) > MAX_COORDINATE {
                    coordinate(f64::from(value), at())?;
                }
            }
            corners.push(bits);
        }
    }
    oddities.add_many(Oddity::TrailingByte, after.len() as u64 - TRIANGLE as u64 * count);
    Ok(corners)
}

/// An ASCII file.
struct Text<'a> {
    cursor: Cursor<'a>,
    /// The bits of all corners, three for each facet.
    corners: Vec<[u64; 3]>,
}

impl<'a> Text<'a> {
    fn new(text: &'a [u8]) -> Self {
        let mut cursor = Cursor::new(text, Blanks { comma: false, continuation: false });
        if text.starts_with(b"\xef\xbb\xbf") {
            cursor.advance(3);
        }
        Text { cursor, corners: Vec::new() }
    }

    fn read(mut self, oddities: &mut Oddities) -> Result<Vec<[u64; 3]>, Box<Fault>> {
        while self.cursor.find_statement() {
            if self.cursor.word().eq_ignore_ascii_case(b"solid") {
                self.cursor.skip_statement();
                while self.read_facet_or_end()? {}
            } else {
                oddities.add(Oddity::TrailingLine);
                self.cursor.skip_statement();
            }
        }
        Ok(self.corners)
    }

    /// `false` when the solid has ended.
    fn read_facet_or_end(&mut self) -> Result<bool, Box<Fault>> {
        const EXPECTED: &str = "`facet normal x y z` or `endsolid`";
        let start = self.find_line(EXPECTED)?;
        let word = self.cursor.word();
        let facet = word.eq_ignore_ascii_case(b"facet");
        if !facet && !word.eq_ignore_ascii_case(b"endsolid") {
            return Err(Fault::new(start, format!("{} stands in a solid", shown(word)), EXPECTED));
        }
        self.cursor.skip_statement();
        if facet {
            self.read_facet()?;
        }
        Ok(facet)
    }

    /// All after the line `facet`.
    fn read_facet(&mut self) -> Result<(), Box<Fault>> {
        const CORNER: &str = "one of the three corners of a facet: `vertex x y z`";
        self.read_keyword(b"outer", "`outer loop`")?;
        self.cursor.skip_statement();
        for _ in 0..3 {
            let start = self.cursor.at();
            self.read_keyword(b"vertex", CORNER)?;
            let position = self.cursor.position().map_err(|fault| fault.expecting(CORNER))?;
            self.cursor.end_of_line(CORNER)?;
            if self.corners.len() as u64 >= MOST_VERTICES {
                return Err(Fault::new(start, "too many facets", format!("at most {}", MOST_VERTICES / 3)));
            }
            self.corners.push(position.map(f64::to_bits));
        }
        for (word, expected) in [(&b"endloop"[..], "`endloop` after three corners"), (b"endfacet", "`endfacet`")] {
            self.read_keyword(word, expected)?;
            self.cursor.end_of_line(expected)?;
        }
        Ok(())
    }

    /// Steps over the first word of the next line, which must be this one.
    #[inline]
    fn read_keyword(&mut self, keyword: &[u8], expected: &str) -> Result<(), Box<Fault>> {
        let start = self.find_line(expected)?;
        let word = self.cursor.word();
        if word.eq_ignore_ascii_case(keyword) {
            return Ok(());
        }
        Err(Fault::new(start, format!("{} stands in a facet", shown(word)), expected))
    }

    /// The byte of the next line that has something in it.
    #[inline]
    fn find_line(&mut self, expected: &str) -> Result<usize, Box<Fault>> {
        if self.cursor.find_statement() {
            return Ok(self.cursor.at());
        }
        Err(Fault::new(self.cursor.at(), "the file ends within a solid", expected))
    }
}

/// The mesh of triangles with these corners, where corners with the same bits are one vertex. Vertices are in the order
/// in which they come first.
#[expect(clippy::indexing_slicing, reason = "corners are numbered, and numbers of earlier ones looked up")]
fn join<T: Copy + Ord + Send>(corners: Vec<[T; 3]>, value: impl Fn(T) -> f64) -> Builder {
    // Sorted, for a table of hashes can be made slow by a file, and one with a secret is slower.
    let mut sorted: Vec<([T; 3], u32)> = corners.iter().copied().zip(0..).collect();
    sorted.par_sort_unstable();
    // For each corner the first one at its place, and then the number of its vertex.
    let mut vertices = vec![0_u32; corners.len()];
    let mut count = 0;
    for equal in sorted.chunk_by(|a, b| a.0 == b.0) {
        count += 1;
        for &(_, corner) in equal {
            vertices[corner as usize] = equal[0].1;
        }
    }
    drop(sorted);
    let mut builder = Builder::default();
    builder.mesh.positions.reserve_exact(count);
    for (number, corner) in corners.into_iter().enumerate() {
        let first = vertices[number] as usize;
        if first == number {
            vertices[number] = builder.mesh.positions.len() as u32;
            builder.mesh.positions.push(corner.map(&value));
        } else {
            vertices[number] = vertices[first];
        }
    }
    let triangles = vertices.as_chunks::<3>().0;
    builder.mesh.triangles.reserve_exact(triangles.len());
    triangles.iter().for_each(|&triangle| builder.add_triangle(triangle));
    builder
}
