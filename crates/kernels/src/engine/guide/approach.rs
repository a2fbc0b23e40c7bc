//! Where photons from very far lights begin: not at the light but short of the casters.
//!
//! A ray of numbers in single precision leads 2^-24 of its length beside what it was aimed at. From the sun to a glass
//! ball that is some thousand metres. So a photon of a light that is thousands of the caster's radii away starts on its
//! way, before the first thing that may stand in it.

use super::casters::{Caster, around, around_shape, placed};
use crate::scene::{Light, Scene};
use glam::DVec3;
use std::cmp::Ordering;

/// How far rays may begin from a caster, in its radii.
struct Reach {
    /// From farther lights photons start before the caster, if they can.
    far: f64,
    /// If they can from so near.
    near: f64,
    /// And are made at the light otherwise, but not from farther: a hundredth of a radius astray.
    farthest: f64,
}

/// A ray goes 2^-24 of its length astray.
const REACH: Reach = Reach { far: 8192.0, near: 16_384.0, farthest: 131_072.0 };

/// Of spheres that are met in another way (see `scene::sphere`) it does so with the square.
const REACH_OF_LARGE: Reach = Reach { far: 64.0, near: 64.0, farthest: 256.0 };

/// Casters from this radius on may be such, in render space.
const LARGE: f64 = 2.0;

/// Wider lights, in radii over distances, send no beam of which the width could be neglected.
const WIDE: f64 = 0.1;

/// More pairs of a far light and an object are not looked at one by one: then photons start at the light.
const MOST_LOOKS: usize = 20_000_000;

/// A sphere around what may be in the way.
pub(super) type Ball = (DVec3, f64);

/// Where photons of a pair start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// At the light.
    Light,
    /// So far before the middle of the caster.
    Before(f64),
    /// At the light, from which rays go astray: paths must not count on them.
    Stray,
}

/// Whether rays that begin so far before a caster go by so much beside what they were aimed at that paths must not
/// count on them.
pub(super) fn is_astray(before: f64, caster: &Caster) -> bool {
    let reach = if caster.radius < LARGE { REACH } else { REACH_OF_LARGE };
    before.partial_cmp(&(reach.near * caster.radius)) != Some(Ordering::Less)
}

/// What may stand between lights and casters, gathered when first asked about. What is missed here would not stand in
/// the way of light paths, which bring light.
pub struct Ways<'a> {
    scene: &'a Scene,
    balls: Option<Vec<Ball>>,
    looks: usize,
}

impl<'a> Ways<'a> {
    /// Of a scene.
    pub fn new(scene: &'a Scene) -> Self {
        Ways { scene, balls: None, looks: 0 }
    }

    /// Of photons from a light to a caster; `within`: which is in the light.
    pub fn start(&mut self, light: &Light, caster: &Caster, within: bool) -> Start {
        let scene = self.scene;
        let (center, radius) = light.bounds(&scene.spheres);
        let between = center.distance(caster.center);
        let distance = if within { radius - between } else { between };
        let reach = if caster.radius < LARGE { REACH } else { REACH_OF_LARGE };
        if distance.partial_cmp(&(reach.far * caster.radius)) != Some(Ordering::Greater) {
            return Start::Light;
        }
        let otherwise = if distance > reach.farthest * caster.radius { Start::Stray } else { Start::Light };
        let balls = self.balls.get_or_insert_with(|| balls(scene));
        self.looks += balls.len();
        if self.looks > MOST_LOOKS || !(within || radius < WIDE * distance) {
            return otherwise;
        }
        let own = match light {
            Light::Sphere { sphere, .. } => *sphere as usize,
            Light::Curved(curved) => scene.spheres.len() + curved.shape as usize,
            Light::Parallelogram(_) | Light::Triangle(_) => usize::MAX,
        };
        let others = || balls.iter().enumerate().filter(|(k, _)| *k != own).map(|(_, ball)| *ball);
        let first = if within {
            around_all(others(), caster, !scene.tables.planes.rows.is_empty())
        } else {
            first_in_the_way(scene, others(), caster, (center - caster.center) / distance, radius / distance)
        };
        let start = 1.01 * first;
        let is_near = start < reach.near * caster.radius;
        let is_between = start < 0.5 * (distance - if within { 0.0 } else { radius });
        if is_near && is_between { Start::Before(start) } else { otherwise }
    }
}

/// How far from the middle of the caster the farthest thing reaches; without an end where there are planes.
fn around_all(balls: impl Iterator<Item = Ball>, caster: &Caster, planes: bool) -> f64 {
    if planes {
        return f64::INFINITY;
    }
    balls.map(|(center, size)| center.distance(caster.center) + size).fold(2.0 * caster.radius, f64::max)
}

/// How far from the middle of the caster, on the way to a light in this direction, the farthest thing reaches that may
/// stand in the way; `wide`: the light's radius over its distance, at most [`WIDE`].
fn first_in_the_way(
    scene: &Scene,
    balls: impl Iterator<Item = Ball>,
    caster: &Caster,
    towards: DVec3,
    wide: f64,
) -> f64 {
    // The tangent of half of the light's angle. At that angle to the axis ways are longer by the cosine.
    let widens = wide / (1.0 - wide * wide).sqrt();
    let longer = (1.0 + widens * widens).sqrt();
    let widest = |along: f64| caster.radius + widens * along.max(0.0);
    let mut farthest = 2.0 * caster.radius;
    for (center, size) in balls {
        let to = center - caster.center;
        let along = to.dot(towards);
        let aside = (to - towards * along).length();
        if along > -size && aside < size + widest(along + size) {
            farthest = farthest.max(to.length() + size);
        }
    }
    for plane in &scene.tables.planes.rows {
        let along = plane.meets(caster.center.to_array(), towards.to_array());
        // A wide beam meets a slanted plane so much sooner or later; it widens by so much on the way.
        let slant = DVec3::from(plane.normal).dot(towards).abs();
        let widens = widens / slant;
        if widens.partial_cmp(&0.5) != Some(Ordering::Less) {
            return f64::INFINITY;
        }
        let slope = (caster.radius / slant + widens * along.abs()) / (1.0 - widens);
        if along + slope > 0.0 {
            farthest = farthest.max((along + slope) * longer);
        }
    }
    farthest
}

/// Spheres around the spheres, the shapes and what meshes are placed, in this order. Around what has no end there is
/// none: no number, with which nothing compares.
pub(super) fn balls(scene: &Scene) -> Vec<Ball> {
    let mut balls: Vec<Ball> = scene.spheres.iter().map(|sphere| (sphere.center, sphere.radius)).collect();
    balls.extend(scene.shapes.iter().map(|shape| match shape.unit.is_endless() {
        true => (DVec3::NAN, f64::NAN),
        false => around_shape(shape),
    }));
    let meshes: Vec<Ball> = scene
        .meshes
        .iter()
        .map(|mesh| around(scene, mesh.first_triangle..mesh.first_triangle + mesh.triangle_count))
        .collect();
    for instance in scene.instances.iter() {
        let Some(&(center, radius)) = meshes.get(instance.mesh as usize) else { continue };
        balls.push(match instance.placement {
            None => (center, radius),
            Some(rows) => placed(rows, center, radius),
        });
    }
    balls
}
