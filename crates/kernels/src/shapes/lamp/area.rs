//! True areas: of unit shapes under affine maps.

use glam::{DMat3, DVec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// How much larger a piece of surface becomes under a map, by its unit normal: the length of cof(M) n.
pub(super) fn growth(map: &DMat3, n: DVec3) -> f64 {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = *map;
    (y.cross(z) * n.x + z.cross(x) * n.y + x.cross(y) * n.z).length()
}

/// Of a disk of radius 1 across the z axis.
pub(super) fn of_disk(map: &DMat3) -> f64 {
    PI * growth(map, DVec3::Z)
}

/// Of the side of a cone between z = -half and half whose radius is middle + slope z. The growth depends on the way
/// round only: integral of the radius times that of the growth.
pub(super) fn of_side(map: &DMat3, middle: f64, slope: f64, half: f64) -> f64 {
    let at = |angle: f64| growth(map, DVec3::new(libm::cos(angle), libm::sin(angle), -slope));
    let eighth = |k: f64| simpson(&at, k * FRAC_PI_4, (k + 1.0) * FRAC_PI_4);
    let eighths = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0].map(eighth);
    let whole: f64 = eighths.iter().map(|piece| piece.sum).sum();
    let integral: f64 = eighths.into_iter().map(|piece| refined(&at, piece, 1e-13 * whole, 40)).sum();
    2.0 * half * middle * integral
}

/// Of all points at most `tube` away from a circle of radius 1 about the z axis. Normals to the axis and away from it
/// come in pairs that are the same, with rho = 1 - x and 1 + x: so a piece is as large as one at rho = 1. Summed all
/// the way round, the growth is an even and periodic function of the other angle, so sums over middles of pieces come
/// near soon: twice as many pieces each way, until it is the same to 1e-9, or to some 1e-6 of maps that leave nothing
/// of one direction.
pub(super) fn of_torus(map: &DMat3, tube: f64) -> f64 {
    let with = |pieces: u32| {
        let n = f64::from(pieces);
        let row = |i: u32| {
            let (up, across) = libm::sincos((f64::from(i) + 0.5) * FRAC_PI_2 / n);
            let at = |k: u32| {
                let (sin, cos) = libm::sincos((f64::from(k) + 0.5) * FRAC_PI_2 / n);
                growth(map, DVec3::new(across * cos, across * sin, up))
            };
            (0..4 * pieces).map(at).sum::<f64>()
        };
        PI * PI * tube / (n * n) * (0..pieces).map(row).sum::<f64>()
    };
    let (mut pieces, mut area) = (16, with(16));
    while pieces < 512 {
        pieces *= 2;
        let finer = with(pieces);
        let same = (finer - area).abs() <= 1e-9 * finer;
        area = finer;
        if same {
            break;
        }
    }
    area
}

/// Of the sphere of radius 1: 4 pi R_G of the squared growths along the axes of the map's ellipsoid (Carlson; DLMF
/// 19.16.3).
pub(super) fn of_ball(map: &DMat3) -> f64 {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = *map;
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    let [most, middle, least] = eigenvalues(&(cofactors.transpose() * cofactors));
    4.0 * PI * carlson_g(most, least, middle)
}

/// The radius of a sphere about the origin that holds the ellipsoid.
pub(super) fn reach_of_ball(map: &DMat3) -> f64 {
    eigenvalues(&(map.transpose() * *map))[0].max(0.0).sqrt()
}

/// An interval, and Simpson's sum.
#[derive(Clone, Copy)]
struct Piece {
    ends: [f64; 2],
    sum: f64,
}

fn simpson(at: &impl Fn(f64) -> f64, from: f64, to: f64) -> Piece {
    let sum = (to - from) / 6.0 * (at(from) + 4.0 * at(0.5 * (from + to)) + at(to));
    Piece { ends: [from, to], sum }
}

/// Halved until the sum of both halves is that of the whole but for so much.
fn refined(at: &impl Fn(f64) -> f64, piece: Piece, error: f64, left: u32) -> f64 {
    let middle = 0.5 * (piece.ends[0] + piece.ends[1]);
    let halves = [simpson(at, piece.ends[0], middle), simpson(at, middle, piece.ends[1])];
    let sum = halves[0].sum + halves[1].sum;
    if left == 0 || (sum - piece.sum).abs() <= 15.0 * error {
        return sum + (sum - piece.sum) / 15.0;
    }
    halves.into_iter().map(|half| refined(at, half, 0.5 * error, left - 1)).sum()
}

