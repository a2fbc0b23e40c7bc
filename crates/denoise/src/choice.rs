//! What of the candidates a pixel takes: the one whose squared error is least around it, as far as the halves can tell.

use crate::filter::Filtered;
use crate::plane::{Colours, Plane};
use crate::prepared::Prepared;
use rayon::prelude::*;

/// Errors are summed over this square twice, one after the other.
const SQUARE: usize = 5;
/// And which one is taken is blurred over this one, twice.
const BLUR: usize = 2;
/// The square over which brightness is found, in units of which errors count.
const BRIGHTNESS: usize = 3;
/// How far away a choice depends on pixels.
pub const REACH: usize = 2 * SQUARE + 2 * BLUR + BRIGHTNESS;
/// What there was before is kept only where its error is less by this share.
const MARGIN: f32 = 0.1;
/// Errors of what is darker than this, in units of the picture's mean, count as if it were so bright.
const DARK: f32 = 0.1;

/// Squares of what both halves have alike count from so many times their noise on.
const PEAK: f32 = 16.0;
/// The square whose noise counts, too, for what is darker.
const WIDE: usize = 3;

/// What was chosen.
pub struct Chosen {
    /// Irradiance of both halves.
    pub halves: [Colours; 2],
    /// Estimated squared error of radiance, summed over the channels.
    pub after: Plane,
    /// Estimated variance of what was chosen, which its squared error is not below.
    pub variance: Plane,
}

impl Chosen {
    /// The noisy picture itself.
    pub fn nothing(prepared: &Prepared) -> Self {
        let halves = prepared.halves.clone();
        let before = error(prepared, |half, c, k| halves[half][c].values[k]);
        Chosen { after: before.clone(), variance: before, halves }
    }
}

/// Squared error of a candidate, an estimate that is right on average where its halves are independent: a filtered
/// half F and the noisy other one O differ by F's error and O's variance, and the mean of two filtered halves has
/// less variance than each. With a and b the shares of the halves, D and E the squared differences of the noisy and
/// of the filtered halves, that is a (F_1 - O_2)^2 + b (F_2 - O_1)^2 - (a^2 + b^2) D - a b E; the noisy picture's is
/// a b D. Zero where the halves say nothing of noise.
fn error(prepared: &Prepared, irradiance: impl Fn(usize, usize, usize) -> f32 + Sync) -> Plane {
    let a = prepared.share;
    let b = 1.0 - a;
    Plane::of(prepared.width, prepared.height, |k| {
        let of_channel = |c: usize| {
            let albedo = if prepared.knows[k] { prepared.albedo[c].values[k] } else { 0.0 };
            let noisy = [0, 1].map(|half| prepared.halves[half][c].values[k]);
            let filtered = [0, 1].map(|half| irradiance(half, c, k));
            let square = |x: f32, y: f32| (x - y) * (x - y);
            let others = a * square(filtered[0], noisy[1]) + b * square(filtered[1], noisy[0]);
            let own = (a * a + b * b) * square(noisy[0], noisy[1]) + a * b * square(filtered[0], filtered[1]);
            albedo * albedo * (others - own)
        };
        of_channel(0) + of_channel(1) + of_channel(2)
    })
}

/// Variance of the mean of two filtered halves, radiance summed over the channels: a b E.
fn variance(prepared: &Prepared, halves: &[Colours; 2]) -> Plane {
    let share = prepared.share * (1.0 - prepared.share);
    Plane::of(prepared.width, prepared.height, |k| {
        let of_channel = |c: usize| {
            let difference = (halves[0][c].values[k] - halves[1][c].values[k]) * prepared.albedo[c].values[k];
            share * difference * difference
        };
        of_channel(0) + of_channel(1) + of_channel(2)
    })
}

