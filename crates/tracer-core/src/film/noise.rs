//! How noisy a film is.
//!
//! The samples of a pixel are stratified: the more of them, the better they are than independent ones, by a factor of
//! eight in the variance at the borders of things after 64 of them. So what a pixel's samples scatter by
//! ([`Film::variance`]) is an upper bound. The noise of the whole picture is told by what is seen instead. At each
//! power of two h, when all pixels have so many samples, their means are put down; of 2 h samples the first half and
//! the second are nets of the sampler with scrambles of their own, and how much the two pictures differ tells the
//! variance:
//!
//! with V(n) = c n^-r for the variance of n samples from a power of two on, and V(2 h) that of the mean of both halves,
//!
//! D(2 h) = 2 V(h) - 2 C,  V(2 h) = (V(h) + C)/2,  so  V(2 h) = D(2 h) 2^-r/(2 (2 - 2^(1-r))),
//!
//! where C is the halves' covariance (below zero where r > 1: together they are a better net than two). The rate r is
//! that at which D has fallen, at least one, that of independent samples, and at most two. With k samples more than h,
//! h/4 at least, it is the difference between these and the first h that tells, as if the two were independent; the
//! covariance comes in with k/h. All is summed over the pixels, so that it is right where pixels err alike, too.
//!
//! One lamp smaller than a pixel, met by chance, may be nearly all of it. Tried and given up: errors relative to each
//! pixel's own luminance (what has met light by chance is bright: 0.75 of the error was told at 28 samples), and the
//! brightest pixels taken for no brighter than the next (a small bright thing before black had no noise at all).
//!
//! Where few pixels bear the error, two pictures may agree by chance: of n pixels that err alike much, the standard
//! deviation of what is seen of the variance is sqrt(2/n) of it. m = (sum d^2)^2 / sum d^4 of the differences d is a
//! third of such n, by Gauss. Below [`FEW`], the noise is never told as less than that of independent samples. The
//! halves of one pixel that bears most of it may agree to the last bit (a lamp smaller than a pixel, hit as often), and
//! nothing is seen of it then: so it is, too, where few pixels bear what independent samples would have. Nor is it
//! told as less where pixels err together since they see the same moments: what is there for a thirtieth of a time all
//! may miss.

use super::adaptive::taken;
use super::{Film, PIXELS, Tile, luminance};
use rayon::prelude::*;

/// m of eighteen pixels: they tell the noise to a sixth of itself, half of sqrt(2/18).
const FEW: f64 = 6.0;

/// m of 72 pixels: they tell how fast the noise has fallen over two octaves to a sixth.
const MANY: f64 = 24.0;

/// What the few pixels that bear nearly all of a picture's noise are: those of a lamp smaller than a pixel, say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FewNoisy {
    /// How many they are.
    pub pixels: usize,
    /// The pixel that bears most: column and row in the picture, from the upper left.
    pub worst: [u32; 2],
    /// The noise of all others relative to their mean luminance, as independent samples would have it: an upper bound.
    pub rest: f64,
}

/// The few are no more than one in so many pixels, or this many (never more than a hundredth): a lamp that is smaller
/// than a pixel is seen in those around it, too, where the filter reaches it.
const ONE_IN: usize = 1000;
const FEWEST: usize = 16;

/// Without them the noise is so many times smaller at least: a caustic may be a third of it.
const FALLS: f64 = 10.0;

/// Those that are named leave so many times the least that any few would leave.
const MORE: f64 = 1.5;

/// What is known of the noise from the last octave of samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Octave {
    /// The samples of each pixel when it ended, a power of two; 0: there was none.
    pub samples: u32,
    /// D: mean square difference between the luminance of the two halves of the samples, in squares of the film's unit;
    /// at so many samples, at half as many, and at a fourth. Zero where it is not known.
    pub differences: [f64; 3],
    /// m: pixels that bear the first of these.
    pub pixels: f64,
}

impl Octave {
    /// r: how fast the variance falls with the number of samples.
    fn rate(&self) -> f64 {
        let [now, half, fourth] = self.differences;
        let fell = if fourth > 0.0 { libm::log2(fourth / now) / 2.0 } else { libm::log2(half / now) };
        if fell.is_finite() { fell.clamp(1.0, 2.0) } else { 1.0 }
    }

    /// V of twice the samples of which D is of the halves, over D.
    fn of_difference(rate: f64) -> f64 {
        libm::exp2(-rate) / (2.0 * (2.0 - libm::exp2(1.0 - rate)))
    }

