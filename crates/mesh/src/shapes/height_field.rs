//! Landscapes from grids of heights: two triangles between four of them.

#![expect(clippy::indexing_slicing, reason = "points and cells are numbered here")]

use crate::data::MeshData;
use rayon::prelude::*;
use scene_format::desc::HeightField;
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, codes};

/// Points of one, at most: a tree of so many triangles takes some ten gigabytes.
pub const MOST_HEIGHTS: u64 = 8192 * 8192;

/// Coordinates beyond this are no numbers to reckon with.
const FARTHEST: f64 = 1e12;

/// The cosine of 40 degrees: where neighbours turn by more there is a crease.
const CREASE: f64 = 0.766_044_443_118_978;

/// Heights in rows from -z to +z, each from -x to +x.
#[derive(Clone, Debug, PartialEq)]
pub struct Heights {
    /// Points along x, two or more.
    pub width: u32,
    /// Points along z, two or more.
    pub depth: u32,
    /// `width * depth` of them, finite; 1 is white.
    pub values: Vec<f32>,
}

/// The triangles of a height field. `span`: where its file is named.
///
/// # Errors
/// The diagnostic that says that a height leaves the range of the arithmetic (`E0303`).
pub fn height_field(field: &HeightField, heights: &Heights, span: Span) -> Result<MeshData, Box<Diagnostic>> {
    let [across, high, along] = field.size.value;
    let [x, y, z] = field.center.value;
    let farthest = heights.values.par_iter().map(|h| (y + f64::from(*h) * high).abs()).reduce(|| 0.0, f64::max);
    if farthest.is_nan() || farthest > FARTHEST {
        let message = format!("a height of this picture comes to {farthest:e}, too large to reckon with");
        let fault = Diagnostic::error(codes::OUT_OF_RANGE, span, message);
        return Err(Box::new(fault.expected(format!("heights of at most {FARTHEST:e} times `size`"))));
    }
    let grid =
        Grid { width: heights.width as usize, depth: heights.depth as usize, size: [across, high, along], heights };
    let (columns, rows) = (grid.width - 1, grid.depth - 1);
    let place = |k: usize, last: usize| k as f64 / last as f64;
    let point = |k: usize| (place(k % grid.width, columns), place(k / grid.width, rows));
    let count = grid.width * grid.depth;
    let positions = (0..count).into_par_iter().map(|k| {
        let (u, down) = point(k);
        [x + (u - 0.5) * across, y + f64::from(heights.values[k]) * high, z + (down - 0.5) * along]
    });
    let uvs = (0..count).into_par_iter().map(|k| {
        let (u, down) = point(k);
        [u as f32, (1.0 - down) as f32]
    });
    let triangles = (0..2 * columns * rows).into_par_iter().map(|k| grid.triangle(k));
    let mut data = MeshData {
        positions: positions.collect(),
        uvs: uvs.collect(),
        triangles: triangles.collect(),
        ..MeshData::default()
    };
    if field.smooth {
        grid.smooth(&mut data);
    }
    Ok(data)
}

struct Grid<'a> {
    width: usize,
    depth: usize,
    size: [f64; 3],
    heights: &'a Heights,
}

/// What is around a point, from +x over +z: of six neighbouring cells' halves the cell's column and row against the
/// point's, whether it is the half with two corners at -z, and which of its corners the point is.
const AROUND: [(usize, usize, usize, usize); 6] =
    [(0, 0, 1, 0), (0, 0, 0, 0), (1, 0, 1, 2), (1, 1, 0, 2), (1, 1, 1, 1), (0, 1, 0, 1)];

/// How much each of them counts: the two that share a corner of a cell as much as one that has it alone.
const WEIGHTS: [f64; 6] = [0.5, 0.5, 1.0, 0.5, 0.5, 1.0];

/// Halves of the cells around a point: their numbers and slopes, where there are such.
type Around = [Option<(usize, [f64; 2])>; 6];

