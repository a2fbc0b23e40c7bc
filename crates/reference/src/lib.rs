//! The reference: a path tracer as the textbook writes it, in `f64`, that the engine of `tracer-core` is held against.
//!
//! It reads the public [`Scene`] and shares nothing below it: every ray is tested against every sphere, shape and
//! triangle, one sample at a time, recursively, with its own random numbers. Sampling is plain and different from the
//! engine's: at a diffuse or glossy surface ONE direction is drawn, half of the time towards a light, half of the time
//! by the material, and weighted by the density of that mixture (Veach 1997, 9.2.4: the one-sample model with the
//! balance heuristic). There are no shadow rays and no roulette, and a light counts wherever a ray meets it.
//!
//! The rendering equation (Kajiya 1986), with L_e only on lights, which absorb:
//! L(x, wo) = L_e + integral of f(wo, wi) L(x', -wi) |cos| dwi. A path ends after `max_bounces + 1` scatterings.
#![forbid(unsafe_code)]

mod camera;
mod environment;
mod first_hit;
mod light;
mod materials;
mod pattern;
mod random;
mod shapes;
mod solids;
pub mod statistics;
mod surface;
mod texture;
mod torus;
mod vertex_color;
mod world;

pub use first_hit::{FirstHit, first_hits};
use glam::DVec3;
use materials::{Incident, Materials, Rough, Scattered};
pub use random::Random;
use scene_format::Diagnostics;
use tracer_core::Scene;
use world::World;

/// Where rays start that leave a smooth mesh by diffuse or glossy scattering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Smoothing {
    /// On the smooth surface that the triangle stands for (Hanika 2021), as the engine does.
    Hanika,
    /// On the triangle: the terminator of a low-poly mesh shows its edges.
    Naive,
}

/// A half-line; the direction is unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub origin: DVec3,
    pub direction: DVec3,
}

/// A rendered picture: row by row from the top, linear RGB.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Mean radiance per pixel.
    pub mean: Vec<DVec3>,
    /// Variance of that mean, per pixel and channel: the samples are independent.
    pub variance: Vec<DVec3>,
}

/// A scene whose pixels are asked for one by one.
pub struct Reference<'a>(Tracer<'a>);

impl<'a> Reference<'a> {
    /// Of a scene.
    pub fn new(scene: &'a Scene, smoothing: Smoothing) -> Self {
        Reference(Tracer { scene, world: World::new(scene), materials: Materials::new(scene), smoothing })
    }

    /// Mean radiance of a pixel over this many independent samples, at least two, and the variance of that mean.
    pub fn pixel(&self, pixel: [u32; 2], samples: u32, seed: u64) -> [DVec3; 2] {
        let mut sums = Sums::default();
        self.add(pixel, samples, seed, &mut sums);
        sums.mean_and_variance()
    }

    /// Adds this many independent samples of a pixel.
    pub fn add(&self, [x, y]: [u32; 2], samples: u32, seed: u64, sums: &mut Sums) {
        let Reference(tracer) = self;
        let scene = tracer.scene;
        let mut random = Random::new(seed ^ (u64::from(y) << 32 | u64::from(x)) << 16);
        for _ in 0..samples {
            let ray = camera::ray(&scene.camera, scene.size, [x, y], &mut random);
            let radiance = ray.map_or(DVec3::ZERO, |ray| tracer.radiance(ray, 0, &mut random));
            sums.sum += radiance;
            sums.squares += radiance * radiance;
        }
        sums.samples += samples;
    }
}

/// What samples of a pixel have brought.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sums {
    sum: DVec3,
    squares: DVec3,
    samples: u32,
}

impl Sums {
    /// Their mean, and the variance of that mean, if they are independent and two at least.
    pub fn mean_and_variance(&self) -> [DVec3; 2] {
        let n = f64::from(self.samples);
        let mean = self.sum / n;
        [mean, (self.squares / n - mean * mean).max(DVec3::ZERO) / (n - 1.0)]
    }
}

/// A scene in which something moves while the shutter is open, as so many samples see it: one at random in each of as
/// many equal parts of the time, and a seed for each. The engine has other times.
pub fn moments(scene: &Scene, samples: u32, seed: u64) -> impl Iterator<Item = (u64, Result<Scene, Diagnostics>)> {
    let mut random = Random::new(seed ^ 0x5b_077e);
    (0..samples).filter_map(move |k| {
        let part = (f64::from(k) + random.number()) / f64::from(samples);
        Some((seed.wrapping_add(u64::from(k).wrapping_mul(0x9e37_79b9_7f4a_7c15)), scene.at(part)?))
    })
}