    /// What the square of the difference between the first h samples and k more is to be multiplied by to be the
    /// variance of all of them; `None` where the latter are too few to tell.
    fn of_more([first, more]: [u32; 2], rate: f64) -> Option<f64> {
        let (h, k) = (f64::from(first), f64::from(more));
        let n = h + k;
        let (of_first, of_more) = (libm::pow(h, -rate), libm::pow(k, -rate));
        let independent = (h * h * of_first + k * k * of_more) / (n * n) / (of_first + of_more);
        (4 * u64::from(more) >= first.into()).then(|| independent * libm::pow(4.0 * Self::of_difference(rate), k / h))
    }

    /// Whether it is one that a file can hold.
    pub fn is_sound(&self) -> bool {
        let [first, ..] = self.differences;
        (self.samples == 0 || self.samples.is_power_of_two())
            && (self.samples > 1 || first == 0.0)
            && self.differences.iter().chain([&self.pixels]).all(|&x| x >= 0.0 && x.is_finite())
    }
}

/// A number to 16 binary digits, as files have it: to 1e-5 of itself, which is below any noise that is asked for.
fn shortened(x: f32) -> f32 {
    f32::from_bits(x.to_bits().saturating_add(0x80) & !0xff)
}

/// What pixels bear of a variance.
#[derive(Clone, Copy, Default)]
struct Borne {
    sum: f64,
    /// Of the squares.
    squares: f64,
}

impl Borne {
    fn add(&mut self, of_pixel: f64) {
        self.sum += of_pixel;
        self.squares += of_pixel * of_pixel;
    }

    fn merge(&mut self, other: &Borne) {
        self.sum += other.sum;
        self.squares += other.squares;
    }

    /// How many pixels that bear the same would make it as sure.
    fn pixels(&self) -> f64 {
        if self.squares > 0.0 { self.sum * self.sum / self.squares } else { 0.0 }
    }
}

impl Film {
    /// Puts down what the film has, where all pixels have the same power of two of samples. Parts know nothing of the
    /// samples of others.
    pub(crate) fn end_octave(&mut self) {
        let samples = self.whole;
        if self.part.is_some() || !samples.is_power_of_two() || self.unfinished.is_some() {
            return;
        }
        let Octave { samples: before, differences: [last, half, _], .. } = self.octave;
        let (light, light_samples, paper) = (self.light_count(), self.light_samples, self.paper);
        let put_down = |tile: &mut Tile| {
            let mut borne = Borne::default();
            let light = if tile.rest == 0 { light } else { taken(tile.rest, light_samples).into() };
            let [first, all] = [samples / 2, samples].map(|end| f64::from(taken(tile.rest, end)));
            // Of tiles that rest the second is the shorter one, where there were more samples before: as one of as many
            // would have told it.
            let unequal = first / (all - first);
            for pixel in 0..PIXELS {
                let mean = tile.luminance(pixel, light, paper);
                // Of the first half and of the second.
                let difference = mean - f64::from(tile.octave[pixel]);
                borne.add(4.0 * difference * difference * unequal);
                tile.octave[pixel] = shortened(mean as f32);
            }
            borne
        };
        // One after the other, so that threads cannot show.
        let of_tiles: Vec<Borne> = self.tiles.par_iter_mut().map(put_down).collect();
        let mut borne = Borne::default();
        of_tiles.iter().for_each(|tile| borne.merge(tile));
        self.octave = match before > 0 && samples == 2 * before {
            true => {
                let differences = [borne.sum / self.count(), last, half];
                Octave { samples, differences, pixels: borne.pixels() }
            }
            false => Octave { samples, ..Octave::default() },
        };
    }

    /// Pixels that it holds; one where there are none.
    fn count(&self) -> f64 {
        (f64::from(self.crop.width) * f64::from(self.crop.height)).max(1.0)
    }

    /// Estimated variance of a pixel's mean luminance, were its samples independent (they are better than that); where
    /// the background is kept by itself, of what is before it and what that is laid over. Zero below two samples.
    pub fn variance(&self, x: u32, y: u32) -> f64 {
        let (tile, pixel) = self.place(x, y);
        if tile.samples[pixel] < 2 {
            return 0.0;
        }
        let n = f64::from(tile.samples[pixel]);
        let mean = tile.of_samples(pixel, self.paper);
        let of_samples = ((tile.squares.of(pixel) / n - mean * mean) / (n - 1.0)).max(0.0);
        // Light paths come one by one: the variance of such a sum is about the sum of squares.
        let splats = tile.splats.as_ref().map_or(0.0, |splats| splats.squares.of(pixel));
        let passes = Some(self.light_of(tile)).filter(|&passes| passes > 0.0).unwrap_or(1.0);
        let of_light = splats / (passes * passes);
        (of_samples + of_light) * self.unit * self.unit
    }

