//! What is closed is closed, its front is outside, and vertices, normals and texture coordinates are those of the surface itself.

use super::*;
use crate::NO_INDEX;
use scene_format::desc::{
    Arrow, Corners, Curve, Extrude, Lathe, MaterialRef, Name, Outline, PathPoints, Placements, Polygon, Profile, Radii,
    Torus, Tube,
};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn corners(mesh: &MeshData, triangle: [u32; 3]) -> [Vector; 3] {
    triangle.map(|k| mesh.positions[k as usize])
}

/// Twice the area, along the normal.
fn area(mesh: &MeshData, triangle: [u32; 3]) -> Vector {
    let [a, b, c] = corners(mesh, triangle);
    let edge = |p: Vector| [0, 1, 2].map(|k| p[k] - a[k]);
    cross(edge(b), edge(c))
}

fn volume(mesh: &MeshData) -> f64 {
    let of = |&t: &[u32; 3]| {
        let [a, b, c] = corners(mesh, t);
        dot(a, cross(b, c)) / 6.0
    };
    mesh.triangles.iter().map(of).sum()
}

/// Edges that are not between two triangles that go along them in opposite ways, by the numbers of their ends.
fn open_edges(mesh: &MeshData) -> usize {
    let mut edges: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    for &[a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            assert_ne!(from, to);
            *edges.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
        }
    }
    edges.values().filter(|ways| **ways != 0).count()
}

/// What holds for every mesh: triangles have an area, all that they name is there, normals are of unit length and on the front.
fn check(mesh: &MeshData) {
    let normals = mesh.normal_triangles.as_ref().unwrap_or(&mesh.triangles);
    let uvs = mesh.uv_triangles.as_ref().unwrap_or(&mesh.triangles);
    assert!(uvs.len() == mesh.triangles.len() && normals.len() == mesh.triangles.len());
    for ((&triangle, normals), uvs) in mesh.triangles.iter().zip(normals).zip(uvs) {
        let n = area(mesh, triangle);
        assert!(dot(n, n) > 0.0, "{triangle:?} has no area");
        assert!(uvs.iter().all(|&k| (k as usize) < mesh.uvs.len()));
        for &k in normals.iter().filter(|&&k| k != NO_INDEX && !mesh.normals.is_empty()) {
            let m = mesh.normals[k as usize].map(f64::from);
            assert!((dot(m, m) - 1.0).abs() < 1e-6 && dot(n, m) > 0.0, "{triangle:?} {n:?} {m:?}");
        }
    }
    assert!(mesh.positions.as_flattened().iter().all(|x| x.is_finite()));
}

fn lathe(profile: &[[f64; 2]], curve: Curve, segments: u32) -> Lathe {
    Lathe {
        profile: Profile(profile.to_vec()).into(),
        curve,
        segments: segments.into(),
        material: MaterialRef::Default,
        transform: Vec::new(),
        placements: Placements::One,
        name: Name::default(),
    }
}

fn made(shape: &dyn Triangulated) -> MeshData {
    let mesh = shape.mesh(Span::NONE).expect("a mesh");
    check(&mesh);
    mesh
}

/// A cone, a ring with a square section, a spindle that meets the axis in the middle, a wine glass; each also written the other way.
#[test]
fn closed_lathes_have_no_gap_and_face_outwards() {
    let cone: &[[f64; 2]] = &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let ring: &[[f64; 2]] = &[[1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 0.0]];
    let spindle: &[[f64; 2]] = &[[0.0, -2.0], [1.0, -1.0], [0.0, 0.0], [1.0, 1.0], [0.0, 2.0]];
    let glass: &[[f64; 2]] =
        &[[0.0, 0.0], [1.0, 0.0], [1.0, 0.1], [0.1, 0.2], [0.1, 1.0], [1.0, 2.0], [0.9, 2.0], [0.0, 1.1], [0.0, 0.0]];
    // An n-gon inscribed in a circle has n/2 sin(2 pi/n) of its radius squared, instead of pi.
    let of = |n: u32| 0.5 * f64::from(n) * libm::sin(TAU / f64::from(n));
    for n in [3, 8, 128] {
        for (profile, solid) in [(cone, Some(1.0 / 3.0)), (ring, Some(3.0)), (spindle, Some(4.0 / 3.0)), (glass, None)]
        {
            let backwards: Vec<[f64; 2]> = profile.iter().rev().copied().collect();
            for profile in [profile, &backwards] {
                for curve in [Curve::Linear, Curve::CatmullRom] {
                    let lathe = lathe(profile, curve, n);
                    assert!(lathe.is_closed());
                    let mesh = made(&lathe);
                    assert_eq!(open_edges(&mesh), 0, "{profile:?} {curve:?} {n}");
                    assert!(volume(&mesh) > 0.0, "{profile:?} {curve:?} {n}");
                    if let (Some(solid), Curve::Linear) = (solid, curve) {
                        assert!((volume(&mesh) - solid * of(n)).abs() < 1e-12 * n as f64, "{profile:?} {n}");
                    }
                }
            }
        }
    }
}

