//! The input as it is filtered: irradiance without lamps and textures, its noise, and features.

use crate::input::Input;
use crate::plane::{Colours, Plane};

/// Albedos below are taken for this: what is nearly black is not made bright.
pub const DARK: f32 = 0.002;
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
        let tint = [0, 1, 2].map(|c| plane(&|k| feature(input.albedo[3 * k + c]).clamp(0.0, 1.0)));
        let albedo = [0, 1, 2].map(|c| plane(&|k| tint[c].values[k].max(DARK)));
        let lamps = [0, 1, 2].map(|c| plane(&|k| number(input.lamps[3 * k + c])));
        let halves =
            input.halves.map(|half| [0, 1, 2].map(|c| plane(&|k| number(half[3 * k + c]) / albedo[c].values[k])));
        let shape = plane(&|k| {
            let [r, g, b] = [0, 1, 2].map(|c| albedo[c].values[k]);
            let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            let variance = input.variance[k] / scale / scale / (luminance * luminance);
            if variance.is_finite() { variance.clamp(0.0, MOST) } else { 0.0 }
        });
        let variance = variance(&halves, input.share, &shape);
        let normal = [0, 1, 2].map(|c| plane(&|k| feature(input.normal[3 * k + c]).clamp(-1.0, 1.0)));
        let near = plane(&|k| if input.depth[k] > 0.0 { (1.0 / input.depth[k]).min(MOST) } else { 0.0 });
        let slope = [slope(&near, 1), slope(&near, width)];
        Prepared {
            width,
            height,
            share: input.share,
            scale,
            albedo,
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
fn variance(halves: &[Colours; 2], share: f32, shape: &Plane) -> Plane {
    let of_halves = differences(halves, share);
    let (wide, wide_shape) = (of_halves.blurred(WIDE), shape.blurred(WIDE));
    let (near, near_shape) = (of_halves.blurred(2), shape.blurred(1));
    Plane::of(shape.width, shape.height, |k| {
        let size = wide.values[k] / wide_shape.values[k];
        if size.is_finite() { near_shape.values[k] * size } else { near.values[k] }
    })
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
