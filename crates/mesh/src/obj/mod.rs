//! Wavefront OBJ, as the specification of Advanced Visualizer 4.2 (appendix B1) describes polygons, and as programs
//! write it.
//!
//! - `v` with 3 coordinates, a weight (ignored, counted), a colour (sRGB from 0 to 1), or both; `vt` with 1 to 3
//!   numbers; `vn`.
//! - `f` (and the old `fo`) in all forms of corners: `1`, `1/2`, `1//3`, `1/2/3`, counted from 1, or back from here if
//!   negative. Faces may name vertices that come later in the file.
//! - `mtllib` and `usemtl`; `s` is read over: normals come from `vn` alone. `o` and `g` name parts, of which one may be
//!   wanted alone: `o` says which object the faces after it are of, until the next `o`, and `g` which groups they are
//!   in, one or several, until the next `g`.
//! - `l`, `p` and all other statements are counted in one warning.
//! - A backslash at the end of a line goes on in the next one.
//!
//! The text is cut into pieces of fixed size at line breaks; the pieces are parsed in parallel, and joined in their
//! order. Of several faults in a file, the first bad statement is told, and a bad index only when there is none.

mod assemble;
mod piece;

use super::colors::Wanted;
use super::cursor::{Fault, shown};
use super::data::MeshData;
use super::error::MeshError;
use super::files::Files;
use super::oddities::{Oddities, Oddity};
use super::parts;
use assemble::Assembly;
use piece::{Piece, names_of_parts};
use rayon::prelude::*;
use std::path::Path;

/// Bytes of a piece, at least: enough to hide the cost of joining, few enough to keep all cores busy.
const PIECE: usize = 1 << 20;

/// Largest number of vertices, texture coordinates or normals: indices have 31 bits.
const MOST: usize = 1 << 31;

/// Reads an OBJ file.
pub(super) fn read(text: &[u8], from: (&Path, &Files), wanted: Wanted<'_>) -> Result<MeshData, MeshError> {
    read_in_pieces(text, from, wanted, PIECE)
}

fn read_in_pieces(
    text: &[u8],
    (path, files): (&Path, &Files),
    wanted: Wanted<'_>,
    piece_bytes: usize,
) -> Result<MeshData, MeshError> {
    if let Some(fault) = foreign_encoding(text) {
        return Err(MeshError::at_line(path, text, *fault));
    }
    let parse = |part| Piece::parse(text, part, wanted);
    let pieces: Vec<Piece> = cut(text, piece_bytes).into_par_iter().map(parse).collect();
    let mut oddities = Oddities::default();
    let mut good = Vec::with_capacity(pieces.len());
    for mut piece in pieces {
        if let Some(fault) = piece.fault {
            return Err(MeshError::at_line(path, text, *fault));
        }
        oddities.merge(std::mem::take(&mut piece.oddities));
        good.push(piece);
    }
    let mut assembly = Assembly::new(good).map_err(|fault| MeshError::at_line(path, text, *fault))?;
    if let Some(part) = wanted.part
        && !assembly.keep_part()
    {
        return Err(parts::unknown(path, part, names_of_parts(text), "objects and groups"));
    }
    let mesh = assembly.into_mesh(text, (path, files), &mut oddities)?;
    if mesh.triangles.is_empty() {
        let odd = oddities.summary();
        let hint = match mesh.positions.len() {
            _ if let Some(part) = wanted.part => {
                let part = shown(part.as_bytes());
                if odd.is_empty() {
                    format!("the part {part} has no faces (`f`)")
                } else {
                    format!("the part {part}; {odd}")
                }
            }
            0 if odd.is_empty() => "the file has no vertices (`v`)".to_owned(),
            0 => format!("the file has no vertices (`v`); is it an OBJ file? {odd}"),
            count if odd.is_empty() => format!("the file has {count} vertices and no faces (`f`)"),
            count => format!("the file has {count} vertices; {odd}"),
        };
        return Err(MeshError::Empty { path: path.to_owned(), hint });
    }
    let mut mesh = mesh;
    // The mesh's own warning comes before that of its materials.
    mesh.warnings.splice(0..0, oddities.to_warning(path));
    Ok(mesh)
}

/// A fault when the file is UTF-16 or binary, which would else look like nonsense.
#[expect(clippy::indexing_slicing, reason = "cut to the text's length")]
fn foreign_encoding(text: &[u8]) -> Option<Box<Fault>> {
    let message = match text {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "the file is UTF-16 text",
        _ if text[..text.len().min(1024)].contains(&0) => "the file is binary",
        _ => return None,
    };
    Some(Fault::new(0, message, "an OBJ file: UTF-8 text of statements such as `v 0 1 0` and `f 1 2 3`"))
}

/// Cuts a text into parts of at least `bytes` bytes that end with a statement.
#[expect(clippy::indexing_slicing, reason = "places found in the text itself")]
fn cut(text: &[u8], bytes: usize) -> Vec<std::ops::Range<usize>> {
    let mut parts = Vec::new();
    let mut start = if text.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    while start < text.len() {
        let mut end = start + bytes;
        loop {
            match text.get(end..).and_then(|rest| rest.iter().position(|&byte| byte == b'\n')) {
                None => end = text.len(),
                Some(line_break) => {
                    end += line_break + 1;
                    let line = &text[..end - 1];
                    if line.strip_suffix(b"\r").unwrap_or(line).ends_with(b"\\") {
                        continue;
                    }
                }
            }
            break;
        }
        parts.push(start..end);
        start = end;
    }
    parts
}

#[cfg(test)]
mod tests;
