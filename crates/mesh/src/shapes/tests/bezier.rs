//! Tubes along Bezier curves.

use super::round::tube;
use super::swept::{Random, holds};
use super::{Vector, check, made, open_edges, volume};
use crate::shapes::Triangulated;
use scene_format::desc::{Radii, Tube, TubeCurve};
use scene_format::diagnostic::Span;
use std::f64::consts::PI;

fn bezier(points: &[Vector], radius: Radii, closed: bool) -> Tube {
    tube(points, radius, TubeCurve::Bezier, closed)
}

/// A point of a span by Bernstein's polynomials.
fn on(span: &[Vector], t: f64) -> Vector {
    let s = 1.0 - t;
    let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    [0, 1, 2].map(|axis| (0..4).map(|k| weights[k] * span[k][axis]).sum())
}

fn balls(points: &[Vector], radius: f64) -> Vec<(Vector, f64)> {
    let spans = points.windows(4).step_by(3);
    spans.flat_map(|span| (0..=1500).map(|n| (on(span, f64::from(n) / 1500.0), radius))).collect()
}

/// Spans with handles in their places, cusps, loops, kinks, lines that turn back, and what is drawn by chance.
#[test]
fn bezier_tubes_are_what_balls_pass_over() {
    let [a, b, c, d] = [[0.0; 3], [0.2, 1.0, 0.3], [1.2, 0.9, -0.4], [1.0, -0.3, 0.2]];
    let x = |x: f64| [x, 0.0, 0.0];
    let mut cases: Vec<(Vec<Vector>, f64, bool)> = vec![
        (vec![a, b, c, d], 0.15, false),
        (vec![a, a, c, d], 0.15, false),
        (vec![a, b, d, d], 0.15, false),
        (vec![a, a, d, d], 0.15, false),
        (vec![a, a, a, d], 0.15, false),
        (vec![a, d, d, d], 0.15, false),
        // A kink, and a span that is a point between two.
        (vec![a, b, c, d, d, d, d, c, [2.0, 1.0, 0.0], [2.0, 0.0, 0.0]], 0.1, false),
        // Cusps: in the middle, and nearly.
        (vec![[0.0; 3], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]], 0.1, false),
        (vec![[0.0; 3], [1.0, 1.0, 0.0], [0.001, 1.0, 0.0], [1.0, 0.0, 0.0]], 0.1, false),
        (vec![[0.0; 3], [1.0, 1.0, 0.0], [-0.1, 1.0, 0.3], [1.0, 0.1, 0.0]], 0.1, false),
        // A loop, and one that is closed with a kink.
        (vec![[0.0; 3], [3.0, 2.0, 0.0], [-2.0, 2.0, 0.3], [1.0, 0.0, 0.0]], 0.1, false),
        (vec![a, [1.5, 1.0, 0.0], [-1.5, 1.0, 0.5], a], 0.1, true),
        // Straight: out and back, beyond its beginning, and where three directions do not tell.
        (vec![x(0.0), x(1.0), x(1.0), x(0.0)], 0.2, false),
        (vec![x(0.0), x(-1.0), x(2.0), x(1.0)], 0.2, false),
        (vec![x(0.0), x(0.04), x(-0.17), x(0.37)], 0.05, false),
    ];
    let mut random = Random(11);
    for _ in 0..12 {
        let mut point = || [0, 1, 2].map(|_| random.between(-1.0, 1.0));
        cases.push(((0..7).map(|_| point()).collect(), 0.12, false));
    }
    let mut faults = Vec::new();
    for (points, radius, closed) in cases {
        let mut shape = bezier(&points, Radii::All(radius), closed);
        shape.segments = 64.into();
        faults.extend(holds(&shape, &balls(&points, radius), &format!("{points:?}")).err());
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// Four spans are nearly a circle, 0.03 % off it.
#[test]
fn four_spans_are_nearly_a_torus() {
    let k = 4.0 / 3.0 * (2.0_f64.sqrt() - 1.0);
    let at = |x: f64, z: f64| [2.0 * x, 0.0, 2.0 * z];
    let quarter = |[x, z]: [f64; 2]| [at(x, z), at(x - k * z, z + k * x), at(k * x - z, k * z + x)];
    let mut points: Vec<Vector> =
        [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].into_iter().flat_map(quarter).collect();
    points.push(points[0]);
    for radius in [Radii::All(0.5), Radii::Each(vec![0.5; 5])] {
        let mut ring = bezier(&points, radius, true);
        ring.segments = 128.into();
        let mesh = made(&ring);
        check(&mesh);
        assert_eq!(open_edges(&mesh), 0);
        let truth = 2.0 * PI * PI * 2.0 * 0.25;
        // Chords of 1/128 of a turn take 0.04 % of the section, and 0.03 % of the way round.
        assert!((volume(&mesh) / truth - 1.0).abs() < 1e-3, "{}", volume(&mesh) / truth);
    }
}

/// Catmull and Rom's curve is Bezier curves, whose handles are known where points are equally far apart: the tubes are
/// one, radii that swell included.
#[test]
fn the_curve_through_points_as_bezier_curves() {
    let passed: Vec<Vector> = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]];
    let last = passed.len() - 1;
    let plus = |p: Vector, q: Vector, s: f64| [0, 1, 2].map(|axis| p[axis] + s * q[axis]);
    let minus = |p: Vector, q: Vector| plus(p, q, -1.0);
    let slope = |k: usize| match k {
        0 => minus(passed[1], passed[0]),
        k if k == last => minus(passed[k], passed[k - 1]),
        k => minus(passed[k + 1], passed[k - 1]).map(|x| 0.5 * x),
    };
    let mut points = vec![passed[0]];
    for k in 0..last {
        points.extend([plus(passed[k], slope(k), 1.0 / 3.0), plus(passed[k + 1], slope(k + 1), -1.0 / 3.0)]);
        points.push(passed[k + 1]);
    }
    let radii = Radii::Each(vec![0.05, 0.1, 0.04, 0.08, 0.03]);
    let [one, other] = [(&points, TubeCurve::Bezier), (&passed, TubeCurve::CatmullRom)].map(|(points, curve)| {
        let mut shape = tube(points, radii.clone(), curve, false);
        shape.segments = 512.into();
        volume(&made(&shape))
    });
    // Both are cut in other places: a piece of length l that turns by a step has l step/8 less in its middle, which is
    // for 1/512 of a turn and pieces of 0.02 a thousandth of the radius in few places.
    assert!((one / other - 1.0).abs() < 1e-4, "{one} {other}");
}

