//! A pass of the filter: candidates for both halves, from pixels that are alike.

use crate::plane::{Colours, Padded, Plane};
use crate::prepared::{DARK, Prepared};
use crate::solve::{MOMENTS, UNKNOWNS, values};
use rayon::prelude::*;

/// A pass looks at pixels of a grid around each.
#[derive(Clone, Copy, Debug)]
pub struct Pass {
    /// Pixels from one of the grid to the next.
    pub step: usize,
    /// How many of them to each side.
    pub reach: usize,
    /// Whether planes are fitted, too: four times the work.
    pub planes: bool,
}

/// Patches that are compared reach so far.
pub const PATCH: usize = 2;
/// Pixels of a row that are worked on at once, and rows: their sums stay in the cache.
const TILE: usize = 32;
const ROWS: usize = 8;
/// Pixels that a patch's sums need beside those of a tile.
const SPAN: usize = TILE + 2 * PATCH;
const SPAN_ROWS: usize = ROWS + 2 * PATCH;
/// Pixels are alike where normals, albedos differ by less than so much.
const NORMAL: f32 = 0.6;
const ALBEDO: f32 = 0.6;
/// And nearness by this share of itself from what is flat.
const NEAR: f32 = 0.03;
/// Too small to be divided by.
const LEAST: f32 = 1e-10;
const MORE: f32 = 2.0;

/// The mean and the value of the plane, for each half: colours one after the other.
pub struct Filtered {
    pub mean: [Vec<[f32; 3]>; 2],
    /// The same as the mean where none are fitted.
    pub plane: [Vec<[f32; 3]>; 2],
}

/// Numbers of a row of a tile.
type Row = [f32; TILE];

/// What is filtered, with borders that a pass may look into.
struct Field {
    pass: Pass,
    width: usize,
    height: usize,
    halves: [[Padded; 3]; 2],
    variance: Padded,
    normal: [Padded; 3],
    near: Padded,
    slope: [Padded; 2],
    tint: [Padded; 3],
    /// What either half was divided by.
    divisors: [[Padded; 3]; 2],
}

/// Sums of a row of a tile: the upper half of a symmetric matrix, and three right hand sides.
struct Sums {
    moments: [Row; MOMENTS],
    right: [[Row; 3]; UNKNOWNS],
}

/// A pass over both halves; what is left is zero where it does not go on.
pub fn filter(
    prepared: &Prepared,
    halves: &[Colours; 2],
    variance: &Plane,
    pass: &Pass,
    goes_on: &(dyn Fn() -> bool + Sync),
) -> Filtered {
    let border = pass.step * pass.reach + PATCH;
    let padded = |plane: &Plane| plane.padded(border, TILE);
    let field = Field {
        pass: *pass,
        width: prepared.width,
        height: prepared.height,
        halves: halves.each_ref().map(|half| half.each_ref().map(padded)),
        variance: padded(variance),
        normal: prepared.normal.each_ref().map(padded),
        near: padded(&prepared.near),
        slope: prepared.slope.each_ref().map(padded),
        tint: prepared.tint.each_ref().map(padded),
        divisors: prepared.divisors.each_ref().map(|half| half.each_ref().map(padded)),
    };
    let (width, pixels) = (field.width, field.width * field.height);
    let empty = || [0, 1].map(|_| vec![[0.0; 3]; pixels]);
    let (mut mean, mut plane) = (empty(), empty());
    let [mean_a, mean_b] = &mut mean;
    let [plane_a, plane_b] = &mut plane;
    let strip = ROWS * width;
    let means = mean_a.par_chunks_mut(strip).zip(mean_b.par_chunks_mut(strip));
    let planes = plane_a.par_chunks_mut(strip).zip(plane_b.par_chunks_mut(strip));
    means.zip(planes).enumerate().for_each(|(k, ((mean_a, mean_b), (plane_a, plane_b)))| {
        let mut work = Work::new();
        for left in (0..width).step_by(TILE).take_while(|_| goes_on()) {
            work.weigh(&field, left, k * ROWS);
            work.give(&field, [left, k * ROWS], 0, mean_a, plane_a);
            work.give(&field, [left, k * ROWS], 1, mean_b, plane_b);
        }
    });
    Filtered { mean, plane }
}

