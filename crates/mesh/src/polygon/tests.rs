use super::*;

fn flat(corners: &[[f64; 2]]) -> Vec<[f64; 3]> {
    corners.iter().map(|&[x, y]| [x, y, 0.0]).collect()
}

/// Shoelace formula.
fn area(corners: &[[f64; 3]]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
}

/// Cuts, and asserts that the triangles have the polygon's winding, its area in sum (so they do not overlap), every
/// corner as a corner, and each border edge exactly once in its direction with all inner edges paired.
fn assert_cut_well(corners: &[[f64; 3]]) {
    let mut cutter = PolygonCutter::default();
    let cut = cutter.cut(corners.iter().copied()).expect("not too intricate");
    assert!(!cut.crossing, "{corners:?}");
    assert_eq!(cut.triangles.len(), corners.len() - 2, "{corners:?} {:?}", cut.triangles);
    let mut sum = 0.0;
    let mut edges = std::collections::BTreeMap::new();
    for triangle in cut.triangles {
        let points = triangle.map(|corner| corners[corner as usize]);
        let part = area(&points);
        assert!(part * area(corners) > 0.0, "{triangle:?} turns the wrong way in {corners:?}");
        sum += part;
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            *edges.entry((triangle[from], triangle[to])).or_insert(0) += 1;
        }
    }
    // Sums of products of coordinates below 100: well within 1e-9.
    assert!((sum - area(corners)).abs() < 1e-9, "{sum} {}", area(corners));
    let count = corners.len() as u32;
    for (&(from, to), &times) in &edges {
        assert_eq!(times, 1);
        assert!(to == (from + 1) % count || edges.contains_key(&(to, from)), "edge {from} {to} is open");
    }
    for corner in 0..count {
        assert!(edges.contains_key(&(corner, (corner + 1) % count)), "border edge {corner} is lost");
    }
}

/// Every rotation of the corners, in both windings.
fn assert_all_starts_cut_well(corners: &[[f64; 2]]) {
    let mut corners = flat(corners);
    for _ in 0..2 {
        for _ in 0..corners.len() {
            assert_cut_well(&corners);
            corners.rotate_left(1);
        }
        corners.reverse();
    }
}

#[test]
fn convex_polygons_become_the_fan() {
    let corners = flat(&[[0.0, 0.0], [2.0, 0.0], [3.0, 1.0], [2.0, 2.0], [0.0, 2.0]]);
    let mut cutter = PolygonCutter::default();
    assert_eq!(cutter.cut(corners.into_iter()).expect("cut").triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
}

#[test]
fn concave_polygons_are_cut_inside() {
    // Arrow head, L, U, star, comb.
    assert_all_starts_cut_well(&[[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.5, 1.0]]);
    assert_all_starts_cut_well(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
    assert_all_starts_cut_well(&[
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [2.0, 3.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [0.0, 3.0],
    ]);
    let star: Vec<[f64; 2]> = (0..14)
        .map(|i| {
            let (angle, radius) = (f64::from(i) * std::f64::consts::PI / 7.0, if i % 2 == 0 { 3.0 } else { 1.0 });
            [radius * libm::cos(angle), radius * libm::sin(angle)]
        })
        .collect();
    assert_all_starts_cut_well(&star);
    let mut teeth = vec![[20.0, -1.0]];
    for tooth in (0..20).rev().map(f64::from) {
        teeth.extend([[tooth + 0.5, 3.0], [tooth, 0.0]]);
    }
    teeth.push([0.0, -1.0]);
    assert_all_starts_cut_well(&teeth);
}

#[test]
fn corners_on_straight_edges_stay_corners() {
    assert_all_starts_cut_well(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 2.0]]);
    assert_all_starts_cut_well(&[
        [0.0, 0.0],
        [1.0, 0.0],
        [2.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [1.5, 3.0],
        [0.0, 3.0],
        [0.0, 1.0],
    ]);
    // Thirds of an edge are not exactly on it in binary.
    assert_all_starts_cut_well(&[[0.0, 0.0], [1.0, 1.0 / 3.0], [2.0, 2.0 / 3.0], [3.0, 1.0], [0.0, 3.0]]);
}

#[test]
fn a_hole_with_a_bridge_stays_a_hole() {
    // A square around a square; the border goes to the hole and back along the same edge.
    let corners = flat(&[
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [0.0, 4.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [3.0, 3.0],
        [3.0, 1.0],
        [1.0, 1.0],
    ]);
    let mut cutter = PolygonCutter::default();
    let cut = cutter.cut(corners.iter().copied()).expect("cut");
    assert!(!cut.crossing);
    let parts: Vec<f64> = cut.triangles.iter().map(|t| area(&t.map(|corner| corners[corner as usize]))).collect();
    assert!(parts.iter().all(|&part| part > 0.0), "{parts:?}");
    assert_eq!(parts.iter().sum::<f64>(), 12.0);
}

#[test]
fn tilted_and_far_polygons_are_cut_as_well() {
    // An L in the plane x + y + z = 3e5, far from the origin.
    let l = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let corners: Vec<[f64; 3]> = l.iter().map(|&[x, y]| [1e5 + x, 1e5 + y, 1e5 - x - y]).collect();
    let mut cutter = PolygonCutter::default();
    let cut = cutter.cut(corners.iter().copied()).expect("cut");
    assert!(!cut.crossing);
    let mut sum = [0.0; 3];
    for triangle in cut.triangles {
        let [a, b, c] = triangle.map(|corner| corners[corner as usize]);
        let normal = cross(difference(b, a), difference(c, a));
        for axis in 0..3 {
            // All wind alike: each has a positive part along (1, 1, 1).
            assert!(normal[axis] > 0.0);
            sum[axis] += normal[axis];
        }
    }
    // Twice the area 3 of the L in each projection; coordinates near 1e5 are exact to 1.5e-11.
    assert!(sum.iter().all(|part| (part - 6.0).abs() < 1e-9), "{sum:?}");
}

#[test]
fn bent_quadrilaterals_are_cut_along_the_smaller_fold() {
    let mut cutter = PolygonCutter::default();
    // A concave one, bent; and a strip so twisted that its halves nearly stand at right angles (cosines of the folds:
    // 0.05 along 0 2, -0.01 along 1 3).
    let concave = [[0.0, 0.0, 0.0], [1.0, 0.4, 0.3], [2.0, 0.0, 0.0], [1.0, 2.0, 0.0]];
    let twisted = [[0.0, 0.0, 0.0], [10.0, 0.0, 1.0], [9.0, 0.1, -1.0], [0.0, 1.0, 0.0]];
    for (corners, expected) in [(concave, [[1, 2, 3], [1, 3, 0]]), (twisted, [[0, 1, 2], [0, 2, 3]])] {
        let cut = cutter.cut(corners.into_iter()).expect("cut");
        assert!(!cut.crossing);
        assert_eq!(cut.triangles, expected, "{corners:?}");
    }
}

#[test]
fn polygons_without_area_have_no_triangles() {
    let mut cutter = PolygonCutter::default();
    for corners in [
        flat(&[[0.0, 0.0]; 5]),
        flat(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]]),
        flat(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]),
    ] {
        assert_eq!(cutter.cut(corners.into_iter()), Ok(Triangulation { triangles: &[], crossing: false }));
    }
}

