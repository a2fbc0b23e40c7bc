//! Elementary functions over lanes, by polynomials: the same bits on every machine and for every N.
//! Coefficients are minimax fits; the largest errors against `libm` in f64 are asserted by the tests below.

use crate::lanes::{Bits, Lanes};

/// sin and cos of 2 pi u, |u| < 2^20: reduced to quarter turns, then an odd and an even polynomial on [-pi/4, pi/4].
/// Absolute error below 2e-7.
#[inline(always)]
pub fn sincos_turns<F: Lanes>(u: F) -> (F, F) {
    let c = F::splat;
    // Adding 1.5 * 2^23 rounds to the nearest integer, ties to even, and leaves it in the low bits.
    let magic = c(12_582_912.0);
    let rounded = u.fma(c(4.0), magic);
    let quadrant = rounded.to_bits();
    let r = u.fma(c(4.0), -(rounded - magic)) * c(std::f32::consts::FRAC_PI_2);
    let r2 = r * r;
    let s = r2.fma(c(-1.951_529_6e-4), c(8.332_161e-3));
    let s = r2.fma(s, c(-1.666_665_5e-1));
    let s = (r2 * r).fma(s, r);
    let k = r2.fma(c(2.443_315_7e-5), c(-1.388_731_6e-3));
    let k = r2.fma(k, c(4.166_664_6e-2));
    let k = (r2 * r2).fma(k, r2.fma(c(-0.5), c(1.0)));
    let one = F::U::splat(1);
    let swap = (quadrant & one).eq(one);
    let (sin, cos) = (F::select(swap, k, s), F::select(swap, s, k));
    let sign_sin = (quadrant & F::U::splat(2)).shl::<30>();
    let sign_cos = ((quadrant + one) & F::U::splat(2)).shl::<30>();
    (F::from_bits(sin.to_bits() ^ sign_sin), F::from_bits(cos.to_bits() ^ sign_cos))
}

/// Natural logarithm of a positive normal number. Relative error below 3e-7.
/// (Mantissa to [sqrt 1/2, sqrt 2), then 2 atanh(f / (2 + f)).)
#[inline(always)]
pub fn ln<F: Lanes>(x: F) -> F {
    let c = F::splat;
    let bits = x.to_bits() - F::U::splat(0x3f35_04f3);
    let exponent = F::from_int(bits.shr::<23>() + F::U::splat(128)) - F::from_int(sign_wrap::<F>(bits));
    let mantissa = F::from_bits((bits & F::U::splat(0x007f_ffff)) + F::U::splat(0x3f35_04f3));
    let f = mantissa - c(1.0);
    let s = f / (c(2.0) + f);
    let z = s * s;
    let p = z.fma(c(0.242_790_79), c(0.284_987_87));
    let p = z.fma(p, c(0.400_009_72));
    let p = z.fma(p, c(0.666_666_6));
    // ln m = f - s (f - z p), which loses no digit near m = 1.
    let ln_m = f - s * (f - z * p);
    exponent.fma(c(0.693_145_75), exponent.fma(c(1.428_606_8e-6), ln_m))
}

/// 128 where the exponent counts up from zero, 384 where the subtraction in [`ln`] wrapped below it.
#[inline(always)]
fn sign_wrap<F: Lanes>(bits: F::U) -> F::U {
    let wrapped = F::U::splat(0x7fff_ffff).lt(bits);
    F::U::select(wrapped, F::U::splat(128 + 512), F::U::splat(128))
}

/// ln(1 + x), x > -1, with small relative error near 0 (Kahan).
#[inline(always)]
pub fn ln1p<F: Lanes>(x: F) -> F {
    let one = F::splat(1.0);
    let u = one + x;
    let d = u - one;
    let exact = d.le(F::splat(0.0)) & F::splat(0.0).le(d);
    F::select(exact, x, ln(u) * (x / F::select(exact, one, d)))
}

/// e^x for x <= 88; 0 below -87. Relative error below 3e-7.
#[inline(always)]
pub fn exp<F: Lanes>(x: F) -> F {
    let c = F::splat;
    let low = x.lt(c(-87.0));
    let x = x.max(c(-87.0));
    let magic = c(12_582_912.0);
    let rounded = x.fma(c(std::f32::consts::LOG2_E), magic);
    let n = rounded - magic;
    let r = n.fnma(c(0.693_145_75), x);
    let r = n.fnma(c(1.428_606_8e-6), r);
    let scale = F::from_bits((rounded.to_bits() + F::U::splat(127)).shl::<23>());
    F::select(low, c(0.0), (exp_tail(r) * r + c(1.0)) * scale)
}

/// (e^r - 1) / r for |r| <= 0.35.
#[inline(always)]
fn exp_tail<F: Lanes>(r: F) -> F {
    let c = F::splat;
    let p = r.fma(c(1.0 / 5040.0), c(1.0 / 720.0));
    let p = r.fma(p, c(1.0 / 120.0));
    let p = r.fma(p, c(1.0 / 24.0));
    let p = r.fma(p, c(1.0 / 6.0));
    let p = r.fma(p, c(0.5));
    r.fma(p, c(1.0))
}

/// e^x - 1 for x <= 0, with small relative error near 0.
#[inline(always)]
pub fn expm1<F: Lanes>(x: F) -> F {
    let near = F::splat(-0.35).lt(x);
    F::select(near, exp_tail(x) * x, exp(x) - F::splat(1.0))
}

