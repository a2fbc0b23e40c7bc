//! One piece of an OBJ file, parsed on its own: what it says, with indices still relative to the piece.

use crate::coloring::NO_COLOR;
use crate::colors::Wanted;
use crate::cursor::{Blanks, Cursor, Fault, shown};
use crate::normals::unit;
use crate::oddities::{Oddities, Oddity};
use std::ops::Range;

/// Most corners of one face.
const MOST_CORNERS: usize = 1 << 24;

const VERTEX: &str = "a vertex: `v x y z`, possibly with a weight or a colour (3, 4, 6 or 7 numbers)";
const UV: &str = "texture coordinates: `vt u v` (1 to 3 numbers)";
const NORMAL: &str = "a vertex normal: `vn x y z`";
const FACE: &str =
    "a face of 3 or more corners: `f 1 2 3`, `f 1/1 2/2 3/3`, `f 1//1 2//2 3//3` or `f 1/1/1 2/2/2 3/3/3`";

pub(super) const OBJ_BLANKS: Blanks = Blanks { comma: false, continuation: true };

/// An index before the sizes of the earlier pieces are known.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct RawIndex(u32);

impl RawIndex {
    /// The corner has none.
    pub(super) const NONE: RawIndex = RawIndex(u32::MAX);

    /// Set: counted from the piece's first element, plus `BIAS` (it may lie in an earlier piece). Clear: from the
    /// file's.
    const RELATIVE: u32 = 1 << 31;
    const BIAS: i64 = 1 << 30;

    /// From the number in the file, where the piece has `count` elements so far; `None` when it is out of any range.
    fn new(number: i64, count: usize) -> Option<RawIndex> {
        if number > 0 {
            u32::try_from(number - 1).ok().filter(|index| index & Self::RELATIVE == 0).map(RawIndex)
        } else {
            let place = (count as i64).saturating_add(number).saturating_add(Self::BIAS);
            let place = u32::try_from(place).ok().filter(|&place| place < Self::RELATIVE - 1)?;
            Some(RawIndex(Self::RELATIVE | place))
        }
    }

    /// The index from the file's first element, where `before` elements lie in earlier pieces and `total` in all;
    /// `None` when there is no such element.
    #[inline]
    pub(super) fn resolve(self, before: usize, total: usize) -> Option<u32> {
        let index = if self.0 & Self::RELATIVE == 0 {
            i64::from(self.0)
        } else {
            before as i64 + i64::from(self.0 & !Self::RELATIVE) - Self::BIAS
        };
        (0..total as i64).contains(&index).then_some(index as u32)
    }
}

/// From `usemtl` on, faces have this material.
pub(super) struct MaterialSwitch<'a> {
    /// Number of the first face, counted in the piece.
    pub(super) first_face: usize,
    pub(super) name: &'a str,
}

/// From `o` or `g` on, faces are in the wanted part by it, or are not.
#[derive(Clone, Copy)]
pub(super) struct PartSwitch {
    /// Number of the first face, counted in the piece.
    pub(super) first_face: u32,
    /// It says which object faces are of, not which groups.
    pub(super) is_object: bool,
    pub(super) is_part: bool,
}

/// What a piece says.
#[derive(Default)]
pub(super) struct Piece<'a> {
    /// Where it lies in the file.
    pub(super) range: Range<usize>,
    pub(super) positions: Vec<[f64; 3]>,
    /// As many as positions, or none when no vertex has any.
    pub(super) colors: Vec<[f32; 3]>,
    pub(super) uvs: Vec<[f32; 2]>,
    /// Of unit length, or zero.
    pub(super) normals: Vec<[f32; 3]>,
    /// Corners of all faces, one after the other.
    pub(super) corners: Vec<RawIndex>,
    /// As long as `corners`, or empty when no corner has any.
    pub(super) uv_corners: Vec<RawIndex>,
    /// As long as `corners`, or empty when no corner has any.
    pub(super) normal_corners: Vec<RawIndex>,
    /// Where each face's corners end.
    pub(super) face_ends: Vec<u32>,
    pub(super) switches: Vec<MaterialSwitch<'a>>,
    /// Where a part is wanted: the statements that change whether faces are in it.
    pub(super) part_switches: Vec<PartSwitch>,
    /// Where a part is wanted: which of the faces of the text are left.
    face_numbers: Option<Vec<u32>>,
    pub(super) libraries: Vec<&'a str>,
    pub(super) oddities: Oddities,
    /// The first fault; nothing after it was parsed. It counts bytes in the file.
    pub(super) fault: Option<Box<Fault>>,
}

