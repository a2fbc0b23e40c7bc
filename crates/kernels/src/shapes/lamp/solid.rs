//! Operands of solids that shine: a direction uniform in the cone about a sphere that holds the operand, or all around
//! from within that sphere. Where it meets the solid on another operand, or not at all, the sample is nothing, so what
//! is cut away, hollow or seen from behind is as right as what a ray finds.
//!
//! Nobody knows how large the surface is that is left of an operand: points of it are not drawn, so no photons and no
//! light paths start there.

use super::{Start, Towards, round};
use crate::shapes::csg::{OnSolid, Part};
use crate::shapes::{Row, Solid};
use glam::DVec3;
use std::f64::consts::PI;

/// An operand of a solid, in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Operand {
    /// Which one, among those of the scene.
    number: u32,
    /// A sphere that holds what may be left of it.
    center: DVec3,
    radius: f64,
}

impl Operand {
    /// Of a solid of which that operand shines, and whose bounds are those of what may be left of it.
    pub(super) fn new(solid: &Solid) -> Self {
        let [low, high] = solid.bounds;
        Operand { number: solid.operands[0], center: 0.5 * (low + high), radius: 0.5 * (high - low).length() }
    }

    /// The area of its sphere.
    pub(super) fn area(&self) -> f64 {
        4.0 * PI * self.radius * self.radius
    }

    /// A direction, from the solid itself where `leaves`, for two random numbers; `None`: this time none.
    pub(super) fn sample(
        &self,
        row: &Row,
        parts: &[Part],
        (from, leaves): (DVec3, bool),
        two_sided: bool,
        [u, v]: [f64; 2],
    ) -> Option<Towards> {
        let o = (from - self.center) / self.radius;
        let to = if o.length_squared() <= 1.0 { round::anywhere(u, v) } else { round::direction(o, u, v) };
        // As rays have it.
        let direction = to.try_normalize()?.as_vec3().as_dvec3();
        let distance = row.meet_among(parts, from, direction, leaves)?;
        let OnSolid { operand, outward: normal, .. } = row.on_solid(parts, from + distance * direction)?;
        let shines = operand == self.number && (two_sided || normal.dot(direction) < 0.0);
        (shines && distance > 0.0).then(|| Towards { direction, distance, inverse_pdf: self.inverse_pdf(from) })
    }

    /// The solid angle of the cone.
    pub(super) fn inverse_pdf(&self, from: DVec3) -> f64 {
        let o = (from - self.center) / self.radius;
        if o.length_squared() <= 1.0 { 4.0 * PI } else { round::measure(o) }
    }

    /// A place holder: nothing starts on it.
    pub(super) fn start(&self) -> Start {
        Start { point: self.center, normal: DVec3::Z, rarity: 1.0 }
    }
}
