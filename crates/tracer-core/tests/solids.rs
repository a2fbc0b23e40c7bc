//! Solids made of closed shapes: hits against whether points are inside, which is asked of the shapes one by one; where
//! faces coincide, closed forms.

// Numbers of tests reach no picture.
#![allow(clippy::disallowed_methods)]

use glam::DVec3;
use scene_format::{Syntax, load_str};
use std::fmt::Write;
use std::path::Path;
use tracer_core::scene::{Solids, Step};
use tracer_core::shapes::csg::Operation;
use tracer_core::shapes::{Solid, UnitShape};
use tracer_core::{Scene, compile};

/// Numbers from 0 to 1: Marsaglia's xorshift.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    fn cube(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }
}

fn scene(object: &str) -> Scene {
    let text = format!("Scene(background: 1, camera: Camera(position: (0, 0, 9)), objects: [{object}])");
    let loaded = load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]);
    let desc = loaded.unwrap_or_else(|error| panic!("{text}: {error:?}")).scene;
    compile(&desc).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// A solid alone in a scene, in render space.
struct Alone(Scene);

impl Alone {
    fn new(object: &str) -> Self {
        let scene = scene(object);
        assert_eq!(scene.shapes.len(), 1, "{object}");
        Alone(scene)
    }

    fn solid(&self) -> Solid {
        let UnitShape::Solid(solid) = self.0.shapes[0].unit else { panic!("a solid") };
        solid
    }

    fn hit(&self, o: DVec3, d: DVec3, leaves: bool) -> Option<f64> {
        let shapes = &self.0.tables.shapes;
        let [o, d] = [o, d].map(|v| v.as_vec3().to_array());
        shapes.rows[0].hit_among(&shapes.parts, o, d, leaves).map(f64::from)
    }

    /// Normal out of it, and where the next ray starts.
    fn on(&self, p: DVec3) -> (u32, DVec3, DVec3) {
        let shapes = &self.0.tables.shapes;
        let on = shapes.rows[0].on_solid(&shapes.parts, p).expect("a surface");
        (on.operand, on.outward, shapes.operands[on.operand as usize].row.surface(p).q)
    }

    /// To render space.
    fn point(&self, p: DVec3) -> DVec3 {
        self.0.frame.point(p)
    }

    /// Whether a point is in it, and how far it is from the surface of any of its operands, at most about.
    fn inside(&self, p: DVec3) -> (bool, f64) {
        let Solids { operands, steps, .. } = &*self.0.solids;
        let solid = self.solid();
        let mut nearest = f64::INFINITY;
        let mut stack = Vec::new();
        let [first, count] = solid.steps.map(|n| n as usize);
        for step in &steps[first..first + count] {
            match *step {
                Step::Operand(k) => {
                    let operand = operands[k as usize];
                    let map = operand.placement;
                    let deep = depth(&operand.unit, map.inverse().transform_point3(p));
                    // Shapes are scaled by at least 0.05 here.
                    nearest = nearest.min(deep.abs() * 0.05);
                    stack.push(deep > 0.0);
                }
                Step::Operation(operation) => {
                    let (b, a) = (stack.pop().expect("two"), stack.pop().expect("two"));
                    stack.push(match operation {
                        Operation::Union => a || b,
                        Operation::Intersection => a && b,
                        Operation::Difference => a && !b,
                    });
                }
            }
        }
        (stack[0], nearest)
    }
}

/// How deep a point of object space is in a shape, about.
fn depth(shape: &UnitShape, q: DVec3) -> f64 {
    match *shape {
        UnitShape::Sphere => 1.0 - q.length(),
        UnitShape::Torus { tube } => tube - libm::hypot(q.truncate().length() - 1.0, q.z),
        UnitShape::Cube => 0.5 - q.abs().max_element(),
        UnitShape::Cone { radii: [a, b], .. } => {
            let side = 0.5 * (a + b) + 0.5 * (b - a) * q.z - q.truncate().length();
            side.min(1.0 - q.z.abs())
        }
        UnitShape::Capsule { half } => 1.0 - (q - DVec3::new(0.0, 0.0, q.z.clamp(-half, half))).length(),
        _ => panic!("no operand"),
    }
}

