//! The tree against brute force, on geometry and rays that are known to be trouble.

mod bvh_support;

use bvh_support::{Batch, COHERENCES, HERE, Hit, MISS, MODES, Mesh, Random, build, levels};
use glam::DVec3;
use tracer_core::bvh::{Accel, Geometry, NONE, TrianglePart, part_hit, triangle_hit};

/// Closest of all triangles, or of their parts, by the scalar formula; ties go to the smaller id.
fn brute_force(mesh: &Mesh, parts: &[TrianglePart], batch: &Batch) -> Vec<Hit> {
    let parts = (0..mesh.triangles.len() as u32).map(|triangle| parts_of(parts, triangle)).collect::<Vec<_>>();
    let one = |ray: usize| {
        let (origin, direction) = batch.ray(ray);
        let mut best = MISS;
        for (triangle, parts) in parts.iter().enumerate() {
            if batch.from_primitive[ray] == triangle as u32 {
                continue;
            }
            if let Some(t) = hit_of(mesh.corners(triangle), parts, origin, direction)
                && t < best.t
            {
                best = Hit { t, primitive: triangle as u32, instance: 0 };
            }
        }
        best
    };
    (0..batch.len()).map(one).collect()
}

/// Parts are sorted by triangle.
fn parts_of(parts: &[TrianglePart], triangle: u32) -> &[TrianglePart] {
    let start = parts.partition_point(|part| part.primitive < triangle);
    let end = parts.partition_point(|part| part.primitive <= triangle);
    &parts[start..end]
}

/// The hit of a triangle that is cut is the least of its parts'.
fn hit_of(corners: [[f32; 3]; 3], parts: &[TrianglePart], origin: [f32; 3], direction: [f32; 3]) -> Option<f32> {
    if parts.is_empty() {
        return triangle_hit(corners, origin, direction);
    }
    parts.iter().filter_map(|part| part_hit(corners, part.bounds, origin, direction)).reduce(f32::min)
}

/// The parts of a mesh's triangles, which are those of every mode.
fn parts(geometry: &Geometry) -> Vec<TrianglePart> {
    let [parts, others @ ..] = MODES.map(|mode| {
        let accel = Accel::build(geometry, mode).expect("the geometry is sound");
        accel.validate(geometry).expect("the tree is valid")
    });
    assert!(others.iter().all(|other| same_parts(other, &parts)));
    parts
}

/// Trees may have the parts of a triangle in another order.
fn same_parts(a: &[TrianglePart], b: &[TrianglePart]) -> bool {
    let sorted = |parts: &[TrianglePart]| {
        let mut keys: Vec<_> =
            parts.iter().map(|part| (part.primitive, part.bounds.map(|corner| corner.map(f32::to_bits)))).collect();
        keys.sort_unstable();
        keys
    };
    sorted(a) == sorted(b)
}

/// Every mode, level and packing gives what brute force gives, to the bit; and what is hit is what blocks.
fn check(mesh: &Mesh, batch: &Batch) -> Vec<Hit> {
    let meshes = [mesh.geometry(0)];
    let geometry = Geometry { meshes: &meshes, instances: &[HERE], ..Geometry::default() };
    let expected = brute_force(mesh, &parts(&geometry), batch);
    for mode in MODES {
        let mut accel = build(&geometry, mode);
        for level in levels() {
            accel = accel.with_level(level);
            for coherence in COHERENCES {
                let case = format!("{mode:?}, {}, {coherence:?}", level.name());
                let found = batch.closest(&accel, coherence);
                for ray in 0..batch.len() {
                    assert_eq!(found[ray], expected[ray], "{case}, ray {ray}: {:?}", batch.ray(ray));
                }
                check_occlusion(&accel, batch, &expected, &case);
            }
        }
    }
    expected
}

