//! Lambert.

use super::Rough;
use crate::random::{Random, about, polar};
use glam::DVec3;
use std::f64::consts::PI;

/// A diffuse surface.
pub struct Diffuse {
    pub albedo: DVec3,
}

impl Rough for Diffuse {
    /// albedo / pi.
    fn f(&self, _n: DVec3, _wo: DVec3, _wi: DVec3) -> DVec3 {
        self.albedo / PI
    }

    /// Cosine-weighted.
    fn sample(&self, n: DVec3, _wo: DVec3, random: &mut Random) -> DVec3 {
        about(n, polar((1.0 - random.number()).sqrt(), random.number()))
    }

    fn density(&self, n: DVec3, _wo: DVec3, wi: DVec3) -> f64 {
        n.dot(wi).max(0.0) / PI
    }
}
