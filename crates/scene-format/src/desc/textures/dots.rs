//! Round dots.

use super::{Mapping, Pattern, SolidMapping};
use crate::desc::Color;
use crate::diagnostic::Spanned;
use crate::schema::Rule;
use crate::words::scene_struct;

scene_struct! {
    /// Round dots, one in the middle of each unit square of the mapped coordinates.
    pub struct Dots as "Dots", "a pattern of dots" {
        /// The colour between the dots.
        a: Spanned<Color> = [0.0; 3] => Rule::share();
        /// The colour of the dots.
        b: Spanned<Color> = [1.0; 3] => Rule::share();
        /// Half a dot's width; dots are one apart.
        radius: f64 = 0.3 => Rule::within("a radius", 0.0, 0.5);
        /// How they lie: `Uv(scale: 8)` puts eight along each side of a rectangle.
        mapping: Mapping = Mapping::default();
    }
}

impl Pattern for Dots {
    fn colors(&self) -> [Color; 2] {
        [self.a.value, self.b.value]
    }

    fn mapping(&self) -> SolidMapping {
        self.mapping.clone().into()
    }
}
