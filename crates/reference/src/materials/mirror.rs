//! Perfect mirrors.

use super::{Incident, Scattered};
use crate::surface::Surface;
use glam::DVec3;

/// The mirrored direction with this colour.
pub fn sample(reflectance: DVec3, s: &Surface, wo: DVec3) -> Scattered {
    Scattered::Specular(Incident { direction: reflect(s, wo).direction, weight: reflectance })
}

/// A mirrored direction and the normal that mirrors it.
pub struct Reflection {
    pub direction: DVec3,
    pub normal: DVec3,
}

/// 2 (wo.n) n - wo. On a smooth mesh it may point into the surface: then it is raised until it rises by a hundredth (by
/// 0.9 of wo's own rise where that is less), and the normal becomes the half vector (Keller et al.: The Iray Light
/// Transport Simulation and Rendering System, 2017, A.3).
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
