//! The film: per pixel, exact sums of radiance over its samples.
//!
//! Sums do not depend on their order, so threads, resumed renderings and parts of a picture rendered elsewhere give the
//! same bytes: they are whole numbers in a window that goes by the scene's brightest light ([`exact`]). All that is
//! read is in the scene's own units.

mod adaptive;
mod cells;
mod exact;
mod file;
mod groups;
mod halves;
mod head;
mod layers;
mod mattes;
mod merge;
mod missed;
mod noise;
mod pack;
mod part;
mod plan;
mod record;
mod state;

pub(crate) use adaptive::{Adaptive, FROM, MOST, run_end};
pub(crate) use cells::Cells;
pub use file::{FilmError, Note, PROGRAM, SavedFilm};
use groups::TileGroups;
pub(crate) use groups::{FilmGroups, Samples};
use halves::TileHalf;
pub(crate) use halves::half_end;
pub use head::FilmHead;
pub use layers::LayerImage;
use layers::{FilmLayer, TileLayers};
use mattes::TileMattes;
pub use mattes::{MatteOf, MattesKept};
pub use merge::{Gap, Gaps, MergeError, faults};
pub use noise::FewNoisy;
use noise::Octave;
pub use part::{Part, Split};
pub use plan::{NoPlan, Plan};
pub use state::FilmState;
pub(crate) use state::Keeper;
use tracer_kernels::sampling::blocks::TILE;

use bytemuck::Zeroable;
use bytemuck::allocation::try_zeroed_vec;
use exact::{LARGEST, Squares, Sums, fixed};
use scene_format::Diagnostics;
use std::alloc::{Layout, handle_alloc_error};
use std::ops::{Range, RangeInclusive};
use std::sync::Arc;
use tracer_kernels::layers::{Kept, Layer, LayerSet};
use tracer_kernels::level::Level;
use tracer_kernels::report::{Costs, Counters, Statistics};
use tracer_kernels::sampling::blocks::QUARTERS;

/// Pixels of a tile.
const PIXELS: usize = (TILE * TILE) as usize;

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

/// What clamping took from the pixels of a tile.
#[derive(Clone, Debug, PartialEq, Zeroable)]
struct Taken {
    sums: Sums,
    /// Samples that were scaled down.
    samples: [u32; PIXELS],
}

/// What light paths brought to the pixels of a tile.
#[derive(Clone, Debug, PartialEq, Zeroable)]
struct Splats {
    sums: Sums,
    /// Sum of squares of the luminance; where the background is kept by itself, of what is before it and of the paper.
    squares: Squares,
}

/// The sums of a tile of 16x16 pixels; pixels in Z-order.
#[derive(Clone, Debug, PartialEq, Zeroable)]
pub(crate) struct Tile {
    sums: Sums,
    /// Sum of squares of the luminance, for the noise estimate.
    squares: Squares,
    /// Samples of each pixel so far, dropped ones included.
    samples: [u32; PIXELS],
    /// How much it rests ([`adaptive`]).
    rest: u32,
    /// Mean luminance of each pixel when the film had the samples of its last octave ([`noise`]).
    octave: [f32; PIXELS],
    /// Where samples are clamped.
    taken: Option<Box<Taken>>,
    /// Where light paths have fallen.
    splats: Option<Box<Splats>>,
    /// Where samples with layers have been added.
    layers: Option<Box<TileLayers>>,
    /// The second half of the samples, where halves are kept.
    half: Option<Box<TileHalf>>,
    /// Where the layer `alpha` is kept and something is seen behind everything: its radiance.
    missed: Option<Box<Sums>>,
    /// Where samples with mattes have been added.
    mattes: Option<Box<TileMattes>>,
    /// Where samples of light groups have been added.
    groups: Option<Box<TileGroups>>,
}

/// Whether a sample can be summed; false for NaN too.
#[inline(always)]
pub(crate) fn counts(sample: [f32; 3]) -> bool {
    sample.iter().all(|&x| x.abs() <= LARGEST)
}

