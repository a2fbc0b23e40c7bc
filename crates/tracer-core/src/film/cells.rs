//! The film while threads add to it: its tiles behind a lock each.
//!
//! The blocks that pixels share in lie across tiles, up to four of them. One is locked at a time, so threads cannot wait for each other in
//! a circle; sums are exact, so who comes first does not matter.

use super::state::Keeper;
use super::{Crop, Film, TILE, Tile};
use crate::sampling::sampler::z_order;
use std::ops::Range;
use std::sync::{Mutex, MutexGuard};

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

/// The pixels of the film that a block of 16x16 pixels and a tile have in common.
pub(crate) struct Overlap {
    corner: [i32; 2],
    columns: Range<u32>,
    rows: Range<u32>,
}

/// The bits of four, each followed by a zero.
const DILATED: [u8; 16] = {
    let mut table = [0; 16];
    let mut k = 0u8;
    while k < 16 {
        table[k as usize] = (k & 1) | (k & 2) << 1 | (k & 4) << 2 | (k & 8) << 3;
        k += 1;
    }
    table
};

impl Overlap {
    /// Number of pixels.
    pub fn pixels(&self) -> u64 {
        self.columns.len() as u64 * self.rows.len() as u64
    }

    /// Those of a quarter of the block, every other pixel of every other row: place among the quarter's, and in the tile; both in Z-order.
    #[inline(always)]
    pub fn of_quarter(&self, quarter: u32) -> impl Iterator<Item = (usize, usize)> + Clone + use<> {
        let of = |pixels: &Range<u32>, corner: i32, odd: u32| {
            let skipped = (pixels.start as i32 - corner) as u32 & 1 ^ odd;
            (pixels.start + skipped..pixels.end).step_by(2).map(move |x| {
                let k = (x as i32 - corner) as usize >> 1;
                (usize::from(DILATED[k & 15]), usize::from(DILATED[(x % TILE) as usize]))
            })
        };
        let [corner_x, corner_y] = self.corner;
        let columns = of(&self.columns, corner_x, quarter & 1);
        of(&self.rows, corner_y, quarter >> 1)
            .flat_map(move |(j, y)| columns.clone().map(move |(i, x)| (i | j << 1, x | y << 1)))
    }
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

    /// Adds what a light path brings to a pixel, if it is one of the crop.
    pub fn splat(&self, [x, y]: [i32; 2], brings: [f32; 3], limit: Option<f64>) {
        let Crop { x: left, y: top, width, height } = self.crop;
        let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return };
        if x < left || y < top || x - left >= width || y - top >= height {
            return;
        }
        let place = (y / TILE - self.first_tile[1]) * self.columns + x / TILE - self.first_tile[0];
        let pixel = z_order(x % TILE, y % TILE) as usize;
        self.lock(place as usize).tile.splat(pixel, brings, limit);
    }

    /// Does a work for each tile that shares pixels with the block of 16x16 pixels whose first pixel this is.
    pub fn each(&self, corner: [i32; 2], mut work: impl FnMut(&mut Tile, &Overlap)) {
        let Crop { x, y, width, height } = self.crop;
        // What of the block lies in the crop.
        let within = |corner: i32, first: u32, count: u32| {
            let place = |x: i32| u32::try_from(x).unwrap_or(0).clamp(first, first + count);
            place(corner)..place(corner + TILE as i32)
        };
        let (columns, rows) = (within(corner[0], x, width), within(corner[1], y, height));
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let of_tile = |pixels: &Range<u32>, tile: u32| pixels.start.max(tile * TILE)..pixels.end.min((tile + 1) * TILE);
        let tiles = |pixels: &Range<u32>| pixels.start / TILE..=(pixels.end - 1) / TILE;
        for row in tiles(&rows) {
            for column in tiles(&columns) {
                let place = (row - self.first_tile[1]) * self.columns + column - self.first_tile[0];
                let overlap = Overlap { corner, columns: of_tile(&columns, column), rows: of_tile(&rows, row) };
                work(self.lock(place as usize).tile, &overlap);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::sampler::z_order;

    /// Wherever a block lies, the pixels that it has in common with a crop are met once, at their places.
    #[test]
    fn blocks_meet_each_pixel_once() {
        let size = [40, 35];
        for crop in [Crop::whole(size), Crop { x: 7, y: 18, width: 11, height: 9 }] {
            let mut film = Film::new(size, crop, 0, 1.0, None);
            for corner in (-17..42).flat_map(|y| [-16, -15, -3, 0, 1, 7, 16, 29, 39].map(|x| [x, y])) {
                let cells = Cells::new(&mut film, None);
                let mut pixels = 0;
                cells.each(corner, |tile, overlap| {
                    pixels += overlap.pixels();
                    for quarter in 0..4 {
                        let item = crate::engine::tests::first_pixel(corner, quarter);
                        for (k, place) in overlap.of_quarter(quarter) {
                            let of = |bits: usize| (bits & 1 | bits >> 1 & 2 | bits >> 2 & 4) as i32;
                            let [x, y] = [item[0] + 2 * of(k), item[1] + 2 * of(k >> 1)].map(|x| x as u32);
                            assert_eq!(place, z_order(x % TILE, y % TILE) as usize);
                            // Counted by the pixel's own number.
                            tile.squares.add(place, f64::from(y * size[0] + x + 1));
                            tile.samples[place] += 1;
                        }
                    }
                });
                let mut expected = 0;
                for (x, y) in film.pixels() {
                    let inside = (corner[0]..corner[0] + 16).contains(&(x as i32))
                        && (corner[1]..corner[1] + 16).contains(&(y as i32));
                    let number = if inside { f64::from(y * size[0] + x + 1).powi(2) } else { 0.0 };
                    let (tile, place) = film.place(x, y);
                    assert_eq!(
                        (tile.squares.of(place), tile.samples[place]),
                        (number, u32::from(inside)),
                        "{corner:?}"
                    );
                    expected += u64::from(inside);
                }
                assert_eq!(pixels, expected);
                film = Film::new(size, crop, 0, 1.0, None);
            }
        }
    }
}