/// Vertices lie on circles about the axis; normals are those of the cone that a line turns into; u is the longitude that has its middle at
/// +z, v the length along the profile.
#[test]
fn vertices_of_lathes_are_those_of_the_surface() {
    let mesh = made(&lathe(&[[1.0, -1.0], [2.0, 1.0]], Curve::Linear, 64));
    let (normals, uvs) = (mesh.normal_triangles.as_ref().expect("some"), mesh.uv_triangles.as_ref().expect("some"));
    assert_eq!((mesh.triangles.len(), open_edges(&mesh)), (128, 128));
    let length = 5.0_f64.sqrt();
    for ((triangle, normals), uvs) in mesh.triangles.iter().zip(normals).zip(uvs) {
        for ((&p, &n), &uv) in triangle.iter().zip(normals).zip(uvs) {
            let ([x, y, z], [u, v]) = (mesh.positions[p as usize], mesh.uvs[uv as usize].map(f64::from));
            let r = libm::hypot(x, z);
            assert!((r - (1.5 + 0.5 * y)).abs() < 1e-12);
            let n = mesh.normals[n as usize].map(f64::from);
            let true_n = [2.0 * x / r / length, -1.0 / length, 2.0 * z / r / length];
            assert!((0..3).all(|k| (n[k] - true_n[k]).abs() < 1e-6), "{n:?} {true_n:?}");
            assert!((v - (y + 1.0) / 2.0).abs() < 1e-6);
            let away = (u - 0.5 - libm::atan2(x, z) / TAU).rem_euclid(1.0);
            assert!(away.min(1.0 - away) < 1e-6, "{u} {x} {z}");
        }
        // No triangle goes round the seam.
        let us = uvs.map(|k| mesh.uvs[k as usize][0]);
        assert!(us.iter().all(|u| (u - us[0]).abs() < 0.02));
    }
}

/// How far a normal may be turned where a curve leaves a circle by `off` half way over an angle of 2h: it does so by about
/// 16 off t^2 (1-t)^2, which is never steeper than 3.08 off/2h; a quarter more for what is not in that.
fn turned_by(off: f64, h: f64) -> f64 {
    2.0 * off / h
}

/// A half circle of points of a sphere, as a curve: off the sphere by little, and its normals are the radii, also at the poles.
#[test]
fn a_curved_profile_is_round() {
    let profile: Vec<[f64; 2]> = (0..=12)
        .map(|k| {
            let angle = PI * f64::from(k) / 12.0;
            [if k == 0 || k == 12 { 0.0 } else { libm::sin(angle) }, -libm::cos(angle)]
        })
        .collect();
    let mesh = made(&lathe(&profile, Curve::CatmullRom, 128));
    assert_eq!(open_edges(&mesh), 0);
    let normals = mesh.normal_triangles.as_ref().expect("some");
    for (triangle, normals) in mesh.triangles.iter().zip(normals) {
        for (&p, &n) in triangle.iter().zip(normals) {
            let (p, n) = (mesh.positions[p as usize], mesh.normals[n as usize].map(f64::from));
            // Half way between points 2h apart the curve is at cos h + sin 2h sin h/4, with h 7.5 degrees: nowhere is it farther off.
            let h = PI / 24.0;
            let off = 1.0 - (libm::cos(h) + libm::sin(2.0 * h) * libm::sin(h) / 4.0);
            assert!((dot(p, p).sqrt() - 1.0).abs() < off + 1e-12, "{p:?}");
            assert!(dot(p, n) > dot(p, p).sqrt() * libm::cos(turned_by(off, h)), "{p:?} {n:?}");
        }
    }
}

