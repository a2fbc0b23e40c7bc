//! Curved shapes, alone and in the tree. Hits against what the shapes are: a point is on one where the equation says
//! so, and the line is within it on one side.

// Numbers of tests reach no picture.
#![allow(clippy::disallowed_methods)]

mod bvh_support;

use bvh_support::{Batch, COHERENCES, HERE, Hit, MISS, MODES, Mesh, build, levels};
use glam::{DAffine3, DMat3, DVec2, DVec3};
use tracer_core::bvh::{Geometry, LeftOut, NONE, ShapeGeometry, SphereGeometry, sphere_hit, triangle_hit};
use tracer_core::scene::Shape;
use tracer_core::shapes::{Row, UnitShape};

/// Numbers from 0 to 1: Marsaglia's xorshift.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn cube(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }
}

const SHAPES: [UnitShape; 13] = [
    UnitShape::Sphere,
    UnitShape::Disk { inner: 0.0 },
    UnitShape::Disk { inner: 0.5 },
    UnitShape::Cone { radii: [1.0, 1.0], caps: true, upright: false },
    UnitShape::Cone { radii: [1.0, 0.0], caps: true, upright: true },
    UnitShape::Cone { radii: [0.25, 1.0], caps: true, upright: false },
    UnitShape::Cone { radii: [1.0, 0.5], caps: false, upright: false },
    UnitShape::Capsule { half: 1.5 },
    UnitShape::Capsule { half: 0.01 },
    UnitShape::Cube,
    UnitShape::Torus { tube: 0.4 },
    UnitShape::Torus { tube: 1.0 },
    UnitShape::Torus { tube: 0.15 },
];

fn is_convex(shape: &UnitShape) -> bool {
    !matches!(shape, UnitShape::Torus { .. })
}

/// Whether a point of object space is within a closed shape, and how far off its surface about.
fn depth(shape: &UnitShape, q: DVec3) -> f64 {
    match *shape {
        UnitShape::Sphere => 1.0 - q.length(),
        UnitShape::Disk { inner } => {
            let r = q.truncate().length();
            -q.z.abs().max(r - 1.0).max(inner - r)
        }
        UnitShape::Cone { radii: [a, b], caps, .. } => {
            let side = 0.5 * (a + b) + 0.5 * (b - a) * q.z - q.truncate().length();
            if caps { side.min(1.0 - q.z.abs()) } else { -side.abs().max(q.z.abs() - 1.0) }
        }
        UnitShape::Plane => -q.z.abs(),
        UnitShape::Capsule { half } => 1.0 - (q - DVec3::new(0.0, 0.0, q.z.clamp(-half, half))).length(),
        UnitShape::Torus { tube } => tube - libm::hypot(q.truncate().length() - 1.0, q.z),
        UnitShape::Cube => 0.5 - q.abs().max_element(),
        UnitShape::Solid(_) => panic!("see solids.rs"),
    }
}

fn map(random: &mut Random, size: f64) -> DAffine3 {
    let matrix3 = DMat3::from_cols(random.cube(), random.cube(), random.cube()) * size;
    let long = matrix3.inverse().to_cols_array().iter().fold(0.0f64, |a, b| a.max(b.abs()));
    if long * size > 20.0 { map(random, size) } else { DAffine3 { matrix3, translation: random.cube() } }
}

fn at(o: [f32; 3], d: [f32; 3], t: f64) -> DVec3 {
    DVec3::from(o.map(f64::from)) + t * DVec3::from(d.map(f64::from))
}