/// A random shape, or a solid of a depth at most.
fn random_shape(random: &mut Random, depth: usize) -> String {
    let p = |random: &mut Random, size: f64| {
        let p = random.cube() * size;
        format!("({:.4}, {:.4}, {:.4})", p.x, p.y, p.z)
    };
    let axis = p(random, 1.0);
    let degrees = random.between(0.0, 360.0);
    let mut transform = format!("Rotate(axis: {axis}, degrees: {degrees:.3})");
    match random.below(4) {
        0 => transform += ", Scale((1, 0.6, -1))",
        1 => transform += ", Matrix(rows: ((1, 0.3, 0, 0.1), (0, 0.8, 0, 0), (0, 0, 1, -0.1)))",
        2 => transform.clear(),
        _ => {}
    }
    let r = random.between(0.3, 0.9);
    let words = match random.below(if depth > 0 { 10 } else { 6 }) {
        0 => format!("Sphere(center: {}, radius: {r:.4}", p(random, 0.5)),
        1 => format!("Box(center: {}, size: ({r:.4}, {:.4}, 1.1)", p(random, 0.5), random.between(0.3, 1.5)),
        2 => format!("Cylinder(from: {}, to: {}, radius: {:.4}", p(random, 1.0), p(random, 1.0), 0.5 * r),
        3 => {
            let tip = if random.below(2) == 0 { 0.0 } else { 0.2 };
            format!("Cone(from: {}, to: {}, radius: {r:.4}, tip_radius: {tip}", p(random, 1.0), p(random, 1.0))
        }
        5 => {
            format!("Torus(axis: {}, radius: {r:.4}, tube_radius: {:.4}", p(random, 1.0), r * random.between(0.2, 0.9))
        }
        4 => format!("Capsule(from: {}, to: {}, radius: {:.4}", p(random, 1.0), p(random, 1.0), 0.5 * r),
        _ => {
            let kind = ["Union", "Intersection", "Difference"][random.below(3)];
            let mut parts = String::new();
            for _ in 0..1 + random.below(3) {
                write!(parts, "{}, ", random_shape(random, depth - 1)).expect("a text");
            }
            format!("{kind}(objects: [{parts}]")
        }
    };
    format!("{words}, transform: [{transform}])")
}

fn random_solid(random: &mut Random) -> Alone {
    let kind = ["Union", "Intersection", "Difference"][random.below(3)];
    let mut parts = String::new();
    for _ in 0..2 + random.below(3) {
        write!(parts, "{}, ", random_shape(random, 2)).expect("a text");
    }
    Alone::new(&format!("{kind}(objects: [{parts}])"))
}

/// So near to a surface of an operand nothing is told of a point.
const NEAR: f64 = 2e-6;

/// Between the start and the hit the line is inside or outside throughout, as it must be.
fn assert_same_side(alone: &Alone, o: DVec3, d: DVec3, end: f64, inside: bool, case: &str) {
    for k in 1..150 {
        let t = end * f64::from(k) / 150.0;
        let (within, near) = alone.inside(o + t * d);
        assert!(within == inside || near < NEAR, "{case}: at {t} of {end}, {near} from a surface");
    }
}