impl<'a> Piece<'a> {
    /// Parses a part of the file that holds whole statements.
    #[expect(clippy::indexing_slicing, reason = "the range is one of the text's own parts")]
    pub(super) fn parse(text: &'a [u8], range: Range<usize>, wanted: Wanted<'_>) -> Piece<'a> {
        let mut piece = Piece { range: range.clone(), ..Piece::default() };
        let mut cursor = Cursor::new(&text[range.clone()], OBJ_BLANKS);
        if let Err(mut fault) = piece.parse_statements(&mut cursor, wanted) {
            fault.at += range.start;
            piece.fault = Some(fault);
        }
        if !piece.colors.is_empty() {
            piece.colors.resize(piece.positions.len(), NO_COLOR);
            piece.colors.shrink_to_fit();
        }
        // What grew by doubling is kept until all pieces are joined.
        piece.positions.shrink_to_fit();
        piece.uvs.shrink_to_fit();
        piece.normals.shrink_to_fit();
        piece.corners.shrink_to_fit();
        piece.uv_corners.shrink_to_fit();
        piece.normal_corners.shrink_to_fit();
        piece
    }

    /// Gives back the memory of faces that have become triangles.
    pub(super) fn forget_faces(&mut self) {
        self.corners = Vec::new();
        self.uv_corners = Vec::new();
        self.normal_corners = Vec::new();
        self.face_ends = Vec::new();
    }

    fn parse_statements(&mut self, cursor: &mut Cursor<'a>, wanted: Wanted<'_>) -> Result<(), Box<Fault>> {
        while cursor.find_statement() {
            match cursor.word() {
                b"v" => self.parse_vertex(cursor, wanted)?,
                b"f" | b"fo" => self.parse_face(cursor)?,
                b"vt" => self.parse_uv(cursor)?,
                b"vn" => self.parse_normal(cursor)?,
                b"usemtl" => {
                    let name = parse_name(cursor, "the name of a material: `usemtl NAME`")?;
                    self.switches.push(MaterialSwitch { first_face: self.face_ends.len(), name });
                }
                b"mtllib" => self.libraries.push(parse_name(cursor, "the name of an MTL file: `mtllib FILE.mtl`")?),
                word @ (b"g" | b"o") => {
                    if let Some(part) = wanted.part {
                        self.enter(word == b"o", cursor.name(), part);
                    }
                }
                b"s" => {}
                b"l" => self.oddities.add(Oddity::LineElement),
                b"p" => self.oddities.add(Oddity::PointElement),
                word => self.oddities.add_statement(word),
            }
            cursor.skip_statement();
        }
        Ok(())
    }

    /// Faces that follow are of an object, or in groups, of this name.
    fn enter(&mut self, is_object: bool, name: &[u8], part: &str) {
        let is_part = is_named(is_object, name, part);
        let last = self.part_switches.iter().rev().take(2).find(|switch| switch.is_object == is_object);
        if last.is_none_or(|last| last.is_part != is_part) {
            self.part_switches.push(PartSwitch { first_face: self.face_ends.len() as u32, is_object, is_part });
        }
    }

    /// Leaves the faces in these ranges alone; they are in order.
    #[expect(clippy::indexing_slicing, reason = "ranges of the piece's faces, which end within its corners")]
    pub(super) fn keep_faces(&mut self, kept: &[Range<usize>]) {
        let numbers: Vec<u32> = kept.iter().flat_map(|run| run.start as u32..run.end as u32).collect();
        let begin = |face: usize| face.checked_sub(1).map_or(0, |last| self.face_ends[last] as usize);
        let mut face_ends = Vec::with_capacity(numbers.len());
        let mut corners = 0;
        for &face in &numbers {
            corners += self.face_ends[face as usize] as usize - begin(face as usize);
            face_ends.push(corners as u32);
        }
        let of_kept = |all: &[RawIndex]| -> Vec<RawIndex> {
            if all.is_empty() {
                return Vec::new();
            }
            let runs = kept.iter().filter(|run| !run.is_empty()).map(|run| &all[begin(run.start)..begin(run.end)]);
            runs.flatten().copied().collect()
        };
        let attribute = |all: &[RawIndex]| {
            let left = of_kept(all);
            // As long as the corners, or empty when no corner has any.
            if left.iter().all(|&index| index == RawIndex::NONE) { Vec::new() } else { left }
        };
        let (uvs, normals) = (attribute(&self.uv_corners), attribute(&self.normal_corners));
        self.corners = of_kept(&self.corners);
        (self.uv_corners, self.normal_corners, self.face_ends) = (uvs, normals, face_ends);
        for switch in &mut self.switches {
            switch.first_face = numbers.partition_point(|&face| (face as usize) < switch.first_face);
        }
        self.face_numbers = Some(numbers);
    }

    fn parse_vertex(&mut self, cursor: &mut Cursor, wanted: Wanted<'_>) -> Result<(), Box<Fault>> {
        let position = cursor.position().map_err(|fault| fault.expecting(VERTEX))?;
        self.positions.push(position);
        cursor.skip_blanks();
        if !cursor.is_at_end_of_statement() {
            self.parse_weight_and_color(cursor, wanted)?;
        }
        Ok(())
    }

    fn parse_weight_and_color(&mut self, cursor: &mut Cursor, wanted: Wanted<'_>) -> Result<(), Box<Fault>> {
        let start = cursor.at();
        let mut numbers = [0.0; 4];
        let mut count = 0;
        while !cursor.is_at_end_of_statement() {
            let Some(number) = numbers.get_mut(count) else {
                return Err(too_much(cursor, VERTEX));
            };
            *number = cursor.number().map_err(|fault| fault.expecting(VERTEX))?;
            count += 1;
            cursor.skip_blanks();
        }
        if count == 2 {
            return Err(Fault::new(start, "a vertex with 5 numbers", VERTEX));
        }
        if matches!(count, 1 | 4) && numbers[0] != 1.0 {
            self.oddities.add(Oddity::Weight);
        }
        let [a, b, c, d] = numbers;
        match count {
            0 | 1 => {}
            _ if !wanted.colors => self.oddities.add(Oddity::VertexColor),
            _ => {
                // This vertex is there already.
                self.colors.resize(self.positions.len() - 1, NO_COLOR);
                self.colors.push(if count == 3 { [a, b, c] } else { [b, c, d] }.map(|x| x as f32));
            }
        }
        Ok(())
    }

    fn parse_uv(&mut self, cursor: &mut Cursor) -> Result<(), Box<Fault>> {
        let mut numbers = [0.0_f32; 3];
        for count in 0.. {
            cursor.skip_blanks();
            if count > 0 && cursor.is_at_end_of_statement() {
                break;
            }
            let start = cursor.at();
            let Some(number) = numbers.get_mut(count) else {
                return Err(too_much(cursor, UV));
            };
            *number = cursor.number().map_err(|fault| fault.expecting(UV))? as f32;
            if !number.is_finite() {
                return Err(Fault::new(start, "a texture coordinate is too large", "at most 3.4e38"));
            }
        }
        self.uvs.push([numbers[0], numbers[1]]);
        Ok(())
    }

    fn parse_normal(&mut self, cursor: &mut Cursor) -> Result<(), Box<Fault>> {
        let mut normal = [0.0; 3];
        for part in &mut normal {
            cursor.skip_blanks();
            *part = cursor.number().map_err(|fault| fault.expecting(NORMAL))?;
        }
        cursor.skip_blanks();
        if !cursor.is_at_end_of_statement() {
            return Err(too_much(cursor, NORMAL));
        }
        let normal = unit(normal);
        self.oddities.add_many(Oddity::ZeroNormal, u64::from(normal.is_none()));
        self.normals.push(normal.unwrap_or_default());
        Ok(())
    }

    fn parse_face(&mut self, cursor: &mut Cursor) -> Result<(), Box<Fault>> {
        let first = self.corners.len();
        cursor.skip_blanks();
        let start = cursor.at();
        while !cursor.is_at_end_of_statement() {
            self.parse_corner(cursor)?;
            cursor.skip_blanks();
        }
        match self.corners.len() - first {
            3..=MOST_CORNERS => {
                self.face_ends.push(self.corners.len() as u32);
                Ok(())
            }
            count @ 0..3 => Err(Fault::new(cursor.at(), format!("a face with {count} corners"), FACE)),
            count => Err(Fault::new(start, format!("a face with {count} corners"), format!("at most {MOST_CORNERS}"))),
        }
    }

    #[inline]
    fn parse_corner(&mut self, cursor: &mut Cursor) -> Result<(), Box<Fault>> {
        let start = cursor.at();
        let position = parse_index(cursor, self.positions.len(), start)?;
        let (mut uv, mut normal) = (RawIndex::NONE, RawIndex::NONE);
        if cursor.take(b'/') {
            if !cursor.is_at(b'/') && !cursor.is_at_end_of_word() {
                uv = parse_index(cursor, self.uvs.len(), start)?;
            }
            if cursor.take(b'/') && !cursor.is_at_end_of_word() {
                normal = parse_index(cursor, self.normals.len(), start)?;
            }
        }
        if !cursor.is_at_end_of_word() {
            return Err(no_corner(cursor, start));
        }
        if uv != RawIndex::NONE || !self.uv_corners.is_empty() {
            // The first corner with any: those before have none.
            self.uv_corners.resize(self.corners.len(), RawIndex::NONE);
            self.uv_corners.push(uv);
        }
        if normal != RawIndex::NONE || !self.normal_corners.is_empty() {
            self.normal_corners.resize(self.corners.len(), RawIndex::NONE);
            self.normal_corners.push(normal);
        }
        self.corners.push(position);
        Ok(())
    }

    /// Where a corner of a face was written: its byte in the file, and its text.
    #[expect(
        clippy::indexing_slicing,
        reason = "the range is one of the text's own parts, and the face one of the piece's"
    )]
    pub(super) fn find_corner(&self, text: &'a [u8], face: usize, corner: usize) -> FoundCorner<'a> {
        let face = self.face_numbers.as_ref().map_or(face, |numbers| numbers[face] as usize);
        let mut cursor = Cursor::new(&text[self.range.clone()], OBJ_BLANKS);
        let mut faces = 0;
        while cursor.find_statement() {
            if matches!(cursor.word(), b"f" | b"fo") {
                if faces == face {
                    for _ in 0..corner {
                        cursor.skip_blanks();
                        cursor.word();
                    }
                    cursor.skip_blanks();
                    break;
                }
                faces += 1;
            }
            cursor.skip_statement();
        }
        FoundCorner { at: self.range.start + cursor.at(), word: cursor.word() }
    }
}

