//! The film: per pixel, exact sums of radiance over its samples.
//!
//! Sums do not depend on their order, so threads, resumed renderings and parts of a picture rendered elsewhere give the same bytes.
//! A sample is split into a multiple of 2^-20 and a rest that is rounded to a multiple of 2^-50; each part is summed in its own f64, exactly as long as the sum of up to 2^20 samples stays below 2^32
//! (Demmel and Nguyen: Fast Reproducible Floating-Point Summation, 2013, with two fixed bins).

use crate::engine::{Costs, Counters, Statistics};
use crate::level::Level;
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

/// Exact sums of radiance per pixel of a tile.
#[derive(Clone, Debug, PartialEq, Zeroable)]
struct Sums {
    coarse: [[f64; PIXELS]; 3],
    fine: [[f64; PIXELS]; 3],
}

impl Sums {
    /// Mean of a pixel over so many samples.
    #[inline]
    fn mean(&self, pixel: usize, samples: u32) -> [f64; 3] {
        let n = f64::from(samples.max(1));
        // Written out: `map` is not always inlined.
        let mean = |c: usize| (self.coarse[c][pixel] + self.fine[c][pixel]) / n;
        [mean(0), mean(1), mean(2)]
    }
}

/// What clamping took from the pixels of a tile.
#[derive(Clone, Debug, PartialEq, Zeroable)]
struct Taken {
    sums: Sums,
    /// Samples that were scaled down.
    samples: [u32; PIXELS],
}

/// The sums of a tile of 16x16 pixels; pixels in Z-order.
#[derive(Clone, Debug, PartialEq, Zeroable)]
pub(crate) struct Tile {
    sums: Sums,
    /// Sum of squares of the luminance, for the noise estimate.
    squares: [f64; PIXELS],
    /// Samples so far, dropped ones included.
    samples: u32,
    /// Where samples are clamped.
    taken: Option<Box<Taken>>,
}

/// Adding and taking away 1.5 * 2^52 * q rounds to a multiple of q, ties to even.
const ROUND_COARSE: f64 = 1.5 * 4_503_599_627_370_496.0 / 1_048_576.0;
const ROUND_FINE: f64 = 1.5 * 4_503_599_627_370_496.0 / 1_125_899_906_842_624.0;
/// Larger samples than this are dropped as not finite: their coarse part would not be exact.
const LARGEST: f32 = 4_294_967_296.0;

/// Whether a sample can be summed; false for NaN too.
#[inline(always)]
fn counts(sample: [f32; 3]) -> bool {
    sample.iter().all(|&x| x.abs() <= LARGEST)
}

/// The two parts of a sample.
#[inline(always)]
fn parts(x: f32) -> (f64, f64) {
    let x = f64::from(x);
    let coarse = (x + ROUND_COARSE) - ROUND_COARSE;
    let fine = ((x - coarse) + ROUND_FINE) - ROUND_FINE;
    (coarse, fine)
}

/// Luminance of linear sRGB.
pub(crate) fn luminance(rgb: [f64; 3]) -> f64 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

impl Tile {
    /// Makes room for what clamping takes.
    fn keep_taken(&mut self) {
        self.taken = Some(Box::new(Taken::zeroed()));
    }

    /// Scales those samples of an item whose largest channel is above the limit down to it, and keeps what that takes; samples and pixels
    /// are those of [`Tile::add`], which comes after. Parts are subtracted from parts, so that what is taken and what is left sum to
    /// what there was, exactly. Samples that will be dropped stay as they are.
    pub(crate) fn clamp(&mut self, limit: f32, mut samples: [&mut [f32]; 3], pixels: &[u8; 64]) {
        let Some(taken) = &mut self.taken else { return };
        for (k, &pixel) in pixels.iter().enumerate() {
            let sample = samples.each_ref().map(|channel| channel[k]);
            let largest = sample[0].max(sample[1]).max(sample[2]);
            if largest <= limit || !counts(sample) {
                continue;
            }
            let pixel = usize::from(pixel);
            taken.samples[pixel] += 1;
            for (c, channel) in samples.iter_mut().enumerate() {
                // The product is exact, so that the largest channel becomes the limit itself.
                let after = (f64::from(sample[c]) * f64::from(limit) / f64::from(largest)) as f32;
                let (before, left) = (parts(sample[c]), parts(after));
                taken.sums.coarse[c][pixel] += before.0 - left.0;
                taken.sums.fine[c][pixel] += before.1 - left.1;
                channel[k] = after;
            }
        }
    }

    /// Adds one sample of each pixel of an item, the k-th being of pixel `pixels[k]`; gives the number of pixels whose sample was
    /// dropped. A sample may be negative: what pixels share is weighed so (`engine::stages::share`).
    pub(crate) fn add(&mut self, [red, green, blue]: [&[f32]; 3], pixels: &[u8; 64]) -> u64 {
        let mut dropped = 0;
        for (&pixel, ((&r, &g), &b)) in pixels.iter().zip(red.iter().zip(green).zip(blue)) {
            let pixel = usize::from(pixel);
            let sample = [r, g, b];
            if !counts(sample) {
                dropped += 1;
                continue;
            }
            for ((x, coarse_sums), fine_sums) in sample.iter().zip(&mut self.sums.coarse).zip(&mut self.sums.fine) {
                let (coarse, fine) = parts(*x);
                coarse_sums[pixel] += coarse;
                fine_sums[pixel] += fine;
            }
            let y = luminance(sample.map(f64::from));
            self.squares[pixel] += y * y;
        }
        dropped
    }

