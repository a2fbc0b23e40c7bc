//! No ray passes between the triangles of a closed mesh, however it is aimed at edges and vertices.
//!
//! `BVH_WATERTIGHT_RAYS` sets how many rays are tried (a million by default).

mod bvh_support;

use bvh_support::{Batch, COHERENCES, HERE, MODES, Mesh, Random, build};
use tracer_core::bvh::{Geometry, NONE};

fn rays() -> usize {
    std::env::var("BVH_WATERTIGHT_RAYS").map_or(1_000_000, |n| n.parse().expect("a number"))
}

#[test]
fn closed_meshes_of_triangles_that_are_cut_do_not_leak() {
    let mut random = Random::new(2);
    let mesh = Mesh::aslant(64, 0.02, &mut random);
    let meshes = [mesh.geometry(0)];
    let geometry = Geometry { meshes: &meshes, instances: &[HERE], ..Geometry::default() };
    let accel = build(&geometry, MODES[2]);
    assert!(accel.stats().parts > 500, "{:?}", accel.stats());
    let mut left = rays() / 4;
    while left > 0 {
        let count = left.min(20_000);
        left -= count;
        let mut batch = Batch::default();
        for _ in 0..count {
            // From the axis of a beam towards a vertex of it, or a point of an edge, at t = 1.
            let beam = random.below(64);
            let ends = [0, 1].map(|end| {
                let corners = &mesh.positions[8 * beam + 4 * end..][..4];
                [0, 1, 2].map(|k: usize| corners.iter().map(|p| p[k]).sum::<f32>() / 4.0)
            });
            let s = 0.02 + 0.96 * random.unit();
            let origin = [0, 1, 2].map(|k: usize| ends[0][k] + s * (ends[1][k] - ends[0][k]));
            let triangle = mesh.corners(12 * beam + random.below(12));
            let corner = random.below(3);
            let (a, b) = (triangle[corner], triangle[(corner + 1) % 3]);
            let s = if random.bits() & 1 == 0 { 0.0 } else { random.unit() };
            batch.push(origin, [0, 1, 2].map(|k: usize| a[k] + s * (b[k] - a[k]) - origin[k]));
        }
        for coherence in COHERENCES {
            let hits = batch.closest(&accel, coherence);
            for (ray, hit) in hits.iter().enumerate() {
                // What leaks out of a beam meets another one later, or nothing.
                assert!(hit.t < 1.001, "{:?} leaks: {hit:?}", batch.ray(ray));
            }
        }
    }
}

#[test]
fn closed_meshes_do_not_leak() {
    let rays = rays();
    let mesh = Mesh::ball(400, 200);
    let meshes = [mesh.geometry(0)];
    let accel = build(&Geometry { meshes: &meshes, instances: &[HERE], ..Geometry::default() }, MODES[2]);
    let mut random = Random::new(1);
    let mut left = rays;
    while left > 0 {
        let count = left.min(20_000);
        left -= count;
        let mut batch = Batch::default();
        for _ in 0..count {
            // From inside: towards a vertex, or a point of an edge; half of them where the arithmetic is exact.
            let origin = random.cube().map(|x| if random.bits() & 1 == 0 { 0.3 * x } else { (8.0 * x).round() / 32.0 });
            let triangle = mesh.corners(random.below(mesh.triangles.len()));
            let corner = random.below(3);
            let (a, b) = (triangle[corner], triangle[(corner + 1) % 3]);
            let s = if random.bits() & 1 == 0 { 0.0 } else { random.unit() };
            let scale = 0.5 + random.unit();
            batch.push(origin, [0, 1, 2].map(|k: usize| (a[k] + s * (b[k] - a[k]) - origin[k]) * scale));
        }
        for coherence in COHERENCES {
            let hits = batch.closest(&accel, coherence);
            for (ray, hit) in hits.iter().enumerate() {
                assert!(hit.primitive != NONE, "{:?} leaks", batch.ray(ray));
            }
        }
    }
}
