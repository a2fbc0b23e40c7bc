//! Placements files: many copies of a mesh, as text with one placement a line.
//!
//! Numbers are parted by blanks or commas, `#` starts a comment, empty lines are passed over. How many numbers a line
//! has says what they are:
//!
//! | numbers | placement |
//! | --- | --- |
//! | 3 | translation x, y, z |
//! | 4 | translation, then one factor of scale |
//! | 8 | translation, factor of scale, axis of rotation (3, of any length), angle in degrees |
//! | 12 | an affine matrix, 3 rows of 4: each row's last number is the translation |
//!
//! A placement scales, then rotates, then moves, all about the origin. (Where a mesh is to turn about its own
//! barycentre, the caller moves the barycentre to the origin first.)

use super::cursor::{Blanks, Cursor, Fault, shown};
use super::data::MAX_COORDINATE;
use super::files::{FileError, read_regular_file};
use glam::{DAffine3, DMat3, DVec3};
use rayon::prelude::*;
use scene_format::Diagnostic;
use scene_format::codes;
use scene_format::diagnostic::{Excerpt, Span};
use std::path::{Path, PathBuf};

const BLANKS: Blanks = Blanks { comma: true, continuation: false };

const EXPECTED: &str =
    "3 numbers (translation), 4 (and a scale), 8 (and an axis and degrees) or 12 (a 3x4 matrix by rows)";

/// Below this share of the largest volume that columns of the same lengths could span, a matrix counts as singular: the
/// rounding of its numbers decides whether it can be inverted.
const SINGULAR: f64 = 1e-12;

/// Bytes of a piece that one thread reads.
const PIECE: usize = 1 << 18;

/// Why placements could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum PlacementsError {
    /// The file could not be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A line is wrong.
    #[error("{}:{line}: {message}", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// 1-based line.
        line: u64,
        /// What is wrong.
        message: String,
        /// What was expected.
        expected: String,
        /// What to do; nothing where that is not known.
        hint: &'static str,
        /// The line, with what is meant of it, where it can be shown.
        excerpt: Option<Box<Excerpt>>,
    },
    /// The file has no placement.
    #[error("{}: the file has no placements", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
}

impl PlacementsError {
    /// The diagnostic at `span` of the scene file: `E0501`, `E0502`, or `E0530` (the placements are wrong).
    pub fn to_diagnostic(&self, span: Span) -> Diagnostic {
        match self {
            PlacementsError::File(error) => error.to_diagnostic(span),
            PlacementsError::Broken { path, line, message, expected, hint, excerpt } => {
                Diagnostic::error(codes::BROKEN_PLACEMENTS, span, format!("the placements file is broken: {message}"))
                    .expected(expected.clone())
                    .hint(*hint)
                    .at_line(path, *line)
                    .showing(excerpt.as_deref().cloned())
            }
            PlacementsError::Empty { path } => {
                Diagnostic::error(codes::BROKEN_PLACEMENTS, span, self.to_string()).expected(EXPECTED).at_line(path, 0)
            }
        }
    }
}

/// Reads the placements in `path`, in the order of its lines.
///
/// # Errors
/// When there is no such file or it cannot be read, when a line is no placement (numbers that are not finite, of
/// another count, a scale or matrix that is singular, an axis of length zero), and when there is none.
pub fn load_placements(path: &Path) -> Result<Vec<DAffine3>, PlacementsError> {
    parse_placements(&read_regular_file(path)?, path)
}

