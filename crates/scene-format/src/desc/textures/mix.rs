//! Two textures in one.

use super::{Albedo, Pattern, SolidMapping};
use crate::schema::Rule;
use crate::words::scene_struct;

scene_struct! {
    /// Between two colours or textures, by a number or a texture: a + weight (b - a).
    pub struct Mix as "Mix", "a mix" {
        /// What shows where the weight is 0.
        a: Albedo = [0.0; 3] => Rule::part();
        /// What shows where it is 1.
        b: Albedo = [1.0; 3] => Rule::part();
        /// How much of `b` shows; of colours the luminance counts. A picture here is read as numbers: see
        /// `color_space`.
        weight: Albedo = [0.5; 3] => Rule::share();
    }
}

impl Pattern for Mix {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.a, &self.b, &self.weight]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        None
    }
}
