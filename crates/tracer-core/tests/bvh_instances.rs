//! Placed meshes, spheres, and all kinds of primitives together.

mod bvh_support;

use bvh_support::{Batch, COHERENCES, HERE, Hit, MISS, MODES, Mesh, Random, build, levels};
use glam::{Affine3A, DVec3, Quat, Vec3};
use tracer_core::Level;
use tracer_core::bvh::{
    Accel, Acceleration, BuildError, Geometry, InstanceGeometry, MeshGeometry, NONE, SphereGeometry, sphere_hit,
};

/// The rows of a map.
fn rows(map: &Affine3A) -> [[f32; 4]; 3] {
    let (m, t) = (map.matrix3, map.translation);
    std::array::from_fn(|k| [m.x_axis[k], m.y_axis[k], m.z_axis[k], t[k]])
}

fn placement(random: &mut Random, spread: f32, size: f32) -> Affine3A {
    let axis = Vec3::from_array(random.cube()) + Vec3::splat(1e-3);
    let scale = Vec3::from_array(random.cube().map(|x| size * (1.2 + x)));
    let rotation = Quat::from_axis_angle(axis.normalize(), random.unit() * 6.0);
    let translation = Vec3::from_array(random.cube()) * spread;
    Affine3A::from_scale_rotation_translation(scale, rotation, translation)
}

fn spheres(count: usize, random: &mut Random) -> Vec<SphereGeometry> {
    let one = |i: usize| {
        let center = DVec3::from_array(random.cube().map(f64::from));
        if i == 7 {
            // A wall.
            return SphereGeometry::new(DVec3::new(0.0, -10_001.5, 0.0), 10_000.0);
        }
        SphereGeometry::new(center, 0.02 + 0.1 * f64::from(random.unit()))
    };
    (0..count).map(one).collect()
}

/// Modes, levels and packings agree to the bit; returns what they find.
fn check(geometry: &Geometry, batch: &Batch) -> Vec<Hit> {
    let reference = build(geometry, Acceleration::None).with_level(Level::PORTABLE);
    let expected = batch.closest(&reference, COHERENCES[0]);
    let beyond: Vec<f32> = expected.iter().map(|hit| hit.t.next_up()).collect();
    let upto: Vec<f32> = expected.iter().map(|hit| hit.t).collect();
    let nothing = vec![MISS; batch.len()];
    let behind = batch.occluded(&reference, &beyond, &expected, COHERENCES[0]);
    for mode in MODES {
        let mut accel = build(geometry, mode);
        for level in levels() {
            accel = accel.with_level(level);
            for coherence in COHERENCES {
                let case = format!("{mode:?}, {}, {coherence:?}", level.name());
                let found = batch.closest(&accel, coherence);
                let blocked = batch.occluded(&accel, &beyond, &nothing, coherence);
                let before = batch.occluded(&accel, &upto, &nothing, coherence);
                assert_eq!(batch.occluded(&accel, &beyond, &expected, coherence), behind, "{case}");
                for ray in 0..batch.len() {
                    assert_eq!(found[ray], expected[ray], "{case}, ray {ray}: {:?}", batch.ray(ray));
                    assert_eq!(blocked[ray] == 1, expected[ray].primitive != NONE, "{case}, ray {ray}");
                    assert_eq!(before[ray], 0, "{case}, ray {ray}");
                }
            }
        }
    }
    expected
}

/// Rays that go on from the hits.
fn onward(batch: &Batch, hits: &[Hit], random: &mut Random) -> Batch {
    let mut next = Batch::default();
    for (ray, hit) in hits.iter().enumerate().filter(|(_, hit)| hit.primitive != NONE) {
        let (o, d) = batch.ray(ray);
        next.push_from([0, 1, 2].map(|k: usize| o[k] + hit.t * d[k]), random.cube(), hit.primitive, hit.instance);
    }
    next
}

#[test]
fn everything_together() {
    let mut random = Random::new(1);
    let (ball, soup) = (Mesh::ball(16, 8), Mesh::soup(60, 0.5, &mut random));
    let spheres = spheres(50, &mut random);
    let meshes = [ball.geometry(50), soup.geometry(50 + ball.triangles.len() as u32)];
    let mut instances = vec![
        InstanceGeometry { mesh: 1, placement: None },
        // The same mesh in the same place again.
        InstanceGeometry { mesh: 1, placement: None },
    ];
    for i in 0..30 {
        instances.push(InstanceGeometry { mesh: i % 2, placement: Some(rows(&placement(&mut random, 1.0, 0.15))) });
    }
    let geometry = Geometry { spheres: &spheres, meshes: &meshes, instances: &instances, ..Geometry::default() };
    let batch = Batch::random(800, 2.0, &mut random);
    let hits = check(&geometry, &batch);
    let kinds = [
        hits.iter().filter(|hit| hit.primitive < 50).count(),
        hits.iter().filter(|hit| hit.instance < 2).count(),
        hits.iter().filter(|hit| hit.instance >= 2 && hit.instance != NONE).count(),
    ];
    assert!(kinds.iter().all(|&count| count > 20), "{kinds:?}");
    assert!(hits.iter().all(|hit| (hit.primitive < 50 || hit.primitive == NONE) == (hit.instance == NONE)));
    check(&geometry, &Batch::beams(60, 2.0, &mut random));
    let next = onward(&batch, &hits, &mut random);
    let again = check(&geometry, &next);
    for (ray, hit) in again.iter().enumerate() {
        let itself = hit.primitive == next.from_primitive[ray] && hit.instance == next.from_instance[ray];
        assert!(!itself || hit.primitive < 50, "ray {ray} hits the triangle it leaves");
    }
}

