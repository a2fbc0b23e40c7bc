//! The input as it is filtered: irradiance without lamps and textures, its noise, and features.

use crate::input::Input;
use crate::plane::{Colours, Plane};
use rayon::prelude::*;

/// Albedos below are taken for this: what is nearly black is not made bright.
pub const DARK: f32 = 0.002;
/// Halves are divided by what each has met of a texture: what the one met more of it than the other is no noise of
/// light. Where one of them has met less than this share of what both have, in any channel, it knows too little of it.
const ENOUGH: f32 = 0.05;
/// Radiance counts as this at most, in units of its mean: squares stay within single precision.
const MOST: f32 = 1e12;
/// The square over which the size of the noise is found.
const WIDE: usize = 7;
/// How far away the noise of a pixel is looked for.
pub const REACH: usize = WIDE + 1;

/// The input as it is filtered.
pub struct Prepared {
    pub width: usize,
    pub height: usize,
    /// Share of the first half.
    pub share: f32,
    /// What radiance of one stands for here: a power of two near the picture's mean.
    pub scale: f32,
    /// What irradiance is multiplied by.
    pub albedo: Colours,
    /// What either half was divided by to be irradiance.
    pub divisors: [Colours; 2],
    /// Of each pixel whether its halves know light by themselves; else they are apart by what they have met of a
    /// texture, which says nothing of noise.
    pub knows: Vec<bool>,
    /// What is added then.
    pub lamps: Colours,
    /// Irradiance of both halves.
    pub halves: [Colours; 2],
    /// Variance of a half's irradiance, were they of one size; summed over the channels.
    pub variance: Plane,
    /// Features.
    pub normal: [Plane; 3],
    /// One over the depth: it changes evenly over what is flat, and is zero at infinity.
    pub near: Plane,
    /// By how much it changes to the right and downwards, on the flatter side.
    pub slope: [Plane; 2],
    /// The albedo as it is.
    pub tint: Colours,
}

impl Prepared {
    pub fn new(input: &Input<'_>) -> Self {
        let (width, height) = (input.width, input.height);
        let plane = |value: &(dyn Fn(usize) -> f32 + Sync)| Plane::of(width, height, value);
        let scale = scale(input);
        let number = |x: f32| if x.is_nan() { 0.0 } else { (x / scale).clamp(-MOST, MOST) };
        let feature = |x: f32| if x.is_finite() { x } else { 0.0 };
        let of_half = input.albedo.map(|albedo| move |k: usize| feature(albedo[k]).clamp(0.0, 1.0));
        let of_both = |k: usize| input.share * of_half[0](k) + (1.0 - input.share) * of_half[1](k);
        let tint = [0, 1, 2].map(|c| plane(&|k| of_both(3 * k + c)));
        let albedo = [0, 1, 2].map(|c| plane(&|k| tint[c].values[k].max(DARK)));
        let of_pixel: Vec<Pixel> = (0..width * height)
            .into_par_iter()
            .map(|k| {
                let three = |of: &dyn Fn(usize) -> f32| [0, 1, 2].map(|c| of(3 * k + c));
                Pixel::of(
                    input.halves.map(|half| three(&|n| number(half[n]))),
                    [three(&of_half[0]), three(&of_half[1])],
                    [0, 1, 2].map(|c| albedo[c].values[k]),
                )
            })
            .collect();
        let knows: Vec<bool> = of_pixel.iter().map(|&pixel| pixel != Pixel::Texture).collect();
        let divisors = [0, 1].map(|half: usize| {
            let own = |c: usize, k: usize| of_half[half](3 * k + c).max(DARK);
            [0, 1, 2].map(|c| plane(&|k| if of_pixel[k] == Pixel::Apart { own(c, k) } else { albedo[c].values[k] }))
        });
        let lamps = [0, 1, 2].map(|c| plane(&|k| number(input.lamps[3 * k + c])));
        let halves = [0, 1].map(|half: usize| {
            [0, 1, 2].map(|c| plane(&|k| number(input.halves[half][3 * k + c]) / divisors[half][c].values[k]))
        });
        let shape = plane(&|k| {
            let luminance = luminance(&albedo, k);
            let variance = input.variance[k] / scale / scale / (luminance * luminance);
            if variance.is_finite() { variance.clamp(0.0, MOST) } else { 0.0 }
        });
        let variance = variance(&halves, input.share, &shape, &knows);
        let normal = [0, 1, 2].map(|c| plane(&|k| feature(input.normal[3 * k + c]).clamp(-1.0, 1.0)));
        let near = plane(&|k| if input.depth[k] > 0.0 { (1.0 / input.depth[k]).min(MOST) } else { 0.0 });
        let slope = [slope(&near, 1), slope(&near, width)];
        Prepared {
            width,
            height,
            share: input.share,
            scale,
            albedo,
            divisors,
            knows,
            lamps,
            halves,
            variance,
            normal,
            near,
            slope,
            tint,
        }
    }
}

