//! Tubes are what all their balls pass over: by points that are within or without.

use super::round::tube;
use super::{Vector, dot, open_edges, volume};
use crate::MeshData;
use crate::shapes::Triangulated;
use scene_format::desc::{Curve, Radii, Tube, TubeCurve};
use scene_format::diagnostic::Span;
use scene_format::path::{Ends, pieces};
use std::f64::consts::{PI, TAU};

/// Numbers that look random, from 0 to 1.
pub(super) struct Random(pub u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn direction(&mut self) -> Vector {
        let (z, angle) = (self.between(-1.0, 1.0), self.between(0.0, TAU));
        let r = (1.0 - z * z).sqrt();
        [r * libm::cos(angle), r * libm::sin(angle), z]
    }
}

fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn plus(a: Vector, b: Vector, times: f64) -> Vector {
    [0, 1, 2].map(|k| a[k] + times * b[k])
}

/// How often the mesh goes round a point, by the triangles that a ray passes.
fn winding(mesh: &MeshData, at: Vector, ray: Vector) -> i32 {
    let of = |triangle: &[u32; 3]| {
        let [a, b, c] = super::corners(mesh, *triangle).map(|p| minus(p, at));
        let sides = [[a, b], [b, c], [c, a]].map(|[p, q]| dot(ray, super::cross(p, q)));
        let passes = |sign: f64| sides.iter().all(|side| side * sign > 0.0);
        if !passes(1.0) && !passes(-1.0) {
            return 0;
        }
        let sign = if passes(1.0) { 1 } else { -1 };
        let n = super::cross(minus(b, a), minus(c, a));
        if dot(a, n) * dot(ray, n) > 0.0 { sign } else { 0 }
    };
    mesh.triangles.iter().map(of).sum()
}

/// The balls of a tube, close together.
fn balls(points: &[Vector], radii: &[f64], closed: bool) -> Vec<(Vector, f64)> {
    let spans = if closed { points.len() } else { points.len() - 1 };
    let on = |k: usize, t: f64| {
        let next = (k + 1) % points.len();
        (plus(points[k], minus(points[next], points[k]), t), radii[k] + t * (radii[next] - radii[k]))
    };
    (0..spans).flat_map(|k| (0..=600).map(move |n| on(k, f64::from(n) / 600.0))).collect()
}

/// How far outside of all balls a point lies.
fn outside(at: Vector, balls: &[(Vector, f64)]) -> f64 {
    let of = |(center, radius): &(Vector, f64)| {
        let way = minus(at, *center);
        dot(way, way).sqrt() - radius
    };
    balls.iter().map(of).fold(f64::INFINITY, f64::min)
}

/// Points at both sides of the surface, and elsewhere, are where the balls say; vertices are not outside.
pub(super) fn holds(shape: &Tube, balls: &[(Vector, f64)], what: &str) -> Result<(), String> {
    let mesh = shape.mesh(Span::NONE).map_err(|fault| format!("{what}: {}", fault.message))?;
    if open_edges(&mesh) != 0 {
        return Err(format!("{what}: it is open"));
    }
    let size = balls.iter().map(|ball| ball.1).fold(0.0, f64::max);
    let far = mesh.positions.iter().map(|&at| outside(at, balls)).fold(f64::NEG_INFINITY, f64::max);
    if far > 2e-3 * size || mesh.positions.as_flattened().iter().any(|x| !x.is_finite()) {
        return Err(format!("{what}: a vertex is {far} outside"));
    }
    // What chords of 1/64 of the turn leave out, across and along.
    let step = TAU / f64::from(shape.segments.value);
    let near = 2.2 * size * (1.0 - libm::cos(0.5 * step));
    // Of curves the path itself has chords.
    let near = if shape.curve == TubeCurve::Linear { near } else { 0.004 };
    let mut random = Random(7);
    for k in 0..150 {
        let ball = &balls[(random.next() * balls.len() as f64) as usize % balls.len()];
        let reach = match k % 3 {
            0 => ball.1 + 1.1 * near,
            1 => ball.1 - 1.1 * near,
            _ => 1.5 * ball.1 * random.next(),
        };
        let at = plus(ball.0, random.direction(), reach);
        let off = outside(at, balls);
        let ray = random.direction();
        let around = winding(&mesh, at, ray);
        let right = if off > near { around == 0 } else { off > -near || around > 0 };
        if !right {
            return Err(format!("{what}: {at:?} is {off} outside, and within it {around} times"));
        }
    }
    Ok(())
}

