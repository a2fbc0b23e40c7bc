//! Directions to luminous spheres, uniform in the solid angle that the sphere covers.

use crate::random::{Random, about, polar};
use glam::DVec3;
use std::f64::consts::TAU;
use tracer_core::Scene;
use tracer_core::scene::{Light, Sphere};

/// 1 - cos of the half angle under which a sphere is seen: sin = r/d, so 1 - cos = sin^2 / (1 + cos). From within it is all around: 2.
fn one_minus_cos(sphere: &Sphere, from: DVec3) -> f64 {
    let sin2 = sphere.radius * sphere.radius / sphere.center.distance_squared(from);
    if sin2 >= 1.0 { 2.0 } else { sin2 / (1.0 + (1.0 - sin2).sqrt()) }
}

fn sphere(scene: &Scene, light: usize) -> &Sphere {
    let Light::Sphere { sphere, .. } = scene.lights[light];
    &scene.spheres[sphere as usize]
}

/// A direction to one of the lights; each is as likely as the others.
pub fn sample(scene: &Scene, from: DVec3, random: &mut Random) -> DVec3 {
    let sphere = sphere(scene, random.below(scene.lights.len()));
    let z = 1.0 - random.number() * one_minus_cos(sphere, from);
    let axis = (sphere.center - from).try_normalize().unwrap_or(DVec3::Z);
    about(axis, polar(z, random.number()))
}

/// The density of [`sample`]: the mean over the lights of 1 / (2 pi (1 - cos)) within their cones. What is in the way does not matter.
pub fn density(scene: &Scene, from: DVec3, direction: DVec3) -> f64 {
    let cones = (0..scene.lights.len()).map(|light| {
        let sphere = sphere(scene, light);
        let opening = one_minus_cos(sphere, from);
        let to_center = sphere.center - from;
        // The line's distance from the centre against the radius; `direction` may point away.
        let miss = to_center.cross(direction).length_squared();
        let inside = opening == 2.0 || (to_center.dot(direction) > 0.0 && miss <= sphere.radius * sphere.radius);
        if inside { 1.0 / (TAU * opening) } else { 0.0 }
    });
    cones.sum::<f64>() / scene.lights.len() as f64
}
