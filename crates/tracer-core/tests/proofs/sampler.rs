//! The sampler's points against independent ones and against plain Owen-scrambled Sobol' points per pixel: error of a
//! pixel, error of the picture's mean, spectrum of the error over the picture, bias, and structure between dimensions
//! and along the sequence.

use tracer_core::sampling::sampler::{Pair, Purpose};
use tracer_reference::Random;
use tracer_reference::statistics::{Estimate, chi_square, sidak};

/// A point of the sampler.
pub(crate) fn point(pair: &Pair, x: u32, y: u32, sample: u32) -> [f64; 2] {
    pair.point(x, y, sample).map(f64::from)
}

/// The pairs that a path uses, with a deep one of each kind.
pub(crate) const PURPOSES: [Purpose; 12] = [
    Purpose::Pixel,
    Purpose::Lens,
    Purpose::Direction(0),
    Purpose::Direction(1),
    Purpose::Direction(2),
    Purpose::Light(0),
    Purpose::Light(1),
    Purpose::Choice(0),
    Purpose::Roulette(0),
    Purpose::Roulette(6),
    Purpose::Aim(0),
    Purpose::AimedDirection(0),
];

/// Pixels along the picture's side.
pub(crate) const SIZE: u32 = 64;

/// Where points come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Source {
    Sampler,
    Independent,
    /// Sobol' points, nested uniform scrambling (Owen 1995) drawn anew for each pixel and pair.
    Owen,
}

/// Nested uniform scrambling: each bit is flipped by a hash of those above it.
pub(crate) fn scrambled(x: u32, key: u64) -> u32 {
    (0..24).fold(0, |word, bit| {
        let above = u64::from(x) >> (32 - bit);
        let flip = Random::new(key ^ (above << 5 | bit) << 20).bits() as u32 & 1;
        word | (((x >> (31 - bit)) & 1) ^ flip) << (31 - bit)
    })
}

/// The second Sobol' dimension (Bratley and Fox 1988: the polynomial x + 1, direction numbers by v ^= v >> 1).
pub(crate) fn second_dimension(i: u32) -> u32 {
    let mut v = 1u32 << 31;
    let mut word = 0;
    for bit in 0..32 {
        if i >> bit & 1 == 1 {
            word ^= v;
        }
        v ^= v >> 1;
    }
    word
}

pub(crate) fn to_unit(x: u32) -> f64 {
    f64::from(x) / 4_294_967_296.0
}

/// The first `n` points of a pair in each pixel of the picture.
pub(crate) fn points(source: Source, purpose: Purpose, seed: u32, n: u32) -> Vec<Vec<[f64; 2]>> {
    let pair = Pair::new(seed, purpose);
    let key = u64::from(seed) << 40 ^ (format!("{purpose:?}").bytes().fold(7, |h: u64, b| h * 31 + u64::from(b)) << 8);
    let pixels = (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (x, y)));
    pixels
        .map(|(x, y)| {
            let mut random = Random::new(key ^ (u64::from(y) << 8 | u64::from(x)) << 44);
            let keys = [random.bits(), random.bits()];
            (0..n)
                .map(|i| match source {
                    Source::Sampler => point(&pair, x, y, i),
                    Source::Independent => [random.number(), random.number()],
                    Source::Owen => [
                        to_unit(scrambled(i.reverse_bits(), keys[0])),
                        to_unit(scrambled(second_dimension(i), keys[1])),
                    ],
                })
                .collect()
        })
        .collect()
}

/// What is integrated over the unit square, and its integral.
pub(crate) struct Integrand {
    pub name: &'static str,
    pub f: fn([f64; 2]) -> f64,
    pub integral: f64,
}

/// A soft shadow's edge, a round light or lens, and something smooth.
pub(crate) fn integrands() -> [Integrand; 3] {
    [
        Integrand { name: "edge", f: |[u, v]| if u + 0.3 * v < 0.6 { 1.0 } else { 0.0 }, integral: 0.45 },
        Integrand {
            name: "disc",
            f: |[u, v]| if u * u + v * v < 1.0 { 1.0 } else { 0.0 },
            integral: std::f64::consts::FRAC_PI_4,
        },
        Integrand { name: "smooth", f: |[u, v]| 4.0 * u * v, integral: 1.0 },
    ]
}

/// The error of each pixel.
fn errors(points: &[Vec<[f64; 2]>], integrand: &Integrand) -> Vec<f64> {
    let mean = |p: &Vec<[f64; 2]>| p.iter().map(|&x| (integrand.f)(x)).sum::<f64>() / p.len() as f64;
    points.iter().map(|p| mean(p) - integrand.integral).collect()
}

