//! Sums that do not depend on their order: whole numbers of a least unit.
//!
//! Radiance is in units of the scene's brightest lamp or background ([`crate::Scene::radiance_unit`]), which is then
//! from 1 to 2, so that the window lies where the scene's numbers are:
//!
//! - a sum is a multiple of 2^-80 in 128 bits with its sign, below 2^47 that is: 2^20 samples of up to 2^26 = 6.7e7
//!   times the brightest;
//! - a sample of 2^-60 = 8.7e-19 of the brightest is rounded by 2^-21 of itself at most, so eighteen decimal orders
//!   below the brightest add up, and larger ones to all 24 bits of an `f32` from 2^-57 on;
//! - squares of the luminance, for the noise alone, are multiples of 2^-132 in 192 bits, below 2^60: 2^20 samples of up
//!   to 2^20 times the brightest (what is above counts as that), and 2^-60 of the brightest still to 12 bits.
//!
//! With more samples than 2^20 the mean must be lower for that: with 2^32, of which there are no more, 2^15 times the
//! brightest at most. No pixel shows that much; nothing asks for it, and sums would wrap.

use super::PIXELS;
use bytemuck::Zeroable;

/// Larger samples than this are not added: 2^26.
pub(super) const LARGEST: f32 = 67_108_864.0;
/// 2^80 and 2^-80.
const PER_ONE: f64 = 1_208_925_819_614_629_174_706_176.0;
pub(super) const LEAST: f64 = 1.0 / PER_ONE;

/// A number of at most [`LARGEST`] in least units, rounded to the nearest, ties to even.
#[inline(always)]
pub(super) fn fixed(x: f32) -> i128 {
    let bits = x.to_bits();
    // A normal number is its mantissa times 2^(exponent - 150).
    let shift = (bits >> 23 & 0xff) as i32 - 150 + 80;
    if shift < 0 {
        // Adding and taking away 1.5 * 2^52 rounds to a whole number.
        const WHOLE: f64 = 1.5 * 4_503_599_627_370_496.0;
        return i128::from((f64::from(x) * PER_ONE + WHOLE - WHOLE) as i64);
    }
    let size = i128::from(bits & 0x007f_ffff | 0x0080_0000) << (shift & 127);
    // All ones where it is negative: the complement and one.
    let sign = i128::from(bits as i32 >> 31);
    (size ^ sign) - sign
}

/// Exact sums of radiance per pixel of a tile.
#[derive(Clone, Debug, PartialEq, Zeroable)]
pub(super) struct Sums([[i128; 3]; PIXELS]);

impl Sums {
    /// Adds to a pixel.
    #[inline(always)]
    pub fn add(&mut self, pixel: usize, x: [i128; 3]) {
        for (sum, x) in self.0[pixel].iter_mut().zip(x) {
            *sum = sum.wrapping_add(x);
        }
    }

    /// Mean of a pixel over so many samples of two sums.
    #[inline]
    pub fn mean_with(&self, other: &Sums, pixel: usize, samples: u32) -> [f64; 3] {
        let n = f64::from(samples.max(1));
        let (one, other) = (&self.0[pixel], &other.0[pixel]);
        let mean = |c: usize| one[c].wrapping_add(other[c]) as f64 * LEAST / n;
        [mean(0), mean(1), mean(2)]
    }

    /// Mean of a pixel over so many samples.
    #[inline]
    pub fn mean(&self, pixel: usize, samples: impl Into<f64>) -> [f64; 3] {
        let n = match samples.into() {
            n if n > 0.0 => n,
            _ => 1.0,
        };
        // Written out: `map` is not always inlined.
        let mean = |c: usize| self.0[pixel][c] as f64 * LEAST / n;
        [mean(0), mean(1), mean(2)]
    }

    /// A sum, in least units.
    pub fn of(&self, channel: usize, pixel: usize) -> i128 {
        self.0[pixel][channel]
    }

    /// Makes it this one.
    pub fn set(&mut self, channel: usize, pixel: usize, sum: i128) {
        self.0[pixel][channel] = sum;
    }
}

/// Exact sums of squares per pixel of a tile: words of 64 bits, the lowest first.
#[derive(Clone, Debug, PartialEq, Zeroable)]
pub(super) struct Squares([[u64; 3]; PIXELS]);

impl Squares {
    /// Binary places behind the point.
    const PLACES: i32 = 132;
    /// 2^20: what is larger counts as this.
    const MOST: f64 = 1_048_576.0;

    /// Adds the square of a number.
    #[inline(always)]
    pub fn add(&mut self, pixel: usize, y: f64) {
        self.add_words(pixel, Self::square(y));
    }

    /// Takes the square of a number away that was added before.
    pub fn take(&mut self, pixel: usize, y: f64) {
        // The complement to two.
        self.add_words(pixel, Self::square(y).map(|word| !word));
        self.add_words(pixel, [1, 0, 0]);
    }

