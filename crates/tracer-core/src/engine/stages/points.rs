//! Points of the sampler for the pixels of a batch.

use crate::engine::batch::{ITEMS, Item, path};
use crate::lanes::{Bits, Lanes};
use crate::sampling::sampler::{Pair, Purpose};

/// The pixels of a vector of slots, as the sampler wants them.
pub struct PixelOf<F: Lanes> {
    reversed_z: F::U,
    item: F::U,
}

impl<F: Lanes> PixelOf<F> {
    /// `slot` may hold state beside the slot.
    #[inline(always)]
    pub fn new(slot: F::U, item_z: &[u32; ITEMS], item_scale: &[u32; ITEMS]) -> Self {
        let item = (slot & F::U::splat(path::SLOT)).shr::<6>();
        let z = F::U::gather(item_z, item) + (slot & F::U::splat(63)) * F::U::gather(item_scale, item);
        PixelOf { reversed_z: z.reverse_bits(), item }
    }
}

/// A dimension pair with its per-item parts.
pub struct PairPoints<F: Lanes> {
    pair: Pair,
    x: [u32; ITEMS],
    y: [u32; ITEMS],
    lanes: std::marker::PhantomData<F>,
}

impl<F: Lanes> PairPoints<F> {
    /// For all items of a batch.
    #[inline(always)]
    pub fn new(seed: u32, purpose: Purpose, items: &[Item], item_z: &[u32; ITEMS]) -> Self {
        let pair = Pair::new(seed, purpose);
        let (mut x, mut y) = ([0; ITEMS], [0; ITEMS]);
        let mut last = None;
        for (k, item) in items.iter().enumerate() {
            // The quarters of a tile have the same part.
            let of = (item_z[k] >> 8, item.sample);
            if last == Some(of) {
                (x[k], y[k]) = (x[k - 1], y[k - 1]);
            } else {
                let part = pair.sample_part(of.0, of.1);
                (x[k], y[k]) = (part.x, part.y);
            }
            last = Some(of);
        }
        PairPoints { pair, x, y, lanes: std::marker::PhantomData }
    }
    /// The pair's points for these pixels.
    #[inline(always)]
    pub fn points(&self, pixel: &PixelOf<F>) -> (F, F) {
        let [points] = Self::points_of([self], pixel);
        points
    }
    /// The points of several pairs, in the time of one (see [`Pair::points_of`]).
    #[inline(always)]
    pub fn points_of<const K: usize>(pairs: [&Self; K], pixel: &PixelOf<F>) -> [(F, F); K] {
        let mut parts = [(pixel.item, pixel.item); K];
        let mut keys = [&pairs[0].pair; K];
        for (k, of) in pairs.iter().enumerate() {
            parts[k] = (F::U::gather(&of.x, pixel.item), F::U::gather(&of.y, pixel.item));
            keys[k] = &of.pair;
        }
        Pair::points_of(keys, pixel.reversed_z, parts)
    }
}
