//! Balls of radius 1 about the origin that shine, seen from outside: directions uniform in the solid angle.

use super::Way;
use glam::DVec3;
use std::f64::consts::TAU;

/// 1 - cos of the half angle of the cone around the ball.
fn opening(o: DVec3) -> f64 {
    let sin2 = (1.0 / o.length_squared()).min(1.0);
    sin2 / (1.0 + (1.0 - sin2).sqrt())
}

/// The solid angle.
pub(super) fn measure(o: DVec3) -> f64 {
    TAU * opening(o)
}

/// A direction.
pub(super) fn direction(o: DVec3, u: f64, v: f64) -> DVec3 {
    let down = u * opening(o);
    let sine = (down * (2.0 - down)).max(0.0).sqrt();
    let axis = (-o).normalize();
    let (right, up) = axis.any_orthonormal_pair();
    axis * (1.0 - down) + (right * libm::cos(TAU * v) + up * libm::sin(TAU * v)) * sine
}

/// The density of a direction, in solid angle.
pub(super) fn density(way: &Way) -> f64 {
    let along = -way.o.dot(way.d);
    let misses = along <= 0.0 || (way.o + along * way.d).length_squared() > 1.0;
    if misses { 0.0 } else { 1.0 / measure(way.o) }
}

/// A direction of all, uniform.
pub(super) fn anywhere(u: f64, v: f64) -> DVec3 {
    let z = 1.0 - 2.0 * u;
    let r = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(r * libm::cos(TAU * v), r * libm::sin(TAU * v), z)
}
