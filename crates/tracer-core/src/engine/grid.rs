//! Where the blocks lie whose pixels share what they find.
//!
//! Pixels of an item share, so their errors are alike, and where a block of 16x16 pixels ends, so does what they have in common: were it
//! always at the same place, the border would be seen. So the grid of blocks moves by less than a block from sample index to sample index.
//! It does so by points of the sampler: the first 16 of them lie in all columns and all rows, the first 256 at all places. Blocks at the
//! picture's border hold fewer pixels.

use super::batch::TILE;
use crate::film::Crop;
use crate::lanes::{ArrayF, ArrayU, Bits, Lanes};
use crate::sampling::sampler::{Pair, Purpose};

/// The blocks that touch a crop. Each is rendered whole, as far as it lies in the picture, so that the crop's pixels share with the same
/// others as in the whole picture.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    crop: Crop,
    first: [i32; 2],
    columns: u32,
    rows: u32,
    shifts: Option<Pair>,
}

impl Grid {
    /// Over a crop. Where pixels share nothing the grid need not move, and cuts as few blocks as can be.
    pub fn new(crop: Crop, seed: u32, moves: bool) -> Self {
        let first = [crop.x, crop.y].map(|x| (x / TILE) as i32);
        let most = if moves { TILE - 1 } else { 0 };
        let count = |first: i32, end: u32| (end + most).div_ceil(TILE) - first as u32;
        let is_empty = crop.width == 0 || crop.height == 0;
        Grid {
            crop,
            first,
            columns: if is_empty { 0 } else { count(first[0], crop.x + crop.width) },
            rows: if is_empty { 0 } else { count(first[1], crop.y + crop.height) },
            shifts: moves.then(|| Pair::new(seed, Purpose::Grid)),
        }
    }

    /// Number of places for blocks; at no sample index all of them need be taken.
    pub fn len(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// How far the blocks begin left of and above tiles, in pixels.
    fn shift(&self, sample: u32) -> [i32; 2] {
        let Some(pair) = &self.shifts else { return [0; 2] };
        let part = pair.sample_part(0, sample);
        let [x, y] = [part.x, part.y].map(ArrayU::<1>::splat);
        let (u, v) = pair.points::<ArrayF<1>>(ArrayU::splat(0), x, y);
        [u, v].map(|u| {
            let mut shift = [0.0];
            u.store(&mut shift);
            (shift[0] * TILE as f32) as i32
        })
    }

    /// The first pixel of a place's block at a sample index, where the block touches the crop.
    pub fn block(&self, place: usize, sample: u32) -> Option<[i32; 2]> {
        let at = [place as u32 % self.columns.max(1), place as u32 / self.columns.max(1)];
        let shift = self.shift(sample);
        let corner = [0, 1].map(|axis| (self.first[axis] + at[axis] as i32) * TILE as i32 - shift[axis]);
        let touches = |begin: i32, first: u32, count: u32| {
            i64::from(begin) < i64::from(first + count) && i64::from(begin) + i64::from(TILE) > i64::from(first)
        };
        let Crop { x, y, width, height } = self.crop;
        (touches(corner[0], x, width) && touches(corner[1], y, height)).then_some(corner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// At every sample index each pixel of a crop lies in one block.
    #[test]
    fn blocks_cover_a_crop_once() {
        let crops = [[0, 0, 1, 1], [0, 0, 17, 9], [5, 31, 40, 3], [16, 16, 32, 16], [15, 17, 1, 30], [3, 3, 0, 5]];
        for [x, y, width, height] in crops {
            for (sample, moves) in (0..64).map(|sample| (sample, true)).chain([(7, false)]) {
                let grid = Grid::new(Crop { x, y, width, height }, 3, moves);
                let mut seen = vec![0; (width * height) as usize];
                for [left, top] in (0..grid.len()).filter_map(|place| grid.block(place, sample)) {
                    let mut touched = false;
                    for (px, py) in (0..256).map(|k| (left + k % 16 - x as i32, top + k / 16 - y as i32)) {
                        if (0..width as i32).contains(&px) && (0..height as i32).contains(&py) {
                            seen[(py * width as i32 + px) as usize] += 1;
                            touched = true;
                        }
                    }
                    assert!(touched);
                }
                assert!(seen.iter().all(|&n| n == 1), "{x} {y} {width} {height}, sample {sample}: {seen:?}");
            }
        }
    }

    /// A crop's blocks are those of the whole picture.
    #[test]
    fn crops_have_the_blocks_of_the_whole() {
        let whole = Grid::new(Crop::whole([200, 100]), 5, true);
        let part = Grid::new(Crop { x: 37, y: 21, width: 50, height: 33 }, 5, true);
        for sample in 0..50 {
            let blocks = |grid: &Grid| (0..grid.len()).filter_map(|k| grid.block(k, sample)).collect::<BTreeSet<_>>();
            assert!(!blocks(&part).is_empty() && blocks(&part).is_subset(&blocks(&whole)));
        }
    }

    /// 16 samples shift the grid to every column and every row, 256 to every place, whatever the seed.
    #[test]
    fn shifts_are_even() {
        for seed in 0..20 {
            let grid = Grid::new(Crop::whole([64, 64]), seed, true);
            let shifts = |samples: std::ops::Range<u32>| samples.map(|sample| grid.shift(sample)).collect::<Vec<_>>();
            for axis in [0, 1] {
                assert_eq!(shifts(0..16).iter().map(|shift| shift[axis]).collect::<BTreeSet<_>>().len(), 16);
            }
            assert_eq!(shifts(0..256).into_iter().collect::<BTreeSet<_>>().len(), 256);
        }
    }
}