impl Grid<'_> {
    /// A half of a cell, counter-clockwise seen from above. The diagonal goes from -x, -z to +x, +z.
    fn triangle(&self, number: usize) -> [u32; 3] {
        let (cell, half) = (number / 2, number % 2);
        let first = (cell / (self.width - 1)) * self.width + cell % (self.width - 1);
        let [a, b] = [first, first + 1];
        let [c, d] = [first + self.width, first + self.width + 1];
        if half == 0 { [a, c, d] } else { [a, d, b] }.map(|corner| corner as u32)
    }

    /// How much a half of a cell rises along x and along z.
    fn slope(&self, number: usize) -> [f64; 2] {
        let corners = self.triangle(number).map(|corner| f64::from(self.heights.values[corner as usize]));
        let [sx, sy, sz] = self.size;
        let (along_x, along_z) = (sy * (self.width - 1) as f64 / sx, sy * (self.depth - 1) as f64 / sz);
        let [a, second, third] = corners;
        match number % 2 {
            0 => [(third - second) * along_x, (second - a) * along_z],
            _ => [(third - a) * along_x, (second - third) * along_z],
        }
    }

    fn around(&self, vertex: usize) -> Around {
        let (column, row) = (vertex % self.width, vertex / self.width);
        AROUND.map(|(left, up, half, _)| {
            let (column, row) = (column.checked_sub(left)?, row.checked_sub(up)?);
            let there = column < self.width - 1 && row < self.depth - 1;
            let number = 2 * (row * (self.width - 1) + column) + half;
            there.then(|| (number, self.slope(number)))
        })
    }

    /// Adds normals: at each point the mean of the cells around it; one for each part where creases part them.
    fn smooth(&self, data: &mut MeshData) {
        let count = self.width * self.depth;
        data.normals = (0..count)
            .into_par_iter()
            .map(|vertex| {
                let around = self.around(vertex);
                mean(&around, &parts(&around), 0)
            })
            .collect();
        let creased = |vertex: &usize| parts(&self.around(*vertex)).iter().any(|part| *part > 0);
        let creased: Vec<usize> = (0..count).into_par_iter().filter(creased).collect();
        if creased.is_empty() {
            return;
        }
        let mut corners = data.triangles.clone();
        for vertex in creased {
            let around = self.around(vertex);
            let parts = parts(&around);
            let first = data.normals.len() as u32;
            let last = parts.iter().copied().max().unwrap_or(0);
            data.normals.extend((1..=last).map(|part| mean(&around, &parts, part)));
            for ((half, part), (.., corner)) in around.iter().zip(parts).zip(AROUND) {
                if let (Some((number, _)), 1..) = (half, part) {
                    corners[*number][corner] = first + part as u32 - 1;
                }
            }
        }
        data.normal_triangles = Some(corners);
    }
}

/// To which part each half of a cell around a point belongs, counted from 0: those between two creases are one.
fn parts(around: &Around) -> [usize; 6] {
    let joined = |k: usize| match (around[k], around[(k + 1) % 6]) {
        (Some((_, a)), Some((_, b))) => {
            let length = |s: [f64; 2]| (1.0 + s[0] * s[0] + s[1] * s[1]).sqrt();
            (1.0 + a[0] * b[0] + a[1] * b[1]) / length(a) / length(b) >= CREASE
        }
        _ => false,
    };
    // Behind a place where they are parted, or anywhere.
    let start = (0..6).find(|k| !joined(*k)).map_or(0, |k| k + 1);
    let (mut parts, mut part) = ([0; 6], 0);
    let mut begun = false;
    for step in 0..6 {
        let k = (start + step) % 6;
        if around[k].is_none() {
            continue;
        }
        if begun && !joined((k + 5) % 6) {
            part += 1;
        }
        (parts[k], begun) = (part, true);
    }
    parts
}

/// The normal of a part.
fn mean(around: &Around, parts: &[usize; 6], part: usize) -> [f32; 3] {
    let (mut sum, mut count) = ([0.0; 2], 0.0);
    for ((half, of), weight) in around.iter().zip(parts).zip(WEIGHTS) {
        if let (Some((_, [x, z])), true) = (half, *of == part) {
            sum = [sum[0] + weight * x, sum[1] + weight * z];
            count += weight;
        }
    }
    crate::normals::unit([-sum[0], count, -sum[1]]).unwrap_or([0.0, 1.0, 0.0])
}
