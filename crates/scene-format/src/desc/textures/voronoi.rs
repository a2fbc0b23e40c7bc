//! Cells about scattered points.

use super::{Albedo, Pattern, SolidMapping};
use crate::schema::Rule;
use crate::words::{scene_struct, scene_words};

scene_struct! {
    /// Cells about scattered points, one point in each unit cube of the mapped coordinates (Worley 1996): stones,
    /// scales, cracks.
    pub struct Voronoi as "Voronoi", "a pattern of cells" {
        /// The colour where the feature is 0.
        a: Albedo = [0.0; 3] => Rule::part();
        /// The colour where it is 1.
        b: Albedo = [1.0; 3] => Rule::part();
        /// What goes from 0 to 1.
        feature: VoronoiFeature = VoronoiFeature::F1;
        /// How far points are from the middles of their cubes: at 0 they are there, at 1 anywhere in the cube.
        jitter: f64 = 1.0 => Rule::within("a share", 0.0, 1.0);
        /// How it lies: `Object(scale: 4)` puts four cells along a unit of length.
        mapping: SolidMapping = SolidMapping::object();
    }
}

scene_words! {
    /// What of scattered points goes from 0 to 1.
    pub enum VoronoiFeature, "feature of cells" {
        /// The distance to the nearest point, at most 1: bumps.
        F1,
        /// How much farther the second nearest is, at most 1: 0 at the borders of cells, for cracks and joints.
        F2MinusF1,
        /// A number of each cell's own, by chance: stones of many shades.
        Cell,
    }
}

impl Pattern for Voronoi {
    fn parts(&self) -> Vec<&Albedo> {
        vec![&self.a, &self.b]
    }

    fn mapping(&self) -> Option<SolidMapping> {
        Some(self.mapping.clone())
    }
}