/// Nothing blocks as far as the closest hit; something does just beyond it, unless it is the target.
fn check_occlusion(accel: &Accel, batch: &Batch, closest: &[Hit], case: &str) {
    for coherence in COHERENCES {
        let nothing = vec![MISS; batch.len()];
        let to: Vec<f32> = closest.iter().map(|hit| hit.t).collect();
        assert!(batch.occluded(accel, &to, &nothing, coherence).iter().all(|&o| o == 0), "{case}");
        let beyond: Vec<f32> = closest.iter().map(|hit| hit.t.next_up()).collect();
        let blocked = batch.occluded(accel, &beyond, &nothing, coherence);
        for ray in 0..batch.len() {
            assert_eq!(blocked[ray] == 1, closest[ray].primitive != NONE, "{case}, ray {ray}");
        }
        // Where only one triangle is that near, and it is the light, the way is free.
        let free = batch.occluded(accel, &beyond, closest, coherence);
        let again: Vec<usize> = (0..batch.len()).filter(|&ray| free[ray] == 1).collect();
        for ray in again {
            let mut alone = Batch::default();
            let (origin, direction) = batch.ray(ray);
            alone.push_from(origin, direction, closest[ray].primitive, closest[ray].instance);
            let next = alone.closest(accel, coherence)[0];
            let left = batch.from_primitive[ray];
            assert!(next.t == closest[ray].t || next.primitive == left, "{case}, ray {ray}: {next:?}");
        }
    }
}

#[test]
fn nothing_at_all() {
    let mut random = Random::new(1);
    let batch = Batch::random(40, 1.0, &mut random);
    assert!(check(&Mesh::default(), &batch).iter().all(|hit| *hit == MISS));
}

#[test]
fn few_triangles() {
    let mut random = Random::new(2);
    for count in 1..=20 {
        let mesh = Mesh::soup(count, 1.0, &mut random);
        check(&mesh, &Batch::random(200, 2.0, &mut random));
    }
}

#[test]
fn soup() {
    let mut random = Random::new(3);
    let mesh = Mesh::soup(1000, 0.2, &mut random);
    let hits = check(&mesh, &Batch::random(600, 1.5, &mut random));
    assert!(hits.iter().filter(|hit| hit.primitive != NONE).count() > 150);
}

#[test]
fn beams() {
    let mut random = Random::new(14);
    let mesh = Mesh::soup(600, 0.2, &mut random);
    let hits = check(&mesh, &Batch::beams(40, 1.2, &mut random));
    assert!(hits.iter().filter(|hit| hit.primitive != NONE).count() > 130);
    // Triangles smaller and larger than a beam, far from the origin too.
    let ball = Mesh::ball(60, 30);
    check(&ball, &Batch::beams(20, 2.0, &mut random));
    check(&ball.clone().scaled(1e4), &Batch::beams(20, 2e4, &mut random));
    check(&ball.scaled(1e-4), &Batch::beams(20, 2e-4, &mut random));
}

#[test]
fn coincident_triangles_resolve_to_the_smallest_id() {
    let mut random = Random::new(4);
    let mut mesh = Mesh::soup(40, 0.7, &mut random);
    for _ in 0..5 {
        // The corners in the same order; turning them round would change the last bits of t.
        mesh.triangles.extend_from_within(..40);
    }
    for batch in [Batch::random(400, 1.0, &mut random), Batch::beams(30, 1.0, &mut random)] {
        let hits = check(&mesh, &batch);
        assert!(hits.iter().all(|hit| hit.primitive == NONE || hit.primitive < 40));
    }
}

#[test]
fn coplanar_grid() {
    let mut mesh = Mesh::default();
    for y in 0..=20 {
        for x in 0..=20 {
            mesh.positions.push([x as f32 / 10.0 - 1.0, 0.25, y as f32 / 10.0 - 1.0]);
        }
    }
    for y in 0..20 {
        for x in 0..20 {
            let a = y * 21 + x;
            mesh.triangles.extend([[a, a + 1, a + 21], [a + 1, a + 22, a + 21]]);
        }
    }
    let mut random = Random::new(5);
    let mut batch = Batch::random(500, 1.0, &mut random);
    // Straight down onto vertices, edges and middles; along the plane; from within the plane.
    for i in 0..=40 {
        for j in 0..=40 {
            batch.push([i as f32 / 20.0 - 1.0, 1.0, j as f32 / 20.0 - 1.0], [0.0, -1.0, 0.0]);
        }
        batch.push([-2.0, 0.25, i as f32 / 20.0 - 1.0], [1.0, 0.0, 0.0]);
        batch.push([i as f32 / 20.0 - 1.0, 0.25, 0.1], [0.0, 1.0, 0.0]);
    }
    let hits = check(&mesh, &batch);
    let down = &hits[500..];
    for (ray, hit) in down.iter().enumerate() {
        let straight = batch.direction[1][500 + ray] == -1.0;
        assert_eq!(hit.primitive != NONE, straight, "{:?}", batch.ray(500 + ray));
        assert!(!straight || (hit.t - 0.75).abs() < 1e-6);
    }
}