#[test]
fn a_border_that_crosses_itself_is_told() {
    let mut cutter = PolygonCutter::default();
    for bow_tie in [
        flat(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]),
        flat(&[[0.0, 0.0], [3.0, 1.0], [3.0, 0.0], [0.0, 2.0]]),
        flat(&[[0.0, 3.0], [1.0, 0.0], [-2.0, 2.0], [2.0, 2.0], [-1.0, 0.0]]),
    ] {
        assert!(cutter.cut(bow_tie.into_iter()).expect("cut").crossing);
    }
}

#[test]
fn large_outlines_are_cut_in_time() {
    // A circle whose radius alternates, a spiral band and a comb, each of many thousand corners.
    let count = 20_000;
    let ring: Vec<[f64; 2]> = (0..count)
        .map(|i| {
            let angle = f64::from(i) / f64::from(count) * std::f64::consts::TAU;
            let radius = if i % 2 == 0 { 50.0 } else { 49.0 };
            [radius * libm::cos(angle), radius * libm::sin(angle)]
        })
        .collect();
    assert_cut_well(&flat(&ring));
    let turn = |i: i32, radius: f64| {
        let angle = f64::from(i) * 0.01;
        [(radius + f64::from(i) * 1e-3) * libm::cos(angle), (radius + f64::from(i) * 1e-3) * libm::sin(angle)]
    };
    let spiral: Vec<[f64; 2]> =
        (0..count / 2).map(|i| turn(i, 10.0)).chain((0..count / 2).rev().map(|i| turn(i, 9.8))).collect();
    assert_cut_well(&flat(&spiral));
    let mut comb: Vec<[f64; 2]> = vec![[50.0, -1.0]];
    let step = 50.0 / f64::from(count / 2);
    for tooth in (0..count / 2).rev().map(f64::from) {
        comb.extend([[(tooth + 0.5) * step, 3.0], [tooth * step, 0.0]]);
    }
    comb.push([0.0, -1.0]);
    assert_cut_well(&flat(&comb));
}

#[test]
fn an_outline_made_to_be_slow_is_refused_in_time() {
    // Corners in a random order cross everywhere, so nearly nothing is an ear.
    let mut state = 7_u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f64 / (1 << 24) as f64
    };
    let corners: Vec<[f64; 3]> = (0..10_000).map(|_| [next(), next(), 0.0]).collect();
    let mut cutter = PolygonCutter::default();
    // Either answer is right; the test is that there is one soon.
    if let Ok(cut) = cutter.cut(corners.into_iter()) {
        assert!(cut.crossing);
    }
    // One search after the last check looks at no more than all corners, in no more rows.
    assert!(cutter.tests <= FREE_TESTS + (TESTS_PER_CORNER + 2) * 10_000);
}