/// 39 degrees are shaded as round, 41 have an edge.
#[test]
fn lathes_have_edges_over_40_degrees() {
    for (turn, edge) in [(39.0_f64, false), (41.0, true)] {
        let angle = turn.to_radians();
        let end = [1.0 - libm::sin(angle), 1.0 + libm::cos(angle)];
        let mesh = made(&lathe(&[[1.0, 0.0], [1.0, 1.0], end], Curve::Linear, 16));
        let normals = mesh.normal_triangles.as_ref().expect("some");
        let mut of_vertex: BTreeMap<u32, Vec<[f32; 3]>> = BTreeMap::new();
        for (triangle, normals) in mesh.triangles.iter().zip(normals) {
            for (&p, &n) in triangle.iter().zip(normals) {
                of_vertex.entry(p).or_default().push(mesh.normals[n as usize]);
            }
        }
        let split = of_vertex.values().filter(|all| all.iter().any(|n| *n != all[0])).count();
        assert_eq!(split, if edge { 16 } else { 0 }, "{turn}");
    }
}

#[test]
fn what_makes_no_lathe_is_told() {
    let told = |profile: &[[f64; 2]], segments: u32| {
        let fault = lathe(profile, Curve::Linear, segments).mesh(Span::NONE).expect_err("none");
        format!("{} {}", fault.code.as_str(), fault.message)
    };
    assert_eq!(told(&[[1.0, 1.0], [1.0, 1.0]], 8), "E0542 the profile of the lathe has no extent");
    assert_eq!(told(&[[1.0, 1.0], [2.0, 1.0], [1.0, 1.0]], 8), "E0542 the profile of the lathe has no extent");
    assert_eq!(told(&[[0.0, 1.0], [0.0, 2.0]], 8), "E0542 the profile of the lathe lies on its axis");
    let many: Vec<[f64; 2]> = (0..10_000).map(|k| [1.0, f64::from(k)]).collect();
    assert_eq!(told(&many, 4096), "E0606 the lathe would have 81911808 triangles");
}

fn extrude(rings: &[&[[f64; 2]]], depth: f64, curve: Curve) -> Extrude {
    Extrude {
        outline: Outline(rings.iter().map(|ring| ring.to_vec()).collect()).into(),
        depth: depth.into(),
        curve,
        material: MaterialRef::Default,
        transform: Vec::new(),
        placements: Placements::One,
        name: Name::default(),
    }
}

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
const HOLE: [[f64; 2]; 4] = [[1.0, 1.0], [2.0, 1.0], [2.0, 3.0], [1.0, 3.0]];

/// Corners on straight sides, holes side by side, a comb of many teeth, points far from the origin.
#[test]
fn extrudes_have_no_gap_face_outwards_and_fill_their_outline() {
    let notched: &[[f64; 2]] =
        &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [4.0, 0.0], [4.0, 2.0], [4.0, 4.0], [2.0, 0.5], [0.0, 4.0]];
    let other = HOLE.map(|[x, y]| [x + 1.5, y]);
    let comb: Vec<[f64; 2]> = (0..500)
        .flat_map(|k| [[f64::from(k), 0.0], [f64::from(k) + 0.5, 9.0]])
        .chain([[500.0, 0.0], [500.0, -1.0], [0.0, -1.0]])
        .collect();
    let far = SQUARE.map(|p| p.map(|x| 1e9 + x));
    let cases: [(&[&[[f64; 2]]], f64); 5] = [
        (&[&SQUARE, &HOLE, &other], 12.0),
        (&[notched], 16.0 - 0.5 * 4.0 * 3.5),
        (&[&comb], 500.0 * 4.5 + 500.0),
        (&[&far], 16.0),
        (&[&SQUARE], 16.0),
    ];
    for (rings, face) in cases {
        let backwards: Vec<Vec<[f64; 2]>> = rings.iter().map(|ring| ring.iter().rev().copied().collect()).collect();
        let backwards: Vec<&[[f64; 2]]> = backwards.iter().map(Vec::as_slice).collect();
        for rings in [rings, &backwards] {
            let mesh = made(&extrude(rings, 2.0, Curve::Linear));
            assert_eq!(open_edges(&mesh), 0);
            let origin = mesh.positions[0];
            let near: Vec<[f64; 3]> = mesh.positions.iter().map(|p| [0, 1, 2].map(|k| p[k] - origin[k])).collect();
            let full = volume(&MeshData { positions: near, ..mesh.clone() });
            assert!((full - 2.0 * face).abs() < 1e-9 * face, "{full} {face}");
            // Nothing lies over anything else: the ends have the area of the face.
            let ends = mesh.triangles.iter().map(|&t| area(&mesh, t)).filter(|n| n[0] == 0.0 && n[1] == 0.0);
            let sum: f64 = ends.map(|n| n[2].abs() / 2.0).sum();
            assert!((sum - 2.0 * face).abs() < 1e-9 * face, "{sum} {face}");
        }
    }
}

