//! Which blocks there are.
//!
//! Pixels of a block share, so their errors are alike, and where a block ends, so does what they have in common: were
//! it always at the same place, the border would be seen. Blocks are cut anew for each sample index
//! ([`tracer_kernels::sampling::blocks`]), and all cuts together move by points of the sampler: the first 16 of them
//! lie in all columns and all rows, the first 256 at all places. Blocks at the picture's border hold fewer pixels.

use crate::film::Crop;
use tracer_kernels::sampling::blocks::{BLOCK_PIXELS, Block, Cut, ITEM_PIXELS, Item, Pixels, QUARTERS, TILE};
use tracer_kernels::sampling::sampler::{Pair, Purpose, hash3};

/// The blocks that touch a crop. Each is rendered whole, as far as it lies in the picture, so that the crop's pixels
/// share with the same others as in the whole picture.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    crop: Crop,
    first: [i32; 2],
    columns: u32,
    rows: u32,
    shifts: Option<Pair>,
    seed: u32,
}

impl Grid {
    /// Over a crop. Where pixels share nothing blocks are tiles.
    pub fn new(crop: Crop, seed: u32, ragged: bool) -> Self {
        let first = [crop.x, crop.y].map(|x| (x / TILE) as i32);
        let most = if ragged { TILE - 1 } else { 0 };
        let count = |first: i32, end: u32| (end + most).div_ceil(TILE) - first as u32;
        let is_empty = crop.width == 0 || crop.height == 0;
        Grid {
            crop,
            first,
            columns: if is_empty { 0 } else { count(first[0], crop.x + crop.width) },
            rows: if is_empty { 0 } else { count(first[1], crop.y + crop.height) },
            shifts: ragged.then(|| Pair::new(seed, Purpose::Grid)),
            seed,
        }
    }

