//! Directions to lights: to spheres uniform in the solid angle that they cover, to flat ones uniform in their area, to
//! other curved ones uniform in the area of their parts before they were brought to where they are, to operands of
//! solids in the solid angle of a sphere around them.

mod curved;

use crate::random::{Random, about, polar};
use glam::DVec3;
use std::f64::consts::TAU;
use tracer_core::Scene;
use tracer_core::scene::{CurvedLight, FlatLight, Light, NONE, Sphere};
use tracer_core::shapes::UnitShape;

/// 1 - cos of the half angle under which a sphere is seen: sin = r/d, so 1 - cos = sin^2 / (1 + cos). From within it is
/// all around: 2.
fn one_minus_cos(sphere: &Sphere, from: DVec3) -> f64 {
    let sin2 = sphere.radius * sphere.radius / sphere.center.distance_squared(from);
    if sin2 >= 1.0 { 2.0 } else { sin2 / (1.0 + (1.0 - sin2).sqrt()) }
}

/// A direction to one of the lights; each is as likely as the others.
pub fn sample(scene: &Scene, from: DVec3, random: &mut Random) -> DVec3 {
    let light = &scene.lights[random.below(scene.lights.len())];
    let (u, v) = (random.number(), random.number());
    let at = |flat: &FlatLight, u: f64, v: f64| flat.corner + u * flat.edges[0] + v * flat.edges[1];
    let point = match light {
        Light::Sphere { sphere, .. } => return towards(&scene.spheres[*sphere as usize], from, [u, v]),
        Light::Curved(CurvedLight { unit: UnitShape::Solid(_), .. }) => return towards(&around(light), from, [u, v]),
        Light::Curved(light) => curved::point(light, [random.number(), u, v]),
        Light::Parallelogram(flat) => at(flat, u, v),
        // Turk 1990: the root gives small slices of it as much as large ones.
        Light::Triangle(flat) => at(flat, (1.0 - v) * u.sqrt(), v * u.sqrt()),
    };
    (point - from).normalize()
}

/// A direction to a sphere, uniform.
fn towards(sphere: &Sphere, from: DVec3, [u, v]: [f64; 2]) -> DVec3 {
    let z = 1.0 - u * one_minus_cos(sphere, from);
    let axis = (sphere.center - from).try_normalize().unwrap_or(DVec3::Z);
    about(axis, polar(z, v))
}

/// A sphere around a light.
fn around(light: &Light) -> Sphere {
    let (center, radius) = light.bounds(&[]);
    Sphere { center, radius, material: NONE, object: NONE, copy: 0, light: NONE, coordinates: 0 }
}

/// The density of [`sample`]: the mean over the lights of what they have alone. What is in the way does not matter.
pub fn density(scene: &Scene, from: DVec3, direction: DVec3) -> f64 {
    let each = scene.lights.iter().map(|light| match light {
        Light::Sphere { sphere, .. } => of_sphere(&scene.spheres[*sphere as usize], from, direction),
        Light::Curved(CurvedLight { unit: UnitShape::Solid(_), .. }) => of_sphere(&around(light), from, direction),
        Light::Curved(light) => curved::density(light, from, direction),
        Light::Parallelogram(flat) => of_flat(flat, 1.0, |u, v| u <= 1.0 && v <= 1.0, from, direction),
        Light::Triangle(flat) => of_flat(flat, 0.5, |u, v| u + v <= 1.0, from, direction),
    });
    each.sum::<f64>() / scene.lights.len() as f64
}

/// 1 / (2 pi (1 - cos)) within the cone around a sphere.
fn of_sphere(sphere: &Sphere, from: DVec3, direction: DVec3) -> f64 {
    let opening = one_minus_cos(sphere, from);
    let to_center = sphere.center - from;
    // The line's distance from the centre against the radius; `direction` may point away.
    let miss = to_center.cross(direction).length_squared();
    let inside = opening == 2.0 || (to_center.dot(direction) > 0.0 && miss <= sphere.radius * sphere.radius);
    if inside { 1.0 / (TAU * opening) } else { 0.0 }
}

/// d^2 / (A |cos|) where the line meets the light; `part`: its area over that of the parallelogram.
fn of_flat(flat: &FlatLight, part: f64, within: impl Fn(f64, f64) -> bool, from: DVec3, direction: DVec3) -> f64 {
    let [a, b] = flat.edges;
    let across = a.cross(b);
    let along = direction.dot(across);
    let d = (flat.corner - from).dot(across) / along;
    let from_corner = from + d * direction - flat.corner;
    let (u, v) = (from_corner.cross(b).dot(across), a.cross(from_corner).dot(across));
    let (u, v) = (u / across.length_squared(), v / across.length_squared());
    if along == 0.0 || d <= 0.0 || u < 0.0 || v < 0.0 || !within(u, v) {
        return 0.0;
    }
    d * d / (part * along.abs())
}
