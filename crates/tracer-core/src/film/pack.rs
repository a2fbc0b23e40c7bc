//! Whole numbers of a tile in as few bits as they need.
//!
//! Sums have many zeros on both sides: below the last place of the smallest sample, above the first of the largest sum.
//! Pixels that lie together are alike, so of each group of 64 the least number is told, and of the others how far they
//! lie above it, by as many bits as the farthest needs. Where many are zero (light paths fall here and there) only
//! which, and the others.

use super::PIXELS;

/// Numbers that have one width. In Z-order they are a square of pixels.
const GROUP: usize = 64;
/// In the first byte of a group: eight bytes say which numbers are not zero, and only those are told.
const SPARSE: u8 = 128;

/// An unsigned number of 192 bits, the lowest word first.
type Wide = [u64; 3];

/// Which numbers to tell: of all 64 a bit each, and what to say of it. Zeros are left out where that saves bytes.
fn told(is_not_zero: u64, width: u32) -> (u64, u8) {
    if is_not_zero.count_zeros() * width > 64 { (is_not_zero, SPARSE) } else { (u64::MAX, 0) }
}

/// The numbers of the bits that are set.
fn ones(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let first = (bits != 0).then_some(bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        first
    })
}

/// Appends numbers with their signs.
pub(super) fn pack(numbers: impl Fn(usize) -> i128, out: &mut Vec<u8>) {
    for first in (0..PIXELS).step_by(GROUP) {
        let group: [i128; GROUP] = std::array::from_fn(|k| numbers(first + k));
        let (mut any, mut is_not_zero) = (0, 0);
        for (k, &number) in group.iter().enumerate() {
            any |= number;
            is_not_zero |= u64::from(number != 0) << k;
        }
        if any == 0 {
            out.push(0);
            continue;
        }
        let shift = any.trailing_zeros();
        let range = |of: u64| {
            let (mut least, mut most) = (i128::MAX, i128::MIN);
            for k in ones(of) {
                (least, most) = (least.min(group[k]), most.max(group[k]));
            }
            (least, 128 - (most.wrapping_sub(least) as u128 >> shift).leading_zeros())
        };
        let (least, width) = range(u64::MAX);
        let (told, sparse) = told(is_not_zero, width);
        let (least, width) = if sparse == 0 { (least, width) } else { range(told) };
        let base = least >> shift;
        // As many bytes of it as tell its sign, too.
        let bytes = (136 - base.leading_zeros().max(base.leading_ones())) / 8;
        out.extend([sparse | (1 + bytes as u8), shift as u8, width as u8]);
        if sparse != 0 {
            out.extend(told.to_le_bytes());
        }
        out.extend(&base.to_le_bytes()[..bytes as usize]);
        let mut bits = BitWriter::new(out);
        for k in ones(told) {
            let above = group[k].wrapping_sub(least) as u128 >> shift;
            bits.push(above as u64, width.min(64));
            if width > 64 {
                bits.push((above >> 64) as u64, width - 64);
            }
        }
    }
}

/// Appends numbers without signs.
pub(super) fn pack_wide(numbers: impl Fn(usize) -> Wide, out: &mut Vec<u8>) {
    for first in (0..PIXELS).step_by(GROUP) {
        let (mut any, mut is_not_zero) = ([0; 3], 0);
        for k in 0..GROUP {
            let number = numbers(first + k);
            is_not_zero |= u64::from(number != [0; 3]) << k;
            any = std::array::from_fn(|word| any[word] | number[word]);
        }
        let Some(low) = (0..3).find(|&k| any[k] != 0) else {
            out.push(0);
            continue;
        };
        let high = (0..3).rfind(|&k| any[k] != 0).unwrap_or(low);
        let shift = 64 * low as u32 + any[low].trailing_zeros();
        let width = 64 * (high as u32 + 1) - any[high].leading_zeros() - shift;
        let (told, sparse) = told(is_not_zero, width);
        out.extend([sparse | 1, shift as u8, width as u8]);
        if sparse != 0 {
            out.extend(told.to_le_bytes());
        }
        let mut bits = BitWriter::new(out);
        for k in ones(told) {
            let number = shifted_down(numbers(first + k), shift);
            bits.push(number[0], width.min(64));
            for word in 1..width.div_ceil(64) {
                bits.push(number[word as usize], (width - 64 * word).min(64));
            }
        }
    }
}

