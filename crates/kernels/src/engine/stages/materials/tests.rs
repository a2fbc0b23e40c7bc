//! Each material against its formula in `f64`: value, density, samples (Pearson's chi-square), reciprocity, and what it
//! reflects in all; the dielectric against Snell and Fresnel; both on smooth surfaces against the side that they must
//! leave to.

use super::seen::LEAST_COSINE;
use super::*;
use crate::lanes::ArrayF;
use crate::scene::{Albedo, Material, materials};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tracer_reference::Random;
use tracer_reference::statistics::{Estimate, chi_square, sidak};

type S = ArrayF<1>;

pub fn scalar(x: S) -> f64 {
    let mut out = [0.0];
    x.store(&mut out);
    f64::from(out[0])
}
pub fn vector(v: V3<S>) -> DVec3 {
    DVec3::new(scalar(v.0), scalar(v.1), scalar(v.2))
}
pub fn lanes(v: DVec3) -> V3<S> {
    V3::splat(v.as_vec3().to_array())
}
pub fn number(random: &mut Random) -> S {
    S::splat((random.bits() >> 40) as f32 / 16_777_216.0)
}

/// A diffuse or glossy material.
#[derive(Clone, Copy, Debug)]
struct Rough {
    /// Blinn-Phong's alpha and s; none: Lambert.
    glossy: Option<(f64, f64)>,
    conserving: bool,
}

impl Rough {
    fn bsdf(&self) -> Bsdf<'static, S> {
        let albedo = Albedo::Color([1.0, 0.5, 0.0]);
        let material = match self.glossy {
            None => Material::Diffuse(materials::Diffuse { albedo }),
            Some((exponent, specular)) => {
                let energy_conserving = self.conserving;
                let [exponent, specular] = [exponent, specular].map(Albedo::number);
                Material::BlinnPhong(materials::BlinnPhong { albedo, exponent, specular, energy_conserving })
            }
        };
        // It may live for ever: there are few.
        let table = Box::leak(Box::new(MaterialTable::new(&[material], 0, 0)));
        Bsdf::new(table, <S as Lanes>::U::splat(0), <S as Lanes>::M::from_bits(1)).0
    }

    /// f for albedo 1, by the formula of the scene language.
    fn f(&self, n: DVec3, wo: DVec3, wi: DVec3) -> f64 {
        let Some((alpha, s)) = self.glossy else { return 1.0 / PI };
        // Rounded vectors are not quite unit, which wo.h would feel at grazing angles.
        let [n, wo, wi] = [n, wo, wi].map(DVec3::normalize);
        // The lobe is that of the normal as it is seen.
        let by_callers = n.dot(wi);
        let n = (n + (f64::from(LEAST_COSINE) - n.dot(wo)).max(0.0) * wo).normalize();
        let h = (wo + wi).normalize();
        // cos^alpha from sin^2: exact also where the lobe is narrow.
        let sin2 = n.cross(h).length_squared().min(1.0);
        let lobe = if n.dot(h) > 0.0 { libm::exp(0.5 * alpha * libm::log1p(-sin2)) } else { 0.0 };
        let glossy = if self.conserving {
            (alpha + 1.0) / (8.0 * PI * wo.dot(h) * n.dot(wi).max(n.dot(wo))) * lobe
        } else {
            (alpha + 2.0) / TAU * lobe
        };
        (1.0 - s) / PI + s * glossy * n.dot(wi).max(0.0) / by_callers
    }
}

/// Lambert, and Blinn-Phong of both kinds from dull to nearly a mirror, from all diffuse to all glossy.
fn rough_materials() -> Vec<Rough> {
    let mut all = vec![Rough { glossy: None, conserving: false }];
    for conserving in [false, true] {
        for alpha in [1.0, 10.0, 100.0, 1e3, 1e4, 1e5] {
            for s in [0.0, 0.1, 0.5, 1.0] {
                all.push(Rough { glossy: Some((alpha, s)), conserving });
            }
        }
    }
    all
}

/// Angles of the viewer to the normal, in degrees.
pub const ANGLES: [f64; 5] = [0.0, 30.0, 60.0, 85.0, 89.5];

