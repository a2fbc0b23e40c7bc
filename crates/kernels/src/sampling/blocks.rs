//! Blocks of 256 pixels that share what they find, and which pixel each slot of a batch is.
//!
//! Pixels of a block share, so their errors are alike; were blocks squares, one of them that finds much where the
//! others find little would be seen. So blocks are ragged: every row of pixels is cut at places of its own, and so is
//! every column of what the rows leave. Column i and row j of block (a, b) are pixel
//!
//! y = 16 b + j - g(16 a + i),  x = 16 a + i - h(y),
//!
//! with whole numbers g and h from 0 to 15 drawn anew for each sample index: each pixel lies in one block, and a block
//! within two by two tiles of the sampler. All g are odd, or all are even, and so are all h: pairs of columns and of
//! rows stay pairs.
//!
//! An item has one column of each pair and one row of each pair, a fourth of the block. Which one is drawn anew for
//! each block, and so is the order of the pairs two by two ([`Deal`]). Were it always every other one, pixels an even
//! number of pixels apart would err alike and those between would not: a screen over walls, seen at 400 % (correlations
//! of 0.38 at four pixels, 0.04 at two and none at one, three and five, in a lampshade's room). Pixels that touch are
//! of one item with half the chance of those further on, so that what is left after a blur is no more than with every
//! other one.

use super::sampler::{hash3, z_order};
use std::ops::Range;

/// Pixels along the side of a tile of sampler and film.
pub const TILE: u32 = 16;
/// Pixels of a block.
pub const BLOCK_PIXELS: usize = (TILE * TILE) as usize;
/// Pixels of an item.
pub const ITEM_PIXELS: usize = BLOCK_PIXELS / QUARTERS as usize;
/// Items that make a block at one sample index.
pub const QUARTERS: u32 = 4;
/// Items in a batch. 1024 paths: fewer leave the vectors of deep bounces empty, more leave the L2 cache.
pub const ITEMS: usize = 16;
/// Slots of a batch: its paths from the camera.
pub const PATHS: usize = ITEMS * ITEM_PIXELS;

/// The slots of a run of items ([`runs`]).
pub fn slots_of(run: &Range<usize>) -> Range<usize> {
    run.start * ITEM_PIXELS..run.end * ITEM_PIXELS
}

/// The runs of a batch's items that are of one block and sample index: all four of it, or one, where each quarter of
/// the pixels sees a moment of its own.
pub fn runs(items: &[Item]) -> impl Iterator<Item = Range<usize>> {
    let is_of_run = |a: &Item, b: &Item| a.block == b.block && a.sample == b.sample;
    items.chunk_by(is_of_run).scan(0, |next, run| {
        let first = *next;
        *next += run.len();
        Some(first..*next)
    })
}

/// How a picture is cut into blocks at a sample index.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cut {
    /// Along the sampler's tiles: nothing is shared.
    #[default]
    Straight,
    /// Raggedly.
    Ragged {
        /// What the cuts are drawn by.
        salt: u32,
        /// The least of h and of g.
        shift: [u8; 2],
    },
}

impl Cut {
    /// How far the cuts of a row or column lie from the tiles', in pixels.
    #[inline(always)]
    fn at(self, axis: usize, line: i32) -> i32 {
        match self {
            Cut::Straight => 0,
            Cut::Ragged { salt, shift } => {
                let steps = hash3(salt, axis as u32, line as u32) >> 61;
                (i32::from(shift[axis]) + 2 * steps as i32) & (TILE as i32 - 1)
            }
        }
    }
}

/// Which columns or rows of a block the quarters have: a bit for each pair says which of the two is the first
/// quarter's, and a bit for each two pairs whether they change places.
#[derive(Clone, Copy)]
struct Deal {
    swapped: u32,
    turned: u32,
}

impl Deal {
    /// The column or row of the first (`odd` is 0) or second quarter that has this place among its eight.
    #[inline(always)]
    fn line(self, place: u8, odd: u32) -> usize {
        let place = u32::from(place);
        let pair = place ^ (self.turned >> (place / 2) & 1);
        (2 * pair + (odd ^ (self.swapped >> pair & 1))) as usize
    }
}

/// A block: where it lies, in tiles, and how it is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Block {
    /// a and b above.
    pub tile: [i32; 2],
    /// How it is cut.
    pub cut: Cut,
}

impl Block {
    /// A block that is a tile.
    pub fn straight(tile: [i32; 2]) -> Self {
        Block { tile, cut: Cut::Straight }
    }