/// What a pixel's halves differ by.
#[derive(Clone, Copy, PartialEq)]
enum Pixel {
    /// By light: each is divided by the albedo of both.
    Light,
    /// By what they have met of a texture, and each knows light by itself: each is divided by its own albedo.
    Apart,
    /// By that, and one of them has met so little that it knows none: what they differ by says nothing of noise.
    Texture,
}

impl Pixel {
    /// From radiance and albedo of the halves, and the albedo of both. It is a texture that they differ by where
    /// division by their own albedos leaves less than half of the difference: not so at the edges of mirrors and of
    /// highlights, whose light does not go with the albedo.
    fn of(radiance: [[f32; 3]; 2], own: [[f32; 3]; 2], albedo: [f32; 3]) -> Self {
        let square = |of: &dyn Fn(usize) -> f32| (0..3).map(|c| of(c) * of(c)).sum::<f32>();
        let whole = square(&|c| (radiance[0][c] - radiance[1][c]) * albedo[c]);
        let left = square(&|c| radiance[0][c] * own[1][c] - radiance[1][c] * own[0][c]);
        if left >= 0.25 * whole {
            Pixel::Light
        } else if (0..3).all(|c| own.iter().all(|own| own[c] >= ENOUGH * albedo[c])) {
            Pixel::Apart
        } else {
            Pixel::Texture
        }
    }
}

/// A power of two near the mean radiance; one of a black picture.
fn scale(input: &Input<'_>) -> f32 {
    let numbers = 3 * input.width * input.height;
    let sum = (0..numbers).map(|k| f64::from(input.mean(k))).filter(|x| x.is_finite()).map(f64::abs).sum::<f64>();
    let mean = (sum / numbers as f64) as f32;
    // The number without its fraction, whose bits are the lower ones.
    let power = f32::from_bits(mean.to_bits() & 0x7f80_0000);
    if power.is_normal() { power.clamp(1e-30, 1e30) } else { 1.0 }
}

/// Half the squared difference of both halves, summed over the channels, and made that of two equal halves: its mean
/// is the variance of one.
fn differences([one, other]: &[Colours; 2], share: f32) -> Plane {
    // The variance of the difference is that of a sample over n a (1 - a), of equal halves 4 / n.
    let factor = 2.0 * share * (1.0 - share);
    Plane::of(one[0].width, one[0].height, |k| {
        let square = |c: usize| {
            let difference = one[c].values[k] - other[c].values[k];
            difference * difference
        };
        factor * (square(0) + square(1) + square(2))
    })
}

/// The variance of a half: as large as the halves tell over a wide square, of the shape that the samples' own has
/// (Rousselle, Knaus, Zwicker 2012, section 5). That one believes the samples independent, which those that are
/// stratified and pixels that share are not: they have a third of it or less.
fn variance(halves: &[Colours; 2], share: f32, shape: &Plane, knows: &[bool]) -> Plane {
    let (width, height) = (shape.width, shape.height);
    let of_halves = differences(halves, share);
    let judged = |plane: &Plane| Plane::of(width, height, |k| if knows[k] { plane.values[k] } else { 0.0 });
    let of_halves = judged(&of_halves);
    let (wide, wide_shape) = (of_halves.blurred(WIDE), judged(shape).blurred(WIDE));
    let (near, near_shape) = (of_halves.blurred(2), shape.blurred(1));
    Plane::of(width, height, |k| {
        let size = wide.values[k] / wide_shape.values[k];
        if size.is_finite() { near_shape.values[k] * size } else { near.values[k] }
    })
}

fn luminance(of: &Colours, k: usize) -> f32 {
    0.2126 * of[0].values[k] + 0.7152 * of[1].values[k] + 0.0722 * of[2].values[k]
}

/// The variance of halves that were filtered, of which nothing else is known.
pub fn variance_of(halves: &[Colours; 2], share: f32) -> Plane {
    differences(halves, share).blurred(3).blurred(3)
}

/// By how much a plane changes from pixel to pixel, `step` numbers apart, on the side where it changes less: at the
/// border of a thing that is its own side.
fn slope(plane: &Plane, step: usize) -> Plane {
    let (width, height, values) = (plane.width, plane.height, &plane.values);
    Plane::of(width, height, |k| {
        let (at, length) = if step == 1 { (k % width, width) } else { (k / width, height) };
        let forwards = (at + 1 < length).then(|| values[k + step] - values[k]);
        let backwards = (at > 0).then(|| values[k] - values[k - step]);
        match (forwards, backwards) {
            (Some(one), Some(other)) => {
                if one.abs() < other.abs() {
                    one
                } else {
                    other
                }
            }
            (one, other) => one.or(other).unwrap_or(0.0),
        }
    })
}
