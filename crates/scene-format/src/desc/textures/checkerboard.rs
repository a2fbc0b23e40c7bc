//! Squares of two colours.

use super::Mapping;
use crate::desc::Color;
use crate::diagnostic::Spanned;
use crate::schema::Rule;
use crate::words::scene_struct;

scene_struct! {
    /// Squares of two colours, one square a unit of the mapped coordinates: `a` where the sum of their whole parts is even.
    pub struct Checkerboard as "Checkerboard", "a checkerboard" {
        /// One colour.
        a: Spanned<Color> = [0.0; 3] => Rule::share();
        /// The other one.
        b: Spanned<Color> = [1.0; 3] => Rule::share();
        /// How the squares lie: `Uv(scale: 8)` puts eight along each side of a rectangle.
        mapping: Mapping = Mapping::default();
    }
}
