//! Which rays can meet the tree at all: those that pass one of the boxes under its root. In a room whose walls are spheres most
//! rays miss them, and a traversal costs more than these few slabs over lanes.
//!
//! The interval of a box is computed as the tree does (`bvh::ray_space`), so a ray that is left out would have met nothing there.

use crate::bvh::TopBoxes;
use crate::engine::batch::{Batch, Columns};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;

/// Lists in `batch.active` the paths that pass a box before what they have hit.
#[inline(always)]
pub fn reach_closest<F: Lanes>(boxes: &TopBoxes, batch: &mut Batch) {
    let paths = &batch.paths;
    let mut count = 0;
    for i in (0..paths.len).step_by(F::N) {
        let slabs = Slabs::<F>::new(&paths.origin, &paths.direction, i);
        let limit = F::load(&batch.hits.t[i..]);
        let reaches = slabs.pass(boxes, limit) & F::first(paths.len - i);
        indices::<F>(i).compress(reaches, &mut batch.active[count..]);
        count += reaches.count();
    }
    batch.active_len = count;
}

/// Lists in `batch.active` the shadow rays that nothing has blocked yet and that pass a box before their end.
#[inline(always)]
pub fn reach_occluded<F: Lanes>(boxes: &TopBoxes, batch: &mut Batch) {
    let shadows = &batch.shadows;
    let mut count = 0;
    for i in (0..shadows.len).step_by(F::N) {
        let slabs = Slabs::<F>::new(&shadows.origin, &shadows.direction, i);
        let free = F::U::load(&shadows.occluded[i..]).eq(F::U::splat(0));
        let reaches = slabs.pass(boxes, F::load(&shadows.t_max[i..])) & free & F::first(shadows.len - i);
        indices::<F>(i).compress(reaches, &mut batch.active[count..]);
        count += reaches.count();
    }
    batch.active_len = count;
}

/// i, i + 1, ...
#[inline(always)]
fn indices<F: Lanes>(i: usize) -> F::U {
    const COUNT: [u32; 32] = {
        let mut table = [0; 32];
        let mut k = 0;
        while k < 32 {
            table[k] = k as u32;
            k += 1;
        }
        table
    };
    F::U::load(&COUNT) + F::U::splat(i as u32)
}

/// Rays, ready for slab tests; per axis.
struct Slabs<F: Lanes> {
    negative: [F::M; 3],
    inverse: [F; 3],
    near_offset: [F; 3],
    far_offset: [F; 3],
}

impl<F: Lanes> Slabs<F> {
    #[inline(always)]
    fn new(origin: &Columns, direction: &Columns, i: usize) -> Self {
        let c = F::splat;
        let (o, d) = (V3::<F>::load(origin, i), V3::<F>::load(direction, i));
        let pad = o.abs().max_component() * c(crate::bvh::PAD);
        let least = d.abs().max_component() * c(crate::bvh::SMALLEST_COMPONENT);
        let (o, d) = ([o.0, o.1, o.2], [d.0, d.1, d.2]);
        let none = F::M::from_bits(0);
        let mut slabs =
            Slabs { negative: [none; 3], inverse: [c(0.0); 3], near_offset: [c(0.0); 3], far_offset: [c(0.0); 3] };
        for axis in 0..3 {
            let negative = d[axis].to_bits().shr::<31>().eq(F::U::splat(1));
            let size = c(1.0) / d[axis].abs().max(least);
            let inverse = F::select(negative, -size, size);
            slabs.negative[axis] = negative;
            slabs.inverse[axis] = inverse;
            slabs.near_offset[axis] = o[axis].fma(inverse, pad * size);
            slabs.far_offset[axis] = o[axis].fma(inverse, -(pad * size));
        }
        slabs
    }

    /// Whether the rays are inside a box somewhere between 0 and `limit`.
    #[inline(always)]
    fn pass(&self, boxes: &TopBoxes, limit: F) -> F::M {
        let mut any = F::M::from_bits(0);
        for k in 0..boxes.len {
            let (mut near, mut far) = (F::splat(0.0), limit);
            for axis in 0..3 {
                let lower = F::splat(boxes.planes[2 * axis][k]);
                let upper = F::splat(boxes.planes[2 * axis + 1][k]);
                let first = F::select(self.negative[axis], upper, lower);
                let second = F::select(self.negative[axis], lower, upper);
                near = near.max(first.fma(self.inverse[axis], -self.near_offset[axis]));
                far = far.min(second.fma(self.inverse[axis], -self.far_offset[axis]));
            }
            any = any | near.le(far);
        }
        any
    }
}
