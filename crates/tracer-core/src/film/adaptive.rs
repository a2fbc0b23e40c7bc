//! Adaptive sampling: which tiles take which sample indices.
//!
//! From [`FROM`] on a tile that rests takes the first half, quarter or eighth of the indices from each power of two to
//! the next, the others all. Such a run of indices is a net of the sampler, as all of them are, and has one guide; and
//! where a rendering ends makes no difference to which it takes. Light paths count for a tile at the indices that it
//! takes, and at no others: they are weighed against the paths of the same guide.
//!
//! Which tiles rest is told by pictures with other seeds, which are not shown ([`crate::engine`]): were it told by the
//! samples themselves, a tile that has not met its few bright ones yet would rest, and be too dark.

use super::halves::half_of;
use super::{Film, TILE, Tile};
use std::ops::Range;
use std::sync::Arc;
use tracer_kernels::sampling::blocks::{Block, tile_of};

/// Before this index all tiles take all; a power of two.
pub(crate) const FROM: u32 = 64;

/// A tile takes one in 2^3 of the indices at least.
pub(crate) const MOST: u32 = 3;

/// How much the tiles of a picture rest: each takes one in 2^k of the sample indices from [`FROM`] on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Adaptive {
    /// Tiles beside each other, and below each other.
    size: [u32; 2],
    /// k, row by row, of the whole picture.
    rests: Vec<u8>,
}

/// From which power of two on an index counts, and how far it is from there.
fn octave(sample: u32) -> (u64, u64) {
    let top = 1 << sample.max(1).ilog2();
    (top, u64::from(sample) - top)
}

/// Whether a tile that rests so much takes a sample index.
#[inline]
pub(crate) fn takes(rest: u32, sample: u32) -> bool {
    if rest == 0 || sample < FROM {
        return true;
    }
    let (top, offset) = octave(sample);
    offset << rest < top
}

/// How many of the indices before this one it takes.
pub(crate) fn taken(rest: u32, end: u32) -> u32 {
    if rest == 0 || end <= FROM {
        return end;
    }
    let (top, offset) = octave(end);
    let (top, offset) = (top as u32, offset as u32);
    FROM + ((top - FROM) >> rest) + offset.min(top >> rest)
}

/// The half of its samples that an index which it takes is of: of those from a power of two to the next the lower half
/// is of the first.
pub(crate) fn half_of_taken(rest: u32, sample: u32) -> usize {
    if rest == 0 || sample < FROM {
        return half_of(sample);
    }
    let (top, offset) = octave(sample);
    usize::from(offset << (rest + 1) >= top)
}

/// How many of these indices it takes, and of the second half.
pub(crate) fn second_taken(rest: u32, samples: Range<u32>) -> u32 {
    let below = |end: u32| {
        let even = super::halves::second_of(0..end.min(FROM));
        if end <= FROM || rest == 0 {
            return if rest == 0 { super::halves::second_of(0..end) } else { even };
        }
        let (top, offset) = octave(end);
        let (top, offset) = (top as u32, offset as u32);
        let half = top >> (rest + 1);
        even + ((top - FROM) >> (rest + 1)) + offset.min(top >> rest).saturating_sub(half)
    };
    below(samples.end).saturating_sub(below(samples.start))
}

/// The first index behind this one at which a tile may begin to rest, or to take, or come to its other half.
pub(crate) fn run_end(sample: u32) -> u32 {
    if sample < FROM {
        return super::half_end(sample).min(FROM);
    }
    let (top, offset) = octave(sample);
    let ends = (0..=MOST + 1).rev().map(|k| top >> k);
    let end = ends.into_iter().find(|&end| end > offset).unwrap_or(top);
    u32::try_from(top + end).unwrap_or(u32::MAX)
}

impl Adaptive {
    /// Of a picture of this size, with a number for each tile, row by row.
    pub fn new(size: [u32; 2], rests: Vec<u8>) -> Option<Self> {
        let size = size.map(|side| side.div_ceil(TILE));
        let fits = rests.len() == size[0] as usize * size[1] as usize;
        (fits && rests.iter().all(|&rest| u32::from(rest) <= MOST)).then_some(Adaptive { size, rests })
    }

    /// Where no tile rests.
    pub fn even(size: [u32; 2]) -> Self {
        let size = size.map(|side| side.div_ceil(TILE));
        Adaptive { size, rests: vec![0; size[0] as usize * size[1] as usize] }
    }

    /// Whether no tile rests.
    pub fn is_even(&self) -> bool {
        self.rests.iter().all(|&rest| rest == 0)
    }

    /// How much the tile in this column and row rests.
    pub fn rest(&self, [column, row]: [u32; 2]) -> u32 {
        u32::from(self.rests[(row * self.size[0] + column) as usize])
    }

    /// Which of the tiles that a block may touch take no sample at this index: a bit for each ([`tile_of`]); `None`
    /// where none in the picture takes one.
    pub fn resting(&self, block: Block, sample: u32) -> Option<u8> {
        let (mut resting, mut awake) = (0, false);
        for row in block.tiles(1) {
            for column in block.tiles(0) {
                let within = |at: i32, size: u32| u32::try_from(at).ok().filter(|&at| at < size);
                let (Some(column), Some(row)) = (within(column, self.size[0]), within(row, self.size[1])) else {
                    continue;
                };
                let takes = takes(self.rest([column, row]), sample);
                awake |= takes;
                resting |= u8::from(!takes) << tile_of(column, row);
            }
        }
        awake.then_some(resting)
    }

    /// As the head of a saved film has it: four tiles in a byte.
    pub fn to_bytes(&self) -> Vec<u8> {
        let byte = |four: &[u8]| four.iter().zip(0..).map(|(rest, k)| rest << (2 * k)).sum();
        self.rests.chunks(4).map(byte).collect()
    }

