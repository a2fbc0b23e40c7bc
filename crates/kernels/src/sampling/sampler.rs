//! The sampler: a pure function of (seed, pixel, sample index, dimension pair).
//!
//! Each dimension pair is an Owen-scrambled Sobol' pair (Burley: Practical Hash-based Owen Scrambling, JCGT 2020),
//! padded: its own shuffled index and its own scrambling. The pixels are decorrelated in screen space, so that the
//! error of neighbours differs as blue noise does (Ahmed and Wonka: Screen-Space Blue-Noise Diffusion of Monte Carlo
//! Sampling Error via Hierarchical Ordering of Pixels, 2020). There a pixel's Z-order number is the high part of the
//! sample index, so the number of samples must be known beforehand. Here it enters by itself: with i the sample index,
//! z the pixel's (Owen-scrambled) Z-order number, S_d the d-th Sobol' matrix, L the lower Pascal matrix and V_d a
//! matrix that is upper triangular, the point is
//!
//! u_d = owen(S_d i XOR L S_d V_d z).
//!
//! S_d i fills the first n bits for i < 2^n, and any k successive rows of the first k columns of L are invertible, so
//! the union of the points of each Z-ordered group of 2^k pixels is stratified in 2^(n + k) strata per dimension, for
//! every n at once: the picture after N samples does not depend on how many were asked for. That holds whatever V_d is;
//! V_0 is the identity, and V_1 (`second_of_pixel`) spreads the points of groups in both dimensions together. Two pairs
//! that belong together are four dimensions of one sequence (over samples; over pixels they are padded): the directions
//! of the first two bounces the first four of Sobol', pixel and lens, which move the same edges and are often used
//! alone, a pair and its companion (`companion_index`). For the directions that was tried, too: in a furnace three
//! bounces had 1.5 times the error.
//!
//! The index is shuffled per tile of 16x16 pixels, so all that depends on the sample index is scalar work, once per
//! tile.

use super::sobol::{companion_index, higher_dimension, owen, pascal_upper, second_of_pixel, shuffle_index};
use crate::lanes::{ArrayF, ArrayU, Bits, Lanes};

/// What a pair of dimensions is used for; `u32` is the vertex number along the path, 0 at the first hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Position in the pixel.
    Pixel,
    /// Position on the lens.
    Lens,
    /// Direction of scattering.
    Direction(u32),
    /// Position on a light.
    Light(u32),
    /// Which light (both, where the tree of lights is deep).
    Choice(u32),
    /// Whether the path goes on (first); which lobe (second).
    Roulette(u32),
    /// Whether a ray is aimed, and at what (first); not used (second).
    Aim(u32),
    /// Direction of an aimed ray.
    AimedDirection(u32),
    /// Where the blocks lie whose pixels share.
    Grid,
}

impl Purpose {
    /// A number of its own.
    fn id(self) -> u32 {
        match self {
            Purpose::Pixel => 0,
            Purpose::Lens => 1,
            Purpose::Aim(0) => 2,
            Purpose::AimedDirection(0) => 3,
            Purpose::Aim(k) => (1 << 16) + 2 * k,
            Purpose::AimedDirection(k) => (1 << 16) + 2 * k + 1,
            // That of no vertex.
            Purpose::Grid => u32::MAX,
            Purpose::Direction(k) => 4 + 4 * k,
            Purpose::Light(k) => 5 + 4 * k,
            Purpose::Choice(k) => 6 + 4 * k,
            Purpose::Roulette(k) => 7 + 4 * k,
        }
    }
}

/// A hash of three words: two rounds of multiply and xor-shift over 64 bits.
pub fn hash3(a: u32, b: u32, c: u32) -> u64 {
    let mix = |x: u64| {
        let x = (x ^ (x >> 32)).wrapping_mul(0x0e98_46af_9b1a_615d);
        let x = (x ^ (x >> 32)).wrapping_mul(0x0e98_46af_9b1a_615d);
        x ^ (x >> 28)
    };
    mix(mix((u64::from(a) << 32) | u64::from(b)).wrapping_add(u64::from(c).wrapping_mul(0x9e37_79b9_7f4a_7c15)))
}

/// The part of a point that depends on (tile, sample index): reversed fractions before the pixel's own part is added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplePart {
    /// First dimension.
    pub x: u32,
    /// Second dimension.
    pub y: u32,
}

/// Keys of one dimension pair, the same for the whole picture.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    purpose: Purpose,
    seed: u32,
    pixel_key: u32,
    owen_x: u32,
    owen_y: u32,
}

