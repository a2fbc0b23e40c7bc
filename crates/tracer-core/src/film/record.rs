//! A tile of a film as it stands in a file ([`super::file`]).

use super::pack::{pack, pack_wide, unpack, unpack_wide};
use super::{FilmLayer, MattesKept, Splats, Squares, Sums, Taken, Tile, TileGroups, TileHalf, TileLayers, TileMattes};
use bytemuck::Zeroable;
use rayon::prelude::*;
use std::io::{self, Read};
use tracer_kernels::layers::{Kept, LayerSet};

/// Bytes of records after which they are looked at: enough for all cores, and little beside a film.
const AT_ONCE: usize = 1 << 20;

/// Records of some tiles of a film, without their numbers and lengths.
#[derive(Default)]
pub(super) struct Records {
    bytes: Vec<u8>,
    /// Which tile a record is of, and where it ends.
    ends: Vec<(usize, usize)>,
}

impl Records {
    /// Reads one more, of the tile with this number, and gives its bytes.
    pub fn add(&mut self, place: usize, from: &mut impl Read) -> io::Result<&[u8]> {
        let start = self.bytes.len();
        from.read_to_end(&mut self.bytes)?;
        self.ends.push((place, self.bytes.len()));
        Ok(&self.bytes[start..])
    }

    /// Whether it is time to look at them.
    pub fn is_full(&self) -> bool {
        self.bytes.len() >= AT_ONCE
    }

    /// Forgets them.
    pub fn clear(&mut self) {
        self.bytes.clear();
        self.ends.clear();
    }

    fn get(&self, k: usize) -> (usize, &[u8]) {
        let start = k.checked_sub(1).map_or(0, |before| self.ends[before].1);
        (self.ends[k].0, &self.bytes[start..self.ends[k].1])
    }

    /// The numbers of their tiles, and their bytes.
    pub fn par_iter(&self) -> impl ParallelIterator<Item = (usize, &[u8])> {
        (0..self.ends.len()).into_par_iter().map(|k| self.get(k))
    }

    /// Their tiles, each once, and their bytes, where number 0 is the tile `first`; `None` where there is no such tile.
    pub fn beside<'a>(&'a self, tiles: &'a mut [Tile], first: usize) -> Option<Vec<(&'a mut Tile, &'a [u8])>> {
        let mut records: Vec<(usize, &[u8])> = (0..self.ends.len()).map(|k| self.get(k)).collect();
        records.sort_unstable_by_key(|record| record.0);
        let (mut rest, mut next) = (tiles.get_mut(first..)?, 0);
        records
            .into_iter()
            .map(|(place, bytes)| {
                let from_here = std::mem::take(&mut rest).get_mut(place.checked_sub(next)?..)?;
                let (tile, behind) = from_here.split_first_mut()?;
                (rest, next) = (behind, place + 1);
                Some((tile, bytes))
            })
            .collect()
    }
}

/// What tiles keep for these layers.
pub(super) fn kept(layers: &[FilmLayer]) -> Kept {
    layers.iter().map(|of| of.layer).collect::<LayerSet>().kept()
}

/// What tiles hold beside the picture.
#[derive(Clone, Copy)]
pub(super) struct Held {
    /// For layers.
    pub kept: Kept,
    /// For mattes.
    pub mattes: MattesKept,
    /// So many light groups.
    pub groups: usize,
}

