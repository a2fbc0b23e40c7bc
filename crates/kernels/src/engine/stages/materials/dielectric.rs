//! The smooth dielectric: a specular lobe of reflection and one of transmission (Fresnel's equations, Snell's law).

use super::specular_reflection::reflect_bent;
use crate::engine::stages::surface::Surface;
use crate::lanes::{Lanes, Mask};
use crate::math::V3;

/// What a smooth dielectric does with wo: its two lobes.
pub struct Dielectric<F: Lanes> {
    /// Where it reflects to.
    pub reflected: V3<F>,
    /// Where it lets pass to; where `reflectance` is 1 this means nothing.
    pub passed: V3<F>,
    /// Share that it reflects.
    pub reflectance: F,
    /// Radiance scaling of what passes: (n_i / n_t)^2.
    pub eta2: F,
}

/// A direction of a smooth dielectric.
pub struct DielectricSample<F: Lanes> {
    /// Direction.
    pub wi: V3<F>,
    /// It passes the surface.
    pub refracted: F::M,
    /// Radiance scaling (n_i / n_t)^2 where refracted, else 1.
    pub eta2: F,
}

impl<F: Lanes> Dielectric<F> {
    /// `ior` is the inside's against the outside's.
    #[inline(always)]
    pub fn new(s: &Surface<F>, wo: V3<F>, ior: F) -> Self {
        let c = F::splat;
        let one = c(1.0);
        let (mut reflected, mut normal) = reflect_bent(s, wo);
        // n_incident / n_transmitted.
        let eta = F::select(s.outside, one / ior, ior);
        if s.smooth.any() {
            // From within, where the interpolated normal reflects totally but the triangle's own lets light out, the
            // latter decides: else rays that entered close to the outline of a low-poly body run round under its
            // surface for ever, and its rim is dark.
            let cos_g = wo.dot(s.ng);
            let total = one.le(refract(wo, normal, eta).sin2_t);
            let caught = s.smooth & !s.outside & total & refract(wo, s.ng, eta).sin2_t.lt(one);
            reflected = V3::select(caught, s.ng.scale(cos_g + cos_g).sub(wo), reflected);
            normal = V3::select(caught, s.ng, normal);
        }
        let r = refract(wo, normal, eta);
        let mut passed = r.direction;
        let reflectance = F::select(r.sin2_t.lt(one), fresnel(r.cos_i, r.cos_t, eta), one);
        if s.smooth.any() {
            // A refracted ray that would stay on the viewer's side takes the geometric normal.
            let wrong = s.smooth & c(-1e-3).lt(passed.dot(s.ng));
            let geometric = refract(wo, s.ng, eta);
            passed = V3::select(wrong & geometric.sin2_t.lt(one), geometric.direction, passed);
        }
        let reflectance = F::select(passed.dot(s.ng).lt(c(0.0)), reflectance, one);
        Dielectric { reflected, passed: passed.normalise(), reflectance, eta2: eta * eta }
    }

    /// One of the two.
    #[inline(always)]
    pub fn take(&self, refracted: F::M) -> DielectricSample<F> {
        DielectricSample {
            wi: V3::select(refracted, self.passed, self.reflected),
            refracted,
            eta2: F::select(refracted, self.eta2, F::splat(1.0)),
        }
    }

    /// Reflection with the reflectance as probability, else refraction.
    #[inline(always)]
    pub fn sample(&self, lobe: F) -> DielectricSample<F> {
        self.take(self.reflectance.le(lobe))
    }
}

/// wo refracted in a plane; where sin2_t reaches 1, all is reflected and `direction` means nothing.
#[derive(Clone, Copy)]
struct Refraction<F: Lanes> {
    direction: V3<F>,
    cos_i: F,
    cos_t: F,
    sin2_t: F,
}

/// Snell's law; `eta` = n_incident / n_transmitted.
#[inline(always)]
fn refract<F: Lanes>(wo: V3<F>, n: V3<F>, eta: F) -> Refraction<F> {
    let (zero, one) = (F::splat(0.0), F::splat(1.0));
    let cos_i = wo.dot(n);
    let sin2_t = eta * eta * (one - cos_i * cos_i).max(zero);
    let cos_t = (one - sin2_t).max(zero).sqrt();
    Refraction { direction: n.mad(eta * cos_i - cos_t, wo.scale(-eta)), cos_i, cos_t, sin2_t }
}

/// Fresnel reflectance of unpolarised light; `eta` = n_incident / n_transmitted.
#[inline(always)]
pub fn fresnel<F: Lanes>(cos_i: F, cos_t: F, eta: F) -> F {
    let (a, b) = (eta * cos_i, eta * cos_t);
    let rs = (a - cos_t) / (a + cos_t);
    let rp = (cos_i - b) / (cos_i + b);
    rs.fma(rs, rp * rp) * F::splat(0.5)
}