impl Pair {
    /// The pair for a purpose.
    pub fn new(seed: u32, purpose: Purpose) -> Self {
        let a = hash3(seed, purpose.id(), 0x5ca1_ab1e);
        let b = hash3(seed, purpose.id(), 0x0ddc_0ffe);
        Pair { purpose, seed, pixel_key: a as u32, owen_x: b as u32, owen_y: (b >> 32) as u32 }
    }

    /// The two numbers of a pixel's sample, in [0, 1): what the engine computes over lanes, for one pixel.
    pub fn point(&self, x: u32, y: u32, sample: u32) -> [f32; 2] {
        let part = self.sample_part(z_order(x / 16, y / 16), sample);
        let z = ArrayU::splat(z_order(x, y).reverse_bits());
        let (u, v) = self.points::<ArrayF<1>>(z, ArrayU::splat(part.x), ArrayU::splat(part.y));
        let mut out = [0.0; 2];
        u.store(&mut out[..1]);
        v.store(&mut out[1..]);
        out
    }

    /// The part that depends on the tile and the sample index.
    pub fn sample_part(&self, tile: u32, sample: u32) -> SamplePart {
        let shuffled = |first: Purpose| shuffle_index(sample, hash3(self.seed ^ 0x9e37_79b9, first.id(), tile) as u32);
        let pair = |index: u32| {
            let mut y = [0];
            pascal_upper(ArrayU::<1>::splat(index)).store(&mut y);
            SamplePart { x: index, y: y[0] }
        };
        match self.purpose {
            // Pairs that belong together share one shuffled index.
            Purpose::Direction(1) => {
                let index = shuffled(Purpose::Direction(0));
                SamplePart { x: higher_dimension(0, index), y: higher_dimension(1, index) }
            }
            Purpose::Lens => pair(companion_index(shuffled(Purpose::Pixel))),
            other => pair(shuffled(other)),
        }
    }

    /// The two numbers, in [0, 1). `reversed_z` is the bit-reversed Z-order number of each lane's pixel.
    #[inline(always)]
    pub fn points<F: Lanes>(&self, reversed_z: F::U, sample_x: F::U, sample_y: F::U) -> (F, F) {
        let [points] = Self::points_of([self], reversed_z, [(sample_x, sample_y)]);
        points
    }

    /// [`Pair::points`] of several pairs, step by step together: each step of a pair waits for the one before, so alone
    /// it leaves most of the processor idle.
    #[inline(always)]
    pub fn points_of<F: Lanes, const K: usize>(
        pairs: [&Pair; K],
        reversed_z: F::U,
        parts: [(F::U, F::U); K],
    ) -> [(F, F); K] {
        let s = F::U::splat;
        let (mut x, mut y) = ([reversed_z; K], [reversed_z; K]);
        for (k, pair) in pairs.iter().enumerate() {
            y[k] = owen(reversed_z, s(pair.pixel_key));
        }
        // L z is the reversal of U of the reversed z, and L U z is U of the reversed z, as L U L is the matrix that
        // reverses (tests in `sobol`).
        for k in 0..K {
            (x[k], y[k]) = (pascal_upper(y[k]), pascal_upper(second_of_pixel(y[k])));
        }
        for k in 0..K {
            (x[k], y[k]) = (parts[k].0 ^ x[k].reverse_bits(), parts[k].1 ^ y[k]);
        }
        for k in 0..K {
            (x[k], y[k]) = (owen(x[k], s(pairs[k].owen_x)), owen(y[k], s(pairs[k].owen_y)));
        }
        let mut points = [(F::splat(0.0), F::splat(0.0)); K];
        for k in 0..K {
            points[k] = (unit(x[k].reverse_bits()), unit(y[k].reverse_bits()));
        }
        points
    }
}

/// The upper 24 bits as a number in [0, 1).
#[inline(always)]
pub fn unit<F: Lanes>(word: F::U) -> F {
    F::from_int(word.shr::<8>()) * F::splat(1.0 / 16_777_216.0)
}

