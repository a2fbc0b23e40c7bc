//! What camera rays hit first, for the layers that are asked for ([`crate::layers`]): a kernel of its own, run where
//! there are any, so that pictures without them pay nothing.

use super::camera::filter_offset;
use super::points::{PairPoints, PixelOf};
use super::surface_at::surface_and_uv_at;
use crate::engine::batch::{Batch, path};
use crate::lanes::{Bits, Lanes, Mask};
use crate::layers::{Definition, FirstHit, LayerSet, Pixel, at, definition};
use crate::math::V3;
use crate::sampling::blocks::ITEM_PIXELS;
use crate::sampling::sampler::Purpose;
use crate::scene::{NONE, Scene};

/// Lanes of the widest registers.
const MOST_LANES: usize = 16;

/// Fills `batch.layers` from the camera rays in `batch.paths` and their hits.
#[inline(always)]
pub fn first_hits<F: Lanes>(scene: &Scene, seed: u32, layers: LayerSet, batch: &mut Batch) {
    let (paths, hits, samples) = (&*batch.paths, &*batch.hits, &mut batch.layers);
    let wants_uv = scene.tables.materials.textured || layers.kept().uv;
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
        let s = surface_and_uv_at(scene, origin, direction, t, primitive, instance, valid, wants_uv);
        let hit = FirstHit { scene, valid, direction, t, surface: &s };
        let bits = valid.bits();
        let slots = &paths.slot[i..i + count];
        for (lane, &slot) in slots.iter().enumerate() {
            let slot = (slot & path::SLOT) as usize;
            samples.hits[slot / ITEM_PIXELS] |= u64::from(bits >> lane & 1) << (slot % ITEM_PIXELS);
        }
        let mut bodies = [0; MOST_LANES];
        s.body.store(&mut bodies);
        let (mut sum, mut nearest) = (0, 0);
        for layer in layers.iter() {
            let Definition { channels, pixel, .. } = definition(layer);
            match pixel {
                Pixel::Mean | Pixel::MeanOfHits(_) => {
                    for value in &at(layer, &hit)[..channels.len()] {
                        let mut of_lane = [0.0; MOST_LANES];
                        // Lanes that hit nothing keep the zero that the column begins with.
                        F::select(valid, *value, F::splat(0.0)).store(&mut of_lane);
                        for (&slot, &value) in slots.iter().zip(&of_lane) {
                            samples.sums[sum][(slot & path::SLOT) as usize] = value;
                        }
                        sum += 1;
                    }
                }
                Pixel::Nearest(number) => {
                    for (lane, &slot) in slots.iter().enumerate() {
                        if bits >> lane & 1 == 1 {
                            let (primitive, instance) = (hits.primitive[i + lane], hits.instance[i + lane]);
                            samples.nearest[nearest][(slot & path::SLOT) as usize] =
                                number(scene, primitive, instance, bodies[lane]);
                        }
                    }
                    nearest += 1;
                }
                Pixel::Seen | Pixel::Counted(_) | Pixel::Direct | Pixel::Indirect => sum += channels.len(),
                Pixel::OfFilm(_) => {}
            }
        }
    }
    if !samples.nearest.is_empty() {
        distances::<F>(scene, seed, batch);
    }
}

/// How far from its pixel's centre each sample lies: the camera rays' own points ([`super::camera`]).
#[inline(always)]
fn distances<F: Lanes>(scene: &Scene, seed: u32, batch: &mut Batch) {
    let paths = &*batch.paths;
    let points = PairPoints::<F>::new(seed, Purpose::Pixel, &batch.items);
    for i in (0..paths.len).step_by(F::N) {
        let (u, v) = points.points(&PixelOf::<F>::new(F::U::load(&paths.slot[i..]), &batch.pixels));
        let (dx, dy) = filter_offset::<F>(scene.camera.filter, u, v);
        let mut of_lane = [0.0; MOST_LANES];
        dx.fma(dx, dy * dy).store(&mut of_lane);
        for (&slot, &distance2) in paths.slot[i..paths.len].iter().zip(&of_lane[..F::N]) {
            batch.layers.distance2[(slot & path::SLOT) as usize] = distance2;
        }
    }
}
