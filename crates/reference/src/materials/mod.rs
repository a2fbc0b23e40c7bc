//! How surfaces scatter light, as the textbook has it: a file for each material. wo points to the viewer, wi to the
//! light, both unit and away from the surface; `f` has no cosine, densities are in solid angle of wi.

mod blinn_phong;
mod conductor;
mod diffuse;
mod mirror;
mod transparent;

use crate::random::Random;
use crate::surface::Surface;
use crate::texture;
use glam::DVec3;
use tracer_core::Scene;
use tracer_core::scene::Material;
use tracer_core::scene::materials::Fresnel;

/// What scatters to more than one direction.
pub trait Rough {
    /// f at a pair of directions.
    fn f(&self, n: DVec3, wo: DVec3, wi: DVec3) -> DVec3;

    /// A direction wi.
    fn sample(&self, n: DVec3, wo: DVec3, random: &mut Random) -> DVec3;

    /// The density of [`Rough::sample`].
    fn density(&self, n: DVec3, wo: DVec3, wi: DVec3) -> f64;
}

/// Interpolated normals that are seen from behind, or nearly so, are raised towards the viewer.
fn seen(n: DVec3, wo: DVec3) -> DVec3 {
    let missing = (1e-3 - n.dot(wo)).max(0.0);
    (n + missing * wo).normalize()
}

/// A direction that light comes from, and its weight f cos / p.
pub struct Incident {
    pub direction: DVec3,
    pub weight: DVec3,
}

/// What a surface does.
pub enum Scattered {
    /// It takes all light.
    Nothing,
    /// One direction of a specular lobe, taken at random.
    Specular(Incident),
    /// Lobes that can be evaluated.
    Rough(Box<dyn Rough>),
}

/// What is reckoned once for each material.
pub struct Materials {
    /// What conductors reflect at once.
    energy: Vec<Option<conductor::Energies>>,
}

impl Materials {
    /// Of a scene.
    pub fn new(scene: &Scene) -> Self {
        let energy = scene.materials.iter().map(|material| match material {
            Material::Conductor(words) => Some(conductor::Energies::new(words.alpha())),
            _ => None,
        });
        Materials { energy: energy.collect() }
    }
}

/// What the surface's material does with light to wo: one line a material.
pub fn scatter(scene: &Scene, known: &Materials, s: &Surface, wo: DVec3, random: &mut Random) -> Scattered {
    let color = |albedo| texture::albedo(scene, albedo, s);
    let number = |albedo| texture::number(scene, albedo, s);
    match scene.materials[s.material as usize] {
        // Its surface is a light's.
        Material::Emissive(_) => Scattered::Nothing,
        Material::Mirror(material) => mirror::sample(color(material.reflectance), s, wo),
        Material::Transparent(glass) => transparent::sample(glass.ior, color(glass.transmittance), s, wo, random),
        Material::Diffuse(material) => Scattered::Rough(Box::new(diffuse::Diffuse { albedo: color(material.albedo) })),
        Material::Conductor(words) => {
            let Some(energies) = &known.energy[s.material as usize] else { return Scattered::Nothing };
            let roughness = number(words.roughness).clamp(0.0, 1.0);
            let tint = match words.fresnel {
                Fresnel::Tinted { edge_tint, .. } => color(edge_tint),
                Fresnel::Complex { .. } => DVec3::ONE,
            };
            let (color, energy) = (color(Material::Conductor(words).traits().color), energies.at(roughness));
            let conductor = conductor::Conductor { words, color, tint, alpha: roughness * roughness, energy };
            conductor::scatter(conductor, s, wo)
        }
        Material::BlinnPhong(words) => Scattered::Rough(Box::new(blinn_phong::BlinnPhong {
            albedo: color(words.albedo),
            exponent: number(words.exponent).clamp(0.0, 1e7),
            specular: number(words.specular).clamp(0.0, 1.0),
            energy_conserving: words.energy_conserving,
        })),
    }
}
