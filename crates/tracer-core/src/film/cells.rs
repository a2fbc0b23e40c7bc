//! The film while threads add to it: its tiles behind a lock each.
//!
//! The blocks that pixels share in lie across tiles, up to two by two of them. One is locked at a time, so threads
//! cannot wait for each other in a circle; sums are exact, so who comes first does not matter.

use super::state::Keeper;
use super::{Crop, Film, TILE, Tile};
use std::ops::Range;
use std::sync::{Mutex, MutexGuard};
use tracer_kernels::sampling::blocks::{BLOCK_PIXELS, Pixels};
use tracer_kernels::sampling::sampler::z_order;

/// A film that threads add to.
pub(crate) struct Cells<'a> {
    crop: Crop,
    first_tile: [u32; 2],
    columns: u32,
    tiles: Vec<Mutex<Cell<'a>>>,
    keeper: Option<Keeper>,
}

/// A tile, and whether it has been kept as it was, if that is asked for.
struct Cell<'a> {
    tile: &'a mut Tile,
    kept: bool,
}

impl<'a> Cells<'a> {
    /// Of a film, which the keeper is told as it is now.
    pub fn new(film: &'a mut Film, keeper: Option<Keeper>) -> Self {
        let kept = keeper.is_none();
        Cells {
            crop: film.crop,
            first_tile: film.first_tile,
            columns: film.tile_columns,
            tiles: film.tiles.iter_mut().map(|tile| Mutex::new(Cell { tile, kept })).collect(),
            keeper,
        }
    }

    /// Whoever keeps the film as it was.
    pub fn keeper(&self) -> Option<&Keeper> {
        self.keeper.as_ref()
    }

    /// Keeps all tiles that nothing has been added to yet.
    pub fn keep_all(&self) {
        let Some(keeper) = &self.keeper else { return };
        for place in 0..self.tiles.len() {
            if keeper.is_closed() {
                break;
            }
            drop(self.lock(place));
            keeper.wait();
        }
    }

    /// A tile that can be added to.
    #[inline]
    fn lock(&self, place: usize) -> MutexGuard<'_, Cell<'a>> {
        let mut cell = self.tiles[place].lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if !cell.kept {
            cell.kept = true;
            self.keep(place, cell.tile);
        }
        cell
    }

    #[cold]
    fn keep(&self, place: usize, tile: &Tile) {
        if let Some(keeper) = &self.keeper {
            keeper.keep(place, tile);
        }
    }

    /// Adds what a light path of a sample index, and of a group of so many, brings to pixels, to those of the crop that
    /// take that index. Pixels of one tile that come one after the other cost one lock.
    pub fn splat(
        &self,
        falls: &[([i32; 2], [f32; 3])],
        (limit, sample): (Option<f64>, u32),
        group: Option<[usize; 2]>,
    ) {
        let Crop { x: left, y: top, width, height } = self.crop;
        let mut held: Option<(u32, MutexGuard<'_, Cell<'a>>)> = None;
        for &([x, y], brings) in falls {
            let (x, y) = (x as u32, y as u32);
            // Left of and above the picture they are larger than any side.
            if x.wrapping_sub(left) >= width || y.wrapping_sub(top) >= height {
                continue;
            }
            let place = (y / TILE - self.first_tile[1]) * self.columns + x / TILE - self.first_tile[0];
            if held.as_ref().is_none_or(|(of, _)| *of != place) {
                // One at a time: the last one is given free first.
                drop(held.take());
                held = Some((place, self.lock(place as usize)));
            }
            let Some(tile) = held.as_mut().map(|(_, cell)| &mut *cell.tile).filter(|tile| tile.takes(sample)) else {
                continue;
            };
            let pixel = z_order(x % TILE, y % TILE) as usize;
            let Some(added) = tile.splat(pixel, brings, limit) else { continue };
            if tile.half_of(sample) == 1 {
                tile.splat_half(pixel, added);
            }
            if let Some([group, count]) = group {
                tile.splat_group((group, count), pixel, added);
            }
        }
    }