/// Samples that a film could not add.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct LeftOut {
    /// Not finite.
    pub dropped: u64,
    /// Finite, but above [`LARGEST`].
    pub beyond: u64,
}

impl LeftOut {
    /// Counts a sample that cannot be summed.
    fn count(&mut self, sample: [f32; 3]) {
        let finite = sample.iter().all(|x| x.is_finite());
        self.beyond += u64::from(finite);
        self.dropped += u64::from(!finite);
    }
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

    /// Scales those samples of a block whose largest channel is above the limit down to it, and keeps what that takes;
    /// samples and pixels are those of [`Tile::add`], which comes after. Whole numbers are subtracted, so that what is
    /// taken and what is left sum to what there was, exactly. Samples that will be dropped stay as they are.
    pub(crate) fn clamp(&mut self, limit: f64, mut samples: [&mut [f32]; 3], pixels: &[[u8; 2]]) {
        let Some(taken) = &mut self.taken else { return };
        for &[k, pixel] in pixels {
            let (k, pixel) = (usize::from(k), usize::from(pixel));
            let sample = samples.each_ref().map(|channel| channel[k]);
            let largest = sample[0].max(sample[1]).max(sample[2]);
            if f64::from(largest) <= limit || !counts(sample) {
                continue;
            }
            taken.samples[pixel] += 1;
            let mut took = [0; 3];
            for (c, channel) in samples.iter_mut().enumerate() {
                // The product is exact, so that the largest channel becomes the limit itself.
                let after = (f64::from(sample[c]) * limit / f64::from(largest)) as f32;
                took[c] = fixed(sample[c]) - fixed(after);
                channel[k] = after;
            }
            taken.sums.add(pixel, took);
        }
    }

    /// Adds samples of a block, those numbered by the first of each of `pixels` to the pixels numbered by the second;
    /// gives how many samples were left out. A sample may be negative: what pixels share is weighed so
    /// (`engine::stages::share`).
    pub(crate) fn add(&mut self, [red, green, blue]: [&[f32]; 3], pixels: &[[u8; 2]]) -> LeftOut {
        let mut left_out = LeftOut::default();
        for &[k, pixel] in pixels {
            let (k, pixel) = (usize::from(k), usize::from(pixel));
            let (r, g, b) = (red[k], green[k], blue[k]);
            let sample = [r, g, b];
            self.samples[pixel] += 1;
            if !counts(sample) {
                left_out.count(sample);
                continue;
            }
            self.sums.add(pixel, [fixed(r), fixed(g), fixed(b)]);
            self.squares.add(pixel, luminance(sample.map(f64::from)));
        }
        left_out
    }

    /// Adds what a light path brings to a pixel, scaled down to the limit where samples are clamped; what that takes is
    /// kept as of samples. What is too large for a sum is left out.
    /// Gives what was added, in least units.
    pub(crate) fn splat(&mut self, pixel: usize, brings: [f32; 3], limit: Option<f64>) -> Option<[i128; 3]> {
        if !counts(brings) {
            return None;
        }
        let mut left = brings;
        let largest = f64::from(brings[0].max(brings[1]).max(brings[2]));
        if let (Some(taken), Some(limit)) = (&mut self.taken, limit.filter(|&limit| largest > limit)) {
            left = brings.map(|x| (f64::from(x) * limit / largest) as f32);
            taken.samples[pixel] += 1;
            taken.sums.add(pixel, [0, 1, 2].map(|c| fixed(brings[c]) - fixed(left[c])));
        }
        let splats = self.splats.get_or_insert_with(|| Box::new(Splats::zeroed()));
        let added = left.map(fixed);
        splats.sums.add(pixel, added);
        splats.squares.add(pixel, luminance(left.map(f64::from)));
        Some(added)
    }