/// A normal in general position.
pub fn normal() -> DVec3 {
    DVec3::new(0.36, -0.48, 0.8)
}

/// The direction at this angle to the normal.
pub fn viewer(degrees: f64) -> DVec3 {
    let (x, _) = normal().any_orthonormal_pair();
    let a = degrees.to_radians();
    normal() * libm::cos(a) + x * libm::sin(a)
}

/// A direction above the surface, half of them near the mirrored one.
fn above(wo: DVec3, spread: f64, random: &mut Random) -> DVec3 {
    let n = normal();
    let mirrored = 2.0 * wo.dot(n) * n - wo;
    loop {
        let d = random.direction();
        let wi = if random.below(2) == 0 { d } else { (mirrored + spread * d).normalize() };
        if wi.dot(n) > 1e-3 {
            return wi;
        }
    }
}

#[test]
fn values_are_those_of_the_formula_and_reciprocal() {
    let mut random = Random::new(1);
    for material in rough_materials() {
        let bsdf = material.bsdf();
        let spread = material.glossy.map_or(1.0, |(alpha, _)| 2.0 / alpha.sqrt());
        for degrees in ANGLES {
            let n = lanes(normal());
            for _ in 0..200 {
                // As rounded: the formula is asked about the very same vectors.
                let wo = lanes(viewer(degrees));
                let wi = lanes(above(viewer(degrees), spread, &mut random));
                let (f, _) = bsdf.evaluate(n, wo, wi, n.dot(wi));
                let (back, _) = bsdf.evaluate(n, wi, wo, n.dot(wo));
                let f = vector(f);
                let expected = material.f(vector(n), vector(wo), vector(wi));
                // cos^2 of the half vector is right to 2e-7, as 1 - sin^2 is: the lobe cos^alpha = (cos^2)^(alpha/2) to
                // alpha/2 cos^(alpha - 2) 2e-7. Where the lobe counts its logarithm is at most 30, and right to 1e-6:
                // 3e-5.
                let h = (vector(wo) + vector(wi)).normalize();
                let cos_h = h.dot(vector(n)).max(3e-4);
                let lobe_error = material.glossy.map_or(0.0, |(alpha, s)| {
                    let relative = f64::min(0.5 * alpha * 2e-7 / (cos_h * cos_h), 1.0);
                    let peak = material.f(vector(n), vector(wo), vector(wi)) - (1.0 - s) / PI;
                    relative * peak + 1e-9 * alpha
                });
                // The energy-conserving lobe divides by wo.h, a difference of rounded numbers.
                let wo_h = 0.5 * (vector(wo) + vector(wi)).length();
                let allowed = (4e-5 + 2e-7 / wo_h) * expected + 2.0 * lobe_error;
                assert!((f.x - expected).abs() < allowed, "{material:?} at {degrees}: {} not {expected}", f.x);
                assert!((f.x - vector(back).x).abs() <= 1e-6 * expected, "{material:?} at {degrees}: not reciprocal");
                assert!((f.y - 0.5 * f.x).abs() <= 1e-6 * f.x && f.z == 0.0, "{material:?}: albedo");
            }
        }
    }
}

#[test]
fn sampled_densities_and_weights_are_the_evaluated_ones() {
    let mut random = Random::new(2);
    for material in rough_materials() {
        let bsdf = material.bsdf();
        for degrees in ANGLES {
            let (n, wo) = (lanes(normal()), lanes(viewer(degrees)));
            for _ in 0..200 {
                let s = bsdf.sample_rough(n, wo, number(&mut random), number(&mut random), number(&mut random));
                if scalar(s.pdf) <= 0.0 {
                    continue;
                }
                let cos = n.dot(s.wi);
                let (f, pdf) = bsdf.evaluate(n, wo, s.wi, cos);
                // The cosine of the sampled direction, a difference of numbers of size one, is wrong by 1e-7 or so.
                let rounding = 1e-5 + 5e-7 / scalar(cos);
                assert!((scalar(s.pdf) / scalar(pdf) - 1.0).abs() < rounding, "{material:?} at {degrees}");
                let weight = vector(f).x * scalar(cos) / scalar(pdf);
                assert!((vector(s.weight).x / weight - 1.0).abs() < rounding, "{material:?} at {degrees}");
            }
        }
    }
}

