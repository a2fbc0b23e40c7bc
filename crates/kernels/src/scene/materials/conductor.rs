//! Metals: a specular lobe, or GGX with what is reflected several times among the bumps.

use super::ggx;
use super::{Albedo, BxdfFlags, LEAST_ALPHA, Lobe, MaterialKind, NARROWEST_ALPHA, Row, Traits, narrow};
use crate::scene::table::Table;

/// How much a metal reflects, by the angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fresnel {
    /// Fresnel's equations for unpolarised light, n and k per channel.
    Complex {
        /// n.
        ior: [f64; 3],
        /// k.
        k: [f64; 3],
    },
    /// F(c) = F0 + (1 - F0)(1 - c)^5 - b c (1 - c)^6, b such that at c = 1/7 Schlick's part is multiplied by the tint
    /// (Kutz, Hasan, Edmondson 2021; OpenPBR 1.1).
    Tinted {
        /// F0.
        reflectance: Albedo,
        /// The tint.
        edge_tint: Albedo,
    },
}

/// A metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// How much it reflects.
    pub fresnel: Fresnel,
    /// r: the width of the lobe is alpha = r^2; below `LEAST_ALPHA` it is a specular one.
    pub roughness: Albedo,
    /// Whether light that is reflected several times among the bumps counts (Kulla and Conty 2017):
    /// F_ms (1 - E(mu_o)) (1 - E(mu_i)) / (pi (1 - E_avg)), F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg)).
    pub multiple_scattering: bool,
}

impl Conductor {
    /// alpha, where it is the same everywhere.
    pub fn alpha(&self) -> Option<f64> {
        self.roughness.constant().map(|[roughness, ..]| roughness * roughness)
    }

    /// Those that the table has rows of: its own, or those of the steps that E is known at.
    fn alphas(&self) -> Vec<f64> {
        let step = |k: usize| k as f64 / (ggx::STEPS - 1) as f64;
        self.alpha().map_or_else(|| (0..ggx::STEPS).map(|k| step(k) * step(k)).collect(), |alpha| vec![alpha])
    }

    /// How many rows it has in the table.
    pub(super) fn rows(&self) -> usize {
        if self.alpha().is_some() { 1 } else { ggx::STEPS }
    }

    fn is_specular(&self) -> bool {
        self.alpha().is_some_and(|alpha| alpha < LEAST_ALPHA)
    }
}

impl MaterialKind for Conductor {
    fn row(&self) -> Row {
        let lobe = if self.is_specular() { Lobe::SmoothConductor } else { Lobe::Conductor };
        let width = self.alpha().map_or(self.roughness, Albedo::number);
        let second = match self.fresnel {
            Fresnel::Complex { .. } => Albedo::Color([1.0; 3]),
            Fresnel::Tinted { edge_tint, .. } => edge_tint,
        };
        Row { parameters: [width, Albedo::number(0.0)], second, ..Row::new(lobe, self.traits().color) }
    }

    fn traits(&self) -> Traits {
        let color = match self.fresnel {
            Fresnel::Complex { ior, k } => {
                // At normal incidence.
                let square = |x: f64| x * x;
                let at = |c: usize| (square(ior[c] - 1.0) + square(k[c])) / (square(ior[c] + 1.0) + square(k[c]));
                Albedo::Color([at(0), at(1), at(2)])
            }
            Fresnel::Tinted { reflectance, .. } => reflectance,
        };
        let lobe = match self.alpha() {
            None => BxdfFlags::SPECULAR.or(BxdfFlags::GLOSSY),
            Some(_) if self.is_specular() => BxdfFlags::SPECULAR,
            Some(_) => BxdfFlags::GLOSSY,
        };
        // A texture may be narrow somewhere.
        let is_narrow = self.alpha().is_none_or(|alpha| alpha <= f64::from(NARROWEST_ALPHA));
        let casts = if is_narrow { color.largest() } else { 0.0 };
        let narrow = self.alpha().map_or(1.0, narrow);
        Traits { flags: BxdfFlags::REFLECTION.or(lobe), color, casts, narrow }
    }

    fn conductor(&self) -> Option<&Conductor> {
        Some(self)
    }
}