    /// What its quarters have of its columns and of its rows.
    #[inline(always)]
    fn deals(&self) -> [Deal; 2] {
        let bits = match self.cut {
            Cut::Straight => 0,
            Cut::Ragged { salt, .. } => hash3(!salt, self.tile[0] as u32, self.tile[1] as u32),
        };
        [bits as u32, (bits >> 32) as u32].map(|bits| Deal { swapped: bits & 0xff, turned: bits >> 8 & 0xf })
    }

    /// The first and the last of the tiles that it may touch, along an axis.
    pub fn tiles(&self, axis: usize) -> std::ops::RangeInclusive<i32> {
        let last = self.tile[axis];
        if self.cut == Cut::Straight { last..=last } else { last - 1..=last }
    }
}

/// One item: a quarter of a block at a sample index.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Item {
    /// Its block.
    pub block: Block,
    /// One column (bit 0) and row (bit 1) of each pair of the block's.
    pub quarter: u32,
    /// Sample index; while glint chains are traced, their index (`engine::glints`).
    pub sample: u32,
    /// A bit for each of the tiles that take no sample at this index ([`tile_of`]): no camera ray is cast for their
    /// pixels, which share nothing then.
    pub resting: u8,
}

/// The number of a tile among those that a block may touch, by the lowest bits of its column and row: bits 8 and 9 of
/// its pixels' numbers in Z-order.
#[inline]
pub fn tile_of(column: u32, row: u32) -> u32 {
    column & 1 | (row & 1) << 1
}

impl Item {
    /// The tiles of the sampler that its block touches, by the lowest bits of their columns (times two) and rows;
    /// `None` left of and above the picture. They are numbered in Z-order.
    pub fn tiles(&self) -> [Option<u32>; 4] {
        let mut tiles = [None; 4];
        for row in self.block.tiles(1) {
            for column in self.block.tiles(0) {
                if column >= 0 && row >= 0 {
                    tiles[((column & 1) << 1 | row & 1) as usize] = Some(z_order(column as u32, row as u32));
                }
            }
        }
        tiles
    }
}

/// The pixels of the slots of a batch.
pub struct Pixels {
    /// Column; below zero left of the picture.
    pub x: Box<[f32]>,
    /// Row.
    pub y: Box<[f32]>,
    /// Number in Z-order of pixels of the picture.
    pub z: Box<[u32]>,
}

/// Bits of a column or row that are looked at: pictures are at most 65536 pixels wide.
const MOST: i32 = 0xffff;

impl Pixels {
    /// Room for so many slots.
    pub fn new(slots: usize) -> Self {
        let (x, y, z) = (vec![0.0; slots], vec![0.0; slots], vec![0; slots]);
        Pixels { x: x.into(), y: y.into(), z: z.into() }
    }

    /// Finds those of the items, one after the other.
    pub fn find(&mut self, items: &[Item]) {
        const SIDE: usize = TILE as usize;
        let mut of_columns = [0; SIDE];
        let mut of_rows = [0; 2 * SIDE];
        let mut last = None;
        for (k, item) in items.iter().enumerate() {
            let Block { tile, cut } = item.block;
            let first = tile.map(|tile| tile * TILE as i32);
            // The quarters of a block come one after the other.
            if last != Some(item.block) {
                of_columns = std::array::from_fn(|i| cut.at(1, first[0] + i as i32));
                of_rows = std::array::from_fn(|j| cut.at(0, first[1] + j as i32 - TILE as i32));
                last = Some(item.block);
            }
            let [columns, rows] = item.block.deals();
            let columns: [_; SIDE / 2] = std::array::from_fn(|i| columns.line(i as u8, item.quarter & 1));
            let rows: [_; SIDE / 2] = std::array::from_fn(|j| rows.line(j as u8, item.quarter >> 1));
            for (place, &[i, j]) in PLACES.iter().enumerate() {
                let (i, j) = (columns[usize::from(i & 7)] & 15, rows[usize::from(j & 7)]);
                let of_block = j as i32 - of_columns[i];
                let y = first[1] + of_block;
                let x = first[0] + i as i32 - of_rows[(of_block + TILE as i32) as usize];
                let slot = k * ITEM_PIXELS + place;
                (self.x[slot], self.y[slot]) = (x as f32, y as f32);
                self.z[slot] = z_order((x & MOST) as u32, (y & MOST) as u32);
            }
        }
    }
}