#[test]
fn degenerate_triangles_are_not_hit() {
    let mut mesh = Mesh::soup(10, 0.5, &mut Random::new(6));
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([
        [0.1, 0.2, 0.3],
        [0.4, 0.5, 0.6],
        [0.7, 0.8, 0.9],
        [f32::NAN, 0.0, 0.0],
        [f32::INFINITY; 3],
    ]);
    mesh.triangles.extend([
        [first, first, first],
        [first, first, first + 1],
        [first, first + 1, first + 2],
        [first, first + 1, first + 3],
        [first, first + 1, first + 4],
    ]);
    let mut random = Random::new(7);
    let mut batch = Batch::random(500, 1.0, &mut random);
    for _ in 0..200 {
        let s = random.unit();
        let o = random.cube();
        let p = [0.1 + 0.6 * s, 0.2 + 0.6 * s, 0.3 + 0.6 * s];
        batch.push(o, [0, 1, 2].map(|i: usize| p[i] - o[i]));
    }
    let hits = check(&mesh, &batch);
    assert!(hits.iter().all(|hit| hit.primitive == NONE || (hit.primitive != 10 && hit.primitive < 13)));
}

#[test]
fn needles() {
    // Triangles a million times longer than wide, seen from all sides, also edge-on.
    let mut random = Random::new(8);
    let mut mesh = Mesh::default();
    for i in 0..300 {
        let (a, b) = (random.cube(), random.cube());
        let c = [0, 1, 2].map(|k: usize| a[k] + 1e-6 * random.cube()[k]);
        mesh.positions.extend([a, b, c]);
        mesh.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let mut batch = Batch::random(300, 1.0, &mut random);
    for _ in 0..600 {
        let [a, b, c] = mesh.corners(random.below(300));
        let (s, o) = (random.unit(), random.cube());
        let p = [0, 1, 2].map(|k: usize| 0.5 * (a[k] + c[k]) * s + b[k] * (1.0 - s));
        batch.push(o, [0, 1, 2].map(|k: usize| p[k] - o[k]));
        // Along the needle, in its plane.
        batch.push([0, 1, 2].map(|k: usize| 2.0 * a[k] - b[k]), [0, 1, 2].map(|k: usize| b[k] - a[k]));
    }
    check(&mesh, &batch);
}

#[test]
fn huge_and_tiny() {
    for scale in [1e6, 1e-6] {
        let mut random = Random::new(9);
        let mesh = Mesh::soup(500, 0.2, &mut random).scaled(scale);
        let hits = check(&mesh, &Batch::random(600, 1.5 * scale, &mut random));
        assert!(hits.iter().filter(|hit| hit.primitive != NONE).count() > 100);
    }
}

#[test]
fn huge_and_tiny_together() {
    let mut random = Random::new(10);
    let mut mesh = Mesh::soup(300, 1e-4, &mut random);
    let ground = mesh.positions.len() as u32;
    mesh.positions.extend([[-1e4, -1.0, -1e4], [1e4, -1.0, -1e4], [0.0, -1.0, 2e4]]);
    mesh.triangles.push([ground, ground + 1, ground + 2]);
    let mut batch = Batch::random(300, 1.0, &mut random);
    for triangle in 0..300 {
        let [a, b, c] = mesh.corners(triangle);
        let o = random.cube();
        batch.push(o, [0, 1, 2].map(|k: usize| (a[k] + b[k] + c[k]) / 3.0 - o[k]));
    }
    let hits = check(&mesh, &batch);
    assert!(hits[300..].iter().filter(|hit| hit.primitive < 300).count() >= 295);
}

#[test]
fn axis_parallel_rays() {
    let mut random = Random::new(11);
    let mesh = Mesh::ball(30, 15);
    let mut batch = Batch::default();
    for _ in 0..400 {
        let axis = random.below(3);
        let mut d = [0.0, -0.0, 0.0];
        d[axis] = if random.bits() & 1 == 0 { 1.0 } else { -1.0 };
        let mut o = random.cube().map(|x| x * 0.9);
        if random.bits() & 1 == 0 {
            // Exactly through a vertex.
            o = mesh.positions[random.below(mesh.positions.len())];
        }
        o[axis] = -2.0 * d[axis];
        batch.push(o, d);
        // Two zero components exchanged for tiny ones.
        batch.push(o, d.map(|x| if x == 0.0 { 1e-30 } else { x }));
    }
    check(&mesh, &batch);
}

#[test]
fn rays_that_are_none() {
    let mesh = Mesh::ball(20, 10);
    let mut batch = Batch::default();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, f32::MAX] {
        for axis in 0..3 {
            let (mut o, mut d) = ([0.0, 0.0, -3.0], [0.0, 0.0, 1.0]);
            o[axis] = bad;
            batch.push(o, [0.0, 0.0, 1.0]);
            d[axis] = bad;
            batch.push([0.0, 0.0, -3.0], d);
        }
    }
    batch.push([0.0, 0.0, -3.0], [0.0; 3]);
    batch.push([0.0, 0.0, -3.0], [1e-40, 0.0, 1e-40]);
    assert!(check(&mesh, &batch).iter().all(|hit| *hit == MISS));
}

