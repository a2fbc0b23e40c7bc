//! A distance field's zero surface as triangles: marching tetrahedra (Doi and Koide 1991).
//!
//! Each cell of a cubic grid is cut into six tetrahedra about its diagonal, alike in all cells, so that neighbours
//! agree on their common faces: the surface is a closed 2-manifold whatever the field does, which marching cubes and
//! surface nets do not promise. Its many slivers are the decimation's business. Cells far from the surface are never
//! looked at.

use super::mesh::Mesh;
use glam::DVec3;
use std::collections::HashMap;

/// A box of cubic cells.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Corner with the smallest coordinates.
    pub min: DVec3,
    /// Corner with the largest coordinates; the last cells may reach beyond it.
    pub max: DVec3,
    /// Edge of a cell.
    pub cell: f64,
}

/// Cells per edge of the blocks that are skipped whole where the surface is far.
const BLOCK: usize = 6;

/// Corners of a cell on the six ways from (0,0,0) to (1,1,1), each a positively oriented tetrahedron.
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// The surface where `distance` is zero, outward where it is positive. `distance` must not grow faster than 1.25 times
/// the length walked, and its zero surface must lie inside the grid.
pub fn polygonise(grid: &Grid, distance: impl Fn(DVec3) -> f64) -> Mesh {
    let size = ((grid.max - grid.min) / grid.cell).ceil();
    let blocks = [size.x, size.y, size.z].map(|n| (n as usize).div_ceil(BLOCK));
    let nodes = blocks.map(|n| n * BLOCK + 1);
    let node_index = |[x, y, z]: [usize; 3]| (z * nodes[1] + y) * nodes[0] + x;
    let node_position = |n: [usize; 3]| grid.min + DVec3::new(n[0] as f64, n[1] as f64, n[2] as f64) * grid.cell;

    let mut values = vec![f64::NAN; nodes.iter().product()];
    let mut surface = Surface::default();
    let reach = 1.25 * 0.5 * 3f64.sqrt() * BLOCK as f64 * grid.cell;
    for bz in 0..blocks[2] {
        for by in 0..blocks[1] {
            for bx in 0..blocks[0] {
                let first = [bx * BLOCK, by * BLOCK, bz * BLOCK];
                let middle = node_position(first) + DVec3::splat(0.5 * BLOCK as f64 * grid.cell);
                if distance(middle).abs() > reach {
                    continue;
                }
                for cell in cells(first) {
                    let corners: [Node; 8] = std::array::from_fn(|c| {
                        let n = [cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)];
                        let index = node_index(n);
                        let position = node_position(n);
                        if values[index].is_nan() {
                            values[index] = distance(position);
                        }
                        Node { index, position, value: values[index] }
                    });
                    for tetrahedron in TETRAHEDRA {
                        surface.cut(tetrahedron.map(|c| corners[c]));
                    }
                }
            }
        }
    }
    surface.mesh
}

fn cells(first: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..BLOCK.pow(3)).map(move |i| [first[0] + i % BLOCK, first[1] + i / BLOCK % BLOCK, first[2] + i / (BLOCK * BLOCK)])
}

#[derive(Clone, Copy)]
struct Node {
    index: usize,
    position: DVec3,
    value: f64,
}

#[derive(Default)]
struct Surface {
    mesh: Mesh,
    /// Vertex on the grid edge between two nodes; only looked up, never walked.
    vertex_on: HashMap<(usize, usize), usize>,
}

impl Surface {
    /// The surface inside a positively oriented tetrahedron.
    fn cut(&mut self, nodes: [Node; 4]) {
        let inside: Vec<usize> = (0..4).filter(|&i| nodes[i].value < 0.0).collect();
        // An even permutation brings the lone corner (or the pair) to the front.
        match inside[..] {
            [i] => self.cut_corner(lone_first(nodes, i), true),
            [i, j] => self.cut_pair(pair_first(nodes, i, j)),
            [_, _, _] => {
                let outside = (0..4).find(|&i| nodes[i].value >= 0.0).unwrap_or(0);
                self.cut_corner(lone_first(nodes, outside), false);
            }
            _ => {}
        }
    }

    fn cut_corner(&mut self, [a, b, c, d]: [Node; 4], lone_is_inside: bool) {
        let [p, q, r] = [self.vertex(a, b), self.vertex(a, c), self.vertex(a, d)];
        self.mesh.triangles.push(if lone_is_inside { [p, q, r] } else { [p, r, q] });
    }

    fn cut_pair(&mut self, [a, b, c, d]: [Node; 4]) {
        let [ac, ad, bc, bd] = [self.vertex(a, c), self.vertex(a, d), self.vertex(b, c), self.vertex(b, d)];
        self.mesh.triangles.push([ac, ad, bd]);
        self.mesh.triangles.push([ac, bd, bc]);
    }

    fn vertex(&mut self, a: Node, b: Node) -> usize {
        let (low, high) = if a.index < b.index { (a, b) } else { (b, a) };
        *self.vertex_on.entry((low.index, high.index)).or_insert_with(|| {
            // Kept off the ends, so that no two vertices of a triangle coincide.
            let t = (low.value / (low.value - high.value)).clamp(0.02, 0.98);
            self.mesh.positions.push(low.position.lerp(high.position, t));
            self.mesh.positions.len() - 1
        })
    }
}

/// An even permutation that starts with node `i`.
fn lone_first(n: [Node; 4], i: usize) -> [Node; 4] {
    let [a, b, c, d] = n;
    match i {
        0 => [a, b, c, d],
        1 => [b, a, d, c],
        2 => [c, a, b, d],
        _ => [d, a, c, b],
    }
}

/// An even permutation that starts with nodes `i` and `j`, `i < j`.
fn pair_first(n: [Node; 4], i: usize, j: usize) -> [Node; 4] {
    let [a, b, c, d] = n;
    match (i, j) {
        (0, 1) => [a, b, c, d],
        (0, 2) => [a, c, d, b],
        (0, 3) => [a, d, b, c],
        (1, 2) => [b, c, a, d],
        (1, 3) => [b, d, c, a],
        _ => [c, d, a, b],
    }
}
