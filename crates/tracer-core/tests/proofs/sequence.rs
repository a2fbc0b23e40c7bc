//! The sampler along its sequence: far out, at its ends, and two pairs of dimensions together.

use crate::sampler::{PURPOSES, SIZE, Source, integrands, point, points, scrambled, second_dimension, to_unit, worth};
use crate::support::effort;
use tracer_core::sampling::sampler::{Pair, Purpose};
use tracer_reference::Random;
use tracer_reference::statistics::Estimate;

/// No period and no repetition: of the first 2^17 samples of a pixel each lies in its own one of 2^17 strata, in each
/// dimension of each pair.
#[test]
fn no_sample_of_131072_comes_again() {
    const N: usize = 1 << 17;
    for purpose in PURPOSES {
        let pair = Pair::new(5, purpose);
        let mut seen = vec![[false; 2]; N];
        for i in 0..N as u32 {
            let p = point(&pair, 301, 77, i);
            for axis in 0..2 {
                let taken = &mut seen[(p[axis] * N as f64) as usize][axis];
                assert!(!*taken, "{purpose:?}: sample {i} meets an earlier one's stratum");
                *taken = true;
            }
        }
    }
}

/// How unevenly the points of two pairs together fill 8^4 cells: Pearson's statistic, 4095 on average for independent
/// points. It has not chi-square's spread (90), not for independently scrambled Sobol' pairs either: whole runs of
/// points share their scrambling.
fn unevenness(points: impl Iterator<Item = [[f64; 2]; 2]>) -> f64 {
    let (mut cells, mut count) = (vec![0u32; 4096], 0.0);
    for [p, q] in points {
        let k = |x: f64| (8.0 * x) as usize;
        cells[k(p[0]) << 9 | k(p[1]) << 6 | k(q[0]) << 3 | k(q[1])] += 1;
        count += 1.0;
    }
    let expected = count / 4096.0;
    cells.iter().map(|&c| (f64::from(c) - expected).powi(2) / expected).sum()
}

/// Two pairs that are meant to be unrelated, far out in one pixel: together they fill their four dimensions as evenly
/// as pairs whose order and scrambling are nested uniform (Owen 1995) and drawn independently, in the mean over all
/// pairs of pairs, pixels and seeds (Welch, three standard errors). Single ones may be further out, where the keys of
/// two shuffles happen to be alike: of 264 at 2^14 samples one came to 6487, the others and those at 2^17 stayed below
/// 5100; of 100 independent ones the furthest was 4663.
///
/// 2^14 samples; with `TRACER_PROOFS=long` 2^17 as well.
#[test]
fn pairs_are_as_unrelated_as_independent_scrambling_makes_them() {
    let runs = [(1u32 << 14, 2u32, 40), (1 << 17, 1, 40)];
    for (n, draws, ideals) in runs.into_iter().take(if effort() > 1 { 2 } else { 1 }) {
        let mut ours = Vec::new();
        for (k, &a) in PURPOSES.iter().enumerate() {
            for &b in &PURPOSES[k + 1..] {
                if TOGETHER.contains(&(a, b)) {
                    continue;
                }
                for seed in 0..draws {
                    let (x, y) = (37 * seed + 5, 91 * seed + 11);
                    let (p, q) = (Pair::new(seed, a), Pair::new(seed, b));
                    ours.push(unevenness((0..n).map(|i| [point(&p, x, y, i), point(&q, x, y, i)])));
                }
            }
        }
        let ideal: Vec<f64> = (0..ideals)
            .map(|draw| {
                let mut random = Random::new(draw);
                let keys: [[u64; 3]; 2] = [[0; 3], [0; 3]].map(|_| [0; 3].map(|_| random.bits()));
                unevenness((0..n).map(|i| {
                    keys.map(|[order, x, y]| {
                        // 24 bits are scrambled: those of the index, each by a hash of the higher ones.
                        let k = scrambled(i << 8, order) >> 8;
                        [to_unit(scrambled(k.reverse_bits(), x)), to_unit(scrambled(second_dimension(k), y))]
                    })
                }))
            })
            .collect();
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let (a, b) = (Estimate::of(&ours), Estimate::of(&ideal));
        let z = a.compare(&b).z;
        let line = format!(
            "{n} samples: {:.0} +- {:.0}, at most {:.0} of {}; independent scrambling {:.0} +- {:.0}, at most {:.0} of \
             {}; z {z:.2}",
            a.mean,
            a.error(),
            largest(&ours),
            ours.len(),
            b.mean,
            b.error(),
            largest(&ideal),
            ideal.len()
        );
        println!("{line}");
        assert!(z < 3.0, "{line}");
    }
}

/// Pairs that are four dimensions of one sequence, and meant to be related.
const TOGETHER: [(Purpose, Purpose); 2] =
    [(Purpose::Pixel, Purpose::Lens), (Purpose::Direction(0), Purpose::Direction(1))];

/// What they are for: of a product of functions of both, and of an edge across all four dimensions, they make less
/// error than padded pairs (the second is exchanged for that of the third bounce).
#[test]
fn pairs_that_belong_together_are_better_than_padded_ones() {
    for (first, second) in TOGETHER {
        for integrand in integrands() {
            for (n, bound) in [(16, 0.9), (64, 0.9)] {
                let error = |second: Purpose| {
                    let square = |seed| {
                        let both = [first, second].map(|p| points(Source::Sampler, p, seed, n));
                        let [first, second] = both;
                        let products = first.iter().zip(&second).map(|(a, b)| {
                            a.iter().zip(b).map(|(&a, &b)| (integrand.f)(a) * (integrand.f)(b)).sum::<f64>()
                                / f64::from(n)
                        });
                        products.map(|mean| (mean - integrand.integral * integrand.integral).powi(2)).sum::<f64>()
                    };
                    (0..2).map(square).sum::<f64>()
                };
                // Of 8192 pixels each: to 0.02.
                let ratio = error(second) / error(Purpose::Direction(2));
                let line = format!("{first:?} and {second:?}, {} {n}: {ratio:.2} of padded pairs", integrand.name);
                println!("{line}");
                assert!(ratio < bound, "{line}");
            }
        }
    }
}

/// The second bounce's directions are the third and fourth dimension of Sobol', whose projection is no (0, 2)-sequence
/// (t = 3): at 8 samples a disc in them alone is up to a twentieth worse than independent points, everything else is
/// better, and the picture's low frequencies never hold more than those of independent points. What it is for is below.
#[test]
fn the_second_bounce_alone_is_no_worse_than_independent_points() {
    for integrand in integrands() {
        for n in [2, 8, 32] {
            let ours = worth(Source::Sampler, Purpose::Direction(1), &integrand, n, 8);
            let independent = worth(Source::Independent, Purpose::Direction(1), &integrand, n, 8);
            // 8 pictures hold some 400 independent low frequencies, each exponentially distributed: the ratio to the
            // mean of all, which is known much better, has a standard error of 1/20. Powers are compared absolutely:
            // that of the sampler's low frequencies against the mean power of independent points.
            let low = ours.low * ours.pixel / independent.pixel;
            let line = format!(
                "{} {n}: pixel {:.2} of independent, low frequencies {low:.2} of independent ({:.2} of its own)",
                integrand.name,
                ours.pixel / independent.pixel,
                ours.low
            );
            println!("{line}");
            // The pixels' mean squared errors are known to about a hundredth.
            assert!(ours.pixel < 1.1 * independent.pixel && low < 1.0, "{line}");
        }
    }
    assert_eq!(SIZE, 64, "the number of low frequencies is that of a picture of 64 pixels");
}