/// Renders a scene in which something moves while the shutter is open, with this many samples per pixel, at least two,
/// at [`moments`] of their own. The variance is an upper bound: times are more even than by chance.
///
/// # Errors
/// What is wrong with the scene at one of the moments.
pub fn render_moving(scene: &Scene, samples: u32, seed: u64, smoothing: Smoothing) -> Result<Picture, Diagnostics> {
    let [width, height] = scene.size;
    let mut sums = vec![Sums::default(); width as usize * height as usize];
    for (seed, now) in moments(scene, samples, seed) {
        let now = now?;
        let reference = Reference::new(&now, smoothing);
        for (k, sums) in (0..).zip(&mut sums) {
            reference.add([k % width, k / width], 1, seed, sums);
        }
    }
    let [mean, variance] = [0, 1].map(|k| sums.iter().map(|sums| sums.mean_and_variance()[k]).collect());
    Ok(Picture { size: scene.size, mean, variance })
}

/// Renders the scene with this many independent samples per pixel, at least two, as it is when its shutter opens.
pub fn render(scene: &Scene, samples: u32, seed: u64, smoothing: Smoothing) -> Picture {
    let reference = Reference::new(scene, smoothing);
    let [width, height] = scene.size;
    let mut picture = Picture { size: scene.size, mean: Vec::new(), variance: Vec::new() };
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let [mean, variance] = reference.pixel([x, y], samples, seed);
        picture.mean.push(mean);
        picture.variance.push(variance);
    }
    picture
}

struct Tracer<'a> {
    scene: &'a Scene,
    world: World,
    materials: Materials,
    smoothing: Smoothing,
}

impl Tracer<'_> {
    /// Radiance that arrives along the ray, which has been scattered `scatterings` times.
    fn radiance(&self, ray: Ray, scatterings: u32, random: &mut Random) -> DVec3 {
        let Some(hit) = self.world.closest(&ray, scatterings == 0) else {
            return self.background(ray.direction, scatterings) * self.scene.radiance_unit;
        };
        let s = self.world.surface(&ray, &hit, self.smoothing);
        if let Some(light) = self.world.light_of(&hit, &s) {
            return texture::shine(self.scene, &self.scene.lights[light], &s);
        }
        if scatterings > self.scene.max_bounces {
            return DVec3::ZERO;
        }
        let wo = -ray.direction;
        match materials::scatter(self.scene, &self.materials, &s, wo, random) {
            Scattered::Nothing => DVec3::ZERO,
            Scattered::Specular(Incident { direction, weight }) => {
                weight * self.radiance(Ray { origin: s.p, direction }, scatterings + 1, random)
            }
            Scattered::Rough(lobes) => self.rough(&s, wo, &*lobes, scatterings, random),
        }
    }

    /// What comes from where nothing is.
    fn background(&self, direction: DVec3, scatterings: u32) -> DVec3 {
        match self.scene.environment() {
            Some(sky) if scatterings == 0 && !sky.camera_visible => DVec3::ZERO,
            Some(sky) => environment::radiance(sky, direction),
            None => DVec3::from(self.scene.background.map(f64::from)),
        }
    }

    /// One direction from the mixture of lights and material: f cos / p times what comes from there.
    fn rough(
        &self,
        s: &surface::Surface,
        wo: DVec3,
        lobes: &dyn Rough,
        scatterings: u32,
        random: &mut Random,
    ) -> DVec3 {
        let to_lights = if self.scene.lights.is_empty() { 0.0 } else { 0.5 };
        let direction = if random.number() < to_lights {
            light::sample(self.scene, s.start, random)
        } else {
            lobes.sample(s.ns, wo, random)
        };
        let cos = s.ns.dot(direction);
        if cos <= 0.0 || s.buries(direction) {
            return DVec3::ZERO;
        }
        let f = lobes.f(s.ns, wo, direction);
        // Directions that bring nothing may have no density either: conductors raise the normal.
        if f == DVec3::ZERO {
            return DVec3::ZERO;
        }
        let by_material = lobes.density(s.ns, wo, direction);
        let density = if to_lights == 0.0 {
            by_material
        } else {
            to_lights * light::density(self.scene, s.start, direction) + (1.0 - to_lights) * by_material
        };
        let weight = f * (cos / density);
        weight * self.radiance(Ray { origin: s.start, direction }, scatterings + 1, random)
    }
}
