//! Lights: which one, a direction to it, and the density of a direction that met one.
//!
//! Radiance is in the engine's unit, per solid angle and projected area. Densities are in solid angle at the receiver.
//! A light shines alike in all directions, from its front: outwards, or the side of its normal; from its back, too,
//! where it has two sides. A sample of a light that does not shine to the receiver has radiance zero. A picture of all
//! directions ([`environment`]) is a light without a number, infinitely far away. Where a texture says which points of
//! a lamp shine more than others, radiance is that of a white point, and [`glow`] says what share of it a point has. So
//! it does where lamps lie in one plane and one of them is met in place of the others.

mod covered;
pub mod curved;
pub mod environment;
mod flat;
mod glow;
mod selection;
mod sphere;

use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{Environment, LightTable};
use crate::shapes::csg::Part;
pub use glow::{share_at, share_towards};
pub use selection::{Choice, choose};

/// A direction to a light.
pub struct LightSample<F: Lanes> {
    /// Unit direction.
    pub wi: V3<F>,
    /// Distance to the light's surface along it; of flat lights, and flat parts, to just before it.
    pub distance: F,
    /// One over the density in solid angle, the choice of the light included.
    pub inverse_pdf: F,
    /// Radiance that comes from there.
    pub radiance: V3<F>,
    /// The light's primitive, which is not in the way; `NONE` where the ray ends before it.
    pub primitive: F::U,
}

/// Where a light sample starts.
#[derive(Clone, Copy)]
pub struct Start<'s, F: Lanes> {
    /// The point.
    pub p: V3<F>,
    /// The sphere or shape that it lies on; else any number that no shape has.
    pub on: F::U,
    /// The parts of all solids.
    pub parts: &'s [Part],
}

#[cfg(test)]
impl<F: Lanes> Start<'_, F> {
    /// A point in space.
    fn free(p: V3<F>) -> Self {
        Start { p, on: F::U::splat(u32::MAX), parts: &[] }
    }
}

/// Where light is asked for.
#[derive(Clone, Copy)]
pub struct Receiver<F: Lanes> {
    /// The point.
    pub p: V3<F>,
    /// Unit normal: what comes from behind it is not asked for. Not read where there is one light.
    pub n: V3<F>,
}

/// How a ray met a light.
#[derive(Clone, Copy)]
pub struct LightHit<F: Lanes> {
    /// The ray's unit direction.
    pub direction: V3<F>,
    /// So far from the receiver.
    pub distance: F,
    /// Cosine to the light's normal there, above zero.
    pub cos: F,
    /// It was met from its front.
    pub front: F::M,
    /// The lanes that have met one; others hold anything.
    pub lanes: F::M,
}

/// A direction to the chosen light, in the lanes of the mask; others hold anything.
#[inline(always)]
pub fn sample<F: Lanes>(
    lights: &LightTable,
    choice: &Choice<F>,
    from: Start<'_, F>,
    u: F,
    v: F,
    lanes: F::M,
) -> LightSample<F> {
    let mut sample = match &lights.environment {
        None => numbered(lights, choice.light, from, u, v, lanes),
        Some(environment) if lights.asked == 0 => environment::sample(environment, u, v),
        Some(environment) => {
            let near = numbered(lights, choice.light, from, u, v, lanes & !choice.environment);
            if choice.environment.any() {
                near.or(choice.environment, environment::sample(environment, u, v))
            } else {
                near
            }
        }
    };
    if lights.several() {
        sample.inverse_pdf = sample.inverse_pdf / choice.probability;
    }
    sample
}

/// A direction to light `k`.
#[inline(always)]
fn numbered<F: Lanes>(lights: &LightTable, k: F::U, from: Start<'_, F>, u: F, v: F, lanes: F::M) -> LightSample<F> {
    let p = from.p;
    let mut sample = sphere::sample(lights, k, p, u, v);
    if lights.has_curved() {
        let is_curved = lanes & curved_lanes(lights, k);
        if is_curved.any() {
            sample = sample.or(is_curved, curved::sample(lights, k, from, u, v, is_curved));
        }
    }
    if lights.has_flat() {
        let is_flat = !k.lt(F::U::splat(lights.first_flat));
        if is_flat.any() {
            return sample.or(is_flat, flat::sample(lights, flat_row(lights, k), p, u, v));
        }
    }
    sample
}

