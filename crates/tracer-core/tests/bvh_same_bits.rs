//! The tree and its answers do not depend on threads, batches or the order of rays.

mod bvh_support;

use bvh_support::{Batch, COHERENCES, HERE, MISS, Mesh, Random, build, levels};
use tracer_core::bvh::{Accel, Acceleration, Geometry, InstanceGeometry};

fn build_with(threads: usize, geometry: &Geometry) -> Accel {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| Accel::build(geometry, Acceleration::Bvh).expect("the geometry is sound"))
}

#[test]
fn builds_are_the_same_for_any_number_of_threads() {
    // Enough for parallel binning, parallel halves and several chunks.
    let (ball, soup) = (Mesh::ball(300, 220), Mesh::soup(5000, 0.01, &mut Random::new(1)));
    let meshes = [ball.geometry(0), soup.geometry(ball.triangles.len() as u32)];
    let instances = [HERE, InstanceGeometry { mesh: 1, placement: None }];
    let geometry = Geometry { meshes: &meshes, instances: &instances, ..Geometry::default() };
    let one = build_with(1, &geometry);
    one.validate(&geometry).expect("the tree is valid");
    let stats = one.stats();
    assert!(stats.bytes as f64 <= 90.0 * stats.triangles as f64, "{stats:?}");
    for threads in [2, 3, 7] {
        assert!(one.bytes() == build_with(threads, &geometry).bytes(), "{threads} threads build another tree");
    }
}

#[test]
fn triangles_are_cut_the_same_for_any_number_of_threads() {
    let mesh = Mesh::aslant(3000, 0.01, &mut Random::new(3));
    let meshes = [mesh.geometry(0)];
    let geometry = Geometry { meshes: &meshes, instances: &[HERE], ..Geometry::default() };
    let one = build_with(1, &geometry);
    let parts = one.validate(&geometry).expect("the tree is valid");
    let cut = parts.chunk_by(|a, b| a.primitive == b.primitive).count() as u64;
    let stats = one.stats();
    // Every triangle is counted once. Each cut makes one box more, and there are no more than three a triangle.
    assert_eq!((stats.triangles, stats.parts), (36_000, parts.len() as u64));
    let boxes = stats.triangles + stats.parts - cut;
    assert!(stats.parts > 36_000 && stats.parts - cut <= 3 * 36_000, "{stats:?}");
    assert!(stats.bytes <= 90 * boxes, "{stats:?}");
    for threads in [2, 3, 7] {
        assert!(one.bytes() == build_with(threads, &geometry).bytes(), "{threads} threads build another tree");
    }
}

#[test]
fn answers_are_the_same_in_any_batch_and_order() {
    let mut random = Random::new(2);
    let mesh = Mesh::soup(4000, 0.1, &mut random);
    let meshes = [mesh.geometry(0)];
    let mut accel = build(&Geometry { meshes: &meshes, instances: &[HERE], ..Geometry::default() }, Acceleration::Bvh);
    let mut batch = Batch::beams(30, 1.2, &mut random);
    while batch.len() < 1000 {
        batch.push(random.cube(), random.cube());
    }
    let all = batch.closest(&accel, COHERENCES[0]);
    for level in levels() {
        accel = accel.with_level(level);
        for coherence in COHERENCES {
            let mut order: Vec<u32> = (0..1000).collect();
            for i in (1..order.len()).rev() {
                order.swap(i, random.below(i + 1));
            }
            assert_eq!(batch.closest_of(&accel, &order, coherence), all);
            for size in [1, 3, 17, 100] {
                let some = &order[..size];
                let found = batch.closest_of(&accel, some, coherence);
                for ray in 0..1000 {
                    let traced = some.contains(&(ray as u32));
                    assert_eq!(found[ray], if traced { all[ray] } else { MISS });
                }
            }
        }
    }
}
