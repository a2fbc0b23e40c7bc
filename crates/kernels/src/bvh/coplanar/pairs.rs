//! The pairs of triangles in one plane that overlap.

use super::find::{Face, UNIT};
use glam::DVec3;
use rayon::prelude::*;

/// All planes together have no more pairs than this: what lies in the planes with the most is not told apart. It takes
/// thousands of surfaces that all lie in each other.
const MOST_PAIRS: usize = 1 << 22;

/// A plane of m triangles is left out where its sweep would test more than `TESTS + m TESTS_EACH` pairs.
const TESTS: usize = 1 << 23;
const TESTS_EACH: usize = 512;

/// The pairs that overlap, winner first, with how far apart they may be.
pub(super) fn pairs_in(planes: Vec<(Vec<u32>, f64)>, faces: &[Face]) -> Vec<(u32, u32, f64)> {
    let planes = within_bounds(planes, faces);
    let of_plane = |(members, gap): (Vec<u32>, f64)| {
        let mut found = Vec::new();
        sweep(&members, faces, |k, other| {
            let first = faces[k as usize].order() < faces[other as usize].order();
            found.push(if first { (k, other, gap) } else { (other, k, gap) });
            true
        });
        found
    };
    let mut pairs: Vec<(u32, u32, f64)> = planes.into_par_iter().flat_map_iter(of_plane).collect();
    pairs.sort_unstable_by_key(|a| (a.0, a.1));
    pairs
}

/// The planes whose pairs can be found and kept, those with the fewest first. Which these are depends on the scene
/// alone.
fn within_bounds(planes: Vec<(Vec<u32>, f64)>, faces: &[Face]) -> Vec<(Vec<u32>, f64)> {
    // Mostly there are too few triangles for so many.
    let at_most = planes.iter().map(|(members, _)| members.len() * (members.len() - 1) / 2).sum::<usize>();
    if at_most <= MOST_PAIRS {
        return planes;
    }
    let counted = |plane: (Vec<u32>, f64)| {
        let mut count = 0;
        let whole = sweep(&plane.0, faces, |_, _| {
            count += 1;
            count <= MOST_PAIRS
        });
        whole.then_some((count, plane))
    };
    let mut counts: Vec<(usize, (Vec<u32>, f64))> = planes.into_par_iter().filter_map(counted).collect();
    counts.sort_by_key(|(count, _)| *count);
    let mut left = MOST_PAIRS;
    let mut fits = |count: usize| {
        left = left.saturating_sub(count);
        left > 0
    };
    counts.into_iter().take_while(|(count, _)| fits(*count)).map(|(_, plane)| plane).collect()
}

/// Tells of each pair that overlaps; `false` where it was told to stop, or the pairs to test are too many.
fn sweep(members: &[u32], faces: &[Face], mut overlaps: impl FnMut(u32, u32) -> bool) -> bool {
    let axes = other_axes(faces[members[0] as usize].normal);
    let flat = |k: u32| faces[k as usize].corners.map(|corner| axes.map(|axis| corner[axis]));
    let along = |k: u32, axis: usize| span(flat(k).map(|corner| corner[axis]));
    // Along the axis that parts them best: a row is swept from end to end.
    let crowd = |axis: usize| {
        let (mut lengths, mut all) = (0.0, (f64::INFINITY, f64::NEG_INFINITY));
        for (lower, upper) in members.iter().map(|&k| along(k, axis)) {
            lengths += upper - lower;
            all = (all.0.min(lower), all.1.max(upper));
        }
        lengths / (all.1 - all.0)
    };
    let axis = usize::from(members.len() > 2 && crowd(1) < crowd(0));
    let ends = |&k: &u32| {
        let (lower, upper) = along(k, axis);
        (lower, upper, k)
    };
    let mut order: Vec<(f64, f64, u32)> = members.iter().map(ends).collect();
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    let mut tests = TESTS + members.len() * TESTS_EACH;
    let mut open: Vec<(f64, u32)> = Vec::new();
    for (lower, upper, k) in order {
        open.retain(|other| other.0 > lower);
        let Some(left) = tests.checked_sub(open.len()) else { return false };
        tests = left;
        for &(_, other) in &open {
            let (a, b) = (&faces[k as usize], &faces[other as usize]);
            // Corners that two share may have been rounded apart.
            if overlap(&flat(k), &flat(other), 16.0 * UNIT * (a.reach + b.reach)) && !overlaps(k, other) {
                return false;
            }
        }
        open.push((upper, k));
    }
    true
}

/// The axes of the plane in which triangles with this normal are seen best.
pub(super) fn other_axes(normal: DVec3) -> [usize; 2] {
    let n = normal.abs();
    match (n.x >= n.y && n.x >= n.z, n.y >= n.z) {
        (true, _) => [1, 2],
        (_, true) => [2, 0],
        _ => [0, 1],
    }
}

/// Whether two triangles of a plane overlap by more than a margin in every direction across their sides.
fn overlap(a: &[[f64; 2]; 3], b: &[[f64; 2]; 3], margin: f64) -> bool {
    [a, b].into_iter().all(|of| {
        (0..3).all(|k| {
            let (p, q) = (of[k], of[(k + 1) % 3]);
            let across = [p[1] - q[1], q[0] - p[0]];
            let length = (across[0] * across[0] + across[1] * across[1]).sqrt();
            let along = |x: &[f64; 2]| (x[0] - p[0]) * across[0] + (x[1] - p[1]) * across[1];
            let (least, most) = span(a.map(|x| along(&x)));
            let (lower, upper) = span(b.map(|x| along(&x)));
            most.min(upper) - least.max(lower) > margin * length
        })
    })
}

pub(super) fn span(x: impl IntoIterator<Item = f64>) -> (f64, f64) {
    x.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)))
}
