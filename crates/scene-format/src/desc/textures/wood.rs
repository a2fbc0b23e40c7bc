//! Rings of wood.

use super::{Albedo, Pattern, SolidMapping};
use crate::schema::Rule;
use crate::words::scene_struct;

scene_struct! {
    /// Rings around the y axis, one a unit of the mapped coordinates, bent by noise. Along y it looks like the side of
    /// a plank, in stripes; across it, at the end of a plank, like a cut tree, in rings about the origin. There is no
    /// field that turns it: with `mapping: Object()` it turns with the object's `transform`. So a plank whose grain
    /// runs along x is written upright and turned: `Box(size: (0.2, 2, 0.1), transform: [Rotate(axis: (0, 0, 1),
    /// degrees: 90)])`. The heart of the tree is at x = 0, z = 0: an `offset` moves it.
    pub struct Wood as "Wood", "wood" {
        /// The colour in a ring's middle, and on the axis.
        a: Albedo = [0.0; 3] => Rule::part();
        /// The colour between.
        b: Albedo = [1.0; 3] => Rule::part();
        /// How far noise bends the rings, in rings.
        distortion: f64 = 0.2 => Rule::within("a distance", -1e3, 1e3);
        /// How it lies: `Object(scale: 4)` makes it four times finer.
        mapping: SolidMapping = SolidMapping::object();
    }
}

impl Pattern for Wood {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.a, &self.b]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        Some(self.mapping.clone())
    }
}