/// Texture coordinates of a square with a hole: of each face as the manual says them.
#[test]
fn faces_of_extrudes_have_upright_textures() {
    let mesh = made(&extrude(&[&SQUARE, &HOLE], 2.0, Curve::Linear));
    let uvs = mesh.uv_triangles.as_ref().expect("some");
    for (&triangle, uvs) in mesh.triangles.iter().zip(uvs) {
        let n = area(&mesh, triangle);
        for (&p, &uv) in triangle.iter().zip(uvs) {
            let ([x, y, z], [u, v]) = (mesh.positions[p as usize], mesh.uvs[uv as usize].map(f64::from));
            let expected = match n[2] {
                0.0 => [u, z / 2.0],
                up if up > 0.0 => [x / 4.0, y / 4.0],
                _ => [1.0 - x / 4.0, y / 4.0],
            };
            assert!((u - expected[0]).abs() < 1e-6 && (v - expected[1]).abs() < 1e-6, "{n:?} {u} {v}");
        }
    }
    // Sides of the square: a quarter of the way round each.
    let side = |k: usize| mesh.uvs[uvs[mesh.triangles.len() - 16 + 2 * k][0] as usize][0];
    assert_eq!([0, 1, 2, 3].map(side), [0.0, 0.25, 0.5, 0.75]);
}

/// Twelve points of a circle, joined by a curve: round within the error of its cubics, with the circle's normals.
#[test]
fn curved_outlines_are_round() {
    let ring: Vec<[f64; 2]> =
        (0..12).map(|k| PI * f64::from(k) / 6.0).map(|angle| [libm::cos(angle), libm::sin(angle)]).collect();
    let mesh = made(&extrude(&[&ring], 1.0, Curve::CatmullRom));
    assert_eq!(open_edges(&mesh), 0);
    let h = PI / 12.0;
    let off = 1.0 - (libm::cos(h) + libm::sin(2.0 * h) * libm::sin(h) / 4.0);
    let normals = mesh.normal_triangles.as_ref().expect("some");
    for (triangle, normals) in mesh.triangles.iter().zip(normals) {
        for (&p, &n) in triangle.iter().zip(normals) {
            let [x, y, _] = mesh.positions[p as usize];
            assert!((libm::hypot(x, y) - 1.0).abs() < off + 1e-12, "{x} {y}");
            if n != NO_INDEX {
                let n = mesh.normals[n as usize].map(f64::from);
                assert!(n[0] * x + n[1] * y > libm::hypot(x, y) * libm::cos(turned_by(off, h)), "{x} {y} {n:?}");
            }
        }
    }
}