/// Directions wi by their half vector with wo, which keeps cells round at grazing angles: t = 1 - cos of its angle to
/// the normal in steps that grow with it, and the angle about the normal, 0 towards wo. dwi = 4 (wo.h) dh (Walter et
/// al. 2007, eq. 14).
struct Cells {
    wo: DVec3,
    towards: DVec3,
    side: DVec3,
    bounds: Vec<f64>,
}

const SECTORS: usize = 8;

impl Cells {
    fn new(wo: DVec3, alpha: f64) -> Self {
        let n = normal();
        let across = wo - wo.dot(n) * n;
        let towards = if across.length() > 1e-9 { across.normalize() } else { n.any_orthonormal_vector() };
        let mut bounds = vec![0.0];
        // The lobe is 1/alpha wide in t.
        let least: f64 = 0.1 / alpha;
        bounds.extend((0..=24).map(|k| least * libm::pow(1.0 / least, f64::from(k) / 24.0)));
        Cells { wo, towards, side: n.cross(towards), bounds }
    }

    fn of(&self, wi: DVec3) -> usize {
        let h = (self.wo + wi).normalize();
        let t = 0.5 * (h - normal()).length_squared();
        let ring = self.bounds.partition_point(|&b| b <= t).clamp(1, self.bounds.len() - 1) - 1;
        let turn = (libm::atan2(h.dot(self.side), h.dot(self.towards)) + PI) / TAU;
        SECTORS * ring + ((turn * SECTORS as f64) as usize).min(SECTORS - 1)
    }

    /// The integral of a density in wi over the part of each cell where wi is above the surface. For each t that part
    /// is
    /// |angle| < limit, so the midpoint rule meets no jump.
    fn integrate(&self, density: impl Fn(DVec3) -> f64) -> Vec<f64> {
        let n = normal();
        let (cos_o, sin_o) = (self.wo.dot(n), self.wo.dot(self.towards));
        let mut cells = Vec::new();
        for pair in self.bounds.windows(2) {
            for sector in 0..SECTORS {
                let (from, to) = (sector as f64 / SECTORS as f64, (sector + 1) as f64 / SECTORS as f64);
                let (from, to) = (from * TAU - PI, to * TAU - PI);
                let mut sum = 0.0;
                const STEPS: usize = 32;
                for i in 0..STEPS {
                    let t = pair[0] + (pair[1] - pair[0]) * (i as f64 + 0.5) / STEPS as f64;
                    let (cos, sin) = (1.0 - t, (t * (2.0 - t)).sqrt());
                    // wi.n = 2 (wo.h) (h.n) - wo.n > 0, with wo.h = cos_o cos + sin_o sin cos(angle).
                    let limit = libm::acos(((0.5 * cos_o / cos - cos_o * cos) / (sin_o * sin)).clamp(-1.0, 1.0));
                    let (low, high) = (from.max(-limit), to.min(limit));
                    if low >= high {
                        continue;
                    }
                    for j in 0..8 {
                        let angle = low + (high - low) * (f64::from(j) + 0.5) / 8.0;
                        let h = n * cos + (self.towards * libm::cos(angle) + self.side * libm::sin(angle)) * sin;
                        let wo_h = self.wo.dot(h);
                        sum += density(2.0 * wo_h * h - self.wo) * 4.0 * wo_h * (high - low) / 8.0;
                    }
                }
                cells.push(sum * (pair[1] - pair[0]) / STEPS as f64);
            }
        }
        cells
    }
}