impl Field {
    /// By how much features of pixels of a row differ from those of the row's own, the places of which are told
    /// first; in units in which they are of about one size.
    fn features(&self, [here, other]: [usize; 2], [across, down]: [isize; 2]) -> [Row; UNKNOWNS] {
        let most = (self.pass.step * self.pass.reach) as f32;
        let mut features = [[1.0; TILE]; UNKNOWNS];
        features[1] = [across as f32 / most; TILE];
        features[2] = [down as f32 / most; TILE];
        let [one, two] = [here, other].map(|place| self.normal.each_ref().map(|plane| plane.row::<TILE>(place)));
        for c in 0..3 {
            (0..TILE).for_each(|x| features[3 + c][x] = two[c][x] - one[c][x]);
        }
        let (near, near_other): (&Row, &Row) = (self.near.row(here), self.near.row(other));
        (0..TILE).for_each(|x| features[6][x] = ((near_other[x] - near[x]) / (near[x] + LEAST)).clamp(-4.0, 4.0));
        let [one, two] = [here, other].map(|place| self.tint.each_ref().map(|plane| plane.row::<TILE>(place)));
        let tint = |of: &[&Row; 3], x: usize| of[0][x] + of[1][x] + of[2][x];
        (0..TILE).for_each(|x| features[7][x] = tint(&two, x) - tint(&one, x));
        features
    }
}

/// What a thread works with.
struct Work {
    /// Offsets of pixels that are alike, and their weights for either half, of the tile's pixels.
    offsets: Vec<[isize; 2]>,
    weights: [Vec<[Row; ROWS]>; 2],
    /// Sums of one row: they stay in the nearest cache.
    sums: Box<Sums>,
    features: [Row; ROWS],
    /// How well other pixels of either half know the irradiance of these, squared.
    known: [[Row; ROWS]; 2],
    distances: [[f32; SPAN]; SPAN_ROWS],
    across: [Row; SPAN_ROWS],
}

impl Work {
    fn new() -> Self {
        Work {
            offsets: Vec::new(),
            weights: [Vec::new(), Vec::new()],
            sums: Box::new(Sums { moments: [[0.0; TILE]; MOMENTS], right: [[[0.0; TILE]; 3]; UNKNOWNS] }),
            features: [[0.0; TILE]; ROWS],
            known: [[[0.0; TILE]; ROWS]; 2],
            distances: [[0.0; SPAN]; SPAN_ROWS],
            across: [[0.0; TILE]; SPAN_ROWS],
        }
    }

    /// Finds the weights of all pixels around those of a tile.
    fn weigh(&mut self, field: &Field, left: usize, top: usize) {
        self.offsets.clear();
        self.weights.iter_mut().for_each(Vec::clear);
        let (step, reach) = (field.pass.step as isize, field.pass.reach as isize);
        for down in -reach..=reach {
            for across in -reach..=reach {
                let offset = [across * step, down * step];
                if !self.compare_features(field, left, top, offset) {
                    continue;
                }
                self.offsets.push(offset);
                for half in 0..2 {
                    // Its weights come from the other half: so that no error makes its own weight.
                    self.compare_patches(field, &field.halves[1 - half], left, top, offset);
                    let weights = std::array::from_fn(|row| self.weights_of(row, half));
                    self.weights[half].push(weights);
                }
            }
        }
    }

    /// Weights of a row of a half, by features and patches.
    fn weights_of(&self, row: usize, half: usize) -> Row {
        const SHARE: f32 = 1.0 / ((2 * PATCH + 1) * (2 * PATCH + 1)) as f32;
        let mut weights: Row = [0.0; TILE];
        for patch in &self.across[row..=row + 2 * PATCH] {
            weights.iter_mut().zip(patch).for_each(|(to, distance)| *to += distance);
        }
        for (to, (alike, known)) in weights.iter_mut().zip(self.features[row].iter().zip(&self.known[half][row])) {
            *to = weight((*to * SHARE).max(0.0)) * alike * known;
        }
        weights
    }

