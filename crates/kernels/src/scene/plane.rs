//! Planes without an end, as rays are tested with them.
//!
//! No box holds a plane, so none hangs in the tree: every ray asks every plane. Their equations are in `f64`, and so is
//! what a ray's t is reckoned from; it is rounded once. So a plane is as exact at the horizon as before the camera's
//! feet, wherever the point is that it was written by. The arithmetic is plain, the same on all processors, levels and
//! widths. A ray that leaves a plane knows it and never meets it again.

use super::Shape;
use crate::shapes::Row;

/// A plane in render space: all points p with n.p = offset.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// Its unit normal.
    pub normal: [f64; 3],
    /// How far it is from the origin, along the normal.
    pub offset: f64,
    /// Primitive id.
    pub id: u32,
}

/// Planes are met up to so far: what lies beyond would be seen in 2^-30 of a picture's height, and squares of the
/// distance would leave the range of `f32`.
const FARTHEST: f64 = 1_073_741_824.0; // 2^30

impl Plane {
    /// How far a point is off it, along the normal.
    #[inline(always)]
    pub fn height(&self, [x, y, z]: [f64; 3]) -> f64 {
        let [a, b, c] = self.normal;
        a * x + b * y + c * z - self.offset
    }

    /// t where a line meets it; not above 0 or no number where it does not ahead.
    #[inline(always)]
    pub fn meets(&self, origin: [f64; 3], [x, y, z]: [f64; 3]) -> f64 {
        let [a, b, c] = self.normal;
        let t = -(self.height(origin) / (a * x + b * y + c * z));
        if t < FARTHEST { t } else { f64::NEG_INFINITY }
    }
}

/// The planes of a scene, in the order of their ids.
#[derive(Default)]
pub struct PlaneTable {
    /// The planes.
    pub rows: Vec<Plane>,
}

impl PlaneTable {
    /// Those among shapes, the first of which has the id `first`.
    pub fn new(shapes: &[Shape], first: u32) -> Self {
        let planes = (first..).zip(shapes).filter(|(_, shape)| shape.unit.is_endless());
        let row = |(id, shape): (u32, &Shape)| {
            let (normal, offset) = Row::new(&shape.unit, &shape.placement).flat_faces().next()?.equation();
            Some(Plane { normal: normal.to_array(), offset, id })
        };
        PlaneTable { rows: planes.filter_map(row).collect() }
    }

    /// Those that a camera sees; `hidden`: of shapes, the first of which has the id `first`.
    pub fn seen(&self, hidden: &[bool], first: u32) -> PlaneTable {
        let is_seen = |plane: &&Plane| !hidden.get((plane.id - first) as usize).copied().unwrap_or(false);
        PlaneTable { rows: self.rows.iter().filter(is_seen).copied().collect() }
    }

    /// Whether there are none.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}