/// Counts of sampled directions against the integral of the evaluated density; failed samples are a cell of their own.
/// 5 % for all materials and angles together (Šidák).
#[test]
fn samples_have_the_evaluated_density() {
    const SAMPLES: u32 = 20_000;
    let materials = rough_materials();
    let level = sidak(0.05, materials.len() * ANGLES.len());
    let mut random = Random::new(3);
    for material in materials {
        let bsdf = material.bsdf();
        for degrees in ANGLES {
            let (n, wo) = (lanes(normal()), lanes(viewer(degrees)));
            let cells = Cells::new(viewer(degrees), material.glossy.map_or(1.0, |(alpha, _)| alpha));
            let mut expected = cells.integrate(|wi| {
                let wi = lanes(wi);
                scalar(bsdf.evaluate(n, wo, wi, n.dot(wi)).1).max(0.0) * f64::from(SAMPLES)
            });
            // The midpoint rule misses slivers above the horizon; a sample may still lie there.
            expected.iter_mut().for_each(|e| *e = e.max(1e-3));
            let within: f64 = expected.iter().sum();
            // A density of at most one; the midpoint rule is good to some 1e-3.
            assert!(within < f64::from(SAMPLES) * 1.003, "{material:?} at {degrees}: density {within}");
            let mut counts = vec![0u64; expected.len() + 1];
            for _ in 0..SAMPLES {
                let s = bsdf.sample_rough(n, wo, number(&mut random), number(&mut random), number(&mut random));
                let cell = if scalar(s.pdf) > 0.0 { cells.of(vector(s.wi)) } else { counts.len() - 1 };
                counts[cell] += 1;
            }
            expected.push((f64::from(SAMPLES) - within).max(1e-3));
            let p = chi_square(&counts, &expected);
            assert!(p > level, "{material:?} at {degrees} degrees: p {p:e}");
        }
    }
}

/// What is reflected of light from everywhere: the mean weight of samples against the integral of the formula; and the
/// energy-conserving lobe never reflects more than it gets.
#[test]
fn furnace() {
    let mut random = Random::new(4);
    for material in rough_materials() {
        let bsdf = material.bsdf();
        for degrees in ANGLES {
            let wo = viewer(degrees);
            let cells = Cells::new(wo, material.glossy.map_or(1.0, |(alpha, _)| alpha));
            let expected: f64 =
                cells.integrate(|wi| material.f(normal(), wo, wi) * wi.dot(normal()).max(0.0)).iter().sum();
            let weights: Vec<f64> = (0..4000)
                .map(|_| {
                    let (u, v, lobe) = (number(&mut random), number(&mut random), number(&mut random));
                    let s = bsdf.sample_rough(lanes(normal()), lanes(wo), u, v, lobe);
                    if scalar(s.pdf) > 0.0 { vector(s.weight).x } else { 0.0 }
                })
                .collect();
            let estimate = Estimate::of(&weights);
            // 245 means: 5 standard errors are met by chance once in 7000 runs. The midpoint rule is good to 3e-3.
            let off = (estimate.mean - expected).abs();
            assert!(
                off < 5.0 * estimate.error() + 3e-3 * expected,
                "{material:?} at {degrees}: {} +- {}, not {expected}",
                estimate.mean,
                estimate.error()
            );
            if material.conserving {
                assert!(expected <= 1.003, "{material:?} at {degrees} reflects {expected}");
            }
        }
    }
}

/// Interpolated normals may be seen from behind. What is reflected of light from everywhere is the integral of the
/// formula there, too, and it is not nothing: half vectors behind the viewer's direction bring nothing that no density
/// counts.
#[test]
fn normals_seen_from_behind() {
    const STEPS: usize = 400;
    let mut random = Random::new(7);
    let (n, (x, y)) = (normal(), normal().any_orthonormal_pair());
    // Narrower lobes would want more steps.
    for material in rough_materials().into_iter().filter(|m| m.glossy.is_none_or(|(alpha, _)| alpha <= 10.0)) {
        let bsdf = material.bsdf();
        for degrees in [95.0, 100.0, 115.0] {
            let wo = viewer(degrees);
            // Over the root t of the cosine, by which low directions are many, and the angle about the normal.
            let mut sum = 0.0;
            for (i, j) in (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (i, j))) {
                let [t, turn] = [i, j].map(|k| (k as f64 + 0.5) / STEPS as f64);
                let (cos, sin) = (t * t, (1.0 - t.powi(4)).sqrt());
                let wi = n * cos + (x * libm::cos(TAU * turn) + y * libm::sin(TAU * turn)) * sin;
                sum += material.f(n, wo, wi) * 2.0 * t * cos;
            }
            let expected = sum * TAU / (STEPS * STEPS) as f64;
            let weights: Vec<f64> = (0..20_000)
                .map(|_| {
                    let (u, v, lobe) = (number(&mut random), number(&mut random), number(&mut random));
                    let s = bsdf.sample_rough(lanes(n), lanes(wo), u, v, lobe);
                    if scalar(s.pdf) > 0.0 { vector(s.weight).x } else { 0.0 }
                })
                .collect();
            let estimate = Estimate::of(&weights);
            // 51 means: 5 standard errors are met by chance once in 34,000 runs. What one sample in 4000 brings, with a
            // weight of about one, may never be met. It was 0.1 and more.
            let allowed = 5.0 * estimate.error() + 1e-3 * expected + 2.5e-4;
            assert!(
                (estimate.mean - expected).abs() < allowed,
                "{material:?} at {degrees}: {} +- {}, not {expected}",
                estimate.mean,
                estimate.error()
            );
        }
    }
}