/// Random trees, random rays from outside and inside: what is hit is the first border, and it faces the right way; from
/// there all rays go on to the next border, however flat they start.
#[test]
fn hits_are_the_first_borders() {
    let mut random = Random(5);
    let (mut hits, mut second) = (0, 0);
    for round in 0..500 {
        let alone = random_solid(&mut random);
        let [low, high] = alone.solid().bounds;
        let (middle, size) = (0.5 * (low + high), (high - low).length());
        if size == 0.0 {
            continue;
        }
        for ray in 0..60 {
            let case = format!("round {round}, ray {ray}");
            let far = if random.unit() < 0.3 { 0.4 } else { 1.5 };
            let o = (middle + random.cube() * size * far).as_vec3().as_dvec3();
            let d = (middle + random.cube() * 0.4 * size - o).normalize().as_vec3().as_dvec3();
            let (inside, near) = alone.inside(o);
            let hit = alone.hit(o, d, false);
            if near > NEAR {
                assert_same_side(&alone, o, d, hit.unwrap_or(4.0 * size), inside, &case);
            }
            let Some(t) = hit else { continue };
            hits += 1;
            let p = o + t * d;
            let (_, n, q) = alone.on(p);
            assert!(q.distance(p) < 1e-5 * (1.0 + t), "{case}");
            assert!((n.length() - 1.0).abs() < 1e-9);
            let step = 1e-5 * n;
            let (out, far_out) = alone.inside(q + step);
            let (within, far_in) = alone.inside(q - step);
            let alone_there = far_out > 0.4e-6 && far_in > 0.4e-6;
            assert!(!alone_there || within && !out, "{case}: {within} {out} {far_out} {far_in}");
            let start = q.as_vec3().as_dvec3();
            let along = random.cube().cross(n).normalize();
            for sign in [-1.0, 1.0] {
                let steep = [1.0, 1e-2, 1e-4][random.below(3)];
                let d = (along + n * (sign * steep)).normalize().as_vec3().as_dvec3();
                let next = alone.hit(start, d, true);
                // Near an edge two surfaces have a point within rounding, flat rays may start on either side, and a
                // bent surface leaves them at once.
                if steep < 1.0 || !alone_there {
                    continue;
                }
                second += 1;
                assert!(next.is_none_or(|t| t > 1e-6), "{case}: met where it starts, at {next:?}");
                assert_same_side(&alone, start, d, next.unwrap_or(4.0 * size), sign < 0.0, &case);
            }
        }
    }
    assert!(hits > 7_000 && second > 4_000, "{hits} {second}");
}

/// Flat rays that leave a solid of flat sides outwards never meet the face that they leave.
#[test]
fn flat_rays_do_not_come_back() {
    let mut random = Random(6);
    let turn = "transform: [Rotate(axis: (1, 2, 3), degrees: 40)]";
    let alone = Alone::new(&format!(
        "Difference({turn}, objects: [Union(objects: [Box(size: (2, 1, 1)), Box(center: (1.5, 0, 0), size: (1, 1, 1)), \
         Sphere(center: (0, 0, 0), radius: 0.9)]), Cylinder(from: (0, -3, 0), to: (0, 3, 0), radius: 0.3)])"
    ));
    let [low, high] = alone.solid().bounds;
    let mut left = 0;
    for _ in 0..200_000 {
        let o = (0.5 * (low + high) + random.cube() * 2.0).as_vec3().as_dvec3();
        let aim = 0.5 * (low + high) + random.cube() * 0.5;
        let d = (aim - o).as_vec3().as_dvec3();
        let Some(t) = alone.hit(o, d, false) else { continue };
        let (operand, n, q) = alone.on(o + t * d);
        // The wall of the hole is hollow: flat rays meet it again at once.
        if matches!(alone.0.solids.operands[operand as usize].unit, UnitShape::Cone { .. }) {
            continue;
        }
        let start = q.as_vec3().as_dvec3();
        let along = random.cube().cross(n).normalize();
        let steep = [1e-2, 1e-4, 1e-6][random.below(3)];
        let d = (along + n * steep).as_vec3().as_dvec3();
        if let Some(t) = alone.hit(start, d, true) {
            let (other, m, _) = alone.on(start + t * d);
            assert!(t > 1e-3 || m.dot(n) < 0.9 || other != operand, "met at {t} with {steep}");
        }
        left += 1;
    }
    assert!(left > 3_000, "{left}");
}

