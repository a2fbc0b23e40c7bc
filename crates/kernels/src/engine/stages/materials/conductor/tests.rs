//! Metals: the value against the formulas in `f64`, reciprocity, the sampled density (Pearson's chi-square), its
//! integral, the furnace.

use super::super::Bsdf;
use super::super::tests::{ANGLES, lanes, normal, number, scalar, vector, viewer};
use super::*;
use crate::lanes::ArrayF;
use crate::scene::materials::{self, Fresnel};
use crate::scene::{Albedo, Material, MaterialTable};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tracer_reference::Random;
use tracer_reference::statistics::{Estimate, chi_square, sidak};

type S = ArrayF<1>;

const WHITE: Fresnel = Fresnel::Tinted { reflectance: Albedo::Color([1.0; 3]), edge_tint: Albedo::Color([1.0; 3]) };
const GOLD: Fresnel = Fresnel::Complex { ior: [0.081, 0.503, 1.464], k: [5.586, 2.268, 1.773] };
const TINTED: Fresnel =
    Fresnel::Tinted { reflectance: Albedo::Color([0.9, 0.5, 0.1]), edge_tint: Albedo::Color([1.0, 0.6, 0.2]) };

fn table(fresnel: Fresnel, alpha: f64, multiple_scattering: bool) -> MaterialTable {
    let roughness = Albedo::number(alpha.sqrt());
    MaterialTable::new(&[Material::Conductor(materials::Conductor { fresnel, roughness, multiple_scattering })], 0, 0)
}

fn bsdf(table: &MaterialTable) -> Bsdf<'_, S> {
    Bsdf::new(table, <S as Lanes>::U::splat(0), <S as Lanes>::M::from_bits(1)).0
}

const ALPHAS: [f64; 7] = [1e-3, 0.01, 0.04, 0.1, 0.25, 0.6, 1.0];

/// Cells of directions by their half vector with wo: squared sine of its angle to the normal, eight sectors about the
/// normal. dwi = 4 (wo.h) dh (Walter et al. 2007, eq. 14).
struct Cells {
    wo: DVec3,
    frame: [DVec3; 3],
    /// Bounds of the squared sine.
    bounds: Vec<f64>,
}

const SECTORS: usize = 8;

impl Cells {
    fn new(wo: DVec3, alpha: f64) -> Self {
        let n = normal();
        let across = wo - wo.dot(n) * n;
        let x = if across.length() > 1e-9 { across.normalize() } else { n.any_orthonormal_vector() };
        // The quantiles of D cos, tan^2 = alpha^2 u / (1 - u), and from the last of them on steps that grow with the
        // sine.
        let sin2 = |u: f64| alpha * alpha * u / (1.0 - u + alpha * alpha * u);
        let mut bounds: Vec<f64> = (0..16).map(|k| sin2(f64::from(k) / 16.0)).collect();
        let least = sin2(15.0 / 16.0);
        bounds.extend((1..=16).map(|k| libm::pow(least, 1.0 - f64::from(k) / 16.0)));
        Cells { wo, frame: [x, n.cross(x), n], bounds }
    }

    fn of(&self, wi: DVec3) -> usize {
        let h = (self.wo + wi).normalize();
        let [x, y, n] = self.frame;
        let sin2 = n.cross(h).length_squared();
        let ring = self.bounds.partition_point(|&b| b <= sin2).clamp(1, self.bounds.len() - 1) - 1;
        let turn = (libm::atan2(h.dot(y), h.dot(x)) + PI) / TAU;
        SECTORS * ring + ((turn * SECTORS as f64) as usize).min(SECTORS - 1)
    }