/// Of a symmetric matrix, the largest first.
fn eigenvalues(m: &DMat3) -> [f64; 3] {
    let (a, b, c) = (m.x_axis.x, m.y_axis.y, m.z_axis.z);
    let (d, e, f) = (m.y_axis.x, m.z_axis.x, m.z_axis.y);
    let mean = (a + b + c) / 3.0;
    let spread =
        ((a - mean) * (a - mean) + (b - mean) * (b - mean) + (c - mean) * (c - mean) + 2.0 * (d * d + e * e + f * f))
            / 6.0;
    let spread = spread.sqrt();
    if spread <= 0.0 {
        return [mean; 3];
    }
    let shifted = (*m - DMat3::from_diagonal(DVec3::splat(mean))) * (1.0 / spread);
    let angle = libm::acos((0.5 * shifted.determinant()).clamp(-1.0, 1.0)) / 3.0;
    let of = |turn: f64| mean + 2.0 * spread * libm::cos(angle + turn);
    let (most, least) = (of(0.0), of(2.0 * PI / 3.0));
    [most, (3.0 * mean - most - least).max(0.0), least.max(0.0)]
}

/// R_G(x, y, z) with z between the others: no term is below zero (DLMF 19.21.10).
fn carlson_g(x: f64, y: f64, z: f64) -> f64 {
    if z <= 0.0 {
        return 0.5 * x.max(y).sqrt();
    }
    0.5 * (z * carlson_f(x, y, z) - (x - z) * (y - z) * carlson_d(x, y, z) / 3.0 + x.sqrt() * y.sqrt() / z.sqrt())
}

/// R_F by duplication (Carlson 1979).
fn carlson_f(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    loop {
        let (a, b, c) = (x.sqrt(), y.sqrt(), z.sqrt());
        let step = a * (b + c) + b * c;
        (x, y, z) = (0.25 * (x + step), 0.25 * (y + step), 0.25 * (z + step));
        let mean = (x + y + z) / 3.0;
        let (p, q, r) = ((mean - x) / mean, (mean - y) / mean, (mean - z) / mean);
        if p.abs().max(q.abs()).max(r.abs()) < 1e-3 {
            let (e2, e3) = (p * q - r * r, p * q * r);
            return (1.0 + (e2 / 24.0 - 0.1 - 3.0 * e3 / 44.0) * e2 + e3 / 14.0) / mean.sqrt();
        }
    }
}