/// Mean power of the frequencies up to `limit` cycles per picture against that of all, both without the mean.
pub(crate) fn low_frequencies(image: &[f64], limit: f64) -> [f64; 2] {
    let n = SIZE as usize;
    let wave: Vec<(f64, f64)> =
        (0..n).map(|k| (std::f64::consts::TAU * k as f64 / n as f64).sin_cos()).map(|(s, c)| (c, -s)).collect();
    // Rows, then columns.
    let mut rows = vec![(0.0, 0.0); n * n];
    for y in 0..n {
        for k in 0..n {
            let mut sum = (0.0, 0.0);
            for x in 0..n {
                let (c, s) = wave[k * x % n];
                sum = (sum.0 + image[y * n + x] * c, sum.1 + image[y * n + x] * s);
            }
            rows[y * n + k] = sum;
        }
    }
    let signed = |k: usize| if k > n / 2 { k as f64 - n as f64 } else { k as f64 };
    let (mut low, mut lows, mut all) = (0.0, 0.0, 0.0);
    for k in 0..n {
        for l in 0..n {
            if k == 0 && l == 0 {
                continue;
            }
            let mut sum = (0.0, 0.0);
            for y in 0..n {
                let ((a, b), (c, s)) = (rows[y * n + k], wave[l * y % n]);
                sum = (sum.0 + a * c - b * s, sum.1 + a * s + b * c);
            }
            let power = sum.0 * sum.0 + sum.1 * sum.1;
            all += power;
            if signed(k).hypot(signed(l)) <= limit {
                low += power;
                lows += 1.0;
            }
        }
    }
    [low / lows, all / (n * n - 1) as f64]
}

/// What a source of points is worth for an integrand at some number of samples.
pub(crate) struct Worth {
    /// Mean squared error of a pixel.
    pub pixel: f64,
    /// Mean squared error of the picture's mean.
    pub picture: f64,
    /// Power of the lowest eighth of the frequencies against that of all.
    pub low: f64,
}

pub(crate) fn worth(source: Source, purpose: Purpose, integrand: &Integrand, n: u32, seeds: u32) -> Worth {
    let (mut pixel, mut picture, mut low, mut all) = (0.0, 0.0, 0.0, 0.0);
    for seed in 0..seeds {
        let e = errors(&points(source, purpose, seed * 97 + 5, n), integrand);
        let count = e.len() as f64;
        pixel += e.iter().map(|x| x * x).sum::<f64>() / count;
        picture += (e.iter().sum::<f64>() / count).powi(2);
        // An eighth of the 32 frequencies below Nyquist's.
        let [l, a] = low_frequencies(&e, 4.0);
        (low, all) = (low + l, all + a);
    }
    let n = f64::from(seeds);
    Worth { pixel: pixel / n, picture: picture / n, low: low / all }
}

/// At every number of samples up to 16: a pixel's error is that of plain Owen-Sobol' points, and clearly smaller than
/// that of independent ones; the picture's mean is better by far; and the error is blue: the lowest eighth of the
/// frequencies holds far less than its share. The bounds stand a third above what was measured.
#[test]
fn error_is_small_and_blue() {
    for purpose in [Purpose::Pixel, Purpose::Light(0), Purpose::Direction(0)] {
        for integrand in integrands() {
            for n in [1, 2, 4, 8, 16] {
                let ours = worth(Source::Sampler, purpose, &integrand, n, 12);
                let owen = worth(Source::Owen, purpose, &integrand, n, 4);
                let independent = worth(Source::Independent, purpose, &integrand, n, 4);
                let mean = ours.picture / (independent.pixel / f64::from(SIZE * SIZE));
                let line = format!(
                    "{purpose:?} {} {n}: pixel {:.2} of independent, {:.2} of Owen; picture's mean {mean:.3}; low \
                     {:.3} (Owen {:.2})",
                    integrand.name,
                    ours.pixel / independent.pixel,
                    ours.pixel / owen.pixel,
                    ours.low,
                    owen.low,
                );
                println!("{line}");
                assert!(ours.pixel < 1.3 * owen.pixel, "{line}");
                assert!(n == 1 || ours.pixel < 0.85 * independent.pixel, "{line}");
                assert!(mean < 0.15, "{line}");
                assert!(ours.low < 0.5, "{line}");
            }
        }
    }
}

/// Two bounces together, f(u) f(v): the shared sequence against padded pairs.
#[test]
fn two_bounces_together() {
    let integrals = integrands();
    for n in [4, 8, 16, 64] {
        for integrand in &integrals {
            let error = |second: Purpose| {
                let mut sum = 0.0;
                for seed in 0..4 {
                    let (a, b) = (
                        points(Source::Sampler, Purpose::Direction(0), seed, n),
                        points(Source::Sampler, second, seed, n),
                    );
                    for (a, b) in a.iter().zip(&b) {
                        let mean = a.iter().zip(b).map(|(&a, &b)| (integrand.f)(a) * (integrand.f)(b)).sum::<f64>()
                            / f64::from(n);
                        sum += (mean - integrand.integral * integrand.integral).powi(2);
                    }
                }
                sum
            };
            let ratio = error(Purpose::Direction(1)) / error(Purpose::Direction(2));
            println!("two bounces, {} {n}: shared sequence {ratio:.2} of padded pairs", integrand.name);
        }
    }
}

