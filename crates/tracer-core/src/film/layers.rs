//! The layers of a film: sums per pixel beside the radiance, in the same whole numbers, so that neither order nor threads can show.

use super::exact::{LARGEST, LEAST, fixed};
use super::pack::{pack, unpack};
use super::{Crop, Film, PIXELS, Tile};
use crate::engine::LayerSamples;
use crate::engine::slots_of;
use crate::layers::{LayerSet, Pixel, Units, definition, units};
use crate::scene::Scene;
use rayon::prelude::*;
use scene_format::desc::Layer;

/// The sums of a tile's layers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TileLayers {
    /// Samples of each pixel that hit something.
    hits: [u32; PIXELS],
    /// Per channel of each layer, one layer after the other: the sum over the samples.
    sums: Vec<[i128; PIXELS]>,
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

/// Numbers that a pixel has of these layers.
pub(super) fn channels(layers: &[FilmLayer]) -> usize {
    layers.iter().map(|of| definition(of.layer).channels.len()).sum()
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
    fn new(channels: usize) -> Self {
        TileLayers { hits: [0; PIXELS], sums: vec![[0; PIXELS]; channels] }
    }

    /// Appends it to a tile's record.
    pub fn record(&self, out: &mut Vec<u8>) {
        pack(|k| self.hits[k].into(), out);
        self.sums.iter().for_each(|sums| pack(|k| sums[k], out));
    }

    /// Reads it from one; no pixel has more samples than so many.
    pub fn read(from: &mut &[u8], most: u32, channels: usize) -> Option<Self> {
        let mut layers = TileLayers::new(channels);
        let mut fits = true;
        unpack(from, |k, count| match u32::try_from(count) {
            Ok(count) if count <= most => layers.hits[k] = count,
            _ => fits = false,
        })?;
        layers.sums.iter_mut().try_for_each(|sums| unpack(from, |k, sum| sums[k] = sum))?;
        fits.then_some(layers)
    }

    /// Bytes of memory that a tile takes for so many channels.
    pub fn bytes(channels: usize) -> usize {
        if channels == 0 { 0 } else { size_of::<TileLayers>() + channels * size_of::<[i128; PIXELS]>() }
    }
}

impl Tile {
    /// Adds what the camera rays of an item hit first; samples and pixels are those of [`Tile::add`].
    #[inline]
    pub(crate) fn add_layers(
        &mut self,
        samples: &LayerSamples,
        item: usize,
        pixels: impl Iterator<Item = (usize, usize)> + Clone,
    ) {
        if samples.columns.is_empty() {
            return;
        }
        let layers = self.layers.get_or_insert_with(|| Box::new(TileLayers::new(samples.columns.len())));
        pixels.clone().for_each(|(k, pixel)| layers.hits[pixel] += (samples.hits[item] >> k & 1) as u32);
        for (sums, column) in layers.sums.iter_mut().zip(&samples.columns) {
            let column = &column[slots_of(item)];
            pixels.clone().for_each(|(k, pixel)| sums[pixel] = sums[pixel].wrapping_add(fixed(within(column[k]))));
        }
    }
}

/// What can be summed: 6.7e7 times the scene's size or its brightest light at most, which is as good as infinite for a layer. No layer makes a
/// NaN of a hit; were there one, it would count as zero.
#[inline(always)]
fn within(x: f32) -> f32 {
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

    /// The pixels of a layer, those that [`Film::crop`] holds; `None` where the film has no such layer.
    ///
    /// # Examples
    ///
    /// ```
    /// use scene_format::desc::Layer;
    /// use std::path::Path;
    /// use tracer_core::{LayerSet, RenderOptions, Unobserved, compile, render};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let text = "Scene(image: Image(width: 9, height: 9), background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)])";
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
        let place = self.layers.iter().position(|of| of.layer == layer)?;
        let first = self.layers[..place].iter().map(|of| definition(of.layer).channels.len()).sum();
        let definition = definition(layer);
        let of = &self.layers[place];
        let Crop { x, y, width, height } = self.crop;
        let count = definition.channels.len();
        let mut values = vec![0.0; count * width as usize * height as usize];
        let rows = values.par_chunks_exact_mut((count * width as usize).max(1)).zip(y..y + height);
        rows.for_each(|(row, y)| {
            for (x, pixel) in (x..x + width).zip(row.chunks_exact_mut(count)) {
                self.layer_of_pixel(x, y, of, first, pixel);
            }
        });
        Some(LayerImage { name: definition.name, channels: definition.channels, values })
    }

    /// A pixel of a layer, whose first channel has this number among all.
    fn layer_of_pixel(&self, x: u32, y: u32, of: &FilmLayer, first: usize, pixel: &mut [f32]) {
        let (tile, k) = self.place(x, y);
        let layers = tile.layers.as_deref();
        let hits = layers.map_or(0, |layers| layers.hits[k]);
        let count = match definition(of.layer).pixel {
            Pixel::Mean => tile.samples[k].max(1),
            Pixel::MeanOfHits(empty) if hits == 0 => return pixel.fill(empty),
            Pixel::MeanOfHits(_) => hits,
        };
        for (c, value) in pixel.iter_mut().enumerate() {
            let sum = layers.map_or(0, |layers| layers.sums[first + c][k]);
            let mean = sum as f64 * LEAST / f64::from(count);
            let mean = mean * of.units.scale + of.units.offset[c];
            *value = mean.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32;
        }
    }
}