    /// The words of a square.
    #[inline(always)]
    fn square(y: f64) -> [u64; 3] {
        let y = y.abs().min(Self::MOST);
        let bits = (y * y).to_bits();
        // The square is mantissa * 2^(exponent - 1075); below the normal numbers it is far below the last place, like
        // zero.
        let (exponent, mantissa) = ((bits >> 52) as i32, bits & ((1 << 52) - 1) | 1 << 52);
        let shift = exponent - 1075 + Self::PLACES;
        if shift <= -53 {
            return [0; 3];
        }
        // No larger shift than 120 comes from MOST, so the lowest bit lies in one of the two lower words.
        let part = if shift < 0 { u128::from(mantissa >> -shift) } else { u128::from(mantissa) << (shift & 63) };
        let (low, high) = (part as u64, (part >> 64) as u64);
        if shift < 64 { [low, high, 0] } else { [0, low, high] }
    }

    /// Adds the sums of another.
    pub fn merge(&mut self, other: &Squares) {
        (0..PIXELS).for_each(|pixel| self.add_words(pixel, other.0[pixel]));
    }

    #[inline(always)]
    fn add_words(&mut self, pixel: usize, more: [u64; 3]) {
        let words = &mut self.0[pixel];
        let mut carry = 0;
        for (sum, more) in words.iter_mut().zip(more) {
            let whole = u128::from(*sum) + u128::from(more) + carry;
            *sum = whole as u64;
            carry = whole >> 64;
        }
    }

    /// The words of a pixel's sum, the lowest first.
    pub fn words(&self, pixel: usize) -> [u64; 3] {
        self.0[pixel]
    }

    /// Makes them these.
    pub fn set(&mut self, pixel: usize, words: [u64; 3]) {
        self.0[pixel] = words;
    }

    /// The sum of a pixel.
    pub fn of(&self, pixel: usize) -> f64 {
        const WORD: f64 = 18_446_744_073_709_551_616.0;
        let [low, middle, high] = self.0[pixel].map(|word| word as f64);
        // 2^-132 in two steps: 2^-64 twice and 2^-4.
        ((high * WORD + middle) * WORD + low) / WORD / WORD / 16.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_over_the_whole_window() {
        for k in 0..108 {
            let x = 1.999_999_9 * f32::from_bits((127 + 25 - k) << 23);
            for x in [x, -x] {
                let exact = f64::from(x);
                let back = fixed(x) as f64 * LEAST;
                assert!((back - exact).abs() <= 0.5 * LEAST, "{x}: {back}");
                // Eighteen orders below one there are 21 bits left, and all of them from 2^-57 on.
                if exact.abs() >= 2f64.powi(-57) {
                    assert_eq!(back, exact);
                } else if exact.abs() >= 1e-18 {
                    assert!((back - exact).abs() <= exact.abs() * 2f64.powi(-20));
                }
            }
        }
        assert_eq!((fixed(0.0), fixed(-0.0), fixed(1e-30)), (0, 0, 0));
    }

    #[test]
    fn the_most_samples_of_the_largest_kind_fit() {
        let all = fixed(LARGEST).checked_mul(1 << 20).expect("it fits");
        assert_eq!(all as f64 * LEAST, f64::from(LARGEST) * f64::from(1 << 20));
    }

    #[test]
    fn squares_add_up_in_any_order() {
        let numbers: Vec<f64> = (0..400).map(|k| 1.37f64.powi(k % 160 - 128) * f64::from(1 + k % 7)).collect();
        let (mut forwards, mut backwards) = (Squares::zeroed(), Squares::zeroed());
        numbers.iter().for_each(|&y| forwards.add(3, y));
        numbers.iter().rev().for_each(|&y| backwards.add(3, -y));
        assert_eq!(forwards, backwards);
        let expected: f64 = numbers.iter().map(|y| y * y).sum();
        assert!((forwards.of(3) / expected - 1.0).abs() < 1e-12, "{} {expected}", forwards.of(3));
        assert_eq!(forwards.of(4), 0.0);
    }

    #[test]
    fn squares_that_are_taken_are_gone() {
        let numbers: Vec<f64> = (-40..20).map(|k| 1.37 * 2f64.powi(k)).collect();
        let mut squares = Squares::zeroed();
        numbers.iter().for_each(|&y| squares.add(3, y));
        squares.add(3, 0.5);
        numbers.iter().rev().for_each(|&y| squares.take(3, y));
        assert_eq!(squares.of(3), 0.25);
        squares.take(3, 0.5);
        assert_eq!(squares.words(3), [0; 3]);
    }

    #[test]
    fn squares_of_all_sizes() {
        for k in -60..=20 {
            let y = 1.25 * 2f64.powi(k);
            let mut squares = Squares::zeroed();
            (0..1000).for_each(|_| squares.add(0, y));
            let expected = 1000.0 * y.min(1_048_576.0).powi(2);
            assert!((squares.of(0) / expected - 1.0).abs() < 1e-3, "2^{k}: {} {expected}", squares.of(0));
        }
        let mut squares = Squares::zeroed();
        squares.add(0, 0.0);
        squares.add(0, 1e-60);
        assert_eq!(squares.of(0), 0.0);
    }
}
