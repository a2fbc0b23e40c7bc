//! Two halves of the samples, summed apart: what the one does not know of the other's noise is how denoising tells
//! noise from picture (`tracer_denoise`). The film sums all samples as ever, and beside them those of the second half;
//! the first is the rest.
//!
//! Which half a sample is of goes by its index alone, so that it is the same for any passes, parts and number of
//! samples: of the indices from one power of two to the next the lower half is of the first, the upper of the second.
//! So both have as many at every power of two, and each run of a half is a net of the sampler's: with every other index
//! one half would have the left of each pixel, the other the right.

use super::adaptive::second_taken;
use super::exact::{LEAST, Sums, fixed};
use super::layers::{is_hit, within};
use super::pack::{pack, unpack};
use super::{Film, PIXELS, Samples, Tile, counts};
use bytemuck::Zeroable;
use std::ops::Range;
use tracer_kernels::layers::{Layer, LayerSamples, LayerSet};

/// What a tile holds of the second half of its samples.
#[derive(Clone, Debug, PartialEq, Zeroable)]
pub(super) struct TileHalf {
    sums: Sums,
    samples: [u32; PIXELS],
    /// Where its light paths have fallen.
    splats: Option<Box<Sums>>,
    /// What samples of either half have seen of lamps, straight, over mirrors and glass or nearly so, where they have;
    /// and of the background, where the film keeps that by itself.
    lamps: Option<Box<[Sums; 2]>>,
    /// The layer `denoising_albedo` of its samples, where the film has that; of those that have hit something where the
    /// film keeps the background by itself.
    albedo: Option<Box<Sums>>,
}

/// The half that a sample index is of: 0 or 1.
#[inline]
pub(crate) fn half_of(sample: u32) -> usize {
    match sample.checked_ilog2() {
        Some(power) if power > 0 => (sample >> (power - 1) & 1) as usize,
        _ => sample as usize,
    }
}

/// The first index behind this one that may be of the other half.
pub(crate) fn half_end(sample: u32) -> u32 {
    let run = sample.checked_ilog2().map_or(0, |power| (1 << power >> 1_u32).max(1) - 1);
    (sample | run).saturating_add(1)
}

/// How many of these indices are of the second half.
pub(super) fn second_of(samples: Range<u32>) -> u32 {
    let below = |end: u32| match end.checked_ilog2() {
        Some(power) if power > 0 => (1 << (power - 1)) + end.saturating_sub(3 << (power - 1)),
        _ => 0,
    };
    below(samples.end).saturating_sub(below(samples.start))
}

impl TileHalf {
    /// Bytes of memory that it takes in a tile at most.
    pub fn most_bytes(light_paths: bool) -> usize {
        size_of::<TileHalf>() + (3 + usize::from(light_paths)) * size_of::<Sums>()
    }

    /// Bytes of memory that it takes.
    pub fn bytes(&self) -> usize {
        let of = |there: bool, size: usize| if there { size } else { 0 };
        let (splats, albedo) = (self.splats.is_some(), self.albedo.is_some());
        let optional = [splats, albedo].map(|there| of(there, size_of::<Sums>())).iter().sum::<usize>();
        size_of::<TileHalf>() + optional + of(self.lamps.is_some(), size_of::<[Sums; 2]>())
    }

    /// Adds what another has of the same pixels.
    pub fn merge(&mut self, other: &TileHalf) {
        let add = |to: &mut Sums, from: &Sums| (0..PIXELS).for_each(|k| to.add(k, [0, 1, 2].map(|c| from.of(c, k))));
        add(&mut self.sums, &other.sums);
        super::merge::add_counts(&mut self.samples, &other.samples);
        if let Some(from) = &other.splats {
            add(self.splats.get_or_insert_with(|| Box::new(Sums::zeroed())), from);
        }
        if let Some(from) = &other.albedo {
            add(self.albedo.get_or_insert_with(|| Box::new(Sums::zeroed())), from);
        }
        if let Some(from) = &other.lamps {
            let lamps = self.lamps.get_or_insert_with(|| Box::new(Zeroable::zeroed()));
            lamps.iter_mut().zip(&**from).for_each(|(to, from)| add(to, from));
        }
    }

