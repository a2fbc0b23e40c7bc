//! The film: per pixel, exact sums of radiance over its samples.
//!
//! Sums do not depend on their order, so threads, resumed renderings and parts of a picture rendered elsewhere give the same bytes.
//! A sample is split into a multiple of 2^-20 and a rest that is rounded to a multiple of 2^-50; each part is summed in its own f64, exactly as long as the sum of up to 2^20 samples stays below 2^32
//! (Demmel and Nguyen: Fast Reproducible Floating-Point Summation, 2013, with two fixed bins).

use crate::engine::{Counters, Statistics};
use crate::lanes::level::Level;
use bytemuck::Zeroable;
use bytemuck::allocation::zeroed_vec;

/// Pixels along a tile's side; see `engine::batch`.
const TILE: u32 = 16;
const PIXELS: usize = 256;

/// A rectangle of pixels, from the upper left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crop {
    /// First column.
    pub x: u32,
    /// First row.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Crop {
    /// The whole picture.
    pub fn whole(size: [u32; 2]) -> Self {
        Crop { x: 0, y: 0, width: size[0], height: size[1] }
    }

    /// The part of it that lies in the picture.
    pub fn within(self, size: [u32; 2]) -> Self {
        let x = self.x.min(size[0]);
        let y = self.y.min(size[1]);
        Crop { x, y, width: self.width.min(size[0] - x), height: self.height.min(size[1] - y) }
    }
}

/// The sums of a tile of 16x16 pixels; pixels in Z-order.
#[derive(Clone, Debug, PartialEq, Zeroable)]
pub(crate) struct Tile {
    coarse: [[f64; PIXELS]; 3],
    fine: [[f64; PIXELS]; 3],
    /// Sum of squares of the luminance, for the noise estimate.
    squares: [f64; PIXELS],
    /// Samples so far, dropped ones included.
    samples: u32,
}

/// Adding and taking away 1.5 * 2^52 * q rounds to a multiple of q, ties to even.
const ROUND_COARSE: f64 = 1.5 * 4_503_599_627_370_496.0 / 1_048_576.0;
const ROUND_FINE: f64 = 1.5 * 4_503_599_627_370_496.0 / 1_125_899_906_842_624.0;
/// Larger samples than this are dropped as not finite: their coarse part would not be exact.
const LARGEST: f32 = 4_294_967_296.0;

/// Luminance of linear sRGB.
pub(crate) fn luminance(rgb: [f64; 3]) -> f64 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

impl Tile {
    /// Adds one sample of each pixel of an item from its slots on, slot k being pixel `pixels[k]`; gives the number of pixels whose
    /// sample was dropped. A sample may be negative: what pixels share is weighed so (`engine::stages::share`).
    pub(crate) fn add(&mut self, radiance: &[Vec<f32>; 3], slots: usize, pixels: &[u8; 64]) -> u64 {
        let [red, green, blue] = radiance.each_ref().map(|channel| &channel[slots..slots + pixels.len()]);
        let mut dropped = 0;
        for (&pixel, ((&r, &g), &b)) in pixels.iter().zip(red.iter().zip(green).zip(blue)) {
            let pixel = usize::from(pixel);
            let sample = [r, g, b];
            // False for NaN too.
            if !sample.iter().all(|&x| x.abs() <= LARGEST) {
                dropped += 1;
                continue;
            }
            for ((x, coarse_sums), fine_sums) in sample.iter().zip(&mut self.coarse).zip(&mut self.fine) {
                let x = f64::from(*x);
                let coarse = (x + ROUND_COARSE) - ROUND_COARSE;
                let fine = ((x - coarse) + ROUND_FINE) - ROUND_FINE;
                coarse_sums[pixel] += coarse;
                fine_sums[pixel] += fine;
            }
            let y = luminance(sample.map(f64::from));
            self.squares[pixel] += y * y;
        }
        dropped
    }

    /// Says that all pixels have been given `samples` more.
    pub(crate) fn count(&mut self, samples: u32) {
        self.samples += samples;
    }
}

/// What [`crate::render`] makes.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    size: [u32; 2],
    crop: Crop,
    seed: u32,
    first_tile: [u32; 2],
    tile_columns: u32,
    tiles: Vec<Tile>,
    /// Rays and dropped samples.
    pub counters: Counters,
    /// Where the time went, if that was asked for.
    pub statistics: Option<Statistics>,
    /// Photons carried light over mirrors and glass: the picture is right in the limit of many samples rather than on average.
    pub caustics: bool,
    /// Lane type that was used.
    pub level: Level,
    /// Threads that were used.
    pub threads: usize,
}

impl Film {
    pub(crate) fn new(size: [u32; 2], crop: Crop, seed: u32) -> Self {
        let first_tile = [crop.x / TILE, crop.y / TILE];
        let end = [(crop.x + crop.width).div_ceil(TILE), (crop.y + crop.height).div_ceil(TILE)];
        let tile_columns = end[0].saturating_sub(first_tile[0]);
        let count = tile_columns as usize * end[1].saturating_sub(first_tile[1]) as usize;
        Film {
            size,
            crop,
            seed,
            first_tile,
            tile_columns,
            // Memory that nothing has been written to: the threads that add to it first have it brought in, not this one.
            tiles: zeroed_vec(count),
            counters: Counters::default(),
            statistics: None,
            caustics: false,
            level: Level::best(),
            threads: 1,
        }
    }

    /// Size of the whole picture.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The part of it that this film holds.
    pub fn crop(&self) -> Crop {
        self.crop
    }

