//! Texture look-up over lanes: mapping, wrap, then the nearest texel or the four around, decoded from sRGB before they
//! are mixed.

use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::sampler::unit;
use crate::scene::TextureTable;
use crate::srgb::SRGB_TO_LINEAR;

/// The colour of texture `id` at (u, v), v upwards, in the lanes of the mask; black elsewhere.
#[inline(always)]
pub fn texture_color<F: Lanes>(table: &TextureTable, id: F::U, u: F, v: F, mask: F::M) -> V3<F> {
    let c = F::splat;
    let zero = F::U::splat(0);
    let one = F::U::splat(1);
    let id = F::U::select(mask, id, zero);
    let width = F::U::gather(&table.width, id);
    let height = F::U::gather(&table.height, id);
    let wrap = F::U::gather(&table.wrap, id);
    let nearest = F::U::gather(&table.nearest, id).eq(one);
    let (mut u, mut v) = (u, v);
    if !table.mapping.is_empty() {
        let place = id * F::U::splat(6);
        let [xu, xv, x] = F::gather3(&table.mapping, place);
        let [yu, yv, y] = F::gather3(&table.mapping, place + F::U::splat(3));
        (u, v) = (xu.fma(u, xv.fma(v, x)), yu.fma(u, yv.fma(v, y)));
    }
    // Row 0 is the top of the picture.
    let (x, y) = (u, c(1.0) - v);
    let (x0, x1, fx) = axis(x, width, wrap, nearest);
    let (y0, y1, fy) = axis(y, height, wrap, nearest);
    let (row0, row1) = (y0 * width, y1 * width);
    let texture = Place::new(table, id, mask);
    let top_left = texture.fetch(row0 + x0);
    if (nearest | !mask).bits() == F::first(F::N).bits() {
        return top_left;
    }
    let top = mix(top_left, texture.fetch(row0 + x1), fx);
    let bottom = mix(texture.fetch(row1 + x0), texture.fetch(row1 + x1), fx);
    mix(top, bottom, fy)
}

/// a (1 - f) + b f.
#[inline(always)]
fn mix<F: Lanes>(a: V3<F>, b: V3<F>, f: F) -> V3<F> {
    b.sub(a).mad(f, a)
}

/// Linear light of the lowest byte of each word.
#[inline(always)]
fn decode<F: Lanes>(word: F::U) -> F {
    F::gather(&*SRGB_TO_LINEAR, word & F::U::splat(0xff))
}

/// From here on a coordinate is known to an eighth and less.
const FRACTIONS: f32 = 1_048_576.0;

/// A number from 0 to 2 that anything about x decides.
#[inline(always)]
fn scrambled<F: Lanes>(x: F) -> F {
    let bits = x.to_bits() * F::U::splat(0x9e37_79b1);
    let bits = (bits ^ bits.shr::<15>()) * F::U::splat(0x85eb_ca6b);
    unit::<F>(bits ^ bits.shr::<13>()) * F::splat(2.0)
}

/// The two texels along an axis and the weight of the second. Texel k covers [k, k + 1)/n, its centre is (k + 1/2)/n.
#[inline(always)]
fn axis<F: Lanes>(x: F, n: F::U, wrap: F::U, nearest: F::M) -> (F::U, F::U, F) {
    let c = F::splat;
    let one = F::U::splat(1);
    let size = F::from_int(n);
    let clamp = wrap.eq(one);
    let mirror = wrap.eq(F::U::splat(2));
    // Towards the horizon of a plane a coordinate has no fraction any more: any, as likely as another.
    let far = c(FRACTIONS).lt(x.abs()) & !clamp;
    let x = if far.any() { F::select(far, scrambled(x), x) } else { x };
    // To [0, 1): a clamped coordinate by its value, a repeated one by its fraction, a mirrored one by a triangle wave.
    let clamped = x.max(c(0.0)).min(c(1.0));
    let fraction = x - floor(x);
    let half = x * c(0.5);
    let wave = (half - floor(half)) * c(2.0);
    let mirrored = F::select(c(1.0).lt(wave), c(2.0) - wave, wave);
    let inside = F::select(clamp, clamped, F::select(mirror, mirrored, fraction));
    let position = inside * size - F::select(nearest, c(0.0), c(0.5));
    let base = floor(position);
    let weight = F::select(nearest, c(0.0), position - base);
    // base is -1 .. n - 1 (n when `inside` rounded to 1).
    let first = (base + c(1.0)).max(c(0.0)).to_int();
    let last = n - one;
    let clamp_edge = clamp | mirror;
    // `first` is base + 1: 0 stands for the texel before the first.
    let before = first.eq(F::U::splat(0));
    let low = F::U::select(before, F::U::select(clamp_edge, F::U::splat(0), last), first - one);
    let low = F::U::select(last.lt(low), last, low);
    let beyond = last.lt(first);
    let high = F::U::select(beyond, F::U::select(clamp_edge, last, F::U::splat(0)), first);
    (low, high, weight)
}

/// Largest integer not above x, |x| < 2^22 (larger texture coordinates have no fraction worth the name).
#[inline(always)]
pub fn floor<F: Lanes>(x: F) -> F {
    let magic = F::splat(12_582_912.0);
    let x = x.max(F::splat(-4_194_304.0)).min(F::splat(4_194_304.0));
    let rounded = (x + magic) - magic;
    F::select(x.lt(rounded), rounded - F::splat(1.0), rounded)
}

/// Where the texels of each lane's texture stand, and how.
struct Place<'t, F: Lanes> {
    words: &'t [u32],
    offset: F::U,
    /// Three floats a texel.
    wide: F::M,
    /// Three bytes in a word.
    narrow: F::M,
}

impl<'t, F: Lanes> Place<'t, F> {
    #[inline(always)]
    fn new(table: &'t TextureTable, id: F::U, mask: F::M) -> Self {
        let wide = mask & F::U::gather(&table.wide, id).eq(F::U::splat(1));
        Place { words: &table.words, offset: F::U::gather(&table.offset, id), wide, narrow: mask & !wide }
    }

    /// The colour of a texel; black outside the mask.
    #[inline(always)]
    fn fetch(&self, texel: F::U) -> V3<F> {
        let zero = F::U::splat(0);
        let mut color = V3::<F>::zero();
        if self.narrow.any() {
            let word = F::U::gather(self.words, F::U::select(self.narrow, self.offset + texel, zero));
            let texel = V3(decode::<F>(word), decode::<F>(word.shr::<8>()), decode::<F>(word.shr::<16>()));
            color = V3::select(self.narrow, texel, color);
        }
        if self.wide.any() {
            let place = F::U::select(self.wide, self.offset + texel * F::U::splat(3), zero);
            let [x, y, z] = F::U::gather3(self.words, place);
            color = V3::select(self.wide, V3(F::from_bits(x), F::from_bits(y), F::from_bits(z)), color);
        }
        color
    }
}