#[test]
fn what_is_no_bezier_path_is_told() {
    let told = |points: &[Vector], radius: Radii, closed: bool| {
        let fault = bezier(points, radius, closed).mesh(Span::NONE).expect_err("it is told");
        format!("{}: {} | {} | {}", fault.code, fault.message, fault.expected, fault.hint)
    };
    let points: Vec<Vector> = (0..12).map(|k| [f64::from(k), f64::from(k % 2), 0.0]).collect();
    let one = || Radii::All(0.1);
    assert_eq!(
        told(&points[..6], one(), false),
        "E0206: the Bezier path of the tube ends within a span: it has 6 points | 4 or 7 points: where it begins, \
         then for each span two handles and the point where it ends | a curve through all of these points is `curve: \
         CatmullRom`"
    );
    assert!(told(&points[..2], one(), false).contains(" 2 points | 4 points: where it begins"));
    assert!(told(&points[..9], one(), true).contains(" 9 points | 7 or 10 points: "));
    assert!(told(&points[..9], one(), true).ends_with("the first point stands at the end once more"));
    assert_eq!(
        told(&points[..7], one(), true),
        "E0206: the Bezier path of the closed tube does not end where it begins | (0, 0, 0) as its last point too, \
         not (6, 0, 0), or a tube that is not `closed` | a span more leads back: two handles and the first point, 10 \
         points in all"
    );
    assert_eq!(
        told(&points[..7], Radii::Each(vec![0.1; 7]), false),
        "E0206: the tube has 3 points between handles and 7 radii | one radius, or 3: one for each point that the path \
         passes | "
    );
    assert_eq!(
        told(&[points[1]; 4], one(), false),
        "E0542: the path of the tube has no extent | two points or more that are not the same | "
    );
    // Handles that rounding leaves nothing of, far from the origin.
    let far = [1e6, 0.0, 0.0];
    let near = [1e6 + 1e-10, 0.0, 0.0];
    let nothing = bezier(&[far, near, far, far], one(), true).mesh(Span::NONE);
    assert!(nothing.map_or_else(|fault| fault.message.contains("no extent"), |mesh| open_edges(&mesh) == 0));
}
