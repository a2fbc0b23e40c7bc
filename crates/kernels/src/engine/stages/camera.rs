//! Camera rays: a point in the pixel by its filter, a point on the lens; from there [`super::cameras`] knows the way.

use super::cameras::View;
use super::points::{PairPoints, PixelOf};
use crate::engine::batch::{Batch, path};
use crate::lanes::{ArrayF, Bits, Lanes, Mask};
use crate::math::{V3, exp, ln, sincos_turns};
use crate::sampling::blocks::ITEM_PIXELS;
use crate::sampling::sampler::Purpose;
use crate::scene::{Camera, Filter, NONE, Projection, Scene};

/// Fills `batch.paths` with the camera rays of those of its items that have a bit set in `items`: of their pixels in
/// the picture.
#[inline(always)]
pub fn camera<F: Lanes>(scene: &Scene, seed: u32, items: u32, batch: &mut Batch) {
    let c = F::splat;
    let camera: &Camera = &scene.camera;
    let pixel_points = PairPoints::<F>::new(seed, Purpose::Pixel, &batch.items);
    let lens_points = PairPoints::<F>::new(seed, Purpose::Lens, &batch.items);
    let view = View::<F>::new(camera, scene.size);
    let has_lens = matches!(camera.projection, Projection::Perspective { lens: Some(_), .. });
    // Pixel coordinates relative to the picture's middle are small integers and halves: exact.
    let middle = scene.size.map(|side| side as f32 / 2.0);
    let [left, top] = middle.map(|middle| c(middle - 0.5));
    let (scale_x, scale_y) = (c(1.0 / middle[0]), c(-1.0 / middle[1]));
    let paths = &mut *batch.paths;
    paths.len = 0;
    for k in 0..batch.items.len() {
        if items >> k & 1 == 0 {
            continue;
        }
        let resting = batch.items[k].resting;
        for j in (0..ITEM_PIXELS).step_by(F::N) {
            let i = paths.len;
            let slot = F::U::load(&SLOTS[j..]) + F::U::splat((k * ITEM_PIXELS) as u32);
            let of = k * ITEM_PIXELS + j;
            let (x, y) = (F::load(&batch.pixels.x[of..]) - left, F::load(&batch.pixels.y[of..]) - top);
            let mut inside = x.abs().lt(c(middle[0])) & y.abs().lt(c(middle[1]));
            if resting != 0 {
                inside = inside & awake::<F>(resting, F::U::load(&batch.pixels.z[of..]));
            }
            let pixel = PixelOf::<F>::new(slot, &batch.pixels);
            let (u, v) = pixel_points.points(&pixel);
            let (dx, dy) = filter_offset::<F>(camera.filter, u, v);
            let eye = view.eye(x * scale_x, y * scale_y);
            let (x, y) = ((x + dx) * scale_x, (y + dy) * scale_y);
            let lens = if has_lens { lens_points.points(&pixel) } else { (c(0.0), c(0.0)) };
            let ray = view.ray(eye, x, y, lens);
            let inside = inside & ray.seen;
            ray.origin.store(&mut paths.origin, i);
            ray.direction.normalise().store(&mut paths.direction, i);
            V3::grey(c(1.0)).store(&mut paths.throughput, i);
            c(1.0).store(&mut paths.eta2[i..]);
            (inverse_density::<F>(camera.filter, dx, dy) * ray.measure).store(&mut paths.film[i..]);
            (slot | F::U::splat(path::SPECULAR)).store(&mut paths.slot[i..]);
            F::U::splat(NONE).store(&mut paths.from_primitive[i..]);
            F::U::splat(NONE).store(&mut paths.from_instance[i..]);
            let count = inside.count();
            if count < F::N {
                paths.keep::<F>(i, inside);
            }
            paths.len += count;
        }
    }
    batch.counters.camera_rays += paths.len as u64;
}

/// Pixels, by their numbers in Z-order, that lie in none of the tiles with a bit set.
#[inline(always)]
fn awake<F: Lanes>(resting: u8, z: F::U) -> F::M {
    let tile = z.shr::<8>() & F::U::splat(3);
    // The same as `resting >> tile & 1`.
    let bits = F::U::gather(&[0, 1, 2, 3].map(|tile| u32::from(resting >> tile & 1)), tile);
    bits.eq(F::U::splat(0))
}

/// One over the filter's density at an offset from the pixel's centre, in pixels; zero where light paths are not
/// reckoned with: beyond [`Filter::reach`], and for all rays through the centre.
#[inline(always)]
fn inverse_density<F: Lanes>(filter: Filter, dx: F, dy: F) -> F {
    let c = F::splat;
    let reach = c(filter.reach());
    let within = dx.abs().lt(reach) & dy.abs().lt(reach);
    let inverse = match filter {
        Filter::Centre => return c(0.0),
        Filter::Box => return c(1.0),
        Filter::Gaussian(sigma) => {
            let (sigma2, r2) = (c((sigma * sigma) as f32), dx.fma(dx, dy * dy));
            exp(r2 / (sigma2 + sigma2)) * sigma2 * c(2.0 * std::f32::consts::PI)
        }
        Filter::BlackmanHarris(radius) => {
            let (x, y) = (dx * c(1.0 / radius as f32), dy * c(1.0 / radius as f32));
            let density = blackman_harris_density(x) * blackman_harris_density(y);
            c((radius * radius) as f32) / density
        }
    };
    F::select(within, inverse, c(0.0))
}

