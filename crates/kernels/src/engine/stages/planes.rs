//! Rays against planes without an end, which are beside the tree (see `scene::plane`). Many rays for each plane, in
//! `f64` and without lanes: the compiler takes as many at a time as the processor does, and no operation is fused.

use super::share::light;
use crate::engine::batch::{Batch, Columns, Group, Members};
use crate::scene::{Met, NONE, Plane, PlaneTable};
use std::ops::Range;

/// Rays at a time.
const AT_ONCE: usize = 64;

#[inline(always)]
fn at(columns: &Columns, i: usize) -> [f64; 3] {
    [columns[0][i], columns[1][i], columns[2][i]].map(f64::from)
}

/// Takes those hits of `batch.hits` that a plane is nearer than. Of planes equally far the first wins, by t before it
/// is rounded: planes that nearly touch do not speckle.
pub fn planes_closest(planes: &PlaneTable, batch: &mut Batch) {
    let (paths, hits) = (&*batch.paths, &mut *batch.hits);
    // Columns of one type and of one length, ids among them, so that the compiler takes several rays at a time.
    let (mut origin, mut direction, mut from) = ([[0f64; AT_ONCE]; 3], [[0f64; AT_ONCE]; 3], [0f64; AT_ONCE]);
    for first in (0..paths.len).step_by(AT_ONCE) {
        let range = first..paths.len.min(first + AT_ONCE);
        for axis in 0..3 {
            widen(&paths.origin[axis][range.clone()], &mut origin[axis]);
            widen(&paths.direction[axis][range.clone()], &mut direction[axis]);
        }
        widen(&paths.from_primitive[range.clone()], &mut from);
        let (mut nearest, mut met) = ([f64::INFINITY; AT_ONCE], [f64::from(NONE); AT_ONCE]);
        for plane in &planes.rows {
            let id = f64::from(plane.id);
            for k in 0..AT_ONCE {
                let of = |columns: &[[f64; AT_ONCE]; 3]| [columns[0][k], columns[1][k], columns[2][k]];
                let t = plane.meets(of(&origin), of(&direction));
                let nearer = (t > 0.0) & (t < nearest[k]) & (from[k] != id);
                nearest[k] = if nearer { t } else { nearest[k] };
                met[k] = if nearer { id } else { met[k] };
            }
        }
        for (i, (nearest, met)) in range.zip(nearest.into_iter().zip(met)) {
            let (t, id) = (nearest as f32, met as u32);
            if id != NONE && t > 0.0 && t < hits.t[i] {
                (hits.t[i], hits.primitive[i], hits.instance[i]) = (t, id, NONE);
            }
        }
    }
}

fn widen<T: Copy + Into<f64>>(column: &[T], wide: &mut [f64; AT_ONCE]) {
    wide.iter_mut().zip(column).for_each(|(wide, x)| *wide = (*x).into());
}

/// Sets `batch.shadows.occluded` for the shadow rays that a plane blocks. What lies in a plane is not hidden by it.
pub fn planes_occluded(met: Met<'_>, batch: &mut Batch) {
    let shadows = &mut *batch.shadows;
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
    let (members, suffixes, groups) = (&*batch.members, &*batch.suffixes, &mut batch.groups);
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
