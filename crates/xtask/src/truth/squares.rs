//! Squares in the noise: steps of the error across the borders of blocks of pixels against those elsewhere.
//!
//! The error of a picture is the picture less the mean of the others, in standard deviations of the pixel's own: what
//! is in the picture lies where it lies, and a lamp's edge that happens to fall on a border must not count for one (it
//! made steps of 2.6 times the others in scenes in which no pixels hung together). Pixels that hang together within
//! blocks have errors alike there, and a step to the next block. Were there no blocks, the mean squared step would be
//! the same at every column and row. Each picture gives a sum of squared steps at borders and elsewhere; their ratio
//! over all pictures has its variance by the jackknife (pictures left out one at a time; Efron 1982), so a few events
//! that hold most of the noise make the bound wide and not wrong.

use super::trial::Source;
use super::world::grey;
use tracer_reference::statistics::student;

/// Pictures, unless more are asked for: each is compared with the mean of the sixteen others.
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
    /// How many pictures it is of.
    pub pictures: u32,
}

impl Squares {
    /// Upper bound at 95 %.
    pub fn upper(&self) -> f64 {
        self.ratio * (quantile(f64::from(self.pictures - 1)) * self.error).exp()
    }

    /// The chance of such a ratio were it [`LIMIT`].
    pub fn chance(&self) -> f64 {
        if self.ratio <= LIMIT || self.error.is_nan() {
            return 1.0;
        }
        0.5 * student((self.ratio / LIMIT).ln() / self.error, f64::from(self.pictures - 1))
    }
}

/// 95 % of Student's t with so many degrees of freedom is below this, by halving.
fn quantile(degrees: f64) -> f64 {
    let (mut low, mut high) = (0.0, 20.0);
    for _ in 0..50 {
        let middle = (low + high) / 2.0;
        // Both sides of it.
        if student(middle, degrees) > 0.1 { low = middle } else { high = middle }
    }
    low
}

/// Measures blocks of 8 and of 16 pixels by so many pictures.
pub fn squares(source: &Source<'_>, first_seed: u32, count: u32) -> [Squares; 2] {
    let pictures: Vec<Vec<f64>> = (first_seed..first_seed + count).map(|seed| pixels(source, seed)).collect();
    let width = source.scenes[0].size[0] as usize;
    let errors = errors(&pictures);
    [8, 16].map(|block| {
        let steps: Vec<[f64; 2]> = errors.iter().map(|error| steps(error, width, block as usize)).collect();
        let (ratio, error) = jackknife(&steps);
        Squares { block, samples: source.samples, ratio, error, pictures: count }
    })
}

/// Each picture less the mean of all, over the pixel's standard deviation; zero where a pixel is the same in all.
fn errors(pictures: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = pictures.len() as f64;
    let over = |f: &dyn Fn(usize) -> f64| (0..pictures[0].len()).map(f).collect::<Vec<f64>>();
    let mean = over(&|k| pictures.iter().map(|picture| picture[k]).sum::<f64>() / n);
    let deviation = over(&|k| pictures.iter().map(|picture| (picture[k] - mean[k]).powi(2)).sum::<f64>().sqrt());
    let error =
        |picture: &[f64], k: usize| if deviation[k] > 0.0 { (picture[k] - mean[k]) / deviation[k] } else { 0.0 };
    pictures.iter().map(|picture| over(&|k| error(picture, k))).collect()
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

    #[test]
    fn bounds_are_those_of_tables() {
        for (degrees, t) in [(10.0, 1.812), (16.0, 1.746), (100.0, 1.660)] {
            assert!((quantile(degrees) - t).abs() < 1e-3, "{degrees}: {}", quantile(degrees));
        }
    }

    /// Independent pixels have none; pixels to which a block adds something of its own do; noise that lies on a border
    /// does not.
    #[test]
    fn blocks_are_told() {
        let mut random = Random::new(1);
        for (share, line, low, high) in [(0.0, 1.0, 0.97, 1.03), (1.0, 1.0, 1.8, 2.2), (0.0, 100.0, 0.97, 1.03)] {
            let picture = |random: &mut Random| {
                let blocks: Vec<f64> = (0..64).map(|_| share * noise(random)).collect();
                let scale = |k: usize| if k / 64 == 16 { line } else { 1.0 };
                (0..4096usize)
                    .map(|k| scale(k) * (noise(random) + blocks[k / 512 * 8 + k % 64 / 8]))
                    .collect::<Vec<_>>()
            };
            let pictures: Vec<Vec<f64>> = (0..PICTURES).map(|_| picture(&mut random)).collect();
            let all: Vec<[f64; 2]> = errors(&pictures).iter().map(|error| steps(error, 64, 8)).collect();
            let (ratio, error) = jackknife(&all);
            assert!((low..high).contains(&ratio) && error < 0.03, "{share} {line}: {ratio} {error}");
        }
    }
}