/// The filter's density at an offset from the pixel's centre, in pixels, with what [`along_axis`] has of both
/// coordinates; zero where [`inverse_density`] is.
pub fn density(filter: Filter, [dx, dy]: [f32; 2], along: [f32; 2]) -> f32 {
    type One = ArrayF<1>;
    let (reach, mut inverse) = (filter.reach(), [0.0]);
    match filter {
        Filter::BlackmanHarris(radius) if dx.abs() < reach && dy.abs() < reach => {
            inverse[0] = (radius * radius) as f32 / (along[0] * along[1]);
        }
        Filter::BlackmanHarris(_) => {}
        _ => inverse_density(filter, One::splat(dx), One::splat(dy)).store(&mut inverse),
    }
    // A box has its reach nowhere near an edge for rays, but light paths fall anywhere.
    if inverse[0] > 0.0 && dx.abs() <= reach && dy.abs() <= reach { 1.0 / inverse[0] } else { 0.0 }
}

/// What [`density`] has of an offset along one axis: light paths fall on many pixels of one column or row.
pub fn along_axis(filter: Filter, offset: f32) -> f32 {
    let Filter::BlackmanHarris(radius) = filter else { return 1.0 };
    let mut density = [0.0];
    blackman_harris_density(ArrayF::<1>::splat(offset * (1.0 / radius as f32))).store(&mut density);
    density[0]
}

/// Density of the window on [-1, 1].
#[inline(always)]
fn blackman_harris_density<F: Lanes>(x: F) -> F {
    let (_, c1) = sincos_turns(x * F::splat(0.5));
    density_by_cosine(c1)
}

/// The same, of cos(pi x).
#[inline(always)]
fn density_by_cosine<F: Lanes>(c1: F) -> F {
    let c = F::splat;
    // cos(2 t) and cos(3 t) of cos(t).
    let c2 = (c1 + c1).fma(c1, c(-1.0));
    let c3 = (c2 + c2).fma(c1, c(0.0) - c1);
    let sum = c1.fma(c(A[1]), c2.fma(c(A[2]), c3.fma(c(A[3]), c(A[0]))));
    (sum * c(0.5 / A[0])).max(c(1e-6))
}

static SLOTS: [u32; ITEM_PIXELS] = {
    let mut table = [0; ITEM_PIXELS];
    let mut k = 0;
    while k < ITEM_PIXELS {
        table[k] = k as u32;
        k += 1;
    }
    table
};

/// Offset from the pixel's centre, in pixels.
#[inline(always)]
pub fn filter_offset<F: Lanes>(filter: Filter, u: F, v: F) -> (F, F) {
    let c = F::splat;
    match filter {
        Filter::Centre => (c(0.0), c(0.0)),
        Filter::Box => (u - c(0.5), v - c(0.5)),
        Filter::Gaussian(sigma) => {
            let radius = (ln(c(1.0) - u) * c(-2.0)).max(c(0.0)).sqrt() * c(sigma as f32);
            let (sin, cos) = sincos_turns(v);
            (radius * cos, radius * sin)
        }
        Filter::BlackmanHarris(radius) => {
            (blackman_harris(u) * c(radius as f32), blackman_harris(v) * c(radius as f32))
        }
    }
}

/// a0 .. a3 of the window.
const A: [f32; 4] = [0.358_75, 0.488_29, 0.141_28, 0.011_68];

/// Inverse of the cumulative 4-term Blackman-Harris window on [-1, 1] (Harris 1978): as of a Gaussian, which it is
/// close to, x = -z P(z^2) with z^2 = -ln(4 u (1 - u)), to 1.3e-3, and a step of Newton's, to 3e-6; to 3e-5 where u is
/// below 1e-4.
#[inline(always)]
fn blackman_harris<F: Lanes>(u: F) -> F {
    let c = F::splat;
    let one = c(1.0);
    // The other half is its mirror image. Further out than 2^-26 no offset is told apart.
    let lower = u.min(one - u).max(c(1.5e-8));
    let z2 = (c(0.0) - ln(lower * (one - lower) * c(4.0))).max(c(0.0));
    let p = z2.fma(z2.fma(z2.fma(z2.fma(c(P[4]), c(P[3])), c(P[2])), c(P[1])), c(P[0]));
    let x = c(0.0) - z2.sqrt() * p;
    let (s1, c1) = sincos_turns(x * c(0.5));
    let x = x - (cumulative(x, s1, c1) - lower) / density_by_cosine(c1);
    let x = x.max(c(-1.0)).min(c(0.0));
    F::select(u.lt(c(0.5)), x, c(0.0) - x)
}

/// Of the lowest power first: least squares over z.
const P: [f32; 5] = [0.358_638_47, -0.001_353_680_7, -0.000_566_029_6, 1.104_860_5e-5, 1.934_494_7e-7];

/// Share of the window a0 + a1 cos(pi x) + a2 cos(2 pi x) + a3 cos(3 pi x) that lies below x, of sine and cosine of
/// pi x; its whole is 2 a0.
#[inline(always)]
fn cumulative<F: Lanes>(x: F, s1: F, c1: F) -> F {
    let c = F::splat;
    let (s2, two_c) = (s1 * c1 * c(2.0), c1 + c1);
    let s3 = two_c.fma(s2, c(0.0) - s1);
    let pi = std::f32::consts::PI;
    let sines = s1.fma(c(A[1] / pi), s2.fma(c(A[2] / (2.0 * pi)), s3 * c(A[3] / (3.0 * pi))));
    x.fma(c(A[0]), sines).fma(c(0.5 / A[0]), c(0.5))
}
