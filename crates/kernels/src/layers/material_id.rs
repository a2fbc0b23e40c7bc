//! Which material: 1 is the first of `materials`, then the next; behind them those without a name there: written in
//! objects, from MTL files, the default. Zero: none, or a lamp of `lights`, which has none.

use super::{PictureLayer, Pixel};
use crate::scene::NONE;

pub(super) struct MaterialId;

impl PictureLayer for MaterialId {
    const NAME: &'static str = "material_id";
    const CHANNELS: &'static [&'static str] = &["Y"];
    const PIXEL: Pixel = Pixel::Nearest(|scene, primitive, instance, body| {
        let first_triangle = scene.spheres.len() + scene.shapes.len();
        let shape = || scene.shapes.get((primitive as usize).checked_sub(scene.spheres.len())?);
        // Solids have the materials of what they are made of.
        let operand =
            body.checked_sub(scene.tables.shapes.first_body).and_then(|k| scene.solids.operands.get(k as usize));
        let material = match scene.instances.get(instance as usize) {
            Some(instance) if instance.material != NONE => instance.material,
            Some(_) => scene.triangles.material.get(primitive as usize - first_triangle).map_or(NONE, |&m| m),
            None => match scene.spheres.get(primitive as usize) {
                Some(sphere) => sphere.material,
                None => match operand {
                    Some(operand) => operand.material,
                    None => shape().map_or(NONE, |shape| shape.material),
                },
            },
        };
        material.wrapping_add(1)
    });
}
