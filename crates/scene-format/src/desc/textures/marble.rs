//! Veins of marble.

use super::{Albedo, Pattern, SolidMapping};
use crate::desc::Vec3;
use crate::diagnostic::Spanned;
use crate::schema::Rule;
use crate::words::scene_struct;

scene_struct! {
    /// Veins across an axis, one a unit of the mapped coordinates, bent by six octaves of turbulence. With `mapping:
    /// Object()` they turn with the object's `transform`, as `Wood` does.
    pub struct Marble as "Marble", "marble" {
        /// The colour of the veins.
        a: Albedo = [0.0; 3] => Rule::part();
        /// The colour between them.
        b: Albedo = [1.0; 3] => Rule::part();
        /// How far turbulence bends the veins, in veins.
        distortion: f64 = 1.0 => Rule::within("a distance", -1e3, 1e3);
        /// Direction across the veins, in the mapped coordinates: they follow each other along it.
        axis: Spanned<Vec3> = [1.0, 0.0, 0.0] => Rule::direction();
        /// How it lies: `Object(scale: 4)` makes it four times finer.
        mapping: SolidMapping = SolidMapping::object();
    }
}

impl Pattern for Marble {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.a, &self.b]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        Some(self.mapping.clone())
    }
}
