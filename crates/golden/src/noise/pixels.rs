//! Single pixels: those whose samples agree on another light, and those brighter than samples can be.
//!
//! What is not here, and was tried: to hold the largest differences against the tail that all others make (Rényi's
//! spacings, Hill's index). In a scene with a small bright lamp behind glass it alarmed for 14 of 100 seeds. A path to
//! a lamp that one picture of ten finds in one of its samples is not in the tail of what others find, and no test can
//! tell it from a fault by two pictures: it is one event, and as probable in one of the pictures as in the other. So
//! one sample is noise unless it is brighter than light can be.

use super::LEAST_CHANGE;
use crate::measured::Measured;

/// Where a pixel's samples are all alike, rounding leaves no more than this share of the square as their variance.
const ROUNDING: f64 = 1e-10;

/// A pixel that differs by more than noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixel {
    /// Column and row.
    pub at: [u32; 2],
    /// Luminance, expected and actual.
    pub is: [f64; 2],
    /// In words, what is wrong with it.
    pub what: &'static str,
    /// The probability, at most, of one as far out anywhere in the picture.
    pub probability: f64,
}

fn luminance(rgb: &[f32]) -> f64 {
    0.2126 * f64::from(rgb[0]) + 0.7152 * f64::from(rgb[1]) + 0.0722 * f64::from(rgb[2])
}

/// Those that noise makes with no more than this probability, all of them together; and the least probability of all.
pub fn far_out(expected: &Measured, actual: &Measured, level: f64) -> (f64, Vec<Pixel>) {
    let pixels = expected.rgb.len() / 3;
    // Two tests, two signs, all pixels.
    let tests = 4.0 * pixels as f64;
    let brightest = f64::from(expected.brightest.max(actual.brightest));
    let samples = f64::from(expected.samples);
    let (mut least, mut found): (f64, Vec<Pixel>) = (1.0, Vec::new());
    for i in 0..pixels {
        let rgb = 3 * i..3 * i + 3;
        let (of_e, of_a) = (&expected.rgb[rgb.clone()], &actual.rgb[rgb]);
        if of_e == of_a {
            continue;
        }
        let is = [luminance(of_e), luminance(of_a)];
        let variance = f64::from(expected.variance[i]) + f64::from(actual.variance[i]);
        let (what, one) = if variance <= ROUNDING * (is[0] * is[0] + is[1] * is[1]) {
            let differs =
                |(e, a): (&f32, &f32)| f64::from((e - a).abs()) > LEAST_CHANGE * f64::from(e.abs().max(a.abs()));
            ("has no noise", if of_e.iter().zip(of_a).any(differs) { 0.0 } else { 1.0 })
        } else {
            let agreeing = agreement(is, variance, samples);
            let bright = brightness(is, brightest, samples);
            if bright < agreeing {
                ("is brighter than its samples can be by light", bright)
            } else {
                ("is another in all its samples", agreeing)
            }
        };
        let probability = (one * tests).min(1.0);
        least = least.min(probability);
        if probability <= level {
            let at = [i as u32 % expected.width, i as u32 / expected.width];
            found.push(Pixel { at, is, what, probability });
        }
    }
    found.sort_by(|a, b| a.probability.total_cmp(&b.probability));
    (least, found)
}

/// The probability, at most, that noise of samples which are as often above as below makes two pixels differ so much,
/// by their own variance. It is the smaller of two bounds on the sum of n numbers d whose signs are coins' to be z
/// times the root of the sum of their squares V^2.
///
/// - 3.18 times the normal distribution's tail at z (Pinelis 1994, Extremal probabilistic problems and Hotelling's T^2
///   test under a symmetry condition).
/// - Near z = root n, where all d are nearly alike: signs that reach the sum, too, are other ones only for d that sum
///   to r V at most, r = (root n - z) / 2. Were there m such small ones, z would be at most m r + root(n - m), by
///   Cauchy and Schwarz for the others; and root(n - m) is at most root n - m / (2 root n). So m is at most
///   2 r / (1 / (2 root n) - r), and 2^m of 2^n signs remain.
///
/// V^2 comes of the variance and of the difference itself, which keeps one bright sample from being far out: its z is
/// one.
fn agreement(is: [f64; 2], variance: f64, samples: f64) -> f64 {
    let difference = ((is[0] - is[1]).abs() - LEAST_CHANGE * is[0].abs().max(is[1].abs())).max(0.0);
    let squares = difference * difference;
    let z = (samples * squares / ((samples - 1.0) * variance + squares)).sqrt();
    let of_normal = 3.18 * 0.5 * libm::erfc(z * std::f64::consts::FRAC_1_SQRT_2);
    let root = samples.sqrt();
    let (r, edge) = (((root - z) / 2.0).max(0.0), 0.5 / root);
    let of_signs = if r < edge { libm::exp2((2.0 * r / (edge - r)).floor() - samples) } else { 1.0 };
    of_normal.min(of_signs).min(1.0)
}

/// The probability, at most, that the brighter pixel got its light by chance, were no sample brighter than the
/// brightest light: all light of both pixels is then at least so many events, and coins decide whose each is
/// (Chernoff's bound, exact where all are one pixel's).
fn brightness(is: [f64; 2], brightest: f64, samples: f64) -> f64 {
    let (more, less) = (is[0].max(is[1]), is[0].min(is[1]).max(0.0));
    let all = more + less;
    if all <= 0.0 || brightest <= 0.0 {
        return 1.0;
    }
    let term = |share: f64| if share > 0.0 { share * libm::log(2.0 * share) } else { 0.0 };
    let divergence = term(more / all) + term(less / all);
    libm::exp(-samples * all / brightest * divergence).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sample_is_noise_and_agreement_is_none() {
        // 32 samples of which one is 32: the mean is one, and so is its variance.
        assert!(agreement([1.0, 0.0], 1.0, 32.0) > 0.3);
        // Ten standard errors of 64 samples.
        assert!(agreement([1.0, 0.0], 0.01, 64.0) < 1e-8);
        // A thousandth is no change, however sure.
        assert_eq!(agreement([1.0, 1.000_9], 1e-20, 64.0), 1.0);
        // 32 samples that agree are 32 coins.
        assert_eq!(agreement([1.0, 0.0], 1e-6, 32.0), libm::exp2(-32.0));
    }

    #[test]
    fn light_has_a_limit() {
        // 32 samples, each as bright as the lamp: 32 coins that all agree.
        assert!((libm::log2(brightness([20.0, 0.0], 20.0, 32.0)) + 32.0).abs() < 1e-9);
        // One sample of the lamp's brightness.
        assert!((brightness([20.0 / 32.0, 0.0], 20.0, 32.0) - 0.5).abs() < 1e-12);
        assert_eq!(brightness([1.0, 1.0], 20.0, 32.0), 1.0);
        assert!(brightness([9.0, 7.0], 20.0, 32.0) > 0.5);
    }
}
