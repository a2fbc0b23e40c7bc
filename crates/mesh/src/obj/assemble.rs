//! Joins the pieces of an OBJ file: resolves indices, cuts polygons, gives triangles their materials.

use super::piece::{FoundCorner, PartSwitch, Piece, RawIndex};
use super::{MOST, Oddities, Oddity};
use crate::coloring::{NO_COLOR, settled};
use crate::cursor::{Fault, shown};
use crate::data::{MaterialNames, MeshData, NO_INDEX};
use crate::error::MeshError;
use crate::files::Files;
use crate::mtl;
use crate::parts::{keep_numbered, number_anew, numbers_of_named};
use crate::polygon::{PolygonCutter, TooIntricate, is_degenerate};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

/// How many elements lie before a piece, or in all pieces.
#[derive(Clone, Copy, Default)]
struct Elements {
    positions: usize,
    uvs: usize,
    normals: usize,
}

/// The triangles of one piece.
#[derive(Default)]
struct Triangles {
    positions: Vec<[u32; 3]>,
    /// Empty when no corner of the file has texture coordinates.
    uvs: Vec<[u32; 3]>,
    /// Empty when no corner of the file has a normal.
    normals: Vec<[u32; 3]>,
    /// Number of the used material's name; empty when the file uses none.
    materials: Vec<u32>,
    oddities: Oddities,
}

/// Which attribute an index is of.
#[derive(Clone, Copy)]
enum Attribute {
    Position,
    Uv,
    Normal,
}

/// A face that cannot be had.
enum BadFace {
    /// An index of something that does not exist.
    Index {
        face: usize,
        corner: usize,
        attribute: Attribute,
    },
    TooIntricate {
        face: usize,
        corners: usize,
    },
}

/// From a face on, this material.
struct MaterialRun {
    first_face: usize,
    /// Number of the used name, or [`NO_INDEX`] before the first `usemtl`.
    name: u32,
}

/// All pieces, and what is before each.
pub(super) struct Assembly<'a> {
    pieces: Vec<Piece<'a>>,
    before: Vec<Elements>,
    total: Elements,
    /// Whether faces were left out, and so what only they name is.
    is_part: bool,
}

impl<'a> Assembly<'a> {
    /// Counts; the fault is that there are too many elements.
    pub(super) fn new(pieces: Vec<Piece<'a>>) -> Result<Self, Box<Fault>> {
        let mut total = Elements::default();
        let mut before = Vec::with_capacity(pieces.len());
        for piece in &pieces {
            before.push(total);
            total.positions += piece.positions.len();
            total.uvs += piece.uvs.len();
            total.normals += piece.normals.len();
            if total.positions.max(total.uvs).max(total.normals) >= MOST {
                let message = "too many vertices, texture coordinates or normals";
                return Err(Fault::new(piece.range.start, message, format!("fewer than {MOST} of each")));
            }
        }
        Ok(Assembly { pieces, before, total, is_part: false })
    }

    /// Leaves the faces of the part that is wanted alone; whether there is such a part.
    pub(super) fn keep_part(&mut self) -> bool {
        self.is_part = true;
        let mut is_there = false;
        // Whether faces are in it by their object, and by their groups: before the first `o` and `g` they are not.
        let (mut by_object, mut by_group) = (false, false);
        for piece in &mut self.pieces {
            let mut kept: Vec<Range<usize>> = Vec::new();
            let mut first = 0;
            let ends = piece.part_switches.iter().map(|switch| (switch.first_face as usize, Some(*switch)));
            for (end, next) in ends.chain([(piece.face_ends.len(), None)]) {
                if (by_object || by_group) && first < end {
                    kept.push(first..end);
                }
                first = end;
                if let Some(PartSwitch { is_object, is_part, .. }) = next {
                    is_there |= is_part;
                    *if is_object { &mut by_object } else { &mut by_group } = is_part;
                }
            }
            piece.keep_faces(&kept);
        }
        is_there
    }

