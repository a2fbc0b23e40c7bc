//! The sphere of radius 1: an ellipsoid under a map.

use super::{ObjectRay, OnUnit, ball, first_end};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

pub(super) fn hit(ray: &ObjectRay, leaves: bool) -> Option<f64> {
    first_end(ray, ball(ray, 0.0, leaves)?, leaves)
}

/// Longitude and latitude: the middle of the picture looks along +z, u grows towards +x.
pub(super) fn surface(q: DVec3) -> OnUnit {
    let n = q.try_normalize().unwrap_or(DVec3::Z);
    let uv = DVec2::new(0.5 + libm::atan2(n.x, n.z) / TAU, 1.0 - libm::acos(n.y.clamp(-1.0, 1.0)) / PI);
    OnUnit { q: n, n, uv }
}