fn shifted_down(number: Wide, shift: u32) -> Wide {
    let (words, bits) = ((shift / 64) as usize, shift % 64);
    let word = |k: usize| number.get(k + words).copied().unwrap_or(0);
    std::array::from_fn(|k| (u128::from(word(k)) | u128::from(word(k + 1)) << 64).wrapping_shr(bits) as u64)
}

fn shifted_up(number: Wide, shift: u32) -> Wide {
    let (words, bits) = ((shift / 64) as usize, shift % 64);
    let word = |k: usize| k.checked_sub(words).map_or(0, |k| number[k]);
    let below = |k: usize| k.checked_sub(1).map_or(0, word);
    std::array::from_fn(|k| ((u128::from(word(k)) << 64 | u128::from(below(k))) << bits >> 64) as u64)
}

/// The head of a group: its first byte without [`SPARSE`], shift, width, and which numbers are told; zero where none
/// is.
fn head(from: &mut &[u8]) -> Option<(u8, u32, u32, u64)> {
    let first = *from.split_off_first()?;
    if first == 0 {
        return Some((0, 0, 0, 0));
    }
    let [shift, width] = [from.split_off_first()?, from.split_off_first()?].map(|&byte| u32::from(byte));
    let told = if first & SPARSE == 0 { u64::MAX } else { u64::from_le_bytes(from.split_off(..8)?.try_into().ok()?) };
    Some((first & !SPARSE, shift, width, told))
}

/// Reads what [`pack`] has written; `None` where that is not what there is.
pub(super) fn unpack(from: &mut &[u8], mut keep: impl FnMut(usize, i128)) -> Option<()> {
    for first in (0..PIXELS).step_by(GROUP) {
        let (kind, shift, width, told) = head(from)?;
        let Some(bytes) = usize::from(kind).checked_sub(1) else { continue };
        if !(1..=16).contains(&bytes) || shift > 127 || width > 128 - shift {
            return None;
        }
        let mut base = [0; 16];
        base[..bytes].copy_from_slice(from.split_off(..bytes)?);
        let unused = 128 - 8 * bytes as u32;
        let base = i128::from_le_bytes(base) << unused >> unused;
        let mut bits = BitReader::new(from, told.count_ones(), width)?;
        for k in ones(told) {
            let above = u128::from(bits.take(width.min(64))) | u128::from(bits.take(width.saturating_sub(64))) << 64;
            keep(first + k, base.wrapping_add(above as i128) << shift);
        }
    }
    Some(())
}

/// Reads what [`pack_wide`] has written; `None` where that is not what there is.
pub(super) fn unpack_wide(from: &mut &[u8], mut keep: impl FnMut(usize, Wide)) -> Option<()> {
    for first in (0..PIXELS).step_by(GROUP) {
        let (kind, shift, width, told) = head(from)?;
        if kind == 0 {
            continue;
        }
        if kind != 1 || width > 192 || shift > 192 - width {
            return None;
        }
        let mut bits = BitReader::new(from, told.count_ones(), width)?;
        for k in ones(told) {
            let number = [0, 1, 2].map(|k| bits.take(width.saturating_sub(64 * k).min(64)));
            keep(first + k, shifted_up(number, shift));
        }
    }
    Some(())
}

/// Bits one after the other, the lowest first; a group's are whole bytes.
struct BitWriter<'a> {
    out: &'a mut Vec<u8>,
    held: u128,
    count: u32,
}

impl<'a> BitWriter<'a> {
    fn new(out: &'a mut Vec<u8>) -> Self {
        BitWriter { out, held: 0, count: 0 }
    }

    /// The lowest `width` bits of a word; the others are zero.
    #[inline(always)]
    fn push(&mut self, word: u64, width: u32) {
        // Of a width below 64 nothing is above; one of 64 takes all.
        let word = if width == 64 { word } else { word & ((1 << width) - 1) };
        self.held |= u128::from(word) << self.count;
        self.count += width;
        if self.count >= 64 {
            self.out.extend((self.held as u64).to_le_bytes());
            self.held >>= 64;
            self.count -= 64;
        }
    }
}