/// R_D by duplication (Carlson 1979).
fn carlson_d(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    let (mut sum, mut factor) = (0.0, 1.0);
    loop {
        let (a, b, c) = (x.sqrt(), y.sqrt(), z.sqrt());
        let step = a * (b + c) + b * c;
        sum += factor / (c * (z + step));
        factor *= 0.25;
        (x, y, z) = (0.25 * (x + step), 0.25 * (y + step), 0.25 * (z + step));
        let mean = 0.2 * (x + y + 3.0 * z);
        let (p, q, r) = ((mean - x) / mean, (mean - y) / mean, (mean - z) / mean);
        if p.abs().max(q.abs()).max(r.abs()) < 1e-3 {
            let (ea, eb) = (p * q, r * r);
            let (ec, ed) = (ea - eb, ea - 6.0 * eb);
            let ee = ed + ec + ec;
            let series = 1.0
                + ed * (-3.0 / 14.0 + 0.25 * 9.0 / 22.0 * ed - 1.5 * 3.0 / 26.0 * r * ee)
                + r * (ee / 6.0 + r * (-9.0 / 22.0 * ec + r * 3.0 / 26.0 * ea));
            return 3.0 * sum + factor * series / (mean * mean.sqrt());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn near(a: f64, b: f64, error: f64) {
        assert!((a / b - 1.0).abs() < error, "{a} is not {b}");
    }

    /// Spheroids (Knud Thomsen's sources: closed forms by the eccentricity), a ball, a flat one.
    #[test]
    fn ellipsoids() {
        let of = |x: f64, y: f64, z: f64| of_ball(&DMat3::from_diagonal(DVec3::new(x, y, z)));
        near(of(2.0, 2.0, 2.0), 16.0 * PI, 1e-14);
        for ratio in [0.999f64, 0.5, 0.1, 1e-3, 1e-6] {
            let e = (1.0 - ratio * ratio).sqrt();
            let oblate = TAU * (1.0 + ratio * ratio / e * ((1.0 + e) / ratio).ln());
            let prolate = TAU * ratio * ratio * (1.0 + e.asin() / (ratio * e));
            near(of(1.0, 1.0, ratio), oblate, 1e-9);
            near(of(ratio, 1.0, ratio), prolate, 1e-9);
        }
        near(of(1.0, 1.0, 0.0), TAU, 1e-7);
    }

    /// By counting little pieces, under a map that shears.
    #[test]
    fn sheared_surfaces() {
        let map = DMat3::from_cols_array_2d(&[[0.9, 0.1, -0.3], [0.4, 1.7, 0.2], [-0.6, 0.5, 0.4]]);
        let n = 1000;
        let middle = |k: i32| (f64::from(k) + 0.5) / f64::from(n);
        let (mut ball, mut side) = (0.0, 0.0);
        for i in 0..n {
            let z = 2.0 * middle(i) - 1.0;
            let r = (1.0 - z * z).sqrt();
            for k in 0..n {
                let (cos, sin) = ((TAU * middle(k)).cos(), (TAU * middle(k)).sin());
                ball += 2.0 * TAU * growth(&map, DVec3::new(r * cos, r * sin, z));
                // By the vectors along and round it.
                let (radius, along) = (0.7 - 0.2 * z, DVec3::new(-0.2 * cos, -0.2 * sin, 1.0));
                let round = DVec3::new(-sin, cos, 0.0) * radius;
                side += 2.0 * TAU * (map * round).cross(map * along).length();
            }
        }
        near(ball / f64::from(n * n), of_ball(&map), 1e-5);
        near(side / f64::from(n * n), of_side(&map, 0.7, -0.2, 1.0), 1e-10);
    }

    /// Of tori: Pappus, and by counting little pieces under a map that shears.
    #[test]
    fn tori() {
        near(of_torus(&DMat3::IDENTITY, 0.3), TAU * TAU * 0.3, 1e-12);
        near(of_torus(&DMat3::from_diagonal(DVec3::splat(2.0)), 1.0), 4.0 * TAU * TAU, 1e-12);
        let map = DMat3::from_cols_array_2d(&[[0.9, 0.1, -0.3], [0.4, 1.7, 0.2], [-0.6, 0.5, 0.4]]);
        let (n, tube) = (400, 0.6);
        let angle = |k: i32| TAU * (f64::from(k) + 0.5) / f64::from(n);
        let mut sum = 0.0;
        for i in 0..n {
            let (up, out) = angle(i).sin_cos();
            for k in 0..n {
                let (sin, cos) = angle(k).sin_cos();
                let round = DVec3::new(-sin, cos, 0.0) * (1.0 + tube * out);
                let along = DVec3::new(-up * cos, -up * sin, out) * tube;
                sum += (map * round).cross(map * along).length();
            }
        }
        near(sum * TAU * TAU / f64::from(n * n), of_torus(&map, tube), 1e-8);
        // Squeezed flat: both sides of what is between two circles.
        let flat = DMat3::from_diagonal(DVec3::new(1.0, 1.0, 1e-7));
        near(of_torus(&flat, 0.5), TAU * (1.5f64.powi(2) - 0.5f64.powi(2)), 1e-6);
    }

    /// A right cone's and cylinder's side, and how far a thin one's is from two flat strips.
    #[test]
    fn sides() {
        near(of_side(&DMat3::IDENTITY, 1.0, 0.0, 1.0), 4.0 * PI, 1e-14);
        near(of_side(&DMat3::IDENTITY, 0.5, 0.5, 1.0), PI * 5f64.sqrt(), 1e-14);
        let flat = DMat3::from_diagonal(DVec3::new(1.0, 1e-6, 1.0));
        near(of_side(&flat, 1.0, 0.0, 1.0), 8.0, 1e-9);
        near(of_disk(&flat), PI * 1e-6, 1e-14);
    }
}
