//! Better triangles of the same number: edge flips and tangential smoothing, with the vertices back on the surface
//! (the middle steps of Botsch and Kobbelt 2004, "A remeshing approach to multiresolution modeling").

use super::mesh::{Mesh, area_vector, quality};
use glam::DVec3;

/// Rounds of flips and smoothing.
const ROUNDS: usize = 5;
/// How far a vertex goes towards the middle of its neighbours.
const STEP: f64 = 0.35;
/// A triangle may not lean further than this from the surface's normal (cosine).
const WORST_LEAN: f64 = 0.4;

/// The smooth surface that the mesh stands for.
pub trait Surface {
    /// The surface point near `p`.
    fn project(&self, p: DVec3) -> DVec3;
    /// Unit normal, outward.
    fn normal(&self, p: DVec3) -> DVec3;
}

/// Improves the triangles of a closed mesh.
pub fn relax(mesh: &mut Mesh, surface: &impl Surface) {
    for p in &mut mesh.positions {
        *p = surface.project(*p);
    }
    for _ in 0..ROUNDS {
        flip(mesh, surface);
        smooth(mesh, surface);
    }
    flip(mesh, surface);
}

/// Flips every edge whose two triangles get better by it.
fn flip(mesh: &mut Mesh, surface: &impl Surface) {
    let sides = mesh.edge_sides();
    let mut touched = vec![false; mesh.triangles.len()];
    let mut around = vec![Vec::new(); mesh.positions.len()];
    for side in &sides {
        if !side.backward {
            around[side.low].push(side.high);
            around[side.high].push(side.low);
        }
    }
    for pair in sides.chunks_exact(2) {
        let (one, two) = (pair[0], pair[1]);
        if touched[one.triangle] || touched[two.triangle] {
            continue;
        }
        // `one` runs low -> high -> c, `two` high -> low -> d.
        let (a, b, c, d) = (one.low, one.high, one.opposite, two.opposite);
        let before = [[a, b, c], [b, a, d]];
        let after = [[a, d, c], [d, b, c]];
        if around[c].contains(&d) || around[a].len() <= 3 || around[b].len() <= 3 {
            continue;
        }
        let worst = |triangles: [[usize; 3]; 2]| {
            let [p, q] = triangles.map(|t| quality(t.map(|v| mesh.positions[v])));
            p.min(q)
        };
        if worst(after) <= worst(before) + 0.02 || !fits_better(mesh, surface, before, after) {
            continue;
        }
        mesh.triangles[one.triangle] = after[0];
        mesh.triangles[two.triangle] = after[1];
        touched[one.triangle] = true;
        touched[two.triangle] = true;
        around[a].retain(|&v| v != b);
        around[b].retain(|&v| v != a);
        around[c].push(d);
        around[d].push(c);
    }
}

/// Whether the flipped triangles lie along the surface about as well as the old ones.
fn fits_better(mesh: &Mesh, surface: &impl Surface, before: [[usize; 3]; 2], after: [[usize; 3]; 2]) -> bool {
    let fit = |triangles: [[usize; 3]; 2]| {
        let [p, q] = triangles.map(|t| {
            let corners = t.map(|v| mesh.positions[v]);
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            area_vector(corners).normalize_or_zero().dot(surface.normal(middle))
        });
        p.min(q)
    };
    let fit_after = fit(after);
    fit_after > WORST_LEAN && fit_after > fit(before) - 0.03
}

/// Moves each vertex along the surface towards the middle of its neighbours, where no triangle suffers.
fn smooth(mesh: &mut Mesh, surface: &impl Surface) {
    let mut triangles_at = vec![Vec::new(); mesh.positions.len()];
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        for &v in triangle {
            triangles_at[v].push(t);
        }
    }
    for (v, ring) in triangles_at.iter().enumerate() {
        let p = mesh.positions[v];
        let n = surface.normal(p);
        let middle =
            ring.iter().map(|&t| mesh.corners(t).iter().sum::<DVec3>() - p).sum::<DVec3>() / (2.0 * ring.len() as f64);
        let along = middle - p;
        let moved = surface.project(p + STEP * (along - n * along.dot(n)));
        let worst_before = ring.iter().map(|&t| quality(mesh.corners(t))).fold(1.0, f64::min);
        mesh.positions[v] = moved;
        let fits = ring.iter().all(|&t| {
            let corners = mesh.corners(t);
            let m = (corners[0] + corners[1] + corners[2]) / 3.0;
            area_vector(corners).normalize_or_zero().dot(surface.normal(m)) > WORST_LEAN
        });
        let worst_after = ring.iter().map(|&t| quality(mesh.corners(t))).fold(1.0, f64::min);
        if !fits || worst_after < worst_before.min(0.5) {
            mesh.positions[v] = p;
        }
    }
}