    /// The whole mesh, with the warning about its materials but without that of `oddities`.
    // Long: one step after the other, each with what those before it have left.
    pub(super) fn into_mesh(
        mut self,
        text: &'a [u8],
        (path, files): (&Path, &Files),
        oddities: &mut Oddities,
    ) -> Result<MeshData, MeshError> {
        let mut colors = self.take_colors();
        let mut positions = join(self.pieces.iter_mut().map(|piece| std::mem::take(&mut piece.positions)).collect());
        let mut normals = join(self.pieces.iter_mut().map(|piece| std::mem::take(&mut piece.normals)).collect());
        let mut uvs = join(self.pieces.iter_mut().map(|piece| std::mem::take(&mut piece.uvs)).collect());
        let names = self.used_names();
        let runs: Vec<Vec<MaterialRun>> = self.material_runs(&names);
        let lookup = Lookup {
            positions: &positions,
            normals: &normals,
            total: self.total,
            any_uv: self.pieces.iter().any(|piece| !piece.uv_corners.is_empty()),
            any_normal: self.pieces.iter().any(|piece| !piece.normal_corners.is_empty()),
            any_zero_normal: normals.par_iter().any(|&normal| normal == [0.0; 3]),
        };
        let parts: Vec<Result<Triangles, BadFace>> = (&mut self.pieces, &self.before, &runs)
            .into_par_iter()
            .map(|(piece, &before, runs)| {
                let triangles = lookup.triangulate(piece, before, runs);
                piece.forget_faces();
                triangles
            })
            .collect();
        if !lookup.any_uv && !self.is_part {
            oddities.add_many(Oddity::UnusedUvs, self.total.uvs as u64);
        }
        if !lookup.any_normal && !self.is_part {
            oddities.add_many(Oddity::UnusedNormals, self.total.normals as u64);
        }
        let mut good = Vec::with_capacity(parts.len());
        for (number, part) in parts.into_iter().enumerate() {
            let mut part = part.map_err(|bad| MeshError::at_line(path, text, *self.fault_of(text, number, bad)))?;
            oddities.merge(std::mem::take(&mut part.oddities));
            good.push(part);
        }
        let libraries: Vec<&str> = self.pieces.iter().flat_map(|piece| piece.libraries.iter().copied()).collect();
        drop(self.pieces);
        let is_part = self.is_part;

        let mut take = |field: fn(&mut Triangles) -> &mut Vec<[u32; 3]>| {
            join(good.iter_mut().map(|part| std::mem::take(field(part))).collect())
        };
        let mut triangles = take(|part| &mut part.positions);
        let (mut normal_triangles, mut uv_triangles) = (take(|part| &mut part.normals), take(|part| &mut part.uvs));
        if is_part {
            keep_named_vertices((&mut positions, &mut colors), &mut triangles);
            keep_named(&mut normals, &mut normal_triangles);
            keep_named(&mut uvs, &mut uv_triangles);
        }
        let colors = settled(colors, positions.len(), 1.0, true, oddities);
        let normals = without_needless_indices(normals, normal_triangles, &triangles, positions.len());
        let uvs = without_needless_indices(uvs, uv_triangles, &triangles, positions.len());

        let materials = mtl::load(&libraries, &names, path, files)?;
        let used = materials.defined(&names).map(|(name, is_defined)| (name.to_owned(), is_defined)).collect();
        let material_names = match names.is_empty() {
            true => MaterialNames::default(),
            false => MaterialNames { libraries: libraries.iter().map(|&name| name.to_owned()).collect(), used },
        };
        let mut triangle_material = join(good.into_iter().map(|part| part.materials).collect());
        if materials.materials.is_empty() {
            triangle_material.clear();
        }
        triangle_material.par_iter_mut().for_each(|material| {
            *material = materials.index_of_name.get(*material as usize).copied().flatten().unwrap_or(NO_INDEX);
        });
        Ok(MeshData {
            positions,
            triangles,
            normals: normals.values,
            normal_triangles: normals.triangles,
            uvs: uvs.values,
            uv_triangles: uvs.triangles,
            colors,
            materials: materials.materials,
            triangle_material,
            material_names,
            libraries: materials.libraries,
            warnings: materials.warning.into_iter().collect(),
        })
    }

    /// What the file says of the colours of all vertices, if any has one.
    fn take_colors(&mut self) -> Vec<[f32; 3]> {
        if self.pieces.iter().all(|piece| piece.colors.is_empty()) {
            return Vec::new();
        }
        let of_piece = |piece: &mut Piece| {
            let mut colors = std::mem::take(&mut piece.colors);
            colors.resize(piece.positions.len(), NO_COLOR);
            colors
        };
        join(self.pieces.iter_mut().map(of_piece).collect())
    }