    /// How alike features are to those of the pixels at an offset; whether any are.
    fn compare_features(&mut self, field: &Field, left: usize, top: usize, [across, down]: [isize; 2]) -> bool {
        let mut any = false;
        let [fx, fy] = [across as f32, down as f32];
        for (row, weights) in self.features.iter_mut().enumerate() {
            let y = (top + row) as isize;
            let there = 0..field.height as isize;
            if !there.contains(&y) || !there.contains(&(y + down)) {
                *weights = [0.0; TILE];
                continue;
            }
            let here = field.near.place(left as isize, y);
            let other = field.near.place(left as isize + across, y + down);
            let rows = |planes: &[Padded; 3]| planes.each_ref().map(|plane| [*plane.row(here), *plane.row(other)]);
            let (normal, tint): ([[Row; 2]; 3], [[Row; 2]; 3]) = (rows(&field.normal), rows(&field.tint));
            let divisors: [[[Row; 2]; 3]; 2] = field.divisors.each_ref().map(rows);
            for (known, divisors) in self.known.iter_mut().zip(&divisors) {
                known[row] = std::array::from_fn(|x| squared(known_of(divisors, x)));
            }
            let (near, near_other): (&Row, &Row) = (field.near.row(here), field.near.row(other));
            let [right, below]: [&Row; 2] = field.slope.each_ref().map(|slope| slope.row(here));
            for x in 0..TILE {
                let square = |[one, other]: &[Row; 2]| (one[x] - other[x]) * (one[x] - other[x]);
                let of_normal =
                    (square(&normal[0]) + square(&normal[1]) + square(&normal[2])) * (1.0 / NORMAL / NORMAL);
                let of_tint = (square(&tint[0]) + square(&tint[1]) + square(&tint[2])) * (1.0 / ALBEDO / ALBEDO);
                let from_flat = near_other[x] - near[x] - (right[x] * fx + below[x] * fy);
                let unit = NEAR * near[x] + 0.5 * (right[x].abs() + below[x].abs()) + LEAST;
                weights[x] = weight(of_normal + of_tint + from_flat * from_flat / (unit * unit));
            }
            for (x, weight) in weights.iter_mut().enumerate() {
                let x = (left + x) as isize + across;
                *weight = if x >= 0 && x < field.width as isize { *weight } else { 0.0 };
            }
            any |= weights.iter().any(|&weight| weight > 0.0);
        }
        any
    }

    /// Squared distances of patches to those at an offset, as multiples of what noise makes them, summed across.
    fn compare_patches(&mut self, field: &Field, half: &[Padded; 3], left: usize, top: usize, offset: [isize; 2]) {
        let [across, down] = offset;
        for (row, distances) in self.distances.iter_mut().enumerate() {
            let [x, y] = [left as isize - PATCH as isize, (top + row) as isize - PATCH as isize];
            // Below the picture the last tile reads its border, or nothing.
            if y - PATCH as isize >= field.height as isize {
                *distances = [0.0; SPAN];
                continue;
            }
            let (here, other) = (field.variance.place(x, y), field.variance.place(x + across, y + down));
            let rows: [[&[f32; SPAN]; 2]; 3] = half.each_ref().map(|plane| [plane.row(here), plane.row(other)]);
            let variances: [&[f32; SPAN]; 2] = [field.variance.row(here), field.variance.row(other)];
            for (x, distance) in distances.iter_mut().enumerate() {
                let square = |[one, other]: [&[f32; SPAN]; 2]| (one[x] - other[x]) * (one[x] - other[x]);
                let squares = square(rows[0]) + square(rows[1]) + square(rows[2]);
                let (one, other) = (variances[0][x], variances[1][x]);
                // A pixel that has more noise than this one counts as if it had no more: it would be like all others.
                let noise = one + one.min(other);
                *distance = (squares - noise) / (LEAST + one + other.min(MORE * one));
            }
        }
        for (across, distances) in self.across.iter_mut().zip(&self.distances) {
            for (x, to) in across.iter_mut().enumerate() {
                *to = distances[x] + distances[x + 1] + distances[x + 2] + distances[x + 3] + distances[x + 4];
            }
        }
    }