    /// Bytes of memory that a tile takes.
    fn bytes(clamped: bool, light_paths: bool, kept: Kept, half: usize, missed: bool) -> usize {
        let of = |there: bool, size: usize| if there { size } else { 0 };
        let optional = of(clamped, size_of::<Taken>()) + of(light_paths, size_of::<Splats>());
        size_of::<Tile>() + optional + TileLayers::bytes(kept) + half + of(missed, size_of::<Sums>())
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

/// Work that is left of a pass that was ended early: places, as whoever renders numbers them, and the sample indices
/// that they lack.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Piece {
    pub places: Range<u32>,
    pub samples: Range<u32>,
}

/// What is left of a pass that was ended early.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Unfinished {
    /// The sample index that the pass ends before.
    pub end: u32,
    /// None where only light paths are left.
    pub pieces: Vec<Piece>,
}

/// What [`crate::render`] makes.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    size: [u32; 2],
    crop: Crop,
    /// Where the film is one.
    part: Option<Part>,
    /// Made of parts, of which some are missing.
    has_gaps: bool,
    /// How many moments the pixels of a sample index see ([`crate::Scene::moments_of_sample`]).
    pub(crate) moments: u32,
    seed: u32,
    /// What a radiance of one in the sums stands for; a power of two.
    unit: f64,
    layers: Vec<FilmLayer>,
    /// Whether the second half of the samples is summed by itself, too.
    halves: bool,
    /// Whether what is seen behind everything is summed by itself, too.
    backdrop: bool,
    /// Luminance of what the picture is laid over then, in the sums' own unit: the noise is that of the whole.
    pub(crate) paper: f64,
    /// What is counted for mattes.
    mattes: MattesKept,
    /// The light groups that are summed by themselves, too.
    groups: FilmGroups,
    first_tile: [u32; 2],
    tile_columns: u32,
    tiles: Vec<Tile>,
    /// The sample index that all pixels lack next; of a part all indices before its first count as had.
    pub(crate) whole: u32,
    /// Beyond these, what a pass that was ended early has left to do.
    pub(crate) unfinished: Option<Unfinished>,
    /// Which tiles rest, where that was decided.
    adaptive: Option<Arc<Adaptive>>,
    /// The sample index whose light paths are not on the film yet, counted as [`Film::whole`].
    pub(crate) light_samples: u32,
    /// What the noise is told by.
    octave: Octave,
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
    /// The most that the largest channel of a sample counts, where samples are clamped: the picture is then too dark
    /// where they were.
    pub clamp: Option<f32>,
    /// Why it was ended early: what is wrong with the scene at the moment of the next sample index, where something
    /// moves while the shutter is open ([`crate::Scene::at_sample`]).
    pub fault: Option<Diagnostics>,
    /// Lane type that was used.
    pub level: Level,
    /// Threads that were used.
    pub threads: usize,
}

