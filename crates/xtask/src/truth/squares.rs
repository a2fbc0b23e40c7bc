//! Squares in the noise: steps of the error across the borders of blocks of pixels against those elsewhere.
//!
//! The error of a picture is the picture less the mean of the others. Pixels that hang together within blocks have
//! errors alike
//! there, and a step to the next block. Were there no blocks, the mean squared step would be the same at every column
//! and row, whatever the
//! noise and however it varies over the picture: blocks begin at multiples of 8 or 16, and what is in the picture knows
//! nothing of that. Each
//! picture gives a sum of squared steps at borders and elsewhere; their ratio over all pictures has its variance by the
//! jackknife
//! (pictures left out one at a time; Efron 1982), so a few pixels that hold most of the noise make the bound wide and
//! not wrong.

use super::trial::Source;
use super::world::grey;
use tracer_reference::statistics::student;

/// Pictures: each is compared with the mean of the sixteen others.
pub const PICTURES: u32 = 17;

/// The largest ratio that is right.
pub const LIMIT: f64 = 1.15;

/// The ratio at blocks of one size.
#[derive(Clone, Copy, Debug)]
pub struct Squares {
    /// Pixels along a block's side.
    pub block: u32,
    /// Samples per pixel.
    pub samples: u32,
    /// Mean squared step at borders over that elsewhere.
    pub ratio: f64,
    /// Standard error of its logarithm.
    pub error: f64,
}

impl Squares {
    /// Upper bound at 95 %.
    pub fn upper(&self) -> f64 {
        // t of 16 degrees of freedom, one side.
        self.ratio * (1.746 * self.error).exp()
    }

    /// The chance of such a ratio were it [`LIMIT`].
    pub fn chance(&self) -> f64 {
        if self.ratio <= LIMIT || self.error.is_nan() {
            return 1.0;
        }
        0.5 * student((self.ratio / LIMIT).ln() / self.error, f64::from(PICTURES - 1))
    }
}

/// Measures blocks of 8 and of 16 pixels.
pub fn squares(source: &Source<'_>, first_seed: u32) -> [Squares; 2] {
    let pictures: Vec<Vec<f64>> = (first_seed..first_seed + PICTURES).map(|seed| pixels(source, seed)).collect();
    let width = source.scenes[0].size[0] as usize;
    let mut mean = vec![0.0; pictures[0].len()];
    for picture in &pictures {
        mean.iter_mut().zip(picture).for_each(|(mean, x)| *mean += x / f64::from(PICTURES));
    }
    // A picture less the mean of the others is this, but for a factor that falls out of the ratio.
    let errors: Vec<Vec<f64>> =
        pictures.iter().map(|picture| picture.iter().zip(&mean).map(|(x, mean)| x - mean).collect()).collect();
    [8, 16].map(|block| {
        let steps: Vec<[f64; 2]> = errors.iter().map(|error| steps(error, width, block as usize)).collect();
        let (ratio, error) = jackknife(&steps);
        Squares { block, samples: source.samples, ratio, error }
    })
}

fn pixels(source: &Source<'_>, seed: u32) -> Vec<f64> {
    let films = source.films(seed);
    let [width, height] = films[0].size();
    let pixel = |(x, y): (u32, u32)| films.iter().map(|film| grey(film.radiance(x, y))).sum();
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(pixel).collect()
}

/// Mean squared steps at borders of blocks, and elsewhere. Borders of 16 pixels are left out of the others of 8, and
/// the other way around:
/// blocks of one size must not hide behind those of another.
fn steps(error: &[f64], width: usize, block: usize) -> [f64; 2] {
    let (mut sums, mut counts) = ([0.0; 2], [0.0; 2]);
    let mut add = |position: usize, step: f64| {
        let kind = match position {
            p if p % block == 0 => 0,
            p if p % 8 != 0 => 1,
            _ => return,
        };
        sums[kind] += step * step;
        counts[kind] += 1.0;
    };
    for (k, x) in error.iter().enumerate() {
        let (column, row) = (k % width, k / width);
        if column > 0 {
            add(column, x - error[k - 1]);
        }
        if row > 0 {
            add(row, x - error[k - width]);
        }
    }
    [0, 1].map(|kind| sums[kind] / counts[kind])
}

/// The ratio of two sums, and the standard error of its logarithm.
fn jackknife(steps: &[[f64; 2]]) -> (f64, f64) {
    let sum = |left_out: usize, kind: usize| -> f64 {
        steps.iter().enumerate().filter(|(k, _)| *k != left_out).map(|(_, step)| step[kind]).sum()
    };
    let ratio = |left_out: usize| sum(left_out, 0) / sum(left_out, 1);
    let n = steps.len();
    let logs: Vec<f64> = (0..n).map(|k| ratio(k).ln()).collect();
    let mean = logs.iter().sum::<f64>() / n as f64;
    let squares: f64 = logs.iter().map(|x| (x - mean) * (x - mean)).sum();
    (ratio(n), ((n - 1) as f64 / n as f64 * squares).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use tracer_reference::Random;

    fn noise(random: &mut Random) -> f64 {
        (0..6).map(|_| random.number()).sum::<f64>() - 3.0
    }

    /// Independent pixels have none; pixels to which a block adds something of its own do.
    #[test]
    fn blocks_are_told() {
        let mut random = Random::new(1);
        for (share, low, high) in [(0.0, 0.97, 1.03), (1.0, 1.8, 2.2)] {
            let picture = |random: &mut Random| {
                let blocks: Vec<f64> = (0..64).map(|_| share * noise(random)).collect();
                (0..4096usize).map(|k| noise(random) + blocks[k / 512 * 8 + k % 64 / 8]).collect::<Vec<_>>()
            };
            let all: Vec<[f64; 2]> = (0..PICTURES).map(|_| steps(&picture(&mut random), 64, 8)).collect();
            let (ratio, error) = jackknife(&all);
            assert!((low..high).contains(&ratio) && error < 0.03, "{ratio} {error}");
        }
    }
}
