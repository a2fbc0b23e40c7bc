//! Blinn-Phong.

use super::{Rough, seen};
use crate::random::{Random, about, polar};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A diffuse surface with a glossy lobe on top.
pub struct BlinnPhong {
    pub albedo: DVec3,
    pub exponent: f64,
    pub specular: f64,
    pub energy_conserving: bool,
}

impl Rough for BlinnPhong {
    /// With the half vector h and its angle theta to the normal (the report's formula): albedo ((1 - s)/pi + s (alpha +
    /// 2)/(2 pi) cos^alpha theta), or, energy conserving (Ashikhmin and Shirley 2000, without the Fresnel factor), with
    /// s (alpha + 1)/(8 pi (wo.h) max(cos i, cos o)) cos^alpha theta. The lobe is that of the normal that is seen,
    /// times the cosine to that over the cosine to `n`, by which callers multiply.
    fn f(&self, n: DVec3, wo: DVec3, wi: DVec3) -> DVec3 {
        let (alpha, s) = (self.exponent, self.specular);
        let by_callers = n.dot(wi);
        if by_callers <= 0.0 {
            return DVec3::ZERO;
        }
        let n = seen(n, wo);
        let h = (wo + wi).normalize();
        let lobe = n.dot(h).max(0.0).powf(alpha);
        let specular = if self.energy_conserving {
            (alpha + 1.0) / (8.0 * PI * wo.dot(h) * n.dot(wi).max(n.dot(wo))) * lobe
        } else {
            (alpha + 2.0) / TAU * lobe
        };
        self.albedo * ((1.0 - s) / PI + s * specular * n.dot(wi).max(0.0) / by_callers)
    }

    /// Cosine-weighted, or every second time wo reflected in a half vector with density (alpha + 1)/(2 pi) cos^alpha
    /// theta.
    fn sample(&self, n: DVec3, wo: DVec3, random: &mut Random) -> DVec3 {
        if random.number() < 0.5 {
            let cos = (1.0 - random.number()).powf(1.0 / (self.exponent + 1.0));
            let h = about(seen(n, wo), polar(cos, random.number()));
            2.0 * wo.dot(h) * h - wo
        } else {
            about(n, polar((1.0 - random.number()).sqrt(), random.number()))
        }
    }

    /// Reflection in h has the Jacobian 1/(4 wo.h) (Walter et al. 2007, eq. 14), and is the same in -h: where wo is
    /// below the horizon the half vector that was drawn may lie behind it.
    fn density(&self, n: DVec3, wo: DVec3, wi: DVec3) -> f64 {
        let diffuse = n.dot(wi).max(0.0) / PI;
        let h = (wo + wi).normalize();
        let of_h = (self.exponent + 1.0) / TAU * seen(n, wo).dot(h).abs().powf(self.exponent);
        0.5 * diffuse + 0.5 * of_h / (4.0 * wo.dot(h))
    }
}