impl<F: Lanes> LightSample<F> {
    /// Another one in the lanes of the mask.
    #[inline(always)]
    fn or(self, mask: F::M, other: Self) -> Self {
        LightSample {
            wi: V3::select(mask, other.wi, self.wi),
            distance: F::select(mask, other.distance, self.distance),
            inverse_pdf: F::select(mask, other.inverse_pdf, self.inverse_pdf),
            radiance: V3::select(mask, other.radiance, self.radiance),
            primitive: F::U::select(mask, other.primitive, self.primitive),
        }
    }
}

/// What comes from where a direction leaves the scene.
#[derive(Clone, Copy)]
pub struct Beyond<F: Lanes> {
    /// The picture's density there.
    pub pdf: F,
    /// The density with which [`choose`] and [`sample`] take it.
    pub sampled: F,
    /// Its radiance.
    pub radiance: V3<F>,
}

/// Of a direction that leaves the scene.
#[inline(always)]
pub fn beyond<F: Lanes>(lights: &LightTable, environment: &Environment, direction: V3<F>) -> Beyond<F> {
    let (pdf, radiance) = environment::pdf_and_radiance(environment, direction);
    let sampled = if lights.asked == 0 { pdf } else { pdf * F::splat(selection::ENVIRONMENT) };
    Beyond { pdf, sampled, radiance }
}

/// The row of a flat light; anything for others.
#[inline(always)]
fn flat_row<U: Bits>(lights: &LightTable, k: U) -> U {
    let first = U::splat(lights.first_flat);
    U::select(k.lt(first), U::splat(0), k - first)
}

/// Where a light is a curved one.
#[inline(always)]
fn curved_lanes<U: Bits>(lights: &LightTable, k: U) -> U::M {
    k.lt(U::splat(lights.first_flat)) & !k.lt(U::splat(lights.spheres))
}

/// Density with which [`choose`] and [`sample`] take a direction that has met light `k`: zero for a sky.
#[inline(always)]
pub fn pdf<F: Lanes>(lights: &LightTable, k: F::U, at: Receiver<F>, hit: &LightHit<F>) -> F {
    let mut inverse = sphere::inverse_pdf(lights, k, at.p);
    if lights.has_curved() {
        let is_curved = hit.lanes & curved_lanes(lights, k);
        if is_curved.any() {
            inverse = F::select(is_curved, curved::inverse_pdf(lights, k, at.p, hit.direction, is_curved), inverse);
        }
    }
    if lights.has_flat() {
        let is_flat = !k.lt(F::U::splat(lights.first_flat));
        inverse = F::select(is_flat, flat::inverse_pdf(lights, flat_row(lights, k), hit), inverse);
    }
    let mut near = selection::probability(lights, k, at) / inverse;
    if lights.has_sky {
        let [.., sky] = lights.rows.row::<F>(k);
        let is_sky = k.lt(F::U::splat(lights.spheres)) & F::splat(0.0).lt(sky);
        near = F::select(is_sky, F::splat(0.0), near);
    }
    if lights.environment.is_some() { near * F::splat(1.0 - selection::ENVIRONMENT) } else { near }
}

/// Radiance of light `k` to where it was met from.
#[inline(always)]
pub fn radiance<F: Lanes>(lights: &LightTable, k: F::U, hit: &LightHit<F>) -> V3<F> {
    let [.., red, green, blue, _, inwards, _] = lights.rows.row::<F>(k);
    let shines = hit.front | F::splat(0.0).lt(inwards);
    let mut radiance = V3::select(shines, V3(red, green, blue), V3::zero());
    if lights.has_curved() {
        let is_curved = hit.lanes & curved_lanes(lights, k);
        if is_curved.any() {
            radiance = V3::select(is_curved, curved::radiance(lights, k, hit.front, is_curved), radiance);
        }
    }
    if lights.has_flat() {
        let is_flat = !k.lt(F::U::splat(lights.first_flat));
        radiance = V3::select(is_flat, flat::radiance(lights, flat_row(lights, k), hit.front), radiance);
    }
    radiance
}

#[cfg(test)]
mod tests;
