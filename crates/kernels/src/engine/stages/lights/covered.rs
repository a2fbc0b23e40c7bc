//! Points of lamps where something else in their plane is met instead, lane by lane: as the tree tells it of hits (see
//! [`crate::bvh`]), by the ray that goes there.

use super::curved::{Column3, MOST, Set, columns};
use crate::bvh::Rays;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{LightTable, NONE, Scene};

/// Whether lights `light`, of primitives and instances, are not what rays meet there, after about these distances, in
/// the lanes of the mask; no others.
#[inline(always)]
pub fn lanes<F: Lanes>(
    scene: &Scene,
    light: F::U,
    (primitive, instance): (F::U, F::U),
    (origin, direction): (V3<F>, V3<F>),
    distance: F,
    lanes: F::M,
) -> F::M {
    let mut asked = Asked {
        light: [0; MOST],
        primitive: [0; MOST],
        instance: [0; MOST],
        origin: columns(origin),
        direction: columns(direction),
        distance: [0.0; MOST],
    };
    light.store(&mut asked.light);
    primitive.store(&mut asked.primitive);
    instance.store(&mut asked.instance);
    distance.store(&mut asked.distance);
    F::M::from_bits(covered(scene, &asked, lanes.bits()))
}

/// What is asked of which light.
struct Asked {
    light: [u32; MOST],
    primitive: [u32; MOST],
    instance: [u32; MOST],
    origin: Column3,
    direction: Column3,
    distance: [f32; MOST],
}

#[inline(never)]
fn covered(scene: &Scene, asked: &Asked, lanes: u32) -> u32 {
    let Some(accel) = scene.accel.as_deref() else { return 0 };
    let ([ox, oy, oz], [dx, dy, dz]) = (&asked.origin, &asked.direction);
    let (from_primitive, from_instance) = (&[NONE; MOST], &[NONE; MOST]);
    let rays = Rays { ox, oy, oz, dx, dy, dz, from_primitive, from_instance };
    let is_covered = |&lane: &usize| {
        let target = (asked.primitive[lane], asked.instance[lane]);
        let slack = slack(&scene.tables.lights, asked.light[lane]);
        accel.is_covered_at(target, &rays, lane, asked.distance[lane], slack)
    };
    Set(lanes).filter(is_covered).map(|lane| 1 << lane).sum()
}

/// How far off its plane rays to a curved light may end: twice as far as they do, for the rounding of distances.
fn slack(lights: &LightTable, light: u32) -> f32 {
    let row = lights.curved.get(light.wrapping_sub(lights.spheres) as usize);
    row.map_or(0.0, |row| 2.0 * row.lamp.offset() as f32)
}
