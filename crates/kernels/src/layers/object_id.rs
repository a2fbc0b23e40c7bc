//! Which object: 1 is the first of `objects`, then the next, what `Repeat` makes one by one; behind them the lamps of
//! `lights`. All copies of an object are one. Zero: none.

use super::{PictureLayer, Pixel};

pub(super) struct ObjectId;

impl PictureLayer for ObjectId {
    const NAME: &'static str = "object_id";
    const CHANNELS: &'static [&'static str] = &["Y"];
    // Between two numbers there is a third object, so they have no mean.
    const PIXEL: Pixel = Pixel::Nearest(|scene, primitive, instance, _| {
        let shape =
            || scene.shapes.get((primitive as usize).checked_sub(scene.spheres.len())?).map(|shape| shape.object);
        let sphere = || scene.spheres.get(primitive as usize).map(|sphere| sphere.object);
        scene
            .instances
            .get(instance as usize)
            .map(|instance| instance.object)
            .or_else(sphere)
            .or_else(shape)
            .map_or(0, |k| k + 1)
    });
}