/// The conductors' rows, and 1 - E of each by the cosine. One whose roughness is a texture has [`ggx::STEPS`] rows in
/// place of one, of the roughnesses k / (STEPS - 1): what is between two is as far between them, as E itself is told.
pub struct ConductorTable {
    /// alpha; 1 where Fresnel's equations hold, else 0; n or tint; k; F_avg of the former; E_avg; 1 / (pi (1 - E_avg)),
    /// or 0.
    pub rows: Table<13>,
    /// 1 - E at the cosines (k / (STEPS - 1))^2, [`ggx::STEPS`] for each conductor.
    pub losses: Vec<f32>,
    /// What of 1 - E, cosine-weighted, lies below these cosines: 2 times the integral of (1 - E) c dc, 1 - E linear
    /// between the steps as it is told. By its differences the lobe of several reflections is sampled.
    pub sums: Vec<f32>,
    /// Of each row, 1 where it is the first of several; empty where all have one.
    pub several: Vec<u32>,
}

impl ConductorTable {
    /// `None` where there are none.
    pub fn new<'a>(conductors: impl Iterator<Item = &'a Conductor>) -> Option<Self> {
        let (mut rows, mut losses, mut several) = (Vec::new(), Vec::new(), Vec::new());
        let mut sums = Vec::new();
        for conductor in conductors {
            several.push(u32::from(conductor.alpha().is_none()));
            for alpha in conductor.alphas() {
                let energy = ggx::Energy::of(if alpha < LEAST_ALPHA { 0.0 } else { alpha });
                rows.push(row(conductor, alpha, energy.average));
                let lost = energy.by_cosine.map(|e| 1.0 - e);
                losses.extend(lost.map(|lost| lost as f32));
                sums.extend(ggx::sums(&lost.map(|lost| lost.max(0.0))).map(|sum| sum as f32));
            }
            several.resize(rows.len(), 0);
        }
        if several.iter().all(|&first| first == 0) {
            several = Vec::new();
        }
        (!rows.is_empty()).then(|| ConductorTable { rows: Table::new(rows), losses, sums, several })
    }
}

/// A conductor's row at one alpha, with E_avg there.
fn row(conductor: &Conductor, alpha: f64, energy: f64) -> [f32; 13] {
    let (exact, n, k, average) = match conductor.fresnel {
        Fresnel::Complex { ior, k } => (1.0, ior, k, [0, 1, 2].map(|c| average(ior[c], k[c]))),
        Fresnel::Tinted { edge_tint, .. } => (0.0, edge_tint.constant().unwrap_or([1.0; 3]), [0.0; 3], [0.0; 3]),
    };
    let left = 1.0 - energy;
    let scale = if conductor.multiple_scattering && left > 1e-6 { 1.0 / (std::f64::consts::PI * left) } else { 0.0 };
    let numbers = [alpha, exact].into_iter().chain(n).chain(k).chain(average);
    let mut row = [0.0; 13];
    for (to, number) in row.iter_mut().zip(numbers.chain([energy, scale])) {
        *to = number as f32;
    }
    row
}

/// Fresnel's reflectance of unpolarised light at a cosine: the mean of both polarisations (Born and Wolf, 14.4).
fn exact(n: f64, k: f64, cos: f64) -> f64 {
    let (c2, s2) = (cos * cos, 1.0 - cos * cos);
    let t0 = n * n - k * k - s2;
    let a2_b2 = (t0 * t0 + 4.0 * n * n * k * k).sqrt();
    let a = (0.5 * (a2_b2 + t0)).max(0.0).sqrt();
    let (t1, t2) = (a2_b2 + c2, 2.0 * cos * a);
    let rs = (t1 - t2) / (t1 + t2);
    let (t3, t4) = (c2 * a2_b2 + s2 * s2, t2 * s2);
    0.5 * rs * (1.0 + (t3 - t4) / (t3 + t4))
}

/// 2 times the integral of F(c) c dc, by the midpoint rule in c^2.
fn average(n: f64, k: f64) -> f64 {
    const STEPS: u32 = 256;
    (0..STEPS).map(|i| exact(n, k, ((f64::from(i) + 0.5) / f64::from(STEPS)).sqrt())).sum::<f64>() / f64::from(STEPS)
}