#[test]
fn what_bounds_no_face_is_told() {
    let told = |rings: &[&[[f64; 2]]]| {
        let fault = extrude(rings, 1.0, Curve::Linear).mesh(Span::NONE).expect_err("none");
        format!("{} {}", fault.code.as_str(), fault.message)
    };
    let bow: &[[f64; 2]] = &[[0.0, 0.0], [2.0, 1.0], [2.0, 0.0], [0.0, 2.0]];
    assert!(told(&[bow]).starts_with("E0545 the outline of the extrude crosses itself: "), "{}", told(&[bow]));
    let outer = told(&[&SQUARE, &HOLE.map(|[x, y]| [x + 2.5, y])]);
    assert!(outer.starts_with("E0545 hole 1 of the extrude crosses the outline of the extrude: "), "{outer}");
    let outside = told(&[&SQUARE, &HOLE.map(|[x, y]| [x + 9.0, y])]);
    assert_eq!(outside, "E0545 hole 1 of the extrude is not within its outline");
    let inner = HOLE.map(|[x, y]| [1.4 + 0.1 * x, 1.5 + 0.1 * y]);
    assert_eq!(told(&[&SQUARE, &HOLE, &inner]), "E0545 hole 2 of the extrude is within another hole");
    assert_eq!(told(&[&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]]), "E0542 the outline of the extrude lies on one line");
    assert_eq!(told(&[&[[0.0, 0.0], [1.0, 1.0], [0.0, 0.0]]]), "E0542 the outline of the extrude has no extent");
    let pinched: &[[f64; 2]] = &[[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]];
    assert_eq!(told(&[pinched]), "E0545 the outline of the extrude touches itself at (1, 1)");
    let touching = told(&[&SQUARE, &HOLE.map(|[x, y]| [x - 1.0, y])]);
    assert!(touching.starts_with("E0545 ") && touching.contains("passes through another point"), "{touching}");
}

fn polygon(points: &[[f64; 3]]) -> Polygon {
    Polygon {
        points: Corners(points.to_vec()).into(),
        material: MaterialRef::Default,
        transform: Vec::new(),
        placements: Placements::One,
        name: Name::default(),
    }
}

/// An arrowhead facing +y: right is x, up -z.
#[test]
fn polygons_face_where_they_go_round_counter_clockwise() {
    let mesh = made(&polygon(&[[0.0, 5.0, 0.0], [2.0, 5.0, 1.0], [0.0, 5.0, -3.0], [-2.0, 5.0, 1.0]]));
    let doubled: f64 = mesh.triangles.iter().map(|&t| area(&mesh, t)[1]).sum();
    assert_eq!((mesh.triangles.len(), doubled), (2, 12.0));
    for (&[x, _, z], uv) in mesh.positions.iter().zip(&mesh.uvs) {
        let expected = [0.5 + x / 4.0, 0.5 + (-z - 1.0) / 4.0];
        assert!((0..2).all(|k| (f64::from(uv[k]) - expected[k]).abs() < 1e-6), "{uv:?} {expected:?}");
    }
}

#[test]
fn what_makes_no_polygon_is_told() {
    let told = |points: &[[f64; 3]]| {
        let fault = polygon(points).mesh(Span::NONE).expect_err("none");
        format!("{} {}", fault.code.as_str(), fault.message)
    };
    let line = [0.0, 1.0, 5.0].map(|x| [x, x, 2.0 * x]);
    assert_eq!(told(&line), "E0542 the polygon has no extent");
    let bent = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.001], [1.0, 1.0, 0.0], [0.0, 1.0, 0.001]];
    assert!(told(&bent).starts_with("E0545 the points of the polygon lie up to "), "{}", told(&bent));
    let crossing = [[0.0, 0.0, 0.0], [3.0, 1.0, 0.0], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    assert!(
        told(&crossing).starts_with("E0545 the polygon crosses itself: the side from points["),
        "{}",
        told(&crossing)
    );
}

fn tube(points: &[[f64; 3]], radius: Radii, curve: Curve, closed: bool) -> Tube {
    Tube {
        points: PathPoints(points.to_vec()).into(),
        radius: radius.into(),
        curve,
        closed,
        segments: 32.into(),
        material: MaterialRef::Default,
        transform: Vec::new(),
        placements: Placements::One,
        name: Name::default(),
    }
}

/// How far outside of all balls along straight pieces a point lies, at least; the balls' radii change evenly.
fn outside(at: Vector, points: &[Vector], radii: &[f64], closed: bool) -> f64 {
    let spans = if closed { points.len() } else { points.len() - 1 };
    let of = |k: usize| {
        let (a, b) = (points[k], points[(k + 1) % points.len()]);
        let (r, s) = (radii[k], radii[(k + 1) % points.len()]);
        let [to, from] = [b, at].map(|p| [0, 1, 2].map(|axis| p[axis] - a[axis]));
        let way = dot(to, to).sqrt();
        let (x, slope) = (dot(from, to) / way, (s - r) / way);
        // The nearest ball's middle lies where the normal leads.
        let y = (dot(from, from) - x * x).max(0.0).sqrt();
        let t = (x + y * slope / (1.0 - slope * slope).sqrt()).clamp(0.0, way);
        (y * y + (x - t) * (x - t)).sqrt() - (r + slope * t)
    };
    (0..spans).map(of).fold(f64::INFINITY, f64::min)
}