/// A hit is on the surface, nothing lies before it, and the surface there is where the hit is and faces the way that it
/// must.
#[test]
fn hits_are_the_first_points_of_the_surface() {
    let mut random = Random(7);
    for shape in SHAPES {
        let mut hits = 0;
        for round in 0..4000 {
            let map = map(&mut random, [1.0, 0.01, 100.0][round % 3]);
            let row = Row::new(&shape, &map);
            let [low, high] = shape.bounds(&map);
            let size = (high - low).length();
            let inside = random.unit() < 0.3;
            let o = map.translation + random.cube() * size * if inside { 0.3 } else { 2.0 };
            let aim = map.transform_point3(random.cube() * DVec3::new(0.9, 0.9, 1.2));
            let (o, d) = (o.as_vec3().to_array(), ((aim - o) * 0.7).as_vec3().to_array());
            let to_object = map.inverse();
            let depth_at = |t: f64| depth(&shape, to_object.transform_point3(at(o, d, t)));
            let closed = shape.is_closed();
            let within = closed && depth_at(0.0) > 0.0;
            let t = row.hit(o, d, false);
            // Steps of a thousandth of the way through the box: what they find must lie behind the hit.
            let end = t.map_or(8.0, f64::from);
            let tolerance = 1e-4;
            if closed {
                for k in 1..200 {
                    let s = end * f64::from(k) / 200.0 * (1.0 - 1e-5);
                    let deep = depth_at(s);
                    assert!(if within { deep > -tolerance } else { deep < tolerance }, "{shape:?} {o:?} {d:?} {t:?}");
                }
            }
            let Some(t) = t else { continue };
            hits += 1;
            // t is rounded to 2^-24 of itself, in units of the shape: its ray goes at most some 100 of them.
            let q = to_object.transform_point3(at(o, d, f64::from(t)));
            let speed = to_object.transform_vector3(DVec3::from(d.map(f64::from))).length();
            assert!(depth(&shape, q).abs() < 1e-7 * (1.0 + f64::from(t) * speed), "{shape:?} {q} {}", depth(&shape, q));
            let on = row.surface(at(o, d, f64::from(t)));
            assert!(to_object.transform_point3(on.q).distance(q) < 1e-6 * (1.0 + f64::from(t) * speed));
            assert!((0.0..=1.0).contains(&on.uv.x) && (-1e-6..=1.000_001).contains(&on.uv.y), "{:?}", on.uv);
            if closed {
                let outwards = on.n.dot(DVec3::from(d.map(f64::from)));
                assert!(outwards * if within { 1.0 } else { -1.0 } > -1e-3 * DVec3::from(d.map(f64::from)).length());
            }
            let p = on.q;
            assert!((p - low).min_element() > -1e-6 * size - 1e-6 && (high - p).min_element() > -1e-6 * size - 1e-6);
        }
        assert!(hits > 400, "{shape:?}: {hits}");
    }
}

/// Rays that leave a closed convex shape inwards come out at its other side, those that leave it outwards do not come
/// back: also where they start on an edge, and however flat they go.
#[test]
fn rays_that_leave_a_shape_meet_its_far_side_only() {
    let mut random = Random(11);
    for shape in SHAPES.into_iter().filter(is_convex) {
        for _ in 0..4000 {
            let map = map(&mut random, 1.0);
            let row = Row::new(&shape, &map);
            let o = (map.translation + random.cube() * 4.0).as_vec3().to_array();
            let aim = map.transform_point3(random.cube() * DVec3::new(0.7, 0.7, 1.1));
            let d = (aim - DVec3::from(o.map(f64::from))).as_vec3().to_array();
            let Some(t) = row.hit(o, d, false) else { continue };
            let on = row.surface(at(o, d, f64::from(t)));
            let start = on.q.as_vec3().to_array();
            // Mostly along the surface.
            let along = random.cube().cross(on.n).normalize();
            let steep = [1.0, 1e-2, 1e-4][(random.unit() * 3.0) as usize];
            for sign in [-1.0, 1.0] {
                let d = (along + on.n * (sign * steep)).as_vec3().to_array();
                let hit = row.hit(start, d, true);
                if !shape.is_closed() {
                    // An open one is met from within, never where the ray starts. The start is rounded by 2^-23 at
                    // most, which turns the normal in object space by 20 x 20 of that, 5e-5, under such maps: flatter
                    // rays may start on either side.
                    assert!(steep < 1e-3 || hit.is_none_or(|t| t > 1e-6), "{shape:?} {hit:?}");
                } else if sign > 0.0 {
                    assert!(hit.is_none_or(|t| t < 1e-3), "{shape:?} comes back at {hit:?}");
                } else {
                    assert!(hit.is_some() || steep < 1e-3, "{shape:?} is lost");
                }
            }
        }
    }
}

