//! Lamps of which some points shine more than others, by a texture.

use super::{NONE, Scene};

/// Where the lights of a scene lie as surfaces, and how much of their light is there on average. Columns, index =
/// light.
#[derive(Clone, Debug)]
pub struct Glow {
    /// The number of the texture that says how much of its light each point shines, as materials have it; 0: all points
    /// shine alike.
    pub texture: Vec<u32>,
    /// The primitive; of a parallelogram the first of its two triangles.
    pub primitive: Vec<u32>,
    /// Its instance, or [`NONE`].
    pub instance: Vec<u32>,
    /// How much of its radiance a light has, on average, about: what chooses between lights goes by it. Never zero.
    pub share: Vec<f32>,
}

impl Glow {
    /// Of a scene, as if its textures took nothing away; `None` where all lights shine evenly.
    pub fn even(scene: &Scene) -> Option<Self> {
        let of_material = &scene.tables.materials.glow;
        if of_material.is_empty() {
            return None;
        }
        let count = scene.lights.len();
        // Look-ups read whole registers.
        let column = |fill: u32| vec![fill; count.max(16)];
        let share = vec![1.0; count];
        let mut glow = Glow { texture: column(0), primitive: column(0), instance: column(NONE), share };
        let mut note = |light: u32, material: u32, primitive: u32, instance: u32| {
            let k = light as usize;
            if k < count {
                glow.texture[k] = of_material.get(material as usize).copied().unwrap_or(0);
                glow.primitive[k] = primitive;
                glow.instance[k] = instance;
            }
        };
        for (id, sphere) in (0..).zip(scene.spheres.iter()) {
            note(sphere.light, sphere.material, id, NONE);
        }
        for (id, shape) in (scene.spheres.len() as u32..).zip(scene.shapes.iter()) {
            note(shape.light, shape.material, id, NONE);
        }
        let (first, triangles) = (scene.tables.loose(), &scene.triangles);
        for (number, instance) in (0..).zip(scene.instances.iter()) {
            let mesh = scene.meshes[instance.mesh as usize];
            // From the last on, so that of two triangles with one light the first stays.
            for k in (mesh.first_triangle..mesh.first_triangle + mesh.triangle_count).rev() {
                let own = triangles.material[k as usize];
                let material = if instance.material == NONE { own } else { instance.material };
                let light = triangles.light.get(k as usize).copied().unwrap_or(NONE);
                note(light, material, first + k, number);
            }
        }
        let is_uneven = glow.texture.iter().any(|&number| number != 0);
        is_uneven.then_some(glow)
    }
}