impl Drop for BitWriter<'_> {
    fn drop(&mut self) {
        let bytes = self.count.div_ceil(8) as usize;
        self.out.extend(&(self.held as u64).to_le_bytes()[..bytes]);
    }
}

struct BitReader<'a> {
    from: &'a [u8],
    held: u128,
    count: u32,
}

impl<'a> BitReader<'a> {
    /// Over so many numbers of this width, which it takes off the front; `None` where there are too few bytes.
    fn new(from: &mut &'a [u8], count: u32, width: u32) -> Option<Self> {
        let bytes = (count * width).div_ceil(8) as usize;
        Some(BitReader { from: from.split_off(..bytes)?, held: 0, count: 0 })
    }

    /// The next `width` bits, 64 at most.
    #[inline(always)]
    fn take(&mut self, width: u32) -> u64 {
        if self.count < width {
            let mut word = [0; 8];
            let bytes = self.from.len().min(8);
            let (now, later) = self.from.split_at(bytes);
            word[..bytes].copy_from_slice(now);
            self.from = later;
            self.held |= u128::from(u64::from_le_bytes(word)) << self.count;
            self.count += 64;
        }
        let word = self.held as u64;
        self.held >>= width;
        self.count -= width;
        if width == 64 { word } else { word & ((1 << width) - 1) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn comes_back(numbers: &[i128; PIXELS]) -> usize {
        let mut bytes = Vec::new();
        pack(|k| numbers[k], &mut bytes);
        let (mut back, mut rest) = ([0; PIXELS], &bytes[..]);
        unpack(&mut rest, |k, number| back[k] = number).expect("what was packed");
        assert!(rest.is_empty());
        assert_eq!(&back, numbers);
        for len in 0..bytes.len() {
            assert_eq!(unpack(&mut &bytes[..len], |_, _| ()), None);
        }
        bytes.len()
    }

    #[test]
    fn sums_come_back() {
        assert_eq!(comes_back(&[0; PIXELS]), 4);
        assert_eq!(comes_back(&[-5 << 70; PIXELS]), 4 * 4);
        assert_eq!(comes_back(&[i128::MIN; PIXELS]), 4 * 4);
        comes_back(&std::array::from_fn(|k| if k % 2 == 0 { i128::MIN } else { i128::MAX }));
        for shift in 0..127 {
            comes_back(&std::array::from_fn(|k| (k as i128 * 0x1234_5678_9abc_def1 - (99 << 60)) << shift));
            comes_back(&std::array::from_fn(|k| if k == 77 { 1 << shift } else { -1 }));
            assert!(comes_back(&std::array::from_fn(|k| if k == 77 { -3 << shift } else { 0 })) <= 3 + 13);
            comes_back(&std::array::from_fn(|k| if k % 5 == 0 { (k as i128 - 99) << shift.min(119) } else { 0 }));
        }
        // Forty bits of each, and a few to say so.
        let h = |k: usize| (k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 24;
        assert_eq!(comes_back(&std::array::from_fn(|k| i128::from(h(k) | 1) << 40)) / PIXELS, 5);
    }

    #[test]
    fn squares_come_back() {
        for shift in 0..192 {
            for number in [[1, 0, 0], [u64::MAX, 3, 0], [0x1234_5678_9abc_def0; 3]] {
                let numbers: [Wide; PIXELS] =
                    std::array::from_fn(|k| shifted_up(number.map(|word: u64| word.wrapping_mul(k as u64 | 1)), shift));
                let mut bytes = Vec::new();
                pack_wide(|k| numbers[k], &mut bytes);
                let (mut back, mut rest) = ([[0; 3]; PIXELS], &bytes[..]);
                unpack_wide(&mut rest, |k, number| back[k] = number).expect("what was packed");
                assert!(rest.is_empty());
                assert_eq!(back, numbers);
                assert_eq!(unpack_wide(&mut &bytes[..bytes.len() - 1], |_, _| ()), None);
            }
        }
        let mut bytes = Vec::new();
        pack_wide(|_| [0; 3], &mut bytes);
        assert_eq!(bytes, [0; 4]);
    }
}