/// Two boxes that share a face, turned: as one there is nothing between them; glass would show it. As much for a box
/// and a cylinder that stands on it, and for shapes of one surface.
#[test]
fn there_are_no_inner_walls() {
    let mut random = Random(7);
    let pairs = [
        ["Box(center: (-0.5, 0, 0))", "Box(center: (0.5, 0, 0))"],
        ["Box(center: (-0.3, 0, 0), size: (0.6, 1, 1))", "Box(center: (0.35, 0, 0), size: (0.7, 1.5, 0.5))"],
        [
            "Cylinder(from: (0, -1, 0), to: (0, 0.1, 0), radius: 0.5)",
            "Cylinder(from: (0, 0.1, 0), to: (0, 1, 0), radius: 0.5)",
        ],
        [
            "Cylinder(from: (0, -1, 0), to: (0, 0.2, 0), radius: 0.5)",
            "Cylinder(from: (0, -0.4, 0), to: (0, 1, 0), radius: 0.5)",
        ],
        ["Box(center: (0, -0.5, 0))", "Cone(from: (0, 0, 0), to: (0, 1, 0), radius: 0.5)"],
        ["Sphere(center: (0, 0, 0), radius: 1)", "Sphere(center: (0, 0, 0), radius: 1)"],
        [
            "Cylinder(from: (0, -1, 0), to: (0, 1, 0), radius: 0.5)",
            "Capsule(from: (0, -1, 0), to: (0, 1, 0), radius: 0.5)",
        ],
    ];
    for pair in pairs {
        for _ in 0..30 {
            let axis = random.cube();
            let alone = Alone::new(&format!(
                "Union(objects: [{}, {}], transform: [Rotate(axis: ({}, {}, {}), degrees: {}), Translate((3, 1, 2))])",
                pair[0],
                pair[1],
                axis.x,
                axis.y,
                axis.z,
                random.between(0.0, 360.0)
            ));
            let [low, high] = alone.solid().bounds;
            for _ in 0..500 {
                let o = low + (high - low) * DVec3::new(random.unit(), random.unit(), random.unit());
                let (inside, near) = alone.inside(o);
                if !inside || near < NEAR {
                    continue;
                }
                let (o, d) = (o.as_vec3().as_dvec3(), random.cube().normalize().as_vec3().as_dvec3());
                let t = alone.hit(o, d, false).expect("a way out");
                assert!(!alone.inside(o + (t + 1e-5) * d).0 || alone.inside(o + (t + 1e-5) * d).1 < NEAR, "{pair:?}");
                assert_same_side(&alone, o, d, t, true, "within");
                // Back in from where it came out.
                let (_, n, q) = alone.on(o + t * d);
                let back = random.cube().cross(n).normalize() - n;
                let (start, back) = (q.as_vec3().as_dvec3(), back.as_vec3().as_dvec3());
                let next = alone.hit(start, back, true);
                if alone.inside(start + 1e-4 * back).0 {
                    let t = next.expect("a far side");
                    assert!(t > 1e-5, "{pair:?}: {t}");
                    assert_same_side(&alone, start, back, t, true, "back in");
                }
                // Away from it: never where it starts.
                let away = (random.cube().cross(n).normalize() + n).as_vec3().as_dvec3();
                assert!(alone.hit(start, away, true).is_none_or(|t| t > 1e-6), "{pair:?}");
            }
        }
    }
}

/// What is taken away takes the face with it: a skin would be met.
#[test]
fn no_skin_is_left_where_faces_coincide() {
    let mut random = Random(8);
    // What is taken, and what is left of x > 0, by the way: nothing.
    let cases = [
        "Box(center: (0.25, 0, 0), size: (0.5, 1, 1))",
        "Box(center: (0.25, 0.5, 0), size: (0.5, 2, 3))",
        "Union(objects: [Box(center: (0.25, 0.25, 0), size: (0.5, 0.5, 1)), \
         Box(center: (0.25, -0.25, 0), size: (0.5, 0.5, 1))])",
    ];
    for case in cases {
        for _ in 0..30 {
            let axis = random.cube();
            let turn =
                format!("Rotate(axis: ({}, {}, {}), degrees: {})", axis.x, axis.y, axis.z, random.between(0.0, 360.0));
            let alone = Alone::new(&format!("Difference(objects: [Box(), {case}], transform: [{turn}])"));
            let whole = Alone::new(&format!(
                "Union(objects: [Box(center: (-0.25, 0, 0), size: (0.5, 1, 1))], transform: [{turn}])"
            ));
            for _ in 0..500 {
                let (o, to) = (random.cube() * 3.0, random.cube() * 0.4);
                let there = |alone: &Alone| {
                    let [o, to] = [o, to].map(|p| alone.point(p));
                    alone.hit(o, to - o, false)
                };
                match (there(&alone), there(&whole)) {
                    (None, None) => {}
                    (Some(a), Some(b)) => assert!((a - b).abs() < 1e-5, "{case}: {a} {b}"),
                    (a, b) => panic!("{case}: {a:?} {b:?}"),
                }
            }
        }
    }
    // A body without itself is nothing, from anywhere.
    for body in [
        "Box()",
        "Sphere(center: (0.2, 0, 0), radius: 0.7)",
        "Cone(radius: 1, tip_radius: 0.3)",
        "Capsule(radius: 0.5)",
    ] {
        let nothing = Alone::new(&format!("Difference(objects: [{body}, {body}])"));
        for _ in 0..5000 {
            let o = random.cube() * 2.0;
            assert_eq!(nothing.hit(o, random.cube() - o, false), None, "{body}");
        }
    }
}