/// A tile as it stands in the file, its number and length included.
pub(super) fn record(place: usize, tile: &Tile) -> Vec<u8> {
    let mut out = Vec::with_capacity(8192);
    out.extend((place as u32).to_le_bytes());
    out.extend([0; 4]);
    let [taken, splats] = [tile.taken.is_some(), tile.splats.is_some()];
    let [layers, half, missed] = [tile.layers.is_some(), tile.half.is_some(), tile.missed.is_some()];
    let octave = tile.octave.iter().any(|mean| mean.to_bits() != 0);
    let parts = [taken, splats, layers, half, missed, tile.mattes.is_some(), tile.groups.is_some(), octave];
    out.push(parts.iter().rev().fold(0, |bits, &part| bits << 1 | u8::from(part)));
    let sums = |sums: &Sums, out: &mut Vec<u8>| (0..3).for_each(|c| pack(|k| sums.of(c, k), out));
    sums(&tile.sums, &mut out);
    pack_wide(|k| tile.squares.words(k), &mut out);
    pack(|k| tile.samples[k].into(), &mut out);
    if let Some(taken) = &tile.taken {
        sums(&taken.sums, &mut out);
        pack(|k| taken.samples[k].into(), &mut out);
    }
    if let Some(splats) = &tile.splats {
        sums(&splats.sums, &mut out);
        pack_wide(|k| splats.squares.words(k), &mut out);
    }
    if let Some(layers) = &tile.layers {
        layers.record(&mut out);
    }
    if let Some(half) = &tile.half {
        half.record(&mut out);
    }
    if let Some(missed) = &tile.missed {
        sums(missed, &mut out);
    }
    if let Some(mattes) = &tile.mattes {
        mattes.record(&mut out);
    }
    if let Some(groups) = &tile.groups {
        groups.record(&mut out);
    }
    if octave {
        pack(|k| (tile.octave[k].to_bits() >> 8).into(), &mut out);
    }
    let length = (out.len() - 8) as u32;
    out[4..8].copy_from_slice(&length.to_le_bytes());
    out
}

/// The tile of a record, without its number and length, into one that is zero. No pixel has more samples than so many;
/// this is held beside the picture.
pub(super) fn read_tile(mut from: &[u8], most: u32, held: Held, tile: &mut Tile) -> Option<()> {
    let from = &mut from;
    let sums = |sums: &mut Sums, from: &mut &[u8]| (0..3).try_for_each(|c| unpack(from, |k, x| sums.set(c, k, x)));
    let squares = |squares: &mut Squares, from: &mut &[u8]| unpack_wide(from, |k, words| squares.set(k, words));
    let samples = |samples: &mut [u32], most: u32, from: &mut &[u8]| {
        let mut fits = true;
        unpack(from, |k, count| match u32::try_from(count) {
            Ok(count) if count <= most => samples[k] = count,
            _ => fits = false,
        })?;
        fits.then_some(())
    };
    let flags = *from.split_off_first()?;
    sums(&mut tile.sums, from)?;
    squares(&mut tile.squares, from)?;
    samples(&mut tile.samples, most, from)?;
    if flags & 1 != 0 {
        let mut taken = Box::new(Taken::zeroed());
        sums(&mut taken.sums, from)?;
        // Light paths may be clamped, too.
        samples(&mut taken.samples, u32::MAX / 2, from)?;
        tile.taken = Some(taken);
    }
    if flags & 2 != 0 {
        let mut splats = Box::new(Splats::zeroed());
        sums(&mut splats.sums, from)?;
        squares(&mut splats.squares, from)?;
        tile.splats = Some(splats);
    }
    if flags & 4 != 0 {
        tile.layers = Some(Box::new(TileLayers::read(from, most, held.kept)?));
    }
    if flags & 8 != 0 {
        tile.half = Some(TileHalf::read(from, &tile.samples)?);
    }
    if flags & 16 != 0 {
        let mut missed = Box::new(Sums::zeroed());
        sums(&mut missed, from)?;
        tile.missed = Some(missed);
    }
    if flags & 32 != 0 {
        tile.mattes = Some(Box::new(TileMattes::read(from, &tile.samples, held.mattes)?));
    }
    if flags & 64 != 0 {
        tile.groups = Some(Box::new(TileGroups::read(from, held.groups)?));
    }
    if flags & 128 != 0 {
        let mut fits = true;
        unpack(from, |k, bits| match u32::try_from(bits) {
            Ok(bits) if bits < 1 << 24 => tile.octave[k] = f32::from_bits(bits << 8),
            _ => fits = false,
        })?;
        fits.then_some(())?;
    }
    (tile.octave.iter().all(|mean| mean.is_finite()) && from.is_empty()).then_some(())
}
