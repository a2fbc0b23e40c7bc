//! Fewer triangles: edge collapses in the order of the quadric error (Garland and Heckbert 1997).
//!
//! Deviations: a small share of the squared edge length is added to the error, so that flat places keep well-shaped
//! triangles; a weight per place keeps more of them where people look. A collapse that would change the topology (link
//! condition), flip or flatten a triangle is not made.

use super::mesh::{Mesh, area_vector, quality};
use glam::{DMat3, DVec3};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Share of the squared edge length in the cost.
const EDGE_LENGTH_COST: f64 = 2e-4;
/// A collapse may not leave a triangle worse than this (1 is equilateral), unless one around it was worse before.
const WORST_QUALITY: f64 = 0.25;
/// Nor lean a triangle further from its vertices' normals than this (cosine).
const WORST_LEAN: f64 = 0.4;
/// Nor leave a vertex with more triangles than this.
const MOST_NEIGHBOURS: usize = 11;

/// Collapses edges of a closed mesh until `target` triangles are left (or none can go). `importance` weighs the error
/// at a place.
pub fn decimate(mesh: &mut Mesh, target: usize, importance: impl Fn(DVec3) -> f64) {
    loop {
        let before = mesh.triangles.len();
        collapse_edges(mesh, target, &importance);
        // What was refused at first may be possible now that its surroundings changed.
        if mesh.triangles.len() <= target || mesh.triangles.len() == before {
            return;
        }
    }
}

fn collapse_edges(mesh: &mut Mesh, target: usize, importance: &impl Fn(DVec3) -> f64) {
    let mut work = Work::new(mesh, importance);
    let mut left = mesh.triangles.len();
    while left > target {
        let Some(candidate) = work.queue.pop() else { break };
        if work.collapse(mesh, &candidate) {
            left -= 2;
        }
    }
    mesh.triangles = mesh.triangles.iter().zip(&work.alive).filter(|(_, alive)| **alive).map(|(t, _)| *t).collect();
    mesh.compact();
}

/// Sum of squared distances to planes: x^T A x + 2 b x + c.
#[derive(Clone, Copy, Default)]
struct Quadric {
    a: [f64; 6],
    b: DVec3,
    c: f64,
}

impl Quadric {
    fn plane(normal: DVec3, point: DVec3, weight: f64) -> Quadric {
        let n = normal;
        let d = -n.dot(point);
        let a = [n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z].map(|v| weight * v);
        Quadric { a, b: n * (weight * d), c: weight * d * d }
    }

    fn add(&mut self, other: &Quadric) {
        for (s, o) in self.a.iter_mut().zip(other.a) {
            *s += o;
        }
        self.b += other.b;
        self.c += other.c;
    }

    fn matrix(&self) -> DMat3 {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        DMat3::from_cols(DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz))
    }

    fn error(&self, p: DVec3) -> f64 {
        (p.dot(self.matrix() * p) + 2.0 * self.b.dot(p) + self.c).max(0.0)
    }

    /// The best point near the edge from `p` to `q`: pulled a little towards its middle, so that it always exists.
    fn best(&self, p: DVec3, q: DVec3) -> DVec3 {
        let middle = 0.5 * (p + q);
        let trace = self.a[0] + self.a[3] + self.a[5];
        let pull = 1e-3 * trace;
        let m = self.matrix() + DMat3::from_diagonal(DVec3::splat(pull));
        let best = m.inverse() * (middle * pull - self.b);
        let far = (best - middle).length_squared() > (q - p).length_squared();
        if far || !best.is_finite() { middle } else { best }
    }
}

struct Candidate {
    cost: f64,
    from: usize,
    to: usize,
    versions: [u32; 2],
    point: DVec3,
}

impl Ord for Candidate {
    /// The cheapest is the greatest: `BinaryHeap` pops it first.
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost.total_cmp(&self.cost).then_with(|| (other.from, other.to).cmp(&(self.from, self.to)))
    }
}
impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Candidate {}

struct Work {
    normals: Vec<DVec3>,
    quadrics: Vec<Quadric>,
    triangles_at: Vec<Vec<usize>>,
    versions: Vec<u32>,
    alive: Vec<bool>,
    queue: BinaryHeap<Candidate>,
}