    /// Number of places for blocks; at no sample index all of them need be taken.
    pub fn len(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// How the picture is cut at a sample index.
    pub fn cut(&self, sample: u32) -> Cut {
        let Some(pair) = &self.shifts else { return Cut::Straight };
        let shift = pair.point(0, 0, sample).map(|x| (x * TILE as f32) as u8);
        Cut::Ragged { salt: hash3(self.seed, sample, 0x7a66_ed01) as u32, shift }
    }

    /// A place's block, where it may touch the crop.
    pub fn block(&self, place: usize, cut: Cut) -> Option<Block> {
        let at = [place as u32 % self.columns.max(1), place as u32 / self.columns.max(1)];
        let block = Block { tile: [0, 1].map(|axis| self.first[axis] + at[axis] as i32), cut };
        let Crop { x, y, width, height } = self.crop;
        let touches = |axis: usize, first: u32, count: u32| {
            let tiles = block.tiles(axis);
            let side = i64::from(TILE);
            let (begin, end) = (i64::from(*tiles.start()) * side, i64::from(*tiles.end() + 1) * side);
            begin < i64::from(first + count) && end > i64::from(first)
        };
        (touches(0, x, width) && touches(1, y, height)).then_some(block)
    }
}

impl Grid {
    /// The quarter of a block that a pixel of the crop is of at a sample index.
    pub fn quarter(&self, pixel: [u32; 2], sample: u32) -> Option<u32> {
        let mut pixels = Pixels::new(BLOCK_PIXELS);
        let at = pixel.map(|x| x as f32);
        (0..self.len()).filter_map(|place| self.block(place, self.cut(sample))).find_map(|block| {
            pixels.find(&(0..QUARTERS).map(|quarter| Item { block, quarter, sample, resting: 0 }).collect::<Vec<_>>());
            let slot = pixels.x.iter().zip(&pixels.y).position(|(&x, &y)| [x, y] == at)?;
            Some((slot / ITEM_PIXELS) as u32)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Where the pixels of a block lie.
    fn pixels(block: Block) -> Vec<[i32; 2]> {
        let items: Vec<Item> = (0..QUARTERS).map(|quarter| Item { block, quarter, sample: 0, resting: 0 }).collect();
        let mut pixels = Pixels::new(BLOCK_PIXELS);
        pixels.find(&items);
        pixels.x.iter().zip(&pixels.y).map(|(&x, &y)| [x as i32, y as i32]).collect()
    }

    /// At every sample index each pixel of a crop lies in one block.
    #[test]
    fn blocks_cover_a_crop_once() {
        let crops = [[0, 0, 1, 1], [0, 0, 17, 9], [5, 31, 40, 3], [16, 16, 32, 16], [15, 17, 1, 30], [3, 3, 0, 5]];
        for [x, y, width, height] in crops {
            for (sample, ragged) in (0..64).map(|sample| (sample, true)).chain([(7, false)]) {
                let grid = Grid::new(Crop { x, y, width, height }, 3, ragged);
                let cut = grid.cut(sample);
                let mut seen = vec![0; (width * height) as usize];
                for block in (0..grid.len()).filter_map(|place| grid.block(place, cut)) {
                    for [px, py] in pixels(block).into_iter().map(|[px, py]| [px - x as i32, py - y as i32]) {
                        if (0..width as i32).contains(&px) && (0..height as i32).contains(&py) {
                            seen[(py * width as i32 + px) as usize] += 1;
                        }
                    }
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
            let blocks = |grid: &Grid| {
                assert_eq!(grid.cut(sample), whole.cut(sample));
                (0..grid.len()).filter_map(|k| Some(grid.block(k, grid.cut(sample))?.tile)).collect::<BTreeSet<_>>()
            };
            assert!(!blocks(&part).is_empty() && blocks(&part).is_subset(&blocks(&whole)));
        }
    }

    /// 16 samples shift all cuts to every column and every row, 256 to every place, whatever the seed.
    #[test]
    fn shifts_are_even() {
        for seed in 0..20 {
            let grid = Grid::new(Crop::whole([64, 64]), seed, true);
            let shift = |sample: u32| match grid.cut(sample) {
                Cut::Ragged { shift, .. } => shift,
                Cut::Straight => panic!("blocks are ragged"),
            };
            for axis in [0, 1] {
                assert_eq!((0..16).map(|sample| shift(sample)[axis]).collect::<BTreeSet<_>>().len(), 16);
            }
            assert_eq!((0..256).map(shift).collect::<BTreeSet<_>>().len(), 256);
        }
    }

    /// A pixel is of all quarters alike, over its sample indices: with 4096 of them the chi-square of three degrees of
    /// freedom is above 26 by chance once in 100,000.
    #[test]
    fn pixels_are_of_all_quarters() {
        for pixel in [[0, 0], [17, 5], [63, 62]] {
            let crop = Crop { x: pixel[0], y: pixel[1], width: 1, height: 1 };
            let mut counts = [0.0; QUARTERS as usize];
            for sample in 0..4096 {
                let quarter = Grid::new(crop, 8, true).quarter(pixel, sample).expect("it is there");
                assert!(
                    sample > 20 || Grid::new(Crop::whole([64, 64]), 8, true).quarter(pixel, sample) == Some(quarter)
                );
                counts[quarter as usize] += 1.0;
            }
            let chi2 = counts.iter().map(|count: &f64| (count - 1024.0).powi(2) / 1024.0).sum::<f64>();
            assert!(chi2 < 26.0, "{pixel:?}: {counts:?}");
        }
    }

    /// Each pixel of a block is of one of its items, within two by two tiles.
    #[test]
    fn items_share_a_block_out() {
        let grid = Grid::new(Crop::whole([64, 64]), 1, true);
        for sample in 0..32 {
            let block = grid.block(6, grid.cut(sample)).expect("within the picture");
            let pixels = pixels(block);
            assert_eq!(pixels.iter().collect::<BTreeSet<_>>().len(), BLOCK_PIXELS);
            for pixel in pixels {
                let tile = pixel.map(|x| x.div_euclid(TILE as i32));
                assert!(block.tiles(0).contains(&tile[0]) && block.tiles(1).contains(&tile[1]), "{sample}");
            }
        }
    }
}
