//! What camera rays hit first, for the layers that are asked for ([`crate::layers`]): a kernel of its own, run where there are any, so
//! that pictures without them pay nothing.

use super::surface::surface;
use crate::engine::batch::{BLOCK_PIXELS, Batch, path};
use crate::lanes::{Bits, Lanes, Mask};
use crate::layers::{FirstHit, LayerSet, at, definition};
use crate::math::V3;
use crate::scene::{NONE, Scene};

/// Lanes of the widest registers.
const MOST_LANES: usize = 16;

/// Fills `batch.layers` from the camera rays in `batch.paths` and their hits.
#[inline(always)]
pub fn first_hits<F: Lanes>(scene: &Scene, layers: LayerSet, batch: &mut Batch) {
    let (paths, hits, samples) = (&batch.paths, &batch.hits, &mut batch.layers);
    for i in (0..paths.len).step_by(F::N) {
        let count = F::N.min(paths.len - i);
        let primitive = F::U::load(&hits.primitive[i..]);
        let valid = F::first(count) & !primitive.eq(F::U::splat(NONE));
        if !valid.any() {
            continue;
        }
        let origin = V3::<F>::load(&paths.origin, i);
        let direction = V3::<F>::load(&paths.direction, i);
        let t = F::load(&hits.t[i..]);
        let instance = F::U::load(&hits.instance[i..]);
        let s = surface(scene, origin, direction, t, primitive, instance, valid);
        let hit = FirstHit { scene, valid, direction, t, surface: &s };
        let bits = valid.bits();
        let slots = &paths.slot[i..i + count];
        for (lane, &slot) in slots.iter().enumerate() {
            let slot = (slot & path::SLOT) as usize;
            samples.hits[slot / BLOCK_PIXELS] |= u64::from(bits >> lane & 1) << (slot % BLOCK_PIXELS);
        }
        let mut column = 0;
        for layer in layers.iter() {
            let values = at(layer, &hit);
            for value in &values[..definition(layer).channels.len()] {
                let mut of_lane = [0.0; MOST_LANES];
                // Lanes that hit nothing keep the zero that the column begins with.
                F::select(valid, *value, F::splat(0.0)).store(&mut of_lane);
                for (&slot, &value) in slots.iter().zip(&of_lane) {
                    samples.columns[column][(slot & path::SLOT) as usize] = value;
                }
                column += 1;
            }
        }
    }
}