#[test]
fn limits_that_are_none() {
    let mesh = Mesh::ball(20, 10);
    let meshes = [mesh.geometry(0)];
    let accel = build(&Geometry { meshes: &meshes, instances: &[HERE], ..Geometry::default() }, MODES[2]);
    let mut batch = Batch::default();
    for _ in 0..4 {
        batch.push([0.0, 0.0, -3.0], [0.1, 0.0, 1.0]);
    }
    let tmax = [f32::NAN, 0.0, -1.0, f32::NEG_INFINITY];
    for coherence in COHERENCES {
        assert_eq!(batch.occluded(&accel, &tmax, &[MISS; 4], coherence), [0; 4]);
    }
}

#[test]
fn rays_from_a_surface_do_not_hit_it() {
    let mut random = Random::new(12);
    let mesh = Mesh::ball(40, 20);
    let seen = brute_force(&mesh, &[], &Batch::random(500, 2.0, &mut Random::new(13)));
    let first = Batch::random(500, 2.0, &mut Random::new(13));
    let mut batch = Batch::default();
    for (ray, hit) in seen.iter().enumerate().filter(|(_, hit)| hit.primitive != NONE) {
        let (o, d) = first.ray(ray);
        batch.push_from([0, 1, 2].map(|k: usize| o[k] + hit.t * d[k]), random.cube(), hit.primitive, 0);
    }
    check(&mesh, &batch);
}

/// Rays at points of triangles: from anywhere, and from a point in the triangle's own plane.
fn at_triangles(mesh: &Mesh, count: usize, random: &mut Random) -> Batch {
    let mut batch = Batch::default();
    for _ in 0..count {
        let [a, b, c] = mesh.corners(random.below(mesh.triangles.len()));
        let mut within = |reach: f32| {
            let (s, t) = (reach * random.unit(), random.unit());
            [0, 1, 2].map(|k: usize| a[k] + s * (1.0 - t) * (b[k] - a[k]) + s * t * (c[k] - a[k]))
        };
        let (p, edge_on) = (within(1.0), within(-1.0));
        for o in [random.cube(), edge_on] {
            batch.push(o, [0, 1, 2].map(|k: usize| p[k] - o[k]));
        }
    }
    batch
}

#[test]
fn triangles_that_are_cut() {
    let mut random = Random::new(15);
    for (count, width) in [(60, 0.03), (60, 1e-3), (20, 0.3)] {
        let mesh = Mesh::aslant(count, width, &mut random);
        let meshes = [mesh.geometry(0)];
        let parts = parts(&Geometry { meshes: &meshes, instances: &[HERE], ..Geometry::default() });
        assert!(parts.len() > 2 * count, "{} parts", parts.len());
        for mut batch in [Batch::random(200, 1.0, &mut random), Batch::beams(20, 1.0, &mut random)] {
            batch.append(&at_triangles(&mesh, 150, &mut random));
            check(&mesh, &batch);
        }
    }
    let mesh = Mesh::aslant(60, 0.03, &mut random);
    check(&mesh.clone().scaled(1e6), &at_triangles(&mesh, 100, &mut random).scaled(1e6));
    check(&mesh.clone().scaled(1e-6), &at_triangles(&mesh, 100, &mut random).scaled(1e-6));
}

