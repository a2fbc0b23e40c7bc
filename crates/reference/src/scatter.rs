//! How surfaces scatter light. wo points to the viewer, wi to the light, both unit and away from the surface; `f` has no cosine.

use crate::random::{Random, about, polar};
use crate::surface::Surface;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The Blinn-Phong lobe.
pub struct Glossy {
    /// alpha.
    pub exponent: f64,
    /// s: the diffuse part has the share 1 - s.
    pub share: f64,
    /// Ashikhmin and Shirley's denominator instead of the report's constant.
    pub energy_conserving: bool,
}

/// A diffuse surface, or one with a glossy lobe on top.
pub struct Rough {
    pub albedo: DVec3,
    pub glossy: Option<Glossy>,
}

impl Rough {
    /// Lambert: albedo/pi. Blinn-Phong, with the half vector h and its angle theta to the normal (the report's formula):
    /// albedo ((1 - s)/pi + s (alpha + 2)/(2 pi) cos^alpha theta), or, energy conserving (Ashikhmin and Shirley 2000, without the
    /// Fresnel factor), with s (alpha + 1)/(8 pi (wo.h) max(cos i, cos o)) cos^alpha theta.
    pub fn f(&self, n: DVec3, wo: DVec3, wi: DVec3) -> DVec3 {
        let Some(glossy) = &self.glossy else { return self.albedo / PI };
        let h = (wo + wi).normalize();
        let lobe = n.dot(h).max(0.0).powf(glossy.exponent);
        let specular = if glossy.energy_conserving {
            (glossy.exponent + 1.0) / (8.0 * PI * wo.dot(h) * n.dot(wi).max(n.dot(wo))) * lobe
        } else {
            (glossy.exponent + 2.0) / TAU * lobe
        };
        self.albedo * ((1.0 - glossy.share) / PI + glossy.share * specular)
    }

    /// A direction: cosine-weighted, or (every second time, if there is a lobe) wo reflected in a half vector with density
    /// (alpha + 1)/(2 pi) cos^alpha theta.
    pub fn sample(&self, n: DVec3, wo: DVec3, random: &mut Random) -> DVec3 {
        match &self.glossy {
            Some(glossy) if random.number() < 0.5 => {
                let cos = (1.0 - random.number()).powf(1.0 / (glossy.exponent + 1.0));
                let h = about(n, polar(cos, random.number()));
                2.0 * wo.dot(h) * h - wo
            }
            _ => about(n, polar((1.0 - random.number()).sqrt(), random.number())),
        }
    }

    /// The density of [`Rough::sample`] in solid angle; reflection in h has the Jacobian 1/(4 wo.h) (Walter et al. 2007, eq. 14).
    pub fn density(&self, n: DVec3, wo: DVec3, wi: DVec3) -> f64 {
        let diffuse = n.dot(wi).max(0.0) / PI;
        let Some(glossy) = &self.glossy else { return diffuse };
        let h = (wo + wi).normalize();
        let of_h = (glossy.exponent + 1.0) / TAU * n.dot(h).max(0.0).powf(glossy.exponent);
        0.5 * diffuse + 0.5 * of_h / (4.0 * wo.dot(h))
    }
}

/// A mirrored direction and the normal that mirrors it.
pub struct Reflection {
    pub direction: DVec3,
    pub normal: DVec3,
}

/// 2 (wo.n) n - wo. On a smooth mesh it may point into the surface: then it is raised until it rises by a hundredth (by 0.9 of wo's
/// own rise where that is less), and the normal becomes the half vector (Keller et al.: The Iray Light Transport Simulation and
/// Rendering System, 2017, A.3).
pub fn reflect(s: &Surface, wo: DVec3) -> Reflection {
    let mirrored = 2.0 * wo.dot(s.ns) * s.ns - wo;
    let rise = mirrored.dot(s.ng);
    let least = (0.9 * wo.dot(s.ng)).min(0.01);
    if !s.smooth || rise >= least {
        return Reflection { direction: mirrored, normal: s.ns };
    }
    let direction = (mirrored + (least - rise) * s.ng).normalize();
    Reflection { direction, normal: (wo + direction).normalize() }
}

/// A smooth dielectric: reflection with the probability F, else refraction, whose radiance is scaled by (n_i/n_t)^2 (Veach 1997, 5.2).
/// Gives the direction and its weight f cos / p.
pub fn dielectric(s: &Surface, wo: DVec3, ior: f64, transmittance: [f64; 3], random: &mut Random) -> (DVec3, DVec3) {
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
    refracted.map_or(reflected, |wi| (wi, eta * eta * DVec3::from(transmittance)))
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