    /// The seed it was rendered with.
    pub fn seed(&self) -> u32 {
        self.seed
    }

    /// Samples of the pixels that have fewest and of those that have most: different only when a rendering was ended early.
    pub fn samples(&self) -> std::ops::RangeInclusive<u32> {
        let counts = || self.tiles.iter().map(|t| t.samples);
        counts().min().unwrap_or(0)..=counts().max().unwrap_or(0)
    }

    /// Bytes of memory that the sums take.
    pub fn bytes(&self) -> usize {
        self.tiles.len() * size_of::<Tile>()
    }

    /// Bytes of memory that the sums of a picture, or part of one, will take.
    pub fn bytes_of(crop: Crop) -> u64 {
        let tiles = |first: u32, length: u32| u64::from((first + length).div_ceil(TILE) - first / TILE);
        tiles(crop.x, crop.width) * tiles(crop.y, crop.height) * size_of::<Tile>() as u64
    }

    /// Column and row of each tile.
    pub(crate) fn tile_positions(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let (first, columns) = (self.first_tile, self.tile_columns.max(1));
        (0..self.tiles.len() as u32).map(move |k| (first[0] + k % columns, first[1] + k / columns))
    }

    pub(crate) fn tiles_mut(&mut self) -> impl Iterator<Item = &mut Tile> {
        self.tiles.iter_mut()
    }

    /// Tile and place in it of a pixel of the crop.
    fn place(&self, x: u32, y: u32) -> (&Tile, usize) {
        let column = x / TILE - self.first_tile[0];
        let row = y / TILE - self.first_tile[1];
        let z = crate::sampling::sampler::z_order(x % TILE, y % TILE);
        (&self.tiles[(row * self.tile_columns + column) as usize], z as usize)
    }

    /// Mean radiance of a pixel, linear RGB; (x, y) in the whole picture, within the crop. Black where there is no sample yet.
    pub fn radiance(&self, x: u32, y: u32) -> [f64; 3] {
        let (tile, pixel) = self.place(x, y);
        let n = f64::from(tile.samples.max(1));
        [0, 1, 2].map(|c| (tile.coarse[c][pixel] + tile.fine[c][pixel]) / n)
    }

    /// Estimated variance of a pixel's mean luminance, were its samples independent (they are better than that). Zero below two
    /// samples.
    pub fn variance(&self, x: u32, y: u32) -> f64 {
        let (tile, pixel) = self.place(x, y);
        let n = f64::from(tile.samples);
        if tile.samples < 2 {
            return 0.0;
        }
        let mean = luminance(self.radiance(x, y));
        ((tile.squares[pixel] / n - mean * mean) / (n - 1.0)).max(0.0)
    }

    /// Root mean square over the pixels of the standard error of a pixel, relative to the mean luminance: the noise of the
    /// picture as one number, an upper bound because the samples are stratified.
    pub fn relative_noise(&self) -> f64 {
        let Crop { x, y, width, height } = self.crop;
        let (mut variance, mut mean) = (0.0, 0.0);
        for py in y..y + height {
            for px in x..x + width {
                variance += self.variance(px, py);
                mean += luminance(self.radiance(px, py));
            }
        }
        let n = f64::from(width) * f64::from(height);
        if mean > 0.0 { (variance / n).sqrt() / (mean / n) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(value: impl Fn(usize) -> f32) -> [Vec<f32>; 3] {
        let column: Vec<f32> = (0..64).map(value).collect();
        [column.clone(), column.clone(), column]
    }

    /// Slot k is pixel k.
    fn first_pixels() -> [u8; 64] {
        std::array::from_fn(|k| k as u8)
    }

    #[test]
    fn sums_do_not_depend_on_their_order() {
        let samples: Vec<[Vec<f32>; 3]> = (0..500u32)
            .map(|k| {
                filled(|pixel| {
                    let h = (k * 64 + pixel as u32).wrapping_mul(0x9e37_79b9);
                    let sign = if h & 16 == 0 { 1.0 } else { -1.0 };
                    // From 2^-31 to 1: the least leave rests of 2^-54 to 2^-51, which sums of the largest would round.
                    f32::from_bits(0x3000_0000 + h % 0x0f80_0000) * sign
                })
            })
            .collect();
        let (mut forwards, mut backwards) = (Tile::zeroed(), Tile::zeroed());
        samples.iter().for_each(|s| assert_eq!(forwards.add(s, 0, &first_pixels()), 0));
        samples.iter().rev().for_each(|s| assert_eq!(backwards.add(s, 0, &first_pixels()), 0));
        assert_eq!(forwards.coarse, backwards.coarse);
        assert_eq!(forwards.fine, backwards.fine);
    }

    #[test]
    fn a_film_takes_the_bytes_that_were_foretold() {
        for crop in
            [Crop::whole([17, 8]), Crop { x: 7, y: 3, width: 2, height: 6 }, Crop { x: 16, y: 8, width: 16, height: 1 }]
        {
            assert_eq!(Film::new([40, 40], crop, 0).bytes() as u64, Film::bytes_of(crop));
        }
    }

    #[test]
    fn wrong_samples_are_dropped_and_counted() {
        let mut tile = Tile::zeroed();
        let samples = filled(|k| [1.0, f32::NAN, -1.0, f32::INFINITY][k % 4]);
        assert_eq!(tile.add(&samples, 0, &first_pixels()), 32);
        assert_eq!([0, 1, 2, 3].map(|k: usize| tile.coarse[0][k]), [1.0, 0.0, -1.0, 0.0]);
    }
}
