//! One texture times another.

use super::{Albedo, Pattern, SolidMapping};
use crate::schema::Rule;
use crate::words::scene_struct;

scene_struct! {
    /// The product of two colours or textures, channel by channel: one tints the other, or darkens it.
    pub struct Multiply as "Multiply", "a product" {
        /// One.
        a: Albedo = [1.0; 3] => Rule::part();
        /// The other.
        b: Albedo = [1.0; 3] => Rule::part();
    }
}

impl Pattern for Multiply {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.a, &self.b]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        None
    }
}
