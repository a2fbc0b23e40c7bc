//! The exact test of signs: how rarely numbers that may as well be negative sum to so much.

/// Steps that the sum of the magnitudes is divided into.
const STEPS: usize = 4096;

/// The probability, at most, that numbers of these magnitudes with signs drawn by tossing a coin sum to what they sum
/// to or more.
///
/// It is exact but for rounding the magnitudes to `STEPS`, which is rounded so that the probability is never too
/// small: Fisher's randomisation test (The Design of Experiments, 1935, section 21). It asks for no distribution, so
/// that fireflies and black pixels cannot mislead it: one that is far out makes the sum large and so is it with half of
/// the signs.
pub fn probability(numbers: &[f64]) -> f64 {
    let total: f64 = numbers.iter().map(|x| x.abs()).sum();
    let sum: f64 = numbers.iter().sum();
    if total == 0.0 || sum <= 0.0 || !total.is_finite() {
        return 1.0;
    }
    let steps: Vec<usize> = numbers.iter().map(|x| (x.abs() / total * STEPS as f64).round() as usize).collect();
    let all: usize = steps.iter().sum();
    // The sum of those with a plus is (all + sum) / 2; rounding moved each by half a step at most.
    let least = ((all as f64 + sum / total * STEPS as f64 - numbers.len() as f64) / 2.0).ceil().max(0.0) as usize;
    let mut chances = vec![0.0; all + 1];
    chances[0] = 1.0;
    let mut reached = 0;
    for step in steps {
        for k in (0..=reached).rev() {
            let half = chances[k] / 2.0;
            if step == 0 {
                continue;
            }
            chances[k] = half;
            chances[k + step] += half;
        }
        reached += step;
    }
    chances.iter().skip(least).sum::<f64>().min(1.0)
}

/// Whether it is worth asking: signs that bring a sum of z times the root of the squares' sum are no rarer than 2^-z^2
/// as far as is known (equal numbers with one sign reach that). What is wrongly thought not worth it passes.
pub fn may_reach(numbers: &[f64], level: f64) -> bool {
    let sum: f64 = numbers.iter().sum();
    let squares: f64 = numbers.iter().map(|x| x * x).sum();
    sum > 0.0 && sum * sum >= squares * (-libm::log2(level) - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All signs of few numbers, counted.
    #[test]
    fn as_counted() {
        let cases: [&[f64]; 5] = [
            &[1.0, 1.0, 1.0, 1.0],
            &[3.0, -1.0, 2.0, 5.0, 0.5],
            &[0.0, 0.0, 2.0, 1.0],
            &[10.0, 0.1, 0.2, -0.3, 0.05, 4.0, 1.0],
            &[-1.0, 2.0],
        ];
        for numbers in cases {
            let sum: f64 = numbers.iter().sum();
            let count = (0..1u32 << numbers.len())
                .filter(|signs| {
                    let of = |k: usize| if signs >> k & 1 == 1 { numbers[k].abs() } else { -numbers[k].abs() };
                    (0..numbers.len()).map(of).sum::<f64>() >= sum - 1e-9
                })
                .count();
            let exact = count as f64 / f64::from(1u32 << numbers.len());
            let got = probability(numbers);
            assert!(got >= exact - 1e-12, "{numbers:?}: {got} {exact}");
            assert!(got <= exact * 1.3, "{numbers:?}: {got} {exact}");
        }
    }

    #[test]
    fn all_of_one_sign_is_rarest() {
        let numbers = [0.3; 32];
        assert!((probability(&numbers).log2() + 32.0).abs() < 1e-9);
        assert!(may_reach(&numbers, 1e-9) && !may_reach(&numbers, 1e-12));
        assert_eq!(probability(&[-1.0, -2.0]), 1.0);
        assert_eq!(probability(&[0.0; 8]), 1.0);
        // One that is far out is as probable as its sign.
        let mut firefly = [0.001; 32];
        firefly[7] = 1e6;
        assert!(probability(&firefly) > 0.2);
    }
}
