//! sRGB code values (IEC 61966-2-1), exactly and fast.

use std::sync::LazyLock;

/// sRGB code value of linear light, both in 0..=1.
pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= LARGEST_OF_LINE { 12.92 * linear } else { 1.055 * libm::pow(linear, EXPONENT) - 0.055 }
}

/// Linear light of an sRGB code value, both in 0..=1: the inverse of [`srgb_encode`].
pub fn srgb_decode(code: f64) -> f64 {
    if code <= 12.92 * LARGEST_OF_LINE { code / 12.92 } else { libm::pow((code + 0.055) / 1.055, 2.4) }
}

/// Up to here the curve is a line.
const LARGEST_OF_LINE: f64 = 0.003_130_8;
const EXPONENT: f64 = 1.0 / 2.4;

/// [`srgb_encode`] in single precision, the same bits as rounding its value, for a tenth of the time.
///
/// With x = 2^e m and c the middle of the 32nd part of 1..2 that m is in, x^a = 2^(e a) c^a (1 + r)^a, r = m / c - 1:
/// two look-ups and the binomial series. |r| <= 1/65, so the series' terms from r^6 on come to less than 0.0227 / 65^6
/// / (1 - 1/65) = 3.1e-13 of the value; rounding and the tables add some 1e-16. So the value and what `libm` gives lie
/// within [`MARGIN`] of each other, and where both ends of that margin round to the same number, `libm`'s does, too.
/// Elsewhere, for one number in ten thousand, `libm` is asked.
pub(super) struct Encoder {
    /// 1 / c.
    inverse: [f64; PARTS],
    /// c^a.
    power: [f64; PARTS],
    /// 2^(e a) for e = k - 9.
    octave: [f64; OCTAVES],
}

const PARTS: usize = 32;
/// Numbers above the line's largest are at least 2^-9; the rest of the table makes it a power of two long.
const OCTAVES: usize = 16;
const LOWEST: u64 = 1023 - 9;
/// Three times 1.055 * 3.1e-13 and the roundings.
const MARGIN: f64 = 1e-12;

/// The tables, made once.
pub(super) static ENCODER: LazyLock<Encoder> = LazyLock::new(|| {
    let inverse: [f64; PARTS] = std::array::from_fn(|part| 1.0 / (1.0 + (part as f64 + 0.5) / PARTS as f64));
    Encoder {
        inverse,
        power: inverse.map(|inverse| libm::pow(1.0 / inverse, EXPONENT)),
        octave: std::array::from_fn(|k| libm::exp2((k as f64 - 9.0) * EXPONENT)),
    }
});

impl Encoder {
    /// `srgb_encode(linear) as f32`.
    #[inline]
    pub(super) fn encode(&self, linear: f64) -> f32 {
        if !(linear > LARGEST_OF_LINE && linear <= 1.0) {
            return srgb_encode(linear) as f32;
        }
        let value = self.estimate(linear);
        let (low, high) = ((value - MARGIN) as f32, (value + MARGIN) as f32);
        if low == high { low } else { srgb_encode(linear) as f32 }
    }

    /// Within [`MARGIN`] of [`srgb_encode`]; above the line, up to 1.
    #[inline]
    fn estimate(&self, linear: f64) -> f64 {
        const A: f64 = EXPONENT;
        const C2: f64 = A * (A - 1.0) / 2.0;
        const C3: f64 = C2 * (A - 2.0) / 3.0;
        const C4: f64 = C3 * (A - 3.0) / 4.0;
        const C5: f64 = C4 * (A - 4.0) / 5.0;
        let bits = linear.to_bits();
        let part = (bits >> 47) as usize % PARTS;
        let octave = ((bits >> 52) - LOWEST) as usize % OCTAVES;
        let mantissa = f64::from_bits(bits & ((1 << 52) - 1) | 1.0f64.to_bits());
        let r = mantissa * self.inverse[part] - 1.0;
        let series = 1.0 + r * (A + r * (C2 + r * (C3 + r * (C4 + r * C5))));
        1.055 * (self.octave[octave] * self.power[part] * series) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_of_known_values() {
        assert_eq!(srgb_encode(0.0), 0.0);
        assert!((srgb_encode(1.0) - 1.0).abs() < 1e-12);
        // 18 % grey is code value 118 of 255.
        assert_eq!((srgb_encode(0.18) * 255.0).round(), 118.0);
        assert!((srgb_encode(0.003_130_8) - 0.003_130_8 * 12.92).abs() < 1e-6);
        for k in 0..=1000 {
            let x = f64::from(k) / 1000.0;
            assert!(
                (srgb_encode(srgb_decode(x)) - x).abs() < 1e-6 && (srgb_decode(srgb_encode(x)) - x).abs() < 1e-6,
                "{x}"
            );
        }
    }

    /// Numbers in 0..=1: all ends of the table's parts with their neighbours, and a million in between, as many in each
    /// octave.
    fn numbers() -> impl Iterator<Item = f64> {
        let ends = (0..=10 * PARTS as u64).flat_map(|k| {
            let end = ((LOWEST << 52) + (k << 47)).cast_signed();
            (-2..=2).map(move |step| f64::from_bits((end + step).cast_unsigned()))
        });
        let between = (0..1_000_000u64).map(|k| {
            let mantissa = k.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 12;
            f64::from_bits((LOWEST - 1 + k % 10) << 52 | mantissa)
        });
        let line = [0.0, LARGEST_OF_LINE, LARGEST_OF_LINE.next_up(), 1.0f64.next_down(), 1.0];
        ends.chain(between).chain(line).filter(|x| *x <= 1.0)
    }

    /// 1.055 times the series' rest (see [`Encoder`]) is 3.3e-13; a dozen roundings of half of 2^-52 make it 3.4e-13.
    #[test]
    fn the_estimate_keeps_well_within_its_margin() {
        for x in numbers().filter(|&x| x > LARGEST_OF_LINE) {
            let (estimate, exact) = (ENCODER.estimate(x), srgb_encode(x));
            assert!((estimate - exact).abs() < 3.4e-13, "{x}: {estimate} {exact}");
        }
    }

    #[test]
    fn fast_code_values_are_those_of_libm() {
        for x in numbers().chain([f64::NAN, -1.0, 1.5, f64::INFINITY]) {
            assert_eq!(ENCODER.encode(x).to_bits(), (srgb_encode(x) as f32).to_bits(), "{x}");
        }
    }

    /// Where the margin holds the middle between two numbers, `libm` decides. The light of such middles is met to a
    /// rounding, which moves the code value by 1e-16, so all but a few of them are near enough.
    #[test]
    fn midpoints_are_decided_by_libm() {
        let mut asked = 0;
        for k in 0..20_000u32 {
            let below = f32::from_bits(0x3d80_0000 + k.wrapping_mul(0x0000_0d11) % 0x0200_0000);
            let middle = 0.5 * (f64::from(below) + f64::from(below.next_up()));
            let linear = libm::pow((middle + 0.055) / 1.055, 2.4);
            let value = ENCODER.estimate(linear);
            asked += u32::from((value - MARGIN) as f32 != (value + MARGIN) as f32);
            assert_eq!(ENCODER.encode(linear).to_bits(), (srgb_encode(linear) as f32).to_bits(), "{linear}");
        }
        assert!(asked > 19_000, "only {asked} were near a midpoint");
    }
}
