//! An indexed triangle mesh and the questions asked of it.

use glam::DVec3;

/// Triangles over shared vertices; counter-clockwise seen from outside.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Vertices.
    pub positions: Vec<DVec3>,
    /// Triangles: indices of vertices.
    pub triangles: Vec<[usize; 3]>,
}

/// An edge and the triangle on one side of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct EdgeSide {
    /// The edge's vertex with the smaller index.
    pub low: usize,
    /// The edge's vertex with the larger index.
    pub high: usize,
    /// Whether the triangle runs from `high` to `low`.
    pub backward: bool,
    /// The triangle.
    pub triangle: usize,
    /// The triangle's third vertex.
    pub opposite: usize,
}

impl Mesh {
    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|v| self.positions[v])
    }

    /// The sides of all edges, sorted by edge: in a closed 2-manifold they come in pairs, forward and backward.
    pub fn edge_sides(&self) -> Vec<EdgeSide> {
        let mut sides = Vec::with_capacity(3 * self.triangles.len());
        for (triangle, &[a, b, c]) in self.triangles.iter().enumerate() {
            for (from, to, opposite) in [(a, b, c), (b, c, a), (c, a, b)] {
                sides.push(EdgeSide { low: from.min(to), high: from.max(to), backward: from > to, triangle, opposite });
            }
        }
        sides.sort_unstable();
        sides
    }

    /// Drops vertices that no triangle uses; the order of the others stays.
    pub fn compact(&mut self) {
        let mut used = vec![false; self.positions.len()];
        for &v in self.triangles.iter().flatten() {
            used[v] = true;
        }
        let mut new_index = vec![usize::MAX; self.positions.len()];
        let mut kept = Vec::new();
        for (v, &p) in self.positions.iter().enumerate() {
            if used[v] {
                new_index[v] = kept.len();
                kept.push(p);
            }
        }
        self.positions = kept;
        for v in self.triangles.iter_mut().flatten() {
            *v = new_index[*v];
        }
    }
}

/// Twice the area of a triangle, as a vector along its normal.
pub fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Shape of a triangle: 1 for an equilateral one, 0 for a degenerate one.
pub fn quality([a, b, c]: [DVec3; 3]) -> f64 {
    let edges = (b - a).length_squared() + (c - b).length_squared() + (a - c).length_squared();
    if edges > 0.0 { 2.0 * 3f64.sqrt() * area_vector([a, b, c]).length() / edges } else { 0.0 }
}
