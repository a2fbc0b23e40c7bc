//! Smooth dielectrics.

use super::mirror::{Reflection, reflect};
use super::{Incident, Scattered};
use crate::random::Random;
use crate::surface::Surface;
use glam::DVec3;

/// A smooth dielectric: reflection with the probability F, else refraction, whose radiance is scaled by (n_i/n_t)^2
/// (Veach 1997, 5.2).
pub fn sample(ior: f64, transmittance: DVec3, s: &Surface, wo: DVec3, random: &mut Random) -> Scattered {
    let (direction, weight) = dielectric(s, wo, ior, transmittance, random);
    Scattered::Specular(Incident { direction, weight })
}

fn dielectric(s: &Surface, wo: DVec3, ior: f64, transmittance: DVec3, random: &mut Random) -> (DVec3, DVec3) {
    let mut reflection = reflect(s, wo);
    let eta = if s.outside { 1.0 / ior } else { ior };
    // From within a smooth mesh: total reflection only where the triangle's own normal says so, too.
    let total = |n: DVec3| refract(wo, n, eta).is_none();
    if s.smooth && !s.outside && total(reflection.normal) && !total(s.ng) {
        reflection = Reflection { direction: 2.0 * wo.dot(s.ng) * s.ng - wo, normal: s.ng };
    }
    let reflected = (reflection.direction, DVec3::ONE);
    if random.number() < fresnel(wo.dot(reflection.normal), eta) {
        return reflected;
    }
    // On a smooth mesh the refracted ray may stay on the viewer's side: then the geometric normal refracts it.
    let refracted = refract(wo, reflection.normal, eta)
        .filter(|wi| !s.smooth || wi.dot(s.ng) <= -1e-3)
        .or_else(|| refract(wo, s.ng, eta));
    refracted.map_or(reflected, |wi| (wi, eta * eta * transmittance))
}

/// Snell's law, eta = n_i/n_t: the tangential part of -wo times eta, and what makes it a unit vector along -n.
fn refract(wo: DVec3, n: DVec3, eta: f64) -> Option<DVec3> {
    let tangential = eta * (n.dot(wo) * n - wo);
    let cos2 = 1.0 - tangential.length_squared();
    (cos2 > 0.0).then(|| tangential - cos2.sqrt() * n)
}

/// Fresnel's reflectance of unpolarised light: the mean of (sin(i - t)/sin(i + t))^2 and (tan(i - t)/tan(i + t))^2.
pub fn fresnel(cos_i: f64, eta: f64) -> f64 {
    let i = cos_i.clamp(0.0, 1.0).acos();
    let sin_t = eta * i.sin();
    if sin_t >= 1.0 {
        return 1.0;
    }
    let t = sin_t.asin();
    if i + t < 1e-6 {
        // Normal incidence, where both fractions are 0/0.
        return ((eta - 1.0) / (eta + 1.0)).powi(2);
    }
    let s = (i - t).sin() / (i + t).sin();
    let p = (i - t).tan() / (i + t).tan();
    0.5 * (s * s + p * p)
}
