//! Planes of numbers, one a pixel.

use rayon::prelude::*;

/// A number for each pixel, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    pub width: usize,
    pub height: usize,
    pub values: Vec<f32>,
}

/// Red, green, blue.
pub type Colours = [Plane; 3];

impl Plane {
    pub fn new(width: usize, height: usize) -> Self {
        Plane { width, height, values: vec![0.0; width * height] }
    }

    /// Number by number, from their places.
    pub fn of(width: usize, height: usize, value: impl Fn(usize) -> f32 + Sync) -> Self {
        let mut plane = Plane::new(width, height);
        plane.values.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for (x, to) in row.iter_mut().enumerate() {
                *to = value(y * width + x);
            }
        });
        plane
    }

    /// Mean over the square that reaches so far, of those of its pixels that there are. Each is summed anew: what lies
    /// outside of the square leaves no rounding in it.
    pub fn blurred(&self, reach: usize) -> Plane {
        let (width, height) = (self.width, self.height);
        let mut across = Plane::new(width, height);
        across.values.par_chunks_mut(width).zip(self.values.par_chunks(width)).for_each(|(to, from)| {
            for (x, to) in to.iter_mut().enumerate() {
                let part = &from[x.saturating_sub(reach)..(x + reach + 1).min(width)];
                *to = part.iter().sum::<f32>() / part.len() as f32;
            }
        });
        let mut down = Plane::new(width, height);
        down.values.par_chunks_mut(width).enumerate().for_each(|(y, to)| {
            let rows = y.saturating_sub(reach)..(y + reach + 1).min(height);
            let share = 1.0 / rows.len() as f32;
            for row in rows {
                let from = &across.values[row * width..][..width];
                to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
            }
            to.iter_mut().for_each(|to| *to *= share);
        });
        down
    }

    /// With a border of so many pixels more on each side, and as many behind the rows' ends as make their width
    /// within it a multiple of `tile`: all like the nearest pixel that there is.
    pub fn padded(&self, border: usize, tile: usize) -> Padded {
        let (width, height) = (self.width, self.height);
        let (stride, rows) = (width.div_ceil(tile) * tile + 2 * border, height + 2 * border);
        let mut values = vec![0.0; stride * rows];
        values.par_chunks_mut(stride).enumerate().for_each(|(y, row)| {
            let from = &self.values[y.saturating_sub(border).min(height - 1) * width..][..width];
            row[..border].fill(from[0]);
            row[border..border + width].copy_from_slice(from);
            row[border + width..].fill(from[width - 1]);
        });
        Padded { stride, border, values }
    }
}

/// A plane with a border.
#[derive(Clone, Debug)]
pub struct Padded {
    pub stride: usize,
    pub border: usize,
    pub values: Vec<f32>,
}

impl Padded {
    /// The place of a pixel that may lie in the border.
    #[inline(always)]
    pub fn place(&self, x: isize, y: isize) -> usize {
        (y + self.border as isize) as usize * self.stride + (x + self.border as isize) as usize
    }

    /// Numbers of a row from a place on.
    #[inline(always)]
    pub fn row<const LENGTH: usize>(&self, place: usize) -> &[f32; LENGTH] {
        self.values[place..].first_chunk().unwrap_or(&[0.0; LENGTH])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_over_the_pixels_that_there_are() {
        let plane = Plane::of(4, 3, |k| k as f32);
        let blurred = plane.blurred(1);
        assert_eq!(blurred.values[0], (0.0 + 1.0 + 4.0 + 5.0) / 4.0);
        assert_eq!(blurred.values[5], 5.0);
        assert_eq!(plane.blurred(9).values, [5.5; 12]);
    }

    #[test]
    fn borders_are_like_the_nearest_pixel() {
        let padded = Plane::of(5, 2, |k| k as f32).padded(3, 4);
        assert_eq!(padded.stride, 8 + 6);
        assert_eq!(padded.row::<4>(padded.place(-3, -2)), &[0.0, 0.0, 0.0, 0.0]);
        assert_eq!(padded.row::<4>(padded.place(3, 1)), &[8.0, 9.0, 9.0, 9.0]);
        assert_eq!(padded.row::<4>(padded.place(7, 4)), &[9.0; 4]);
    }
}