    /// Sums over all pixels around those of a row.
    fn sum(&mut self, field: &Field, [left, y]: [usize; 2], half: usize, row: usize) {
        let Sums { moments, right } = &mut *self.sums;
        moments.iter_mut().for_each(|row| *row = [0.0; TILE]);
        right.iter_mut().flatten().for_each(|row| *row = [0.0; TILE]);
        let here = field.near.place(left as isize, y as isize);
        for (&[across, down], weights) in self.offsets.iter().zip(&self.weights[half]) {
            let weights = &weights[row];
            if weights.iter().all(|&weight| weight == 0.0) {
                continue;
            }
            let other = field.near.place(left as isize + across, y as isize + down);
            let colours: [&Row; 3] = field.halves[half].each_ref().map(|plane| plane.row(other));
            if !field.pass.planes {
                (0..TILE).for_each(|x| moments[0][x] += weights[x]);
                for (colour, sum) in colours.iter().zip(&mut right[0]) {
                    (0..TILE).for_each(|x| sum[x] += weights[x] * colour[x]);
                }
                continue;
            }
            let features = field.features([here, other], [across, down]);
            let mut next = moments.iter_mut();
            for i in 0..UNKNOWNS {
                let mut weighted: Row = [0.0; TILE];
                (0..TILE).for_each(|x| weighted[x] = weights[x] * features[i][x]);
                for (feature, moment) in features[i..].iter().zip(&mut next) {
                    (0..TILE).for_each(|x| moment[x] += weighted[x] * feature[x]);
                }
                for (colour, sum) in colours.iter().zip(&mut right[i]) {
                    (0..TILE).for_each(|x| sum[x] += weighted[x] * colour[x]);
                }
            }
        }
    }

    /// Means and planes of a tile's pixels, into the rows of its strip.
    fn give(
        &mut self,
        field: &Field,
        [left, top]: [usize; 2],
        half: usize,
        mean: &mut [[f32; 3]],
        plane: &mut [[f32; 3]],
    ) {
        let rows = mean.chunks_mut(field.width).zip(plane.chunks_mut(field.width));
        for (row, (mean, plane)) in rows.enumerate() {
            self.sum(field, [left, top + row], half, row);
            let Sums { moments, right } = &*self.sums;
            for (x, (mean, plane)) in mean[left..].iter_mut().zip(&mut plane[left..]).take(TILE).enumerate() {
                // A pixel is like itself, so there are weights.
                *mean = right[0].map(|sum| sum[x] / moments[0][x]);
                *plane = *mean;
                if field.pass.planes {
                    let of_pixel: [f32; MOMENTS] = std::array::from_fn(|k| moments[k][x]);
                    let right: [[f32; 3]; UNKNOWNS] = std::array::from_fn(|k| right[k].map(|row| row[x]));
                    *plane = values(&of_pixel, &right).map_or(*mean, |plane| plane.map(|x| x.max(0.0)));
                }
            }
        }
    }
}

/// How well another pixel knows the irradiance of this one, beside how well this one does, at most one: its noise is
/// that of radiance over its albedo, which of black is anything. By the channel that it knows least of: weights are of
/// pixels. Without it what is black made mixed pixels at its border darker, which took up to 4 % from a picture of
/// white dots on black.
#[inline(always)]
fn known_of(divisors: &[[Row; 2]; 3], x: usize) -> f32 {
    let ratio = |[here, other]: &[Row; 2]| other[x] / here[x].max(DARK);
    ratio(&divisors[0]).min(ratio(&divisors[1])).min(ratio(&divisors[2])).min(1.0)
}

fn squared(x: f32) -> f32 {
    x * x
}

/// Nearly exp(-d), but with an end.
#[inline(always)]
fn weight(distance: f32) -> f32 {
    let x = (1.0 - 0.25 * distance).max(0.0);
    (x * x) * (x * x)
}
