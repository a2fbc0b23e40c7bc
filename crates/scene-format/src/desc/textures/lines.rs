//! Lines at whole coordinates.

use super::{Albedo, Mapping, Pattern, SolidMapping};
use crate::schema::Rule;
use crate::words::{scene_struct, scene_words};

scene_struct! {
    /// Lines where the mapped coordinates are whole: a grid, tiles with joints, stripes.
    pub struct Lines as "Lines", "a pattern of lines" {
        /// The colour of the lines.
        a: Albedo = [0.0; 3] => Rule::part();
        /// The colour between them.
        b: Albedo = [1.0; 3] => Rule::part();
        /// How wide a line is; lines are one apart. 0.5 makes even stripes.
        width: f64 = 0.05 => Rule::within("a width", 0.0, 1.0);
        /// Which way the lines run.
        along: LinesAlong = LinesAlong::Both;
        /// How they lie: `Uv(scale: 8)` puts eight along each side of a rectangle.
        mapping: Mapping = Mapping::default();
    }
}

scene_words! {
    /// Which way lines run.
    pub enum LinesAlong, "way of lines" {
        /// Along u and along v.
        Both,
        /// Along u: where v is whole.
        U,
        /// Along v: where u is whole.
        V,
    }
}

impl Pattern for Lines {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.a, &self.b]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        Some(self.mapping.clone().into())
    }
}