/// Reads placements from the bytes of their file; `path` is what messages show.
///
/// # Errors
/// As [`load_placements`].
#[expect(clippy::indexing_slicing, reason = "the pieces are ranges of the text itself")]
pub fn parse_placements(text: &[u8], path: &Path) -> Result<Vec<DAffine3>, PlacementsError> {
    let pieces = pieces_at_line_breaks(text);
    let counts: Vec<usize> = pieces.par_iter().map(|piece| count_lines(&text[piece.clone()])).collect();
    // Read straight into place: a copy of 96 bytes for each short line would be the larger part of the memory.
    let mut placements = vec![DAffine3::IDENTITY; counts.iter().sum()];
    let mut rest = &mut placements[..];
    let mut parts = Vec::with_capacity(pieces.len());
    for (piece, count) in pieces.into_iter().zip(counts) {
        let (part, after) = rest.split_at_mut(count);
        parts.push((piece, part));
        rest = after;
    }
    let faults: Vec<Option<Box<Fault>>> = parts
        .into_par_iter()
        .map(|(piece, part)| {
            let mut cursor = Cursor::new(&text[piece.clone()], BLANKS);
            for slot in part {
                cursor.find_statement();
                match parse_line(&mut cursor) {
                    Ok(placement) => *slot = placement,
                    Err(mut fault) => {
                        fault.at += piece.start;
                        return Some(fault);
                    }
                }
                cursor.skip_statement();
            }
            None
        })
        .collect();
    if let Some(fault) = faults.into_iter().flatten().next() {
        let (line, excerpt) = (fault.line_in(text), Excerpt::around(text, fault.at).map(Box::new));
        let hint = hint(&fault, text);
        let Fault { message, expected, .. } = *fault;
        return Err(PlacementsError::Broken { path: path.to_owned(), line, message, expected, hint, excerpt });
    }
    if placements.is_empty() {
        return Err(PlacementsError::Empty { path: path.to_owned() });
    }
    Ok(placements)
}

/// What to do about a line of a table that other programs write.
fn hint(fault: &Fault, text: &[u8]) -> &'static str {
    let before = text.get(..fault.at).unwrap_or_default();
    let line = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |line_break| line_break + 1);
    let (above, begin) = before.split_at(line);
    let first = || count_lines(above) == 0 && begin.iter().all(|byte| b" \t\xef\xbb\xbf".contains(byte));
    if fault.message.ends_with("is not a number") && first() {
        return "names of columns stand in a comment: begin that line with `#`, or leave it out";
    }
    match &*fault.message {
        "a placement with 5 numbers" | "a placement with 6 numbers" | "a placement with 7 numbers" => {
            "of a table with more columns keep x, y, z and a factor of the size; colours by a column are a Repeat over \
             lists in `vars`, each item with its own material"
        }
        _ => "",
    }
}

fn pieces_at_line_breaks(text: &[u8]) -> Vec<std::ops::Range<usize>> {
    let mut pieces = Vec::new();
    let mut start = if text.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    while start < text.len() {
        let after = text.get(start + PIECE..).unwrap_or_default();
        let end = match after.iter().position(|&byte| byte == b'\n') {
            Some(line_break) => start + PIECE + line_break + 1,
            None => text.len(),
        };
        pieces.push(start..end);
        start = end;
    }
    pieces
}

fn count_lines(text: &[u8]) -> usize {
    let mut cursor = Cursor::new(text, BLANKS);
    let mut count = 0;
    while cursor.find_statement() {
        count += 1;
        cursor.skip_statement();
    }
    count
}

