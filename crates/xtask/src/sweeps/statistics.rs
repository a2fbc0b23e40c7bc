//! What is asked of a sweep: does the noise, does the mean jump between neighbouring steps?
//!
//! # Noise
//! Of n pictures with independent seeds the sample variance of each pixel, averaged over pixels, is an unbiased
//! estimate of the noise V of one picture, whatever hangs together within it. Default and plain pictures give the ratio
//! R = V/V'. Between neighbours d = ln R(i+1) - ln R(i), a function of the four sets of pictures; its variance is that
//! of the jackknife, picture k being left out of all four at a time. The pictures of a seed are alike at both steps
//! where the technique is, and then their luck cancels in d, which the jackknife sees as well. The noise of the plain
//! path tracer may be a few events; then so may R, and d's error is large and says so. H0: |d| <= ln 1.5. It is
//! rejected where (|d| - ln 1.5) over the error is so large that Student's t with n - 1 degrees of freedom gives it a
//! chance below the level, divided among all jumps that are asked for (Bonferroni).
//!
//! # Means
//! A mean changes with the parameter; what it must not do is jump. Over four steps c = (3 (m2 - m1) - (m3 - m0)) / 2 is
//! zero for any parabola but for terms of third order, and J for a jump J between the middle ones. A lamp that comes
//! into view jumps by right, so c of the plain path tracer's pictures is taken off. The standard error is that of n
//! values, one for each seed. H0: the rest is at most 2 % of the mean, tested as above.
//!
//! # Frames
//! Mean squared differences between neighbouring frames, default over plain, both with one seed for all frames: what is
//! to be seen there beside motion is noise. The ratio, and its error as above; H0: it is at most one.

use tracer_reference::statistics::student;

/// The largest jump of the noise that is right.
pub const LARGEST: f64 = 1.5;

/// The largest jump of the mean, relative.
pub const OF_MEAN: f64 = 0.02;

/// Grey pixels of pictures, by seed.
pub type Pictures = Vec<Vec<f64>>;

/// A number with its standard error.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// The number.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

impl Measured {
    /// The chance, on one side, to see it so far above `limit` if it were that much.
    pub fn chance(&self, limit: f64, pictures: usize) -> f64 {
        let above = self.value.abs() - limit;
        if above <= 0.0 || self.error.is_nan() {
            return 1.0;
        }
        0.5 * student(above / self.error, (pictures - 1) as f64)
    }
}

/// Noise of one picture without the one left out: the variance of each pixel, averaged.
fn noise(pictures: &[Vec<f64>], left_out: usize) -> f64 {
    let used = || pictures.iter().enumerate().filter(move |(k, _)| *k != left_out).map(|(_, picture)| picture);
    let n = used().count() as f64;
    let pixels = pictures[0].len();
    let of_pixel = |p: usize| {
        let mean = used().map(|picture| picture[p]).sum::<f64>() / n;
        used().map(|picture| (picture[p] - mean).powi(2)).sum::<f64>() / (n - 1.0)
    };
    (0..pixels).map(of_pixel).sum::<f64>() / pixels as f64
}

/// A statistic of n pictures and its values with each left out, `None` being all.
fn jackknife(n: usize, statistic: impl Fn(usize) -> f64) -> Measured {
    let values: Vec<f64> = (0..n).map(&statistic).collect();
    let mean = values.iter().sum::<f64>() / n as f64;
    let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
    Measured { value: statistic(n), error: ((n - 1) as f64 / n as f64 * squares).sqrt() }
}

/// ln of the noise of default over plain pictures, with each left out and, last, of all.
pub fn ratios(ours: &Pictures, plain: &Pictures) -> Vec<f64> {
    (0..=ours.len()).map(|k| (noise(ours, k) / noise(plain, k)).ln()).collect()
}

/// The jump between two steps' [`ratios`].
pub fn jump(a: &[f64], b: &[f64]) -> Measured {
    jackknife(a.len() - 1, |k| b[k] - a[k])
}

