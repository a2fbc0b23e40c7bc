//! Which rays can meet the tree at all: those that pass one of the boxes under its root. In a room whose walls are
//! spheres most rays miss them, and a traversal costs more than these few slabs over lanes.
//!
//! The interval of a box is computed as the tree does (`bvh::ray_space`), so a ray that is left out would have met
//! nothing there.

use crate::bvh::{Boxes, TopBoxes};
use crate::engine::batch::{Batch, Columns};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;

/// Lists in `batch.active` the paths that pass a box before what they have hit.
#[inline(always)]
pub fn reach_closest<F: Lanes>(boxes: &TopBoxes, batch: &mut Batch) {
    let paths = &*batch.paths;
    let mut count = 0;
    for i in (0..paths.len).step_by(F::N) {
        let slabs = Slabs::<F>::load(&paths.origin, &paths.direction, i);
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
    let shadows = &*batch.shadows;
    let mut count = 0;
    for i in (0..shadows.len).step_by(F::N) {
        let slabs = Slabs::<F>::load(&shadows.origin, &shadows.direction, i);
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
pub struct Slabs<F: Lanes> {
    negative: [F::M; 3],
    inverse: [F; 3],
    near_offset: [F; 3],
    far_offset: [F; 3],
}

impl<F: Lanes> Slabs<F> {
    #[inline(always)]
    fn load(origin: &Columns, direction: &Columns, i: usize) -> Self {
        Self::new(V3::<F>::load(origin, i), V3::<F>::load(direction, i))
    }

    /// Rays from o along d.
    #[inline(always)]
    pub fn new(o: V3<F>, d: V3<F>) -> Self {
        let c = F::splat;
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
    pub fn pass(&self, boxes: &TopBoxes, limit: F) -> F::M {
        let mut any = F::M::from_bits(0);
        for k in 0..boxes.len {
            any = any | self.pass_one(boxes, k, limit);
        }
        any
    }

    /// The same for boxes that have a bit set in the mask.
    #[inline(always)]
    pub fn pass_some<const N: usize>(&self, boxes: &Boxes<N>, mut mask: u64, limit: F) -> F::M {
        let mut any = F::M::from_bits(0);
        while mask != 0 {
            any = any | self.pass_one(boxes, mask.trailing_zeros() as usize, limit);
            mask &= mask - 1;
        }
        any
    }

    #[inline(always)]
    fn pass_one<const N: usize>(&self, boxes: &Boxes<N>, k: usize, limit: F) -> F::M {
        let (mut near, mut far) = (F::splat(0.0), limit);
        for axis in 0..3 {
            let lower = F::splat(boxes.planes[2 * axis][k]);
            let upper = F::splat(boxes.planes[2 * axis + 1][k]);
            let first = F::select(self.negative[axis], upper, lower);
            let second = F::select(self.negative[axis], lower, upper);
            near = near.max(first.fma(self.inverse[axis], -self.near_offset[axis]));
            far = far.min(second.fma(self.inverse[axis], -self.far_offset[axis]));
        }
        near.le(far)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::{Accel, Acceleration, Coherence, Geometry, Hits, InstanceGeometry, MeshGeometry};
    use crate::engine::batch::rays;
    use crate::lanes::ArrayF;
    use crate::scene::NONE;

    /// Numbers between -1 and 1.
    struct Random(u32);

    impl Random {
        fn next(&mut self) -> f32 {
            self.0 += 1;
            (crate::sampling::sampler::hash3(7, self.0, 0) >> 40) as f32 / (1u32 << 23) as f32 - 1.0
        }
        fn vector(&mut self) -> [f32; 3] {
            [self.next(), self.next(), self.next()]
        }
    }

    /// A ball whose vertices lie every so many degrees.
    fn ball() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
        let (around, down) = (24u32, 12u32);
        let vertex = |k: u32, row: u32| {
            let (sin, cos) = (row as f32 / down as f32 * std::f32::consts::PI).sin_cos();
            let (y, x) = (k as f32 / around as f32 * std::f32::consts::TAU).sin_cos();
            [sin * x, cos, sin * y]
        };
        let positions = (0..=down).flat_map(|row| (0..around).map(move |k| vertex(k, row))).collect();
        let at = |k: u32, row: u32| row * around + k % around;
        let square = |k: u32, row: u32| {
            [[at(k, row), at(k + 1, row), at(k, row + 1)], [at(k + 1, row), at(k + 1, row + 1), at(k, row + 1)]]
        };
        let triangles = (0..down).flat_map(|row| (0..around).flat_map(move |k| square(k, row))).collect();
        (positions, triangles)
    }

    /// Whatever a ray hits, it passes a box: with a few placed meshes and with many.
    #[test]
    fn rays_that_hit_pass_a_box() {
        let (positions, triangles) = ball();
        let mesh = MeshGeometry { positions: &positions, triangles: &triangles, first_primitive: 0 };
        let mut random = Random(0);
        for placed in [1, 2, 5, 40] {
            let mut place = || {
                let (o, mut rows) = (random.vector(), [random.vector(), random.vector(), random.vector()]);
                (0..3).for_each(|k| rows[k][k] += 1.5);
                std::array::from_fn(|k| [0.3 * rows[k][0], 0.3 * rows[k][1], 0.3 * rows[k][2], 3.0 * o[k]])
            };
            let instances: Vec<_> =
                (0..placed).map(|_| InstanceGeometry { mesh: 0, placement: Some(place()) }).collect();
            let geometry = Geometry { meshes: &[mesh], instances: &instances, ..Geometry::default() };
            let accel = Accel::build(&geometry, Acceleration::Bvh).expect("a tree");
            let mut batch = Batch::new();
            let (mut hit, mut sorted_out) = (0, 0);
            for _ in 0..100 {
                let len = 1000;
                for ray in 0..len {
                    let (o, d) = (random.vector(), random.vector());
                    for axis in 0..3 {
                        batch.paths.origin[axis][ray] = 5.0 * o[axis];
                        batch.paths.direction[axis][ray] = d[axis];
                    }
                    batch.hits.t[ray] = f32::INFINITY;
                }
                batch.paths.len = len;
                reach_closest::<ArrayF<1>>(accel.top_boxes(), &mut batch);
                let reaching = batch.active[..batch.active_len].to_vec();
                let from = vec![NONE; len];
                let rays = rays(&batch.paths.origin, &batch.paths.direction, &from, &from, len);
                let found = &mut *batch.hits;
                let mut hits = Hits {
                    t: &mut found.t[..len],
                    primitive: &mut found.primitive[..len],
                    instance: &mut found.instance[..len],
                };
                hits.primitive.fill(NONE);
                let all: Vec<u32> = (0..len as u32).collect();
                accel.closest(&rays, &all, &mut hits, Coherence::Incoherent);
                for ray in all.iter().filter(|&&ray| hits.primitive[ray as usize] != NONE) {
                    hit += 1;
                    assert!(reaching.binary_search(ray).is_ok(), "{placed} placed: ray {ray} hits and passes no box");
                }
                sorted_out += len - reaching.len();
            }
            println!("{placed} placed: {hit} of 100000 hit, {sorted_out} pass no box");
            assert!(hit > 200 && sorted_out > 200, "{placed}: {hit} {sorted_out}");
        }
    }
}
