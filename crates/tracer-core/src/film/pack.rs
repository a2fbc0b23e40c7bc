//! Whole numbers of a tile in as few bits as they need.
//!
//! Sums have many zeros on both sides: below the last place of the smallest sample, above the first of the largest sum.
//! Pixels that lie together are alike, so of each group of 64 the least number is told, and of the others how far they
//! lie above it, by as many bits as the farthest needs.

use super::PIXELS;

/// Numbers that have one width. In Z-order they are a square of pixels.
const GROUP: usize = 64;

/// An unsigned number of 192 bits, the lowest word first.
type Wide = [u64; 3];

/// Appends numbers with their signs.
pub(super) fn pack(numbers: impl Fn(usize) -> i128, out: &mut Vec<u8>) {
    for first in (0..PIXELS).step_by(GROUP) {
        let group: [i128; GROUP] = std::array::from_fn(|k| numbers(first + k));
        let (mut any, mut least, mut most) = (0, group[0], group[0]);
        for &number in &group {
            any |= number;
            least = least.min(number);
            most = most.max(number);
        }
        if any == 0 {
            out.push(0);
            continue;
        }
        let shift = any.trailing_zeros();
        let width = 128 - (most.wrapping_sub(least) as u128 >> shift).leading_zeros();
        let base = least >> shift;
        // As many bytes of it as tell its sign, too.
        let bytes = (136 - base.leading_zeros().max(base.leading_ones())) / 8;
        out.extend([1 + bytes as u8, shift as u8, width as u8]);
        out.extend(&base.to_le_bytes()[..bytes as usize]);
        let mut bits = BitWriter::new(out);
        for &number in &group {
            let above = number.wrapping_sub(least) as u128 >> shift;
            bits.push(above as u64, width.min(64));
            bits.push((above >> 64) as u64, width.saturating_sub(64));
        }
    }
}

/// Appends numbers without signs.
pub(super) fn pack_wide(numbers: impl Fn(usize) -> Wide, out: &mut Vec<u8>) {
    for first in (0..PIXELS).step_by(GROUP) {
        let any = (first..first + GROUP)
            .map(&numbers)
            .fold([0; 3], |any: Wide, number| std::array::from_fn(|k| any[k] | number[k]));
        let Some(low) = (0..3).find(|&k| any[k] != 0) else {
            out.push(0);
            continue;
        };
        let high = (0..3).rfind(|&k| any[k] != 0).unwrap_or(low);
        let shift = 64 * low as u32 + any[low].trailing_zeros();
        let width = 64 * (high as u32 + 1) - any[high].leading_zeros() - shift;
        out.extend([1, shift as u8, width as u8]);
        let mut bits = BitWriter::new(out);
        for number in (first..first + GROUP).map(&numbers) {
            let number = shifted_down(number, shift);
            for (k, word) in number.into_iter().enumerate() {
                bits.push(word, width.saturating_sub(64 * k as u32).min(64));
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

/// Reads what [`pack`] has written; `None` where that is not what there is.
pub(super) fn unpack(from: &mut &[u8], mut keep: impl FnMut(usize, i128)) -> Option<()> {
    for first in (0..PIXELS).step_by(GROUP) {
        let Some(bytes) = usize::from(from.split_off_first().copied()?).checked_sub(1) else { continue };
        let [shift, width] = [from.split_off_first()?, from.split_off_first()?].map(|&byte| u32::from(byte));
        if !(1..=16).contains(&bytes) || shift > 127 || width > 128 - shift {
            return None;
        }
        let mut base = [0; 16];
        base[..bytes].copy_from_slice(from.split_off(..bytes)?);
        let unused = 128 - 8 * bytes as u32;
        let base = i128::from_le_bytes(base) << unused >> unused;
        let mut bits = BitReader::new(from, width)?;
        for k in 0..GROUP {
            let above = u128::from(bits.take(width.min(64))) | u128::from(bits.take(width.saturating_sub(64))) << 64;
            keep(first + k, base.wrapping_add(above as i128) << shift);
        }
    }
    Some(())
}

/// Reads what [`pack_wide`] has written; `None` where that is not what there is.
pub(super) fn unpack_wide(from: &mut &[u8], mut keep: impl FnMut(usize, Wide)) -> Option<()> {
    for first in (0..PIXELS).step_by(GROUP) {
        match from.split_off_first()? {
            0 => continue,
            1 => {}
            _ => return None,
        }
        let [shift, width] = [from.split_off_first()?, from.split_off_first()?].map(|&byte| u32::from(byte));
        if width > 192 || shift > 192 - width {
            return None;
        }
        let mut bits = BitReader::new(from, width)?;
        for k in 0..GROUP {
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
    /// Over a group of numbers of this width, which it takes off the front; `None` where there are too few bytes.
    fn new(from: &mut &'a [u8], width: u32) -> Option<Self> {
        let bytes = GROUP * width as usize / 8;
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