impl Work {
    fn new(mesh: &Mesh, importance: impl Fn(DVec3) -> f64) -> Work {
        let n = mesh.positions.len();
        let mut work = Work {
            normals: vec![DVec3::ZERO; n],
            quadrics: vec![Quadric::default(); n],
            triangles_at: vec![Vec::new(); n],
            versions: vec![0; n],
            alive: vec![true; mesh.triangles.len()],
            queue: BinaryHeap::new(),
        };
        for (t, &triangle) in mesh.triangles.iter().enumerate() {
            let corners = mesh.corners(t);
            let area = area_vector(corners);
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            let weight = area.length() * importance(middle);
            let quadric = Quadric::plane(area.normalize_or_zero(), middle, weight);
            for v in triangle {
                work.normals[v] += area;
                work.quadrics[v].add(&quadric);
                work.triangles_at[v].push(t);
            }
        }
        for &[a, b, c] in &mesh.triangles {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                if p < q {
                    work.push(mesh, p, q);
                }
            }
        }
        work
    }

    fn push(&mut self, mesh: &Mesh, from: usize, to: usize) {
        let mut quadric = self.quadrics[from];
        quadric.add(&self.quadrics[to]);
        let (p, q) = (mesh.positions[from], mesh.positions[to]);
        let point = quadric.best(p, q);
        let weight = quadric.a[0] + quadric.a[3] + quadric.a[5];
        let cost = quadric.error(point) + EDGE_LENGTH_COST * weight * (q - p).length_squared();
        let versions = [self.versions[from], self.versions[to]];
        self.queue.push(Candidate { cost, from, to, versions, point });
    }

    fn neighbours(&self, mesh: &Mesh, v: usize) -> Vec<usize> {
        let mut around: Vec<usize> =
            self.triangles_at[v].iter().flat_map(|&t| mesh.triangles[t]).filter(|&u| u != v).collect();
        around.sort_unstable();
        around.dedup();
        around
    }

    fn collapse(&mut self, mesh: &mut Mesh, candidate: &Candidate) -> bool {
        let &Candidate { from, to, versions, point, .. } = candidate;
        if versions != [self.versions[from], self.versions[to]] {
            return false;
        }
        let (around_from, around_to) = (self.neighbours(mesh, from), self.neighbours(mesh, to));
        // Link condition: the two ends have exactly the two opposite vertices in common.
        let common = around_from.iter().filter(|v| around_to.binary_search(v).is_ok()).count();
        if common != 2 || around_from.len() + around_to.len() - 4 > MOST_NEIGHBOURS {
            return false;
        }
        let worst = self.worst_quality(mesh, from).min(self.worst_quality(mesh, to)).min(WORST_QUALITY);
        if !self.keeps_shape(mesh, from, to, point, worst) || !self.keeps_shape(mesh, to, from, point, worst) {
            return false;
        }

        mesh.positions[to] = point;
        let quadric = self.quadrics[from];
        self.quadrics[to].add(&quadric);
        let normal = self.normals[from];
        self.normals[to] += normal;
        for t in std::mem::take(&mut self.triangles_at[from]) {
            if mesh.triangles[t].contains(&to) {
                self.alive[t] = false;
                for v in mesh.triangles[t] {
                    self.triangles_at[v].retain(|&other| other != t);
                }
            } else {
                for v in &mut mesh.triangles[t] {
                    if *v == from {
                        *v = to;
                    }
                }
                self.triangles_at[to].push(t);
            }
        }
        self.versions[from] += 1;
        self.versions[to] += 1;
        for v in self.neighbours(mesh, to) {
            self.push(mesh, v.min(to), v.max(to));
        }
        true
    }

    fn worst_quality(&self, mesh: &Mesh, v: usize) -> f64 {
        self.triangles_at[v].iter().map(|&t| quality(mesh.corners(t))).fold(1.0, f64::min)
    }

    /// Whether the triangles at `moved` that do not vanish with the edge to `other` stay upright and no worse than
    /// `worst` when `moved` goes to `point`.
    fn keeps_shape(&self, mesh: &Mesh, moved: usize, other: usize, point: DVec3, worst: f64) -> bool {
        self.triangles_at[moved].iter().filter(|&&t| !mesh.triangles[t].contains(&other)).all(|&t| {
            let mut corners = mesh.corners(t);
            for (corner, &v) in corners.iter_mut().zip(&mesh.triangles[t]) {
                if v == moved {
                    *corner = point;
                }
            }
            let n = area_vector(corners).normalize_or_zero();
            let expected: DVec3 = mesh.triangles[t].iter().map(|&v| self.normals[v].normalize_or_zero()).sum();
            n.dot(expected) > WORST_LEAN * expected.length() && quality(corners) >= worst
        })
    }
}