    fn add_to_lamps(&mut self, of: usize, pixel: usize, added: [i128; 3]) {
        let lamps = self.lamps.get_or_insert_with(|| Box::new(Zeroable::zeroed()));
        lamps[of].add(pixel, added);
    }

    /// Appends it to a tile's record.
    pub fn record(&self, out: &mut Vec<u8>) {
        let parts = [self.splats.is_some(), self.lamps.is_some(), self.albedo.is_some()];
        out.push(parts.iter().zip(0..).map(|(&there, bit)| u8::from(there) << bit).sum());
        pack(|k| self.samples[k].into(), out);
        let lamps = self.lamps.iter().flat_map(|lamps| lamps.iter());
        for sums in std::iter::once(&self.sums).chain(self.splats.as_deref()).chain(lamps).chain(self.albedo.as_deref())
        {
            (0..3).for_each(|c| pack(|k| sums.of(c, k), out));
        }
    }

    /// Reads it from one; no pixel has more samples than these.
    pub fn read(from: &mut &[u8], samples: &[u32; PIXELS]) -> Option<Box<Self>> {
        let mut half = Box::new(TileHalf::zeroed());
        let parts = *from.split_off_first()?;
        if parts > 7 {
            return None;
        }
        half.splats = (parts & 1 != 0).then(|| Box::new(Sums::zeroed()));
        half.lamps = (parts & 2 != 0).then(|| Box::new(Zeroable::zeroed()));
        half.albedo = (parts & 4 != 0).then(|| Box::new(Sums::zeroed()));
        let mut fits = true;
        unpack(from, |k, count| match u32::try_from(count) {
            Ok(count) if count <= samples[k] => half.samples[k] = count,
            _ => fits = false,
        })?;
        let TileHalf { sums, splats, lamps, albedo, .. } = &mut *half;
        let lamps = lamps.iter_mut().flat_map(|lamps| lamps.iter_mut());
        for sums in std::iter::once(sums).chain(splats.as_deref_mut()).chain(lamps).chain(albedo.as_deref_mut()) {
            (0..3).try_for_each(|c| unpack(from, |k, sum| sums.set(c, k, sum)))?;
        }
        fits.then_some(half)
    }
}

impl Tile {
    /// Makes room for the second half.
    pub(super) fn keep_half(&mut self) {
        self.half = Some(Box::new(TileHalf::zeroed()));
    }

    /// Adds samples of the second half, which [`Tile::add`] is given, too; where halves are kept.
    pub(crate) fn add_half(&mut self, samples: impl Samples, pixels: &[[u8; 2]]) {
        let Some(half) = &mut self.half else { return };
        for &[k, pixel] in pixels {
            let (k, pixel) = (usize::from(k), usize::from(pixel));
            half.samples[pixel] += 1;
            if let Some(sample) = samples.whole(k) {
                half.sums.add(pixel, sample);
            }
        }
    }

    /// Adds what a half has seen of lamps, straight or over mirrors and glass, of the samples that [`Tile::add`] is
    /// given, too; where halves are kept. It is clamped as a sample is, and never more than the sample has: what there
    /// is beside it stays at zero or above.
    pub(crate) fn add_lamps(
        &mut self,
        of: usize,
        (lamps, samples): (&[[f32; 3]], impl Samples),
        pixels: &[[u8; 2]],
        limit: Option<f64>,
    ) {
        let Some(half) = &mut self.half else { return };
        for &[k, pixel] in pixels {
            let met = lamps[usize::from(k)];
            if met == [0.0; 3] || !counts(met) {
                continue;
            }
            let Some(sample) = samples.whole(usize::from(k)) else { continue };
            let largest = f64::from(met[0].max(met[1]).max(met[2]));
            let scale = limit.filter(|&limit| largest > limit).map_or(1.0, |limit| limit / largest);
            let seen = |c: usize| fixed((f64::from(met[c]) * scale) as f32).min(sample[c]);
            half.add_to_lamps(of, usize::from(pixel), [0, 1, 2].map(seen));
        }
    }

