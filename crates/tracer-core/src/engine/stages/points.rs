//! Points of the sampler for the pixels of a batch.

use crate::engine::batch::{Item, path};
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
    pub fn new(slot: F::U, item_z: &[u32], item_scale: &[u32]) -> Self {
        let item = (slot & F::U::splat(path::SLOT)).shr::<6>();
        let z = F::U::gather(item_z, item) + (slot & F::U::splat(63)) * F::U::gather(item_scale, item);
        PixelOf { reversed_z: z.reverse_bits(), item }
    }
}

/// A dimension pair with its per-item parts.
pub struct PairPoints<F: Lanes> {
    pair: Pair,
    x: [u32; 16],
    y: [u32; 16],
    lanes: std::marker::PhantomData<F>,
}

impl<F: Lanes> PairPoints<F> {
    /// For all items of a batch.
    #[inline(always)]
    pub fn new(seed: u32, purpose: Purpose, items: &[Item], item_z: &[u32]) -> Self {
        let pair = Pair::new(seed, purpose);
        let (mut x, mut y) = ([0; 16], [0; 16]);
        for (k, item) in items.iter().enumerate() {
            let part = pair.sample_part(item_z[k] >> 8, item.sample);
            x[k] = part.x;
            y[k] = part.y;
        }
        PairPoints { pair, x, y, lanes: std::marker::PhantomData }
    }
    /// The pair's points for these pixels.
    #[inline(always)]
    pub fn points(&self, pixel: &PixelOf<F>) -> (F, F) {
        self.pair.points(pixel.reversed_z, F::U::gather(&self.x, pixel.item), F::U::gather(&self.y, pixel.item))
    }
}
