//! Meshes of the generator's scenes: thin, folded, low-poly and closed ones, written as OBJ or OFF files beside the
//! scene.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use tracer_reference::Random;

/// A point.
pub type Point = [f64; 3];

/// A triangle mesh, counter-clockwise from outside.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    /// Corners.
    pub positions: Vec<Point>,
    /// Unit normals of the corners; may be empty.
    pub normals: Vec<Point>,
    /// Texture coordinates of the corners; may be empty.
    pub uvs: Vec<[f64; 2]>,
    /// Corners of each triangle.
    pub triangles: Vec<[usize; 3]>,
}

fn normalised(p: Point) -> Point {
    let length = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
    p.map(|x| x / length)
}

impl Shape {
    /// A quadrilateral with these corners, with texture coordinates.
    pub fn quad(corners: [Point; 4]) -> Self {
        Shape {
            positions: corners.to_vec(),
            normals: Vec::new(),
            uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        }
    }

    /// A closed box.
    pub fn block(low: Point, high: Point) -> Self {
        let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { high[axis] } else { low[axis] });
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        Shape {
            positions: (0..8).map(corner).collect(),
            triangles: sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect(),
            ..Shape::default()
        }
    }

    /// An icosahedron whose triangles are cut into four so many times, on the unit sphere, with the sphere's normals.
    pub fn ball(cuts: u32) -> Self {
        let phi = (1.0 + 5f64.sqrt()) / 2.0;
        let ends = [(-1.0, phi), (1.0, phi), (-1.0, -phi), (1.0, -phi)];
        let mut positions: Vec<Point> = Vec::new();
        positions.extend(ends.map(|(a, b)| normalised([a, b, 0.0])));
        positions.extend(ends.map(|(a, b)| normalised([0.0, a, b])));
        positions.extend(ends.map(|(a, b)| normalised([b, 0.0, a])));
        #[rustfmt::skip]
        let mut triangles = vec![
            [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6],
            [7, 1, 8],
            [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7],
            [9, 8, 1],
        ];
        for _ in 0..cuts {
            let mut middles = BTreeMap::new();
            let mut middle = |a: usize, b: usize| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    positions.push(normalised([0, 1, 2].map(|k| positions[a][k] + positions[b][k])));
                    positions.len() - 1
                })
            };
            let cut = |[a, b, c]: [usize; 3]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
            };
            triangles = triangles.into_iter().flat_map(cut).collect();
        }
        Shape { normals: positions.clone(), positions, uvs: Vec::new(), triangles }
    }

    /// A ring about the y axis, large radius 1, with normals and texture coordinates.
    pub fn ring(tube: f64, around: usize, across: usize) -> Self {
        let mut shape = Shape::default();
        for i in 0..=around {
            for j in 0..=across {
                let (u, v) = (i as f64 / around as f64, j as f64 / across as f64);
                let ((sin, cos), (rise, out)) =
                    ((u * std::f64::consts::TAU).sin_cos(), (v * std::f64::consts::TAU).sin_cos());
                let (outward, normal) = ([cos, 0.0, -sin], [cos * out, rise, -sin * out]);
                shape.positions.push([0, 1, 2].map(|k| outward[k] + tube * normal[k]));
                shape.normals.push(normal);
                shape.uvs.push([3.0 * u, 2.0 * v]);
            }
        }
        let at = |i: usize, j: usize| i * (across + 1) + j;
        for i in 0..around {
            for j in 0..across {
                shape.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                shape.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        shape
    }

    /// Rods of a square section, upright and lying, within a unit of the origin; each a closed box.
    pub fn rods(count: usize, width: f64, random: &mut Random) -> Self {
        let mut shape = Shape::default();
        for k in 0..count {
            let [x, z] = [0; 2].map(|_| random.between(-1.0, 1.0));
            let h = width / 2.0;
            shape.join(&match k % 3 {
                0 => Shape::block([x - h, 0.0, z - h], [x + h, 0.8, z + h]),
                1 => Shape::block([-1.0, 0.1 + 0.6 * x.abs(), z - h], [1.0, 0.1 + 0.6 * x.abs() + width, z + h]),
                _ => Shape::block([x - h, 0.1 + 0.6 * z.abs(), -1.0], [x + h, 0.1 + 0.6 * z.abs() + width, 1.0]),
            });
        }
        shape
    }

    /// Lying slats side by side, as much gap as slat; each a thin closed box.
    pub fn slats(width: f64) -> Self {
        let mut shape = Shape::default();
        for k in 0..(1.0 / width) as usize {
            let x = -1.0 + 2.0 * width * k as f64;
            shape.join(&Shape::block([x, 0.3, -1.0], [x + width, 0.32, 1.0]));
        }
        shape
    }

    /// Blades of grass: single triangles, lit on both sides.
    pub fn grass(count: usize, random: &mut Random) -> Self {
        let mut shape = Shape::default();
        for _ in 0..count {
            let [x, z] = [0; 2].map(|_| random.between(-1.0, 1.0));
            let (sin, cos) = random.between(0.0, std::f64::consts::TAU).sin_cos();
            let lean = [0; 2].map(|_| random.between(-0.15, 0.15));
            let (half, tall) = (random.between(0.01, 0.02), random.between(0.3, 0.7));
            let first = shape.positions.len();
            shape.positions.extend([
                [x - half * cos, 0.0, z - half * sin],
                [x + half * cos, 0.0, z + half * sin],
                [x + lean[0], tall, z + lean[1]],
            ]);
            shape.triangles.push([first, first + 1, first + 2]);
        }
        shape
    }

    /// A sheet folded to and fro, with slopes of so many degrees.
    pub fn corrugated(degrees: f64, pitch: f64) -> Self {
        let rise = pitch / 2.0 * degrees.to_radians().tan();
        let count = (2.0 / pitch).round() as usize * 2;
        let mut shape = Shape::default();
        for k in 0..=count {
            let x = -1.0 + pitch / 2.0 * k as f64;
            let y = 0.1 + if k % 2 == 1 { rise } else { 0.0 };
            shape.positions.extend([[x, y, 1.0], [x, y, -1.0]]);
            if k > 0 {
                let a = 2 * (k - 1);
                shape.triangles.extend([[a, a + 2, a + 3], [a, a + 3, a + 1]]);
            }
        }
        shape
    }

    /// Adds another mesh without normals and texture coordinates.
    pub fn join(&mut self, other: &Shape) {
        let first = self.positions.len();
        self.positions.extend(&other.positions);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|corner| corner + first)));
        self.uvs.clear();
    }

    /// The same surface, if it is flat, in four triangles for each; so many times.
    pub fn subdivided(&self, times: u32) -> Self {
        let mut out = Shape { normals: Vec::new(), ..self.clone() };
        for _ in 0..times {
            let mut finer = Shape::default();
            for t in &out.triangles {
                let [a, b, c] = t.map(|corner| out.positions[corner]);
                let middle = |p: Point, q: Point| [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
                let first = finer.positions.len();
                finer.positions.extend([a, b, c, middle(a, b), middle(b, c), middle(c, a)]);
                let corners = [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]];
                finer.triangles.extend(corners.map(|t| t.map(|corner| corner + first)));
            }
            out = finer;
        }
        out
    }

    /// Scaled, then moved.
    pub fn placed(mut self, scale: f64, by: Point) -> Self {
        for p in &mut self.positions {
            *p = [0, 1, 2].map(|k| scale * p[k] + by[k]);
        }
        self
    }

    /// As an OBJ file.
    pub fn obj(&self) -> String {
        let mut text = String::new();
        for [x, y, z] in &self.positions {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for [x, y, z] in &self.normals {
            let _ = writeln!(text, "vn {x} {y} {z}");
        }
        for [u, v] in &self.uvs {
            let _ = writeln!(text, "vt {u} {v}");
        }
        for triangle in &self.triangles {
            text.push('f');
            for corner in triangle {
                let k = corner + 1;
                let _ = match (self.uvs.is_empty(), self.normals.is_empty()) {
                    (true, true) => write!(text, " {k}"),
                    (true, false) => write!(text, " {k}//{k}"),
                    (false, true) => write!(text, " {k}/{k}"),
                    (false, false) => write!(text, " {k}/{k}/{k}"),
                };
            }
            text.push('\n');
        }
        text
    }

    /// As an OFF file: positions and triangles.
    pub fn off(&self) -> String {
        let mut text = format!("OFF\n{} {} 0\n", self.positions.len(), self.triangles.len());
        for [x, y, z] in &self.positions {
            let _ = writeln!(text, "{x} {y} {z}");
        }
        for [a, b, c] in &self.triangles {
            let _ = writeln!(text, "3 {a} {b} {c}");
        }
        text
    }
}
