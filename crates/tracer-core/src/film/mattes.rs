//! Mattes of a film: of each pixel how many samples have hit which object, or which material, first. Whole numbers
//! again, so that neither order nor threads can show; and all of them, for which are the six with most samples is known
//! in the end only, and of parts only when they are merged.

use super::{Film, PIXELS, Tile};
use std::ops::Range;
use tracer_kernels::layers::{Layer, LayerSamples, LayerSet};

/// What mattes a film keeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MattesKept {
    /// Of objects and lights.
    pub objects: bool,
    /// Of materials.
    pub materials: bool,
}

/// What mattes tell apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MatteOf {
    /// Objects and lights, by the numbers of the layer `object_id`.
    Objects,
    /// Materials, by the numbers of the layer `material_id`.
    Materials,
}

impl MattesKept {
    /// Whether there are none.
    pub fn is_empty(self) -> bool {
        self == MattesKept::default()
    }

    /// Those that there are, in order.
    pub fn iter(self) -> impl Iterator<Item = MatteOf> {
        let [objects, materials] = [self.objects, self.materials];
        objects.then_some(MatteOf::Objects).into_iter().chain(materials.then_some(MatteOf::Materials))
    }

    /// The layers whose samples they are made of; the film keeps them, too.
    pub(crate) fn layers(self) -> LayerSet {
        self.iter().map(MatteOf::layer).collect()
    }

    /// As the head of a saved film has it.
    pub(super) fn bits(self) -> u32 {
        u32::from(self.objects) | u32::from(self.materials) << 1
    }

    /// Back again.
    pub(super) fn from_bits(bits: u32) -> Option<Self> {
        (bits < 4).then_some(MattesKept { objects: bits & 1 != 0, materials: bits & 2 != 0 })
    }

    /// Bytes of memory that they take for a pixel where few things meet in it, as in most.
    pub fn bytes_of_pixel(self) -> u64 {
        (self.bytes() / PIXELS) as u64
    }

    /// Bytes of memory that they take in a tile where few things meet in a pixel, as in most pictures.
    pub(super) fn bytes(self) -> usize {
        self.iter().count() * PIXELS * (size_of::<Vec<Count>>() + 4 * size_of::<Count>())
    }
}

impl MatteOf {
    /// The layer that has the numbers.
    fn layer(self) -> Layer {
        match self {
            MatteOf::Objects => Layer::ObjectId,
            MatteOf::Materials => Layer::MaterialId,
        }
    }

    /// Where its numbers stand among those of the nearest samples, with these layers.
    fn column(self, layers: LayerSet) -> usize {
        layers.iter().take_while(|&layer| layer != self.layer()).collect::<LayerSet>().kept().nearest
    }
}

/// A number, and how many samples have hit what it stands for.
type Count = (u32, u32);

/// Of each pixel of a tile the counts, by number.
#[derive(Clone, Debug, PartialEq)]
struct TileMatte(Box<[Vec<Count>; PIXELS]>);

/// What a tile holds for mattes: objects, then materials, where they are kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct TileMattes(Vec<TileMatte>);

/// Adds to the count of a number.
fn add(counts: &mut Vec<Count>, number: u32, samples: u32) {
    match counts.binary_search_by_key(&number, |&(number, _)| number) {
        // A file that lies must not be a panic.
        Ok(k) => counts[k].1 = counts[k].1.saturating_add(samples),
        Err(k) => counts.insert(k, (number, samples)),
    }
}

impl TileMattes {
    pub fn new(kept: MattesKept) -> Self {
        TileMattes(kept.iter().map(|_| TileMatte(Box::new([const { Vec::new() }; PIXELS]))).collect())
    }

    /// Bytes of memory that it takes.
    pub fn bytes(&self) -> usize {
        let of_pixel = |counts: &Vec<Count>| size_of::<Vec<Count>>() + counts.capacity() * size_of::<Count>();
        self.0.iter().flat_map(|matte| matte.0.iter()).map(of_pixel).sum()
    }

    /// Adds what another has of the same pixels.
    pub fn merge(&mut self, other: &TileMattes) {
        for (to, from) in self.0.iter_mut().zip(&other.0) {
            for (to, from) in to.0.iter_mut().zip(from.0.iter()) {
                from.iter().for_each(|&(number, samples)| add(to, number, samples));
            }
        }
    }

    /// Appends it to a tile's record: of each pixel how many numbers, then each less the one before, and its count.
    pub fn record(&self, out: &mut Vec<u8>) {
        for counts in self.0.iter().flat_map(|matte| matte.0.iter()) {
            put(counts.len() as u32, out);
            let mut last = 0;
            for &(number, samples) in counts {
                put(number - last, out);
                put(samples, out);
                last = number;
            }
        }
    }

    /// Reads it from one; no pixel has more samples than these.
    pub fn read(from: &mut &[u8], samples: &[u32; PIXELS], kept: MattesKept) -> Option<Self> {
        let mut mattes = TileMattes::new(kept);
        for matte in &mut mattes.0 {
            for (counts, &most) in matte.0.iter_mut().zip(samples) {
                let (mut number, mut sum) = (0u32, 0u32);
                for _ in 0..take(from)? {
                    let above = take(from).filter(|&above| above > 0)?;
                    number = number.checked_add(above)?;
                    let count = take(from).filter(|&count| count > 0)?;
                    sum = sum.checked_add(count).filter(|&sum| sum <= most)?;
                    counts.push((number, count));
                }
            }
        }
        Some(mattes)
    }
}

