//! The direction that mirrors and glass reflect to.

use crate::engine::stages::surface::Surface;
use crate::lanes::{Lanes, Mask};
use crate::math::V3;

/// wo reflected in the shading normal, bent so that it leaves the geometric surface: where it would start inside, the
/// reflected direction is raised to just above the surface (the bend-normal rule of Keller et al., The Iray Light
/// Transport Simulation and Rendering System, 2017, A.3). Gives the direction and the normal that makes it.
#[inline(always)]
pub fn reflect_bent<F: Lanes>(s: &Surface<F>, wo: V3<F>) -> (V3<F>, V3<F>) {
    let c = F::splat;
    let d = wo.dot(s.ns);
    let r = s.ns.scale(d + d).sub(wo);
    let mut normal = s.ns;
    let mut direction = r;
    if s.smooth.any() {
        let height = r.dot(s.ng);
        let least = (wo.dot(s.ng) * c(0.9)).min(c(0.01));
        let low = s.smooth & height.lt(least);
        let raised = s.ng.mad(least - height, r).normalise();
        direction = V3::select(low, raised, r);
        let bent = wo.add(raised);
        let length2 = bent.dot(bent).max(c(1e-30));
        normal = V3::select(low, bent.scale(c(1.0) / length2.sqrt()), s.ns);
    }
    (direction, normal)
}
