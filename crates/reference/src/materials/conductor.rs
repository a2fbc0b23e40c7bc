//! Metals: GGX as Walter et al. 2007 have it, sampled by all normals, with Heitz's correlated shadowing and masking
//! (2014), and the compensation of Kulla and Conty (2017).

use super::mirror::reflect;
use super::{Incident, Rough, Scattered, seen};
use crate::random::{Random, about, polar};
use crate::surface::Surface;
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tracer_core::scene::materials::{self, Fresnel};

/// A metal with its colour at normal incidence, where a texture has it.
pub struct Conductor {
    pub words: materials::Conductor,
    pub color: DVec3,
    /// What Schlick's reflectance is multiplied by at the cosine 1/7.
    pub tint: DVec3,
    pub alpha: f64,
    /// What it reflects at once, if it were white.
    pub energy: Energy,
}

/// One direction where the metal is smooth, else its lobes.
pub fn scatter(conductor: Conductor, s: &Surface, wo: DVec3) -> Scattered {
    if conductor.alpha >= 1e-4 {
        return Scattered::Rough(Box::new(conductor));
    }
    let reflection = reflect(s, wo);
    let weight = conductor.fresnel(wo.dot(reflection.normal));
    Scattered::Specular(Incident { direction: reflection.direction, weight })
}

impl Conductor {
    /// The reflectance of a flat surface.
    fn fresnel(&self, cos: f64) -> DVec3 {
        let cos = cos.clamp(0.0, 1.0);
        match self.words.fresnel {
            Fresnel::Complex { ior, k } => DVec3::from_array([0, 1, 2].map(|c| complex_fresnel(ior[c], k[c], cos))),
            Fresnel::Tinted { .. } => {
                let schlick = |cos: f64| self.color + (DVec3::ONE - self.color) * (1.0 - cos).powi(5);
                // What has to go at the cosine 1/7.
                let gone = schlick(1.0 / 7.0) * (DVec3::ONE - self.tint);
                let shape = |cos: f64| cos * (1.0 - cos).powi(6);
                (schlick(cos) - gone * (shape(cos) / shape(1.0 / 7.0))).clamp(DVec3::ZERO, DVec3::ONE)
            }
        }
    }

    /// 2 times the integral of F(c) c dc.
    fn average_fresnel(&self) -> DVec3 {
        let steps = 200;
        let cos = |i: i32| (f64::from(i) + 0.5) / f64::from(steps);
        (0..steps).map(|i| self.fresnel(cos(i)) * (2.0 * cos(i) / f64::from(steps))).sum()
    }
}

impl Rough for Conductor {
    /// Of the normal that is seen, times the cosine to that over the cosine to `n`, by which callers multiply.
    fn f(&self, n: DVec3, wo: DVec3, wi: DVec3) -> DVec3 {
        let by_callers = n.dot(wi);
        let n = seen(n, wo);
        let (cos_o, cos_i) = (n.dot(wo), n.dot(wi));
        if cos_o <= 0.0 || cos_i <= 0.0 || by_callers <= 0.0 {
            return DVec3::ZERO;
        }
        let alpha = self.alpha;
        let h = (wo + wi).normalize();
        let once = distribution(alpha, n.dot(h)) * masking(alpha, cos_o, cos_i) / (4.0 * cos_o * cos_i);
        let mut f = self.fresnel(wo.dot(h)) * once;
        if self.words.multiple_scattering {
            let (average, e) = (self.average_fresnel(), self.energy.average);
            let color = average * average * e / (DVec3::ONE - average * (1.0 - e));
            let lost = |cos: f64| 1.0 - self.energy.at(cos);
            f += color * (lost(cos_o) * lost(cos_i) / (PI * (1.0 - e).max(1e-9)));
        }
        f * (cos_i / by_callers)
    }

    /// Cosine-weighted, or every second time wo reflected in a normal of density D cos.
    fn sample(&self, n: DVec3, wo: DVec3, random: &mut Random) -> DVec3 {
        let n = seen(n, wo);
        if random.number() < 0.5 {
            return about(n, polar((1.0 - random.number()).sqrt(), random.number()));
        }
        let u = random.number();
        let tan2 = self.alpha * self.alpha * u / (1.0 - u);
        let h = about(n, polar(1.0 / (1.0 + tan2).sqrt(), random.number()));
        2.0 * wo.dot(h) * h - wo
    }

    fn density(&self, n: DVec3, wo: DVec3, wi: DVec3) -> f64 {
        let n = seen(n, wo);
        let h = (wo + wi).normalize();
        let of_h = distribution(self.alpha, n.dot(h)) * n.dot(h).max(0.0);
        0.5 * n.dot(wi).max(0.0) / PI + 0.5 * of_h / (4.0 * wo.dot(h).abs())
    }
}

/// D (Walter et al. 2007, eq. 33).
fn distribution(alpha: f64, cos: f64) -> f64 {
    if cos <= 0.0 {
        return 0.0;
    }
    let tan2 = 1.0 / (cos * cos) - 1.0;
    let a2 = alpha * alpha;
    a2 / (PI * cos.powi(4) * (a2 + tan2).powi(2))
}