impl Film {
    pub(crate) fn new(size: [u32; 2], crop: Crop, seed: u32, unit: f64, clamp: Option<f32>) -> Self {
        let first_tile = [crop.x / TILE, crop.y / TILE];
        let end = [(crop.x + crop.width).div_ceil(TILE), (crop.y + crop.height).div_ceil(TILE)];
        let tile_columns = end[0].saturating_sub(first_tile[0]);
        let count = tile_columns as usize * end[1].saturating_sub(first_tile[1]) as usize;
        // Memory that nothing has been written to: the threads that add to it first have it brought in, not this one.
        // What is not to be had ends the program as any other block would; who can ask before does (`Film::bytes_of`).
        let none = |()| handle_alloc_error(Layout::array::<Tile>(count).unwrap_or(Layout::new::<Tile>()));
        let mut tiles: Vec<Tile> = try_zeroed_vec(count).unwrap_or_else(none);
        if clamp.is_some() {
            tiles.iter_mut().for_each(Tile::keep_taken);
        }
        Film {
            size,
            crop,
            part: None,
            has_gaps: false,
            moments: 0,
            seed,
            unit,
            layers: Vec::new(),
            halves: false,
            backdrop: false,
            paper: 0.0,
            mattes: MattesKept::default(),
            groups: FilmGroups::default(),
            first_tile,
            tile_columns,
            tiles,
            whole: 0,
            unfinished: None,
            adaptive: None,
            light_samples: 0,
            octave: Octave::default(),
            counters: Counters::default(),
            statistics: None,
            costs: Costs::default(),
            reuse: false,
            caustics: false,
            clamp,
            fault: None,
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

    /// Whether there is anything on it, or was left out.
    pub(crate) fn is_begun(&self) -> bool {
        self.whole > self.first() || self.unfinished.is_some()
    }

    /// Makes it a part, before anything is added to it.
    pub(crate) fn keep_part(&mut self, part: Option<Part>) {
        self.part = part;
        self.whole = self.first();
        self.light_samples = self.first();
    }

    /// The part that it is of its rendering; `None` where it is all of it.
    pub fn part(&self) -> Option<Part> {
        self.part
    }

    /// Whether samples were missing where it was merged ([`Film::merge`]).
    pub fn has_gaps(&self) -> bool {
        self.has_gaps
    }

    /// Its first sample index.
    pub(crate) fn first(&self) -> u32 {
        self.part.map_or(0, |part| part.first)
    }

    /// How many sample indices' light paths are on it.
    fn light_count(&self) -> f64 {
        let whole = f64::from(self.light_samples.saturating_sub(self.first()));
        if self.unfinished.is_none() { whole } else { whole + self.light_of_quarters() }
    }

    /// What part of the light paths of a sample index that was ended early is on it: where something moves, those of a
    /// quarter come before its samples.
    fn light_of_quarters(&self) -> f64 {
        let pieces = self.unfinished.as_ref().filter(|_| self.moments == QUARTERS).map_or(&[][..], |rest| &rest.pieces);
        let Some(rest) = pieces.first() else { return 0.0 };
        let begun = (u64::from(rest.places.start) * u64::from(QUARTERS)).div_ceil(u64::from(rest.places.end).max(1));
        begun as f64 / f64::from(QUARTERS)
    }

    /// Whether sums of the two stand for the same radiance.
    pub(crate) fn has_unit_of(&self, other: &Film) -> bool {
        self.unit == other.unit
    }

    /// Samples of all pixels together.
    pub fn camera_samples(&self) -> u64 {
        self.tiles.iter().flat_map(|tile| tile.samples).map(u64::from).sum()
    }

    /// Samples of the pixels that have fewest and of those that have most: different only when a rendering was ended
    /// early. Where quiet tiles take fewer ([`Film::is_adaptive`]), of those that take all.
    pub fn samples(&self) -> RangeInclusive<u32> {
        let takes_all = |&(x, y): &(u32, u32)| self.place(x, y).0.rest == 0;
        let of_all = self.samples_among(self.pixels().filter(takes_all));
        let until = self.whole.saturating_sub(self.first());
        of_all.unwrap_or(if self.is_adaptive() { until..=until } else { 0..=0 })
    }

    /// Fewest and most samples of a pixel, those of quiet tiles among them.
    pub fn samples_of_pixels(&self) -> RangeInclusive<u32> {
        self.samples_among(self.pixels()).unwrap_or(0..=0)
    }

    fn samples_among(&self, pixels: impl Iterator<Item = (u32, u32)> + Clone) -> Option<RangeInclusive<u32>> {
        let counts = pixels.map(|(x, y)| {
            let (tile, pixel) = self.place(x, y);
            tile.samples[pixel]
        });
        Some(counts.clone().min()?..=counts.max()?)
    }

    /// Bytes of memory that the sums take.
    pub fn bytes(&self) -> usize {
        let kept = self.layers().kept();
        let of_layers = |tile: &Tile| if tile.layers.is_some() { kept } else { Kept::default() };
        let of_tile = |tile: &Tile| {
            let half = tile.half.as_ref().map_or(0, |half| half.bytes());
            let [taken, splats, missed] = [tile.taken.is_some(), tile.splats.is_some(), tile.missed.is_some()];
            let mattes = tile.mattes.as_ref().map_or(0, |mattes| mattes.bytes());
            let groups = tile.groups.as_ref().map_or(0, |groups| groups.bytes());
            Tile::bytes(taken, splats, of_layers(tile), half, missed) + mattes + groups
        };
        self.tiles.iter().map(of_tile).sum()
    }

    /// Bytes of memory that the sums of a picture, or part of one, will take, its samples clamped or not, where light
    /// paths fall everywhere or nowhere, with these layers, with halves or not.
    pub fn bytes_of(crop: Crop, clamped: bool, light_paths: bool, layers: LayerSet, halves: bool) -> u64 {
        let tiles = |first: u32, length: u32| u64::from((first + length).div_ceil(TILE) - first / TILE);
        let half = if halves { TileHalf::most_bytes(light_paths) } else { 0 };
        let alpha = layers.iter().any(|layer| layer == Layer::Alpha);
        let of_tile = Tile::bytes(clamped, light_paths, layers.kept(), half, alpha);
        tiles(crop.x, crop.width) * tiles(crop.y, crop.height) * of_tile as u64
    }

    /// Tile and place in it of a pixel of the crop.
    fn place(&self, x: u32, y: u32) -> (&Tile, usize) {
        let column = x / TILE - self.first_tile[0];
        let row = y / TILE - self.first_tile[1];
        let z = tracer_kernels::sampling::sampler::z_order(x % TILE, y % TILE);
        (&self.tiles[(row * self.tile_columns + column) as usize], z as usize)
    }

    /// Mean radiance of a pixel, linear RGB; (x, y) in the whole picture, within the crop. Black where there is no
    /// sample yet.
    #[inline]
    pub fn radiance(&self, x: u32, y: u32) -> [f64; 3] {
        let (tile, pixel) = self.place(x, y);
        self.mean(tile, (&tile.sums, tile.splats.as_ref().map(|splats| &splats.sums)), pixel)
    }

    /// Mean radiance of a pixel of a tile, over what its samples and what light paths have brought.
    #[inline(always)]
    fn mean(&self, tile: &Tile, (sums, splats): (&Sums, Option<&Sums>), pixel: usize) -> [f64; 3] {
        let samples = tile.samples[pixel];
        let [r, g, b] = match splats {
            None => sums.mean(pixel, samples),
            // As always but where a rendering was ended early; half the work.
            Some(splats) if self.unfinished.is_none() && f64::from(samples) == self.light_of(tile) => {
                sums.mean_with(splats, pixel, samples)
            }
            Some(splats) => {
                let (of_paths, of_light) = (sums.mean(pixel, samples), splats.mean(pixel, self.light_of(tile)));
                [of_paths[0] + of_light[0], of_paths[1] + of_light[1], of_paths[2] + of_light[2]]
            }
        };
        [r * self.unit, g * self.unit, b * self.unit]
    }

    /// What of [`Film::radiance`] light paths brought.
    pub(crate) fn of_light_paths(&self, x: u32, y: u32) -> [f64; 3] {
        let (tile, pixel) = self.place(x, y);
        let count = self.light_of(tile);
        tile.splats.as_ref().map_or([0.0; 3], |splats| splats.sums.mean(pixel, count).map(|x| x * self.unit))
    }

    /// Mean radiance that clamping took from a pixel: with [`Film::radiance`] it sums to what the pixel has without
    /// clamping, but for the rounding of that sum. Black where nothing was taken.
    pub fn taken(&self, x: u32, y: u32) -> [f64; 3] {
        let (tile, pixel) = self.place(x, y);
        tile.taken.as_ref().map_or([0.0; 3], |taken| taken.sums.mean(pixel, tile.samples[pixel]).map(|x| x * self.unit))
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
    pub(crate) fn pixels(&self) -> impl Iterator<Item = (u32, u32)> + Clone + use<> {
        let Crop { x, y, width, height } = self.crop;
        (y..y + height).flat_map(move |py| (x..x + width).map(move |px| (px, py)))
    }
}

#[cfg(test)]
mod tests;