    /// Back again, of a picture of this size.
    pub fn from_bytes(size: [u32; 2], bytes: &[u8]) -> Option<Self> {
        let size = size.map(|side| side.div_ceil(TILE));
        // A size that lies takes no memory.
        let count = u64::from(size[0]) * u64::from(size[1]);
        if count.div_ceil(4) != bytes.len() as u64 {
            return None;
        }
        let rests = (0..count as usize).map(|k| bytes[k / 4] >> (2 * (k % 4)) & 3).collect();
        let read = Adaptive { size, rests };
        (read.to_bytes() == bytes).then_some(read)
    }
}

impl Tile {
    /// Whether it takes samples of this index.
    #[inline]
    pub(crate) fn takes(&self, sample: u32) -> bool {
        takes(self.rest, sample)
    }

    /// The half of its samples that one of this index is of.
    #[inline]
    pub(crate) fn half_of(&self, sample: u32) -> usize {
        half_of_taken(self.rest, sample)
    }
}

impl Film {
    /// Which tiles rest; `None` where that was not decided: there are too few samples, or it was not asked for.
    pub(crate) fn adaptive(&self) -> Option<&Arc<Adaptive>> {
        self.adaptive.as_ref()
    }

    /// From here on its tiles rest as is said.
    pub(crate) fn keep_adaptive(&mut self, adaptive: Option<Arc<Adaptive>>) {
        if let Some(adaptive) = &adaptive {
            let ([left, top], columns) = (self.first_tile, self.tile_columns);
            for (place, tile) in (0..).zip(&mut self.tiles) {
                tile.rest = adaptive.rest([left + place % columns, top + place / columns]);
            }
        }
        self.adaptive = adaptive;
    }

    /// Whether tiles rest: quiet ones have fewer samples than the others ([`crate::RenderOptions::adaptive`]).
    pub fn is_adaptive(&self) -> bool {
        self.adaptive.as_ref().is_some_and(|adaptive| !adaptive.is_even())
    }

    /// Samples of all its pixels together when the rendering has got to an index.
    pub(crate) fn samples_until(&self, end: u32) -> u64 {
        let first = self.first();
        let of_pixel = |(x, y): (u32, u32)| {
            let rest = self.place(x, y).0.rest;
            u64::from(taken(rest, end).saturating_sub(taken(rest, first)))
        };
        self.pixels().map(of_pixel).sum()
    }

    /// How many sample indices' light paths count for a tile.
    #[inline(always)] // Developing asks it once a pixel.
    pub(super) fn light_of(&self, tile: &Tile) -> f64 {
        if tile.rest == 0 {
            return self.light_count();
        }
        f64::from(taken(tile.rest, self.light_samples).saturating_sub(taken(tile.rest, self.first())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is counted is what is taken, and so are halves; a run has one of each.
    #[test]
    fn indices_are_counted_as_they_are_taken() {
        for rest in 0..=MOST {
            let (mut count, mut second) = (0, 0);
            for sample in 0..3000 {
                assert_eq!((taken(rest, sample), second_taken(rest, 0..sample)), (count, second), "{rest} {sample}");
                if takes(rest, sample) {
                    count += 1;
                    second += half_of_taken(rest, sample) as u32;
                }
                let state = |at: u32| (takes(rest, at), takes(rest, at).then(|| half_of_taken(rest, at)));
                let end = run_end(sample);
                assert!(end > sample && (sample..end).all(|at| state(at) == state(sample)), "{rest} {sample} {end}");
            }
            for power in 6..31 {
                let end = 1 << power;
                assert_eq!(taken(rest, end), FROM + ((end - FROM) >> rest));
                assert_eq!(2 * second_taken(rest, 0..end), taken(rest, end), "halves are equal");
            }
        }
        assert!(run_end(u32::MAX - 1) > u32::MAX - 1 && takes(0, u32::MAX) && !takes(1, u32::MAX));
    }

    #[test]
    fn a_picture_is_read_as_it_is_written() {
        let size = [100, 33];
        let adaptive = Adaptive::new(size, (0..21).map(|k| (k * 7 % 4) as u8).collect()).expect("7 by 3 tiles");
        let bytes = adaptive.to_bytes();
        assert_eq!(Adaptive::from_bytes(size, &bytes).as_ref(), Some(&adaptive));
        assert_eq!(Adaptive::from_bytes([100, 49], &bytes), None);
        assert_eq!(Adaptive::from_bytes([16, 16], &bytes), None);
        assert_eq!(Adaptive::new(size, vec![0; 20]), None);
        assert_eq!(Adaptive::new(size, vec![4; 21]), None);
        assert!(Adaptive::even(size).is_even() && !adaptive.is_even());
    }

    /// A block is left out where all its tiles in the picture rest.
    #[test]
    fn blocks_rest_where_their_tiles_do() {
        use tracer_kernels::sampling::blocks::Cut;
        let adaptive = Adaptive::new([48, 32], vec![0, 3, 3, 3, 3, 3]).expect("3 by 2 tiles");
        let block = |tile: [i32; 2]| Block { tile, cut: Cut::Ragged { salt: 1, shift: [0; 2] } };
        assert_eq!(adaptive.resting(block([0, 0]), 127), Some(0));
        assert_eq!(adaptive.resting(block([1, 1]), 127), Some(0b1110));
        assert_eq!(adaptive.resting(block([2, 0]), 127), None);
        assert_eq!(adaptive.resting(block([2, 0]), 64), Some(0));
        assert_eq!(adaptive.resting(Block::straight([1, 0]), 127), None);
    }
}