/// Whether what stands after `o` or `g` is a name, which may have blanks in it, or after `g` has it among several.
fn is_named(is_object: bool, name: &[u8], part: &str) -> bool {
    name == part.as_bytes() || !is_object && groups(name).any(|group| group == part.as_bytes())
}

/// The names of groups after `g`.
fn groups(names: &[u8]) -> impl Iterator<Item = &[u8]> {
    names.split(u8::is_ascii_whitespace).filter(|name| !name.is_empty())
}

/// The names of all objects and groups of a text, in order, but for those that are no text.
pub(super) fn names_of_parts(text: &[u8]) -> impl Iterator<Item = &str> {
    let mut cursor = Cursor::new(text, OBJ_BLANKS);
    let next = move || {
        while cursor.find_statement() {
            let word = cursor.word();
            let names = if matches!(word, b"o" | b"g") { Some((word == b"o", cursor.name())) } else { None };
            cursor.skip_statement();
            if names.is_some() {
                return names;
            }
        }
        None
    };
    let all = std::iter::from_fn(next)
        .flat_map(|(is_object, names)| names.split(move |byte| !is_object && byte.is_ascii_whitespace()));
    all.filter_map(|name| std::str::from_utf8(name).ok())
}

/// A corner in the text.
pub(super) struct FoundCorner<'a> {
    pub(super) at: usize,
    pub(super) word: &'a [u8],
}