/// A torus is met again by rays that leave it outwards, and not where they start: the line is outside until then, and
/// inside of rays that leave inwards, however flat they go. Its whole line is cut into the same pieces by all of its
/// points.
#[test]
fn rays_that_leave_a_torus_meet_what_is_ahead() {
    let mut random = Random(12);
    let mut met = [0, 0];
    for shape in [0.4, 1.0, 0.15, 0.01, 1e-4].map(|tube| UnitShape::Torus { tube }) {
        let UnitShape::Torus { tube } = shape else { continue };
        for round in 0..6000 {
            let map = map(&mut random, 1.0);
            let row = Row::new(&shape, &map);
            // A point of it, or near to the circles where planes touch it.
            let turns = DVec2::new(random.unit(), [random.unit(), 0.25, 0.75, 0.0][round % 4]) * std::f64::consts::TAU;
            let out = DVec3::new(libm::cos(turns.x), libm::sin(turns.x), 0.0);
            let q = out * (1.0 + tube * libm::cos(turns.y)) + DVec3::Z * tube * libm::sin(turns.y);
            let on = row.surface(map.transform_point3(q));
            let start = on.q.as_vec3().to_array();
            let along = random.cube().cross(on.n).normalize();
            let steep = [1.0, 1e-1, 1e-2][(random.unit() * 3.0) as usize];
            for sign in [-1.0, 1.0] {
                let d = (along + on.n * (sign * steep)).as_vec3().to_array();
                let hit = row.hit(start, d, true);
                // The chord of a flat ray within a very thin ring is as short as the roundings of its start.
                if sign < 0.0 && hit.is_none() && tube < 1e-3 && steep < 1.0 {
                    continue;
                }
                let to_object = map.inverse();
                let depth_at = |t: f64| depth(&shape, to_object.transform_point3(at(start, d, t)));
                let end = hit.map_or(5.0, f64::from);
                // The start is rounded by 2^-23, which is some 20 of that in units of the shape.
                let tolerance = 5e-6;
                for k in 1..200 {
                    let deep = depth_at(end * f64::from(k) / 200.0);
                    let right = if sign < 0.0 { deep > -tolerance } else { deep < tolerance };
                    assert!(right, "{shape:?} {start:?} {d:?} {hit:?}: {deep} at {k}");
                }
                let Some(t) = hit else {
                    assert!(sign > 0.0, "{shape:?} is lost");
                    continue;
                };
                met[usize::from(sign > 0.0)] += 1;
                assert!(depth_at(f64::from(t)).abs() < 1e-5, "{shape:?} {}", depth_at(f64::from(t)));
            }
        }
    }
    assert!(met[0] > 25_000 && met[1] > 500, "{met:?}");
}

/// No ray passes between cap and side: aimed at the rim from inside and from outside all are met.
#[test]
fn closed_shapes_have_no_seams() {
    let mut random = Random(13);
    for shape in SHAPES.into_iter().filter(|shape| shape.is_closed() && is_convex(shape)) {
        for _ in 0..20_000 {
            let map = map(&mut random, 1.0);
            let row = Row::new(&shape, &map);
            let turn = random.unit() * std::f64::consts::TAU;
            let (z, r) = match shape {
                UnitShape::Cone { radii, .. } => {
                    if random.unit() < 0.5 {
                        (-1.0, radii[0])
                    } else {
                        (1.0, radii[1])
                    }
                }
                UnitShape::Capsule { half } => (half, 1.0),
                UnitShape::Cube => (0.5, 0.0),
                _ => (0.0, 1.0),
            };
            let rim = map.transform_point3(DVec3::new(r * libm::cos(turn), r * libm::sin(turn), z));
            let inside = map.transform_point3(DVec3::new(0.05 * random.unit(), 0.0, -0.5 * random.unit()));
            let o = inside.as_vec3().to_array();
            let d = (rim - inside).as_vec3().to_array();
            let t = row.hit(o, d, false).expect("from inside all rays are met");
            assert!((t - 1.0).abs() < 1e-3, "{shape:?} at {t}");
            // Through the shape from far away.
            let o = (inside + (inside - rim) * 3.0 + random.cube()).as_vec3();
            let d = inside.as_vec3() - o;
            assert!(row.hit(o.to_array(), d.to_array(), false).is_some(), "{shape:?}");
        }
    }
}