fn check_linear(points: &[Vector], radii: &[f64], closed: bool) -> Result<(), String> {
    let mut tube = tube(points, Radii::Each(radii.to_vec()), TubeCurve::Linear, closed);
    tube.segments = 64.into();
    holds(&tube, &balls(points, radii, closed), &format!("{points:?} {radii:?} {closed}"))
}

/// A path that turns by so many degrees.
fn bent(degrees: f64) -> [Vector; 3] {
    let angle = degrees.to_radians();
    [[-1.0, 0.0, 0.0], [0.0; 3], [libm::cos(angle), libm::sin(angle), 0.0]]
}

#[test]
fn sharp_elbows_are_what_balls_pass_over() {
    let mut faults = Vec::new();
    for degrees in [0.0, 1e-4, 20.0, 90.0, 140.0, 150.0, 170.0, 179.0, 179.999, 180.0 - 1e-8, 180.0] {
        for radii in [
            [0.1, 0.5, 0.1],
            [0.4, 0.1, 0.4],
            [0.2, 0.2, 0.2],
            [0.1, 0.3, 0.5],
            [0.5, 0.3, 0.1],
            [0.9, 0.05, 0.4],
            [0.3, 1.3, 0.3],
            [1.2, 0.1, 0.3],
            [0.3, 0.1, 1.2],
            [0.1, 1.1, 0.4],
        ] {
            faults.extend(check_linear(&bent(degrees), &radii, false).err());
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn random_tubes_are_what_balls_pass_over() {
    let mut faults = Vec::new();
    let mut random = Random(1);
    for k in 0..60 {
        let count = 2 + (random.next() * 5.0) as usize;
        let closed = count > 2 && random.next() < 0.3;
        let thick = if k % 3 == 0 { 0.2 } else { 0.8 };
        let points: Vec<Vector> = (0..count).map(|_| [0; 3].map(|_: i32| random.between(-1.0, 1.0))).collect();
        let radii: Vec<f64> = (0..count).map(|_| random.between(0.05, thick)).collect();
        let balls = balls(&points, &radii, closed);
        // What lies in all balls of a ring may be a hollow within it.
        let size = radii.iter().fold(0.0_f64, |most, r| most.max(*r));
        let hollow = closed && balls.iter().all(|ball| outside(ball.0, &balls) < -0.3 * size) && thick > 0.5;
        if !hollow {
            faults.extend(check_linear(&points, &radii, closed).err());
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// Curves that turn back, or nearly, and such as bend tighter than their radius, some with radii that swell.
#[test]
fn curves_are_what_balls_pass_over() {
    let mut cases: Vec<(Vec<Vector>, f64)> = Vec::new();
    for off in [0.3, 0.03, 0.01, 1e-3, 1e-6, 0.0] {
        cases.push((vec![[-1.0, -off, 0.0], [1.0, 0.0, 0.0], [-1.0, off, 0.0]], 0.3));
    }
    cases.push((vec![[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3]], 0.3));
    cases.push((vec![[-0.3, 0.1, 0.7], [0.4, -0.3, 0.2], [-0.3, 0.1, 0.7], [0.1, 0.9, 0.2]], 0.25));
    cases.push((vec![[0.0; 3], [0.3, 0.0, 0.0], [0.3, 0.2, 0.0], [0.0, 0.2, 0.1]], 0.4));
    let mut faults = Vec::new();
    for (points, radius) in cases {
        let path = pieces(&points, Ends::Open, true, 0.01);
        let balls: Vec<(Vector, f64)> = path
            .iter()
            .flat_map(|piece| {
                let way = minus(piece.to, piece.from);
                let count = (300.0 * dot(way, way).sqrt()).ceil().max(1.0);
                (0..=count as u32).map(move |n| (plus(piece.from, way, f64::from(n) / count), radius))
            })
            .collect();
        let mut shape = tube(&points, Radii::All(radius), TubeCurve::CatmullRom, false);
        shape.segments = 64.into();
        faults.extend(holds(&shape, &balls, &format!("{points:?}")).err());
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// On a straight path of a smooth tube the radius swells smoothly, too.
#[test]
fn radii_of_smooth_tubes_swell_smoothly() {
    let points = [[-1.0, 0.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0]];
    let mesh = tube(&points, Radii::Each(vec![0.1, 0.4, 0.1]), TubeCurve::CatmullRom, false).mesh(Span::NONE);
    let mesh = mesh.expect("a mesh");
    // Half way of a cubic that is flat in the middle and 0.3 steep at the end: 0.1 + 0.15 + (0.3 - 0)/8.
    let widest = |x: f64| {
        let near = mesh.positions.iter().filter(|p| (p[0] - x).abs() < 0.15);
        near.map(|p| libm::hypot(p[1], p[2])).fold(0.0, f64::max)
    };
    assert!(widest(-0.5) > 0.29, "{}", widest(-0.5));
    assert_eq!(open_edges(&mesh), 0);
}

/// Where no piece is short both pieces meet in a seam: nothing lies within, and the volume is that of the balls' way.
#[test]
fn elbows_with_room_have_nothing_within() {
    for (degrees, radii) in
        [(60.0, [0.2; 3]), (90.0, [0.25, 0.2, 0.15]), (100.0, [0.1, 0.2, 0.1]), (40.0, [0.3, 0.1, 0.2])]
    {
        let points = bent(degrees);
        for segments in [32, 128] {
            let mut shape = tube(&points, Radii::Each(radii.to_vec()), TubeCurve::Linear, false);
            shape.segments = segments.into();
            let mesh = shape.mesh(Span::NONE).expect("a mesh");
            super::check(&mesh);
            let mut random = Random(3);
            for _ in 0..300 {
                let at = [random.between(-1.3, 1.3), random.between(-0.4, 1.3), random.between(-0.3, 0.3)];
                let ray = random.direction();
                let around = winding(&mesh, at, ray);
                assert!((0..=1).contains(&around), "{degrees} {radii:?}: {at:?} is within {around} times");
            }
            assert!(volume(&mesh) < PI);
        }
    }
}

/// A sixteenth of a piece, and what normals between two of unit length are short.
const ASKEW: f64 = 1.02 / 16.0;

/// The azimuth of interpolated normals against that of the place, in pieces, at most: of a band of a lathe and of a
/// tapered tube, cut by their middles, and of two triangles.
#[test]
fn normals_of_cones_are_not_askew() {
    let worst = |mesh: &MeshData, heights: [f64; 2]| {
        let normals = mesh.normal_triangles.as_ref().expect("some");
        let mut worst = 0.0_f64;
        for (triangle, normals) in mesh.triangles.iter().zip(normals) {
            let places = super::corners(mesh, *triangle);
            if places.iter().any(|p| p[1] < heights[0] || p[1] > heights[1]) {
                continue;
            }
            for k in 0..=20 {
                for l in 0..=20 - k {
                    let shares = [k, l, 20 - k - l].map(|n| f64::from(n) / 20.0);
                    let mix = |all: [Vector; 3]| [0, 1, 2].map(|x| (0..3).map(|c| shares[c] * all[c][x]).sum());
                    let (p, n): (Vector, Vector) =
                        (mix(places), mix(normals.map(|k| mesh.normals[k as usize].map(f64::from))));
                    if libm::hypot(p[0], p[2]) < 1e-6 {
                        continue;
                    }
                    let off = libm::atan2(n[0] * p[2] - n[2] * p[0], n[0] * p[0] + n[2] * p[2]);
                    worst = worst.max(off.abs() / (TAU / 32.0));
                }
            }
        }
        worst
    };
    for (r, s) in [(0.9, 0.1), (1.0, 0.7), (0.3, 0.29), (0.02, 1.0)] {
        let lathe = super::lathe(&[[r, 0.0], [s, 5.0]], Curve::Linear, 32).mesh(Span::NONE).expect("a mesh");
        assert!(worst(&lathe, [-1.0, 6.0]) < ASKEW, "{r} {s}: {}", worst(&lathe, [-1.0, 6.0]));
        // Balls that give a cone.
        let points = [[0.0; 3], [0.0, 5.0, 0.0]];
        let tube = tube(&points, Radii::Each(vec![r, s]), TubeCurve::Linear, false).mesh(Span::NONE).expect("a mesh");
        assert!(worst(&tube, [-2.0, 7.0]) < ASKEW, "{r} {s}: {}", worst(&tube, [-2.0, 7.0]));
    }
    // All but e^-2 of a sharp tip.
    let tip = super::lathe(&[[0.0, 0.0], [1.0, 0.0], [0.0, 5.0]], Curve::Linear, 32).mesh(Span::NONE).expect("a mesh");
    let most = 5.0 * (1.0 - libm::exp(-2.0));
    assert!(worst(&tip, [1e-9, most + 1e-9]) < ASKEW, "{}", worst(&tip, [1e-9, most + 1e-9]));
}

/// v grows along the tube, over elbows too, and on the outer side by the length on it.
#[test]
fn texture_coordinates_go_on_over_elbows() {
    let square = [[0.0; 3], [2.0, 0.0, 0.0], [2.0, 0.0, 2.0], [0.0, 0.0, 2.0]];
    for closed in [false, true] {
        let mesh = tube(&square, Radii::All(0.4), TubeCurve::Linear, closed).mesh(Span::NONE).expect("a mesh");
        let uvs = mesh.uv_triangles.as_ref().expect("some");
        let whole = if closed { 8.0 + 4.0 * 0.4 * PI / 2.0 } else { 6.0 + 2.0 * 0.4 * PI / 2.0 + 0.4 * PI };
        let (mut steepest, mut flattest) = (0.0_f64, f64::INFINITY);
        for (triangle, uvs) in mesh.triangles.iter().zip(uvs) {
            let (p, uv) = (super::corners(&mesh, *triangle), uvs.map(|k| mesh.uvs[k as usize].map(f64::from)));
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                // Along the outermost line.
                let way = minus(p[b], p[a]);
                let out = |p: Vector| (p[0] - 1.0).abs().max((p[2] - 1.0).abs()) > 1.38 && p[1].abs() < 0.05;
                if uv[a][0] == uv[b][0] && out(p[a]) && out(p[b]) {
                    let rate = (uv[b][1] - uv[a][1]).abs() * whole / dot(way, way).sqrt();
                    (steepest, flattest) = (steepest.max(rate), flattest.min(rate));
                }
            }
        }
        assert!(flattest > 0.98 && steepest < 1.03, "{closed}: {flattest} {steepest}");
        let v = mesh.uvs.iter().map(|uv| uv[1]);
        assert_eq!((v.clone().fold(1.0, f32::min), v.fold(0.0, f32::max)), (0.0, 1.0));
    }
}

/// Of points that are one the largest ball counts, also of the one that closes a path.
#[test]
fn of_balls_in_one_place_the_largest_counts() {
    let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let of = |points: &[Vector], radii: &[f64], closed: bool| {
        let mesh = tube(points, Radii::Each(radii.to_vec()), TubeCurve::Linear, closed).mesh(Span::NONE);
        mesh.expect("a mesh").positions
    };
    assert_eq!(of(&[a, b, b, c], &[0.1, 0.1, 0.3, 0.1], false), of(&[a, b, c], &[0.1, 0.3, 0.1], false));
    assert_eq!(of(&[a, b, c, a], &[0.1, 0.2, 0.1, 0.3], true), of(&[a, b, c], &[0.3, 0.2, 0.1], true));
}

/// Smooth radii that grow faster than the path: balls that swallow others within a span.
#[test]
fn smooth_radii_that_swallow() {
    let points = [[-1.0, 0.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0]];
    let mut balls = Vec::new();
    for k in 0..=1000 {
        let t = f64::from(k) / 1000.0;
        // Flat in the middle, 0.8 steep at the end.
        let (t2, t3) = (t * t, t * t * t);
        let radius = 0.1 + 0.8 * (t3 - 2.0 * t2 + t) + 0.8 * (3.0 * t2 - 2.0 * t3);
        balls.extend([([t - 1.0, 0.0, 0.0], radius), ([1.0 - t, 0.0, 0.0], radius)]);
    }
    let mut shape = tube(&points, Radii::Each(vec![0.1, 0.9, 0.1]), TubeCurve::CatmullRom, false);
    shape.segments = 64.into();
    assert_eq!(holds(&shape, &balls, "swallowed"), Ok(()));
}