    /// The integral over each cell of a density in wi, above the surface, by the midpoint rule in sin^2 and angle:
    /// dh = dsin2 dangle / (2 cos).
    fn integrate(&self, density: impl Fn(DVec3) -> f64) -> Vec<f64> {
        const STEPS: usize = 24;
        const TURNS: usize = 48;
        let [x, y, n] = self.frame;
        let mut cells = Vec::new();
        for pair in self.bounds.windows(2) {
            for sector in 0..SECTORS {
                let mut sum = 0.0;
                for i in 0..STEPS {
                    let sin2 = pair[0] + (pair[1] - pair[0]) * (i as f64 + 0.5) / STEPS as f64;
                    let (sin, cos) = (sin2.sqrt(), (1.0 - sin2).sqrt());
                    for j in 0..TURNS {
                        let turn = (sector as f64 + (j as f64 + 0.5) / TURNS as f64) / SECTORS as f64;
                        let angle = turn * TAU - PI;
                        let h = n * cos + (x * libm::cos(angle) + y * libm::sin(angle)) * sin;
                        let o_h = self.wo.dot(h);
                        let wi = 2.0 * o_h * h - self.wo;
                        if o_h > 0.0 && wi.dot(n) > 0.0 {
                            sum += density(wi) * 4.0 * o_h / (2.0 * cos);
                        }
                    }
                }
                let area = (pair[1] - pair[0]) / STEPS as f64 * TAU / (SECTORS * TURNS) as f64;
                cells.push(sum * area);
            }
        }
        cells
    }
}

/// The single reflection of a white metal, by the textbook.
fn once(alpha: f64, n: DVec3, wo: DVec3, wi: DVec3) -> f64 {
    let [n, wo, wi] = [n, wo, wi].map(DVec3::normalize);
    let h = (wo + wi).normalize();
    let sin2 = n.cross(h).length_squared();
    let (a2, cos2) = (alpha * alpha, 1.0 - sin2);
    let d = a2 / (PI * (sin2 + a2 * cos2).powi(2));
    let lambda = |cos: f64| 0.5 * ((1.0 + a2 * (1.0 / (cos * cos) - 1.0)).sqrt() - 1.0);
    let (o, i) = (n.dot(wo), n.dot(wi));
    d / (1.0 + lambda(o) + lambda(i)) / (4.0 * o * i)
}

#[test]
fn values_are_those_of_the_formula_and_reciprocal() {
    let mut random = Random::new(1);
    for alpha in ALPHAS {
        let (white, gold) = (table(WHITE, alpha, false), table(GOLD, alpha, true));
        let (white, gold) = (bsdf(&white), bsdf(&gold));
        for degrees in ANGLES {
            for _ in 0..200 {
                let (n, wo) = (lanes(normal()), lanes(viewer(degrees)));
                let d = random.direction();
                let mirrored = 2.0 * viewer(degrees).dot(normal()) * normal() - viewer(degrees);
                let wi = if random.below(2) == 0 { d } else { (mirrored + 2.0 * alpha * d).normalize() };
                if wi.dot(normal()) < 1e-3 {
                    continue;
                }
                let wi = lanes(wi);
                let f = vector(white.evaluate(n, wo, wi, n.dot(wi)).0).x;
                let expected = once(alpha, vector(n), vector(wo), vector(wi));
                // The half vector is right to 2e-7 over |wo + wi|, and D changes by at most 2/alpha times the change of
                // its sine; cosines are right to 1e-7.
                let cos = vector(n).dot(vector(wi)).min(vector(n).dot(vector(wo)));
                let length = (vector(wo) + vector(wi)).length();
                let allowed = 1e-5 + 2e-6 / (alpha * length) + 1e-6 / cos;
                assert!((f / expected - 1.0).abs() < allowed, "alpha {alpha} at {degrees}: {f} not {expected}");
                let there = vector(gold.evaluate(n, wo, wi, n.dot(wi)).0);
                let back = vector(gold.evaluate(n, wi, wo, n.dot(wo)).0);
                assert!(
                    (there - back).abs().max_element() <= 2e-6 * there.max_element(),
                    "alpha {alpha}: not reciprocal"
                );
            }
        }
    }
}

/// The lobe of several reflections by itself: its probability, and the shares and densities of its steps of cosines.
struct Several {
    probability: f64,
    /// Share of a step, and its density over that of a cosine-weighted one.
    steps: Vec<[f64; 2]>,
}

impl Several {
    fn new(table: &MaterialTable, cos: f64) -> Self {
        let (bsdf, conductors) = (bsdf(table), table.conductors.as_ref().expect("it is a metal"));
        let conductor = bsdf.conductor(conductors, <S as Lanes>::M::from_bits(1));
        let probability = scalar(conductor.loss(conductors, S::splat(cos as f32)).0);
        let sums: Vec<f64> = conductors.sums.iter().map(|&sum| f64::from(sum)).collect();
        let all = sums[GGX_STEPS - 1];
        let cos2 = |k: usize| (k as f64 / (GGX_STEPS - 1) as f64).powi(4);
        let of_step = |k: usize| {
            let share = (sums[k + 1] - sums[k]) / all;
            [share, share / (cos2(k + 1) - cos2(k))]
        };
        Several { probability, steps: (0..GGX_STEPS - 1).map(of_step).collect() }
    }