/// Chooses among what was chosen before and what a pass has made of it.
pub fn choose(prepared: &Prepared, last: &Chosen, filtered: &Filtered) -> Chosen {
    let (width, height) = (prepared.width, prepared.height);
    let errors = [
        last.after.clone(),
        error(prepared, |half, c, k| filtered.mean[half][k][c]),
        error(prepared, |half, c, k| filtered.plane[half][k][c]),
    ];
    let brightness = brightness(prepared);
    let around = errors.each_ref().map(|error| {
        let relative = Plane::of(width, height, |k| error.values[k] * brightness.values[k]);
        relative.blurred(SQUARE).blurred(SQUARE).values
    });
    let best: Vec<usize> = (0..width * height)
        .into_par_iter()
        .map(|k| {
            let [kept, mean, plane] = [0, 1, 2].map(|of: usize| around[of][k]);
            let filtered = mean.min(plane);
            if kept + MARGIN * kept.abs() <= filtered { 0 } else { 1 + usize::from(plane < mean) }
        })
        .collect();
    let maps = [0, 1, 2].map(|of| {
        let taken = Plane::of(width, height, |k| if best[k] == of { 1.0 } else { 0.0 });
        taken.blurred(BLUR).blurred(BLUR).values
    });
    let mixed = |k: usize, of: [f32; 3]| maps[0][k] * of[0] + maps[1][k] * of[1] + maps[2][k] * of[2];
    let blended = [0, 1].map(|half| {
        [0, 1, 2].map(|c| {
            let last = &last.halves[half][c].values;
            Plane::of(width, height, |k| mixed(k, [last[k], filtered.mean[half][k][c], filtered.plane[half][k][c]]))
        })
    });
    let halves = with_peaks(prepared, blended);
    let after = error(prepared, |half, c, k| halves[half][c].values[k]);
    let variance = variance(prepared, &halves);
    Chosen { halves, after, variance }
}

/// Halves that were filtered, but as they were where both say that the filter has taken too much: a lamp in a mirror,
/// two pixels wide, is lost in the squares that errors are summed over. What both differ by from the filtered other
/// one has the square of the filter's error as its mean product; it counts where it is far above the noise around,
/// which normal noise makes once in ten million pixels. What is darker than the filtered must be far above the noise of
/// a square, too: light that one sample in a hundred finds is in neither half of most pixels, which were black
/// dots in what others had found.
fn with_peaks(prepared: &Prepared, blended: [Colours; 2]) -> [Colours; 2] {
    let around = prepared.variance.blurred(WIDE);
    let is_peak = |k: usize| {
        let (mut product, mut difference, mut above) = (0.0, 0.0, 0.0);
        for c in 0..3 {
            let [one, other] = prepared.halves.each_ref().map(|half| half[c].values[k]);
            let [to_one, to_other] = [one - blended[1][c].values[k], other - blended[0][c].values[k]];
            product += to_one * to_other;
            difference += (one - other) * (one - other);
            above += to_one + to_other;
        }
        let noise = prepared.variance.values[k].max(0.5 * difference);
        product > PEAK * if above < 0.0 { noise.max(around.values[k]) } else { noise }
    };
    [0, 1].map(|half| {
        [0, 1, 2].map(|c| {
            let (noisy, blended) = (&prepared.halves[half][c].values, &blended[half][c].values);
            Plane::of(prepared.width, prepared.height, |k| if is_peak(k) { noisy[k] } else { blended[k] })
        })
    })
}

/// One over the square of how bright it is around each pixel.
fn brightness(prepared: &Prepared) -> Plane {
    let (width, height) = (prepared.width, prepared.height);
    let radiance = Plane::of(width, height, |k| {
        let channel = |c: usize| {
            let [one, other] = prepared.halves.each_ref().map(|half| half[c].values[k]);
            let irradiance = prepared.share * one + (1.0 - prepared.share) * other;
            irradiance * prepared.albedo[c].values[k] + prepared.lamps[c].values[k]
        };
        ((channel(0) + channel(1) + channel(2)) * (1.0 / 3.0)).max(0.0)
    });
    let around = radiance.blurred(BRIGHTNESS);
    Plane::of(width, height, |k| 1.0 / (around.values[k] * around.values[k] + DARK * DARK))
}
