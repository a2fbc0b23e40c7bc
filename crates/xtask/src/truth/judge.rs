//! Whether two ways to the same picture agree: a sequential test that rare light does not fool.
//!
//! # What is tested
//!
//! For the whole picture and each of its tiles, a and b being the expectations of the two ways, b the truth: H0: |a -
//! b| <= t b, with t the
//! tolerance ([`TOLERANCE_PICTURE`], [`TOLERANCE_TILE`]). Whole pictures with independent seeds are the independent
//! values: however the pixels
//! of one hang together, the spread over pictures tells the variance of a region's mean.
//!
//! # Levels
//!
//! A thousand scenes shall give a finding by chance once in a hundred times: 1e-5 a scene. That is a product of two.
//! The pictures of the
//! stages ([`STAGES`]) may raise a suspicion, at the level [`SUSPICION`] a scene, divided (Bonferroni) among stages,
//! regions and the two
//! directions; so it does not matter that stages share pictures. A suspicion is tried anew on as many fresh pictures as
//! raised it, sixteen or more, for the
//! suspected regions and directions only, at the level [`CONFIRMATION`], divided among these. Fresh pictures know
//! nothing of the old ones: the chance of
//! both is at most 1e-2 x 1e-3.
//!
//! # Rare light
//!
//! Welch's t is safe against what is there: one value that outweighs all others moves the mean by x/n and the standard
//! error by as
//! much, so |t| is about 1 and nothing is suspected. It is not safe against what is not there. Light that is found once
//! in a thousand pictures is
//! missing from most means, and from their standard errors. So only the side with the *lower* mean can fool, by light
//! that it has not found, and it gets
//! an allowance. Were the light in question spread over events of value v (per sample) and probability p, then N
//! samples miss them all with
//! probability (1-p)^N <= exp(-pN); at level l that excludes p > ln(1/l)/N, so what is missed at level l is at most v
//! ln(1/l)/N: the rule of three for other levels than 5 %.
//! What v may be depends on which side is lower:
//!
//! * What comes in lumps (a path that lights 64 pixels, a photon that lights a disc): the largest deviation of a cell
//!   of 16x16
//!   pixels from its mean over the pictures; N is the number of such cells. This is allowed for on either side.
//! * Light that only chance finds: the plain path tracer's rays that leave a matt surface, pass mirrors or glass and
//!   meet a lamp bring all of its
//!   radiance, and a small lamp is met so seldom that it may not have been met at all. A sample brings at most what the
//!   brightest lamp has, since
//!   throughputs are at most one (times [`GAIN`] where a material reflects more than it gets); N is the number of
//!   samples in the region. This is
//!   allowed for where the plain path tracer is lower ([`Question::brightest`]) and the scene has mirrors, glass or
//!   narrow lobes. Without these, light samples
//!   find every lamp, and bring what its solid angle lets them, which the cells show.
//!   Where the default picture is lower, its light was found by plain paths often enough to be measured, and a default
//!   that finds it more seldom
//!   than these is what this test is to find.
//!
//! Where the allowance or the standard error is larger than what is to be told, nothing is told, and the report says so
//! with the error that was
//! reached ([`Told::error`]). This is a stricter rule than a median of means, which needs the variance to bound its
//! error, and the variance is just what rare light hides.

use super::trial::{CELL, Picture, Pictures, Region, regions};
use tracer_reference::statistics::Estimate;

/// What the whole picture may be off, relative to the truth.
pub const TOLERANCE_PICTURE: f64 = 0.003;

/// What a tile of 32x32 pixels may be off.
pub const TOLERANCE_TILE: f64 = 0.015;

/// Pictures of each side by the end of each stage.
pub const STAGES: [usize; 4] = [4, 8, 16, 32];

/// The chance of a suspicion in a scene without a fault.
pub const SUSPICION: f64 = 1e-2;

/// The chance to confirm a false one.
pub const CONFIRMATION: f64 = 1e-3;

/// More pictures are made where a region differs by more than half of the tolerance at this level: the sixteen tiles of
/// a sound scene
/// have a chance of one in six at most to ask for them.
const DOUBT: f64 = 0.01;

/// More pictures are made once while the whole picture's standard error is more than this.
const WANTED: f64 = 0.01;

/// The report's Blinn-Phong lobe reflects up to 3.8 times what it gets.
pub const GAIN: f64 = 4.0;

/// Two ways to what should be the same picture.
#[derive(Clone, Copy)]
pub struct Question<'a> {
    /// What is doubted.
    pub ours: &'a dyn Pictures,
    /// The truth.
    pub theirs: &'a dyn Pictures,
    /// Cells along a side of the pictures.
    pub across: usize,
    /// Samples of the truth in a pixel.
    pub samples: u32,
    /// The most that a sample of the plain path tracer brings by chance alone; zero where light samples find all light.
    pub brightest: f64,
}

