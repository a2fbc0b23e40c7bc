//! What is known of lamps only when all else of a scene stands: how far before them rays end where something lies in
//! their plane, and how much of their light those have whose points shine unlike each other. What chooses between
//! lights, and who sends photons, goes by the latter, which need not be exact, since what is chosen seldom counts more.

use super::stages::lights::{curved, share_towards};
use crate::lanes::{ArrayF, ArrayU, Bits, Lanes};
use crate::math::V3;
use crate::sampling::warp;
use crate::scene::{Glow, Light, LightTable, Scene};
use glam::DVec3;
use rayon::prelude::*;
use std::sync::Arc;

type One = ArrayF<1>;

/// The least share that a lamp counts as: its bright points may lie between those that were looked at.
const LEAST: f64 = 1.0 / 16.0;
/// So many points of a lamp are looked at, of many lamps fewer.
const MOST_POINTS: usize = 64;
/// So many are looked at in all, about.
const ALL_POINTS: usize = 1 << 19;

/// Finds out which lights of a scene lie in one plane with others, which shine unevenly, and about how much: from then
/// on its tables know. Without such lights they stay as they are.
pub fn measure(scene: &mut Scene) {
    keep_off(scene);
    let Some(mut glow) = Glow::even(scene) else { return };
    let count = scene.lights.len();
    scene.tables.lights.glow = Some(Arc::new(glow.clone()));
    let points = (ALL_POINTS / count.max(1)).clamp(4, MOST_POINTS);
    let of_light = |k: usize| match [glow.texture[k], glow.covered[k]] {
        [0, 0] => 1.0,
        _ if !scene.lights[k].is_drawn() => 1.0,
        _ => share(scene, k, points) as f32,
    };
    glow.share = (0..count).into_par_iter().map(of_light).collect();
    let environment = scene.tables.lights.environment.clone();
    scene.tables.lights = LightTable::with_glow(&scene.lights, &scene.spheres, environment, Some(Arc::new(glow)));
}

/// Has rays to lamps end, and photons start, before what lies in one plane with them and overlaps them.
fn keep_off(scene: &mut Scene) {
    let Some(accel) = scene.accel.clone().filter(|accel| accel.has_coplanar()) else { return };
    let mut offsets = vec![0f32; scene.lights.len()];
    scene.surfaces_of_lights(|light, _, primitive, _| {
        if let Some(offset) = offsets.get_mut(light as usize) {
            *offset = offset.max(accel.coplanar_offset(primitive));
        }
    });
    if offsets.iter().all(|&offset| offset == 0.0) {
        return;
    }
    scene.lights.iter_mut().zip(offsets).for_each(|(light, offset)| light.keep_off(offset.into()));
    let environment = scene.tables.lights.environment.clone();
    scene.tables.lights = LightTable::new(&scene.lights, &scene.spheres, environment);
}

/// [`LEAST`] + (1 - [`LEAST`]) m, m the mean over so many points of the share that they have, channels by what they
/// shine.
fn share(scene: &Scene, light: usize, points: usize) -> f64 {
    let radiance = scene.lights[light].radiance();
    let (mut sum, mut all) = (0.0, 0.0);
    for k in 0..points {
        // The golden ratio's multiples lie even for every number of points.
        let [u, v] = [(k as f64 + 0.5) / points as f64, ((k as f64 + 0.5) * 0.618_033_988_749_895).fract()];
        let (point, normal, rarity) = start(scene, light, u, v);
        let [point, inwards] = [point, -normal].map(|v| V3::<One>::splat(v.as_vec3().to_array()));
        let number = ArrayU::splat(light as u32);
        let V3(red, green, blue) = share_towards(scene, number, (point, inwards), One::splat(0.0), One::first(1));
        for (channel, share) in radiance.into_iter().zip([red, green, blue].map(told)) {
            sum += channel * rarity * share;
            all += channel * rarity;
        }
    }
    let mean = if all > 0.0 { sum / all } else { 0.0 };
    LEAST + (1.0 - LEAST) * mean
}

/// A point of a light for two numbers from 0 to 1, the unit normal there, and one over the density of points there, but
/// for a factor.
fn start(scene: &Scene, light: usize, u: f64, v: f64) -> (DVec3, DVec3, f64) {
    let vector = |v: V3<One>| DVec3::new(told(v.0), told(v.1), told(v.2));
    match &scene.lights[light] {
        Light::Sphere { sphere, .. } => {
            let sphere = &scene.spheres[*sphere as usize];
            let [u, v] = [u, v].map(|x| One::splat(x as f32));
            let outwards = vector(warp::cone(u, v, One::splat(2.0)));
            (sphere.center + sphere.radius * outwards, outwards, 1.0)
        }
        Light::Curved(_) => {
            let lights = &scene.tables.lights;
            let row = ArrayU::splat(light as u32 - lights.spheres);
            let [u, v] = [u, v].map(|x| One::splat(x as f32));
            let start = curved::start::<One>(&lights.curved, row, u, v, One::first(1));
            (vector(start.point), vector(start.normal), told(start.rarity))
        }
        Light::Parallelogram(flat) => (flat.corner + u * flat.edges[0] + v * flat.edges[1], flat.normal(), 1.0),
        Light::Triangle(flat) => {
            let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
            (flat.corner + u * flat.edges[0] + v * flat.edges[1], flat.normal(), 1.0)
        }
    }
}

fn told(x: One) -> f64 {
    let mut out = [0.0];
    x.store(&mut out);
    f64::from(out[0])
}