    /// Bytes of memory that a tile takes.
    fn bytes(clamped: bool) -> usize {
        size_of::<Tile>() + if clamped { size_of::<Taken>() } else { 0 }
    }

    /// Says that all pixels have been given `samples` more.
    pub(crate) fn count(&mut self, samples: u32) {
        self.samples += samples;
    }
}

/// What clamping took from a picture ([`crate::RenderOptions::clamp`]); the same for any number of threads and lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clamped {
    /// The limit.
    pub limit: f32,
    /// Samples of the film's pixels that were scaled down.
    pub samples: u64,
    /// Radiance that was taken, mean over the film's pixels, linear RGB.
    pub radiance: [f64; 3],
    /// Its luminance relative to the mean luminance without clamping; zero where that is black.
    pub share: f64,
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
    /// What the switches cost.
    pub costs: Costs,
    /// Pixels shared what they found.
    pub reuse: bool,
    /// Photons told where rays were aimed.
    pub caustics: bool,
    /// The most that the largest channel of a sample counts, where samples are clamped: the picture is then too dark where they were.
    pub clamp: Option<f32>,
    /// Lane type that was used.
    pub level: Level,
    /// Threads that were used.
    pub threads: usize,
}

impl Film {
    pub(crate) fn new(size: [u32; 2], crop: Crop, seed: u32, clamp: Option<f32>) -> Self {
        let first_tile = [crop.x / TILE, crop.y / TILE];
        let end = [(crop.x + crop.width).div_ceil(TILE), (crop.y + crop.height).div_ceil(TILE)];
        let tile_columns = end[0].saturating_sub(first_tile[0]);
        let count = tile_columns as usize * end[1].saturating_sub(first_tile[1]) as usize;
        // Memory that nothing has been written to: the threads that add to it first have it brought in, not this one.
        let mut tiles: Vec<Tile> = zeroed_vec(count);
        if clamp.is_some() {
            tiles.iter_mut().for_each(Tile::keep_taken);
        }
        Film {
            size,
            crop,
            seed,
            first_tile,
            tile_columns,
            tiles,
            counters: Counters::default(),
            statistics: None,
            costs: Costs::default(),
            reuse: false,
            caustics: false,
            clamp,
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
        self.tiles.len() * Tile::bytes(self.clamp.is_some())
    }

    /// Bytes of memory that the sums of a picture, or part of one, will take, its samples clamped or not.
    pub fn bytes_of(crop: Crop, clamped: bool) -> u64 {
        let tiles = |first: u32, length: u32| u64::from((first + length).div_ceil(TILE) - first / TILE);
        tiles(crop.x, crop.width) * tiles(crop.y, crop.height) * Tile::bytes(clamped) as u64
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
    #[inline]
    pub fn radiance(&self, x: u32, y: u32) -> [f64; 3] {
        let (tile, pixel) = self.place(x, y);
        tile.sums.mean(pixel, tile.samples)
    }

    /// Mean radiance that clamping took from a pixel: with [`Film::radiance`] it sums to what the pixel has without clamping, but for the
    /// rounding of that sum. Black where nothing was taken.
    pub fn taken(&self, x: u32, y: u32) -> [f64; 3] {
        let (tile, pixel) = self.place(x, y);
        tile.taken.as_ref().map_or([0.0; 3], |taken| taken.sums.mean(pixel, tile.samples))
    }

    /// What clamping took in all; `None` where samples are not clamped.
    pub fn clamped(&self) -> Option<Clamped> {
        let limit = self.clamp?;
        let (mut samples, mut taken, mut left) = (0, [0.0; 3], [0.0; 3]);
        for (x, y) in self.pixels() {
            let (tile, pixel) = self.place(x, y);
            samples += tile.taken.as_ref().map_or(0, |taken| u64::from(taken.samples[pixel]));
            for (sum, x) in taken.iter_mut().zip(self.taken(x, y)) {
                *sum += x;
            }
            for (sum, x) in left.iter_mut().zip(self.radiance(x, y)) {
                *sum += x;
            }
        }
        let whole = luminance(taken) + luminance(left);
        let share = if whole > 0.0 { luminance(taken) / whole } else { 0.0 };
        let count = f64::from(self.crop.width) * f64::from(self.crop.height);
        Some(Clamped { limit, samples, radiance: taken.map(|x| x / count.max(1.0)), share })
    }

    /// The pixels that this film holds, row by row.
    fn pixels(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let Crop { x, y, width, height } = self.crop;
        (y..y + height).flat_map(move |py| (x..x + width).map(move |px| (px, py)))
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
        let (mut variance, mut mean) = (0.0, 0.0);
        for (x, y) in self.pixels() {
            variance += self.variance(x, y);
            mean += luminance(self.radiance(x, y));
        }
        let n = f64::from(self.crop.width) * f64::from(self.crop.height);
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

    fn slices(samples: &[Vec<f32>; 3]) -> [&[f32]; 3] {
        samples.each_ref().map(Vec::as_slice)
    }

    /// Sample k is pixel k's.
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
        samples.iter().for_each(|s| assert_eq!(forwards.add(slices(s), &first_pixels()), 0));
        samples.iter().rev().for_each(|s| assert_eq!(backwards.add(slices(s), &first_pixels()), 0));
        assert_eq!(forwards.sums, backwards.sums);
    }

    #[test]
    fn a_film_takes_the_bytes_that_were_foretold() {
        for crop in
            [Crop::whole([17, 8]), Crop { x: 7, y: 3, width: 2, height: 6 }, Crop { x: 16, y: 8, width: 16, height: 1 }]
        {
            for clamp in [None, Some(1.0)] {
                let film = Film::new([40, 40], crop, 0, clamp);
                assert_eq!(film.bytes() as u64, Film::bytes_of(crop, clamp.is_some()));
            }
        }
    }

    #[test]
    fn wrong_samples_are_dropped_and_counted() {
        let mut tile = Tile::zeroed();
        let samples = filled(|k| [1.0, f32::NAN, -1.0, f32::INFINITY][k % 4]);
        assert_eq!(tile.add(slices(&samples), &first_pixels()), 32);
        assert_eq!([0, 1, 2, 3].map(|k: usize| tile.sums.coarse[0][k]), [1.0, 0.0, -1.0, 0.0]);
    }

    /// Samples of all signs and sizes, some of them far above the limit: per pixel and channel, what is taken and what is left sum to
    /// what there was to the last bit of both parts; nothing is above the limit, and the rest is as it was.
    #[test]
    fn what_is_taken_and_what_is_left_are_the_whole() {
        const LIMIT: f32 = 0.7;
        let sample = |k: u32, channel: u32| {
            filled(|pixel| {
                let h = crate::sampling::sampler::hash3(k, pixel as u32, channel);
                let sign = if h >> 62 == 0 { -1.0 } else { 1.0 };
                // From 2^-31 to 2^23: 200 of them stay below 2^32.
                f32::from_bits(0x3000_0000 + h as u32 % 0x1b00_0000) * sign
            })[0]
                .clone()
        };
        let (mut whole, mut clamped) = (Tile::zeroed(), Tile::zeroed());
        clamped.keep_taken();
        for k in 0..200 {
            let before = [0, 1, 2].map(|channel| sample(k, channel));
            let mut after = before.clone();
            whole.add(slices(&before), &first_pixels());
            clamped.clamp(LIMIT, after.each_mut().map(Vec::as_mut_slice), &first_pixels());
            clamped.add(slices(&after), &first_pixels());
            for slot in 0..64 {
                let [before, after] = [&before, &after].map(|s| s.each_ref().map(|channel| channel[slot]));
                let largest = before.iter().fold(f32::MIN, |a, &b| a.max(b));
                if largest <= LIMIT {
                    assert_eq!(after, before);
                    continue;
                }
                for c in 0..3 {
                    assert_eq!(after[c] == LIMIT, before[c] == largest, "{before:?} {after:?}");
                    // The quotient is rounded twice, to f64 and to f32; below 2^-126 f32 is coarser.
                    let exact = f64::from(before[c]) * f64::from(LIMIT) / f64::from(largest);
                    assert!((f64::from(after[c]) - exact).abs() <= exact.abs() * 1.2e-7 + 1e-45);
                }
            }
        }
        let taken = clamped.taken.as_ref().expect("it was clamped");
        assert!(taken.samples[..64].iter().all(|&n| (50..200).contains(&n)), "{:?}", &taken.samples[..64]);
        for c in 0..3 {
            for pixel in 0..64 {
                let sum = |of: &Sums| (of.coarse[c][pixel], of.fine[c][pixel]);
                let (left, took, all) = (sum(&clamped.sums), sum(&taken.sums), sum(&whole.sums));
                assert_eq!((left.0 + took.0, left.1 + took.1), all, "channel {c}, pixel {pixel}");
            }
        }
    }

    #[test]
    fn what_is_not_finite_is_dropped_and_not_clamped() {
        let mut tile = Tile::zeroed();
        tile.keep_taken();
        let mut samples = filled(|k| [9.0, f32::NAN, -9.0, f32::INFINITY][k % 4]);
        tile.clamp(3.0, samples.each_mut().map(Vec::as_mut_slice), &first_pixels());
        assert_eq!(tile.add(slices(&samples), &first_pixels()), 32);
        assert_eq!([0, 1, 2, 3].map(|k: usize| tile.sums.coarse[0][k]), [3.0, 0.0, -9.0, 0.0]);
        let taken = tile.taken.expect("it was clamped");
        assert_eq!(
            [0, 1, 2, 3].map(|k: usize| (taken.samples[k], taken.sums.coarse[0][k])),
            [(1, 6.0), (0, 0.0), (0, 0.0), (0, 0.0)]
        );
    }
}