/// The texture coordinates that the manual says, at points that can be reckoned by hand.
#[test]
fn texture_coordinates_are_those_of_the_manual() {
    let uv = |shape: UnitShape, q: [f64; 3]| Row::new(&shape, &DAffine3::IDENTITY).surface(DVec3::from(q)).uv;
    let near = |a: DVec2, b: [f64; 2]| assert!((a - DVec2::from(b)).length() < 1e-9, "{a} {b:?}");
    near(uv(UnitShape::Disk { inner: 0.0 }, [0.5, -1.0, 0.0]), [0.75, 0.0]);
    let cylinder = UnitShape::Cone { radii: [1.0; 2], caps: true, upright: false };
    near(uv(cylinder, [0.0, -1.0, 0.5]), [0.5, 0.75]);
    near(uv(cylinder, [1.0, 0.0, 0.0]), [0.75, 0.5]);
    near(uv(cylinder, [0.5, 0.0, 1.0]), [0.75, 0.5]);
    near(uv(cylinder, [0.5, 0.25, -1.0]), [0.25, 0.625]);
    let upright = UnitShape::Cone { radii: [1.0; 2], caps: true, upright: true };
    near(uv(upright, [0.5, 0.25, -1.0]), [0.75, 0.375]);
    let capsule = UnitShape::Capsule { half: 1.0 };
    near(uv(capsule, [0.0, -1.0, 0.0]), [0.5, 0.5]);
    near(uv(capsule, [0.0, 0.0, 2.0]), [0.5 + libm::atan2(0.0, -0.0) / std::f64::consts::TAU, 1.0]);
    near(uv(UnitShape::Sphere, [0.0, 0.0, 1.0]), [0.5, 0.5]);
    let torus = UnitShape::Torus { tube: 0.5 };
    near(uv(torus, [0.0, -1.5, 0.0]), [0.5, 0.5]);
    near(uv(torus, [1.0, 0.0, 0.5]), [0.75, 0.75]);
    near(uv(torus, [-1.0, 0.0, -0.5]), [0.25, 0.25]);
}