    /// Its density at a cosine.
    fn density(&self, cos: f64) -> f64 {
        let step = ((cos.sqrt() * (GGX_STEPS - 1) as f64) as usize).min(GGX_STEPS - 2);
        self.steps[step][1] * cos / PI
    }

    /// Adds so many of its directions to the cells that they lie in, evenly in cos^2 and angle within a step.
    fn add(&self, cells: &Cells, count: f64, to: &mut [f64]) {
        const ROWS: usize = 32;
        const TURNS: usize = 512;
        let cos2 = |k: usize| (k as f64 / (GGX_STEPS - 1) as f64).powi(4);
        let [x, y, n] = cells.frame;
        for (k, [share, _]) in self.steps.iter().enumerate() {
            for row in 0..ROWS {
                let cos2 = cos2(k) + (cos2(k + 1) - cos2(k)) * (row as f64 + 0.5) / ROWS as f64;
                for turn in 0..TURNS {
                    let angle = TAU * (turn as f64 + 0.5) / TURNS as f64;
                    let wi = n * cos2.sqrt() + (x * libm::cos(angle) + y * libm::sin(angle)) * (1.0 - cos2).sqrt();
                    to[cells.of(wi)] += count * share / (ROWS * TURNS) as f64;
                }
            }
        }
    }
}

/// Counts of sampled directions against the integral of the density, which is one but for the samples below the
/// horizon; the evaluated density is that, and each sample's density and weight are the evaluated ones. The lobe of
/// several reflections has steps too steep for the cells: it is integrated by itself. 5 % for all together (Šidák).
#[test]
fn samples_have_the_evaluated_density() {
    const SAMPLES: u32 = 20_000;
    let cases: Vec<(f64, bool)> = ALPHAS.iter().flat_map(|&alpha| [(alpha, false), (alpha, true)]).collect();
    let level = sidak(0.05, cases.len() * ANGLES.len());
    let mut random = Random::new(3);
    for (alpha, several) in cases {
        let (of_both, of_one) = (table(TINTED, alpha, several), table(TINTED, alpha, false));
        let (bsdf, alone) = (bsdf(&of_both), bsdf(&of_one));
        for degrees in ANGLES {
            let (n, wo) = (lanes(normal()), lanes(viewer(degrees)));
            let cells = Cells::new(viewer(degrees), alpha);
            let lobe = several.then(|| Several::new(&of_both, scalar(n.dot(wo))));
            let p = lobe.as_ref().map_or(0.0, |lobe| lobe.probability);
            let of_one = |wi: V3<S>| (1.0 - p) * scalar(alone.evaluate(n, wo, wi, n.dot(wi)).1);
            let mut expected = cells.integrate(|wi| of_one(lanes(wi)) * f64::from(SAMPLES));
            if let Some(lobe) = &lobe {
                lobe.add(&cells, p * f64::from(SAMPLES), &mut expected);
            }
            // The midpoint rule misses slivers above the horizon; a sample may still lie there.
            expected.iter_mut().for_each(|e| *e = e.max(1e-3));
            let within: f64 = expected.iter().sum();
            assert!(within < f64::from(SAMPLES) * 1.004, "alpha {alpha} at {degrees}: density {within}");
            let mut counts = vec![0u64; expected.len() + 1];
            for _ in 0..SAMPLES {
                let s = bsdf.sample_rough(n, wo, number(&mut random), number(&mut random), number(&mut random));
                let pdf = scalar(s.pdf);
                counts[if pdf > 0.0 { cells.of(vector(s.wi)) } else { expected.len() }] += 1;
                if pdf > 0.0 {
                    let cos = scalar(n.dot(s.wi));
                    let (f, density) = bsdf.evaluate(n, wo, s.wi, n.dot(s.wi));
                    assert!((pdf / scalar(density) - 1.0).abs() < 1e-5);
                    let reckoned = of_one(s.wi) + lobe.as_ref().map_or(0.0, |lobe| p * lobe.density(cos));
                    // At the border of two steps rounding may take the other.
                    let place = cos.sqrt() * (GGX_STEPS - 1) as f64;
                    let off = (pdf / reckoned - 1.0).abs();
                    assert!(off < 1e-4 || (place - place.round()).abs() < 1e-4, "alpha {alpha} at {degrees}: {off:e}");
                    let weight = vector(f) * (cos / pdf);
                    assert!((vector(s.weight) - weight).abs().max_element() < 1e-5 * weight.max_element().max(1.0));
                }
            }
            expected.push((f64::from(SAMPLES) - within).max(1e-3));
            let p = chi_square(&counts, &expected);
            assert!(p > level, "alpha {alpha}, several {several}, at {degrees} degrees: p {p:e}");
        }
    }
}

