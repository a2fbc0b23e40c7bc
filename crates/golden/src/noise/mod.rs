//! Whether two pictures of different bytes are the same picture but for noise.
//!
//! Three questions, each asked so that pictures that differ by noise alone answer one of them wrongly in at most a
//! thousandth of all comparisons ([`FALSE_ALARMS`] in all), whatever the distribution of their samples:
//!
//! - *Light*: regions of 8x8 pixels, of 16x16 and so on up to the whole picture, each channel of each region. If the
//!   picture is the same, what batch k of one brings more than batch k of the other may as well be negative, for all k
//!   at once. [`signs`] says how rarely coins bring so large a sum. Regions of a size, and sizes, share the level
//!   (`level_of_one`).
//! - *Pixels whose samples agree*: where nearly all samples of a pixel say another light, as where an edge has moved,
//!   or nothing is noisy.
//! - *Pixels brighter than light*: more than samples as bright as the brightest light can make of it. One bright sample
//!   is noise, however rare (`pixels` says why).
//!
//! A change of less than [`LEAST_CHANGE`] of a region's light is taken for none: rounding that shows in every sample
//! alike (another compiler, another sine) is no change of a picture.

mod pixels;
pub mod signs;

use crate::measured::{CELL, Measured, batch_count, batch_start, cells, pixels_of_cell};
use serde::Serialize;

/// How often, at most, pictures that differ by noise alone are said to differ.
pub const FALSE_ALARMS: f64 = 1e-3;
/// Of these, those of regions; the others are of pixels.
const OF_REGIONS: f64 = 0.7e-3;
/// A change of a region's light, as share of it, that is none.
pub const LEAST_CHANGE: f64 = 1e-3;
/// The rarest signs of so many batches are so many times rarer than a test's level, or the test is not made: it would
/// need each batch to agree.
const SPARE: f64 = 16.0;

/// A finding.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// In a sentence.
    pub what: String,
    /// The region: left, top, width, height.
    pub region: [u32; 4],
    /// The probability, at most, of such a finding anywhere in the picture by noise alone.
    pub probability: f64,
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Judgement {
    /// They differ as two pictures with other random numbers do.
    Noise {
        /// The least probability that any test gave, of all of them.
        probability: f64,
    },
    /// They do not.
    Different {
        /// At least one, those of the smallest regions first.
        findings: Vec<Finding>,
    },
    /// It cannot be told.
    Unknown {
        /// In a sentence.
        why: String,
    },
}

/// Findings that are told.
const TOLD: usize = 3;

/// The level of one of so many tests of which any may fail (Šidák 1967).
fn level_of_one(level: f64, tests: usize) -> f64 {
    -libm::expm1(libm::log1p(-level) / tests as f64)
}

/// The other way: the probability that any of so many tests gives one so small.
fn of_all(probability: f64, tests: usize) -> f64 {
    if probability >= 1.0 { 1.0 } else { -libm::expm1(libm::log1p(-probability) * tests as f64) }
}

/// Judges whether `actual` is `expected` but for noise.
pub fn judge(expected: &Measured, actual: &Measured) -> Judgement {
    let size = |m: &Measured| (m.width, m.height);
    if size(expected) != size(actual) {
        let (e, a) = (size(expected), size(actual));
        return unknown(format!("the size is {}x{}, expected {}x{}", a.0, a.1, e.0, e.1));
    }
    if expected.samples != actual.samples {
        return unknown(format!("there are {} samples a pixel, expected {}", actual.samples, expected.samples));
    }
    if expected.look != actual.look {
        return unknown(format!("it is developed by {}, expected {}", actual.look, expected.look));
    }
    let scales = scales(expected);
    if scales.is_empty() {
        return unknown(format!("{} samples are too few to know the noise; 32 are enough", expected.samples));
    }
    let mut findings = Vec::new();
    let mut least: f64 = 1.0;
    for scale in &scales {
        let tests = 3 * scale.columns * scale.rows * scales.len();
        for region in scale.regions() {
            for (c, name) in ["red", "green", "blue"].into_iter().enumerate() {
                let Some((one, change)) = light(expected, actual, &region, c, scale.level) else { continue };
                let probability = of_all(one, tests) * FALSE_ALARMS / OF_REGIONS;
                least = least.min(probability);
                if one <= scale.level {
                    let what = format!("{} of {name} light by {:+.2} %", region.name(expected), 100.0 * change);
                    findings.push(Finding { what, region: region.pixels(expected), probability });
                }
            }
        }
    }
    let level = FALSE_ALARMS - OF_REGIONS;
    let (probability, found) = pixels::far_out(expected, actual, level);
    least = least.min(probability * FALSE_ALARMS / level);
    findings.extend(found.into_iter().map(|pixel| {
        let ([x, y], [e, a]) = (pixel.at, pixel.is);
        let what = format!("pixel ({x}, {y}) {}: {a:.4}, expected {e:.4}", pixel.what);
        Finding { what, region: [x, y, 1, 1], probability: (pixel.probability * FALSE_ALARMS / level).min(1.0) }
    }));
    if findings.is_empty() {
        return Judgement::Noise { probability: least };
    }
    // Each is certain enough; the smallest region says most about where.
    let area = |finding: &Finding| u64::from(finding.region[2]) * u64::from(finding.region[3]);
    findings.sort_by(|a, b| area(a).cmp(&area(b)).then(a.probability.total_cmp(&b.probability)));
    findings.dedup_by_key(|finding| finding.region);
    findings.truncate(TOLD);
    Judgement::Different { findings }
}