    /// Adds what samples of the second half have met of the layer `denoising_albedo`, whose sums begin at `place`; the
    /// pixels are those of [`Tile::add`]. `all`: whether those count that have hit nothing.
    pub(crate) fn add_half_albedo(
        &mut self,
        layers: &LayerSamples,
        (place, all): (usize, bool),
        slots: &Range<usize>,
        pixels: &[[u8; 2]],
    ) {
        let Some(half) = &mut self.half else { return };
        let albedo = half.albedo.get_or_insert_with(|| Box::new(Sums::zeroed()));
        for &[k, pixel] in pixels {
            let slot = slots.start + usize::from(k);
            if all || is_hit(layers, slot) {
                albedo.add(usize::from(pixel), [0, 1, 2].map(|c| fixed(within(layers.sums[place + c][slot]))));
            }
        }
    }

    /// Adds what a half's sample shows beside the light on surfaces, where halves are kept.
    pub(super) fn add_to_lamps(&mut self, of: usize, pixel: usize, added: [i128; 3]) {
        if let Some(half) = &mut self.half {
            half.add_to_lamps(of, pixel, added);
        }
    }

    /// Adds what a light path of the second half has brought, as [`Tile::splat`] gives it; where halves are kept.
    pub(crate) fn splat_half(&mut self, pixel: usize, added: [i128; 3]) {
        let Some(half) = &mut self.half else { return };
        half.splats.get_or_insert_with(|| Box::new(Sums::zeroed())).add(pixel, added);
    }
}

impl Film {
    /// Keeps halves apart, if that is wanted; before anything is added.
    pub(crate) fn keep_halves(&mut self, halves: bool) {
        self.halves = halves;
        if halves {
            self.tiles.iter_mut().for_each(Tile::keep_half);
        }
    }

    /// Where a layer stands among the sums of a sample's layers, if it is kept for halves.
    pub(crate) fn place_for_halves(&self, layer: Layer) -> Option<usize> {
        let layers = self.layers();
        let before: LayerSet = layers.iter().take_while(|&other| other != layer).collect();
        (self.halves && layers.iter().any(|other| other == layer)).then(|| before.kept().sums)
    }

    /// Whether two halves of the samples are kept apart ([`crate::RenderOptions::halves`]).
    pub fn has_halves(&self) -> bool {
        self.halves
    }

    /// Samples of a pixel that are of the first and of the second half; zero where halves are not kept.
    pub fn samples_of_halves(&self, x: u32, y: u32) -> [u32; 2] {
        let (tile, pixel) = self.place(x, y);
        tile.half.as_ref().map_or([0; 2], |half| {
            let second = half.samples[pixel];
            [tile.samples[pixel] - second, second]
        })
    }

    /// What lamps, seen straight or over up to three mirrors and surfaces of glass only, add to
    /// [`Film::radiance_of_halves`]; where the film has the layer `emission`, else zero. It is clamped where samples
    /// are, and is no more than they have.
    pub fn lamps_of_halves(&self, x: u32, y: u32) -> [[f64; 3]; 2] {
        let (tile, pixel) = self.place(x, y);
        let samples = self.samples_of_halves(x, y);
        let Some(lamps) = tile.half.as_ref().and_then(|half| half.lamps.as_deref()) else { return [[0.0; 3]; 2] };
        [0, 1].map(|of| lamps[of].mean(pixel, samples[of]).map(|x| x * self.unit))
    }