fn parse_line(cursor: &mut Cursor) -> Result<DAffine3, Box<Fault>> {
    let start = cursor.at();
    let mut numbers = [0.0; 12];
    let mut count = 0;
    while !cursor.is_at_end_of_statement() {
        let at = cursor.at();
        let Some(number) = numbers.get_mut(count) else {
            return Err(Fault::new(at, "a placement with more than 12 numbers", EXPECTED));
        };
        *number = cursor.number().map_err(|fault| fault.expecting(EXPECTED))?;
        if number.abs() > MAX_COORDINATE {
            let mut again = cursor.clone();
            again.go_back_to(at);
            let message = format!("the number {} is too large", shown(again.word()));
            return Err(Fault::new(at, message, format!("a magnitude of at most {MAX_COORDINATE:e}")));
        }
        count += 1;
        cursor.skip_blanks();
    }
    let [x, y, z, scale, axis @ .., degrees, _, _, _, _] = numbers;
    let axis = DVec3::from_array(axis);
    let matrix = match count {
        3 => DMat3::IDENTITY,
        4 => DMat3::from_diagonal(DVec3::splat(scale)),
        8 if axis == DVec3::ZERO => {
            return Err(Fault::new(start, "the axis of rotation has no length", "an axis such as `0 1 0`"));
        }
        8 => rotation(axis, degrees) * scale,
        12 => {
            let [a, b, c, _, d, e, f, _, g, h, i, _] = numbers;
            DMat3::from_cols_array(&[a, d, g, b, e, h, c, f, i])
        }
        _ => return Err(Fault::new(start, format!("a placement with {count} numbers"), EXPECTED)),
    };
    let translation = if count == 12 { [numbers[3], numbers[7], numbers[11]] } else { [x, y, z] };
    if is_singular(matrix) {
        let message = if count == 12 { "the matrix is singular" } else { "the scale is zero" };
        return Err(Fault::new(start, message, "a placement that keeps the mesh three-dimensional"));
    }
    Ok(DAffine3::from_mat3_translation(matrix, DVec3::from_array(translation)))
}

fn is_singular(matrix: DMat3) -> bool {
    // By the directions of the columns, so that the size of the numbers does not matter.
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|column| {
        let largest = column.abs().max_element();
        if largest > 0.0 { (column / largest).normalize() } else { DVec3::ZERO }
    });
    columns[0].cross(columns[1]).dot(columns[2]).abs() <= SINGULAR
}

