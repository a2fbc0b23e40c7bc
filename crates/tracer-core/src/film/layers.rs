//! The layers of a film: sums per pixel beside the radiance, in the same whole numbers, so that neither order nor
//! threads can show.

use super::exact::{LARGEST, LEAST, fixed};
use super::pack::{pack, unpack};
use super::{Crop, Film, PIXELS, Tile};
use rayon::prelude::*;
use std::ops::Range;
use tracer_kernels::layers::Layer;
use tracer_kernels::layers::{FilmNumber, Kept, LayerSamples, LayerSet, Pixel, Units, definition, units};
use tracer_kernels::sampling::blocks::ITEM_PIXELS;
use tracer_kernels::scene::Scene;

/// What a tile holds for its layers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TileLayers {
    /// Samples of each pixel that hit something.
    hits: [u32; PIXELS],
    /// Per channel of those that are means, one layer after the other: the sum over the samples.
    sums: Vec<[i128; PIXELS]>,
    /// Per layer of the others: the [`candidate`] that won; zero before any sample.
    nearest: Vec<[u64; PIXELS]>,
}

/// A sample's number as that of its pixel: the largest of all is the nearest sample's, and of equally near ones the one
/// with the smallest number, whoever comes first.
#[inline(always)]
fn candidate(distance2: f32, number: u32) -> u64 {
    // What is not negative is ordered as its bits are.
    u64::from(!distance2.to_bits()) << 32 | u64::from(!number)
}

/// The number of a candidate; zero before any.
fn number_of(candidate: u64) -> u32 {
    if candidate == 0 { 0 } else { !(candidate as u32) }
}

/// A layer of a film, and what its sums stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FilmLayer {
    pub layer: Layer,
    pub units: Units,
}

impl FilmLayer {
    /// As the head of a saved film has it.
    pub fn saved(self) -> SavedLayer {
        let Units { scale, offset } = self.units;
        SavedLayer { name: definition(self.layer).name.to_owned(), units: [scale, offset[0], offset[1], offset[2]] }
    }
}

/// A layer in the head of a saved film: by its name, since a film of another version of the program may have others.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SavedLayer {
    pub name: String,
    pub units: [f64; 4],
}

impl SavedLayer {
    /// The layer; `None` where this program has none of that name.
    pub fn layer(&self) -> Option<FilmLayer> {
        let [scale, x, y, z] = self.units;
        LayerSet::by_name(&self.name).map(|layer| FilmLayer { layer, units: Units { scale, offset: [x, y, z] } })
    }
}

/// A layer's pixels, row by row from the top. What is in them, [`Layer`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerImage {
    /// Its name in files: `normal`.
    pub name: &'static str,
    /// Its channels: `X`, `Y`, `Z`.
    pub channels: &'static [&'static str],
    /// A number for each channel of each pixel.
    pub values: Vec<f32>,
}

impl TileLayers {
    fn new(kept: Kept) -> Self {
        let (sums, nearest) = (vec![[0; PIXELS]; kept.sums], vec![[0; PIXELS]; kept.nearest]);
        TileLayers { hits: [0; PIXELS], sums, nearest }
    }

    /// How many samples of a pixel have hit something.
    pub fn hits_of(&self, pixel: usize) -> u32 {
        self.hits[pixel]
    }

    /// The sum of a channel, by its place among all of them.
    pub fn sum_of(&self, channel: usize, pixel: usize) -> i128 {
        self.sums[channel][pixel]
    }

    /// Appends it to a tile's record.
    pub fn record(&self, out: &mut Vec<u8>) {
        pack(|k| self.hits[k].into(), out);
        self.sums.iter().for_each(|sums| pack(|k| sums[k], out));
        self.nearest.iter().for_each(|nearest| pack(|k| nearest[k].into(), out));
    }

    /// Reads it from one; no pixel has more samples than so many.
    pub fn read(from: &mut &[u8], most: u32, kept: Kept) -> Option<Self> {
        let mut layers = TileLayers::new(kept);
        let mut fits = true;
        unpack(from, |k, count| match u32::try_from(count) {
            Ok(count) if count <= most => layers.hits[k] = count,
            _ => fits = false,
        })?;
        layers.sums.iter_mut().try_for_each(|sums| unpack(from, |k, sum| sums[k] = sum))?;
        layers.nearest.iter_mut().try_for_each(|nearest| {
            unpack(from, |k, best| match u64::try_from(best) {
                Ok(best) => nearest[k] = best,
                Err(_) => fits = false,
            })
        })?;
        fits.then_some(layers)
    }

