//! Every warp: unit length, its inverse in `f64`, and counts against its density (Pearson's chi-square, 5 % for all
//! together).

use super::*;
use crate::lanes::ArrayF;
use std::f64::consts::TAU;
use tracer_reference::Random;
use tracer_reference::statistics::{chi_square, sidak};

type S = ArrayF<1>;

fn scalar(x: S) -> f64 {
    let mut out = [0.0];
    x.store(&mut out);
    f64::from(out[0])
}
fn vector(v: V3<S>) -> [f64; 3] {
    [scalar(v.0), scalar(v.1), scalar(v.2)]
}
fn turns(y: f64, x: f64) -> f64 {
    libm::atan2(y, x).rem_euclid(TAU) / TAU
}

/// A warp with what undoes it: the point's two numbers, both uniform in [0, 1) when its density is what its comment
/// says.
struct Warp {
    name: String,
    forward: Box<dyn Fn(S, S) -> [f64; 3]>,
    inverse: Box<dyn Fn([f64; 3]) -> [f64; 2]>,
    /// On the unit sphere, or in the plane.
    unit: bool,
}

fn warps() -> Vec<Warp> {
    let mut warps = vec![
        Warp {
            name: "disc".into(),
            forward: Box::new(|u, v| {
                let (x, y) = disc(u, v);
                [scalar(x), scalar(y), 0.0]
            }),
            // Density 1/pi: the share of the disc within r is r^2.
            inverse: Box::new(|[x, y, _]| [x * x + y * y, turns(y, x)]),
            unit: false,
        },
        Warp {
            name: "cosine_hemisphere".into(),
            forward: Box::new(|u, v| vector(cosine_hemisphere(u, v))),
            // Density cos/pi: the integral from the pole to theta is sin^2 theta.
            inverse: Box::new(|[x, y, _]| [x * x + y * y, turns(y, x)]),
            unit: true,
        },
    ];
    for opening in [1e-6f32, 0.01, 0.5, 1.0, 2.0] {
        warps.push(Warp {
            name: format!("cone {opening}"),
            forward: Box::new(move |u, v| vector(cone(u, v, S::splat(opening)))),
            // Density 1/(2 pi opening): (1 - cos theta)/opening, with 1 - cos = sin^2/(1 + cos) where that is exact.
            inverse: Box::new(move |[x, y, z]| {
                let one_minus_cos = if z > 0.0 { (x * x + y * y) / (1.0 + z) } else { 1.0 - z };
                [one_minus_cos / f64::from(opening), turns(y, x)]
            }),
            unit: true,
        });
    }
    for alpha in [1.0f32, 10.0, 1e3, 1e5] {
        warps.push(Warp {
            name: format!("power_cosine {alpha}"),
            forward: Box::new(move |u, v| vector(power_cosine(u, v, S::splat(alpha)))),
            // Density (alpha + 1)/(2 pi) cos^alpha: 1 - cos^(alpha + 1), with cos^2 = 1 - sin^2 where that is exact.
            inverse: Box::new(move |[x, y, _]| {
                let exponent = 0.5 * (f64::from(alpha) + 1.0);
                [-libm::expm1(exponent * libm::log1p(-(x * x + y * y).min(1.0))), turns(y, x)]
            }),
            unit: true,
        });
    }
    warps
}

/// A number as the sampler gives them: 24 bits.
fn number(random: &mut Random) -> f32 {
    (random.bits() >> 40) as f32 / 16_777_216.0
}

#[test]
fn warps_are_undone_by_their_inverses() {
    let mut random = Random::new(1);
    for warp in warps() {
        for _ in 0..2000 {
            let (u, v) = (number(&mut random), number(&mut random));
            let p = (warp.forward)(S::splat(u), S::splat(v));
            if warp.unit {
                let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
                assert!((length - 1.0).abs() < 1e-6, "{}: length {length}", warp.name);
            }
            let [a, b] = (warp.inverse)(p);
            // Components are right to about 3e-7, and u is at most of slope 2 in them.
            assert!((a - f64::from(u)).abs() < 2e-6, "{}: u {u} comes back as {a}", warp.name);
            // The angle is lost at the pole.
            let off = (b - f64::from(v)).abs();
            let r = (p[0] * p[0] + p[1] * p[1]).sqrt();
            assert!(off.min(1.0 - off) * r < 1e-6, "{}: v {v} comes back as {b}", warp.name);
        }
    }
}

/// 16 x 16 cells of equal probability.
#[test]
fn warps_have_their_densities() {
    let all = warps();
    let level = sidak(0.05, all.len());
    let mut random = Random::new(2);
    for warp in &all {
        let mut cells = vec![0u64; 256];
        let n = 100_000;
        for _ in 0..n {
            let (u, v) = (S::splat(number(&mut random)), S::splat(number(&mut random)));
            let [a, b] = (warp.inverse)((warp.forward)(u, v)).map(|x| ((x * 16.0) as usize).min(15));
            cells[16 * a + b] += 1;
        }
        let p = chi_square(&cells, &vec![f64::from(n) / 256.0; 256]);
        assert!(p > level, "{}: p {p}", warp.name);
    }
}

/// The largest numbers that the sampler gives, and the least.
#[test]
fn warps_at_the_ends() {
    let last = 1.0 - 1.0 / 16_777_216.0;
    for warp in warps() {
        for (u, v) in [(0.0, 0.0), (0.0, last), (last, 0.0), (last, last)] {
            let p = (warp.forward)(S::splat(u), S::splat(v));
            let length = p.iter().map(|x| x * x).sum::<f64>();
            assert!(p.iter().all(|x| x.is_finite()) && length <= 1.0 + 2e-6, "{}: {p:?} at ({u}, {v})", warp.name);
        }
    }
    // The lowest direction is sqrt(2^-24) above the horizon, never on it.
    assert!((scalar(cosine_hemisphere(S::splat(last), S::splat(0.0)).2) - 2.44e-4).abs() < 1e-6);
}
