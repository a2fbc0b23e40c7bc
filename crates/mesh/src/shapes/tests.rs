//! What is closed is closed, its front is outside, and vertices, normals and texture coordinates are those of the
//! surface itself.

mod bezier;
mod height_field;
mod round;
mod swept;

use super::*;
use crate::NO_INDEX;
use scene_format::desc::{Corners, Curve, Extrude, Lathe, MaterialRef, Name, Outline, Placements, Polygon, Profile};
use std::collections::{BTreeMap, BTreeSet};
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

/// What holds for every mesh: triangles have an area, all that they name is there, normals are of unit length and on
/// the front.
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
        camera_visible: true,
        name: Name::default(),
    }
}

fn made(shape: &dyn Triangulated) -> MeshData {
    let mesh = shape.mesh(Span::NONE).expect("a mesh");
    check(&mesh);
    mesh
}

/// A cone, a ring with a square section, a spindle that meets the axis in the middle, a wine glass; each also written
/// the other way.
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

/// Vertices lie on circles about the axis; normals are those of the cone that a line turns into; u is the longitude
/// that has its middle at +z, v the length along the profile.
#[test]
fn vertices_of_lathes_are_those_of_the_surface() {
    let mesh = made(&lathe(&[[1.0, -1.0], [2.0, 1.0]], Curve::Linear, 64));
    let (normals, uvs) = (mesh.normal_triangles.as_ref().expect("some"), mesh.uv_triangles.as_ref().expect("some"));
    assert_eq!((mesh.triangles.len(), open_edges(&mesh)), (256, 128));
    let length = 5.0_f64.sqrt();
    for ((triangle, normals), uvs) in mesh.triangles.iter().zip(normals).zip(uvs) {
        for ((&p, &n), &uv) in triangle.iter().zip(normals).zip(uvs) {
            let ([x, y, z], [u, v]) = (mesh.positions[p as usize], mesh.uvs[uv as usize].map(f64::from));
            let r = libm::hypot(x, z);
            // On the cone, or in the middle of a flat piece of it.
            let cone = 1.5 + 0.5 * y;
            assert!((r - cone).abs() < 1e-12 || (r - cone * libm::cos(PI / 64.0)).abs() < 1e-12);
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

/// Walls that two lathes share are of the same triangles, whichever way the profiles go: what is in one place is found
/// by that.
#[test]
fn walls_that_lathes_share_are_the_same() {
    let tumbler: &[[f64; 2]] = &[[0.0, 0.0], [1.0, 0.0], [1.1, 2.0], [1.0, 2.0], [0.9, 0.2], [0.0, 0.2]];
    let water: &[[f64; 2]] = &[[0.0, 0.2], [0.9, 0.2], [0.95, 1.1], [0.0, 1.1]];
    let wall: &[[f64; 2]] = &[[1.0, 2.0], [1.0, 1.0], [0.9, 0.2]];
    let faces = |profile: &[[f64; 2]], inner: bool| -> BTreeSet<[[u32; 3]; 3]> {
        let mesh = made(&lathe(profile, Curve::Linear, 16));
        let on_wall = |p: &Vector| !inner || (p[1] > 0.1 && p[1] < 1.2 && libm::hypot(p[0], p[2]) > 0.85);
        let sorted = |triangle: &[u32; 3]| {
            let corners = corners(&mesh, *triangle);
            let mut seen = corners.map(|p| p.map(|x| (x as f32).to_bits()));
            seen.sort_unstable();
            corners.iter().all(on_wall).then_some(seen)
        };
        mesh.triangles.iter().filter_map(sorted).collect()
    };
    let backwards = |profile: &[[f64; 2]]| profile.iter().rev().copied().collect::<Vec<_>>();
    for profile in [tumbler, water, wall] {
        assert!(faces(profile, false) == faces(&backwards(profile), false), "{profile:?}");
    }
    let joined: Vec<[f64; 2]> = tumbler[..4].iter().chain(&[[0.95, 1.1]]).chain(&tumbler[4..]).copied().collect();
    let (outer, inner) = (faces(&joined, true), faces(water, true));
    assert_eq!((inner.len(), outer.intersection(&inner).count()), (64, 64));
}

/// How far a normal may be turned where a curve leaves a circle by `off` half way over an angle of 2h: it does so by
/// about 16 off t^2 (1-t)^2, which is never steeper than 3.08 off/2h; a quarter more for what is not in that.
fn turned_by(off: f64, h: f64) -> f64 {
    2.0 * off / h
}

/// A half circle of points of a sphere, as a curve: off the sphere by little, and its normals are the radii, also at
/// the poles.
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
            // Half way between points 2h apart the curve is at cos h + sin 2h sin h/4, with h 7.5 degrees: nowhere is
            // it farther off.
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

/// A point that is off by rounding closes a profile as the same point does, and so does one that is nearly on the axis.
#[test]
fn what_is_nearly_closed_is_closed() {
    let ring = [[1.0, 0.0], [2.0, 0.0], [1.5, 1.0], [1.0, 1e-14]];
    let axis = [[1e-14, 0.0], [1.0, 0.5], [1e-15, 1.0]];
    for profile in [&ring[..], &axis[..]] {
        let lathe = lathe(profile, Curve::Linear, 16);
        assert!(lathe.is_closed());
        let mesh = made(&lathe);
        assert_eq!(open_edges(&mesh), 0);
        assert!(volume(&mesh) > 0.0);
    }
    let open = [[1.0, 0.0], [2.0, 0.0], [1.5, 1.0], [1.0, 1e-3]];
    assert!(!lathe(&open, Curve::Linear, 16).is_closed());
}

fn extrude(rings: &[&[[f64; 2]]], depth: f64, curve: Curve) -> Extrude {
    Extrude {
        outline: Outline(rings.iter().map(|ring| ring.to_vec()).collect()).into(),
        depth: depth.into(),
        curve,
        material: MaterialRef::Default,
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
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
        camera_visible: true,
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
    let bow_tie = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let expected = "E0545 the polygon crosses itself: the side from points[0] to points[1] crosses \
                    that from points[2] to points[3] at (0.5, 0.5, 0)";
    assert_eq!(told(&bow_tie), expected);
}

/// As in an `Extrude` and a `Lathe`.
#[test]
fn points_that_repeat_the_last_are_dropped() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let mut repeated: Vec<[f64; 3]> = square.iter().flat_map(|&corner| [corner, corner]).collect();
    repeated.push(square[0]);
    assert_eq!(made(&polygon(&repeated)).positions, square);
    let written = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [3.0, 1.0, 0.0], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let fault = polygon(&written).mesh(Span::NONE).expect_err("none");
    assert!(
        fault.message.contains("from points[0] to points[2] crosses that from points[3] to points[4]"),
        "{fault:?}"
    );
}