/// Chords of a lens and the volume of a ring, which a hole of whatever radius leaves of a ball: 4/3 pi (height/2)^3.
#[test]
fn closed_forms() {
    let lens = Alone::new(
        "Intersection(objects: [Sphere(center: (0, 0, -2), radius: 2.2), Sphere(center: (0, 0, 2), radius: 2.2)])",
    );
    let scale = lens.0.frame.scale;
    for k in 0..50 {
        let r = 0.9 * f64::from(k) / 50.0;
        let o = lens.point(DVec3::new(0.0, r, 5.0));
        let near = lens.hit(o, DVec3::NEG_Z, false).expect("the lens");
        let (_, _, q) = lens.on(o + near * DVec3::NEG_Z);
        let chord = lens.hit(q.as_vec3().as_dvec3(), DVec3::NEG_Z, true).expect("its far side") / scale;
        let expected = 2.0 * ((2.2f64 * 2.2 - r * r).sqrt() - 2.0);
        assert!((chord - expected).abs() < 3e-6, "{chord} {expected}");
    }
    for hole in [0.2f64, 0.5, 0.8] {
        let ring = Alone::new(&format!(
            "Difference(objects: [Sphere(center: (0, 0, 0), radius: 1), \
             Cylinder(from: (0, -2, 0), to: (0, 2, 0), radius: {hole})])"
        ));
        let (n, scale) = (400, ring.0.frame.scale);
        let mut volume = 0.0;
        for i in 0..n {
            for j in 0..n {
                let at = |k: i32| -1.0 + 2.0 * (f64::from(k) + 0.5) / f64::from(n);
                let d = DVec3::NEG_X;
                let mut from = ring.point(DVec3::new(5.0, at(i), at(j)));
                let mut leaves = false;
                let mut inside = false;
                while let Some(t) = ring.hit(from, d, leaves) {
                    if inside {
                        volume += t / scale;
                    }
                    (inside, leaves) = (!inside, true);
                    from = ring.on(from + t * d).2.as_vec3().as_dvec3();
                }
                assert!(!inside, "a ray is lost in the ring");
            }
        }
        volume *= 4.0 / f64::from(n * n);
        let half = (1.0 - hole * hole).sqrt();
        let expected = 4.0 / 3.0 * std::f64::consts::PI * half * half * half;
        assert!((volume - expected).abs() < 3e-3, "{hole}: {volume} {expected}");
    }
}

/// The most that a solid may be made of, and the least.
#[test]
fn solids_of_one_and_of_many() {
    let mut many = String::new();
    for k in 0..63 {
        write!(many, "Box(center: ({}, 0, 0), size: (0.5, 1, 1)), ", f64::from(k) - 31.0).expect("a text");
    }
    let alone = Alone::new(&format!("Difference(objects: [Box(size: (80, 0.8, 0.8)), {many}])"));
    let o = alone.point(DVec3::new(41.0, 0.1, 0.1));
    let (mut from, mut leaves, mut met) = (o, false, 0);
    while let Some(t) = alone.hit(from, DVec3::NEG_X, leaves) {
        met += 1;
        leaves = true;
        from = alone.on(from + t * DVec3::NEG_X).2.as_vec3().as_dvec3();
    }
    assert_eq!(met, 128);
    let one = Alone::new("Difference(objects: [Sphere(center: (0, 0, 0), radius: 1)])");
    assert!(one.hit(one.point(DVec3::new(0.0, 0.0, 5.0)), DVec3::NEG_Z, false).is_some());
}
