//! The Blinn-Phong lobe over lanes, by the report's formula or energy conserving (Ashikhmin and Shirley 2000, without
//! Fresnel's factor).

use super::seen::{raised_cosine, seen};
use crate::lanes::{Lanes, Mask};
use crate::math::{V3, exp, ln1p};
use crate::sampling::warp;
use std::f32::consts::FRAC_1_PI;

/// The lobe's parameters.
#[derive(Clone, Copy)]
pub struct BlinnPhong<F: Lanes> {
    /// alpha.
    pub exponent: F,
    /// s: the Lambert lobe beside it has the share 1 - s.
    pub share: F,
    /// Lanes with the energy-conserving lobe.
    pub conserving: F::M,
}

impl<F: Lanes> BlinnPhong<F> {
    /// Probability that the lobe is sampled: its share of the reflected light at normal incidence, where the report's
    /// formula with its half-vector lobe reflects 4 s.
    #[inline(always)]
    pub fn probability(&self) -> F {
        let s = F::select(self.conserving, self.share, self.share * F::splat(4.0));
        s / (s + (F::splat(1.0) - self.share))
    }

    /// f of the lobe without colour, times the cosine to the normal that is seen over `cos_i`, and the density of its
    /// own samples; `cos_i` is ns.wi > 0.
    #[inline(always)]
    pub fn evaluate(&self, ns: V3<F>, wo: V3<F>, wi: V3<F>, cos_i: F) -> (F, F) {
        let c = F::splat;
        let none = c(0.0);
        let by_callers = cos_i;
        let (ns, raised) = seen(ns, wo);
        let cos_i = if raised.any() { F::select(raised, ns.dot(wi), cos_i) } else { cos_i };
        let (alpha, s) = (self.exponent, self.share);
        let h = wo.add(wi);
        let h2 = h.dot(h).max(c(1e-30));
        let side = ns.cross(h);
        // cos^alpha from sin^2, which keeps its digits where the lobe is narrow: (1 - sin^2)^(alpha/2).
        let sin2 = (side.dot(side) / h2).min(c(0.999_999_9));
        let above = none.lt(ns.dot(h));
        let lobe = F::select(above, exp(ln1p(-sin2) * (alpha * c(0.5))), none);
        // wo.h = |wo + wi| / 2 for unit vectors.
        let wo_h = (h2.sqrt() * c(0.5)).max(c(1e-15));
        let cos_o = ns.dot(wo);
        let widest = cos_i.max(cos_o).max(c(1e-7));
        let report = lobe * ((alpha + c(2.0)) * c(0.5 * FRAC_1_PI));
        let conserving = lobe * ((alpha + c(1.0)) * c(0.125 * FRAC_1_PI)) / (wo_h * widest);
        let mut f = s * F::select(self.conserving, conserving, report);
        if raised.any() {
            f = f * raised_cosine(raised, cos_i, by_callers);
        }
        (f, lobe * ((alpha + c(1.0)) * c(0.125 * FRAC_1_PI)) / wo_h)
    }

    /// wo reflected in a half vector of the lobe. Where that lies behind wo, which it may where the surface is seen at
    /// a grazing angle, no density counts the direction: those lanes are not in the mask.
    #[inline(always)]
    pub fn sample(&self, ns: V3<F>, wo: V3<F>, u: F, v: F) -> (V3<F>, F::M) {
        let (ns, _) = seen(ns, wo);
        let h = ns.to_world(warp::power_cosine(u, v, self.exponent));
        let d = wo.dot(h);
        (h.scale(d + d).sub(wo), F::splat(0.0).lt(d))
    }
}
