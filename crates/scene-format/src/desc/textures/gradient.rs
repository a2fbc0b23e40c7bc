//! From one colour to another.

use super::{Albedo, Pattern, SolidMapping, Uv};
use crate::schema::Rule;
use crate::words::{scene_struct, scene_words};

scene_struct! {
    /// From `a` where the mapped coordinate is 0 to `b` where it is 1, linear between, and constant beyond.
    pub struct Gradient as "Gradient", "a gradient" {
        /// The colour at 0.
        a: Albedo = [0.0; 3] => Rule::part();
        /// The colour at 1.
        b: Albedo = [1.0; 3] => Rule::part();
        /// What runs from 0 to 1.
        axis: GradientAxis = GradientAxis::Y;
        /// How it lies.
        mapping: SolidMapping = SolidMapping::Uv(Uv::default());
    }
}

scene_words! {
    /// What runs from 0 to 1 in a gradient.
    pub enum GradientAxis, "axis of a gradient" {
        /// The second coordinate: v, or y.
        Y,
        /// The first: u, or x.
        X,
        /// The third, which is 0 where there are two.
        Z,
        /// The distance from the origin.
        Radial,
    }
}

impl Pattern for Gradient {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.a, &self.b]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        Some(self.mapping.clone())
    }
}
