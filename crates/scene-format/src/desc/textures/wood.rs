//! Rings of wood.

use super::{Albedo, Pattern, SolidMapping};
use crate::desc::Vec3;
use crate::diagnostic::Spanned;
use crate::schema::Rule;
use crate::words::scene_struct;

scene_struct! {
    /// Rings around the trunk's axis, one a unit of the mapped coordinates, bent by noise. Along the axis it looks like
    /// the side of a plank, in stripes; across it, at the end of a plank, like a cut tree, in rings about the origin. A
    /// floor or a table top shows stripes with `axis: (1, 0, 0)`, rings with the default. With `mapping: Object()` it
    /// turns with the object's `transform`. The axis passes through the origin: an `offset` of the mapping moves it.
    pub struct Wood as "Wood", "wood" {
        /// The colour in a ring's middle, and on the axis.
        a: Albedo = [0.0; 3] => Rule::part();
        /// The colour between.
        b: Albedo = [1.0; 3] => Rule::part();
        /// How far noise bends the rings, in rings.
        distortion: f64 = 0.2 => Rule::within("a distance", -1e3, 1e3);
        /// Direction of the trunk, in the mapped coordinates: grain runs along it.
        axis: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::direction();
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