#[test]
fn triangles_beside_those_that_are_cut_are_tested_as_anywhere_else() {
    // So small that products of their coordinates vanish and t is the clamp's; in leaves with parts.
    let mut random = Random::new(19);
    let mut mesh = Mesh::aslant(60, 0.03, &mut random);
    let small = Mesh::soup(40, 1.0, &mut random).scaled(1e-18);
    let mut triangles = Vec::new();
    for (at, triangle) in small.triangles.iter().enumerate() {
        triangles.extend_from_slice(&mesh.triangles[18 * at..18 * (at + 1)]);
        triangles.push(triangle.map(|vertex| vertex + mesh.positions.len() as u32));
    }
    mesh.positions.extend(&small.positions);
    mesh.triangles = triangles;
    let mut batch = at_triangles(&small.clone().scaled(1e18), 400, &mut random);
    batch.origin.iter_mut().flatten().for_each(|x| *x *= 1e-18);
    let hits = check(&mesh, &batch);
    assert!(hits.iter().filter(|hit| hit.primitive % 19 == 18).count() > 100);
}

/// No less than the slack of the formula for a triangle of size D that is hit: m <= 2 D, and the depths are no farther
/// apart than D.
fn slack(corners: [[f32; 3]; 3], direction: [f32; 3]) -> f64 {
    let [a, b, c] = corners.map(|p| DVec3::from_array(p.map(f64::from)));
    let d = DVec3::from_array(direction.map(f64::from));
    let size = (b - a).length().max((c - b).length()).max((a - c).length());
    // |det| is |n . d / dz|, here without its roundings, which are 10 u m^2.
    let det = ((b - a).cross(c - a).dot(d) / d.abs().max_element()).abs() - 40.0 * size * size / 16_777_216.0;
    if det <= 0.0 { f64::INFINITY } else { 4.0 * size * size * size / (1_048_576.0 * det * d.abs().max_element()) }
}

#[test]
fn a_cut_takes_no_hit_away_and_adds_none() {
    let mut random = Random::new(16);
    for width in [0.03, 1e-3, 1e-5, 0.3] {
        let mesh = Mesh::aslant(60, width, &mut random);
        let meshes = [mesh.geometry(0)];
        let all = parts(&Geometry { meshes: &meshes, instances: &[HERE], ..Geometry::default() });
        let batch = at_triangles(&mesh, 600, &mut random);
        let mut hits = 0;
        for ray in 0..batch.len() {
            let (origin, direction) = batch.ray(ray);
            for triangle in 0..mesh.triangles.len() {
                let corners = mesh.corners(triangle);
                let parts = parts_of(&all, triangle as u32);
                let (whole, cut) =
                    (triangle_hit(corners, origin, direction), hit_of(corners, parts, origin, direction));
                let case = format!("{corners:?} {origin:?} {direction:?}: {whole:?} {cut:?}");
                assert_eq!(whole.is_some(), cut.is_some(), "{case}");
                if let (Some(whole), Some(cut)) = (whole, cut) {
                    assert!(f64::from((whole - cut).abs()) <= slack(corners, direction), "{case}");
                    hits += 1;
                }
            }
        }
        assert!(hits > 800, "{hits} hits");
    }
}

#[test]
fn only_long_triangles_aslant_are_cut() {
    let mut random = Random::new(18);
    // Large triangles of all shapes, of which a few could be; a scan; needles along an axis.
    let mut straight = Mesh::default();
    for i in 0..300 {
        let [_, y, z] = random.cube();
        straight.positions.extend([[-1.0, y, z], [1.0, y, z], [1.0, y + 0.02, z]]);
        straight.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    // So far away that padding makes up for what cuts take from the boxes.
    let mut far = Mesh::aslant(60, 0.03, &mut random);
    far.positions.iter_mut().for_each(|p| p[1] += 2e5);
    for mesh in [far, Mesh::soup(3000, 0.4, &mut random), Mesh::ball(60, 30), straight] {
        let meshes = [mesh.geometry(0)];
        assert!(parts(&Geometry { meshes: &meshes, instances: &[HERE], ..Geometry::default() }).is_empty());
    }
}

#[test]
fn triangles_too_small_or_too_large_are_not_cut() {
    let mesh = Mesh::aslant(60, 0.03, &mut Random::new(17));
    for (scale, cut) in [(1.0, true), (1e-8, true), (1e8, true), (1e-10, false), (1e10, false)] {
        let mesh = mesh.clone().scaled(scale);
        let meshes = [mesh.geometry(0)];
        let parts = parts(&Geometry { meshes: &meshes, instances: &[HERE], ..Geometry::default() });
        assert_eq!(!parts.is_empty(), cut, "{scale}");
    }
}