/// The jump of the mean in the middle of four steps, default less plain, over the mean.
pub fn jump_of_mean(steps: [&Pictures; 4], plain: [&Pictures; 4]) -> Measured {
    let n = steps[0].len();
    let mean = |picture: &[f64]| picture.iter().sum::<f64>() / picture.len() as f64;
    let jump = |steps: [&Pictures; 4], k: usize| {
        let [a, b, c, d] = steps.map(|pictures| mean(&pictures[k]));
        (3.0 * (c - b) - (d - a)) / 2.0
    };
    let values: Vec<f64> = (0..n).map(|k| jump(steps, k) - jump(plain, k)).collect();
    let size = steps.iter().flat_map(|pictures| pictures.iter()).map(|p| mean(p)).sum::<f64>() / (4 * n) as f64;
    let middle = values.iter().sum::<f64>() / n as f64;
    let squares: f64 = values.iter().map(|x| (x - middle) * (x - middle)).sum();
    Measured { value: middle / size, error: (squares / (n * (n - 1)) as f64).sqrt() / size }
}

/// Mean squared differences between two frames, default over plain, as a logarithm.
pub fn flicker(ours: [&Pictures; 2], plain: [&Pictures; 2]) -> Measured {
    let of_seed = |pair: [&Pictures; 2], k: usize| -> f64 {
        pair[0][k].iter().zip(&pair[1][k]).map(|(a, b)| (a - b) * (a - b)).sum()
    };
    let n = ours[0].len();
    let sum = |pair: [&Pictures; 2], left_out: usize| -> f64 {
        (0..n).filter(|k| *k != left_out).map(|k| of_seed(pair, k)).sum()
    };
    jackknife(n, |k| (sum(ours, k) / sum(plain, k)).ln())
}

#[cfg(test)]
mod tests {
    use super::*;
    use tracer_reference::Random;

    fn pictures(random: &mut Random, n: usize, mean: f64, deviation: f64) -> Pictures {
        // Of twelve uniform numbers: variance one.
        let mut noise = || (0..12).map(|_| random.number()).sum::<f64>() - 6.0;
        (0..n).map(|_| (0..400).map(|_| mean + deviation * noise()).collect()).collect()
    }

    /// Errors are what they say: over many trials without a jump, value over error has a variance of about one.
    #[test]
    fn errors_are_right() {
        let mut random = Random::new(1);
        let (mut jumps, mut means) = (0.0, 0.0);
        for _ in 0..60 {
            let mut step = || [pictures(&mut random, 8, 1.0, 0.3), pictures(&mut random, 8, 1.0, 1.0)];
            let steps = [step(), step(), step(), step()];
            let at = |k: usize| ratios(&steps[k][0], &steps[k][1]);
            let d = jump(&at(0), &at(1));
            jumps += (d.value / d.error).powi(2) / 60.0;
            let of = |which: usize| [0, 1, 2, 3].map(|k| &steps[k][which]);
            let d = jump_of_mean(of(0), of(1));
            means += (d.value / d.error).powi(2) / 60.0;
        }
        // The square of Student's t of 7 degrees of freedom has a mean of 7/5 and a fourth moment of 3 * 49 / (5 * 3),
        // hence a deviation of 2.8; of 60 of them the mean is off by 0.36: three and a half of these on either side.
        assert!((0.14..2.66).contains(&jumps) && (0.14..2.66).contains(&means), "{jumps} {means}");
    }

    /// Twice the noise is told, and so is a mean that jumps by a twentieth; a slope is no jump.
    #[test]
    fn jumps_are_told() {
        let mut random = Random::new(2);
        let plain = [(); 2].map(|()| pictures(&mut random, 8, 1.0, 1.0));
        let ours = [0.3, 0.6].map(|deviation| pictures(&mut random, 8, 1.0, deviation));
        let d = jump(&ratios(&ours[0], &plain[0]), &ratios(&ours[1], &plain[1]));
        // A variance of 8 times 400 numbers is off by (2 / (7 * 400))^(1/2), four of them by 0.053: nearly four of
        // these.
        assert!((d.value - 4f64.ln()).abs() < 0.2 && d.chance(LARGEST.ln(), 8) < 1e-5, "{d:?}");
        for (means, jumps) in [([1.0, 1.0, 1.05, 1.05], true), ([1.0, 1.1, 1.2, 1.3], false)] {
            let steps = means.map(|mean| pictures(&mut random, 8, mean, 0.05));
            let flat = [1.0; 4].map(|mean| pictures(&mut random, 8, mean, 0.05));
            let d = jump_of_mean([0, 1, 2, 3].map(|k| &steps[k]), [0, 1, 2, 3].map(|k| &flat[k]));
            assert_eq!(d.chance(OF_MEAN, 8) < 1e-4, jumps, "{means:?}: {d:?}");
        }
    }
}
