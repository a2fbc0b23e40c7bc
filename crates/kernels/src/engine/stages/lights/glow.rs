//! Lamps whose points shine unlike each other: the share of a lamp's radiance that a point has, by its texture, and
//! none where something else in its plane is met instead.
//!
//! Directions to lamps are taken as if they shone evenly, with the same densities: where a point shines more, a sample
//! brings more. So it does not matter whether a point is asked for where a ray met it or where a light sample goes: the
//! surface there is found by the same function. Parts, since only scenes that have such lamps pay for them.
//!
//! Of a lamp without a texture the share is one, and so it is wherever rays have met one: nothing is in its place.

use super::super::materials::Texel;
use super::super::patterns::At;
use super::super::surface::Surface;
use super::super::surface_at::surface_at;
use super::{covered, flat_row};
use crate::lanes::{Bits, Lanes, Mask, Part};
use crate::math::V3;
use crate::scene::{LightTable, Scene};

/// The share at surfaces of lamps, in the lanes of the mask; elsewhere one.
#[inline(always)]
pub fn share_at<F: Lanes>(scene: &Scene, s: &Surface<F>, mask: F::M) -> V3<F> {
    F::apart(Met { scene, at: At::of(s), normal: s.ns, material: s.material, mask })
}

/// The share of lights `light` where rays meet them in these directions after about these distances, in the lanes of
/// the mask; elsewhere one.
#[inline(always)]
pub fn share_towards<F: Lanes>(
    scene: &Scene,
    light: F::U,
    (origin, direction): (V3<F>, V3<F>),
    distance: F,
    mask: F::M,
) -> V3<F> {
    F::apart(Towards { scene, light, origin, direction, distance, mask })
}

/// A surface that was met.
struct Met<'t, F: Lanes> {
    scene: &'t Scene,
    at: At<F>,
    normal: V3<F>,
    material: F::U,
    mask: F::M,
}

impl<F: Lanes> Part<F> for Met<'_, F> {
    type Out = V3<F>;
    #[inline(always)]
    fn run(self) -> V3<F> {
        let Met { scene, at, normal, material, mask } = self;
        if scene.tables.materials.glow.is_empty() {
            return V3::grey(F::splat(1.0));
        }
        let number = F::U::gather(&scene.tables.materials.glow, F::U::select(mask, material, F::U::splat(0)));
        share(scene, number, at, normal, mask)
    }
}

/// A light in some direction.
struct Towards<'t, F: Lanes> {
    scene: &'t Scene,
    light: F::U,
    origin: V3<F>,
    direction: V3<F>,
    distance: F,
    mask: F::M,
}

impl<F: Lanes> Part<F> for Towards<'_, F> {
    type Out = V3<F>;
    #[inline(always)]
    fn run(self) -> V3<F> {
        let Towards { scene, light, origin, direction, distance, mask } = self;
        let lights = &scene.tables.lights;
        let one = V3::grey(F::splat(1.0));
        let Some(glow) = &lights.glow else { return one };
        let light = F::U::select(mask, light, F::U::splat(0));
        let number = F::U::gather(&glow.texture, light);
        let has_texture = mask & !number.eq(F::U::splat(0));
        let is_covered = mask & !F::U::gather(&glow.covered, light).eq(F::U::splat(0));
        let on = has_texture | is_covered;
        if !on.any() {
            return one;
        }
        let mut primitive = F::U::gather(&glow.primitive, light);
        let instance = F::U::gather(&glow.instance, light);
        if lights.has_flat() {
            let on_flat = on & !light.lt(F::U::splat(lights.first_flat));
            let point = direction.mad(distance, origin);
            let second = on_flat & beyond_diagonal(lights, light, point);
            primitive = primitive + F::U::select(second, F::U::splat(1), F::U::splat(0));
        }
        let mut found = one;
        if has_texture.any() {
            let s = surface_at(scene, origin, direction, distance, primitive, instance, has_texture);
            found = share(scene, number, At::of(&s), s.ns, has_texture);
        }
        if is_covered.any() {
            let covered =
                covered::lanes(scene, light, (primitive, instance), (origin, direction), distance, is_covered);
            found = V3::select(covered, V3::zero(), found);
        }
        found
    }
}

/// Where points of flat lights, all p = corner + u a + v b, lie in the second triangle of a parallelogram: u + v > 1.
/// With A = |a x b| and n its unit normal, u = (p - corner) x b . n / A and v = a x (p - corner) . n / A.
#[inline(always)]
fn beyond_diagonal<F: Lanes>(lights: &LightTable, light: F::U, point: V3<F>) -> F::M {
    let row = lights.flat.row::<F>(flat_row(lights, light));
    let [a, b] = [V3(row[3], row[4], row[5]), V3(row[6], row[7], row[8])];
    let (normal, area) = (V3(row[9], row[10], row[11]), row[15]);
    let from_corner = point.sub(V3(row[0], row[1], row[2]));
    let (u, v) = (from_corner.cross(b).dot(normal), a.cross(from_corner).dot(normal));
    let is_pair = (row[17].to_bits() & F::U::splat(LightTable::TRIANGLE)).eq(F::U::splat(0));
    is_pair & area.lt(u + v)
}

/// By a texture's number, where that is not 0.
#[inline(always)]
fn share<F: Lanes>(scene: &Scene, number: F::U, at: At<F>, normal: V3<F>, mask: F::M) -> V3<F> {
    let (zero, one) = (F::splat(0.0), F::splat(1.0));
    let on = mask & !number.eq(F::U::splat(0));
    if !on.any() {
        return V3::grey(one);
    }
    let V3(red, green, blue) = F::apart(Texel { scene, number, at, normal, mask: on });
    let color = V3(red.max(zero).min(one), green.max(zero).min(one), blue.max(zero).min(one));
    V3::select(on, color, V3::grey(one))
}
