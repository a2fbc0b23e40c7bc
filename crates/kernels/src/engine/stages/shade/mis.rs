//! Multiple importance sampling: Veach's power heuristic (1997, 9.2.2), with the exponent two.

use crate::lanes::Lanes;

/// a^2 / (a^2 + b^2), written so that large densities do not overflow.
#[inline(always)]
pub fn power_heuristic<F: Lanes>(a: F, b: F) -> F {
    weight_of_ratio(b / a)
}

/// 1 / (1 + (b / a)^2) of the ratio b / a.
#[inline(always)]
pub fn weight_of_ratio<F: Lanes>(ratio: F) -> F {
    F::splat(1.0) / ratio.fma(ratio, F::splat(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::ArrayF;

    /// The weights of both ways to find a light sum to one (Veach 1997, 9.2), also where one density is all or nothing.
    #[test]
    fn mis_weights_sum_to_one() {
        type S = ArrayF<1>;
        let weight = |a: f32, b: f32| {
            let mut out = [0.0];
            power_heuristic(S::splat(a), S::splat(b)).store(&mut out);
            f64::from(out[0])
        };
        for a in [1e-20f32, 1e-8, 0.01, 0.3, 1.0, 7.0, 1e5, 1e20] {
            for b in [1e-20f32, 1e-8, 0.01, 0.3, 1.0, 7.0, 1e5, 1e20] {
                let (of_a, of_b) = (weight(a, b), weight(b, a));
                assert!((of_a + of_b - 1.0).abs() < 3e-7, "{a} {b}: {of_a} + {of_b}");
                let ratio = f64::from(b) / f64::from(a);
                assert!((of_a - 1.0 / (1.0 + ratio * ratio)).abs() < 3e-7, "{a} {b}: {of_a}");
            }
            assert_eq!(weight(a, 0.0), 1.0);
        }
    }
}