    /// The names of materials that faces use, in the order of first use.
    fn used_names(&self) -> Vec<&'a str> {
        let mut known = BTreeMap::new();
        let mut names = Vec::new();
        let mut current = None;
        for piece in &self.pieces {
            let mut face = 0;
            // Each material with the face after its last one, in turn.
            let ends = piece.switches.iter().map(|switch| (switch.first_face, Some(switch.name)));
            for (end, next) in ends.chain([(piece.face_ends.len(), None)]) {
                if let (true, Some(name)) = (end > face, current) {
                    known.entry(name).or_insert_with(|| names.push(name));
                }
                face = end;
                current = next.or(current);
            }
        }
        names
    }

    /// For each piece, which faces have which of the used names.
    fn material_runs(&self, names: &[&str]) -> Vec<Vec<MaterialRun>> {
        let numbers: BTreeMap<&str, u32> = names.iter().zip(0..).map(|(&name, number)| (name, number)).collect();
        // A name that no face uses is not among the used ones, and its run is empty.
        let number_of = |name: &str| numbers.get(name).copied().unwrap_or(NO_INDEX);
        let mut current = NO_INDEX;
        let mut all = Vec::with_capacity(self.pieces.len());
        for piece in &self.pieces {
            let mut runs = vec![MaterialRun { first_face: 0, name: current }];
            for switch in &piece.switches {
                current = number_of(switch.name);
                runs.push(MaterialRun { first_face: switch.first_face, name: current });
            }
            all.push(runs);
        }
        // No name is used: no triangle needs a number.
        if names.is_empty() { all.iter().map(|_| Vec::new()).collect() } else { all }
    }

    /// The line of a bad face of a piece, and what is bad.
    #[expect(clippy::indexing_slicing, reason = "numbers that `into_mesh` counted")]
    fn fault_of(&self, text: &'a [u8], number: usize, bad: BadFace) -> Box<Fault> {
        let piece = &self.pieces[number];
        match bad {
            BadFace::TooIntricate { face, corners } => {
                TooIntricate::fault(piece.find_corner(text, face, 0).at, corners)
            }
            BadFace::Index { face, corner, attribute } => {
                let FoundCorner { at, word } = piece.find_corner(text, face, corner);
                let (what, count) = match attribute {
                    Attribute::Position => ("vertex", self.total.positions),
                    Attribute::Uv => ("texture coordinate", self.total.uvs),
                    Attribute::Normal => ("vertex normal", self.total.normals),
                };
                let expected = match count {
                    0 => format!("no {what} index, as the file has none"),
                    _ => format!("a {what} index from 1 to {count}, or counting back from -1"),
                };
                Fault::new(at, format!("the corner {} names a {what} that does not exist", shown(word)), expected)
            }
        }
    }
}

/// What all pieces look their indices up in.
struct Lookup<'a> {
    positions: &'a [[f64; 3]],
    normals: &'a [[f32; 3]],
    total: Elements,
    any_uv: bool,
    any_normal: bool,
    any_zero_normal: bool,
}

impl Lookup<'_> {
    /// The triangles of a piece.
    #[expect(
        clippy::indexing_slicing,
        reason = "faces end within the piece's corners, and `resolve` has checked every index"
    )]
    fn triangulate(&self, piece: &Piece, before: Elements, runs: &[MaterialRun]) -> Result<Triangles, BadFace> {
        let mut out = Triangles::default();
        out.positions.reserve(piece.face_ends.len());
        let mut cutter = PolygonCutter::default();
        let (mut corners, mut uvs, mut normals) = (Vec::new(), Vec::new(), Vec::new());
        let mut runs = runs.iter().peekable();
        let mut material = None;
        let mut first = 0;
        for (face, &end) in piece.face_ends.iter().enumerate() {
            let range = first..end as usize;
            first = range.end;
            while let Some(run) = runs.next_if(|run| run.first_face <= face) {
                material = Some(run.name);
            }
            resolve(&piece.corners[range.clone()], before.positions, self.total.positions, &mut corners)
                .map_err(|corner| BadFace::Index { face, corner, attribute: Attribute::Position })?;
            let raw = piece.uv_corners.get(range.clone()).unwrap_or_default();
            resolve(raw, before.uvs, self.total.uvs, &mut uvs).map_err(|corner| BadFace::Index {
                face,
                corner,
                attribute: Attribute::Uv,
            })?;
            let raw = piece.normal_corners.get(range).unwrap_or_default();
            resolve(raw, before.normals, self.total.normals, &mut normals).map_err(|corner| BadFace::Index {
                face,
                corner,
                attribute: Attribute::Normal,
            })?;

            let position = |&corner: &u32| self.positions[corner as usize];
            let triangles = match corners[..] {
                [ref a, ref b, ref c] if is_degenerate([a, b, c].map(position)) => &[][..],
                [_, _, _] => &[[0, 1, 2]],
                _ => {
                    let cut = cutter
                        .cut(corners.iter().map(position))
                        .map_err(|TooIntricate| BadFace::TooIntricate { face, corners: corners.len() })?;
                    out.oddities.add_many(Oddity::CrossingPolygon, u64::from(cut.crossing));
                    cut.triangles
                }
            };
            out.oddities.add_many(Oddity::DegenerateTriangle, (corners.len() - 2 - triangles.len()) as u64);
            for &triangle in triangles {
                out.positions.push(triangle.map(|corner| corners[corner as usize]));
                if self.any_uv {
                    let uv = triangle.map(|corner| uvs.get(corner as usize).copied().unwrap_or(NO_INDEX));
                    out.oddities.add_many(Oddity::MissingUvs, u64::from(uv.contains(&NO_INDEX)));
                    out.uvs.push(uv);
                }
                if self.any_normal {
                    out.normals.push(self.normals_of(triangle, &normals, &mut out.oddities));
                }
                out.materials.extend(material);
            }
        }
        // All pieces' triangles are kept until they are joined.
        out.positions.shrink_to_fit();
        out.uvs.shrink_to_fit();
        out.normals.shrink_to_fit();
        out.materials.shrink_to_fit();
        Ok(out)
    }

    fn normals_of(&self, triangle: [u32; 3], normals: &[u32], oddities: &mut Oddities) -> [u32; 3] {
        let named = triangle.map(|corner| normals.get(corner as usize).copied().unwrap_or(NO_INDEX));
        oddities.add_many(Oddity::MissingNormals, u64::from(named.contains(&NO_INDEX)));
        if !self.any_zero_normal {
            return named;
        }
        named.map(|normal| match self.normals.get(normal as usize) {
            Some(&value) if value != [0.0; 3] => normal,
            _ => NO_INDEX,
        })
    }
}