/// G2 (Heitz 2014, eq. 99), with Smith's Lambda of GGX (eq. 72).
fn masking(alpha: f64, cos_o: f64, cos_i: f64) -> f64 {
    let lambda = |cos: f64| {
        let tan2 = 1.0 / (cos * cos) - 1.0;
        0.5 * ((1.0 + alpha * alpha * tan2).sqrt() - 1.0)
    };
    1.0 / (1.0 + lambda(cos_o) + lambda(cos_i))
}

/// Fresnel's equations with a complex index m = n + i k: r_s = (cos - m cos_t)/(cos + m cos_t), r_p = (m cos -
/// cos_t)/(m cos + cos_t), m^2 sin_t^2 = sin^2.
fn complex_fresnel(n: f64, k: f64, cos: f64) -> f64 {
    type Complex = [f64; 2];
    let times = |a: Complex, b: Complex| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
    let size2 = |a: Complex| a[0] * a[0] + a[1] * a[1];
    let m = [n, k];
    let m2 = times(m, m);
    let sin2 = 1.0 - cos * cos;
    // m cos_t = sqrt(m^2 - sin^2), the root with a positive real part.
    let under = [m2[0] - sin2, m2[1]];
    let length = size2(under).sqrt();
    let root = [(0.5 * (length + under[0])).max(0.0).sqrt(), (0.5 * (length - under[0])).max(0.0).sqrt()];
    let s = size2([cos - root[0], -root[1]]) / size2([cos + root[0], root[1]]);
    // r_p times m: m^2 cos against m cos_t.
    let (up, down) = ([m2[0] * cos - root[0], m2[1] * cos - root[1]], [m2[0] * cos + root[0], m2[1] * cos + root[1]]);
    0.5 * (s + size2(up) / size2(down))
}

/// What a white metal reflects at once, by the cosine.
#[derive(Clone)]
pub struct Energy {
    /// At the cosines (k / 64)^2.
    by_cosine: Vec<f64>,
    average: f64,
}

/// Those of a material: one, or of the roughnesses k / (n - 1).
pub struct Energies(Vec<Energy>);

impl Energies {
    /// Of one alpha, or of all.
    pub fn new(alpha: Option<f64>) -> Self {
        let steps = 40;
        let of_step = |k: i32| (f64::from(k) / f64::from(steps)).powi(2);
        Energies(alpha.map_or_else(|| (0..=steps).map(|k| Energy::new(of_step(k))).collect(), |a| vec![Energy::new(a)]))
    }

    /// Linear between the roughnesses.
    pub fn at(&self, roughness: f64) -> Energy {
        let [.., last] = &self.0[..] else { return Energy { by_cosine: vec![1.0; 65], average: 1.0 } };
        let place = roughness * (self.0.len() - 1) as f64;
        let (low, t) = (&self.0[place as usize], place.fract());
        let high = self.0.get(place as usize + 1).unwrap_or(last);
        let mix = |a: f64, b: f64| (1.0 - t) * a + t * b;
        let by_cosine = low.by_cosine.iter().zip(&high.by_cosine).map(|(&a, &b)| mix(a, b)).collect();
        Energy { by_cosine, average: mix(low.average, high.average) }
    }
}

impl Energy {
    /// By integrals over all normals, half-way between the quantiles of D cos.
    pub fn new(alpha: f64) -> Self {
        let by_cosine: Vec<f64> = (0..=64).map(|k| reflected(alpha, (f64::from(k) / 64.0).powi(2))).collect();
        let mut energy = Energy { by_cosine, average: 0.0 };
        let steps = 2000;
        let cos = |i: i32| (f64::from(i) + 0.5) / f64::from(steps);
        energy.average = (0..steps).map(|i| energy.at(cos(i)) * 2.0 * cos(i) / f64::from(steps)).sum();
        energy
    }

    fn at(&self, cos: f64) -> f64 {
        let place = cos.clamp(0.0, 1.0).sqrt() * 64.0;
        let low = (place as usize).min(63);
        let t = place - low as f64;
        (1.0 - t) * self.by_cosine[low] + t * self.by_cosine[low + 1]
    }
}

fn reflected(alpha: f64, cos_o: f64) -> f64 {
    let cos_o = cos_o.max(1e-5);
    let wo = DVec3::new((1.0 - cos_o * cos_o).sqrt(), 0.0, cos_o);
    let (rows, columns) = (160, 160);
    let mut sum = 0.0;
    for row in 0..rows {
        let u = (f64::from(row) + 0.5) / f64::from(rows);
        let cos_h = 1.0 / (1.0 + alpha * alpha * u / (1.0 - u)).sqrt();
        let sin_h = (1.0 - cos_h * cos_h).sqrt();
        for column in 0..columns {
            let angle = TAU * (f64::from(column) + 0.5) / f64::from(columns);
            let h = DVec3::new(sin_h * angle.cos(), sin_h * angle.sin(), cos_h);
            let o_h = wo.dot(h);
            let wi = 2.0 * o_h * h - wo;
            if o_h > 0.0 && wi.z > 0.0 {
                sum += masking(alpha, cos_o, wi.z) * o_h / (cos_o * cos_h);
            }
        }
    }
    sum / f64::from(rows * columns)
}