fn unknown(why: String) -> Judgement {
    Judgement::Unknown { why }
}

/// Regions of one size.
struct Scale {
    /// Cells along a side of a region.
    side: usize,
    columns: usize,
    rows: usize,
    /// The level of one region's one channel.
    level: f64,
    cells: [usize; 2],
}

/// Cells from a column and a row on, before another.
struct Region {
    columns: std::ops::Range<usize>,
    rows: std::ops::Range<usize>,
    whole: bool,
}

impl Region {
    fn pixels(&self, of: &Measured) -> [u32; 4] {
        let side = |cells: &std::ops::Range<usize>, all: u32| {
            let from = cells.start as u32 * CELL;
            [from, (cells.end as u32 * CELL).min(all) - from]
        };
        let ([x, width], [y, height]) = (side(&self.columns, of.width), side(&self.rows, of.height));
        [x, y, width, height]
    }

    fn name(&self, of: &Measured) -> String {
        let [x, y, width, height] = self.pixels(of);
        if self.whole {
            "the whole picture differs".to_owned()
        } else {
            format!("{width}x{height} pixels at ({x}, {y}) differ")
        }
    }
}

impl Scale {
    fn regions(&self) -> impl Iterator<Item = Region> + use<'_> {
        let [all_columns, all_rows] = self.cells;
        (0..self.rows).flat_map(move |row| {
            (0..self.columns).map(move |column| Region {
                columns: column * self.side..((column + 1) * self.side).min(all_columns),
                rows: row * self.side..((row + 1) * self.side).min(all_rows),
                whole: self.columns * self.rows == 1,
            })
        })
    }
}

/// The sizes of regions whose tests so many batches can fail.
fn scales(of: &Measured) -> Vec<Scale> {
    let cells = cells(of.width, of.height);
    let sides = || {
        (0..).map(|k| 1usize << k).scan(false, |done, side| {
            let now = !*done;
            *done = side >= cells[0].max(cells[1]);
            now.then_some(side)
        })
    };
    let rarest = libm::exp2(-f64::from(batch_count(of.samples)));
    let scale = |side: usize, of_scale: f64| {
        let [columns, rows] = cells.map(|n| n.div_ceil(side));
        // Two for both signs.
        let level = level_of_one(of_scale, 3 * columns * rows);
        Scale { side, columns, rows, level, cells }
    };
    let mut kept: Vec<usize> = sides().collect();
    loop {
        let of_scale = level_of_one(OF_REGIONS, kept.len().max(1));
        let scales: Vec<Scale> = kept.iter().map(|&side| scale(side, of_scale)).collect();
        match scales.first() {
            Some(first) if 2.0 * rarest * SPARE > first.level => drop(kept.remove(0)),
            _ => return scales,
        }
    }
}

/// How probable, at most, the difference of a region's channel is by noise, with both signs; and the difference as
/// share of the light. `None` where that is not worth asking.
fn light(expected: &Measured, actual: &Measured, region: &Region, c: usize, level: f64) -> Option<(f64, f64)> {
    let [columns, rows] = cells(expected.width, expected.height);
    let count = batch_count(expected.samples);
    let (mut sums, mut differences) = ([0.0; 2], Vec::with_capacity(count as usize));
    for k in 0..count {
        let samples = f64::from(batch_start(expected.samples, k + 1) - batch_start(expected.samples, k));
        let mut of_batch = [0.0; 2];
        for row in region.rows.clone() {
            for column in region.columns.clone() {
                let weight = samples * pixels_of_cell(expected.width, expected.height, column, row);
                let at = 3 * ((k as usize * rows + row) * columns + column) + c;
                of_batch[0] += weight * f64::from(expected.batches[at]);
                of_batch[1] += weight * f64::from(actual.batches[at]);
            }
        }
        sums = [sums[0] + of_batch[0], sums[1] + of_batch[1]];
        differences.push(of_batch[1] - of_batch[0]);
    }
    let sum: f64 = differences.iter().sum();
    let light = (sums[0].abs() + sums[1].abs()) / 2.0;
    let none = LEAST_CHANGE * light / f64::from(count);
    let sign = sum.signum();
    differences.iter_mut().for_each(|d| *d = sign * *d - none);
    if !signs::may_reach(&differences, level / 2.0) {
        return None;
    }
    Some(((2.0 * signs::probability(&differences)).min(1.0), sum / light.max(f64::MIN_POSITIVE)))
}

#[cfg(test)]
mod tests;
