//! The sampler along its sequence: far out, and at its ends.

use tracer_core::lanes::{ArrayF, ArrayU, Bits, Lanes};
use tracer_core::sampling::sampler::unit;

/// Numbers stay below one, whatever the bits: ln(1 - u) and the last stratum depend on it.
#[test]
fn numbers_stay_below_one() {
    for bits in [u32::MAX, u32::MAX - 255, u32::MAX - 256, 1 << 31, 256, 255, 0] {
        let mut out = [0.0f32];
        unit::<ArrayF<1>>(ArrayU::splat(bits)).store(&mut out);
        assert_eq!(f64::from(out[0]), f64::from(bits >> 8) / 16_777_216.0, "{bits:#x}");
        assert!(out[0] < 1.0);
    }
}