    /// The layer `denoising_albedo` of either half, where the film has it, else zero; without what is white where
    /// nothing is hit, where the film keeps the background by itself ([`Film::has_backdrop`]): what is behind is not
    /// part of the picture then, and thin dark things are divided by what they reflect, not by what they leave free.
    pub fn albedo_of_halves(&self, x: u32, y: u32) -> [[f64; 3]; 2] {
        let (tile, pixel) = self.place(x, y);
        let samples = self.samples_of_halves(x, y);
        let (Some(place), Some(layers)) = (self.place_for_halves(Layer::DenoisingAlbedo), tile.layers.as_deref())
        else {
            return [[0.0; 3]; 2];
        };
        let missed = if self.backdrop { tile.samples[pixel].saturating_sub(layers.hits_of(pixel)) } else { 0 };
        let white = i128::from(missed) * fixed(1.0);
        let second = tile.half.as_ref().and_then(|half| half.albedo.as_deref());
        [0, 1].map(|of| {
            [0, 1, 2].map(|c| {
                let second = second.map_or(0, |second| second.of(c, pixel));
                let first = || layers.sum_of(place + c, pixel).wrapping_sub(white).wrapping_sub(second);
                let sum = if of == 1 { second } else { first() };
                sum as f64 * LEAST / f64::from(samples[of].max(1))
            })
        })
    }

    /// Mean radiance of a pixel over either half of its samples, linear RGB, as [`Film::radiance`] is over all; `None`
    /// where one of them has no sample.
    pub fn radiance_of_halves(&self, x: u32, y: u32) -> Option<[[f64; 3]; 2]> {
        let (tile, pixel) = self.place(x, y);
        let half = tile.half.as_ref()?;
        let samples = self.samples_of_halves(x, y);
        // Light paths of a pass that was ended early have come from other indices than samples have; else there are as
        // many, and what was merged does not know its indices.
        let light = match &self.unfinished {
            Some(_) => {
                let range = self.first()..self.light_samples.max(self.first());
                let second = f64::from(second_taken(tile.rest, range));
                let second = second + if half_of(self.light_samples) == 1 { self.light_of_quarters() } else { 0.0 };
                [self.light_of(tile) - second, second]
            }
            None => samples.map(f64::from),
        };
        if samples.contains(&0) {
            return None;
        }
        let mean = |second: bool, c: usize| {
            let part = |all: i128, of_second: i128| if second { of_second } else { all.wrapping_sub(of_second) };
            let sum = part(tile.sums.of(c, pixel), half.sums.of(c, pixel));
            let splats = part(
                tile.splats.as_ref().map_or(0, |splats| splats.sums.of(c, pixel)),
                half.splats.as_ref().map_or(0, |splats| splats.of(c, pixel)),
            );
            let over = |sum: i128, count: f64| sum as f64 * LEAST / if count > 0.0 { count } else { 1.0 };
            let of = usize::from(second);
            (over(sum, f64::from(samples[of])) + over(splats, light[of])) * self.unit
        };
        Some([false, true].map(|second| [0, 1, 2].map(|c| mean(second, c))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_equal_at_powers_of_two() {
        let halves: Vec<usize> = (0..16).map(half_of).collect();
        assert_eq!(halves, [0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1]);
        for end in 0..2000 {
            let second = (0..end).filter(|&sample| half_of(sample) == 1).count();
            assert_eq!(second_of(0..end) as usize, second, "{end}");
            assert!(!end.is_power_of_two() || end == 1 || 2 * second == end as usize);
            // A run has one half, and the next index begins a run.
            let next = half_end(end);
            assert!(next > end && (end..next).all(|sample| half_of(sample) == half_of(end)), "{end}");
        }
        assert_eq!((half_end(u32::MAX), half_of(u32::MAX), second_of(0..u32::MAX)), (u32::MAX, 1, (1 << 31) - 1));
    }
}
