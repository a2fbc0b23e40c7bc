//! The tests that judge: what a statistic's tail probability is, and how strict each of many tests has to be.
//!
//! Series and continued fractions for the incomplete gamma and beta functions as in Press et al.: Numerical Recipes,
//! 6.2 and 6.4.

/// Šidák 1967: the level of each of `tests` independent tests so that all of them together fail by chance with this
/// probability.
pub fn sidak(family_level: f64, tests: usize) -> f64 {
    // 1 - (1 - level)^(1/n) without cancellation.
    -libm::expm1(libm::log1p(-family_level) / tests as f64)
}

/// Mean and variance of a mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The mean.
    pub mean: f64,
    /// Its variance.
    pub variance: f64,
    /// Degrees of freedom of the variance; infinite for a known one.
    pub freedom: f64,
}

impl Estimate {
    /// Of independent values, at least two.
    pub fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
        Estimate { mean, variance: squares / (n - 1.0) / n, freedom: n - 1.0 }
    }

    /// Standard error of the mean.
    pub fn error(&self) -> f64 {
        self.variance.sqrt()
    }

    /// How far two means are apart (Welch 1947): the statistic, and the probability of one at least as large when both
    /// are of the same quantity. Equal means of variance zero agree.
    pub fn compare(&self, other: &Estimate) -> Comparison {
        let variance = self.variance + other.variance;
        let difference = self.mean - other.mean;
        if variance <= 0.0 {
            let probability = if difference == 0.0 { 1.0 } else { 0.0 };
            return Comparison {
                z: if difference == 0.0 { 0.0 } else { f64::INFINITY.copysign(difference) },
                probability,
            };
        }
        let z = difference / variance.sqrt();
        let part = |e: &Estimate| e.variance * e.variance / e.freedom;
        let freedom = variance * variance / (part(self) + part(other));
        Comparison { z, probability: student(z, freedom) }
    }
}

/// Two means compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Difference of the means in standard errors.
    pub z: f64,
    /// Two-sided tail probability.
    pub probability: f64,
}

/// P(|T| >= |t|) for Student's t; the normal distribution for infinite degrees of freedom.
pub fn student(t: f64, freedom: f64) -> f64 {
    if freedom > 1e7 {
        return libm::erfc(t.abs() / std::f64::consts::SQRT_2);
    }
    incomplete_beta(freedom / 2.0, 0.5, freedom / (freedom + t * t))
}

/// P(X >= x) for chi-square.
pub fn chi_square_tail(x: f64, freedom: f64) -> f64 {
    1.0 - incomplete_gamma(freedom / 2.0, x / 2.0)
}

/// Pearson's chi-square test of counts against expected counts: the probability of counts at least as odd. Cells are
/// pooled in the order of their expectation until each expects five or more; a count where nothing is expected gives 0.
///
/// # Panics
/// When the lists differ in length.
pub fn chi_square(observed: &[u64], expected: &[f64]) -> f64 {
    assert_eq!(observed.len(), expected.len());
    let mut cells: Vec<(f64, f64)> = expected.iter().zip(observed).map(|(&e, &o)| (e, o as f64)).collect();
    cells.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut statistic, mut used) = (0.0, 0usize);
    let (mut expectation, mut count) = (0.0, 0.0);
    for (e, o) in cells {
        if e == 0.0 && o > 0.0 {
            return 0.0;
        }
        expectation += e;
        count += o;
        if expectation >= 5.0 {
            statistic += (count - expectation) * (count - expectation) / expectation;
            used += 1;
            (expectation, count) = (0.0, 0.0);
        }
    }
    if used < 2 { 1.0 } else { chi_square_tail(statistic, (used - 1) as f64) }
}

/// The regularised lower incomplete gamma function P(a, x).
fn incomplete_gamma(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let front = libm::exp(a * libm::log(x) - x - libm::lgamma(a));
    if x < a + 1.0 {
        let (mut sum, mut term, mut n) = (1.0 / a, 1.0 / a, a);
        while term > sum * 1e-16 {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return front * sum;
    }
    // Lentz's evaluation of the continued fraction of 1 - P.
    let (mut b, mut c, mut d) = (x + 1.0 - a, 1e300, 1.0 / (x + 1.0 - a));
    let mut h = d;
    for i in 1..100_000 {
        let an = -f64::from(i) * (f64::from(i) - a);
        b += 2.0;
        d = 1.0 / (an * d + b);
        c = b + an / c;
        h *= c * d;
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    1.0 - front * h
}

/// The regularised incomplete beta function I_x(a, b).
fn incomplete_beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    let ln_front = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b) + a * libm::log(x) + b * libm::log1p(-x);
    let front = libm::exp(ln_front);
    if x < (a + 1.0) / (a + b + 2.0) {
        front * beta_fraction(a, b, x) / a
    } else {
        1.0 - front * beta_fraction(b, a, 1.0 - x) / b
    }
}

fn beta_fraction(a: f64, b: f64, x: f64) -> f64 {
    let mut c = 1.0;
    let mut d = 1.0 / (1.0 - (a + b) * x / (a + 1.0));
    let mut h = d;
    for m in 1..100_000 {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / (1.0 + even * d);
        c = 1.0 + even / c;
        h *= c * d;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / (1.0 + odd * d);
        c = 1.0 + odd / c;
        h *= c * d;
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    h
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Table values: 5 % and 0.1 % points.
    #[test]
    fn tails_of_known_distributions() {
        for (x, freedom, p) in [(3.841_46, 1.0, 0.05), (18.307_0, 10.0, 0.05), (149.449, 100.0, 0.001)] {
            assert!((chi_square_tail(x, freedom) - p).abs() < 1e-5 * 5.0, "chi-square {freedom}");
        }
        for (t, freedom, p) in [(12.706_2, 1.0, 0.05), (2.228_14, 10.0, 0.05), (3.390_49, 100.0, 0.001)] {
            assert!((student(t, freedom) - p).abs() < 1e-6 * 5.0, "t {freedom} {}", student(t, freedom));
        }
        assert!((student(1.959_964, f64::INFINITY) - 0.05).abs() < 1e-6);
    }

    #[test]
    fn sidak_of_many_tests() {
        assert!((sidak(0.05, 1) - 0.05).abs() < 1e-15);
        assert!((1.0 - (1.0 - sidak(0.01, 1000)).powi(1000) - 0.01).abs() < 1e-12);
    }

    #[test]
    fn chi_square_accepts_a_fair_die_and_rejects_a_loaded_one() {
        let mut random = crate::Random::new(1);
        let mut fair = [0u64; 6];
        (0..60_000).for_each(|_| fair[random.below(6)] += 1);
        assert!(chi_square(&fair, &[10_000.0; 6]) > 0.01);
        fair[0] += 500;
        assert!(chi_square(&fair, &[10_083.3; 6]) < 1e-4);
        assert_eq!(chi_square(&[5, 1], &[6.0, 0.0]), 0.0);
    }
}