/// A white metal reflects all that it gets, to what its table is good for, and never more; by one reflection alone it
/// loses some.
#[test]
fn furnace() {
    let mut random = Random::new(4);
    for alpha in ALPHAS {
        for several in [false, true] {
            let table = table(WHITE, alpha, several);
            let bsdf = bsdf(&table);
            for degrees in [0.0, 30.0, 60.0, 80.0, 88.0] {
                let weights: Vec<f64> = (0..20_000)
                    .map(|_| {
                        let (u, v, lobe) = (number(&mut random), number(&mut random), number(&mut random));
                        let s = bsdf.sample_rough(lanes(normal()), lanes(viewer(degrees)), u, v, lobe);
                        if scalar(s.pdf) > 0.0 { vector(s.weight).x } else { 0.0 }
                    })
                    .collect();
                let e = Estimate::of(&weights);
                // 70 means at 5 standard errors; E between the table's places is linear: 3e-3.
                let slack = 5.0 * e.error() + 3e-3;
                assert!(e.mean < 1.0 + slack, "alpha {alpha} at {degrees}: {} +- {}", e.mean, e.error());
                if several {
                    assert!(e.mean > 1.0 - slack, "alpha {alpha} at {degrees}: {} +- {}", e.mean, e.error());
                } else if alpha > 0.5 && degrees < 45.0 {
                    assert!(e.mean < 0.97, "alpha {alpha} at {degrees}: {}", e.mean);
                }
            }
        }
    }
}

/// Fresnel's equations in complex numbers, and the points that the tinted model is told by.
#[test]
fn fresnel_is_the_closed_form() {
    let of = |fresnel: Fresnel, cos: f64| {
        let table = table(fresnel, 0.5, true);
        let (bsdf, conductors) = (bsdf(&table), table.conductors.as_ref().unwrap());
        vector(bsdf.conductor(conductors, <S as Lanes>::M::from_bits(1)).fresnel(S::splat(cos as f32)))
    };
    // At normal incidence ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2), at grazing one.
    let (ior, k) = ([0.081, 0.503, 1.464], [5.586, 2.268, 1.773]);
    let normal = DVec3::from([0, 1, 2].map(|c: usize| {
        let (up, down): (f64, f64) = (ior[c] - 1.0, ior[c] + 1.0);
        (up * up + k[c] * k[c]) / (down * down + k[c] * k[c])
    }));
    assert!((of(GOLD, 1.0) - normal).abs().max_element() < 2e-6);
    assert!((of(GOLD, 0.0) - DVec3::ONE).abs().max_element() < 2e-6);
    // Without absorption it is glass: at Brewster's angle half of the other polarisation.
    let glass = Fresnel::Complex { ior: [1.5; 3], k: [0.0; 3] };
    let cos = 1.0 / (1.0f64 + 1.5 * 1.5).sqrt();
    let s = (1.0 - 1.5 * 1.5) / (1.0 + 1.5 * 1.5);
    assert!((of(glass, cos).x - 0.5 * s * s).abs() < 2e-6);
    assert!((of(TINTED, 1.0) - DVec3::new(0.9, 0.5, 0.1)).abs().max_element() < 1e-6);
    assert!((of(TINTED, 0.0) - DVec3::ONE).abs().max_element() < 1e-6);
    let schlick = DVec3::new(0.9, 0.5, 0.1).map(|f0| f0 + (1.0 - f0) * libm::pow(6.0 / 7.0, 5.0));
    let at_82 = schlick * DVec3::new(1.0, 0.6, 0.2);
    assert!((of(TINTED, 1.0 / 7.0) - at_82).abs().max_element() < 2e-6);
}