/// Over seeds each pixel's every point is uniform, and so are the points of two pairs together: no bias. 64 seeds of
/// 4096 pixels, first sample and a later one; 8^4 cells for each pair of pairs; 5 % for all together.
#[test]
fn points_are_uniform_over_seeds_and_pairs_unrelated() {
    let pairs: Vec<(Purpose, Purpose)> =
        PURPOSES.iter().enumerate().flat_map(|(k, &a)| PURPOSES[k + 1..].iter().map(move |&b| (a, b))).collect();
    let level = sidak(0.05, 2 * pairs.len());
    for sample in [0, 5] {
        // One pixel a seed: pixels of one picture are stratified, not independent.
        let of = |purpose: Purpose| -> Vec<[f64; 2]> {
            (0..40_000u32).map(|seed| point(&Pair::new(seed, purpose), seed % 61, seed / 61 % 67, sample)).collect()
        };
        let all: Vec<Vec<[f64; 2]>> = PURPOSES.iter().map(|&p| of(p)).collect();
        for (a, b) in &pairs {
            let index = |p: &Purpose| PURPOSES.iter().position(|q| q == p).expect("a purpose");
            let mut cells = vec![0u64; 4096];
            for (p, q) in all[index(a)].iter().zip(&all[index(b)]) {
                let k = |x: f64| (8.0 * x) as usize;
                cells[k(p[0]) << 9 | k(p[1]) << 6 | k(q[0]) << 3 | k(q[1])] += 1;
            }
            let p = chi_square(&cells, &[40_000.0 / 4096.0; 4096]);
            assert!(p > level, "{a:?} and {b:?}, sample {sample}: p {p:e}");
        }
    }
}

/// The mean over 64 seeds of what a whole picture integrates is right, for each number of samples: within 4 standard
/// errors over seeds.
#[test]
fn means_over_64_seeds_are_right() {
    for purpose in PURPOSES {
        for integrand in integrands() {
            for n in [1, 3, 16] {
                let pair_means: Vec<f64> = (0..64)
                    .map(|seed| {
                        let pair = Pair::new(seed, purpose);
                        let pixels = (0..256).map(|k| (k % 16 + 24, k / 16 + 8));
                        let sum: f64 = pixels
                            .flat_map(|(x, y)| (0..n).map(move |i| (x, y, i)))
                            .map(|(x, y, i)| (integrand.f)(point(&pair, x, y, i)))
                            .sum();
                        sum / (256.0 * f64::from(n))
                    })
                    .collect();
                let mean = Estimate::of(&pair_means);
                // 24 bits cut off half of 2^-24 on average; 90 means are asserted.
                let off = (mean.mean - integrand.integral).abs();
                assert!(
                    off < 4.5 * mean.error() + 2e-7,
                    "{purpose:?} {} {n}: {} +- {}",
                    integrand.name,
                    mean.mean,
                    mean.error()
                );
            }
        }
    }
}

/// Every pair in every pixel: 2^n samples hit each elementary interval of area 2^-n once, of every shape, as a (0,
/// 2)-sequence does; the second bounce, the third and fourth dimension of Sobol', hits each of area 2^-(n - 1) twice...
/// (t = 1) or better than that.
#[test]
fn pairs_are_stratified_in_two_dimensions() {
    for purpose in PURPOSES {
        let pair = Pair::new(21, purpose);
        let mut worst = 0;
        for (x, y) in [(0, 0), (13, 50), (511, 300)] {
            for n in 0..=10u32 {
                let points: Vec<[f64; 2]> = (0..1u32 << n).map(|i| point(&pair, x, y, i)).collect();
                // The least t so that all intervals of area 2^(t - n) hold 2^t points.
                let even = |t: u32| {
                    (0..=n - t).all(|a| {
                        let (columns, rows) = ((1u32 << a) as f64, (1u32 << (n - t - a)) as f64);
                        let mut cells = vec![0u32; 1 << (n - t)];
                        for p in &points {
                            cells[(p[0] * columns) as usize * rows as usize + (p[1] * rows) as usize] += 1;
                        }
                        cells.iter().all(|&c| c == 1 << t)
                    })
                };
                worst = worst.max((0..=n).find(|&t| even(t)).expect("all points lie in the square"));
            }
        }
        println!("{purpose:?}: t = {worst}");
        assert!(worst <= if purpose == Purpose::Direction(1) { 3 } else { 0 }, "{purpose:?}: t = {worst}");
    }
}