    /// Does a work for each tile that takes a sample index and has pixels in common with the block, or part of one,
    /// that has these slots; what it is given tells them: slot counted from the first, and place in the tile.
    pub fn each(
        &self,
        pixels: &Pixels,
        (slots, sample): (Range<usize>, u32),
        mut work: impl FnMut(&mut Tile, &[[u8; 2]]),
    ) {
        let Crop { x: left, y: top, width, height } = self.crop;
        // By the lowest bits of the tile's column and row: a block lies within two by two tiles.
        let (mut common, mut lens, mut places) = ([[[0; 2]; BLOCK_PIXELS]; 4], [0; 4], [0; 4]);
        let of_slots = pixels.x[slots.clone()].iter().zip(&pixels.y[slots.clone()]).zip(&pixels.z[slots]);
        for (k, ((&x, &y), &z)) in of_slots.enumerate() {
            let (x, y) = (x as i32 as u32, y as i32 as u32);
            if x.wrapping_sub(left) >= width || y.wrapping_sub(top) >= height {
                continue;
            }
            let tile = (z >> 8 & 3) as usize;
            if lens[tile] == 0 {
                places[tile] = (y / TILE - self.first_tile[1]) * self.columns + x / TILE - self.first_tile[0];
            }
            common[tile][lens[tile]] = [k as u8, z as u8];
            lens[tile] += 1;
        }
        for tile in 0..4 {
            if lens[tile] > 0 {
                let cell = &mut self.lock(places[tile] as usize);
                if cell.tile.takes(sample) {
                    work(cell.tile, &common[tile][..lens[tile]]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tracer_kernels::sampling::blocks::{Block, Cut, Item, QUARTERS};

    /// However a block is cut, the pixels that it has in common with a crop are met once, at their places.
    #[test]
    fn blocks_meet_each_pixel_once() {
        let size = [40, 35];
        let cuts = [Cut::Straight, Cut::Ragged { salt: 5, shift: [3, 8] }, Cut::Ragged { salt: 6, shift: [15, 0] }];
        let blocks = cuts
            .into_iter()
            .flat_map(|cut| (-1..5).flat_map(move |row| (-1..5).map(move |column| Block { tile: [column, row], cut })));
        for (crop, block) in [Crop::whole(size), Crop { x: 7, y: 18, width: 11, height: 9 }]
            .into_iter()
            .flat_map(|crop| blocks.clone().map(move |block| (crop, block)))
        {
            let mut film = Film::new(size, crop, 0, 1.0, None);
            let mut pixels = Pixels::new(512);
            // Behind another block.
            let items = [Block::default(), block]
                .into_iter()
                .flat_map(|block| (0..QUARTERS).map(move |quarter| Item { block, quarter, sample: 0, resting: 0 }));
            pixels.find(&items.collect::<Vec<_>>());
            let at = |slot: usize| [pixels.x[slot] as i64, pixels.y[slot] as i64];
            let mut met = 0;
            Cells::new(&mut film, None).each(&pixels, (256..512, 0), |tile, common| {
                met += common.len();
                for &[k, place] in common {
                    let [x, y] = at(256 + usize::from(k)).map(|x| x as u32);
                    assert_eq!(u32::from(place), z_order(x % TILE, y % TILE));
                    // Counted by the pixel's own number.
                    tile.squares.add(place.into(), f64::from(y * size[0] + x + 1));
                    tile.samples[usize::from(place)] += 1;
                }
            });
            let mut expected = 0;
            for (x, y) in film.pixels() {
                let inside = (256..512).filter(|&slot| at(slot) == [x, y].map(i64::from)).count();
                let number = if inside == 1 { f64::from(y * size[0] + x + 1).powi(2) } else { 0.0 };
                let (tile, place) = film.place(x, y);
                assert_eq!((tile.squares.of(place), tile.samples[place] as usize), (number, inside), "{block:?}");
                expected += inside;
            }
            assert_eq!(met, expected);
        }
    }
}