/// Where a texture says how rough a metal is, it is there the metal of that roughness: at the table's places, between
/// them, and at both ends.
#[test]
fn a_roughness_by_a_texture_is_that_roughness() {
    let mut random = Random::new(5);
    for fresnel in [WHITE, GOLD, TINTED] {
        let conductor = materials::Conductor { fresnel, roughness: Albedo::Texture(0), multiple_scattering: true };
        // Behind another one, so that it does not begin the table.
        let smooth = materials::Conductor { roughness: Albedo::number(0.0), ..conductor };
        let varying = MaterialTable::new(&[Material::Conductor(smooth), Material::Conductor(conductor)], 1, 1);
        for roughness in [0.02, 1.0 / 31.0, 0.1, 0.3, 0.5, 15.0 / 31.0, 0.77, 0.999, 1.0] {
            let alpha = roughness * roughness;
            let constant = table(fresnel, alpha, true);
            let constant = bsdf(&constant);
            let mut here = Bsdf::<S>::new(&varying, <S as Lanes>::U::splat(1), <S as Lanes>::M::from_bits(1)).0;
            here.parameter = S::splat(alpha as f32);
            for degrees in ANGLES {
                let (n, wo) = (lanes(normal()), lanes(viewer(degrees)));
                for _ in 0..50 {
                    let wi = random.direction();
                    let wi = lanes(if wi.dot(normal()) < 0.0 { -wi } else { wi });
                    let (f, pdf) = here.evaluate(n, wo, wi, n.dot(wi));
                    let (g, density) = constant.evaluate(n, wo, wi, n.dot(wi));
                    // E is linear between the same places, once in f64 and once in f32: 1 - E is right to 1e-7, of
                    // which the second lobe has at most the share (1 - E) / (pi (1 - E_avg)).
                    let off = (vector(f) - vector(g)).abs().max_element();
                    assert!(off < 1e-5 * vector(g).max_element() + 2e-6, "{roughness} at {degrees}: {off:e}");
                    let off = (scalar(pdf) - scalar(density)).abs();
                    assert!(off < 1e-5 * scalar(density) + 2e-6, "{roughness} at {degrees}: {off:e}");
                }
            }
        }
    }
}

/// Whatever a metal is seen from, behind its interpolated normal too, what it reflects once is never more than what
/// comes, sample by sample; and what it reflects several times has no weights of hundreds.
#[test]
fn no_sample_is_worth_much_more_than_one() {
    let mut random = Random::new(6);
    for alpha in ALPHAS {
        for several in [false, true] {
            let table = table(WHITE, alpha, several);
            let bsdf = bsdf(&table);
            let n = lanes(normal());
            for cos in [-0.5, -0.2, -0.05, -0.002, 0.0, 0.0005, 0.003, 0.02, 0.1, 0.4, 1.0f64] {
                let across = normal().any_orthonormal_vector();
                let wo = lanes(cos * normal() + (1.0 - cos * cos).sqrt() * across);
                let weights: Vec<f64> = (0..4000)
                    .map(|_| {
                        let (u, v, lobe) = (number(&mut random), number(&mut random), number(&mut random));
                        let s = bsdf.sample_rough(n, wo, u, v, lobe);
                        if scalar(s.pdf) > 0.0 { vector(s.weight).x } else { 0.0 }
                    })
                    .collect();
                let most = weights.iter().copied().fold(0.0, f64::max);
                assert!(weights.iter().all(|weight| *weight >= 0.0), "alpha {alpha} at {cos}");
                // By one reflection G2/G1 of the normal that is seen. By several the losses of a step of the table over
                // their mean there: they fall to an eighth within one at most.
                let bound = if several { 8.0 } else { 1.0 + 1e-3 };
                assert!(most < bound, "alpha {alpha}, several {several}, at {cos}: {most}");
                // As in the furnace: five standard errors of 154 means, and 3e-3 between the table's places.
                let e = Estimate::of(&weights);
                let at = format!("alpha {alpha}, several {several}, at {cos}");
                assert!(e.mean < 1.0 + 5.0 * e.error() + 3e-3, "{at}: {} +- {}", e.mean, e.error());
            }
        }
    }
}