/// arccos of x in [-1, 1], in radians. Absolute error below 1e-6.
/// (Abramowitz and Stegun 4.4.46, with the mirrored half.)
#[inline(always)]
pub fn acos<F: Lanes>(x: F) -> F {
    let c = F::splat;
    let a = x.abs().min(c(1.0));
    let p = a.fma(c(-0.001_262_491_1), c(0.006_670_09));
    let p = a.fma(p, c(-0.017_088_126));
    let p = a.fma(p, c(0.030_891_88));
    let p = a.fma(p, c(-0.050_174_305));
    let p = a.fma(p, c(0.088_978_99));
    let p = a.fma(p, c(-0.214_598_8));
    let p = a.fma(p, c(std::f32::consts::FRAC_PI_2));
    let r = (c(1.0) - a).sqrt() * p;
    F::select(x.lt(c(0.0)), c(std::f32::consts::PI) - r, r)
}

/// atan2(y, x) / (2 pi), in [-1/2, 1/2]. Absolute error below 2e-7.
#[inline(always)]
pub fn atan2_turns<F: Lanes>(y: F, x: F) -> F {
    let c = F::splat;
    let (ax, ay) = (x.abs(), y.abs());
    let (big, small) = (ax.max(ay), ax.min(ay));
    let zero = big.le(c(0.0));
    let q = small / F::select(zero, c(1.0), big);
    let z = q * q;
    // atan q / q on [0, 1].
    let p = z.fma(c(0.002_866_225_7), c(-0.016_165_737));
    let p = z.fma(p, c(0.042_909_61));
    let p = z.fma(p, c(-0.075_289_64));
    let p = z.fma(p, c(0.106_562_64));
    let p = z.fma(p, c(-0.142_089));
    let p = z.fma(p, c(0.199_935_51));
    let p = z.fma(p, c(-0.333_331_45));
    let p = z.fma(p, c(1.0));
    let turns = p * q * c(0.5 * std::f32::consts::FRAC_1_PI);
    let turns = F::select(ax.lt(ay), c(0.25) - turns, turns);
    let turns = F::select(x.lt(c(0.0)), c(0.5) - turns, turns);
    F::from_bits(turns.to_bits() | (y.to_bits() & F::U::splat(0x8000_0000)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::ArrayF;

    type S = ArrayF<1>;
    fn run(f: impl Fn(S) -> S, x: f32) -> f64 {
        let mut out = [0.0];
        f(S::splat(x)).store(&mut out);
        f64::from(out[0])
    }
    /// 20,001 points from a to b.
    fn points(a: f32, b: f32) -> impl Iterator<Item = f32> {
        (0..=20_000).map(move |i| a + (b - a) * (i as f32 / 20_000.0))
    }

    #[test]
    fn sin_and_cos_of_turns() {
        for u in points(-3.0, 3.0) {
            let x = f64::from(u) * std::f64::consts::TAU;
            assert!((run(|u| sincos_turns(u).0, u) - libm::sin(x)).abs() < 2e-7, "sin {u}");
            assert!((run(|u| sincos_turns(u).1, u) - libm::cos(x)).abs() < 2e-7, "cos {u}");
        }
    }

    #[test]
    fn logarithms() {
        for e in -120..120 {
            for x in points(1.0, 2.0).step_by(97) {
                let x = x * 2f32.powi(e);
                let exact = libm::log(f64::from(x));
                assert!((run(ln, x) - exact).abs() <= 3e-7 * exact.abs().max(1e-30) + 1e-37, "ln {x}");
            }
        }
        for e in -40..0 {
            for x in points(1.0, 1.999).step_by(97) {
                for x in [x * 2f32.powi(e), -x * 2f32.powi(e)] {
                    let exact = libm::log1p(f64::from(x));
                    let got = run(ln1p, x);
                    assert!((got - exact).abs() <= 6e-7 * exact.abs(), "ln1p {x}: {got} {exact}");
                }
            }
        }
    }

    #[test]
    fn exponentials() {
        for x in points(-86.9, 80.0) {
            let exact = libm::exp(f64::from(x));
            assert!((run(exp, x) - exact).abs() <= 5e-7 * exact, "exp {x}");
        }
        assert_eq!(run(exp, -200.0), 0.0);
        for x in points(-3.0, 0.0).chain(points(-1e-3, 0.0)) {
            let exact = libm::expm1(f64::from(x));
            assert!((run(expm1, x) - exact).abs() <= 6e-7 * exact.abs(), "expm1 {x}");
        }
    }

    #[test]
    fn inverse_circular() {
        for x in points(-1.0, 1.0) {
            assert!((run(acos, x) - libm::acos(f64::from(x))).abs() < 1e-6, "acos {x}");
        }
        for t in points(-0.5, 0.5) {
            let a = f64::from(t) * std::f64::consts::TAU;
            let (y, x) = ((3.0 * libm::sin(a)) as f32, (3.0 * libm::cos(a)) as f32);
            let exact = libm::atan2(f64::from(y), f64::from(x)) / std::f64::consts::TAU;
            assert!((run(|y| atan2_turns(y, S::splat(x)), y) - exact).abs() < 2e-7, "atan2 {y} {x}");
        }
    }
}