    /// The standard error of a pixel relative to its own luminance, as [`Film::variance`] has it; zero where it is
    /// black.
    pub fn noise(&self, x: u32, y: u32) -> f64 {
        // In the sums' own unit: squares of the scene's might leave the range of numbers.
        let (variance, mean) = (self.variance(x, y) / self.unit / self.unit, self.mean_luminance(x, y));
        if mean > 0.0 { variance.sqrt() / mean } else { 0.0 }
    }

    /// Mean luminance of a pixel in the sums' own unit; where the background is kept by itself, without it, over what
    /// the picture is laid over.
    pub(crate) fn mean_luminance(&self, x: u32, y: u32) -> f64 {
        let light = (luminance(self.radiance(x, y)) - luminance(self.background(x, y))) / self.unit;
        if self.paper > 0.0 { light + self.paper * (1.0 - self.alpha(x, y)) } else { light }
    }

    /// Which part of the pixels is looked at: where the picture will be laid over nothing that is known, what it
    /// covers. Else a small thing before nothing would have more noise than one that fills the picture, as its mean
    /// has that nothing in it.
    fn covered(&self) -> f64 {
        if !self.backdrop || self.paper > 0.0 {
            return 1.0;
        }
        self.pixels().map(|(x, y)| self.alpha(x, y)).sum::<f64>() / self.count()
    }

    /// Root mean square over the pixels of their standard error, relative to the mean luminance: the noise of the
    /// picture as one number; where the background is kept by itself, of what is before it and what that is laid over,
    /// over the pixels, and parts of such, that show anything of it.
    /// It is seen from how much pictures of other samples differ; of parts that were merged, and where something moves
    /// while the shutter is open, it is what independent samples would have, which is more. Zero where no pixel has two
    /// samples: nobody can tell.
    pub fn relative_noise(&self) -> f64 {
        // In the sums' own unit: squares of the scene's might leave the range of numbers.
        let mean = self.pixels().map(|(x, y)| self.mean_luminance(x, y)).sum::<f64>() / self.count();
        let borne = self.independent();
        let independent = borne.sum / self.count();
        let variance = match self.seen_variance() {
            Some((seen, pixels)) if pixels.min(borne.pixels() / 3.0) >= FEW && self.moments == 0 => seen,
            Some((seen, _)) => seen.max(independent),
            None => independent,
        };
        if mean > 0.0 { (variance * self.covered()).sqrt() / mean } else { 0.0 }
    }

    /// What pixels bear of the variance that independent samples would have, in the sums' own unit. On the thread that
    /// asks: threads of a pool that is nobody's own would be missing in a process that forks.
    fn independent(&self) -> Borne {
        let mut borne = Borne::default();
        self.pixels().for_each(|(x, y)| borne.add(self.variance(x, y) / self.unit / self.unit));
        borne
    }

