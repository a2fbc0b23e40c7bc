//! Where photons from very far lights begin: not at the light but short of the casters.
//!
//! A ray of numbers in single precision leads 2^-24 of its length beside what it was aimed at. From the sun to a glass
//! ball that is some thousand metres. So a photon of a light that is thousands of the caster's radii away starts on its
//! way, before the first thing that may stand in it.

use super::casters::{Caster, around, around_shape, placed};
use crate::scene::{NONE, Scene};
use glam::DVec3;

/// From a light this many radii of the caster away, rays may well go a thousandth of a radius astray.
const FAR: f64 = 8192.0;

/// The same of casters as large as the scene, whose spheres are met in another way (see `scene::sphere`).
const FAR_FROM_LARGE: f64 = 64.0;

/// How large these are, in render space.
const LARGE: f64 = 1.0;

/// More pairs of a far light and an object are not looked at one by one: then a photon starts at its light.
const MOST_LOOKS: usize = 20_000_000;

/// A sphere around what may be in the way.
type Ball = (DVec3, f64);

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

/// What may stand between lights and casters, gathered when first asked about.
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

    /// Of photons from a light with this middle and radius to a caster; `within`: which is in the light.
    pub fn start(&mut self, (light, radius): Ball, caster: &Caster, within: bool) -> Start {
        let between = light.distance(caster.center);
        let distance = if within { radius - between } else { between };
        let far = if caster.radius < LARGE { FAR } else { FAR_FROM_LARGE };
        if distance.partial_cmp(&(far * caster.radius)) != Some(std::cmp::Ordering::Greater) {
            return Start::Light;
        }
        let scene = self.scene;
        let balls = self.balls.get_or_insert_with(|| balls(scene));
        self.looks += balls.len();
        if self.looks > MOST_LOOKS {
            return Start::Stray;
        }
        let first = if within {
            around_all(balls, caster, !scene.tables.planes.rows.is_empty())
        } else {
            first_in_the_way(scene, balls, caster, (light - caster.center) / distance, radius / distance)
        };
        let start = 1.01 * first;
        if start < 0.5 * (distance - if within { 0.0 } else { radius }) { Start::Before(start) } else { Start::Stray }
    }
}

/// How far from the middle of the caster the farthest thing reaches; without an end where there are planes.
fn around_all(balls: &[Ball], caster: &Caster, planes: bool) -> f64 {
    if planes {
        return f64::INFINITY;
    }
    balls.iter().map(|(center, size)| center.distance(caster.center) + size).fold(2.0 * caster.radius, f64::max)
}

/// How far from the middle of the caster, on the way to a light in this direction, the farthest thing reaches that may
/// stand in the way; `widens`: the light's radius over its distance.
fn first_in_the_way(scene: &Scene, balls: &[Ball], caster: &Caster, towards: DVec3, widens: f64) -> f64 {
    let widest = |along: f64| caster.radius + widens * along.max(0.0);
    let mut farthest = 2.0 * caster.radius;
    for (center, size) in balls {
        let to = *center - caster.center;
        let along = to.dot(towards);
        let aside = (to - towards * along).length();
        if along > -size && aside < size + widest(along + size) {
            farthest = farthest.max(along + size);
        }
    }
    for plane in &scene.tables.planes.rows {
        let along = plane.meets(caster.center.to_array(), towards.to_array());
        // A wide beam meets a slanted plane so much sooner or later; it widens by so much on the way.
        let slant = DVec3::from(plane.normal).dot(towards).abs();
        let widens = widens / slant;
        if widens.partial_cmp(&0.5) != Some(std::cmp::Ordering::Less) {
            return f64::INFINITY;
        }
        let slope = (caster.radius / slant + widens * along.abs()) / (1.0 - widens);
        if along + slope > 0.0 {
            farthest = farthest.max(along + slope);
        }
    }
    farthest
}

/// Spheres around all that has an end, without the lights of `lights`, which are spheres.
fn balls(scene: &Scene) -> Vec<Ball> {
    let mut balls: Vec<Ball> = scene
        .spheres
        .iter()
        .filter(|sphere| sphere.light == NONE)
        .map(|sphere| (sphere.center, sphere.radius))
        .collect();
    let lit = |light: u32| light != NONE;
    let shapes = scene.shapes.iter().filter(|shape| !shape.unit.is_endless() && !lit(shape.light));
    balls.extend(shapes.map(around_shape));
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
