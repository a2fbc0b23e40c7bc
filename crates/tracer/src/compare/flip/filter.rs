//! Convolutions of FLIP: all its kernels are products of one for the rows and one for the columns, or sums of such.

use super::PIXELS_PER_DEGREE;
use rayon::prelude::*;

/// One number a pixel.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    pub width: usize,
    pub values: Vec<f32>,
}

/// Weights of the pixels from -r to r.
#[derive(Clone, Debug)]
pub(super) struct Kernel {
    weights: Vec<f32>,
}

/// a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees: the transform of a Gaussian contrast sensitivity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gaussian {
    pub a: f64,
    pub b: f64,
}

/// A sum of Gaussians with weight one in all.
#[derive(Clone, Debug)]
pub(super) struct Sum {
    terms: Vec<Term>,
}

#[derive(Clone, Debug)]
struct Term {
    weight: f32,
    kernel: Kernel,
}

/// The widest of the Gaussians: all channels are cut off where it has fallen to nothing, at 3 standard deviations.
const WIDEST: f64 = 0.04;

impl Sum {
    pub fn new(gaussians: &[Gaussian]) -> Self {
        let pi = std::f64::consts::PI;
        let per_degree = f64::from(PIXELS_PER_DEGREE);
        let radius = (3.0 * (WIDEST / (2.0 * pi * pi)).sqrt() * per_degree).ceil() as i32;
        let unscaled: Vec<(f64, Vec<f64>)> = gaussians
            .iter()
            .map(|g| {
                let weights = (-radius..=radius).map(|x| {
                    let degrees = f64::from(x) / per_degree;
                    (-pi * pi * degrees * degrees / g.b).exp()
                });
                (g.a * (pi / g.b).sqrt(), weights.collect())
            })
            .collect();
        let total: f64 = unscaled.iter().map(|(scale, w)| scale * w.iter().sum::<f64>().powi(2)).sum();
        let terms = unscaled
            .into_iter()
            .map(|(scale, weights)| Term {
                weight: (scale / total) as f32,
                kernel: Kernel { weights: weights.into_iter().map(|w| w as f32).collect() },
            })
            .collect();
        Sum { terms }
    }

    pub fn blur(&self, plane: &Plane) -> Plane {
        let mut sum = Plane { width: plane.width, values: vec![0.0; plane.values.len()] };
        for term in &self.terms {
            let blurred = plane.convolved(&term.kernel, &term.kernel);
            for (sum, value) in sum.values.iter_mut().zip(blurred.values) {
                *sum += term.weight * value;
            }
        }
        sum
    }
}

impl Kernel {
    /// A Gaussian as wide as the eye's edge detector, its first derivative and its second. The Gaussian sums to 1, of
    /// the others the positive weights do and the negative ones sum to -1.
    pub fn of_features() -> [Kernel; 3] {
        // Peak to trough of the detector, in degrees: two standard deviations.
        const WIDTH: f64 = 0.082;
        let sigma = 0.5 * WIDTH * f64::from(PIXELS_PER_DEGREE);
        let radius = (3.0 * sigma).ceil() as i32;
        let kernel = |weight: &dyn Fn(f64) -> f64| {
            let weights: Vec<f64> = (-radius..=radius)
                .map(|x| weight(f64::from(x)) * (-f64::from(x * x) / (2.0 * sigma * sigma)).exp())
                .collect();
            let positive: f64 = weights.iter().filter(|w| **w > 0.0).sum();
            let negative: f64 = -weights.iter().filter(|w| **w < 0.0).sum::<f64>();
            let scaled = weights.iter().map(|&w| (if w > 0.0 { w / positive } else { w / negative.max(1e-30) }) as f32);
            Kernel { weights: scaled.collect() }
        };
        [kernel(&|_| 1.0), kernel(&|x| -x), kernel(&|x| x * x / (sigma * sigma) - 1.0)]
    }
}

impl Plane {
    /// Convolved by one kernel along the rows and by one along the columns; beyond the border its pixels go on.
    pub fn convolved(&self, along_rows: &Kernel, along_columns: &Kernel) -> Plane {
        let width = self.width;
        let height = self.values.len() / width;
        let mut rows = vec![0.0; self.values.len()];
        rows.par_chunks_mut(width).zip(self.values.par_chunks(width)).for_each(|(out, row)| {
            for (x, out) in out.iter_mut().enumerate() {
                *out = weighted(along_rows, x, width, |x| row[x]);
            }
        });
        let mut values = vec![0.0; self.values.len()];
        values.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
            for (x, out) in out.iter_mut().enumerate() {
                *out = weighted(along_columns, y, height, |y| rows[y * width + x]);
            }
        });
        Plane { width, values }
    }
}

/// The weighted sum around a pixel of a line of `length` pixels.
fn weighted(kernel: &Kernel, centre: usize, length: usize, value: impl Fn(usize) -> f32) -> f32 {
    let radius = kernel.weights.len() / 2;
    kernel
        .weights
        .iter()
        .enumerate()
        .map(|(k, weight)| weight * value((centre + k).saturating_sub(radius).min(length - 1)))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blurring_keeps_what_is_even() {
        let even = Plane { width: 7, values: vec![0.3; 35] };
        let sum = Sum::new(&[Gaussian { a: 34.1, b: 0.04 }, Gaussian { a: 13.5, b: 0.025 }]);
        assert!(sum.blur(&even).values.iter().all(|v| (v - 0.3).abs() < 1e-6));
        let [smooth, first, second] = Kernel::of_features();
        assert!(even.convolved(&smooth, &smooth).values.iter().all(|v| (v - 0.3).abs() < 1e-6));
        for derivative in [first, second] {
            assert!(even.convolved(&derivative, &smooth).values.iter().all(|v| v.abs() < 1e-6));
        }
    }

    /// A step of height h has a first derivative of at most h: the positive weights sum to one.
    #[test]
    fn a_step_is_an_edge_of_its_height() {
        let step = Plane { width: 40, values: (0..40 * 40).map(|k| if k % 40 < 20 { 0.0 } else { 0.5 }).collect() };
        let [smooth, first, _] = Kernel::of_features();
        let edges = step.convolved(&first, &smooth).values;
        let most = edges.iter().fold(0.0f32, |most, v| most.max(v.abs()));
        assert!((most - 0.5).abs() < 1e-5, "{most}");
    }
}