/// Z-order (Morton) number: the bits of x and y interleaved, x lowest. Both below 65536.
pub fn z_order(x: u32, y: u32) -> u32 {
    let spread = |v: u32| {
        let v = (v | (v << 8)) & 0x00ff_00ff;
        let v = (v | (v << 4)) & 0x0f0f_0f0f;
        let v = (v | (v << 2)) & 0x3333_3333;
        (v | (v << 1)) & 0x5555_5555
    };
    spread(x) | (spread(y) << 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PURPOSES: [Purpose; 8] = [
        Purpose::Pixel,
        Purpose::Lens,
        Purpose::Direction(0),
        Purpose::Direction(1),
        Purpose::Light(0),
        Purpose::Choice(2),
        Purpose::Roulette(7),
        Purpose::Grid,
    ];

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

    /// 2^n samples of one pixel hit every one of 2^n strata of each dimension once.
    #[test]
    fn samples_of_a_pixel_are_stratified() {
        for purpose in PURPOSES {
            let pair = Pair::new(3, purpose);
            for n in 0..10 {
                let mut seen = vec![[0u32; 2]; 1 << n];
                for s in 0..1u32 << n {
                    let [u, v] = pair.point(45, 17, s);
                    seen[(u * (1 << n) as f32) as usize][0] += 1;
                    seen[(v * (1 << n) as f32) as usize][1] += 1;
                }
                assert!(seen.iter().all(|c| *c == [1, 1]), "{purpose:?} n {n}");
            }
        }
    }

    /// 2^n samples of the pixels of an aligned Z-ordered group of 2^k hit every one of 2^(n + k) strata once: groups
    /// within a tile, where the sample index is shuffled alike.
    #[test]
    fn groups_of_pixels_are_stratified_for_every_number_of_samples() {
        for purpose in PURPOSES {
            let pair = Pair::new(11, purpose);
            for n in 0..5 {
                for k in [1u32, 2, 3, 4, 6, 8] {
                    let mut seen = vec![[0u32; 2]; 1 << (n + k)];
                    for z in 0..1u32 << k {
                        let (mut x, mut y) = (48, 16);
                        for bit in 0..4 {
                            x += (z >> (2 * bit) & 1) << bit;
                            y += (z >> (2 * bit + 1) & 1) << bit;
                        }
                        for s in 0..1u32 << n {
                            let [u, v] = pair.point(x, y, s);
                            seen[(u * (1u32 << (n + k)) as f32) as usize][0] += 1;
                            seen[(v * (1u32 << (n + k)) as f32) as usize][1] += 1;
                        }
                    }
                    assert!(seen.iter().all(|c| *c == [1, 1]), "{purpose:?} n {n} k {k}");
                }
            }
        }
    }

    /// The mean over many seeds of one pixel's first point is 1/2 within 4 standard errors (4 / sqrt(12 * 4096) =
    /// 0.018).
    #[test]
    fn means_over_seeds() {
        for purpose in PURPOSES {
            let (mut a, mut b) = (0.0, 0.0);
            for seed in 0..4096 {
                let [u, v] = Pair::new(seed, purpose).point(3, 5, 0);
                a += f64::from(u) / 4096.0;
                b += f64::from(v) / 4096.0;
            }
            assert!((a - 0.5).abs() < 0.018 && (b - 0.5).abs() < 0.018, "{purpose:?} {a} {b}");
        }
    }

    /// The least t so that every elementary interval of area 2^(t - m) holds 2^t of these 2^m points.
    fn quality(points: &[[f32; 2]], m: u32) -> u32 {
        let even = |t: u32| {
            (0..=m - t).all(|columns| {
                let rows = m - t - columns;
                let mut cells = vec![0u32; 1 << (m - t)];
                for [u, v] in points {
                    let (column, row) = (u * (1u32 << columns) as f32, v * (1u32 << rows) as f32);
                    cells[(column as usize) << rows | row as usize] += 1;
                }
                cells.iter().all(|&count| count == 1 << t)
            })
        };
        (0..=m).find(|&t| even(t)).expect("all points lie in the whole")
    }

    /// What docs/noise.md ("Neighbours in two dimensions") says of 2^n samples of the pixels of groups of 2^k.
    #[test]
    fn groups_of_pixels_are_spread_in_two_dimensions() {
        let table = [
            [0, 0, 1, 0, 1, 0, 1, 1],
            [1, 0, 1, 1, 2, 1, 2, 1],
            [0, 1, 2, 1, 1, 2, 3, 2],
            [1, 2, 3, 1, 1, 1, 1, 1],
            [1, 1, 1, 2, 2, 2, 2, 2],
            [1, 2, 1, 2, 2, 3, 3, 1],
            [0, 1, 2, 3, 2, 3, 4, 1],
        ];
        let pair = Pair::new(5, Purpose::Light(0));
        for (n, of_samples) in (0u32..).zip(table) {
            for (k, expected) in (1u32..).zip(of_samples) {
                let mut points = Vec::new();
                for z in 0..1u32 << k {
                    let (mut x, mut y) = (32, 80);
                    for bit in 0..4 {
                        x += (z >> (2 * bit) & 1) << bit;
                        y += (z >> (2 * bit + 1) & 1) << bit;
                    }
                    points.extend((0..1u32 << n).map(|sample| pair.point(x, y, sample)));
                }
                assert_eq!(quality(&points, n + k), expected, "n {n} k {k}");
            }
        }
    }
}
