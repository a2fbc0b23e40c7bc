//! Tubes, tori, arrows, and boxes with round edges.

use super::{Vector, check, dot, made, open_edges, volume};
use crate::shapes::Triangulated;
use scene_format::desc::{Arrow, MaterialRef, Name, PathPoints, PerAxis, Placements, Radii, RectBox, Tube, TubeCurve};
use scene_format::diagnostic::Span;
use std::f64::consts::{PI, TAU};

pub(super) fn tube(points: &[[f64; 3]], radius: Radii, curve: TubeCurve, closed: bool) -> Tube {
    Tube {
        points: PathPoints(points.to_vec()).into(),
        radius: radius.into(),
        curve,
        closed,
        segments: 32.into(),
        material: MaterialRef::Default,
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
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

/// Vertices lie on the balls' envelope: elbows, round ends, closed paths, radii that change; nothing is open or inside
/// out.
#[test]
fn tubes_are_what_balls_pass_over() {
    let bent: &[Vector] = &[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.5], [0.5, 3.0, 1.5], [3.0, 4.0, 2.0]];
    let straight: &[Vector] = &[[0.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
    let ring: &[Vector] = &[[2.0, 0.0, 0.0], [0.0, 0.3, 2.0], [-2.0, 0.0, 0.0], [0.0, -0.4, -2.0]];
    for (points, closed) in [(bent, false), (straight, false), (ring, true)] {
        let tube = tube(points, Radii::All(0.3), TubeCurve::Linear, closed);
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
    // A capsule: the volume of a prism and two polyhedra within the ball, whose chords of 1/32 of the turn take 0.6 %
    // at most.
    let mesh = made(&tube(straight, Radii::All(0.3), TubeCurve::Linear, false));
    let truth = PI * 0.09 * (3.0 + 4.0 / 3.0 * 0.3);
    assert!((0.99..1.0).contains(&(volume(&mesh) / truth)), "{}", volume(&mesh) / truth);
    let v = mesh.uvs.iter().map(|uv| uv[1]);
    assert_eq!((v.clone().fold(1.0, f32::min), v.fold(0.0, f32::max)), (0.0, 1.0));
    // Straight, with radii that change: the ends are parts of balls, the sides cones.
    for radii in [vec![0.2, 0.6, 0.1], vec![0.5, 0.2, 0.7]] {
        let points: &[Vector] = &[[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
        let mesh = made(&tube(points, Radii::Each(radii.clone()), TubeCurve::Linear, false));
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
    let mesh = made(&tube(&circle, Radii::All(0.5), TubeCurve::CatmullRom, true));
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
    let mesh = made(&tube(&knot, Radii::Each(radii), TubeCurve::CatmullRom, true));
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
        TubeCurve::CatmullRom,
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
    let of = |points: &[Vector], radius: Radii, closed: bool| message(&tube(points, radius, TubeCurve::Linear, closed));
    let [a, b] = [[0.0; 3], [1.0, 0.0, 0.0]];
    assert_eq!(of(&[a, a], Radii::All(1.0), false), "E0542: the path of the tube has no extent");
    let two = "E0542: the path of the closed tube goes through two points only";
    assert_eq!(of(&[a, b, a], Radii::All(0.1), true), two);
    assert_eq!(of(&[a, b], Radii::All(0.1), true), two);
    assert_eq!(of(&[a, b], Radii::Each(vec![0.1; 3]), false), "E0206: the tube has 2 points and 3 radii");
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
        camera_visible: true,
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
    assert_eq!(message(&arrow(up, 0.1, Some([0.3, 1.1]))), "the head of the arrow is longer than it: 1.1");
    // One that is all head is a cone.
    let cone = made(&arrow(up, 0.1, Some([0.3, 1.0])));
    assert_eq!(open_edges(&cone), 0);
    assert!((volume(&cone) / (PI * 0.09 / 3.0) - 1.0).abs() < 1e-3);
    assert_eq!(message(&arrow(up, 0.1, Some([0.05, 0.5]))), "the head of the arrow is thinner than its shaft: 0.05");
}

/// Vertices lie on the surface of what is within `rounding` of the inner box, which may have no length in one, two or
/// three directions; flat sides are flat, and a face's texture goes once over it.
#[test]
fn boxes_with_round_edges() {
    let center = [3.0, -1.0, 0.5];
    for (size, rounding) in [
        ([1.0, 2.0, 3.0], 0.2),
        ([1.0, 2.0, 3.0], 0.5),
        ([2.0, 1.0, 1.0], 0.5),
        ([0.3, 0.3, 0.3], 0.15),
        ([1.0, 1.0, 1.0], 1e-6),
    ] {
        let cuboid = RectBox {
            center: center.into(),
            size: PerAxis(size).into(),
            rounding: rounding.into(),
            material: MaterialRef::Default,
            transform: Vec::new(),
            placements: Placements::One,
            camera_visible: true,
            name: Name::default(),
        };
        let mesh = made(&cuboid);
        assert_eq!(open_edges(&mesh), 0, "{size:?}");
        let inner = size.map(|side| 0.5 * side - rounding);
        for (at, normal) in mesh.positions.iter().zip(&mesh.normals) {
            let off = [0, 1, 2].map(|k: usize| {
                let x = at[k] - center[k];
                x - x.clamp(-inner[k], inner[k])
            });
            assert!((dot(off, off).sqrt() - rounding).abs() < 1e-12, "{at:?} {size:?}");
            let along = dot(off, normal.map(f64::from)) / rounding;
            assert!((along - 1.0).abs() < 1e-6, "{at:?} {normal:?}");
        }
        // Steiner's formula: the inner box, its sides, edges and corners, each `rounding` thick. Chords take little.
        let [a, b, c] = inner.map(|half| 2.0 * half);
        let (r, sides) = (rounding, 2.0 * (a * b + b * c + c * a));
        let truth = a * b * c + sides * r + PI * r * r * (a + b + c) + 4.0 / 3.0 * PI * r * r * r;
        let share = volume(&mesh) / truth;
        assert!((0.995..=1.0 + 1e-12).contains(&share), "{size:?}: {share}");
        let [u, v] = [0, 1].map(|k: usize| {
            let all = mesh.uvs.iter().map(|uv| uv[k]);
            [all.clone().fold(1.0, f32::min), all.fold(0.0, f32::max)]
        });
        // Faces meet at 45 degrees, where the corner is missing.
        let missing = (1.0 - libm::cos(PI / 4.0)) * rounding / size.into_iter().fold(f64::INFINITY, f64::min);
        for [low, high] in [u, v].map(|ends| ends.map(f64::from)) {
            assert!(low >= 0.0 && low <= missing + 1e-6, "{low}");
            assert!(high <= 1.0 && high >= 1.0 - missing - 1e-6, "{high}");
        }
    }
}