/// Every mode, level and packing gives what brute force over shapes, spheres and triangles gives, to the bit, and what
/// is hit is what blocks.
#[test]
fn the_tree_finds_what_brute_force_finds() {
    let mut random = Random(17);
    let mut numbers = bvh_support::Random::new(3);
    let placed = |random: &mut Random, unit: UnitShape| {
        let mut placement = map(random, 0.3);
        placement.translation = random.cube();
        Shape { unit, placement, material: 0, light: NONE, object: 0, copy: 0, is_plain: false, coordinates: 0 }
    };
    let shapes: Vec<Shape> = (0..90).map(|k| placed(&mut random, SHAPES[k % SHAPES.len()])).collect();
    let geometry_of = |shape: &Shape| {
        let [low, high] = shape.bounds();
        // As the compiler pads it, or more.
        let pad = DVec3::splat(low.abs().max(high.abs()).max_element() / 524_288.0);
        let row = Row::new(&shape.unit, &shape.placement);
        ShapeGeometry { row, lower: (low - pad).as_vec3().to_array(), upper: (high + pad).as_vec3().to_array() }
    };
    let rows: Vec<ShapeGeometry> = shapes.iter().map(geometry_of).collect();
    let spheres: Vec<SphereGeometry> =
        (0..5).map(|_| SphereGeometry::new(random.cube(), 0.05 + 0.1 * random.unit())).collect();
    // None of its triangles is cut.
    let ball = Mesh::ball(60, 30);
    // Ids 5 and 6 are of spheres that hang beside the tree.
    let first_shape = 7;
    let meshes = [ball.geometry(first_shape + rows.len() as u32)];
    let geometry = Geometry {
        spheres: &spheres,
        shapes: &rows,
        first_shape,
        parts: &[],
        planes: &[],
        meshes: &meshes,
        instances: &[HERE],
        left_out: LeftOut::default(),
    };
    let mut batch = Batch::random(800, 1.5, &mut numbers);
    batch.append(&Batch::beams(30, 1.5, &mut numbers));
    let brute = |batch: &Batch, ray: usize| {
        let (origin, direction) = batch.ray(ray);
        let from = batch.from_primitive[ray];
        let mut best = MISS;
        let mut take = |t: Option<f32>, primitive: u32, instance: u32| {
            if let Some(t) = t
                && (t, primitive) < (best.t, best.primitive)
            {
                best = Hit { t, primitive, instance };
            }
        };
        if origin.iter().chain(&direction).any(|x| !x.is_finite()) || direction == [0.0; 3] {
            return MISS;
        }
        for (k, sphere) in (0..).zip(&spheres) {
            take(sphere_hit(sphere, origin, direction, from == k), k, NONE);
        }
        for (k, shape) in (first_shape..).zip(&rows) {
            take(shape.row.hit(origin, direction, from == k), k, NONE);
        }
        for (k, id) in (meshes[0].first_primitive..).enumerate().take(ball.triangles.len()) {
            take(if from == id { None } else { triangle_hit(ball.corners(k), origin, direction) }, id, 0);
        }
        best
    };
    // Second rays leave what the first have hit.
    let mut second = Batch::default();
    for ray in 0..batch.len() {
        let hit = brute(&batch, ray);
        let (origin, direction) = batch.ray(ray);
        let Some(shape) = rows.get(hit.primitive.wrapping_sub(first_shape) as usize) else { continue };
        let start = shape.row.surface(at(origin, direction, f64::from(hit.t))).q;
        second.push_from(start.as_vec3().to_array(), random.cube().as_vec3().to_array(), hit.primitive, NONE);
    }
    assert!(second.len() > 200, "{}", second.len());
    batch.append(&second);
    let expected: Vec<Hit> = (0..batch.len()).map(|ray| brute(&batch, ray)).collect();
    for mode in MODES {
        let mut accel = build(&geometry, mode);
        assert_eq!((accel.stats().shapes, accel.stats().spheres), (90, 5));
        for level in levels() {
            accel = accel.with_level(level);
            for coherence in COHERENCES {
                let found = batch.closest(&accel, coherence);
                for ray in 0..batch.len() {
                    let case = format!("{mode:?}, {}, {coherence:?}, ray {ray}", level.name());
                    assert_eq!(found[ray], expected[ray], "{case}: {:?}", batch.ray(ray));
                }
                let nothing = vec![MISS; batch.len()];
                let to: Vec<f32> = expected.iter().map(|hit| hit.t).collect();
                assert!(batch.occluded(&accel, &to, &nothing, coherence).iter().all(|&o| o == 0));
                let beyond: Vec<f32> = expected.iter().map(|hit| hit.t.next_up()).collect();
                let blocked = batch.occluded(&accel, &beyond, &nothing, coherence);
                let free = batch.occluded(&accel, &beyond, &expected, coherence);
                for ray in 0..batch.len() {
                    assert_eq!(blocked[ray] == 1, expected[ray].primitive != NONE);
                    let of_shape = expected[ray].primitive.wrapping_sub(first_shape) < 90;
                    assert!(!of_shape || free[ray] == 0, "the target does not block");
                }
            }
        }
    }
}