    /// The few pixels without which the noise is a tenth or less of what it is; `None` where there are none such.
    pub fn few_noisy(&self) -> Option<FewNoisy> {
        // In the sums' own unit: squares of the scene's might leave the range of numbers.
        let unit = self.unit * self.unit;
        let mut of_pixels: Vec<([u32; 2], f64)> =
            self.pixels().map(|(x, y)| ([x, y], self.variance(x, y) / unit)).collect();
        let most = (of_pixels.len() / ONE_IN).max(FEWEST).min(of_pixels.len() / 100);
        if most == 0 {
            return None;
        }
        of_pixels.select_nth_unstable_by(most, |a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let (few, others) = of_pixels.split_at_mut(most);
        few.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let light = |&([x, y], _): &([u32; 2], f64)| self.mean_luminance(x, y);
        // Sums of their own: of differences nothing may be left but rounding.
        let mut sums = [others.iter().map(|(_, variance)| variance).sum(), others.iter().map(light).sum::<f64>()];
        let (mut count, covered) = (others.len() as f64, self.covered());
        let noise = |[variance, light]: [f64; 2], count: f64| {
            if light > 0.0 { (variance * count * covered).sqrt() / light } else { 0.0 }
        };
        // Without the first k of them, for each k.
        let mut rests = vec![noise(sums, count)];
        for pixel in few.iter().rev() {
            sums = [sums[0] + pixel.1, sums[1] + light(pixel)];
            count += 1.0;
            rests.push(noise(sums, count));
        }
        rests.reverse();
        let least = rests[most];
        let pixels = rests.iter().position(|&rest| rest <= MORE * least)?;
        (rests[0] >= FALLS * least && pixels > 0).then(|| FewNoisy { pixels, worst: few[0].0, rest: rests[pixels] })
    }

    /// The rate at which the square of the noise falls with the number of samples: 1 for independent ones, and where
    /// few pixels bear the noise: how fast it has fallen is chance there, and many samples more will meet others.
    pub fn noise_rate(&self) -> f64 {
        if self.octave.pixels < MANY { 1.0 } else { self.octave.rate() }
    }

    /// Mean variance of the pixels in the sums' own unit, as the octaves tell it, and how many pixels bear it.
    fn seen_variance(&self) -> Option<(f64, f64)> {
        let Octave { samples, differences, pixels } = self.octave;
        if differences[0] <= 0.0 || self.has_gaps {
            return None;
        }
        let rate = self.octave.rate();
        let of_octave = differences[0] * Octave::of_difference(rate);
        // Samples of a pixel when the octave ended, and those after.
        let (mut last, mut factor) = ([samples, 0], None);
        let (mut borne, mut by_octave) = (Borne::default(), 0.0);
        for (x, y) in self.pixels() {
            let (tile, pixel) = self.place(x, y);
            let (n, light) = (tile.samples[pixel], self.light_of(tile));
            let samples = taken(tile.rest, samples);
            let now = [samples, n.saturating_sub(samples)];
            if now != last {
                (last, factor) = (now, Octave::of_more(now, rate));
            }
            // Light paths of other indices than the samples': of a pass that was ended early.
            let is_apart = tile.splats.is_some() && light != f64::from(n);
            match factor.filter(|_| !is_apart) {
                Some(factor) => {
                    // From the mean of all to that of those which came after.
                    let times = f64::from(n) / f64::from(n - samples);
                    let difference = (tile.luminance(pixel, light, self.paper) - f64::from(tile.octave[pixel])) * times;
                    borne.add(factor * difference * difference);
                }
                None => by_octave += of_octave * f64::from(samples) / f64::from(n.max(1)),
            }
        }
        if by_octave > 0.0 {
            borne.merge(&Borne { sum: by_octave, squares: by_octave * by_octave / pixels.max(1.0) });
        }
        Some((borne.sum / self.count(), if borne.sum > 0.0 { borne.pixels().min(pixels) } else { pixels }))
    }
}

impl Tile {
    /// Mean luminance of a pixel's samples in the sums' own unit; where the background is kept by itself, without it,
    /// over what the picture is laid over.
    fn of_samples(&self, pixel: usize, paper: f64) -> f64 {
        let samples = self.samples[pixel];
        let behind = self.missed.as_ref().map_or(0.0, |missed| luminance(missed.mean(pixel, samples)));
        let light = luminance(self.sums.mean(pixel, samples)) - behind;
        if paper == 0.0 || samples == 0 {
            return light;
        }
        let hits = self.layers.as_ref().map_or(0, |layers| layers.hits_of(pixel));
        light + paper * (1.0 - f64::from(hits) / f64::from(samples))
    }

    /// The same, with what the light paths of so many sample indices brought.
    fn luminance(&self, pixel: usize, light: f64, paper: f64) -> f64 {
        let of_light = self.splats.as_ref().map_or(0.0, |splats| luminance(splats.sums.mean(pixel, light)));
        self.of_samples(pixel, paper) + of_light
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where both halves are independent, as where they are nets that together are a better one, what is seen at a
    /// power of two is what the law says, and between two of them it goes from the one to the other.
    #[test]
    fn the_law_is_found_again() {
        for rate in [1.0, 1.3, 1.5, 2.0] {
            let variance = |n: u32| f64::from(n).powf(-rate);
            // D of the halves of n samples, by V(n) = (V(n/2) + C)/2.
            let difference = |n: u32| 4.0 * (variance(n / 2) - variance(n));
            let octave = Octave { samples: 64, differences: [64, 32, 16].map(difference), pixels: 64.0 };
            assert!((octave.rate() - rate).abs() < 1e-12);
            let seen = octave.differences[0] * Octave::of_difference(rate);
            assert!((seen / variance(64) - 1.0).abs() < 1e-12, "{rate}: {seen}");
            // At 128 samples, of which the second half is the next net.
            let all = Octave::of_more([64, 64], rate).map(|factor| factor * difference(128));
            assert!(all.is_some_and(|all| (all / variance(128) - 1.0).abs() < 1e-12), "{rate}: {all:?}");
            assert!(Octave::of_more([64, 15], rate).is_none() && Octave::of_more([64, 16], rate).is_some());
        }
        // What has not fallen, or is not known.
        let rate = |differences| Octave { samples: 8, differences, pixels: 64.0 }.rate();
        assert_eq!([[1.0, 1.0, 1.0], [1.0, 0.0, 0.0], [0.0; 3], [1e-9, 1.0, 0.0]].map(rate), [1.0, 1.0, 1.0, 2.0]);
    }
}
