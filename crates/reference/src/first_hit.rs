//! What the picture's layers show: the first hit of a ray through a pixel's centre.

use crate::world::World;
use crate::{Smoothing, camera, texture};
use glam::DVec3;
use tracer_core::Scene;
use tracer_core::scene::Projection;

/// What is seen at a pixel's centre, in render space.
#[derive(Clone, Copy, Debug)]
pub struct FirstHit {
    /// The point.
    pub point: DVec3,
    /// Shading normal, unit, on the viewer's side.
    pub normal: DVec3,
    /// Distance from the eye along the view axis; of cameras that see all around the distance itself.
    pub depth: f64,
    /// Texture coordinates, v upwards.
    pub uv: [f64; 2],
    /// Albedo, reflectance or transmittance; of lamps none.
    pub albedo: DVec3,
    /// What it shines to the viewer, in W/(sr m^2).
    pub emission: DVec3,
    /// Its object's place among `objects`, behind them the lamps.
    pub object: u32,
    /// Its material's place, or `NONE`.
    pub material: u32,
}

/// The first hits of the rays from the eye through the pixels' centres, row by row; `None` where nothing is hit.
pub fn first_hits(scene: &Scene) -> Vec<Option<FirstHit>> {
    let world = World::new(scene);
    let [width, height] = scene.size;
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    pixels.map(|pixel| first_hit(scene, &world, pixel)).collect()
}

fn first_hit(scene: &Scene, world: &World, [x, y]: [u32; 2]) -> Option<FirstHit> {
    let camera = &scene.camera;
    let [x, y] = [(x, scene.size[0]), (y, scene.size[1])].map(|(x, n)| 2.0 * (f64::from(x) + 0.5) / f64::from(n) - 1.0);
    let (camera, [x, y]) = &camera::of_eye(camera, [x, -y], [x, -y]);
    let ray = camera::through(camera, *x, *y)?;
    let hit = world.closest(&ray, true)?;
    let s = world.surface(&ray, &hit, Smoothing::Naive);
    let light = world.light_of(&hit, &s).map(|light| &scene.lights[light]);
    let albedo = match (light, scene.materials.get(s.material as usize)) {
        (Some(_), _) | (_, None) => DVec3::ZERO,
        (None, Some(material)) => texture::albedo(scene, material.traits().color, &s),
    };
    let emission = light.map_or(DVec3::ZERO, |light| texture::shine(scene, light, &s));
    Some(FirstHit {
        point: s.p,
        normal: s.ns,
        depth: match camera.projection {
            Projection::Perspective { .. } | Projection::Orthographic => (s.p - camera.eye).dot(camera.forward),
            Projection::Panorama | Projection::Fisheye { .. } => (s.p - camera.eye).length(),
        },
        uv: s.uv,
        albedo,
        emission,
        object: world.object_of(&hit),
        material: s.material,
    })
}