#[cold]
fn too_much(cursor: &mut Cursor, expected: &str) -> Box<Fault> {
    let at = cursor.at();
    Fault::new(at, format!("{} is too much", shown(cursor.word())), expected)
}

#[inline]
fn parse_index(cursor: &mut Cursor, count: usize, start: usize) -> Result<RawIndex, Box<Fault>> {
    match cursor.integer() {
        Some(number) if number != 0 => RawIndex::new(number, count).ok_or_else(|| no_corner(cursor, start)),
        _ => Err(no_corner(cursor, start)),
    }
}

/// The fault of a corner that starts at a byte.
#[cold]
fn no_corner(cursor: &mut Cursor, start: usize) -> Box<Fault> {
    cursor.go_back_to(start);
    let word = cursor.word();
    let indices = word.split(|&byte| byte == b'/').filter(|index| !index.is_empty());
    let mut numbers = indices.map(|index| std::str::from_utf8(index).ok().and_then(|index| index.parse::<i128>().ok()));
    let message = match numbers.find(|number| !number.is_some_and(|n| (1..=1 << 31).contains(&n.unsigned_abs()))) {
        Some(Some(0)) => format!("the corner {} has the index 0: indices count from 1, or back from -1", shown(word)),
        Some(Some(_)) => format!("the corner {} has an index far out of range", shown(word)),
        _ => format!("{} is no corner of a face", shown(word)),
    };
    Fault::new(start, message, FACE)
}

fn parse_name<'a>(cursor: &mut Cursor<'a>, expected: &str) -> Result<&'a str, Box<Fault>> {
    let start = cursor.at();
    let name = cursor.name();
    match std::str::from_utf8(name) {
        Ok("") => Err(Fault::new(start, "a name is missing at the end of the line", expected)),
        Ok(name) => Ok(name),
        Err(_) => Err(Fault::new(start, format!("the name {} is not UTF-8 text", shown(name)), expected)),
    }
}