#[test]
fn triangles_that_are_cut() {
    let mut random = Random::new(11);
    let (beams, ball) = (Mesh::aslant(40, 0.03, &mut random), Mesh::ball(16, 8));
    let spheres = spheres(20, &mut random);
    let meshes = [ball.geometry(20), beams.geometry(20 + ball.triangles.len() as u32)];
    // Beside whole ones in the world's tree, and in a tree of their own.
    let mut instances =
        vec![InstanceGeometry { mesh: 0, placement: None }, InstanceGeometry { mesh: 1, placement: None }];
    for _ in 0..10 {
        instances.push(InstanceGeometry { mesh: 1, placement: Some(rows(&placement(&mut random, 1.0, 0.5))) });
    }
    let geometry = Geometry { spheres: &spheres, meshes: &meshes, instances: &instances, ..Geometry::default() };
    let stats = build(&geometry, Acceleration::Bvh).stats();
    let parts_of_one = build(&Geometry { instances: &instances[2..3], ..geometry }, Acceleration::Bvh).stats().parts;
    assert!(parts_of_one > 200 && stats.parts > parts_of_one + 200, "{parts_of_one} of {stats:?}");
    for batch in [Batch::random(500, 2.0, &mut random), Batch::beams(30, 2.0, &mut random)] {
        let hits = check(&geometry, &batch);
        let placed = hits.iter().filter(|hit| hit.instance >= 2 && hit.instance != NONE).count();
        assert!(placed > 20, "{placed}");
        let next = onward(&batch, &hits, &mut random);
        let again = check(&geometry, &next);
        for (ray, hit) in again.iter().enumerate() {
            let itself = hit.primitive == next.from_primitive[ray] && hit.instance == next.from_instance[ray];
            assert!(!itself || hit.primitive < 20, "ray {ray} hits the triangle it leaves");
        }
    }
}

#[test]
fn an_instance_is_where_its_triangles_are() {
    let mut random = Random::new(2);
    let ball = Mesh::ball(24, 12);
    for _ in 0..20 {
        let placement = placement(&mut random, 3.0, 0.5);
        let mut moved = ball.clone();
        for p in &mut moved.positions {
            *p = placement.transform_point3(Vec3::from_array(*p)).to_array();
        }
        let (meshes, flat) = ([ball.geometry(0)], [moved.geometry(0)]);
        let instances = [InstanceGeometry { mesh: 0, placement: Some(rows(&placement)) }];
        let placed =
            build(&Geometry { meshes: &meshes, instances: &instances, ..Geometry::default() }, Acceleration::Bvh);
        let flattened =
            build(&Geometry { meshes: &flat, instances: &[HERE], ..Geometry::default() }, Acceleration::Bvh);
        let mut batch = Batch::default();
        for _ in 0..300 {
            let target = moved.positions[random.below(moved.positions.len())];
            let o = random.cube().map(|x| 4.0 * x);
            let aside = random.cube();
            batch.push(o, [0, 1, 2].map(|k: usize| target[k] + 0.1 * aside[k] - o[k]));
        }
        let (a, b) = (batch.closest(&placed, COHERENCES[0]), batch.closest(&flattened, COHERENCES[0]));
        // Positions differ by roundings of the placement, some 1e-6 of coordinates up to 4: at the silhouette and at
        // edges between triangles the two may choose differently, elsewhere t agrees.
        let close = (0..batch.len()).filter(|&i| a[i].t == b[i].t || (a[i].t - b[i].t).abs() < 2e-5 * b[i].t).count();
        assert!(close >= batch.len() - 2, "{close} of {}", batch.len());
    }
}

#[test]
fn rays_from_far_away_hit_an_instance_as_precisely() {
    let ball = Mesh::ball(64, 32);
    let meshes = [ball.geometry(0)];
    let there = Affine3A::from_translation(Vec3::new(0.5, 0.25, 0.0));
    let instances = [InstanceGeometry { mesh: 0, placement: Some(rows(&there)) }];
    let accel = build(&Geometry { meshes: &meshes, instances: &instances, ..Geometry::default() }, Acceleration::Bvh);
    let mut batch = Batch::default();
    for distance in [2.0, 1e4, 1e6] {
        batch.push([0.53125, 0.28125, -distance], [0.0, 0.0, 1.0]);
    }
    let hits = batch.closest(&accel, COHERENCES[0]);
    assert!(hits.iter().all(|hit| hit.primitive == hits[0].primitive && hit.primitive != NONE));
}