/// A number in as many bytes as it needs, seven bits each, the lowest first.
fn put(mut number: u32, out: &mut Vec<u8>) {
    while number >= 128 {
        out.push(number as u8 | 128);
        number >>= 7;
    }
    out.push(number as u8);
}

fn take(from: &mut &[u8]) -> Option<u32> {
    let mut number = 0u64;
    for shift in (0..35).step_by(7) {
        let byte = *from.split_off_first()?;
        number |= u64::from(byte & 127) << shift;
        if byte < 128 {
            return u32::try_from(number).ok();
        }
    }
    None
}

/// Bytes of a tile's record at most, where pixels have so many samples.
pub(super) fn longest_record(kept: MattesKept, samples: u32) -> u64 {
    let of_pixel = 5 + 10 * u64::from(samples);
    kept.iter().count() as u64 * PIXELS as u64 * of_pixel
}

impl Tile {
    /// Counts what the camera rays of a block's slots hit first; `pixels` are those of [`Tile::add`], `layers` those
    /// whose samples these are.
    pub(crate) fn add_mattes(
        &mut self,
        kept: MattesKept,
        layers: LayerSet,
        samples: &LayerSamples,
        slots: &Range<usize>,
        pixels: &[[u8; 2]],
    ) {
        let mattes = self.mattes.get_or_insert_with(|| Box::new(TileMattes::new(kept)));
        for (of, matte) in kept.iter().zip(&mut mattes.0) {
            let Some(column) = samples.nearest.get(of.column(layers)) else { continue };
            let column = &column[slots.clone()];
            for &[k, pixel] in pixels {
                // Zero is nothing, or what has no material.
                let number = column[usize::from(k)];
                if number > 0 {
                    add(&mut matte.0[usize::from(pixel)], number, 1);
                }
            }
        }
    }
}

impl Film {
    /// Makes room for mattes; before anything is added.
    pub(crate) fn keep_mattes(&mut self, kept: MattesKept) {
        self.mattes = kept;
    }

    /// The mattes that it holds.
    pub fn mattes(&self) -> MattesKept {
        self.mattes
    }

    /// What the camera rays of a pixel have hit first, by number, each with its share of the pixel's samples: they sum
    /// to one at most. Samples lie where the picture's filter has them, so shares are those of the filtered picture.
    /// Empty where nothing is hit, and where such mattes are not kept.
    pub fn matte(&self, of: MatteOf, x: u32, y: u32) -> Vec<(u32, f64)> {
        let (tile, pixel) = self.place(x, y);
        let Some(k) = self.mattes.iter().position(|kept| kept == of) else { return Vec::new() };
        let counts = tile.mattes.as_ref().and_then(|mattes| mattes.0.get(k));
        let samples = f64::from(tile.samples[pixel].max(1));
        let share = |&(number, count): &Count| (number, f64::from(count) / samples);
        counts.map_or(Vec::new(), |matte| matte.0[pixel].iter().map(share).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_come_back_and_lies_do_not() {
        let kept = MattesKept { objects: true, materials: true };
        let mut mattes = TileMattes::new(kept);
        let mut samples = [0; PIXELS];
        for (k, samples) in samples.iter_mut().enumerate() {
            for j in 0..k as u32 % 7 {
                add(&mut mattes.0[0].0[k], 1 + j * j * 1_000_003, 1 + j * 200);
                add(&mut mattes.0[1].0[k], u32::MAX - j, 1);
                *samples += 1 + j * 200;
            }
        }
        let mut bytes = Vec::new();
        mattes.record(&mut bytes);
        assert_eq!(TileMattes::read(&mut &*bytes, &samples, kept).as_ref(), Some(&mattes));
        assert!(bytes.len() as u64 <= longest_record(kept, 4000));
        let read = |bytes: &[u8], most: u32| TileMattes::read(&mut &*bytes, &[most; PIXELS], kept);
        assert!(read(&bytes[..bytes.len() - 1], 4000).is_none(), "it is cut short");
        assert!(read(&bytes, 3).is_none(), "more hits than samples");
        let zeros = [0; 2 * PIXELS];
        assert_eq!(read(&zeros, 0), Some(TileMattes::new(kept)));
        for lie in [&[1, 0, 1][..], &[1, 1, 0], &[2, 1, 1, 0, 1], &[255, 255, 255, 255, 255, 1], &[1, 1]] {
            assert!(read(&[lie, &zeros].concat(), 9).is_none() || lie.len() == 2, "{lie:?}");
        }
    }

    #[test]
    fn merged_counts_are_those_of_one() {
        let kept = MattesKept { objects: true, materials: false };
        let all = [(5, 2), (1, 7), (9, 1), (5, 3)];
        let of = |counts: &[Count]| {
            let mut mattes = TileMattes::new(kept);
            counts.iter().for_each(|&(number, samples)| add(&mut mattes.0[0].0[3], number, samples));
            mattes
        };
        let (mut ab, mut ba) = (of(&all[..2]), of(&all[2..]));
        ab.merge(&of(&all[2..]));
        ba.merge(&of(&all[..2]));
        assert_eq!((&ab, &ba), (&of(&all), &of(&all)));
        assert_eq!(ab.0[0].0[3], [(1, 7), (5, 5), (9, 1)]);
    }
}
