//! Tori, by the roots of their quartic.

use glam::DVec3;
use std::f64::consts::TAU;

/// A complex number.
#[derive(Clone, Copy)]
struct Complex(f64, f64);

impl Complex {
    fn plus(self, other: Complex) -> Complex {
        Complex(self.0 + other.0, self.1 + other.1)
    }

    fn times(self, other: Complex) -> Complex {
        Complex(self.0 * other.0 - self.1 * other.1, self.0 * other.1 + self.1 * other.0)
    }

    fn over(self, other: Complex) -> Complex {
        let square = other.0 * other.0 + other.1 * other.1;
        let Complex(re, im) = self.times(Complex(other.0, -other.1));
        Complex(re / square, im / square)
    }
}

/// All roots of a polynomial of the fourth degree whose first coefficient is 1, at once (Durand 1960, Kerner 1966).
fn roots(c: [f64; 4]) -> [Complex; 4] {
    let at = |x: Complex| c.iter().fold(Complex(1.0, 0.0), |sum, c| sum.times(x).plus(Complex(*c, 0.0)));
    // As large as the roots may be.
    let size = 1.0 + c.iter().enumerate().map(|(k, c)| c.abs().powf(1.0 / (k + 1) as f64)).fold(0.0, f64::max);
    let mut all = [0, 1, 2, 3].map(|k| {
        let angle = 0.4 + TAU / 4.0 * f64::from(k);
        Complex(size * angle.cos(), size * angle.sin())
    });
    for _ in 0..300 {
        let mut largest = 0f64;
        for k in 0..4 {
            let mut step = at(all[k]);
            for j in (0..4).filter(|&j| j != k) {
                step = step.over(all[k].plus(Complex(-all[j].0, -all[j].1)));
            }
            if step.0.is_finite() && step.1.is_finite() {
                all[k] = all[k].plus(Complex(-step.0, -step.1));
                largest = largest.max(step.0.abs()).max(step.1.abs());
            }
        }
        if largest < 1e-15 * size {
            break;
        }
    }
    all
}

/// Every t where a line crosses the surface of the torus with radii 1 and `tube` about the z axis.
pub fn crossings(tube: f64, o: DVec3, d: DVec3) -> Vec<f64> {
    // By the way in units from the point that is nearest to the middle.
    let (length, middle) = (d.length(), -o.dot(d) / d.dot(d));
    let (o, d) = (o + middle * d, d / length);
    if o.length() > 1.0 + tube {
        return Vec::new();
    }
    // (|p|^2 + 1 - tube^2)^2 - 4 (x^2 + y^2) = (s^2 + k)^2 - 4 (a s^2 + 2 b s + c)
    let k = o.dot(o) + 1.0 - tube * tube;
    let (a, b, c) = (d.truncate().dot(d.truncate()), o.truncate().dot(d.truncate()), o.truncate().dot(o.truncate()));
    let roots = roots([0.0, 2.0 * k - 4.0 * a, -8.0 * b, k * k - 4.0 * c]);
    let value = |s: f64| (s * s + k).powi(2) - 4.0 * (a * s * s + 2.0 * b * s + c);
    let slope = |s: f64| 4.0 * s * (s * s + k) - 8.0 * (a * s + b);
    let real = roots.into_iter().filter(|Complex(_, im)| im.abs() < 1e-7);
    real.map(|Complex(s, _)| middle + (s - value(s) / slope(s)) / length).filter(|t| t.is_finite()).collect()
}

/// Of the distance from the circle of radius 1, which is `tube` on the surface.
pub fn gradient(q: DVec3) -> DVec3 {
    q - (q * DVec3::new(1.0, 1.0, 0.0)).normalize_or(DVec3::X)
}

/// The way round its section, from 0 to 1, 1/2 on the outside.
pub fn section(q: DVec3) -> f64 {
    0.5 + q.z.atan2(q.truncate().length() - 1.0) / TAU
}
