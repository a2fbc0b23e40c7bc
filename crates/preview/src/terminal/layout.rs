//! Where a picture stands on the screen, and in what size.

use super::ask::Protocol;
use super::device::Size;

/// What a cell is taken for where nobody knows.
const USUAL: [u32; 2] = [10, 20];

/// What a screen is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Points of a picture in a cell.
    points: [u32; 2],
    /// Height of a point, in widths of one.
    tall: f64,
    /// Points of a picture come in rows of this.
    band: u32,
    /// Whether the size of a cell is known.
    pub known: bool,
}

impl Grid {
    /// `told`: the size of a cell as the terminal says.
    pub fn new(protocol: Protocol, size: Size, told: Option<[u32; 2]>) -> Self {
        let cell = size.cell.or(told);
        let known = cell.is_some();
        match protocol {
            Protocol::Blocks => {
                // A cell is as high as two points that are square, or nearly.
                let tall = cell.map_or(1.0, |[width, height]| f64::from(height) / f64::from(2 * width));
                Grid { points: [1, 2], tall: tall.clamp(0.5, 2.0), band: 1, known }
            }
            // A band may reach below the picture, and must not reach the last line: the screen would scroll.
            Protocol::Sixel => Grid { points: cell.unwrap_or(USUAL), tall: 1.0, band: 6, known },
            Protocol::Kitty | Protocol::Iterm => Grid { points: cell.unwrap_or(USUAL), tall: 1.0, band: 1, known },
        }
    }

    /// Points in so many columns and rows.
    fn points(&self, cells: [u16; 2]) -> [u32; 2] {
        let [columns, rows] = [u32::from(cells[0]) * self.points[0], u32::from(cells[1]) * self.points[1]];
        [columns, rows / self.band * self.band]
    }

    /// The most square pixels that can be seen there.
    pub fn visible(&self, cells: [u16; 2]) -> [u32; 2] {
        let [width, height] = self.points(cells);
        [width.max(1), ((f64::from(height) * self.tall).round() as u32).max(1)]
    }

    /// Where a picture of this size stands in so many columns and rows: as large as can be, a small one enlarged by a
    /// whole factor. `None`: there is no room.
    pub fn place(&self, picture: [u32; 2], cells: [u16; 2]) -> Option<Placed> {
        let bounds = self.points(cells);
        if bounds.contains(&0) {
            return None;
        }
        let [width, height] = picture.map(f64::from);
        let scale = (f64::from(bounds[0]) / width).min(f64::from(bounds[1]) * self.tall / height);
        let scale = if scale >= 1.0 { scale.floor() } else { scale };
        let side = |length: f64, bound: u32| (length.round() as u32).clamp(1, bound);
        let points = [side(width * scale, bounds[0]), side(height * scale / self.tall, bounds[1])];
        let covered = [0, 1].map(|k| points[k].div_ceil(self.points[k]) as u16);
        let at = [0, 1].map(|k| cells[k].saturating_sub(covered[k]) / 2);
        Some(Placed { points, at, covered })
    }
}

/// A place on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placed {
    /// Size of the picture in points.
    pub points: [u32; 2],
    /// Column and row of its first cell, from 0.
    pub at: [u16; 2],
    /// Columns and rows that it takes.
    pub covered: [u16; 2],
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(protocol: Protocol, cell: Option<[u32; 2]>) -> Grid {
        Grid::new(protocol, Size { columns: 80, rows: 24, cell }, None)
    }

    #[test]
    fn half_blocks_keep_the_shape() {
        let square = grid(Protocol::Blocks, None);
        assert_eq!(square.visible([80, 23]), [80, 46]);
        let placed = square.place([512, 512], [80, 23]).expect("room");
        assert_eq!((placed.points, placed.at, placed.covered), ([46, 46], [17, 0], [46, 23]));
        let wide = square.place([1600, 400], [80, 23]).expect("room");
        assert_eq!((wide.points, wide.at, wide.covered), ([80, 20], [0, 6], [80, 10]));
        // A cell of 10 by 24 has points that are taller than wide.
        let tall = grid(Protocol::Blocks, Some([10, 24]));
        let placed = tall.place([600, 600], [80, 20]).expect("room");
        assert_eq!(placed.points, [48, 40]);
        assert_eq!(tall.visible([80, 20]), [80, 48]);
    }

    #[test]
    fn small_pictures_are_enlarged_by_whole_factors() {
        let placed = grid(Protocol::Blocks, None).place([24, 16], [80, 23]).expect("room");
        assert_eq!(placed.points, [48, 32]);
        let placed = grid(Protocol::Kitty, Some([10, 20])).place([24, 16], [80, 23]).expect("room");
        assert_eq!(placed.points, [24 * 28, 16 * 28]);
    }

    #[test]
    fn nothing_reaches_beyond_its_cells() {
        for protocol in [Protocol::Blocks, Protocol::Kitty, Protocol::Iterm, Protocol::Sixel] {
            for cell in [None, Some([9, 19]), Some([7, 13])] {
                for (columns, rows) in [(1, 1), (20, 3), (20, 40), (213, 60)] {
                    for picture in [[1, 1], [1, 4000], [4000, 1], [97, 61], [1920, 1080]] {
                        let grid = grid(protocol, cell);
                        let Placed { points, at, covered } = grid.place(picture, [columns, rows]).expect("room");
                        assert!(at[0] + covered[0] <= columns && at[1] + covered[1] <= rows);
                        let band = if protocol == Protocol::Sixel { 6 } else { 1 };
                        assert!(points[1].next_multiple_of(band) <= u32::from(rows) * grid.points[1]);
                    }
                }
            }
        }
        assert_eq!(grid(Protocol::Blocks, None).place([10, 10], [20, 0]), None);
    }
}
