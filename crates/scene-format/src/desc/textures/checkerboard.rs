//! Squares, or cubes, of two colours.

use super::{Albedo, Pattern, SolidMapping, Uv};
use crate::schema::Rule;
use crate::words::scene_struct;

scene_struct! {
    /// Squares of two colours, one square a unit of the mapped coordinates: `a` where the sum of their whole parts is
    /// even. In space they are cubes, and a face that lies where two meet is in the upper one.
    pub struct Checkerboard as "Checkerboard", "a checkerboard" {
        /// One colour.
        a: Albedo = [0.0; 3] => Rule::part();
        /// The other one.
        b: Albedo = [1.0; 3] => Rule::part();
        /// How the squares lie: `Uv(scale: 8)` puts eight along each side of a rectangle, `Object(scale: 2)` two along
        /// a unit of length.
        mapping: SolidMapping = SolidMapping::Uv(Uv::default());
    }
}

impl Pattern for Checkerboard {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.a, &self.b]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        Some(self.mapping.clone())
    }
}