/// Column and row of the slots of an item, in Z-order.
static PLACES: [[u8; 2]; ITEM_PIXELS] = {
    let mut table = [[0; 2]; ITEM_PIXELS];
    let mut z = 0;
    while z < ITEM_PIXELS {
        let mut axis = 0;
        while axis < 2 {
            let b = z >> axis;
            table[z][axis] = ((b & 1) | (b >> 1 & 2) | (b >> 2 & 4)) as u8;
            axis += 1;
        }
        z += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines are cut at all places of their parity alike. With 4096 lines the chi-square of seven degrees of freedom is
    /// above 31 by chance once in 16,000.
    #[test]
    fn cuts_are_everywhere() {
        for (axis, shift) in (0..2).flat_map(|axis| (0..TILE as u8).map(move |shift| (axis, shift))) {
            let cut = Cut::Ragged { salt: 77 + u32::from(shift), shift: [shift; 2] };
            let mut counts = [0.0; TILE as usize];
            (-1000..3096).for_each(|line| counts[cut.at(axis, line) as usize] += 1.0);
            let (own, other): (Vec<_>, Vec<_>) =
                counts.iter().enumerate().partition(|(k, _)| k % 2 == usize::from(shift) % 2);
            assert!(other.iter().all(|&(_, &count)| count == 0.0));
            let chi2 = own.iter().map(|&(_, &count): &(usize, &f64)| (count - 512.0).powi(2) / 512.0).sum::<f64>();
            assert!(chi2 < 31.0, "{axis} {shift}: {chi2} {counts:?}");
        }
    }

    /// All items are in a run, whole blocks and parts of them alike.
    #[test]
    fn runs_are_of_one_block() {
        let item = |x: i32, quarter: u32, sample: u32| {
            let block = Block::straight([x, 1]);
            Item { block, quarter, sample, resting: 0 }
        };
        let whole = (0..2).flat_map(|sample| (0..2).flat_map(move |x| (0..QUARTERS).map(move |q| item(x, q, sample))));
        let whole: Vec<_> = runs(&whole.collect::<Vec<_>>()).collect();
        assert_eq!(whole, [0..4, 4..8, 8..12, 12..16]);
        let parts: Vec<_> = runs(&[item(0, 2, 5), item(1, 2, 5), item(1, 2, 6)]).collect();
        assert_eq!(parts, [0..1, 1..2, 2..3]);
        assert_eq!((runs(&[]).count(), slots_of(&(1..3))), (0, 64..192));
    }

    /// Both quarters have one line of each pair, and lines of different pairs are of one quarter half the time, or
    /// stand at places of one parity. With 4000 blocks the deviation of a frequency is 0.008.
    #[test]
    fn lines_are_dealt_by_pairs() {
        const BLOCKS: i32 = 4000;
        let mut together = [[0; TILE as usize]; TILE as usize];
        let mut alternate = [0; TILE as usize];
        for k in 0..BLOCKS {
            let block = Block { tile: [k % 60, k / 60], cut: Cut::Ragged { salt: 9, shift: [0; 2] } };
            for deal in block.deals() {
                let quarters = [0, 1].map(|odd| (0..8).map(|place| deal.line(place, odd)).collect::<Vec<_>>());
                for lines in &quarters {
                    let mut pairs: Vec<_> = lines.iter().map(|line| line / 2).collect();
                    pairs.sort_unstable();
                    assert_eq!(pairs, (0..8).collect::<Vec<_>>());
                    for (place, &line) in lines.iter().enumerate() {
                        lines.iter().for_each(|&other| together[line][other] += 1);
                        alternate[line] += place % 2;
                    }
                }
                assert!((0..8).all(|place| quarters[0][place] / 2 == quarters[1][place] / 2));
                assert!(quarters.concat().into_iter().collect::<std::collections::BTreeSet<_>>().len() == 16);
            }
        }
        let frequency = |count: i32| f64::from(count) / f64::from(2 * BLOCKS);
        for (line, row) in together.iter().enumerate() {
            for (other, &count) in row.iter().enumerate().filter(|(other, _)| *other != line) {
                let expected = if other / 2 == line / 2 { 0.0 } else { 0.5 };
                assert!((frequency(count) - expected).abs() < 0.03, "{line}, {other}: {}", frequency(count));
            }
            assert!((frequency(alternate[line] as i32) - 0.5).abs() < 0.03, "{line}");
        }
    }
}