/// Replaces `indices` by those of the corners of one face, [`NO_INDEX`] where a corner has none; the error is the
/// number of the first corner whose index does not exist.
fn resolve(raw: &[RawIndex], before: usize, total: usize, indices: &mut Vec<u32>) -> Result<(), usize> {
    indices.clear();
    for (corner, &index) in raw.iter().enumerate() {
        indices.push(match index {
            RawIndex::NONE => NO_INDEX,
            _ => index.resolve(before, total).ok_or(corner)?,
        });
    }
    Ok(())
}

/// Values of corners, with their indices where they need own ones.
struct Indexed<T> {
    values: Vec<T>,
    triangles: Option<Vec<[u32; 3]>>,
}

/// Leaves the vertices that corners name; no colours where none of these has one.
fn keep_named_vertices((positions, colors): (&mut Vec<[f64; 3]>, &mut Vec<[f32; 3]>), triangles: &mut [[u32; 3]]) {
    let numbers = numbers_of_named(positions.len(), triangles);
    keep_numbered(positions, &numbers);
    keep_numbered(colors, &numbers);
    number_anew(triangles, &numbers);
    if colors.iter().all(|color| color.iter().any(|x| x.is_nan())) {
        colors.clear();
    }
}

/// Leaves the values that corners name.
fn keep_named<T>(values: &mut Vec<T>, corners: &mut [[u32; 3]]) {
    let numbers = numbers_of_named(values.len(), corners);
    keep_numbered(values, &numbers);
    number_anew(corners, &numbers);
}

/// Drops values that no corner names, and indices that are those of the positions.
fn without_needless_indices<T>(
    values: Vec<T>,
    own: Vec<[u32; 3]>,
    shared: &[[u32; 3]],
    positions: usize,
) -> Indexed<T> {
    if own.as_flattened().iter().all(|&index| index == NO_INDEX) {
        Indexed { values: Vec::new(), triangles: None }
    } else if values.len() == positions && own == shared {
        Indexed { values, triangles: None }
    } else {
        Indexed { values, triangles: Some(own) }
    }
}

/// One vector of many, copied in parallel.
fn join<T: Copy + Default + Send + Sync>(parts: Vec<Vec<T>>) -> Vec<T> {
    if parts.iter().filter(|part| !part.is_empty()).count() <= 1 {
        return parts.into_iter().find(|part| !part.is_empty()).unwrap_or_default();
    }
    let mut all = vec![T::default(); parts.iter().map(Vec::len).sum()];
    let mut rest = &mut all[..];
    let mut slots = Vec::with_capacity(parts.len());
    for part in &parts {
        let (slot, after) = rest.split_at_mut(part.len());
        slots.push(slot);
        rest = after;
    }
    // By value, so that each part's memory is free as soon as it is copied.
    slots.into_par_iter().zip(parts).for_each(|(slot, part)| slot.copy_from_slice(&part));
    all
}
