//! Rays against planes without an end, which are beside the tree (see `scene::plane`). Many rays for each plane, in
//! `f64` and without lanes: the compiler takes as many at a time as the processor does, and no operation is fused.

use super::share::light;
use crate::engine::batch::{Batch, Columns, Group, Members};
use crate::scene::{Met, NONE, Plane, PlaneTable};
use std::ops::Range;

/// Rays at a time.
const AT_ONCE: usize = 64;

#[inline(always)]
fn at(columns: &Columns, i: usize) -> [f32; 3] {
    [columns[0][i], columns[1][i], columns[2][i]]
}

/// Takes those hits of `batch.hits` that a plane is nearer than. Of planes equally far the first wins, by t before it
/// is rounded: planes that nearly touch do not speckle.
pub fn planes_closest(planes: &PlaneTable, batch: &mut Batch) {
    let (paths, hits) = (&batch.paths, &mut batch.hits);
    for first in (0..paths.len).step_by(AT_ONCE) {
        let count = AT_ONCE.min(paths.len - first);
        let (mut nearest, mut id) = ([f64::INFINITY; AT_ONCE], [NONE; AT_ONCE]);
        for plane in &planes.rows {
            for (k, (nearest, id)) in nearest.iter_mut().zip(&mut id).enumerate().take(count) {
                let i = first + k;
                let t = plane.meets(at(&paths.origin, i), at(&paths.direction, i));
                let nearer = t > 0.0 && t < *nearest && paths.from_primitive[i] != plane.id;
                *nearest = if nearer { t } else { *nearest };
                *id = if nearer { plane.id } else { *id };
            }
        }
        for (k, (nearest, id)) in nearest.into_iter().zip(id).enumerate().take(count) {
            let (i, t) = (first + k, nearest as f32);
            if id != NONE && t > 0.0 && t < hits.t[i] {
                (hits.t[i], hits.primitive[i], hits.instance[i]) = (t, id, NONE);
            }
        }
    }
}

/// Sets `batch.shadows.occluded` for the shadow rays that a plane blocks. What lies in a plane is not hidden by it.
pub fn planes_occluded(met: Met<'_>, batch: &mut Batch) {
    let shadows = &mut batch.shadows;
    for plane in &met.planes.rows {
        for i in 0..shadows.len {
            let t = plane.meets(at(&shadows.origin, i), at(&shadows.direction, i));
            let other = shadows.from_primitive[i] != plane.id && shadows.target_primitive[i] != plane.id;
            let between = t > 0.0 && t < f64::from(shadows.t_max[i]) && other;
            if between && !holds(met, plane, shadows.target_primitive[i], shadows.target_instance[i]) {
                shadows.occluded[i] = 1;
            }
        }
    }
}

/// Whether a triangle lies in a plane.
fn holds(met: Met<'_>, plane: &Plane, primitive: u32, instance: u32) -> bool {
    primitive != NONE && met.accel.is_some_and(|accel| accel.lies_in(plane.id, primitive, instance))
}

/// Hides the suffixes with these numbers from the members beyond planes: a segment is blocked where its ends are on two
/// sides. That asks nothing but on which side points are, once for each; a suffix or member on the very plane is on
/// neither. The finder of a suffix sees it.
pub fn planes_hide(planes: &PlaneTable, numbers: Range<usize>, batch: &mut Batch) {
    let (members, suffixes, groups) = (&batch.members, &batch.suffixes, &mut batch.groups);
    for plane in &planes.rows {
        let (mut sides, mut sides_of) = ([0; 2], NONE);
        for j in numbers.clone().filter(|&j| light(suffixes, &batch.radiance, j) != [0.0; 3]) {
            let of = groups.of_suffix[j];
            let group = groups.list[of as usize];
            if sides_of != of {
                (sides, sides_of) = (sides_of_group(plane, members, group), of);
            }
            let height = plane.height(at(&suffixes.point, j));
            if suffixes.primitive[j] == plane.id || height == 0.0 {
                continue;
            }
            let mut beyond = sides[usize::from(height < 0.0)];
            while beyond != 0 {
                let place = beyond.trailing_zeros();
                beyond &= beyond - 1;
                let finder = members.slot[group.first as usize + place as usize] == suffixes.slot[j];
                groups.hidden[j] |= u64::from(!finder) << place;
            }
        }
    }
}

/// The members of a group behind a plane, a bit each, and those before it.
fn sides_of_group(plane: &Plane, members: &Members, group: Group) -> [u64; 2] {
    let [mut behind, mut before] = [0u64; 2];
    for place in 0..group.len {
        let i = (group.first + place) as usize;
        let height = if members.primitive[i] == plane.id { 0.0 } else { plane.height(at(&members.start, i)) };
        behind |= u64::from(height < 0.0) << place;
        before |= u64::from(height > 0.0) << place;
    }
    [behind, before]
}
