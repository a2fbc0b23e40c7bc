//! Whether two pictures of different bytes are the same picture but for noise.
//!
//! Three questions, each asked so that pictures that differ by noise alone answer one of them wrongly in at most a
//! thousandth of all comparisons ([`FALSE_ALARMS`] in all), whatever the distribution of their samples:
//!
//! - *Light*: regions of 8x8 pixels, of 16x16 and so on up to the whole picture, each channel of each region. If the
//!   picture is the same, what
//!   batch k of one brings more than batch k of the other may as well be negative, for all k at once. [`signs`] says
//!   how rarely coins bring so large a
//!   sum. Regions of a size, and sizes, share the level ([`level_of_one`]).
//! - *Pixels far out*: a firefly is in one batch, of which the signs say nothing. [`tail`] asks whether the largest
//!   differences go on where the others end.
//! - *Pixels without noise*: where all samples of both are the same number, the numbers are compared.
//!
//! A change of less than [`LEAST_CHANGE`] of a region's light is taken for none: rounding that shows in every sample
//! alike (another
//! compiler, another sine) is no change of a picture.

pub mod signs;
pub mod tail;

use crate::measured::{CELL, Measured, batch_count, batch_start, cells, pixels_of_cell};
use serde::Serialize;

/// How often, at most, pictures that differ by noise alone are said to differ.
pub const FALSE_ALARMS: f64 = 1e-3;
/// Of these, those of regions; the others are of pixels far out.
const OF_REGIONS: f64 = 0.7e-3;
/// A change of a region's light, as share of it, that is none.
pub const LEAST_CHANGE: f64 = 1e-3;
/// The rarest signs of so many batches are so many times rarer than a test's level, or the test is not made: it would
/// need each batch to agree.
const SPARE: f64 = 16.0;
/// Where a pixel's samples are all alike, rounding leaves no more than this share of the square as their variance.
const ROUNDING: f64 = 1e-10;
/// Differences are measured by the noise of the pixels around, this far.
const REACH: i64 = 2;
/// Where too few pixels differ to tell a tail, a difference of so many standard deviations of both pictures is too
/// large.
const FAR_OUT: f64 = 12.0;

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
    let (probability, found) = pixels(expected, actual);
    least = least.min(probability);
    findings.extend(found);
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
/// share of the light. `None`
/// where that is not worth asking.
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

fn luminance(rgb: &[f32]) -> f64 {
    0.2126 * f64::from(rgb[0]) + 0.7152 * f64::from(rgb[1]) + 0.0722 * f64::from(rgb[2])
}

/// Pixels far out, and pixels without noise.
fn pixels(expected: &Measured, actual: &Measured) -> (f64, Vec<Finding>) {
    let (width, height) = (i64::from(expected.width), i64::from(expected.height));
    let at = |x: i64, y: i64| (y * width + x) as usize;
    let of_pixel = |m: &Measured, i: usize| luminance(&m.rgb[3 * i..3 * i + 3]);
    let variance = |i: usize| f64::from(expected.variance[i]) + f64::from(actual.variance[i]);
    let mut findings = Vec::new();
    let mut differences: Vec<(f64, [u32; 2])> = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let i = at(x, y);
            let (e, a) = (of_pixel(expected, i), of_pixel(actual, i));
            let place = [x as u32, y as u32];
            let channels = 3 * i..3 * i + 3;
            if expected.rgb[channels.clone()] == actual.rgb[channels.clone()] {
                continue;
            }
            if variance(i) <= ROUNDING * (e * e + a * a) {
                let pairs = expected.rgb[channels.clone()].iter().zip(&actual.rgb[channels]);
                if pairs
                    .into_iter()
                    .any(|(e, a)| f64::from((e - a).abs()) > LEAST_CHANGE * f64::from(e.abs().max(a.abs())))
                {
                    let what = format!("pixel ({x}, {y}) has no noise and is {a:.4}, expected {e:.4}");
                    findings.push(Finding { what, region: [place[0], place[1], 1, 1], probability: 0.0 });
                }
                continue;
            }
            // The pixel's own variance is left out: a firefly makes it as large as itself.
            let (mut noise, mut light, mut count) = (0.0, 0.0, 0.0);
            for near_y in (y - REACH).max(0)..(y + REACH + 1).min(height) {
                for near_x in (x - REACH).max(0)..(x + REACH + 1).min(width) {
                    let near = at(near_x, near_y);
                    if near != i {
                        noise += variance(near);
                        light += of_pixel(expected, near).abs() + of_pixel(actual, near).abs();
                        count += 1.0;
                    }
                }
            }
            // Where all around is without noise, the light around is the measure.
            let scale =
                if count > 0.0 { (noise / count).sqrt().max(LEAST_CHANGE * light / count) } else { variance(i).sqrt() };
            let difference = (e - a).abs() / scale.max(f64::MIN_POSITIVE);
            if difference > 0.0 {
                differences.push((difference, place));
            }
        }
    }
    differences.sort_by(|a, b| b.0.total_cmp(&a.0));
    let numbers: Vec<f64> = differences.iter().map(|(difference, _)| *difference).collect();
    let (probability, far) = far_out(&numbers);
    findings.extend(differences.iter().take(far).map(|(difference, [x, y])| {
        let (e, a) = (of_pixel(expected, at((*x).into(), (*y).into())), of_pixel(actual, at((*x).into(), (*y).into())));
        let what = format!("pixel ({x}, {y}) is {a:.4}, expected {e:.4}: {difference:.0} times the noise around");
        Finding { what, region: [*x, *y, 1, 1], probability }
    }));
    (if findings.is_empty() { probability } else { findings[0].probability.min(probability) }, findings)
}

/// How many of the differences, in descending order and in units of their noise, lie too far out, and how probable that
/// is.
fn far_out(differences: &[f64]) -> (f64, usize) {
    let level = FALSE_ALARMS - OF_REGIONS;
    match tail::widest_gap(differences) {
        Some(gap) => {
            let probability = gap.probability * FALSE_ALARMS / level;
            (probability.min(1.0), if gap.probability <= level { gap.above } else { 0 })
        }
        None => (1.0, differences.iter().filter(|difference| **difference > FAR_OUT).count()),
    }
}

#[cfg(test)]
mod tests;
