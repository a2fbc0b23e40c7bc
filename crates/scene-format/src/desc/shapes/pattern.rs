//! Copies by a rule: rows and columns, a ring, chance.

use crate::desc::Vec3;
use crate::schema::Rule;
use crate::words::scene_enum;

scene_enum! {
    /// Copies by a rule, instead of a list of placements.
    pub enum PlacementPattern, "placement pattern" {
        /// Rows and columns about the origin, x first, then y, then z: `Grid(count: (5, 1, 5), spacing: (2, 1, 2))`.
        Grid as "a grid" {
            /// How many along x, y and z.
            count: [u32; 3] => Rule::within("a whole number", 1.0, 1e6);
            /// From one to the next along x, y and z.
            spacing: Vec3 = [1.0; 3] => Rule::within("a distance", -1e12, 1e12).unit("in the scene's unit");
        };
        /// Evenly on a circle about the origin, counter-clockwise seen from the tip of `axis`.
        Ring as "a ring of copies" {
            /// How many.
            count: u32 => Rule::within("a whole number", 1.0, 1e7);
            /// Radius of the circle.
            radius: f64 => Rule::length("a length");
            /// What the circle goes round.
            axis: Vec3 = [0.0, 1.0, 0.0] => Rule::direction();
            /// Angle of the first copy. At 0 it stands where (0, 1, 0) x axis points, or (1, 0, 0) where the axis is
            /// upright.
            start: f64 = 0.0 => Rule::within("an angle", -1e9, 1e9).unit("in degrees");
            /// Whether copies turn with the circle, as the seats of a carousel do; else all look the same way.
            turn: bool = true;
        };
        /// By chance, evenly over a box.
        Scatter as "a scattering of copies" {
            /// How many.
            count: u32 => Rule::within("a whole number", 1.0, 1e7);
            /// A corner of the box.
            min: Vec3 => Rule::point();
            /// The corner opposite, greater or less along each axis; the same y gives copies on the ground.
            max: Vec3 => Rule::point();
            /// Another number gives other places.
            seed: u32 = 0u32 => Rule::within("a whole number", 0.0, 4_294_967_295.0);
            /// Least distance between copies. A copy that finds no room in 32 tries is left out, which is a warning.
            spacing: Option<f64> = None => Rule::length("a length");
            /// Axis about which each copy is turned by an angle of its own; `None`: none is.
            turn: Option<Vec3> = None => Rule::direction();
            /// The least and the greatest factor of the copies' sizes.
            scale: [f64; 2] = [1.0, 1.0] => Rule::within("a factor", 1e-9, 1e9);
        };
    }
}

impl PlacementPattern {
    /// How many copies it asks for.
    pub fn count(&self) -> u64 {
        match self {
            PlacementPattern::Grid { count, .. } => count.iter().map(|&n| u64::from(n)).product(),
            PlacementPattern::Ring { count, .. } | PlacementPattern::Scatter { count, .. } => u64::from(*count),
        }
    }
}