/// A region that differs.
#[derive(Clone, Debug)]
pub struct Difference {
    /// Where.
    pub region: String,
    /// (ours - theirs)/theirs.
    pub relative: f64,
    /// Its standard error.
    pub error: f64,
    /// What ours and theirs are.
    pub means: [f64; 2],
    /// How many pictures of each side say so.
    pub pictures: usize,
}

/// What was told in the end.
#[derive(Clone, Debug, Default)]
pub struct Told {
    /// Confirmed differences, the whole picture first.
    pub differences: Vec<Difference>,
    /// Three standard errors and the allowance for rare light, of the whole picture, relative: what differs by less was
    /// not told.
    pub error: f64,
    /// The same of the tile in the middle of all tiles, when they are sorted by it.
    pub tile_error: f64,
    /// Pictures of each side.
    pub pictures: usize,
    /// All pictures of ours.
    pub ours: Vec<Picture>,
}

/// A region of two sets of pictures.
struct Comparison {
    ours: Estimate,
    theirs: Estimate,
    /// What the lower side may have missed, for each unit of ln(1/level).
    missed: f64,
}

impl Comparison {
    fn new(region: &Region, ours: &[Picture], theirs: &[Picture], question: &Question<'_>) -> Self {
        let [a, b] = [ours, theirs].map(|pictures| Estimate::of(&region.means(pictures)));
        let lower = a.mean < b.mean;
        let pictures = if lower { ours } else { theirs };
        let brightest = if lower { 0.0 } else { question.brightest };
        let cells = (region.cells.len() * pictures.len()) as f64;
        let per_cell = f64::from(CELL * CELL) * f64::from(question.samples);
        let mut lump = 0.0f64;
        for &cell in &region.cells {
            let mean = pictures.iter().map(|p| p.cells[cell]).sum::<f64>() / pictures.len() as f64;
            lump = pictures.iter().fold(lump, |lump, p| lump.max((p.cells[cell] - mean).abs()));
        }
        Comparison { ours: a, theirs: b, missed: lump / cells + brightest / (cells * per_cell) }
    }

    fn error(&self) -> f64 {
        (self.ours.variance + self.theirs.variance).sqrt()
    }

    /// Whether they differ by more than the tolerance at this level, one direction.
    fn differ(&self, tolerance: f64, level: f64) -> bool {
        let apart = (self.ours.mean - self.theirs.mean).abs();
        let excess = apart - tolerance * self.theirs.mean.abs() - self.missed * (1.0 / level).ln();
        if excess.is_nan() {
            return true;
        }
        // A mean that is too far off by `excess`, tested for zero. Two-sided tails are halved.
        let shifted = Estimate { mean: excess, ..self.ours };
        excess > 0.0 && 0.5 * shifted.compare(&Estimate { mean: 0.0, ..self.theirs }).probability < level
    }

    fn difference(&self, region: &Region, pictures: usize) -> Difference {
        let truth = if self.theirs.mean == 0.0 { f64::MIN_POSITIVE } else { self.theirs.mean };
        Difference {
            region: region.name.clone(),
            relative: (self.ours.mean - self.theirs.mean) / truth,
            error: self.error() / truth,
            means: [self.ours.mean, self.theirs.mean],
            pictures,
        }
    }

    /// See [`Told::error`]. Tiles that are all but black are measured by a hundredth of the whole picture.
    fn told(&self, whole: f64) -> f64 {
        let least = (0.01 * whole).max(f64::MIN_POSITIVE);
        (3.0 * self.error() + self.missed * (1.0 / CONFIRMATION).ln()) / self.theirs.mean.abs().max(least)
    }
}

fn tolerance(region: usize) -> f64 {
    if region == 0 { TOLERANCE_PICTURE } else { TOLERANCE_TILE }
}