/// The rotation about an axis of any length but zero, by the right-hand rule (Rodrigues' formula).
///
/// The same bits on every machine, and exact for multiples of 90 degrees about a coordinate axis.
pub fn rotation(axis: DVec3, degrees: f64) -> DMat3 {
    let axis = axis / axis.abs().max_element();
    let axis = axis / axis.dot(axis).sqrt();
    // Into -45 to 45 degrees and a quarter turn: the remainder of degrees is exact, that of radians is not.
    let turn = degrees % 360.0;
    let quarter = (turn / 90.0).round();
    let radians = (turn - 90.0 * quarter).to_radians();
    let (s, c) = (libm::sin(radians), libm::cos(radians));
    let (sin, cos) = match (quarter as i64).rem_euclid(4) {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    };
    let outer = DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z);
    let cross = DMat3::from_cols(
        DVec3::new(0.0, axis.z, -axis.y),
        DVec3::new(-axis.z, 0.0, axis.x),
        DVec3::new(axis.y, -axis.x, 0.0),
    );
    DMat3::from_diagonal(DVec3::splat(cos)) + cross * sin + outer * (1.0 - cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Vec<DAffine3>, PlacementsError> {
        parse_placements(text.as_bytes(), Path::new("p.txt"))
    }

    #[test]
    fn lines_of_each_kind_place_a_point() {
        let text = "# copies\r\n1 2 3\n\n1,2,3,2 # twice as large\n1 2 3 2 0 0 5 90\n1 0 0 10, 0 0 -1 20, 0 1 0 30";
        let placements = parse(text).expect("placements");
        let moved: Vec<[f64; 3]> =
            placements.iter().map(|p| p.transform_point3(DVec3::new(1.0, 0.0, 0.5)).to_array()).collect();
        assert_eq!(moved, [[2.0, 2.0, 3.5], [3.0, 2.0, 4.0], [1.0, 4.0, 4.0], [11.0, 19.5, 30.0]]);
    }

    #[test]
    fn rotations_are_exact_at_quarters_and_right_between() {
        assert_eq!(rotation(DVec3::Y, 90.0) * DVec3::Z, DVec3::X);
        assert_eq!(rotation(DVec3::X * 1e200, -270.0) * DVec3::Y, DVec3::Z);
        assert_eq!(rotation(DVec3::NEG_Z, 360.0 * 1e6 + 180.0) * DVec3::X, DVec3::NEG_X);
        let axis = DVec3::new(1.0, -2.0, 3.0);
        let third = rotation(axis, 30.0);
        // Twelve times 30 degrees is a full turn; the axis stays; right angles stay. Rounding only.
        let full = (0..12).fold(DMat3::IDENTITY, |m, _| third * m);
        assert!(full.abs_diff_eq(DMat3::IDENTITY, 1e-14));
        assert!((third * axis).abs_diff_eq(axis, 1e-14));
        assert!((third * third.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-15));
        assert!((third.x_axis.x - (1.0 / 14.0 + 13.0 / 14.0 * 0.75_f64.sqrt())).abs() < 1e-15);
    }

    #[test]
    fn wrong_lines_are_named() {
        for (text, expected) in [
            ("1 2 3\n1 2\n", "p.txt:2: a placement with 2 numbers"),
            ("# c\n\n1 2 x\n", "p.txt:3: `x` is not a number"),
            ("1 2 nan\n", "p.txt:1: `nan` is not a finite number"),
            ("1 2 1e31\n", "p.txt:1: the number `1e31` is too large"),
            ("1 2 3 0\n", "p.txt:1: the scale is zero"),
            ("1 2 3 1 0 0 0 90\n", "p.txt:1: the axis of rotation has no length"),
            ("1 2 3 0 4 5 6 0 7 8 9 0", "p.txt:1: the matrix is singular"),
            ("0 0 0 0 0 1 0 0 0 0 1 0", "p.txt:1: the matrix is singular"),
            ("1 2 3 4 5 6 7 8 9 10 11 12 13", "p.txt:1: a placement with more than 12 numbers"),
            ("# nothing\n \n", "p.txt: the file has no placements"),
            ("", "p.txt: the file has no placements"),
        ] {
            assert_eq!(parse(text).expect_err(text).to_string(), expected);
        }
    }

    #[test]
    fn tables_of_other_programs_are_told_what_to_do() {
        let hint = |text: &str| match parse(text).expect_err(text) {
            PlacementsError::Broken { hint, .. } => hint,
            other => panic!("{other}"),
        };
        for header in ["x,y,z\n1,2,3\n", "# made by p\n\n \"x\" \"y\"\n", "\u{feff}x y z\n"] {
            assert!(hint(header).contains("begin that line with `#`"), "{header}");
        }
        assert_eq!(hint("1 2 3\nx y z\n"), "");
        assert_eq!(hint("1 2 x\n"), "");
        assert!(hint("1,2,3,0.5,7\n").contains("keep x, y, z"));
        assert_eq!(hint("1 2\n"), "");
    }

    /// Over several pieces: the order is that of the lines, and of two faults the first is told.
    #[test]
    fn pieces_keep_order_and_lines() {
        let mut text: String = (0..50_000).map(|i| format!("{i} 0 0 # {i}\n\n")).collect();
        assert!(text.len() > 3 * PIECE);
        let placements = parse(&text).expect("placements");
        assert!(placements.iter().zip(0..50_000).all(|(p, i)| p.translation.x == f64::from(i)));
        assert_eq!(placements.len(), 50_000);
        for line in [49_000, 30_001] {
            let at = text.match_indices('\n').nth(line - 2).expect("line").0 + 1;
            text.insert_str(at, "bad ");
            assert_eq!(parse(&text).expect_err("bad").to_string(), format!("p.txt:{line}: `bad` is not a number"));
        }
    }

    #[test]
    fn singular_is_a_matter_of_shape_and_not_of_size() {
        let tiny = "1e-25 0 0 0 0 1e20 0 0 0 0 1 0";
        assert_eq!(parse(tiny).expect("placements").len(), 1);
        // Rows 1 2 3 / 4 5 6 / 7 8 9.0000001: nearly flat, but not by rounding.
        assert_eq!(parse("1 2 3 0 4 5 6 0 7 8 9.0000001 0").expect("placements").len(), 1);
    }
}
