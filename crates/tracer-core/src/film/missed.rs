//! What camera rays see behind everything, summed by itself, so that a picture can be laid over another one
//! ([`crate::Backdrop`]). The layer `alpha` is kept beside it, which tells how much of a pixel that is.

use super::exact::Sums;
use super::layers::is_hit;
use super::{Film, Samples, Tile};
use bytemuck::Zeroable;
use tracer_kernels::layers::LayerSamples;

impl Tile {
    /// Adds samples of the block whose first item this is, those of [`Tile::add`], whose camera rays have hit nothing:
    /// all that they have is the background. The squares that tell the noise have in its place the luminance of the
    /// `paper` that the picture will be laid over, or nothing. Where halves are kept, what is seen of the background is
    /// coverage, not light, as lamps are.
    pub(crate) fn add_missed(
        &mut self,
        samples: impl Samples,
        layers: &LayerSamples,
        first_slot: usize,
        pixels: &[[u8; 2]],
        (half, paper): (usize, f64),
    ) {
        for &[k, pixel] in pixels {
            let (k, pixel) = (usize::from(k), usize::from(pixel));
            if is_hit(layers, first_slot + k) {
                continue;
            }
            self.squares.add(pixel, paper);
            let Some(sample) = samples.whole(k).filter(|&sample| sample != [0; 3]) else { continue };
            self.missed.get_or_insert_with(|| Box::new(Sums::zeroed())).add(pixel, sample);
            self.squares.take(pixel, samples.luminance(k));
            self.add_to_lamps(half, pixel, sample);
        }
    }
}

impl Film {
    /// Keeps what is seen behind everything by itself, if that is wanted; before anything is added.
    pub(crate) fn keep_backdrop(&mut self, backdrop: bool) {
        self.backdrop = backdrop;
    }

    /// Takes down the luminance of what the picture will be laid over, as radiance; zero: nothing.
    pub(crate) fn lie_over(&mut self, paper: f64) {
        let paper = paper / self.unit;
        self.paper = if self.backdrop && paper.is_finite() { paper } else { 0.0 };
    }

    /// Whether it keeps what is seen behind everything by itself: the scene has a [`crate::Backdrop`].
    pub fn has_backdrop(&self) -> bool {
        self.backdrop
    }

    /// The part of a pixel's radiance ([`Film::radiance`]) that is the background, seen by camera rays that hit
    /// nothing, linear RGB. Black where that is not kept ([`Film::has_backdrop`]).
    pub fn background(&self, x: u32, y: u32) -> [f64; 3] {
        let (tile, pixel) = self.place(x, y);
        let mean = |missed: &Sums| missed.mean(pixel, tile.samples[pixel]).map(|x| x * self.unit);
        tile.missed.as_deref().map_or([0.0; 3], mean)
    }

    /// The share of a pixel's samples that hit something, 0 to 1; one where that is not kept
    /// ([`Film::has_backdrop`]).
    pub fn alpha(&self, x: u32, y: u32) -> f64 {
        if !self.backdrop {
            return 1.0;
        }
        let (tile, pixel) = self.place(x, y);
        let hits = tile.layers.as_ref().map_or(0, |layers| layers.hits_of(pixel));
        f64::from(hits) / f64::from(tile.samples[pixel].max(1))
    }
}
