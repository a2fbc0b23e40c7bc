//! Curves from exposed radiance to display values in 0..=1 (linear, before sRGB encoding).

/// A filmic curve per channel: the fit of the ACES reference tone curve by Narkowicz (2015), at 0.6 of
/// the exposure, which is how the reference shows it; highlights roll off.
pub fn filmic(rgb: [f64; 3]) -> [f64; 3] {
    rgb.map(|x| {
        let x = x.max(0.0) * 0.6;
        ((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)).clamp(0.0, 1.0)
    })
}

/// An AgX-like curve (after Troy Sobotka's AgX, in the polynomial form of Benjamin Wrensch, 2023): the channels are
/// mixed a little before a sigmoid over the logarithm, so that bright saturated colours go to white instead of to a
/// primary.
pub fn agx(rgb: [f64; 3]) -> [f64; 3] {
    const IN: [[f64; 3]; 3] = [
        [0.842_479_062_253_094, 0.078_433_599_999_999_2, 0.079_223_745_147_764_3],
        [0.042_328_242_261_012_1, 0.878_468_636_469_772, 0.079_166_127_460_543_9],
        [0.042_375_654_905_705_1, 0.078_433_6, 0.879_142_973_793_104],
    ];
    const OUT: [[f64; 3]; 3] = [
        [1.196_879_005_120_17, -0.098_020_881_140_136_8, -0.099_029_744_079_720_5],
        [-0.052_896_851_757_456_2, 1.151_903_129_904_17, -0.098_961_176_844_843_3],
        [-0.052_971_635_514_443_8, -0.098_043_450_117_124_1, 1.151_073_672_641_16],
    ];
    const LOW: f64 = -12.473_93;
    const HIGH: f64 = 4.026_069;
    let mixed = multiply(IN, rgb.map(|x| x.max(0.0)));
    let curved = mixed.map(|x| {
        let stops = libm::log2(x.max(1e-10)).clamp(LOW, HIGH);
        let t = (stops - LOW) / (HIGH - LOW);
        let t2 = t * t;
        let t4 = t2 * t2;
        15.5 * t4 * t2 - 40.14 * t4 * t + 31.96 * t4 - 6.868 * t2 * t + 0.4298 * t2 + 0.1191 * t - 0.002_32
    });
    // The curve gives display-encoded values of exponent 2.2; the picture is encoded to sRGB afterwards.
    multiply(OUT, curved).map(|x| libm::pow(x.clamp(0.0, 1.0), 2.2))
}

fn multiply(m: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|row: usize| m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both rise with the light and stay within 0..=1; a neutral stays neutral (within the rounding of AgX's matrices).
    #[test]
    fn curves_rise_and_keep_greys_grey() {
        for curve in [filmic, agx] {
            let mut before = -1.0;
            for k in 0..200 {
                let x = 1e-4 * libm::exp2(f64::from(k) * 0.1);
                let rgb = curve([x; 3]);
                assert!(rgb.iter().all(|c| (0.0..=1.0).contains(c)));
                assert!(rgb[1] >= before - 1e-9, "falls at {x}");
                assert!((rgb[0] - rgb[1]).abs() < 0.01 && (rgb[2] - rgb[1]).abs() < 0.01);
                before = rgb[1];
            }
        }
    }
}
