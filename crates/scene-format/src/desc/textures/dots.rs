//! Round dots.

use super::{Albedo, Mapping, Pattern, SolidMapping};
use crate::schema::Rule;
use crate::words::scene_struct;

scene_struct! {
    /// Round dots, one in the middle of each unit square of the mapped coordinates.
    pub struct Dots as "Dots", "a pattern of dots" {
        /// The colour between the dots.
        a: Albedo = [0.0; 3] => Rule::part();
        /// The colour of the dots.
        b: Albedo = [1.0; 3] => Rule::part();
        /// Half a dot's width; dots are one apart.
        radius: f64 = 0.3 => Rule::within("a radius", 0.0, 0.5);
        /// How they lie: `Uv(scale: 8)` puts eight along each side of a rectangle.
        mapping: Mapping = Mapping::default();
    }
}

impl Pattern for Dots {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.a, &self.b]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        Some(self.mapping.clone().into())
    }
}
