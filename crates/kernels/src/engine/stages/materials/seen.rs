//! The shading normal that glossy lobes stand on.

use crate::lanes::{Lanes, Mask};
use crate::math::V3;

/// The viewer's cosine is not less than about this.
pub const LEAST_COSINE: f32 = 1e-3;

/// The shading normal, raised towards the viewer where he would see it from behind or nearly so, which interpolated
/// ones are along outlines: else there would be black dots. With the lanes where it is.
#[inline(always)]
pub fn seen<F: Lanes>(ns: V3<F>, wo: V3<F>) -> (V3<F>, F::M) {
    let c = F::splat;
    let missing = c(LEAST_COSINE) - ns.dot(wo);
    let low = c(0.0).lt(missing);
    if !low.any() {
        return (ns, low);
    }
    (V3::select(low, wo.mad(missing, ns).normalise(), ns), low)
}

/// By what f of a raised normal is multiplied: its cosine to wi over that of the normal as it was, which is what
/// callers multiply by; zero where light comes from below either.
#[inline(always)]
pub fn raised_cosine<F: Lanes>(raised: F::M, cos_i: F, by_callers: F) -> F {
    let (zero, one) = (F::splat(0.0), F::splat(1.0));
    let lit = zero.lt(cos_i) & zero.lt(by_callers);
    F::select(raised, F::select(lit, cos_i / by_callers.max(F::splat(1e-20)), zero), one)
}