/// Fresnel's closed form: the mean of (sin(i - t)/sin(i + t))^2 and (tan(i - t)/tan(i + t))^2.
fn closed_form(i: f64, eta: f64) -> f64 {
    let sin_t = eta * libm::sin(i);
    if sin_t >= 1.0 {
        return 1.0;
    }
    let t = libm::asin(sin_t);
    if i < 1e-6 {
        return ((eta - 1.0) / (eta + 1.0)).powi(2);
    }
    let s = libm::sin(i - t) / libm::sin(i + t);
    let p = libm::tan(i - t) / libm::tan(i + t);
    0.5 * (s * s + p * p)
}

/// A surface seen from one of its sides.
fn surface(ng: DVec3, ns: DVec3, outside: bool) -> Surface<S> {
    let mask = |on: bool| <S as Lanes>::M::from_bits(u32::from(on));
    let zero = S::splat(0.0);
    Surface {
        p: V3::zero(),
        start: V3::zero(),
        ng: lanes(ng),
        ns: lanes(ns),
        outside: mask(outside),
        smooth: mask(ng != ns),
        offset: zero,
        u: zero,
        v: zero,
        material: <S as Lanes>::U::splat(0),
        light: <S as Lanes>::U::splat(0),
        body: <S as Lanes>::U::splat(0),
        primitive: <S as Lanes>::U::splat(0),
    }
}

#[test]
fn fresnel_is_the_closed_form() {
    for ior in [1.33 / 1.5, 1.0 / 1.5, 1.0, 1.0003, 1.33, 1.5, 2.0, 2.5] {
        for outside in [true, false] {
            let eta: f64 = if outside { 1.0 / ior } else { ior };
            for k in 0..=900 {
                let i = f64::from(k) * 0.1f64.to_radians();
                let cos_i = libm::cos(i);
                let sin2_t = eta * eta * libm::sin(i).powi(2);
                if sin2_t >= 1.0 - 1e-4 {
                    continue;
                }
                let f = scalar(fresnel(
                    S::splat(cos_i as f32),
                    S::splat((1.0 - sin2_t).sqrt() as f32),
                    S::splat(eta as f32),
                ));
                // At grazing angles the reflectance changes by its argument's rounding times 1/cos_t.
                let error = (f - closed_form(i, eta)).abs();
                assert!(error < 4e-6, "ior {ior} outside {outside} angle {}: {f}", i.to_degrees());
            }
        }
    }
}