    /// Adds what another has of the same pixels.
    pub fn merge(&mut self, other: &TileLayers) {
        super::merge::add_counts(&mut self.hits, &other.hits);
        for (sums, from) in self.sums.iter_mut().zip(&other.sums) {
            sums.iter_mut().zip(from).for_each(|(sum, from)| *sum = sum.wrapping_add(*from));
        }
        for (nearest, from) in self.nearest.iter_mut().zip(&other.nearest) {
            nearest.iter_mut().zip(from).for_each(|(best, from)| *best = (*best).max(*from));
        }
    }

    /// Bytes of memory that a tile takes.
    pub fn bytes(kept: Kept) -> usize {
        let (sums, nearest) = (kept.sums * size_of::<[i128; PIXELS]>(), kept.nearest * size_of::<[u64; PIXELS]>());
        if sums + nearest == 0 { 0 } else { size_of::<TileLayers>() + sums + nearest }
    }
}

/// Whether the camera ray of a slot has hit something.
#[inline(always)]
pub(crate) fn is_hit(samples: &LayerSamples, slot: usize) -> bool {
    samples.hits[slot / ITEM_PIXELS] >> (slot % ITEM_PIXELS) & 1 != 0
}

impl Tile {
    /// Adds what the camera rays of a block's slots hit first; `pixels` are those of [`Tile::add`].
    #[inline]
    pub(crate) fn add_layers(&mut self, samples: &LayerSamples, slots: &Range<usize>, pixels: &[[u8; 2]]) {
        if samples.sums.is_empty() && samples.nearest.is_empty() {
            return;
        }
        let layers = self.layers.get_or_insert_with(|| Box::new(TileLayers::new(samples.kept())));
        let pixels = || pixels.iter().map(|&[k, pixel]| (usize::from(k), usize::from(pixel)));
        for (k, pixel) in pixels() {
            layers.hits[pixel] += u32::from(is_hit(samples, slots.start + k));
        }
        for (sums, column) in layers.sums.iter_mut().zip(&samples.sums) {
            let column = &column[slots.clone()];
            pixels().for_each(|(k, pixel)| sums[pixel] = sums[pixel].wrapping_add(fixed(within(column[k]))));
        }
        for (nearest, column) in layers.nearest.iter_mut().zip(&samples.nearest) {
            let (column, distance2) = (&column[slots.clone()], &samples.distance2[slots.clone()]);
            pixels().for_each(|(k, pixel)| nearest[pixel] = nearest[pixel].max(candidate(distance2[k], column[k])));
        }
    }
}

/// What can be summed: 6.7e7 times the scene's size or its brightest light at most, which is as good as infinite for a
/// layer. No layer makes a NaN of a hit; were there one, it would count as zero.
#[inline(always)]
pub(super) fn within(x: f32) -> f32 {
    if x.is_nan() { 0.0 } else { x.clamp(-LARGEST, LARGEST) }
}

impl Film {
    /// Makes room for layers of a scene; before anything is added.
    pub(crate) fn keep_layers(&mut self, layers: LayerSet, scene: &Scene) {
        self.layers = layers.iter().map(|layer| FilmLayer { layer, units: units(layer, scene) }).collect();
    }

    /// Whether the layers of both are the same, and stand for the same.
    pub(crate) fn has_layers_of(&self, other: &Film) -> bool {
        self.layers == other.layers
    }

    /// The layers that it holds.
    pub fn layers(&self) -> LayerSet {
        self.layers.iter().map(|of| of.layer).collect()
    }

    /// What a pixel has of a layer, its first channel; zero where the film has no such layer. On the thread that asks.
    pub(crate) fn number(&self, layer: Layer, x: u32, y: u32) -> f32 {
        let Some(of) = self.layers.iter().find(|of| of.layer == layer) else { return 0.0 };
        let before = self.layers().iter().take_while(|&other| other != layer).collect::<LayerSet>().kept();
        let mut pixel = [0.0; 3];
        self.layer_of_pixel(x, y, of, before, &mut pixel[..definition(layer).channels.len()]);
        pixel[0]
    }

