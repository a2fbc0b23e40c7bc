//! Lamps of which some points shine more than others: by a texture, or since something else in their plane is met in
//! place of them.

use super::{NONE, Scene};
use crate::shapes::{Solid, UnitShape};

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
    /// 1 where something that lies in the light's plane is met in place of some part of it ([`crate::bvh`]), which
    /// gives no light then; else 0.
    pub covered: Vec<u32>,
    /// How much of its radiance a light has, on average, about: what chooses between lights goes by it. Never zero.
    pub share: Vec<f32>,
}

impl Glow {
    /// Of a scene, as if nothing took light away; `None` where all lights shine evenly.
    pub fn even(scene: &Scene) -> Option<Self> {
        let of_material = &scene.tables.materials.glow;
        let accel = scene.accel.as_deref().filter(|accel| accel.has_coplanar());
        if of_material.is_empty() && accel.is_none() {
            return None;
        }
        let count = scene.lights.len();
        // Look-ups read whole registers.
        let column = |fill: u32| vec![fill; count.max(16)];
        let share = vec![1.0; count];
        let mut glow =
            Glow { texture: column(0), primitive: column(0), instance: column(NONE), covered: column(0), share };
        scene.surfaces_of_lights(|light, material, primitive, instance| {
            let k = light as usize;
            if k < count {
                glow.texture[k] = of_material.get(material as usize).copied().unwrap_or(0);
                glow.primitive[k] = primitive;
                glow.instance[k] = instance;
                let shines = scene.lights[k].radiance() != [0.0; 3];
                let is_covered = accel.is_some_and(|accel| shines && accel.is_covered(primitive, instance));
                glow.covered[k] |= u32::from(is_covered);
            }
        });
        let is_uneven = glow.texture.iter().chain(&glow.covered).any(|&number| number != 0);
        is_uneven.then_some(glow)
    }
}

impl Scene {
    /// Tells of all surfaces: of each the light that it is, or none of [`Scene::lights`], its material, its primitive,
    /// and its instance or [`NONE`]. Of two triangles that are one light the first comes last.
    pub fn surfaces_of_lights(&self, mut tell: impl FnMut(u32, u32, u32, u32)) {
        for (id, sphere) in (0..).zip(self.spheres.iter()) {
            tell(sphere.light, sphere.material, id, NONE);
        }
        for (id, shape) in (self.spheres.len() as u32..).zip(self.shapes.iter()) {
            match shape.unit {
                UnitShape::Solid(Solid { operands: [first, count], .. }) => {
                    let operands = self.solids.operands.iter().skip(first as usize).take(count as usize);
                    operands.for_each(|operand| tell(operand.light, operand.material, id, NONE));
                }
                _ => tell(shape.light, shape.material, id, NONE),
            }
        }
        let (first, triangles) = (self.tables.loose(), &self.triangles);
        for (number, instance) in (0..).zip(self.instances.iter()) {
            let mesh = self.meshes[instance.mesh as usize];
            for k in (mesh.first_triangle..mesh.first_triangle + mesh.triangle_count).rev() {
                let own = triangles.material[k as usize];
                let material = if instance.material == NONE { own } else { instance.material };
                let light = triangles.light.get(k as usize).copied().unwrap_or(NONE);
                tell(light, material, first + k, number);
            }
        }
    }
}