#[test]
fn many_spheres_as_one_by_one() {
    let mut random = Random::new(3);
    let spheres = spheres(300, &mut random);
    let geometry = Geometry { spheres: &spheres, meshes: &[], instances: &[], ..Geometry::default() };
    let batch = Batch::random(1000, 1.4, &mut random);
    check(&geometry, &Batch::beams(50, 1.4, &mut random));
    let mut hits = check(&geometry, &batch);
    let next = onward(&batch, &hits, &mut random);
    hits.extend(check(&geometry, &next));
    let rays = (0..batch.len())
        .map(|i| (batch.ray(i), NONE))
        .chain((0..next.len()).map(|i| (next.ray(i), next.from_primitive[i])));
    for (hit, ((o, d), from)) in hits.iter().zip(rays) {
        let mut expected = MISS;
        for (id, sphere) in (0u32..).zip(&spheres) {
            if let Some(t) = sphere_hit(sphere, o, d, id == from)
                && t < expected.t
            {
                expected = Hit { t, primitive: id, instance: NONE };
            }
        }
        assert_eq!(*hit, expected);
    }
}

#[test]
fn hits_found_earlier_stand_unless_beaten() {
    let mut random = Random::new(4);
    let mesh = Mesh::soup(200, 0.3, &mut random);
    let meshes = [mesh.geometry(10)];
    let spheres = spheres(10, &mut random);
    let accel = build(
        &Geometry { spheres: &spheres, meshes: &meshes, instances: &[HERE], ..Geometry::default() },
        Acceleration::Bvh,
    );
    let batch = Batch::random(500, 1.2, &mut random);
    let free = batch.closest(&accel, COHERENCES[0]);
    for coherence in COHERENCES {
        for (factor, id, stands) in [(0.5, 9_999, true), (1.0, 0, true), (1.0, 9_999, false), (2.0, 0, false)] {
            let mut t: Vec<f32> = free.iter().map(|hit| hit.t * factor).collect();
            let (mut primitive, mut instance) = (vec![id; batch.len()], vec![NONE; batch.len()]);
            let active: Vec<u32> = (0..batch.len() as u32).collect();
            let mut hits = tracer_core::bvh::Hits { t: &mut t, primitive: &mut primitive, instance: &mut instance };
            accel.closest(&batch.rays(), &active, &mut hits, coherence);
            for ray in (0..batch.len()).filter(|&ray| free[ray].primitive != NONE) {
                let expected = if stands { id } else { free[ray].primitive };
                assert!(primitive[ray] == expected || free[ray].primitive == 0, "{factor} {id} ray {ray}");
            }
        }
    }
}

#[test]
fn instances_are_small() {
    // Bytes an instance hardly depend on their number.
    let mut random = Random::new(5);
    let ball = Mesh::ball(8, 4);
    let meshes = [ball.geometry(0)];
    let instances: Vec<_> = (0..10_000)
        .map(|_| InstanceGeometry { mesh: 0, placement: Some(rows(&placement(&mut random, 1.0, 0.01))) })
        .collect();
    let geometry = Geometry { meshes: &meshes, instances: &instances, ..Geometry::default() };
    let accel = build(&geometry, Acceleration::Bvh);
    let each = accel.stats().bytes as f64 / 10_000.0;
    assert!(each < 120.0, "{each} bytes an instance");
}

fn refused(meshes: &[MeshGeometry], instances: &[InstanceGeometry], spheres: &[SphereGeometry]) -> Option<BuildError> {
    Accel::build(&Geometry { spheres, meshes, instances, ..Geometry::default() }, Acceleration::Bvh).err()
}

#[test]
fn wrong_geometry_is_refused() {
    let mut mesh = Mesh::ball(8, 4);
    let count = mesh.triangles.len() as u32;
    let flat = Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0));
    let flattened = InstanceGeometry { mesh: 0, placement: Some(rows(&flat)) };
    assert_eq!(refused(&[mesh.geometry(0)], &[HERE, flattened], &[]), Some(BuildError::Placement { instance: 1 }));
    let missing = InstanceGeometry { mesh: 3, placement: None };
    let expected = BuildError::Mesh { instance: 0, mesh: 3, meshes: 1 };
    assert_eq!(refused(&[mesh.geometry(0)], &[missing], &[]), Some(expected));
    let sphere = SphereGeometry::new(DVec3::ZERO, 1.0);
    let expected = BuildError::Ids { mesh: 0, first: 0, taken: 1 };
    assert_eq!(refused(&[mesh.geometry(0)], &[HERE], &[sphere]), Some(expected));
    let vertices = mesh.positions.len();
    mesh.triangles.push([0, 1, 77_777]);
    let expected = BuildError::Vertex { mesh: 0, triangle: count, vertex: 77_777, vertices };
    assert_eq!(refused(&[mesh.geometry(0)], &[HERE], &[]), Some(expected));
}