    /// The pixels of a layer, those that [`Film::crop`] holds; `None` where the film has no such layer.
    ///
    /// # Examples
    ///
    /// ```
    /// use tracer_kernels::layers::Layer;
    /// use std::path::Path;
    /// use tracer_core::{LayerSet, RenderOptions, Unobserved, compile, render};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let text = "Scene(image: Image(width: 9, height: 9), background: 1, \
    ///             objects: [Sphere(center: (0, 0, 0), radius: 1)])";
    /// let loaded = scene_format::load_str("ball.ron", text, scene_format::Syntax::Ron, Path::new("."), &[])?;
    /// let scene = compile(&loaded.scene)?;
    /// let layers = LayerSet::from_iter([Layer::Depth, Layer::Normal]);
    /// let options = RenderOptions { layers: Some(layers), samples: Some(64), ..RenderOptions::default() };
    /// let film = render(&scene, &options, &Unobserved);
    ///
    /// let depth = film.layer(Layer::Depth).ok_or("the film has it")?;
    /// assert_eq!((depth.name, depth.channels), ("depth", &["Z"][..]));
    /// assert!((depth.values[4 * 9 + 4] - 4.0).abs() < 0.1, "the ball is 4 before the camera");
    /// assert_eq!(depth.values[0], f32::INFINITY);
    /// let normal = film.layer(Layer::Normal).ok_or("the film has it")?;
    /// assert!(normal.values[3 * (4 * 9 + 4) + 2] > 0.9, "it faces the camera");
    /// assert!(film.layer(Layer::Albedo).is_none());
    /// # Ok(())
    /// # }
    /// ```
    pub fn layer(&self, layer: Layer) -> Option<LayerImage> {
        let of = self.layers.iter().find(|of| of.layer == layer)?;
        // Those before it in the set come before it in the tiles.
        let before =
            self.layers.iter().map(|of| of.layer).take_while(|&other| other != layer).collect::<LayerSet>().kept();
        let definition = definition(layer);
        let Crop { x, y, width, height } = self.crop;
        let count = definition.channels.len();
        let mut values = vec![0.0; count * width as usize * height as usize];
        let rows = values.par_chunks_exact_mut((count * width as usize).max(1)).zip(y..y + height);
        rows.for_each(|(row, y)| {
            for (x, pixel) in (x..x + width).zip(row.chunks_exact_mut(count)) {
                self.layer_of_pixel(x, y, of, before, pixel);
            }
        });
        Some(LayerImage { name: definition.name, channels: definition.channels, values })
    }

    /// A pixel of a layer, before which so much is kept.
    fn layer_of_pixel(&self, x: u32, y: u32, of: &FilmLayer, before: Kept, pixel: &mut [f32]) {
        let (tile, k) = self.place(x, y);
        let layers = tile.layers.as_deref();
        let hits = layers.map_or(0, |layers| layers.hits[k]);
        let count = match definition(of.layer).pixel {
            Pixel::Mean | Pixel::Seen | Pixel::Counted(_) => tile.samples[k].max(1),
            Pixel::MeanOfHits(empty) if hits == 0 => return pixel.fill(empty),
            Pixel::MeanOfHits(_) => hits,
            Pixel::Nearest(_) => {
                return pixel.fill(layers.map_or(0, |layers| number_of(layers.nearest[before.nearest][k])) as f32);
            }
            Pixel::Direct => return self.direct_of_pixel(x, y, before.sums, pixel),
            Pixel::Indirect => return self.indirect_of_pixel(x, y, before.sums, pixel),
            Pixel::OfFilm(FilmNumber::Variance) => return pixel.fill(finite(self.variance(x, y))),
            Pixel::OfFilm(FilmNumber::Samples) => return pixel.fill(tile.samples[k] as f32),
            Pixel::OfFilm(FilmNumber::Noise) => return pixel.fill(finite(self.noise(x, y))),
        };
        for (c, value) in pixel.iter_mut().enumerate() {
            let sum = layers.map_or(0, |layers| layers.sums[before.sums + c][k]);
            let mean = sum as f64 * LEAST / f64::from(count);
            *value = finite(mean * of.units.scale + of.units.offset[c]);
        }
    }
}

impl Film {
    /// What has come over one surface at most, whose sums begin here; without the background that is kept by itself.
    fn direct_of_pixel(&self, x: u32, y: u32, first: usize, pixel: &mut [f32]) {
        let (tile, k) = self.place(x, y);
        let scale = self.unit * LEAST / f64::from(tile.samples[k].max(1));
        for (c, value) in pixel.iter_mut().enumerate() {
            let sum = tile.layers.as_ref().map_or(0, |layers| layers.sums[first + c][k]);
            let missed = tile.missed.as_ref().map_or(0, |missed| missed.of(c, k));
            *value = finite(sum.wrapping_sub(missed).max(0) as f64 * scale);
        }
    }

    /// What is left of the picture without that, whose sums begin here, and what light paths brought. Not below zero: a
    /// sample's direct light is rounded to single precision where there are light groups.
    fn indirect_of_pixel(&self, x: u32, y: u32, first: usize, pixel: &mut [f32]) {
        let (tile, k) = self.place(x, y);
        let scale = self.unit * LEAST / f64::from(tile.samples[k].max(1));
        let of_light_paths = self.of_light_paths(x, y);
        for (c, value) in pixel.iter_mut().enumerate() {
            let direct = tile.layers.as_ref().map_or(0, |layers| layers.sums[first + c][k]);
            let rest = tile.sums.of(c, k).wrapping_sub(direct).max(0);
            *value = finite(rest as f64 * scale + of_light_paths[c]);
        }
    }
}

/// In single precision; what is beyond its range is its largest number.
fn finite(x: f64) -> f32 {
    x.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}
