//! Blocks of 256 pixels that share what they find, and which pixel each slot of a batch is.
//!
//! Pixels of a block share, so their errors are alike; were blocks squares, one of them that finds much where the
//! others find little would be seen. So blocks are ragged: every row of pixels is cut at places of its own, and so is
//! every column of what the rows leave. Column i and row j of block (a, b) are pixel
//!
//! y = 16 b + j - g(16 a + i),  x = 16 a + i - h(y),
//!
//! with whole numbers g and h from 0 to 15 drawn anew for each sample index: each pixel lies in one block, and a block
//! within two by two tiles of the sampler. All g are odd, or all are even, and so are all h: columns and rows that lie
//! two apart in a block lie an even number of pixels apart in the picture, so that pixels that touch are never of one
//! item.

use super::sampler::{hash3, z_order};

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

/// The slots of the block whose first item this is.
pub fn slots_of_block(first: usize) -> std::ops::Range<usize> {
    first * ITEM_PIXELS..first * ITEM_PIXELS + BLOCK_PIXELS
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
    /// Every other column and row of the block: from the first or second column (bit 0) and row (bit 1) on.
    pub quarter: u32,
    /// Sample index; while glint chains are traced, their index (`engine::glints`).
    pub sample: u32,
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
            let odd = [item.quarter & 1, item.quarter >> 1].map(|odd| odd as usize);
            for (place, &[i, j]) in PLACES.iter().enumerate() {
                let (i, j) = (2 * i as usize + odd[0], 2 * j as usize + odd[1]);
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
}
