//! Boxes whose edges and corners are round: a smaller box and all that lies within `rounding` of it.

#![expect(clippy::indexing_slicing, reason = "axes are numbered here")]

use super::{Triangulated, first_fault};
use crate::data::MeshData;
use scene_format::Diagnostic;
use scene_format::desc::RectBox;
use scene_format::diagnostic::Span;
use std::f64::consts::FRAC_PI_4;

/// Flat pieces of an eighth of a turn. The chord of 1/64 of a turn is off by 0.12 % of the radius.
const PIECES: u32 = 8;

/// Of the inner box: what is shorter than this, relative to the whole, has no length but for rounding.
const NO_LENGTH: f64 = 1e-12;

/// Of each face: the axes, and their signs, along which u and v grow; first x = low and high, then y, then z.
const FACES: [[[(usize, f64); 2]; 2]; 3] = [
    [[(2, 1.0), (1, 1.0)], [(2, -1.0), (1, 1.0)]],
    [[(0, 1.0), (2, 1.0)], [(0, 1.0), (2, -1.0)]],
    [[(0, -1.0), (1, 1.0)], [(0, 1.0), (1, 1.0)]],
];

impl Triangulated for RectBox {
    fn noun(&self) -> &'static str {
        "box"
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn middle(&self) -> Option<[f64; 3]> {
        Some(self.center.value)
    }

    fn mesh(&self, span: Span) -> Result<MeshData, Box<Diagnostic>> {
        match first_fault(self, span) {
            Some(fault) => Err(fault),
            None => Ok(rounded(self.center.value, self.size.value.0, self.rounding.value)),
        }
    }
}

/// The steps along one axis: from the middle to the inner box, and the tangent of the angle by which the normal is off
/// the face's. Both faces that meet at 45 degrees, and all three at a corner, have the same steps there, so that a
/// vertex is found by three of them, whichever face asks.
fn steps(half: f64, rounding: f64) -> Vec<(f64, f64)> {
    let inner = half - rounding;
    let has_length = inner > NO_LENGTH * half;
    let inner = if has_length { inner } else { 0.0 };
    let tangent = |k: u32| if k == PIECES { 1.0 } else { libm::tan(FRAC_PI_4 * f64::from(k) / f64::from(PIECES)) };
    let low = (0..=PIECES).rev().map(|k| (-inner, -tangent(k)));
    // Where the inner box has no length its two ends are one vertex.
    low.chain((u32::from(!has_length)..=PIECES).map(|k| (inner, tangent(k)))).collect()
}

fn rounded(center: [f64; 3], size: [f64; 3], rounding: f64) -> MeshData {
    let axes = size.map(|size| steps(0.5 * size, rounding));
    let counts = [0, 1, 2].map(|axis: usize| axes[axis].len());
    let numbers = vec![None; counts.iter().product()];
    let mut made = Made { center, size, rounding, axes, counts, numbers, mesh: MeshData::default() };
    for (axis, sides) in FACES.iter().enumerate() {
        for (side, along) in sides.iter().enumerate() {
            made.face(axis, side == 1, *along);
        }
    }
    made.mesh
}

/// What there is of a box.
struct Made {
    center: [f64; 3],
    size: [f64; 3],
    rounding: f64,
    axes: [Vec<(f64, f64)>; 3],
    counts: [usize; 3],
    /// Of each place of the lattice of steps: the number of its vertex.
    numbers: Vec<Option<u32>>,
    mesh: MeshData,
}

impl Made {
    /// The vertex at a place of the lattice's surface, where one of the tangents is 1 or -1.
    fn vertex(&mut self, at: [usize; 3]) -> u32 {
        let (mesh, rounding) = (&mut self.mesh, self.rounding);
        let steps = [0, 1, 2].map(|axis: usize| self.axes[axis][at[axis]]);
        let place = (at[2] * self.counts[1] + at[1]) * self.counts[0] + at[0];
        *self.numbers[place].get_or_insert_with(|| {
            let length = libm::sqrt(steps.iter().map(|(_, tangent)| tangent * tangent).sum());
            let normal = steps.map(|(_, tangent)| tangent / length);
            mesh.positions.push([0, 1, 2].map(|k: usize| self.center[k] + (steps[k].0 + rounding * normal[k])));
            mesh.normals.push(normal.map(|n| n as f32));
            mesh.positions.len() as u32 - 1
        })
    }

    /// The face at one end of an axis, whose texture coordinates grow along the axes and signs of `along`.
    fn face(&mut self, axis: usize, high: bool, along: [(usize, f64); 2]) {
        let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
        let width = self.counts[b];
        let first = self.mesh.uvs.len();
        let mut vertices = Vec::with_capacity(width * self.counts[c]);
        for place in 0..width * self.counts[c] {
            let mut at = [0; 3];
            (at[axis], at[b], at[c]) = (usize::from(high) * (self.counts[axis] - 1), place % width, place / width);
            let number = self.vertex(at);
            let position = self.mesh.positions[number as usize];
            let uv = along.map(|(k, sign)| (0.5 + sign * (position[k] - self.center[k]) / self.size[k]) as f32);
            self.mesh.uvs.push(uv);
            vertices.push(number);
        }
        let uv_triangles = self.mesh.uv_triangles.get_or_insert_default();
        for place in (width..vertices.len()).filter(|place| place % width > 0) {
            let quad = [place - width - 1, place - width, place, place - 1];
            for [p, q, r] in [[0, 1, 2], [0, 2, 3]] {
                let corners = if high { [quad[p], quad[q], quad[r]] } else { [quad[p], quad[r], quad[q]] };
                self.mesh.triangles.push(corners.map(|k| vertices[k]));
                uv_triangles.push(corners.map(|k| (first + k) as u32));
            }
        }
    }
}
