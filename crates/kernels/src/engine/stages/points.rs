//! Points of the sampler for the pixels of a batch.

use crate::engine::batch::{ITEMS, path};
use crate::lanes::{Bits, Lanes};
use crate::sampling::blocks::{Item, Pixels};
use crate::sampling::sampler::{Pair, Purpose};

/// The pixels of a vector of slots, as the sampler wants them.
pub struct PixelOf<F: Lanes> {
    reversed_z: F::U,
    item: F::U,
    odd_column: F::M,
    odd_row: F::M,
}

impl<F: Lanes> PixelOf<F> {
    /// `slot` may hold state beside the slot.
    #[inline(always)]
    pub fn new(slot: F::U, pixels: &Pixels) -> Self {
        let word = F::U::splat;
        let slot = slot & word(path::SLOT);
        let z = F::U::gather(&pixels.z, slot);
        let item = slot.shr::<6>();
        // The lowest bits of column and row of the sampler's tile.
        let odd_column = !(z & word(1 << 8)).eq(word(0));
        let odd_row = !(z & word(1 << 9)).eq(word(0));
        PixelOf { reversed_z: z.reverse_bits(), item, odd_column, odd_row }
    }
}

/// A dimension pair with its parts for each item and each tile of the sampler that the item touches: four tables over
/// the items, since tables of 16 words are looked up in registers.
pub struct PairPoints<F: Lanes> {
    pair: Pair,
    x: [[u32; ITEMS]; 4],
    y: [[u32; ITEMS]; 4],
    lanes: std::marker::PhantomData<F>,
}

impl<F: Lanes> PairPoints<F> {
    /// For all items of a batch.
    #[inline(always)]
    pub fn new(seed: u32, purpose: Purpose, items: &[Item]) -> Self {
        let pair = Pair::new(seed, purpose);
        let (mut x, mut y) = ([[0; ITEMS]; 4], [[0; ITEMS]; 4]);
        let (mut last, mut last_sample) = ([None; 4], 0);
        for (k, item) in items.iter().enumerate().take(ITEMS) {
            // The quarters of a block touch the same tiles.
            if k > 0 && items[k - 1] == (Item { quarter: items[k - 1].quarter, ..*item }) {
                for q in 0..4 {
                    (x[q][k], y[q][k]) = (x[q][k - 1], y[q][k - 1]);
                }
                continue;
            }
            let tiles = item.tiles();
            for (q, &tile) in tiles.iter().enumerate() {
                let Some(of) = tile else { continue };
                // Blocks side by side have two in common.
                if k > 0 && last_sample == item.sample && last[q] == tile {
                    (x[q][k], y[q][k]) = (x[q][k - 1], y[q][k - 1]);
                } else {
                    let part = pair.sample_part(of, item.sample);
                    (x[q][k], y[q][k]) = (part.x, part.y);
                }
            }
            (last, last_sample) = (tiles, item.sample);
        }
        PairPoints { pair, x, y, lanes: std::marker::PhantomData }
    }
    /// A table's words for these pixels.
    #[inline(always)]
    fn part(parts: &[[u32; ITEMS]; 4], pixel: &PixelOf<F>) -> F::U {
        let upper =
            F::U::select(pixel.odd_column, F::U::gather(&parts[2], pixel.item), F::U::gather(&parts[0], pixel.item));
        let lower =
            F::U::select(pixel.odd_column, F::U::gather(&parts[3], pixel.item), F::U::gather(&parts[1], pixel.item));
        F::U::select(pixel.odd_row, lower, upper)
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
            parts[k] = (Self::part(&of.x, pixel), Self::part(&of.y, pixel));
            keys[k] = &of.pair;
        }
        Pair::points_of(keys, pixel.reversed_z, parts)
    }
}