/// Vertices lie on the balls' envelope: elbows, round ends, closed paths, radii that change; nothing is open or inside out.
#[test]
fn tubes_are_what_balls_pass_over() {
    let bent: &[Vector] = &[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.5], [0.5, 3.0, 1.5], [3.0, 4.0, 2.0]];
    let straight: &[Vector] = &[[0.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
    let ring: &[Vector] = &[[2.0, 0.0, 0.0], [0.0, 0.3, 2.0], [-2.0, 0.0, 0.0], [0.0, -0.4, -2.0]];
    for (points, closed) in [(bent, false), (straight, false), (ring, true)] {
        let tube = tube(points, Radii::All(0.3), Curve::Linear, closed);
        let mesh = made(&tube);
        check(&mesh);
        assert_eq!(open_edges(&mesh), 0, "{points:?}");
        assert!(volume(&mesh) > 0.0);
        let radii = vec![0.3; points.len()];
        for &at in &mesh.positions {
            let off = outside(at, points, &radii, closed);
            assert!(off.abs() < 1e-12, "{at:?} is off by {off}: {points:?}");
        }
    }
    // A capsule: the volume of a prism and two polyhedra within the ball, whose chords of 1/32 of the turn take 0.6 % at most.
    let mesh = made(&tube(straight, Radii::All(0.3), Curve::Linear, false));
    let truth = PI * 0.09 * (3.0 + 4.0 / 3.0 * 0.3);
    assert!((0.99..1.0).contains(&(volume(&mesh) / truth)), "{}", volume(&mesh) / truth);
    let v = mesh.uvs.iter().map(|uv| uv[1]);
    assert_eq!((v.clone().fold(1.0, f32::min), v.fold(0.0, f32::max)), (0.0, 1.0));
    // Straight, with radii that change: the ends are parts of balls, the sides cones.
    for radii in [vec![0.2, 0.6, 0.1], vec![0.5, 0.2, 0.7]] {
        let points: &[Vector] = &[[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
        let mesh = made(&tube(points, Radii::Each(radii.clone()), Curve::Linear, false));
        check(&mesh);
        assert_eq!(open_edges(&mesh), 0);
        // Where a narrowing cone and a widening one meet, vertices lie between both, in the plane through the point.
        let off = mesh.positions.iter().map(|&at| outside(at, points, &radii, false).abs()).fold(0.0, f64::max);
        assert!(off < 0.02, "{off}");
    }
}

/// A ring through eight points of a circle is nearly a torus; all curves are closed, smooth, and pass their points.
#[test]
fn tubes_along_curves() {
    let circle: Vec<Vector> =
        (0..8).map(|k| f64::from(k) * TAU / 8.0).map(|t| [2.0 * libm::cos(t), 0.0, 2.0 * libm::sin(t)]).collect();
    let mesh = made(&tube(&circle, Radii::All(0.5), Curve::CatmullRom, true));
    check(&mesh);
    assert_eq!(open_edges(&mesh), 0);
    let truth = 2.0 * PI * PI * 2.0 * 0.25;
    assert!((volume(&mesh) / truth - 1.0).abs() < 0.02, "{}", volume(&mesh) / truth);
    // A knot, whose frame comes back turned.
    let knot: Vec<Vector> = (0..24)
        .map(|k| f64::from(k) * TAU / 24.0)
        .map(|t| {
            let r = 2.0 + libm::cos(3.0 * t);
            [r * libm::cos(2.0 * t), r * libm::sin(2.0 * t), libm::sin(3.0 * t)]
        })
        .collect();
    let radii = (0..24).map(|k| 0.2 + 0.1 * f64::from(k % 2)).collect();
    let mesh = made(&tube(&knot, Radii::Each(radii), Curve::CatmullRom, true));
    check(&mesh);
    assert_eq!(open_edges(&mesh), 0);
    // No stripe goes round it: the seam of u is as long as the tube, not longer by turns about it.
    let seam: Vec<Vector> = {
        let uvs = mesh.uv_triangles.as_ref().expect("there are");
        let mut seam: Vec<(f32, Vector)> = Vec::new();
        for (corners, uvs) in mesh.triangles.iter().zip(uvs) {
            for (&corner, &uv) in corners.iter().zip(uvs) {
                let [u, v] = mesh.uvs[uv as usize];
                if u == 0.0 {
                    seam.push((v, mesh.positions[corner as usize]));
                }
            }
        }
        seam.sort_by(|a, b| a.0.total_cmp(&b.0));
        seam.dedup();
        seam.into_iter().map(|(_, at)| at).collect()
    };
    let way = |path: &[Vector]| -> f64 {
        let step = |pair: &[Vector]| [0, 1, 2].map(|axis| pair[1][axis] - pair[0][axis]);
        path.windows(2).map(|pair| dot(step(pair), step(pair)).sqrt()).sum()
    };
    let mut path = knot.clone();
    path.push(knot[0]);
    assert!((0.8..1.3).contains(&(way(&seam) / way(&path))), "{}", way(&seam) / way(&path));
    // Radii go from one point to the next without passing beyond them.
    let tapered = made(&tube(
        &[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
        Radii::Each(vec![0.3, 0.1, 0.1]),
        Curve::CatmullRom,
        false,
    ));
    let between = tapered.positions.iter().filter(|p| (1.0..2.0).contains(&p[0]));
    assert!(between.map(|p| libm::hypot(p[1], p[2])).all(|r| (0.1 - 1e-9..0.11).contains(&r)));
}

#[test]
fn tubes_without_a_path_are_told() {
    let message = |tube: &Tube| {
        let fault = tube.mesh(Span::NONE).expect_err("it is told");
        format!("{}: {}", fault.code, fault.message)
    };
    let of = |points: &[Vector], radius: Radii, closed: bool| message(&tube(points, radius, Curve::Linear, closed));
    let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    assert_eq!(of(&[a, a], Radii::All(1.0), false), "E0542: the path of the tube has no extent");
    assert_eq!(of(&[a, b, a], Radii::All(0.1), true), "E0542: the path of the tube has no extent");
    assert_eq!(
        of(&[a, b, c], Radii::Each(vec![0.1, 1.2, 0.1]), false),
        "E0545: of the balls of the tube at (0, 0, 0) and (1, 0, 0) one lies within the other"
    );
    assert_eq!(of(&[a, b, a], Radii::All(0.1), false), "E0545: the tube turns straight back at (1, 0, 0)");
    assert_eq!(of(&[a, b], Radii::Each(vec![0.1; 3]), false), "E0206: the tube has 2 points and 3 radii");
}

fn torus(tube_radius: f64, segments: u32) -> Torus {
    Torus {
        center: [1.0, 2.0, 3.0].into(),
        axis: [0.0, 3.0, 4.0].into(),
        radius: 2.0.into(),
        tube_radius: tube_radius.into(),
        segments: segments.into(),
        material: MaterialRef::Default,
        transform: Vec::new(),
        placements: Placements::One,
        name: Name::default(),
    }
}

/// Vertices, normals and texture coordinates of a torus about a leaning axis, one that closes its hole, too.
#[test]
fn tori() {
    for tube in [0.5, 2.0] {
        let mesh = made(&torus(tube, 256));
        check(&mesh);
        assert_eq!(open_edges(&mesh), 0, "{tube}");
        // A polygon of n sides has sin(t)/t of its circle's area, t = 2 pi/n; the section's, turned about by another: 0.9999 squared.
        let truth = 2.0 * PI * PI * 2.0 * tube * tube;
        assert!((volume(&mesh) / truth - 0.9998).abs() < 1e-4, "{}", volume(&mesh) / truth);
        let (normals, uvs) = (mesh.normal_triangles.as_ref(), mesh.uv_triangles.as_ref());
        let (normals, uvs) = (normals.expect("there are"), uvs.expect("there are"));
        for (corners, (normals, uvs)) in mesh.triangles.iter().zip(normals.iter().zip(uvs)) {
            for k in 0..3 {
                let p = mesh.positions[corners[k] as usize];
                let [x, y, z] = [p[0] - 1.0, p[1] - 2.0, p[2] - 3.0];
                // Along the axis, and across it: to the right is (0, 1, 0) x axis = +x, the third is right x axis = (0, -0.8, 0.6).
                let (up, right, third) = (0.6 * y + 0.8 * z, x, -0.8 * y + 0.6 * z);
                let out = libm::hypot(right, third);
                assert!((libm::hypot(out - 2.0, up) - tube).abs() < 1e-9, "{p:?} is off the torus");
                if out < 1e-9 {
                    continue;
                }
                let n = mesh.normals[normals[k] as usize].map(f64::from);
                let (n_up, n_out) =
                    (0.6 * n[1] + 0.8 * n[2], (n[0] * right + (-0.8 * n[1] + 0.6 * n[2]) * third) / out);
                assert!((n_up - up / tube).abs() < 1e-6 && (n_out - (out - 2.0) / tube).abs() < 1e-6);
                let [u, v] = mesh.uvs[uvs[k] as usize].map(f64::from);
                let wraps = |a: f64, b: f64| (a - b - (a - b).round()).abs() < 1e-6;
                assert!(wraps(u, 0.5 + libm::atan2(right, third) / TAU), "{u}");
                assert!(wraps(v, 0.5 + libm::atan2(up, out - 2.0) / TAU), "{v}");
            }
        }
    }
    let fault = torus(2.1, 32).mesh(Span::NONE).expect_err("it is told");
    assert_eq!(fault.message, "the section of the torus is wider than it: its `tube_radius` is 2.1");
}

/// Arrows have shaft and head where they are written to be, whichever way they point.
#[test]
fn arrows() {
    let arrow = |to: Vector, radius: f64, head: Option<[f64; 2]>| Arrow {
        from: [1.0, 1.0, 1.0].into(),
        to: to.into(),
        radius: radius.into(),
        head_radius: head.map(|[wide, _]| wide.into()),
        head_length: head.map(|[_, long]| long.into()),
        segments: 512.into(),
        material: MaterialRef::Default,
        transform: Vec::new(),
        placements: Placements::One,
        name: Name::default(),
    };
    let cases = [
        ([1.0, 4.0, 1.0], 0.1, None, [0.25, 0.6]),
        ([1.0, -2.0, 1.0], 0.1, Some([0.4, 1.0]), [0.4, 1.0]),
        ([2.0, 3.0, -1.0], 0.3, None, [0.75, 1.5]),
        ([1.00001, 4.0, 1.0], 0.1, None, [0.25, 0.6]),
    ];
    for (to, radius, head, [wide, long]) in cases {
        let mesh = made(&arrow(to, radius, head));
        check(&mesh);
        assert_eq!(open_edges(&mesh), 0);
        let way = [0, 1, 2].map(|k| to[k] - 1.0);
        let whole = dot(way, way).sqrt();
        let truth = PI * radius * radius * (whole - long) + PI * wide * wide * long / 3.0;
        assert!((volume(&mesh) / truth - 1.0).abs() < 1e-3, "{to:?}: {} of {truth}", volume(&mesh));
        // The tip is the vertex that is farthest along it.
        let along = |p: &Vector| dot([0, 1, 2].map(|k| p[k] - 1.0), way) / whole;
        let tip = mesh.positions.iter().max_by(|a, b| along(a).total_cmp(&along(b))).expect("there are");
        assert!((0..3).all(|k| (tip[k] - to[k]).abs() < 1e-9), "{tip:?}");
    }
    let message = |arrow: &Arrow| arrow.mesh(Span::NONE).expect_err("it is told").message;
    let [up, here] = [[1.0, 2.0, 1.0], [1.0, 1.0, 1.0]];
    assert_eq!(message(&arrow(here, 0.1, None)), "the arrow begins and ends at the same point");
    assert_eq!(message(&arrow(up, 0.1, Some([0.3, 1.0]))), "the head of the arrow is longer than it: 1");
    assert_eq!(message(&arrow(up, 0.1, Some([0.05, 0.5]))), "the head of the arrow is thinner than its shaft: 0.05");
}
