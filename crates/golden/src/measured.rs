//! A picture with what is known of its noise: sums of cells over batches of its samples.

/// Pixels along a side of a cell, the smallest region whose light is compared.
pub const CELL: u32 = 8;

/// Most batches that the samples are divided into. With 64 the exact test of signs ([`crate::noise`]) gets below any
/// level that a picture of 65536x65536 pixels asks for.
pub const MOST_BATCHES: u32 = 64;

/// A picture, linear and exposed as EXR files have it, with its noise.
///
/// What one sample index brings to a region holds all that pixels have in common at that index: what they share, light
/// paths, the pixel filter. Different indices have nothing in common but the stratification of the sampler, which makes
/// their mean better than that of independent ones. So the spread over batches of indices is the noise of a region of
/// any shape, bounded from above, without a model of how neighbours correlate.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples of each pixel.
    pub samples: u32,
    /// What no sample is brighter than: the brightest light or background, in `rgb`'s unit.
    pub brightest: f32,
    /// How the picture becomes display values, in words: pictures that are developed otherwise are not compared by
    /// their light.
    pub look: String,
    /// Red, green, blue of each pixel, row by row from the top.
    pub rgb: Vec<f32>,
    /// Estimated variance of each pixel's luminance, were its samples independent; in the square of `rgb`'s unit.
    pub variance: Vec<f32>,
    /// Mean over the pixels of a cell and the samples of a batch: red, green, blue of each cell, row by row, batch
    /// after batch.
    pub batches: Vec<f32>,
}

/// Cells along width and height.
pub fn cells(width: u32, height: u32) -> [usize; 2] {
    [width.div_ceil(CELL) as usize, height.div_ceil(CELL) as usize]
}

/// How many batches so many samples make.
pub fn batch_count(samples: u32) -> u32 {
    samples.min(MOST_BATCHES)
}

/// Samples before batch `k`: batches differ by one sample at most.
pub fn batch_start(samples: u32, k: u32) -> u32 {
    (u64::from(samples) * u64::from(k) / u64::from(batch_count(samples).max(1))) as u32
}

/// Pixels of a cell; those at the right and lower border have fewer.
pub fn pixels_of_cell(width: u32, height: u32, column: usize, row: usize) -> f64 {
    let side = |all: u32, k: usize| f64::from((all - k as u32 * CELL).min(CELL));
    side(width, column) * side(height, row)
}

/// Makes the batches while a picture is rendered.
#[derive(Clone, Debug)]
pub struct Recorder {
    width: u32,
    height: u32,
    samples: u32,
    /// Samples that were seen last.
    seen: u32,
    /// Batches that are full.
    full: u32,
    /// Sums of the cells over all samples that were seen.
    before: Vec<f64>,
    batches: Vec<f32>,
}

impl Recorder {
    /// For a picture of this size and so many samples.
    pub fn new(width: u32, height: u32, samples: u32) -> Self {
        let [columns, rows] = cells(width, height);
        Recorder {
            width,
            height,
            samples,
            seen: 0,
            full: 0,
            before: vec![0.0; 3 * columns * rows],
            batches: Vec::with_capacity(3 * columns * rows * batch_count(samples) as usize),
        }
    }

    /// Whether a batch ends where every pixel has so many samples: then, and only then, [`Recorder::see`] wants to see
    /// the picture.
    pub fn wants(&self, samples: u32) -> bool {
        self.full < batch_count(self.samples) && samples == batch_start(self.samples, self.full + 1)
    }

    /// Takes the mean radiance of all pixels over so many samples.
    pub fn see(&mut self, samples: u32, pixel: impl Fn(u32, u32) -> [f64; 3]) {
        let [columns, rows] = cells(self.width, self.height);
        let mut sums = vec![0.0; 3 * columns * rows];
        for y in 0..self.height {
            for x in 0..self.width {
                let cell = (y / CELL) as usize * columns + (x / CELL) as usize;
                for (c, value) in pixel(x, y).into_iter().enumerate() {
                    sums[3 * cell + c] += value * f64::from(samples);
                }
            }
        }
        let count = f64::from(samples - self.seen);
        for (k, (&sum, before)) in sums.iter().zip(&mut self.before).enumerate() {
            let cell = k / 3;
            let pixels = pixels_of_cell(self.width, self.height, cell % columns, cell / columns);
            self.batches.push(((sum - *before) / (pixels * count)) as f32);
            *before = sum;
        }
        (self.seen, self.full) = (samples, self.full + 1);
    }

    /// The batches, when all of them were seen.
    pub fn batches(self) -> Option<Vec<f32>> {
        (self.full == batch_count(self.samples)).then_some(self.batches)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The picture grows by what each sample brings; the batches are the means of that.
    #[test]
    fn batches_are_means_of_what_samples_bring() {
        for samples in [3, 64, 100, 640] {
            let (width, height) = (11, 9);
            let mut recorder = Recorder::new(width, height, samples);
            let brings = |k: u32, x: u32, y: u32| f64::from((k * 7 + x * 3 + y * 5) % 11);
            let mut ends = Vec::new();
            for n in 1..=samples {
                if recorder.wants(n) {
                    ends.push(n);
                    let mean =
                        |x, y| [1.0, 2.0, 0.0].map(|c| c * (0..n).map(|k| brings(k, x, y)).sum::<f64>() / f64::from(n));
                    recorder.see(n, mean);
                }
            }
            assert_eq!(ends.last(), Some(&samples));
            assert_eq!(ends.len() as u32, samples.min(MOST_BATCHES));
            let batches = recorder.batches().expect("all batches");
            let [columns, rows] = cells(width, height);
            assert_eq!(batches.len(), 3 * columns * rows * ends.len());
            // The last cell has three columns and one row.
            let (from, to) = (batch_start(samples, 1), batch_start(samples, 2));
            let mut expected = 0.0;
            for k in from..to {
                for x in 8..11 {
                    expected += brings(k, x, 8);
                }
            }
            expected /= 3.0 * f64::from(to - from);
            let cell = 3 * columns * rows + 3 * (columns * rows - 1);
            assert!((f64::from(batches[cell]) - expected).abs() < 1e-5, "{samples}");
            assert!((f64::from(batches[cell + 1]) - 2.0 * expected).abs() < 1e-5 && batches[cell + 2] == 0.0);
        }
    }
}