/// Asks until it is told, or until the last stage.
pub fn judge(question: &Question<'_>, first_seed: u32) -> Told {
    let regions = regions(question.across);
    let level = SUSPICION / (STAGES.len() * regions.len() * 2) as f64;
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    let mut told = Told::default();
    for (stage, &count) in STAGES.iter().enumerate() {
        let new = count - ours.len();
        let from = first_seed + ours.len() as u32;
        ours.extend(question.ours.pictures(from, new));
        theirs.extend(question.theirs.pictures(from + 0x4000_0000, new));
        let compared: Vec<Comparison> =
            regions.iter().map(|region| Comparison::new(region, &ours, &theirs, question)).collect();
        let suspected: Vec<usize> = (0..regions.len()).filter(|&k| compared[k].differ(tolerance(k), level)).collect();
        let whole = compared[0].theirs.mean.abs();
        told.error = compared[0].told(whole);
        told.tile_error = median(compared[1..].iter().map(|tile| tile.told(whole)).collect());
        told.pictures = count;
        if !suspected.is_empty() {
            told.differences = confirm(question, &regions, &compared, &suspected, count.max(16), first_seed);
        }
        let known = compared[0].error() <= WANTED * compared[0].theirs.mean.abs();
        let go_on = stage == 0 && !known || doubtful(&compared);
        if !told.differences.is_empty() || !go_on {
            break;
        }
    }
    told.ours = ours;
    told
}

fn doubtful(compared: &[Comparison]) -> bool {
    compared.iter().enumerate().any(|(k, comparison)| comparison.differ(0.5 * tolerance(k), DOUBT))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// Tries suspected regions anew.
fn confirm(
    question: &Question<'_>,
    regions: &[Region],
    before: &[Comparison],
    suspected: &[usize],
    count: usize,
    first_seed: u32,
) -> Vec<Difference> {
    let first = first_seed + 1000;
    let (ours, theirs) = (question.ours.pictures(first, count), question.theirs.pictures(first + 0x4000_0000, count));
    let level = CONFIRMATION / suspected.len() as f64;
    let again = |&k: &usize| {
        let comparison = Comparison::new(&regions[k], &ours, &theirs, question);
        let way = |c: &Comparison| c.ours.mean > c.theirs.mean;
        let same = way(&comparison) == way(&before[k]);
        (same && comparison.differ(tolerance(k), level)).then(|| comparison.difference(&regions[k], count))
    };
    suspected.iter().filter_map(again).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tracer_reference::Random;

    /// Cells with even noise, and lumps of light that come seldom: `lump` in one cell of `seldom` pictures; both have
    /// this mean.
    struct Made {
        mean: f64,
        lump: f64,
        seldom: usize,
    }

    impl Pictures for Made {
        fn pictures(&self, first: u32, count: usize) -> Vec<Picture> {
            let picture = |seed: u32| {
                let mut random = Random::new(u64::from(seed));
                let cell = |random: &mut Random| {
                    let noise = 0.1 * self.mean * random.between(-1.0, 1.0);
                    let found = self.seldom > 0 && random.below(self.seldom) == 0;
                    let chance = if self.seldom > 0 { 1.0 / self.seldom as f64 } else { 0.0 };
                    self.mean - self.lump * chance + noise + if found { self.lump } else { 0.0 }
                };
                let cells = (0..64).map(|_| cell(&mut random)).collect();
                Picture { cells, negative: 0, lowest: 0.0, lit: 0, dropped: 0 }
            };
            (first..first + count as u32).map(picture).collect()
        }
    }

    /// The chance of a finding in a scene without a fault is 1e-5, whatever the noise; `brightest` in units of a cell's
    /// lump.
    fn findings(ours: &Made, theirs: &Made, brightest: f64, scenes: u32) -> usize {
        let question = Question { ours, theirs, across: 8, samples: 1, brightest: 256.0 * brightest };
        (0..scenes).filter(|k| !judge(&question, k * 5000).differences.is_empty()).count()
    }

    #[test]
    fn sound_scenes_are_sound() {
        let even = |mean| Made { mean, lump: 0.0, seldom: 0 };
        assert_eq!(findings(&even(1.0), &even(1.0), 0.0, 300), 0);
        // Light in lumps that few pictures have, so that most means are too low; on one side, or on both.
        for (lump, seldom) in [(0.5, 50), (5.0, 500), (20.0, 5000), (100.0, 50_000)] {
            let rare = Made { mean: 1.0, lump, seldom };
            assert_eq!(findings(&even(1.0), &rare, lump, 300), 0, "{lump} once in {seldom}");
            assert_eq!(findings(&rare, &rare, lump, 300), 0, "{lump} once in {seldom}, both");
        }
    }

    #[test]
    fn faults_are_found() {
        let even = |mean| Made { mean, lump: 0.0, seldom: 0 };
        let noisy = || Made { mean: 1.0, lump: 0.5, seldom: 50 };
        for (mean, theirs) in [(0.95, even(1.0)), (1.05, even(1.0)), (0.9, noisy()), (1.1, noisy())] {
            let found = findings(&even(mean), &theirs, 0.0, 100);
            assert!(found >= 99, "{mean}: found in {found} of 100 scenes");
        }
    }
}
