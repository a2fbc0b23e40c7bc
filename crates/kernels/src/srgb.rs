//! Decoding of sRGB (IEC 61966-2-1): from code values to linear light.

use std::sync::LazyLock;

/// Linear light of each 8-bit sRGB value: the exact formula in `f64`, rounded to `f32`.
pub static SRGB_TO_LINEAR: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|value| linear_of_srgb(value as f64 / 255.0) as f32));

/// Linear light of each 16-bit sRGB value.
pub fn linear_of_srgb16() -> &'static [f32] {
    static TABLE: LazyLock<Vec<f32>> =
        LazyLock::new(|| (0..=u16::MAX).map(|value| linear_of_srgb(f64::from(value) / 65535.0) as f32).collect());
    &TABLE
}

/// Linear light of a code value, both in 0 to 1.
pub fn linear_of_srgb(code: f64) -> f64 {
    // libm and not std: its bits are the same on every machine.
    if code <= 0.04045 { code / 12.92 } else { libm::pow((code + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_and_a_value_between_are_those_of_the_standard() {
        assert_eq!(SRGB_TO_LINEAR[0], 0.0);
        assert_eq!(SRGB_TO_LINEAR[255], 1.0);
        // 10 / 255 lies on the straight part, 188 / 255 is close to half the light.
        assert_eq!(SRGB_TO_LINEAR[10], (10.0 / 255.0 / 12.92) as f32);
        assert!((SRGB_TO_LINEAR[188] - 0.5029).abs() < 1e-4);
        assert!(SRGB_TO_LINEAR.windows(2).all(|pair| pair[0] < pair[1]));
    }

    /// 257 v / 65535 is v / 255: 16-bit pictures that only repeat 8 bits look the same.
    #[test]
    fn sixteen_bits_agree_with_eight() {
        for value in 0..256 {
            assert_eq!(linear_of_srgb16()[257 * value], SRGB_TO_LINEAR[value]);
        }
    }
}