/// The dielectric reflects when the random number is below Fresnel's reflectance, else refracts by Snell's law, from
/// both sides, up to grazing and total reflection.
#[test]
fn dielectric_obeys_snell_and_fresnel() {
    let n = normal();
    for ior in [1.33 / 1.5, 1.0 / 1.5, 1.0, 1.0003, 1.33, 1.5, 2.0, 2.5] {
        for outside in [true, false] {
            let s = surface(n, n, outside);
            let eta: f64 = if outside { 1.0 / ior } else { ior };
            for degrees in [0.0, 0.1, 10.0, 41.0, 56.3, 80.0, 89.0, 89.9] {
                let wo = viewer(degrees);
                let sin_t = eta * libm::sin(f64::to_radians(degrees));
                let f = closed_form(f64::to_radians(degrees), eta);
                let at = |lobe: f64| Dielectric::new(&s, lanes(wo), S::splat(ior as f32)).sample(S::splat(lobe as f32));
                let margin = 2e-4;
                if f > margin {
                    let d = at(f - margin);
                    let mirrored = 2.0 * wo.dot(n) * n - wo;
                    assert!(!d.refracted.any() && scalar(d.eta2) == 1.0, "ior {ior} {degrees}: {f}");
                    assert!((vector(d.wi) - mirrored).length() < 1e-6);
                }
                if sin_t < 0.9999 && f < 1.0 - margin {
                    let d = at(f + margin);
                    assert!(d.refracted.any(), "ior {ior} outside {outside} {degrees}: {f}");
                    assert!((scalar(d.eta2) / (eta * eta) - 1.0).abs() < 1e-6);
                    let wi = vector(d.wi);
                    let tangential = eta * (wo.dot(n) * n - wo);
                    let expected = tangential - (1.0 - tangential.length_squared()).sqrt() * n;
                    // The depth below the surface is a square root of a difference: rounding 2e-7/cos_t.
                    let rounding = 1e-6 + 4e-7 / (1.0 - sin_t * sin_t).sqrt();
                    assert!((wi - expected).length() < rounding, "ior {ior} outside {outside} {degrees}: {wi}");
                    // The same light on its way back: F is the same.
                    let back = closed_form(libm::asin(sin_t), 1.0 / eta);
                    assert!((back - f).abs() < 1e-9);
                }
                if sin_t > 1.0 {
                    assert!(!at(0.999_999).refracted.any(), "ior {ior} {degrees}: no total reflection");
                }
            }
        }
    }
}

/// A geometric normal and a shading normal up to 80 degrees off it, seen from above both the surface.
fn bent(random: &mut Random) -> (DVec3, DVec3, DVec3) {
    loop {
        let (ng, other, wo) = (random.direction(), random.direction(), random.direction());
        let ns = (ng + random.between(0.0, 2.0) * other).normalize();
        if ng.dot(ns) > 0.17 && wo.dot(ng) > 1e-3 {
            return (ng, ns, wo);
        }
    }
}

/// Mirrors on smooth meshes reflect away from the surface, whatever the normals, and as the shading normal says
/// wherever that can be.
#[test]
fn mirrored_directions_leave_the_surface() {
    let mut random = Random::new(5);
    for _ in 0..50_000 {
        let (ng, ns, wo) = bent(&mut random);
        let (direction, normal) = reflect_bent(&surface(ng, ns, true), lanes(wo));
        let (direction, normal) = (vector(direction), vector(normal));
        assert!(direction.dot(ng) > 0.0, "ng {ng} ns {ns} wo {wo}: into the surface");
        assert!((direction.length() - 1.0).abs() < 1e-6 && (normal.length() - 1.0).abs() < 1e-6);
        // The normal is the one that mirrors, whether bent or not.
        assert!((2.0 * wo.dot(normal) * normal - wo - direction).length() < 1e-4);
        let plain = 2.0 * wo.dot(ns) * ns - wo;
        if plain.dot(ng) > 0.0101 {
            assert!((direction - plain).length() < 1e-5);
        }
    }
}

/// Dielectrics on smooth meshes: what is reflected stays on the viewer's side, what is refracted leaves it.
#[test]
fn refracted_directions_pass_the_surface() {
    let mut random = Random::new(6);
    let mut refracted = 0;
    for _ in 0..50_000 {
        let (ng, ns, wo) = bent(&mut random);
        let s = surface(ng, ns, random.below(2) == 0);
        let ior = S::splat(random.between(0.5, 2.5) as f32);
        let d = Dielectric::new(&s, lanes(wo), ior).sample(number(&mut random));
        let wi = vector(d.wi);
        assert!((wi.length() - 1.0).abs() < 1e-6);
        refracted += u32::from(d.refracted.any());
        assert!(if d.refracted.any() { wi.dot(ng) < 0.0 } else { wi.dot(ng) > 0.0 }, "ng {ng} ns {ns} wo {wo}");
    }
    assert!(refracted > 20_000, "{refracted}");
}
